"""The commands that draw: plot, draw, animate."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import click

from ..animation.needs import require
from ..animation.shows import USUAL, WORDS
from ..base.files import ANIMATIONS, PICTURES, ending
from ..base.themes import THEMES
from .options import FAILED, a_path, say, set_option

# Figures that `pictures.diagrams` draws; written here because that is imported only when it draws.
_FIGURES = ("free-body", "kinetic", "impulse-momentum", "energy")


def _picture(_ctx: click.Context, _option: click.Parameter, out: Path | None) -> Path | None:
    """An ending that is no picture's is refused before anything is computed."""
    if out is not None:
        ending(out, PICTURES, "a picture")
    return out


def _animation(_ctx: click.Context, _option: click.Parameter, out: Path | None) -> Path | None:
    """The same for an animation."""
    if out is not None:
        require(ending(out, ANIMATIONS, "an animation"))
    return out


def _out_option(
    says: str, check: Callable[[click.Context, click.Parameter, Path | None], Path | None]
) -> Callable[[Any], Any]:
    return click.option("--out", metavar="FILE", type=a_path, callback=check, help=says)


_theme_option = click.option(
    "--theme", type=click.Choice(THEMES), default="light", help="Ink on light or dark paper."
)


@click.command()
@click.argument("result", type=a_path)
@_out_option("The picture, .png, .svg or .pdf (default: a PNG beside RESULT).", _picture)
@_theme_option
def plot(result: Path, out: Path | None, theme: str) -> None:
    """Draw the result of a sweep, or a recorded history.

    RESULT is the .h5 file that `sweep` or `run --history` wrote.
    """

    from ..pictures.plots import plot

    click.echo(plot(result, out, theme))


@click.command()
@click.argument("scene", type=a_path)
@_out_option("The picture, .png, .svg or .pdf (default: SCENE's name with .png, here).", _picture)
@click.option(
    "--at",
    metavar="INSTANT",
    help='A time ("0.3 s"), an event ("strike", "strike 2", "before strike") or the "end" of the run.',
)
@click.option(
    "--as",
    "kind",
    type=click.Choice(_FIGURES),
    help="A diagram as in a textbook: free bodies, forces = m a, impulses of a blow, work of each force.",
)
@click.option(
    "--body", "bodies", metavar="NAME", multiple=True, help="With --as: only this one (repeatable)."
)
@click.option(
    "--show",
    metavar="WORDS",
    default="",
    help="Of dimensions, velocities, with commas; without --as.",
)
@click.option("--run", "run", metavar="NAME", help="Which of its [runs] (default: the first).")
@_theme_option
@set_option
@click.pass_context
def draw(
    ctx: click.Context,
    scene: Path,
    out: Path | None,
    at: str | None,
    kind: str | None,
    bodies: tuple[str, ...],
    show: str,
    run: str | None,
    theme: str,
    values: Mapping[str, str],
) -> None:
    """Draw a scene with names, at its start or another instant.

    It shows most modelling errors. With --as the diagrams of a textbook: without --at at the start, at the
    first blow (impulse-momentum), or over the whole run (energy).
    """
    from ..draw import draw as drawn
    from ..file import load

    if bodies and kind is None:
        raise click.UsageError("--body goes with --as")
    made = drawn(load(scene).with_values(values), at, kind, bodies, run, theme, show)
    click.echo(made.save(out or Path(f"{scene.stem}.png")))
    if made.fault:
        say(made.fault, error=True)
        ctx.exit(FAILED)


@click.command()
@click.argument("scene", type=a_path)
@_out_option("The animation, .html, .gif or .mp4 (default: SCENE's name with .html, here).", _animation)
@click.option(
    "--show",
    metavar="WORDS",
    default=",".join(USUAL),
    show_default=True,
    help=f"Of {', '.join(WORDS)}, with commas; slow: time passes slower around events.",
)
@click.option(
    "--trace",
    metavar="POINT",
    multiple=True,
    help="A point whose way is drawn, such as AB.B (repeatable; default: all particles).",
)
@click.option("--run", "run", metavar="NAME", help="Which of its [runs] (default: the first).")
@click.option(
    "--theme",
    type=click.Choice(THEMES),
    help="Ink on light or dark paper (default: light; a page is as the reader's system).",
)
@set_option
@click.pass_context
def animate(
    ctx: click.Context,
    scene: Path,
    out: Path | None,
    show: str,
    trace: tuple[str, ...],
    run: str | None,
    theme: str | None,
    values: Mapping[str, str],
) -> None:
    """Run a scene and show it in motion.

    HTML is one page that needs nothing else: play, scrub, slow motion, step from event to event. GIF and MP4
    show the same: blows with their impulses, the time with its events, and what --show and --trace ask for.
    """
    from ..animate import animate as animated
    from ..file import load

    made = animated(load(scene).with_values(values), run, show, trace, theme)
    click.echo(made.save(out or Path(f"{scene.stem}.html")))
    if made.fault:
        say(made.fault, error=True)
        ctx.exit(FAILED)
