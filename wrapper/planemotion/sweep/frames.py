"""The result of a sweep as tables of pandas: a row for each case, and statistics of the answers."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base.arrays import Floats
from ..engine.words import words
from ..language.cf import unit_of
from .layout import REASON_WORDS, STATUS_WORDS

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

# Quantiles that statistics tell.
QUANTILES = (0.05, 0.5, 0.95)


def cases(dataset: xr.Dataset) -> pd.DataFrame:
    """One row for each case of a sweep, in their order.

        planemotion.cases(scene.sweep())

    Columns: the swept parameters; the answers, lists as "KEY[1]", "KEY[2]" ..., words of events as text;
    their errors "KEY_error"; status as a word, the message, and "KEY_reason" where an answer is missing.
    """
    import pandas as pd

    dims = dataset["status"].dims
    names = str(dataset.attrs["parameters"]).split()
    flat = dataset.stack(_row=dims) if len(dims) > 1 else dataset.rename({dims[0]: "_row"})
    columns: dict[str, Any] = {}
    for name in names:
        along = dataset[name].broadcast_like(dataset["status"]).transpose(*dims)
        columns[name] = along.values.ravel()
    asks = [str(key) for key in dataset["ask"].values]
    for name in [*asks, *(f"{key}_error" for key in asks), "margin", "error_over_accuracy"]:
        if name in flat:
            columns.update(_columns(name, flat[name]))
    columns["status"] = [STATUS_WORDS.get(code, f"status {code}") for code in flat["status"].values.tolist()]
    columns["message"] = flat["message"].values
    reasons = flat["reason"].transpose("_row", "ask").values
    for key, codes in zip(asks, reasons.T.tolist(), strict=True):
        if any(codes):
            columns[f"{key}_reason"] = [REASON_WORDS.get(code, "") if code else "" for code in codes]
    return pd.DataFrame(columns)


def _columns(name: str, variable: xr.DataArray) -> Iterator[tuple[str, Any]]:
    """The columns of a variable: one, or one for each number of a list."""
    if "letters" in variable.attrs:
        variable = words(variable)
    further = [dim for dim in variable.dims if dim != "_row"]
    values: Any = variable.transpose("_row", *further).values
    if not further:
        yield name, values
    for place in product(*(range(size) for size in values.shape[1:])) if further else ():
        yield f"{name}[{', '.join(str(1 + k) for k in place)}]", values[(slice(None), *place)]


def statistics(dataset: xr.Dataset) -> pd.DataFrame:
    """Of each answer that is one number: over the cases that a design has drawn, in its unit.

        planemotion.statistics(scene.sweep())

    Columns: unit, cases with an answer, mean, deviation, the quantiles q05, q50 and q95; "mean_error" and so
    on are standard errors of independent cases.  Those of a Latin hypercube, a Sobol or a Halton sequence
    are smaller, as a rule.  Cases that are listed count as drawn.  Raises ValueError for those of a grid.
    """
    import pandas as pd

    if dataset["status"].dims != ("case",):
        raise ValueError("statistics are of cases that a design has drawn, without a grid beside")
    rows = {}
    for key in (str(key) for key in dataset["ask"].values):
        variable = dataset[key]
        if variable.dims == ("case",) and "letters" not in variable.attrs:
            known = variable.values[np.isfinite(variable.values)]
            rows[key] = {"unit": unit_of(variable.attrs), "cases": len(known), **_statistics(known)}
    return pd.DataFrame.from_dict(rows, orient="index")


def _statistics(values: Floats) -> dict[str, float]:
    n = len(values)
    if n < 2:
        return {}
    deviation = float(values.std(ddof=1))
    found = {"mean": float(values.mean()), "mean_error": deviation / np.sqrt(n), "deviation": deviation}
    ordered = np.sort(values)
    for part in QUANTILES:
        name = f"q{round(100 * part):02d}"
        found[name] = float(np.quantile(ordered, part))
        found[f"{name}_error"] = _quantile_error(ordered, part)
    return found


def _quantile_error(ordered: Floats, part: float) -> float:
    """Half the distance between the values as many places below and above as the binomial law is wide.

    Not-a-number where these places are not among the values."""
    n = len(ordered)
    wide = np.sqrt(n * part * (1 - part))
    low, high = n * part - wide - 0.5, n * part + wide - 0.5
    if low < 0 or high > n - 1:
        return float("nan")
    ends = np.interp([low, high], np.arange(n), ordered)
    return float(ends[1] - ends[0]) / 2
