"""The command line: `planemotion run | sweep | check | explain | plot | draw`.

Exit status: 0 all is well; 1 a run failed or ended early; 2 what was given is wrong (a file, a key, a value,
an output that cannot be written); 130 stopped by Ctrl-C.  Results go to stdout, all else to stderr.

Heavy modules are imported inside the commands, so that --help and a mistyped option answer at once.
"""

from __future__ import annotations

import errno
import json
import os
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .base.errors import PlanemotionError, SceneError, SimulationError, StudyError

if TYPE_CHECKING:
    from .engine.result import AskValue, RunResult
    from .scene import Scene

_FAILED, _WRONG, _INTERRUPTED = 1, 2, 130
# Without a terminal: seconds between two lines of progress.
_PLAIN_PROGRESS_EVERY = 5.0
_SHOWN_OF_LIST = 6
_DIGITS = 8  # significant, of an answer; of a table of many
_DIGITS_OF_TABLE = 6


class _Commands(click.Group):
    """Turns the errors of the package into one message and an exit status."""

    def invoke(self, ctx: click.Context) -> Any:
        try:
            return super().invoke(ctx)
        except SimulationError as error:
            status, text = _FAILED, str(error)
        except PlanemotionError as error:
            status, text = (_INTERRUPTED if _is_interruption(error) else _WRONG), str(error)
        except OSError as error:
            if error.errno == errno.EPIPE:  # `planemotion ... | head`: click ends quietly
                raise
            status, text = _WRONG, f"{error.filename or 'standard output'}: {error.strerror or error}"
        except KeyboardInterrupt:
            status, text = _INTERRUPTED, "stopped"
        _say(text, error=status != _INTERRUPTED)
        ctx.exit(status)


def _is_interruption(error: PlanemotionError) -> bool:
    return type(error).__name__ == "SweepInterrupted"  # its module is heavy and may not be loaded


def _say(text: str, *, error: bool = False) -> None:
    """One line for people, on stderr."""
    click.echo((click.style("error: ", fg="red", bold=True) if error else "") + text, err=True)


def _values(_ctx: click.Context, _option: click.Parameter, given: Sequence[str]) -> dict[str, str]:
    """--set name=value as a table; the last one counts."""
    values = {}
    for text in given:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not (name and equals and value):
            raise click.BadParameter(f'"{text}": write name=value, such as d="2 in" or sweep.d.num=200')
        values[name] = value
    return values


_set_option = click.option(
    "--set",
    "values",
    metavar="NAME=VALUE",
    multiple=True,
    callback=_values,
    help='A parameter, with or without unit (d="2 in"), or a setting (solve.route=ida). Repeatable.',
)
_path = click.Path(path_type=Path)


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="planemotion", prog_name="planemotion")
def main() -> None:
    """Rigid bodies in plane motion: energy, momentum, impacts.

    Scenes are TOML files; a study is a scene with a [sweep].
    """


# ---- run ------------------------------------------------------------------------------------------------


@main.command()
@click.argument("paths", nargs=-1, required=True, type=_path)
@click.option("--json", "json_out", metavar="OUT", help="Write the answers as JSON to OUT (- for stdout).")
@_set_option
@click.option(
    "--history", "history_out", metavar="FILE.h5", type=_path, help="Record the motion of one scene."
)
@click.pass_context
def run(
    ctx: click.Context,
    paths: Sequence[Path],
    json_out: str | None,
    values: Mapping[str, str],
    history_out: Path | None,
) -> None:
    """Run scenes and answer what they ask.

    PATHS are files, or folders whose *.toml files are run. A study runs its base case. A scene that fails
    does not stop the others; the exit status is 0 only if every one is ok.
    """
    files = _scene_files(paths)
    if history_out is not None and len(files) > 1:
        raise click.UsageError(f"--history records one scene, but {len(files)} files are given")
    entries, worst = [], 0
    with ExitStack() as outputs:
        # Both places are claimed before the work, so that one which cannot be written costs no time.
        json_path = outputs.enter_context(_claimed(Path(json_out))) if json_out not in (None, "-") else None
        history_path = outputs.enter_context(_claimed(history_out)) if history_out is not None else None
        for file in files:
            entry, text, status = _run_one(file, values, history_path)
            worst = max(worst, status)
            entries.append(entry)
            if json_out is None:
                click.echo(text, nl=False)
            if "error" in entry:
                _say(entry["error"], error=True)
        if json_out is not None:
            document = json.dumps({"scenes": entries}, indent=1, allow_nan=False, ensure_ascii=False) + "\n"
            if json_path is None:
                click.echo(document, nl=False)
            else:
                json_path.write_text(document, encoding="utf-8")
    for written in (json_out if json_out != "-" else None, history_out):
        if written is not None and Path(written).exists():
            _say(f"wrote {written}")
    ctx.exit(worst)


