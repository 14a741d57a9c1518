"""A sweep on a thousand workers: who waits for whom, by the clock of tests/sweep/thousand.py."""

from __future__ import annotations

import pytest

from planemotion.sweep import spread
from planemotion.sweep.size import memory
from tests.sweep.thousand import Costs, simulate

COSTS = Costs(received=5e-9, stored=5e-7, stored_block=0.01, case_bytes=104)
STORED = COSTS.received + COSTS.stored


def test_a_thousand_workers_do_not_wait_where_a_case_takes_some_milliseconds() -> None:
    """The disk needs a tenth of the time in which they compute; to begin and to end costs little."""
    found = simulate(10**8, 1000, 0.01, COSTS, life=1e99)
    assert found.efficiency > 0.9
    assert found.own < 0.6
    assert found.longest < 61
    assert found.deaths == 0


def test_the_disk_alone_is_waited_for_where_cases_are_quick() -> None:
    """A thousand workers compute ten times as fast as one process stores: its clock is that of the sweep."""
    cases = 10**8
    found = simulate(cases, 1000, 5e-5, COSTS, life=1e99)
    assert found.own > 0.9
    assert found.seconds > cases * STORED
    assert found.efficiency < 0.2


def test_blocks_that_wait_for_the_disk_fit_into_memory() -> None:
    """Whatever a block holds, and however fast it comes."""
    for of_case in (104, 1040):
        costs = Costs(5e-9, 5e-7, 0.01, of_case)
        found = simulate(3 * 10**7, 1000, 1e-5, costs, life=1e99)
        assert found.gigabytes < 1.05 * spread._HELD * memory() / 1e9, of_case


def test_workers_that_die_cost_no_more_than_their_blocks() -> None:
    found = simulate(10**8, 1000, 0.01, COSTS, life=2e4)
    assert found.deaths > 30
    assert found.efficiency > 0.85


@pytest.mark.parametrize("number", [1, 2, 32])
def test_few_workers_have_work_to_the_end(number: int) -> None:
    found = simulate(10**6, number, 1e-3, COSTS, life=1e99)
    assert found.efficiency > 0.93
