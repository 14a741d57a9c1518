"""The scenes of docs/ run as they stand, and give what the text beside them says."""

from __future__ import annotations

import doctest
import math
import re
import tomllib
from importlib import import_module
from pathlib import Path
from typing import Any

import gallery_pages
import numpy as np
import pytest
import status_table
from scipy.optimize import least_squares

import planemotion
from planemotion._layout import pm_status
from planemotion.engine.kernel import status_name
from tests import CHAPTER, ROOT

LAWS = re.findall(r"```toml\n(.*?)```", (ROOT / "docs/impact_laws.md").read_text(encoding="utf-8"), re.DOTALL)
HOW_TO = (ROOT / "docs/howto.md").read_text(encoding="utf-8")
PROGRAMS = re.findall(r"```python\n(.*?)```", HOW_TO, re.DOTALL)
KANE, CRADLE, SPHERES, BEAM = LAWS

SCENES = (ROOT / "docs/scenes.md").read_text(encoding="utf-8")
DROPPED = """
until = "floor strikes"
parameters = { e = 0.5, h = "1 m", m = "2 kg" }
ground.lines.floor = { through = [0, 0] }
bodies.ball = { mass = "m", at = [0, "h"] }
contacts.floor = { touch = ["ball", "ground.floor"], restitution = "e" }
"""


def test_the_studies_of_how_a_scene_is_written() -> None:
    tables = tomllib.loads(re.split("## Studies.*?```toml\n", SCENES, flags=re.DOTALL)[1].split("```")[0])
    assert list(tables) == ["sweep", "find", "runs", "solve"]
    dropped = tomllib.loads(DROPPED)

    def scene(asks: dict[str, Any], *names: str) -> planemotion.Scene:
        return planemotion.Scene.from_table(
            {**dropped, "ask": asks, **{name: tables[name] for name in names}}
        )

    assert scene({"v": "ball.speed"}, "sweep").sweep()["v"].sizes == {"e": 11, "h": 3}
    found = scene({"v": "ball.speed/e"}, "find", "solve").run()
    assert found.found["h"].value == pytest.approx(16 / (2 * 9.81), rel=1e-7)
    assert found.route == ("rk",)
    weights = {"of": "ball.weight", "run": "heavy", "unit": "N"}
    assert scene({"w": weights}, "runs").run()["w"] == pytest.approx(5 * 9.81)


def test_the_curves_of_how_a_scene_is_written() -> None:
    """All three ways, as a wire for a bead that slides from its end to its lowest place."""
    ways = re.findall(r"`(\{ (?:x|parabola|points) = .*?\})`", SCENES)
    assert len(ways) == 3
    depths = []
    for way in ways:
        scene = planemotion.load_text(f"""
            until = "bead.velocity.y > 0"
            ground.curves.wire = {way}
            bodies.bead = {{ mass = "1 kg", at = ["-0.9 m", "~0.3 m"] }}
            joints.wire = {{ slot = ["bead", "ground.wire"] }}
            ask = {{ speed = {{ max = "bead.speed" }}, fall = "bead.moved.y" }}
        """)
        result = scene.run()
        assert result["speed"] == pytest.approx(math.sqrt(-2 * 9.81 * float(str(result["fall"]))), rel=1e-6)
        depths.append(result["fall"])
    assert depths[0] == pytest.approx(depths[1], rel=1e-9)


def test_kanes_paradox() -> None:
    limited = planemotion.load_text(KANE).run()
    assert limited.lost == pytest.approx(0, abs=1e-12)
    assert limited.counts["limited_blows"] == 1
    stronge = planemotion.load_text(KANE.replace('"newton"', '"stronge"')).run()
    assert stronge.asks["lost"].value == pytest.approx(0.7169, abs=1e-4)
    assert stronge.counts["limited_blows"] == 0


def test_the_cradle() -> None:
    together = planemotion.load_text(CRADLE).run()
    assert (together.v1, together.v2, together.v3) == pytest.approx((-1 / 3, 2 / 3, 2 / 3), abs=1e-12)
    in_turn = planemotion.load_text(CRADLE + '[solve]\nimpacts = "sequential"\n').run()
    assert (in_turn.v1, in_turn.v2, in_turn.v3) == pytest.approx((0, 0, 1), abs=1e-12)


def test_the_cradle_with_stiffnesses() -> None:
    spheres = planemotion.load_text(SPHERES).run()
    assert (spheres.v1, spheres.v2, spheres.v3) == pytest.approx((-0.071, 0.076, 0.995), abs=5e-4)


