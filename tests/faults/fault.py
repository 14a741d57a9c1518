"""One planted fault: what it changes in a source of the kernel, and whether it still fits there."""

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Fault:
    """In `file`, `old` becomes `new`; white space in `old` stands for any white space. `old` occurs once."""

    name: str
    file: str
    old: str
    new: str


class Misfit(Exception):
    """A fault whose text does not occur once in the source, or with which it does not compile."""


def planted(source: str, fault: Fault) -> str:
    """The source with the fault in it."""
    pattern = r"\s+".join(re.escape(word) for word in fault.old.split())
    changed, n = re.subn(pattern, lambda _: fault.new, source)
    if n != 1:
        raise Misfit(f"kernel/{fault.file} has {n} places like `{fault.old}`")
    return changed
