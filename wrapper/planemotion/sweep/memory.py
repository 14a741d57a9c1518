"""The result of a sweep in memory: what `export` would write to a file, as an `xarray.Dataset`.

`MemoryStore` keeps the blocks of a sweep, `MemoryFile` stands where export expects a netCDF file, so that
both results have the same names, shapes and attributes by one description (export.py).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
import numpy.typing as npt

from .store import Block

if TYPE_CHECKING:
    import xarray as xr


class MemoryStore:
    """Takes the blocks of a sweep of `cases` cases, in order; nothing is ever there before."""

    def __init__(self, cases: int) -> None:
        self.cases = cases
        self.done = 0
        self.blocks: list[Block] = []

    def gaps(self) -> list[tuple[int, int]]:
        """First case and number of cases of what is missing at the beginning: all."""
        return [(0, self.cases)] if self.cases else []

    def add(self, first: int, block: Block) -> None:
        """Keeps the results of the cases from `first` on."""
        assert first == self.done, "blocks come in the order of the cases"
        self.blocks.append(block)
        self.done += len(block)


class MemoryVariable:
    """A variable that is filled box by box."""

    def __init__(self, dims: tuple[str, ...], values: npt.NDArray[Any]) -> None:
        self.dims = dims
        self.values = values
        self.attrs: dict[str, Any] = {}

    def __setitem__(self, box: tuple[slice, ...], values: npt.NDArray[Any]) -> None:
        self.values[box] = values


class MemoryFile:
    """As much of an h5netcdf.File as export uses."""

    def __init__(self) -> None:
        self.dimensions: dict[str, int] = {}
        self.variables: dict[str, MemoryVariable] = {}
        self.attrs: dict[str, Any] = {}

    def create_variable(
        self,
        name: str,
        dims: tuple[str, ...],
        dtype: Any,
        *,
        data: npt.NDArray[Any] | None = None,
        chunks: Sequence[int] | None = None,
    ) -> MemoryVariable:
        """Adds a variable of h5py's type `dtype`: `data`, or what an empty file reads as.  `chunks` says how
        a file would be laid out."""
        if data is not None:
            values = np.array(data)
        elif h5py.check_string_dtype(np.dtype(dtype)):
            values = np.full(self._shape(dims), "", dtype=object)
        else:
            values = np.zeros(self._shape(dims), dtype)
        variable = self.variables[name] = MemoryVariable(dims, values)
        return variable

    def _shape(self, dims: tuple[str, ...]) -> tuple[int, ...]:
        return tuple(self.dimensions[dim] for dim in dims)

    def dataset(self) -> xr.Dataset:
        """What xarray reads from such a file: dimensions' own variables and those that the attribute
        `coordinates` names are coordinates."""
        import xarray as xr

        variables: dict[str, xr.Variable] = {}
        named: set[str] = set()
        for name, variable in self.variables.items():
            attributes: Mapping[str, Any] = dict(variable.attrs)
            named.update(str(attributes.get("coordinates", "")).split())
            kept = {key: value for key, value in attributes.items() if key != "coordinates"}
            # What export writes needs none of the looks that xarray takes at whatever else it is given.
            variables[name] = xr.Variable(variable.dims, variable.values, kept, fastpath=True)
        apart = {name: x for name, x in variables.items() if name in self.dimensions or name in named}
        rest = {name: x for name, x in variables.items() if name not in apart}
        return xr.Dataset(rest, apart, self.attrs)
