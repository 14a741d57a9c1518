"""A quick part of `python -m tests.stress.contacts`, and that its checks see what is wrong."""

from __future__ import annotations

import numpy as np
import pytest

import planemotion
from planemotion import _layout as layout
from tests.stress.contacts import course, one_body, thrown
from tests.stress.contacts.instants import CONFIRMED, REFUTED, Instant, going_on, last, recounted, touches
from tests.stress.contacts.laws import (
    Problem,
    accelerations,
    goes_on,
    is_admissible,
    motions,
    obeys,
    one_contact,
)
from tests.stress.contacts.rest import faults
from tests.stress.contacts.throws import Throw, Thrown, Wall, throw
from tests.stress.contacts.verdict import RIGHT, is_fault, verdict

BLOWS = [(law, contacts, True) for law in one_body.LAWS for contacts in (1, 2, 3)]
STARTS = [("newton", contacts, False) for contacts in (1, 2, 3)]


@pytest.mark.parametrize(("law", "contacts", "blow"), BLOWS + STARTS)
def test_one_body_obeys_the_laws_restated(law: str, contacts: int, blow: bool) -> None:
    words = one_body.table(1, 150, contacts, law, blow=blow)
    assert {word: n for word, n in words.items() if is_fault(word)} == {}
    assert words[RIGHT] > 100


@pytest.mark.parametrize("seed", [20004, 20009, 20018, 20023])
def test_several_motions_are_counted_whatever_the_order(seed: int) -> None:
    """One that obeys the laws to the last bit does not hide another that is rounded a little more."""
    assert not [word for word in one_body.table(seed, 500, 3, "newton", blow=False) if is_fault(word)]


@pytest.mark.parametrize(
    ("law", "contacts", "seed", "case", "blow", "word"),
    [
        ("poisson", 4, 5027, 168, True, "not unique"),  # all slips but 0.1 % have ended: rounding decided
        ("newton", 2, 700002, 121, False, "not unique"),  # a slip of none: that of rounding decided
        ("newton", 3, 700020, 457, False, "not unique"),
        (
            "newton",
            2,
            820001,
            439,
            False,
            "not unique",
        ),  # next to a lock: the order decided
        (
            "poisson",
            4,
            820003,
            486,
            True,
            "no motion",
        ),  # parts by 4e-10 before it is needed
        ("newton", 3, 20014, 14, True, "no motion"),  # what comes nearest lets a contact approach by 6e-8
        ("poisson", 4, 20030, 121, True, "not unique"),  # motions that differ by 1e-5
        ("newton", 2, 950000, 414, True, "right"),  # drawn together by 1e-12 m/s^2, seen by nobody
        ("stronge", 2, 20021, 363, True, "right"),  # slips on at a speed of 6e-7 of the blow
        ("poisson", 2, 20035, 235, True, "right"),  # loads of 1e7 that all but cancel
        ("poisson", 4, 20040, 320, True, "right"),
    ],
)
def test_blows_that_only_rounding_or_closeness_decided(
    law: str, contacts: int, seed: int, case: int, blow: bool, word: str
) -> None:
    drawn = one_body.seeded(seed, 500, contacts, law, blow=blow).case(case)
    assert one_body.judged(drawn, law, blow=blow) == [word]


def test_what_is_thrown_comes_to_rest_in_equilibrium_whatever_the_order_and_the_mirror() -> None:
    rows = list(thrown.table(range(40), 2))
    assert [row for row in rows if row.word not in thrown.BY_THEORY] == []
    assert sum(row.word == "ok" for row in rows) > 35


