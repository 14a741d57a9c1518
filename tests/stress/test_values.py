"""A quick part of `make stress`: scenes with other values on two routes, and what the table must see."""

from __future__ import annotations

import numpy as np
import pytest

import planemotion
from tests import ROOT
from tests.stress import values
from tests.stress.values import AGREES, DIFFERS, TOLD, Found, compared, names

SCENES = ("studies/pendulum.toml", "studies/chapter17/17-C2.toml", "studies/chapter17/17-017.toml")


def test_all_scenes_are_there() -> None:
    assert len(names()) == len(set(names())) > 162
    assert set(SCENES) <= set(names())


@pytest.mark.parametrize("name", SCENES)
def test_routes_agree_at_other_values(name: str) -> None:
    found = compared(name, "rk", first=1, cases=4, by=0.15)
    assert found.differs == []
    assert found.words.total() == 4
    assert found.words[AGREES] + found.words[TOLD] >= 3


def test_counts_stay_and_values_change() -> None:
    scene = planemotion.load(ROOT / "studies/geneva_drive.toml")
    flat = values._flat(scene, "auto")
    param = values.changed(scene, flat, np.random.default_rng(1), 3, 0.15)
    n = flat.parameters.index("n")
    assert (param[:, n] == flat.defaults[n]).all()
    others = np.delete(param, n, axis=1) != np.delete(np.asarray(flat.defaults), n)
    assert others.all()


def test_what_differs_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    run, calls = values.call.run_cases, []

    def off(flat: object, param: object) -> object:
        results = run(flat, param)  # type: ignore[arg-type]
        calls.append(flat)
        if len(calls) == 2:
            results.out[...] *= 1 + 1e-4
        return results

    monkeypatch.setattr(values.call, "run_cases", off)
    found: Found = compared(SCENES[0], "rk", first=1, cases=2, by=0.15)
    assert found.words[DIFFERS] == 2
    assert "times what is told" in found.differs[0]
