"""Expressions: values against Python's, code against values, dimensions, limits and messages."""

from __future__ import annotations

import ctypes
import ctypes.util
import math
import struct
from contextlib import suppress
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planemotion import _layout as layout
from planemotion.base.errors import SceneError
from planemotion.language import dimensions, tree, units
from planemotion.language.address import Address
from planemotion.language.arithmetic import apply
from planemotion.language.code import ConstantPool, emit, stack_depth
from planemotion.language.dimensions import Dimension
from planemotion.language.homogeneity import dimension, require
from planemotion.language.leaves import evaluate, names
from planemotion.language.parser import MAX_NESTING, parse
from planemotion.language.tree import Binary, Call, Name, Node, Number, Unary, as_node, binary, call

PARAMETERS = {"a": 2.385, "b": -0.71, "c": 1.37, "t": 0.3}
LIBM = ctypes.CDLL(ctypes.util.find_library("m"))


def value(text: str, **parameters: Any) -> Any:
    return evaluate(parse(text), lambda leaf: {**PARAMETERS, **parameters}[str(leaf)])


def bits(number: float) -> bytes:
    return struct.pack("<d", number) if not math.isnan(number) else b"nan"


# ---- values ----------------------------------------------------------------------------------------------

SAME_IN_PYTHON = [
    "a + b*c",
    "a - b - c",
    "a/b/c",
    "-a^2",
    "a^c^b",
    "2^-a",
    "-(a - b)*c",
    "a - -b",
    "+a",
    "(a + b)*(c - a)/(b*c)",
    "1.5e-3*a + .5 - 2.",
    "(a < b) + (b <= c) + (a > b) + (c >= a) + (a != b)",
    "a > b and b > c or not a < c",
    "not a < b and c > 0",
    "sin(a) + cos(b)*tan(c) - atan(a)",
    "asin(b) + acos(b) + atan2(a, b)",
    "sqrt(a) + abs(b) + exp(c) + log(a) + floor(b)",
    "min(a, b, c) + max(b, a)",
    "2*pi*a",
]


@pytest.mark.parametrize("text", SAME_IN_PYTHON)
def test_value_is_python_s(text: str) -> None:
    functions = {name: getattr(math, name) for name in tree.FUNCTIONS if hasattr(math, name)}
    scope = {**PARAMETERS, **functions, "abs": abs, "min": min, "max": max, "pi": math.pi}
    assert value(text) == eval(text.replace("^", "**"), scope)


NUMBERS = st.floats(-1e3, 1e3).map(lambda number: Number(number))


def operations(children: Any) -> Any:
    return (
        st.builds(Binary, st.sampled_from(sorted(tree.RANK)), children, children)
        | st.builds(Unary, st.sampled_from(["-", "not"]), children)
        | st.builds(
            lambda name, x: Call(name, (x,)), st.sampled_from(["sin", "sqrt", "log", "floor"]), children
        )
        | st.builds(
            lambda name, x: Call(name, tuple(x)),
            st.sampled_from(["min", "max"]),
            st.lists(children, min_size=2, max_size=4),
        )
        | st.builds(lambda *x: Call("select", x), children, children, children)
    )


TREES = st.recursive(NUMBERS | st.sampled_from([Name("a"), Name("b"), Name("c")]), operations, max_leaves=12)


