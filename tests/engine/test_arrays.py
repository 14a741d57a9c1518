"""Cases as arrays: neighbours, bad cases, threads, histories, starts."""

from __future__ import annotations

import math
import threading

import numpy as np
import pytest

from planemotion import _layout as layout
from planemotion import load_text
from planemotion.compile.flatten import flatten
from planemotion.engine.call import check, run_cases, trace, values
from planemotion.engine.kernel import status_text
from planemotion.engine.messages import message
from tests.engine.scenes import BROKEN, FAILURES, PENDULUM


def test_a_case_does_not_depend_on_its_neighbours() -> None:
    flat = flatten(load_text(PENDULUM + 'ask = { omega = "AB.omega", force = { max = "A.force.norm" } }\n'))
    param = np.tile(flat.defaults, (12, 1))
    param[:, flat.parameters.index("L")] = np.linspace(0.5, 2, 12)
    together = run_cases(flat, param, workers=2)
    for i in range(12):
        alone = run_cases(flat, param[i : i + 1])
        assert np.array_equal(alone.out[0], together.out[i])
        assert np.array_equal(alone.audit[0], together.audit[i])


def test_a_bad_case_leaves_the_others_alone() -> None:
    flat = flatten(load_text(PENDULUM + 'ask.omega = "AB.omega"\n'))
    param = np.tile(flat.defaults, (3, 1))
    param[1, flat.parameters.index("m")] = -1
    results = run_cases(flat, param)
    assert results.status.tolist() == [layout.PM_OK, layout.PM_BAD_VALUE, layout.PM_OK]
    assert np.isnan(results.out[1, 0])
    assert results.out[0, 0] == results.out[2, 0]
    assert "bodies.AB.mass: it is -1 kg; the bound is 0 kg" in message(flat, results, 1)
    assert message(flat, results, 0) == ""


def test_what_f2py_would_convert_silently_is_refused() -> None:
    flat = flatten(load_text(PENDULUM))
    good = flat.defaults[None, :]
    with pytest.raises(ValueError, match=r"\(cases, 4\) is wanted"):
        run_cases(flat, good[:, :2])
    with pytest.raises(TypeError, match="real numbers are wanted"):
        run_cases(flat, good + 1j)
    with pytest.raises(ValueError, match="stop has the type int64"):
        run_cases(flat, good, stop=np.zeros(1, np.int64))
    with pytest.raises(ValueError, match="workers is 0"):
        run_cases(flat, good, workers=0)
    assert run_cases(flat, np.zeros((0, 4))).out.shape == (0, 0)
    assert run_cases(flat, np.asfortranarray(np.tile(good, (3, 1)))).status.tolist() == [0, 0, 0]


def test_another_thread_sees_progress_and_can_stop() -> None:
    flat = flatten(load_text(PENDULUM.replace('"AB.turned = -60 deg"', '"t = 20 s"')))
    stop, progress = np.zeros(1, np.int32), np.zeros(1, np.int64)
    param = np.tile(flat.defaults, (4000, 1))
    results = []
    worker = threading.Thread(
        target=lambda: results.append(run_cases(flat, param, workers=2, stop=stop, progress=progress))
    )
    worker.start()
    while progress[0] == 0 and worker.is_alive():
        pass
    stop[0] = 1
    worker.join(5)
    assert not worker.is_alive()
    status = results[0].status
    assert layout.PM_CANCELLED in status
    assert layout.PM_OK in status


def test_a_history_has_the_run_from_start_to_end() -> None:
    flat = flatten(load_text(PENDULUM))
    history = trace(flat, flat.defaults)
    assert history.status == layout.PM_OK
    assert history.time[0] == 0
    assert np.all(np.diff(history.time) >= 0)
    assert history.columns["AB.angle"][0] == pytest.approx(math.radians(-10))
    assert history.columns["AB.angle"][-1] == pytest.approx(math.radians(-70))
    total = history.columns["energy.total"]
    assert np.ptp(total) < 1e-8 * abs(total[0])
    assert set(history.mark) <= {0, 1, 2}


def test_a_long_history_gets_the_room_that_it_needs() -> None:
    flat = flatten(load_text(PENDULUM.replace('"AB.turned = -60 deg"', '"t = 300 s"')))
    history = trace(flat, flat.defaults)
    assert len(history.time) > 4096
    assert history.time[-1] == pytest.approx(300)
    assert not np.isnan(history.columns["AB.angle"]).any()


def test_check_assembles_the_start() -> None:
    flat = flatten(load_text(PENDULUM))
    start = check(flat)
    assert (start.status, start.message) == (layout.PM_OK, "")
    assert start.info["coordinates"] == 6
    assert (start.info["constraints"], start.info["redundant"], start.info["freedom"]) == (4, 0, 2)
    assert start.pose[0] == pytest.approx(
        [0.6 * math.cos(-math.pi / 18), 0.6 * math.sin(-math.pi / 18), -math.pi / 18]
    )
    assert start.velocity[:, 2] == pytest.approx([-1, 3])
    assert start.number["opening"] < 1e-12
    broken = check(flatten(load_text(BROKEN + FAILURES[0][0], file="x.toml")))
    assert broken.status == layout.PM_ASSEMBLY
    assert "joints.q is open by" in broken.message


def test_values_in_python_are_those_of_the_kernel() -> None:
    flat = flatten(
        load_text(PENDULUM + 'bodies.P = { mass = "1 kg", at = ["L*sin(phi)^3", "exp(phi)*L"] }\n')
    )
    start = check(flat)
    value = values(flat)
    row = flat.rows(layout.PM_TABLE_BODY)[2]
    assert start.pose[2, 0] == value[row[layout.PM_BODY_X]]
    assert start.pose[2, 1] == value[row[layout.PM_BODY_Y]]


def test_every_status_has_a_text() -> None:
    for name, status in layout.pm_status.items():
        assert len(status_text(status)) > 1, name