@pytest.mark.parametrize(
    "number",
    [
        13,  # corners of two boxes at one place
        16,  # blows at one instant, hundreds of them
        86,  # a bounce that is short beside the step
        166,  # passes with other numbers of blows that agree
        330,  # a rocking crate, one blow apart in two passes
        12595,  # a corner parts slower than can be seen, in free flight
        22307,
        24246,
        881125,  # a box flat on one wall of a gutter, a corner on the other: rounding held it
        902476,
        909745,
        911726,
        882190,
        901562,
        906463,
        570098,  # two boxes side by side, all but at rest: closing a gap of 7e-11 m put them 1 mm away
        2107614,  # friction drives a box into a gutter as it clatters to rest: its slip was left without any
        2118808,  # a corner bounces while another one still slips: it gains speed in flight
        532222,  # in a stack a corner is sunk by a hair where others have come to rest
    ],
)
def test_throws_that_did_not_go_on(number: int) -> None:
    assert thrown.become(number).word in ("ok", "undecided")


@pytest.mark.parametrize(
    "number",
    [
        930508,  # loads of 1e9 N, of either sign, where corners hold each other
        931104,
        931258,  # stuck in one pass, slipping in the other, as a series of blows ends: then both stick
    ],
)
def test_what_no_motion_hangs_on_leaves_no_run_undecided(number: int) -> None:
    assert thrown.become(number).word == "ok"


def _problem() -> Problem:
    """A block that falls flat on two feet."""
    feet = np.array([[[0, 1, -0.5], [1, 0, 0.3]], [[0, 1, 0.5], [1, 0, 0.3]]])
    return Problem(
        np.array([1, 1, 0.1]), feet, np.array([0.2, 0.2]), np.array([0.5, 0.5]), np.array([1.0, -1, 0])
    )


def test_the_laws_tell_right_from_wrong() -> None:
    x = _problem()
    (after,) = motions(x)
    assert obeys(x, after)
    assert is_admissible(x, after)
    for off in np.eye(3) * 1e-3:
        assert not obeys(x, after + off)
    counts = np.ones(20)
    assert verdict(x, after, 0, 0 * counts, "newton", blow=True) == RIGHT
    assert is_fault(verdict(x, after + 1e-3, 0, 0 * counts, "newton", blow=True))
    assert is_fault(verdict(x, after, -9, 0 * counts, "newton", blow=True))


def test_what_is_open_after_a_blow_is_enumerated_there() -> None:
    """Two contacts that slide on: no motion goes on from there (case 350), or two do (1058)."""
    drawn = one_body.draw(np.random.default_rng([12, 2, 7]), 1500, 2, blow=True)
    found = one_body.run(one_body.scene(2, "newton", blow=True), drawn, blow=True)
    told = {350: (layout.PM_PAINLEVE, "no motion"), 1058: (layout.PM_NOT_UNIQUE, "not unique")}
    struck = np.zeros(20)
    struck[layout.PM_COUNT_JUMPS] = 1
    for case, (status, word) in told.items():
        x, after = drawn.problem(case), found.out[case]
        assert found.status[case] == status
        assert verdict(x, after, status, struck, "newton", blow=True) == word
        other = layout.PM_PAINLEVE + layout.PM_NOT_UNIQUE - status
        assert is_fault(verdict(x, after, other, struck, "newton", blow=True))
    for case in np.flatnonzero(found.status == 0)[:40]:
        for status, _ in told.values():
            assert is_fault(verdict(drawn.problem(case), after, status, struck, "newton", blow=True))


def test_a_foot_that_slides_is_drawn_in_or_goes_on() -> None:
    """Of a rod on one foot, sliding with friction: 1 + 3 cos (cos - mu sin) < 0 and omega tell (Painleve).

    Where that drift cannot be seen beside 1 m/s, two motions are no fault.
    """
    for degrees, omega, count in ((50, 0.0, 1), (50, 3.0, 2), (50, 1e-4, 2), (50, 1e-6, 2), (20, 3.0, 1)):
        s, c = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
        foot = np.array([[[0, 1, -0.5 * c], [1, 0, 0.5 * s]]])
        x = Problem(np.array([1, 1, 1 / 12]), foot, np.array([1.6]), np.zeros(1), np.array([-1.0, 0, 0]))
        v = np.array([-1 - 0.5 * omega * s, 0.5 * omega * c, omega])
        assert len(accelerations(x, v)) == count
        assert goes_on(x, v) == (count == 1 or omega < 1e-5)