BINARY_CODES = {
    "ADD": "+", "SUB": "-", "MUL": "*", "DIV": "/", "POW": "^", "LT": "<", "LE": "<=", "GT": ">", "GE": ">=",
    "EQ": "=", "NE": "!=", "AND": "and", "OR": "or",
}  # fmt: skip
UNARY_NAMES = ("sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "abs", "exp", "log", "floor", "not")


def run(code: Any, pool: Any, parameters: Any) -> float:
    """The stack machine of planemotion.h, by its definition."""
    operators = {
        **{getattr(layout, f"PM_OP_{name}"): (symbol, 2) for name, symbol in BINARY_CODES.items()},
        **{getattr(layout, f"PM_OP_{name.upper()}"): (name, 1) for name in UNARY_NAMES},
        layout.PM_OP_HYPOT: ("norm", 2),
        layout.PM_OP_ATAN2: ("atan2", 2),
        layout.PM_OP_MIN: ("min", 2),
        layout.PM_OP_MAX: ("max", 2),
        layout.PM_OP_NEG: ("-", 1),
        layout.PM_OP_SELECT: ("select", 3),
    }
    stack = []
    for operation, argument in code:
        if operation == layout.PM_OP_CONSTANT:
            stack.append(pool.values[argument])
        elif operation == layout.PM_OP_PARAMETER:
            stack.append(parameters[argument])
        else:
            symbol, count = operators[operation]
            operands = stack[-count:]
            del stack[-count:]
            stack.append(apply(symbol, operands))
    (result,) = stack
    return result


COLUMN = {name: index for index, name in enumerate(PARAMETERS)}


def parameter(leaf: Any) -> Any:
    return layout.PM_OP_PARAMETER, COLUMN[leaf.text]


@given(TREES)
def test_code_computes_the_value(tree: Node) -> None:
    pool = ConstantPool()
    code = emit(tree, parameter, pool)
    expected = evaluate(tree, lambda leaf: PARAMETERS[str(leaf)])
    assert bits(run(code, pool, list(PARAMETERS.values()))) == bits(expected)


@given(TREES)
def test_written_again_it_is_the_same_expression(tree: Node) -> None:
    """Grouping survives: the text of a node evaluates to the same bits."""
    if "select" in str(tree):
        return
    exact = substitute_exact(tree)
    text = str(exact)
    assert bits(value(text)) == bits(evaluate(exact, lambda leaf: PARAMETERS[str(leaf)]))


def substitute_exact(tree: Node) -> Any:
    """Numbers with all their digits as their text."""
    match tree:
        case Number():
            return Number(tree.value_si, text=repr(tree.value_si))
        case Unary():
            return Unary(tree.operator, substitute_exact(tree.operand))
        case Binary():
            return Binary(tree.operator, substitute_exact(tree.left), substitute_exact(tree.right))
        case Call():
            return Call(tree.function, tuple(map(substitute_exact, tree.arguments)))
    return tree


ANY_NUMBER = st.floats() | st.sampled_from([0.0, -0.0, 1.0, -1.0, 0.5, 3.0, -3.0])


@given(ANY_NUMBER, ANY_NUMBER)
def test_arithmetic_is_that_of_c(x: float, y: float) -> None:
    for name, function in {"^": LIBM.pow, "norm": LIBM.hypot, "atan2": LIBM.atan2}.items():
        function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double, ctypes.c_double]
        assert bits(apply(name, [x, y])) == bits(function(x, y)), name
    for name in ("sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "exp", "log", "floor"):
        function = getattr(LIBM, name)
        function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double]
        assert bits(apply(name, [x])) == bits(function(x)), name


def test_not_a_number_stays_visible() -> None:
    for operation in ("min", "max", "+", "*", "/"):
        assert math.isnan(apply(operation, [math.nan, 1.0]))
        assert math.isnan(apply(operation, [1.0, math.nan]))
    assert apply("<", [math.nan, 1.0]) == 0.0
    assert apply("/", [1.0, -0.0]) == -math.inf
    assert math.isnan(apply("/", [0.0, 0.0]))


# ---- reading ---------------------------------------------------------------------------------------------


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


# ---- dimensions ------------------------------------------------------------------------------------------

DIMENSIONS = {
    "r": dimensions.LENGTH,
    "t": dimensions.TIME,
    "W": dimensions.FORCE,
    "g": dimensions.ACCELERATION,
    "v": dimensions.VELOCITY,
    "n": dimensions.DIMENSIONLESS,
    "any": None,
}


def resolve(leaf: Any) -> Any:
    return DIMENSIONS[leaf.text]


