"""Pictures of designs show every parameter that was drawn; counts are whole; colours can be told apart."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib.colors
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from scipy.stats import spearmanr

from planemotion import load_text
from planemotion._layout import PM_LIMIT_TIME
from planemotion.pen import page, theme
from planemotion.pictures.panels import open_sweep, read_panels
from planemotion.pictures.samples import bins_of, influential, rank_correlation, samples
from planemotion.pictures.sweep import plot_sweep
from planemotion.webpage.plots import plots
from tests.pictures.figures import texts

# A ball that is thrown up and counts its bounces; a low ceiling of time ends some cases early.
BOUNCES = """
until = "t = 2 s"
[parameters]
h = "1 m"
e = 0.5
v = "0 m/s"
[bodies]
b = { mass = "1 kg", at = [0, "h"] }
[ground]
lines = { floor = { through = [0, 0] } }
[contacts]
c = { touch = ["b", "ground.floor"], restitution = "e" }
[start]
b.velocity.x = "v"
[events]
hit = "c.gap = 0 m"
half = "t = 1 s"
[ask]
far = { of = "b.x", unit = "m" }
blows = { of = "hit.count", at = "half" }
[sweep]
design = { latin = 64, seed = 3 }
h = { uniform = ["0.2 m", "3 m"] }
e = { uniform = [0.3, 0.9] }
v = { normal = ["1 m/s", "0.2 m/s"] }
"""


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("design")
    load_text(BOUNCES, file="bounces.toml").sweep(out=folder)
    return folder / "bounces.h5"


def test_each_parameter_has_a_scatter_and_each_ask_its_distribution(swept: Path) -> None:
    with page.style(), open_sweep(swept) as dataset:
        figure = plot_sweep(dataset)
        values = {name: dataset[name].values for name in ("h", "e", "v", "far", "blows")}
    FigureCanvasAgg(figure).draw()
    shown = {
        (place.get_xlabel(), place.get_ylabel()): np.asarray(place.get_lines()[0].get_xydata())
        for place in figure.axes
        if place.get_lines() and place.get_ylabel() != "part of them below"
    }
    for ask, label in (("far", "far [m]"), ("blows", "blows")):
        for parameter, across in (("h", "h [m]"), ("e", "e"), ("v", "v [m/s]")):
            np.testing.assert_array_equal(shown[across, label].T, [values[parameter], values[ask]])
    assert f"rank correlation {spearmanr(values['v'], values['far'])[0]:.2f}" in texts(figure)
    histograms = [place for place in figure.axes if place.get_ylabel() == "cases"]
    assert len(histograms) == 2
    for place in histograms:
        ticks = place.get_yticks()
        assert np.array_equal(ticks, np.round(ticks)), "cases are counted"
    whole = next(place for place in histograms if "count" in place.get_xlabel())
    assert np.array_equal(whole.get_xticks(), np.round(whole.get_xticks()))


def test_the_distribution_function_counts_the_cases(swept: Path) -> None:
    with page.style(), open_sweep(swept) as dataset:
        figure = plot_sweep(dataset)
        far = np.sort(dataset["far"].values)
    below = next(place for place in figure.axes if place.get_ylabel() == "part of them below")
    x, y = np.asarray(below.get_lines()[0].get_xydata()).T
    np.testing.assert_array_equal(x, far)
    np.testing.assert_allclose(y, np.arange(1, 65) / 64)


def test_cases_that_end_otherwise_are_a_category_over_pairs_of_parameters(tmp_path: Path) -> None:
    text = BOUNCES.replace('"t = 2 s"', '"b.x > 1.9 m"') + '[solve]\nmax_time = "2 s"\n'
    load_text(text, file="late.toml").sweep(out=tmp_path)
    with page.style(), open_sweep(tmp_path / "late.h5") as dataset:
        figure = plot_sweep(dataset)
        bad = np.count_nonzero(dataset["status"].values)
        late = np.count_nonzero(dataset["status"].values == PM_LIMIT_TIME)
    assert 0 < late <= bad < 64
    pairs = [place for place in figure.axes if place.get_ylabel() in ("e", "v [m/s]") and place.get_lines()]
    assert {(place.get_xlabel(), place.get_ylabel()) for place in pairs} == {
        ("h [m]", "e"), ("h [m]", "v [m/s]"), ("e", "v [m/s]"),
    }  # fmt: skip
    for place in pairs:
        counts = {str(line.get_label()): np.size(line.get_xdata()) for line in place.get_lines()}
        assert (counts["ok"], counts["limit time"], sum(counts.values())) == (64 - bad, late, 64)


def test_a_map_shows_by_category_how_the_cases_ended(tmp_path: Path) -> None:
    start = BOUNCES.index("[sweep]")
    grids = """[sweep]
