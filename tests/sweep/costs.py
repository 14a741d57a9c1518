"""What a case costs beside its computation, as docs/howto.md says: python -m tests.sweep.costs."""

from __future__ import annotations

import pickle
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from planemotion import load
from planemotion.sweep.cache import Kept
from planemotion.sweep.cases import Study
from planemotion.sweep.forms import Form
from planemotion.sweep.netcdf import write_result
from planemotion.sweep.parts import part_at, write_part
from planemotion.sweep.plan import plan_sweep
from planemotion.sweep.table import write_csv
from tests import ROOT

CASES = 65536


def timed(name: str, action: Callable[[], object], unit: float = 0.0) -> float:
    """Microseconds a case; `unit`: of a thread's computing, of which the part is told."""
    begun = time.perf_counter()
    action()
    spent = 1e6 * (time.perf_counter() - begun) / CASES
    print(
        f"{name:30} {spent:8.3f} us a case" + (f", 1/{unit / spent:.0f} of a thread's time" if unit else "")
    )
    return spent


def main() -> None:
    grid = {"from": "1 in", "to": "6 in", "num": CASES}
    scene = load(ROOT / "studies/sphere_over_bars.toml").grids(d=grid)
    study = Study(scene, plan_sweep(scene), 1, Kept())
    swept = study.plan.block(0, CASES)
    compute = timed("computed by one thread", lambda: study.solver.compute(swept, workers=1))
    block = study.solver.compute(swept, workers=1)
    data = pickle.dumps(block)
    timed(f"received, {len(data) / CASES:.0f} bytes", lambda: pickle.loads(data), compute)
    with tempfile.TemporaryDirectory(dir=ROOT / "build") as name:
        folder = Path(name)
        timed("a part written", lambda: write_part(*part_at(folder, 0, block)), compute)
        told = {**study.attributes(), "manifest": "{}"}
        timed("HDF5", lambda: write_result(folder / "r.h5", study.layout, [block], told), compute)
        timed("CSV", lambda: write_csv(folder / "r.h5", folder / "r.csv"), compute)
        store = Form("zarr", "none", 1 << 14).store(folder / "z", study, resume=False)
        with store:
            timed("a chunk of Zarr", lambda: store.add(0, block), compute)
            timed("Zarr completed", store.complete, compute)  # type: ignore[union-attr]


if __name__ == "__main__":
    main()