def no_leaf(leaf: Any) -> None:
    raise AssertionError(leaf)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("r + (3 in)", dimensions.LENGTH),
        ("W/g*v", dimensions.MOMENTUM),
        ("W/g*r^2", dimensions.INERTIA),
        ("sqrt(g*r)", dimensions.VELOCITY),
        ("(g*r)^(1/2)", dimensions.VELOCITY),
        ("r^-1.5", Dimension(length=dimensions.exact_exponent(-1.5))),
        ("r^(1/3)*r^(2/3)", dimensions.LENGTH),
        ("2^(r/(1 m))", dimensions.DIMENSIONLESS),
        ("atan2(r, 3 m)", dimensions.DIMENSIONLESS),
        ("norm(r, v*t)", dimensions.LENGTH),
        ("max(r, 0, 2 m)", dimensions.LENGTH),
        ("abs(-r)", dimensions.LENGTH),
        ("r < 3 in and not v > 2 m/s", dimensions.DIMENSIONLESS),
        ("r > 0", dimensions.DIMENSIONLESS),
        ("r + 0", dimensions.LENGTH),
        ("0*t + r", dimensions.LENGTH),
        ("any + r", dimensions.LENGTH),
        ("any*r", None),
        ("-0", None),
        ("asin(r/(3 m)) + (30 deg)", dimensions.DIMENSIONLESS),
    ],
)
def test_dimension(text: str, expected: Any) -> None:
    assert dimension(parse(text), resolve) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("r + (3 s)", 'in "r + (3 s)": r is a length, 3 s is a time; they cannot be added'),
        ("r - n", 'in "r - n": r is a length, n is a plain number; they cannot be added'),
        ("r < t", 'in "r < t": r is a length, t is a time; they cannot be compared'),
        ("2*(r = v)", 'in "r = v": r is a length, v is a velocity; they cannot be compared'),
        ("max(r, 0, t)", 'in "max(r, 0, t)": r is a length, t is a time; they cannot be compared'),
        ("atan2(r, t)", 'in "atan2(r, t)": r is a length, t is a time; they cannot be compared'),
        ("sin(r)", "sin takes an angle or a plain number; r is a length"),
        ("exp(r)", "exp takes a plain number; r is a length"),
        ("floor(t)", "floor takes a plain number; t is a time"),
        ("not r", '"not" takes conditions, such as x > 0; r is a length'),
        ("r > 0 and v", '"and" takes conditions, such as x > 0; v is a velocity'),
        ("r^n", 'in "r^n": r is a length, so its power must be a constant, not n'),
        ("r^0.3333", 'in "r^0.3333": r is a length, so its power must be a simple fraction'),
        ("r^(0/0)", "its power must be a simple fraction"),
        ("2^t", 'the power in "2^t" takes a plain number; t is a time'),
    ],
)
def test_clashing_dimensions(text: str, message: str) -> None:
    with pytest.raises(SceneError) as caught:
        dimension(parse(text), resolve)
    assert message in str(caught.value)


def test_wanted_dimension() -> None:
    require(parse("0"), dimensions.INERTIA, no_leaf)
    require(parse("3 kg*m^2"), dimensions.INERTIA, no_leaf)
    with pytest.raises(SceneError) as caught:
        require(parse("10.5 lb*ft"), dimensions.INERTIA, no_leaf)
    assert str(caught.value).startswith(
        "a moment of inertia (mass*length^2, such as kg*m^2) is wanted; this is a moment"
    )
    with pytest.raises(SceneError, match=r"^a length \(such as m\) is wanted; this is a plain number$"):
        require(parse("3"), dimensions.LENGTH, no_leaf)


# ---- code ------------------------------------------------------------------------------------------------


def test_constants_are_folded_and_kept_once() -> None:
    pool = ConstantPool()
    code = emit(parse("2*pi*a + sqrt(4)*b + 2*pi"), parameter, pool)
    assert [operation for operation, _ in code].count(layout.PM_OP_CONSTANT) == 3
    assert sorted(pool.values) == [2.0, 2 * math.pi]
    assert emit(parse("3 + 4"), parameter, pool) == [(layout.PM_OP_CONSTANT, pool.values.index(7.0))]


