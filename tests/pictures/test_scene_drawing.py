"""Drawings of scenes: names can be read, bodies stand where they were put."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Circle

import planemotion
from planemotion.pen import page
from planemotion.pen.sketch import Sketch
from planemotion.pictures import scene as sketch
from tests.pictures.figures import texts
from tests.scenes.parts import rod_on_pin

EVERYTHING = """
title = "All there is to draw"
until = "t = 1 s"
parameters = { L = "720 mm" }
[ground]
points = { S = ["-900 mm", "-200 mm"] }
lines = { guide = { through = [0, 0], angle = "90 deg" }, floor = { through = [0, "-400 mm"] } }
circles.arc = { center = ["900 mm", 0], radius = "250 mm" }
rows.bars = { from = ["-1.5 m", "-400 mm"], step = ["100 mm", 0], count = 4 }
[bodies]
wheel = { disk = "0.3 m", mass = "10 kg", points = { B = ["240 mm", 0] }, at = [0, 0] }
AB = { rod = ["A", "B"], length = "L", mass = "4 kg", at = { B = "wheel.B" }, angle = "~-70 deg" }
ring = { hoop = "150 mm", mass = "1 kg", at = ["700 mm", "-250 mm"] }
half = { half_ring = "120 mm", mass = "1 kg", at = ["-900 mm", "300 mm"] }
bead = { mass = "0.1 kg", at = ["900 mm", "250 mm"] }
ball = { sphere = "100 mm", mass = "1 kg", at = ["-1.4 m", 0] }
patch = { mass = "0.1 kg", at = ["0.1 m", "-100 mm"] }
[bodies.box]
plate = ["200 mm", "100 mm"]
corners = ["P", "Q", "R", "T"]
mass = "1 kg"
at = ["-700 mm", "-50 mm"]
angle = "20 deg"
[bodies.lump]
mass = "1 kg"
inertia = "0.01 kg*m^2"
points = { U = ["50 mm", 0], V = [0, "80 mm"] }
at = ["1.3 m", "300 mm"]
[joints]
C = { pin = ["wheel.center", "ground"] }
B = { pin = ["AB.B", "wheel.B"] }
A = { slider = ["AB.A", "ground.guide"] }
D = { slot = ["bead", "ground.arc"] }
E = { link = ["lump.U", "ground.S"] }
F = { rolling = ["ring.rim", "ground.floor"] }
W = { weld = ["patch", "wheel"] }
[contacts]
corners = { touch = ["box.corners", "ground.floor"] }
over = { touch = ["ball.rim", "ground.bars"] }
near = { touch = ["half.rim", "ball.rim"] }
[forces]
k = { spring = ["box.P", "ground.S"], stiffness = "100 N/m" }
c = { damper = ["AB.A", "half"], rate = "2 N*s/m" }
q = { torsion = ["lump", "ground"], stiffness = "1 N*m" }
push = { force = "lump.V", value = ["3 N", "-4 N"] }
turn = { force = "lump.V", value = { polar = ["(3 N)*(1 + t/(1 s))", "30 deg"] }, turns_with = "lump" }
motor = { couple = "wheel", value = "-1 N*m" }
"""


def start_of(text: str) -> sketch.Start:
    return sketch.start_of(planemotion.load_text(text))


def drawn(start: sketch.Start) -> Figure:
    with page.style():
        return sketch.figure(start)


@pytest.fixture(scope="module")
def everything() -> tuple[sketch.Start, Figure]:
    start = start_of(EVERYTHING)
    return start, drawn(start)


def names_in(figure: Figure) -> list[Any]:
    return [text for text in figure.axes[0].texts if text.get_text() != "g"]


def test_everything_is_named(everything: tuple[sketch.Start, Figure]) -> None:
    start, figure = everything
    assert start.fault == ""
    shown = {name for text in names_in(figure) for name in text.get_text().split(", ")}
    data = start.data
    for table in (data.bodies, data.joints, data.contacts, data.forces):
        assert set(table) <= shown
    assert {"P", "Q", "R", "T", "U", "V", "S", "guide", "floor", "arc", "bars[0]"} <= shown


def test_no_name_covers_another_or_leaves_the_picture(everything: tuple[sketch.Start, Figure]) -> None:
    _, figure = everything
    renderer = figure.canvas.get_renderer()  # type: ignore[attr-defined]
    frame = figure.axes[0].get_window_extent(renderer)
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in names_in(figure)]
    for i, (name, box) in enumerate(boxes):
        assert frame.x0 <= box.x0, name
        assert box.x1 <= frame.x1, name
        for other, there in boxes[:i]:
            assert not box.overlaps(there), (name, other)


def test_both_axes_have_one_scale_in_the_unit_of_the_file(everything: tuple[sketch.Start, Figure]) -> None:
    _, figure = everything
    [place] = figure.axes
    box = place.get_window_extent()
    (x0, x1), (y0, y1) = place.get_xlim(), place.get_ylim()
    assert box.width / (x1 - x0) == pytest.approx(box.height / (y1 - y0), rel=1e-9)
    assert place.get_xlabel() == "x [mm]"


def test_bodies_are_drawn_where_the_assembly_put_them(everything: tuple[sketch.Start, Figure]) -> None:
    start, figure = everything
    circles = {
        (round(patch.center[0], 6), round(patch.center[1], 6), round(patch.radius, 6))
        for patch in figure.axes[0].patches
        if isinstance(patch, Circle)
    }
    assert (0.0, 0.0, 300.0) in circles  # the wheel, in mm
    x, y, angle = start.poses["AB"]
    # The rod's end A lies on the guide, half a length from G.
    assert x - 0.36 * np.cos(angle) == pytest.approx(0.0, abs=1e-12)
    pins = [(cx, cy) for cx, cy, radius in circles if 1 < radius < 60]
    end = (1000 * x - 360 * np.cos(angle), 1000 * y - 360 * np.sin(angle))
    assert min(np.hypot(cx - end[0], cy - end[1]) for cx, cy in pins) < 1e-3


def test_a_start_that_cannot_be_assembled_is_drawn_as_written() -> None:
    start = start_of(f"""
