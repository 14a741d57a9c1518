"""The command run: scenes and what they answer."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..base.bounded import shown
from ..base.errors import SceneError, SimulationError, StudyError
from ..base.files import HISTORIES, appearing, ending
from .options import FAILED, WRONG, a_path, advise, say, set_option, terminal_width

if TYPE_CHECKING:
    from ..engine.answer import AskValue
    from ..engine.result import RunResult
    from ..scene import Scene


@dataclass(frozen=True)
class _Recording:
    """What is written over time: into which file, at which times, which quantities."""

    file: Path | None
    every: str | None
    quantities: Sequence[str]


def _history_file(_ctx: click.Context, _option: click.Parameter, out: Path | None) -> Path | None:
    """An ending that is no history's is refused before anything is computed."""
    if out is not None:
        ending(out, HISTORIES, "a history")
    return out


@click.command()
@click.argument("paths", nargs=-1, required=True, type=a_path)
@click.option("--json", "json_out", metavar="OUT", help="Write the answers as JSON to OUT (- for stdout).")
@set_option
@click.option(
    "--history",
    "history_out",
    metavar="FILE",
    type=a_path,
    callback=_history_file,
    help="Record one scene over time: .h5, .nc or .csv.",
)
@click.option(
    "--every",
    metavar="TIME",
    help='Times of the history ("10 ms"; default: as many as straight lines between them need).',
)
@click.option(
    "--quantity",
    "quantities",
    metavar="EXPRESSION",
    multiple=True,
    help="What to record, such as A.force.x (default: motion, energies, what the asks read). Repeatable.",
)
@click.pass_context
def run(
    ctx: click.Context,
    paths: Sequence[Path],
    json_out: str | None,
    values: Mapping[str, str],
    history_out: Path | None,
    every: str | None,
    quantities: Sequence[str],
) -> None:
    """Run scenes and answer what they ask.

    PATHS are files, or folders whose TOML files are run. A study runs its base case. A scene that fails
    does not stop the others; the exit status is 0 only if every one is ok.
    """
    if history_out is None and (every is not None or quantities):
        raise click.UsageError("--every and --quantity are for --history FILE")
    wanted = _Recording(history_out, every, quantities)
    files = _scene_files(paths)
    if history_out is not None and len(files) > 1:
        raise click.UsageError(f"--history records one scene, but {len(files)} files are given")
    entries, worst = [], 0
    with ExitStack() as outputs:
        # Both places are claimed before the work, so that one which cannot be written costs no time.
        json_path = outputs.enter_context(claimed(Path(json_out))) if json_out not in (None, "-") else None
        history_path = outputs.enter_context(claimed(history_out)) if history_out is not None else None
        for file in files:
            entry, text, status = _run_one(file, values, wanted, history_path)
            worst = max(worst, status)
            entries.append(entry)
            if json_out is None:
                click.echo(text, nl=False)
            if "error" in entry:
                say(entry["error"], error=True)
        if json_out is not None:
            document = json.dumps({"scenes": entries}, indent=1, allow_nan=False, ensure_ascii=False) + "\n"
            if json_path is None:
                click.echo(document, nl=False)
            else:
                json_path.write_text(document, encoding="utf-8", errors="backslashreplace")
        written = [history_out] if history_path is not None and _is_written(history_path) else []
    for path in (*([json_out] if json_path is not None else []), *written):
        say(f"wrote {path}")
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


def _run_one(
    file: Path, values: Mapping[str, str], wanted: _Recording, history: Path | None
) -> tuple[dict[str, Any], str, int]:
    """One scene: its entry for JSON, its text for people, its exit status.  Raises no SceneError.

    `history`: where it is recorded, if it is.
    """
    from ..file import load
    from ..run import simulate

    identity = shown(file.stem)
    try:
        scene = load(file).with_values(values)
        advise(scene)
        identity = scene.id
        result = simulate(scene)
        if history is not None:
            _record(scene, wanted, history)
    except SceneError as error:
        entry = {"id": identity, "file": os.fspath(file), "status": "bad_input", "error": str(error)}
        return {**entry, "route": [], "asks": {}, "audit": {}}, "", WRONG
    except SimulationError as error:
        entry = {"id": identity, "file": os.fspath(file), "status": "failed", "error": str(error)}
        return {**entry, "route": [], "asks": {}, "audit": {}}, "", FAILED
    return result.to_json(), _answers(scene, result), 0 if result.ok else FAILED


def _record(scene: Scene, wanted: _Recording, path: Path) -> None:
    """Writes the history of a scene, of each of its [runs]."""
    from ..engine import history
    from ..history import record_runs

    assert wanted.file is not None
    runs = record_runs(scene, wanted.quantities, every=wanted.every)
    attributes = {"id": scene.id, "title": scene.data.title, "scene": scene.whole_text}
    history.write(path, runs, attributes, ending(wanted.file, HISTORIES, "a history"))


def _answers(scene: Scene, result: RunResult) -> str:
    """What a terminal shows of a result."""
    from ..engine.result import shown_answers

    colour = "green" if result.ok else "red"
    title = f"  {scene.data.title}" if scene.data.title else ""
    audit = ", ".join(
        f"{name} {'-' if value is None else f'{value:.1e}'}" for name, value in result.audit.items()
    )
    lines = [
        f"{click.style(result.id, bold=True)}{title}: {click.style(result.status, fg=colour)}",
        *(f"  {line}" for line in _answer_lines(shown_answers(result))),
        click.style(f"  audit: {audit}; route: {', '.join(result.route) or 'none'}", dim=True),
        *(click.style(f"  {note}", fg="yellow") for note in result.notes),
    ]
    return "\n".join(lines) + "\n\n"


def _answer_lines(asks: Mapping[str, AskValue]) -> list[str]:
    """The answers in their order: numbers stand below each other, lists behind their keys."""
    from ..engine.answer import note_text, unit_text, value_text
    from ..report.aligned import Column, aligned

    width = terminal_width()
    singles = [ask for ask in asks.values() if not isinstance(ask.value, list)]
    key, note = Column(least=_longest(asks)), Column(style="dim")
    number = Column(right=True, least=_longest(map(value_text, singles)))
    unit = Column(least=_longest(map(unit_text, singles)))
    lines = []
    for is_list, group in groupby(asks.items(), key=lambda item: isinstance(item[1].value, list)):
        columns = (key, Column(), note) if is_list else (key, number, unit, note)
        rows = [
            (name, f"{value_text(ask)}  {unit_text(ask)}", note_text(ask))
            if is_list
            else (name, value_text(ask), unit_text(ask), note_text(ask))
            for name, ask in group
        ]
        lines += aligned(rows, columns, width=None if width is None else width - 2)
    return lines


def _longest(texts: Iterable[str]) -> int:
    return max(map(len, texts), default=0)


def _is_written(claimed: Path) -> bool:
    """Whether something stands in a claimed place, or it is a device."""
    return not claimed.is_file() or claimed.stat().st_size > 0


class _NothingWritten(Exception):
    """Leaves a claimed place as it was."""


@contextmanager
def claimed(path: Path) -> Iterator[Path]:
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
    with suppress(_NothingWritten), appearing(path.resolve()) as temporary:
        temporary.touch()
        yield temporary
        if not _is_written(temporary):
            raise _NothingWritten
