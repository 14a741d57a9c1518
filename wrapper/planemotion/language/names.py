"""Names of more than one word, or with an index: "left.crank", "link[3]", "cell[2,1]".

A dotted text does not show where such a name ends: only who knows the names can take it apart.
"""

from __future__ import annotations

from collections.abc import Collection


class Names:
    """The names of a scene that are more than one plain word."""

    def __init__(self, whole: Collection[str] = ()) -> None:
        self.whole = frozenset(whole)
        self._most = max((name.count(".") + 1 for name in self.whole), default=1)

    def __contains__(self, name: str) -> bool:
        return name in self.whole

    def split(self, dotted: str) -> list[str]:
        """The names in a dotted text, each as long as it can be."""
        words = dotted.split(".")
        if not self.whole:
            return words
        found, first = [], 0
        while first < len(words):
            last = min(len(words), first + self._most)
            while last > first + 1 and ".".join(words[first:last]) not in self.whole:
                last -= 1
            found.append(".".join(words[first:last]))
            first = last
        return found

    def owner(self, text: str) -> tuple[str, str]:
        """What "BODY.MARK" names: the body, and the mark, which is empty where there is none."""
        first = self.split(text)[0]
        return first, text[len(first) + 1 :]


PLAIN_NAMES = Names()
