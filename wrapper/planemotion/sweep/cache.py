"""What a scene keeps from one run or sweep to the next, so that a call costs no more than its cases.

The tables of a scene depend on which parameters are swept, not on their grids: they are made once.  They are
made anew when the scene says something else, also where its table was changed directly.
"""

from __future__ import annotations

import marshal
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from ..compile.flatten import FlatScene
    from ..reading.scene import SceneData

# Which parameters are swept, and whether a history can be made.
_Use: TypeAlias = tuple[frozenset[str], bool]
# The version of marshal's format in which equal values are equal bytes, however often they are referred to.
_SAME_EACH_TIME = 2


def _as_written(said: Any) -> bytes:
    """What tells 1 from 1.0 and keeps the order of tables, which comparing would not."""
    try:
        return marshal.dumps(said, _SAME_EACH_TIME)
    except ValueError:  # of what is no value of a scene, which is told elsewhere
        return repr(said).encode()


class Kept:
    """The tables by what they are used for; `chunk`: by workers, the cases of the last chunk."""

    def __init__(self) -> None:
        self.chunk: dict[int, int] = {}
        self._said = b""
        self._flats: dict[_Use, list[FlatScene]] = {}

    def flats(
        self, raw: Mapping[str, Any], file: str | None, use: _Use, make: Callable[[], list[FlatScene]]
    ) -> list[FlatScene]:
        """The tables of each run of the scene `raw` out of `file`; `make` makes what is not there."""
        said = _as_written((file, {key: value for key, value in raw.items() if key != "sweep"}))
        if said != self._said:
            self._said, self._flats = said, {}
        if use not in self._flats:
            self._flats[use] = make()
        return self._flats[use]

    def flats_of(
        self, data: SceneData, raw: Mapping[str, Any], file: str | None, *, history: bool = False
    ) -> list[FlatScene]:
        """The tables of each of its [runs], made once until the scene is changed."""
        from ..compile.flatten import flatten

        use = frozenset(data.sweep.grids), history
        names = tuple(data.runs) or (None,)
        return self.flats(raw, file, use, lambda: [flatten(data, name, history=history) for name in names])
