"""A recorded run as a file or as a dataset: what moved and pushed, over time.

Both have the dimension `t`, with one row for each recorded time and two for every event, before and after its
jump:

    t                    time, s
    mark                 0 a time between events, 1 just before an event, 2 just after it
    event                names of what happened there, "" between events
    AB.B.velocity.x ...  what was recorded, named by its address, with its unit in the attribute `units`

An HDF5 file (.h5 or .nc) is a netCDF-4 file; in a scene with [runs] each run is a group of its own with the
same content.  A table (.csv) has the units in its header, and the run in its first column.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..base.arrays import Floats
from ..base.bounded import require_file
from ..base.errors import StudyError
from ..language.address import is_energy
from ..language.cf import cf_units, unit_of
from .kernel import status_name
from .outcome import History

if TYPE_CHECKING:
    import xarray

STEP, BEFORE, AFTER = 0, 1, 2
_MARKS = {STEP: "step", BEFORE: "before_event", AFTER: "after_event"}
_KIND = "planemotion history"
# Names of what is no quantity.
_TIME, _MARK, _EVENT = "t", "mark", "event"


def event_times(recorded: History) -> Floats:
    """The instants [events], each once, in s."""
    return np.unique(recorded.time[recorded.mark == AFTER])


def dataset(recorded: History, attributes: Mapping[str, Any]) -> xarray.Dataset:
    """The history: coordinates t, mark and event, and a variable [t] with its unit for each column."""
    import xarray

    variables = {
        name: ("t", values, cf_units(_unit(name, recorded.units[name])))
        for name, values in recorded.columns.items()
    }
    flags = {"flag_values": list(_MARKS), "flag_meanings": " ".join(_MARKS.values())}
    coordinates = {
        _TIME: ("t", recorded.time, {"units": "s"}),
        _MARK: ("t", recorded.mark.astype(np.int8), flags),
        _EVENT: ("t", np.array(_events(recorded), dtype=object)),
    }
    told = {**attributes, "status": status_name(recorded.status)}
    return xarray.Dataset(variables, coordinates, told)


def _events(recorded: History) -> tuple[str, ...]:
    return recorded.events or ("",) * len(recorded.time)


def write(path: Path, runs: Mapping[str, History], attributes: Mapping[str, Any], ending: str = "h5") -> None:
    """Writes the recorded runs; the one run of a scene without [runs] has the name "".

    `ending`: one of HISTORIES, which `path` need not have.  Raises OSError if the file cannot be written.
    """
    if ending == "csv":
        _write_table(path, runs)
    else:
        _write_hdf5(path, runs, attributes)


def _write_table(path: Path, runs: Mapping[str, History]) -> None:
    """One row for each time of each run; the columns of a run that another does not have are empty there."""
    units = {name: _unit(name, unit) for recorded in runs.values() for name, unit in recorded.units.items()}
    named = any(runs)
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        heads = [f"{name} [{unit}]" for name, unit in units.items()]
        table.writerow([*(["run"] if named else []), "t [s]", *heads, _MARK, _EVENT])
        for run, recorded in runs.items():
            columns = [recorded.columns.get(name) for name in units]
            events = _events(recorded)
            for i, time in enumerate(recorded.time):
                values = ["" if column is None else repr(float(column[i])) for column in columns]
                mark = _MARKS[int(recorded.mark[i])]
                table.writerow([*([run] if named else []), repr(float(time)), *values, mark, events[i]])


def _write_hdf5(path: Path, runs: Mapping[str, History], attributes: Mapping[str, Any]) -> None:
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


def _letters(texts: Sequence[str]) -> npt.NDArray[np.bytes_]:
    """Texts as bytes [texts, letters]: texts of any length are what a damaged file hangs on."""
    coded = [text.encode() for text in texts]
    longest = max(map(len, coded), default=0) or 1
    return np.array([list(text.ljust(longest, b"\0")) for text in coded], np.uint8).view("S1")


def _write_run(group: Any, recorded: History) -> None:
    letters = _letters(_events(recorded))
    group.dimensions["letter"] = letters.shape[1]
    group.dimensions["t"] = len(recorded.time)
    group.create_variable(_TIME, ("t",), "f8", data=recorded.time).attrs["units"] = "s"
    mark = group.create_variable(_MARK, ("t",), "i1", data=recorded.mark.astype(np.int8))
    group.create_variable(_EVENT, ("t", "letter"), "S1", data=letters).attrs["_Encoding"] = "utf-8"
    group.attrs["coordinates"] = f"{_MARK} {_EVENT}"
    mark.attrs.update(flag_values=np.array(list(_MARKS), np.int8), flag_meanings=" ".join(_MARKS.values()))
    for address, values in recorded.columns.items():
        variable = group.create_variable(address, ("t",), "f8", data=values, fillvalue=np.nan)
        variable.attrs.update(cf_units(_unit(address, recorded.units[address])))
    group.attrs.update(status=np.int32(recorded.status), status_word=status_name(recorded.status))


def _unit(address: str, unit: str) -> str:
    """The unit as people say it: J and rad are N*m and 1 for a calculation only."""
    if is_energy(address):
        return "J"
    return "rad" if address.split(".")[-1] in ("angle", "turned") else unit or "1"


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
    named = {name: item for name, item in group.items() if name not in (_TIME, _MARK, _EVENT, "letter")}
    columns = {name: item[...].astype(np.float64) for name, item in named.items()}
    units = {name: unit_of(item.attrs) for name, item in named.items()}
    status = int(np.ravel(group.attrs["status"])[0])
    mark = group[_MARK][...].astype(np.int32)
    events = tuple(b"".join(letters).decode("utf-8", "replace") for letters in group[_EVENT][...])
    return History(group[_TIME][...], columns, units, mark, status, events)
