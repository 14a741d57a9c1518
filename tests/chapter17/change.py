"""What is different for another observer: axes, units, and the factor that each measure gains."""

from __future__ import annotations

from dataclasses import dataclass


class NoRule(Exception):
    """The scene has something for which this module has no rule."""


@dataclass(frozen=True)
class Change:
    """phi: turned by, rad; mirrored first; factors of length, time, mass."""

    phi: float = 0.0
    mirrored: bool = False
    length: float = 1.0
    time: float = 1.0
    mass: float = 1.0

    @property
    def sign(self) -> float:
        return -1.0 if self.mirrored else 1.0

    def size(self, mass: int, length: int, time: int) -> float:
        """The factor of a quantity of that dimension."""
        return float(self.mass**mass * self.length**length * self.time**time)


# Measures: exponents of mass, length, time, and whether the sign turns when mirrored.
MEASURES = {
    "TIME": (0, 0, 1, 0),
    "ANGLE": (0, 0, 0, 1),
    "TURNED": (0, 0, 0, 1),
    "OMEGA": (0, 0, -1, 1),
    "ALPHA": (0, 0, -2, 1),
    "MASS": (1, 0, 0, 0),
    "WEIGHT": (1, 1, -2, 0),
    "INERTIA": (1, 2, 0, 0),
    "KINETIC": (1, 2, -2, 0),
    "MOMENTUM": (1, 1, -1, 0),
    "ANGULAR_MOMENTUM": (1, 2, -1, 1),
    "POLE": (0, 1, 0, 0),
    "POSITION": (0, 1, 0, 0),
    "MOVED": (0, 1, 0, 0),
    "PATH": (0, 1, 0, 0),
    "VELOCITY": (0, 1, -1, 0),
    "ACCELERATION": (0, 1, -2, 0),
    "JOINT_FORCE": (1, 1, -2, 0),
    "JOINT_COUPLE": (1, 2, -2, 1),
    "JOINT_IMPULSE": (1, 1, -1, 0),
    "JOINT_NORMAL": (1, 1, -2, 0),
    "JOINT_FRICTION": (1, 1, -2, 1),
    "JOINT_FRICTION_NEEDED": (0, 0, 0, 0),
    "CONTACT_GAP": (0, 1, 0, 0),
    "CONTACT_CLOSED": (0, 0, 0, 0),
    "CONTACT_SLIP": (0, 1, -1, 1),
    "CONTACT_NORMAL": (1, 1, -2, 0),
    "CONTACT_FRICTION": (1, 1, -2, 1),
    "CONTACT_FRICTION_NEEDED": (0, 0, 0, 0),
    "CONTACT_FORCE": (1, 1, -2, 0),
    "CONTACT_IMPULSE": (1, 1, -1, 0),
    "FORCE_FORCE": (1, 1, -2, 0),
    "FORCE_COUPLE": (1, 2, -2, 1),
    "FORCE_WORK": (1, 2, -2, 0),
    "FORCE_POWER": (1, 2, -3, 0),
    "FORCE_ENERGY": (1, 2, -2, 0),
    "FORCE_STRETCH": (0, 1, 0, 0),  # of points
    "EVENT_COUNT": (0, 0, 0, 0),
    "EVENT_SIDE": (0, 0, 0, 0),
    "EVENT_TIME": (0, 0, 1, 0),
    "POTENTIAL": (1, 2, -2, 0),
    "TOTAL": (1, 2, -2, 0),
    "LOST": (1, 2, -2, 0),
    "SPIN_OMEGA": (0, 0, -1, 0),
    "SPIN_ANGLE": (0, 0, 0, 0),
    "SPIN_MOMENTUM": (1, 2, -1, 0),
    "SPIN_INERTIA": (1, 2, 0, 0),
}
