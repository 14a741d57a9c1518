"""The result of a sweep as what a picture shows: its axes, and the numbers of each ask over them.

Along one parameter each ask becomes a panel of curves; along two a map, or a family of curves where one of
them has few values; further parameters are held at their first value.  Of cases that a design has drawn there
are the values of each of its parameters.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..base.arrays import Floats
from ..base.errors import StudyError
from ..base.words import counted
from ..language.cf import unit_of
from ..pen.page import FAMILY
from .condensed import condensed, middles

if TYPE_CHECKING:
    import xarray as xr

# Values along one side of a map: more than a picture has dots are not drawn.
MAP_CELLS = 1200
WANTED = "; an .h5 is wanted that `sweep` or `run --history` wrote"


def open_sweep(path: Path) -> xr.Dataset:
    """The result of a sweep, lazily.  Raises StudyError if it is none."""
    import xarray as xr

    is_zarr = path.suffix == ".zarr" and path.is_dir()
    if not path.is_file() and not is_zarr:
        raise StudyError(f"{path}: there is no such file")
    try:
        dataset = xr.open_dataset(path, engine="zarr" if is_zarr else "h5netcdf")
    except Exception as error:  # there is nothing that HDF5 does not say of a damaged file
        why = WANTED if path.suffix in (".toml", ".csv") else f": {error}"
        raise StudyError(f"{path}: is no result of a sweep or a run{why}") from error
    if "parameters" not in dataset.attrs or "status" not in dataset:
        dataset.close()
        raise StudyError(f"{path}: is no result of a sweep or a run{WANTED}")
    return dataset


@dataclass(frozen=True)
class SweptAxis:
    """A swept parameter as an axis of the picture; `drawn`: by a design, so that its cases are dots;
    `words`: of an option, whose values are 0, 1, .."""

    name: str
    label: str
    values: Floats
    log: bool
    drawn: bool = False
    words: tuple[str, ...] = ()


@dataclass(frozen=True)
class Panel:
    """One ask: values over the axes drawn (one axis of curves, or two of a map); `names` of its curves; what
    is asked in `words`."""

    label: str
    values: Floats
    names: tuple[str, ...]
    note: str
    words: str = ""


@dataclass(frozen=True)
class Panels:
    """A sweep as a picture: its title, and in words what is in it; one axis of curves or two of maps, and the
    parameter that has a curve for each value; a panel for each ask; over the axes how the cases ended, as
    numbers of `endings`, of which 0 is well.  `drawn`: parameters that a design has drawn (on one axis)."""

    title: str
    words: str
    axes: Sequence[SweptAxis]
    family: SweptAxis | None
    panels: Sequence[Panel]
    ended: npt.NDArray[np.intp]
    endings: Sequence[str]
    drawn: Sequence[SweptAxis] = ()

    @property
    def bad(self) -> npt.NDArray[np.bool_]:
        """Which cases did not end well, over the axes."""
        bad: npt.NDArray[np.bool_] = self.ended != 0
        return bad


def read_panels(dataset: xr.Dataset, cells: int = MAP_CELLS) -> Panels:
    """What a picture shows of a sweep as `xarray.open_dataset` gives it.

    `cells`: values along each side of a map; a finer grid is condensed (condensed.py) to so many at most."""
    held = _held(dataset)
    shown = dataset.isel(dict.fromkeys(held, 0))
    axes = [_axis(dataset, dim) for dim in drawn_dims(dataset)]
    family = None
    if len(axes) == 2 and min(len(axis.values) for axis in axes) <= FAMILY:
        few = min((0, 1), key=lambda i: (len(axes[i].values), -i))
        family = axes.pop(few)
    ended, endings = _endings(shown, axes)
    panels = [_panel(shown, str(key), axes, family) for key in dataset["ask"].values]
    title = str(dataset.attrs.get("title") or dataset.attrs.get("id") or "Sweep")
    drawn = _drawn(dataset, axes[0]) if axes[0].drawn else ()
    read = Panels(title, _counts(dataset, held), axes, family, panels, ended, endings, drawn)
    steps = [-(-len(axis.values) // cells) for axis in axes]
    return _coarser(read, steps) if len(axes) == 2 and max(steps) > 1 else read


def _coarser(read: Panels, steps: Sequence[int]) -> Panels:
    """A map of fewer dots, each of steps[0] x steps[1] cases."""
    return replace(
        read,
        words=f"{read.words}; each dot of a map: the median of {steps[0]} x {steps[1]} cases",
        axes=[
            replace(axis, values=middles(axis.values, step))
            for axis, step in zip(read.axes, steps, strict=True)
        ],
        panels=[replace(panel, values=condensed(panel.values, steps)) for panel in read.panels],
        ended=_worst(read.ended, steps),
    )


def _worst(ended: npt.NDArray[np.intp], steps: Sequence[int]) -> npt.NDArray[np.intp]:
    """The greatest number of each block of steps[0] x steps[1]."""
    for along, step in enumerate(steps):
        ended = np.maximum.reduceat(ended, np.arange(0, ended.shape[along], step), axis=along)
    return ended


def _endings(shown: xr.Dataset, axes: Sequence[SweptAxis]) -> tuple[npt.NDArray[np.intp], list[str]]:
    """How the cases ended over the axes (of several at one place the rarest), and what the numbers mean."""
    status = shown["status"].transpose(*[axis.name for axis in axes], ...)
    codes, counts = np.unique(status.values, return_counts=True)
    order = [0, *(code for code in codes[np.argsort(-counts, kind="stable")].tolist() if code != 0)]
    numbers = np.zeros(status.shape, np.intp)
    for number, code in enumerate(order):
        numbers[status.values == code] = number
    places = numbers.reshape(*(len(axis.values) for axis in axes), -1).max(axis=-1)
    words = status_words(shown)
    return places, [words.get(code, str(code)) for code in order]


def status_words(dataset: xr.Dataset) -> dict[int, str]:
    """What the codes of a status mean."""
    attributes = dataset["status"].attrs
    words = [word.replace("_", " ") for word in str(attributes.get("flag_meanings", "")).split()]
    return dict(zip(np.atleast_1d(attributes.get("flag_values", [])).tolist(), words, strict=False))


def drawn_dims(dataset: xr.Dataset) -> list[str]:
    """The one or two dimensions that the picture shows, in the order of the study.

    A dimension that is no parameter is that of cases which a design has drawn.
    """
    dims = [str(dim) for dim in dataset["status"].dims]
    several = [dim for dim in dims if dataset.sizes[dim] > 1]
    longest = sorted(several or dims[:1], key=lambda dim: -dataset.sizes[dim])[:2]
    drawn = [dim for dim in longest if dim not in str(dataset.attrs["parameters"]).split()]
    if drawn and min(dataset.sizes[dim] for dim in longest) > FAMILY:
        return drawn  # what a design has drawn makes no map
    return [dim for dim in dims if dim in longest]


def _held(dataset: xr.Dataset) -> list[str]:
    drawn = drawn_dims(dataset)
    return [str(dim) for dim in dataset["status"].dims if dim not in drawn]


def _along(dataset: xr.Dataset, dim: str) -> list[str]:
    """The parameters that go with a dimension."""
    return [str(name) for name in str(dataset.attrs["parameters"]).split() if dataset[name].dims == (dim,)]


def _drawn(dataset: xr.Dataset, axis: SweptAxis) -> list[SweptAxis]:
    """The parameters that a design has drawn."""
    return [
        SweptAxis(
            name, _with_unit(name, dataset[name]), np.asarray(dataset[name].values, np.float64), False, True
        )
        for name in _along(dataset, axis.name)
    ]


def _axis(dataset: xr.Dataset, dim: str) -> SweptAxis:
    along = _along(dataset, dim)
    shown = dim if dim in along else along[0]  # the first of those that a design draws
    words = words_of(dataset[shown])
    values = np.arange(float(len(words))) if words else np.asarray(dataset[shown].values, np.float64)
    others = [name for name in along if name != shown]
    label = _with_unit(shown, dataset[shown]) + (f", moving {', '.join(others)} too" if others else "")
    is_log = not words and _is_logarithmic(values)
    return SweptAxis(dim, label, values, is_log, drawn=shown != dim, words=words)


def words_of(coordinate: xr.DataArray) -> tuple[str, ...]:
    """The words of a swept option; none of a number."""
    return tuple(map(str, coordinate.values)) if coordinate.dtype.kind in "OUST" else ()


def text_of(coordinate: xr.DataArray, i: int) -> str:
    """One value of what is swept: "0.05 m", "newton"."""
    words, unit = words_of(coordinate), unit_of(coordinate.attrs)
    if words:
        return words[i]
    return f"{float(coordinate.values[i]):g}" + (f" {unit}" if unit != "1" else "")


def _is_logarithmic(values: Floats) -> bool:
    """Whether the steps of values [n] are those of a logarithmic grid."""
    if len(values) < 4 or values.min() <= 0:
        return False
    steps = np.diff(np.log(values))
    return bool(np.ptp(steps) < 1e-6 * abs(steps).max() and np.ptp(values) > 0)


def _with_unit(name: str, variable: xr.DataArray) -> str:
    unit = unit_of(variable.attrs)
    return name if unit in ("", "1") else f"{name} [{unit}]"


def _panel(dataset: xr.Dataset, key: str, axes: Sequence[SweptAxis], family: SweptAxis | None) -> Panel:
    """The numbers of an ask, ordered as the picture wants them."""
    variable = dataset[key]
    drawn = [axis.name for axis in axes]
    curves = [family.name] if family else []
    lists = [str(dim) for dim in variable.dims if dim not in (*drawn, *curves)]
    values = np.asarray(variable.transpose(*drawn, *curves, *lists).values, np.float64)
    missing = int(np.count_nonzero(np.isnan(values)))
    note = f"no value in {missing} of {values.size}" if missing else ""
    names: tuple[str, ...] = ()
    if len(axes) == 2 and lists:
        values = values[..., 0]  # a map has room for one number
        note = ", ".join(filter(None, [f"the first of {variable.sizes[lists[0]]}", note]))
    elif len(axes) == 1:
        values = values.reshape(len(axes[0].values), -1)
        names = _curve_names(variable, family, lists)
    words = str(variable.attrs.get("long_name", ""))
    return Panel(_with_unit(key, variable), values, names, note, "" if words == key else words)


def _curve_names(variable: xr.DataArray, family: SweptAxis | None, lists: Sequence[str]) -> tuple[str, ...]:
    """What the curves of a panel are called; none where there is one."""
    names = [""]
    for dim in [*([family.name] if family else []), *lists]:
        coordinate = variable[dim]
        name = dim.removesuffix("_at") if dim in lists else dim
        if dim.endswith("_number"):
            texts = [f"{value:g}" for value in coordinate.values]
        else:
            texts = [f"{name} = {text_of(coordinate, i)}" for i in range(coordinate.size)]
        names = [", ".join(filter(None, [begun, text])) for begun in names for text in texts]
    return tuple(names) if len(names) > 1 else ()


def _counts(dataset: xr.Dataset, held: Sequence[str]) -> str:
    """How many cases there are, how many did not end well and how, and which parameters are held."""
    status = dataset["status"]
    texts = [counted(status.size, "case")]
    values, counts = np.unique(status.values, return_counts=True)
    word_of = status_words(dataset)
    bad = [
        f"{count} {word_of.get(value, str(value))}"
        for value, count in zip(values.tolist(), counts.tolist(), strict=True)
        if value != 0
    ]
    if bad:
        texts.append(f"not ok (red): {', '.join(bad)}")
    for dim in held:
        coordinate = dataset[dim]
        size = f" (the first of {coordinate.size})" if coordinate.size > 1 else ""
        texts.append(f"at {dim} = {text_of(coordinate, 0)}{size}")
    return "; ".join(texts)
