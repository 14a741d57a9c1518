"""Small faults, one to plant at a time, that the tests of the kernel must catch.

A fault is one small change of one source: a sign in a column of a Jacobian, a wrong gamma, a dropped event
function, a wrong restitution, a dropped row ... There is a file of them for each room of the kernel;
`python -m tests.faults` plants them in a copy of it.
"""

from tests.faults import (
    elements,
    equations,
    events,
    events_asked,
    expression,
    impact,
    numerics,
    routes_ida,
    routes_path,
    routes_rk,
    routes_start,
    routes_uniform,
    run,
    scene,
    state,
    study,
    tree,
)
from tests.faults.fault import Fault

# The rooms from the lowest to the highest, as in kernel/.
BY_ROOM: dict[str, list[Fault]] = {
    "numerics": numerics.FAULTS,
    "expression": expression.FAULTS,
    "state": state.FAULTS,
    "elements": elements.FAULTS,
    "scene": scene.FAULTS,
    "equations": equations.FAULTS,
    "tree": tree.FAULTS,
    "events": events.FAULTS + events_asked.FAULTS,
    "impact": impact.FAULTS,
    "routes/path": routes_path.FAULTS,
    "routes/rk": routes_rk.FAULTS,
    "routes/ida": routes_ida.FAULTS,
    "routes/uniform": routes_uniform.FAULTS,
    "routes/start": routes_start.FAULTS,
    "run": run.FAULTS,
    "study": study.FAULTS,
}
FAULTS = [fault for faults in BY_ROOM.values() for fault in faults]
