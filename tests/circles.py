"""Circles of files that need each other, for the tests of the rooms."""

from collections.abc import Mapping


def circles(needs: Mapping[str, set[str]]) -> list[list[str]]:
    """Groups of two and more in which each needs all others, directly or through others.

    `needs` has every name, also those that need nothing.
    """
    reach = {name: _reach(name, needs) for name in needs}
    groups = {frozenset(other for other in reach[name] if name in reach[other]) for name in needs}
    return sorted(sorted(group) for group in groups if len(group) > 1)


def _reach(name: str, needs: Mapping[str, set[str]]) -> set[str]:
    """All that `name` needs, directly or through others."""
    found: set[str] = set()
    waiting = [name]
    while waiting:
        for other in needs[waiting.pop()] - found:
            found.add(other)
            waiting.append(other)
    return found
