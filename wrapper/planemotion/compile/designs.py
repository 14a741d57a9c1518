"""Cases that a design draws: points of a unit cube (`scipy.stats.qmc`), turned into distributions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ..base.arrays import Floats
from ..base.errors import SceneError
from ..model.readers import DISTRIBUTIONS, Value
from ..model.tables import DESIGNS, Design, Swept
from .grids import quantities_in_one_unit

# A quantile function: parts of the probability [n] -> values [n].
Quantiles = Callable[[Floats], Floats]


def draw(
    design: Design, swept: Mapping[str, Swept], units: Mapping[str, str]
) -> dict[str, tuple[str, Floats]]:
    """Unit and values [n] of each parameter that has a distribution.

    `units`: those of bare numbers.  The same design draws the same values again.  Raises SceneError with a
    key path.
    """
    points = _correlated(_points(design, len(swept)), design, list(swept))
    drawn = {}
    for column, (name, one) in zip(points.T, swept.items(), strict=True):
        unit, quantiles = _distribution(one, f"sweep.{name}", units[name])
        drawn[name] = unit, quantiles(column)
    return drawn


def _points(design: Design, dimensions: int) -> Floats:
    """Points [n, dimensions] inside of the unit cube."""
    from scipy.stats import qmc

    word = next(word for word in DESIGNS if getattr(design, word) is not None)
    n, path = getattr(design, word), f"sweep.design.{word}"
    if word == "sobol" and n & (n - 1):
        raise SceneError(
            "a Sobol sequence is even at powers of 2 alone, such as 64 or 1024", path=path, value=n
        )
    if word == "random":
        points = np.random.default_rng(design.seed).random((n, dimensions))
    else:
        engine = {"latin": qmc.LatinHypercube, "sobol": qmc.Sobol, "halton": qmc.Halton}[word]
        points = engine(dimensions, rng=np.random.default_rng(design.seed)).random(n)
    return _inside(points)


def _correlated(points: Floats, design: Design, names: list[str]) -> Floats:
    """The points [n, dimensions] by a Gaussian copula: each column is spread as before.

    Raises SceneError for correlations that cannot be.
    """
    from scipy.special import ndtr, ndtri

    if not design.correlation:
        return points
    matrix = np.eye(len(names))
    for index, (first, second, size) in enumerate(design.correlation):
        path = f"sweep.design.correlation[{index}]"
        for name in (first, second):
            if name not in names:
                raise SceneError(f'"{name}" has no distribution', path=path, value=name)
        i, j = names.index(first), names.index(second)
        if i == j or matrix[i, j]:
            raise SceneError(f"{first} and {second}: one pair of two parameters is wanted", path=path)
        if not -1 < size < 1:
            raise SceneError("a correlation is between -1 and 1", path=path, value=size)
        matrix[i, j] = matrix[j, i] = size
    least = float(np.linalg.eigvalsh(matrix)[0])
    if not least > 0:
        reason = (
            "no parameters can be correlated like that: their matrix has the eigenvalue "
            f"{least:.3g}, and all must be greater than 0"
        )
        raise SceneError(reason, path="sweep.design.correlation")
    scores = ndtri(points) @ np.linalg.cholesky(matrix).T
    return _inside(np.asarray(ndtr(scores), np.float64))


def _inside(points: Floats) -> Floats:
    """A distribution without ends has no value at 0 or 1."""
    smallest = np.finfo(np.float64).eps
    return np.clip(points, smallest, 1 - smallest)


def _distribution(swept: Swept, path: str, unit: str) -> tuple[str, Quantiles]:
    """The unit of a distribution, and its quantiles, cut off at `within`."""
    from scipy import stats

    word = next(word for word in DISTRIBUTIONS if getattr(swept, word) is not None)
    written = tuple(getattr(swept, word))
    _check_count(written, word, path)
    # the spread of a lognormal distribution is that of a logarithm, a bare number
    of_unit, bare = (written[:1], written[1:]) if word == "lognormal" else (written, ())
    limits = swept.within or ()
    unit, values = quantities_in_one_unit([*of_unit, *limits], f"{path}.{word}", unit)
    ends = values[len(of_unit) :]
    a = [*values[: len(of_unit)], *(_bare(one, f"{path}.{word}") for one in bare)]
    match word:
        case "uniform":
            _check_order(a, f"{path}.{word}", written)
            frozen = stats.uniform(a[0], a[1] - a[0])
        case "triangular":
            _check_order([a[0], a[2]], f"{path}.{word}", written)
            if not a[0] <= a[1] <= a[2]:
                raise SceneError("the most frequent value is between the ends", path=f"{path}.{word}")
            frozen = stats.triang((a[1] - a[0]) / (a[2] - a[0]), a[0], a[2] - a[0])
        case "normal":
            _check_spread(a[1], f"{path}.{word}", written)
            frozen = stats.norm(a[0], a[1])
        case _:
            _check_spread(a[1], f"{path}.{word}", written)
            if not a[0] > 0:
                raise SceneError(
                    "the median of a lognormal distribution is greater than 0", path=f"{path}.{word}"
                )
            frozen = stats.lognorm(a[1], scale=a[0])
    if not limits:
        return unit, frozen.ppf
    _check_order(ends, f"{path}.within", limits)
    low, high = frozen.cdf(ends)
    if not high > low:
        raise SceneError("the distribution has nothing between these", path=f"{path}.within")
    return unit, lambda part: np.clip(frozen.ppf(low + part * (high - low)), ends[0], ends[1])


def _check_count(written: Sequence[Value], word: str, path: str) -> None:
    meaning = DISTRIBUTIONS[word]
    if len(written) != len(meaning):
        wanted = f"{word} = [{', '.join(meaning)}] is wanted"
        raise SceneError(wanted, path=f"{path}.{word}", value=list(written))


def _check_order(ends: Sequence[float] | Floats, path: str, written: Sequence[Value]) -> None:
    if not ends[0] < ends[1]:
        raise SceneError("the first end must be less than the last", path=path, value=list(written))


def _check_spread(spread: float, path: str, written: Sequence[Value]) -> None:
    if not spread > 0:
        raise SceneError("the spread must be greater than 0", path=path, value=list(written))


def _bare(written: Value, path: str) -> float:
    try:
        return float(written)
    except ValueError:
        reason = "the spread of the logarithm is a number without a unit, such as 0.2"
        raise SceneError(reason, path=path, value=written) from None
