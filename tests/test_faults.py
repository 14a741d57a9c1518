"""The tables of planted faults follow the kernel: each still has its place (`make faults` plants them)."""

import pytest

from tests import ROOT
from tests.faults import BY_ROOM, FAULTS
from tests.faults.fault import Fault, planted


@pytest.mark.parametrize("fault", FAULTS, ids=[fault.name for fault in FAULTS])
def test_each_fault_fits_its_source(fault: Fault) -> None:
    sound = (ROOT / "kernel" / fault.file).read_text(encoding="utf-8")
    assert planted(sound, fault) != sound


def test_no_two_faults_are_the_same() -> None:
    assert len({(fault.file, fault.old, fault.new) for fault in FAULTS}) == len(FAULTS)
    assert len({fault.name for fault in FAULTS}) == len(FAULTS)


def test_each_fault_is_listed_with_its_room() -> None:
    listed = [(room, fault.file.rpartition("/")[0]) for room, faults in BY_ROOM.items() for fault in faults]
    assert all(room == folder for room, folder in listed)
    assert all(BY_ROOM.values())
