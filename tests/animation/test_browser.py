"""The player in a browser: it opens without an error, moves, scrubs, and hears the keyboard, light and dark.

`make test-browser` installs Chromium and Playwright and lets no test be skipped.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import planemotion
from tests import STUDIES
from tests.chromium import chromium, opened
from tests.test_history import BALL

browser = chromium()


@pytest.fixture(params=["light", "dark"])
def player(browser: Any, tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Any]:
    """A page with the ball; errors in its console and requests to elsewhere are failures."""
    file = planemotion.load_text(BALL).animate().save(tmp_path / "ball.html")
    with opened(browser, file, request.param) as page:
        assert page.evaluate("document.documentElement.dataset.theme") == request.param
        yield page


def state(page: Any, name: str) -> Any:
    return page.evaluate(f"document.querySelector('.pm').player.{name}")


def picture(page: Any) -> str:
    """The pixels of the scene."""
    return str(page.evaluate("document.querySelector('canvas.scene').toDataURL()"))


def test_it_plays_pauses_and_stops_at_the_end(player: Any) -> None:
    first = picture(player)
    player.keyboard.press("Space")
    player.wait_for_function("document.querySelector('.pm').player.time > 0.05")
    assert picture(player) != first
    player.keyboard.press("Space")
    assert state(player, "playing") is False
    stopped = state(player, "time")
    player.wait_for_timeout(150)
    assert state(player, "time") == stopped
    for _ in range(12):
        player.keyboard.press("ArrowUp")
    player.get_by_role("button", name="Play").click()
    player.wait_for_function("document.querySelector('.pm').player.playing === false")
    assert state(player, "time") == pytest.approx(2)


def test_the_time_axis_scrubs(player: Any) -> None:
    axis = player.get_by_role("slider", name="time")
    box = axis.bounding_box()
    player.mouse.move(box["x"] + 14, box["y"] + 25)
    player.mouse.down()
    player.mouse.move(box["x"] + box["width"] / 2, box["y"] + 25)
    player.mouse.up()
    assert state(player, "time") == pytest.approx(1, abs=0.01)
    assert float(axis.get_attribute("aria-valuenow")) == pytest.approx(1, abs=0.01)


def test_events_are_stepped_through_on_the_side_after_the_blow(player: Any) -> None:
    player.keyboard.press("n")
    assert player.locator(".what").text_content() == "top"
    player.get_by_role("button", name="next event").click()
    assert player.locator(".what").text_content() == "floor"
    speed = player.evaluate(
        "(() => { const p = document.querySelector('.pm').player;"
        " return between(p.motion.bodies[0].vy, p.motion.look(p.time, p.row).at); })()"
    )
    assert speed > 0, "it goes up again"
    assert "0.980" not in (player.locator(".clock").text_content() or "")
    player.keyboard.press("p")
    assert player.locator(".what").text_content() == "top"


def test_the_ball_is_drawn_where_it_is(player: Any) -> None:
    """At 0.1 s: y = 1 + 0.3 - g/200, x = 0.2 m, in the player's own coordinates."""
    x, y = player.evaluate(
        "(() => { const m = document.querySelector('.pm').player.motion, l = m.look(0.1);"
        " return [l.poses[0].x, l.poses[0].y]; })()"
    )
    assert x == pytest.approx(0.2, abs=2e-3)
    assert y == pytest.approx(1.3 - 9.81 / 200, abs=4e-3)


@pytest.mark.parametrize(
    ("key", "shows"), [("v", "velocities"), ("l", "names"), ("c", "follow"), ("t", "traces")]
)
def test_keys_show_and_hide(player: Any, key: str, shows: str) -> None:
    player.keyboard.press("n")
    player.keyboard.press("n")
    before, picture_before = state(player, f"shows.{shows}"), picture(player)
    player.keyboard.press(key)
    assert state(player, f"shows.{shows}") is not before
    if shows != "traces":  # a ball that turns has none at first
        assert picture(player) != picture_before
    button = player.locator(f"button[data-shows={shows}]")
    assert button.get_attribute("aria-pressed") == str(not before).lower()


