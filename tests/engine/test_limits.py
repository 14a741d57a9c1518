"""Limits that are told before anything is computed, those that end a case, and Ctrl-C."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable
from threading import Timer
from typing import Any

import pytest

from planemotion import SceneError, StudyError, load_text
from planemotion.compile.flatten import flatten
from planemotion.engine import call
from planemotion.report import explain as explanations
from planemotion.scene import Scene
from tests import STUDIES

POINT = 'bodies.P = { mass = "1 kg", at = [0, 0] }\nparameters = { T = "2000 s", L = "1 m", h = "1 m" }\n'
DOUBLE = """
id = "double"
until = "t = 900 s"
ground.points.O = [0, 0]
bodies.A = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = [0, 0] }, angle = "20 deg" }
bodies.B = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = "A.B" }, angle = "20 deg" }
joints.a = { pin = ["A.A", "ground.O"] }
joints.b = { pin = ["A.B", "B.A"] }
ask.omega = { of = "B.omega" }
ask.early = { of = "B.omega", at = { each = "t", values = ["0.1 s"] } }
solve.max_steps = 2147483647
"""


@pytest.mark.parametrize(
    ("until", "said"),
    [
        ('"t = 2000 s"', 'until = "t = 2000 s": this is at t = 2000 s, but a run ends at 1000 s where'),
        ('"t = T"', 'give solve.max_time = "2000 s", or more'),
        ('["t = 2000 s", "t = 3000 s"]', 'until[0] = "t = 2000 s": this is at t = 2000 s'),
        ('{ all = ["t = 0.5*T", "3*t > 2*T"] }', 'until[1] = "3*t > 2*T": this is at t = 1333.33 s'),
        ('"late"', 'until = "late": this is at t = 2000 s'),
        ('"t = -1 s"', "this is at t = -1 s, and a run begins at t = 0 s"),
        ('"t < 5 s"', "time only grows"),
    ],
)
def test_an_end_that_cannot_come_is_told_before_the_run(until: str, said: str) -> None:
    scene = load_text(f'until = {until}\nevents.late = "t = T"\n{POINT}')
    with pytest.raises(SceneError) as caught:
        scene.tables()
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("until", "more"),
    [
        ('["t = 2000 s", "P.y < -1 m"]', ""),
        ('"t = 2000 s"', 'solve.max_time = "2000 s"'),
        ('"t = 2000 s"', 'solve.max_time = "3 s"'),
        ('"t = T"', 'sweep.T = ["1 s", "2000 s"]'),
        ('"t = 1000 s"', ""),
        ('"t^2 = 4e6 s^2"', ""),
    ],
)
def test_an_end_that_may_come_is_left_to_the_run(until: str, more: str) -> None:
    assert load_text(f"until = {until}\n{POINT}{more}").tables()


@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
def test_what_is_due_at_the_start_happens_there(route: str) -> None:
    at_once = load_text(f'until = "t = 0 s"\n{POINT}ask.y = "P.y"\nsolve.route = "{route}"').run()
    assert (at_once.y, at_once.stopped_at or 0.0) == (0, 0)
    asks = "".join(f'ask.{one} = "{one}.count"\n' for one in "efgh")
    events = 'events = { e = "t = 0 s", f = "t > 0 s", g = "t < 0 s", h = "2*t = t" }\n'
    later = load_text(f'until = "t = 1 s"\n{events}{POINT}{asks}solve.route = "{route}"').run()
    assert [later.asks[one].value for one in "efgh"] == [1, 1, 0, 1]


@pytest.mark.parametrize("route", ["auto", "ida"])
def test_a_limit_on_computing_time_ends_a_case_with_what_it_has(route: str) -> None:
    scene = load_text(f'{DOUBLE}solve.max_cpu = "50 ms"\nsolve.route = "{route}"')
    begun = time.thread_time()
    result = scene.run()
    assert result.status == "limit_cpu"
    assert "solve.max_cpu: given up after 0.05 s of computing time" in result.error
    assert result.asks["omega"].value is None
    assert result.asks["early"].value is not None
    assert 0 < (result.stopped_at or 0) < 900
    assert time.thread_time() - begun < 10


def test_the_limit_is_heard_where_two_points_go_by_each_other_in_rounding() -> None:
    # On a plate 500,000 km high two points that stay apart seem to pass all the time.
    scene = load_text(
        """
        until = "cup strikes"
        solve.max_cpu = "50 ms"
        parameters.side = "500 mm"
        ground.points.B = ["-200 mm", "250 mm"]
        bodies.panel.plate = ["side", "1000000.0*(side)"]
        bodies.panel.mass = "8 kg"
        bodies.panel.points = { A = [0, "side/2"], C = { from = "A", by = ["-2e-10 mm", 0] } }
        bodies.panel.at = { A = [0, 0] }
        bodies.sphere = { mass = "2 kg", at = "ground.B" }
        joints.A = { pin = ["panel.A", "ground"] }
        contacts.cup = { touch = ["sphere", "panel.C"], capture = "pin" }
        ask.v_G = { of = "panel.velocity.x", unit = "m/s" }
        """
    )
    begun = time.thread_time()
    assert scene.run().status == "limit_cpu"
    assert time.thread_time() - begun < 10


def test_the_limit_is_heard_in_the_search_for_where_two_curves_are_nearest() -> None:
    # A flank of 200,000 turns: of its parts no two are so far apart that the search could leave them out.
    text = (STUDIES / "involute_teeth.toml").read_text(encoding="utf-8").split("[sweep]")[0]
    scene = load_text('solve.max_cpu = "50 ms"\n' + text.replace("from = -1.3", "from = -1.3e6", 1))
    begun = time.thread_time()
    result = scene.run()
    assert result.status == "limit_cpu"
    assert all(answer.value is None for answer in result.asks.values())
    assert "given up after 0.05 s of computing time" in scene.check().faults[0]
    assert time.thread_time() - begun < 10


def test_a_limit_that_is_not_reached_changes_no_bit() -> None:
    scene = load_text(DOUBLE.replace("900 s", "5 s"))
    limited = scene.with_values({"solve.max_cpu": "1000 s"}).run()
    assert (limited.status, limited.omega, limited.asks["omega"].error) == (
        "ok",
        scene.run().omega,
        scene.run().asks["omega"].error,
    )


def _search(scene: Scene) -> Any:
    sought = 'find = { vary = { L = ["0.5 m", "2 m"] }, where = "B.omega = (1e5 rad/s)", samples = 4096 }\n'
    text = sought + DOUBLE.replace('"1 m"', '"L"').replace("until", 'parameters.L = "1 m"\nuntil')
    return load_text(text.replace("900 s", "20 s")).run()


def _marks(scene: Scene) -> Any:
    text = 'id = "marks"\nuntil = "t = 900 s"\nevents.e = "P.x every (1e-9 m)"\nask.n = "e.count"\n'
    limits = 'solve = { route = "rk", max_events = 2147483647 }\nstart.P.velocity.x = "1 m/s"\n'
    return load_text(text + limits + POINT).run()


@pytest.mark.parametrize(
    "work",
    [
        lambda scene: scene.run(),
        lambda scene: scene.with_values({"solve.route": "ida"}).run(),
        _search,
        _marks,
        lambda scene: explanations.explain_run(scene, scene),
        lambda scene: call.trace(flatten(scene), flatten(scene).defaults),
    ],
)
def test_ctrl_c_is_heard_inside_the_kernel(work: Callable[[Scene], Any]) -> None:
    scene = load_text(DOUBLE.replace("solve.max", "solve.accuracy = 1e-13\nsolve.max"))
    scene.tables()
    Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        work(scene)
    assert time.monotonic() - begun < 2


def test_other_signals_and_other_listeners_are_not_disturbed() -> None:
    """An event loop that listens to signals hears them during a run, too; an own handler of Ctrl-C stays."""
    scene = load_text(DOUBLE.replace("900 s", "300 s"))  # runs longer than the timers wait
    scene.tables()
    read, write = os.pipe()
    os.set_blocking(write, False)
    before = signal.set_wakeup_fd(write)
    handlers = [signal.signal(one, lambda *_: None) for one in (signal.SIGUSR1, signal.SIGINT)]
    try:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        timer = Timer(0.05, os.kill, (os.getpid(), signal.SIGUSR1))
        timer.start()
        assert scene.run().status == "ok"
        timer.join()
        assert signal.SIGUSR1 in os.read(read, 10)
        signal.signal(signal.SIGINT, lambda *_: None)
        timer = Timer(0.05, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        assert scene.run().status == "ok"
        timer.join()
        assert signal.set_wakeup_fd(write) == write
    finally:
        signal.set_wakeup_fd(before)
        for one, handler in zip((signal.SIGUSR1, signal.SIGINT), handlers, strict=True):
            signal.signal(one, handler)


HUGE = "".join(f"sweep.{name} = {{ from = 1, to = 2, num = 100000 }}\n" for name in "LhT")


def test_the_size_of_a_sweep_is_told_and_bounded_before_it_begins(tmp_path: Any) -> None:
    scene = load_text(f'id = "x"\nuntil = "t = 1 s"\n{POINT}{HUGE}ask.y = "P.y"')
    with pytest.raises(SceneError) as caught:
        scene.sweep()
    assert "sweep: 1000000000000000 cases, about 54 PB of HDF5 and " in str(caught.value)
    assert "give solve.max_cases = 1000000000000000 if they are meant" in str(caught.value)
    meant = scene.with_values({"solve.max_cases": 10**15})
    with pytest.raises(
        StudyError, match="1000000000000000 cases need 108 PB of memory, and this machine has"
    ):
        meant.sweep()
    with pytest.raises(StudyError, match=r"PB are needed on the way, and .* are free there"):
        meant.sweep(out=tmp_path / "out")
    assert not (tmp_path / "out").exists()
