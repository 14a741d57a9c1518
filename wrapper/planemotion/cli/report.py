"""The command report: a scene, a study or a result as a page."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import click

from ..base.files import REPORTS, ending
from .options import FAILED, a_path, say, set_option


def _page(_ctx: click.Context, _option: click.Parameter, out: Path | None) -> Path | None:
    """An ending that is no page's is refused before anything is computed."""
    if out is not None:
        ending(out, REPORTS, "a report")
    return out


@click.command()
@click.argument("path", metavar="SCENE|RESULT", type=a_path)
@click.option(
    "--out",
    metavar="FILE",
    type=a_path,
    callback=_page,
    help="The page, .html (default: the name of SCENE or RESULT with .html, here).",
)
@click.option(
    "--replays",
    metavar="N",
    type=click.IntRange(1, 100),
    default=9,
    show_default=True,
    help="Of a study: at most so many cases are shown in motion.",
)
@set_option
@click.pass_context
def report(ctx: click.Context, path: Path, out: Path | None, replays: int, values: Mapping[str, str]) -> None:
    """Tell all of a scene, a study or a result on one page.

    The page needs nothing else: answers and errors, the motion, the picture and the text of the scene, how it
    was computed. Of a study, or the .h5 that `sweep` wrote, also plots, outcomes and cases in motion.
    """
    from ..reporting import report_of

    made = report_of(path, dict(values), replays)
    click.echo(made.save(out or Path(f"{path.stem}.html")))
    if made.fault:
        say(made.fault, error=True)
        ctx.exit(FAILED)
