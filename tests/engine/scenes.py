"""Scenes that the tests of the engine share, and their answers."""

from __future__ import annotations

from typing import Any

from planemotion import load_text
from tests.scenes.parts import rod_on_pin

PENDULUM = f"""
until = "AB.turned = -60 deg"
parameters = {{ L = "1.2 m", m = "3 kg", phi = "20 deg" }}
ground.lines.slope = {{ through = [0, 0], angle = "phi" }}
{rod_on_pin(length="L", mass="m", angle="-10 deg", lines={"own": {"through": [0, 0], "angle": "phi"}})}
bodies.C = {{ disk = "0.2 m", mass = "1 kg", at = "AB.B" }}
joints.B = {{ pin = ["C.center", "AB.B"] }}
start = {{ C.omega = "3 rad/s", AB.omega = "-1 rad/s" }}
"""


def answers_to(asks: dict[str, str], text: str = PENDULUM) -> dict[str, Any]:
    """The values of expressions at the end of the run."""
    scene = load_text(text)
    for key, ask in asks.items():
        scene.ask(key, ask)
    return {key: value.value for key, value in scene.run().asks.items()}


BROKEN = f"""
until = "t = 1 s"
{rod_on_pin("a", "p", angle="0 deg")}
ground.lines.high = {{ through = [0, "0.3 m"] }}
"""
FAILURES = [
    ('joints.q = { slider = ["a.B", "ground.high"] }', "assembly", "joints.q is open by 0.3 m"),
    (
        'start = { a.omega = "1 rad/s", "a.B.velocity.y" = "3 m/s" }',
        "start_conflict",
        "start.a.B.velocity.y: 3 m/s is given",
    ),
    (
        'bodies.b = { disk = "1 m", mass = "1 kg", at = [0, 0] }\n'
        'contacts.c = { touch = ["b.rim", "ground.high"] }',
        "penetration",
        "contacts.c: the two overlap by 1.3 m at the start",
    ),
    (
        'bodies.b = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = "a.B" } }\n'
        'joints.q = { pin = ["a.B", "b.A"] }\nstart.a.omega = "1 rad/s"',
        "start_open",
        "leaves the motion of bodies.b undetermined",
    ),
]
