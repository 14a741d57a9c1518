"""Faults planted in `kernel/impact/`: contacts as springs."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "springs: restitution counts once",
        "impact/contact_springs.c",
        "1 / (c->restitution * c->restitution)",
        "1 / c->restitution",
    ),
    Fault(
        "springs: without restitution nothing is lost",
        "impact/contact_springs.c",
        "(c->phase == LOADS && c->restitution == 0)",
        "0",
    ),
    Fault(
        "springs: all are equally stiff",
        "impact/contact_springs.c",
        "return x->spring[i].stiffness / x->stiffest;",
        "return 1;",
    ),
    Fault("springs: all are linear", "impact/contact_springs.c", "x->exponent == 1 ?", "x->exponent > 0 ?"),
    Fault(
        "springs: what turns back inside a step is not seen",
        "impact/contact_springs.c",
        "if (!(d[0] < 0 && d[1] > 0)) return 0;",
        "if (d[0] < INFINITY) return 0;",
    ),
    Fault(
        "springs: velocities of the last step are forgotten",
        "impact/contact_springs.c",
        "c->start += change(x, 2 * i, x->next);",
        "",
    ),
    Fault(
        "springs: the impulse of the last step alone",
        "impact/contact_springs.c",
        "c->impulse[0] += x->next[n + i];",
        "c->impulse[0] = x->next[n + i];",
    ),
    Fault(
        "springs: what parts and meets again does not push",
        "impact/contact_springs.c",
        "c->phase = loses ? OPEN : c->phase == LOADS ? RELEASES : LOADS;",
        "c->phase = loses || c->phase == OPEN ? OPEN : c->phase == LOADS ? RELEASES : LOADS;",
    ),
    Fault(
        "springs: what holds energy is let go",
        "impact/contact_springs.c",
        "any |= approaches || !holds_nothing(x, i);",
        "any |= approaches;",
    ),
    Fault(
        "springs: contacts do not feel each other",
        "impact/contact_springs_friction.c",
        "double sum = x->response[r * 2 * n + 2 * k];",
        "double sum = (r / 2 == k) * x->response[r * 2 * n + 2 * k];",
    ),
    Fault(
        "springs: friction drives slips on",
        "impact/contact_springs_friction.c",
        "= -x->spring[i].rub * x->spring[i].sense;",
        "= x->spring[i].rub * x->spring[i].sense;",
    ),
    Fault(
        "springs: what is held does not feel other loads",
        "impact/contact_springs_friction.c",
        "right[r] = -row[2 * k];",
        "right[r] = 0 * row[2 * k];",
    ),
    Fault(
        "springs: a slip that ends is passed over",
        "impact/contact_springs.c",
        "case SLIP: return slips(x, i) ?",
        "case SLIP: return 0 ?",
    ),
    Fault(
        "springs: friction holds whatever it needs",
        "impact/contact_springs_friction.c",
        "return hold * pm_contact_springs_force(x, i, y) - side * drag;",
        "return 1 + 0 * side * drag;",
    ),
    Fault(
        "springs: the order in the file shares friction",
        "impact/contact_springs_friction.c",
        "if (m < 2 || !find_least(x, m, p, right)) return;",
        "if (1) return;",
    ),
    Fault(
        "springs: nothing is ever wedged",
        "impact/contact_springs_wedged.c",
        "if (m == 0 || ",
        "if (1 || ",
    ),
    Fault(
        "springs: wedged by loads that move the bodies",
        "impact/contact_springs_wedged.c",
        "z[2 * i] > PM_SPRINGS_KEPT * load_of(x, i) && ",
        "",
    ),
    Fault(
        "springs: friction that wedges is greater than it can be",
        "impact/contact_springs_wedged.c",
        "share = fmax(share, -has / more);",
        "share = 0 * has;",
    ),
]