def _scene_files(paths: Sequence[Path]) -> list[Path]:
    """The files named, and the *.toml files below the folders named, in order of their names."""
    files: list[Path] = []
    for path in paths:
        if not path.is_dir():
            files.append(path)
            continue
        found = sorted(file for file in path.rglob("*.toml") if not _is_hidden(file.relative_to(path)))
        if not found:
            raise StudyError(f"{path}: there are no scene files (*.toml) in this folder")
        files += found
    return files


def _is_hidden(path: Path) -> bool:
    return any(part.startswith(".") for part in path.parts)


def _run_one(file: Path, values: Mapping[str, str], history: Path | None) -> tuple[dict[str, Any], str, int]:
    """One scene: its entry for JSON, its text for people, its exit status.  Raises no SceneError."""
    from .file import load
    from .run import simulate

    identity = file.stem
    try:
        scene = load(file).with_values(values)
        identity = scene.id
        result = _interruptible(simulate, scene)
        if history is not None:
            _record(scene, history)
    except SceneError as error:
        entry = {"id": identity, "file": os.fspath(file), "status": "bad_input", "error": str(error)}
        return {**entry, "route": [], "asks": {}, "audit": {}}, "", _WRONG
    except SimulationError as error:
        entry = {"id": identity, "file": os.fspath(file), "status": "failed", "error": str(error)}
        return {**entry, "route": [], "asks": {}, "audit": {}}, "", _FAILED
    return result.to_json(), _answers(scene, result), 0 if result.ok else _FAILED


def _interruptible(work: Callable[[Any], Any], subject: Any) -> Any:
    """Does work that keeps its thread in the kernel, while this one listens to Ctrl-C."""
    from threading import Thread

    outcome: list[Any] = []
    fault: list[BaseException] = []

    def do() -> None:
        try:
            outcome.append(work(subject))
        except BaseException as error:
            fault.append(error)

    thread = Thread(target=do, daemon=True)  # must not keep a stopped process alive
    thread.start()
    thread.join()
    if fault:
        raise fault[0]
    return outcome[0]


def _record(scene: Scene, path: Path) -> None:
    """Writes the history of a scene, of each of its [runs]."""
    from .compile.flatten import flatten
    from .engine import call as engine
    from .engine import history

    runs = {}
    for run in scene.run_names or (None,):
        flat = flatten(scene, run)
        runs[run or ""] = _interruptible(lambda one: engine.trace(one, one.defaults), flat)
    attributes = {"id": scene.id, "title": scene.data.title, "scene": scene.text}
    history.write(path, runs, attributes)


def _answers(scene: Scene, result: RunResult) -> str:
    """What a terminal shows of a result."""
    colour = "green" if result.ok else "red"
    title = f"  {scene.data.title}" if scene.data.title else ""
    lines = [f"{click.style(result.id, bold=True)}{title}: {click.style(result.status, fg=colour)}"]
    rows = [(key, *_value_and_unit(ask)) for key, ask in result.asks.items()]
    keys = max((len(row[0]) for row in rows), default=0)
    numbers = max((len(row[1]) for row in rows if not row[3]), default=0)
    units = max((len(row[2]) for row in rows if not row[3]), default=0)
    for key, number, unit, is_list, *notes in rows:
        value = f"{number}  {unit}" if is_list else f"{number:>{numbers}}  {unit:<{units}}"
        tail = "".join(click.style(f"  {note}", dim=True) for note in notes if note)
        lines.append(f"  {key:<{keys}}  {value}{tail}" if tail else f"  {key:<{keys}}  {value}".rstrip())
    audit = ", ".join(
        f"{name} {'-' if value is None else f'{value:.1e}'}" for name, value in result.audit.items()
    )
    lines.append(click.style(f"  audit: {audit}; route: {', '.join(result.route) or 'none'}", dim=True))
    lines += [click.style(f"  {note}", fg="yellow") for note in result.notes]
    return "\n".join(lines) + "\n\n"


