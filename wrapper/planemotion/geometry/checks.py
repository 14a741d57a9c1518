"""What the values of a scene must satisfy, whichever they are: sizes are positive, written points fit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..language.leaves import Leaf, evaluate
from ..language.tree import Node


@dataclass(frozen=True)
class Checks:
    """Expressions that must be positive.

    `positive`: the expressions; `steps`: what their leaves stand for, each after those it needs.
    """

    positive: tuple[Node, ...] = ()
    steps: tuple[tuple[str, Node], ...] = ()

    def hold(self, values: Mapping[str, float]) -> bool:
        """Whether they are at these values (SI) of the independent parameters."""
        known = dict(values)

        def look_up(leaf: Leaf) -> float:
            return known[str(leaf)]

        for name, node in self.steps:
            known[name] = evaluate(node, look_up)
        return all(evaluate(node, look_up) > 0 for node in self.positive)
