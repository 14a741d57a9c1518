"""The table of planted faults follows the kernel: each still has its place (`make faults` plants them)."""

import pytest

import faults


@pytest.mark.parametrize("fault", faults.FAULTS, ids=[fault.name for fault in faults.FAULTS])
def test_each_fault_fits_its_source(fault: faults.Fault) -> None:
    sound = (faults.ROOT / "kernel" / fault.file).read_text(encoding="utf-8")
    assert faults.planted(sound, fault) != sound


def test_no_two_faults_are_the_same() -> None:
    assert len({(fault.file, fault.old, fault.new) for fault in faults.FAULTS}) == len(faults.FAULTS)
    assert len({fault.name for fault in faults.FAULTS}) == len(faults.FAULTS)
