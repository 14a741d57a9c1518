"""How the cases of a sweep ended: counts, and those that did not end well."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..engine.kernel import status_name, status_text
from ..language.cf import unit_of
from ..pictures.panels import words_of

if TYPE_CHECKING:
    import xarray as xr

# Cases that are listed one by one.
LISTED = 50


def outcomes(dataset: xr.Dataset) -> list[dict[str, Any]]:
    """The statuses that occur: the word, what it means, how many cases have it, ok first."""
    values, counts = np.unique(dataset["status"].values, return_counts=True)
    return [
        {"word": status_name(value), "means": status_text(value), "count": count, "ok": value == 0}
        for value, count in sorted(
            zip(values.tolist(), counts.tolist(), strict=True), key=lambda one: (one[0] != 0, -one[1])
        )
    ]


def cases_not_ok(dataset: xr.Dataset) -> list[dict[str, Any]]:
    """The first of the cases that did not end well: their parameters, status and message."""
    status, message = dataset["status"], dataset["message"]
    places = np.argwhere(status.values != 0)[:LISTED]
    return [
        {
            "parameters": ", ".join(case_texts(dataset, dict(zip(status.dims, place.tolist(), strict=True)))),
            "word": status_name(int(status.values[tuple(place)])),
            "message": str(message.values[tuple(place)]),
        }
        for place in places
    ]


def case_texts(dataset: xr.Dataset, place: dict[Any, int]) -> list[str]:
    """The swept parameters of a case, such as "d = 0.05 m"."""
    return [f"{name} = {text}" for name, text in case_values(dataset, place).items()]


def case_values(dataset: xr.Dataset, place: dict[Any, int]) -> dict[str, str]:
    """The same by name, each as a scene takes it."""
    values = {}
    for name in str(dataset.attrs["parameters"]).split():
        variable = dataset[name]
        words = words_of(variable)
        if words:
            values[name] = words[place[variable.dims[0]]]
            continue
        value = float(variable.values[place[variable.dims[0]]])
        unit = unit_of(variable.attrs)
        values[name] = f"{value!r}" if unit == "1" else f"{value!r} {unit}"
    return values
