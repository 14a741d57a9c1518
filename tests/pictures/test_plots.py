"""Pictures of sweeps and histories: what they show is read back from the figures."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from planemotion._layout import (
    PM_ASSEMBLY,
    PM_AUDITS,
    PM_LIMIT_TIME,
    PM_OK,
    PM_REASON_NOT_REACHED,
    PM_ROUTE_RK,
)
from planemotion.base.errors import StudyError
from planemotion.base.themes import THEMES
from planemotion.compile.asks import Asked
from planemotion.engine import history
from planemotion.engine.outcome import History
from planemotion.pen import page
from planemotion.pen.theme import on_paper
from planemotion.pictures.history import plot_history
from planemotion.pictures.panels import open_sweep
from planemotion.pictures.plots import plot
from planemotion.pictures.sweep import plot_sweep
from planemotion.sweep.block import Block
from planemotion.sweep.layout import Coordinate, Layout
from planemotion.sweep.netcdf import write_result
from tests.pictures.figures import png_size, texts, values_of

D = np.linspace(1.0, 6.0, 51)
OMEGA = np.linspace(1.0, 3.0, 31)


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
        solves=np.arange(cases, dtype=np.int32),
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


def test_a_bar_of_many_decades_has_plain_numbers_on_any_paper(tmp_path: Path) -> None:
    """On dark paper it had $\\mathdefault{10^{2}}$."""
    d, omega = np.meshgrid(D, OMEGA, indexing="ij")
    grids = [[axis("d", "in", D)], [axis("omega0", "rad/s", OMEGA)]]
    file = result(tmp_path / "a.h5", grids, {("n", ""): np.floor(d**4 * omega)})
    for paper in THEMES:
        with page.style(paper), open_sweep(file) as dataset:
            figure = on_paper(plot_sweep(dataset), paper)
            figure.savefig(tmp_path / "a.png")
            shown = [label.get_text() for label in figure.axes[1].get_yticklabels()]
        assert {"10", "100", "1000"} <= set(shown)
        assert "$" not in "".join(shown)


def test_a_count_that_is_the_same_in_all_cases_has_whole_ticks(tmp_path: Path) -> None:
    [place] = figure_of(result(tmp_path / "a.h5", [[axis("d", "in", D)]], {("n", ""): np.zeros(len(D))})).axes
    low, high = place.get_ylim()
    assert [tick for tick in place.get_yticks() if low <= tick <= high] == [0, 1]


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
