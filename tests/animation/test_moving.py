"""What a player is given: signs on their carriers, where the drawing has them, at any time of the run."""

from __future__ import annotations

import base64
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import planemotion
from planemotion.animation import moving, needs, video
from planemotion.animation.beside import Beside
from planemotion.animation.document import document
from planemotion.animation.page import page
from planemotion.base.errors import StudyError
from planemotion.engine.history import AFTER
from planemotion.pictures.scene import SceneDrawing
from tests.cli.calls import invoke, left_in, write
from tests.test_history import BALL

EVERYTHING = """
id = "all"
title = "All </script> signs"
until = "t = 0.4 s"
[bodies]
AB = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = [0, 0] }, angle = "-20 deg" }
wheel = { disk = "0.2 m", mass = "1 kg", at = ["2 m", "0.2 m"] }
lump = { mass = "1 kg", at = ["-1 m", "-1 m"], inertia = "1 kg*m^2", points = POINTS }
p = { mass = "1 kg", at = ["3 m", "1 m"] }
[ground]
points = { S = ["-1 m", "1 m"] }
lines = { floor = { through = [0, 0] } }
[joints]
A = { pin = ["AB.A", "ground"] }
[contacts]
floor = { touch = ["wheel.rim", "ground.floor"], friction = "rough" }
[couplings]
[forces]
spring = { spring = ["lump.V", "ground.S"], stiffness = "20 N/m", free_length = "1 m" }
push = { force = "wheel.center", value = ["2 N", 0] }
[events]
low = "AB.angle = -60 deg"
""".replace("POINTS", '{ V = ["0.2 m", 0], W = [0, "0.3 m"] }')


def unpacked(told: dict[str, Any]) -> np.ndarray:
    """As the player reads it."""
    if "one" in told:
        return np.full(told["n"], told["one"])
    if "f" in told:
        return np.frombuffer(base64.b64decode(told["f"]), "<f4").astype(float)
    steps = np.frombuffer(base64.b64decode(told["u"]), "<u2").astype(float)
    return np.asarray(told["low"] + steps * (told["high"] - told["low"]) / 65535)


@pytest.fixture(scope="module")
def motion() -> moving.Motion:
    return moving.record(planemotion.load_text(EVERYTHING))


def test_signs_are_where_the_drawing_has_them(motion: moving.Motion) -> None:
    told = document(Beside(motion))
    bodies = [
        [unpacked(body[key]) if body[key] else 0 * unpacked(told["t"]) for key in ("x", "y", "angle")]
        for body in told["bodies"]
    ]
    size = max(told["box"][2] - told["box"][0], told["box"][3] - told["box"][1])
    followed_at = unpacked(told["followed"]["t"])
    ways = [
        (unpacked(x), unpacked(y)) for x, y in zip(told["followed"]["x"], told["followed"]["y"], strict=True)
    ]
    ground = motion.sketch(0)
    SceneDrawing(motion.data, ground).draw_ground()
    for row in motion.rows(9):
        drawn = [*ground.signs.signs, *motion.signs(row)]
        assert len(drawn) == len(told["signs"])
        for sign, sent in zip(drawn, told["signs"], strict=True):
            assert sign.kind == sent["kind"]
            for place, (carrier, x, y) in zip(sign.places, sent["at"], strict=True):
                if carrier >= 0:
                    gx, gy, turn = (values[row] for values in bodies[carrier])
                    c, s = math.cos(turn), math.sin(turn)
                    x, y = gx + c * x - s * y, gy + s * x + c * y
                elif carrier == -2:
                    time = motion.recorded.time[row]
                    x, y = (np.interp(time, followed_at, way) for way in ways[int(x)])
                assert math.dist((x, y), place) < 1e-3 * size, (sign.kind, sign.text)


def test_each_kind_of_carrier_is_there(motion: moving.Motion) -> None:
    signs = document(Beside(motion))["signs"]
    spring = next(sign for sign in signs if sign["kind"] == "spring")
    assert sorted(place[0] for place in spring["at"]) == [-1, 2], "from a body to the ground"
    outline = next(sign for sign in signs if sign["kind"] == "polygon" and sign.get("dashes"))
    assert {place[0] for place in outline["at"]} == {2}, "of a body without a shape"
    names = {sign["text"] for sign in signs if sign["kind"] == "name"}
    assert {"AB", "wheel", "lump", "p", "A", "B", "V", "W", "S", "floor", "spring", "push"} <= names


def test_lines_between_its_instants_are_true_to_a_pixel() -> None:
    found = moving.record(planemotion.load_text(BALL))
    fine = planemotion.load_text(BALL).history("b.x", "b.y", every="3 ms")
    low, high = found.room
    pixel = float((high - low).max()) / 500
    for t, x, y, mark in zip(
        fine.t.values, fine["b.x"].values, fine["b.y"].values, fine.mark.values, strict=True
    ):
        if mark == 0:
            assert math.dist(found.poses_at(float(t))["b"][:2], (x, y)) < pixel
    assert len(found.recorded.time) < 80


def test_events_and_impulses_are_at_their_rows() -> None:
    told = document(Beside(moving.record(planemotion.load_text(BALL))))
    t = unpacked(told["t"])
    strike = (3 + math.sqrt(9 + 2 * 9.81 * 0.9)) / 9.81
    (first, *_) = [event for event in told["events"] if event["name"] == "floor"]
    assert t[first["row"]] == pytest.approx(strike, rel=1e-6)
    assert t[first["row"] - 1] == t[first["row"]], "both sides of the blow"
    (blow,) = told["impulses"]
    impulse = unpacked(blow["y"])
    speed = 9.81 * strike - 3
    assert impulse[first["row"]] == pytest.approx(2 * 1.8 * speed, rel=1e-4)
    assert impulse[first["row"] - 1] == pytest.approx(0, abs=1e-3)


