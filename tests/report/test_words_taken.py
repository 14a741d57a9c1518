"""The quantities that the reader takes are those of the reference: every word that stands in the sources of
the reader, and every word of the reference, is tried behind each thing that can be asked."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

import planemotion
from planemotion.compile.flatten import flatten
from planemotion.report.meaning import meanings
from tests import ROOT
from tests.report.test_meaning import SCENE

SOURCES = ROOT / "wrapper/planemotion"
# What is asked: an address before the word, and where the reference has the words.
THINGS = [
    ("body.", ("body", "point")),
    ("body.center.", ("point",)),
    ("moved.driven.", ("driven",)),
    ("event.", ("event",)),
    ("energy.", ("energy",)),
    ("spin.", ("spin",)),
    ("modes.", ("modes",)),
    ("modes[1].", ("modes",)),
    ("joint.", ("joint",)),
    ("rolls.", ("joint",)),
    ("turned_by.", ("joint",)),
    ("contact.", ("contact",)),
    ("caught.", ("contact",)),
    ("force.", ("force",)),
    ("cord.", ("coupling",)),
    ("rope.", ("coupling",)),
    ("gears.", ("coupling",)),
    ("motor.", ("coupling",)),
]


def literals(path: Path) -> set[str]:
    """The texts of a module that are one word."""
    return {
        node.value
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
        if re.fullmatch(r"[a-z][a-z_]*", node.value)
    }


def candidates() -> list[str]:
    read = [
        path for room in ("compile", "model", "language", "kinds") for path in SOURCES.glob(f"{room}/*.py")
    ]
    told = {word for groups in meanings().values() for words in groups.values() for word in words}
    return sorted({word for path in read for word in literals(path)} | told)


def taken(before: str, words: list[str]) -> set[str]:
    """The words that the reader takes behind `before`; it tells all others at once."""
    left = list(words)
    while left:
        scene = planemotion.load_text(SCENE)
        for word in left:
            scene.ask(f"q_{word}", of=f"{before}{word}")
        try:
            flatten(scene)
        except planemotion.SceneError as error:
            faults = dict(re.findall(r"ask\.q_(\w+) = (.*)", str(error)))
            refused = {word for word, said in faults.items() if "a part is wanted" not in said}
            if not refused:
                break
            left = [word for word in left if word not in refused]
        else:
            break
    return set(left)


@pytest.mark.parametrize(("before", "groups"), THINGS, ids=[before for before, _ in THINGS])
def test_the_reader_takes_no_quantity_that_the_reference_has_not(
    before: str, groups: tuple[str, ...]
) -> None:
    told = {word for group in groups for word in meanings()["measures"][group]}
    found = taken(before, candidates())
    assert found
    assert found <= told


def test_the_reader_takes_each_quantity_of_the_reference_somewhere() -> None:
    told = {word for group, words in meanings()["measures"].items() if group != "scene" for word in words}
    assert set().union(*(taken(before, sorted(told)) for before, _ in THINGS)) == told
