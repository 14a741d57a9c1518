"""Faults planted in `kernel/elements/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "capture: the place is not turned into the body",
        "elements/capture.c",
        "out[1] = -pose[4] * x",
        "out[1] = pose[4] * x",
    ),
    Fault(
        "capture: a body is held as a pin",
        "elements/capture.c",
        "can_turn(&w->frame, normal.body[1]) ? 3 : 2",
        "0 ? 3 : 2",
    ),
    Fault(
        "capture: a particle holds the other's angle",
        "elements/capture.c",
        "PM_BODY_ROW(frame->model, body)[PM_BODY_TURNS]",
        "1",
    ),
    Fault(
        "capture: points meet from afar",
        "elements/capture.c",
        "room = MEETS",
        "room = 0.1",
    ),
    Fault(
        "spin: taken for uniform", "elements/constant_motion.c", "pm_turning_plane_turns(w->model) || ", ""
    ),
    Fault(
        "uniform: rows are dropped from the proof",
        "elements/constant_motion.c",
        "|| !rows_hold(w, x)) return 0",
        ") return 0",
    ),
    Fault(
        "uniform: levers of locked bodies do not change their couples",
        "elements/constant_motion.c",
        "x->levers = more = 1",
        "more = 1",
    ),
    Fault(
        "belt: friction does not know that it runs",
        "elements/constraint.c",
        "return pm_constraint_rate(frame, row) - pm_drive_rate(frame, row->drive);",
        "return pm_constraint_rate(frame, row);",
    ),
    Fault(
        "jacobian: x of the first partner",
        "elements/constraint.c",
        "row->j[0] = factor * n[0]",
        "row->j[0] = -factor * n[0]",
    ),
    Fault(
        "jacobian: y of the first partner",
        "elements/constraint.c",
        "row->j[1] = factor * n[1]",
        "row->j[1] = -factor * n[1]",
    ),
    Fault(
        "jacobian: angle of the first partner",
        "elements/constraint.c",
        "row->j[2] = factor *",
        "row->j[2] = -factor *",
    ),
    Fault(
        "jacobian: x of the second partner",
        "elements/constraint.c",
        "row->j[3] = -factor * n[0]",
        "row->j[3] = factor * n[0]",
    ),
    Fault(
        "jacobian: y of the second partner",
        "elements/constraint.c",
        "row->j[4] = -factor * n[1]",
        "row->j[4] = factor * n[1]",
    ),
    Fault(
        "jacobian: angle of the second partner",
        "elements/constraint.c",
        "row->j[5] = -factor *",
        "row->j[5] = factor *",
    ),
    Fault("ratio: the ground takes nothing", "elements/constraint.h", " && row->ratio == 1;", ";"),
    Fault("jacobian: relative angle", "elements/constraint_angle.c", "row->j[5] = -1", "row->j[5] = 1"),
    Fault(
        "jacobian: side of a distance",
        "elements/constraint_distance.c",
        "pm_constraint_along(row, &x, n, row->sign)",
        "pm_constraint_along(row, &x, n, 1)",
    ),
    Fault(
        "gamma: distance",
        "elements/constraint_distance.c",
        "+ across * across / distance",
        "- across * across / distance",
    ),
    Fault(
        "uniform: missed root of one inside the other",
        "elements/constraint_distance.c",
        "-(hardest + r.rate * r.rate / nearest)",
        "-hardest",
    ),
    Fault(
        "drive: no acceleration",
        "elements/constraint_drive.c",
        "row->gamma += pm_drive_change(frame, row->drive);",
        "",
    ),
    Fault(
        "ratio: opposite couples",
        "elements/constraint_drive.c",
        ".couple = {1, -row->ratio}}",
        ".couple = {1, -1}}",
    ),
    Fault(
        "ratio: the other way",
        "elements/constraint_drive.c",
        "row->j[5] = -row->ratio;",
        "row->j[5] = row->ratio;",
    ),
    Fault(
        "jacobian: line that turns, normal",
        "elements/constraint_line.c",
        "row->j[5] -= pm_dot(x.d, l.t)",
        "row->j[5] += pm_dot(x.d, l.t)",
    ),
    Fault(
        "jacobian: wheel on a line",
        "elements/constraint_line.c",
        "row->j[2] += row->radius_a",
        "row->j[2] -= row->radius_a",
    ),
    Fault(
        "jacobian: line that turns, tangent",
        "elements/constraint_line.c",
        "pm_dot(x.d, l.n) - row->radius_a; row->g = rolled",
        "pm_dot(x.d, l.n) + row->radius_a; row->g = rolled",
    ),
    Fault(
        "gamma: line, Coriolis",
        "elements/constraint_line.c",
        "- 2 * x.omega_b * pm_dot(x.u, l.t)",
        "+ 2 * x.omega_b * pm_dot(x.u, l.t)",
    ),
    Fault(
        "gamma: line, no slip",
        "elements/constraint_line.c",
        "+ 2 * x.omega_b * pm_dot(x.u, l.n)",
        "- 2 * x.omega_b * pm_dot(x.u, l.n)",
    ),
    Fault(
        "memory: anchor of another place",
        "elements/constraint_line.c",
        "memory->anchor = rolled(frame, row, &x, &l)",
        "memory->anchor = rolled(frame, row, &x, &l) + 1e-3",
    ),
    Fault(
        "uniform: missed root of a rod that spins",
        "elements/constraint_line.c",
        "? pm_dot(r.apart, l.n) - r.swing",
        "? pm_dot(r.apart, l.n) - 0.5 * r.swing",
    ),
    Fault(
        "gears: both inside",
        "elements/constraint_marks.c",
        "row->radius_a = side == -1 ? -radius_a : radius_a;",
        "row->radius_a = radius_a;",
    ),
    Fault("gamma: pin", "elements/constraint_point.c", "row->gamma = omega_a", "row->gamma = -omega_a"),
    Fault(
        "strand: tangent point on the wrong side",
        "elements/constraint_strand.c",
        "- row->radius_a * strand.n[k]",
        "+ row->radius_a * strand.n[k]",
    ),
    Fault(
        "strand: gamma without turning",
        "elements/constraint_strand.c",
        "across * across / x.length - pm_dot",
        "-pm_dot",
    ),
    Fault(
        "strand: the other drum winds the wrong way",
        "elements/constraint_strand.c",
        "row->j[5] -= row->radius_b",
        "row->j[5] += row->radius_b",
    ),
    Fault(
        "strand: its turning pays nothing out",
        "elements/constraint_strand.c",
        "(row->radius_b - row->radius_a) * direction + row->radius_a",
        "row->radius_a",
    ),
    Fault(
        "jacobian: wheel on a circle",
        "elements/constraint_tangent.c",
        "row->j[2] -= row->radius_a",
        "row->j[2] += row->radius_a",
    ),
    Fault(
        "jacobian: circle under a wheel",
        "elements/constraint_tangent.c",
        "row->j[5] -= row->radius_b",
        "row->j[5] += row->radius_b",
    ),
    Fault(
        "gamma: circle, no slip",
        "elements/constraint_tangent.c",
        "- 2 * pm_dot(x.u, n) * spin",
        "+ 2 * pm_dot(x.u, n) * spin",
    ),
    Fault(
        "memory: turns are forgotten",
        "elements/constraint_tangent.c",
        "turn * round(c / turn)",
        "0 * round(c / turn)",
    ),
    Fault(
        "line of action: other side of the wheel",
        "elements/constraint_tangent.c",
        "y.a.p[k] - row->radius_a",
        "y.a.p[k] + row->radius_a",
    ),
    Fault(
        "contact: members are counted from zero",
        "elements/contact.c",
        "return k > place ? k - 1 : k;",
        "return k;",
    ),
    Fault(
        "contact: a rate without the row's body",
        "elements/contact.c",
        "a.v[0] - b.v[0], a.v[1] - b.v[1]",
        "a.v[0], a.v[1]",
    ),
    Fault(
        "edge: what is behind it touches",
        "elements/contact.c",
        "|| pm_edge_touches(&w->frame, contact)",
        "|| 1",
    ),
    Fault(
        "edge: both edges have the corner",
        "elements/contact.c",
        "pm_edge_is_covered(w, s, contact) ? INFINITY :",
        "",
    ),
    Fault(
        "drive: its way starts anew at every step",
        "elements/drive.c",
        "memory->anchor += pm_drive_way(frame, program, memory);",
        "",
    ),
    Fault("edge: its end is not seen beside it", "elements/edge.c", "if (beyond <= 0) return", "return"),
    Fault(
        "edge: the wrong corner",
        "elements/edge.c",
        "if (x.radius > 0) *member = x.from > x.to",
        "if (x.radius > 0) *member = x.from < x.to",
    ),
    Fault(
        "edge: a corner turns the slip round",
        "elements/edge.c",
        "member != PM_SEGMENT_FACE ? -1 : 1",
        "member != PM_SEGMENT_FACE ? 1 : 1",
    ),
    Fault("edge: the next one is not seen", "elements/edge.c", "room = beyond_end(&x, end);", ""),
    Fault(
        "force: spring pushes",
        "elements/force.c",
        "return stiffness * x->stretch",
        "return -stiffness * x->stretch",
    ),
    Fault(
        "force: couple of a torsion spring",
        "elements/force.c",
        "x->couple = -stiffness",
        "x->couple = stiffness",
    ),
    Fault("force: no reaction on the second partner", "elements/force.c", "x.couple, -1)", "x.couple, 0)"),
    Fault(
        "force: moment of a force",
        "elements/force.c",
        "(couple + (at[0] - pose[0])",
        "(couple - (at[0] - pose[0])",
    ),
    Fault(
        "grip: friction goes with the slip",
        "elements/joint_friction.c",
        "== PM_SLIDE_FORWARD ? -size",
        "== PM_SLIDE_FORWARD ? size",
    ),
    Fault(
        "grip: slides the wrong way",
        "elements/joint_friction.c",
        "friction > 0 ? PM_SLIDE_BACKWARD",
        "friction < 0 ? PM_SLIDE_BACKWARD",
    ),
    Fault(
        "grip: never overcome within a phase",
        "elements/joint_friction.c",
        "if (needed <= limit",
        "if (w->state.t > 0 || needed <= limit",
    ),
    Fault(
        "grip: load of one axis",
        "elements/joint_friction.c",
        "sum = hypot(sum, x[active])",
        "sum = x[active]",
    ),
    Fault(
        "grip: a load has a sign", "elements/joint_friction.c", "hypot(sum, x[active])", "(sum + x[active])"
    ),
    Fault("grip: no reaction", "elements/joint_friction.c", "x->body_b = row.body[1];", ""),
    Fault(
        "measure: velocity of a moving observer",
        "elements/measure_body.c",
        "out[0] = p.v[0] - (v[0] - v[2]",
        "out[0] = p.v[0] - (v[0] + v[2]",
    ),
    Fault(
        "capture: its force is that of its first row",
        "elements/measure_contact.c",
        "PM_JOINT_CONSTRAINTS * slot + axis",
        "PM_JOINT_CONSTRAINTS * slot",
    ),
    Fault(
        "action: the event acts each time",
        "elements/trigger.c",
        "w->event->seen[event] + 1 == nth",
        "nth > 0",
    ),
    Fault(
        "one by one: one event for all", "elements/trigger.c", "w->event->fired[i] = PM_FIRED_EARLIER;", ";"
    ),
    Fault(
        "event: a blow's change of sign",
        "elements/trigger.c",
        "const int rises = before < 0 && after > 0",
        "const int rises = 0",
    ),
    Fault(
        "event: a trigger on time that comes late",
        "elements/trigger.c",
        "return due > now ? due : INFINITY",
        "return due > now ? due + 1e-7 : INFINITY",
    ),
    Fault(
        "spin: its couple turns the wrong way", "elements/turning_plane.c", "f[2] += square", "f[2] -= square"
    ),
    Fault(
        "spin: pulls towards the axis", "elements/turning_plane.c", "outward = square", "outward = -square"
    ),
    Fault(
        "spin: both moments in the plane exchanged",
        "elements/turning_plane.c",
        "sine * sine +",
        "cosine * cosine +",
    ),
    Fault(
        "spin: nothing across the plane", "elements/turning_plane.c", " + second(frame, i, PM_SECOND_Z);", ";"
    ),
    Fault(
        "spin: keeps its rate, not its momentum",
        "elements/turning_plane.c",
        "momentum / pm_turning_plane_inertia(frame)",
        "momentum / 0.3",
    ),
    Fault("spin: no energy", "elements/turning_plane.c", "return 0.5 * omega * (i", "return 0 * (i"),
]
