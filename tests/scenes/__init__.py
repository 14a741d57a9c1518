"""Scenes that tests and the benchmark share, and how they are asked.

`parts`: bodies with what holds them, as lines of TOML that stand before the tables of a scene.  `pendulum`:
the rod on a pin that sweeps and the command line run.  `chain`: links by an index; those of benchmarks are
written out by studies/benchmarks/generate.py.
"""

from __future__ import annotations

from typing import Any

import planemotion
from planemotion.engine.result import Answer

G = 9.81  # m/s^2, of a scene that gives no other
ROUTES = ("auto", "rk", "ida")  # the default, and those that go on in time


def answers(text: str, route: str = "auto", **parameters: Any) -> dict[str, Any]:
    """What a scene answers on a route, by the keys of its asks, with other values for some parameters."""
    result = planemotion.load_text(text).run(**{"solve.route": route, **parameters})
    assert result.status == "ok", result.error
    return {key: answer.value for key, answer in result.asks.items()}


def answers_at_ties(text: str, route: str = "auto", **parameters: Any) -> dict[str, Any]:
    """The answers; on the route ida, which is not as exact as ties, nothing is said of its errors."""
    return answers(text, route, **{"solve.estimate": route != "ida", **parameters})


def on_route(text: str, route: str = "auto") -> planemotion.RunResult:
    """The result of a scene on a route, whatever its status."""
    return planemotion.load_text(f'solve.route = "{route}"\n{text}').run()


def asked(result: planemotion.RunResult, ask: str) -> float:
    """An answer that is one number."""
    return number(result[ask])


def close(route: str) -> float:
    """How near answers of one second of smooth motion are to the truth."""
    return 1e-8 if route == "ida" else 1e-9


def number(value: Answer) -> float:
    """A value that is one number."""
    assert isinstance(value, int | float)
    return value


def numbers(value: Answer) -> list[Any]:
    """A value that is a list."""
    assert isinstance(value, list)
    return value


def within(route: str, ida: float = 1e-5, others: float = 1e-9) -> float:
    """The relative error that is allowed: the route ida keeps fewer digits than the others."""
    return ida if route == "ida" else others


def fault(text: str, **parameters: Any) -> str:
    """What is said of a run that fails."""
    try:
        planemotion.load_text(text).run(**parameters)
    except planemotion.SimulationError as error:
        return str(error)
    raise AssertionError("the run has not failed")
