"""The columns of a history: positions, velocities, energies and reactions over time."""

from __future__ import annotations

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.drawing import Drawing
from ..geometry.packing import Tables
from .elements import CouplingInfo
from .measure_rows import Scope
from .measures import Measures

_OF_BODY = ("x", "y", "velocity.x", "velocity.y")
_OF_TURNING_BODY = ("angle", "omega")
_OF_FORCE = ("force.x", "force.y")
_OF_CONTACT = ("gap", "normal", "friction")
_OF_SPIN = ("spin.omega", "spin.inertia")
_ENERGIES = ("kinetic", "potential", "total")


def trace_columns(
    measures: Measures, tables: Tables, scope: Scope, drawing: Drawing
) -> dict[str, tuple[int, str]]:
    """Column name (an address) -> program and SI unit."""
    addresses: list[str] = []
    for name, body in drawing.bodies.items():
        quantities = (*_OF_BODY, *(_OF_TURNING_BODY if body.rotates else ()))
        addresses += [f"{name}.{quantity}" for quantity in quantities]
    for name, joint in scope.joints.items():
        addresses += [f"{name}.{quantity}" for quantity in joint.joint.columns]
    for name, coupling in scope.couplings.items():
        addresses += [f"{name}.{quantity}" for quantity in _coupling_quantities(coupling)]
    for name in scope.contacts:
        addresses += [f"{name}.{quantity}" for quantity in _OF_CONTACT]
    for name, force in scope.forces.items():
        addresses += [f"{name}.{quantity}" for quantity in (("couple",) if force.rotary else _OF_FORCE)]
    addresses += [f"energy.{kind}" for kind in _ENERGIES]
    if tables.rows[layout.PM_TABLE_SPIN]:
        addresses += _OF_SPIN
    columns: dict[str, tuple[int, str]] = {}
    for address in addresses:
        try:
            reading = measures.lower(address, f"history.{address}")
        except SceneError:
            # A force that needs a mass which was left out has no value; its column is left out with it.
            continue
        columns[address] = (tables.program(reading.node, f"history.{address}"), reading.dimension.unit or "1")
    return columns


def _coupling_quantities(coupling: CouplingInfo) -> tuple[str, ...]:
    """Its columns; of strands, those of each."""
    count = len(coupling.indices)
    spans = [f"[{span}]" for span in range(1, count + 1)] if count > 1 else [""]
    return tuple(f"{quantity}{span}" for quantity in coupling.coupling.columns for span in spans)
