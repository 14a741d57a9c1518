"""Old words of scenes: read with the same meaning as the new ones, with one hint for each."""

from __future__ import annotations

import subprocess
import sys
import warnings
from pathlib import Path

import pytest

import planemotion
from planemotion.base.errors import SceneError, SceneHint

WHEEL = """
id = "wheel"
until = "t = 2 s"
parameters = { M = "0.8 N*m" }
bodies.wheel = { disk = "0.5 m", mass = "4 kg", at = [0, 0] }
bodies.arm = { disk = "0.2 m", mass = "1 kg", at = [0, 0] }
joints.axle = { pin = ["wheel", "ground"], OPTION }
joints.hub = { pin = ["arm", "ground"] }
couplings.drive = { KIND = ["arm", "ground"], value = "2 rad/s" }
start.wheel.omega = "9 rad/s"
ask.omega = { of = "wheel.omega", at = "end" }
ask.couple = { of = "drive.couple", at = "end" }
"""
LANDING = """
until = "t = 1 s"
bodies.box = { plate = ["0.4 m", "0.2 m"], mass = "3 kg", corners = ["A", "B", "C", "D"], at = [0, "1 m"] }
contacts.post = { touch = ["box.A", "ground.P"], CAPTURE }
ground.points.P = ["-0.2 m", "0.3 m"]
ask.omega = { of = "box.omega", at = "end" }
"""
BALLS = """
until = "t = 1 s"
plane = "horizontal"
bodies.a = { disk = "10 cm", mass = "1 kg", at = [0, 0] }
bodies.b = { disk = "10 cm", mass = "1 kg", at = ["20 cm", 0] }
bodies.c = { disk = "10 cm", mass = "1 kg", at = ["40 cm", 0] }
contacts.ab = { touch = ["a.rim", "b.rim"], restitution = 1 }
contacts.bc = { touch = ["b.rim", "c.rim"], restitution = 1 }
start.a.velocity = ["1 m/s", 0]
ask.last = { of = "c.velocity.x", at = "end" }
solve = { SETTING }
"""


def scene(text: str, **words: str) -> planemotion.Scene:
    for word, meant in words.items():
        text = text.replace(word, meant)
    return planemotion.load_text(text, file="old.toml")


@pytest.mark.parametrize(
    ("text", "old", "new", "hint"),
    [
        (
            WHEEL,
            {"OPTION": 'friction = "M"', "KIND": "motor"},
            {"OPTION": 'friction_couple = "M"', "KIND": "motor"},
            "old.toml:7:44: joints.axle.friction: write friction_couple instead of friction; "
            "the old form is still read",
        ),
        (
            WHEEL,
            {"OPTION": "active = true", "KIND": "rate"},
            {"OPTION": "active = true", "KIND": "motor"},
            "old.toml:9:21: couplings.drive.rate: write motor instead of rate; the old form is still read",
        ),
        (
            LANDING,
            {"CAPTURE": 'capture = "point"'},
            {"CAPTURE": 'capture = "pin"'},
            'old.toml:4:50: contacts.post.capture: write capture = "pin" instead of capture = "point"; '
            "the old form is still read",
        ),
        (
            BALLS,
            {"SETTING": 'simultaneous = "one by one"'},
            {"SETTING": 'impacts = "sequential"'},
            'old.toml:11:11: solve.simultaneous: write impacts = "sequential" instead of '
            'simultaneous = "one by one"; the old form is still read',
        ),
        (
            BALLS,
            {"SETTING": 'simultaneous = "together"'},
            {"SETTING": 'impacts = "simultaneous"'},
            'old.toml:11:11: solve.simultaneous: write impacts = "simultaneous" instead of '
            'simultaneous = "together"; the old form is still read',
        ),
        (
            BALLS,
            {"SETTING": "assembly = 1e-9"},
            {"SETTING": "assembly_tolerance = 1e-9"},
            "old.toml:11:11: solve.assembly: write assembly_tolerance instead of assembly; "
            "the old form is still read",
        ),
    ],
)
def test_an_old_word_means_what_the_new_one_does(
    text: str, old: dict[str, str], new: dict[str, str], hint: str
) -> None:
    with pytest.warns(SceneHint) as told:
        before = scene(text, **old)
    assert [str(one.message) for one in told] == [hint]
    after = scene(text, **new)
    assert before.data.model_copy(update={"hints": ()}) == after.data
    assert before.run().asks == after.run().asks


def test_impacts_one_by_one_differ_from_simultaneous_ones() -> None:
    """So that the two settings above are told apart by the answers."""
    last = {
        order: scene(BALLS, SETTING=f'impacts = "{order}"').run().last
        for order in ("simultaneous", "sequential")
    }
    assert last["sequential"] == pytest.approx(1)
    assert last["simultaneous"] != pytest.approx(1)


def test_a_bearing_rubs_by_a_couple_and_by_its_load() -> None:
    """Both at once: M + mu r N, with N the weight."""
    load = {"KIND": "motor", "OPTION": 'friction_couple = "M", friction = { mu = 0.1, radius = "20 mm" }'}
    braking = 0.8 + 0.1 * 0.02 * 4 * 9.81
    assert scene(WHEEL, **load).run().omega == pytest.approx(9 - braking / 0.5 * 2, rel=1e-9)


def test_a_parameter_t_hides_the_time_and_gives_a_hint() -> None:
    text = 'until = "time = t"\nparameters.t = "2 s"\nbodies.P = { mass = "1 kg", at = [0, 0] }\n'
    text += 'ask.y = { of = "P.y", at = "end" }\n'
    with pytest.warns(SceneHint, match=r"parameters\.t: a parameter t hides the time"):
        assert planemotion.load_text(text).run().y == pytest.approx(-0.5 * 9.81 * 4)


def test_a_condition_on_a_parameter_t_says_how_the_time_is_called() -> None:
    text = 'until = "t = 2 s"\nparameters.t = "2 s"\nbodies.P = { mass = "1 kg", at = [0, 0] }\n'
    with pytest.warns(SceneHint, match=r"parameters\.t"):
        hidden = planemotion.load_text(text)
    with pytest.raises(SceneError, match='t is a parameter of this scene, the time is called "time"'):
        hidden.run()


def test_a_hint_is_given_once_for_each_scene() -> None:
    with pytest.warns(SceneHint):
        one = scene(BALLS, SETTING="assembly = 1e-9")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        one.run()
        one.with_values({"solve.accuracy": "1e-9"}).run()
        one.with_values({"solve.max_steps": "1000"}).run()


def test_new_words_and_other_faults_give_no_hint() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scene(BALLS, SETTING="assembly_tolerance = 1e-9")
        with pytest.raises(SceneError, match="joints = 3: a table is wanted"):
            planemotion.load_text('until = "t = 1 s"\njoints = 3\nbodies.P = { mass = "1 kg" }')


def test_both_forms_of_a_word_are_refused() -> None:
    with pytest.raises(SceneError, match=r"solve\.assembly: this is the old word for assembly_tolerance"):
        scene(BALLS, SETTING="assembly = 1e-9, assembly_tolerance = 1e-9")


def test_the_command_line_shows_a_hint_and_goes_on(tmp_path: Path) -> None:
    path = tmp_path / "old.toml"
    path.write_text(BALLS.replace("SETTING", "assembly = 1e-9"), encoding="utf-8")
    command = [sys.executable, "-m", "planemotion.cli", "run", str(path), "--set", "solve.accuracy=1e-9"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0
    hint = "solve.assembly: write assembly_tolerance instead of assembly; the old form is still read"
    assert done.stderr == f"hint: {path}:11:11: {hint}\n"
