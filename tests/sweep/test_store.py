"""The files of a sweep: blocks, parts, the lock, the result file, its table and its summary."""

from __future__ import annotations

import csv
import errno
import math
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from planemotion._layout import PM_ASSEMBLY, PM_AUDITS, PM_REASON_NOT_REACHED, PM_ROUTE_RK
from planemotion.base.errors import StudyError
from planemotion.base.files import appearing
from planemotion.compile.asks import Asked
from planemotion.sweep.block import Block
from planemotion.sweep.layout import Coordinate, Layout
from planemotion.sweep.locks import OutputLock
from planemotion.sweep.netcdf import hyperslabs, write_result
from planemotion.sweep.parts import part_faults
from planemotion.sweep.store import SweepStore
from planemotion.sweep.table import summarise, write_csv

MANIFEST = {"format": 1, "scene": "one\ntwo", "sweep": {"d": {"num": 3}}, "checksums": {"tables": "a"}}


def block(
    first: int, count: int, columns: int = 3, runs: int = 1, message: dict[int, str] | None = None
) -> Block:
    """Rows that tell their case."""
    case = np.arange(first, first + count)
    return Block(
        value=case[:, None] + np.arange(columns) / 10,
        reason=np.zeros((count, 2), np.int8),
        status=np.where(np.isin(case, list(message or {})), PM_ASSEMBLY, 0).astype(np.int32),
        run_status=np.zeros((count, runs), np.int32),
        route=np.full((count, runs), PM_ROUTE_RK, np.int8),
        solves=np.arange(first, first + count, dtype=np.int32),
        audit=case[:, None, None] * np.full((1, runs, PM_AUDITS), 1e-15),
        error=((case[:, None] + np.arange(columns) / 10) * 1e-12).astype(np.float32),
        trust=(case[:, None] + np.array([100.0, 0.5])).astype(np.float32),
        message={at - first: text for at, text in (message or {}).items() if first <= at < first + count},
        seconds=0.25,
    )


def layout(*sizes: int, runs: Any = (), at: Any = None, estimate: bool = False) -> Layout:
    dims = tuple((f"p{i}", size) for i, size in enumerate(sizes))
    coordinates = tuple(
        Coordinate(name, name, "min", np.arange(size, dtype=np.float64) + 0.5) for name, size in dims
    )
    asks = (Asked("v", "s", 1, 0, 1, False, "t"), Asked("w", "h", 1, 1, 2, True, "each t", at))
    return Layout(dims, coordinates, asks, runs, estimate)


def same(a: Block, b: Block) -> bool:
    names = ("value", "reason", "status", "run_status", "route", "audit", "error", "trust")
    equal = all(getattr(a, name).tobytes() == getattr(b, name).tobytes() for name in names)
    return equal and (a.message, a.seconds) == (b.message, b.seconds)


def store(folder: Path, resume: bool = False, **changes: Any) -> SweepStore:
    return SweepStore(folder, "s", 10, {**MANIFEST, **changes}, resume=resume)


# ---- blocks ------------------------------------------------------------------------------------------------


def test_a_block_comes_back_bit_for_bit() -> None:
    odd = block(3, 4, message={4: "open by 3 µm", 6: 'a "line"\nand another'})
    odd.value[0] = [math.nan, -0.0, 5e-324]
    assert same(Block.from_bytes(odd.to_bytes()), odd)
    assert odd.to_bytes() == odd.to_bytes()
    empty = block(0, 0)
    assert same(Block.from_bytes(empty.to_bytes()), empty)


def test_joined_blocks_are_the_whole() -> None:
    message = {1: "a", 5: "b", 9: "c"}
    whole = block(0, 10, message=message)
    pieces = [block(first, count, message=message) for first, count in ((0, 3), (3, 1), (4, 6))]
    joined = Block.join(pieces)
    assert joined.seconds == 0.75
    assert same(Block(**{**vars(joined), "seconds": 0.25}), whole)


@given(st.lists(st.integers(1, 5), min_size=1, max_size=4), st.data())
def test_hyperslabs_cover_the_cases_in_order(shape: Any, data: Any) -> None:
    cases = math.prod(shape)
    first = data.draw(st.integers(0, cases))
    count = data.draw(st.integers(0, cases - first))
    numbers = np.arange(cases).reshape(shape)
    boxes = list(hyperslabs(shape, first, count))
    covered = [number for box in boxes for number in numbers[box].ravel().tolist()]
    assert covered == list(range(first, first + count))
    assert len(boxes) <= 2 * len(shape) - 1


