"""Couplings, to rows of the kernel's joint and contact tables; the kinds are in kinds/.

What holds both ways is a joint of the kernel.  A cord pulls only: each of its straight strands is a contact
whose gap is its slack.  Driven bodies are held to the ground by what is prescribed.
"""

from __future__ import annotations

from dataclasses import dataclass

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.pose import GROUND, PointRef
from ..geometry.rows import CouplingRows
from ..geometry.writer import Writer
from ..kinds.base import Coupling
from ..language.dimensions import ANGULAR_VELOCITY, VELOCITY
from ..language.tree import ZERO
from ..model.tables import Body


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


def drive(to: Writer, name: str, body: Body) -> None:
    """Holds a driven body to what is prescribed: the velocity of its mass centre, and its spin."""
    driven = body.driven
    assert driven is not None
    path = f"bodies.{name}.driven"
    x, y = to.reader.vector(driven.velocity, f"{path}.velocity", VELOCITY, to.over_time)
    origin = to.drawing.point_at(GROUND, (ZERO, ZERO), path)
    centre = to.drawing.point(PointRef(name, "G"))
    to.joint(layout.PM_JOINT_DRIVE, centre, origin, path, programs=(x, y))
    if body.turns:
        omega = to.over_time(driven.omega, f"{path}.omega", ANGULAR_VELOCITY)
        index = to.drawing.body_index(name)
        to.joint(layout.PM_JOINT_RATE, index, layout.PM_GROUND, path, programs=(omega,))
    elif driven.omega != 0:
        raise SceneError("a particle does not turn; leave out omega", path=f"{path}.omega")