def test_the_course_of_one_contact_is_that_of_routh() -> None:
    """Two ways to follow it: by its shares, enumerated, and by its rates."""
    rng = np.random.default_rng(3)
    same = 0
    for law in ("poisson", "stronge"):
        drawn = one_body.draw(rng, 60, 1, blow=True)
        for i in range(60):
            x = drawn.problem(i)
            end, alone = course.follow(x, law), one_contact(x, 0, law)
            if end.after is None:
                continue
            assert alone is not None
            np.testing.assert_allclose(end.after, alone, atol=1e-7)
            same += 1
    assert same > 100


def test_what_does_not_rest_is_seen() -> None:
    box = Thrown("plate", (0.4, 0.2), 1, (0, 1, 0), (0, 0, 0))
    alone = Throw("box", (box,), (Wall(),), (), 0.5, 0, "newton")
    assert faults(alone, [(0, 0.1, 0)], 0) == []
    assert "a body is under a wall" in faults(alone, [(0, 0.09, 0)], 0)
    assert "1 of the weights are not held" in faults(alone, [(0, 0.11, 0)], 0)
    assert any("not held" in fault for fault in faults(alone, [(0, np.hypot(0.2, 0.1) - 0.02, 0.4)], 0))
    assert any("nowhere" in fault for fault in faults(alone, [(0, 2, 0)], 0))
    two = Throw("stack", (box, box), (Wall(),), ((0, 1),), 0.5, 0, "newton")
    assert faults(two, [(0, 0.1, 0), (0.1, 0.3, 0)], 0) == []
    assert "two bodies overlap" in faults(two, [(0, 0.1, 0), (0.1, 0.28, 0)], 0)
    assert any("not held" in fault for fault in faults(two, [(0, 0.1, 0), (0.25, 0.3, 0)], 0))


def test_a_number_is_always_the_same_throw() -> None:
    assert throw(7) == throw(7)
    assert len({throw(number).kind for number in range(100)}) == 7


@pytest.mark.parametrize(
    ("number", "route"),
    [
        (1447, ""),  # what nearly locks: a slip below all speeds, stopped, moves a body by much more
        (1127, ""),  # at a dead centre of four dominoes a slip reverses, and another contact slides
        (3926, ""),  # two contacts depend on others, and each hides that of the other
        (2820, "ida"),
        (1579, ""),  # a corner cuts off the end of an edge
        (1743, ""),
        (2328, ""),  # next to where dominoes lock, what sticks is held by joints alone
        (23801, ""),  # two slips at once
        (2787, ""),  # what parts so slowly that no time shows in which it comes back has not bounced
        (501206, ""),  # a slip that reverses where two contacts lock, of which one parts then
        (501822, ""),  # a short bounce close to the end of an edge, which is passed before the next look
        (502434, ""),  # a blow leaves some slip of what sticks, and it slides the other way
        (501261, ""),  # a series of blows that ends at once after a slip has ended
        (701426, ""),
        (3022, ""),  # a corner as near to the end of an edge as counts as touching: no decision of the errors
        (508119, ""),  # a corner that goes over the end of an edge fired there again and again
        (102250, ""),  # what turns at once on a path has no way that energies show
        (501150, ""),  # a corner on the end of an edge slides over it, and comes back before a step ends
        (508695, ""),
        (
            506792,
            "",
        ),  # where bounces of one foot end another one stands open by less than these would be high
        (531863, ""),  # it comes to rest while a foot is 5e-10 m above its wall
        (
            507585,
            "",
        ),  # a corner moves along behind the end of an edge, close beside it: steps on a path were short
        (501165, ""),  # corner on corner, two contacts are one for an instant
        (504979, ""),  # of slips that hang on each other one is below rounding until another has ended
        (501531, ""),
        (510444, ""),  # a corner parts as a series of blows at another one is cut off: that is no decision
        (532431, ""),  # a box flat on a wall: a corner on the other wall slips to the second order
        (532431, "rk"),
        (532431, "ida"),
        (2008459, ""),  # likewise, and it slips still back
        (2052044, ""),
        (510507, ""),  # a coarse run called bounces endless of a box that was struck again later on
    ],
)
def test_throws_that_failed_once(number: int, route: str) -> None:
    one = throw(number)
    ran = thrown.Ran(one.text(route=route), len(one.bodies))
    decided = ("ok", "undecided") if route == "ida" else ("ok",)  # its errors are larger
    assert ran.status in decided, ran.why
    if ran.status == "ok":
        assert faults(one, ran.poses, ran.kinetic) == []


