"""The README's examples run as they stand."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import planemotion
from tests import ROOT

BLOCKS = re.findall(r"```(\w+)\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL)


def block(language: str) -> str:
    found = [text for kind, text in BLOCKS if kind == language]
    assert len(found) == 1, f"README.md has {len(found)} {language} examples"
    return found[0]


def test_the_scene_runs(tmp_path: Path) -> None:
    path = tmp_path / "sphere.toml"
    path.write_text(block("toml"), encoding="utf-8")
    result = planemotion.load(path).run()
    assert result.status == "ok"
    assert result.bars_passed == 76  # 17.C3 at d = 2 in: floor(ln((omega0^2 + c)/c)/(-2 ln k))


def test_the_scene_has_ten_lines() -> None:
    assert len(block("toml").strip().splitlines()) == 10


def test_the_python_example_runs(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(ROOT)
    names: dict[str, object] = {}
    exec(compile(block("python"), "README.md", "exec"), names)
    assert "76" in capsys.readouterr().out
    assert names["table"].sizes["d"] == 3  # type: ignore[attr-defined]


def test_every_file_that_it_names_exists() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    names = re.findall(r"(?:docs|studies|kernel)/[\w./]*\w|\w+\.md", text)
    assert "CONTRIBUTING.md" in names
    for name in names:
        assert (ROOT / name).exists(), name
