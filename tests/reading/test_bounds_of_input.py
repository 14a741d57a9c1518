"""What is written too deep, too long, too large or nowhere is told at once, with its place and the bound."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from planemotion import SceneError, load, load_text
from planemotion.base import bounded
from planemotion.scene import Scene
from planemotion.sweep.plan import plan_sweep

SCENE = 'until = "t = 1 s"\nbodies.P = { mass = "1 kg", at = [0, 0] }\nparameters.L = "1 m"\n'
STEPS = 'ask.a = { of = "P.x", at = { each = "t", values = { from = "0 s", to = "1 s", %s } } }'


def message(more: str) -> str:
    """What is said of the scene with `more` in it, wherever that is noticed before it is run."""

    def prepare() -> None:
        scene = load_text(SCENE + more, file="x.toml")
        scene.tables()
        if scene.data.sweep.grids:
            plan_sweep(scene)

    with pytest.raises(SceneError) as caught:
        prepare()
    assert caught.value.file in ("x.toml", None)
    return str(caught.value)


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("parameters.q = " + "[" * 5000 + "]" * 5000, "tables and lists more than 32 levels deep"),
        ("parameters.q = " + "[" * 40 + "]" * 40, "tables and lists more than 32 levels deep"),
        (".".join(["a"] * 100_000) + " = 1", "x.toml:4: a key more than 32 levels deep"),
        (".".join(["'a'"] * 40) + " = 1", "tables and lists more than 32 levels deep"),
        ("parameters.q = " + "9" * 5000, "x.toml:4: this is not TOML: an integer of more than 4000 digits"),
        ("parameters.q = 1" + "_000" * 1000, "parameters.q: an integer of about 3001 digits; at most 309"),
        ("parameters.q = 0x" + "f" * 5000, "parameters.q: an integer of about 6021 digits; at most 309"),
        ('title = "' + "x" * 100_001 + '"', "title: a text of 100001 characters; at most 100000 are read"),
        ("x" * 201 + " = 1", "a key of 201 characters; at most 200 are read"),
        ('title = "a\\u0000b"', "title: a text with a character that no file can hold"),
        ("solve.max_steps = 2147483648", "solve.max_steps = 2147483648: less than or equal to 2147483647"),
        (
            "solve.max_events = 99999999999",
            "solve.max_events = 99999999999: less than or equal to 2147483647",
        ),
        (
            'events.e = { when = "t = 1 s", nth = 2147483648 }',
            "events.e.nth = 2147483648: less than or equal",
        ),
        (
            'events.e = "t = 1 s"\nask.a = { of = "P.x", at = "e 99999999999" }',
            'ask.a.at = "e 99999999999": firings are counted with at most 9 digits',
        ),
        ("sweep.L = { from = 1, to = 2, step = 1e-320 }", "sweep.L.step = 1e-320: the steps are too small"),
        (
            "sweep.L = { from = 1, to = 2, step = 1e-9 }",
            "sweep.L.step = 1e-09: these are 1e+09 values; at most",
        ),
        (STEPS % 'step = "1e-320 s"', 'ask.a.at.values.step = "1e-320 s": the steps are too small'),
        (STEPS % 'step = "1e-9 s"', 'step = "1e-9 s": these are 1e+09 values; at most 100000 values are'),
        (
            STEPS % "num = 1000000000",
            "ask.a.at.values.num = 1000000000: these are 1e+09 values; at most 100000",
        ),
    ],
)
def test_what_is_beyond_a_bound_is_told_with_it(more: str, said: str) -> None:
    begun = time.monotonic()
    assert said in message(more)
    assert time.monotonic() - begun < 5


def _endless() -> list[Any]:
    endless: list[Any] = []
    endless.append(endless)
    return endless


@pytest.mark.parametrize("value", [_endless(), {"a": _endless()}, 10**400, "half \ud800 a pair", {1: 2}])
def test_the_builder_has_the_same_bounds(value: Any) -> None:
    with pytest.raises(SceneError):
        Scene("x").body("A", mass=value).data  # noqa: B018
    with pytest.raises(SceneError):
        Scene.from_table({"until": value}).data  # noqa: B018


def test_a_chain_of_parameters_may_be_as_long_as_the_scene() -> None:
    chain = "".join(f'parameters.p{i} = "p{i - 1} + 1"\n' for i in range(2999, 0, -1))
    scene = load_text(SCENE + chain + 'parameters.p0 = 1\nask.last = "p2999"')
    assert scene.run().last == 3000
    circle = message(chain + 'parameters.p0 = "p2999"')
    assert "in a circle: p2999 -> p2998 -> " in circle
    assert circle.endswith("-> ... 2989 more ... -> p2999")
    assert len(circle) < 300


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("/dev/zero", "it is larger than 10000000 bytes"),
        ("a\0b", "a path has no character NUL"),
        ("/", "directory"),
    ],
)
def test_what_is_no_file_is_told(path: str, said: str) -> None:
    with pytest.raises(SceneError, match=said):
        load(path)


def test_a_pipe_is_read_and_one_that_nobody_writes_does_not_hang(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bounded, "_PATIENCE", 0.2)
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with pytest.raises(SceneError, match=r"nothing was written into it for 0\.2 s"):
        load(pipe)
    monkeypatch.setattr(bounded, "_PATIENCE", 20.0)
    with subprocess.Popen([sys.executable, "-c", f"open({str(pipe)!r}, 'w').write({SCENE!r})"]):
        assert load(pipe).data.id == "pipe"