# ---- files -------------------------------------------------------------------------------------------------


def write_half(path: Path, fault: Exception) -> None:
    with appearing(path) as temporary:
        temporary.write_text("half")
        assert not path.exists()
        raise fault


def test_a_file_appears_whole_or_not_at_all(tmp_path: Path) -> None:
    path = tmp_path / "file"
    with pytest.raises(ZeroDivisionError):
        write_half(path, ZeroDivisionError())
    assert list(tmp_path.iterdir()) == []
    with appearing(path) as temporary:
        temporary.write_text("whole")
    assert path.read_text() == "whole"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("fault", "message"),
    [
        (OSError(errno.ENOSPC, "No space left on device"), "file: the disk .* is full.*--resume"),
        (OSError("unable to write (error message = 'No space left on device')"), "is full"),
        (PermissionError(errno.EACCES, "Permission denied"), "file: cannot be written: Permission denied"),
    ],
)
def test_what_the_system_says_becomes_a_message(tmp_path: Path, fault: Exception, message: str) -> None:
    with pytest.raises(StudyError, match=message):
        write_half(tmp_path / "file", fault)
    assert list(tmp_path.iterdir()) == []


def test_a_lock_keeps_others_out_until_it_is_released(tmp_path: Path) -> None:
    mine, other = OutputLock(tmp_path), OutputLock(tmp_path)
    mine.acquire()
    with pytest.raises(
        StudyError, match=rf"another sweep writes into this folder \(process {os.getpid()} on "
    ):
        other.acquire()
    other.release()
    assert mine.path.exists()
    mine.release()
    other.acquire()
    other.release()
    assert list(tmp_path.iterdir()) == []


def test_the_lock_file_of_a_dead_process_is_taken_over(tmp_path: Path) -> None:
    lock = OutputLock(tmp_path)
    lock.path.write_text(
        "process 1 on elsewhere, since 2001-01-01 00:00:00, and more than the new text is long " * 3
    )
    lock.acquire()
    assert lock.path.read_text().startswith(f"process {os.getpid()} on ")
    assert "2001" not in lock.path.read_text()
    lock.release()


# ---- the store ---------------------------------------------------------------------------------------------


def test_parts_may_come_in_any_order_and_are_read_in_order(tmp_path: Path) -> None:
    with store(tmp_path) as first:
        assert first.gaps() == [(0, 10)]
        first.add(6, block(6, 2))
        first.add(0, block(0, 3))
        assert first.gaps() == [(3, 3), (8, 2)]
    with store(tmp_path, resume=True) as again:
        assert (again.done, again.gaps()) == (5, [(3, 3), (8, 2)])
        again.add(8, block(8, 2))
        again.add(3, block(3, 3))
        assert again.gaps() == []
        assert same(Block(**{**vars(Block.join(list(again.blocks()))), "seconds": 0.25}), block(0, 10))


def test_a_sweep_without_a_part_leaves_nothing(tmp_path: Path) -> None:
    with store(tmp_path / "out"):
        assert (tmp_path / "out/s.parts/manifest.json").exists()
    assert list(tmp_path.iterdir()) == []


def test_other_results_in_the_folder_do_not_matter(tmp_path: Path) -> None:
    (tmp_path / "other.h5").write_text("mine")
    (tmp_path / "other.parts").mkdir()
    with store(tmp_path) as first:
        first.add(0, block(0, 1))
    assert (tmp_path / "other.h5").read_text() == "mine"


def test_a_part_that_is_there_twice_is_refused(tmp_path: Path) -> None:
    with store(tmp_path) as first:
        first.add(0, block(0, 4))
        first.add(6, block(6, 1))
    with store(tmp_path / "b") as other:
        other.add(3, block(3, 2))
    extra = next((tmp_path / "b").glob("s.parts/part-*"))
    extra.rename(tmp_path / "s.parts" / extra.name)
    with pytest.raises(StudyError, match=f"{extra.name}: its cases are not wanted or are there twice"):
        store(tmp_path, resume=True).__enter__()
    assert len(list(tmp_path.glob("s.parts/part-*"))) == 3


