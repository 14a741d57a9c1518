"""The scenes of the benchmark: for each its file, the hand-derived model, the mechanism and the reference.

Cases and exact answers come from references.json (references.py makes it), so that every peer gets the same.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import planemotion

from . import generate, mechanisms, models

HERE = Path(__file__).parent
STUDIES = HERE.parent
ROOT = STUDIES.parent
REFERENCES = HERE / "references.json"
# What double precision can be told apart from: smaller errors are drawn and compared as this.
LEAST_ERROR = 1e-16

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Problem:
    """One scene and what is asked of it.

    `asks`: keys of the scene, in the order of the reference's columns (a list counts as several); `relative`:
    errors are relative; `count`: key whose wrong integers are counted instead; `drift`: key of the energy,
    which starts at `energy`, J.  `no_engine`: why engines have no row.
    """

    name: str
    title: str
    unit: str
    model: models.Model
    scene: Callable[[], planemotion.Scene]
    asks: tuple[str, ...]
    relative: bool = False
    count: str | None = None
    drift: str | None = None
    mechanism: mechanisms.Mechanism | None = None
    no_engine: str = ""
    energy: float = 0.0

    @property
    def reference(self) -> dict[str, Any]:
        return references()[self.name]

    @property
    def names(self) -> tuple[str, ...]:
        """Parameters that differ from case to case."""
        return tuple(self.reference["names"])

    @property
    def cases(self) -> Floats:
        """[cases, names], SI."""
        cases = self.reference["cases"]
        return np.array(cases, float).reshape(len(cases), len(self.names))

    def slow_cases(self) -> int:
        """The first cases, which stand for all: what a slow method runs."""
        return int(self.reference["slow"])

    def exact(self) -> Floats:
        """[cases, columns of the answers], SI."""
        return np.array(self.reference["answers"], float)

    def error(self, answers: Floats) -> float:
        """The greatest error over the cases and the answers that are not counts."""
        exact = self.exact()[: len(answers)]
        keep = [i for i, key in enumerate(self.reference["columns"]) if key not in (self.count, self.drift)]
        exact, found = exact[:, keep], np.asarray(answers, float)[:, keep]
        error = np.abs(found - exact) / (np.abs(exact) if self.relative else 1.0)
        error = error[~np.isnan(exact)]
        return float(np.max(error)) if error.size and not np.isnan(error).any() else float("nan")

    def wrong(self, answers: Floats) -> int | None:
        """Cases with a wrong count."""
        if self.count is None:
            return None
        column = self.reference["columns"].index(self.count)
        return int(np.count_nonzero(np.asarray(answers)[:, column] != self.exact()[: len(answers), column]))

    def energy_drift(self, answers: Floats) -> float | None:
        """Greatest change of the energy from the start to the end, J."""
        if self.drift is None:
            return None
        column = self.reference["columns"].index(self.drift)
        return float(np.max(np.abs(np.asarray(answers)[:, column] - self.energy)))


@cache
def references() -> dict[str, Any]:
    """The stored references by problem."""
    found: dict[str, Any] = json.loads(REFERENCES.read_text(encoding="utf-8"))
    return found


def _file(path: Path) -> Callable[[], planemotion.Scene]:
    return lambda: planemotion.load(path)


NO_EVENTS = "a fixed step without events: states at given angles are not an answer of the engine"
SOFT_CONTACT = (
    "its contacts are soft: a plastic blow of a rough bar and a coefficient of restitution have no exact form"
)

PROBLEMS = (
    Problem(
        "sphere_over_bars",
        "Sphere over bars (17.C3), d and omega0 at random",
        "rel.",
        models.SphereOverBars(),
        _file(STUDIES / "sphere_over_bars.toml"),
        ("omega_B", "bars_passed"),
        relative=True,
        count="bars_passed",
        no_engine=SOFT_CONTACT,
    ),
    Problem(
        "rolling_collar",
        "Rolling hoop with collar, d and mass ratio on a grid",
        "rel.",
        models.Collar(),
        _file(STUDIES / "rolling_collar.toml"),
        ("omega_above", "time_of_turn"),
        relative=True,
        no_engine=NO_EVENTS,
    ),
    Problem(
        "linkage_c5",
        "Two hinged bars released level (17.C5), to 89 deg",
        "rel.",
        models.Linkage(),
        _file(HERE / "scenes" / "linkage_c5.toml"),
        ("omega", "omega_end", "v_D", "time"),
        relative=True,
        no_engine=NO_EVENTS,
    ),
    Problem(
        "double_pendulum",
        "Double pendulum of rods, 5 s",
        "m",
        models.DoublePendulum(),
        _file(STUDIES / "double_pendulum.toml"),
        ("tip_x", "tip_y"),
        mechanism=mechanisms.double_pendulum(),
    ),
    Problem(
        "slider_crank",
        "Slider-crank under gravity, 10 s, 22 turns",
        "rad",
        models.SliderCrank(),
        _file(STUDIES / "slider_crank.toml"),
        ("crank_angle",),
        mechanism=mechanisms.slider_crank(),
    ),
    Problem(
        "zeno_ball",
        "Bouncing ball, e = 0.9, to its rest at 8.58 s",
        "s",
        models.Ball(),
        _file(HERE / "scenes" / "zeno_ball.toml"),
        ("first", "rest"),
        no_engine=SOFT_CONTACT,
    ),
    Problem(
        "pendulum_a01",
        "IFToMM A01, simple pendulum, 10 s",
        "m",
        models.SimplePendulum(),
        _file(HERE / "scenes" / "pendulum_a01.toml"),
        ("x", "y"),
        mechanism=mechanisms.simple_pendulum(),
    ),
    *(
        Problem(
            f"four_bars_{n}",
            f"IFToMM A02, N-four-bar, N = {n}, 10 s through its flat position",
            "rad",
            models.FourBars(n),
            partial(generate.four_bars, n),
            ("angle", "energy"),
            drift="energy",
            energy=models.FourBars(n).start_energy,
            mechanism=mechanisms.four_bars(n),
        )
        for n in (2, 40)
    ),
)