def test_the_theme_changes(player: Any) -> None:
    before, colour = picture(player), player.evaluate("getComputedStyle(document.body).backgroundColor")
    player.keyboard.press("d")
    assert picture(player) != before
    assert player.evaluate("getComputedStyle(document.body).backgroundColor") != colour


def test_the_wheel_zooms_and_a_double_click_shows_all(player: Any) -> None:
    scene = player.locator("canvas.scene")
    before = picture(player)
    scene.hover()
    player.mouse.wheel(0, -400)
    player.wait_for_function("document.querySelector('.pm').player.stage.zoom > 1.2")
    assert picture(player) != before
    zoomed = picture(player)
    scene.dblclick()
    assert picture(player) != zoomed
    assert [state(player, "stage.zoom"), *state(player, "stage.shift")] == [1, 0, 0]


def test_a_click_on_a_name_traces_it(player: Any) -> None:
    player.keyboard.press("n")
    before = picture(player)
    x, y, wide, high = player.evaluate("document.querySelector('.pm').player.stage.boxes[1]")
    player.locator("canvas.scene").click(position={"x": x + wide / 2, "y": y + high / 2})
    assert state(player, "stage.traced.size") == 1
    assert picture(player) != before


def test_the_player_keeps_the_time_of_the_frames(browser: Any, tmp_path: Path) -> None:
    """The pace, the freshness of a blow and the lengths of arrows are the same numbers in both."""
    shown = planemotion.load_text(BALL).animate(show="velocities,slow", theme="dark")
    beside = shown.beside
    strike = float(beside.timing.events[1])
    with opened(browser, shown.save(tmp_path / "ball.html"), "light") as page:
        assert page.evaluate("document.documentElement.dataset.theme") == "dark"
        pressed = "[...document.querySelectorAll('[aria-pressed=true]')].map((one) => one.dataset.shows)"
        assert set(page.evaluate(pressed)) == {"names", "velocities", "traces", "slow"}
        assert not page.get_by_label("energies over time").is_visible()
        player = "document.querySelector('.pm').player"
        for time in (0.1, 0.3, strike - 0.05, strike + 0.003, strike + 0.02, 1.7):
            page.evaluate(f"{player}.seek({time})")
            pace = page.evaluate(f"{player}.pace()")
            assert pace == pytest.approx(float(beside.timing.pace(np.array([time]))[0]), rel=1e-3)
            seen, fresh = beside.timing.fresh(time), page.evaluate(f"{player}.blow()?.fresh")
            assert (fresh is None) == (seen is None)
            assert seen is None or fresh == pytest.approx(seen[1], abs=1e-3)
        page.keyboard.press("e")
        assert page.get_by_label("energies over time").is_visible()


def test_in_a_frame_of_a_notebook_all_of_it_is_seen(browser: Any, tmp_path: Path) -> None:
    shown = planemotion.load_text(BALL).animate()
    host = tmp_path / "notebook.html"
    host.write_text(f'<div style="width: 620px">{shown._repr_html_()}</div>', encoding="utf-8")
    with opened(browser, host, "light") as page:
        inner = page.frames[1]
        inner.wait_for_selector(".keys")
        tall = page.evaluate("document.querySelector('iframe').clientHeight")
        assert inner.evaluate("document.querySelector('.pm').scrollHeight") <= tall + 4 or tall == 1000
        assert tall > 750, "the column is narrow: what stands beside the scene stands below it"


def test_names_of_a_crowded_scene_keep_apart(browser: Any, tmp_path: Path) -> None:
    """Gears on bearings, names within a tenth of the picture: some have lines to their places."""
    file = planemotion.load(STUDIES / "gear_train.toml").animate().save(tmp_path / "gears.html")
    with opened(browser, file, "light") as page:
        boxes = state(page, "stage.boxes")
        assert len(boxes) > 12
        for (x, y, wide, tall), (other_x, other_y, other_wide, other_tall) in combinations(boxes, 2):
            across = min(x + wide, other_x + other_wide) - max(x, other_x) - 6  # each box has 3 pixels around
            down = min(y + tall, other_y + other_tall) - max(y, other_y) - 6
            assert across <= 0 or down <= 0
