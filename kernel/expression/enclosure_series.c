/* enclosure_series.c - a sharper bound of a program's bends over a part of a step, by Taylor series of high order
 * (numerics/ball_series.h).
 *
 * What is long beside its own changes - the distance from a pole on a circle about it - has bounds by intervals that are out
 * of all proportion, however short the parts are: x^2 + y^2 is taken as if x and y had nothing to do with each other. */
#include "expression/enclosure.h"
#include "expression/operation.h"
#include "expression/program_fold.h"
#include "numerics/ball_series.h"

/* Whether x is above zero, or below; 0: either. */
static int side_of(const pm_ball_series *x)
{
    const pm_interval value = pm_ball_interval(x->c[0]);
    return (value.lo > 0) - (value.hi < 0);
}

static pm_ball_series negative(const pm_ball_series *a)
{
    const pm_ball_series none = pm_ball_series_number(0);
    return pm_ball_series_sum(&none, a, -1);
}

static pm_ball_series unary(int op, const pm_ball_series *a)
{
    switch (op) {
    case PM_OP_NEG: return negative(a);
    case PM_OP_SIN: return pm_ball_series_sin(a);
    case PM_OP_COS: return pm_ball_series_cos(a);
    case PM_OP_TAN: return pm_ball_series_tan(a);
    case PM_OP_ASIN: return pm_ball_series_asin(a);
    case PM_OP_ACOS: return pm_ball_series_acos(a);
    case PM_OP_ATAN: return pm_ball_series_atan(a);
    case PM_OP_TANH: return pm_ball_series_tanh(a);
    case PM_OP_SQRT: return pm_ball_series_sqrt(a);
    case PM_OP_EXP: return pm_ball_series_exp(a);
    case PM_OP_LOG: return pm_ball_series_log(a);
    case PM_OP_ABS: return side_of(a) > 0 ? *a : side_of(a) < 0 ? negative(a) : pm_ball_series_unknown();
    default: return pm_ball_series_unknown(); /* not, floor: intervals tell as much */
    }
}

/* The first where a is on that side of b, the other one where it is on the other. */
static pm_ball_series either(const pm_ball_series *a, const pm_ball_series *b, int side)
{
    const pm_ball_series apart = pm_ball_series_sum(a, b, -1);
    const int stands = side_of(&apart);
    return stands == 0 ? pm_ball_series_unknown() : stands == side ? *a : *b;
}

static pm_ball_series binary(int op, const pm_ball_series *a, const pm_ball_series *b)
{
    switch (op) {
    case PM_OP_ADD: return pm_ball_series_sum(a, b, 1);
    case PM_OP_SUB: return pm_ball_series_sum(a, b, -1);
    case PM_OP_MUL: return pm_ball_series_product(a, b);
    case PM_OP_DIV: return pm_ball_series_quotient(a, b);
    case PM_OP_POW: return pm_ball_series_power(a, b);
    case PM_OP_ATAN2: return pm_ball_series_atan2(a, b);
    case PM_OP_HYPOT: return pm_ball_series_hypot(a, b);
    case PM_OP_MIN: return either(a, b, -1);
    case PM_OP_MAX: return either(a, b, 1);
    default: return pm_ball_series_unknown(); /* comparisons, logic */
    }
}

static pm_ball_series choice(const pm_ball_series *a)
{
    if (side_of(a) != 0) return a[1];
    return a->c[0].at == 0 && a->c[0].by == 0 ? a[2] : pm_ball_series_unknown();
}

typedef struct pm_stretch {
    const pm_measure_series *along;
    double middle, half;
    int wide; /* all over it, not at its middle */
} pm_stretch;

/* What a step pushes that takes no operand. */
static pm_ball_series leaf(const pm_program_step *s, const double *number, const pm_stretch *x)
{
    const pm_measure_series *along = x->along;
    if (s->kind == STEP_ANSWER) return pm_ball_series_unknown();
    if (s->kind != STEP_MEASURE) return pm_ball_series_number(number[s->arg]);
    return pm_ball_series_of(along->series + along->place[s->arg], x->middle, x->half, x->wide);
}

static pm_ball_series operate(const pm_program_step *s, const pm_ball_series *a)
{
    if (s->kind == STEP_TABLE) return pm_ball_series_unknown();
    switch (pm_operations[s->op].takes) {
    case 1: return unary(s->op, a);
    case 2: return binary(s->op, a, a + 1);
    default: return choice(a);
    }
}

static pm_ball_series over(const pm_model *m, int index, const double *number, const pm_stretch *x)
{
    const pm_program_fold *f = m->programs.fold;
    pm_ball_series stack[PM_STACK + 1];
    int top = -1;
    stack[0] = pm_ball_series_unknown();
    for (int k = f->first[index]; k < f->first[index + 1]; k++) {
        const pm_program_step *s = &f->step[k];
        if (s->kind == STEP_NUMBER || s->kind == STEP_MEASURE || s->kind == STEP_ANSWER) {
            stack[++top] = leaf(s, number, x);
            continue;
        }
        if (s->kind == STEP_WITH_NUMBER)
            stack[top + 1] = pm_ball_series_number(number[s->arg]);
        else
            top -= pm_operations[s->op].takes - 1;
        stack[top] = operate(s, stack + top);
    }
    return stack[0];
}

pm_interval pm_enclosure_bends_along(const pm_model *m, int index, const double *number,
                                     const pm_measure_series *along, double from, double to)
{
    const double half = 0.5 * (to - from);
    pm_stretch x = {along, 0.5 * (from + to), half, 0};
    const pm_ball_series middle = over(m, index, number, &x);
    x.wide = 1;
    const pm_ball_series wide = over(m, index, number, &x);
    const pm_interval bends = pm_ball_series_bend(&middle, &wide);
    return (pm_interval){bends.lo / (half * half), bends.hi / (half * half)};
}
