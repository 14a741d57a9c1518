"""The words of the scene language that are values or parts of addresses; keys are those of the models.

Kinds of joints, couplings and forces say their own words (kinds/).
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from typing import Any

from ..base.errors import SceneError, StudyError, nearest
from ..base.words import listed
from ..language.address import DOTTED, KEYWORDS

GROUND = "ground"  # what does not move, as an owner of marks

SHAPES = ("rod", "disk", "cylinder", "hoop", "sphere", "half_ring", "plate")
EDGE_ON_SHAPES = ("disk", "hoop")
ROUND_SHAPES = ("disk", "cylinder", "hoop", "sphere", "half_ring")

# Groups whose keys a sweep may vary by their path, such as contacts.floor.law.
ELEMENTS = ("bodies", "joints", "couplings", "contacts", "forces", "events")
OPTIONS = ("solve", *ELEMENTS)

SINGULAR = {"joints": "joint", "couplings": "coupling", "contacts": "contact", "forces": "force"}

IMPACTS = ("simultaneous", "sequential")
SHARED = ("none", "least")
LAWS = ("newton", "poisson", "stronge")
ROUTES = ("auto", "state", "jump", "uniform", "path", "rk", "ida")

RIM_CHANGES = ("slips", "sticks")  # of a cord on a rim
CONTACT_CHANGES = ("strikes", "opens", "slips", "sticks")
CORD_CHANGES = ("slackens", "tightens")
CAPTURE_CHANGES = ("strikes", "opens")

BODY_QUANTITIES = (
    *("angle", "turned", "omega", "alpha", "mass", "weight", "inertia", "kinetic_energy"),
    *("momentum", "angular_momentum", "pole"),
)
POINT_QUANTITIES = ("x", "y", "position", "moved", "path", "velocity", "speed", "acceleration")
JOINT_QUANTITIES = ("force", "couple", "impulse", "normal", "friction", "friction_needed", "power")
DRIVEN = "driven"  # before what the drive of a body does
DRIVE_QUANTITIES = ("force", "couple", "power")
CONTACT_QUANTITIES = (
    *("gap", "closed", "slip", "normal", "friction", "friction_needed", "force", "impulse"),
)
CAPTURE_QUANTITIES = ("gap", "closed", "force", "couple", "impulse")  # no normal and no friction
FORCE_QUANTITIES = ("force", "couple", "work", "power", "stretch", "stretch_rate", "energy")
EVENT_QUANTITIES = ("count", "time")
ENERGIES = ("kinetic", "potential", "total", "lost")
SPIN_QUANTITIES = ("omega", "angle", "momentum", "inertia")
MODE_QUANTITIES = ("omega", "damping", "period")  # of one mode of small motion
MODES_QUANTITIES = ("count", "growth")  # of all of them
SCENE_QUANTITIES = ("t", "time", "energy", "weight", "momentum", "angular_momentum", "spin", "modes")
PARTS = ("x", "y", "norm", "angle")

# What an ask takes of an expression: its value at an instant, an extreme over the run, or all of its course.
ASK_EXTREMES = ("max", "min")
ASK_PERCENTILES = ("median", "percentile")
ASK_INTEGRALS = ("integral", "mean", "rms", *ASK_PERCENTILES)
ASK_PERIODS = ("period", "frequency")
ASK_WAVES = ("amplitude", "phase")
ASK_SWINGS = (*ASK_PERIODS, *ASK_WAVES)
ASK_WORDS = ("of", *ASK_EXTREMES, *ASK_INTEGRALS, *ASK_SWINGS)

# What an element or parameter cannot be called: the words would mean two things.
RESERVED = frozenset({*SCENE_QUANTITIES, *KEYWORDS, GROUND, "pi", "start", "end", "rest"})
_NAME = re.compile(DOTTED)


def table(raw: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    """The table of that name, empty if it is not written."""
    return mapping(raw.get(key, {}), key)


def mapping(value: Any, path: str) -> Mapping[str, Any]:
    """The value as a table.  Raises SceneError if it is none."""
    if not isinstance(value, Mapping):
        raise SceneError("a table is wanted", path=path, value=value)
    return value


def check_name(name: str, path: str) -> None:
    """Raises SceneError if `name` cannot be used in an address; names of parts and with an index can."""
    if not _NAME.fullmatch(name):
        raise SceneError("a name is letters, digits and _, and begins with a letter", path=f"{path}.{name}")
    if re.split(r"[.\[]", name, maxsplit=1)[0] in RESERVED:
        raise SceneError(f'"{name}" has a meaning of its own; choose another name', path=f"{path}.{name}")


def is_option(path: str) -> bool:
    """Whether it leads to a key of an element, or to a setting."""
    return "." in path and path.partition(".")[0] in OPTIONS


def not_built(what: str, path: str | None = None, value: object = None) -> SceneError:
    """The error for a word that the language has and this version does not do."""
    return SceneError(f"not built yet: {what}", path=path, value=value)


def shown_words(show: str | Iterable[str], known: Collection[str]) -> tuple[str, ...]:
    """The words of an option `show`, as a list or as one text with commas.

    Raises StudyError for one that is not known."""
    words = listed(show)
    for word in words:
        if word not in known:
            raise StudyError(f'show = "{word}": {unknown(word, known, "word")}')
    return words


def unknown(word: str, known: Collection[str], what: str) -> str:
    """The text that there is no such parameter, body, ..., with the nearest one that there is."""
    guess = nearest(word, known)
    there_is = f"there is {', '.join(known)}" if known else "there is none"
    return f'unknown {what} "{word}"; {there_is}' + (f' (did you mean "{guess}"?)' if guess else "")
