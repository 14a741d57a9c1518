"""A recorded run as an HDF5 file: everything that moved and pushed, over time.

The file is a netCDF-4 file along the dimension `row`, one row for every step that was taken and two for every
event, before and after its jump:

    t                    time, s
    mark                 0 a step, 1 just before an event, 2 just after it
    AB.B.velocity.x ...  what was recorded, named by its address, with its unit in the attribute `units`

In a scene with [runs] each run is a group of its own with the same content.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..base.arrays import Floats
from ..base.bounded import require_file
from ..base.errors import StudyError
from .kernel import status_name
from .outcome import History

STEP, BEFORE, AFTER = 0, 1, 2
_MARKS = {STEP: "step", BEFORE: "before_event", AFTER: "after_event"}
_KIND = "planemotion history"


def event_times(recorded: History) -> Floats:
    """The instants [events], each once, in s."""
    return np.unique(recorded.time[recorded.mark == AFTER])


def write(path: Path, runs: Mapping[str, History], attributes: Mapping[str, Any]) -> None:
    """Writes the recorded runs; the one run of a scene without [runs] has the name "".

    Raises OSError if the file cannot be written.
    """
    import h5netcdf
    import h5py

    from ..base.checksums import seal

    try:
        with h5netcdf.File(path, "w") as file:
            file.attrs["kind"] = _KIND
            for name, value in attributes.items():
                file.attrs[name] = value
            for run, recorded in runs.items():
                _write_run(file.create_group(run) if run else file, recorded)
        with h5py.File(path, "r+") as sealed:
            seal(sealed)
    except RuntimeError as error:  # what HDF5 says when closing fails
        raise OSError(str(error)) from error


def _write_run(group: Any, recorded: History) -> None:
    group.dimensions["row"] = len(recorded.time)
    group.create_variable("t", ("row",), "f8", data=recorded.time).attrs["units"] = "s"
    mark = group.create_variable("mark", ("row",), "i1", data=recorded.mark.astype(np.int8))
    mark.attrs.update(flag_values=np.array(list(_MARKS), np.int8), flag_meanings=" ".join(_MARKS.values()))
    for address, values in recorded.columns.items():
        variable = group.create_variable(address, ("row",), "f8", data=values, fillvalue=np.nan)
        variable.attrs["units"] = _unit(address, recorded.units[address])
    group.attrs.update(status=np.int32(recorded.status), status_word=status_name(recorded.status))


def _unit(address: str, unit: str) -> str:
    """The unit as people say it: J and rad are N*m and 1 for a calculation only."""
    words = address.split(".")
    if "energy" in words or words[-1] == "work":
        return "J"
    return "rad" if words[-1] in ("angle", "turned") else unit or "1"


def is_history(path: Path) -> bool:
    """Whether the file is one that `write` made; False for anything else, also for what is no file."""
    import h5py

    try:
        require_file(path)
        with h5py.File(path, "r") as file:
            return bool(file.attrs.get("kind", "") == _KIND)
    except (OSError, KeyError, RuntimeError):
        return False


def read(path: Path) -> tuple[dict[str, History], dict[str, Any]]:
    """What `write` wrote: the runs by name, and the attributes.  Raises StudyError if it cannot be read."""
    import h5py

    try:
        with h5py.File(path, "r") as file:
            groups = {name: item for name, item in file.items() if isinstance(item, h5py.Group)}
            runs = {name: _read_run(group) for name, group in (groups or {"": file}).items()}
            return runs, dict(file.attrs)
    except Exception as error:  # there is nothing that HDF5 does not say of a damaged file
        raise StudyError(f"{path}: cannot be read: {error}") from error


def _read_run(group: Any) -> History:
    named = {name: item for name, item in group.items() if name not in ("t", "mark", "row")}
    columns = {name: item[...].astype(np.float64) for name, item in named.items()}
    units = {name: str(item.attrs["units"]) for name, item in named.items()}
    status = int(np.ravel(group.attrs["status"])[0])
    return History(group["t"][...], columns, units, group["mark"][...].astype(np.int32), status)
