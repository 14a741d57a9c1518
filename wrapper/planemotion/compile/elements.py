"""Joints, couplings and forces: from partners and options to rows of the kernel's tables.

What holds both ways is a joint of the kernel.  A cord pulls only: each of its straight strands is a contact
whose gap is its slack.  Driven bodies are held to the ground by what is prescribed.  The kinds are in kinds/.
"""

from __future__ import annotations

from dataclasses import dataclass

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.drawing import PointRef
from ..geometry.partners import Partner, pairs, partner
from ..geometry.rows import CouplingRows, Span
from ..geometry.writer import Writer
from ..kinds.base import Bearing, BearingJoint, Coupling, Force, Joint, RubbingJoint
from ..language.dimensions import ANGULAR_VELOCITY, DIMENSIONLESS, LENGTH, MOMENT, VELOCITY
from ..language.tree import ZERO, Node
from ..model.tables import Body, Driven
from ..model.words import GROUND


@dataclass(frozen=True)
class JointInfo:
    """What measures and events need to know of a joint: its row, what it is, partners, friction."""

    index: int
    joint: Joint
    partners: tuple[Partner, Partner]
    rubs: bool

    @property
    def kind(self) -> str:
        return self.joint.kind

    @property
    def owners(self) -> tuple[str, str]:
        return self.partners[0].owner, self.partners[1].owner


def add_joint(to: Writer, name: str, joint: Joint) -> JointInfo:
    """Adds the row of one joint.  Raises SceneError for partners that do not fit its kind."""
    path = f"joints.{name}"
    first, second = pairs(
        joint.partners,
        f"{path}.{joint.kind}",
        lambda text, where, index: partner(to.drawing, text, where, *joint.marks[index]),
    )
    try:
        row = joint.row(to, first, second, path)
    except SceneError as error:
        raise error.at(path=path) from None
    index = to.joint(row.kind, row.a, row.b, path, value=row.value, programs=row.programs)
    rubs = bool({"friction", "friction_couple"} & joint.model_fields_set)
    if isinstance(joint, RubbingJoint) and rubs:
        _rub(to, joint, index, (first, second), path)
    return JointInfo(index, joint, (first, second), rubs)


def _rub(to: Writer, joint: RubbingJoint, index: int, partners: tuple[Partner, Partner], path: str) -> None:
    """The row of the friction of a joint: a part of given size, and one that goes with its load."""
    own: Node = ZERO
    by_load: Node = ZERO
    bearing = isinstance(joint, BearingJoint)
    given = "friction" if "friction" in joint.model_fields_set else "friction_couple"
    where = f"{path}.{given}"
    if bearing and not all(to.rotates(one.owner) for one in partners):
        raise SceneError(f"a particle does not rotate: its {joint.kind} has no friction", path=where)
    if isinstance(joint.friction, Bearing):
        if not bearing:
            raise SceneError(f"a {joint.kind} has no radius; give the coefficient", path=where)
        mu = to.reader.number(joint.friction.mu, f"{where}.mu", DIMENSIONLESS)
        by_load = mu * to.reader.number(joint.friction.radius, f"{where}.radius", LENGTH)
    elif not bearing:
        by_load = to.reader.number(joint.friction, where, DIMENSIONLESS)
    if isinstance(joint, BearingJoint):
        own = to.reader.number(joint.friction_couple, f"{path}.friction_couple", MOMENT)
    values = ((own, where), (by_load, where))
    to.force(layout.PM_FORCE_FRICTION, index, index, where, values=values)


