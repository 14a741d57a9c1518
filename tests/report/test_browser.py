"""The report in a browser: it opens without an error, draws its plots, and its sliders choose the case."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import planemotion
from tests.chromium import chromium, opened
from tests.report.test_page import SCENE, SWEEP

browser = chromium()
# Two parameters: a map, two sliders, and cases without an answer.
GRID = SCENE.replace('v = "2 m/s"', 'v = "2 m/s"\ntau = "0.5 s"').replace("t = 1 s", "t = tau")
GRID += (
    '[sweep]\nv = { from = "1 m/s", to = "4 m/s", num = 21 }\n'
    'tau = { from = "0.1 s", to = "1.5 s", num = 15 }\n'
)


@pytest.fixture(params=["light", "dark"])
def theme(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def study(browser: Any, tmp_path: Path, theme: str) -> Iterator[Any]:
    file = planemotion.load_text(SWEEP).report(replays=4).save(tmp_path / "study.html")
    with opened(browser, file, theme) as page:
        yield page


def player(page: Any, what: str) -> Any:
    """Of the player in the page, once it is there."""
    page.wait_for_function("document.getElementById('player').contentDocument.querySelector('.pm')?.player")
    return page.evaluate(
        f"document.getElementById('player').contentDocument.querySelector('.pm').player.{what}"
    )


def test_a_scene_plays_in_its_report(browser: Any, tmp_path: Path, theme: str) -> None:
    file = planemotion.load_text(SCENE).report().save(tmp_path / "scene.html")
    with opened(browser, file, theme) as page:
        assert page.locator(".answers tbody tr").count() == 1
        assert player(page, "motion.look(1).poses[0].x") == pytest.approx(2, abs=0.02)
        visible = page.locator(".picture:visible")
        assert visible.count() == 1
        assert theme in visible.get_attribute("class")
        assert visible.evaluate("image => image.naturalWidth") > 100


def test_the_slider_replays_its_case(study: Any) -> None:
    ends = []
    for place in range(4):
        study.locator("#slider-0").fill(str(place))
        study.locator("#slider-0").dispatch_event("input")
        assert study.locator("#case").text_content() == f"v = {place + 1} m/s"
        study.wait_for_timeout(300)
        ends.append(player(study, "motion.look(1).poses[0].x"))
    assert ends == pytest.approx([1, 2, 3, 4], abs=0.02)


def test_a_curve_can_be_seen_on_its_paper(study: Any, theme: str) -> None:
    """Its luminance differs from that of the paper; a dark blue on dark paper was hardly seen."""
    shown = [
        study.evaluate(f"getComputedStyle(document.querySelector('{where}')).{what}")
        for where, what in (("#plot-0 path.js-line", "stroke"), ("body", "backgroundColor"))
    ]
    curve, paper = (_luminance(colour) for colour in shown)
    bright, dim = max(curve, paper), min(curve, paper)
    assert (bright + 0.05) / (dim + 0.05) > 4.5  # WCAG 2.1, 1.4.3
    assert (paper > curve) == (theme == "light")


def _luminance(colour: str) -> float:
    """Of "rgb(31, 78, 121)", relative, as WCAG 2.1 has it."""
    parts = [int(part) / 255 for part in re.findall(r"\d+", colour)[:3]]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def test_a_curve_is_drawn_hovered_over_and_zoomed(study: Any) -> None:
    plot = study.locator("#plot-0")
    assert plot.locator("path.js-line").count() == 1
    box = plot.locator(".nsewdrag").bounding_box()
    across, down = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    study.mouse.move(across, down)
    study.wait_for_selector(".hoverlayer text")
    whole = study.evaluate("document.getElementById('plot-0').layout.xaxis.range")
    study.mouse.down()
    study.mouse.move(across + 120, down)
    study.mouse.up()
    zoomed = study.evaluate("document.getElementById('plot-0').layout.xaxis.range")
    assert zoomed[1] - zoomed[0] < 0.5 * (whole[1] - whole[0])


def test_the_theme_changes_in_page_plot_picture_and_player(study: Any, theme: str) -> None:
    study.locator("#theme").click()
    other = {"light": "dark", "dark": "light"}[theme]
    assert study.evaluate("document.documentElement.dataset.theme") == other
    assert other in study.locator(".picture:visible").get_attribute("class")
    study.wait_for_function(
        "theme => document.getElementById('player').contentDocument.documentElement.dataset.theme === theme",
        arg=other,
    )


def test_a_grid_is_a_map_with_two_sliders(browser: Any, tmp_path: Path, theme: str) -> None:
    file = planemotion.load_text(GRID).report(replays=4).save(tmp_path / "grid.html")
    with opened(browser, file, theme) as page:
        assert page.locator("input[type=range]").count() == 2
        assert page.evaluate("document.getElementById('plot-0').data[0].type") == "heatmap"
        page.locator("#slider-1").fill("1")
        page.locator("#slider-1").dispatch_event("input")
        assert page.locator("#case").text_content() == "v = 1 m/s, tau = 1.5 s"
