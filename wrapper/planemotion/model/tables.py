"""The tables of a scene as frozen pydantic models: bodies, marks, contacts, events, asks, finds, settings.

Numbers stay as written ("10 in", "r + (3 in)", 0.5); units and expressions are read when the scene is made
into the kernel's tables.  Joints, couplings and forces are models of their kinds (kinds/).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator, Field

from .curve import Curve
from .element import Kind, Number, Pair, Partners, Table, Text
from .listed import Cases, Listed
from .readers import (
    DISTRIBUTIONS,
    DrivenPlace,
    Offset,
    Place,
    Value,
    Vector,
    read_actions,
    read_at,
    read_bounds,
    read_circle,
    read_correlation,
    read_driven_place,
    read_friction,
    read_grid,
    read_named,
    read_names,
    read_numbers,
    read_place,
    read_point,
    read_sequence,
    read_swept,
    read_value_or_vector,
)
from .words import ASK_WORDS, SHAPES

DEFAULT_G = "9.81 m/s^2"
# Far beyond what a scene needs: they end runs that would not end by themselves.
DEFAULT_MAX_EVENTS = 1_000_000
DEFAULT_MAX_STEPS = 1_000_000
DEFAULT_MAX_CASES = 100_000_000
# Intervals into which a find divides the range of one parameter, and of each of two.
DEFAULT_SAMPLES = 32
# What a counter of the kernel can hold.
MOST_COUNT = 2**31 - 1
# Of a sweep: what the numbers of its cases can hold.
MOST_CASES = 2**53
DEFAULT_PAIR_SAMPLES = 8
# Of a design: as many as a grid may have.
MOST_DRAWN = 10_000_000


class Line(Table):
    """A straight line: through a point at an angle, or from one point to another."""

    through: Pair | None = None
    angle: Number | None = None
    start: Pair | None = Field(None, alias="from")
    to: Pair | None = None


class Circle(Table):
    center: Pair = Vector(0, 0)
    radius: Number


class Row(Table):
    """Points one `step` apart; endless without `count`."""

    start: Pair = Field(alias="from")
    step: Pair
    count: Number | None = None


Points = dict[str, Annotated[Vector | Offset, BeforeValidator(read_point)]]
Circles = dict[str, Annotated[Circle, BeforeValidator(read_circle)]]


class Ground(Table):
    points: Points = {}
    lines: dict[str, Line] = {}
    circles: Circles = {}
    rows: dict[str, Row] = {}
    curves: dict[str, Curve] = {}


class Driven(Table):
    """Prescribed motion of a body: of its mass centre or of a point, and its spin or angle, over t."""

    velocity: Pair = Vector(0, 0)
    omega: Number = 0
    at: Annotated[DrivenPlace, BeforeValidator(read_driven_place)] | None = None
    angle: Number | None = None


class Spin(Table):
    """An axis in the plane about which the plane turns, and what turns along."""

    through: Pair
    angle: Number
    inertia: Number = 0
    couple: Number | None = None


_ENDS = read_names(2, "the names of two ends", 'rod = ["A", "B"], and length = "1 m" beside it')


class Body(Table):
    rod: Annotated[tuple[str, ...], BeforeValidator(_ENDS)] | None = None
    disk: Number | None = None
    cylinder: Number | None = None
    hoop: Number | None = None
    sphere: Number | None = None
    half_ring: Number | None = None
    plate: Pair | None = None
    length: Number | None = None
    corners: Annotated[tuple[str, ...], BeforeValidator(read_names(4, "four names"))] | None = None
    mass: Number | None = None
    weight: Number | None = None
    inertia: Number | None = None
    gyration: Number | None = None
    mass_center: Pair = Vector(0, 0)
    points: Points = {}
    lines: dict[str, Line] = {}
    circles: Circles = {}
    curves: dict[str, Curve] = {}
    at: Annotated[Place, BeforeValidator(read_place)] | None = None
    angle: Number | None = None
    driven: Driven | None = None
    depth: Number | None = None
    edge_on: bool = False
    active: Number = True

    @property
    def shape(self) -> str | None:
        """The key of its shape, None for a body of given inertia and for a particle."""
        return next((shape for shape in SHAPES if getattr(self, shape) is not None), None)

    @property
    def rotates(self) -> bool:
        """Whether it is more than a particle."""
        return self.shape is not None or self.inertia is not None or self.gyration is not None


class Friction(Table):
    static: Number
    kinetic: Number


class Contact(Kind):
    word = "touch"
    partners: Partners
    restitution: Number = 0
    friction: Annotated[Value | Friction, BeforeValidator(read_friction)] = 0
    tangential: Number | None = None
    normal: Number | None = None
    law: Text = "newton"
    stiffness: Number | None = None
    painleve: Literal["stop", "impact"] = "stop"
    capture: Literal["none", "pin", "body"] = "none"
    surface_speed: Number | None = None


class Grid(Table):
    """A list of values, or from .. to in `num` values or steps of `step`, ends included.

    Only its shape is checked here."""

    unwritten: ClassVar[tuple[str, ...]] = ("values",)
    values: tuple[Value, ...] | None = None
    from_: Number | None = Field(None, alias="from")
    to: Number | None = None
    num: Annotated[int, Field(strict=True)] | None = None
    step: Number | None = None
    scale: Literal["linear", "log"] = "linear"


GridOf = Annotated[Grid, BeforeValidator(read_grid)]

DESIGNS = ("latin", "sobol", "halton", "random")
Numbers = Annotated[tuple[Value, ...], BeforeValidator(read_numbers)]


class Swept(Grid):
    """The values of a swept parameter: a grid, or a distribution from which the design draws.

    `listed`: of the parameter of cases that are listed, where its `values` are not.
    """

    unwritten: ClassVar[tuple[str, ...]] = ("values", "listed")
    listed: Listed | None = None
    uniform: Numbers | None = None
    normal: Numbers | None = None
    lognormal: Numbers | None = None
    triangular: Numbers | None = None
    within: Annotated[tuple[Value, Value], BeforeValidator(read_bounds)] | None = None

    @property
    def is_drawn(self) -> bool:
        """Whether it has a distribution."""
        return any(getattr(self, word) is not None for word in DISTRIBUTIONS)


SweptOf = Annotated[Swept, BeforeValidator(read_swept)]


class Design(Table):
    """How many cases are drawn from the distributions of a sweep, and by which rule."""

    latin: Annotated[int, Field(strict=True, ge=1, le=MOST_DRAWN)] | None = None
    sobol: Annotated[int, Field(strict=True, ge=1, le=MOST_DRAWN)] | None = None
    halton: Annotated[int, Field(strict=True, ge=1, le=MOST_DRAWN)] | None = None
    random: Annotated[int, Field(strict=True, ge=1, le=MOST_DRAWN)] | None = None
    seed: Annotated[int, Field(strict=True, ge=0)] = 0
    correlation: Annotated[tuple[tuple[str, str, float], ...], BeforeValidator(read_correlation)] = ()


class Refine(Table):
    """How a map of outcomes over two parameters is refined from the grids of a sweep."""

    of: Annotated[tuple[str, ...], BeforeValidator(read_named)] | None = None
    tolerance: Annotated[float, Field(gt=0, lt=1)] = 1e-3


class Retry(Table):
    """Settings with which a case of a sweep is computed once more if it failed."""

    accuracy: Number | None = None
    route: Text | None = None
    max_cpu: Number | None = None
    max_events: Annotated[int, Field(ge=1, le=MOST_COUNT)] | None = None
    max_steps: Annotated[int, Field(ge=1, le=MOST_COUNT)] | None = None


class At(Table):
    """An instant that is not an event: where an expression is extreme, or takes given values."""

    max: Number | None = None
    min: Number | None = None
    each: Number | None = None
    values: GridOf | None = None


class Action(Table):
    """What an event does: it adds or removes an element, or applies an impulse."""

    kinds: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "add": (),
        "remove": (),
        "impulse": ("value", "work"),
        "nudge": (),
    }
    add: Text | None = None
    remove: Text | None = None
    impulse: Text | None = None
    nudge: Text | None = None
    value: Annotated[Value | Vector, BeforeValidator(read_value_or_vector)] | None = None
    work: Number | None = None
    active: Number = True


class Event(Table):
    """`when` one of the conditions comes - for the `nth` time, if that is given - the actions are done."""

    when: Annotated[tuple[str, ...], BeforeValidator(read_sequence)]
    do: Annotated[tuple[Action, ...], BeforeValidator(read_actions)] = ()
    nth: Annotated[int, Field(strict=True, le=MOST_COUNT)] | None = None


class Ask(Table):
    """`of` an expression `at` an instant, its extreme `max` or `min`, or what it does over the time: also as
    long as `during` holds, `about` a value, at `omega`.  `events`: which of these happened, in which order.
    """

    of: Number | None = None
    max: Number | None = None
    min: Number | None = None
    integral: Number | None = None
    mean: Number | None = None
    rms: Number | None = None
    median: Number | None = None
    percentile: Number | None = None
    percent: Number | None = None
    period: Number | None = None
    frequency: Number | None = None
    amplitude: Number | None = None
    phase: Number | None = None
    about: Number = 0
    nth: Annotated[int, Field(strict=True, ge=1, lt=MOST_COUNT)] | None = None
    omega: Number | None = None
    events: Annotated[tuple[str, ...], BeforeValidator(read_named)] | None = None
    during: Text | None = None
    at: Annotated[str | At, BeforeValidator(read_at)] | None = None
    unit: Text | None = None
    run: Text | None = None

    @property
    def word(self) -> str:
        """Which of ASK_WORDS is given; of a checked ask it is one."""
        return next(word for word in ASK_WORDS if getattr(self, word) is not None)

    @property
    def text(self) -> str:
        """What was asked, for people: "max hoop.omega", "-sphere.omega before strike 1"."""
        words = [("" if word == "of" else f"{word} ", getattr(self, word)) for word in ASK_WORDS]
        words.append(("which happened of ", ", ".join(self.events) if self.events else None))
        words.append(("at percent ", None if self.percent is None else str(self.percent)))
        words.append(("swing ", None if self.nth is None else str(self.nth)))
        words.append(("at omega ", self.omega))
        words.append(("during ", self.during))
        if isinstance(self.at, At):
            words += [("at max ", self.at.max), ("at min ", self.at.min), ("at each ", self.at.each)]
        else:
            words.append(("" if str(self.at).startswith("before ") else "at ", self.at))
        words.append(("in run ", self.run))
        return " ".join(f"{word}{written}" for word, written in words if written is not None)


class Find(Table):
    """What is sought: parameters between bounds, under conditions, with something extreme."""

    vary: dict[str, Annotated[tuple[Value, Value], BeforeValidator(read_bounds)]]
    where: Annotated[tuple[str, ...], BeforeValidator(read_sequence)] = ()
    greatest: Number | None = None
    least: Number | None = None
    samples: Annotated[int, Field(strict=True)] | None = None

    @property
    def intervals(self) -> int:
        """`samples`, or what is taken without it."""
        if self.samples is not None:
            return self.samples
        return DEFAULT_SAMPLES if len(self.vary) == 1 else DEFAULT_PAIR_SAMPLES

    @property
    def goal(self) -> Literal["greatest", "least"] | None:
        """The key that says what is to be extreme."""
        if self.greatest is not None:
            return "greatest"
        return "least" if self.least is not None else None


class Solve(Table):
    route: Text = "auto"
    accuracy: Number = 1e-10
    estimate: bool = True
    max_time: Number | None = None
    max_cpu: Number | None = None
    max_cases: Annotated[int, Field(ge=1, le=MOST_CASES)] = DEFAULT_MAX_CASES
    max_events: Annotated[int, Field(le=MOST_COUNT)] = DEFAULT_MAX_EVENTS
    max_steps: Annotated[int, Field(le=MOST_COUNT)] = DEFAULT_MAX_STEPS
    assembly_tolerance: Number = 1e-12
    impacts: Text | None = None
    shared: Text = "none"
    stiffness_exponent: Number = 1


class Part(Table):
    """A scene within the scene: all that it defines is called PART.NAME."""

    use: Text
    with_: dict[str, Number] = Field({}, alias="with")


class Sweep(Table):
    """What a study varies: grids by parameter, in their order, and parameters that move together."""

    grids: dict[str, SweptOf] = {}
    design: Design | None = None
    refine: Refine | None = None
    cases: Cases | None = None
    retry: Retry | None = None
    zip: tuple[tuple[str, ...], ...] = ()
