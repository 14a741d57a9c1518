"""`python -m tests.stress.files`: sweeps killed at random, and on full disks (a part of `make stress`)."""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
from pathlib import Path

from tests.stress.files.trials import Sweep, full_disk, killed


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=20, help="sweeps that are killed")
    parser.add_argument("--disks", type=int, default=20, help="sweeps on full disks")
    parser.add_argument("--first", type=int, default=0, help="number of the first one")
    given = parser.parse_args()
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        sweep = Sweep.unhurt(Path(folder))
        for word, trial, count in (("killed", killed, given.kills), ("full disk", full_disk, given.disks)):
            for number in range(given.first, given.first + count):
                out = Path(folder, "out")
                if fault := trial(sweep, out, number):
                    faults += 1
                    print(f"{word}, number {number}: {fault}")
                shutil.rmtree(out, ignore_errors=True)
            print(f"{word}: {count} sweeps, faults so far {faults}", flush=True)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
