"""A blow of several contacts, followed in its impulses step by step, with all shares found by enumeration.

The laws are those of docs/impact_laws.md, "Poisson or Stronge at one of them": all contacts go at one pace,
each sticks or slides against the slip of the moment, nothing penetrates at any moment.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace

import numpy as np

from tests.stress.contacts.laws import BACKWARD, CLOSE, DEPENDS, FORWARD, OPEN, STICK, Array, Problem, residue

NONE = 1e-2  # times what is close, of the velocities before: no slip, no approach
ROUNDING = 1e-11  # of the impulses, of the energy: nothing
MOST = 2000  # stretches: slips of two contacts may end in turn, ever smaller


@dataclass(frozen=True)
class Share:
    """What contacts do on a stretch, by its length: `rate` [3] of velocities, `load` [n] normal impulses.

    is_unique: no other loads in these modes give these velocities.
    """

    rate: Array
    load: Array
    is_unique: bool = True


@dataclass(frozen=True)
class End:
    """Where a blow ends: `after` [3]; None where none goes on, or several."""

    after: Array | None
    why: str = "ends"


NO_MOTION, SEVERAL, ENDLESS = "no motion", "not unique", "endless"


def _modes(x: Problem, i: int, slip: float) -> tuple[int, ...]:
    if slip != 0 or x.friction[i] == 0:
        return OPEN, FORWARD if slip >= 0 else BACKWARD
    return OPEN, STICK, FORWARD, BACKWARD


def _share(x: Problem, modes: tuple[int, ...], listed: list[int], pace: Array, close: float) -> Share | None:
    """The rates of these modes, if they are determined; of inequalities those of the loads are checked."""
    rows, values, loads, of = [], [], [], []
    for i, mode in zip(listed, modes, strict=True):
        if mode == OPEN:
            continue
        normal, tangent = x.jacobian[i]
        rows.append(normal)
        values.append(pace[i])
        if mode == STICK:
            rows.append(tangent)
            values.append(0.0)
            loads += [x.along(i, 1), x.along(i, -1)]  # the cone: both of them push
            of += [i, i]
        else:
            loads.append(x.along(i, 1 if mode == FORWARD else -1))
            of.append(i)
    load = np.zeros(len(x))
    if not loads:
        return Share(np.zeros(len(x.mass)), load)
    lever = np.array(loads).T / x.mass[:, None]
    a, wanted = np.array(rows) @ lever, np.array(values)
    size, _, rank, _ = np.linalg.lstsq(a, wanted, rcond=DEPENDS * close)
    none = close * np.abs(wanted).max() + residue(a, size)
    if np.abs(a @ size - wanted).max() > none or size.min() < -close * np.abs(size).max():
        return None
    np.add.at(load, of, size)
    return Share(lever @ size, load, bool(rank == len(loads)))


def _obeys(
    x: Problem,
    share: Share,
    modes: tuple[int, ...],
    listed: list[int],
    slip: Array,
    pace: Array,
    close: float,
) -> bool:
    rates = x.jacobian @ share.rate
    none = close * max(float(np.abs(rates).max()), float(pace.max()))
    for i, mode in zip(listed, modes, strict=True):
        if rates[i, 0] < pace[i] - none:
            return False
        begins = slip[i] == 0 and x.friction[i] > 0 and mode in (FORWARD, BACKWARD)
        if begins and (1 if mode == FORWARD else -1) * rates[i, 1] < -none:
            return False
    return True


def shares(x: Problem, listed: list[int], slip: Array, pace: Array, close: float = CLOSE) -> list[Share]:
    """All motions that the laws allow on this stretch; of several loads that give one, the mean."""
    found: list[list[Share]] = []
    for modes in itertools.product(*(_modes(x, i, float(slip[i])) for i in listed)):
        share = _share(x, modes, listed, pace, close)
        if share is None or not _obeys(x, share, modes, listed, slip, pace, close):
            continue
        same = next((motion for motion in found if _same(share.rate, motion[0].rate, close)), None)
        if same is None:
            found.append([share])
        else:
            same.append(share)
    return [_mean(motion) for motion in found]


def _mean(motion: list[Share]) -> Share:
    loads = [share.load for share in motion if share.is_unique]
    return replace(motion[0], load=np.mean(loads, axis=0)) if loads else motion[0]


def _same(a: Array, b: Array, close: float) -> bool:
    return bool(np.abs(a - b).max() <= 1e2 * close * max(np.abs(a).max(), np.abs(b).max()))


def _until_none(value: float, rate: float) -> float:
    return -value / rate if value * rate < 0 else np.inf


def _until_spent(law: str, u: float, rate: float, load: float, left: float) -> float:
    """`left`: of the impulse (poisson), of the work (stronge), that restitution may still give."""
    if load <= 0:
        return np.inf
    if law == "poisson":
        return max(0.0, left / load)
    root = u * u + 2 * rate * max(left, 0) / load
    return 0.0 if left <= 0 else 2 * left / load / (u + np.sqrt(root))


def follow(x: Problem, law: str, close: float = CLOSE) -> End:
    """The end of a blow in which all contacts approach, none of them stiffer than the others."""
    v = x.before.copy()
    none = NONE * close * x.scale
    before = x.jacobian[:, 0] @ v
    impulse, work = np.zeros(len(x)), np.zeros(len(x))
    left = np.zeros(len(x))
    rebounds = np.zeros(len(x), dtype=bool)
    compresses = True
    exact = {"slip": x.jacobian[:, 1] @ v, "normal": before.copy()}
    for _ in range(MOST):
        normal, slip = exact["normal"], exact["slip"]
        if compresses and (normal >= 0).all():
            compresses = False
            left = x.restitution * impulse if law == "poisson" else -(x.restitution**2) * work
            left[impulse <= ROUNDING * impulse.max()] = 0
            if law == "stronge":
                left[-work <= ROUNDING * x.energy(x.before)] = 0
            rebounds = left > 0
        if not compresses and not rebounds.any():
            return End(v)
        pace = np.maximum(-normal, 0) if compresses else np.where(rebounds, -x.restitution * before, 0)
        listed = [i for i in range(len(x)) if normal[i] <= 0 or pace[i] > 0]
        found = shares(x, listed, slip, pace, close)
        if len(found) != 1:
            return End(None, SEVERAL if found else NO_MOTION)
        rate, load = found[0].rate, found[0].load
        u = x.jacobian @ rate
        ends = [_until_none(float(slip[i]), u[i, 1]) for i in range(len(x))]
        met = [_until_none(float(normal[i]), u[i, 0]) if normal[i] > 0 else np.inf for i in range(len(x))]
        spent = [
            _until_spent(law, float(normal[i]), u[i, 0], load[i], left[i]) if rebounds[i] else np.inf
            for i in range(len(x))
        ]
        s = min([*ends, *met, *spent, 1.0 if compresses else np.inf])
        if not np.isfinite(s):
            return End(None, NO_MOTION)
        done = load * s * (normal + 0.5 * u[:, 0] * s)
        impulse, work = impulse + load * s, work + done
        left = left - (load * s if law == "poisson" else done)
        rebounds = rebounds & (np.array(spent) > s)
        v = v + rate * s
        normal, slip = normal + u[:, 0] * s, slip + u[:, 1] * s
        exact["normal"] = np.where((np.array(met) <= s) | (np.abs(normal) <= none), 0, normal)
        exact["slip"] = np.where((np.array(ends) <= s) | (np.abs(slip) <= none), 0, slip)
    return End(None, ENDLESS)
