"""A pair of toothed wheels, and a wheel on a rack."""

from __future__ import annotations

import math

from tests.scenes.parts import body, on_axle

PHI = math.radians(20)
I_A, I_B = 0.5 * 2 * 0.1**2, 0.5 * 6 * 0.2**2

PAIR = f"""
until = "t = 0.5 s"
plane = "horizontal"
parameters = {{ phi = "20 deg", T = "3 N*m", eta = 1 }}
{on_axle("A", "a", disk="0.1 m", mass="2 kg")}
{on_axle("B", "b", disk="0.2 m", mass="6 kg", x="0.3 m")}
couplings.mesh = {{ gears = ["A.rim", "B.rim"], pressure_angle = "phi" }}
forces.motor = {{ couple = "A", value = "T" }}
[ask]
omega = "B.omega"
along = "mesh.force.y on B"
apart = "mesh.force.x on B"
size = "mesh.force.norm"
axle_A = "a.force.x on A"
axle_B = "b.force.x on B"
axle_B_y = "b.force.y on B"
"""


RACK = f"""
until = "t = 0.4 s"
parameters = {{ phi = "20 deg", T = "3 N*m" }}
ground.lines.rail = {{ through = [0, "-0.1 m"] }}
{body("rack", mass="5 kg", inertia="1 kg*m^2", lines={"teeth": {"through": [0, 0]}}, at=[0, "-0.1 m"])}
{on_axle("A", "a", disk="0.1 m", mass="2 kg")}
joints.guide = {{ slider = ["rack.center", "ground.rail"], turning = false }}
couplings.mesh = {{ gears = ["A.rim", "rack.teeth"], pressure_angle = "phi" }}
forces.motor = {{ couple = "A", value = "T" }}
[ask]
omega = "A.omega"
v = "rack.velocity.x"
x = "rack.x"
along = "mesh.force.x on rack"
apart = "mesh.force.y on rack"
normal = "guide.force.y on rack"
axle = "a.force.y on A"
couple = "guide.couple on rack"
"""
