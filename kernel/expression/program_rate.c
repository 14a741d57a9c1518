/* program_rate.c - a program of the time alone with its rate: every number on the stack carries its derivative by t
 * (forward differentiation).  Steps and kinks have the rate of one of their sides. */
#include <math.h>

#include "expression/operation.h"
#include "expression/piecewise.h"
#include "expression/program.h"

typedef struct pm_timed {
    double x, rate;
} pm_timed;

static pm_timed unary(int op, pm_timed a)
{
    const double x = pm_operations[op].one(a.x);
    double slope;
    switch (op) {
    case PM_OP_NEG: slope = -1; break;
    case PM_OP_SIN: slope = cos(a.x); break;
    case PM_OP_COS: slope = -sin(a.x); break;
    case PM_OP_TAN: slope = 1 + x * x; break;
    case PM_OP_ASIN: slope = 1 / sqrt(1 - a.x * a.x); break;
    case PM_OP_ACOS: slope = -1 / sqrt(1 - a.x * a.x); break;
    case PM_OP_ATAN: slope = 1 / (1 + a.x * a.x); break;
    case PM_OP_TANH: slope = 1 - x * x; break;
    case PM_OP_SQRT: slope = 0.5 / x; break;
    case PM_OP_ABS: slope = a.x < 0 ? -1 : 1; break;
    case PM_OP_EXP: slope = x; break;
    case PM_OP_LOG: slope = 1 / a.x; break;
    default: slope = 0; /* not, floor */
    }
    return (pm_timed){x, a.rate == 0 ? 0 : slope * a.rate};
}

static double power_rate(pm_timed a, pm_timed b, double x)
{
    const double by_base = a.rate == 0 ? 0 : b.x * pow(a.x, b.x - 1) * a.rate;
    return by_base + (b.rate == 0 ? 0 : x * log(a.x) * b.rate);
}

static pm_timed binary(int op, pm_timed a, pm_timed b)
{
    const double x = pm_operations[op].two(a.x, b.x), square = a.x * a.x + b.x * b.x;
    double rate;
    switch (op) {
    case PM_OP_ADD: rate = a.rate + b.rate; break;
    case PM_OP_SUB: rate = a.rate - b.rate; break;
    case PM_OP_MUL: rate = a.rate * b.x + a.x * b.rate; break;
    case PM_OP_DIV: rate = (a.rate - x * b.rate) / b.x; break;
    case PM_OP_POW: rate = power_rate(a, b, x); break;
    case PM_OP_ATAN2: rate = (a.rate * b.x - a.x * b.rate) / square; break;
    case PM_OP_HYPOT: rate = (a.x * a.rate + b.x * b.rate) / x; break;
    case PM_OP_MIN:
    case PM_OP_MAX: rate = x == a.x ? a.rate : b.rate; break;
    default: rate = 0; /* comparisons, logic */
    }
    return (pm_timed){x, rate};
}

/* x and the number of a piece. */
static pm_timed look_up(const pm_program_walk *x, const pm_timed *a)
{
    const pm_piecewise p = pm_piecewise_of(x->m, x->arg);
    if (x->op == PM_OP_KNOT) return (pm_timed){pm_piecewise_begin(&p, round(a->x)), 0};
    const double n = x->op == PM_OP_PIECE ? round(a[1].x) : pm_piecewise_number(&p, a->x);
    double derivative[3];
    const double value = pm_piecewise_piece(&p, n, a->x, derivative);
    return (pm_timed){value, a->rate == 0 ? 0 : derivative[0] * a->rate};
}

double pm_program_of_time(const pm_model *m, int index, const double *param, const double *value, double t,
                          double *rate)
{
    pm_timed stack[PM_STACK];
    stack[0] = stack[1] = stack[2] =
        (pm_timed){NAN, NAN}; /* no valid code reads them before they are pushed */
    for (pm_program_walk x = pm_program_walk_begin(m, index); pm_program_walk_next(&x);) {
        pm_timed *a = stack + x.at;
        if (pm_operation_of_table(x.op)) {
            *a = look_up(&x, a);
            continue;
        }
        switch (x.takes) {
        case 0: /* check.c allows no measure but the time */
            *a =
                x.op == PM_OP_MEASURE ? (pm_timed){t, 1} : (pm_timed){pm_program_number(&x, param, value), 0};
            break;
        case 1: *a = unary(x.op, *a); break;
        case 2: *a = binary(x.op, a[0], a[1]); break;
        default: *a = a[0].x != 0 ? a[1] : a[2];
        }
    }
    *rate = stack[0].rate;
    return stack[0].x;
}
