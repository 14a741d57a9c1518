"""A flattened scene seen by another observer: turned, mirrored, in other units of length, time and mass.

The tables are rewritten, the questions with them: a place x of the old scene is at lambda R(phi) M x in the
new one (M mirrors x), a force is mu lambda / tau^2 times as large, and every expression reads the new
motion back in the old terms. So all answers must stay the same numbers, signs included, while the kernel
sees other tables.

A body's own axes are mirrored with it: its angle theta becomes phi + s theta (s = -1 mirrored), a place (x,
y) on it (s x, y); a line's free side stays on its left, so that its direction turns round when mirrored.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np

from planemotion import _layout as L
from planemotion.compile.flatten import FlatScene
from tests.chapter17.change import MEASURES, Change, NoRule

Code = list[tuple[int, int]]


BY_KIND = {number: name.removeprefix("PM_MEASURE_") for name, number in L.pm_measure_kind.items()}
KNOWN_TABLES = set(range(L.PM_TABLE_ACTION + 1))


def transformed(flat: FlatScene, change: Change) -> FlatScene:
    """The scene as the other observer has it.  Raises NoRule where this module does not know how."""
    return _Rewriter(flat, change).flat_scene()


def half_written(flat: FlatScene) -> bool:
    """Whether a start gives one component of a velocity alone: the other is 0 along the scene's own axes, so
    that only quarter turns keep the meaning."""
    given: dict[tuple[int, int], set[int]] = {}
    for start in flat.rows(L.PM_TABLE_START):
        row = flat.rows(L.PM_TABLE_MEASURE)[start[L.PM_START_MEASURE]]
        if row[L.PM_MEASURE_KIND] == L.PM_MEASURE_VELOCITY:
            thing = int(row[L.PM_MEASURE_A]), int(row[L.PM_MEASURE_IN])
            given.setdefault(thing, set()).add(int(row[L.PM_MEASURE_PART]))
    return any(len(parts) == 1 for parts in given.values())


class _Rewriter:
    def __init__(self, flat: FlatScene, change: Change) -> None:
        self.flat, self.change = flat, change
        self.rows: list[list[list[int]]] = [
            [[int(entry) for entry in row] for row in flat.rows(table)] for table in range(L.PM_TABLES)
        ]
        strange = [table for table in range(L.PM_TABLES) if table not in KNOWN_TABLES and self.rows[table]]
        if strange:
            raise NoRule(f"table {strange[0]}")
        self.constants = [float(one) for one in flat.constant]
        code = [(row[0], row[1]) for row in self.rows[L.PM_TABLE_CODE]]
        self.codes: list[Code] = [code[a : a + n] for a, n in self.rows[L.PM_TABLE_PROGRAM]]
        self.values: dict[tuple[Any, ...], int] = {}

    # ---- values and programs ----

    def constant(self, number: float) -> tuple[int, int]:
        self.constants.append(number)
        return L.PM_OP_CONSTANT, len(self.constants) - 1

    def combined(self, parts: list[tuple[Code, float]], offset: float = 0.0) -> Code:
        """The sum of codes times factors, and a constant."""
        code: Code = [self.constant(offset)] if offset else []
        for one, factor in parts:
            code += [*one, *([] if factor == 1 else [self.constant(factor), (L.PM_OP_MUL, 0)])]
            if code != one and len(code) > len(one) + 2 * (factor != 1):
                code.append((L.PM_OP_ADD, 0))
        return code

    def value(self, parts: list[tuple[int, float]], offset: float = 0.0) -> int:
        """A new value: the sum of old values times factors, and a constant."""
        key = (*parts, offset)
        if key not in self.values:
            code = self.combined([([(L.PM_OP_VALUE, old)], factor) for old, factor in parts], offset)
            self.codes.append(code)
            self.rows[L.PM_TABLE_VALUE].append([len(self.codes) - 1])
            self.values[key] = len(self.rows[L.PM_TABLE_VALUE]) - 1
        return self.values[key]

    def scale(self, row: list[int], column: int, factor: float, offset: float = 0.0) -> None:
        if row[column] >= 0 and (factor != 1 or offset):
            row[column] = self.value([(row[column], factor)], offset)

    def turn(self, row: list[int], x: int, y: int, factor: float) -> None:
        """A vector of the scene."""
        s, c = self.change.sign, math.cos(self.change.phi)
        n = math.sin(self.change.phi)
        old = row[x], row[y]
        row[x] = self.value([(old[0], factor * s * c), (old[1], -factor * n)])
        row[y] = self.value([(old[0], factor * s * n), (old[1], factor * c)])

    def place(self, row: list[int], x: int, y: int, body: int) -> None:
        if body == L.PM_GROUND:
            self.turn(row, x, y, self.change.length)
        else:
            self.scale(row, x, self.change.sign * self.change.length)
            self.scale(row, y, self.change.length)

    def program(self, old: int, factor: float) -> int:
        self.codes.append(self.combined([(self.codes[old], factor)]))
        return len(self.codes) - 1

    def program_vector(self, row: list[int], x: int, y: int, factor: float, body: int) -> None:
        zero: Code = [self.constant(0.0)]
        a = self.codes[row[x]] if row[x] >= 0 else zero
        b = self.codes[row[y]] if row[y] >= 0 else zero
        s = self.change.sign
        phi = self.change.phi if body == L.PM_GROUND else 0.0
        c, n = math.cos(phi), math.sin(phi)
        self.codes.append(self.combined([(a, factor * s * c), (b, -factor * n)]))
        self.codes.append(self.combined([(a, factor * s * n), (b, factor * c)]))
        row[x], row[y] = len(self.codes) - 2, len(self.codes) - 1

    # ---- the tables ----

    def flat_scene(self) -> FlatScene:
        self.starts()
        self.read_back()
        self.bodies_and_marks()
        self.joints()
        self.contacts()
        self.forces()
        self.spin()
        self.actions()
        (setting,) = self.rows[L.PM_TABLE_SETTING]
        self.turn(setting, L.PM_SETTING_GRAVITY_X, L.PM_SETTING_GRAVITY_Y, self.change.size(0, 1, -2))
        self.scale(setting, L.PM_SETTING_MAX_TIME, self.change.time)
        return dataclasses.replace(self.flat, table=self.packed(), constant=np.array(self.constants))

    def packed(self) -> Any:
        self.rows[L.PM_TABLE_PROGRAM] = []
        self.rows[L.PM_TABLE_CODE] = []
        for code in self.codes:
            self.rows[L.PM_TABLE_PROGRAM].append([len(self.rows[L.PM_TABLE_CODE]), len(code)])
            self.rows[L.PM_TABLE_CODE] += [list(one) for one in code]
        directory: list[int] = []
        body: list[int] = []
        for rows in self.rows:
            directory += [2 * L.PM_TABLES + len(body), len(rows)]
            body += [entry for row in rows for entry in row]
        return np.array(directory + body, dtype=np.int32)

    def bodies_and_marks(self) -> None:
        change, rows = self.change, self.rows
        for row in rows[L.PM_TABLE_BODY]:
            self.scale(row, L.PM_BODY_MASS, change.mass)
            self.scale(row, L.PM_BODY_INERTIA, change.size(1, 2, 0))
            self.turn(row, L.PM_BODY_X, L.PM_BODY_Y, change.length)
            if row[L.PM_BODY_ROTATES]:
                self.scale(row, L.PM_BODY_ANGLE, change.sign, change.phi)
        for row in rows[L.PM_TABLE_POINT]:
            self.place(row, L.PM_POINT_X, L.PM_POINT_Y, row[L.PM_POINT_BODY])
        for row in rows[L.PM_TABLE_LINE]:
            self.scale(row, L.PM_LINE_ANGLE, change.sign, self.phi_of(row[L.PM_LINE_POINT]))
        for row in rows[L.PM_TABLE_CIRCLE]:
            self.scale(row, L.PM_CIRCLE_RADIUS, change.length)
        for row in rows[L.PM_TABLE_PATTERN]:
            self.place(row, L.PM_PATTERN_STEP_X, L.PM_PATTERN_STEP_Y, self.body_of(row[L.PM_PATTERN_POINT]))

    def body_of(self, point: int) -> int:
        return self.rows[L.PM_TABLE_POINT][point][L.PM_POINT_BODY]

    def phi_of(self, point: int) -> float:
        return self.change.phi if self.body_of(point) == L.PM_GROUND else 0.0

    def difference(self, a: int, b: int) -> float:
        """What the difference of two bodies' angles gains: particles and the ground do not turn along."""

        def gain(body: int) -> float:
            turns = body >= 0 and self.rows[L.PM_TABLE_BODY][body][L.PM_BODY_ROTATES]
            return self.change.phi if turns else 0.0

        return gain(a) - gain(b)

    def joints(self) -> None:
        change = self.change
        for row in self.rows[L.PM_TABLE_JOINT]:
            kind, a, b = row[L.PM_JOINT_KIND], row[L.PM_JOINT_A], row[L.PM_JOINT_B]
            if kind == L.PM_JOINT_LINK:
                self.scale(row, L.PM_JOINT_VALUE, change.length)
            elif kind in (L.PM_JOINT_SLIDER_FIXED, L.PM_JOINT_WELD):
                on = self.rows[L.PM_TABLE_LINE][b][L.PM_LINE_POINT] if kind == L.PM_JOINT_SLIDER_FIXED else b
                self.scale(
                    row, L.PM_JOINT_VALUE, change.sign, self.difference(self.body_of(a), self.body_of(on))
                )
            elif kind == L.PM_JOINT_RATE:
                factor = change.sign / change.time
                row[L.PM_JOINT_PROGRAM_X] = self.program(row[L.PM_JOINT_PROGRAM_X], factor)
            elif kind == L.PM_JOINT_DRIVE:
                speed = change.length / change.time
                self.program_vector(row, L.PM_JOINT_PROGRAM_X, L.PM_JOINT_PROGRAM_Y, speed, L.PM_GROUND)

    def contacts(self) -> None:
        change = self.change
        for row in self.rows[L.PM_TABLE_CONTACT]:
            self.scale(row, L.PM_CONTACT_SLACK, change.length)
            if row[L.PM_CONTACT_SPEED] >= 0:
                speed = change.sign * change.length / change.time
                row[L.PM_CONTACT_SPEED] = self.program(row[L.PM_CONTACT_SPEED], speed)
            if change.mirrored:
                for column in (L.PM_CONTACT_SENSE_A, L.PM_CONTACT_SENSE_B):
                    row[column] = -row[column] if abs(row[column]) == 1 else row[column]
                ends = row[L.PM_CONTACT_FROM], row[L.PM_CONTACT_TO]
                row[L.PM_CONTACT_TO], row[L.PM_CONTACT_FROM] = ends
            for column in (L.PM_CONTACT_FROM, L.PM_CONTACT_TO):
                self.scale(row, column, change.sign * change.length)

    def forces(self) -> None:
        change = self.change
        sizes = {
            L.PM_FORCE_SPRING: (change.size(1, 0, -2), change.length),
            L.PM_FORCE_TORSION: (change.size(1, 2, -2), change.sign),
            L.PM_FORCE_DAMPER: (change.size(1, 0, -1), 1),
            L.PM_FORCE_ROTARY_DAMPER: (change.size(1, 2, -1), 1),
        }
        for row in self.rows[L.PM_TABLE_FORCE]:
            kind, a, b = row[L.PM_FORCE_KIND], row[L.PM_FORCE_A], row[L.PM_FORCE_B]
            if kind in sizes:
                self.scale(row, L.PM_FORCE_VALUE_1, sizes[kind][0])
                offset = self.difference(a, b) if kind == L.PM_FORCE_TORSION else 0.0
                self.scale(row, L.PM_FORCE_VALUE_2, sizes[kind][1], offset)
            elif kind == L.PM_FORCE_APPLIED:
                factor = change.size(1, 1, -2)
                self.program_vector(row, L.PM_FORCE_PROGRAM_X, L.PM_FORCE_PROGRAM_Y, factor, b)
            elif kind == L.PM_FORCE_COUPLE:
                factor = change.sign * change.size(1, 2, -2)
                row[L.PM_FORCE_PROGRAM_X] = self.program(row[L.PM_FORCE_PROGRAM_X], factor)
            elif kind == L.PM_FORCE_FRICTION:
                # Never turns its sign: a couple and a radius of a bearing, else a force and a ratio.
                pin = self.rows[L.PM_TABLE_JOINT][a][L.PM_JOINT_KIND] == L.PM_JOINT_PIN
                self.scale(row, L.PM_FORCE_VALUE_1, change.size(1, 2 if pin else 1, -2))
                self.scale(row, L.PM_FORCE_VALUE_2, change.length if pin else 1)
            else:
                raise NoRule(f"force kind {kind}")

    def spin(self) -> None:
        """The axis turns and is mirrored as a line of the ground, and the gravity along it with it.

        The sense of the rate about it says nothing about the motion in the plane: it is kept, and that of the
        couple with it, so that every observer is possible.
        """
        change = self.change
        for row in self.rows[L.PM_TABLE_SPIN]:
            self.turn(row, L.PM_SPIN_X, L.PM_SPIN_Y, change.length)
            self.scale(row, L.PM_SPIN_ANGLE, change.sign, change.phi)
            self.scale(row, L.PM_SPIN_INERTIA, change.size(1, 2, 0))
            self.scale(row, L.PM_SPIN_OMEGA, 1 / change.time)
            if row[L.PM_SPIN_COUPLE] >= 0:
                row[L.PM_SPIN_COUPLE] = self.program(row[L.PM_SPIN_COUPLE], change.size(1, 2, -2))
        for row in self.rows[L.PM_TABLE_SECOND]:
            for column in range(L.PM_SECOND_COLUMNS):
                self.scale(row, column, change.size(1, 2, 0))

    def actions(self) -> None:
        """Elements have their own rows, a nudge has a sign; impulses are vectors, work a number."""
        change = self.change
        factors = {
            L.PM_ACTION_ANGULAR: change.sign * change.size(1, 2, -1),
            L.PM_ACTION_WORK: change.size(1, 2, -2),
        }
        x, y = L.PM_ACTION_PROGRAM_X, L.PM_ACTION_PROGRAM_Y
        for row in self.rows[L.PM_TABLE_ACTION]:
            kind = row[L.PM_ACTION_KIND]
            if kind == L.PM_ACTION_IMPULSE:
                self.program_vector(row, x, y, change.size(1, 1, -1), L.PM_GROUND)
            elif kind in factors:
                row[x] = self.program(row[x], factors[kind])
            elif kind not in (L.PM_ACTION_ADD, L.PM_ACTION_REMOVE, L.PM_ACTION_NUDGE):
                raise NoRule(f"action kind {kind}")

    # ---- measures: the same quantity of the new motion, and how the old one is read off it ----

    def factor(self, row: list[int]) -> float:
        name = BY_KIND[row[L.PM_MEASURE_KIND]]
        if name not in MEASURES:
            raise NoRule(f"measure {name}")
        mass, length, time, odd = MEASURES[name]
        factor = self.change.size(mass, length, time) * (self.change.sign if odd else 1)
        inside = row[L.PM_MEASURE_IN] >= 0
        return factor * (self.change.sign if inside and row[L.PM_MEASURE_PART] == L.PM_PART_X else 1)

    def offset(self, row: list[int]) -> float:
        if row[L.PM_MEASURE_KIND] != L.PM_MEASURE_ANGLE:
            return 0.0
        return self.difference(row[L.PM_MEASURE_A], row[L.PM_MEASURE_IN])

    def starts(self) -> None:
        for row in self.rows[L.PM_TABLE_START]:
            measure = self.rows[L.PM_TABLE_MEASURE][row[L.PM_START_MEASURE]]
            self.scale(row, L.PM_START_VALUE, self.factor(measure), self.offset(measure))

    def read_back(self) -> None:
        """Every expression reads the new measures back in the old terms."""
        measures = self.rows[L.PM_TABLE_MEASURE]
        old = [list(row) for row in measures]
        expansion: list[Code] = []
        for index, row in enumerate(old):
            if row[L.PM_MEASURE_PART] == L.PM_PART_ANGLE:
                parts = []
                for part in (L.PM_PART_Y, L.PM_PART_X):
                    one = list(row)
                    one[L.PM_MEASURE_PART] = part
                    factor = self.factor(one)
                    self.direct(one)
                    measures.append(one)
                    parts += self.combined([([(L.PM_OP_MEASURE, len(measures) - 1)], 1 / factor)])
                expansion.append([*parts, (L.PM_OP_ATAN2, 0)])
                continue
            factor, offset = self.factor(row), self.offset(row)
            self.direct(measures[index])
            expansion.append(self.combined([([(L.PM_OP_MEASURE, index)], 1 / factor)], -offset / factor))
        self.codes = [
            [new for op, arg in code for new in (expansion[arg] if op == L.PM_OP_MEASURE else [(op, arg)])]
            for code in self.codes
        ]

    def direct(self, row: list[int]) -> None:
        """Parts of a vector along the directions of the scene turn with it."""
        part = row[L.PM_MEASURE_PART]
        inside = row[L.PM_MEASURE_IN] >= 0
        if part == L.PM_PART_ALONG:
            phi = (0.0 if inside else self.change.phi) + (math.pi if self.change.mirrored else 0.0)
            self.scale(row, L.PM_MEASURE_VALUE, self.change.sign, phi)
        elif part in (L.PM_PART_X, L.PM_PART_Y) and not inside:
            angle = self.change.phi
            if part == L.PM_PART_Y:
                angle += math.pi / 2
            elif self.change.mirrored:
                angle += math.pi
            if angle:
                row[L.PM_MEASURE_PART] = L.PM_PART_ALONG
                row[L.PM_MEASURE_VALUE] = self.value([], angle)
