"""The commands that tell about a scene: check, explain."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import click

from .options import FAILED, a_path, advise, say, set_option


@click.command()
@click.argument("path", metavar="SCENE|RESULT", type=a_path)
@set_option
@click.pass_context
def check(ctx: click.Context, path: Path, values: Mapping[str, str]) -> None:
    """Assemble a scene without running it, or verify a result.

    Of a scene it tells degrees of freedom, redundant constraints and how far the assembly moved what is
    drawn. Of an .h5 file that `sweep` or `run --history` wrote, a .zarr store, or a folder of them, whether
    it is as written.
    """
    from ..file import load
    from ..report import explain as explanations
    from ..sweep.verify import is_result

    if is_result(path):
        ctx.exit(_verify(path))
    scene = load(path).with_values(values)
    advise(scene)
    report = explanations.check(scene)
    click.echo(report.text)
    for fault in report.faults:
        say(fault, error=True)
    ctx.exit(FAILED if report.faults else 0)


def _verify(path: Path) -> int:
    from ..sweep.verify import verify

    found = verify(path)
    for one in found:
        if not one.faults:
            click.echo(f"{one.path}: as it was written")
        for fault in one.faults:
            say(f"{one.path}: {fault}", error=True)
    return FAILED if any(one.faults for one in found) else 0


@click.command()
@click.argument("scene", type=a_path)
@click.option(
    "--run", "also_run", is_flag=True, help="Run it too: phases, events, jumps, steps, audit, answers."
)
@set_option
@click.pass_context
def explain(ctx: click.Context, scene: Path, also_run: bool, values: Mapping[str, str]) -> None:
    """Tell what a scene is made of and how it is computed.

    With --run also what happened in the run.
    """
    from ..file import load
    from ..report import explain as explanations
    from ..run import simulate

    read = load(scene).with_values(values)
    report = explanations.explain(read)
    click.echo(report.text)
    for fault in report.faults:
        say(fault, error=True)
    if report.faults:
        ctx.exit(FAILED)
    if also_run:
        result = simulate(read)
        click.echo(explanations.explain_run(read, result))
        ctx.exit(0 if result.ok else FAILED)