v = { from = "0.5 m/s", to = "1.5 m/s", num = 11 }
e = { from = 0.3, to = 0.9, num = 9 }
"""
    text = BOUNCES[:start].replace('"t = 2 s"', '"b.x > 1.9 m"') + grids + '[solve]\nmax_time = "2 s"\n'
    load_text(text, file="map.toml").sweep(out=tmp_path)
    with page.style(), open_sweep(tmp_path / "map.h5") as dataset:
        figure = plot_sweep(dataset)
        status = dataset["status"].values
    place = next(one for one in figure.axes if one.get_title(loc="left") == "how the cases ended")
    shown = np.asarray(place.collections[0].get_array()).reshape(9, 11)
    assert np.array_equal(shown.T != 0, status != 0)
    legend: Any = place.get_legend()
    assert [text.get_text() for text in legend.get_texts()][:2] == ["ok", "limit time"]


def test_of_many_parameters_those_that_matter_are_shown() -> None:
    from planemotion.pictures.panels import Panel, Panels, SweptAxis

    random = np.random.default_rng(3)
    values = random.normal(size=(9, 400))
    drawn = [SweptAxis(f"p{i}", f"p{i}", one, False, True) for i, one in enumerate(values)]
    ask = Panel("a", (3 * values[7] - values[2] + 0.5 * values[4])[:, None], (), "")
    read = Panels("t", "w", [drawn[0]], None, [ask], np.zeros(400, np.intp), ["ok"], drawn)
    kept = [axis.name for axis in influential(read)]
    assert len(kept) == 5
    assert {"p2", "p4", "p7"} < set(kept)
    assert kept == sorted(kept)
    assert len(samples(read).axes) == 2 + 5, "a distribution on two scales, and the scatters"


def test_rank_correlation_is_spearmans() -> None:
    random = np.random.default_rng(1)
    x, y = random.integers(0, 9, (2, 200)).astype(float)
    y[3] = np.nan
    known = np.isfinite(y)
    assert rank_correlation(x, y) == pytest.approx(spearmanr(x[known], y[known])[0], rel=1e-12)
    assert rank_correlation(x, np.ones(200)) == 0.0


@pytest.mark.parametrize(
    "values", [np.zeros(5), np.array([3.0]), np.linspace(0, 1, 7), np.array([1e99, -1e99, 0])]
)
def test_all_values_are_in_the_bins(values: np.ndarray) -> None:
    edges = bins_of(values)
    assert np.all(np.diff(edges) > 0)
    assert edges[0] <= values.min() <= values.max() <= edges[-1]


def test_counts_have_a_bin_each() -> None:
    np.testing.assert_array_equal(bins_of(np.array([2.0, 2, 3, 5])), [1.5, 2.5, 3.5, 4.5, 5.5])


def test_a_report_has_the_same_panels(swept: Path) -> None:
    with open_sweep(swept) as dataset:
        made = plots(read_panels(dataset))
        speeds = dataset["v"].values
    assert [plot["title"] for plot in made] == ["far [m]", "blows"]
    kinds = [[one["type"] for one in plot["data"]] for plot in made]
    assert kinds == [["bar", "scatter", "scatter", "scatter"]] * 2
    np.testing.assert_allclose(made[0]["data"][3]["x"], speeds, rtol=1e-8)
    assert sum(made[0]["data"][0]["y"]) == 64, "each case is in a bar"
    assert made[0]["layout"]["xaxis4"]["title"]["text"] == "v [m/s]"


# Machado, Oliveira and Fernandes (2009), severity 1: what the colour-blind see of linear RGB.
SEEN_BY = {
    "all": np.eye(3),
    "protanopes": [[0.1523, 1.0526, -0.2049], [0.1145, 0.7863, 0.0992], [-0.0039, -0.0481, 1.052]],
    "deuteranopes": [[0.3673, 0.8606, -0.228], [0.2801, 0.6725, 0.0474], [-0.0118, 0.0429, 0.9689]],
    "tritanopes": [[1.2555, -0.0767, -0.1788], [-0.0784, 0.9308, 0.1476], [0.0047, 0.6914, 0.3039]],
}
TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])


def lab(colour: str, seen: Any) -> np.ndarray:
    """CIE L*a*b* of a colour as somebody sees it."""
    rgb = np.array(matplotlib.colors.to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    xyz = TO_XYZ @ np.clip(np.asarray(seen) @ linear, 0, 1) / (0.9505, 1.0, 1.089)
    f = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


@pytest.mark.parametrize("who", SEEN_BY)
@pytest.mark.parametrize("paper", ["light", "dark"])
def test_curves_can_be_told_apart(who: str, paper: str) -> None:
    """By 17 units of L*a*b* at least; 2 can just be seen side by side."""
    colours = list(page.CURVES) if paper == "light" else [theme._DARK[one] for one in page.CURVES]
    seen = [lab(colour, SEEN_BY[who]) for colour in colours]
    apart = {(i, j): float(np.linalg.norm(seen[i] - seen[j])) for i in range(len(seen)) for j in range(i)}
    assert min(apart.values()) > 17, min(apart, key=lambda pair: apart[pair])
