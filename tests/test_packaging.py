"""What is said of the package in several places agrees, and a wheel carries what it needs."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tomllib
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

import planemotion._kernel as kernel
import wheel_check
import wheel_libraries
import wheel_licences
from tests import ROOT

PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = PYPROJECT["project"]
MESON = (ROOT / "meson.build").read_text(encoding="utf-8")
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
RECIPE = yaml.safe_load((ROOT / ".conda/recipe.yaml").read_text(encoding="utf-8"))
SETTINGS = PYPROJECT["tool"]["cibuildwheel"]

# What conda-forge calls otherwise: its matplotlib brings a graphical interface along.
CONDA_NAMES = {"matplotlib": "matplotlib-base"}
MODULE = Path(kernel.__file__)
# Where the tests run on an installed wheel.
IS_WHEEL = MODULE.parent.with_name("planemotion.libs").is_dir()


def meson(pattern: str) -> str:
    (found,) = re.findall(pattern, MESON)
    return str(found)


def conda(requirement: str) -> str:
    """A requirement of pip as conda writes it."""
    parsed = Requirement(requirement)
    return f"{CONDA_NAMES.get(parsed.name, parsed.name)} {parsed.specifier}".strip()


def minors(names: list[str], pattern: str) -> list[int]:
    """The N of Python 3.N in texts that match a pattern."""
    return [int(match[1]) for name in names if (match := re.fullmatch(pattern, name))]


# ---- what is said twice -----------------------------------------------------------------------------------


def test_the_version_is_the_same_everywhere() -> None:
    said = meson(r"  version: '([\d.]+)'")
    assert "version" in PROJECT["dynamic"]
    assert version("planemotion") == said
    assert CITATION["version"] == said
    assert RECIPE["context"]["version"] == said


def test_the_title_is_the_same_everywhere() -> None:
    name = meson(r"project\(\n  '(\w+)'")
    assert [PROJECT["name"], CITATION["title"], RECIPE["package"]["name"]] == [name] * 3
    assert [CITATION["abstract"], RECIPE["about"]["summary"]] == [PROJECT["description"]] * 2


def test_the_licence_is_the_same_everywhere() -> None:
    licence = meson(r"  license: '([^']+)'")
    assert [PROJECT["license"], CITATION["license"], RECIPE["about"]["license"]] == [licence] * 3


def test_authors_and_keywords_are_the_same_everywhere() -> None:
    assert CITATION["authors"] == PROJECT["authors"]
    assert CITATION["keywords"] == PROJECT["keywords"]
    (author,) = PROJECT["authors"]
    assert f'author = "{author["name"]}"' in (ROOT / "docs/conf.py").read_text(encoding="utf-8")


def test_the_versions_of_python_are_the_same_everywhere() -> None:
    told = minors(PROJECT["classifiers"], r"Programming Language :: Python :: 3\.(\d+)")
    assert told == minors(SETTINGS["build"], r"cp3(\d+)-\*")
    assert PROJECT["requires-python"] == f">=3.{told[0]}"
    assert f'match(python, "<3.{told[0]}")' in RECIPE["build"]["skip"]
    sentence = ", ".join(f"3.{minor}" for minor in told[:-1]) + f" or 3.{told[-1]}"
    assert sentence in (ROOT / "docs/install.md").read_text(encoding="utf-8")


# ---- the recipe of conda ----------------------------------------------------------------------------------


def test_the_recipe_runs_with_what_pip_installs() -> None:
    assert RECIPE["requirements"]["run"] == ["python", *map(conda, PROJECT["dependencies"])]


def test_the_recipe_builds_with_what_pip_and_meson_build_with() -> None:
    gsl = meson(r"dependency\('gsl', version: '([^']+)'")
    sundials = meson(r"sundials_wanted = '([^']+)'")
    klu = meson(r"find_library\('(klu)'")
    assert RECIPE["requirements"]["host"] == [
        "python",
        "pip",
        *map(conda, PYPROJECT["build-system"]["requires"]),
        f"gsl {gsl}",
        f"sundials {sundials}",
        f"lib{klu}",
    ]


# ---- wheels -----------------------------------------------------------------------------------------------


def test_the_scripts_that_cibuildwheel_calls_exist() -> None:
    linux: dict[str, Any] = SETTINGS["linux"]
    calls = " ".join([*linux["before-all"], *linux["repair-wheel-command"], linux["test-command"]])
    scripts = [name for name in re.findall(r"\{project\}/(\S+)", calls) if not name.startswith("build/")]
    assert len(scripts) == 3
    for name in scripts:
        assert (ROOT / name).is_file(), name
        assert name.endswith(".py") or os.access(ROOT / name, os.X_OK), name


def interpreters(named: str, path: str) -> subprocess.CompletedProcess[str]:
    """What .ci/pythons finds: the interpreters for wheels."""
    environment = {**os.environ, "PYTHONS": named, "PATH": path}
    call = [str(ROOT / ".ci/pythons")]
    return subprocess.run(call, capture_output=True, text=True, check=False, env=environment)


def executable(path: Path, script: str) -> str:
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)
    return str(path)


def test_wheels_are_for_the_interpreters_that_are_named_each_version_once() -> None:
    found = interpreters(f"{sys.executable} {sys._base_executable}", os.environ["PATH"])  # type: ignore[attr-defined]
    assert found.stdout.split() == [sys._base_executable], found.stderr  # type: ignore[attr-defined]


def test_an_interpreter_that_is_named_and_cannot_build_is_an_error(tmp_path: Path) -> None:
    old = executable(tmp_path / "python3", "echo 3.9 /usr/bin/python3.9")
    bare = executable(tmp_path / "bare", "echo lacks Python.h; exit 1")
    for name, reason in [(old, "is Python 3.9"), (bare, "lacks Python.h"), ("/nowhere/python3", "/nowhere")]:
        found = interpreters(name, os.environ["PATH"])
        assert found.returncode != 0, name
        assert name in found.stderr
        assert reason in found.stderr
        assert not found.stdout


def test_an_interpreter_that_only_lies_on_the_path_and_does_not_run_is_left_out(tmp_path: Path) -> None:
    newest = minors(PROJECT["classifiers"], r"Programming Language :: Python :: 3\.(\d+)")[-1]
    shim = executable(tmp_path / f"python3.{newest}", "echo this one is not active; exit 127")
    (tmp_path / "more").mkdir()
    good = executable(tmp_path / f"more/python3.{newest}", f"echo 3.{newest} /opt/python")
    found = interpreters("", f"{tmp_path}:{tmp_path / 'more'}:{os.environ['PATH']}")
    assert found.returncode == 0
    assert f"{shim} cannot be used: this one is not active" in found.stderr
    told = found.stdout.split()
    assert "/opt/python" in told or sys.version_info[:2] == (3, newest), good
    assert len(told) == len(set(told))


def test_the_releases_for_wheels_are_recent_enough() -> None:
    sums = (ROOT / ".ci/libraries.sha256").read_text(encoding="utf-8")
    release = dict(re.findall(r"^[0-9a-f]{64}  (\w+)-([\d.]+)\.tar\.gz$", sums, re.MULTILINE))
    assert sorted(release) == ["SuiteSparse", "gsl", "sundials"]
    assert release["gsl"] in SpecifierSet(meson(r"dependency\('gsl', version: '([^']+)'"))
    assert release["sundials"] in SpecifierSet(meson(r"sundials_wanted = '([^']+)'"))


@pytest.mark.parametrize(
    ("library", "owner"),
    [
        ("libgsl.so.27", "gsl"),
        ("libgslcblas-76b62b78.so.0.0.0", "gsl"),
        ("libsundials_ida.so.6", "sundials"),
        ("libsuitesparseconfig.so.5", "suitesparse"),
        ("libgslx.so.1", None),
        ("libopenblas.so.0", None),
    ],
)
def test_libraries_are_known_by_their_names(library: str, owner: str | None) -> None:
    project = wheel_libraries.project_of(library)
    assert (project.name if project else None) == owner


def test_the_kernel_is_linked_with_every_project_and_no_other() -> None:
    projects = {wheel_libraries.project_of(name) for name in wheel_libraries.linked(MODULE)}
    assert projects == set(wheel_libraries.PROJECTS)


@pytest.mark.skipif(shutil.which("dpkg-query") is None, reason="the texts are those of Debian's packages")
@pytest.mark.skipif(IS_WHEEL, reason="a wheel carries the texts already")
def test_the_licence_texts_of_all_projects_are_found(tmp_path: Path) -> None:
    shutil.copy(MODULE, tmp_path)
    found = wheel_licences.collect(tmp_path)
    assert set(found) == set(wheel_libraries.PROJECTS)
    texts = {project.name: "\n".join(map(Path.read_text, files)) for project, files in found.items()}
    assert "GNU GENERAL PUBLIC LICENSE" in texts["gsl"]
    assert "LESSER GENERAL PUBLIC LICENSE" in texts["suitesparse"]
    assert "Redistributions in binary form" in texts["sundials"]


def test_texts_that_were_kept_beside_a_library_are_taken(tmp_path: Path) -> None:
    gsl = wheel_libraries.PROJECTS[0]
    kept = tmp_path / "share/licenses/gsl/COPYING"
    kept.parent.mkdir(parents=True)
    kept.write_text("the text")
    assert wheel_licences.texts(tmp_path / "lib/libgsl.so.27", gsl) == [kept]


def test_a_library_of_unknown_licence_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copy(MODULE, tmp_path)
    monkeypatch.setattr(wheel_licences, "linked", lambda module: {"libopenblas.so.0": Path("/lib")})
    with pytest.raises(SystemExit, match=r"needs libopenblas\.so\.0, whose licence"):
        wheel_licences.collect(tmp_path)


def test_the_metadata_of_a_wheel_cover_all_that_is_in_it() -> None:
    metadata = (
        "Name: x\nLicense-Expression: GPL-3.0-or-later\nLicense-File: LICENSE\n\nLicense-Expression: text\n"
    )
    amended = wheel_licences.amend(metadata, list(wheel_libraries.PROJECTS), ["libraries/gsl/COPYING.txt"])
    assert amended == (
        "Name: x\nLicense-Expression: GPL-3.0-or-later AND BSD-3-Clause AND LGPL-2.1-or-later\n"
        "License-File: LICENSE\nLicense-File: libraries/gsl/COPYING.txt\n\nLicense-Expression: text\n"
    )


@pytest.mark.skipif(IS_WHEEL, reason="the libraries are those of a wheel")
def test_the_check_of_wheels_refuses_libraries_of_the_system() -> None:
    with pytest.raises(SystemExit, match=r"lib\w+\.so\S* is taken from \S+, not from the wheel"):
        wheel_check.check_libraries()
