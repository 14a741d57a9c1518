"""The libraries that a wheel carries, and what an extension module is linked with."""

from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Project:
    """A project whose libraries go into the wheel; `libraries` matches their names without lib and .so."""

    name: str
    licence: str
    libraries: str


PROJECTS = (
    Project("gsl", "GPL-3.0-or-later", r"gsl|gslcblas"),
    Project("sundials", "BSD-3-Clause", r"sundials_\w+"),
    Project("suitesparse", "LGPL-2.1-or-later AND BSD-3-Clause", r"klu|btf|amd|colamd|suitesparseconfig"),
)
# What every Linux with glibc has, and no wheel may carry.
GLIBC = r"linux-vdso|ld-linux-x86-64|libc|libm|libpthread|libdl|librt"


def project_of(library: str) -> Project | None:
    """Whose library this is, by its file name (libgsl.so.27, and libgsl-5d02bd0b.so.27 of a wheel)."""
    for project in PROJECTS:
        if re.match(rf"lib({project.libraries})(-[0-9a-f]{{8}})?\.so", library):
            return project
    return None


def linked(module: Path) -> dict[str, Path | None]:
    """The libraries that the loader takes for a module, glibc left out; None: it does not find one."""
    asked = subprocess.run(["ldd", str(module)], capture_output=True, text=True, check=False)
    if asked.returncode != 0:
        raise SystemExit(f"{module.name} cannot be loaded: {asked.stderr.strip() or asked.stdout.strip()}")
    found: dict[str, Path | None] = {}
    for line in asked.stdout.splitlines():
        name, arrow, place = line.strip().partition(" => ")
        if arrow and not re.match(rf"({GLIBC})\.so", name):
            found[name] = None if place.startswith("not found") else Path(place.rsplit(" (", 1)[0])
    return found
