"""Names beside what they name: each stands where it covers least, with a line to its place where that helps.

A name may stand in many spots around its place.  Each spot has a cost by itself: the ink that it covers, how
far it is, whether it leaves the picture; and one beside the spots of other names: boxes that overlap, lines
that cross.  Every name takes its cheapest spot, and again as the others have taken theirs.  A line leads from
a name that stands far away, or nearer to what another name of its kind stands for than to its own.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..base.arrays import Floats

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.text import Text

_SIZE = 8.5  # of letters, in points
LINE = 0.5  # width of a line that leads to a place, in points
_POINTS_PER_INCH = 72.0
_DISTANCES = (5.0, 9.0, 14.0, 21.0, 30.0, 42.0, 58.0, 78.0)  # of spots from their place, in points
_DIRECTIONS = 16
_PAD = 2.5  # points that a name keeps off ink
_BETWEEN = np.array([5.0, 1.5])  # and off other names: beside each other, and above each other
_FAR = 20.0  # points from what it names: farther away a name has a line
_NEARER = 0.8  # of the way to its own, the way to what another name stands for, that makes it doubtful
_ROUNDS = 4
_ORDERS = 8  # in which names are placed, where the first leaves some that disturb each other
# Costs: of a place of ink that is covered, another name, the frame, a line, what a line crosses.
_INK, _NAME, _FRAME, _LINE, _CROSSED = 7.0, 120.0, 200.0, 12.0, 40.0


@dataclass
class Name:
    """A text for a place; `around`: the ink [n, 2] of what has the name, if it is more than that place."""

    place: tuple[float, float]
    text: str
    colour: str
    bold: bool
    around: Sequence[tuple[float, float]] = ()


@dataclass(frozen=True)
class Written:
    """A name on its picture: the lower left of its text, and where its line leaves it, if it has one."""

    name: Name
    at: tuple[float, float]
    line: tuple[float, float] | None


@dataclass
class _Spots:
    """Where a name may stand, in dots: boxes [n, 4] (x0, y0, x1, y1) and what each costs by itself [n].

    `foot` [n, 2]: the place of what it names that is nearest to the box; `has_line` [n]: whether a line leads
    there.
    """

    text: Text
    boxes: Floats
    cost: Floats
    foot: Floats
    has_line: np.ndarray
    chosen: int = field(default=0)

    @property
    def box(self) -> Floats:
        return np.asarray(self.boxes[self.chosen])

    @property
    def line(self) -> tuple[Floats, Floats] | None:
        """Both ends of the line of the chosen spot, at the name and at what it names."""
        if not self.has_line[self.chosen]:
            return None
        foot = self.foot[self.chosen]
        return _nearest(self.box[None], foot[None])[0], foot


def write(
    axes: Axes, canvas: FigureCanvasAgg, ink: Sequence[tuple[float, float]], names: Sequence[Name]
) -> list[Written]:
    """Writes names on axes on which `ink` [n, 2] is drawn already."""
    to_dots = axes.transData.transform
    dot = canvas.figure.dpi / _POINTS_PER_INCH
    frame = np.array(axes.get_window_extent(canvas.get_renderer()).extents)
    inked = _Ink(to_dots(np.array(ink)) if ink else np.empty((0, 2)), dot)
    shown = sorted(names, key=lambda one: one.bold)  # bodies have more room
    around = [to_dots(np.array([*one.around] or [one.place])) for one in shown]
    spots = []
    for name, own in zip(shown, around, strict=True):
        others = [
            places
            for other, places in zip(shown, around, strict=True)
            if other is not name and (other.colour, other.bold) == (name.colour, name.bold)
        ]
        spots.append(_spots_of(axes, canvas, name, own, others, inked, frame, dot))
    _choose(spots, dot)
    return [_put(axes, one, name) for one, name in zip(spots, shown, strict=True)]


def _put(axes: Axes, spots: _Spots, name: Name) -> Written:
    """Writes a name at its spot, with its line."""
    to_unit = axes.transData.inverted().transform
    x, y = to_unit(spots.box[:2])
    spots.text.set_position((float(x), float(y)))
    spots.text.set_verticalalignment("bottom")
    if spots.line is None:
        return Written(name, (float(x), float(y)), None)
    ends = to_unit(np.array(spots.line))
    axes.plot(ends[:, 0], ends[:, 1], color=name.colour, linewidth=LINE, zorder=7.5)
    return Written(name, (float(x), float(y)), (float(ends[0, 0]), float(ends[0, 1])))


class _Ink:
    """How much is inked in a box: places [n, 2] counted by cells, and summed up from the lower left."""

    def __init__(self, places: Floats, dot: float) -> None:
        self.cell = dot
        cells = np.floor(places / dot).astype(np.int64)
        self.low = cells.min(axis=0) if len(cells) else np.zeros(2, np.int64)
        size = cells.max(axis=0) - self.low + 1 if len(cells) else np.ones(2, np.int64)
        counts = np.zeros(size, np.int64)
        np.add.at(counts, tuple((cells - self.low).T), 1)
        self.sums = np.pad(counts.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))

    def in_boxes(self, boxes: Floats) -> Floats:
        """The places in each box [n]."""
        corners = np.rint(boxes / self.cell).astype(np.int64) - np.tile(self.low, 2)
        x0, x1 = (np.clip(corners[:, k], 0, self.sums.shape[0] - 1) for k in (0, 2))
        y0, y1 = (np.clip(corners[:, k], 0, self.sums.shape[1] - 1) for k in (1, 3))
        sums = self.sums
        return np.asarray(sums[x1, y1] - sums[x0, y1] - sums[x1, y0] + sums[x0, y0], np.float64)


def _spots_of(
    axes: Axes,
    canvas: FigureCanvasAgg,
    name: Name,
    own: Floats,
    others: Sequence[Floats],
    inked: _Ink,
    frame: Floats,
    dot: float,
) -> _Spots:
    """Where a name may stand; `own`, `others`: places [n, 2] of what it names, and of what others name."""
    weight = "bold" if name.bold else "normal"
    text = axes.text(*name.place, name.text, color=name.colour, size=_SIZE, weight=weight, zorder=8)
    extent = text.get_window_extent(canvas.get_renderer())
    center = axes.transData.transform(name.place)
    boxes, distances = _boxes_around(center, extent.width, extent.height, dot)
    far, foot = _ways(boxes, own)
    near_others = np.min([_ways(boxes, other)[0] for other in others], axis=0) if others else np.inf
    has_line = (far > _FAR * dot) | ((near_others < _NEARER * far) & (far > _DISTANCES[1] * dot))
    outside = (boxes[:, :2] < frame[:2]).any(axis=1) | (boxes[:, 2:] > frame[2:]).any(axis=1)
    cost = distances + _INK * inked.in_boxes(_grown(boxes, _PAD * dot)) + _FRAME * outside + _LINE * has_line
    return _Spots(text, boxes, cost, foot, has_line)


def _boxes_around(center: Floats, width: float, height: float, dot: float) -> tuple[Floats, Floats]:
    """Boxes [n, 4] round a place, near ones first, and their distances [n] in points."""
    turns = math.pi / 4 + np.arange(_DIRECTIONS) * (2 * math.pi / _DIRECTIONS)
    # Directions are pushed towards the sides of a box.
    way = np.clip(1.25 * np.column_stack([np.cos(turns), np.sin(turns)]), -1.0, 1.0)
    distances = np.repeat(_DISTANCES, _DIRECTIONS)
    half = 0.5 * np.array([width, height])
    middle = center + np.tile(way, (len(_DISTANCES), 1)) * (distances[:, None] * dot + half)
    return np.hstack([middle - half, middle + half]), distances


def _grown(boxes: Floats, pad: float) -> Floats:
    return boxes + pad * np.array([-1.0, -1.0, 1.0, 1.0])


def _nearest(boxes: Floats, places: Floats) -> Floats:
    """The place [n, 2] of each box that is nearest to one of the places [n, 2]."""
    return np.clip(places, boxes[:, :2], boxes[:, 2:])


def _ways(boxes: Floats, places: Floats) -> tuple[Floats, Floats]:
    """How far each box [n, 4] is from the nearest of the places [m, 2], and which that is [n, 2]."""
    x, y = places[:, 0], places[:, 1]
    dx = np.maximum(boxes[:, :1] - x, 0.0) + np.maximum(x - boxes[:, 2:3], 0.0)
    dy = np.maximum(boxes[:, 1:2] - y, 0.0) + np.maximum(y - boxes[:, 3:4], 0.0)
    far = np.hypot(dx, dy)
    best = np.argmin(far, axis=1)
    return far[np.arange(len(boxes)), best], places[best]


def _choose(spots: Sequence[_Spots], dot: float) -> None:
    """Gives each its spot, beginning with one name and another until no two disturb each other."""
    tried: dict[float, list[int]] = {}
    for first in range(min(_ORDERS, len(spots))):
        disturbed = _settle([*spots[first:], *spots[:first]], dot)
        tried.setdefault(disturbed, [one.chosen for one in spots])
        if disturbed < _CROSSED:
            return
    for one, chosen in zip(spots, tried.get(min(tried, default=0.0), ()), strict=False):
        one.chosen = chosen


def _settle(spots: Sequence[_Spots], dot: float) -> float:
    """Each takes its cheapest spot beside those before it, then beside all others, until none moves.

    Gives what they then cost beside each other."""
    for one, name in enumerate(spots):
        name.chosen = int(np.argmin(name.cost + _beside(name, spots[:one], dot)))
    for _ in range(_ROUNDS):
        moved, disturbed = False, 0.0
        for one, name in enumerate(spots):
            beside = _beside(name, [*spots[:one], *spots[one + 1 :]], dot)
            best = int(np.argmin(name.cost + beside))
            moved |= best != name.chosen
            name.chosen = best
            disturbed += float(beside[best])
        if not moved:
            break
    return disturbed


def _beside(name: _Spots, others: Sequence[_Spots], dot: float) -> Floats:
    """What each spot [n] of a name costs beside the chosen ones of others."""
    cost = np.zeros(len(name.cost))
    ends = _nearest(name.boxes, name.foot)
    for other in others:
        cost += _NAME * _overlap(name.boxes, other.box, _BETWEEN * dot)
        cost += _CROSSED * (name.has_line & _passes(ends, name.foot, _grown(other.box[None], 0.5 * dot)))
        if other.line is not None:
            start, end = other.line
            cost += _CROSSED * _passes(start[None], end[None], _grown(name.boxes, 0.5 * dot))
            cost += _CROSSED * (name.has_line & _cross(ends, name.foot, start, end))
    return cost


def _overlap(boxes: Floats, box: Floats, pad: Floats) -> np.ndarray:
    """Whether each of the boxes [n, 4] comes nearer to a box than `pad` [2]."""
    grown = boxes + np.concatenate([-pad, pad])
    beside = (grown[:, 0] < box[2]) & (box[0] < grown[:, 2])
    return np.asarray(beside & (grown[:, 1] < box[3]) & (box[1] < grown[:, 3]))


def _passes(starts: Floats, ends: Floats, boxes: Floats) -> np.ndarray:
    """Whether the line from each start [n, 2] to its end passes its box [n, 4]; each of these may be one."""
    way = np.where(ends == starts, 1e-9, ends - starts)
    first, last = np.sort([(boxes[:, :2] - starts) / way, (boxes[:, 2:] - starts) / way], axis=0)
    return np.asarray(np.maximum(first.max(axis=1), 0.0) < np.minimum(last.min(axis=1), 1.0))


def _cross(starts: Floats, ends: Floats, start: Floats, end: Floats) -> np.ndarray:
    """Whether each line [n] crosses another one."""

    def side(a: Floats, b: Floats, place: Floats) -> Floats:
        return np.sign(
            (b[..., 0] - a[..., 0]) * (place[..., 1] - a[..., 1])
            - (b[..., 1] - a[..., 1]) * (place[..., 0] - a[..., 0])
        )

    apart = side(starts, ends, start) != side(starts, ends, end)
    return np.asarray(apart & (side(start, end, starts) != side(start, end, ends)))
