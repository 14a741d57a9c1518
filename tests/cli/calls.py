"""The command line as it is called here: scenes to give it, what it says and leaves."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from click.testing import CliRunner, Result

from planemotion.cli.main import main
from tests.scenes.pendulum import RELEASED

# Another angle than the rod can reach: one ask has no number.
NOT_REACHED = RELEASED.replace('"AB.angle = -60 deg"', '"AB.angle = 60 deg"').replace(
    '"pendulum"', '"unreached"'
)
UNKNOWN_KEY = RELEASED.replace("length =", "lenght =")
# The run ends by its limit: an answer that cannot stand for the asked end.
ENDLESS = 'id = "endless"\n' + RELEASED.replace('id = "pendulum"', "").replace(
    'until = "t = 0.35 s"', 'until = "AB.angle = 60 deg"\nsolve.max_time = "0.2 s"'
)
# The two ends of the rod are pinned farther apart than it is long.
TORN = RELEASED.replace(
    "joints.A =", 'ground.points.P = [2, 0]\njoints.B = { pin = ["AB.B", "ground.P"] }\njoints.A ='
).replace("[2, 0]", '["2 m", 0]')


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def invoke(*arguments: str | Path) -> Result:
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


def strict_json(text: str) -> Any:
    def refuse(word: str) -> None:
        raise AssertionError(f"{word} is no JSON")

    return json.loads(text, parse_constant=refuse)


def command(*arguments: str | Path) -> list[str]:
    return [sys.executable, "-m", "planemotion.cli", *(str(argument) for argument in arguments)]


def left_in(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}
