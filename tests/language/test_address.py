"""Addresses: what is read, that it can be written again, and messages."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planemotion.base.errors import SceneError
from planemotion.language.address import KEYWORDS, Address, parse_address
from planemotion.language.parser import parse


@pytest.mark.parametrize(
    ("text", "address"),
    [
        ("t", Address("t")),
        ("AB.omega", Address("AB", ("omega",))),
        ("AB.B.x in DE", Address("AB", ("B", "x"), in_="DE")),
        ("A.force.y on AB", Address("A", ("force", "y"), on="AB")),
        ("bars[3].normal", Address("bars", ("normal",), member=3)),
        ("bars[-2].normal", Address("bars", ("normal",), member=-2)),
        ("belt.tension[2]", Address("belt", ("tension",), member=2, member_after=1)),
        ("energy.kinetic", Address("energy", ("kinetic",))),
        ("angular_momentum about P", Address("angular_momentum", about="P")),
        ("slab.angular_momentum about slab.P", Address("slab", ("angular_momentum",), about="slab.P")),
        ("AB.velocity along 30 deg", Address("AB", ("velocity",), along="30 deg")),
        ("AB.velocity along -30 deg in DE", Address("AB", ("velocity",), along="-30 deg", in_="DE")),
        ("AB.velocity along ground.run", Address("AB", ("velocity",), along="ground.run")),
        (
            "AB.velocity along (a + (30 deg)) in DE",
            Address("AB", ("velocity",), along="a + (30 deg)", in_="DE"),
        ),
        ("  AB.x   on  DE ", Address("AB", ("x",), on="DE")),
    ],
)
def test_read(text: str, address: Address) -> None:
    assert parse_address(text) == address
    assert parse_address(str(address)) == address


WORD = st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,5}", fullmatch=True).filter(lambda word: word not in KEYWORDS)
OPTIONAL_WORD = st.none() | WORD


@st.composite
def addresses(draw: Any) -> Any:
    path = tuple(draw(st.lists(WORD, min_size=1, max_size=3)))
    member = draw(st.none() | st.integers(-99, 99))
    return Address(
        thing=draw(WORD),
        path=path,
        member=member,
        in_=draw(OPTIONAL_WORD),
        on=draw(OPTIONAL_WORD),
        about=draw(OPTIONAL_WORD),
        along=draw(OPTIONAL_WORD | st.sampled_from(["30 deg", "-0.5", "a + (3 deg)"])),
        member_after=draw(st.integers(0, len(path))) if member is not None else 0,
    )


@given(addresses())
def test_round_trip(address: Address) -> None:
    assert parse_address(str(address)) == address
    assert parse(str(address)) == address


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "it ends where a name is wanted"),
        ("3.x", 'a name is wanted, not "3." (character 1)'),
        ("AB.x in", 'it ends where a body after "in" is wanted'),
        ("AB.x in DE in FG", '"in" is said twice'),
        ("AB.x in DE[2]", '"DE[2]" has an index; "in" takes a plain name'),
        ("a.inertia about 3", 'a point after "about" is wanted, not "3" (character 17)'),
        ("bars[1].tension[2]", '"bars[1].tension[2]" has two indices; one is possible'),
        ("bars[].x", 'in, on, about, along or the end is wanted, not "[" (character 5)'),
        ("bars[12345678901].x", 'not "["'),
        ("AB.x + 1", 'in, on, about, along or the end is wanted, not "+" (character 6)'),
        ("AB.velocity along (a", 'the parenthesis after "along" is not closed'),
        ("AB.velocity along", 'it ends where an angle or a line after "along" is wanted'),
    ],
)
def test_messages(text: str, message: str) -> None:
    with pytest.raises(SceneError) as caught:
        parse_address(text)
    assert message in str(caught.value)
