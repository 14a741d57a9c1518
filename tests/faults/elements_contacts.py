"""Faults planted in `kernel/elements/`: contacts, curves and edges, and what captures."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "curves: a foot in the next part is not looked for",
        "elements/curve_feet.c",
        "along(&c->node[i], f->x) >= 0 && along(&c->node[i + 1], f->x) < 0",
        "i % 2 == 0 && along(&c->node[i], f->x) >= 0 && along(&c->node[i + 1], f->x) < 0",
    ),
    Fault(
        "curves: a foot that is closed is found again",
        "elements/curve_feet.c",
        "if (off <= PM_CURVE_SAME * all) return 1;",
        "if (off < 0) return 1;",
    ),
    Fault(
        "curves: the far side of a body is touched",
        "elements/curve_feet.c",
        "return f->taken->n > 0 && height <",
        "return f->taken->n > 9 && height <",
    ),
    Fault(
        "curves: a circle goes round the end where the curve is drawn from",
        "elements/contact_curve.c",
        "normal->b[k] += at->p[k];",
        "normal->b[k] += 0 * at->p[k];",
    ),
    Fault(
        "curves: what comes from behind touches",
        "elements/contact_curve.c",
        "return !behind && near.height - radius <= length;",
        "return near.height - radius <= length;",
    ),
    Fault(
        "pairs of curves: a bent curve goes on without ends",
        "elements/curve.c",
        "if (pm_curve_is_endless(frame->model, curve) && at.bend != 0)",
        "if (0)",
    ),
    Fault(
        "pairs of curves: what comes to the end of the second is let go",
        "elements/contact_pair.c",
        "return is_within ? next_on_second(frame, normal, member) : PM_NONE;",
        "return PM_NONE;",
    ),
    Fault(
        "pairs of curves: a corner of the second pulls",
        "elements/contact_constraint.c",
        "return normal->body[0] == frame->numbers->of_contact[contact].body[0] ? 1 : -1;",
        "return 1;",
    ),
    Fault(
        "pairs of curves: a corner of the second that was passed is there",
        "elements/contact_pair.c",
        "take_passed(frame, contact, PM_PAIR_SECOND_FROM, s[0], closed->passed);",
        ";",
    ),
    Fault(
        "pieces of curves: a foot stays on the piece from which it comes",
        "elements/curve_piece.c",
        "of = piece.to + beside(frame, curve);",
        "of = piece.to - beside(frame, curve);",
    ),
    Fault(
        "pieces of curves: each place is on its own",
        "elements/curve.c",
        "pm_curve_has_pieces(frame->model, curve) ? of : s",
        "pm_curve_has_pieces(frame->model, curve) ? s : s",
    ),
    Fault(
        "pieces of curves: every knot is an end of the curve",
        "elements/curve_piece.c",
        "piece.from <= all.from : piece.to >= all.to",
        "piece.from <= all.to : piece.to >= all.from",
    ),
    Fault(
        "backlash: both flanks are on one side",
        "elements/contact_constraint.c",
        "c->flank = e[PM_CONTACT_SENSE_A];",
        "c->flank = 1;",
    ),
    Fault(
        "backlash: a flank that closes forgets where it was",
        "elements/contact.c",
        "return pm_contact_is_cord(m, contact) || pm_contact_has_flank(m, contact);",
        "return pm_contact_is_cord(m, contact);",
    ),
    Fault(
        "boxes that slide on each other catch where their corners pass",
        "elements/edge.c",
        "if (pm_cross(x->along, along) < -PM_EDGE_BEHIND) return 1;",
        "(void)along;",
    ),
    Fault(
        "capture: the place is not turned into the body",
        "elements/capture.c",
        "out[1] = -pose[4] * x",
        "out[1] = pose[4] * x",
    ),
    Fault(
        "capture: a body is held as a pin",
        "elements/capture.c",
        "can_rotate(frame, normal.body[1]) ? 3 : 2",
        "0 ? 3 : 2",
    ),
    Fault(
        "capture: a particle holds the other's angle",
        "elements/capture.c",
        "PM_BODY_ROW(frame->model, body)[PM_BODY_ROTATES]",
        "1",
    ),
    Fault(
        "capture: points meet from afar",
        "elements/capture.c",
        "room = PM_CAPTURE_MEETS",
        "room = 0.1",
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
        "|| pm_edge_touches(frame, contact)",
        "|| 1",
    ),
    Fault(
        "edge: both edges have the corner",
        "elements/contact.c",
        "pm_edge_is_covered(frame, s, contact) ? INFINITY :",
        "",
    ),
    Fault("edge: its end is not seen beside it", "elements/edge.c", "if (beyond <= 0) return", "return"),
    Fault(
        "edge: the wrong corner",
        "elements/edge.c",
        "*member = x.from > x.to",
        "*member = x.from < x.to",
    ),
    Fault(
        "edge: a corner turns the slip round",
        "elements/edge.c",
        "member != PM_SEGMENT_FACE ? -1 : 1",
        "member != PM_SEGMENT_FACE ? 1 : 1",
    ),
    Fault("edge: the next one is not seen", "elements/edge.c", "room = beyond_end(&x, end);", ""),
    Fault(
        "contact: a cord slips by the coefficient of its rim",
        "elements/contact.c",
        "return pm_constraint_cord_grip(given, pm_constraint_cord_wrap(frame, &c));",
        "return given;",
    ),
]
