"""The command schema: the language of scenes for editors."""

from __future__ import annotations

import json
from pathlib import Path

import click

from .options import a_path


@click.command()
@click.option("--out", metavar="FILE", type=a_path, help="Where it is written (default: to stdout).")
def schema(out: Path | None) -> None:
    """Write the JSON Schema of scene files.

    Editors check and complete scenes by it: "#:schema FILE" in the first line of a scene names it.
    """
    from ..base.files import appearing
    from ..report.schema import schema as made

    text = json.dumps(made(), indent=1) + "\n"
    if out is None:
        click.echo(text, nl=False)
        return
    with appearing(out) as temporary:
        temporary.write_text(text, encoding="utf-8")
    click.echo(out)
