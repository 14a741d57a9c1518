"""Faults planted in `kernel/elements/`: constraints of belts, cords and teeth."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "uniform: a strand shortens at the speed with which it began",
        "elements/constraint_strand.c",
        "course[2] += (x->a[b] - x->a[a]) * strand.u[k];",
        "course[2] += 0;",
    ),
    Fault(
        "teeth: both flanks draw their wheels together",
        "elements/constraint_teeth.c",
        "c->j[k] = along * t.j[k] + across * n.j[k];",
        "c->j[k] = along * t.j[k] - across * n.j[k];",
    ),
    Fault(
        "teeth: no acceleration across the line of action",
        "elements/constraint_teeth.c",
        "c->gamma = along * t.gamma + across * n.gamma;",
        "c->gamma = along * t.gamma;",
    ),
    Fault(
        "teeth: the force acts along the pitch circles",
        "elements/constraint_teeth.c",
        "x->direction[k] + c->teeth[1] * n.direction[k]",
        "x->direction[k] + 0 * n.direction[k]",
    ),
    Fault(
        "teeth: the flank that pulls stays",
        "elements/teeth.c",
        "memory->direction = -pm_teeth_loaded(memory);",
        "memory->direction = 1;",
    ),
    Fault(
        "teeth: a blow has the flank of the motion",
        "elements/teeth.c",
        "if (!(impulse < -PM_PULLS * greatest)) continue;",
        "if (!(impulse < -2 * greatest)) continue;",
    ),
    Fault(
        "strand: tangent point on the wrong side",
        "elements/constraint_strand.c",
        "- c->radius_a * strand.n[k]",
        "+ c->radius_a * strand.n[k]",
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
        "c->j[5] -= c->radius_b",
        "c->j[5] += c->radius_b",
    ),
    Fault(
        "strand: its turning pays nothing out",
        "elements/constraint_strand.c",
        "(c->radius_b - c->radius_a) * direction + c->radius_a",
        "c->radius_a",
    ),
    Fault(
        "cord: a rim grips by the whole wrap",
        "elements/constraint_cord.c",
        "return 2 * tanh(0.5 * coefficient * fmax(wrap, 0));",
        "return 2 * tanh(coefficient * fmax(wrap, 0));",
    ),
    Fault(
        "cord: the friction of a rim pulls with the cord",
        "elements/constraint_cord.c",
        "tension[0] = slip ? 0.5 : 1;",
        "tension[0] = slip ? -0.5 : 1;",
    ),
    Fault(
        "cord: while it slips friction stays as it was",
        "elements/constraint_cord.c",
        "c->slide = copysign(",
        "if (c->slide == 0) c->slide = copysign(",
    ),
    Fault(
        "cord: turns are not wound",
        "elements/constraint_cord.c",
        "return wrap + turn * c->turns;",
        "return wrap;",
    ),
    Fault(
        "cord: it is wrapped on the other side",
        "elements/constraint_cord.c",
        "return c->radius_rim < 0 ? direction[0] - direction[1]",
        "return c->radius_rim > 0 ? direction[0] - direction[1]",
    ),
    Fault(
        "cord: where it holds again its slip is that of before",
        "elements/constraint_cord.c",
        "if (anchor_too) memory->slip = -own.g;",
        "if (anchor_too) memory->slip = 0;",
    ),
    Fault(
        "cord: its second strand does not follow",
        "elements/constraint_cord.c",
        "if (anchor_too) memory->slip = -own.g;\n    memory->direction = direction[0];\n"
        "    memory->behind = direction[1];",
        "if (anchor_too) memory->slip = -own.g;\n    memory->direction = direction[0];",
    ),
    Fault(
        "teeth: with backlash friction drives the wheels on",
        "elements/constraint_teeth.c",
        "c->j[5] = -c->value;",
        "c->j[5] = c->value;",
    ),
    Fault(
        "teeth: their friction has no couple",
        "elements/constraint_teeth.c",
        "x->couple[0] = c->value;",
        "x->couple[0] = 0;",
    ),
    Fault(
        "belt: the line of centres may turn as it likes",
        "elements/constraint_belt.c",
        "(c->radius_b - c->radius_a) * direction;",
        "0 * direction;",
    ),
    Fault(
        "belt: what the centres do passes nothing",
        "elements/constraint_belt.c",
        "pm_constraint_along(c->j, &x.marks, x.t, -x.lever);",
        "pm_constraint_along(c->j, &x.marks, x.t, 0);",
    ),
    Fault(
        "belt: no term of both velocities in gamma",
        "elements/constraint_belt.c",
        "2 * pm_dot(x.marks.u, x.n)",
        "0 * pm_dot(x.marks.u, x.n)",
    ),
    Fault(
        "belt: its force across the line of centres is the other way",
        "elements/constraint_belt.c",
        "x->direction[k] = -y.lever * y.t[k];",
        "x->direction[k] = y.lever * y.t[k];",
    ),
]
