"""Code for the kernel's stack machine; expressions that are composed."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planemotion import _layout as layout
from planemotion.base.errors import SceneError
from planemotion.language import dimensions, tree, units
from planemotion.language.address import Address
from planemotion.language.code import ConstantPool, emit, stack_depth
from planemotion.language.leaves import evaluate
from planemotion.language.parser import parse
from planemotion.language.tree import Binary, Call, Name, Node, Number, Unary, as_node, binary, call
from tests.language.expressions import PARAMETERS, TREES, parameter, run


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
