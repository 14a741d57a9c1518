"""The reference of the scene language as a page of Markdown, made of the models and of what words mean."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import NoneType
from typing import Any, Literal, get_args, get_origin

from pydantic.fields import FieldInfo

from ..examples import text_of
from ..kinds import KINDS
from ..kinds.base import Bearing
from ..model import tables
from ..model.curve import Curve
from ..model.element import Element, Kind, Table
from ..model.listed import Cases
from ..model.tabulated import Tabulated
from ..reading.scene import SceneData
from .meaning import Meaning, meaning_of, meanings

# Title of a chapter of tables, and the tables in it.
_CHAPTERS: Mapping[str, tuple[type[Table], ...]] = {
    "A scene": (SceneData,),
    "Bodies and marks": (
        *(tables.Body, tables.Ground, tables.Line, tables.Circle, tables.Row, Curve),
        *(tables.Driven, tables.Spin, Tabulated),
    ),
    "Parts": (tables.Part,),
    "Events and questions": (tables.Event, tables.Action, tables.Ask, tables.At),
    "Studies and settings": (
        *(
            tables.Find,
            tables.Sweep,
            tables.Swept,
            tables.Design,
            Cases,
            tables.Retry,
            tables.Refine,
            tables.Grid,
        ),
        tables.Solve,
    ),
}
_ELEMENT_TABLES = (Element, tables.Friction, Bearing)
_NAMES = {
    "SceneData": "The file",
    "Element": "What all elements take",
    "Bearing": "Friction of a bearing or of teeth",
}
_MEASURES = {
    "body": "Of a body: `BODY.WORD`",
    "point": "Of a point: `BODY.POINT.WORD`; without a point of the mass centre",
    "driven": "Of what drives a body: `BODY.driven.WORD`",
    "joint": "Of a joint: `JOINT.WORD`",
    "coupling": "Of a coupling: `COUPLING.WORD`",
    "contact": "Of a contact: `CONTACT.WORD`, of a member of a set or row `CONTACT[3].WORD`",
    "force": "Of a force: `FORCE.WORD`",
    "event": "Of an event: `EVENT.WORD`",
    "energy": "Of the scene: `energy.WORD`",
    "spin": "Of a plane that turns: `spin.WORD`",
    "modes": "Of small motion about an instant: `modes.WORD`, of one mode `modes[1].WORD`",
    "scene": "Of the scene: `WORD`",
}
_WORDS = {
    "parts": "Parts of a vector",
    "keywords": "Words behind an address, and between conditions",
    "changes": "Changes of contacts, cords and joints with friction, as conditions",
    "functions": "Functions of expressions",
    "many": "Many equal parts",
    "laws": "Laws of impact",
    "routes": "Routes",
}


def reference() -> str:
    """The page; each kind stands beside the example that shows it."""
    return "\n".join(_page()) + "\n"


def _page() -> Iterator[str]:
    yield "# The words of a scene\n"
    yield "This page is made of the models that read a scene: it has every word that the program takes.\n"
    for title, models in _CHAPTERS.items():
        yield f"## {title}\n"
        for model in models:
            yield from _of_table(model)
    for group, kinds in KINDS.items():
        yield f"## {group.capitalize()}\n"
        for kind in kinds.values():
            yield from _of_kind(kind, text_of(kind.word))
    yield "## Options of elements\n"
    for model in _ELEMENT_TABLES:
        yield from _of_table(model)
    yield "## Measures\n"
    for group, title in _MEASURES.items():
        yield from _plain(title, meanings()["measures"][group])
    yield "## Other words\n"
    for group, title in _WORDS.items():
        yield from _plain(title, meanings()["words"][group])


def _of_table(model: type[Table]) -> Iterator[str]:
    yield f"### {_NAMES.get(model.__name__, model.__name__)}\n"
    said = (model.__dict__.get("__doc__") or "").split("\n\n")[0]
    if said and model is not SceneData:
        yield f"{' '.join(said.split())}\n"
    fields = {field.alias or name: field for name, field in model.model_fields.items()}
    keys = list(meanings()["tables"][model.__name__])
    yield from _rows((key, meaning_of(model, key), fields.get(key)) for key in keys)


def _of_kind(kind: type[Kind], scene: str) -> Iterator[str]:
    yield f"### {kind.word}\n"
    own = [key for key in kind.options() if key not in Element.model_fields]
    yield from _rows(
        [(kind.word, meaning_of(kind, kind.word), None)]
        + [(key, meaning_of(kind, key), kind.model_fields[key]) for key in own]
    )
    yield f"```toml\n{scene.rstrip()}\n```\n"


def _rows(rows: Iterator[tuple[str, Meaning, FieldInfo | None]] | list[Any]) -> Iterator[str]:
    yield "| word | meaning | unit | if left out |\n|---|---|---|---|"
    for key, meaning, field in rows:
        says = f"{meaning.says}{_choices(field)}"
        yield f"| `{key}` | {says} | {meaning.unit} | {_without(meaning, field)} |".replace("  ", " ")
    yield ""


def _plain(title: str, said: Mapping[str, Meaning]) -> Iterator[str]:
    yield f"### {title}\n"
    yield "| word | meaning | unit |\n|---|---|---|"
    for word, meaning in said.items():
        yield f"| `{word}` | {meaning.says} | {meaning.unit} |".replace("  ", " ")
    yield ""


def _choices(field: FieldInfo | None) -> str:
    """The values that a key may have, where they are few."""
    parts = [field.annotation, *get_args(field.annotation)] if field is not None else []
    found = next((get_args(part) for part in parts if get_origin(part) is Literal), ())
    return f" One of {', '.join(f'`{one}`' for one in found)}." if found else ""


def _without(meaning: Meaning, field: FieldInfo | None) -> str:
    """What is taken where the word is left out."""
    if meaning.without:
        return meaning.without
    if field is None:
        return ""
    if field.is_required():
        return "it must be given"
    default = field.default
    if isinstance(default, NoneType | tuple | dict) or default == "":
        return "none"
    if isinstance(default, bool):
        return f"`{str(default).lower()}`"
    if isinstance(default, Table):
        return "none"
    if hasattr(default, "first"):
        return f"[{default.first}, {default.second}]"
    return f"`{default}`"
