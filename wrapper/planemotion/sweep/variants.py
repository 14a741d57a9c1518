"""Sweeps over what changes the scene itself, such as the number of its links: tables of their own for each.

A sweep over such a parameter has one solver for each of its values; a block of cases is shared out among
them.  Asks that a variant does not have are not reached in its cases.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain, product

import numpy as np
import numpy.typing as npt

from .._layout import PM_REASON_NOT_REACHED
from ..base.arrays import Floats
from ..base.errors import SceneError
from ..compile.asks import Asked
from ..geometry.parameters import Parameters, Reader
from ..reading.scene import SceneData
from .block import Block
from .plan import SweepPlan
from .retry import Retrying
from .solver import Solver

# Each has tables of its own.
MOST_VARIANTS = 1000


def switches_of(data: SceneData) -> frozenset[str]:
    """The parameters on which it depends what is active."""
    reader = Reader(Parameters(data.parameters, data.sweep.grids, data.book))
    elements = (
        *(data.bodies.values(), data.joints.values(), data.couplings.values()),
        *(data.contacts.values(), data.forces.values()),
    )
    written = [one.active for group in elements for one in group]
    written += [action.active for event in data.events.values() for action in event.do]
    nodes = [reader.parameters.parse(text) for text in written if isinstance(text, str)]
    return frozenset(name for node in nodes for name in reader.depends_on(node))


def variants_of(plan: SweepPlan, counted: frozenset[str]) -> tuple[tuple[int, ...], list[tuple[float, ...]]]:
    """The numbers of the swept parameters on which it depends what there is, and all values of these, SI."""
    columns = tuple(i for i, axis in enumerate(plan.axes) if axis.name in counted or axis.options)
    if not columns:
        return (), [()]
    named = [plan.names[i] for i in columns]
    groups = [[axis for axis in group if axis.name in named] for group in plan.groups]
    groups = [group for group in groups if group]
    # What moves together along a dimension, each once: cases that are listed repeat it.
    steps = [list(dict.fromkeys(zip(*(axis.si.tolist() for axis in group), strict=True))) for group in groups]
    count = math.prod(map(len, steps))
    if count > MOST_VARIANTS:
        reason = f"{count} scenes that differ in what there is; at most {MOST_VARIANTS} are possible"
        raise SceneError(reason, path=f"sweep.{named[0]}")
    order = [axis.name for group in groups for axis in group]
    found = [dict(zip(order, chain.from_iterable(one), strict=True)) for one in product(*steps)]
    return columns, list(dict.fromkeys(tuple(values[name] for name in named) for values in found))


@dataclass(frozen=True)
class Variants:
    """What computes cases of scenes that differ: `solvers` by the values in the `columns` of what is swept.

    `asks`: those of all, in order.
    """

    columns: tuple[int, ...]
    solvers: Mapping[tuple[float, ...], Solver | Retrying]
    asks: tuple[Asked, ...]

    def compute(
        self,
        swept: Floats,
        *,
        workers: int,
        stop: npt.NDArray[np.int32] | None = None,
        done: npt.NDArray[np.int64] | None = None,
    ) -> Block:
        """As Solver.compute."""
        begun = time.perf_counter()
        rows: dict[tuple[float, ...], list[int]] = {}
        for row, values in enumerate(zip(*(swept[:, i].tolist() for i in self.columns), strict=True)):
            rows.setdefault(values, []).append(row)
        blocks, order = [], []
        for values, own in rows.items():
            solver = self.solvers[values]
            blocks.append(_spread(solver.compute(swept[own], workers=workers, stop=stop), solver, self.asks))
            order += own
            if done is not None:
                done += len(own)
        return replace(
            _sorted(Block.join(blocks), np.argsort(np.array(order, np.int64))),
            seconds=time.perf_counter() - begun,
        )


def asks_of_all(solvers: Sequence[Solver | Retrying]) -> tuple[Asked, ...]:
    """The asks of all, each as long as it is anywhere."""
    asks: dict[str, Asked] = {}
    for solver in solvers:
        for _, _, ask in solver.asks:
            known = asks.get(ask.key)
            if known is not None and known.letters != ask.letters:
                reason = "its events differ from case to case; name those that are there in all"
                raise SceneError(reason, path=f"ask.{ask.key}")
            if known is None or ask.count > known.count:
                asks[ask.key] = ask
    return tuple(asks.values())


def _spread(block: Block, solver: Solver | Retrying, asks: Sequence[Asked]) -> Block:
    """The block with columns for all asks."""
    own: dict[str, tuple[int, int, int]] = {}
    place = 0
    for number, (_, _, ask) in enumerate(solver.asks):
        own[ask.key] = number, place, ask.count
        place += ask.count
    width = sum(ask.count for ask in asks)
    value = np.full((len(block), width), np.nan)
    error = np.full((len(block), width if solver.estimate else 0), np.nan, np.float32)
    reason = np.full((len(block), len(asks)), PM_REASON_NOT_REACHED, np.int8)
    first = 0
    for column, ask in enumerate(asks):
        if ask.key in own:
            number, at, count = own[ask.key]
            value[:, first : first + count] = block.value[:, at : at + count]
            if solver.estimate:
                error[:, first : first + count] = block.error[:, at : at + count]
            reason[:, column] = block.reason[:, number]
        first += ask.count
    return replace(block, value=value, error=error, reason=reason)


def _sorted(block: Block, order: npt.NDArray[np.int64]) -> Block:
    """Its cases in another order: row i is the one that stood at order[i]."""
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
    arrays = {name: getattr(block, name)[order] for name in Block.arrays()}
    return replace(
        block, **arrays, message={int(place[row]): text for row, text in sorted(block.message.items())}
    )
