"""Answers of the named studies in closed form or by quadrature, and an integrator of its own.

They share nothing with the engine."""

from __future__ import annotations

from collections.abc import Callable

import mpmath as mp

INCH = 0.0254  # m
G_US = 32.2 * 0.3048  # m/s^2
G_SI = 9.81  # m/s^2

State = list[mp.mpf]


def sphere_reference(d: float, r: float, omega0: float) -> tuple[float, int]:
    """omega above bar B and bars passed, from the recursion of chapter problem 17.C3, in 40 digits."""
    with mp.workdps(40):
        d, r, omega0, g = (mp.mpf(x) for x in (d, r, omega0, G_US))
        beta = mp.asin(d / (2 * r))
        c, k = 10 * g / (7 * r) * (1 - mp.cos(beta)), (2 + 5 * mp.cos(2 * beta)) / 7
        square, bars = omega0**2, 0
        first = mp.nan
        while True:
            square = k**2 * (square + c) - c
            if square <= 0:
                return float(first), bars
            bars += 1
            if bars == 1:
                first = mp.sqrt(square)


def collar_reference(
    d: float, ratio: float, omega: float = 15.0, r: float = 0.3, m: float = 2.0
) -> tuple[float, float]:
    """omega with the collar above and the time of a turn: energy and adaptive quadrature."""
    d, ratio, omega, r, m, g = (mp.mpf(x) for x in (d, ratio, omega, r, m, G_SI))
    mc = ratio * m

    def inertia(x: mp.mpf) -> mp.mpf:
        return 2 * m * r**2 + mc * (r**2 + d**2 - 2 * r * d * mp.cos(x))

    def speed(x: mp.mpf) -> mp.mpf:
        return mp.sqrt((inertia(mp.mpf(0)) * omega**2 - 2 * mc * g * d * (1 - mp.cos(x))) / inertia(x))

    return float(speed(mp.pi)), float(mp.quad(lambda x: 1 / speed(x), mp.linspace(0, 2 * mp.pi, 9)))


def gragg_extrapolation(
    rhs: Callable[[mp.mpf, State], State], y0: State, t_end: mp.mpf, intervals: int, order: int = 12
) -> State:
    """Bulirsch-Stoer with fixed intervals: midpoint rule with 2, 4 .. 2 order substeps, extrapolated."""
    y, h = list(y0), t_end / intervals
    for i in range(intervals):
        table: list[list[list[mp.mpf]]] = []
        for j in range(order):
            n = 2 * (j + 1)
            step = h / n
            z0, z1 = y, [u + step * f for u, f in zip(y, rhs(i * h, y), strict=True)]
            for k in range(1, n):
                z2 = [u + 2 * step * f for u, f in zip(z0, rhs(i * h + k * step, z1), strict=True)]
                z0, z1 = z1, z2
            last = rhs((i + 1) * h, z1)
            row = [[(u + v + step * f) / 2 for u, v, f in zip(z0, z1, last, strict=True)]]
            for m in range(1, j + 1):
                ratio = (mp.mpf(j + 1) / (j + 1 - m)) ** 2 - 1
                row.append(
                    [u + (u - v) / ratio for u, v in zip(row[m - 1], table[j - 1][m - 1], strict=True)]
                )
            table.append(row)
        y = table[-1][-1]
    return y
