"""A result that is no more what was written is found: by --resume, and by check."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest

from planemotion import StudyError, load_text
from planemotion.base.checksums import faults_of, require_sound
from planemotion.compile.flatten import flatten
from planemotion.engine import call, history
from planemotion.pictures.panels import open_sweep
from planemotion.sweep.run import sweep_files
from planemotion.sweep.verify import verify
from tests.scenes.pendulum import RELEASED

# One case fails and has a message.
STUDY = RELEASED.replace('{ from = "0.5 m", to = "1 m", num = 6 }', '["0.5 m", "-1 m", "1 m"]')


@pytest.fixture
def result(tmp_path: Path) -> Path:
    """A finished sweep."""
    return sweep_files(load_text(STUDY), tmp_path).result


def resume(result: Path) -> int:
    """Cases that are computed when the sweep is gone on with."""
    return sweep_files(load_text(STUDY), result.parent, resume=True).computed


def faults(path: Path) -> list[str]:
    return [fault for one in verify(path) for fault in one.faults]


def test_a_sound_result_is_verified(result: Path) -> None:
    assert resume(result) == 0
    assert [one.path.name for one in verify(result.parent)] == ["pendulum.h5", "pendulum.csv"]
    assert faults(result.parent) == faults(result) == []


def _status(file: h5py.File) -> None:
    file["status"][0] = 99


def _number(file: h5py.File) -> None:
    file["omega"][2] += 1e-15


def _error(file: h5py.File) -> None:
    file["omega_error"][0] *= 2


def _grid(file: h5py.File) -> None:
    file["L"][0] = 0.6


def _unit(file: h5py.File) -> None:
    file["omega"].attrs["units"] = "deg/s"


def _message(file: h5py.File) -> None:
    file["message"][1] = "all is well"


def _more(file: h5py.File) -> None:
    file["extra"] = 1


def _less(file: h5py.File) -> None:
    del file["reaction"]


def _says(file: h5py.File) -> None:
    file.attrs["title"] = "another"


@pytest.mark.parametrize(
    ("change", "named"),
    [
        (_status, "status"),
        (_number, "omega"),
        (_error, "omega_error"),
        (_grid, "L"),
        (_unit, "omega"),
        (_message, "message"),
        (_more, "extra"),
        (_less, "reaction"),
        (_says, "its attributes"),
    ],
)
def test_what_was_changed_is_named(result: Path, change: Callable[[h5py.File], None], named: str) -> None:
    with h5py.File(result, "r+") as file:
        change(file)
    assert faults(result) == [f"{named}: not what was written"]
    with pytest.raises(
        StudyError, match=rf"this result is damaged: {named}: not what was written\. Remove it"
    ):
        resume(result)


def test_no_flipped_bit_passes(result: Path) -> None:
    """Of a file with a bit flipped nothing is taken that is not what was written."""
    sound, chosen = result.read_bytes(), random.Random(18)
    wanted = _content(result)
    found = 0
    for _ in range(150):
        damaged = bytearray(sound)
        place = chosen.randrange(len(sound))
        damaged[place] ^= 1 << chosen.randrange(8)
        result.write_bytes(damaged)
        if faults_of(result):
            found += 1
            with pytest.raises(StudyError):
                resume(result)
        else:
            assert _content(result) == wanted, place  # the bit stands where nothing is read
    assert found > 50


def _content(path: Path) -> dict[str, list[object]]:
    with h5py.File(path, "r") as file:
        return {
            name: [str(file[name].attrs.get("units")), file[name][()].tobytes()] for name in ("omega", "L")
        }


def test_a_result_of_an_earlier_version_is_told(result: Path) -> None:
    with h5py.File(result, "r+") as file:
        del file.attrs["checksums"]
    assert "it has no checksums: an earlier version wrote it" in faults(result)[0]
    with h5py.File(result, "r+") as file:
        file.attrs["manifest"] = file.attrs["manifest"].replace('"format": 5', '"format": 4')
    with pytest.raises(StudyError, match=r"in another format \(4, now 5\)"):
        resume(result)


@pytest.mark.parametrize("damage", ["cut", "flipped", "longer", "empty"])
def test_a_damaged_table_is_told_and_written_anew(result: Path, damage: str) -> None:
    table = result.with_suffix(".csv")
    sound = table.read_bytes()
    flipped = bytearray(sound)
    flipped[len(flipped) // 2] ^= 1
    table.write_bytes(
        {"cut": sound[:-10], "flipped": bytes(flipped), "longer": sound + b"\n", "empty": b""}[damage]
    )
    assert faults(result.parent) == ["it is not the table of pendulum.h5"]
    assert resume(result) == 0
    assert table.read_bytes() == sound


def test_a_recorded_run_is_verified(tmp_path: Path) -> None:
    path = tmp_path / "run.h5"
    scene = load_text(RELEASED)
    flat = flatten(scene)
    history.write(path, {"": call.trace(flat, flat.defaults)}, {"id": scene.id})
    assert faults(path) == []
    with h5py.File(path, "r+") as file:
        file["AB.omega"][3] += 1e-12
    assert faults(path) == ["AB.omega: not what was written"]


def read_all(path: Path) -> None:
    """All that `plot` reads, without the picture, which takes longer."""
    require_sound(path)
    if history.is_history(path):
        history.read(path)
    else:
        open_sweep(path).close()


@pytest.mark.parametrize("kind", ["sweep", "history"])
def test_no_damaged_file_is_drawn(kind: str, result: Path) -> None:
    """With its checksums, and as an earlier version wrote it: drawn, or told, never anything else."""
    path = result
    if kind == "history":
        path = result.with_name("run.h5")
        flat = flatten(load_text(RELEASED))
        history.write(path, {"": call.trace(flat, flat.defaults)}, {"id": "x"})
    for sealed in (True, False):
        if not sealed:
            with h5py.File(path, "r+") as file:
                del file.attrs["checksums"]
        sound, chosen, told = path.read_bytes(), random.Random(18), 0
        for _ in range(40):
            damaged = bytearray(sound)
            for _ in range(3):
                damaged[chosen.randrange(min(12_000, len(sound)))] ^= 1 << chosen.randrange(8)
            path.write_bytes(damaged)
            try:
                read_all(path)
            except StudyError:
                told += 1
        assert told > 5
        path.write_bytes(sound)
