"""Every scene that is shipped is told about: its start is assembled, and it is explained, without a fault."""

from __future__ import annotations

from pathlib import Path

import pytest

from planemotion import load, load_text
from planemotion.report import explain as explanations

STUDIES = Path(__file__).parents[2] / "studies"


@pytest.mark.parametrize("part", range(4))
def test_every_shipped_scene_is_checked_and_explained(part: int) -> None:
    files = sorted(STUDIES.glob("chapter17/*.toml")) + sorted(STUDIES.glob("*.toml"))
    assert len(files) > 160
    for file in files[part::4]:
        scene = load(file)
        for report in (explanations.check(scene), explanations.explain(scene)):
            assert not report.faults, file
            assert report.text.startswith(scene.id)


def test_rows_of_a_section_may_end_early() -> None:
    """Events with and without actions stand below each other, in whatever order."""
    strike = '{ when = "start", do = [{ impulse = "P", value = ["1 N*s", 0] }] }'
    events = f'events = {{ a = "t = 1 s", b = {strike} }}'
    text = f'until = "a"\n{events}\nbodies.P = {{ mass = "1 kg", at = [0, 0] }}'
    lines = explanations.explain(load_text(text)).text.splitlines()
    assert "  a  t = 1 s" in lines
    assert any(line.startswith("  b  start    impulse [1 N*s, 0] on P") for line in lines)