def test_the_page_is_one_file_that_needs_nothing(motion: moving.Motion) -> None:
    text = page(document(Beside(motion)))
    assert len(text) < 100_000
    assert text.count("</script>") == 2, "a title does not end the script"
    for word in ("http:", "https:", "src=", "@import", "url("):
        assert word not in text
    start = text.index('id="pm-motion">') + len('id="pm-motion">')
    told = json.loads(text[start : text.index("</script>", start)])
    assert told["title"] == "All </script> signs"


def test_a_run_that_changes_little_is_small_and_one_with_many_blows_is_bounded() -> None:
    assert (
        len(page(document(Beside(moving.record(planemotion.load("studies/chapter17/17-C5.toml")))))) < 100_000
    )
    bars = moving.record(planemotion.load("studies/sphere_over_bars.toml"))
    assert len(page(document(Beside(bars)))) < 300_000
    assert np.count_nonzero(bars.recorded.mark == AFTER) > 500


def test_frames_go_from_the_start_to_the_end(motion: moving.Motion) -> None:
    shown = list(video.Film(Beside(motion), most=3))
    assert len(shown) == 3
    assert shown[0].shape == shown[-1].shape
    assert np.abs(shown[0].astype(int) - shown[-1]).max() > 100


@pytest.mark.parametrize("number", ["004", "016", "081", "094", "125"])
def test_scenes_of_the_chapter_have_the_same_signs_at_all_instants(number: str) -> None:
    found = moving.record(planemotion.load(f"studies/chapter17/17-{number}.toml"))
    seen = {tuple((sign.kind, len(sign.places)) for sign in found.signs(row)) for row in found.rows(30)}
    assert len(seen) == 1


def test_the_widget_has_the_motion_and_the_player_of_the_page() -> None:
    shown = planemotion.load_text(BALL).animate()
    made, page = shown.widget(), shown.html()
    motion = json.loads(page.split('id="pm-motion">')[1].split("</script>")[0])
    assert json.loads(json.dumps(made.motion)) == motion
    assert (made.time, made.playing) == (0.0, False)
    for part in ("class Motion", "class Stage", "class Player"):
        assert page.count(part) == made._esm.count(part) == 1
    assert made._css in page
    assert {"motion", "time", "playing", "speed"} <= set(made.keys)
    assert repr(made).startswith("Player of ")


def test_without_anywidget_it_is_told_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(needs, "find_spec", lambda name: None)
    with pytest.raises(StudyError, match=r'needs anywidget: pip install "planemotion\[notebook\]"; without'):
        planemotion.load_text(BALL).animate().widget()


# ---- files ----


def test_animate_writes_where_it_says(folder: Path) -> None:
    scene = write(folder, "a.toml", BALL)
    assert invoke("animate", scene).stdout.strip() == "a.html"
    assert (folder / "a.html").read_text(encoding="utf-8").startswith("<!doctype html>")
    assert left_in(folder) == {"a.toml", "a.html"}
    shown = planemotion.load(scene).animate()
    assert shown.save("b.html") == Path("b.html")
    assert (folder / "b.html").read_bytes() == (folder / "a.html").read_bytes()
    assert shown._repr_html_().startswith("<iframe srcdoc=")


@pytest.mark.parametrize("kind", ["gif", "mp4"])
def test_frames_become_a_file(folder: Path, kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(video, "_MOST", 4)
    planemotion.load_text(BALL).animate().save(f"a.{kind}")
    begin = (folder / f"a.{kind}").read_bytes()[:12]
    assert begin.startswith(b"GIF89a") if kind == "gif" else begin[4:8] == b"ftyp"
    assert left_in(folder) == {f"a.{kind}"}


def test_what_cannot_be_written_is_refused_before_it_is_computed(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done = invoke("animate", "missing.toml", "--out", "a.avi")
    assert done.exit_code == 2
    assert "an animation is written as one of .html, .gif, .mp4" in done.stderr
    monkeypatch.setattr(needs, "find_spec", lambda name: None)
    done = invoke("animate", "missing.toml", "--out", "a.mp4")
    assert done.exit_code == 2
    assert 'needs imageio-ffmpeg: pip install "planemotion[video]"' in done.stderr
    with pytest.raises(StudyError, match="no folder"):
        planemotion.load_text(BALL).animate().save("nowhere/a.html")
    assert left_in(folder) == set()


def test_a_run_that_ends_early_is_shown_and_told(folder: Path) -> None:
    text = BALL.replace('"t = 2 s"', '"b.y > 9 m"') + '[solve]\nmax_time = "0.5 s"\n'
    done = invoke("animate", write(folder, "a.toml", text))
    assert done.exit_code == 1
    assert "the run ended early (limit_time)" in done.stderr
    assert "ended early: limit_time" in (folder / "a.html").read_text(encoding="utf-8")


def test_what_stands_still_is_the_same_in_all_frames_of_a_gif(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """White paper stays white, and the same numbers stand for it: it is stored once."""
    from PIL import Image, ImageSequence

    monkeypatch.setattr(video, "_MOST", 8)
    planemotion.load_text(BALL).animate().save("x.gif")
    with Image.open(folder / "x.gif") as shown:
        frames = [np.asarray(one.convert("RGB"))[:, :30] for one in ImageSequence.Iterator(shown)]
    assert len(frames) > 2
    assert tuple(frames[-1][2, 2]) == (255, 255, 255)
    assert all(np.array_equal(frame[60:-75], frames[0][60:-75]) for frame in frames)
