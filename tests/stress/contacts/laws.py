"""The laws of contact, restated on plain matrices: a check of motions, all motions, the blow at one contact.

A problem is M (v1 - v0) = J^T p with the rows n_i, t_i of J.  At each contact v1 parts faster than wanted
(and p_i = 0), or as fast, with p_i in the cone of friction against the slip of v1 (docs/impact_laws.md,
"Several contacts at once").
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import nnls

Array = npt.NDArray[np.float64]
CLOSE = 1e-7  # of the velocities: the same
SHARP = 1e-10  # likewise, where motions are nearer to each other, or to none, than that
DEPENDS = 1e-3  # likewise, of that, of singular values: contacts depend on each other
UNDRIVEN = 1e-11  # of the natural acceleration: drives nothing; PM_PULLS, by which the engine goes
RESIDUE = 1e-14  # of the terms of an equation: large loads that nearly cancel leave so much
OPEN, STICK, FORWARD, BACKWARD = range(4)


@dataclass(frozen=True)
class Problem:
    """`mass` [3]; `jacobian` [n, 2, 3]: normal and tangent; `friction`, `restitution` [n]; `before` [3].

    Of several bodies 3 for each of them.
    """

    mass: Array
    jacobian: Array
    friction: Array
    restitution: Array
    before: Array

    def __len__(self) -> int:
        return len(self.friction)

    @property
    def scale(self) -> float:
        """The greatest velocity at a contact before."""
        return float(np.abs(self.jacobian @ self.before).max())

    @property
    def wanted(self) -> Array:
        """[n] normal velocities after: what approaches parts with its restitution, what rests stays."""
        approach: Array = np.minimum(self.jacobian[:, 0] @ self.before, 0)
        return -self.restitution * approach

    def energy(self, v: Array) -> float:
        return float(0.5 * self.mass @ v**2)

    def along(self, i: int, slip: int) -> Array:
        """The load of contact i that slides so, by unit normal load."""
        load: Array = self.jacobian[i, 0] - slip * self.friction[i] * self.jacobian[i, 1]
        return load


def residue(a: Array, size: Array) -> float:
    """What rounding leaves of a size."""
    return float(RESIDUE * (np.abs(a) @ np.abs(size)).max())


def can_be_loaded(x: Problem, after: Array, generators: list[Array], close: float = CLOSE) -> bool:
    """Whether loads on these generators, none of them negative, make `after` of `before`."""
    change = x.mass * (after - x.before)
    size = float(np.abs(change).max()) + float(x.mass.max()) * x.scale
    if not generators:
        return bool(np.abs(change).max() <= close * size)
    _, rest = nnls(np.array(generators).T, change)
    return bool(rest <= close * size)


def obeys(x: Problem, after: Array, close: float = CLOSE) -> bool:
    """Whether a motion obeys the laws at all contacts at once, by some loads."""
    none = close * (x.scale + float(np.abs(x.jacobian @ after).max()))
    generators = []
    for i, parts in enumerate(x.jacobian[:, 0] @ after - x.wanted):
        if parts < -none:
            return False
        if parts > none:
            continue
        slip = float(x.jacobian[i, 1] @ after)
        for sign in (1, -1) if abs(slip) <= none else (np.sign(slip),):
            generators.append(x.along(i, sign))
    return can_be_loaded(x, after, generators, close)


def is_admissible(x: Problem, after: Array) -> bool:
    """What any law demands: nothing penetrates, no energy comes from nowhere, loads lie in the cones."""
    close = CLOSE * (x.scale + float(np.abs(x.jacobian @ after).max()))
    if (x.jacobian[:, 0] @ after < -close).any():
        return False
    if x.energy(after) > x.energy(x.before) * (1 + CLOSE):
        return False
    return can_be_loaded(x, after, [x.along(i, sign) for i in range(len(x)) for sign in (1, -1)])


def motions(x: Problem, close: float = CLOSE) -> list[Array]:
    """All that obey the laws, by enumeration of what each contact may do."""
    found: list[Array] = []
    for modes in itertools.product((OPEN, STICK, FORWARD, BACKWARD), repeat=len(x)):
        loads, rows, values = [], [], []
        for i, mode in enumerate(modes):
            if mode == OPEN:
                continue
            normal, tangent = x.jacobian[i]
            rows.append(normal)
            values.append(x.wanted[i])
            if mode == STICK:
                loads += [normal, tangent]
                rows.append(tangent)
                values.append(0)
            else:
                loads.append(x.along(i, 1 if mode == FORWARD else -1))
        after = x.before
        if loads:
            a, lever = np.array(rows), np.array(loads).T / x.mass[:, None]
            size, *_ = np.linalg.lstsq(a @ lever, np.array(values) - a @ x.before, rcond=DEPENDS * close)
            after = x.before + lever @ size
        is_other = all(np.abs(after - other).max() > 1e2 * close * x.scale for other in found)
        if is_other and obeys(x, after, close):
            found.append(after)
    return found


# ---- accelerations, where contacts hold or slide ----
@dataclass(frozen=True)
class Rates:
    """At some velocities: contacts that stay, their `drift` [n, 2] by turning, and which way they slip."""

    closed: list[int]
    drift: Array
    slides: list[int]


def _rates_at(x: Problem, v: Array, close: float) -> Rates:
    u = x.jacobian @ v
    none = 10 * close * (x.scale + float(np.abs(u).max()))
    # a place r of the body accelerates by -omega^2 r; n.r and t.r are the levers of t and n
    drift = v[2] ** 2 * np.stack([x.jacobian[:, 1, 2], -x.jacobian[:, 0, 2]], axis=1)
    closed = [i for i in range(len(x)) if abs(u[i, 0]) <= none]
    return Rates(closed, drift, [0 if abs(u[i, 1]) <= none else int(np.sign(u[i, 1])) for i in closed])


def accelerations(x: Problem, v: Array, close: float = CLOSE) -> list[Array]:
    """All that the laws allow at velocities `v` under no forces but those of the contacts, by enumeration."""
    if np.abs(x.jacobian @ v).max() <= 10 * close * x.scale and abs(v[2]) <= close * abs(x.before[2]):
        return [np.zeros(3)]  # it rests, and nothing drives it
    return allowed(x, _rates_at(x, v, close), close)


def goes_on(x: Problem, v: Array, close: float = CLOSE) -> bool:
    """Whether one motion goes on from a blow, by what the engine can see: a drift below that drives nothing.

    Exactly, a drift may leave no motion, or several, however small it is beside the speed of the blow.
    """
    natural = x.scale**2 / float(np.abs(x.jacobian[:, :, 2]).max())
    drift = float(np.abs(_rates_at(x, v, close).drift).max())
    return drift <= UNDRIVEN * natural or len(accelerations(x, v, close)) == 1


def allowed(x: Problem, at: Rates, close: float = CLOSE) -> list[Array]:
    """All accelerations that the laws allow at these rates."""
    found: list[Array] = []
    for modes in itertools.product(*(_modes_of(slides) for slides in at.slides)):
        a = _acceleration(x, at, modes, close)
        size = 1e-300 + float(np.abs(at.drift).max())
        if a is not None and all(np.abs(a - b).max() > 1e2 * close * size for b in found):
            found.append(a)
    return found


def _modes_of(slides: int) -> tuple[int, ...]:
    if slides:
        return OPEN, FORWARD if slides > 0 else BACKWARD
    return OPEN, STICK, FORWARD, BACKWARD


def _acceleration(x: Problem, at: Rates, modes: tuple[int, ...], close: float) -> Array | None:
    """That of these modes, if it obeys their inequalities."""
    loads, rows, values, of = [], [], [], []
    for i, mode in zip(at.closed, modes, strict=True):
        if mode == OPEN:
            continue
        rows.append(x.jacobian[i, 0])
        values.append(-at.drift[i, 0])
        of.append(i)
        if mode == STICK:
            loads += [x.along(i, 1), x.along(i, -1)] if x.friction[i] > 0 else [x.along(i, 1)]
            of += [i] if x.friction[i] > 0 else []
            rows.append(x.jacobian[i, 1])
            values.append(-at.drift[i, 1])
        else:
            loads.append(x.along(i, 1 if mode == FORWARD else -1))
    a = np.zeros(len(x.mass))
    if loads:
        lever = np.array(loads).T / x.mass[:, None]
        wanted = np.array(values)
        size, *_ = np.linalg.lstsq(np.array(rows) @ lever, wanted, rcond=DEPENDS * close)
        if (size < -close * np.abs(size).max()).any():
            return None
        a = lever @ size
        none = close * float(np.abs(at.drift).max())
        if np.abs(np.array(rows) @ a - wanted).max() > none + residue(np.array(rows) @ lever, size):
            return None
    u = x.jacobian @ a + at.drift
    none = close * (float(np.abs(at.drift).max()) + float(np.abs(u).max()))
    for i, mode, slides in zip(at.closed, modes, at.slides, strict=True):
        if u[i, 0] < -none:
            return None
        if not slides and mode in (FORWARD, BACKWARD) and u[i, 1] * (1 if mode == FORWARD else -1) < -none:
            return None
    return a


# ---- one contact, followed in its normal impulse (Routh) ----
def _slides(x: Problem, i: int, slip: float) -> int:
    """How contact i slides; 0: it sticks."""
    normal, tangent = x.jacobian[i]
    if slip != 0:
        return 1 if slip > 0 else -1
    w_tn, w_tt = tangent @ (normal / x.mass), tangent @ (tangent / x.mass)
    if abs(w_tn) <= x.friction[i] * w_tt:
        return 0
    return 1 if w_tn > 0 else -1


def _rates(x: Problem, i: int, slides: int) -> tuple[Array, Array]:
    """Of the velocities, and of those at the contact, by normal impulse."""
    normal, tangent = x.jacobian[i]
    if slides:
        rate = x.along(i, slides) / x.mass
    else:
        w_tn, w_tt = tangent @ (normal / x.mass), tangent @ (tangent / x.mass)
        rate = (normal - w_tn / w_tt * tangent) / x.mass
    return rate, x.jacobian[i] @ rate


def one_contact(x: Problem, i: int, law: str) -> Array | None:
    """Velocities after a blow at contact i alone, with restitution by this law; None where it never ends."""
    v, impulse, work = x.before.copy(), 0.0, 0.0
    compressed = False
    wanted = float(x.wanted[i])
    if x.jacobian[i, 0] @ v >= 0:
        return v
    left = {"newton": np.inf, "poisson": np.inf, "stronge": np.inf}
    for _ in range(12):
        u = x.jacobian[i] @ v
        slip = float(u[1]) if abs(u[1]) > 1e-12 * x.scale else 0.0
        slides = _slides(x, i, slip)
        rate, du = _rates(x, i, slides)
        until = []  # impulses to what comes next: the end of the slip, of the compression, of the restitution
        if slides and slip * du[1] < 0:
            until.append((-u[1] / du[1], "slip"))
        if not compressed and du[0] > 0:
            until.append((-u[0] / du[0], "compressed"))
        if compressed and law == "newton" and du[0] > 0:
            until.append(((wanted - u[0]) / du[0], "over"))
        if compressed and law == "poisson":
            until.append((left[law], "over"))
        if compressed and law == "stronge":  # u p + du p^2/2 = work that is left
            root = u[0] ** 2 + 2 * du[0] * left[law]
            if root >= 0 and u[0] + np.sqrt(root) > 0:
                until.append((2 * left[law] / (u[0] + np.sqrt(root)), "over"))
        if not until:
            return None
        p, what = min(until)
        work += u[0] * p + 0.5 * du[0] * p * p
        left = {
            "newton": np.inf,
            "poisson": left["poisson"] - p,
            "stronge": left["stronge"] - u[0] * p - 0.5 * du[0] * p * p,
        }
        impulse += p
        v = v + rate * p
        if what == "over":
            return v
        if what == "slip":
            v = (
                v
                - x.jacobian[i, 1]
                * (x.jacobian[i, 1] @ v)
                / (x.jacobian[i, 1] @ (x.jacobian[i, 1] / x.mass))
                / x.mass
            )
        if what == "compressed":
            compressed = True
            left = {
                "newton": np.inf,
                "poisson": x.restitution[i] * impulse,
                "stronge": -(x.restitution[i] ** 2) * work,
            }
            if x.restitution[i] == 0:
                return v
    return None
