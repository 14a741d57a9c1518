"""Evidence for the chapter beside the reference figures: other routes in time, and audits that close."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from planemotion.compile.flatten import FlatScene, flatten
from planemotion.engine import call
from planemotion.engine.result import collect
from planemotion.scene import Scene
from tests import CHAPTER
from tests.chapter17 import gallery
from tests.chapter17.change import Change
from tests.chapter17.chapter import (
    DECLINED,
    ENDS_EARLY,
    LEFT_OUT,
    SCENES,
    TIME_ROUTES,
    errors,
    load,
    on_route,
    residual,
    run,
    why_not,
)
from tests.chapter17.observer import half_written, transformed
from tests.scenes import numbers

# What another route may differ by: it is a check of the physics, the figures themselves are known to 1e-8.
BETWEEN_ROUTES = 1e-6
# What an answer may differ by for another observer.
BETWEEN_OBSERVERS = 1e-7
OBSERVERS = {
    "turned": Change(phi=0.7),
    "mirrored": Change(mirrored=True),
    "rescaled": Change(length=3.7, time=0.6, mass=2.3),
}
# What the audit of a default run may leave open; the engine itself fails a run at 1e-6.
AUDIT = 1e-9
# The root of a difference of energies that nearly cancel, after some 500 blows: the rate at which the sphere
# comes over its last bar is a two-hundredth of what it began with; errors grow as the square of that.
BETWEEN_ROUTES_LAST = {("17-C3", "check_omega_last"): 1e-4}


COMPARED = [
    pytest.param(path, route, id=f"{path.stem}-{route}")
    for path in SCENES
    for route in TIME_ROUTES
    if (path.stem, route) not in (*LEFT_OUT, *DECLINED, *ENDS_EARLY)  # that they are as said is tested below
]


@pytest.mark.parametrize(("path", "route"), COMPARED)
def test_a_route_in_time_gives_the_same(path: Path, route: str) -> None:
    """Where no time passes the status says that the route has shown nothing; the answers are there."""
    still = set(run(path).route) <= {"state", "jump"}
    result = run(path, route)
    assert result.status == ("no_time_route" if still else run(path).status), result.error
    wrong = {
        key: error
        for key, error in errors(result, run(path).asks)
        if not error <= BETWEEN_ROUTES_LAST.get((path.stem, key), BETWEEN_ROUTES)
    }
    assert wrong == {}


@pytest.mark.parametrize(("stem", "route"), ENDS_EARLY)
def test_what_a_route_answers_before_it_fails_is_right(stem: str, route: str) -> None:
    """Only the last of a list of values, at the place itself, is missing or is hardly known."""
    path = CHAPTER / f"{stem}.toml"
    early, whole = run(path, route), run(path)
    assert early.status in ENDS_EARLY[stem, route]
    assert early.status != "ends_singular" or "before" in early.error
    for key, ask in whole.asks.items():
        values, right = numbers(early.asks[key].value), numbers(ask.value)
        error = numbers(early.asks[key].error)[-1]
        assert values[-1] is None or error is None or abs(values[-1] - right[-1]) <= error
        assert values[:-1] == pytest.approx(right[:-1], rel=BETWEEN_ROUTES, abs=0)


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_the_audit_closes(path: Path) -> None:
    assert residual(run(path)) <= AUDIT


@pytest.mark.parametrize(("stem", "route"), LEFT_OUT)
def test_a_find_that_takes_too_long_is_right_where_it_was_found(stem: str, route: str) -> None:
    """One run on the route, with what the default route found, does what is sought."""
    path = CHAPTER / f"{stem}.toml"
    raw = load(path).table
    left, right = raw.pop("find")["where"].split("=")
    raw["ask"] = {side: {"of": of, "unit": "rad/s"} for side, of in (("left", left), ("right", right))}
    values = {name: f"{found.value!r} {found.unit}" for name, found in run(path).found.items()}
    result = on_route(Scene.from_table(raw), route).run(**values)
    assert (result.status, result.route) == ("ok", (route,))
    assert result.left == pytest.approx(result.right, rel=BETWEEN_ROUTES)


@pytest.mark.parametrize(("stem", "route"), DECLINED)
def test_what_a_route_does_not_take_it_declines(stem: str, route: str) -> None:
    """Nothing is declined unseen, and nothing is answered then."""
    result = run(CHAPTER / f"{stem}.toml", route)
    assert result.status == "unsupported"
    assert f'solve.route = "{route}": this route does not compute the motion' in result.error
    assert all(ask.value is None for ask in result.asks.values())


def test_what_is_left_out_is_there() -> None:
    assert {stem for stem, _ in LEFT_OUT} <= {path.stem for path in SCENES}


def test_the_index_page_is_up_to_date() -> None:
    there = gallery.PAGE.read_text(encoding="utf-8").splitlines()
    assert there == gallery.page().splitlines(), "run `make gallery`"


@pytest.mark.parametrize("route", TIME_ROUTES)
def test_most_of_what_moves_is_compared(route: str) -> None:
    """What the engine declines may not grow unnoticed: nine of ten scenes that move at all are compared."""
    moving = [path for path in SCENES if not {"state", "jump"} >= set(run(path).route)]
    assert len([path for path in moving if not why_not(path, route)]) > 0.9 * len(moving)


def seen_by(flat: FlatScene, change: Change) -> FlatScene:
    """The scene turned, mirrored or rescaled; a start that is half written allows only quarter turns."""
    if change.phi and half_written(flat):
        change = Change(phi=math.pi / 2)
    return transformed(flat, change)


@pytest.mark.parametrize("observer", OBSERVERS)
@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_another_observer_finds_the_same(path: Path, observer: str) -> None:
    data = load(path).data
    flats = [flatten(data, name) for name in data.runs] or [flatten(data)]
    seen = [seen_by(flat, OBSERVERS[observer]) for flat in flats]
    runs = [(flat, call.run_cases(flat, np.atleast_2d(flat.defaults))) for flat in seen]
    result = collect(data.id, data.file, tuple(data.ask), runs)
    assert result.status == run(path).status, result.error
    wrong = {key: error for key, error in errors(result, run(path).asks) if not error <= BETWEEN_OBSERVERS}
    assert wrong == {}
