"""The language of scenes as a JSON Schema, made of the models that read it: for editors and checkers.

Each key of a table is there with its type and what is taken without it, each kind of joint, coupling, contact
and force with its own options.  What a schema cannot say - units, names, expressions - `check` says.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection, Mapping
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, TypeAlias, Union, get_args, get_origin

from pydantic import BaseModel, BeforeValidator
from pydantic.fields import FieldInfo

from ..kinds import KINDS
from ..model import readers
from ..model.curve import read_points
from ..model.element import Kind, Table
from ..model.listed import Cases
from ..model.tables import Design, Find, Refine, Retry, Sweep, Swept
from ..reading.scene import SceneData
from .meaning import meaning_of, meanings

Schema: TypeAlias = dict[str, Any]

_TEXT: Schema = {"type": "string"}
_VALUE: Schema = {"$ref": "#/$defs/value"}
_VECTOR: Schema = {"$ref": "#/$defs/vector"}
_NAMES: Schema = {"type": "array", "items": _TEXT}
_TEXTS: Schema = {"anyOf": [_TEXT, {**_NAMES, "minItems": 1}]}
_ONE_OR_TWO: Schema = {"anyOf": [_TEXT, {**_NAMES, "minItems": 2, "maxItems": 2}]}
_PAIR: Schema = {"type": "array", "items": _VALUE, "minItems": 2, "maxItems": 2}
# What is said once for every value of an index.
_REPEATED: Schema = {
    "type": "object",
    "properties": {"for": {**_TEXTS, "description": meanings()["words"]["many"]["for"].says}},
    "required": ["for"],
    "additionalProperties": True,
}
# What readers take that is no table of their model: reader -> schemas.
_BARE: Mapping[Callable[..., Any], list[Schema]] = {
    readers.read_circle: [_VALUE],
    readers.read_grid: [{"type": "array", "items": _VALUE}],
    readers.read_swept: [{"type": "array", "items": _VALUE}],
    readers.read_friction: [_VALUE],
    readers.read_joint_friction: [_VALUE],
    readers.read_cord_friction: [_VALUE],
    readers.read_at: [_TEXT],
    readers.read_ask: [_VALUE],
    readers.read_event: [_TEXTS],
}
# What readers take, whatever their model is.
_WHOLE: Mapping[Callable[..., Any], Schema] = {
    readers.read_value: _VALUE,
    readers.read_numbers: {"type": "array", "items": _VALUE},
    readers.read_text: _TEXT,
    readers.read_named: _TEXTS,
    readers.read_correlation: {"type": "array", "items": {"type": "array", "minItems": 3, "maxItems": 3}},
    readers.read_vector: _VECTOR,
    read_points: {"type": "array", "items": _VECTOR},
    readers.read_value_or_vector: {"anyOf": [_VALUE, _VECTOR]},
    readers.read_point: {
        "anyOf": [
            _VECTOR,
            {
                "type": "object",
                "properties": {"from": _TEXT, "by": _VECTOR},
                "required": ["from", "by"],
                "additionalProperties": False,
            },
        ]
    },
    readers.read_place: {
        "anyOf": [
            _TEXT,
            _VECTOR,
            {"type": "object", "additionalProperties": {"anyOf": [_TEXT, _VECTOR]}, "maxProperties": 2},
        ]
    },
    readers.read_driven_place: {
        "anyOf": [
            _VECTOR,
            {"type": "object", "additionalProperties": _VECTOR, "maxProperties": 1, "minProperties": 1},
        ]
    },
    readers.read_sequence: _TEXTS,
    readers.read_stops: {**_NAMES, "minItems": 2},
    readers.read_until: {
        "anyOf": [
            _TEXTS,
            {
                "type": "object",
                "properties": {"all": _TEXTS},
                "required": ["all"],
                "additionalProperties": False,
            },
        ]
    },
    readers.read_bounds: _PAIR,
    readers.read_point_or_two: _ONE_OR_TWO,
    readers.read_body_or_two: _ONE_OR_TWO,
    readers.read_templates: {
        "type": "object",
        "additionalProperties": {"type": "object", "additionalProperties": True},
    },
    readers.read_start: {  # by address, which dotted keys make tables in tables
        "type": ["object", "string"],
        "pattern": "^equilibrium$",
        "properties": {
            "equilibrium": {
                "description": "Whether the scene starts in an equilibrium near the positions given.",
                "type": "boolean",
            },
            "nudge": {
                "description": "The side to which an unstable rest is left, such as AB.omega < 0.",
                **_TEXT,
            },
        },
        "additionalProperties": True,
    },
}


def schema() -> Schema:
    """The JSON Schema (draft 2020-12) of a scene file."""
    made = _Definitions()
    root = made.table(SceneData, beside=(*KINDS, "sweep", "runs"))
    for group, kinds in KINDS.items():
        root["properties"][group] = _said(
            SceneData, group, _named({"anyOf": [made.kind(kind) for kind in kinds.values()]})
        )
    root["properties"]["sweep"] = _said(SceneData, "sweep", made.sweep())
    run = {"type": "object", "properties": {"find": made.reference(Find)}, "additionalProperties": _VALUE}
    root["properties"]["runs"] = _said(SceneData, "runs", _named(run))
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A scene of planemotion",
        **root,
        "$defs": {
            "value": {
                "description": 'A number, true or false, a quantity such as "10 in", or an expression.',
                "type": ["number", "string", "boolean"],
            },
            "vector": {
                "description": "[x, y] or { polar = [size, angle] }.",
                "anyOf": [
                    _PAIR,
                    {
                        "type": "object",
                        "properties": {"polar": _PAIR},
                        "required": ["polar"],
                        "additionalProperties": False,
                    },
                ],
            },
            **made.tables,
        },
    }


def _named(one: Schema) -> Schema:
    """A table of things by name, each of which may be written once for many."""
    choices = one["anyOf"] if set(one) == {"anyOf"} else [one]
    return {"type": "object", "additionalProperties": {"anyOf": [*choices, _REPEATED]}}


def _said(model: type[Table], key: str, one: Schema) -> Schema:
    """The schema of a key with what the key means."""
    return {**one, "description": meaning_of(model, key).text}


class _Definitions:
    """Schemas of models, each made once."""

    def __init__(self) -> None:
        self.tables: dict[str, Schema] = {}

    def reference(self, model: type[Table]) -> Schema:
        name = model.__name__
        if name not in self.tables:
            self.tables[name] = {}  # it may need itself
            self.tables[name] = self.table(model)
        return {"$ref": f"#/$defs/{name}"}

    def table(self, model: type[Table], beside: Collection[str] = ()) -> Schema:
        """The keys that a file may give, but for some."""
        fields = {field.alias or name: field for name, field in model.model_fields.items()}
        keys = [key for key in model.file_keys() if key not in beside]
        return self._object(model, {key: fields[key] for key in keys})

    def kind(self, kind: type[Kind]) -> Schema:
        """An element of one kind: its word with the partners, and its options."""
        made = self._object(kind, {key: kind.model_fields[key] for key in kind.options()})
        partners = _said(kind, kind.word, self._field(kind.model_fields["partners"]))
        made["properties"] = {kind.word: partners, **made["properties"]}
        made["required"] = [kind.word, *made.get("required", [])]
        return made

    def sweep(self) -> Schema:
        """Grids by parameter, and zip."""
        zipped = _said(Sweep, "zip", {"type": "array", "items": _NAMES})
        grid = self._read(readers.read_swept, Swept)
        tables: dict[str, type[Table]] = {"design": Design, "refine": Refine, "retry": Retry}
        properties = {
            "zip": zipped,
            **{key: _said(Sweep, key, self.table(model)) for key, model in tables.items()},
        }
        cases = {**self.table(Cases), "additionalProperties": {"type": "array", "items": _VALUE}}
        properties["cases"] = _said(Sweep, "cases", {"anyOf": [{"type": "string"}, cases]})
        return {"type": "object", "properties": properties, "additionalProperties": grid}

    def _object(self, model: type[Table], fields: Mapping[str, FieldInfo]) -> Schema:
        made: Schema = {"type": "object"}
        said = inspect.cleandoc(model.__dict__.get("__doc__") or "").split("\n\n")[0]
        if said:
            made["description"] = " ".join(said.split())
        made["properties"] = {
            key: _said(model, key, self._with_default(field)) for key, field in fields.items()
        }
        required = [key for key, field in fields.items() if field.is_required()]
        if required:
            made["required"] = required
        made["additionalProperties"] = False
        return made

    def _with_default(self, field: FieldInfo) -> Schema:
        made = self._field(field)
        if isinstance(field.default, str | bool | int | float) and field.default != "":
            return {**made, "default": field.default}
        return made

    def _field(self, field: FieldInfo) -> Schema:
        return self._of(field.annotation, tuple(field.metadata))

    def _of(self, annotation: Any, metadata: tuple[Any, ...] = ()) -> Schema:
        """The schema of what an annotation, or the reader in front of it, takes."""
        reader = next((one.func for one in metadata if isinstance(one, BeforeValidator)), None)
        if reader is not None:
            return self._read(reader, annotation)
        origin, parts = get_origin(annotation), get_args(annotation)
        if origin is Annotated:
            return self._of(parts[0], tuple(parts[1:]))
        if annotation == readers.Value:
            return _VALUE
        if origin in (Union, UnionType):
            several = [self._of(part) for part in parts if part is not NoneType]
            return several[0] if len(several) == 1 else {"anyOf": several}
        if origin is Literal:
            return {"enum": list(parts)}
        if origin is dict:
            return _named(self._of(parts[1]))
        if origin is tuple:
            return {"type": "array", "items": self._of(parts[0])}
        if isinstance(annotation, type) and issubclass(annotation, Table):
            return self.reference(annotation)
        return {"type": {bool: "boolean", int: "integer", float: "number", str: "string"}[annotation]}

    def _read(self, reader: Any, annotation: Any) -> Schema:
        if reader in _WHOLE:
            return _WHOLE[reader]
        if reader is readers.read_actions:
            return {"type": "array", "items": self._of(get_args(annotation)[0])}
        if reader in _BARE:
            tables = [part for part in (annotation, *get_args(annotation)) if _is_model(part)]
            return {"anyOf": [*_BARE[reader], *(self._of(table) for table in tables)]}
        if reader is readers.read_sweep:
            return self.sweep()
        count = inspect.getclosurevars(reader).nonlocals.get("count")
        if count is not None:  # of readers.read_names
            return {**_NAMES, "minItems": count, "maxItems": count}
        if get_origin(annotation) is dict:  # by address, which a dotted key makes a table in a table
            inner = self._of(get_args(annotation)[1])
            return _named({"anyOf": [inner, _named(inner)]})
        return self._of(annotation)  # it only looks closer


def _is_model(part: Any) -> bool:
    return isinstance(part, type) and issubclass(part, BaseModel)