def _value_and_unit(ask: AskValue) -> tuple[str, str, bool, str, str]:
    """The answer as text, its unit, whether it is a list, its error, and why something is missing."""
    unit, error, reason = (
        "" if ask.unit == "1" else ask.unit,
        _error(ask),
        f"({ask.reason})" if ask.reason else "",
    )
    if not isinstance(ask.value, list):
        return _number(ask.value), unit, False, error, reason
    shown = [_number(value) for value in ask.value[:_SHOWN_OF_LIST]]
    more = [f"... {len(ask.value)} values"] if len(ask.value) > _SHOWN_OF_LIST else []
    return ", ".join([*shown, *more]) or "-", unit, True, error, reason


def _error(ask: AskValue) -> str:
    """The estimated error, of a list the greatest, or the margin."""
    if ask.margin is not None:
        return f"margin {ask.margin:.1e}"
    if ask.error is None:
        return ""
    errors = ask.error if isinstance(ask.error, list) else [ask.error]
    return f"\u00b1 {max(error for error in errors if error is not None):.1e}"


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.{_DIGITS}g}"


# ---- sweep ----------------------------------------------------------------------------------------------


@main.command()
@click.argument("study", type=_path)
@click.option(
    "--out", required=True, metavar="DIR", type=_path, help="Folder of the result; it is made if need be."
)
@click.option(
    "--workers", metavar="N", type=click.IntRange(min=1), help="Threads (default: one for each core)."
)
@click.option("--resume", is_flag=True, help="Go on where a sweep into DIR was ended.")
@_set_option
@click.pass_context
def sweep(
    ctx: click.Context, study: Path, out: Path, workers: int | None, resume: bool, values: Mapping[str, str]
) -> None:
    """Run all cases of a study and leave HDF5, CSV and PNG in DIR.

    A case that fails becomes a gap with a status and does not stop the others. Ctrl-C keeps what is done.
    """
    from .file import load
    from .sweep.study import plan_sweep, sweep_files

    scene = load(study).with_values(values)
    total = plan_sweep(scene).cases
    begun = time.perf_counter()
    with _progress(total) as report:
        files = sweep_files(scene, out, workers=workers, resume=resume, progress=report)
    seconds = time.perf_counter() - begun

    from .pictures import plots as picture
    from .sweep.export import summarise

    image = picture.plot(files.result)
    summary = summarise(files.result)
    click.echo(_table(summary.header, summary.rows))
    if summary.cases > len(summary.rows):
        click.echo(click.style(f"{len(summary.rows)} of {summary.cases} cases", dim=True))
    statuses = ", ".join(f"{count} {word}" for word, count in sorted(summary.statuses.items()))
    rate = f", {files.computed / seconds:.0f} cases/s" if files.computed else ""
    click.echo(f"\n{summary.cases} cases ({statuses}); {files.computed} computed in {seconds:.1f} s{rate}")
    for path in (files.table, files.result, image):
        click.echo(f"  {path}")
    if not summary.statuses.get("ok"):
        _say("no case came to its end; the column reason of the table says why", error=True)
        ctx.exit(_FAILED)


@contextmanager
def _progress(total: int) -> Iterator[Callable[[int, int], None]]:
    """Shows how far a sweep is: a bar on a terminal, now and then a line elsewhere."""
    if not sys.stderr.isatty():
        yield _PlainProgress()
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    rate = TextColumn("{task.fields[rate]}")
    columns = (BarColumn(), MofNCompleteColumn(), TextColumn("cases"), rate, TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True)) as bar:
        task = bar.add_task("", total=total, rate="")
        begun, first = time.perf_counter(), [-1]

        def report(done: int, _total: int) -> None:
            if first[0] < 0:
                first[0] = done  # a resumed sweep does not begin at 0
            seconds = time.perf_counter() - begun
            rate = (done - first[0]) / seconds if seconds > 0 else 0.0
            bar.update(task, completed=done, rate=f"{rate:.0f} cases/s" if rate else "")

        yield report


class _PlainProgress:
    """A line on stderr every few seconds, and one at the end."""

    def __init__(self) -> None:
        self._begun = self._told = time.perf_counter()
        self._first: int | None = None
        self._ended = False

    def __call__(self, done: int, total: int) -> None:
        now = time.perf_counter()
        if self._first is None:
            self._first = done  # a resumed sweep does not begin at 0
        if self._ended or (done < total and now - self._told < _PLAIN_PROGRESS_EVERY):
            return
        self._told, self._ended = now, done >= total
        rate = (done - self._first) / max(now - self._begun, 1e-9)
        left = (
            f", {rate:.0f} cases/s, {(total - done) / rate:.0f} s left" if rate > 0 and done < total else ""
        )
        _say(f"{done} of {total} cases{left}")


