"""Faults planted in `kernel/expression/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "pieces of curves: their third derivative is none",
        "expression/program_taylor.c",
        "d[2] * c[1] * c[1] * c[1] / 6",
        "0 * d[2] * c[1] * c[1] * c[1] / 6",
    ),
    Fault(
        "second derivatives: a product has no mixed term",
        "expression/program_rate.c",
        "a.change * b.x + 2 * a.rate * b.rate + a.x * b.change",
        "a.change * b.x + a.x * b.change",
    ),
    Fault(
        "enclosure: a product bends by its factors alone",
        "expression/enclosure_rules.c",
        "pm_interval_scaled(2, TIMES(a->rate, b->rate))",
        "pm_interval_scaled(0, TIMES(a->rate, b->rate))",
    ),
    Fault(
        "enclosure: what comes back has kept its side",
        "expression/enclosure_rules.c",
        "return monotonic && no_pole && !pm_jet_changes(op, x);",
        "return no_pole && !pm_jet_changes(op, x);",
    ),
    Fault(
        "enclosure: a series takes the lesser of two for the greater",
        "expression/enclosure_series.c",
        "case PM_OP_MAX: return either(a, b, 1);",
        "case PM_OP_MAX: return either(a, b, -1);",
    ),
    Fault(
        "enclosure: numbers have no end",
        "expression/enclosure_rules.c",
        "if (x->gaps) return x->gaps == PM_GAPS_EVERYWHERE;",
        "",
    ),
    Fault(
        "enclosure: what passes a pole keeps its side",
        "expression/enclosure_rules.c",
        "return monotonic && no_pole && !",
        "return monotonic && !",
    ),
    Fault(
        "enclosure: a power of a negative base is one of a positive",
        "expression/enclosure_rules.c",
        "if (!(a->value.lo > 0)) {",
        "if (0) {",
    ),
    Fault(
        "enclosure: the exponential of no number is a number",
        "expression/enclosure_rules.c",
        "exp(x > PM_EXPONENT_MOST ? PM_EXPONENT_MOST : x)",
        "exp(fmin(x, PM_EXPONENT_MOST))",
    ),
    Fault(
        "enclosure: an angle does not leap",
        "expression/enclosure_rules.c",
        "return stands ? x : y;",
        "return stands ? NULL : NULL;",
    ),
    Fault(
        "enclosure: the angle of what is zero does not leap",
        "expression/enclosure_rules.c",
        "return stands ? x : y;",
        "return stands ? NULL : y;",
    ),
    Fault(
        "fold: operands change places",
        "expression/program.c",
        "binary(s->op, *top, number[s->arg])",
        "binary(s->op, number[s->arg], *top)",
    ),
    Fault(
        "program: left and right",
        "expression/program.c",
        "case PM_OP_SUB: return a - b",
        "case PM_OP_SUB: return b - a",
    ),
    Fault(
        "nodes: the same number is read at every node",
        "expression/program_batch.c",
        "operate(s, n, stack[top], stack[top + 1], 1, switches)",
        "operate(s, n, stack[top], stack[top + 1], 0, switches)",
    ),
    Fault(
        "nodes: a choice takes the other way",
        "expression/program_batch.c",
        "!= 0 ? yes[k] : no[k]",
        "!= 0 ? no[k] : yes[k]",
    ),
    Fault(
        "branch: the greater of two is the lesser",
        "expression/program_batch.c",
        "op == PM_OP_MIN ? sign > 0 : sign < 0",
        "sign < 0",
    ),
    Fault(
        "fold: positions stay",
        "expression/program_fold.c",
        "kind == PM_MEASURE_MASS ||",
        "kind != PM_MEASURE_TIME ||",
    ),
    Fault(
        "answers are read before they are there",
        "expression/program.c",
        "least = e[PM_ASK_KIND] == PM_ASK_END ? e[PM_ASK_OUT] : 0;",
        "least = m->nout;",
    ),
    Fault(
        "tables: a knot belongs to the piece below it",
        "expression/piecewise.c",
        "if (p->knot[middle] <= x)",
        "if (p->knot[middle] < x)",
    ),
    Fault(
        "tables: one that is held goes on beyond its end",
        "expression/piecewise.c",
        "p->beyond == PM_BEYOND_EXTEND ? at_end[0] : 0",
        "p->beyond != PM_BEYOND_NONE ? at_end[0] : 0",
    ),
    Fault(
        "tables: a rate is that of the argument",
        "expression/program_rate.c",
        "(pm_shape){derivative[0], derivative[1]}",
        "(pm_shape){1, derivative[1]}",
    ),
    Fault(
        "tables: what reads one along a line does not bend",
        "expression/program_rate.c",
        "(pm_shape){derivative[0], derivative[1]}",
        "(pm_shape){derivative[0], 0}",
    ),
    Fault(
        "enclosure: a table bends by its argument alone",
        "expression/enclosure_table.c",
        "pm_interval_product(second, pm_interval_square(a->rate))",
        "pm_interval_product(second, pm_interval_of(0))",
    ),
    Fault(
        "tables: knots that do not increase are taken",
        "expression/piecewise.c",
        "if (!(m->constant[k - 1] < m->constant[k]))",
        "if (m->constant[k - 1] > m->constant[k])",
    ),
    Fault(
        "program: every reading of a measure counts for each",
        "expression/program_rate.c",
        "if (x->next != at->next) return",
        "if (x->next == NULL) return",
    ),
    Fault(
        "program: where two are equal the lesser is the first",
        "expression/program_rate.c",
        "case PM_OP_MIN: return x == b.x ? b : (pm_timed){x, a.rate, a.change};",
        "case PM_OP_MIN: return x == a.x ? a : (pm_timed){x, b.rate, b.change};",
    ),
]
