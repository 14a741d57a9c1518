"""A map as a file: HDF5 that xarray opens, with checksums."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import h5py

from ..base.bounded import require_file
from ..base.checksums import seal
from ..base.errors import StudyError
from ..base.files import appearing

if TYPE_CHECKING:
    import xarray as xr

# What the attribute `kind` of a map says.
KIND = "outcome map"


def write(dataset: xr.Dataset, path: Path) -> None:
    """The file appears whole or not at all.  Raises StudyError if it cannot be written."""
    if not path.parent.is_dir():
        raise StudyError(f"{path}: cannot be written: there is no folder {path.parent}")
    with appearing(path) as temporary:
        dataset.to_netcdf(temporary, engine="h5netcdf")
        with h5py.File(temporary, "r+") as file:
            seal(file)


def is_map(path: Path) -> bool:
    """Whether it is the file of a map."""
    try:
        require_file(path)
        with h5py.File(path, "r") as file:
            return bool(file.attrs.get("kind") == KIND)
    except OSError:
        return False


def read(path: Path) -> xr.Dataset:
    """What `write` wrote."""
    import xarray as xr

    return xr.load_dataset(path, engine="h5netcdf")
