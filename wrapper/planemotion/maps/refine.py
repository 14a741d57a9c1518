"""Where a function over two parameters changes its outcome: cells that are divided along the boundaries.

A cell whose corners agree is left as it is: an island that no place of the start grid meets is not seen.
Of the others each side with different ends is halved until the change lies between two neighbours of the
lattice.  A cell with two such changes is done where the straight line between them is the boundary, to the
tolerance, at three places along it: on either side, 0.6 of the tolerance away, the outcome is the one there.
What else there is (a bend, a third outcome, a second boundary) is divided into four, down to the tolerance.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from ..base.arrays import Floats, Ints
from .lattice import Places, Side
from .looks import Looks

# Where along the line between two changes one looks, and how far beside it, of the tolerance.
_ALONG = (0.5, 0.25, 0.75)  # a bend shows most in the middle
_BESIDE = 0.6
# Corners of a cell, counterclockwise; its sides: from which corner to which, from low to high.
_CORNERS = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.int64)
_SIDES = ((0, 1), (1, 2), (3, 2), (0, 3))

# A cell: its lower left place and its length.  An edge: its first place, along which axis, and its length.
Cell = tuple[int, int, int]
Edge = tuple[int, int, int, int]


@dataclass(frozen=True)
class Change:
    """Where an edge changes its outcome: between `place` and the next along the axis; outcomes there.

    `whole`: these are the outcomes of the edge's ends.
    """

    place: tuple[int, int]
    along: int
    before: int
    after: int
    whole: bool

    @property
    def middle(self) -> tuple[float, float]:
        """Between both places."""
        i, j = self.place
        return (i + 0.5, float(j)) if self.along == 0 else (float(i), j + 0.5)


@dataclass
class Refined:
    """What a refinement leaves: the cells that were not divided, and where their edges change.

    `open`: cells as small as the tolerance in which more than one boundary lies.
    """

    cells: dict[Cell, tuple[int, int, int, int]] = field(default_factory=dict)
    changes: dict[Edge, Change] = field(default_factory=dict)
    open: set[Cell] = field(default_factory=set)

    def of_cell(self, cell: Cell) -> list[tuple[int, Change]]:
        """The changes on the sides of a cell: number of the side, and the change."""
        found = ((side, self.changes.get(edge)) for side, edge in enumerate(edges_of(cell)))
        return [(side, change) for side, change in found if change]


def edges_of(cell: Cell) -> list[Edge]:
    """The sides of a cell: below, right, above, left."""
    i, j, size = cell
    return [(i, j, 0, size), (i + size, j, 1, size), (i, j + size, 0, size), (i, j, 1, size)]


def refine(look: Looks, sides: tuple[Side, Side], tolerance: float) -> Refined:
    """Divides the cells of the start grid until all is known to the tolerance, a part of the ranges."""
    step = sides[0].steps
    work = _Work(look, sides, tolerance)
    todo = [(i, j, step) for i in range(0, sides[0].last, step) for j in range(0, sides[1].last, step)]
    while todo:
        while todo:
            todo = work.examine(todo)
        todo = work.contradicted()
    return work.found


class _Work:
    def __init__(self, look: Looks, sides: tuple[Side, Side], tolerance: float) -> None:
        self.look = look
        self.sides = sides
        self.tolerance = tolerance
        self.found = Refined()
        self.divided: set[Edge] = set()  # that have a middle

    def examine(self, cells: list[Cell]) -> list[Cell]:
        """Keeps the cells that are done, and gives the quarters of the others."""
        corners = self._corners(cells)
        mixed = [cell for cell, ends in zip(cells, corners, strict=True) if len(set(ends)) > 1]
        self.found.cells.update(zip(cells, corners, strict=True))
        self._find_changes(mixed)
        small = {cell for cell in mixed if self._is_small(cell)}
        simple = [cell for cell in mixed if self._is_simple(cell)]
        straight = self._straight([cell for cell in simple if cell not in small])
        self.found.open |= small - set(simple)
        return self._divide(cell for cell in mixed if cell not in small and cell not in straight)

    def contradicted(self) -> list[Cell]:
        """Quarters of cells beside smaller ones, on whose sides those saw more than the corners tell."""
        odd = [cell for cell in self.found.cells if cell[2] > 1 and self._is_contradicted(cell)]
        return self._divide(odd)

    def _corners(self, cells: list[Cell]) -> list[tuple[int, int, int, int]]:
        at = np.array(cells, np.int64)
        places: Places = at[:, None, :2] + _CORNERS[None] * at[:, 2, None, None]
        outcomes = self.look(places.reshape(-1, 2)).reshape(-1, 4).tolist()
        return [(a, b, c, d) for a, b, c, d in outcomes]

    def _is_small(self, cell: Cell) -> bool:
        i, j, size = cell
        lengths = [
            side.part(np.array([first, first + size])) for side, first in zip(self.sides, (i, j), strict=True)
        ]
        return size == 1 or all(float(ends[1] - ends[0]) <= self.tolerance for ends in lengths)

    def _is_simple(self, cell: Cell) -> bool:
        changes = self.found.of_cell(cell)
        return len(changes) == 2 and all(change.whole for _, change in changes)

    def _divide(self, cells: Iterable[Cell]) -> list[Cell]:
        quarters = []
        for cell in cells:
            i, j, size = cell
            half = size // 2
            del self.found.cells[cell]
            self.divided.update(edges_of(cell))
            quarters += [(i + a * half, j + b * half, half) for a, b in _CORNERS.tolist()]
        return quarters

    # ---- where edges change ----

    def _find_changes(self, cells: list[Cell]) -> None:
        """Halves all edges with different ends together, towards the first change that is met."""
        edges = {edge for cell in cells for edge in edges_of(cell)} - self.found.changes.keys()
        if not edges:
            return
        at = np.array(sorted(edges), np.int64)
        unit = np.eye(2, dtype=np.int64)[at[:, 2]]
        low, high = np.zeros(len(at), np.int64), at[:, 3].copy()
        ends = self.look(at[:, :2]), self.look(at[:, :2] + unit * at[:, 3:])
        differ = ends[0] != ends[1]
        at, unit, low, high, before, after = (x[differ] for x in (at, unit, low, high, *ends))
        first, last = before, after.copy()
        while (open_ := high - low > 1).any():
            middle = (low + high) // 2
            seen = after.copy()
            seen[open_] = self.look((at[:, :2] + unit * middle[:, None])[open_])
            is_before = seen == first
            low = np.where(open_ & is_before, middle, low)
            high, last = np.where(open_ & ~is_before, middle, high), np.where(open_ & ~is_before, seen, last)
        places = at[:, :2] + unit * low[:, None]
        for k, row in enumerate(at.tolist()):
            place = int(places[k, 0]), int(places[k, 1])
            whole = bool(last[k] == after[k])
            self.found.changes[tuple(row)] = Change(place, row[2], int(first[k]), int(last[k]), whole)

    # ---- whether a boundary is straight ----

    def _straight(self, cells: list[Cell]) -> set[Cell]:
        """Those of the cells with two changes in which the line between these is the boundary."""
        if not cells:
            return set()
        ends = np.array([[c.middle for _, c in self.found.of_cell(cell)] for cell in cells])
        p, q = self._parts(ends[:, 0]), self._parts(ends[:, 1])
        normal = np.stack([p[:, 1] - q[:, 1], q[:, 0] - p[:, 0]], axis=1)  # to the left of p -> q
        length = np.hypot(*normal.T)
        normal /= np.maximum(length, np.finfo(float).tiny)[:, None]
        wanted = self._beside(cells, p, normal)
        good = length <= self.tolerance
        left = np.flatnonzero(~good)
        for along in _ALONG:
            for sign, side in ((1, 0), (-1, 1)):
                at = (p + along * (q - p) + sign * _BESIDE * self.tolerance * normal)[left]
                seen = self.look(self._places(at, [cells[k] for k in left.tolist()]))
                left = left[seen == wanted[left, side]]
        good[left] = True
        return {cell for cell, one in zip(cells, good, strict=True) if one}

    def _beside(self, cells: list[Cell], p: Floats, normal: Floats) -> Ints:
        """Outcomes [n, 2] on the left and the right of lines through p: of the corners that are farthest."""
        at = np.array(cells, np.int64)
        places = at[:, None, :2] + _CORNERS[None] * at[:, 2, None, None]
        parts = np.stack([self.sides[k].part(places[:, :, k]) for k in (0, 1)], axis=2)
        distance = np.einsum("nck,nk->nc", parts - p[:, None], normal)
        corner = np.array([self.found.cells[cell] for cell in cells], np.int32)
        rows = np.arange(len(cells))
        left, right = distance.argmax(axis=1), distance.argmin(axis=1)
        return np.stack([corner[rows, left], corner[rows, right]], axis=1)

    def _parts(self, places: Floats) -> Floats:
        return np.stack([self.sides[k].part(places[:, k]) for k in (0, 1)], axis=1)

    def _places(self, parts: Floats, cells: list[Cell]) -> Places:
        """The places next to these parts of the ranges, inside of the cells."""
        at = np.array(cells, np.int64).reshape(-1, 3)
        places = np.stack([self.sides[k].place(parts[:, k]) for k in (0, 1)], axis=1)
        return np.clip(places, at[:, :2], at[:, :2] + at[:, 2:])

    # ---- beside smaller cells ----

    def _is_contradicted(self, cell: Cell) -> bool:
        corners = self.found.cells[cell]
        for edge, (a, b) in zip(edges_of(cell), _SIDES, strict=True):
            if edge not in self.divided:
                continue
            seen = [corners[a], *self._inside(edge), corners[b]]
            changes = sum(one != other for one, other in pairwise(seen))
            if changes > (corners[a] != corners[b]):
                return True
        return False

    def _inside(self, edge: Edge) -> list[int]:
        """The outcomes at the places where an edge is divided, in order."""
        i, j, along, size = edge
        half = size // 2
        if edge not in self.divided or half == 0:
            return []
        middle = (i + half, j) if along == 0 else (i, j + half)
        seen = self.look.at(*middle)
        here = [] if seen is None else [seen]
        return [*self._inside((i, j, along, half)), *here, *self._inside((*middle, along, half))]
