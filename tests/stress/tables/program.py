"""The program of tests/kernel/tables/: as the package's kernel is built, or under a sanitizer."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from tests import ROOT

_MESON = Path(sys.executable).with_name("meson")
_NAME = "fuzz_tables"


def _compiled(folder: Path) -> Path:
    subprocess.run([_MESON, "compile", "-C", folder, _NAME], check=True, stdout=subprocess.DEVNULL)
    return folder / "tests/kernel/tables" / _NAME


def installed() -> Path:
    """In the folder of `make setup`, with what is built there."""
    return _compiled(ROOT / "build/python")


def sanitized(by: str) -> Path:
    """In the folder of `make sanitize`; by: "address,undefined" or "thread"."""
    options = ("-Dbuildtype=debug", "-Doptimization=1", f"-Db_sanitize={by}")
    return _compiled(_configured(f"sanitize-{by.replace(',', '-')}", options))


def trapping() -> Path:
    """As fast as the package's kernel: what C does not define falls, and what goes beyond a fence."""
    traps = "-Dc_args=-fsanitize=float-cast-overflow -fsanitize-undefined-trap-on-error"
    return _compiled(_configured("trapping", ("-Dbuildtype=release", "-Db_sanitize=undefined", traps)))


def _configured(name: str, options: tuple[str, ...]) -> Path:
    folder = ROOT / "build" / name
    if not (folder / "build.ninja").exists():
        command: list[str | Path] = [_MESON, "setup", folder, "-Dpython=false", "-Dwerror=false", *options]
        subprocess.run([*command, "-Db_lundef=false"], cwd=ROOT, check=True)
    return folder
