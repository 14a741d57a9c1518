"""The result of a sweep in memory, as an `xarray.Dataset`: what one reads from the file of the same sweep."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .block import Block
from .layout import MESSAGE, Layout, Tally

if TYPE_CHECKING:
    import xarray as xr


class MemoryStore:
    """Takes the blocks of a sweep of `cases` cases, in any order; nothing is ever there before."""

    def __init__(self, cases: int) -> None:
        self.cases = cases
        self.done = 0
        self._blocks: dict[int, Block] = {}

    @property
    def blocks(self) -> list[Block]:
        """The blocks in the order of the cases."""
        return [self._blocks[first] for first in sorted(self._blocks)]

    @property
    def missing(self) -> int:
        """Cases that are not there yet."""
        return self.cases - self.done

    def gaps(self) -> list[tuple[int, int]]:
        """First case and number of cases of what is missing at the beginning: all."""
        return [(0, self.cases)] if self.cases else []

    def fit(self, first: int, count: int, end: int) -> int:
        """How many cases from `first` on, `count` and at most up to `end`, are one block."""
        return min(count, end - first)

    def add(self, first: int, block: Block) -> None:
        """Keeps the results of the cases from `first` on."""
        self._blocks[first] = block
        self.done += len(block)


def dataset(layout: Layout, blocks: list[Block], attributes: Mapping[str, Any]) -> xr.Dataset:
    """What `xarray.load_dataset` reads from the file that `netcdf.write_result` makes of the same.

    Dimensions' own variables, and those that the attribute `coordinates` names, are coordinates.
    """
    import xarray as xr

    block = Block.join(blocks)
    tally = Tally(layout)
    tally.add(block)
    summary = tally.attributes()
    of_cases = dict(layout.case_values(block))
    of_cases[MESSAGE] = np.full(layout.cases, "", dtype=object)
    for row, text in block.message.items():
        of_cases[MESSAGE][row] = text
    variables: dict[str, xr.Variable] = {}
    zipped: set[str] = set()
    for one in layout.variables():
        values = one.data
        if values is None:
            cases = np.ascontiguousarray(of_cases[one.name], one.dtype)
            values = cases.reshape(layout.shape + cases.shape[1:])
        zipped.update(str(one.attributes.get("coordinates", "")).split())
        kept = {key: value for key, value in one.attributes.items() if key != "coordinates"}
        # What a layout says needs none of the looks that xarray takes at whatever else it is given.
        variables[one.name] = xr.Variable(one.dims, np.array(values), kept, fastpath=True)
    apart = {name: x for name, x in variables.items() if name in layout.dimensions or name in zipped}
    rest = {name: x for name, x in variables.items() if name not in apart}
    return xr.Dataset(rest, apart, {**attributes, **summary})
