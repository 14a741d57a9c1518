/* enclosure.c - a program along a stretch of time: its jet, and its switches. */
#include "expression/enclosure.h"

#include "expression/operation.h"
#include "expression/program_fold.h"
#include "numerics/tolerances.h"

enum { SWITCHES = PM_OPERATION_JUMPS | PM_OPERATION_CORNERS };

static void note(int op, const pm_jet *x, pm_enclosure *e)
{
    if (x->motion || pm_jet_keeps_side(op, x)) return;
    e->open++;
    e->changes += pm_jet_changes(op, x);
}

/* The switches of an operation on the operands a[]; row: that of a table. */
static void note_switches(const pm_model *m, int op, int row, const pm_jet *a, pm_enclosure *e)
{
    if (op == PM_OP_PIECEWISE) {
        const pm_jet pieces = pm_jet_of_pieces(m, row, a);
        note(PM_OP_FLOOR, &pieces, e);
    }
    if (op == PM_OP_NOT || op == PM_OP_FLOOR || op == PM_OP_ABS || op == PM_OP_SELECT) note(op, a, e);
    if (op == PM_OP_AND || op == PM_OP_OR) {
        note(op, a, e);
        note(op, a + 1, e);
    }
    const pm_jet *leaps = op == PM_OP_ATAN2 ? pm_jet_leaps_with(a, a + 1) : NULL;
    if (leaps) note(PM_OP_GE, leaps, e);
    if (pm_operations[op].takes == 2 && pm_operation_has(op, SWITCHES)) {
        const pm_jet d = pm_jet_difference(a, a + 1);
        note(op, &d, e);
    }
}

static pm_jet time_jet(double from, double to)
{
    return (pm_jet){{from, 0.5 * (from + to), to}, {from, to}, {1, 1}, {0, 0}, 0, 0};
}

static pm_jet number_jet(double x) { return (pm_jet){{x, x, x}, {x, x}, {0, 0}, {0, 0}, 0, 0}; }

/* What the motion does is not known: it stands still, beside what the time does. */
static pm_jet motion_jet(void)
{
    pm_jet x = number_jet(1);
    x.motion = 1;
    return x;
}

static pm_jet leaf(const pm_program_walk *x, const double *param, const double *value, double from, double to)
{
    if (x->op == PM_OP_ANSWER) return motion_jet();
    if (x->op != PM_OP_MEASURE) return number_jet(pm_program_number(x, param, value));
    if (PM_MEASURE_ROW(x->m, x->arg)[PM_MEASURE_KIND] != PM_MEASURE_TIME) return motion_jet();
    return time_jet(from, to);
}

static pm_jet select_jet(const pm_jet *a)
{
    pm_jet f = a->motion || !pm_jet_keeps_side(PM_OP_SELECT, a) ? pm_jet_hull(a + 1, a + 2)
               : a->at[1] != 0                                  ? a[1]
                                                                : a[2];
    for (int k = 0; k < 3; k++) f.at[k] = a->at[k] != 0 ? a[1].at[k] : a[2].at[k];
    f.motion |= a->motion;
    return f;
}

pm_interval pm_enclosure_sampled_bends(pm_interval seen, double nothing)
{
    const double more =
        PM_TIME_WIDER * pm_interval_width(seen) + PM_TIME_LEVEL * pm_interval_size(seen) + nothing;
    return (pm_interval){seen.lo - more, seen.hi + more};
}

/* The operation on a[0], a[1] ..; its result takes their place. */
static void operate(const pm_model *m, int op, int row, pm_jet *a, pm_enclosure *e)
{
    note_switches(m, op, row, a, e);
    if (pm_operation_of_table(op)) {
        *a = pm_jet_of_table(m, op, row, a);
        return;
    }
    switch (pm_operations[op].takes) {
    case 1: *a = pm_jet_of_one(op, a); break;
    case 2: *a = pm_jet_of_two(op, a, a + 1); break;
    default: *a = select_jet(a);
    }
}

pm_enclosure pm_enclosure_of_time(const pm_model *m, int index, const double *param, const double *value,
                                  double from, double to)
{
    pm_enclosure e = {.open = 0};
    pm_jet stack[PM_STACK];
    stack[0] = motion_jet();
    for (pm_program_walk x = pm_program_walk_begin(m, index); pm_program_walk_next(&x);) {
        if (x.takes == 0)
            stack[x.at] = leaf(&x, param, value, from, to);
        else
            operate(m, x.op, x.arg, stack + x.at, &e);
    }
    e.jet = stack[0];
    return e;
}

pm_jet pm_enclosure_of_series(const pm_chebyshev_series *series, double from, double to)
{
    const pm_chebyshev_part x = pm_chebyshev_series_over(series, from, to);
    return (pm_jet){{x.at[0], x.at[1], x.at[2]}, x.value, x.rate, x.bend, 0, 0};
}

/* What a switch makes of its operands a[0], a[1], as its sign says. */
static pm_jet branch_jet(int op, int sign, const pm_jet *a)
{
    const pm_jet turned = pm_jet_of_one(PM_OP_NEG, a);
    if (op == PM_OP_ABS) return sign < 0 ? turned : a[0];
    if (pm_operation_has(op, PM_OPERATION_JUMPS)) return number_jet(pm_operations[op].two(sign, 0));
    return a[op == PM_OP_MIN ? sign > 0 : sign < 0];
}

static int is_switch(const pm_program_step *s)
{
    return s->kind != STEP_SELECT && s->kind != STEP_TABLE && pm_operation_has(s->op, SWITCHES);
}

/* Along [from, to]; sign: of the switches that are given, NULL: none is. */
static pm_enclosure enclose(const pm_model *m, int index, const double *number,
                            const pm_measure_series *along, const signed char *sign, double from, double to)
{
    const pm_program_fold *f = m->programs.fold;
    pm_enclosure e = {.open = 0};
    pm_jet stack[PM_STACK + 1];
    int top = -1;
    stack[0] = motion_jet();
    for (int k = f->first[index]; k < f->first[index + 1]; k++) {
        const pm_program_step *s = &f->step[k];
        switch (s->kind) {
        case STEP_NUMBER: stack[++top] = number_jet(number[s->arg]); continue;
        case STEP_MEASURE:
            stack[++top] = pm_enclosure_of_series(along->series + along->place[s->arg], from, to);
            continue;
        case STEP_ANSWER: stack[++top] = motion_jet(); continue;
        case STEP_WITH_NUMBER: stack[top + 1] = number_jet(number[s->arg]); break;
        default: top -= pm_operations[s->op].takes - 1;
        }
        if (sign && is_switch(s))
            stack[top] = branch_jet(s->op, *sign++, stack + top);
        else
            operate(m, s->op, s->arg, stack + top, &e);
    }
    e.jet = stack[0];
    return e;
}

pm_enclosure pm_enclosure_along(const pm_model *m, int index, const double *number,
                                const pm_measure_series *along, double from, double to)
{
    return enclose(m, index, number, along, NULL, from, to);
}

pm_jet pm_enclosure_at(const pm_model *m, int index, const double *number, const pm_measure_series *along,
                       const signed char *sign, double s)
{
    return enclose(m, index, number, along, sign, s, s).jet;
}