@dataclass(frozen=True)
class CouplingInfo:
    """What measures and events need to know of a coupling: what it is, and its rows."""

    coupling: Coupling
    rows: CouplingRows

    @property
    def kind(self) -> str:
        return self.coupling.kind

    @property
    def index(self) -> int | None:
        return self.rows.index

    @property
    def indices(self) -> tuple[int, ...]:
        return self.rows.indices

    @property
    def spans(self) -> tuple[Span, ...]:
        """Its strands."""
        return self.rows.spans or tuple(map(Span, self.rows.indices))

    @property
    def rims(self) -> tuple[int, ...]:
        """Contacts of a cord over rims that it may slip on."""
        return tuple(dict.fromkeys(span.index for span in self.spans if span.member != layout.PM_NONE))

    @property
    def may_slip(self) -> bool:
        """Whether it is a belt that slips where its friction is overcome."""
        return self.rows.may_slip

    @property
    def owners(self) -> tuple[tuple[str, str], ...]:
        return self.rows.owners

    @property
    def bodies(self) -> tuple[str, ...]:
        """All partners, each once."""
        return tuple(dict.fromkeys(owner for pair in self.owners for owner in pair))


def add_coupling(to: Writer, name: str, coupling: Coupling) -> CouplingInfo:
    """Adds the rows of one coupling.  Raises SceneError for partners and options that do not fit."""
    path = f"couplings.{name}"
    try:
        return CouplingInfo(coupling, coupling.rows(to, path))
    except SceneError as error:
        raise error.at(path=path) from None


@dataclass(frozen=True)
class DriveInfo:
    """What measures need to know of what drives a body: the rows that hold its place and its angle."""

    place: int
    angle: int | None


def drive(to: Writer, name: str, body: Body) -> DriveInfo:
    """Holds a driven body to what is prescribed of its place and of its angle."""
    driven = body.driven
    assert driven is not None
    path = f"bodies.{name}.driven"
    place = _drive_place(to, name, driven, path)
    if not body.rotates:
        for key in ("angle", "omega"):
            if key in driven.model_fields_set:
                raise SceneError(f"a particle does not rotate; leave out {key}", path=f"{path}.{key}")
        return DriveInfo(place, None)
    index = to.drawing.body_index(name)
    if driven.angle is None:
        kind, program = layout.PM_JOINT_RATE, to.over_time(driven.omega, f"{path}.omega", ANGULAR_VELOCITY)
    elif "omega" in driven.model_fields_set:
        raise SceneError("give angle or omega, not both", path=f"{path}.omega")
    else:
        kind, program = layout.PM_JOINT_ANGLE, to.over_time(driven.angle, f"{path}.angle", DIMENSIONLESS)
    return DriveInfo(place, to.joint(kind, index, layout.PM_GROUND, path, programs=(program,)))


def _drive_place(to: Writer, name: str, driven: Driven, path: str) -> int:
    origin = to.drawn.point_at(GROUND, (ZERO, ZERO), path)
    if driven.at is None:
        velocity = to.reader.vector(driven.velocity, f"{path}.velocity", VELOCITY, to.over_time)
        centre = to.drawn.point(PointRef(name, "G"))
        return to.joint(layout.PM_JOINT_DRIVE, centre, origin, path, programs=velocity)
    if "velocity" in driven.model_fields_set:
        raise SceneError("give at or velocity, not both", path=f"{path}.velocity")
    point, written = driven.at.points[0]
    marks = to.drawing.marks(name)
    if point not in marks.points:
        raise SceneError(marks.has_no("point", point, marks.points), path=f"{path}.at.{point}")
    at = to.reader.vector(written, f"{path}.at", LENGTH, to.over_time)
    return to.joint(layout.PM_JOINT_PLACED, to.drawn.point(PointRef(name, point)), origin, path, programs=at)


@dataclass(frozen=True)
class ForceInfo:
    """What measures need to know of a force: its row, the owners of its partners, whether it is a couple,
    from what its stretch counts where the row does not say it, and whether it has a potential."""

    index: int
    owners: tuple[str, ...]
    rotary: bool
    free: Node | None
    stores: bool


def add_force(to: Writer, name: str, force: Force) -> ForceInfo:
    """Adds the row of one force.  Raises SceneError for partners and options that do not fit."""
    path = f"forces.{name}"
    try:
        row = force.row(to, path)
        index = to.force(
            row.kind, row.a, row.b, path, values=row.values, programs=row.programs, option=row.option
        )
    except SceneError as error:
        raise error.at(path=path) from None
    return ForceInfo(index, row.owners, row.rotary, row.free, row.stores)
