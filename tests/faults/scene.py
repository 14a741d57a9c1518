"""Faults planted in `kernel/scene/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "pieces of curves: any table is read",
        "scene/check_reads.c",
        "if (a.knot[i] != b.knot[i]) return 0;",
        "if (a.knot[i] != b.knot[i]) continue;",
    ),
    Fault(
        "pieces of curves: a table is read anywhere",
        "scene/check_reads.c",
        "before != PM_OP_MEASURE ||",
        "",
    ),
    Fault(
        "needed: a contact lets nothing act",
        "scene/dependency.c",
        "{PM_TABLE_CONTACT, element_is_needed},",
        "",
    ),
    Fault(
        "needed: what a program reads is not followed",
        "scene/dependency.c",
        "more |= mark(x, ref[k].of, ref[k].index)",
        "if (table != PM_TABLE_CODE) more |= mark(x, ref[k].of, ref[k].index)",
    ),
    Fault("needed: events do nothing", "scene/dependency.c", "{PM_TABLE_ACTION, action_is_needed},", ""),
    Fault(
        "needed: a start beside another is its own",
        "scene/dependency.c",
        " || is_needed_body(x, e[PM_MEASURE_IN])",
        "",
    ),
    Fault(
        "reduce: places of the smaller scene",
        "scene/prune.c",
        "return known ? m->prune.original[table][row] : row;",
        "return row;",
    ),
    Fault(
        "symmetry: any body is round",
        "scene/symmetry.c",
        "return !is_rotated(s, e[PM_POINT_BODY]) ||",
        "return 1 ||",
    ),
    Fault(
        "symmetry: across a line",
        "scene/symmetry.c",
        "return fabs(across) <= PM_SYMMETRY_SAME * hypot(s->by[0], s->by[1])",
        "return 1",
    ),
    Fault(
        "class: a product of times",
        "scene/program_grade.c",
        "(op == PM_OP_MUL && a != b)",
        "op == PM_OP_MUL",
    ),
    Fault(
        "growth: the ratio of two forces",
        "scene/program_grade.c",
        "if (b == PM_ENERGY_CLASS_NONE) return product(a, b);",
        "if (b <= PM_ENERGY_CLASS_LINEAR) return a;",
    ),
]
