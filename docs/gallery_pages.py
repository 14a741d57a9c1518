"""The gallery of the chapter: its pages are written before Sphinx reads the documents.

Each scene of studies/chapter17 is run and drawn, in one process.  What that gives is kept in build/gallery
under a checksum of the scene and of the installed package: what has not changed is not computed again.
The pages go to docs/gallery, the pictures and animations beside the pages in the output.
"""

from __future__ import annotations

import hashlib
import json
import re
import shutil
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any

import planemotion
from planemotion.base.versions import versions
from planemotion.engine.result import answer_rows, trust_text

HERE = Path(__file__).parent
SCENES = HERE.parent / "studies" / "chapter17"
PAGES = HERE / "gallery"
KEPT = HERE.parent / "build" / "gallery"
# Name of the page, its title, and the first and last number of its problems.
SECTIONS = (
    ("samples", "Sample problems", "SP", 1, 99),
    ("energy", "Work and energy", "", 1, 51),
    ("momentum", "Impulse and momentum", "", 52, 95),
    ("impact", "Eccentric impact", "", 96, 134),
    ("review", "Review problems", "", 135, 146),
    ("computer", "Computer problems", "C", 1, 99),
)
MOVING = (
    *("17-SP03", "17-SP04", "17-SP05", "17-SP07", "17-SP08", "17-SP11"),
    *("17-011", "17-020", "17-145", "17-C1", "17-C3", "17-C5"),
)
HEAD = """\
# Gallery of the chapter

The scenes of a textbook chapter on energy and momentum of rigid bodies in plane motion: {count} problems,
one file each, in `studies/chapter17`. The pictures and answers were made when these pages were built, by the
parameters as they are written. {ok} of {count} runs end as `ok`. What error and status say:
[How far to trust an answer](../trust.md).

Each scene has its text below its answers, to be opened. Some have a player of the motion, too.

| section | scenes | with a player |
|---|---|---|
"""
ENTRY = """\
## {id} {title}

{description}

```{{raw}} html
<img class="made" loading="lazy" src="../made/chapter17/{stem}.svg" alt="{alt}">
```

| {head} |
|---|---|---|---|
{answers}

Status: {status}

{notes}```{{raw}} html
<details class="scene"><summary>Scene: {stem}.toml</summary>
```
```{{literalinclude}} ../../studies/chapter17/{stem}.toml
:language: toml
```
```{{raw}} html
</details>
```
{animation}
"""
ANIMATION = """\
```{{raw}} html
<details class="scene"><summary>Animation</summary>
<iframe class="made" loading="lazy" src="../made/chapter17/{stem}.html" title="{alt}, in motion"></iframe>
<p><a href="../made/chapter17/{stem}.html">The animation as a page of its own</a></p></details>
```
"""


def write_pages(out: Path) -> None:
    """Writes the pages, and their pictures into a folder of the output."""
    PAGES.mkdir(exist_ok=True)
    KEPT.mkdir(parents=True, exist_ok=True)
    out.mkdir(parents=True, exist_ok=True)
    installed = _installed()
    entries = {path.stem: made(path, installed) for path in sorted(SCENES.glob("*.toml"))}
    for entry in entries.values():
        for kept, name in entry["files"].items():
            shutil.copy(KEPT / kept, out / name)
    for old in set(KEPT.iterdir()) - {KEPT / name for name in _in_use(entries)}:
        old.unlink()
    index = [HEAD.format(count=len(entries), ok=sum(entry["ok"] for entry in entries.values()))]
    for name, title, kind, first, last in SECTIONS:
        stems = [stem for stem in entries if is_in(stem, kind, first, last)]
        text = "\n".join([f"# {title}\n", *(_entry(stem, entries[stem]) for stem in stems)])
        (PAGES / f"{name}.md").write_text(text, encoding="utf-8")
        moving = ", ".join(entries[stem]["id"] for stem in stems if stem in MOVING)
        span = f"{entries[stems[0]]['id']} to {entries[stems[-1]]['id']}"
        index.append(f"| [{title}]({name}.md), {span} | {len(stems)} | {moving} |\n")
    names = "\n".join(name for name, *_ in SECTIONS)
    index.append(f"\n```{{toctree}}\n:hidden:\n:maxdepth: 1\n\n{names}\n```\n")
    (PAGES / "index.md").write_text("".join(index), encoding="utf-8")


