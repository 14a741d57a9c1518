"""The kinds of joints, couplings and forces: one file and one line of the table below each.

The class of a kind says the word, the options (its fields), the rows that it writes and how it is drawn, by
what `model`, `geometry` and `pen` offer.  `reading` makes scenes of kinds and `compile` takes their rows; no
other module knows a kind by its name, and messages list the words in the order of this table.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from ..model.element import Kind
from ..model.tables import Contact
from .base import Coupling, Force, Joint
from .belt import Belt
from .cord import Cord
from .couple import Couple
from .damper import Damper
from .force import AppliedForce
from .gears import Gears
from .link import Link
from .motor import Motor
from .pin import Pin
from .ratio import Ratio
from .rolling import Rolling
from .slider import Slider
from .slot import Slot
from .spring import Spring
from .torsion import Torsion
from .weld import Weld

K = TypeVar("K", bound=Kind)


def _table(*kinds: type[K]) -> Mapping[str, type[K]]:
    return {kind.word: kind for kind in kinds}


JOINTS: Mapping[str, type[Joint]] = _table(
    Pin,
    Slider,
    Slot,
    Link,
    Weld,
    Rolling,
)
COUPLINGS: Mapping[str, type[Coupling]] = _table(
    Gears,
    Belt,
    Cord,
    Motor,
    Ratio,
)
FORCES: Mapping[str, type[Force]] = _table(
    Spring,
    Torsion,
    Damper,
    AppliedForce,
    Couple,
)
# Table of a scene -> the kinds that stand in it.
KINDS: Mapping[str, Mapping[str, type[Kind]]] = {
    "joints": JOINTS,
    "couplings": COUPLINGS,
    "contacts": _table(Contact),
    "forces": FORCES,
}
