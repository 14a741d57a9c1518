"""Pictures: what they show is read back from the figures; that they can be read, by measuring their names."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import Collection
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from matplotlib.text import Text

import planemotion
from planemotion._layout import (
    PM_ASSEMBLY,
    PM_AUDITS,
    PM_LIMIT_TIME,
    PM_OK,
    PM_REASON_NOT_REACHED,
    PM_ROUTE_RK,
)
from planemotion.base.errors import StudyError
from planemotion.compile.asks import Asked
from planemotion.engine import history
from planemotion.engine.outcome import History
from planemotion.pen import page
from planemotion.pictures import scene as sketch
from planemotion.pictures.history import plot_history
from planemotion.pictures.plots import plot
from planemotion.pictures.sweep import open_sweep, plot_sweep
from planemotion.sweep.block import Block
from planemotion.sweep.layout import Coordinate, Layout
from planemotion.sweep.netcdf import write_result

D = np.linspace(1.0, 6.0, 51)
OMEGA = np.linspace(1.0, 3.0, 31)


# ---- results to draw ------------------------------------------------------------------------------------


def result(
    path: Path,
    grids: Sequence[Sequence[Coordinate]],
    values: dict[tuple[str, str], np.ndarray],
    status: np.ndarray | None = None,
) -> Path:
    """The file of a sweep over `grids`, each a group that moves together; values[key, unit] by case."""
    dims = tuple((group[0].name, len(group[0].values)) for group in grids)
    cases = int(np.prod([size for _, size in dims]))
    columns = [np.reshape(numbers, (cases, -1)).astype(float) for numbers in values.values()]
    asks = tuple(
        Asked(key, unit, 1.0, 0, column.shape[1], column.shape[1] > 1, key)
        for (key, unit), column in zip(values, columns, strict=True)
    )
    status = np.zeros(cases, np.int32) if status is None else status.astype(np.int32)
    missing = np.stack([np.isnan(column).any(axis=1) for column in columns], axis=1)
    block = Block(
        value=np.concatenate(columns, axis=1),
        reason=np.where(missing, PM_REASON_NOT_REACHED, 0).astype(np.int8),
        status=status,
        run_status=status[:, None],
        route=np.full((cases, 1), PM_ROUTE_RK, np.int8),
        audit=np.full((cases, 1, PM_AUDITS), 1e-12),
        error=np.empty((cases, 0), np.float32),
        trust=np.empty((cases, 0), np.float32),
        message={},
    )
    layout = Layout(dims, tuple(coordinate for group in grids for coordinate in group), asks)
    write_result(path, layout, [block], {"title": "A sweep", "id": "sweep"})
    return path


def axis(name: str, unit: str, values: np.ndarray, dim: str = "") -> Coordinate:
    return Coordinate(name, dim or name, unit, values)


def figure_of(path: Path) -> Figure:
    with page.style(), open_sweep(path) as dataset:
        return plot_sweep(dataset)


def texts(figure: Figure) -> str:
    return " | ".join(item.get_text() for item in figure.findobj(Text) if isinstance(item, Text))


def values_of(drawn: Collection) -> np.ma.MaskedArray[Any, Any]:
    """What a map of colours shows, with what is left out masked."""
    return np.ma.asarray(drawn.get_array())


def png_size(path: Path) -> tuple[int, int]:
    head = path.read_bytes()[:24]
    assert head.startswith(b"\x89PNG\r\n\x1a\n")
    return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")


# ---- sweeps ---------------------------------------------------------------------------------------------


def test_one_parameter_gives_a_panel_for_each_ask_with_units(tmp_path: Path) -> None:
    values = {("omega", "rad/s"): 2.385 / D, ("bars", ""): np.floor(20 / D)}
    figure = figure_of(result(tmp_path / "a.h5", [[axis("d", "in", D)]], values))
    first, second = figure.axes
    assert first.get_title(loc="left") == "omega [rad/s]"
    assert second.get_title(loc="left") == "bars"
    assert second.get_xlabel() == "d [in]"
    line = first.get_lines()[0]
    assert np.array_equal(line.get_xdata(), D)
    assert np.array_equal(line.get_ydata(), 2.385 / D)
    assert second.get_lines()[0].get_drawstyle() == "steps-mid"
    assert "A sweep" in texts(figure)
    assert "51 cases" in texts(figure)


def test_failed_cases_are_gaps_marked_and_counted(tmp_path: Path) -> None:
    status = np.full(51, PM_OK)
    status[20:23], status[40] = PM_ASSEMBLY, PM_LIMIT_TIME
    omega = np.where(status == PM_OK, D, np.nan)
    omega[5] = np.nan  # an ask that was not reached in a good case
    figure = figure_of(result(tmp_path / "a.h5", [[axis("d", "in", D)]], {("omega", "rad/s"): omega}, status))
    [place] = figure.axes
    curve, *_, marks = place.get_lines()
    assert np.count_nonzero(np.isnan(curve.get_ydata())) == 5
    assert np.array_equal(marks.get_xdata(), D[status != PM_OK])
    assert marks.get_color() == page.RED
    assert place.get_title(loc="right") == "no value in 5 of 51"
    assert "not ok (red): 3 assembly, 1 limit time" in texts(figure)


def test_a_value_between_two_gaps_is_seen(tmp_path: Path) -> None:
    omega = np.full(51, np.nan)
    omega[7] = 2.385
    figure = figure_of(result(tmp_path / "a.h5", [[axis("d", "in", D)]], {("omega", ""): omega}))
    dots = [line for line in figure.axes[0].get_lines() if line.get_marker() == "."]
    assert [np.asarray(line.get_xdata()).tolist() for line in dots] == [[D[7]]]


def test_two_parameters_give_maps(tmp_path: Path) -> None:
    d, omega = np.meshgrid(D, OMEGA, indexing="ij")
    status = np.where((d > 4) & (omega > 2.5), PM_LIMIT_TIME, PM_OK).ravel()
    speed = np.where(status.reshape(d.shape) == PM_OK, d + 10 * omega, np.nan)
    grids = [[axis("d", "in", D)], [axis("omega0", "rad/s", OMEGA)]]
    figure = figure_of(
        result(tmp_path / "a.h5", grids, {("v", "ft/s"): speed, ("n", ""): np.floor(d)}, status)
    )
    place = figure.axes[0]
    assert (place.get_xlabel(), place.get_ylabel()) == ("d [in]", "omega0 [rad/s]")
    assert place.get_title(loc="left") == "v [ft/s]"
    mesh, failed = place.collections
    shown = np.ma.filled(values_of(mesh), np.nan).reshape(len(OMEGA), len(D))
    np.testing.assert_array_equal(shown, speed.T)
    assert values_of(failed).count() == np.count_nonzero(status)
    assert place.get_title(loc="right") == f"no value in {np.count_nonzero(status)} of {status.size}"


def test_few_values_of_the_second_parameter_give_curves(tmp_path: Path) -> None:
    ratio = np.array([0.5, 1.0, 2.0])
    values = np.outer(D, ratio)
    grids = [[axis("d", "m", D)], [axis("ratio", "", ratio)]]
    figure = figure_of(result(tmp_path / "a.h5", grids, {("v", "m/s"): values, ("w", "m/s"): values}))
    curves = [
        line
        for line in figure.axes[0].get_lines()
        if line.get_label() in ("ratio = 0.5", "ratio = 1", "ratio = 2")
    ]
    assert [np.asarray(line.get_ydata())[-1] for line in curves] == [3.0, 6.0, 12.0]
    assert "ratio = 2" in [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def test_lists_zips_and_held_parameters_are_told(tmp_path: Path) -> None:
    few = np.linspace(1.0, 2.0, 9)
    grids = [
        [axis("m", "kg", D), axis("r", "m", 0.1 * D, "m")],
        [axis("d", "m", np.linspace(1, 2, 8))],
        [axis("e", "", few[:2])],
    ]
    cases = 51 * 8 * 2
    figure = figure_of(result(tmp_path / "a.h5", grids, {("v", "m/s"): np.arange(cases)}))
    assert figure.axes[0].get_xlabel() == "m [kg], moving r too"
    assert "at e = 1 (the first of 2)" in texts(figure)
    figure = figure_of(
        result(tmp_path / "b.h5", [[axis("d", "m", few)]], {("v", "m/s"): np.outer(few, [1, 2, 3])})
    )
    legend = figure.axes[0].get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == ["1", "2", "3"]


@pytest.mark.parametrize("values", [np.full(51, np.nan), np.zeros(51), np.full(51, 1e300), 10.0 ** (-D * 8)])
def test_odd_values_can_be_drawn(tmp_path: Path, values: np.ndarray) -> None:
    path = result(tmp_path / "a.h5", [[axis("d", "", D)]], {("v", ""): values})
    assert min(png_size(plot(path))) > 100


def test_odd_grids_can_be_drawn(tmp_path: Path) -> None:
    one = [[axis("d", "", D[:1])]]
    assert plot(result(tmp_path / "one.h5", one, {("v", ""): D[:1]})).exists()
    log = [[axis("d", "", np.geomspace(1, 1e4, 60))]]
    figure = figure_of(result(tmp_path / "log.h5", log, {("v", ""): np.geomspace(1, 1e4, 60)}))
    assert (figure.axes[0].get_xscale(), figure.axes[0].get_yscale()) == ("log", "log")
    assert [text.get_text() for text in figure.axes[0].get_xticklabels()][1:-1] == [
        "1",
        "10",
        "100",
        "1000",
        "10000",
    ]
    two = [[axis("d", "", D)], [axis("e", "", OMEGA)]]
    figure = figure_of(result(tmp_path / "map.h5", two, {("v", ""): np.geomspace(1, 1e4, 51 * 31)}))
    FigureCanvasAgg(figure).draw()
    assert "10000" in texts(figure)
    assert "$" not in texts(figure)
    large = [[axis("d", "", np.arange(3000.0))], [axis("e", "", np.arange(400.0))]]
    figure = figure_of(result(tmp_path / "large.h5", large, {("v", ""): np.arange(3000.0 * 400)}))
    assert values_of(figure.axes[0].collections[0]).size < 1200 * 400
    assert "1200000 cases" in texts(figure)


def test_a_picture_appears_whole_or_not_at_all(tmp_path: Path) -> None:
    path = result(tmp_path / "a.h5", [[axis("d", "", D)]], {("v", ""): D})
    for place in (tmp_path / "missing" / "p.png", path / "p.png"):
        with pytest.raises(StudyError, match=r"p\.png"):
            plot(path, place)
    assert [found.name for found in tmp_path.iterdir()] == ["a.h5"]


# ---- histories ------------------------------------------------------------------------------------------


def recorded() -> History:
    time = np.array([0.0, 0.1, 0.2, 0.2, 0.3])
    mark = np.array([0, 0, history.BEFORE, history.AFTER, 0], np.int32)
    columns = {
        "A.x": time,
        "A.velocity.x": 2 * time,
        "floor.force.x": 0 * time,
        "floor.force.y": time,
        "energy.total": time,
    }
    units = {
        "A.x": "m",
        "A.velocity.x": "m/s",
        "floor.force.x": "N",
        "floor.force.y": "N",
        "energy.total": "N*m",
    }
    return History(time, columns, units, mark, PM_LIMIT_TIME)


def test_a_history_is_read_as_it_was_written(tmp_path: Path) -> None:
    path = tmp_path / "h.h5"
    history.write(path, {"": recorded()}, {"title": "A fall"})
    assert history.is_history(path)
    runs, attributes = history.read(path)
    assert attributes["title"] == "A fall"
    assert list(runs) == [""]
    assert runs[""].status == PM_LIMIT_TIME
    assert runs[""].units["energy.total"] == "J"
    for name, values in recorded().columns.items():
        np.testing.assert_array_equal(runs[""].columns[name], values)
    assert history.event_times(runs[""]).tolist() == [0.2]


def test_a_history_shows_each_kind_and_the_events(tmp_path: Path) -> None:
    path = tmp_path / "h.h5"
    history.write(path, {"low": recorded(), "high": recorded()}, {"title": "A fall"})
    runs, _ = history.read(path)
    with page.style():
        figure = plot_history(runs, "A fall")
    assert len(figure.axes) == 8
    titles = [place.get_title(loc="left") for place in figure.axes[::2]]
    assert titles == ["energies [J]", "positions [m]", "velocities [m/s]", "forces [N]"]
    assert figure.axes[-1].get_xlabel() == "t [s]"
    assert {place.get_title(loc="right") for place in figure.axes[:2]} == {"run low", "run high"}
    for place in figure.axes:
        upright = [line for line in place.get_lines() if np.array_equal(line.get_xdata(), [0.2, 0.2])]
        assert len(upright) == 1
    assert min(png_size(plot(path))) > 300


# ---- scenes ---------------------------------------------------------------------------------------------

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
    start = start_of("""
until = "t = 1 s"
ground.points.P = ["2 m", 0]
bodies.AB = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = [0, 0] }, angle = "30 deg" }
joints = { A = { pin = ["AB.A", "ground"] }, B = { pin = ["AB.B", "ground.P"] } }
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
    scene = planemotion.load_text("""
until = "t = 1 s"
parameters.L = "3 ft"
bodies.AB = { rod = ["A", "B"], length = "L", mass = "1 kg", at = { A = [0, 0] } }
joints.A = { pin = ["AB.A", "ground"] }
""")
    assert sketch.start_of(scene).poses["AB"][0] == pytest.approx(1.5 * 0.3048)
    assert sketch.start_of(scene.with_values({"L": "5"})).poses["AB"][0] == pytest.approx(2.5 * 0.3048)
    assert drawn(sketch.start_of(scene)).axes[0].get_xlabel() == "x [ft]"
