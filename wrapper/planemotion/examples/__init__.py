"""Scenes to begin with: one for each kind of joint, coupling, contact and force, and two studies.

`planemotion new` copies them, the reference of the language shows them, the pages of docs/ run them.
It uses `base` only.
"""

from __future__ import annotations

from importlib.resources import files

from ..base.errors import SceneError, nearest

FIRST = "pendulum"
# The scene that shows a kind has the name of that kind, but where the whole machine has a better one.
_SHOWN_BY = {"touch": "pendulum", "motor": "slider_crank", "rolling": "incline"}


def titles() -> dict[str, str]:
    """Names of all examples, the one for beginners first, each with what its first line says."""
    names = sorted(entry.name[:-5] for entry in files(__name__).iterdir() if entry.name.endswith(".toml"))
    names.sort(key=lambda name: name != FIRST)
    return {name: " ".join(_read(name).partition("\n")[0].lstrip("# ").split()) for name in names}


def text_of(name: str) -> str:
    """The text of an example by its name, or by the kind that it shows.

    Raises SceneError for a name that no example has.
    """
    known = titles()
    name = _SHOWN_BY.get(name, name)
    if name not in known:
        guess = nearest(name, known)
        hint = f'did you mean "{guess}"?' if guess else f"there are {', '.join(known)}"
        raise SceneError(f'there is no example "{name}"; {hint}')
    return _read(name)


def _read(name: str) -> str:
    return (files(__name__) / f"{name}.toml").read_text(encoding="utf-8")
