"""What the words of the language mean, as model/meaning.toml says it: for the schema and the reference."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources

from ..model.element import Element, Kind, Table


@dataclass(frozen=True)
class Meaning:
    """What a word says, the SI unit of the number behind it, and what is taken where it is left out."""

    says: str
    unit: str = ""
    without: str = ""

    @property
    def text(self) -> str:
        """All of it in one line."""
        unit = f" [{self.unit}]" if self.unit else ""
        without = f" Without it: {self.without}." if self.without else ""
        return f"{self.says}{unit}{without}"


@cache
def meanings() -> Mapping[str, Mapping[str, Mapping[str, Meaning]]]:
    """All words: by chapter ("tables", "kinds", "measures", "words"), and group ("Body", "pin", "point")."""
    text = resources.files("planemotion.model").joinpath("meaning.toml").read_text(encoding="utf-8")
    return {
        chapter: {
            group: {word: Meaning(**said) for word, said in words.items()} for group, words in groups.items()
        }
        for chapter, groups in tomllib.loads(text).items()
    }


def meaning_of(model: type[Table], key: str) -> Meaning:
    """The meaning of a key of a table, or of an element of some kind.

    What a table takes from another one, as a swept parameter from a grid, has its meaning there.

    Raises KeyError for a word that has none.
    """
    if issubclass(model, Kind):
        if key in Element.model_fields:
            return meanings()["tables"]["Element"][key]
        return meanings()["kinds"][model.word][key]
    said = meanings()["tables"]
    homes = [base.__name__ for base in model.__mro__ if key in said.get(base.__name__, {})]
    if not homes:
        raise KeyError(key)
    return said[homes[0]][key]
