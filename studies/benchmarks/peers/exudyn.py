"""Exudyn: rigid bodies of the plane with revolute joints in redundant coordinates, generalised-alpha."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.utilities import (
    CoordinateConstraint,
    LoadMassProportional,
    MarkerBodyMass,
    MarkerBodyPosition,
    MarkerNodeCoordinate,
    NodePoint2D,
    NodePointGround,
    NodeRigidBody2D,
    ObjectGround,
    ObjectJointRevolute2D,
    ObjectMassPoint2D,
    ObjectRigidBody2D,
)

from ..mechanisms import Mechanism
from ..problems import Problem
from ..rows import Attempt
from . import engines

NAME = "Exudyn generalized-alpha"
STEPS = (1e-2, 1e-3, 1e-4)  # s
GRAVITY = [0, -9.81, 0]
SPECTRAL_RADIUS = 0.95


def attempts(problem: Problem, quick: bool) -> Iterator[Attempt]:
    yield from engines.attempts(NAME, exu.GetVersionString(), STEPS[:1] if quick else STEPS, problem, Run)


class Run:
    """A mechanism at a step; `solve(steps)` runs it anew and gives the angles of its rods and the energy."""

    def __init__(self, mechanism: Mechanism, step: float) -> None:
        self.mechanism, self.step = mechanism, step

    def solve(self, steps: int) -> tuple[list[float], float]:
        exu.config.printToConsole = False
        container = exu.SystemContainer()
        system = container.AddSystem()
        nodes = build(system, self.mechanism)
        system.Assemble()
        settings = exu.SimulationSettings()
        timing = settings.timeIntegration
        timing.numberOfSteps = steps
        timing.endTime = steps * self.step
        timing.verboseMode = 0
        timing.newton.useModifiedNewton = True
        timing.generalizedAlpha.spectralRadius = SPECTRAL_RADIUS
        settings.solution.file.write = False
        if not system.SolveDynamic(settings):
            raise RuntimeError("its solver failed")
        coordinates = [np.array(system.GetNodeOutput(n, exu.OutputVariableType.Coordinates)) for n in nodes]
        rates = [np.array(system.GetNodeOutput(n, exu.OutputVariableType.Coordinates_t)) for n in nodes]
        rods = self.mechanism.rods
        angles = [rod.angle + float(q[2]) for rod, q in zip(rods, coordinates, strict=True)]
        energy = 0.0
        for i, (rod, q, v) in enumerate(zip(rods, coordinates, rates, strict=True)):
            height = self.mechanism.pin(i)[1] + rod.mass_center * math.sin(rod.angle) + q[1]
            kinetic = rod.mass * (v[0] ** 2 + v[1] ** 2) + rod.inertia * v[2] ** 2
            energy += kinetic / 2 - GRAVITY[1] * rod.mass * float(height)
        return angles, float(energy)


def build(system: Any, mechanism: Mechanism) -> list[Any]:
    """Bodies at their start, joints and weights; the nodes of the rods."""
    ground = system.AddObject(ObjectGround(referencePosition=[0, 0, 0]))
    nodes, ends, pins = [], [], []
    for i, rod in enumerate(mechanism.rods):
        x, y = mechanism.pin(i)
        center = [
            x + rod.mass_center * math.cos(rod.angle),
            y + rod.mass_center * math.sin(rod.angle),
            rod.angle,
        ]
        velocity = [*mechanism.velocity(i), rod.omega]
        node = system.AddNode(NodeRigidBody2D(referenceCoordinates=center, initialVelocities=velocity))
        body = system.AddObject(ObjectRigidBody2D(mass=rod.mass, inertia=rod.inertia, nodeNumber=node))
        weigh(system, body)
        nodes.append(node)
        pins.append(mark(system, body, -rod.mass_center))
        ends.append(mark(system, body, rod.length - rod.mass_center))
        base = mark(system, ground, *rod.at) if rod.parent is None else ends[rod.parent]
        system.AddObject(ObjectJointRevolute2D(markerNumbers=[base, pins[i]]))
    for i, j in mechanism.closed:
        system.AddObject(ObjectJointRevolute2D(markerNumbers=[ends[i], ends[j]]))
    if mechanism.piston:
        add_piston(system, mechanism, ends)
    return nodes


def add_piston(system: Any, mechanism: Mechanism, ends: list[Any]) -> None:
    assert mechanism.piston is not None
    i, mass = mechanism.piston
    x, _ = mechanism.end(i)
    u, _ = mechanism.end_velocity(i)
    node = system.AddNode(NodePoint2D(referenceCoordinates=[x, 0], initialVelocities=[u, 0]))
    body = system.AddObject(ObjectMassPoint2D(physicsMass=mass, nodeNumber=node))
    system.AddObject(ObjectJointRevolute2D(markerNumbers=[ends[i], mark(system, body)]))
    fixed = system.AddMarker(MarkerNodeCoordinate(nodeNumber=system.AddNode(NodePointGround()), coordinate=0))
    height = system.AddMarker(MarkerNodeCoordinate(nodeNumber=node, coordinate=1))
    system.AddObject(CoordinateConstraint(markerNumbers=[fixed, height]))


def mark(system: Any, body: Any, x: float = 0.0, y: float = 0.0) -> Any:
    return system.AddMarker(MarkerBodyPosition(bodyNumber=body, localPosition=[x, y, 0]))


def weigh(system: Any, body: Any) -> None:
    marker = system.AddMarker(MarkerBodyMass(bodyNumber=body))
    system.AddLoad(LoadMassProportional(markerNumber=marker, loadVector=GRAVITY))
