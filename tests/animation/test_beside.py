"""What an animation shows beside the bodies, at the right time and place, in a page as in frames."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import to_rgb

import planemotion
from planemotion.animation import drawn, film, timing
from planemotion.animation.document import document
from planemotion.animation.timing import Timing
from planemotion.animation.video import Film
from planemotion.base.errors import SceneError, StudyError
from planemotion.examples import text_of
from planemotion.pen.page import IMPULSE, RED, TRACE, VELOCITY
from tests.cli.calls import invoke, write
from tests.test_history import BALL

STRIKE = (3 + math.sqrt(9 + 2 * 9.81 * 0.9)) / 9.81  # of the ball on the floor, s
ROD = """
until = "t = 1 s"
[bodies]
AB = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = [0, 0] } }
[joints]
A = { pin = ["AB.A", "ground"] }
"""


def dots(frame: np.ndarray, colour: str) -> np.ndarray:
    """Rows and columns [n, 2] of the dots of a colour."""
    wanted = 255 * np.array(to_rgb(colour))
    return np.argwhere(np.abs(frame.astype(float) - wanted).max(axis=2) < 12)


def scene_part(frame: np.ndarray) -> np.ndarray:
    """Without the title, the time axis and the energies."""
    return frame[70:-66, :-260]


# ---- time ----


@pytest.mark.parametrize(
    ("end", "speed"), [(4.0, 1.0), (12.0, 1.0), (0.8, 0.1), (30.0, 5.0), (3e-4, 5e-5), (0.0, 1.0), (2e6, 2e5)]
)
def test_a_run_takes_some_seconds_of_a_viewer_at_a_round_speed(end: float, speed: float) -> None:
    told = Timing(end, np.zeros(0), False).told()
    assert told["speed"] == pytest.approx(speed, rel=1e-12)
    assert told["speed"] in told["speeds"]
    assert told["speeds"] == sorted(told["speeds"])


def test_time_is_slow_by_the_events_and_even_elsewhere() -> None:
    """The steps between frames are as the pace says, which is a sixth at an event."""
    one = Timing(4.0, np.array([2.0]), True)
    times, speed = one.frames(20, 1000)
    assert speed == 1.0
    assert (times[0], times[-1]) == (0.0, 4.0)
    steps, middle = np.diff(times), 0.5 * (times[1:] + times[:-1])
    far = np.abs(middle - 2.0)
    law = np.where(far < 0.35, 1 / 6 + 5 / 6 * (far / 0.35) ** 2, 1.0)
    scale = steps[far > 0.5].mean()
    assert scale == pytest.approx(1 / 20, rel=0.01)
    np.testing.assert_allclose(steps / scale, law, atol=0.04)
    even, _ = Timing(4.0, np.array([2.0]), False).frames(20, 1000)
    assert np.ptp(np.diff(even)) < 1e-12
    assert len(even) == 81
    few, faster = one.frames(20, 31)
    assert len(few) == 31
    assert faster == pytest.approx((len(times) - 1) / 30, rel=0.02)


def test_a_blow_is_seen_for_a_while() -> None:
    one = Timing(4.0, np.array([1.0, 2.0]), False)
    assert one.fresh(0.99) is None
    assert one.fresh(1.0) == (0, 1.0)
    assert one.fresh(1.35) == (0, pytest.approx(0.5))
    assert one.fresh(1.8) is None
    assert one.fresh(2.07) == (1, pytest.approx(0.9))


# ---- frames ----


@pytest.fixture(scope="module")
def ball() -> Film:
    return Film(planemotion.load_text(BALL).animate(show="velocities,energies").beside)


def test_a_blow_shows_its_impulse_and_its_name_until_it_fades(ball: Film) -> None:
    counts = [
        len(dots(scene_part(ball.frame(time)), IMPULSE)) for time in (STRIKE - 0.01, STRIKE, STRIKE + 1.0)
    ]
    assert counts[0] == counts[2] == 0
    assert counts[1] > 60
    rows, columns = dots(scene_part(ball.frame(STRIKE)), IMPULSE).T
    assert np.ptp(rows) > 3 * np.ptp(columns), "it acts along the normal"
    assert [name for _, name in ball.beside.events][:2] == ["top", "floor"]


def test_a_blow_is_shown_where_it_was(ball: Film, monkeypatch: pytest.MonkeyPatch) -> None:
    """The ball is on its way up meanwhile."""
    monkeypatch.setattr(drawn, "_FAINT", 1.0)  # its colour is known
    at, later = (dots(scene_part(ball.frame(STRIKE + delay)), IMPULSE) for delay in (0, 0.05))
    assert len(later) > 20
    assert later[:, 0].max() == pytest.approx(at[:, 0].max(), abs=4)


def test_velocities_point_where_bodies_go(ball: Film) -> None:
    """Up, then down: the tip is above or below the ball, as far from it as the speed says."""
    lengths = []
    for time, up in ((0.0, True), (STRIKE - 1e-3, False)):
        rows = dots(ball.frame(time)[70:, :-260], VELOCITY)[:, 0]
        tail = ball.paper.sketch.pen.axes.transData.transform(ball.beside.place([0, 0, 0], time))[
            1
        ]  # from below
        tail = ball.frame(time).shape[0] - tail - 70
        lengths.append(tail - rows.min() if up else rows.max() - tail)
        assert lengths[-1] > 10
    speeds = 3.0, 9.81 * STRIKE - 3
    assert lengths[0] / lengths[1] == pytest.approx(speeds[0] / speeds[1], abs=0.05)


def test_the_energies_have_their_values_beside(ball: Film) -> None:
    energies: Any = ball.paper.moving[0]
    ball.frame(0.2)
    shown = {kind: float(text.get_text()) for kind, text in energies.values.items()}
    speed = math.hypot(2, 3 - 9.81 * 0.2)
    assert shown["kinetic"] == pytest.approx(0.5 * 2 * speed**2, rel=0.02)
    assert shown["total"] == pytest.approx(shown["kinetic"] + shown["potential"], abs=0.02)
    without = Film(planemotion.load_text(BALL).animate(show="").beside)
    assert without.frame(0.0).shape[1] < ball.frame(0.0).shape[1] - 200


@pytest.mark.parametrize("point", ["AB.B", "AB"])
def test_the_trace_of_a_point_is_its_way(point: str) -> None:
    shown = planemotion.load_text(ROD).animate(trace=point)
    radius = 1.0 if point == "AB.B" else 0.5
    (way,) = shown.beside.ways.values()
    np.testing.assert_allclose(np.hypot(way[:, 1], way[:, 2]), radius, atol=2e-3)
    assert np.hypot(*np.diff(way[:, 1:], axis=0).T).max() < 0.11 * radius
    film_of = Film(shown.beside)
    counts = [len(dots(film_of.frame(time), TRACE)) for time in (0.0, 0.5, 1.0)]
    assert counts[0] < counts[1] < counts[2]


def test_forces_are_shown_on_request_only() -> None:
    counts = [
        len(dots(scene_part(Film(planemotion.load_text(ROD).animate(show=show).beside).frame(0.5)), RED))
        for show in ("energies", "energies,forces")
    ]
    assert counts[0] == 0
    assert counts[1] > 40


def test_dark_frames_are_dark() -> None:
    shown = Film(planemotion.load_text(BALL).animate(theme="dark", show="velocities").beside).frame(0.1)
    assert np.median(shown) < 40
    assert not len(dots(shown, VELOCITY))
    assert len(dots(shown, "#6fb4ff")) > 20


def test_a_view_that_is_much_too_wide_follows_the_body() -> None:
    far = planemotion.load("studies/thrown_ball.toml").animate()
    assert far.motion.follows
    assert not planemotion.load_text(BALL).animate().motion.follows
    low, high = far.beside.room_at(1.0)
    place = far.beside.place([0, 0, 0], 1.0)
    np.testing.assert_allclose(0.5 * (low + high), place)
    assert (high - low).max() == pytest.approx(2.5 * far.motion.size)


def test_the_rounding_of_a_velocity_is_no_arrow() -> None:
    """The wheel of a Geneva drive stands still on its pin: 7e-15 m/s had an arrow of an inch."""
    beside = planemotion.load("studies/geneva_drive.toml").animate(show="velocities").beside
    assert all(not one.sizes.any() for one in beside.arrows["velocity"])


def test_in_a_view_that_follows_signs_are_as_large_as_what_is_seen() -> None:
    """The sign of a force had the size of the whole flight, and the force began there: out of view."""
    far = planemotion.load_text(text_of("drag")).animate(show="forces")
    assert far.motion.follows
    [force] = far.beside.arrows["force"]
    low, high = far.beside.room_at(1.0)
    place = np.array(far.beside.place(force.at, 1.0))
    assert (low < place).all()
    assert (place < high).all()
    assert document(far.beside)["near"] < 0.05 * far.motion.view


# ---- files ----


def test_a_gif_has_the_colours_of_its_frames_and_keeps_none(tmp_path: Path) -> None:
    from PIL import Image, ImageSequence

    shown = Film(planemotion.load_text(BALL).animate(show="velocities,energies,slow").beside, most=40)
    alive = []

    def watched() -> Iterator[np.ndarray]:
        import weakref

        for frame in shown:
            alive.append(weakref.ref(frame))
            yield frame
            assert sum(one() is not None for one in alive) <= 2, "frames before are given up"

    film.write_gif(tmp_path / "x.gif", shown.samples(), watched(), 20)
    worst = []
    with Image.open(tmp_path / "x.gif") as opened:
        written: Any = opened
        assert written.n_frames == 40
        assert written.info["loop"] == 0
        assert written.info["duration"] == 50
        for time, one in zip(shown.times, ImageSequence.Iterator(written), strict=True):
            true = shown.frame(float(time)).astype(int)
            worst.append(np.abs(np.asarray(one.convert("RGB")).astype(int) - true).max())
        assert one.info["duration"] == 1000
    assert max(worst) < 80, "mixtures at edges are the worst"


def test_a_frame_that_is_the_same_is_shown_as_long(tmp_path: Path) -> None:
    from PIL import Image

    still = np.full((20, 30, 3), 200, np.uint8)
    film.write_gif(tmp_path / "x.gif", [still], [still, still, still], 20)
    with Image.open(tmp_path / "x.gif") as opened:
        written: Any = opened
        written.seek(written.n_frames - 1)
        assert np.array_equal(np.asarray(written.convert("RGB")), still)


def test_words_that_there_are_not_are_told(tmp_path: Path) -> None:
    scene = planemotion.load_text(ROD)
    with pytest.raises(StudyError, match='show = "force": unknown word "force"; there is ener'):
        scene.animate(show="force")
    with pytest.raises(SceneError, match=r'trace = "AC.B": unknown body "AC"; there is AB'):
        scene.animate(trace=["AC.B"])
    with pytest.raises(SceneError, match=r'trace = "AB.C": unknown point of AB "C"'):
        scene.animate(trace="AB.C")
    with pytest.raises(StudyError, match=r'theme = "black": light or dark is wanted'):
        scene.animate(theme="black")
    done = invoke("animate", write(tmp_path, "a.toml", ROD), "--show", "speed")
    assert done.exit_code == 2
    assert 'show = "speed"' in done.stderr


# ---- a page says the same ----


def test_a_page_is_told_what_frames_show() -> None:
    shown = planemotion.load_text(BALL).animate(show="forces,slow", trace="b", theme="dark")
    told = document(shown.beside)
    assert told["shows"] == {
        "theme": "dark", "energies": False, "velocities": False, "forces": True, "slow": True,
    }  # fmt: skip
    assert told["traces"] == [{"name": "b", "at": [0, 0.0, 0.0]}]
    assert told["timing"]["speed"] == shown.beside.timing.speed
    assert (told["timing"]["near"], told["timing"]["flash"]) == (timing.NEAR, timing.FLASH)
