"""Bodies with what holds them, as lines of TOML: to be put before the first table of a scene."""

from __future__ import annotations

import json
from typing import Any

FLOOR = "ground.lines.floor = { through = [0, 0] }\n"


def inline(value: Any) -> str:
    """A value as TOML has it within a line."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {inline(one)}" for key, one in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(inline(one) for one in value) + "]"
    return json.dumps(value)


def body(name: str, **keys: Any) -> str:
    """A body by its keys."""
    return f"bodies.{name} = {inline(keys)}\n"


def rod(name: str = "AB", length: str = "1 m", mass: str = "1 kg", **keys: Any) -> str:
    """A slender rod from A, at the origin unless `at` says otherwise, to B."""
    shape = {"rod": ["A", "B"], "length": length, "mass": mass}
    return body(name, **{**shape, "at": {"A": [0, 0]}, **keys})


def rod_on_pin(name: str = "AB", joint: str = "A", **keys: Any) -> str:
    """A slender rod whose end A is pinned to the ground."""
    return rod(name, **keys) + f'joints.{joint} = {{ pin = ["{name}.A", "ground"] }}\n'


def on_axle(
    name: str = "wheel", axle: str = "axle", friction: Any = None, x: str | int = 0, **keys: Any
) -> str:
    """A body about its centre, pinned to the ground at (x, 0); `friction`: a couple, or the table of it."""
    key = "friction" if isinstance(friction, dict) else "friction_couple"
    pin = {"pin": [f"{name}.center", "ground"]} | ({} if friction is None else {key: friction})
    return body(name, at=[x, 0], **keys) + f"joints.{axle} = {inline(pin)}\n"


def drum_and_block(friction: Any = None) -> str:
    """A block of 3 kg on a cord that is wound on a drum of 0.2 m and 4 kg; it hangs on the drum's right."""
    return (
        on_axle("drum", disk="0.2 m", mass="4 kg", friction=friction)
        + body("block", mass="3 kg", at=["0.2 m", "-2 m"])
        + 'couplings.cord = { cord = ["drum.rim cw", "block"] }\n'
    )


def plate(name: str, width: str, height: str, mass: str, **keys: Any) -> str:
    """A rectangular plate with the corners A, B, C, D, counted from the lower left one."""
    return body(name, plate=[width, height], corners=["A", "B", "C", "D"], mass=mass, **keys)


def touching(name: str, mark: str, line: str = "floor", **options: Any) -> str:
    """A contact of a mark with a line of the ground."""
    return f"contacts.{name} = {inline({'touch': [mark, f'ground.{line}'], **options})}\n"


FALLING = """
id = "fall"
parameters = { h = "1 m", v = "0 m/s" }
bodies.ball = { mass = "1 kg", at = [0, "h"] }
start.ball.velocity.x = "v"
until = "landing"
events.landing = "ball.y = 0 m"
events.far = "ball.x > (1 m)"
"""


def beam_on_feet(
    contacts: str, feet: tuple[float, float, float] = (-2, 1, 2), at: str = "[0, 0]", solve: str = ""
) -> str:
    """A beam of 10 kg on feet A, B, C at so many metres beside its mass centre; asks come last."""
    marks = ", ".join(f'{name} = ["{x} m", 0]' for name, x in zip("ABC", feet, strict=True))
    moment = " + ".join(f"{x}*{name}.normal" for name, x in zip("ABC", feet, strict=True))
    return f"""
until = "t = 1 s"
{solve}
[ground]
lines = {{ floor = {{ through = [0, 0] }} }}
[bodies.beam]
rod = ["X", "Y"]
length = "4 m"
mass = "10 kg"
at = {at}
points = {{ {marks} }}
[contacts]
{contacts}
[ask]
A = "A.normal"
B = "B.normal"
C = "C.normal"
all = "A.normal + B.normal + C.normal"
moment = "{moment}"
"""


def rod_on_two_pins(pins: str, until: str = "t = 0.1 s") -> str:
    """A rod of 10 kg and 4 m on the level, pinned at both ends A and B by these joints; asks come last."""
    return f"""
until = "{until}"
[ground]
points = {{ A = ["-2 m", 0], B = ["2 m", 0] }}
[bodies.rod]
rod = ["A", "B"]
length = "4 m"
mass = "10 kg"
at = [0, 0]
[joints]
{pins}
[ask]
Ax = "A.force.x on rod"
Ay = "A.force.y on rod"
By = "B.force.y on rod"
"""
