"""What it costs that a force depends on the motion: the same force as a number and as an expression."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

import planemotion
from planemotion.compile.flatten import FlatScene, flatten
from planemotion.engine import call

from .rows import Row
from .tables import Table
from .timing import Timer, interleave

CASES = 20  # in one call, so that what Python does around it does not count
ROUNDS = 15
BUDGET = 3.0  # s of one timer
ROUTES = ("rk", "ida")
SCENE = """
until = "t = 10 s"
parameters = {{ k = "50 N/m", c = "0.3 N*s/m", F = "3 N", M = "0.1 N*m" }}
ground.points.O = [0, 0]
ground.lines.track = {{ through = [0, 0], angle = 0 }}
bodies.block = {{ mass = "2 kg", at = ["0.3 m", 0] }}
joints.guide = {{ slider = ["block", "ground.track"] }}
joints.pin = {{ pin = ["rod.A", "block"] }}
forces.spring = {{ spring = ["block", "ground.O"], stiffness = {stiffness}, free_length = 0 }}
forces.damper = {{ damper = ["block", "ground.O"], rate = {rate} }}
forces.push = {{ force = "block", value = [{force}, 0] }}
forces.motor = {{ couple = "rod", value = {couple} }}
solve = {{ route = "{route}", estimate = false }}
ask = {{ x = "block.x", omega = "rod.omega" }}
[bodies.rod]
rod = ["A", "B"]
length = "1 m"
mass = "1 kg"
angle = "-60 deg"
at = {{ A = ["0.3 m", 0] }}
"""
CONSTANT = {"stiffness": '"k"', "rate": '"c"', "force": '"F"', "couple": '"M"'}
# The same values by expressions that read the motion.
OF_MOTION = {
    "stiffness": '"k*(1 + 0*spring.stretch/(1 m))"',
    "rate": '"c*(1 + 0*block.speed/(1 m/s))"',
    "force": '"F*(1 + 0*block.x/(1 m))"',
    "couple": '"M*(1 + 0*rod.omega/(1 rad/s))"',
}


def tables(rows: Sequence[Row], quick: bool, out: Path) -> list[Table]:
    table = Table(
        "motion_forces",
        "A force that depends on the motion beside the same as a constant",
        ("route", "what depends", "constant: CPU ms", "by motion: CPU ms", "times", "answers differ by"),
        text="A block on a spring that carries a rod, 10 s, without error estimates. "
        "The expressions have the values of the constants; `all`: those of all four forces.",
    )
    for route in ROUTES[:1] if quick else ROUTES:
        for word in (*OF_MOTION, "all"):
            table.rows.append([route, word, *compared(route, word, 1 if quick else ROUNDS)])
    return [table]


def compared(route: str, word: str, rounds: int) -> list[float]:
    """CPU ms of a case as constants and by the motion, their ratio, the greatest difference of answers."""
    changed = OF_MOTION if word == "all" else {word: OF_MOTION[word]}
    flats = [made(route, CONSTANT), made(route, {**CONSTANT, **changed})]
    answers = [solved(flat) for flat in flats]
    timers = [Timer.first(lambda flat=flat: solved(flat)) for flat in flats]  # type: ignore[misc]
    interleave(timers, rounds, BUDGET)
    constant, of_motion = (1e3 * timer.best / CASES for timer in timers)
    return [constant, of_motion, of_motion / constant, float(np.max(abs(answers[1] - answers[0])))]


def made(route: str, forces: dict[str, str]) -> FlatScene:
    return flatten(planemotion.load_text(SCENE.format(route=route, **forces)), history=False)


def solved(flat: FlatScene) -> np.ndarray:
    """The answers of the cases, which are all alike."""
    result = call.run_cases(flat, np.tile(np.asarray(flat.defaults, np.float64), (CASES, 1)), workers=1)
    if np.any(result.status):
        raise RuntimeError(f"status {result.status[0]}")
    return result.out
