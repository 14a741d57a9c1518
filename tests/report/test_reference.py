"""The reference has every word of the language, and its examples run."""

from __future__ import annotations

import re

import pytest

import planemotion
from planemotion.kinds import KINDS
from planemotion.report.meaning import meanings
from planemotion.report.reference import reference
from tests import ROOT

EXAMPLES = ROOT / "docs/examples"
WORDS = [kind for kinds in KINDS.values() for kind in kinds]
PAGE = reference(lambda word: (EXAMPLES / f"{word}.toml").read_text(encoding="utf-8"))


def test_the_reference_has_every_word_with_its_meaning_once() -> None:
    rows = re.findall(r"^\| `(\w+)` \| (.*?)(?: One of .*?)? \|", PAGE, re.MULTILINE)
    said = [
        (word, " ".join(meaning.says.split()))
        for groups in meanings().values()
        for words in groups.values()
        for word, meaning in words.items()
    ]
    assert sorted(rows) == sorted(said)


def test_defaults_and_choices_are_told() -> None:
    assert re.search(r"^\| `restitution` \|.*\| `0` \|$", PAGE, re.MULTILINE)
    assert re.search(r"^\| `turning` \|.*\| `true` \|$", PAGE, re.MULTILINE)
    assert re.search(r"^\| `center` \|.*\| \[0, 0\] \|$", PAGE, re.MULTILINE)
    assert re.search(r"^\| `only` \|.*One of `push`, `pull`\. \|.*\| both \|$", PAGE, re.MULTILINE)
    assert re.search(r"^\| `until` \|.*\| it must be given \|$", PAGE, re.MULTILINE)


@pytest.mark.parametrize("word", WORDS)
def test_the_example_of_a_kind_has_it_and_runs(word: str) -> None:
    made = planemotion.load(EXAMPLES / f"{word}.toml")
    result = made.run()
    assert result.status == "ok"
    assert result.asks
    groups = [getattr(made.data, group) for group in KINDS]
    assert word in [element.kind for group in groups for element in group.values()]


@pytest.mark.parametrize("study", sorted(path.name for path in (EXAMPLES / "studies").glob("*.toml")))
def test_the_studies_of_the_tutorial_run(study: str) -> None:
    assert planemotion.load(EXAMPLES / "studies" / study).run().status == "ok"


def test_every_example_is_of_a_kind() -> None:
    assert {path.stem for path in EXAMPLES.glob("*.toml")} == set(WORDS)
