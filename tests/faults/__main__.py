"""Plants faults in a copy of the kernel, one at a time, and expects its tests to catch each of them.

    python -m tests.faults               all faults (`make faults`)
    python -m tests.faults gamma ida     those whose name or file has one of these words
    python -m tests.faults --first       no more than one test that catches each: a fifth of the time
    python -m tests.faults --jobs 1      that many at once, instead of one for each core

What is printed tells what caught each fault: names of tests, "audit" where a run said by itself that it
cannot be trusted, "routes" where two routes disagreed. A fault that nothing catches, or that no longer fits
its source, makes the exit status 1.
"""

import argparse
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tests import ROOT
from tests.faults import FAULTS
from tests.faults.fault import Fault, Misfit, planted

COMPILER = os.environ.get("CC", "gcc")
FLAGS = ["-std=gnu11", "-O1", "-ffp-contract=off", "-fno-math-errno", "-D_GNU_SOURCE", "-UNDEBUG", "-w"]
LIBRARIES = os.environ.get("FAULTS_LIBRARIES", "-lgsl -lgslcblas -lsundials_ida -lklu -lm -lpthread").split()
TEST_SECONDS = 30  # of the processor: a test that takes longer hangs; the slowest needs ten on a busy machine
WAIT_SECONDS = 20 * TEST_SECONDS  # of the clock: a test that waits for ever hangs too, without using any
MESSAGE = 2000  # characters of a compiler's message that are worth showing
SOUND = ".sound"  # the object of a source without a fault, while another stands in its place
AUDIT = "-10, expected 0"  # how check.h prints a run that ended with PM_AUDIT


def run(command: list[str]) -> None:
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode:
        raise Misfit(" ".join(command) + "\n" + result.stderr[:MESSAGE])


