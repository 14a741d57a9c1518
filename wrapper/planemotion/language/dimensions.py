"""Dimensions of mechanics: exponents of mass, length and time, with the words and SI units of the field."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

# Largest denominator of an exponent of a dimension: roots of roots, not rounding noise.
_MAX_DENOMINATOR = 24


@dataclass(frozen=True)
class Dimension:
    """Exponents of mass, length and time."""

    mass: int | Fraction = 0
    length: int | Fraction = 0
    time: int | Fraction = 0

    def __mul__(self, other: Dimension) -> Dimension:
        return Dimension(self.mass + other.mass, self.length + other.length, self.time + other.time)

    def __truediv__(self, other: Dimension) -> Dimension:
        return Dimension(self.mass - other.mass, self.length - other.length, self.time - other.time)

    def __pow__(self, exponent: int | Fraction) -> Dimension:
        return Dimension(*(_exact(power * exponent) for power in (self.mass, self.length, self.time)))

    @property
    def name(self) -> str:
        """A word of the field such as "moment of inertia"; the formula where there is none."""
        known = _KNOWN_DIMENSIONS.get(self)
        return known[0] if known else f"quantity of {self.formula}"

    @property
    def phrase(self) -> str:
        """The name with its article: "a length", "an angular velocity"."""
        return f"{'an' if self.name[0] in 'aeiou' else 'a'} {self.name}"

    @property
    def formula(self) -> str:
        """Such as "mass*length^2/time^2"; "1" if dimensionless."""
        return _product((("mass", self.mass), ("length", self.length), ("time", self.time)))

    @property
    def unit(self) -> str:
        """The usual SI unit, in words that `factor` reads with factor 1; "" if dimensionless."""
        known = _KNOWN_DIMENSIONS.get(self)
        return known[1] if known else _product((("kg", self.mass), ("m", self.length), ("s", self.time)))


def _exact(power: int | Fraction) -> int | Fraction:
    """A whole number as an int."""
    return power.numerator if power.denominator == 1 else power


def _product(powers: tuple[tuple[str, int | Fraction], ...]) -> str:
    """Words with exponents as a text with at most one fraction bar: "kg*m/s^2"."""

    def join(factors: list[tuple[str, int | Fraction]]) -> str:
        return "*".join(word if p == 1 else f"{word}^{p if p == int(p) else f'({p})'}" for word, p in factors)

    above = join([(word, p) for word, p in powers if p > 0]) or "1"
    below = [(word, -p) for word, p in powers if p < 0]
    if not below:
        return above
    return f"{above}/{join(below)}" if len(below) == 1 else f"{above}/({join(below)})"


DIMENSIONLESS = Dimension()
MASS = Dimension(mass=1)
LENGTH = Dimension(length=1)
TIME = Dimension(time=1)
VELOCITY = LENGTH / TIME
ACCELERATION = VELOCITY / TIME
ANGULAR_VELOCITY = DIMENSIONLESS / TIME
ANGULAR_ACCELERATION = ANGULAR_VELOCITY / TIME
FORCE = MASS * ACCELERATION
MOMENT = ENERGY = FORCE * LENGTH
POWER = ENERGY / TIME
IMPULSE = MOMENTUM = FORCE * TIME
ANGULAR_IMPULSE = ANGULAR_MOMENTUM = MOMENT * TIME
INERTIA = MASS * LENGTH**2
STIFFNESS = FORCE / LENGTH
DAMPING = FORCE / VELOCITY
PRESSURE = FORCE / LENGTH**2
# name, SI unit
_KNOWN_DIMENSIONS: dict[Dimension, tuple[str, str]] = {
    DIMENSIONLESS: ("plain number", ""),
    MASS: ("mass", "kg"),
    LENGTH: ("length", "m"),
    TIME: ("time", "s"),
    VELOCITY: ("velocity", "m/s"),
    ACCELERATION: ("acceleration", "m/s^2"),
    ANGULAR_VELOCITY: ("angular velocity", "rad/s"),
    ANGULAR_ACCELERATION: ("angular acceleration", "rad/s^2"),
    FORCE: ("force", "N"),
    MOMENT: ("moment or energy", "N*m"),
    POWER: ("power", "W"),
    IMPULSE: ("impulse or momentum", "N*s"),
    ANGULAR_IMPULSE: ("angular impulse or momentum", "N*m*s"),
    INERTIA: ("moment of inertia", "kg*m^2"),
    STIFFNESS: ("stiffness", "N/m"),
    DAMPING: ("damping rate", "N*s/m"),
    PRESSURE: ("pressure", "Pa"),
    LENGTH**2: ("area", "m^2"),
    LENGTH**3: ("volume", "m^3"),
    MASS / LENGTH**3: ("density", "kg/m^3"),
}


def exact_exponent(power: float | Fraction) -> int | Fraction:
    """The exponent as a whole number or a fraction of small denominator, whichever it is up to rounding."""
    return _exact(Fraction(power).limit_denominator(_MAX_DENOMINATOR))