until = "t = 1 s"
ground.points.P = ["2 m", 0]
{rod_on_pin(angle="30 deg")}
joints.B = {{ pin = ["AB.B", "ground.P"] }}
""")
    assert "open by" in start.fault
    assert start.poses["AB"] == pytest.approx((0.5 * np.cos(np.pi / 6), 0.25, np.pi / 6))
    figure = drawn(start)
    assert "not assembled" in texts(figure)
    gaps = [line for line in figure.axes[0].get_lines() if line.get_color() == page.RED]
    assert len(gaps) == 1  # between the rod's end and where it is pinned


def test_a_scene_of_no_size_and_a_horizontal_one() -> None:
    figure = drawn(
        start_of('until = "t = 1 s"\nplane = "horizontal"\nbodies.P = { mass = "1 kg", at = [0, 0] }\n')
    )
    assert "seen from above" in texts(figure)
    assert figure.axes[0].get_xlabel() == "x [m]"
    assert "g" not in [text.get_text() for text in figure.axes[0].texts]


def test_set_moves_the_drawing() -> None:
    scene = planemotion.load_text(f"""
until = "t = 1 s"
parameters.L = "3 ft"
{rod_on_pin(length="L")}
""")
    assert sketch.start_of(scene).poses["AB"][0] == pytest.approx(1.5 * 0.3048)
    assert sketch.start_of(scene.with_values({"L": "5"})).poses["AB"][0] == pytest.approx(2.5 * 0.3048)
    assert drawn(sketch.start_of(scene)).axes[0].get_xlabel() == "x [ft]"


def members_in(
    step: str, room: tuple[tuple[float, float], tuple[float, float]], count: str = ""
) -> np.ndarray:
    """Where the members of a row from (1 m, 0) are drawn in a picture of that room (m)."""
    start = start_of(f"""
until = "t = 1 s"
bodies.P = {{ mass = "1 kg", at = [0, 0] }}
ground.rows.bars = {{ from = ["1 m", 0], step = {step}{count} }}
""")
    low, high = (np.array(corner) for corner in room)
    with page.style():
        seen = Sketch(start.drawing, start.poses, "m", (low, high))
        sketch.SceneDrawing(start.data, seen).draw_ground()
    return np.array([patch.center for patch in seen.pen.axes.patches if isinstance(patch, Circle)])


def test_an_endless_row_goes_through_the_whole_picture() -> None:
    dense = members_in('["1 cm", 0]', ((-40.0, -1.0), (60.0, 5.0)))
    assert dense[:, 0].min() < -40
    assert dense[:, 0].max() > 60
    gaps = np.diff(np.sort(dense[:, 0]))
    assert gaps.max() == pytest.approx(gaps.min())  # a band: no member is left out that could be seen
    assert len(dense) < 400
    slanting = members_in('["3 m", "-4 m"]', ((-30.0, -30.0), (30.0, 30.0)))
    assert all(np.hypot(*(at - (1, 0))) % 5 == pytest.approx(0) for at in slanting)
    assert len(slanting) > 10


def test_a_row_that_ends_has_its_members_alone() -> None:
    assert members_in('["2 m", 0]', ((-5.0, -1.0), (50.0, 1.0)), ", count = 4")[:, 0] == pytest.approx(
        [1, 3, 5, 7]
    )
    assert len(members_in('["2 m", 0]', ((2.0, 4.0), (9.0, 11.0)))) == 0  # it passes below the picture


def test_what_touches_a_curve_is_drawn_at_its_foot() -> None:
    """A ball half a metre above the lowest place of a bowl."""
    start = start_of("""
until = "t = 1 s"
ground.curves.bowl = { x = "(1 m)*s", y = "(0.25 m)*s^2", from = -1.93, to = 2 }
bodies.ball = { disk = "0.2 m", mass = "2 kg", at = [0, "0.7 m"] }
contacts.c = { touch = ["ground.bowl", "ball.rim"] }
""")
    with page.style():
        seen = Sketch(start.drawing, start.poses, "m", (np.array([-2.0, -1.0]), np.array([2.0, 1.0])))
        (push,) = sketch.contact_pushes(seen, "c", start.data.contacts["c"])
    assert np.array(push.places) == pytest.approx(np.array([[0, 0], [0, 0.5]]), abs=1e-4)
    assert push.turn == pytest.approx(0, abs=1e-3)
