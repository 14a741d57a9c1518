"""What a sweep will take, from a sample of its cases that is computed: a dry run.

The sample is spread evenly over all cases, by steps of the golden ratio.  It is computed in batches, whose
rates tell how far the time can be trusted.  The time is that of computing; to write the
files takes somewhat more.
"""

from __future__ import annotations

import math
import os
import resource
import shutil
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..base.errors import StudyError
from .block import Block
from .cache import Kept
from .cases import Study
from .costs import Costly, Costs
from .layout import STATUS_WORDS
from .plan import plan_sweep
from .size import EXTRA, Size, expected_size

if TYPE_CHECKING:
    from ..reading.scene import WrittenScene

# Seconds of computing after which the sample is large enough, and its cases and batches at most.
_SECONDS = 2.0
_MOST_CASES = 4096
_BATCHES = 16
_GOLDEN = (math.sqrt(5) - 1) / 2
# Blocks in memory at once: one that is computed, one that is stored and its bytes.
_BLOCKS = 3


@dataclass(frozen=True)
class Estimate:
    """What a sweep will take.

    `sample`: cases that were computed, and `statuses` how they ended, in words; `seconds` of computing all on
    `workers` threads, with their standard error (not-a-number for one batch); `memory`: bytes; `size` on the
    disk, `way`: bytes on the way, `free`: there; `costliest` of the sample: see costs.py.
    """

    size: Size
    workers: int
    sample: int
    statuses: Mapping[str, int]
    seconds: float
    error: float
    memory: int
    way: int
    free: int
    costliest: Sequence[Costly]


def estimate(
    scene: WrittenScene, *, workers: int | None = None, out: str | os.PathLike[str] = "."
) -> Estimate:
    """Computes a sample of the cases of the scene's [sweep], some seconds long; no file is left.

    `out`: the folder whose disk is looked at.  Raises SceneError as a sweep does.
    """
    if workers is not None and workers < 1:
        raise StudyError(f"workers = {workers}: at least 1 is needed")
    study = Study(scene, plan_sweep(scene), workers or len(os.sched_getaffinity(0)), Kept())
    size = expected_size(study.layout)
    numbers, blocks = _sample(study)
    whole = Block.join(blocks)
    mean = whole.seconds / len(whole)
    words = Counter(STATUS_WORDS.get(code, f"status {code}") for code in whole.status.tolist())
    return Estimate(
        size,
        study.workers,
        len(whole),
        dict(words),
        mean * size.cases,
        _error(blocks) * size.cases,
        _memory(study, size),
        EXTRA * size.result,
        _free(Path(out)),
        _costliest(study, numbers, whole.solves),
    )


def _sample(study: Study) -> tuple[npt.NDArray[np.int64], list[Block]]:
    """Numbers [n] of cases, and their results."""
    numbers: list[npt.NDArray[np.int64]] = []
    blocks: list[Block] = []
    begun = time.perf_counter()
    for batch in _batches(study.plan.cases, study.workers):
        numbers.append(batch)
        blocks.append(study.solver.compute(study.plan.rows(batch), workers=study.workers))
        if time.perf_counter() - begun > _SECONDS and len(blocks) > 1:
            break
    if len(blocks) > 1:  # the first one pays for what is done once
        begins = blocks[0].seconds / len(blocks[0]) > 2 * blocks[1].seconds / len(blocks[1])
        numbers, blocks = numbers[begins:], blocks[begins:]
    return np.concatenate(numbers), blocks


def _batches(cases: int, workers: int) -> Iterator[npt.NDArray[np.int64]]:
    """Different cases, spread over all: small batches first, so that slow cases are not too many."""
    seen: set[int] = set()
    most = min(cases, _MOST_CASES)
    place, size = 0.5, workers
    while len(seen) < most:
        batch: list[int] = []
        while len(batch) < size and len(seen) < most:
            place = (place + _GOLDEN) % 1
            number = _free_number(int(place * cases), cases, seen)
            seen.add(number)
            batch.append(number)
        yield np.array(batch, np.int64)
        size = min(2 * size, max(workers, _MOST_CASES // _BATCHES))


def _free_number(number: int, cases: int, seen: set[int]) -> int:
    while number in seen:
        number = (number + 1) % cases
    return number


def _error(blocks: Sequence[Block]) -> float:
    """The standard error of the mean time of a case, from how it differs from batch to batch."""
    if len(blocks) < 2:
        return math.nan
    cases = np.array([len(block) for block in blocks])
    seconds = np.array([block.seconds for block in blocks])
    rest = seconds - cases * seconds.sum() / cases.sum()
    return float(math.sqrt(len(blocks) / (len(blocks) - 1) * (rest @ rest)) / cases.sum())


def _memory(study: Study, size: Size) -> int:
    """Of the process: what it has had until now, and the blocks of a sweep into files."""
    now = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    of_case = size.result / size.cases
    return int(now + _BLOCKS * of_case * min(study.max_chunk, size.cases))


def _free(folder: Path) -> int:
    place = next(parent for parent in (folder.absolute(), *folder.absolute().parents) if parent.exists())
    return shutil.disk_usage(place).free


def _costliest(study: Study, numbers: npt.NDArray[np.int64], solves: npt.NDArray[Any]) -> tuple[Costly, ...]:
    costs = Costs()
    costs.add_cases(numbers, solves)

    def values_of(case: int) -> str:
        return ", ".join(f"{name} = {value}" for name, value in study.plan.case(case).items())

    return costs.found(values_of)
