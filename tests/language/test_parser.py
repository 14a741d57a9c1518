"""What is read, what is refused, limits and messages."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planemotion.base.errors import SceneError
from planemotion.language import dimensions
from planemotion.language.address import Address
from planemotion.language.homogeneity import dimension
from planemotion.language.leaves import names
from planemotion.language.parser import MAX_NESTING, parse
from planemotion.language.tree import Name, Number
from tests.language.expressions import PARAMETERS, no_leaf, value


@pytest.mark.parametrize(
    ("written", "value_si", "dimension_"),
    [
        ("10 in", 0.254, dimensions.LENGTH),
        ("180 rpm", 6 * math.pi, dimensions.ANGULAR_VELOCITY),
        ("-90 deg", -math.pi / 2, dimensions.DIMENSIONLESS),
        ("2 N/(m*s)", 2.0, dimensions.STIFFNESS / dimensions.TIME),
        (3, 3.0, dimensions.DIMENSIONLESS),
        (True, 1.0, dimensions.DIMENSIONLESS),
        (False, 0.0, dimensions.DIMENSIONLESS),
    ],
)
def test_a_quantity_is_a_number(written: Any, value_si: float, dimension_: Any) -> None:
    number = parse(written)
    assert isinstance(number, Number)
    assert not number.wild
    assert (number.value_si, number.dimension) == (pytest.approx(value_si, rel=1e-15), dimension_)


@pytest.mark.parametrize("zero", ["0", "0.0", "-0", 0, 0.0, "(0)"])
def test_a_literal_zero_is_wild(zero: str | float) -> None:
    node = parse(zero)
    assert isinstance(node, Number)
    assert node.wild
    assert dimension(parse(zero), no_leaf) is None


def test_a_zero_with_a_unit_is_not_wild() -> None:
    node = parse("0 in")
    assert isinstance(node, Number)
    assert not node.wild


def test_quantities_inside_expressions() -> None:
    assert value("a + (3 in)") == PARAMETERS["a"] + 3 * 0.0254
    assert value("(180 rpm) + (60 rpm)*t/(12 s)") == pytest.approx((180 + 60 * 0.3 / 12) * math.pi / 30)
    assert value("max(3 in, 1 in)") == 3 * 0.0254
    assert value("a > 3 in and b < 2 s") == 1.0
    assert value("a > 0 and b < 0") == 1.0
    assert value("-a*cos(60 deg)") == pytest.approx(-PARAMETERS["a"] / 2)


def test_leaves_are_names_and_addresses() -> None:
    tree = parse("AB.B.x in DE - W*bars[2].normal / weight + (angular_momentum about P)*t")
    assert names(tree) == {
        Address("AB", ("B", "x"), in_="DE"),
        Name("W"),
        Address("bars", ("normal",), member=2),
        Name("weight"),
        Address("angular_momentum", about="P"),
        Name("t"),
    }


def test_a_direction_ends_before_an_operator() -> None:
    tree = parse("2*A.velocity along 30 deg in B * 3")
    assert names(tree) == {Address("A", ("velocity",), along="30 deg", in_="B")}
    assert str(tree) == "2*A.velocity in B along 30 deg*3"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", 'bodies.AB.mass = "": it ends where a number, a name or a parenthesis is wanted'),
        (
            "r + 3 in",
            '"r + 3 in": a number with a unit inside an expression goes in parentheses: (3 in)',
        ),
        ("3 in^2 - r", "goes in parentheses: (3 in^2)"),
        ("-3 in + r", "goes in parentheses: (-3 in)"),
        ("2*3 in", "goes in parentheses: (3 in)"),
        ("2 kg*rod.omega", "a number with a unit goes in parentheses: (2 kg)*..."),
        ("2 kg * rod.velocity.x", "a number with a unit goes in parentheses: (2 kg)*..."),
        ("2 zz*r", 'unknown unit "zz"; a number with a unit goes in parentheses: (2 s)*t'),
        ("3 foo", 'unknown unit "foo"'),
        ("a b", 'an operator or the end is wanted, not "b" (character 3)'),
        ("(a", "it ends where an operator or ) is wanted"),
        ("a)", 'an operator or the end is wanted, not ")" (character 2)'),
        ("a +", "it ends where a number, a name or a parenthesis is wanted"),
        ("* a", 'a number, a name or a parenthesis is wanted, not "*" (character 1)'),
        ("and", 'a number, a name or a parenthesis is wanted, not "and" (character 1)'),
        ("sni(a)", 'unknown function "sni" (did you mean "sin"?)'),
        ("qqq(a)", 'unknown function "qqq" (there are sin, cos, tan'),
        ("select(a, b, c)", 'unknown function "select"'),
        ("sin()", 'a number, a name or a parenthesis is wanted, not ")" (character 5)'),
        ("sin(a, b)", "sin takes 1 argument, not 2"),
        ("atan2(a)", "atan2 takes 2 arguments, not 1"),
        ("min(a)", "min takes at least 2 arguments, not 1"),
        ("a < b < c", 'comparisons are not chained; write "a < b and b < c"'),
        ("a == b", "write = for equality, not =="),
        ("a ** 2", "write ^ for a power, not **"),
        ("1e999", "1e999 is too large for a number"),
        ("AB.x in", 'it ends where a body after "in" is wanted'),
        ("a every b", 'an operator or the end is wanted, not "every" (character 3)'),
        (math.nan, "bodies.AB.mass = nan: the number must be finite"),
        ([1], "bodies.AB.mass = [1]: a number with a unit is wanted"),
    ],
)
def test_messages(text: str, message: str) -> None:
    with pytest.raises(SceneError) as caught:
        parse(text, where="bodies.AB.mass")
    assert message in str(caught.value)
    assert caught.value.path == "bodies.AB.mass"


@pytest.mark.parametrize(
    "text", ["__import__('os')", "a.__class__()", "lambda: 1", "[a for a in b]", "a; b", "'x'"]
)
def test_only_the_grammar_is_read(text: str) -> None:
    with pytest.raises(SceneError):
        parse(text)


@given(st.text(alphabet="ab1.5 +-*/^()=<>,[]insorandtm_\u00b2\n", max_size=40))
def test_any_text_is_an_expression_or_an_error(text: str) -> None:
    with suppress(SceneError):
        parse(text)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("(" * 1000 + "a" + ")" * 1000, f"nested more than {MAX_NESTING} levels deep"),
        ("-" * 1000 + "a", f"nested more than {MAX_NESTING} levels deep"),
        ("not " * 900 + "a", f"nested more than {MAX_NESTING} levels deep"),
        ("^".join("a" * 100), f"nested more than {MAX_NESTING} levels deep"),
        ("sin(" * 100 + "a" + ")" * 100, f"nested more than {MAX_NESTING} levels deep"),
        ("+".join("a" * 1000), "a chain of more than 200 operations; split it into parameters"),
        ("a" * 5000, "an expression of 5000 characters; at most 4000 are read"),
    ],
)
def test_limits(text: str, message: str) -> None:
    with pytest.raises(SceneError, match=message):
        parse(text)


def test_long_chains_below_the_limit_work() -> None:
    assert value("+".join("a" * 200), a=1.0) == 200
    assert value("(" * 50 + "a" + ")" * 50, a=1.0) == 1
