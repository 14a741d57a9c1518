"""A scene as a function of some of its parameters, on arrays: for optimisers and the like."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..base.arrays import Floats
from ..base.errors import SceneError, StudyError
from ..model.words import unknown
from .cache import Kept
from .cases import Study
from .layout import STATUS_WORDS
from .plan import plan_sweep

if TYPE_CHECKING:
    from ..reading.scene import WrittenScene


class SceneFunction:
    """f(x): answers of a scene at parameters x, numbers in the units of `units`.

    x [n, inputs] gives [n, outputs], or [n] where one output was named; x [inputs] gives one row of that.
    There is not-a-number where a case has no answer.  The same bits as `scene.run` and `scene.sweep` give.
    """

    def __init__(
        self, scene: WrittenScene, inputs: Sequence[str], outputs: str | Sequence[str], workers: int | None
    ) -> None:
        """`scene`: one whose sweep has a grid for each input."""
        if workers is not None and workers < 1:
            raise StudyError(f"workers = {workers}: at least 1 is needed")
        plan = plan_sweep(scene)
        self._study = Study(scene, plan, workers or len(os.sched_getaffinity(0)), Kept())
        self._axes = {axis.name: axis for axis in plan.axes}
        self.inputs = tuple(inputs)
        self._single = isinstance(outputs, str)
        self.outputs = (outputs,) if isinstance(outputs, str) else tuple(outputs)
        first = np.cumsum([0, *(ask.count for ask in self._study.asks)]).tolist()
        known = {ask.key: (ask, at) for ask, at in zip(self._study.asks, first, strict=False)}
        for name in self.outputs:
            if name not in known:
                raise SceneError(unknown(name, known, "ask"), file=scene.data.file, path=f"ask.{name}")
            if known[name][0].is_list:
                raise SceneError("a list is no number", file=scene.data.file, path=f"ask.{name}")
        self._columns = [known[name][1] for name in self.outputs]

    @property
    def units(self) -> tuple[str, ...]:
        """Of the inputs."""
        return tuple(self._axes[name].unit for name in self.inputs)

    def __call__(self, x: npt.ArrayLike) -> Floats:
        return self.with_status(x)[0]

    def with_status(self, x: npt.ArrayLike) -> tuple[Floats, npt.NDArray[np.str_]]:
        """The same, and how each case ended: "ok", or the word of its status."""
        given = np.asarray(x, np.float64)
        rows = np.atleast_2d(given)
        if given.ndim > 2 or rows.shape[1] != len(self.inputs):
            wanted = f"[n, {len(self.inputs)}] or [{len(self.inputs)}]"
            raise ValueError(f"x has the shape {given.shape}; {wanted} is wanted: {', '.join(self.inputs)}")
        values, words = [], []
        for first in range(0, len(rows), self._study.max_chunk):
            block = self._study.solver.compute(
                self._si(rows[first : first + self._study.max_chunk]), workers=self._study.workers
            )
            values.append(block.value[:, self._columns])
            words += [STATUS_WORDS.get(code, f"status {code}") for code in block.status.tolist()]
        result = np.concatenate(values) if values else np.empty((0, len(self.outputs)))
        statuses = np.array(words, dtype=np.str_)
        if self._single:
            result = result[:, 0]
        return (result[0], statuses[0:1]) if given.ndim == 1 else (result, statuses)

    def _si(self, rows: Floats) -> Floats:
        """In SI, in the order of the sweep."""
        columns = dict(zip(self.inputs, rows.T, strict=True))
        return np.stack([axis.in_si(columns[name]) for name, axis in self._axes.items()], axis=1)