def _installed() -> bytes:
    """A checksum of what computes and draws: versions of libraries, and the package as it is installed."""
    told = hashlib.sha256(json.dumps(versions(), sort_keys=True).encode())
    package = Path(planemotion.__file__).parent
    for file in sorted(
        [*package.rglob("*.py"), *package.rglob("*.toml"), *package.glob("animation/player*")]
    ):
        told.update(file.read_bytes())
    told.update(Path(__file__).read_bytes())
    return told.digest()


def made(path: Path, installed: bytes) -> dict[str, Any]:
    """What a scene gives, from what is kept or computed now."""
    key = hashlib.sha256(installed + path.read_bytes()).hexdigest()[:24]
    kept = KEPT / f"{key}.json"
    if not kept.exists():
        # The entry is written last: one that is there is whole.
        kept.write_text(json.dumps(_computed(path, key)), encoding="utf-8")
    entry: dict[str, Any] = json.loads(kept.read_text(encoding="utf-8"))
    return {**entry, "kept": kept.name}


def _computed(path: Path, key: str) -> dict[str, Any]:
    scene = planemotion.load(path)
    result = scene.run()
    files = {f"{key}.svg": f"{path.stem}.svg"}
    scene.draw().save(KEPT / f"{key}.svg")
    if path.stem in MOVING:
        files[f"{key}.html"] = f"{path.stem}.html"
        scene.animate().save(KEPT / f"{key}.html")
    return {
        "id": result.id,
        "title": scene.data.title,
        "description": " ".join(scene.data.description.split()),
        "ok": result.ok,
        "status": f"`{result.status}`{_because(result.error)}. Errors: {trust_text(result)}.",
        "notes": list(result.notes),
        "answers": answer_rows(result),
        "files": files,
    }


def _because(error: str) -> str:
    return f" ({error})" if error else ""


def _in_use(entries: dict[str, Any]) -> Iterator[str]:
    for entry in entries.values():
        yield from (entry["kept"], *entry["files"])


def is_in(stem: str, kind: str, first: int, last: int) -> bool:
    """Whether a scene is one of the problems of a kind from the first number to the last."""
    found = re.fullmatch(r"17-(SP|C|)(\d+)", stem)
    return found is not None and found[1] == kind and first <= int(found[2]) <= last


def _entry(stem: str, entry: dict[str, Any]) -> str:
    head, *rows = entry["answers"]
    alt = escape(f"{entry['id']} {entry['title']}", quote=True)
    return ENTRY.format(
        stem=stem,
        alt=alt,
        id=entry["id"],
        title=entry["title"],
        description=entry["description"],
        head=" | ".join(head),
        answers="\n".join(f"| {' | '.join((f'`{row[0]}`', *map(_spaced, row[1:])))} |" for row in rows),
        status=entry["status"],
        notes="".join(f"Note: {note}.\n\n" for note in entry["notes"]),
        animation=ANIMATION.format(stem=stem, alt=alt) if stem in MOVING else "",
    )


def _spaced(cell: str) -> str:
    """A cell that Markdown takes as text."""
    return re.sub(r"([\\|*_\[\]<>])", r"\\\1", cell)


def _begin(app: Any) -> None:
    write_pages(Path(app.outdir) / "made" / "chapter17")


def setup(app: Any) -> dict[str, bool]:
    app.connect("builder-inited", _begin)
    return {"parallel_read_safe": False}
