"""What is looked at for errors and margins alone changes nothing of the motion."""

from __future__ import annotations

import numpy as np
import pytest

import planemotion
from planemotion._layout import PM_OK
from planemotion.compile.flatten import flatten
from planemotion.engine.call import run_cases
from planemotion.engine.outcome import CaseResults
from tests.stress.contacts.throws import throw


def _run(number: int, estimate: bool) -> CaseResults:
    scene = planemotion.load_text(throw(number).text()).with_values({"solve.estimate": estimate})
    flat = flatten(scene, history=False)
    return run_cases(flat, np.atleast_2d(flat.defaults))


@pytest.mark.parametrize("number", [600001, 600003, 600012, 600017, 600021])
def test_the_motion_is_the_same_without_estimates(number: int) -> None:
    """Where no tighter pass is the answer.  600017: bounces end together, of which one has parted by then."""
    estimated, alone = _run(number, True), _run(number, False)
    assert estimated.status[0] == alone.status[0] == PM_OK
    assert estimated.out.tobytes() == alone.out.tobytes()
