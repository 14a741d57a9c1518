"""Joints: from partners and options to rows of the kernel's joint table; the kinds are in kinds/."""

from __future__ import annotations

from dataclasses import dataclass

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.partners import Partner, pairs, partner
from ..geometry.writer import Writer
from ..kinds.base import Bearing, Joint, RubbingJoint
from ..language.dimensions import DIMENSIONLESS, LENGTH, MOMENT
from ..language.tree import ZERO, Node


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
        kind, a, b, value = joint.row(to, first, second, path)
    except SceneError as error:
        raise error.at(path=path) from None
    index = to.joint(kind, a, b, path, value=value)
    rubs = isinstance(joint, RubbingJoint) and "friction" in joint.model_fields_set
    if isinstance(joint, RubbingJoint) and rubs:
        _rub(to, joint, index, (first, second), f"{path}.friction")
    return JointInfo(index, joint, (first, second), rubs)


def _rub(to: Writer, joint: RubbingJoint, index: int, partners: tuple[Partner, Partner], path: str) -> None:
    """The row of the friction of a joint: a part of given size, and one that goes with its load."""
    own: Node = ZERO
    by_load: Node = ZERO
    if joint.bearing and not all(to.turns(one.owner) for one in partners):
        raise SceneError(f"a particle does not turn: its {joint.kind} has no friction", path=path)
    if isinstance(joint.friction, Bearing):
        if not joint.bearing:
            raise SceneError(f"a {joint.kind} has no radius; give the coefficient", path=path)
        mu = to.reader.number(joint.friction.mu, f"{path}.mu", DIMENSIONLESS)
        by_load = mu * to.reader.number(joint.friction.radius, f"{path}.radius", LENGTH)
    elif joint.bearing:
        own = to.reader.number(joint.friction, path, MOMENT)
    else:
        by_load = to.reader.number(joint.friction, path, DIMENSIONLESS)
    values = ((own, path), (by_load, path))
    to.force(layout.PM_FORCE_FRICTION, index, index, path, values=values)
