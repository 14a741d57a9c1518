"""The figures of the main job: speed beside error, against references that share nothing with the engine.

    .venv/bin/python studies/benchmarks/figures.py          all tables but the last
    .venv/bin/python studies/benchmarks/figures.py memory   resident memory of a sweep of 10^6 cases (minutes)

Times are the least of several repetitions of calls into the kernel, by the clock, since two workers are
compared with one; compare ratios within one run, machines are noisy.
"""

from __future__ import annotations

import argparse
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import mpmath as mp
import numpy as np

import planemotion
from planemotion import engine
from planemotion.flatten import FlatScene, flatten

STUDIES = Path(__file__).parent.parent
INCH = 0.0254
G_US = 32.2 * 0.3048
G_SI = 9.81
MEMORY_CASES = 1_000_000


def best_time(call, repeat: int = 3) -> float:
    times = []
    for _ in range(repeat):
        begun = time.perf_counter()
        call()
        times.append(time.perf_counter() - begun)
    return min(times)


def flat_of(name: str, only: str | None = None, **values: object) -> FlatScene:
    """The tables of a study's base case; with `only` that ask alone, so that extremes cost nothing."""
    scene = planemotion.load(STUDIES / f"{name}.toml").with_values(values)
    if only:
        scene = planemotion.Scene.from_raw(
            {**scene.raw, "ask": {only: scene.raw["ask"][only]}}, file=scene.file
        )
    return flatten(scene.data)


def columns(flat: FlatScene, **values: np.ndarray) -> np.ndarray:
    """Parameter rows in SI: the defaults of the file but for the given columns."""
    count = max(np.size(value) for value in values.values())
    param = np.tile(flat.defaults, (count, 1))
    for name, value in values.items():
        param[:, flat.parameters.index(name)] = value
    return param


def out_of(flat: FlatScene, results: engine.CaseResults, key: str) -> np.ndarray:
    ask = next(ask for ask in flat.asks if ask.key == key)
    return results.out[:, ask.first] / ask.factor


# ---- sphere over bars ----


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


def table_17_c3() -> None:
    print("\n17.C3: r = 10 in, omega0 = 1.5 rad/s; route rk at the default accuracy")
    header = ("d [in]", "bars", "closed form", "omega_B [rad/s]", "closed form", "rel. error")
    print("{:>7} {:>5} {:>12} {:>18} {:>18} {:>10}".format(*header))
    flat = flat_of("sphere_over_bars")
    spacings = np.arange(1, 6.01, 0.5)
    results = engine.run_cases(flat, columns(flat, d=spacings * INCH))
    omega, bars = out_of(flat, results, "omega_B"), out_of(flat, results, "bars_passed")
    for i, d in enumerate(spacings):
        reference, count = sphere_reference(d * INCH, 10 * INCH, 1.5)
        error = abs(omega[i] / reference - 1)
        print(f"{d:7.1f} {bars[i]:5.0f} {count:12d} {omega[i]:18.14f} {reference:18.14f} {error:10.1e}")


def sphere_speed(route: str, cases: int, low: float, accuracy: str = "1e-10") -> None:
    flat = flat_of("sphere_over_bars_grid", **{"solve.route": route, "solve.accuracy": float(accuracy)})
    side = int(np.sqrt(cases))
    d, omega0 = (a.ravel() for a in np.meshgrid(np.linspace(low, 6, side) * INCH, np.linspace(1, 3, side)))
    param = columns(flat, d=d, omega0=omega0)
    results = engine.run_cases(flat, param)
    omega, bars = out_of(flat, results, "omega_B"), out_of(flat, results, "bars_passed")
    reference = [sphere_reference(*x) for x in zip(d, np.full(d.size, 10 * INCH), omega0, strict=True)]
    passed = [i for i, (first, _) in enumerate(reference) if first == first]
    error = max(abs(omega[i] / reference[i][0] - 1) for i in passed)
    wrong = sum(bars[i] != reference[i][1] for i in range(d.size))
    one, two = (best_time(lambda n=n: engine.run_cases(flat, param, workers=n)) for n in (1, 2))
    print(
        f"sphere over bars  {route:4} {accuracy:>6} {d.size:6d} cases, {np.mean(bars):5.1f} bars each: "
        f"{d.size / one:9.1f} cases/s on 1 core, {d.size / two:9.1f} on 2 ({one / two:.2f}x); "
        f"omega_B error {error:.1e}, wrong counts {wrong}, failed {np.count_nonzero(results.status)}"
    )


# ---- rolling collar ----


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


