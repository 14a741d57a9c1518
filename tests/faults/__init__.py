"""Small faults, one to plant at a time, that the tests of the kernel must catch.

A fault is one small change of one source: a sign in a column of a Jacobian, a wrong gamma, a dropped event
function, a wrong restitution, a dropped row ... Each room of the kernel has its file of them, a large room
one for each of its subjects; `python -m tests.faults` plants them in a copy of the kernel.
"""

from tests.faults import (
    elements_constraints,
    elements_contacts,
    elements_measures,
    elements_wrapped,
    equations_active,
    equations_solved,
    events,
    events_asked,
    events_bracketed,
    events_series,
    expression,
    impact_blows,
    impact_courses,
    impact_instants,
    impact_modes,
    impact_springs,
    numerics,
    routes_ida,
    routes_path,
    routes_path_time,
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
    "elements": elements_constraints.FAULTS
    + elements_contacts.FAULTS
    + elements_measures.FAULTS
    + elements_wrapped.FAULTS,
    "scene": scene.FAULTS,
    "equations": equations_active.FAULTS + equations_solved.FAULTS,
    "tree": tree.FAULTS,
    "events": events.FAULTS + events_bracketed.FAULTS + events_asked.FAULTS + events_series.FAULTS,
    "impact": impact_blows.FAULTS
    + impact_courses.FAULTS
    + impact_instants.FAULTS
    + impact_modes.FAULTS
    + impact_springs.FAULTS,
    "routes/path": routes_path.FAULTS + routes_path_time.FAULTS,
    "routes/rk": routes_rk.FAULTS,
    "routes/ida": routes_ida.FAULTS,
    "routes/uniform": routes_uniform.FAULTS,
    "routes/start": routes_start.FAULTS,
    "run": run.FAULTS,
    "study": study.FAULTS,
}
FAULTS = [fault for faults in BY_ROOM.values() for fault in faults]
