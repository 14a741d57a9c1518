"""A scene as it is written in Python: its table as TOML would give it, and one method for each part of it.

`table` is a copy; the scene is validated when `data` is first needed.
"""

from __future__ import annotations

import copy
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

from ..base.bounded import check_table, shown
from ..base.errors import SceneError
from ..base.html import html_table
from .change import set_value
from .outline import name_of, outline
from .plain import plain
from .renamed import Hints
from .scene import SceneData
from .validate import validate

# Keys that are words of Python, as they are written there.
_PYTHON = {"for_": "for", "with_": "with", "from_": "from"}


def _spelled(one: Any) -> Any:
    """An element with its keys as a file has them."""
    return {_PYTHON.get(key, key): value for key, value in one.items()} if isinstance(one, Mapping) else one


class SceneTable:
    """The table of a scene, which methods write; planemotion.Scene adds what a scene can do."""

    def __init__(
        self,
        id: str = "",
        *,
        title: str | None = None,
        description: str | None = None,
        plane: str | None = None,
        until: Any = None,
    ) -> None:
        given = {"id": id or None, "title": title, "description": description, "plane": plane, "until": until}
        self._raw: dict[str, Any] = {
            key: plain(value, key) for key, value in given.items() if value is not None
        }
        self.file: str | None = None
        self._text: str | None = None
        self._data: SceneData | None = None
        self._hints = Hints()

    @classmethod
    def from_table(
        cls, table: Mapping[str, Any], *, file: str | None = None, text: str | None = None
    ) -> Self:
        """A scene from its table; `text` is the TOML it was read from."""
        check_table(table)
        scene = cls()
        scene._raw = copy.deepcopy(dict(table))
        scene.file = file
        scene._text = text
        return scene

    def parameters(self, **values: Any) -> Self:
        """Parameters: quantities, or expressions of each other."""
        return self._update("parameters", values)

    def measured(self, name: str, **keys: Any) -> Self:
        """One of the [tables]: measured values, `at` and `value`, from here or from a `file`, and options.

        scene.measured("push", at=["0 s", "0.1 s"], value=["0 N", "50 N"], outside="hold")
        """
        return self._update("tables", {name: keys})

    def ground(self, **marks: Any) -> Self:
        """`points`, `lines`, `circles`, `curves` and `rows` of the ground, each a dict by name."""
        for group, named in marks.items():
            spelled = {name: _spelled(one) for name, one in named.items()}
            self._raw.setdefault("ground", {}).setdefault(group, {}).update(plain(spelled, f"ground.{group}"))
        return self._changed()

    def body(self, name: str, **keys: Any) -> Self:
        """A body with its shape, mass, marks and place."""
        return self._update("bodies", {name: keys})

    def spin(self, **keys: Any) -> Self:
        """The axis about which the plane turns: `through`, `angle`, and `inertia`, `couple`."""
        return self._update("spin", keys)

    def joint(self, name: str, **keys: Any) -> Self:
        """A joint: one kind with its partners, and options."""
        return self._update("joints", {name: keys})

    def coupling(self, name: str, **keys: Any) -> Self:
        """A coupling: gears, a belt, a cord or a motor, and options."""
        return self._update("couplings", {name: keys})

    def contact(self, name: str, **keys: Any) -> Self:
        """A contact: touch = [mark, mark], and options."""
        return self._update("contacts", {name: keys})

    def force(self, name: str, **keys: Any) -> Self:
        """A spring, damper, applied force or couple."""
        return self._update("forces", {name: keys})

    def template(self, name: str, scene: SceneTable | Mapping[str, Any]) -> Self:
        """What parts may be made of: another scene, or its table."""
        return self._update("templates", {name: scene.table if isinstance(scene, SceneTable) else scene})

    def part(self, name: str, use: str, **keys: Any) -> Self:
        """A part: `use` one of the templates, or a file; `with_` a dict of its parameters."""
        return self._update("parts", {name: {"use": use, **keys}})

    def start(self, values: Mapping[str, Any] | None = None, /, **more: Any) -> Self:
        """Start values by address."""
        return self._update("start", {**(values or {}), **more})

    def event(self, name: str, when: Any, **keys: Any) -> Self:
        """A named event: a condition or a list of them; with `do`, a list of actions, and `nth`."""
        return self._update("events", {name: {"when": when, **keys} if keys else when})

    def until(self, instant: Any) -> Self:
        """What ends the run."""
        self._raw["until"] = plain(instant, "until")
        return self._changed()

    def ask(self, name: str, of: Any = None, **keys: Any) -> Self:
        """A question: `of` an expression, or `max` or `min`; with `at`, `unit` and `run`."""
        return self._update("ask", {name: {**({} if of is None else {"of": of}), **keys}})

    def runs(self, **values: Mapping[str, Any]) -> Self:
        """Named runs, each a dict of parameters."""
        return self._update("runs", values)

    def find(self, **keys: Any) -> Self:
        """What is sought: `vary`, with `where`, `greatest` or `least`."""
        return self._update("find", keys)

    def grids(self, values: Mapping[str, Any] | None = None, /, **more: Any) -> Self:
        """The grids of its [sweep], by parameter.

        scene.grids(d=["1 in", "2 in"], e={"from": 0, "to": 1, "num": 9}).sweep()
        """
        return self._update("sweep", {**(values or {}), **more})

    def solve(self, **settings: Any) -> Self:
        """Settings: route, accuracy, estimate, impacts, shared, assembly_tolerance, max_time and the like."""
        return self._update("solve", settings)

    # ---- what it says ----

    @property
    def data(self) -> SceneData:
        """The validated scene.  Raises SceneError for the first fault."""
        if self._data is None:
            name = shown(Path(self.file).stem) if self.file else "scene"
            self._data = validate(self._raw, file=self.file, name=name, text=self._text)
            self._hints.tell(self._data.hints, self.file, self._text)
        return self._data

    @property
    def table(self) -> dict[str, Any]:
        """The table of the scene, as TOML would give it: a copy; `Scene.from_table` makes a scene of it."""
        return copy.deepcopy(self._raw)

    @property
    def id(self) -> str:
        """Its name in results."""
        return self.data.id

    @property
    def run_names(self) -> tuple[str, ...]:
        """Names of its [runs]; empty if it is run once."""
        return tuple(self.data.runs)

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """A copy with other values: parameters by name (a bare number takes the unit of the file), or
        settings such as "sweep.d.num" and "solve.route".

        Raises SceneError for an unknown name or a value of another dimension.
        """
        scene = self.from_table(self._raw, file=self.file, text=self._text)
        scene._hints = self._hints
        for name, value in self._plain(values).items():
            try:
                set_value(scene._raw, name, value, lambda: scene.data)
            except SceneError as error:
                raise error.at(file=self.file) from None
            scene._changed()
        return scene

    def _plain(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Values by name, as TOML has them.  Raises SceneError, with the name and the file."""
        try:
            return {name: plain(value, name) for name, value in values.items()}
        except SceneError as error:
            raise error.at(file=self.file) from None

    # ---- as it is shown ----

    def __repr__(self) -> str:
        lines = [f"  {name}: {names}" for name, names in outline(self._raw)]
        return "\n".join([f"Scene {name_of(self._raw, self.file)}", *lines])

    def _repr_html_(self) -> str:
        """A table of what is in it for a notebook."""
        rows = [("table", "names"), *outline(self._raw)]
        return html_table(f"Scene {name_of(self._raw, self.file)}", rows)

    # ---- changing ----

    def _update(self, table: str, values: Mapping[str, Any]) -> Self:
        spelled = {name: _spelled(one) for name, one in values.items()}
        self._raw.setdefault(table, {}).update(plain(spelled, table))
        return self._changed()

    def _changed(self) -> Self:
        self._data = self._text = None
        return self
