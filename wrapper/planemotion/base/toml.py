"""From a TOML text to its table: what is no TOML, or too much of it, is told with its line."""

from __future__ import annotations

import re
import tomllib
from typing import Any

from .bounded import MOST_LEVELS, check_table
from .errors import SceneError

_FAULT = re.compile(r"(.*) \(at (?:(line \d+), column \d+|end of document)\)")
# Digits beyond which Python reads no integer, and names of a dotted key that take tomllib too long.
_LONG_INTEGER = re.compile(r"\d[\d_]{4000}")
_LONG_KEY = re.compile(r"""(?<!["'\w-])(?:["'\w-]++[ \t]*+\.[ \t]*+){64}""")


def parse_toml(text: str, file: str | None = None) -> dict[str, Any]:
    """The table that a TOML text is, within the bounds of `bounded.check_table`.

    Raises SceneError, with the line where it is no TOML; `file` is named in it.
    """
    try:
        if key := _LONG_KEY.search(text):
            raise SceneError(f"{_line_of(text, key)}: a key more than {MOST_LEVELS} levels deep")
        raw = tomllib.loads(text)
        check_table(raw)
    except tomllib.TOMLDecodeError as error:
        match = _FAULT.fullmatch(str(error))
        last = f"line {len(text.splitlines())}"
        reason = f"{match[2] or last}: {match[1]}" if match else str(error)
        raise SceneError(f"no TOML: {reason}", file=file) from None
    except SceneError as error:
        raise error.at(file=file) from None
    except RecursionError:
        reason = f"tables and lists more than {MOST_LEVELS} levels deep"
        raise SceneError(reason, file=file) from None
    except ValueError as error:  # of Python's numbers and dates
        integer = _LONG_INTEGER.search(text)
        reason = f"{_line_of(text, integer)}: an integer of more than 4000 digits" if integer else str(error)
        raise SceneError(f"no TOML: {reason}", file=file) from None
    return raw


def _line_of(text: str, found: re.Match[str]) -> str:
    return f"line {text.count(chr(10), 0, found.start()) + 1}"
