"""Who takes part: each module has `NAME`, `version()` and `attempts(problem, quick)`.

A peer that is not installed is a row that says so; `forbidden` names packages taken for missing.
"""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Collection, Iterator

from ..problems import Problem
from ..rows import Attempt

# Module here: name in the tables, package that it needs.
PEERS = {
    "c_loop": ("C loop", None),
    "engine": ("planemotion", None),
    "heyoka": ("heyoka", "heyoka"),
    "scipy": ("SciPy DOP853", "scipy"),
    "sundae": ("scikit-SUNDAE IDA", "sksundae"),
    "mujoco": ("MuJoCo", "mujoco"),
    "exudyn": ("Exudyn", "exudyn"),
}


def attempts(problem: Problem, quick: bool, forbidden: Collection[str] = ()) -> Iterator[Attempt]:
    """What all peers try at a problem, in the order of PEERS; `quick`: one setting each."""
    for module, (name, package) in PEERS.items():
        if package in forbidden or (package and importlib.util.find_spec(package) is None):
            yield Attempt(name, "", "", skip="not installed")
            continue
        peer = importlib.import_module(f".{module}", __name__)
        yield from peer.attempts(problem, quick)
