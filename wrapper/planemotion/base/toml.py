"""From a TOML text to its table: what is not TOML, or too much of it, is told with its line."""

from __future__ import annotations

import re
import tomllib
from typing import Any

from .bounded import MOST_LEVELS, check_table
from .errors import SceneError

_FAULT = re.compile(r"(.*) \(at (?:line (\d+), column (\d+)|end of document)\)", re.DOTALL)
_QUOTED = '; a text stands in quotation marks, also a number with its unit: "1.2 m"'
_GIVEN_TWICE = (
    "given twice: a table or key that stands above is begun anew here; write all of it at one place"
)
# What is given twice: the key or the table with which a line begins, or that of a table within the line.
_BEGUN = re.compile(r"""\s*(\[+[^]]+\]+|[\w."'-]+(?=\s*=))""")
_INLINE_KEY = re.compile(r"Duplicate inline table key '(.*)'")
# How the complaints of tomllib begin -> what is wrong in plain words.
_COMPLAINTS = {
    "Unclosed inline table": f'"," or "}}" is wanted{_QUOTED}',
    "Unclosed array": f'"," or "]" is wanted{_QUOTED}',
    "Expected newline or end of document": f"the end of the line is wanted{_QUOTED}",
    "Invalid value": f"a number, true, false, a text, a list or a table is wanted{_QUOTED}",
    "Invalid statement": 'a line is [a.table], key = value, or a comment behind "#"',
    "Expected '=' after a key": '"=" is wanted behind the key',
    "Expected ']'": '"]" is wanted behind the name of a table',
    "Invalid initial character for a key": (
        "a key is wanted; a table between { } stands in one line, and no comma before its end"
    ),
    "Cannot declare": _GIVEN_TWICE,
    "Cannot overwrite": _GIVEN_TWICE,
    "Cannot redefine": _GIVEN_TWICE,
    "Cannot mutate": _GIVEN_TWICE,
    "Duplicate inline table key": _GIVEN_TWICE,
    "Illegal character": "the quotation mark at the end of a text is missing, or it has a control character",
    "Unterminated string": "the quotation mark at the end of a text is missing",
    'Expected "\'"': "the quotation mark at the end of a text is missing",
    "Unescaped": 'a text in "" has "\\\\" for a backslash; in \'\' it stands as it is',
}
_NO_TOML = "this is not TOML"
# Signs of what stands at a fault that are shown.
_SHOWN = 20
# Digits beyond which Python reads no integer, and names of a dotted key that take tomllib too long.
_LONG_INTEGER = re.compile(r"\d[\d_]{4000}")
_LONG_KEY = re.compile(r"""(?<!["'\w-])(?:["'\w-]++[ \t]*+\.[ \t]*+){64}""")


def parse_toml(text: str, file: str | None = None) -> dict[str, Any]:
    """The table that a TOML text is, within the bounds of `bounded.check_table`.

    Raises SceneError, with the line where it is not TOML; `file` is named in it.
    """
    try:
        if key := _LONG_KEY.search(text):
            raise SceneError(f"a key more than {MOST_LEVELS} levels deep", line=_line_of(text, key))
        raw = tomllib.loads(text)
        check_table(raw)
    except tomllib.TOMLDecodeError as error:
        raise _fault(str(error), text, file) from None
    except SceneError as error:
        raise error.at(file=file) from None
    except RecursionError:
        reason = f"tables and lists more than {MOST_LEVELS} levels deep"
        raise SceneError(reason, file=file) from None
    except ValueError as error:  # of Python's numbers and dates
        integer = _LONG_INTEGER.search(text)
        reason = "an integer of more than 4000 digits" if integer else str(error)
        line = _line_of(text, integer) if integer else None
        raise SceneError(f"{_NO_TOML}: {reason}", file=file, line=line) from None
    return raw


def _fault(complaint: str, text: str, file: str | None) -> SceneError:
    """A complaint of tomllib in plain words, with its place and what stands there."""
    found = _FAULT.fullmatch(complaint)
    lines = text.splitlines() or [""]
    said, line, column = complaint, len(lines), len(lines[-1]) + 1
    if found:
        said = found[1]
        line, column = (int(found[2]), int(found[3])) if found[2] else (line, column)
    reason = next((plain for begin, plain in _COMPLAINTS.items() if said.startswith(begin)), said)
    if reason is _GIVEN_TWICE and (name := _given_twice(said, lines[line - 1], column)):
        reason = f"{name} is {reason}"
    rest = lines[line - 1][column - 1 :].strip() if line <= len(lines) else ""
    shown = rest if len(rest) <= _SHOWN else f"{rest[:_SHOWN]}..."
    here = f", not `{shown}`" if shown else ""
    head, semicolon, tail = reason.partition(";")
    if " wanted" in head:
        reason = f"{head}{here}{semicolon}{tail}"
    return SceneError(f"{_NO_TOML}: {reason}", file=file, line=line, column=column)


def _given_twice(said: str, line: str, column: int) -> str | None:
    """The key or table that a line gives a second time; None: one within a table, which is not told."""
    inline = _INLINE_KEY.match(said)
    before = line[: column - 1]
    if inline or before.count("{") > before.count("}"):
        return inline[1] if inline else None
    begun = _BEGUN.match(line)
    return begun[1] if begun else None


def _line_of(text: str, found: re.Match[str]) -> int:
    return text.count("\n", 0, found.start()) + 1