class Workshop:
    """A copy of the kernel with its objects, and the tests as objects; a pool of threads shares the work."""

    def __init__(self, folder: Path, pool: ThreadPoolExecutor, first: bool) -> None:
        self.pool = pool
        self.first = first
        self.caught: Counter[tuple[str, str]] = Counter()  # faults of a source, by a test
        self.kernel = folder / "kernel"
        shutil.copytree(ROOT / "kernel", self.kernel)
        self.sources = sorted(path.relative_to(self.kernel).as_posix() for path in self.kernel.rglob("*.c"))
        listed = (ROOT / "tests/kernel/meson.build").read_text(encoding="utf-8")
        self.tests = re.findall(r"^  '(\w+)',$", listed, re.MULTILINE)
        self.objects = folder
        list(pool.map(self.compile, self.sources))
        list(
            pool.map(
                lambda name: self.compile_to(ROOT / f"tests/kernel/{name}.c", folder / f"test_{name}.o"),
                self.tests,
            )
        )

    def compile_to(self, source: Path, target: Path) -> None:
        run([COMPILER, *FLAGS, f"-I{self.kernel}", "-c", str(source), "-o", str(target)])

    def compile(self, name: str) -> None:
        self.compile_to(self.kernel / name, self.object_of(name))

    def object_of(self, name: str) -> Path:
        return self.objects / f"kernel_{Path(name).stem}.o"

    def users(self, file: str) -> list[str]:
        """What must be compiled again when `file` changes."""
        if file.endswith(".c"):
            return [file]
        headers = {file}
        files = list(self.kernel.rglob("*.[ch]"))
        texts = {path.relative_to(self.kernel).as_posix(): path.read_text(encoding="utf-8") for path in files}
        while (
            users := {
                name for name, text in texts.items() if any(f'"{header}"' in text for header in headers)
            }
            - headers
        ):
            headers |= users
        return sorted(name for name in headers if name.endswith(".c"))

    def findings(self, name: str) -> list[str]:
        """What test `name` has to say: nothing, or its name and what else it noticed."""
        program = self.objects / f"test_{name}"
        objects = [str(self.object_of(source)) for source in self.sources]
        run([COMPILER, str(program) + ".o", *objects, "-o", str(program), *LIBRARIES])
        try:
            result = subprocess.run(
                ["sh", "-c", f"ulimit -t {TEST_SECONDS}; exec {program}"],
                capture_output=True,
                text=True,
                errors="replace",
                timeout=WAIT_SECONDS,
            )
        except subprocess.TimeoutExpired:
            return [f"{name} (waits)"]
        if result.returncode == 0:
            return []
        stopped = result.returncode in (-signal.SIGXCPU, -signal.SIGKILL)
        if stopped and not result.stderr:  # else it has failed before
            return [f"{name} (hangs)"]
        noticed = ["audit"] if AUDIT in result.stderr else []
        noticed += ["routes"] if ": routes_agree: " in result.stderr else []
        return [*noticed, name]

    def time_tests(self) -> list[str]:
        """What the tests find in the sound kernel; from then on quick ones are tried before slow ones."""
        seconds = {}
        found = []
        for name in self.tests:
            begun = resource.getrusage(resource.RUSAGE_CHILDREN)
            found += self.findings(name)
            ended = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds[name] = ended.ru_utime - begun.ru_utime
        self.tests.sort(key=lambda name: seconds[name])
        return found

    def check(self, file: str) -> list[str]:
        """What the tests find now that `file` is changed; the audit and the comparison of routes come first.

        Tests that have caught much in this file are tried before others.
        """
        found: set[str] = set()
        tests = sorted(self.tests, key=lambda name: -self.caught[file, name])
        for name, words in zip(tests, self.pool.map(self.unless_found(found), tests), strict=True):
            found.update(words)
            self.caught[file, name] += bool(words)
        return sorted(found, key=lambda word: (word not in ("audit", "routes"), word))

    def unless_found(self, found: set[str]) -> Callable[[str], list[str]]:
        """`findings`, or nothing as soon as one test is enough and has failed: one that hangs tells less."""

        def look(name: str) -> list[str]:
            failed = any(not word.endswith(")") for word in found)
            words = [] if self.first and failed else self.findings(name)
            found.update(words)
            return words

        return look

    def plant(self, fault: Fault) -> list[str]:
        path = self.kernel / fault.file
        sound = path.read_text(encoding="utf-8")
        changed = planted(sound, fault)
        users = [(name, self.object_of(name)) for name in self.users(fault.file)]
        for _, built in users:
            built.rename(built.with_suffix(SOUND))
        path.write_text(changed, encoding="utf-8")
        try:
            list(self.pool.map(self.compile, [name for name, _ in users]))
            return self.check(fault.file)
        finally:
            path.write_text(sound, encoding="utf-8")
            for _, built in users:
                built.with_suffix(SOUND).replace(built)


def options() -> argparse.Namespace:
    asked = argparse.ArgumentParser(description="plants faults in a copy of the kernel, one at a time")
    asked.add_argument("words", nargs="*", help="only faults whose name or file has one of these")
    asked.add_argument("--first", action="store_true", help="no more than one test that catches each")
    asked.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers and tests at once")
    return asked.parse_args()


def main() -> int:
    asked = options()
    faults = [
        fault
        for fault in FAULTS
        if not asked.words or any(word in f"{fault.name} {fault.file}" for word in asked.words)
    ]
    survivors = 0
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(asked.jobs) as pool:
        workshop = Workshop(Path(folder), pool, asked.first)
        found = workshop.time_tests()
        if found:
            sys.exit(f"the tests fail without any fault: {', '.join(found)}")
        for fault in faults:
            try:
                found = workshop.plant(fault)
                verdict = ", ".join(found) or "NOTHING"
            except Misfit as misfit:
                found, verdict = [], f"DOES NOT FIT: {misfit}"
            survivors += not found
            print(f"{fault.name}: {verdict}", flush=True)
    print(f"{len(faults)} faults, {len(faults) - survivors} caught")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
