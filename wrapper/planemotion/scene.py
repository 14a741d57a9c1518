"""Scenes in Python: the same words as in a file, one method for each table.

    s = Scene("pendulum", until="t = 2 s")
    s.body("AB", rod=["A", "B"], length="1 m", mass="2 kg", at={"A": [0, 0]})
    s.joint("A", pin=["AB.A", "ground"])
    s.ask("omega", of="AB.omega", unit="rad/s")
    s.run().omega

reading/written.py holds the table and what writes it; here stands what a scene can be asked to do.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from .language.units import declared_unit
from .model.tables import DEFAULT_G
from .reading.plain import plain
from .reading.written import SceneTable
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


class Scene(SceneTable):
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

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """The scene in a TOML file; see `planemotion.load`."""
        from .file import load

        return load(path)

    # ---- what it says ----

    @cached_property
    def _kept(self) -> Kept:
        """What runs made of the tables, for the next ones."""
        return Kept()

    def tables(self, *, history: bool = False) -> list[FlatScene]:
        """The tables of each of its [runs]; `history`: with its columns.  Raises SceneError as `data`."""
        return self._kept.flats_of(self.data, self._raw, self.file, history=history)

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

    # ---- running ----

    def run(self, **parameters: Any) -> RunResult:
        """Answers of the scene, with other values for some parameters: numbers in the unit of the scene,
        texts such as "2 in", or quantities of pint.

        >>> from planemotion import load_text
        >>> from planemotion.examples import text_of
        >>> result = load_text(text_of("pin"), file="pin.toml").run(g="1.62 m/s^2")
        >>> result
        RunResult pin: ok
          omega = -2.0124612 rad/s
          reaction = 12.15 N
        >>> result.asks["omega"].error < 1e-8
        True

        Raises SceneError for a fault in the scene, SimulationError (with the partial result) if a run fails.
        An early stop, such as a limit, is a result whose status is not "ok".
        """
        from .run import run, run_near

        if not parameters:
            return run(self)
        values = self._plain(parameters)
        return run_near(self, values) or run(self.with_values(values))

    def history(
        self,
        *quantities: str | Sequence[str],
        every: Any = None,
        of_run: str | None = None,
        **parameters: Any,
    ) -> xarray.Dataset:
        """The scene over time, with other values for some parameters.

        `quantities`: expressions such as "AB.omega" or "A.force.x", or lists of them, each a variable;
        without any, positions, velocities and energies, and the reactions that asks read.  `every`: a time
        such as "10 ms"; without it there are as many instants as straight lines between them need to be true
        to a thousandth of what is shown.  `of_run`: which of its [runs] (default: the first).  Every event
        has two rows, before and after its jump.

        What the dataset holds is said in `planemotion.history`.  Raises SceneError for a fault,
        SimulationError if nothing can be recorded.

        >>> from planemotion import load_text
        >>> from planemotion.examples import text_of
        >>> told = load_text(text_of("pin")).history("rod.omega", "A.force.y", every="0.1 s")
        >>> told["rod.omega"].sel(t=0.1).round(4).item(), told["rod.omega"].attrs["units"]
        (-1.2258, 'rad/s')
        """
        from .history import history

        flat = [name for one in quantities for name in ([one] if isinstance(one, str) else one)]
        return history(self.with_values(parameters), flat, every=every, run=of_run)

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

        `at`: a time such as "0.3 s", or an event ("strike 2", "before strike"); without it the start.  `as_`:
        a figure of the book, with names and values: "free-body", "kinetic" (forces = m a), "impulse-momentum"
        (without `at` of the first blow) or "energy" (the work of each force since the start; without `at` of
        the whole run); of all bodies, or of `bodies`.  `show`: of "dimensions" and "velocities", as a list or
        with commas, without `as_`.  `of_run`: which of its [runs] (default: the first).  `theme`: "light" or
        "dark" paper.  `save` writes PNG, SVG or PDF, by the ending; how values stand in figures is said in
        `planemotion.draw`.  Raises SceneError for a fault in the scene, an unknown figure or body, an instant
        that the run does not come to or where nothing is struck but shall be; SimulationError if nothing can
        be recorded.
        """
        from .draw import draw

        return draw(self.with_values(parameters), at, as_, bodies, of_run, theme, show)

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
        raw = {**self._raw, "sweep": plain(chosen, "sweep")}
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

        sweep = {**({} if grids else self._raw.get("sweep", {})), **plain(grids, "sweep")}
        said = {"of": None if of is None else plain(of, "sweep.refine.of"), "tolerance": tolerance}
        given = {key: value for key, value in said.items() if value is not None}
        refine = {**self._raw.get("sweep", {}).get("refine", {}), **given}
        scene = type(self).from_table({**self._raw, "sweep": {**sweep, "refine": refine}}, file=self.file)
        return outcome_map(scene, workers, progress)
