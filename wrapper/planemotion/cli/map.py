"""The command map: outcomes over two parameters, and the boundaries between them."""

from __future__ import annotations

import re
import time
from collections.abc import Mapping
from pathlib import Path

import click

from .options import a_path, say, set_option

# Seconds between two lines of progress.
_PROGRESS_EVERY = 5.0


@click.command("map")
@click.argument("study", type=a_path)
@click.option(
    "--out", required=True, metavar="DIR", type=a_path, help="Folder of the map; it is made if need be."
)
@click.option(
    "--workers", metavar="N", type=click.IntRange(min=1), help="Threads (default: one for each core)."
)
@set_option
def map_(study: Path, out: Path, workers: int | None, values: Mapping[str, str]) -> None:
    """Find where outcomes change over two parameters.

    It leaves HDF5 and PNG in DIR.

    The grids of [sweep] are where it starts: an island of an outcome that none of their places meets is not
    seen. [sweep] refine says what tells outcomes apart, and how near the boundaries are followed.
    """
    from ..file import load
    from ..mapping import outcome_map

    scene = load(study).with_values(values)
    made = outcome_map(scene, workers, _Progress())
    out.mkdir(parents=True, exist_ok=True)
    name = re.sub(r"[^\w.+-]", "_", scene.id).lstrip(".") or "map"
    paths = [made.save(out / f"{name}_map.{ending}") for ending in ("h5", "png")]
    attributes = made.dataset.attrs
    for outcome, share in sorted(made.outcomes.items(), key=lambda one: -one[1]):
        click.echo(f"{share:8.2%}  {outcome}")
    seconds, part = attributes["elapsed_seconds"], made.cases / attributes["cases_of_full_grid"]
    click.echo(
        f"\n{made.cases} cases in {seconds:.1f} s, {part:.2g} of a full grid; "
        f"{made.dataset.sizes['curve']} boundaries to {attributes['tolerance']:g} of the ranges"
    )
    if attributes["open_cells"]:
        say(
            f"in {attributes['open_cells']} cells as small as the tolerance more than one boundary is left: "
            "several outcomes meet there, or the boundaries lie closer together"
        )
    for path in paths:
        click.echo(f"  {path}")


class _Progress:
    """A line on stderr every few seconds."""

    def __init__(self) -> None:
        self._reported = time.perf_counter()

    def __call__(self, done: int) -> None:
        if time.perf_counter() - self._reported >= _PROGRESS_EVERY:
            self._reported = time.perf_counter()
            say(f"{done} cases")
