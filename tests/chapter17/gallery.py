"""The chapter in figures, and its index page.

python -m tests.chapter17.gallery          writes its page and prints how many answers are right
python -m tests.chapter17.gallery --index  writes the page, studies/chapter17/README.md, only
"""

from __future__ import annotations

import re
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from planemotion.engine.answer import AskValue
from planemotion.engine.result import RunResult
from tests import CHAPTER
from tests.chapter17 import chapter

PAGE = CHAPTER / "README.md"
BOUNDS = (1e-6, 1e-8, 1e-10)
HEAD = """\
# The chapter's scenes

One file per problem; `planemotion run studies/chapter17 --json -` runs all of them,
`make gallery` writes this page. Answers are those of the parameters as written.

| problem | scene | answers |
|---|---|---|
"""
# Of a list of answers the page shows the ends.
_SHOWN = 4


def page() -> str:
    """The index page: a row for each scene."""
    return HEAD + "".join(_row(path) for path in sorted(chapter.SCENES, key=_order))


def _order(path: Path) -> tuple[str, int]:
    """Sample problems, problems, computer problems, each by number."""
    kind, number = re.fullmatch(r"17-(SP|C|)(\d+)", path.stem).groups()  # type: ignore[union-attr]
    return {"SP": "1", "": "2", "C": "3"}[kind], int(number)


def _row(path: Path) -> str:
    data = chapter.load(path).data
    described = " ".join(data.description.split()).replace("|", "\\|")
    asks = chapter.run(path).asks
    units = chapter.scales(asks)
    answers = "<br>".join(f"{key} = {_shown(ask, units[ask.unit])}" for key, ask in asks.items())
    return f"| {data.id} | [{data.title}]({path.name})<br>{described} | {answers} |\n"


def _shown(ask: AskValue, greatest: float) -> str:
    """The answer to five digits; what cancels is 0, so that the page does not show rounding."""
    least = chapter.CANCELS * greatest
    unit = "" if ask.unit == "1" else f" {ask.unit}"
    values = chapter.as_list(ask.value)
    texts = ["none" if value is None else f"{value if abs(value) > least else 0:.5g}" for value in values]
    if len(texts) > _SHOWN:
        texts = [*texts[: _SHOWN - 1], "...", texts[-1]]
    return ", ".join(texts) + unit


def right(results: dict[Path, RunResult], bound: float) -> Iterator[Path]:
    """The scenes whose answers are all within a bound of the reference figures."""
    for path, result in results.items():
        wanted = chapter.reference(result)
        if result.status == "ok" and all(error <= bound for _, error in chapter.errors(result, wanted)):
            yield path


def figures() -> Iterator[str]:
    """Lines of the table of counts and what goes with it."""
    began = time.perf_counter()
    results = {path: chapter.run(path) for path in chapter.SCENES}
    took = time.perf_counter() - began
    known = [path for path, result in results.items() if chapter.reference(result)]
    yield f"{len(results)} scenes, {len(known)} with reference figures; {took:.2f} s to load and run them"
    worst = max(results, key=lambda path: chapter.residual(results[path]))
    yield f"greatest residual of an audit: {chapter.residual(results[worst]):.1e} ({worst.stem})"
    failed = [path.stem for path, result in results.items() if result.status != "ok"]
    yield f"not ok: {', '.join(failed) or 'none'}"
    yield "| route | scenes | " + " | ".join(f"right at {bound:g}" for bound in BOUNDS) + " | seconds |"
    yield "|---|---|" + "---|" * len(BOUNDS) + "---|"
    for route in ("auto", *chapter.TIME_ROUTES):
        yield _count(route, known)
    yield from _weak(known)


def _count(route: str, known: list[Path]) -> str:
    began = time.perf_counter()
    taken = [path for path in known if route == "auto" or not chapter.why_not(path, route)]
    results = {path: chapter.run(path, route) for path in taken}
    took = time.perf_counter() - began
    counts = [str(len(list(right(results, bound)))) for bound in BOUNDS]
    return f"| {route} | {len(taken)} | {' | '.join(counts)} | {took:.1f} |"


def _weak(known: list[Path]) -> Iterator[str]:
    """What is not right at the finest bound, by route, and what a route in time cannot say."""
    for route in ("auto", *chapter.TIME_ROUTES):
        for path in known:
            reason = chapter.why_not(path, route) if route != "auto" else ""
            if reason:
                if reason != chapter.NO_TIME:
                    yield f"{route} {path.stem}: not compared: {reason}"
                continue
            result = chapter.run(path, route)
            for key, error in chapter.errors(result, chapter.reference(result)):
                if not error <= BOUNDS[-1]:
                    yield f"{route} {path.stem}: {key} off by {error:.1e}"


def main() -> None:
    if "--index" not in sys.argv:
        print("\n".join(figures()))
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
