"""Grids of a sweep and the plan of its cases."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planemotion.base.errors import SceneError
from planemotion.compile.grids import read_grid
from planemotion.language import units
from planemotion.model.tables import Grid
from planemotion.sweep import run
from planemotion.sweep.plan import Axis, SweepPlan, plan_sweep
from tests.sweep import fake
from tests.sweep.fake import FakeEngine, FakeScene


def grid(raw: Any, unit: str = "") -> tuple[str, npt.NDArray[np.float64]]:
    raw = {"values": tuple(raw)} if isinstance(raw, list) else raw
    return read_grid(Grid.model_validate(raw), path="sweep.d", unit=unit)


def test_a_linear_grid_has_the_decimals_that_one_would_write() -> None:
    unit, values = grid({"from": "1 in", "to": "6 in", "num": 501})
    assert unit == "in"
    assert values.tolist() == [float(f"{i // 100}.{i % 100:02}") for i in range(100, 601)]


def test_a_step_and_a_number_make_the_same_grid() -> None:
    stepped, counted = {"from": "0 m", "to": "0.3 m", "step": "5 mm"}, {"from": 0, "to": "0.3 m", "num": 61}
    assert grid(stepped)[1].tolist() == grid(counted, "m")[1].tolist()
    down = grid({"from": "30 deg", "to": "-90 deg", "step": "-10 deg"})[1]
    assert down.tolist() == list(range(30, -91, -10))


def test_a_step_that_does_not_divide_its_range_stops_before_the_end() -> None:
    assert grid({"from": "1 in", "to": "2 in", "step": "0.3 in"})[1].tolist() == [1, 1.3, 1.6, 1.9]


def test_one_value_is_the_first() -> None:
    assert grid({"from": "1 in", "to": "2 in", "num": 1})[1].tolist() == [1]


def test_a_logarithmic_grid_keeps_its_ends() -> None:
    values = grid({"from": "0.3 N", "to": "300 N", "num": 4, "scale": "log"})[1]
    assert values[[0, 3]].tolist() == [0.3, 300]
    assert values == pytest.approx([0.3, 3, 30, 300], rel=1e-15)


def test_a_list_is_in_the_unit_of_its_first_value() -> None:
    unit, values = grid([0, "2 ft", "6 in", "1 ft"])
    assert (unit, values.tolist()) == ("ft", [0, 2, pytest.approx(0.5, rel=1e-15), 1])
    assert grid([True, False])[1].tolist() == [1, 0]


def test_bare_numbers_take_the_declared_unit() -> None:
    assert grid([1, 2], "in")[0] == "in"


@pytest.mark.parametrize(
    ("raw", "message"),
    [
        ({"from": "1 in", "to": "2 in", "num": 0}, "sweep.d.num = 0: an empty sweep; at least 1 value"),
        ({"from": "1 in", "to": "2 in", "num": -3}, "sweep.d.num = -3: an empty sweep"),
        ({"from": "1 in", "to": "2 in", "num": 10**9}, "at most 10000000"),
        ([], 'sweep.d = "[]": an empty sweep; at least 1 value is needed'),
        (["1 in", "2 lb"], 'sweep.d[1] = "2.0 lb": a force, but this grid is of length'),
        (["1 in", 2], "sweep.d[1]"),
        ({"from": "1 mm", "to": "1e306 m", "num": 3}, 'sweep.d.to = "1e+306 m": no finite number in "mm"'),
        (["r + 1"], "sweep.d[0]"),
        ({"from": "1 in", "to": "2 in", "step": "-0.5 in"}, "the step must lead"),
        ({"from": "1 in", "to": "2 in", "step": 0}, "the step must lead"),
        ({"from": "1 in", "to": "2 in", "step": "1e-9 in"}, "at most 10000000"),
        ({"from": "0 in", "to": "2 in", "num": 3, "scale": "log"}, "sweep.d.scale"),
        ({"from": "1 in", "to": "2 in", "step": "1 in", "scale": "log"}, 'needs "num"'),
    ],
)
def test_a_grid_that_makes_no_sense_is_refused_with_its_place(raw: Any, message: str) -> None:
    with pytest.raises(SceneError) as error:
        grid(raw)
    assert message in str(error.value)


@given(
    st.floats(-1e6, 1e6), st.floats(-1e6, 1e6), st.integers(2, 60),
    st.sampled_from(["in", "ft", "mm", "lb", "rpm", "deg", ""]),
)  # fmt: skip
@settings(deadline=None)
def test_a_case_written_out_gives_the_bits_of_the_grid(first: int, last: float, num: int, unit: str) -> None:
    raw = {"from": f"{first!r} {unit}", "to": f"{last!r} {unit}", "num": num}
    axis = Axis("d", *grid(raw))
    plan = SweepPlan(((axis,),))
    column = plan.block(0, num)[:, 0]
    written = [units.parse_quantity(plan.case(i)["d"]).value_si for i in range(num)]
    assert column.tobytes() == np.array(written).tobytes()
    assert axis.values[[0, -1]].tolist() == [first, last]


# ---- plans --------------------------------------------------------------------------------------------


def test_cases_are_numbered_in_the_order_of_c() -> None:
    plan = plan_sweep(FakeScene({"d": ["1 in", "2 in"], "m": [5, 6, 7]}))
    assert (plan.names, plan.dims, plan.cases) == (("d", "m"), (("d", 2), ("m", 3)), 6)
    assert plan.block(2, 3).tolist() == [[0.0254, 7], [0.0508, 5], [0.0508, 6]]
    assert plan.case(3) == {"d": "2.0 in", "m": "5.0"}


def test_zipped_parameters_share_a_dimension() -> None:
    sweep = {"m": [1, 2], "w": ["1 rad/s", "2 rad/s"], "d": [3, 4], "zip": [["d", "m"]]}
    plan = plan_sweep(FakeScene(sweep))
    assert plan.dims == (("d", 2), ("w", 2))
    assert plan.block(0, 3).tolist() == [[3 * 0.0254, 1, 1], [3 * 0.0254, 1, 2], [4 * 0.0254, 2, 1]]


@pytest.mark.parametrize(
    ("sweep", "message"),
    [
        ({}, "fake.toml: sweep: nothing to sweep"),
        ({"d": ["1 in"], "m": [1, 2], "zip": [["d", "m"]]}, "fake.toml: sweep.zip[0]: zipped grids"),
        ({"d": ["1 lb"]}, "fake.toml: sweep.d: the grid is of force, but the parameter is a length"),
        ({"d": {"from": "1 in", "to": "2 in", "num": 0}}, "fake.toml: sweep.d.num = 0: an empty sweep"),
    ],
)
def test_a_sweep_that_cannot_be_is_refused(engine: FakeEngine, sweep: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError) as error:
        plan_sweep(FakeScene(sweep))
    assert message in str(error.value)


def test_an_ask_cannot_have_the_name_of_another_column(
    engine: FakeEngine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = FakeScene({"d": ["1 in"]}, ask={"d": "d"})
    monkeypatch.setattr(fake, "ASKS", (replace(fake.ASKS[0], key="d"), *fake.ASKS[1:]))
    with pytest.raises(SceneError, match=r"fake\.toml: ask\.d: this name"):
        run.sweep_files(scene, tmp_path / "out")
    assert not (tmp_path / "out").exists()
