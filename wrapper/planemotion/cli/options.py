"""What the commands share: options, exit statuses and one line on stderr."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ..base.errors import located

if TYPE_CHECKING:
    from ..scene import Scene

FAILED, WRONG, INTERRUPTED = 1, 2, 130


def _values(_ctx: click.Context, _option: click.Parameter, given: Sequence[str]) -> dict[str, str]:
    """--set name=value as a table; the last one counts."""
    values = {}
    for text in given:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not (name and equals and value):
            raise click.BadParameter(f'"{text}": write name=value, such as d="2 in" or sweep.d.num=200')
        values[name] = value
    return values


set_option = click.option(
    "--set",
    "values",
    metavar="NAME=VALUE",
    multiple=True,
    callback=_values,
    help='A parameter (d="2 in"; without a unit it has that of the file), or a setting (solve.route=ida). '
    "Repeatable.",
)


a_path = click.Path(path_type=Path)


def say(text: str, *, error: bool = False) -> None:
    """One line for people, on stderr."""
    click.echo((click.style("error: ", fg="red", bold=True) if error else "") + text, err=True)


def advise(scene: Scene) -> None:
    """What is right in a scene and perhaps not meant."""
    for text in scene.data.advice:
        say(f"hint: {located(text, scene.file, scene.data.source.text)}")


def terminal_width() -> int | None:
    """Columns of the terminal that stdout is; None where it is a file or a pipe, whose lines have no end."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else None
