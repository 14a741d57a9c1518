"""The models of the studies, as one file for fuzz.c: their lengths (int64), then the arrays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from planemotion import load
from planemotion.compile.flatten import FlatScene, flatten
from tests import ROOT

MOST_CPU = "0.005 s"  # of computing time of each case
FIRINGS = 8  # of a list of answers: short, so that its changes are cheap


def scenes() -> list[Path]:
    studies = ROOT / "studies"
    return sorted([*studies.glob("*.toml"), *studies.glob("chapter17/*.toml")])


def models(files: Sequence[Path]) -> Iterator[FlatScene]:
    """The first run of each scene, with a limit of computing time."""
    for file in files:
        yield flatten(load(file).with_values({"solve.max_cpu": MOST_CPU}), history=False, firings=FIRINGS)


def write(file: Path, files: Sequence[Path]) -> int:
    """Their number."""
    number = 0
    with file.open("wb") as stream:
        for flat in models(files):
            lengths = np.array([len(flat.table), len(flat.constant), len(flat.defaults)], np.int64)
            stream.write(lengths.tobytes() + flat.table.tobytes())
            stream.write(flat.constant.tobytes() + flat.defaults.tobytes())
            number += 1
    return number
