"""The command export-fmu: a scene for programs of co-simulation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import click

from .options import a_path, say, set_option


@click.command("export-fmu")
@click.argument("scene", type=a_path)
@click.option("--out", required=True, metavar="FILE", type=a_path, help="The file; its ending is .fmu.")
@click.option(
    "--quantity",
    "quantities",
    metavar="EXPRESSION",
    multiple=True,
    help="An output, such as AB.omega. Repeatable; without it motion, energies and what the asks read.",
)
@click.option("--run", "of_run", metavar="NAME", help="Which of [runs] (default: the first).")
@set_option
def export_fmu(
    scene: Path, out: Path, quantities: Sequence[str], of_run: str | None, values: Mapping[str, str]
) -> None:
    """Write a scene as an FMU for co-simulation (FMI 2.0) on Linux.

    Its parameters are those of the scene, to be set before the first step; outputs are quantities over time,
    all in SI.
    """
    from ..file import load
    from ..fmu import export_fmu as export

    made = export(load(scene).with_values(values), out, quantities, run=of_run)
    say(f"{made.path}: {len(made.parameters)} parameters, {len(made.outputs)} outputs")
