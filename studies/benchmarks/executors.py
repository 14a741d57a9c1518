"""Sweeps by executors beside threads: rate, memory of each worker, bytes, and workers that are killed."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from .problems import STUDIES
from .rows import Row
from .tables import Table

CASES, QUICK_CASES = 1_000_000, 50_000
KILLS, QUICK_KILLS = 20, 2
# Seconds between two kills: a new worker has begun to compute, and all fall into the sweep.
PAUSE = 1.0
PROGRAM = """
import hashlib, json, os, resource, signal, sys, threading, time
import planemotion

def peak():
    with open("/proc/self/status") as file:
        return int(next(line.split()[1] for line in file if line.startswith("VmHWM"))) / 1024

def main():
    given = json.loads(sys.argv[1])
    scene = planemotion.load(given["study"])
    grid = {"from": "1 in", "to": "6 in", "num": given["cases"]}
    seen, killed, client = [], 0, None
    if given["who"] != "threads":
        import dask
        from dask.distributed import Client, LocalCluster
        # So long after a death Dask gives up a worker that is starting again: here they die more often.
        dask.config.set({"distributed.deploy.lost-worker-timeout": "10 minutes"})
        cluster = LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
        client = Client(cluster)
        client.run(lambda: planemotion.load_text)  # the package is there before the clock runs
    over = threading.Event()

    def look():
        # The workers that answer: a killed one does not.
        found = client.run(lambda: (os.getpid(), peak()), on_error="ignore").values()
        found = [answer for answer in found if isinstance(answer, tuple)]
        seen.extend(memory for _, memory in found)
        return [pid for pid, _ in found]

    def kill():
        nonlocal killed
        while killed < given["kills"] and not over.wait(given["pause"]):
            pids = look()
            if pids:
                os.kill(pids[killed % len(pids)], signal.SIGKILL)
                killed += 1

    thread = threading.Thread(target=kill, daemon=True)
    thread.start()
    begun = time.perf_counter()
    scene.sweep(out=given["out"], executor=client, workers=1 if client else 2, d=grid)
    taken = time.perf_counter() - begun
    over.set()
    thread.join()
    if client:
        client.wait_for_workers(2)
        look()
        client.close()
        cluster.close()
    memory = max(seen, default=peak())
    digest = hashlib.sha256(open(os.path.join(given["out"], scene.id + ".csv"), "rb").read()).hexdigest()
    print(json.dumps({"seconds": taken, "memory": memory, "main": peak(), "digest": digest, "kills": killed}))

if __name__ == "__main__":
    main()
"""


def tables(rows: Sequence[Row], quick: bool, out: Path) -> list[Table]:
    return [beside_threads(QUICK_CASES if quick else CASES, QUICK_KILLS if quick else KILLS)]


def beside_threads(cases: int, kills: int) -> Table:
    """Two threads, two workers of Dask, and the same with kills: the bytes of the CSV tables are compared."""
    table = Table(
        "executors",
        "Executors beside threads",
        (
            *("who computes", "cases", "s by the clock", "cases/s", "% of the threads' rate"),
            *("most MB of a worker", "MB of the main process", "workers killed", "the same bytes"),
        ),
        text="`Scene.sweep(out=...)` of sphere over bars, d from 1 to 6 in, by two threads, and by two local "
        "worker processes of Dask with a thread each; the last row while workers are killed, one every "
        f"{PAUSE:g} s. The time is that of the whole call: computing, storing, HDF5 and CSV.",
    )
    threads = computed("threads", cases, 0)
    for who, number in (("threads", 0), ("two Dask workers", 0), ("two Dask workers, killed", kills)):
        found = threads if who == "threads" else computed(who, cases, number)
        table.rows.append(
            [
                *(who, cases, found["seconds"], cases / found["seconds"]),
                100 * threads["seconds"] / found["seconds"],
                *(found["memory"], found["main"], found["kills"]),
                "yes" if found["digest"] == threads["digest"] else "NO",
            ]
        )
    return table


def computed(who: str, cases: int, kills: int) -> dict[str, Any]:
    """One sweep in a process of its own."""
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "program.py"
        program.write_text(PROGRAM, encoding="utf-8")
        given = {
            "study": str(STUDIES / "sphere_over_bars.toml"),
            "who": who,
            "cases": cases,
            "out": str(Path(folder) / "out"),
            "kills": kills,
            "pause": PAUSE,
        }
        command = [sys.executable, str(program), json.dumps(given)]
        ended = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
        result: dict[str, Any] = json.loads(ended.stdout.splitlines()[-1])
        return result
