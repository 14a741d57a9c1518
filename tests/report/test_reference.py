"""The reference has every word of the language, and the examples run."""

from __future__ import annotations

import re

import pytest

import planemotion
from planemotion.examples import text_of, titles
from planemotion.kinds import KINDS
from planemotion.report.meaning import meanings
from planemotion.report.reference import reference

WORDS = [kind for kinds in KINDS.values() for kind in kinds]
PAGE = reference()


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
    made = planemotion.load_text(text_of(word))
    result = made.run()
    assert result.status == "ok"
    assert result.asks
    groups = [getattr(made.data, group) for group in KINDS]
    assert word in [element.kind for group in groups for element in group.values()]


@pytest.mark.parametrize("name", titles())
def test_every_example_runs_and_says_in_its_first_line_what_it_is(name: str) -> None:
    assert planemotion.load_text(text_of(name)).run().status == "ok"
    assert titles()[name].endswith((".", "?"))
