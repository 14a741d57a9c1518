"""`python -m tests.stress.tables`: tables of the studies changed at random, in a kernel under ASan and UBSan.

A part of `make stress`.  --fast changes them in a kernel that is as fast as the package's and traps what C
does not define: some 3 ms each instead of ten.  --valid runs them as they are, in valgrind;
--threads in a kernel under TSan, in several batches at the same time.  --only does one of the changes again.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from pathlib import Path

from tests import ROOT
from tests.stress.tables.corpus import scenes, write
from tests.stress.tables.program import installed, sanitized, trapping

# A change may ask for more memory than there is: the allocator says no, as it does without a sanitizer.
_MEMORY = "allocator_may_return_null=1:max_allocation_size_mb=2000"
LIMITS = {
    "ASAN_OPTIONS": f"halt_on_error=1:abort_on_error=1:{_MEMORY}",
    "UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1",
    "TSAN_OPTIONS": "halt_on_error=1",
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=20_000, help="how many are changed")
    parser.add_argument("--first", type=int, default=0, help="number of the first one")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--only", type=int, help="do this change again")
    parser.add_argument(
        "--fast", action="store_true", help="traps instead of sanitizers, three times as fast"
    )
    parser.add_argument("--valid", action="store_true", help="the models as they are, in valgrind")
    parser.add_argument("--threads", action="store_true", help="the models as they are, under TSan")
    given = parser.parse_args()
    corpus = ROOT / "build/stress/tables.bin"
    corpus.parent.mkdir(parents=True, exist_ok=True)
    write(corpus, scenes())
    if given.valid:
        return valgrind(corpus)
    program = trapping() if given.fast else sanitized("thread" if given.threads else "address,undefined")
    arguments = [str(given.first), str(given.count), str(given.jobs)]
    if given.only is not None:
        arguments = ["--only", str(given.only)]
    elif given.threads:
        arguments = ["--threads"]
    return subprocess.run([program, corpus, *arguments], env=os.environ | LIMITS, check=False).returncode


def valgrind(corpus: Path) -> int:
    """Reads of what was never written, too, which ASan does not see."""
    if shutil.which("valgrind") is None:
        print("valgrind is not installed; on Debian: apt-get install valgrind")
        return 1
    options = ("--quiet", "--error-exitcode=9", "--leak-check=full", "--errors-for-leak-kinds=definite")
    command: list[str | Path] = ["valgrind", *options, installed(), corpus, "--valid"]
    return subprocess.run(command, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
