"""The tables of a scene, read by the names of their columns."""

from __future__ import annotations

import numpy as np

from planemotion import _layout as layout
from planemotion import load_text
from planemotion.compile.flatten import FlatScene, flatten
from planemotion.engine.evaluator import run_program, value_table

PARTICLE = 'until = "start"\nbodies.P = { mass = "1 kg", at = ["1 m", "2 m"] }\n'


class Tables:
    """The tables of a scene with the values of one case."""

    def __init__(self, text: str, run: str | None = None, **param: float) -> None:
        self.flat: FlatScene = flatten(load_text(text), run)
        case = dict(zip(self.flat.parameters, self.flat.defaults, strict=True)) | param
        self.param = np.array([case[name] for name in self.flat.parameters])
        self.value = value_table(self.flat, self.param)

    def row(self, table: str, path: str) -> dict[str, int]:
        """The first row with that key path, by column name."""
        index = self.flat.names[layout.pm_table[f"PM_TABLE_{table}"]].index(path)
        return self.rows(table)[index]

    def rows(self, table: str) -> list[dict[str, int]]:
        columns: dict[str, int] = getattr(layout, f"pm_{table.lower()}_column")
        prefix = f"PM_{table}_"
        names = {
            number: name.removeprefix(prefix)
            for name, number in columns.items()
            if not name.endswith("_COLUMNS")
        }
        table_rows = self.flat.rows(layout.pm_table[f"PM_TABLE_{table}"])
        return [{names[i]: int(entry) for i, entry in enumerate(row)} for row in table_rows]

    def pose(self, body: str) -> tuple[float, float, float]:
        row = self.row("BODY", f"bodies.{body}")
        x, y, angle = (float(self.value[row[column]]) for column in ("X", "Y", "ANGLE"))
        return x, y, angle

    def point(self, index: int) -> tuple[int, float, float]:
        row = self.rows("POINT")[index]
        return row["BODY"], float(self.value[row["X"]]), float(self.value[row["Y"]])

    def program(self, index: int) -> float:
        return run_program(self.flat, index, self.param, self.value)


def body_of(keys: str) -> Tables:
    return Tables(f'until = "start"\nbodies.Q = {{ {keys} }}')


TWO_RODS = """
until = "start"
ground.points.O = ["3 m", 0]
ground.lines.guide = { through = [0, "1 m"], angle = "30 deg" }
ground.circles.arc = { center = [0, 0], radius = "5 m" }
ground.rows.bars = { from = [0, 0], step = ["1 m", 0] }
bodies.a = { rod = ["A", "B"], length = "2 m", mass = "1 kg", at = { A = [0, 0] }, angle = "90 deg" }
bodies.b = { rod = ["A", "B"], length = "2 m", mass = "1 kg", at = { A = ["1 m", 0] }, angle = "30 deg" }
bodies.p = { mass = "1 kg", at = ["3 m", "4 m"] }
bodies.wheel = { disk = "1 m", mass = "1 kg", at = ["6 m", 0] }
bodies.rim = { hoop = "3 m", mass = "1 kg", at = ["6 m", "2 m"] }
"""
