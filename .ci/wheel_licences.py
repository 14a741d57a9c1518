"""Puts the licence texts of the libraries into a wheel that is going to carry them, before auditwheel does.

    python .ci/wheel_licences.py WHEEL

The texts are those of the libraries that the extension module is linked with: what `.ci/libraries` kept of
their sources, or what Debian says of their packages. A library of unknown licence is an error. The expression
in the wheel's metadata then covers all that is in it.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from wheel_libraries import Project, linked, project_of

COMMON = re.compile(r"/usr/share/common-licenses/[\w.-]*\w")


def texts(library: Path, project: Project) -> list[Path]:
    """The files with the licence of a library: beside it below its prefix, or of its Debian package."""
    real = library.resolve()
    kept = real.parent.parent / "share" / "licenses" / project.name
    if kept.is_dir():
        return sorted(kept.iterdir())
    owner = subprocess.run(["dpkg-query", "-S", str(real)], capture_output=True, text=True, check=False)
    said = Path("/usr/share/doc", owner.stdout.partition(":")[0], "copyright")
    if owner.returncode != 0 or not said.is_file():
        raise SystemExit(f"{real}: no licence text in {kept}, and none of a Debian package")
    # Debian's text only names the files of the licences that many packages have.
    return [said, *(Path(name) for name in sorted(set(COMMON.findall(said.read_text(encoding="utf-8")))))]


def collect(root: Path) -> dict[Project, list[Path]]:
    """The texts that an unpacked wheel must carry."""
    found: dict[Project, list[Path]] = {}
    for module in sorted(root.rglob("*.so")):
        for name, place in linked(module).items():
            project = project_of(name)
            if project is None:
                raise SystemExit(
                    f"{module.name} needs {name}, whose licence .ci/wheel_libraries.py does not know"
                )
            if place is None:
                raise SystemExit(f"{module.name} needs {name}, which is not found")
            if project not in found:
                found[project] = texts(place, project)
    if not found:
        raise SystemExit(f"no module in {root.name} is linked with a library")
    return found


def expression(own: str, projects: list[Project]) -> str:
    """The licence of all that is in a wheel: each part once, the project's own first."""
    parts = [own, *(part for project in projects for part in project.licence.split(" AND "))]
    return " AND ".join(dict.fromkeys(parts))


def amend(metadata: str, projects: list[Project], files: list[str]) -> str:
    """The metadata with the licence of the whole, and with the names of the texts."""
    head, gap, body = metadata.partition("\n\n")
    lines = []
    for line in head.splitlines():
        key, _, value = line.partition(": ")
        lines.append(f"{key}: {expression(value, projects)}" if key == "License-Expression" else line)
    return "\n".join([*lines, *(f"License-File: {name}" for name in files)]) + gap + body


def add(wheel: Path) -> list[str]:
    """Changes a wheel in its place; gives the names of the texts that were added."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-m", "wheel", "unpack", "--dest", folder, str(wheel)], check=True)
        (root,) = Path(folder).iterdir()
        (info,) = root.glob("*.dist-info")
        found = collect(root)
        names = []
        for project, files in found.items():
            for file in files:
                name = f"libraries/{project.name}/{file.name}.txt".replace(".txt.txt", ".txt")
                (info / "licenses" / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(file, info / "licenses" / name)
                names.append(name)
        metadata = info / "METADATA"
        metadata.write_text(amend(metadata.read_text(encoding="utf-8"), list(found), names), encoding="utf-8")
        pack = [sys.executable, "-m", "wheel", "pack", "--dest-dir", str(wheel.parent), str(root)]
        subprocess.run(pack, check=True)
    return names


if __name__ == "__main__":
    if len(sys.argv) != 2:
        raise SystemExit(f"usage: python {sys.argv[0]} WHEEL")
    print("wheel: licence texts added:", *add(Path(sys.argv[1])))
