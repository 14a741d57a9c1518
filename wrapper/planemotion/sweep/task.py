"""A block of cases as a task for any process: what it is sent, and what it gives back."""

from __future__ import annotations

import pickle
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..base.arrays import Floats
from ..base.errors import StudyError
from ..base.versions import row_versions
from .block import Block
from .retry import Retrying
from .solver import Solver
from .variants import Variants

# Scenes that a worker keeps ready: a worker may serve several sweeps at once.
_KEPT = 4


@dataclass(frozen=True)
class Recipe:
    """A solver as bytes, and what made it: another version might compute other bits."""

    versions: tuple[tuple[str, str], ...]
    solver: bytes

    @staticmethod
    def of(solver: Solver | Retrying | Variants) -> Recipe:
        """What is sent to the workers."""
        return Recipe(tuple(row_versions().items()), pickle.dumps(solver))


def compute_block(recipe: Recipe, swept: Floats, threads: int, attempt: int) -> Block:
    """The results of a case for each row of `swept` [ncase, swept], SI.

    `attempt` makes a task that is done again another one: some schedulers give the same failure for the same
    task.  Raises StudyError where the worker has another version of planemotion.
    """
    del attempt
    # What comes through a network may be read only, and in no order of its own.
    return _solver(recipe).compute(np.array(swept, np.float64, order="C"), workers=threads)


@lru_cache(_KEPT)
def _solver(recipe: Recipe) -> Solver | Retrying | Variants:
    here = row_versions()
    differ = [f"{name} {here.get(name, 'missing')} and not {text}" for name, text in recipe.versions
              if here.get(name) != text]  # fmt: skip
    if differ:
        raise StudyError(
            f"a worker has {', '.join(differ)}, so its bits may be others; "
            "install the same build of planemotion everywhere"
        )
    solver: Solver | Retrying | Variants = pickle.loads(recipe.solver)
    return solver
