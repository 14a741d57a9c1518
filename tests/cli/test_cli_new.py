"""new: a scene to begin with."""

from __future__ import annotations

from pathlib import Path

import pytest

import planemotion
from planemotion.examples import FIRST, text_of, titles
from tests.cli.calls import invoke, left_in, write


@pytest.mark.parametrize("name", ["swing", "swing.toml"])
def test_it_writes_the_first_example_which_runs(folder: Path, name: str) -> None:
    done = invoke("new", folder / name)
    assert done.exit_code == 0
    assert f"planemotion run {folder / 'swing.toml'}" in done.stdout
    assert left_in(folder) == {"swing.toml"}
    assert (folder / "swing.toml").read_text("utf-8") == text_of(FIRST)
    assert planemotion.load(folder / "swing.toml").run().status == "ok"


def test_a_dot_in_the_name_stays(folder: Path) -> None:
    assert invoke("new", folder / "17.51").exit_code == 0
    assert left_in(folder) == {"17.51.toml"}


def test_it_copies_the_example_that_is_named(folder: Path) -> None:
    done = invoke("new", folder / "many", "--from", "sweep")
    assert done.exit_code == 0
    assert "planemotion sweep" in done.stdout
    assert (folder / "many.toml").read_text("utf-8") == text_of("sweep")


def test_a_name_of_an_example_is_that_example(folder: Path) -> None:
    """`new sweep` wrote the pendulum, which `sweep` then refused."""
    assert "planemotion sweep" in invoke("new", folder / "sweep").stdout
    assert (folder / "sweep.toml").read_text("utf-8") == text_of("sweep")
    assert invoke("new", folder / "find", "--from", "cord").exit_code == 0
    assert (folder / "find.toml").read_text("utf-8") == text_of("cord")


def test_the_kind_that_an_example_shows_is_a_name_of_it() -> None:
    assert text_of("motor") == text_of("slider_crank")


def test_nothing_is_overwritten(folder: Path) -> None:
    write(folder, "mine.toml", "mine")
    done = invoke("new", folder / "mine")
    assert done.exit_code == 2
    assert f"{folder / 'mine.toml'} is there already" in done.stderr
    assert (folder / "mine.toml").read_text("utf-8") == "mine"


def test_the_list_names_every_example_the_first_one_first(folder: Path) -> None:
    lines = invoke("new", "--list").stdout.splitlines()
    assert [line.split()[0] for line in lines] == list(titles())
    assert lines[0].split()[0] == FIRST
    assert {"slider_crank", "incline"} < set(titles())


def test_what_cannot_be_is_told(folder: Path) -> None:
    done = invoke("new", folder / "a", "--from", "pendulam")
    assert done.exit_code == 2
    assert 'there is no example "pendulam"; did you mean "pendulum"?' in done.stderr
    done = invoke("new", folder / "none" / "a")
    assert done.exit_code == 2
    assert f"there is no folder {folder / 'none'}" in done.stderr
    assert left_in(folder) == set()