def test_constants_differ_by_their_bits() -> None:
    pool = ConstantPool()
    assert pool.index(0.0) != pool.index(-0.0)
    assert pool.index(math.nan) == pool.index(math.nan)


def test_a_leaf_may_be_several_instructions() -> None:
    pool = ConstantPool()
    squared = [(layout.PM_OP_PARAMETER, 0), (layout.PM_OP_PARAMETER, 0), (layout.PM_OP_MUL, 0)]
    code = emit(parse("x.y + 1"), lambda leaf: squared, pool)
    assert run(code, pool, [3.0]) == 10.0
    assert stack_depth(code) == 2


def test_stack_of_the_kernel_is_respected() -> None:
    deep = as_node(Name("a"))
    for _ in range(layout.PM_STACK - 1):
        deep = Name("a") - deep
    assert stack_depth(emit(deep, parameter, ConstantPool())) == layout.PM_STACK
    with pytest.raises(SceneError, match=f"needs {layout.PM_STACK + 1} intermediate numbers at once"):
        emit(Name("a") - deep, parameter, ConstantPool())


def test_every_operation_of_the_language_has_a_code() -> None:
    """A function without a code would fail only when a scene uses it."""
    for name, (least, _) in tree.FUNCTIONS.items():
        emit(Call(name, (Name("a"),) * least), parameter, ConstantPool())
    for operator in tree.RANK:
        emit(Binary(operator, Name("a"), Name("b")), parameter, ConstantPool())


# ---- composing -------------------------------------------------------------------------------------------


def test_trivial_parts_vanish() -> None:
    x, address = Name("x"), Address("AB", ("x",))
    assert x + 0 == 0 + x == x - 0 == 1 * x == x * 1 == x / 1 == x
    assert -Unary("-", x) == x
    assert 0 * x == x * 0 == tree.ZERO
    assert 0 - x == -x == Unary("-", x)
    assert x + Number(0.0, dimensions.LENGTH) == x
    assert Number(1.0, dimensions.LENGTH) * x != x
    assert address - x == Binary("-", address, x)
    assert as_node(2) * 3 + 1 == Number(7.0)
    assert Number(2.0, dimensions.LENGTH) / Number(4.0, dimensions.TIME) == Number(0.5, dimensions.VELOCITY)
    assert tree.sin(0) == Number(0.0)
    assert tree.cos(x) == Call("cos", (x,))
    assert abs(x) == Call("abs", (x,))
    assert x**2 == Binary("^", x, Number(2.0))


def test_a_rotated_point_at_angle_zero_is_short() -> None:
    x, y, px, py = (Name(word) for word in ("x", "y", "px", "py"))
    angle = as_node(0)
    assert x + tree.cos(angle) * px - tree.sin(angle) * py == x + px
    assert y + tree.sin(angle) * px + tree.cos(angle) * py == y + py


@given(TREES, TREES, st.sampled_from(["+", "-", "*", "/", "^", "<", "and"]))
def test_composing_keeps_the_value(left: Node, right: Node, operator: str) -> None:
    """Simplification may only drop what is finite and trivial."""

    def of(tree: Node) -> float:
        return evaluate(tree, lambda leaf: PARAMETERS[str(leaf)])

    plain, composed = of(Binary(operator, left, right)), of(binary(operator, left, right))
    if math.isfinite(of(left)) and math.isfinite(of(right)):
        assert composed == plain or (math.isnan(plain) and math.isnan(composed))


def test_wrong_number_of_arguments_is_a_programming_error() -> None:
    with pytest.raises(TypeError, match="atan2 takes 2 arguments, not 1"):
        call("atan2", 1)


def test_a_quantity_becomes_a_number() -> None:
    number = as_node(units.parse_quantity("3 in"))
    assert isinstance(number, Number)
    assert (str(number), number.dimension) == ("3 in", dimensions.LENGTH)
