"""The scenes of docs/ run as they stand, and give what the text beside them says."""

from __future__ import annotations

import re

import pytest

import planemotion
from tests import ROOT

LAWS = re.findall(r"```toml\n(.*?)```", (ROOT / "docs/impact_laws.md").read_text(encoding="utf-8"), re.DOTALL)
KANE, CRADLE, SPHERES, BEAM = LAWS


def test_kanes_paradox() -> None:
    limited = planemotion.load_text(KANE).run()
    assert limited.lost == pytest.approx(0, abs=1e-12)
    assert limited.counts["limited_blows"] == 1
    stronge = planemotion.load_text(KANE.replace('"newton"', '"stronge"')).run()
    assert stronge.asks["lost"].value == pytest.approx(0.7169, abs=1e-4)
    assert stronge.counts["limited_blows"] == 0


def test_the_cradle() -> None:
    together = planemotion.load_text(CRADLE).run()
    assert (together.v1, together.v2, together.v3) == pytest.approx((-1 / 3, 2 / 3, 2 / 3), abs=1e-12)
    in_turn = planemotion.load_text(CRADLE + '[solve]\nimpacts = "sequential"\n').run()
    assert (in_turn.v1, in_turn.v2, in_turn.v3) == pytest.approx((0, 0, 1), abs=1e-12)


def test_the_cradle_with_stiffnesses() -> None:
    spheres = planemotion.load_text(SPHERES).run()
    assert (spheres.v1, spheres.v2, spheres.v3) == pytest.approx((-0.071, 0.076, 0.995), abs=5e-4)


def test_the_beam_on_three_supports() -> None:
    least = planemotion.load_text(BEAM).run()
    assert least.asks["at_a"].value == pytest.approx(98.1 * 11 / 26, rel=1e-11)
    without = planemotion.load_text(BEAM.replace('"least"', '"none"')).run()
    assert without.asks["at_a"].value is None
    for result in (least, without):
        assert result.asks["all"].value == pytest.approx(98.1, rel=1e-11)
