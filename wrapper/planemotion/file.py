"""Scene files: TOML to a scene and back."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .base.bounded import read_bytes
from .base.errors import SceneError
from .base.toml import parse_toml
from .base.written import written, written_key
from .reading.places import without_files
from .reading.scene import SceneData

if TYPE_CHECKING:
    from .scene import Scene

# A file that is larger is no scene.
_MOST_BYTES = 10_000_000


def load(path: str | os.PathLike[str]) -> Scene:
    """The scene in a TOML file.

    Raises SceneError for a file that cannot be read, is not TOML (with the line), or says what no scene can.
    """
    name = os.fspath(path)
    if "\n" in name:
        raise SceneError("load takes the path of a file; load_text takes the text of a scene")
    try:
        text = read_bytes(Path(path), _MOST_BYTES).decode("utf-8")
    except UnicodeDecodeError:
        raise SceneError("the file is not text in UTF-8", file=name) from None
    except OSError as error:
        there = Path(f"{name}.toml")
        hint = f"; did you mean {there}?" if there.is_file() else ""
        raise SceneError(f"cannot be read: {error.strerror or error}{hint}", file=name) from None
    return load_text(text, file=name)


def load_text(text: str, *, file: str | None = None) -> Scene:
    """The scene in a TOML text; `file` is named in messages, and its stem is the id if there is none.

    >>> import planemotion
    >>> planemotion.load_text('ask.v = "b.x"\\nbodies.b = { mas = "1 kg" }', file="ball.toml")
    Traceback (most recent call last):
    planemotion.base.errors.SceneError: ...mas...did you mean "mass"...
    """
    from .scene import Scene

    scene = Scene.from_table(parse_toml(text, file), file=file, text=text)
    scene.data  # noqa: B018 - faults are to be found when the file is read
    return scene


def to_toml(raw: Mapping[str, Any]) -> str:
    """A scene's table as TOML: plain keys first, then one table for each group with an entry on each line."""
    top = [
        f"{written_key(key)} = {written(value)}"
        for key, value in raw.items()
        if not isinstance(value, Mapping)
    ]
    groups = [(key, value) for key, value in raw.items() if isinstance(value, Mapping)]
    texts = ["\n".join(top)] if top else []
    for key, group in groups:
        lines = [
            f"[{written_key(key)}]",
            *(f"{written_key(name)} = {written(value)}" for name, value in group.items()),
        ]
        texts.append("\n".join(lines))
    return "\n\n".join(texts) + "\n"


def to_whole_toml(raw: Mapping[str, Any], data: SceneData) -> str | None:
    """The same with what stands in files of their own, values and points; None if nothing does."""
    values = {name: table.in_scene for name, table in data.tables.items() if table.file is not None}
    whole = without_files(raw, data)
    if values:
        whole = {**whole, "tables": {**raw["tables"], **values}}
    return None if whole is raw else to_toml(whole)
