"""A run that did not come to its end tells which values its condition took."""

import pytest

import planemotion

_PENDULUM = """
until = "{until}"
parameters.e = {e}
ground.points.stop = [0, "-1 m"]
solve.max_time = "3 s"
bodies.rod = {{ rod = ["A", "B"], length = "1.2 m", mass = "3 kg", at = {{ A = [0, 0] }} }}
joints.A = {{ pin = ["rod.A", "ground"] }}
contacts.stop = {{ touch = ["rod.bottom", "ground.stop"], restitution = "e" }}
events.fast = "rod.omega > 30 rad/s"
ask.turned = {{ of = "rod.turned", unit = "deg" }}
"""


def _error(until: str, e: float = 0.6) -> str:
    error = planemotion.load_text(_PENDULUM.format(until=until, e=e)).run().error
    assert error is not None
    return error


@pytest.mark.parametrize(
    ("until", "e", "told"),
    [
        ("rod.turned = -200 deg", 1, "rod.turned lay between -90 deg and 0 deg up to t = 3 s"),
        ("rod.omega > 0", 0, "rod.omega lay between -4.952 rad/s and 0 rad/s"),
        (
            "fast",
            1,
            '4.952 rad/s up to t = 3 s (the event fast waits for "rod.omega > 30 rad/s")',
        ),
        (
            "rod.turned > -200 deg",
            1,
            "it is above that from the start on, and an event fires when a value rises",
        ),
        (
            "rod.turned < 200 deg",
            1,
            "it is below that from the start on, and an event fires when a value falls",
        ),
    ],
)
def test_the_range_of_what_was_waited_for_is_told(until: str, e: float, told: str) -> None:
    assert told in _error(until, e)


def test_what_came_to_rest_on_the_way_is_not_called_at_rest_from_the_start() -> None:
    # the first blow at t = 0: the rod lies at its stop, then nothing moves
    error = _error("rod.omega > 0", 0)
    assert "everything has come to rest" in error
    assert "from the start" not in error