def collar_speed(route: str, side: int, accuracy: str = "1e-10") -> None:
    flat = flat_of("rolling_collar", **{"solve.route": route, "solve.accuracy": float(accuracy)})
    d, ratio = (a.ravel() for a in np.meshgrid(np.linspace(0, 0.3, side), np.linspace(0.5, 2, side)))
    param = columns(flat, d=d, mass_ratio=ratio)
    results = engine.run_cases(flat, param)
    above, turn = out_of(flat, results, "omega_above"), out_of(flat, results, "time_of_turn")
    sample = range(0, d.size, d.size // 40 + 1)
    reference = {i: collar_reference(d[i], ratio[i]) for i in sample}
    error = max(max(abs(above[i] / a - 1), abs(turn[i] / t - 1)) for i, (a, t) in reference.items())
    one, two = (best_time(lambda n=n: engine.run_cases(flat, param, workers=n)) for n in (1, 2))
    print(
        f"rolling collar    {route:4} {accuracy:>6} {d.size:6d} cases: "
        f"{d.size / one:9.1f} cases/s on 1 core, {d.size / two:9.1f} on 2 ({one / two:.2f}x); "
        f"error of omega_above and time_of_turn {error:.1e}, failed {np.count_nonzero(results.status)}"
    )


# ---- routes against tight references ----


def route_table(name: str, key: str, reference: float, what: str) -> None:
    print(f"\n{name}: {what}; reference {reference:.15g}")
    print(f"{'route':>6} {'rtol':>7} {'ms':>9} {'error':>9} {'steps':>7} {'energy':>9}")
    for route in ("rk", "ida"):
        for accuracy in ("1e-6", "1e-8", "1e-10"):
            flat = flat_of(name, key, **{"solve.route": route, "solve.accuracy": float(accuracy)})
            param = flat.defaults[None, :]
            results = engine.run_cases(flat, param)
            elapsed = best_time(lambda flat=flat, param=param: engine.run_cases(flat, param), 5)
            value = out_of(flat, results, key)[0]
            print(
                f"{route:>6} {accuracy:>7} {elapsed * 1e3:9.2f} {abs(value - reference):9.1e} "
                f"{results.count[0, engine_steps()]:7d} {results.audit[0, 0]:9.1e}"
            )


def engine_steps() -> int:
    from planemotion._layout import PM_COUNT_STEPS

    return PM_COUNT_STEPS


def double_pendulum_reference() -> float:
    """Height of the lower tip after 5 s: hand-derived equations (rods 1 m, 1 kg) in 30 digits."""
    with mp.workdps(30):
        g, inertia = mp.mpf("9.81"), mp.mpf(1) / 12

        def rhs(_t, y):
            a, b, wa, wb = y
            c, s = mp.cos(a - b), mp.sin(a - b)
            m11, m22, m12 = inertia + mp.mpf(5) / 4, inertia + mp.mpf(1) / 4, c / 2
            f1 = -mp.mpf(3) / 2 * g * mp.cos(a) - s / 2 * wb * wb
            f2 = -g / 2 * mp.cos(b) + s / 2 * wa * wa
            det = m11 * m22 - m12 * m12
            return [wa, wb, (f1 * m22 - f2 * m12) / det, (m11 * f2 - m12 * f1) / det]

        y = gragg_extrapolation(rhs, [mp.mpf(0)] * 4, mp.mpf(5), 250)
        return float(mp.sin(y[0]) + mp.sin(y[1]))


def slider_crank_reference() -> float:
    """Crank angle after 10 s, 30 digits, one coordinate: crank 0.1 m, rod 0.3 m, masses 0.2, 0.2, 0.4 kg."""
    with mp.workdps(30):
        a, length, m1, m2, m3, g = (mp.mpf(x) for x in ("0.1", "0.3", "0.2", "0.2", "0.4", "9.81"))

        def parts(th):
            s, c = mp.sin(th), mp.cos(th)
            root = mp.sqrt(length**2 - (a * s) ** 2)
            phi = a * c / root  # rate of the rod's angle per unit crank rate
            dphi = (-a * s * root - a * c * (-(a**2) * s * c / root)) / root**2
            x2, y2 = -a * s - a * s * phi / 2, a * c / 2
            dx2, dy2 = -a * c - (a * c * phi + a * s * dphi) / 2, -a * s / 2
            x3, dx3 = -a * s - a * s * phi, -a * c - a * c * phi - a * s * dphi
            moment = m1 * a**2 / 3 + m2 * (x2**2 + y2**2) + m2 * length**2 / 12 * phi**2 + m3 * x3**2
            slope = 2 * (m2 * (x2 * dx2 + y2 * dy2) + m2 * length**2 / 12 * phi * dphi + m3 * x3 * dx3)
            return moment, slope, g * a / 2 * (m1 + m2) * c

        def rhs(_t, y):
            moment, slope, weight = parts(y[0])
            return [y[1], -(slope * y[1] ** 2 / 2 + weight) / moment]

        return float(gragg_extrapolation(rhs, [mp.pi / 4, mp.mpf(10)], mp.mpf(10), 1000)[0])


def gragg_extrapolation(rhs, y0, t_end, intervals: int, order: int = 12):
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


# ---- memory ----


def memory() -> None:
    """A sweep of 10^6 cases in a process of its own; its greatest resident memory."""
    with tempfile.TemporaryDirectory() as folder:
        code = (
            "import planemotion, sys\n"
            f"scene = planemotion.load({str(STUDIES / 'sphere_over_bars.toml')!r})\n"
            "scene = scene.with_values({'sweep.d.from': '5.5 in', 'sweep.d.to': '6 in', "
            f"'sweep.d.num': {MEMORY_CASES}}})\n"
            f"scene.sweep(out={folder!r}, workers=2)\n"
        )
        begun = time.perf_counter()
        subprocess.run([sys.executable, "-c", code], check=True)
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
        size = sum(p.stat().st_size for p in Path(folder).rglob("*") if p.is_file()) / 2**20
        print(
            f"{MEMORY_CASES} cases of sphere over bars (d 5.5 to 6 in): {time.perf_counter() - begun:.0f} s, "
            f"at most {peak:.0f} MB resident, {size:.0f} MB of files"
        )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("what", nargs="?", choices=("all", "memory"), default="all")
    if parser.parse_args().what == "memory":
        memory()
        return
    table_17_c3()
    print("\nspeed beside error")
    sphere_speed("rk", 400, 1)
    sphere_speed("ida", 49, 2)
    collar_speed("rk", 40)
    collar_speed("ida", 14)
    route_table("double_pendulum", "tip_y", double_pendulum_reference(), "height of the tip after 5 s [m]")
    route_table("slider_crank", "crank_angle", slider_crank_reference(), "crank angle after 10 s [rad]")


if __name__ == "__main__":
    main()