def test_a_part_does_not_pass_for_other_cases(tmp_path: Path) -> None:
    with store(tmp_path) as first:
        first.add(0, block(0, 4))
    (part,) = (tmp_path / "s.parts").glob("part-*")
    moved = part.rename(part.with_name(part.name.replace("part-000000000000", "part-000000000004")))
    with pytest.raises(
        StudyError, match=rf"{moved.name}: this part file is damaged, or is one of other cases"
    ):
        store(tmp_path, resume=True).__enter__()
    assert [moved.name in fault for fault in part_faults(moved.parent)] == [True]


def test_the_leftovers_of_a_kill_are_cleared_away(tmp_path: Path) -> None:
    with store(tmp_path) as first:
        first.add(0, block(0, 4))
    (tmp_path / "s.parts/.part-x.tmp").write_text("half")
    with store(tmp_path, resume=True):
        assert not list(tmp_path.glob("s.parts/.*"))


@pytest.mark.parametrize(
    ("changes", "said", "not_said"),
    [
        ({"scene": "one\nthree"}, "scene without the line `two`; scene with the line `three`", "tables"),
        ({"scene": "two\none"}, "scene in another order", "tables"),
        (
            {"sweep": {"e": {"num": 3}}},
            'sweep.d ({"num": 3}, now missing); sweep.e (missing, now {"num": 3})',
            "",
        ),
        ({"checksums": {"tables": "b"}}, 'checksums.tables ("a", now "b")', "scene"),
        ({"format": 2, "checksums": {"tables": "b"}}, "in another format (1, now 2)", "tables"),
    ],
)
def test_what_differs_is_named(tmp_path: Path, changes: dict[str, Any], said: str, not_said: str) -> None:
    with store(tmp_path) as first:
        first.add(0, block(0, 4))
    with pytest.raises(StudyError) as error:
        store(tmp_path, resume=True, **changes).__enter__()
    assert said in str(error.value)
    assert not not_said or not_said not in str(error.value)


def test_a_file_that_is_no_result_is_refused(tmp_path: Path) -> None:
    (tmp_path / "s.h5").write_text("mine")
    for resume, message in ((False, "never overwritten"), (True, "is not a whole result of a sweep")):
        with pytest.raises(StudyError, match=message):
            store(tmp_path, resume=resume).__enter__()
    assert [path.name for path in tmp_path.iterdir()] == ["s.h5"]
    assert (tmp_path / "s.h5").read_text() == "mine"


# ---- the result --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", [(10,), (2, 5), (5, 2), (1, 10, 1), (2, 1, 5)])
@pytest.mark.parametrize("pieces", [(10,), (3, 4, 3), (1,) * 10])
def test_every_case_finds_its_place(tmp_path: Path, shape: Any, pieces: tuple[int, ...]) -> None:
    message = {2: "two", 7: "seven"}
    firsts = np.cumsum((0, *pieces))
    blocks = [block(int(first), count, message=message) for first, count in zip(firsts, pieces, strict=False)]
    write_result(tmp_path / "r.h5", layout(*shape), blocks, {})
    with xr.open_dataset(tmp_path / "r.h5", engine="h5netcdf") as data:
        assert data.v.shape == shape
        assert data.v.values.ravel().tolist() == list(range(10))
        assert data.w.values.reshape(10, 2).tolist() == [[i + 0.1, i + 0.2] for i in range(10)]
        assert data.message.values.ravel().tolist() == [message.get(i, "") for i in range(10)]
        assert data.audit_energy.values.ravel().tolist() == [i * 1e-15 for i in range(10)]


def test_units_of_time_and_long_texts_survive(tmp_path: Path) -> None:
    text = "a scene\n" * 20_000
    write_result(tmp_path / "r.h5", layout(3), [block(0, 3)], {"scene": text})
    with xr.open_dataset(tmp_path / "r.h5", engine="h5netcdf") as data:
        assert data.attrs["scene"] == text
        assert (data.v.dtype, data.p0.dtype) == (np.float64, np.float64)
        assert [data[name].attrs["units"] for name in ("p0", "v", "w", "audit_energy")] == [
            "min",
            "s",
            "h",
            "1",
        ]
        assert data.attrs["elapsed_seconds"] == 0.25
        assert data.w_number.values.tolist() == [1, 2]


