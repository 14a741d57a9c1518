"""The command new: a scene to begin with."""

from __future__ import annotations

from pathlib import Path

import click

from ..base.errors import StudyError
from ..examples import FIRST, text_of, titles
from .options import a_path


def _show(ctx: click.Context, _option: click.Parameter, asked: bool) -> None:
    if not asked:
        return
    width = max(map(len, titles()))
    for name, title in titles().items():
        click.echo(f"{name:{width}}  {title}")
    ctx.exit()


@click.command()
@click.argument("name", type=a_path)
@click.option("--from", "example", metavar="EXAMPLE", help=f"What is copied (default: NAME, or {FIRST}).")
@click.option(
    "--list", is_flag=True, is_eager=True, expose_value=False, callback=_show, help="Show the examples."
)
def new(name: Path, example: str | None) -> None:
    """Write NAME.toml, a commented scene to begin with.

    It is a copy of the example of that name, or of the pendulum. Nothing is overwritten.
    """
    path = name if name.suffix == ".toml" else name.with_name(f"{name.name}.toml")
    text = text_of(example or (path.stem if path.stem in titles() else FIRST))
    try:
        with open(path, "x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        raise StudyError(f"{path} is there already, and is not overwritten; choose another name") from None
    except FileNotFoundError:
        raise StudyError(f"{path}: there is no folder {path.parent}") from None
    click.echo(f"{path}: {text.partition(chr(10))[0].lstrip('# ')}")
    click.echo(f"next: planemotion {'sweep' if '[sweep]' in text else 'run'} {path}")
