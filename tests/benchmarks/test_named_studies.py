"""The two named studies against closed forms and quadratures that share nothing with the engine.

Sphere over bars (chapter problem 17.C3): with beta = asin(d/2r), c = (10 g/7 r)(1 - cos beta) and
k = (2 + 5 cos 2 beta)/7 the speed above the n-th bar is omega_n^2 = k^(2n) (omega0^2 + c) - c; the normal
force is least just before bar B.  Rolling collar: work and energy (17.11) with the kinetic energy of hoop and
collar about the contact point; times by mpmath quadrature, the normal force from the vertical acceleration of
the collar.
"""

from __future__ import annotations

import mpmath as mp
import pytest

import planemotion
from tests import STUDIES
from tests.scenes import number

G_US = mp.mpf("32.2") * mp.mpf("0.3048")
G_SI = mp.mpf("9.81")
INCH = mp.mpf("0.0254")
RK = 1e-9  # reached: some 1e-11
IDA = 1e-8  # reached: some 1e-10, at ten times the time


def sphere_closed_form(d: mp.mpf, r: mp.mpf, omega0: mp.mpf) -> dict[str, mp.mpf]:
    beta = mp.asin(d / (2 * r))
    c = 10 * G_US / (7 * r) * (1 - mp.cos(beta))
    k = (2 + 5 * mp.cos(2 * beta)) / 7
    strike = omega0**2 + c
    bars = mp.floor(mp.log(strike / c) / (-2 * mp.log(k)))
    normal = mp.cos(beta) - r * strike / G_US
    return {
        "omega_B": mp.sqrt(k**2 * strike - c),
        "bars_passed": bars,
        "min_normal_over_weight": normal,
        "friction_needed": mp.mpf(2) / 7 * mp.sin(beta) / normal,
    }


def relative(value: float, reference: mp.mpf) -> float:
    return float(abs(value / reference - 1)) if reference else abs(value)


@pytest.mark.parametrize("d", ["1", "2.37", "3", "4.4", "5.5", "6"])
@pytest.mark.parametrize(("route", "bound"), [("rk", RK), ("ida", IDA)])
def test_sphere_over_bars_matches_the_recursion(d: str, route: str, bound: float) -> None:
    result = planemotion.load(STUDIES / "sphere_over_bars.toml").run(**{"d": f"{d} in", "solve.route": route})
    reference = sphere_closed_form(mp.mpf(d) * INCH, 10 * INCH, mp.mpf("1.5"))
    assert result.status == "ok"
    assert result.asks["bars_passed"].value == reference.pop("bars_passed")
    for key, expected in reference.items():
        assert relative(number(result.asks[key].value), expected) < bound, key


def test_widest_spacing_is_where_the_recursion_ends_with_no_speed() -> None:
    """Above the fifth bar nothing is left: k^10 (omega0^2 + c) = c."""
    result = planemotion.load(STUDIES / "widest_spacing.toml").sweep()
    assert (result["status"].values == 0).all()
    for omega0, d in zip(result["omega0"].values, result["d"].values, strict=True):

        def left(spacing: mp.mpf, omega0: float = float(omega0)) -> mp.mpf:
            beta = mp.asin(spacing / 20)
            c = 10 * G_US / (70 * INCH) * (1 - mp.cos(beta))
            return ((2 + 5 * mp.cos(2 * beta)) / 7) ** 10 * (omega0**2 + c) - c

        assert relative(d, mp.findroot(left, (mp.mpf(1), mp.mpf(6)), solver="anderson")) < RK


class Collar:
    """Hoop of mass m and radius r with a collar of mass mc at d: energy in the turned angle."""

    def __init__(self, d: str, r: str, m: str, mass_ratio: str, omega_below: str) -> None:
        self.d, self.r, self.m, self.omega = (mp.mpf(x) for x in (d, r, m, omega_below))
        self.mc = mp.mpf(mass_ratio) * self.m

    def inertia(self, turned: mp.mpf) -> mp.mpf:
        """About the contact point: 2 m r^2 of the hoop and mc (distance of the collar)^2."""
        return 2 * self.m * self.r**2 + self.mc * (
            self.r**2 + self.d**2 - 2 * self.r * self.d * mp.cos(turned)
        )

    def speed(self, turned: mp.mpf) -> mp.mpf:
        work = 2 * self.mc * G_SI * self.d * (1 - mp.cos(turned))
        return mp.sqrt((self.inertia(mp.mpf(0)) * self.omega**2 - work) / self.inertia(turned))

    def normal_over_weight(self, turned: mp.mpf) -> mp.mpf:
        # height of the collar r - d cos(turned); its second derivative by d(omega^2/2)/d(turned)
        alpha = mp.diff(lambda x: self.speed(x) ** 2 / 2, turned)
        rise = self.d * (mp.sin(turned) * alpha + mp.cos(turned) * self.speed(turned) ** 2)
        return 1 + self.mc * rise / ((self.m + self.mc) * G_SI)

    def time_of_turn(self) -> mp.mpf:
        return mp.quad(lambda x: 1 / self.speed(x), mp.linspace(0, 2 * mp.pi, 9))

    def least_normal(self) -> mp.mpf:
        angles = [2 * mp.pi * i / 360 for i in range(361)]
        guess = min(angles, key=self.normal_over_weight)
        return min(
            self.normal_over_weight(mp.findroot(lambda x: mp.diff(self.normal_over_weight, x), guess)),
            self.normal_over_weight(guess),
        )


COLLARS = [
    ("0.2", "0.3", "2", "1", "15"),
    ("0.1", "0.3", "2", "0.5", "15"),
    ("0.3", "0.3", "2", "1", "9"),
    ("0.25", "0.3", "2", "2", "18"),
]


@pytest.mark.parametrize("case", COLLARS)
@pytest.mark.parametrize(("route", "bound"), [("rk", RK), ("ida", IDA)])
def test_rolling_collar_matches_energy_and_quadrature(
    case: tuple[str, str, str, str, str], route: str, bound: float
) -> None:
    d, r, m, ratio, omega = case
    result = planemotion.load(STUDIES / "rolling_collar.toml").run(
        **{
            "d": f"{d} m", "r": f"{r} m", "m": f"{m} kg", "mass_ratio": float(ratio),
            "omega_below": f"{omega} rad/s", "solve.route": route,
        }
    )  # fmt: skip
    with mp.workdps(30):
        collar = Collar(*case)
        assert relative(number(result.omega_above), collar.speed(mp.pi)) < bound
        assert relative(number(result.time_of_turn), collar.time_of_turn()) < bound
        least = collar.least_normal()
    assert relative(number(result.min_normal_over_weight), least) < bound
    assert result.asks["hops"].value == (1 if least < 0 else 0)
    assert (result.asks["friction_needed"].value is None) == (least < 0)
