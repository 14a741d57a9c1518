"""Scenes that start in an equilibrium, and what is said of it."""

from __future__ import annotations

import planemotion

STARTS = 'start = "equilibrium"\n'


def kind(text: str) -> str:
    """What a check says of the equilibrium."""
    (line,) = (
        line for line in planemotion.load_text(text).check().text.splitlines() if "equilibrium" in line
    )
    return line.split(",")[0].split("(")[0].strip()


def pendulum(angle: float, rest: str = "", until: str = "t = 0.5 s", free: float = 0) -> str:
    """A rod of 3 kg and 2 m on a pin with a torsion spring."""
    return f"""
until = "{until}"
[bodies.AB]
rod = ["A", "B"]
length = "2 m"
mass = "3 kg"
at = {{ A = [0, 0] }}
angle = "{angle} deg"
[joints.A]
pin = ["AB.A", "ground"]
[forces.spring]
torsion = ["AB", "ground"]
stiffness = "10 N*m/rad"
free_angle = "{free} deg"
{rest}
[ask]
angle = "AB.angle"
omega = "AB.omega"
couple = "spring.couple"
"""
