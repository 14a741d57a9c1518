"""Faults planted in `kernel/elements/`: forces, measures and triggers."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "teeth: the impulse of a blow has the flank of the motion after it",
        "elements/measure_joint.c",
        "c.flank = x->w->impulses.flank[x->a];",
        "c.flank = 0;",
    ),
    Fault(
        "capture: the couple is a force",
        "elements/measure_contact.c",
        "held_force(x->w, i, PM_JOINT_CONSTRAINTS - 1)",
        "held_force(x->w, i, 0)",
    ),
    Fault(
        "spin: taken for uniform",
        "elements/force.c",
        "if (pm_turning_plane_turns(frame->model)) return 0; for",
        "for",
    ),
    Fault(
        "force: spring pushes",
        "elements/force.c",
        "slack ? 0 : stiffness * x->stretch",
        "slack ? 0 : -stiffness * x->stretch",
    ),
    Fault(
        "force: couple of a torsion spring",
        "elements/force.c",
        "act_by_couple(x, -stiffness * x->stretch)",
        "act_by_couple(x, stiffness * x->stretch)",
    ),
    Fault("force: no reaction on the second partner", "elements/force.c", "x.couple, -1)", "x.couple, 0)"),
    Fault(
        "force: moment of a force",
        "elements/force.c",
        "(couple + (at[0] - pose[0])",
        "(couple - (at[0] - pose[0])",
    ),
    Fault(
        "measure: the couple of teeth with backlash is their friction",
        "elements/measure_contact.c",
        "return tangent.value * slot_friction(x->w, slot);",
        "return slot_friction(x->w, slot);",
    ),
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
        "firing->seen[event] + 1 == nth",
        "nth > 0",
    ),
    Fault("one by one: one event for all", "elements/trigger.c", "firing->fired[i] = PM_FIRED_EARLIER;", ";"),
    Fault(
        "event: a blow's change of sign",
        "elements/trigger.c",
        "return before >= 0 && after < 0;",
        "return 0;",
    ),
    Fault(
        "event: a trigger on time that comes late",
        "elements/trigger.c",
        "return due > w->frame.t ? due : INFINITY",
        "return due > w->frame.t ? due + 1e-7 : INFINITY",
    ),
    Fault(
        "needed: the last jump is of one island",
        "elements/measure.c",
        "[PM_MEASURE_LOST] = {NOTHING, MOTION, UNKNOWN, 0, OF_ALL,",
        "[PM_MEASURE_LOST] = {NOTHING, MOTION, UNKNOWN, 0, 0,",
    ),
    Fault(
        "event: at the start the time is not due",
        "elements/trigger.c",
        "root_of(w, i) == w->frame.t",
        "root_of(w, i) == w->frame.t + 1",
    ),
    Fault(
        "jump: off zero nothing fires",
        "elements/trigger.c",
        "return before <= 0 && after > 0;",
        "return before < 0 && after > 0;",
    ),
    Fault(
        "jump: onto zero nothing is equal",
        "elements/trigger.c",
        "return before != 0 && after != before;",
        "return before * after < 0;",
    ),
    Fault(
        "event: what fires at the nth time fires without end",
        "elements/trigger.c",
        "firing->count[event] = once && count == PM_COUNTLESS ? 1 : count;",
        "firing->count[event] = count;",
    ),
    Fault(
        "slope: a line of action that does not turn",
        "elements/force_slope.c",
        "across[k] = (weight[k] - along * x->n[k]) / x->length",
        "across[k] = (weight[k] - along * x->n[k]) * 0 / x->length",
    ),
    Fault(
        "slope: the velocity of a point without the turn of its lever",
        "elements/slope.c",
        "to->q[3 * p->body + 2] -=",
        "to->q[3 * p->body + 2] -= 0 *",
    ),
    Fault(
        "measure slope: a moving observer whose axes stand still",
        "elements/measure_slope.c",
        "add_way(frame, &p, &o, (double[]){-omega * turned[1], omega * turned[0]}, to);",
        "add_way(frame, &p, &o, (double[]){0, 0}, to);",
    ),
    Fault(
        "measure: differences over half their way",
        "elements/measure.c",
        "weight * (at[1] - at[0]) / (2 * step)",
        "weight * (at[1] - at[0]) / step",
    ),
    Fault(
        "belt: the other strand is drawn",
        "elements/measure_joint.c",
        "(strand == 0 ? 0.5 : -0.5)",
        "(strand == 0 ? -0.5 : 0.5)",
    ),
    Fault(
        "belt: its strands carry what it drives with, each",
        "elements/measure_joint.c",
        "(strand == 0 ? 0.5 : -0.5)",
        "(strand == 0 ? 1 : -1)",
    ),
    Fault(
        "belt: nothing is slipped by",
        "elements/measure_joint.c",
        "state.friction[k] == PM_STICK ? 0",
        "state.friction[k] != PM_OPEN ? 0",
    ),
    Fault(
        "measure slope: slip of a joint as if it held",
        "elements/measure_slope.c",
        "add_rate(x, &c, weight[0], to);",
        "",
    ),
    Fault(
        "force: what draws two points together stays wherever they go",
        "elements/force.c",
        "constant(frame, e[PM_FORCE_PROGRAM_X]) && pm_constant_motion_together(frame, &c, x);",
        "constant(frame, e[PM_FORCE_PROGRAM_X]) + 0 * pm_constant_motion_together(frame, &c, x);",
    ),
]
