"""Answers of the benchmark's scenes in many digits: closed forms, quadratures, and motions in time.

They share nothing with the engine; mpmath's working precision is what the caller has set.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import mpmath as mp

INCH = 0.0254  # m
G_US = 32.2 * 0.3048  # m/s^2
G_SI = 9.81  # m/s^2

State = list[mp.mpf]


# ---- closed forms and quadratures ----


def sphere_squares(d: float, r: float, omega0: float) -> list[mp.mpf]:
    """omega^2 above each bar that the sphere passes (chapter problem 17.C3), in 40 digits.

    Energy about each bar, and (2 + 5 cos 2 beta)/7 of omega kept at each blow.
    """
    with mp.workdps(40):
        d, r, omega0, g = (mp.mpf(x) for x in (d, r, omega0, G_US))
        beta = mp.asin(d / (2 * r))
        c, k = 10 * g / (7 * r) * (1 - mp.cos(beta)), (2 + 5 * mp.cos(2 * beta)) / 7
        square, passed = omega0**2, []
        while (square := k**2 * (square + c) - c) > 0:
            passed.append(square)
        return passed


class RollingCollar:
    """A hoop of radius r and mass m with a collar of ratio m at d rolls one turn from omega, collar below.

    Energy in the turned angle x; N and F from the acceleration of the mass centre.
    """

    def __init__(self, d: float, ratio: float, omega: float = 15.0, r: float = 0.3, m: float = 2.0) -> None:
        self.d, self.omega, self.r, self.m = (mp.mpf(x) for x in (d, omega, r, m))
        self.collar = mp.mpf(ratio) * self.m
        self.g = mp.mpf(G_SI)

    def inertia(self, x: mp.mpf) -> mp.mpf:
        """About the contact point."""
        r, d = self.r, self.d
        return 2 * self.m * r**2 + self.collar * (r**2 + d**2 - 2 * r * d * mp.cos(x))

    def square(self, x: mp.mpf) -> mp.mpf:
        """omega^2."""
        work = 2 * self.collar * self.g * self.d * (1 - mp.cos(x))
        return (self.inertia(mp.mpf(0)) * self.omega**2 - work) / self.inertia(x)

    def forces(self, x: mp.mpf) -> tuple[mp.mpf, mp.mpf]:
        """N and F."""
        s, c = mp.sin(x), mp.cos(x)
        moment, weight = self.collar * self.d, (self.m + self.collar) * self.g
        alpha = -moment * s * (self.g + self.r * self.square(x)) / self.inertia(x)
        normal = weight + moment * (c * self.square(x) + s * alpha)
        friction = (self.m + self.collar) * self.r * alpha + moment * (s * self.square(x) - c * alpha)
        return normal, friction

    def omega_above(self) -> mp.mpf:
        return mp.sqrt(self.square(mp.pi))

    def time_of_turn(self) -> mp.mpf:
        return mp.quad(lambda x: 1 / mp.sqrt(self.square(x)), mp.linspace(0, 2 * mp.pi, 9))

    def least_normal_over_weight(self) -> mp.mpf:
        return least_of(lambda x: self.forces(x)[0] / ((self.m + self.collar) * self.g))

    def friction_needed(self) -> mp.mpf:
        """Greatest |F|/N, where N does not vanish."""

        def needed(x: mp.mpf) -> mp.mpf:
            normal, friction = self.forces(x)
            return -abs(friction) / normal

        return -least_of(needed)


def least_of(f: Callable[[mp.mpf], mp.mpf], samples: int = 64) -> mp.mpf:
    """The least value of a smooth function over a turn: samples, then golden section in the best bracket."""
    x = [2 * mp.pi * i / samples for i in range(samples + 1)]
    values = [f(u) for u in x]
    best = min(range(samples + 1), key=lambda i: values[i])
    low, high = x[max(best - 1, 0)], x[min(best + 1, samples)]
    golden = (mp.sqrt(5) - 1) / 2
    while high - low > mp.mpf(10) ** (-mp.mp.dps // 2):  # the value is then good to twice as many digits
        left, right = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, right) if f(left) < f(right) else (left, high)
    return min(values[best], f((low + high) / 2))


# ---- motions in time ----


def double_pendulum(y: State) -> State:
    """Two slender rods of 1 m and 1 kg: angles from the level and their rates."""
    g, inertia = mp.mpf(G_SI), mp.mpf(1) / 12
    a, b, wa, wb = y
    c, s = mp.cos(a - b), mp.sin(a - b)
    m11, m22, m12 = inertia + mp.mpf(5) / 4, inertia + mp.mpf(1) / 4, c / 2
    f1 = -mp.mpf(3) / 2 * g * mp.cos(a) - s / 2 * wb * wb
    f2 = -g / 2 * mp.cos(b) + s / 2 * wa * wa
    det = m11 * m22 - m12 * m12
    return [wa, wb, (f1 * m22 - f2 * m12) / det, (m11 * f2 - m12 * f1) / det]


def slider_crank(y: State) -> State:
    """Crank 0.1 m, rod 0.3 m, masses 0.2, 0.2, 0.4 kg: I(th) th'' + I'(th) th'^2 / 2 = M(th)."""
    a, length, m1, m2, m3, g = (mp.mpf(x) for x in (0.1, 0.3, 0.2, 0.2, 0.4, G_SI))
    s, c = mp.sin(y[0]), mp.cos(y[0])
    root = mp.sqrt(length**2 - (a * s) ** 2)
    phi = a * c / root
    dphi = (-a * s * root + a * c * a**2 * s * c / root) / root**2
    x2, y2 = -a * s - a * s * phi / 2, a * c / 2
    dx2, dy2 = -a * c - (a * c * phi + a * s * dphi) / 2, -a * s / 2
    x3, dx3 = -a * s - a * s * phi, -a * c - a * c * phi - a * s * dphi
    moment = m1 * a**2 / 3 + m2 * (x2**2 + y2**2) + m2 * length**2 / 12 * phi**2 + m3 * x3**2
    slope = 2 * (m2 * (x2 * dx2 + y2 * dy2) + m2 * length**2 / 12 * phi * dphi + m3 * x3 * dx3)
    return [y[1], -(slope * y[1] ** 2 / 2 + g * a / 2 * (m1 + m2) * c) / moment]


def crank_inertia(th: mp.mpf) -> mp.mpf:
    """What the crank feels of the masses of `slider_crank`: T = I(th) th'^2 / 2."""
    a, length, m1, m2, m3 = (mp.mpf(x) for x in ("0.1", "0.3", "0.2", "0.2", "0.4"))
    s, c = mp.sin(th), mp.cos(th)
    phi = a * c / mp.sqrt(length**2 - (a * s) ** 2)
    x2, y2, x3 = -a * s - a * s * phi / 2, a * c / 2, -a * s - a * s * phi
    return m1 * a**2 / 3 + m2 * (x2**2 + y2**2) + m2 * length**2 / 12 * phi**2 + m3 * x3**2


def midpoint_extrapolated(
    rhs: Callable[[State], State], start: Sequence[mp.mpf], end: float, intervals: int, order: int = 12
) -> State:
    """Gragg's midpoint rule with 2, 4 .. 2 order substeps of each of the equal intervals, extrapolated."""
    y, h = [mp.mpf(u) for u in start], mp.mpf(end) / intervals
    for _ in range(intervals):
        table: list[list[State]] = []
        for j in range(order):
            n = 2 * (j + 1)
            step = h / n
            z0, z1 = y, [u + step * f for u, f in zip(y, rhs(y), strict=True)]
            for _ in range(1, n):
                z0, z1 = z1, [u + 2 * step * f for u, f in zip(z0, rhs(z1), strict=True)]
            row = [[(u + v + step * f) / 2 for u, v, f in zip(z0, z1, rhs(z1), strict=True)]]
            for m in range(1, j + 1):
                ratio = (mp.mpf(j + 1) / (j + 1 - m)) ** 2 - 1
                row.append(
                    [u + (u - v) / ratio for u, v in zip(row[m - 1], table[j - 1][m - 1], strict=True)]
                )
            table.append(row)
        y = table[-1][-1]
    return y
