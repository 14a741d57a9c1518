"""A quick part of `make stress`: ida beside the default on some scenes, and what the table must see."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

import planemotion
from tests import CHAPTER, ROOT
from tests.stress import routes
from tests.stress.routes import Outcome, Source, compared, outcome, sources

STUDIES = ("thrown_ball", "cart_pendulum", "brachistochrone", "hinged_rod", "shaken_upright")


def _study(name: str) -> Source:
    return name, partial(planemotion.load, ROOT / f"studies/{name}.toml")


def test_all_scenes_are_there() -> None:
    names = [name for name, _ in sources()]
    assert len(names) == len(set(names))
    assert {*STUDIES, "linkage_c5", "17-001", *routes.EXPLAINED} <= set(names)
    assert len(names) >= len(list(CHAPTER.glob("*.toml")))


@pytest.mark.parametrize("name", STUDIES)
def test_ida_agrees_with_the_default(name: str) -> None:
    found = outcome(_study(name))
    assert (found.word, found.is_wrong) == ("agrees", False), found
    assert found.difference <= routes.AGREES


def test_scenes_of_the_chapter_agree() -> None:
    found = [outcome(one) for one in sources() if one[0].startswith("17-01")]
    assert [one for one in found if one.word not in ("agrees", "declined")] == []
    assert sum(one.word == "agrees" for one in found) > 5


def test_what_differs_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """The harness itself: a route that is off, one that ends, and a process that falls."""
    run = routes.call.run_cases

    def off(flat: object, param: object) -> object:
        results = run(flat, param)  # type: ignore[arg-type]
        if flat is not first:
            results.out[...] *= 1 + 1e-7
        return results

    name, make = _study("thrown_ball")
    first: object = None
    flats = routes._flat

    def kept(scene: planemotion.Scene, route: str) -> object:
        nonlocal first
        flat = flats(scene, route)
        first = flat if route == "auto" else first
        return flat

    monkeypatch.setattr(routes, "_flat", kept)
    monkeypatch.setattr(routes.call, "run_cases", off)
    found = compared(name, make)
    assert (found.word, found.is_wrong) == ("differs", True)
    assert found.difference == pytest.approx(1e-7, rel=1e-3)
    monkeypatch.setattr(routes, "compared", lambda *_: routes.sys.exit(3))
    assert outcome((name, make)).detail == "exit status 3"


def test_only_what_is_explained_may_end_without_an_answer() -> None:
    known, other = next(iter(routes.EXPLAINED)), "17-001"
    assert not Outcome(known, "no answer").is_wrong
    assert Outcome(other, "no answer").is_wrong


def test_what_cancels_is_compared_with_the_greatest_of_its_unit() -> None:
    flat = routes._flat(_study("thrown_ball")[1](), "auto")
    width = sum(ask.count for ask in flat.asks)
    out, error = np.full((1, width), 1e-9), np.zeros((1, width))
    out[0, 0] = 3.0
    size = routes.sizes(flat, out, error)
    same = [ask.unit == flat.asks[0].unit for ask in flat.asks for _ in range(ask.count)]
    assert np.all(size[0, same] == 3.0)
