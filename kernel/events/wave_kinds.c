/* wave_kinds.c - what a program may have along a step, by its operations.
 *
 * A step is as long as the motion allows, so that its nodes show places and speeds, and products of two of them: energies,
 * moments.  A product of more turns as many times as fast as they do: cos^8 of an angle is a narrow peak. */
#include "events/wave_kinds.h"

#include "expression/operation.h"
#include "expression/program.h"
#include "expression/program_fold.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"

enum { SWITCHES = PM_OPERATION_JUMPS | PM_OPERATION_CORNERS | PM_OPERATION_COUNTS };

int pm_wave_kinds_distance(const pm_model *m, int measure)
{
    const int32_t *e = PM_MEASURE_ROW(m, measure);
    switch ((enum pm_measure_kind)e[PM_MEASURE_KIND]) {
    case PM_MEASURE_FORCE_STRETCH:
    case PM_MEASURE_FORCE_RATE:
    case PM_MEASURE_FORCE_ENERGY: return 1;
    case PM_MEASURE_POSITION:
    case PM_MEASURE_MOVED:
    case PM_MEASURE_VELOCITY:
    case PM_MEASURE_MOMENTUM:
        return e[PM_MEASURE_PART] == PM_PART_NORM || e[PM_MEASURE_PART] == PM_PART_ANGLE;
    case PM_MEASURE_CONTACT_GAP:
        return PM_CONTACT_ROW(m, e[PM_MEASURE_A])[PM_CONTACT_KIND] == PM_CONTACT_CORD;
    default: return 0;
    }
}

/* What a step of a program may have that its operands have not. */
static int more_than_operands(const pm_model *m, const pm_program_step *s)
{
    const int op = s->op;
    switch (s->kind) {
    case STEP_MEASURE: return pm_wave_kinds_distance(m, s->arg) ? PM_WAVES_DISTANCES : PM_WAVES_NONE;
    case STEP_NUMBER:
    case STEP_ANSWER: return PM_WAVES_NONE;
    case STEP_TABLE:
        return op == PM_OP_PIECEWISE ? PM_WAVES_ANY : PM_WAVES_NONE; /* a piece is a polynomial */
    default:
        if (op == PM_OP_NEG || op == PM_OP_ADD || op == PM_OP_SUB || op == PM_OP_MUL ||
            (op == PM_OP_DIV && s->kind == STEP_WITH_NUMBER))
            return PM_WAVES_NONE;
        return op == PM_OP_SELECT || pm_operation_has(op, SWITCHES) ? PM_WAVES_SWITCHES_ONLY : PM_WAVES_ANY;
    }
}

/* The size of something has a corner at zero: that is seen where it is read. */
static int is_size(const pm_model *m, const pm_program_step *s)
{
    return s->kind == STEP_MEASURE && pm_program_takes_size(m, s->arg);
}

/* ---- degree ---- */
/* Of what a program reads: a number between instants has none. */
static int degree_of_measure(const pm_program_walk *x, const void *of)
{
    (void)of;
    if (x->op != PM_OP_MEASURE) return 0;
    switch ((enum pm_measure_kind)PM_MEASURE_ROW(x->m, x->arg)[PM_MEASURE_KIND]) {
    case PM_MEASURE_MASS:
    case PM_MEASURE_WEIGHT:
    case PM_MEASURE_CONTACT_CLOSED:
    case PM_MEASURE_EVENT_COUNT:
    case PM_MEASURE_EVENT_TIME:
    case PM_MEASURE_EVENT_SIDE: return 0;
    case PM_MEASURE_KINETIC:
    case PM_MEASURE_TOTAL:
    case PM_MEASURE_ANGULAR_MOMENTUM:
    case PM_MEASURE_JOINT_POWER:
    case PM_MEASURE_FORCE_POWER:
    case PM_MEASURE_FORCE_ENERGY: return 2;
    default: return 1;
    }
}

/* A yes or no is the same between its switches. */
static int degree_kept(const pm_program_walk *x, int a)
{
    return pm_operation_has(x->op, PM_OPERATION_COUNTS) && a < PM_WAVES_DEGREE ? 0 : a;
}

static int degree_of_two(const pm_program_walk *x, int a, int b)
{
    return x->op == PM_OP_MUL ? pm_min(a + b, PM_WAVES_DEGREE) : degree_kept(x, pm_max(a, b));
}

/* Of a program of sums, products and switches, as a polynomial of its measures; PM_WAVES_DEGREE: so high, or more. */
static int degree_of(const pm_model *m, int program)
{
    static const pm_program_rules rules = {degree_of_measure, degree_kept, degree_of_two};
    return pm_program_rules_apply(m, program, &rules, NULL);
}

/* The most that a step of the program has; an answer would be no polynomial. */
int pm_wave_kinds_of(const pm_model *m, int program)
{
    const pm_program_fold *f = m->programs.fold;
    int most = PM_WAVES_NONE;
    for (int k = f->first[program]; k < f->first[program + 1]; k++) {
        const int more = more_than_operands(m, &f->step[k]);
        if (f->step[k].kind == STEP_ANSWER) return PM_WAVES_NONE;
        if (more > most) most = more;
        k += is_size(m, &f->step[k]);
    }
    return degree_of(m, program) < PM_WAVES_DEGREE ? most : PM_WAVES_ANY;
}
