"""The boundaries of a map as curves, and its areas as polygons, of the cells that a refinement leaves."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

from .refine import Cell, Change, Refined

# A point on the lattice.
Point = tuple[float, float]


@dataclass(frozen=True)
class Curve:
    """A boundary between two outcomes: points on the lattice; a closed one ends where it begins."""

    outcomes: tuple[int, int]
    points: tuple[Point, ...]


@dataclass(frozen=True)
class Piece:
    """A polygon of one outcome."""

    outcome: int
    points: tuple[Point, ...]


def pieces_of(found: Refined) -> Iterator[Piece]:
    """Each cell, cut along the boundaries in it: together they cover the map."""
    for cell, corners in found.cells.items():
        changes = found.of_cell(cell)
        if not changes:
            yield Piece(corners[0], tuple(_corner(cell, k) for k in range(4)))
            continue
        centre = [_centre(cell)] if len(changes) != 2 else []
        for outcome, points in _arcs(cell, corners, changes):
            yield Piece(outcome, (*points, *centre))


def _arcs(
    cell: Cell, corners: tuple[int, ...], changes: list[tuple[int, Change]]
) -> Iterator[tuple[int, list[Point]]]:
    """The way round a cell from each change to the next, and the outcome there."""
    on = dict(changes)
    way: list[tuple[int | None, Point]] = []  # corners with their outcomes, and changes
    for k in range(4):
        way.append((corners[k], _corner(cell, k)))
        if k in on:
            way.append((None, on[k].middle))
    first = next(n for n, (outcome, _) in enumerate(way) if outcome is None)
    way = [*way[first:], *way[:first], way[first]]
    arc: list[Point] = []
    outcome = corners[0]
    for kind, point in way:
        arc.append(point)
        if kind is not None:
            outcome = kind
        elif len(arc) > 1:
            yield outcome, arc
            arc = [point]


def _corner(cell: Cell, k: int) -> Point:
    i, j, size = cell
    return (float(i + size * (k in (1, 2))), float(j + size * (k in (2, 3))))


def _centre(cell: Cell) -> Point:
    i, j, size = cell
    return (i + 0.5 * size, j + 0.5 * size)


def curves_of(found: Refined) -> list[Curve]:
    """The boundaries, each between two outcomes and as long as it can be followed."""
    links: dict[tuple[int, int], dict[Point, list[Point]]] = defaultdict(lambda: defaultdict(list))
    for cell in found.cells:
        changes = [change for _, change in found.of_cell(cell)]
        between = _pair(changes[0]) if changes else (0, 0)
        ends = [change.middle for change in changes]
        if len(ends) == 2 and _pair(changes[1]) == between:
            _join(links[between], ends[0], ends[1])
            continue
        for change in changes:
            _join(links[_pair(change)], change.middle, _centre(cell))
    curves = []
    for outcomes, linked in sorted(links.items()):
        curves += [Curve(outcomes, tuple(points)) for points in _chains(linked)]
    return curves


def _pair(change: Change) -> tuple[int, int]:
    return min(change.before, change.after), max(change.before, change.after)


def _join(linked: dict[Point, list[Point]], a: Point, b: Point) -> None:
    linked[a].append(b)
    linked[b].append(a)


def _chains(linked: dict[Point, list[Point]]) -> Iterator[list[Point]]:
    """The ways through a net of points, from ends and forks first, then those that are closed."""
    starts = sorted(point for point, others in linked.items() if len(others) != 2)
    for start in [*starts, *sorted(linked)]:
        while linked[start]:
            points = [start, linked[start].pop()]
            linked[points[1]].remove(start)
            while len(linked[points[-1]]) == 1 and points[-1] != start and points[-1] not in starts:
                ahead = linked[points[-1]].pop()
                linked[ahead].remove(points[-1])
                points.append(ahead)
            yield points
