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
    folder = ROOT / "build" / f"sanitize-{by.replace(',', '-')}"
    if not (folder / "build.ninja").exists():
        options = ("-Dpython=false", "-Dbuildtype=debug", "-Doptimization=1", "-Dwerror=false")
        command: list[str | Path] = [_MESON, "setup", folder, *options, f"-Db_sanitize={by}"]
        subprocess.run([*command, "-Db_lundef=false"], cwd=ROOT, check=True)
    return _compiled(folder)