def test_a_list_over_a_grid_has_its_values(tmp_path: Path) -> None:
    write_result(tmp_path / "r.h5", layout(3, at=("deg", np.array([30.0, -90.0]))), [block(0, 3)], {})
    with xr.open_dataset(tmp_path / "r.h5", engine="h5netcdf") as data:
        assert data.w.sel(w_at=-90).values.tolist() == [0.2, 1.2, 2.2]
        assert data.w_at.attrs["unit"] == "deg"


def test_a_result_needs_all_cases(tmp_path: Path) -> None:
    with pytest.raises(StudyError, match="3 of 4 cases"):
        write_result(tmp_path / "r.h5", layout(4), [block(0, 3)], {})


def test_a_message_costs_no_space_where_all_is_well(tmp_path: Path) -> None:
    for name, message in (("well", None), ("ill", {5: "x"})):
        write_result(
            tmp_path / name,
            layout(200_000, 3),
            [block(i * 60_000, 60_000, message=message) for i in range(10)],
            {},
        )
    numbers = 600_000 * (3 * 8 + 4 + 2 + 1 + 4 + PM_AUDITS * 8)
    assert (tmp_path / "well").stat().st_size < numbers + 2_000_000
    assert (tmp_path / "ill").stat().st_size < numbers + 5_000_000


def test_the_table_says_why(tmp_path: Path) -> None:
    odd = block(0, 3, message={1: 'joints.A is "open",\nby 3 mm'})
    odd.value[2, 0] = math.nan
    odd.reason[2] = [PM_REASON_NOT_REACHED, PM_REASON_NOT_REACHED]
    write_result(tmp_path / "r.h5", layout(3), [odd], {})
    write_csv(tmp_path / "r.h5", tmp_path / "r.csv")
    with open(tmp_path / "r.csv", newline="") as file:
        rows = list(csv.reader(file))
    assert rows == [
        ["p0 [min]", "v [s]", "w[1] [h]", "w[2] [h]", "reason", "status"],
        ["0.5", "0.0", "0.1", "0.2", "", "ok"],
        ["1.5", "1.0", "1.1", "1.2", 'joints.A is "open",\nby 3 mm', "assembly"],
        ["2.5", "nan", "2.1", "2.2", "v: not reached; w: not reached", "ok"],
    ]


def test_a_summary_shows_both_ends_and_counts_the_statuses(tmp_path: Path) -> None:
    write_result(tmp_path / "r.h5", layout(10, 10), [block(0, 100, message={3: "a", 50: "b"})], {})
    summary = summarise(tmp_path / "r.h5", rows=4)
    assert summary.header == ("p0 [min]", "p1 [min]", "v [s]", "w[1] [h]", "w[2] [h]", "reason", "status")
    assert [row[2] for row in summary.rows] == [0, 33, 66, 99]
    assert (summary.cases, summary.statuses) == (100, {"ok": 98, "assembly": 2})
    assert len(summarise(tmp_path / "r.h5", rows=1000).rows) == 100
    with pytest.raises(StudyError, match=r"no\.h5: cannot be read"):
        summarise(tmp_path / "no.h5")


def test_errors_stand_beside_their_answers(tmp_path: Path) -> None:
    written = layout(2, 2, estimate=True)
    write_result(tmp_path / "s.h5", written, [block(0, 4)], {})
    with xr.open_dataset(tmp_path / "s.h5", engine="h5netcdf") as data:
        assert data.v.attrs["ancillary_variables"] == "v_error"
        assert data.w_error.dims == data.w.dims
        assert data.w_error.values.tolist() == (1e-12 * data.w.values).astype(np.float32).tolist()
        assert data.margin.values.tolist() == [[100, 101], [102, 103]]
    write_csv(tmp_path / "s.h5", tmp_path / "s.csv")
    with open(tmp_path / "s.csv", newline="") as file:
        header, *rows = csv.reader(file)
    assert header[5:] == ["v error [s]", "w error [h]", "margin", "reason", "status"]
    assert rows[3][5:8] == ["3e-12", "3.2e-12", "103"]
    assert summarise(tmp_path / "s.h5").header == (*header[:5], "reason", "status")
