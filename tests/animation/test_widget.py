"""The player as a widget of a notebook, in a browser: two views of one model, moved and heard by Python."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import planemotion
from tests.chromium import chromium, opened
from tests.test_history import BALL

browser = chromium()

# What Jupyter gives a widget, as far as ours uses it: values, listeners, and what is sent to Python.
_MODEL = """
class Model {
  constructor(state) { this.state = state; this.listeners = {}; this.sent = []; this.changed = {}; }
  get(key) { return this.state[key]; }
  set(key, value) {
    if (this.state[key] === value) return;
    this.state[key] = this.changed[key] = value;
    (this.listeners[`change:${key}`] || []).forEach((listener) => listener());
  }
  save_changes() { this.sent.push(this.changed); this.changed = {}; }
  on(name, listener) { (this.listeners[name] = this.listeners[name] || []).push(listener); }
  off(name, listener) { this.listeners[name] = this.listeners[name].filter((one) => one !== listener); }
}
"""


@pytest.fixture(scope="module")
def made() -> Any:
    return planemotion.load_text(BALL).animate().widget()


@pytest.fixture(params=["light", "dark"])
def shown(browser: Any, made: Any, tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Any]:
    """A page with two views of the ball, as a notebook has them where a cell is shown twice."""
    state = {key: getattr(made, key) for key in ("motion", "time", "playing", "speed")}
    told = json.dumps(state).replace("</", "<\\/")
    page = f"""<!doctype html><meta charset="utf-8"><style>{made._css}</style>
    <p id="above"></p><div id="one" style="width: 700px"></div><div id="two" style="width: 1000px"></div>
    <script type="application/json" id="state">{told}</script>
    <script type="text/plain" id="module">{made._esm}</script>
    <script type="module">{_MODEL}
    const text = document.getElementById("module").textContent;
    const url = URL.createObjectURL(new Blob([text], {{ type: "text/javascript" }}));
    const widget = (await import(url)).default;
    window.model = new Model(JSON.parse(document.getElementById("state").textContent));
    const hidden = document.createElement("div"); // a view is made before it stands on the page
    window.close_one = widget.render({{ model, el: hidden }});
    document.getElementById("one").append(hidden);
    widget.render({{ model, el: document.getElementById("two") }});
    window.ready = true;
    </script>"""
    file = tmp_path / "notebook.html"
    file.write_text(page, encoding="utf-8")
    with opened(browser, file, request.param) as view:
        view.wait_for_function("window.ready && document.querySelectorAll('canvas.scene')[0].height > 150")
        yield view


def player(page: Any, what: str, view: int = 0) -> Any:
    return page.evaluate(f"document.querySelectorAll('.pm')[{view}].player.{what}")


def picture(page: Any, view: int = 0) -> str:
    return str(page.evaluate(f"document.querySelectorAll('canvas.scene')[{view}].toDataURL()"))


def test_python_moves_both_views_and_hears_them(shown: Any) -> None:
    colours = [player(shown, "colours.ink", view) for view in (0, 1)]
    assert colours[0] == colours[1] != "", "also of the view that was made before it stood on the page"
    before = picture(shown), picture(shown, 1)
    shown.evaluate("model.set('time', 0.5)")
    assert player(shown, "time") == player(shown, "time", 1) == pytest.approx(0.5)
    assert picture(shown) != before[0]
    assert picture(shown, 1) != before[1]
    shown.locator("#one .pm").press("End")
    shown.wait_for_function("model.sent.some((one) => Math.abs(one.time - 2) < 1e-6)")
    assert player(shown, "time", 1) == pytest.approx(2), "the other view follows"
    shown.evaluate("model.set('speed', 5)")
    assert player(shown, "speed") == 5
    shown.evaluate("model.set('time', 0); model.set('playing', true)")
    shown.wait_for_function("document.querySelector('.pm').player.playing === false")
    shown.wait_for_function("model.get('playing') === false && Math.abs(model.get('time') - 2) < 1e-6")
    assert len(shown.evaluate("model.sent")) < 40, "messages are spared while it plays"


def test_keys_are_for_the_view_that_has_the_focus(shown: Any) -> None:
    shown.evaluate("document.addEventListener('keydown', (event) => { window.heard = event.key; })")
    shown.locator("#above").evaluate("element => element.focus()")
    shown.keyboard.press("v")
    assert shown.evaluate("window.heard") == "v"
    assert player(shown, "shows.velocities") is False
    shown.locator("#two .pm").press("v")
    assert [player(shown, "shows.velocities", view) for view in (0, 1)] == [False, True]
    shown.locator("#two .pm").press("d")
    themes = [player(shown, "themed.dataset.theme", view) for view in (0, 1)]
    assert themes[0] != themes[1]
    shown.locator("#two .pm").press("p")
    assert shown.evaluate("window.heard") == "v", "the notebook does not hear what the player did"


def test_a_view_that_is_closed_hears_nothing(shown: Any) -> None:
    shown.evaluate("close_one()")
    shown.evaluate("model.set('time', 1)")
    assert player(shown, "time") == 0
    assert player(shown, "time", 1) == pytest.approx(1)


def test_it_fits_where_it_stands(shown: Any) -> None:
    narrow, wide = (
        shown.evaluate(f"document.querySelectorAll('.pm .stage')[{i}].clientWidth") for i in (0, 1)
    )
    assert narrow < 700 < wide <= 1000
    assert player(shown, "stage.size[0]") > 600, "below each other"
    shown.evaluate("document.getElementById('one').style.width = '900px'")
    shown.wait_for_function("document.querySelector('.pm').player.stage.size[0] < 600")
