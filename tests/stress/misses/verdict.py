"""What became of a case beside its truth: one word for the tables."""

from __future__ import annotations

import numpy as np

from planemotion import _layout as layout
from planemotion.engine.outcome import CaseResults
from tests.stress.contacts.laws import Array

RIGHT, BEYOND, MISSED = "right", "beyond its estimate", "missed"
TOLD = "told"  # by its status: undecided, a limit
BEYOND_BY = 10.0  # times the estimated error
ROUNDING = 1e-11  # of the size of the answer
MISS = 1e-3  # of that size: no error of a method that has seen everything


def words(found: CaseResults, truth: Array, size: Array, rounding: Array | float = ROUNDING) -> list[str]:
    """A word for each case.

    truth, size [ncase, nout]: the answers, and their size; rounding: what of it doubles do not tell.
    """
    off = np.abs(found.out - truth)
    missed = (off > np.maximum(MISS * size, BEYOND_BY * found.error)).any(axis=1)
    beyond = (off > BEYOND_BY * found.error + rounding * size).any(axis=1)
    word = np.where(missed, MISSED, np.where(beyond, BEYOND, RIGHT))
    return [str(w) for w in np.where(found.status == layout.PM_OK, word, TOLD)]
