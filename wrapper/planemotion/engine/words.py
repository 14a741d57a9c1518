"""Words of events: which happened, in which order.  In results a word is a whole number; here it is read.

The kernel tells of each firing of an event how many events of the word have fired so far.  What fired at the
same instant has the order of the ask.  The digits of the number, to the base letters + 1, are the places of
the events in the ask, from 1: with the events "tip" and "fall" 0 is the empty word, 1 "tip", 5 "tip fall".
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .. import _layout as layout
from ..base.arrays import Floats, Ints
from ..compile.asks import Asked
from .outcome import CaseResults


def read_words(asked: Asked, results: CaseResults) -> tuple[Floats, Ints]:
    """The words [ncase] of an ask as numbers, NaN where a run failed, and enum pm_reason [ncase].

    Of a word that is too long for a number the first letters are there (PM_REASON_CUT).
    """
    n = asked.longest
    place = results.out[:, asked.first : asked.first + asked.columns - 1]
    fired = results.out[:, asked.first + asked.columns - 1]  # in all; not known where a run ends early
    order = np.argsort(place, axis=1, kind="stable")[:, :n]  # at one place in the order of the events
    known = np.isfinite(np.take_along_axis(place, order, axis=1))
    word = np.zeros(len(place))
    for letter, is_there in zip((order // n + 1).T, known.T, strict=True):
        word = np.where(is_there, word * (len(asked.letters) + 1) + letter, word)
    endless = results.reason[:, asked.row + asked.rows - 1] == layout.PM_REASON_INFINITE
    cut = (np.isfinite(place).sum(axis=1) > n) | (fired > n) | endless
    failed = results.status < layout.PM_OK
    reason = np.where(cut, layout.PM_REASON_CUT, layout.PM_REASON_NONE)
    return np.where(failed, np.nan, word), np.where(failed, layout.PM_REASON_FAILED, reason).astype(np.int32)


def words(variable: Any) -> Any:
    """The texts of an answer which events happened, as a variable (`xarray.DataArray`) of a result has it.

        planemotion.words(scene.sweep()["outcome"])

    Not-a-number, of a case that failed, becomes "failed".  Raises ValueError for another variable.
    """
    letters = tuple(str(variable.attrs.get("letters", "")).split())
    if not letters:
        raise ValueError(f"{variable.name}: is no answer which events happened")
    numbers, at = np.unique(np.asarray(variable.values, np.float64), return_inverse=True)
    texts = np.array([spelled(one, letters) for one in numbers.tolist()], dtype=object)
    return variable.copy(data=texts[at].reshape(variable.shape))


def spelled(word: float, letters: tuple[str, ...]) -> str:
    """A word as text: its events, a number behind those that come several times on end ("over*3 strike")."""
    if math.isnan(word):
        return "failed"
    names: list[str] = []
    rest = int(word)
    while rest:
        rest, letter = divmod(rest, len(letters) + 1)
        names.append(letters[letter - 1])
    parts: list[tuple[str, int]] = []
    for name in reversed(names):
        if parts and parts[-1][0] == name:
            parts[-1] = name, parts[-1][1] + 1
        else:
            parts.append((name, 1))
    return " ".join(name if count == 1 else f"{name}*{count}" for name, count in parts)
