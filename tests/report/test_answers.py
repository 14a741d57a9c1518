"""Answers in words: no digit beyond what their errors leave."""

from __future__ import annotations

from pathlib import Path

import pytest

from planemotion import AskValue, load
from planemotion.engine.answer import note_text, value_text
from planemotion.examples import text_of
from tests.cli.calls import invoke, strict_json


@pytest.mark.parametrize(
    ("value", "error", "text", "note"),
    [
        (-3.55e-15, 1.4e-13, "0", "\u00b1 1.4e-13"),
        (8.137e-14, 1.4e-13, "8e-14", "\u00b1 1.4e-13"),
        (-4.95227220576, 9.9e-14, "-4.9522722", "\u00b1 9.9e-14"),
        (-4.95227220576, 9.9e-4, "-4.95227", "\u00b1 9.9e-04"),
        (3.0004, 1.2e-2, "3", "\u00b1 1.2e-02"),
        (123456.789, 2100.0, "123500", "\u00b1 2.1e+03"),
        (12.0, 2100.0, "0", "\u00b1 2.1e+03"),
        (1.5e-300, 1e-308, "1.5e-300", "\u00b1 1.0e-308"),
        (1e-310, 5e-324, "1e-310", "\u00b1 4.9e-324"),
        (0.123456789, 0.0, "0.12345679", "\u00b1 0.0e+00"),
        (0.123456789, None, "0.12345679", ""),
        (None, None, "-", ""),
        ([1e-20, 1.23456], [1e-12, 1e-3], "0, 1.2346", "\u00b1 1.0e-03"),
        ([1e-20, None, 1.23456], None, "1e-20, -, 1.23456", ""),
        ([], None, "-", ""),
    ],
)
def test_a_value_has_the_digits_that_its_error_leaves(
    value: float | list[float | None] | None,
    error: float | list[float | None] | None,
    text: str,
    note: str,
) -> None:
    ask = AskValue(value, "rad", error=error)
    assert (value_text(ask), note_text(ask)) == (text, note)


def test_what_a_terminal_rounds_is_whole_everywhere_else(folder: Path) -> None:
    """Where the rod hangs its end is below its pin, up to rounding."""
    (folder / "a.toml").write_text(text_of("pin") + 'ask.x = { of = "rod.B.x", unit = "m" }\n')
    result = load("a.toml").run()
    x = result.asks["x"]
    assert isinstance(x.value, float)
    assert isinstance(x.error, float)
    assert 0 < abs(x.value) < x.error / 20
    line = next(one for one in invoke("run", "a.toml").stdout.splitlines() if one.split()[:1] == ["x"])
    assert line.split() == ["x", "0", "m", "\u00b1", f"{x.error:.1e}"]
    assert "  x = 0 m" in repr(result).splitlines()
    assert "  x = 0 m" in result.explain().splitlines()
    [entry] = strict_json(invoke("run", "a.toml", "--json", "-").stdout)["scenes"]
    assert entry["asks"]["x"]["value"] == result.x
