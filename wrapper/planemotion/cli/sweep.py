"""The commands sweep and merge: a study into a folder, by one process or by many."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..base.words import counted
from .options import FAILED, a_path, say, set_option, terminal_width

if TYPE_CHECKING:
    from ..scene import Scene
    from ..sweep.run import SweepFiles
    from ..sweep.shard import Shard

# Without a terminal: seconds between two lines of progress.
_PLAIN_PROGRESS_EVERY = 5.0
_DIGITS_OF_TABLE = 6  # significant


def _shard(_ctx: click.Context, _option: click.Parameter, written: str | None) -> Shard | None:
    from ..sweep.shard import Shard

    return Shard.read(written) if written is not None else None


_table_option = click.option(
    "--table", metavar="WORD", default="csv", help="The table as csv (default) or parquet, or none."
)


@click.command()
@click.argument("study", type=a_path)
@click.option("--out", metavar="DIR", type=a_path, help="Folder of the result; it is made if need be.")
@click.option(
    "--workers", metavar="N", type=click.IntRange(min=1), help="Threads (default: one for each core)."
)
@click.option("--resume", is_flag=True, help="Go on where a sweep into DIR was ended.")
@click.option(
    "--shard",
    metavar="I/N",
    callback=_shard,
    help="Only the I-th of N parts of the cases; `merge` puts together what N processes computed.",
)
@click.option(
    "--format", "result", metavar="WORD", default="hdf5", help="The result as hdf5 (default) or zarr."
)
@click.option("--chunk", metavar="N", type=click.IntRange(min=1), help="Cases of a chunk of Zarr.")
@_table_option
@click.option(
    "--stop-after", metavar="N", type=click.IntRange(min=1), help="Stop when so many cases have failed."
)
@click.option("--dry-run", is_flag=True, help="Only estimate time, memory and files, by a sample of cases.")
@set_option
@click.pass_context
def sweep(
    ctx: click.Context,
    study: Path,
    out: Path | None,
    workers: int | None,
    resume: bool,
    shard: Shard | None,
    result: str,
    chunk: int | None,
    table: str,
    stop_after: int | None,
    dry_run: bool,
    values: Mapping[str, str],
) -> None:
    """Run all cases of a study and leave HDF5, CSV and PNG in DIR.

    A case that fails becomes a gap with a status and does not stop the others. Ctrl-C keeps what is done.
    """
    from ..file import load
    from ..sweep.forms import Form
    from ..sweep.run import sweep_files, sweep_shard

    form = Form(result, table, chunk)
    scene = load(study).with_values(values)
    if dry_run:
        _estimated(scene, out or Path(), workers)
        return
    if out is None:
        raise click.MissingParameter(param_hint="--out", param_type="option", ctx=ctx)
    if shard:
        with _progress() as report:
            done = sweep_shard(
                scene, out, shard, workers=workers, progress=report, stop_after=stop_after, form=form
            )
        left = f"{done.missing} of the sweep are missing" if done.missing else "all shards are there"
        say(f"shard {shard}: {counted(done.cases, 'case')}, {done.computed} computed; {left}")
        return
    begun = time.perf_counter()
    with _progress() as report:
        files = sweep_files(
            scene,
            out,
            workers=workers,
            resume=resume,
            progress=report,
            tell=say,
            stop_after=stop_after,
            form=form,
        )
    _told(ctx, files, time.perf_counter() - begun)


@click.command()
@click.argument("study", type=a_path)
@click.option("--out", required=True, metavar="DIR", type=a_path, help="Folder of the shards.")
@click.option("--wait", is_flag=True, help="Wait until all shards are computed, and show how far they are.")
@_table_option
@set_option
@click.pass_context
def merge(
    ctx: click.Context, study: Path, out: Path, wait: bool, table: str, values: Mapping[str, str]
) -> None:
    """Make one result of the shards of a study that are in DIR.

    It leaves what `sweep` would have left, with the same bytes in the table, and removes the shards.
    """
    from ..file import load
    from ..sweep.run import merge_shards

    scene = load(study).with_values(values)
    begun = time.perf_counter()
    with _progress() as report:
        files = merge_shards(scene, out, wait=wait, progress=report, tell=say, table=table)
    _told(ctx, files, time.perf_counter() - begun)


def _estimated(scene: Scene, out: Path, workers: int | None) -> None:
    """Tells what a sweep will take."""
    from ..sweep.estimate import estimate
    from ..sweep.size import readable

    found = estimate(scene, workers=workers, out=out)
    size = found.size
    error = f" ± {_duration(found.error)}" if found.error == found.error else ""
    lines = [
        f"{counted(size.cases, 'case')}; a sample of {found.sample} was computed: {_counted(found.statuses)}",
        f"  time    {_duration(found.seconds)}{error} of computing on {found.workers} threads",
        f"  memory  about {readable(found.memory)}",
        f"  files   {readable(size.result)} of HDF5 and {readable(size.table)} of CSV, and on the way "
        f"{readable(found.way)} more; {readable(found.free)} are free in {out}",
        *(f"  costly  {one.text}" for one in found.costliest),
    ]
    click.echo("\n".join(lines))


# From so many of one unit on the next one is told, and what a unit is in s.
_DURATIONS = ((120.0, 1.0, "s"), (7200.0, 60.0, "min"), (172_800.0, 3600.0, "h"))


def _duration(seconds: float) -> str:
    for most, one, unit in _DURATIONS:
        if seconds < most:
            return f"{seconds / one:.3g} {unit}"
    return f"{seconds / 86400:.3g} days"


def _counted(statuses: Mapping[str, int]) -> str:
    return ", ".join(f"{count} {word}" for word, count in sorted(statuses.items()))


def _told(ctx: click.Context, files: SweepFiles, seconds: float) -> None:
    """Draws and tells a result; exit status 1 if no case is ok."""
    from ..pictures.plots import plot
    from ..sweep.table import summarise

    image = plot(files.result)
    summary = summarise(files.result)
    click.echo(_table(summary.header, summary.rows))
    if summary.cases > len(summary.rows):
        click.echo(click.style(f"{len(summary.rows)} of {summary.cases} cases", dim=True))
    if summary.drawn:
        click.echo(_statistics(files.result))
    rate = f" in {seconds:.1f} s" + (f", {files.computed / seconds:.0f} cases/s" if files.computed else "")
    cases = counted(summary.cases, "case")
    click.echo(f"\n{cases} ({_counted(summary.statuses)}); {files.computed} computed{rate}")
    for one in summary.costliest:
        click.echo(f"  costly: {one.text}")
    for path in (files.table, files.result, image):
        if path.exists():
            click.echo(f"  {path}")
    if not summary.statuses.get("ok"):
        say("no case came to its end; the column reason of the table says why", error=True)
        ctx.exit(FAILED)


def _statistics(result: Path) -> str:
    """Mean, deviation and quantiles of the answers, with their standard errors."""
    from ..pictures.panels import open_sweep
    from ..report.aligned import Column, aligned
    from ..sweep.frames import QUANTILES, statistics

    with open_sweep(result) as dataset:
        table = statistics(dataset)
    names = ["mean", "deviation", *(f"q{round(100 * part):02d}" for part in QUANTILES)]
    rows = [
        [str(key), *(_with_error(row, name) for name in names), str(row["unit"]).replace("1", "")]
        for key, row in table.iterrows()
        if row["cases"] > 1
    ]
    heads = [["", "mean", "deviation", *(f"{part:.0%} below" for part in QUANTILES), ""]]
    columns = [Column(), *[Column(right=True)] * len(names), Column()]
    return "\n" + "\n".join(aligned(rows, columns, header=heads, width=terminal_width()))


def _with_error(row: Any, name: str) -> str:
    error = row.get(f"{name}_error", float("nan"))
    return f"{row[name]:.6g}" + ("" if error != error else f" ± {error:.1g}")


@contextmanager
def _progress() -> Iterator[Callable[[int, int], None]]:
    """Shows how far a sweep is: a bar on a terminal, now and then a line elsewhere."""
    if not sys.stderr.isatty():
        yield _PlainProgress()
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    rate = TextColumn("{task.fields[rate]}")
    columns = (BarColumn(), MofNCompleteColumn(), TextColumn("cases"), rate, TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True)) as bar:
        pace = _Pace()

        def report(done: int, total: int) -> None:
            if not bar.task_ids:  # only a sweep that can begin has a bar
                bar.add_task("", total=total, rate="")
            rate = pace.rate(done)
            bar.update(bar.task_ids[0], completed=done, rate=f"{rate:.0f} cases/s" if rate else "")

        yield report


class _Pace:
    """Cases per second since the first report: a resumed sweep does not begin at 0."""

    def __init__(self) -> None:
        self._begun = time.perf_counter()
        self._first: int | None = None

    def rate(self, done: int) -> float:
        if self._first is None:
            self._first = done
        return (done - self._first) / max(time.perf_counter() - self._begun, 1e-9)


class _PlainProgress:
    """A line on stderr every few seconds, and one at the end."""

    def __init__(self) -> None:
        self._pace = _Pace()
        self._reported = time.perf_counter()
        self._ended = False

    def __call__(self, done: int, total: int) -> None:
        now, rate = time.perf_counter(), self._pace.rate(done)
        if self._ended or (done < total and now - self._reported < _PLAIN_PROGRESS_EVERY):
            return
        self._reported, self._ended = now, done >= total
        left = (
            f", {rate:.0f} cases/s, {(total - done) / rate:.0f} s left" if rate > 0 and done < total else ""
        )
        say(f"{done} of {total} cases{left}")


def _table(header: Sequence[str], rows: Sequence[Sequence[Any]]) -> str:
    """Columns below names and units, fitted to a terminal; a column of empty words is left out."""
    from ..report.aligned import Column, aligned

    titles = [title.partition(" ")[::2] for title in header]
    words = [any(isinstance(row[i], str) for row in rows) for i in range(len(header))]
    shown = [i for i in range(len(header)) if not words[i] or any(row[i] for row in rows)]
    cells = [[row[i] if words[i] else _number_or_gap(row[i]) for i in shown] for row in rows]
    heads = [[titles[i][0] for i in shown], [titles[i][1].replace("[1]", "") for i in shown]]
    columns = [Column(right=not words[i]) for i in shown]
    return "\n".join(aligned(cells, columns, header=heads, width=terminal_width()))


def _number_or_gap(value: Any) -> str:
    number = float(value)
    return "-" if number != number else f"{number:.{_DIGITS_OF_TABLE}g}"
