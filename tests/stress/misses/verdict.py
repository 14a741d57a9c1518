"""What became of a case beside its truth: one word for the tables, and how well its errors were told."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from planemotion import _layout as layout
from planemotion.engine.outcome import CaseResults
from tests.stress.contacts.laws import Array

RIGHT, BEYOND, MISSED = "right", "beyond its estimate", "missed"
TOLD = "told"  # by its status: undecided, a limit
NOT_JUDGED = "on an edge"
BEYOND_BY = 10.0  # times the estimated error
ROUNDING = 1e-11  # of the size of the answer
MISS = 1e-3  # of that size: no error of a method that has seen everything
LEAST_TRUE_ERROR = 1e-14  # of that size: closer than that the truths themselves are not known


@dataclass(frozen=True)
class Errors:
    """True and estimated ones of the answers of runs that ended as `ok`, [n] each; those of counts are 0."""

    true: Array
    told: Array

    @classmethod
    def joined(cls, parts: Iterable[Errors]) -> Errors:
        every = [*parts] or [cls(np.zeros(0), np.zeros(0))]
        return cls(*(np.concatenate([getattr(one, name) for one in every]) for name in ("true", "told")))

    def covered(self) -> float:
        """The share whose estimate is no less than the true error."""
        return float(np.mean(self.true <= self.told)) if len(self.true) else np.nan

    def median(self) -> float:
        """Of the estimate over the true error, counts left out."""
        some = self.told > 0
        return float(np.median(self.told[some] / self.true[some])) if some.any() else np.nan


def told_columns(counts: Mapping[str, int], words: Iterable[str], errors: Errors) -> tuple[str, ...]:
    """What the tables show: how often each word was said, and how well errors were told."""
    shown = (str(counts.get(word, 0)) for word in words)
    return (*shown, str(len(errors.true)), f"{100 * errors.covered():.2f}", f"{errors.median():.3g}")


@dataclass(frozen=True)
class Verdict:
    """A word for each case, and the errors of all of them."""

    words: list[str]
    errors: Errors


def judge(
    found: CaseResults,
    truth: Array,
    size: Array,
    rounding: Array | float = ROUNDING,
    edge: Array | None = None,
) -> Verdict:
    """truth, size [ncase, nout]: the answers, and their size; rounding: what of it doubles do not tell; edge
    [ncase]: where the truth is open, as it lies on an edge."""
    off = np.abs(found.out - truth)
    missed = (off > np.maximum(MISS * size, BEYOND_BY * found.error)).any(axis=1)
    beyond = (off > BEYOND_BY * found.error + rounding * size).any(axis=1)
    word = np.where(missed, MISSED, np.where(beyond, BEYOND, RIGHT))
    if edge is not None:
        word = np.where(edge & (word != RIGHT), NOT_JUDGED, word)
    word = np.where(found.status == layout.PM_OK, word, TOLD)
    judged = np.isin(word, (RIGHT, BEYOND, MISSED))
    true = np.maximum(off, np.where(found.error > 0, LEAST_TRUE_ERROR * size, 0))
    return Verdict([str(one) for one in word], Errors(true[judged].ravel(), found.error[judged].ravel()))
