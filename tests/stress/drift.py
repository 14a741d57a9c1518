"""`python -m tests.stress.drift`: how far energy drifts over many periods of conservative motion.

A part of `make stress`.  The period is that of the motion, or about that of its swings where it has none; the
drift is that of the total energy over the greatest kinetic energy of the run.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
import tomllib
from dataclasses import dataclass

from rich.console import Console
from rich.table import Table

import planemotion
from planemotion.file import to_toml
from tests import ROOT

ALLOWED = 1e-9
# Study, seconds of a period.
STUDIES = {"pendulum": 1.8692, "slider_crank": 0.6, "double_pendulum": 2.0}
ROUTES = ("auto", "rk")
ASK = {
    "first": {"of": "energy.total", "at": "begin"},
    "last": "energy.total",
    "most": {"max": "energy.kinetic"},
}


@dataclass(frozen=True)
class Drift:
    status: str
    energy: float
    told: float  # error of the energies, likewise
    steps: int
    seconds: float

    @property
    def is_small(self) -> bool:
        return self.status == "ok" and self.energy <= ALLOWED


def drift(study: str, route: str, periods: float) -> Drift:
    """Over so many periods of a study."""
    end = periods * STUDIES[study]
    raw = tomllib.loads((ROOT / f"studies/{study}.toml").read_text(encoding="utf-8"))
    raw["until"], raw["ask"] = f"t = {end} s", ASK
    raw["events"] = {"begin": "start"}
    limits = {"max_time": f"{2 * end} s", "max_steps": 2**31 - 1, "max_events": 2**31 - 1}
    raw["solve"] = {"route": route, **limits}
    begun = time.monotonic()
    found = planemotion.load_text(to_toml(raw)).run()
    seconds = time.monotonic() - begun
    value = {name: _number(ask.value) for name, ask in found.asks.items()}
    error = {name: _number(ask.error) for name, ask in found.asks.items()}
    return Drift(
        found.status,
        abs(value["last"] - value["first"]) / value["most"],
        (error["last"] + error["first"]) / value["most"],
        found.counts["steps"],
        seconds,
    )


def _number(found: object) -> float:
    return found if isinstance(found, float) else math.nan


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--periods", type=float, default=1e4)
    given = parser.parse_args()
    columns = ("study", "route", "status", "energy", "told", "steps", "s")
    shown = Table(*columns, title=f"drift over {given.periods:g} periods")
    good = True
    for study in STUDIES:
        for route in ROUTES:
            x = drift(study, route, given.periods)
            good &= x.is_small
            numbers = (f"{x.energy:.1e}", f"{x.told:.1e}", f"{x.steps}", f"{x.seconds:.2f}")
            shown.add_row(study, route, x.status, *numbers, style=None if x.is_small else "red")
    Console(soft_wrap=True).print(shown)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
