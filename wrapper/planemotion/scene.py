"""Scenes in Python: the same words as in a file, one method for each table.

    s = Scene("pendulum", until="t = 2 s")
    s.body("AB", rod=["A", "B"], length="1 m", mass="2 kg", at={"A": [0, 0]})
    s.joint("A", pin=["AB.A", "ground"])
    s.ask("omega", of="AB.omega", unit="rad/s")
    s.run().omega

A scene holds its table as TOML would give it (`table` is a copy); it is validated when `data` is first
needed.
"""

from __future__ import annotations

import copy
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from .base.bounded import check_table, shown
from .base.errors import SceneError
from .base.html import html_table
from .language.units import declared_unit
from .model.tables import DEFAULT_G
from .reading.change import set_value
from .reading.outline import name_of, outline
from .reading.plain import plain, plain_text
from .reading.renamed import Hints
from .reading.scene import SceneData
from .reading.validate import validate
from .sweep.cache import Kept

if TYPE_CHECKING:
    import xarray

    from .animate import Animation
    from .compile.flatten import FlatScene
    from .draw import Picture
    from .engine.result import RunResult
    from .mapping import OutcomeMap
    from .report.explain import Told
    from .reporting import Report
    from .sweep.function import SceneFunction
    from .sweep.run import ShardDone

# Keys that are words of Python, as they are written there.
_PYTHON = {"for_": "for", "with_": "with", "from_": "from"}


def _spelled(one: Any) -> Any:
    """An element with its keys as a file has them."""
    return {_PYTHON.get(key, key): value for key, value in one.items()} if isinstance(one, Mapping) else one