@pytest.mark.parametrize(
    "number",
    [
        509136,  # a box lies flat on one wall: the corner on the other one holds a third for an instant
        714977,  # likewise: what stands at right angles to a wall holds little more than what it hides
    ],
)
def test_boxes_in_gutters_that_failed_once(number: int) -> None:
    assert thrown.become(number).word in ("ok", "not_unique")


@pytest.mark.parametrize(
    ("number", "mirrored", "turned"),
    [
        (500179, False, True),  # feet held as they clatter, whose friction drove them
        (509146, True, False),  # dominoes that lock ever more nearly
        (509492, True, False),
        (700202, True, False),  # others hold two contacts for an instant alone
        (700202, True, True),  # a corner on the end of an edge
    ],
)
def test_throws_that_the_order_or_the_mirror_decided(number: int, mirrored: bool, turned: bool) -> None:
    one = throw(number).mirrored() if mirrored else throw(number)
    ran = thrown.Ran(one.text(turned=turned), len(one.bodies))
    assert ran.status == "ok", ran.why
    assert faults(one, ran.poses, ran.kinetic) == []


def test_motions_of_a_rod_on_one_foot_are_counted() -> None:
    """Painleve: 1 + 3 cos (cos - mu sin) < 0; without rotation none goes on, with enough of it two do."""
    half = 0.5 * np.exp(1j * np.radians(50))
    for friction, omega, count in ((1.6, 0.0, 0), (1.6, 6.0, 2), (0.3, 0.0, 1)):
        velocity = (-1 - omega * half.imag, omega * half.real, omega)  # the foot slides at -1 m/s
        rod = Thrown("rod", (1.0,), 1, (half.real, half.imag, np.radians(50)), velocity)
        alone = Throw("rod", (rod,), (Wall(),), (), friction, 0, "newton")
        x = Instant(alone, np.array([rod.pose]), np.array([velocity]))
        (foot,) = touches(x)
        assert len(going_on(x, [foot], x.velocity.ravel())) == count


@pytest.mark.parametrize(("number", "said"), [(714977, "not_unique"), (500039, "no_motion")])
def test_what_theory_leaves_open_is_recounted(number: int, said: str) -> None:
    row = thrown.become(number)
    assert (row.word, row.recount) == (said, CONFIRMED)
    here = last(throw(number))
    assert recounted(here, "no_motion" if said == "not_unique" else "not_unique") == REFUTED


def test_a_contact_that_only_carried_others_gives_nothing_back() -> None:
    """By Stronge's law: it was pushed at no speed, so that it took no work; a body stops dead there."""
    for seed, contacts, case in ((301, 3, 47), (303, 3, 125), (302, 4, 476)):
        drawn = one_body.draw(np.random.default_rng([seed, contacts, 2, True]), 500, contacts, blow=True)
        found = one_body.run(one_body.scene(contacts, "stronge", blow=True), drawn, blow=True)
        np.testing.assert_allclose(found.out[case], 0, atol=1e-12)


def test_a_run_of_which_no_comparison_stands_has_no_error_that_could_be_believed() -> None:
    """Its coarse runs find no contacts for a blow late in a series, where it finds some itself."""
    result = planemotion.load_text(throw(506792).text()).run()
    assert result.status == "ok"
    assert all(ask.error is None for ask in result.asks.values())
    assert "a second run of the case, and that one failed or went another way" in result.notes[0]
