"""Three scenes as a newcomer wrote them from README.md and docs/ alone: each attempt that failed, in order,
what the message said, and what was changed for it; in the end the answers are those of closed forms."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from planemotion import SceneError, load_text
from tests.scenes import G


@dataclass(frozen=True)
class Stumble:
    """The message, and what was changed for it: pairs of old and new."""

    told: str
    changes: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Story:
    """A scene as it was first written, the stumbles, and the answers."""

    first: str
    stumbles: tuple[Stumble, ...]
    answers: dict[str, float]


def slider_crank(r: float, length: float, rate: float) -> float:
    """The greatest speed of the piston."""
    a = np.linspace(0, 2 * np.pi, 2_000_001)
    slope = r * np.sin(a) * np.cos(a) / np.sqrt(length**2 - (r * np.sin(a)) ** 2)
    return float(np.abs(r * rate * (np.sin(a) + slope)).max())


HINGED = Story(
    """\
until = "stop strikes"
[bodies]
rod = { rod = "1 m", ends = ["A", "B"], mass = "2 kg", at = { A = [0, 0] } }
[joints]
A = { pin = ["rod.A", "ground"] }
[ground]
points = { peg = { polar = ["0.8 m", "-60 deg"] } }
[contacts]
stop = { touch = ["ground.peg", "rod.bottom"], restitution = 0.5 }
[ask]
speed_before = { of = "rod.omega", at = "before stop strikes" }
speed_after = "rod.omega"
impulse = "stop.impulse"
""",
    (
        Stumble('bodies.rod.ends: unknown key (did you mean "rod"?)', (('ends = ["A", "B"], ', ""),)),
        Stumble(
            'bodies.rod.rod = "1 m": the names of two ends are wanted, such as rod = ["A", "B"], and length',
            (('rod = "1 m"', 'rod = ["A", "B"], length = "1 m"'),),
        ),
        Stumble(
            'events.NAME = "stop strikes", then at = "before NAME"',
            (
                ('until = "stop strikes"', 'until = "strike"\nevents.strike = "stop strikes"'),
                ('"before stop strikes"', '"before strike"'),
            ),
        ),
        Stumble('such as "stop.impulse.norm"', (('"stop.impulse"', '"stop.impulse.norm"'),)),
    ),
    {
        "speed_before": -np.sqrt(3 * G * np.sin(np.pi / 3)),
        "speed_after": 0.5 * np.sqrt(3 * G * np.sin(np.pi / 3)),
        "impulse": (2 / 3) * 1.5 * np.sqrt(3 * G * np.sin(np.pi / 3)) / 0.8,
    },
)

CRANK = Story(
    """\
until = "crank.turned = 1 rev"
[parameters]
r = "50 mm"
l = "150 mm"
[bodies]
crank = { rod = ["O", "A"], length = "r", mass = "1 kg", at = { O = [0, 0] } }
rod = { rod = ["A", "B"], length = "l", mass = "2 kg", at = { A = "crank.A" } }
piston = { mass = "3 kg", at = "rod.B" }
[ground]
lines = { bore = { through = [0, 0], angle = "0 deg" } }
[joints]
O = { pin = ["crank.O", "ground"], angle = "(100 rad/s)*t" }
A = { pin = ["crank.A", "rod.A"] }
B = { pin = ["rod.B", "piston"] }
guide = { slider = ["piston", "ground.bore"] }
[ask]
top_speed = { max = "piston.v", unit = "m/s" }
work = { integral = "O.couple*crank.omega", unit = "N m" }
""",
    (
        Stumble(
            'body "piston" has no point or quantity "v"; it has G, center (did you mean "velocity"?)',
            (("piston.v", "piston.velocity"),),
        ),
        Stumble('such as "piston.velocity.norm"', (("piston.velocity", "piston.velocity.norm"),)),
        Stumble('"N m" is not a unit: units are words joined by * and /', (("N m", "N*m"),)),
    ),
    {"top_speed": slider_crank(0.05, 0.15, 100), "work": 0},
)

INCLINE = Story(
    """\
until = "disk.x = 2 m"
[bodies]
disk = { disk = "0.1 m", mass = "5 kg", at = { polar = ["0.1 m", "60 deg"] } }
[ground]
lines = { slope = { through = [0, 0], angle = "-30 deg" } }
[contacts]
floor = { touch = ["disk.rim", "ground.slope"], friction = 0.1 }
[ask]
v = "disk.velocity"
slips = "floor.slips"
""",
    (
        Stumble('such as "disk.velocity.norm"', (("disk.velocity", "disk.velocity.norm"),)),
        Stumble('unknown quantity of a contact "slips"', (("floor.slips", "floor.slip"),)),
    ),
    # it slips: a = g (sin - f cos), alpha r = 2 f g cos
    {
        "v": np.sqrt(2 * G * (0.5 - 0.1 * np.cos(np.pi / 6)) * (2 - 0.05) / np.cos(np.pi / 6)),
        "slips": np.sqrt(2 * G * (0.5 - 0.1 * np.cos(np.pi / 6)) * (2 - 0.05) / np.cos(np.pi / 6))
        * (1 - 0.2 * np.cos(np.pi / 6) / (0.5 - 0.1 * np.cos(np.pi / 6))),
    },
)  # fmt: skip


@pytest.mark.parametrize("story", [HINGED, CRANK, INCLINE], ids=["hinged rod", "slider-crank", "incline"])
def test_every_failed_attempt_is_explained_by_its_message(story: Story) -> None:
    text = story.first
    for stumble in story.stumbles:
        with pytest.raises(SceneError) as caught:
            load_text(text).run()
        assert stumble.told in str(caught.value)
        for old, new in stumble.changes:
            assert old in text
            text = text.replace(old, new)
    result = load_text(text).run()
    for name, expected in story.answers.items():
        assert result[name] == pytest.approx(expected, rel=1e-9, abs=1e-8)