def test_the_beam_on_three_supports() -> None:
    least = planemotion.load_text(BEAM).run()
    assert least.asks["at_a"].value == pytest.approx(98.1 * 11 / 26, rel=1e-11)
    without = planemotion.load_text(BEAM.replace('"least"', '"none"')).run()
    assert without.asks["at_a"].value is None
    for result in (least, without):
        assert result.asks["all"].value == pytest.approx(98.1, rel=1e-11)


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.strip().splitlines()[-1])
def test_the_programs_of_the_how_tos_print_what_they_say(
    program: str, capsys: pytest.CaptureFixture[str]
) -> None:
    said = re.findall(r"^print\(.*\)  # (.*)$", program, re.MULTILINE)
    assert said
    exec(compile(program, "howto.md", "exec"), {})
    assert capsys.readouterr().out.splitlines() == said


def test_the_optimum_of_the_how_to_is_the_centre_of_percussion() -> None:
    assert len(PROGRAMS) == 2
    names: dict[str, Any] = {}
    exec(compile(PROGRAMS[0], "howto.md", "exec"), names)
    assert names["best"].x == pytest.approx(2 / 3 * 1.2, abs=1e-5)
    assert names["best"].fun == pytest.approx(0, abs=1e-4)


def test_the_measurements_of_the_how_to_are_a_damped_oscillation() -> None:
    names: dict[str, Any] = {}
    exec(compile(PROGRAMS[1], "howto.md", "exec"), names)
    measured, t = names["measured"], np.arange(names["measured"].size) * 0.1
    assert measured == pytest.approx(_oscillation(t, 200, 4), abs=5.1e-4)
    closed = least_squares(lambda x: _oscillation(t, *x) - measured, [150, 1], x_scale=[100, 1])
    assert names["fit"].x == pytest.approx(closed.x, rel=1e-5)


def test_the_table_of_statuses_has_each_of_the_kernels_once() -> None:
    rows = re.findall(
        r"^\| `(\w+)` \((-?\d+)\) \| [^|]+ \| [^|]+ \|$", status_table.status_table(), re.MULTILINE
    )
    wanted = {status_name(number): str(number) for number in pm_status.values()}
    assert dict(rows) == wanted
    assert len(rows) == len(wanted)


@pytest.mark.parametrize("text", ["ok", "audit"])
def test_a_status_without_a_line_fails_the_build(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    told = status_table.advice()
    for words in told.values():
        words.pop(text, None)
    monkeypatch.setattr(status_table, "advice", lambda: told)
    with pytest.raises(ValueError, match=text):
        status_table.status_table()


def test_every_scene_of_the_chapter_is_in_one_section_of_the_gallery() -> None:
    stems = [path.stem for path in CHAPTER.glob("*.toml")]
    assert set(gallery_pages.MOVING) < set(stems)
    for stem in stems:
        sections = [
            section[0] for section in gallery_pages.SECTIONS if gallery_pages.is_in(stem, *section[2:])
        ]
        assert len(sections) == 1, stem


def test_the_gallery_computes_a_scene_once_and_keeps_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = tmp_path / "17-C5.toml"
    scene.write_text((CHAPTER / scene.name).read_text("utf-8"), "utf-8")
    monkeypatch.setattr(gallery_pages, "KEPT", tmp_path)
    first = gallery_pages.made(scene, b"installed")
    assert first["status"].startswith("`ok`")
    assert [row[0] for row in first["answers"]] == ["ask", *planemotion.load(scene).data.ask]
    assert {Path(name).suffix for name in first["files"].values()} == {".svg", ".html"}
    assert all((tmp_path / name).stat().st_size for name in first["files"])
    monkeypatch.setattr(gallery_pages, "_computed", None)
    assert gallery_pages.made(scene, b"installed") == first
    with pytest.raises(TypeError):
        gallery_pages.made(scene, b"another version")


def _oscillation(t: Any, stiffness: float, rate: float) -> Any:
    """2 kg let go 0.1 m from where its spring is free: damped below the critical rate, in closed form."""
    decay = rate / (2 * 2)
    omega = math.sqrt(stiffness / 2 - decay**2)
    return 0.1 * np.exp(-decay * t) * (np.cos(omega * t) + decay / omega * np.sin(omega * t))


@pytest.mark.parametrize("module", ["scene", "file", "engine.result"])
def test_the_examples_of_the_docstrings_run(
    module: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    flags = doctest.ELLIPSIS
    done = doctest.testmod(import_module(f"planemotion.{module}"), optionflags=flags)
    assert done.attempted > 1
    assert done.failed == 0


def test_the_equations_name_files_that_are_there_and_each_kind_of_constraint() -> None:
    page = (ROOT / "docs/equations.md").read_text(encoding="utf-8")
    named = {name.removeprefix("kernel/") for name in re.findall(r"`([a-z/_]+\.c)`", page)}
    assert len(named) > 50
    assert {name for name in named if not (ROOT / "kernel" / name).is_file()} == set()
    laws = {
        path.name
        for path in (ROOT / "kernel/elements").glob("*.c")
        if re.search(r"^const pm_constraint_ops pm_", path.read_text(encoding="utf-8"), re.MULTILINE)
    }
    assert len(laws) > 8
    assert {f"elements/{name}" for name in laws} - named == set()
