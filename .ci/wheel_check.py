"""Uses an installed wheel as a user would: `.ci/wheel-test` runs this in a clean environment.

    python wheel_check.py          what planemotion does with nothing beside it
    python wheel_check.py --fmu    what FMPy, which must be installed, does with an FMU that planemotion wrote

It looks at what the extension module is linked with: everything but glibc must come from the wheel. It then
writes a scene, runs it on two routes, sweeps it on two threads, draws and animates it, and sweeps a study;
answers are compared with closed forms.
"""

from __future__ import annotations

import json
import math
import shutil
import subprocess
import sys
import tempfile
from contextlib import chdir
from importlib.metadata import files
from importlib.util import find_spec
from pathlib import Path

from wheel_libraries import PROJECTS, linked, project_of

PROGRAM = Path(sys.executable).with_name("planemotion")
STUDIES = Path(__file__).resolve().parent.parent / "studies"
# The rod of the examples: 1.2 m long, it falls from the horizontal through a quarter turn.
FALLEN = -math.sqrt(3 * 9.81 / 1.2)
TIMED = """
import time
begin = time.process_time()
import planemotion
print(time.process_time() - begin)
"""


def need(holds: bool, what: str) -> None:
    if not holds:
        raise SystemExit(f"wheel-test: FAILED: {what}")


def command(*words: str) -> str:
    done = subprocess.run([str(PROGRAM), *words], capture_output=True, text=True, check=False)
    need(done.returncode == 0, f"planemotion {' '.join(words)}: {done.stderr or done.stdout}")
    return done.stdout


def check_libraries() -> None:
    spec = find_spec("planemotion")
    need(spec is not None and spec.origin is not None, "planemotion is not installed")
    assert spec is not None
    assert spec.origin is not None
    package = Path(spec.origin).parent
    need(package.is_relative_to(sys.prefix), f"planemotion is taken from {package}, not from the wheel")
    (module,) = package.glob("_kernel.*.so")
    carried = package.with_name("planemotion.libs")
    projects = set()
    for name, place in linked(module).items():
        need(place is not None, f"{name} is nowhere to be found")
        assert place is not None
        need(place.resolve().parent == carried, f"{name} is taken from {place}, not from the wheel")
        projects.add(project_of(name))
    for project in PROJECTS:
        need(project in projects, f"no library of {project.name} is in the wheel")
        texts = [
            path for path in files("planemotion") or [] if f"licenses/libraries/{project.name}/" in str(path)
        ]
        need(bool(texts), f"no licence text of {project.name} is in the wheel")
    print("wheel-test: from the wheel:", *sorted(linked(module)))


def check_scene() -> None:
    command("new", "swing")
    for words in ([], ["--set", "solve.route=ida"]):
        (scene,) = json.loads(command("run", "swing.toml", "--json", "-", *words))["scenes"]
        value = scene["asks"]["omega_before"]["value"]
        need(scene["status"] == "ok", f"a scene ends as {scene['status']}")
        need(math.isclose(value, FALLEN, rel_tol=1e-8), f"a scene gives {value}, not {FALLEN}")
        print(f"wheel-test: a scene by route {scene['route'][0]}: {value}")


def check_sweep() -> None:
    import xarray  # not before the libraries are known to be those of the wheel

    command("new", "restitutions", "--from", "sweep")
    command("sweep", "restitutions.toml", "--out", "swept", "--workers", "2")
    (result,) = Path("swept").glob("*.h5")
    with xarray.open_dataset(result, engine="h5netcdf") as table:
        error = float(abs(table["omega_after"] + table["e"] * FALLEN).max())
        need(table.sizes["e"] == 10, f"a sweep has {table.sizes['e']} cases, not 10")
        need(error < 1e-8, f"a sweep is wrong by {error}")
    print("wheel-test: a sweep of 10 cases on 2 threads")


def above_next_bar(d: float) -> float:
    """omega (rad/s) of the sphere of studies/sphere_over_bars.toml straight above bar B, d inches on.

    It rolls about bar A until it strikes B (energy), keeps its angular momentum about B, and rolls on.
    """
    g, r, omega = 32.2 * 12, 10, 1.5
    half = math.asin(d / (2 * r))
    drop = 2 * g * (1 - math.cos(half)) / (1.4 * r)
    struck = math.sqrt(omega**2 + drop) * (0.4 + math.cos(2 * half)) / 1.4
    return math.sqrt(struck**2 - drop)


def check_study() -> None:
    import xarray

    shutil.copy(STUDIES / "sphere_over_bars.toml", ".")
    command("sweep", "sphere_over_bars.toml", "--out", "study")
    with xarray.open_dataset("study/sphere_over_bars.h5", engine="h5netcdf") as table:
        need(table["d"].units == "in", f"a study keeps its d in {table['d'].units}")
        need(table.sizes["d"] == 501, f"a study has {table.sizes['d']} cases, not 501")
        pairs = zip(table["omega_B"].values, map(above_next_bar, table["d"].values), strict=True)
        error = max(abs(found / expected - 1) for found, expected in pairs)
    need(error < 1e-9, f"a study differs from its closed form by {error}")
    print("wheel-test: a study of 501 cases")


def check_pictures() -> None:
    begun = {
        ".png": b"\x89PNG\r\n",
        ".svg": b"<?xml",
        ".pdf": b"%PDF-",
        ".html": b"<!doctype html>",
    }
    for ending, begin in begun.items():
        picture = Path(f"picture{ending}")
        command("animate" if ending == ".html" else "draw", "swing.toml", "--out", str(picture))
        text = picture.read_bytes()
        need(text.lower().startswith(begin.lower()), f"{picture} begins with {text[:20]!r}")
        print(f"wheel-test: {picture}: {len(text)} bytes")


def check_fmu() -> None:
    """An FMU of the falling rod: valid, and its energy is that of a rod that falls freely."""
    from fmpy import simulate_fmu
    from fmpy.validation import validate_fmu

    command("new", "swing")
    command(
        "export-fmu", "swing.toml", "--out", "swing.fmu", "--quantity", "rod.omega", "--quantity", "rod.angle"
    )
    problems = validate_fmu("swing.fmu")
    need(problems == [], f"FMPy finds faults of an FMU: {problems}")
    table = simulate_fmu("swing.fmu", stop_time=0.3)
    falls = 3 * 9.81 / 1.2
    error = max(abs(row["rod.omega"] ** 2 + falls * math.sin(row["rod.angle"])) for row in table)
    need(len(table) > 100, f"FMPy computes {len(table)} points")
    need(abs(table[-1]["rod.omega"]) > 1, "the rod of an FMU does not move")
    need(error < 1e-6, f"the energy of an FMU is wrong by {error}")
    print(f"wheel-test: FMPy runs an FMU of {Path('swing.fmu').stat().st_size} bytes: {len(table)} points")


def check_import() -> None:
    call = [sys.executable, "-c", TIMED]
    took = [float(subprocess.run(call, capture_output=True, text=True, check=True).stdout) for _ in range(5)]
    need(min(took) < 0.05, f"import planemotion takes {min(took):.3f} s of a core")
    print(f"wheel-test: import planemotion: {1000 * min(took):.1f} ms of a core")


CHECKS = {
    (): (check_libraries, check_scene, check_sweep, check_study, check_pictures, check_import),
    ("--fmu",): (check_libraries, check_fmu),
}

if __name__ == "__main__":
    checks = CHECKS.get(tuple(sys.argv[1:]))
    if checks is None:
        raise SystemExit(f"usage: python {sys.argv[0]} [--fmu]")
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        for check in checks:
            check()
    print("wheel-test: passed")