class Scene:
    """A scene under construction, or one read from a file.

    What is repeated takes `for_`, such as body("link[i]", for_="i in 1..n", ...).

    Values are those of a file: numbers, texts such as "10 in", true and false, lists and dicts; quantities of
    pint, numbers and arrays of numpy and arrays of quantities are taken as well.  Methods return the scene,
    so that they can be chained.

    >>> from planemotion import Scene
    >>> swing = (
    ...     Scene("swing", until="rod.turned = -90 deg")
    ...     .parameters(L="1.2 m")
    ...     .body("rod", rod=["A", "B"], length="L", mass="3 kg", at={"A": [0, 0]})
    ...     .joint("A", pin=["rod.A", "ground"])
    ...     .ask("omega", of="rod.omega", unit="rad/s")
    ... )
    >>> round(swing.run()["omega"], 4)
    -4.9523

    A sweep is declared and run in two words:

    >>> swing.grids(L=["0.5 m", "1 m"]).sweep()["omega"].values.round(3)
    array([-7.672, -5.425])
    """

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
        self._raw: dict[str, Any] = {key: plain(value) for key, value in given.items() if value is not None}
        self.file: str | None = None
        self._text: str | None = None
        self._data: SceneData | None = None
        self._kept = Kept()
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

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """The scene in a TOML file; see `planemotion.load`."""
        from .file import load

        return load(path)

    # ---- tables ----

    def parameters(self, **values: Any) -> Self:
        """Parameters: quantities, or expressions of each other."""
        return self._update("parameters", values)

    def ground(self, **marks: Any) -> Self:
        """`points`, `lines`, `circles`, `curves` and `rows` of the ground, each a dict by name."""
        for group, named in marks.items():
            spelled = {name: _spelled(one) for name, one in named.items()}
            self._raw.setdefault("ground", {}).setdefault(group, {}).update(plain(spelled))
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

    def template(self, name: str, scene: Scene | Mapping[str, Any]) -> Self:
        """What parts may be made of: another scene, or its table."""
        return self._update("templates", {name: scene.table if isinstance(scene, Scene) else scene})

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
        self._raw["until"] = plain(instant)
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

    def tables(self) -> list[FlatScene]:
        """The tables of each of its [runs], without a history; raises SceneError as `data` does."""
        return self._kept.flats_of(self.data, self._raw, self.file)

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

    @property
    def text(self) -> str:
        """The scene as TOML: the text of its file if nothing was changed."""
        return self._text if self._text is not None else self.to_toml()

    @property
    def whole_text(self) -> str:
        """The scene as TOML that needs no other file: with the values of its tables."""
        from .file import to_toml, to_whole_toml

        if self.data.whole is not None:
            return to_whole_toml(self.data.whole, self.data) or to_toml(self.data.whole)
        return to_whole_toml(self._raw, self.data) or self.text

    def to_toml(self) -> str:
        """The scene as TOML, written anew."""
        from .file import to_toml

        return to_toml(self._raw)

    def with_values(self, values: Mapping[str, Any]) -> Scene:
        """A copy with other values: parameters by name (a bare number takes the unit of the file), or
        settings such as "sweep.d.num" and "solve.route".

        Raises SceneError for an unknown name or a value of another dimension.
        """
        scene = Scene.from_table(self._raw, file=self.file, text=self._text)
        scene._hints = self._hints
        for name, value in values.items():
            try:
                set_value(scene._raw, name, plain(value), lambda: scene.data)
            except SceneError as error:
                raise error.at(file=self.file) from None
            scene._changed()
        return scene

    # ---- as it is shown ----

    def __repr__(self) -> str:
        lines = [f"  {name}: {names}" for name, names in outline(self._raw)]
        return "\n".join([f"Scene {name_of(self._raw, self.file)}", *lines])

    def _repr_html_(self) -> str:
        """A table of what is in it for a notebook."""
        rows = [("table", "names"), *outline(self._raw)]
        return html_table(f"Scene {name_of(self._raw, self.file)}", rows)

    # ---- running ----

    def run(self, **parameters: Any) -> RunResult:
        """Answers of the scene, with other values for some parameters: numbers in the unit of the scene,
        texts such as "2 in", or quantities of pint.

        >>> from planemotion import load_text
        >>> from planemotion.examples import text_of
        >>> result = load_text(text_of("pin"), file="pin.toml").run(g="1.62 m/s^2")
        >>> result
        RunResult pin: ok
          omega = -2.01246118 rad/s
          reaction = 12.15 N
        >>> result.asks["omega"].error < 1e-8
        True

        Raises SceneError for a fault in the scene, SimulationError (with the partial result) if a run fails.
        An early stop, such as a limit, is a result whose status is not "ok".
        """
        from .run import run, run_near

        near = run_near(self, parameters) if parameters else None
        return near or run(self.with_values(parameters) if parameters else self)

    def history(
        self, *quantities: str, every: Any = None, of_run: str | None = None, **parameters: Any
    ) -> xarray.Dataset:
        """The scene over time, with other values for some parameters.

        `quantities`: expressions such as "AB.omega" or "A.force.x", each a variable; without any, positions,
        velocities and energies, and the reactions that asks read.  `every`: a time such as "10 ms"; without
        it there are as many instants as straight lines between them need to be true to a thousandth of what
        is shown.  `of_run`: which of its [runs] (default: the first).  Every event has two rows, before and
        after its jump.

        What the dataset holds is said in `planemotion.history`.  Raises SceneError for a fault,
        SimulationError if nothing can be recorded.

        >>> from planemotion import load_text
        >>> from planemotion.examples import text_of
        >>> told = load_text(text_of("pin")).history("rod.omega", "A.force.y", every="0.1 s")
        >>> told["rod.omega"].sel(t=0.1).round(4).item(), told["rod.omega"].attrs["units"]
        (-1.2258, 'rad/s')
        """
        from .history import history

        return history(self.with_values(parameters), quantities, every=every, run=of_run)

    def animate(
        self,
        *,
        show: str | Iterable[str] = "energies",
        trace: str | Iterable[str] = (),
        of_run: str | None = None,
        theme: str | None = None,
        **parameters: Any,
    ) -> Animation:
        """The scene in motion, with other values for some parameters; a notebook shows it, with a player.

        >>> from planemotion import load_text
        >>> from planemotion.examples import text_of
        >>> load_text(text_of("pin")).animate(show="forces,slow", trace="rod.B", g="3 m/s^2").save("rod.html")
        PosixPath('rod.html')

        `show`: of "energies", "velocities", "forces" and "slow" (time passes slower around events), as a list
        or with commas; blows are always seen with their impulses.  `trace`: points whose ways are drawn, such
        as "AB.B" (without any: of all particles).  `of_run`: which of its [runs] (default: the first).
        `theme`: "light" or "dark" (default: light; a page is as the reader's system).  `save` writes one page
        of HTML that needs nothing else, or a GIF or MP4, which show the same.  Raises SceneError for a fault
        or a point that there is not, StudyError for another word, SimulationError if nothing can be recorded.
        """
        from .animate import animate

        return animate(self.with_values(parameters), of_run, show, trace, theme)

    def draw(
        self,
        at: Any = None,
        as_: str | None = None,
        *,
        bodies: str | Sequence[str] = (),
        show: str | Iterable[str] = (),
        of_run: str | None = None,
        theme: str = "light",
        **parameters: Any,
    ) -> Picture:
        """The scene as a picture, with other values for some parameters; a notebook shows it.

        >>> from planemotion import load_text
        >>> from planemotion.examples import text_of
        >>> scene = load_text(text_of("pin"))
        >>> scene.draw(at="0.3 s", as_="kinetic").save("kinetic.svg")
        PosixPath('kinetic.svg')
        >>> scene.draw(show="dimensions", theme="dark").save("rod.png").stat().st_size > 10_000
        True

        `at`: a time such as "0.3 s", or an event ("strike", "strike 2"); without it the start.  `as_`: a
        figure of the book, with names and values: "free-body", "kinetic" (forces = m a), "impulse-momentum"
        (without `at` of the first blow) or "energy" (the work of each force since the start; without `at` of
        the whole run); of all bodies, or of `bodies`.  `show`: of "dimensions" and "velocities", as a list or
        with commas, without `as_`.  `of_run`: which of its [runs] (default: the first).  `theme`: "light" or
        "dark" paper.  `save` writes PNG, SVG or PDF, by the ending; how values stand in figures is said in
        `planemotion.draw`.  Raises SceneError for a fault in the scene, an unknown figure or body, an instant
        that the run does not come to or where nothing is struck but shall be; SimulationError if nothing can
        be recorded.
        """
        from .draw import draw

        when = at if at is None else plain_text(at)
        return draw(self.with_values(parameters), when, as_, bodies, of_run, theme, show)

    def check(self, **parameters: Any) -> Told:
        """The assembled start, as `planemotion check` tells it: `text`, and `faults`, a message for each.

        >>> from planemotion import load_text
        >>> from planemotion.examples import text_of
        >>> load_text(text_of("pin"), file="pin.toml").check().faults
        ()

        Raises SceneError for a fault in the scene."""
        from .report.explain import check

        return check(self.with_values(parameters))

    def explain(self, **parameters: Any) -> Told:
        """What the scene is made of and how it is computed, as `planemotion explain` tells it.

        Raises SceneError for a fault in the scene."""
        from .report.explain import explain

        return explain(self.with_values(parameters))

    def report(self, *, replays: int = 9, **parameters: Any) -> Report:
        """The scene, or the study if it has a [sweep], as one page of HTML that needs nothing else.

        >>> from planemotion import load_text
        >>> from planemotion.examples import text_of
        >>> load_text(text_of("pin")).report(g="3 m/s^2").save("report.html")
        PosixPath('report.html')

        It has the answers with their errors, the motion, the picture and the text of the scene, how it was
        computed and with what; of a study plots of the answers, how the cases ended, and at most `replays`
        cases in motion, with a slider for each of the parameters plotted.  Raises SceneError for a fault in
        the scene, StudyError if what a report is built with (the extra `report`) is not installed.
        """
        from .reporting import report

        return report(self.with_values(parameters), replays)

    def sweep(
        self,
        *,
        out: str | os.PathLike[str] | None = None,
        workers: Any = None,
        resume: bool = False,
        progress: Any = None,
        executor: Any = None,
        stop_after: int | None = None,
        format: str = "hdf5",
        table: str = "csv",
        chunk: int | None = None,
        grids: Mapping[str, Any] | None = None,
        **more_grids: Any,
    ) -> Any:
        """The study over grids of parameters: those given here, else those of [sweep].

        >>> from planemotion import load_text
        >>> from planemotion.examples import text_of
        >>> scene = load_text(text_of("pin"))
        >>> scene.sweep(g={"from": "1 m/s^2", "to": "10 m/s^2", "num": 4})["reaction"].values.round(3)
        array([ 7.5, 30. , 52.5, 75. ])

        A grid is a list, an array, an array of quantities of pint, or a dict as in a file.
        `grids`: the same as a dict, also of parameters with the name of an option, such as "workers".  See
        `sweep.run.run_sweep` for `out`, `workers`, `resume`, `progress`, `stop_after` and what it returns,
        `sweep.forms.Form` for `format`, `table` and `chunk` of the files.

        `executor`: what computes instead of threads of this process: anything that has `submit` as the
        executors of `concurrent.futures` have it (a process pool, a `dask.distributed.Client`,
        `mpi4py.futures`), or a function that makes one, which is called again when its workers have died.
        """
        from .sweep.forms import Form
        from .sweep.run import run_sweep

        chosen = {**(grids or {}), **more_grids}
        raw = {**self._raw, "sweep": plain(chosen)}
        scene = type(self).from_table(raw, file=self.file) if chosen else self
        return run_sweep(
            scene,
            out=out,
            workers=workers,
            resume=resume,
            progress=progress,
            kept=self._kept,
            executor=executor,
            stop_after=stop_after,
            form=Form(format, table, chunk),
        )

    def sweep_shard(
        self,
        number: int,
        of: int,
        *,
        out: str | os.PathLike[str],
        workers: int | None = None,
        progress: Any = None,
        executor: Any = None,
    ) -> ShardDone:
        """The cases of shard `number` (1 to `of`) of its [sweep], left as parts in the folder `out`.

        Other processes, on any machine that sees the folder, may compute other shards meanwhile; when all are
        there, `sweep(out=out, resume=True)` puts them together.  A shard that was ended goes on where it was.
        """
        from .sweep.run import sweep_shard
        from .sweep.shard import Shard

        shard = Shard.read(f"{number}/{of}")
        return sweep_shard(self, out, shard, workers=workers, progress=progress, executor=executor)

    def function(
        self,
        inputs: Sequence[str] | Mapping[str, str],
        outputs: str | Sequence[str],
        *,
        workers: int | None = None,
    ) -> SceneFunction:
        """The scene as a function on arrays, for optimisers, analyses of sensitivity and the like.

            f = scene.function(["d", "mass_ratio"], "omega_above")
            f([[0.1, 1.0], [0.2, 1.0]])

        `inputs`: parameters, in the units of the file, or a dict with the unit of each.  `outputs`: one ask
        or several.  All rows of a call are computed together, on `workers` threads (default: all cores).
        Raises SceneError for what is no parameter or no number.
        """
        from .sweep.function import SceneFunction

        units = dict(inputs) if isinstance(inputs, Mapping) else self._units_of(inputs)
        grids = {name: [f"1 {unit}".strip()] for name, unit in units.items()}
        scene = type(self).from_table({**self._raw, "sweep": grids}, file=self.file)
        return SceneFunction(scene, tuple(units), outputs, workers)

    def _units_of(self, names: Sequence[str]) -> dict[str, str]:
        """The units of parameters as the file gives them; "" of an expression."""
        declared = {"g": DEFAULT_G, **self._raw.get("parameters", {})}
        return {name: declared_unit(declared[name]) if name in declared else "" for name in names}

    def map(
        self,
        *,
        of: str | Sequence[str] | None = None,
        tolerance: float | None = None,
        workers: int | None = None,
        progress: Callable[[int], None] | None = None,
        **grids: Any,
    ) -> OutcomeMap:
        """Which outcome there is over two parameters, and the boundaries between the outcomes.

            scene.map(of="overturned", a={"from": 0, "to": 2, "num": 17}, w={...}).save("map.png")

        `grids`: two grids from which it starts, else those of [sweep]; an island that none of their places
        meets is not seen.  `of`: asks that tell outcomes apart (default: all words of events), `tolerance`:
        how near the boundaries are followed, as a part of both ranges (1e-3); else as [sweep] refine says.
        `progress(done)` is called with the number of runs.  Raises SceneError if no map can be made.
        """
        from .mapping import outcome_map

        sweep = {**({} if grids else self._raw.get("sweep", {})), **plain(grids)}
        said = {"of": None if of is None else plain(of), "tolerance": tolerance}
        given = {key: value for key, value in said.items() if value is not None}
        refine = {**self._raw.get("sweep", {}).get("refine", {}), **given}
        scene = type(self).from_table({**self._raw, "sweep": {**sweep, "refine": refine}}, file=self.file)
        return outcome_map(scene, workers, progress)

    # ---- changing ----

    def _update(self, table: str, values: Mapping[str, Any]) -> Self:
        self._raw.setdefault(table, {}).update(plain({name: _spelled(one) for name, one in values.items()}))
        return self._changed()

    def _changed(self) -> Self:
        self._data = self._text = None
        return self
