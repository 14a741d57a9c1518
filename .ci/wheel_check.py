"""Uses an installed wheel as a user would: `.ci/wheel-test` runs this in a clean environment.

It looks at what the extension module is linked with: everything but glibc must come from the wheel. It then
writes a scene, runs it on two routes and sweeps it on two threads; answers are compared with closed forms.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
import tempfile
from contextlib import chdir
from importlib.metadata import files
from importlib.util import find_spec
from pathlib import Path

from wheel_libraries import PROJECTS, linked, project_of

PROGRAM = Path(sys.executable).with_name("planemotion")
# The rod of the examples: 1.2 m long, it falls from the horizontal through a quarter turn.
FALLEN = -math.sqrt(3 * 9.81 / 1.2)
TIMED = """
import time
begin = time.perf_counter()
import planemotion
print(time.perf_counter() - begin)
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


def check_import() -> None:
    call = [sys.executable, "-c", TIMED]
    took = [float(subprocess.run(call, capture_output=True, text=True, check=True).stdout) for _ in range(5)]
    need(min(took) < 0.05, f"import planemotion takes {min(took):.3f} s")
    print(f"wheel-test: import planemotion: {1000 * min(took):.1f} ms")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        check_libraries()
        check_scene()
        check_sweep()
        check_import()
    print("wheel-test: passed")
