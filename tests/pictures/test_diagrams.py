"""The book's figures: what acts on each body makes its motion, and is drawn with names and values."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

import planemotion
from planemotion.base.errors import SceneError
from planemotion.pen import page
from planemotion.pictures import acting, diagrams, energies
from planemotion.pictures.acting import Balance
from planemotion.scene import Scene
from tests import CHAPTER
from tests.pictures.figures import texts

# What labels may overlap by, pixels of 180 to an inch.
SLIVER = 6
# What a label may stick out of its own drawing, likewise: there is room between them.
STICKS_OUT = 30
# Of the greatest force, couple or energy of the scene: what a sum may miss.
CLOSE = 1e-9
# One or more of each: weights and pins, gears, cords, belts, slots, rolling, motors, a turning plane, welds,
# rows, friction, captures, impulses that are applied, massless bodies, blows with several contacts.
SAMPLE = (
    *("17-003", "17-012", "17-027", "17-035", "17-041", "17-044", "17-046", "17-050", "17-054"),
    *("17-062", "17-071", "17-079", "17-080", "17-082", "17-086", "17-096", "17-100", "17-103"),
    *("17-106", "17-111", "17-116", "17-121", "17-123", "17-130", "17-134", "17-142", "17-146"),
)
# Masses are left out, and all that is unknown has a couple about the centre.
NO_MASS = ("17-089", "17-090", "17-091", "17-C4")
# A mass is left out of what a work is done on; two blows at one instant, of which the kernel keeps the last.
NO_SUM = ("17-006", "17-125", "17-126")


def chapter() -> list[object]:
    """All scenes; those beside the sample are slow together."""
    return [
        pytest.param(path, id=path.stem, marks=() if path.stem in SAMPLE else pytest.mark.slow)
        for path in sorted(CHAPTER.glob("*.toml"))
    ]


def size_of(balances: Sequence[Balance]) -> tuple[float, float]:
    """The greatest vector and the greatest couple, also of a vector about the centre."""
    vectors, couples = [0.0], [0.0]
    for one in balances:
        for act in one.acts:
            size = 0.0 if act.vector is None else float(np.hypot(*act.vector))
            vectors.append(size)
            couples += [abs(act.couple or 0.0), size * math.dist(act.place, one.center)]
        for wrench in (one.before, one.after):
            vectors.append(float(np.hypot(*wrench.vector)))
            couples.append(abs(wrench.couple or 0.0))
    return float(np.nanmax(vectors)), float(np.nanmax(couples))


def check(balances: Sequence[Balance]) -> int:
    """That what is known sums up; gives how many sums were known."""
    force, couple = size_of(balances)
    known = 0
    for one in balances:
        vector, rest = one.missing()
        if not np.isnan(vector).any():
            known += 1
            assert np.abs(vector).max() <= CLOSE * force, (one.body, vector)
        if rest is not None and not math.isnan(rest) and not any(act.by_balance for act in one.acts):
            known += 1
            assert abs(rest) <= CLOSE * couple, (one.body, rest)
    return known


@pytest.mark.parametrize("path", chapter())
def test_forces_make_m_a_and_couples_i_alpha(path: Path) -> None:
    """Of every body at the start, and at the end, where contacts and cords are others."""
    scene = planemotion.load(path)
    known = check(acting.forces(acting.instant(scene)))
    assert known > 0 or path.stem in NO_MASS
    check(acting.forces(acting.instant(scene, last=True)))


@pytest.mark.parametrize("path", chapter())
def test_momenta_before_and_impulses_make_those_after(path: Path) -> None:
    """At the first blow."""
    scene = planemotion.load(path)
    end = acting.instant(scene, last=True)
    jumps = energies.ledger(end)
    try:
        here = acting.instant(scene, blow=True)
    except SceneError:
        here = None
    if here is None:
        assert abs(jumps.blows) <= CLOSE * jumps.size, "no blow is passed over"
    else:
        assert check(acting.blows(here)) > 0 or path.stem in NO_SUM


def keys(table: Any) -> Iterator[tuple[str, Any]]:
    """All keys of a scene as it is written, with their values."""
    for one in table if isinstance(table, list) else [table]:
        for key, value in one.items() if isinstance(one, dict) else ():
            yield key, value
            yield from keys(value)


def does_more(scene: Scene) -> bool:
    """Whether friction or drives may work in a scene."""
    works = ("friction", "friction_couple", "driven", "motor")
    return any(key in works and value != "rough" for key, value in keys(scene.table))


@pytest.mark.parametrize("path", chapter())
def test_work_makes_kinetic_energy(path: Path) -> None:
    """T1 + works + blows = T2: each is recorded by itself where nothing else works."""
    scene = planemotion.load(path)
    found = energies.ledger(acting.instant(scene, last=True))
    if not does_more(scene):
        assert abs(found.rest) <= CLOSE * found.size, found


BLOW = """
title = "A ball strikes the lower end of a rod"
until = "strike strikes"
bodies.AB = { rod = ["A", "B"], length = "1.2 m", mass = "3 kg", at = { A = [0, 0] }, angle = "-90 deg" }
bodies.ball = { mass = "0.5 kg", at = "AB.B" }
joints.A = { pin = ["AB.A", "ground"] }
contacts.strike = { touch = ["ball", "AB.B"], normal = "180 deg", restitution = 0.5 }
start.ball.velocity.x = "4 m/s"
"""


SLOWED = """
plane = "horizontal"
until = "t = 1 s"
bodies.ball = { mass = "2 kg", at = [0, 0] }
start.ball.velocity.x = "3 m/s"
events.slowed = { when = "t = 0.5 s", do = [{ impulse = "ball", value = ["-(1 kg)*ball.velocity.x", 0] }] }
"""


def shown(scene: Scene, kind: str, at: str | None = None, bodies: Sequence[str] = ()) -> str:
    with page.style():
        return texts(diagrams.figure(scene, kind, at, None, bodies))


def test_a_blow_as_the_run_begins_is_drawn_with_its_values() -> None:
    """By hand: with e = 1/2 the rod turns with omega = (1 + e) v L / (L^2 + I_A/m), I_A = M L^2/3."""
    scene = planemotion.load_text(BLOW)
    omega = 1.5 * 4 * 1.2 / (1.2**2 + 3 * 1.2**2 / 3 / 0.5)
    impulse = 3 * 1.2**2 / 3 * omega / 1.2
    drawn = shown(scene, diagrams.IMPULSE)
    for label in (
        "m v_x = 2 N*s",
        f"strike_N = {impulse:.4g} N*s",
        f"m v_x = {3 * omega * 0.6:.4g} N*s",
        f"I ω = {3 * 1.2**2 / 12 * omega:.4g} N*m*s",
        f"A_x = {3 * omega * 0.6 - impulse:.4g} N*s",
        "before: 0 | ",
        "strike, t = 0 s",
    ):
        assert label in f"{drawn} | ", label
    assert "ball" not in shown(scene, diagrams.IMPULSE, bodies=("AB",)).replace("A ball", "")


def test_free_bodies_just_before_a_blow_and_just_after_it() -> None:
    """From level to hanging: m g + m omega^2 L/2 = 5/2 m g at its hinge, m g when it is stopped."""
    scene = planemotion.load_text("""
        until = "strike"
        events.strike = "stop strikes"
        ground.points.S = [0, "-1 m"]
        bodies.rod = { rod = ["A", "B"], length = "1 m", mass = "2 kg", at = { A = [0, 0] } }
        joints.A = { pin = ["rod.A", "ground"] }
        contacts.stop = { touch = ["rod.bottom", "ground.S"] }
        ask.omega = "rod.omega"
    """)
    weight = 2 * 9.81
    for at, pull, said in (("before strike", 2.5 * weight, "before strike"), ("strike", weight, "strike")):
        drawn = shown(scene, diagrams.FREE_BODY, at)
        assert f"A_y = {pull:.4g} N" in drawn
        assert f"{said}, stop, t = " in drawn
        check(acting.forces(acting.instant(scene, at)))
    assert "stop_N" in shown(scene, diagrams.IMPULSE, "before strike")


def test_an_impulse_is_that_of_the_velocity_before_it() -> None:
    """Half of the momentum is taken: of what is left it would be half as much."""
    here = acting.instant(planemotion.load_text(SLOWED), blow=True)
    assert check(acting.blows(here)) == 1
    (act,) = acting.blows(here)[0].acts
    assert act.vector == pytest.approx([-3.0, 0.0])


TURNED = """
plane = "horizontal"
until = "t = 1 s"
bodies.A = { disk = "0.1 m", mass = "2 kg", at = [0, 0], angle = "30 deg" }
bodies.B = { disk = "0.2 m", mass = "1 kg", at = [0, 0] }
joints.shaft = { pin = ["A.center", "B.center"] }
forces.spring = { torsion = ["A", "B"], stiffness = "3 N*m", free_angle = 0 }
"""


def test_a_torsion_spring_turns_both_of_its_bodies() -> None:
    """By 3 N m / rad * 30 degrees, one against the other."""
    balances = acting.forces(acting.instant(planemotion.load_text(TURNED)))
    assert check(balances) == 4
    couples = [act.couple or 0.0 for one in balances for act in one.acts if act.label == "spring"]
    assert sorted(couples) == pytest.approx([-math.pi / 2, math.pi / 2])


def test_units_are_those_of_the_scene() -> None:
    feet = planemotion.load_text(BLOW.replace("1.2 m", "4 ft"))
    assert "N*s" not in shown(feet, diagrams.IMPULSE).replace("lb*ft*s", "")
    assert " lb*ft*s" in shown(feet, diagrams.IMPULSE)
    assert "energy [ft*lb]" in shown(feet, diagrams.ENERGY)
    assert "weight = 29.43 N" in shown(planemotion.load_text(BLOW), diagrams.FREE_BODY)


def test_a_couple_that_is_only_rounding_is_not_drawn() -> None:
    """The plate of 17.80 is held by a weld in its middle, whose couple is zero: 1e-16 N*m were shown."""
    told = shown(planemotion.load(CHAPTER / "17-080.toml"), diagrams.KINETIC)
    assert "fixed_y" in told
    assert "fixed =" not in told
    assert "e-" not in told


@pytest.mark.parametrize("kind", [diagrams.FREE_BODY, diagrams.KINETIC, diagrams.IMPULSE])
@pytest.mark.parametrize("stem", [*SAMPLE[::3], "17-SP08", "17-099"])
def test_names_keep_apart_and_inside(stem: str, kind: str) -> None:
    """No two labels overlap by more than a sliver, and each stays in its own drawing."""
    scene = planemotion.load(CHAPTER / f"{stem}.toml")
    with page.style():
        try:
            figure = diagrams.figure(scene, kind)
        except SceneError:
            assert kind == diagrams.IMPULSE
            return
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        boxes = [
            (item.get_text(), item.get_window_extent(canvas.get_renderer()))
            for item in figure.findobj(Text)
            if isinstance(item, Text) and item.get_text() and item.get_visible()
        ]
        for axes in figure.axes:
            room = axes.bbox.padded(STICKS_OUT)
            for label in axes.texts:
                extent = label.get_window_extent(canvas.get_renderer())
                assert room.contains(extent.x0, extent.y0), label.get_text()
                assert room.contains(extent.x1, extent.y1), label.get_text()
    for i, (text, box) in enumerate(boxes):
        assert figure.bbox.padded(2).contains(box.x0, box.y0), text
        assert figure.bbox.padded(2).contains(box.x1, box.y1), text
        for other, beside in boxes[:i]:
            width = min(box.x1, beside.x1) - max(box.x0, beside.x0)
            height = min(box.y1, beside.y1) - max(box.y0, beside.y0)
            assert width <= SLIVER or height <= SLIVER, (text, other)


def test_a_picture_in_python() -> None:
    scene = planemotion.load_text(BLOW)
    figure = scene.draw(as_="free-body", bodies="AB")
    assert figure._repr_png_().startswith(b"\x89PNG")
    assert "AB" in texts(figure.figure)
    assert "ball" not in texts(figure.figure).replace("A ball", "")
    assert "at the start" in texts(scene.draw().figure)
    assert "t = 0 s" in texts(scene.draw(at=0).figure)
    for options, reason in (
        ({"as_": "momentum"}, 'unknown figure "momentum"; there is free-body, kinetic'),
        ({"as_": "kinetic", "bodies": ["CD"]}, 'unknown body "CD"'),
        ({"bodies": "AB"}, "give as_ too"),
        ({"as_": "kinetic", "at": "9 s"}, "the run ends before it"),
    ):
        with pytest.raises(SceneError, match=reason):
            scene.draw(**options)