def _table(header: Sequence[str], rows: Sequence[Sequence[Any]]) -> str:
    """Aligned columns below names and units; numbers on the right; a column of empty words is left out."""
    texts = []
    for i, title in enumerate(header):
        cells = [row[i] if isinstance(row[i], str) else _number_or_gap(row[i]) for row in rows]
        is_word = any(isinstance(row[i], str) for row in rows)
        if is_word and not any(cells):
            continue
        name, _, unit = title.partition(" ")
        shown = [name, unit if unit != "[1]" else "", *cells]
        width = max(map(len, shown))
        texts.append([f"{cell:{'<' if is_word else '>'}{width}}" for cell in shown])
    lines = ["  ".join(cells).rstrip() for cells in zip(*texts, strict=True)]
    return "\n".join([*(click.style(line, bold=True) for line in lines[:2]), *lines[2:]])


def _number_or_gap(value: Any) -> str:
    number = float(value)
    return "-" if number != number else f"{number:.{_DIGITS_OF_TABLE}g}"


# ---- check, explain -------------------------------------------------------------------------------------


@main.command()
@click.argument("scene", type=_path)
@_set_option
@click.pass_context
def check(ctx: click.Context, scene: Path, values: Mapping[str, str]) -> None:
    """Read and assemble a scene without running it.

    Tells degrees of freedom, redundant rows and how far the assembly moved what is drawn.
    """
    from .file import load
    from .report import explain as explanations

    report = explanations.check(load(scene).with_values(values))
    click.echo(report.text)
    for fault in report.faults:
        _say(fault, error=True)
    ctx.exit(_FAILED if report.faults else 0)


@main.command()
@click.argument("scene", type=_path)
@click.option(
    "--run", "also_run", is_flag=True, help="Run it too: phases, events, jumps, steps, audit, answers."
)
@_set_option
@click.pass_context
def explain(ctx: click.Context, scene: Path, also_run: bool, values: Mapping[str, str]) -> None:
    """Tell what a scene is made of and how it is computed.

    With --run also what happened in the run.
    """
    from .file import load
    from .report import explain as explanations
    from .run import simulate

    read = load(scene).with_values(values)
    report = explanations.explain(read)
    click.echo(report.text)
    for fault in report.faults:
        _say(fault, error=True)
    if report.faults:
        ctx.exit(_FAILED)
    if also_run:
        result = _interruptible(simulate, read)
        click.echo(explanations.explain_run(read, result))
        ctx.exit(0 if result.ok else _FAILED)


# ---- pictures -------------------------------------------------------------------------------------------


@main.command()
@click.argument("result", type=_path)
@click.option("--out", metavar="PNG", type=_path, help="The picture (default: beside RESULT).")
def plot(result: Path, out: Path | None) -> None:
    """Draw the result of a sweep, or a recorded history.

    RESULT is the .h5 file that `sweep` or `run --history` wrote.
    """
    from .pictures import plots as picture

    click.echo(picture.plot(result, out))


@main.command()
@click.argument("scene", type=_path)
@click.option("--out", metavar="PNG", type=_path, help="The picture (default: SCENE's name with .png, here).")
@_set_option
@click.pass_context
def draw(ctx: click.Context, scene: Path, out: Path | None, values: Mapping[str, str]) -> None:
    """Draw a scene at its start, with names.

    It shows most modelling errors.
    """
    from .file import load
    from .pictures import scene as sketch

    target = out or Path(f"{scene.stem}.png")
    start = sketch.start_of(load(scene).with_values(values))
    sketch.draw(start, target)
    click.echo(target)
    if start.fault:
        _say(start.fault, error=True)
        ctx.exit(_FAILED)


# ---- outputs --------------------------------------------------------------------------------------------


class _NothingWritten(Exception):
    """Leaves a claimed place as it was."""


@contextmanager
def _claimed(path: Path) -> Iterator[Path]:
    """A temporary file beside `path`, made at once; what is written there becomes `path` when the block ends.

    If nothing was written, or the block raised, `path` stays as it was.  Devices and pipes are written
    directly.  Raises StudyError if the place cannot be written.
    """
    if path.is_dir():
        raise StudyError(f"{path}: is a folder; a file is wanted")
    if path.exists() and not path.is_file():
        yield path
        return
    if not path.parent.is_dir():
        raise StudyError(f"{path}: cannot be written: there is no folder {path.parent}")
    from .sweep.store import appearing

    with suppress(_NothingWritten), appearing(path.resolve()) as temporary:
        temporary.touch()
        yield temporary
        if temporary.stat().st_size == 0:
            raise _NothingWritten


if __name__ == "__main__":
    main()
