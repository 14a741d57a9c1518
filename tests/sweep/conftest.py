"""A formula in place of the engine, and a sweep that was killed."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest

from tests.sweep.fake import FakeEngine, stand_ins
from tests.sweep.processes import child, wait_for_parts


@pytest.fixture
def engine(monkeypatch: pytest.MonkeyPatch) -> FakeEngine:
    engine = FakeEngine()
    for module, name, fake in stand_ins(engine):
        monkeypatch.setattr(module, name, fake)
    return engine


@pytest.fixture
def killed(tmp_path: Path) -> Path:
    """The folder of a sweep that was killed in the middle."""
    with child(tmp_path / "out") as process:
        wait_for_parts(process, tmp_path / "out", 3)
        process.send_signal(signal.SIGKILL)
    return tmp_path / "out"
