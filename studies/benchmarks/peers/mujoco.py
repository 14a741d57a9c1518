"""MuJoCo with its Runge-Kutta method of order 4: pins are hinges of a tree, loops are soft equalities."""

from __future__ import annotations

from collections.abc import Iterator

import mujoco

from ..mechanisms import Mechanism
from ..problems import Problem
from ..rows import Attempt
from . import engines

NAME = "MuJoCo RK4"
STEPS = (1e-2, 1e-3, 1e-4)  # s
# Equalities as stiff as the step allows: time constant in steps, and impedance.
STIFF = 'solref="{:g} 1" solimp="0.9999 0.9999 0.001"'


def attempts(problem: Problem, quick: bool) -> Iterator[Attempt]:
    yield from engines.attempts(NAME, mujoco.__version__, STEPS[:1] if quick else STEPS, problem, Run)


class Run:
    """A mechanism at a step, compiled once."""

    def __init__(self, mechanism: Mechanism, step: float) -> None:
        self.mechanism = mechanism
        self.model = mujoco.MjModel.from_xml_string(xml(mechanism, step))

    def solve(self, steps: int) -> tuple[list[float], float]:
        data = started(self.model, self.mechanism)
        complaints: list[str] = []
        mujoco.set_mju_user_warning(complaints.append)  # else they go to a file and the terminal
        mujoco.mj_step(self.model, data, steps)
        if complaints:
            raise RuntimeError(complaints[0])
        mujoco.mj_forward(self.model, data)  # positions and energy of the last state
        angles: list[float] = []
        for i, rod in enumerate(self.mechanism.rods):  # a hinge turns relative to the parent
            angles.append(
                float(data.qpos[self.model.joint(f"h{i}").qposadr[0]])
                + (0.0 if rod.parent is None else angles[rod.parent])
            )
        return angles, float(data.energy.sum())


def started(model: mujoco.MjModel, mechanism: Mechanism) -> mujoco.MjData:
    data = mujoco.MjData(model)
    for i, rod in enumerate(mechanism.rods):
        hinge = model.joint(f"h{i}")
        parent = None if rod.parent is None else mechanism.rods[rod.parent]
        data.qpos[hinge.qposadr[0]] = rod.angle - (parent.angle if parent else 0.0)
        data.qvel[hinge.dofadr[0]] = rod.omega - (parent.omega if parent else 0.0)
    if mechanism.piston:
        slide = model.joint("slide")
        data.qpos[slide.qposadr[0]] = mechanism.end(mechanism.piston[0])[0]
        data.qvel[slide.dofadr[0]] = mechanism.end_velocity(mechanism.piston[0])[0]
    return data


def xml(mechanism: Mechanism, step: float) -> str:
    """The mechanism in the plane y = 0, z up; a hinge about -y turns counterclockwise seen from the front."""
    children: dict[int | None, list[int]] = {}
    for i, rod in enumerate(mechanism.rods):
        children.setdefault(rod.parent, []).append(i)

    def body(i: int) -> str:
        rod = mechanism.rods[i]
        x, z = rod.at if rod.parent is None else (mechanism.rods[rod.parent].length, 0.0)
        inertia = f'diaginertia="{rod.inertia:.17g} {rod.inertia:.17g} {rod.inertia:.17g}"'
        inner = "".join(body(j) for j in children.get(i, []))
        return (
            f'<body name="b{i}" pos="{x:.17g} 0 {z:.17g}"><joint name="h{i}" type="hinge" axis="0 -1 0"/>'
            f'<inertial pos="{rod.mass_center:.17g} 0 0" mass="{rod.mass:.17g}" {inertia}/>'
            f'<site name="e{i}" pos="{rod.length:.17g} 0 0"/>{inner}</body>'
        )

    stiff = STIFF.format(2 * step)
    bodies = "".join(body(i) for i in children[None])
    equal = "".join(f'<connect site1="e{i}" site2="e{j}" {stiff}/>' for i, j in mechanism.closed)
    if mechanism.piston:
        i, mass = mechanism.piston
        bodies += (
            '<body name="piston"><joint name="slide" type="slide" axis="1 0 0"/>'
            f'<inertial pos="0 0 0" mass="{mass:.17g}" diaginertia="1e-3 1e-3 1e-3"/>'
            '<site name="piston" pos="0 0 0"/></body>'
        )
        equal += f'<connect site1="e{i}" site2="piston" {stiff}/>'
    option = (
        f'<option gravity="0 0 -9.81" timestep="{step:.17g}" integrator="RK4" '
        'tolerance="1e-14" iterations="100">'
    )
    return (
        f'<mujoco>{option}<flag contact="disable" energy="enable"/></option><worldbody>{bodies}</worldbody>'
        f"<equality>{equal}</equality></mujoco>"
    )
