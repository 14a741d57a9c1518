/* program_rate.c - a program of the time alone with its first and second derivative by t, and the derivative of any program by
 * what it reads: every number on the stack carries both (forward differentiation).  Of f(a) they are
 *
 *   f' a'   and   f'' a'^2 + f' a''
 *
 * with f' the slope and f'' the bend of the operation.  Steps and kinks have the derivatives of one of their sides: where the
 * operands of min or max are equal, of the side on which the first is not less (enclosure_rules.c tells switches so). */
#include <math.h>

#include "expression/operation.h"
#include "expression/piecewise.h"
#include "expression/program.h"
#include "numerics/tolerances.h"

typedef struct pm_timed {
    double x, rate, change; /* value, d/dt, d2/dt2 */
} pm_timed;

typedef struct pm_shape {
    double slope, bend; /* of an operation at its argument */
} pm_shape;

/* At the argument a, where the value is x. */
static pm_shape shape_of(int op, double a, double x)
{
    switch (op) {
    case PM_OP_NEG: return (pm_shape){-1, 0};
    case PM_OP_SIN: return (pm_shape){cos(a), -x};
    case PM_OP_COS: return (pm_shape){-sin(a), -x};
    case PM_OP_TAN: return (pm_shape){1 + x * x, 2 * x * (1 + x * x)};
    case PM_OP_ASIN: return (pm_shape){1 / sqrt(1 - a * a), a / pow(1 - a * a, 1.5)};
    case PM_OP_ACOS: return (pm_shape){-1 / sqrt(1 - a * a), -a / pow(1 - a * a, 1.5)};
    case PM_OP_ATAN: return (pm_shape){1 / (1 + a * a), -2 * a / ((1 + a * a) * (1 + a * a))};
    case PM_OP_TANH: return (pm_shape){1 - x * x, -2 * x * (1 - x * x)};
    case PM_OP_SQRT: return (pm_shape){0.5 / x, -0.25 / (x * a)};
    case PM_OP_ABS: return (pm_shape){a < 0 ? -1 : 1, 0};
    case PM_OP_EXP: return (pm_shape){x, x};
    case PM_OP_LOG: return (pm_shape){1 / a, -1 / (a * a)};
    default: return (pm_shape){0, 0}; /* not, floor, sign */
    }
}

/* A function of a that is x there. */
static pm_timed along(pm_shape f, pm_timed a, double x)
{
    const double bent = a.rate == 0 ? 0 : f.bend * a.rate * a.rate;
    return (pm_timed){x, a.rate == 0 ? 0 : f.slope * a.rate, bent + (a.change == 0 ? 0 : f.slope * a.change)};
}

static pm_timed unary(int op, pm_timed a)
{
    const double x = pm_operations[op].one(a.x);
    return a.rate == 0 && a.change == 0 ? (pm_timed){x, 0, 0} : along(shape_of(op, a.x, x), a, x);
}

static pm_timed product(pm_timed a, pm_timed b)
{
    return (pm_timed){a.x * b.x, a.rate * b.x + a.x * b.rate,
                      a.change * b.x + 2 * a.rate * b.rate + a.x * b.change};
}

static pm_timed ratio(pm_timed a, pm_timed b, double x)
{
    if (isinf(b.x) && isfinite(a.x)) return (pm_timed){x, 0, 0}; /* nothing, and so is what changes */
    const double rate = (a.rate - x * b.rate) / b.x;
    return (pm_timed){x, rate, (a.change - 2 * rate * b.rate - x * b.change) / b.x};
}

static int changes(pm_timed a) { return a.rate != 0 || a.change != 0; }

/* a to a constant power n. */
static pm_timed power_of(pm_timed a, double n, double x)
{
    if (!changes(a) || n == 0) return (pm_timed){x, 0, 0};
    const double slope = n * pow(a.x, n - 1), bend = n == 1 ? 0 : n * (n - 1) * pow(a.x, n - 2);
    return (pm_timed){x, slope * a.rate, (a.rate == 0 ? 0 : bend * a.rate * a.rate) + slope * a.change};
}

/* exp(l), l = b log a */
static pm_timed power(pm_timed a, pm_timed b, double x)
{
    if (!changes(b)) return power_of(a, b.x, x);
    const pm_timed log_a = unary(PM_OP_LOG, a), l = product(b, log_a);
    return (pm_timed){x, x * l.rate, x * (l.change + l.rate * l.rate)};
}

static pm_timed direction(pm_timed a, pm_timed b, double x)
{
    const double square = a.x * a.x + b.x * b.x, rate = (a.rate * b.x - a.x * b.rate) / square;
    const double change = a.change * b.x - a.x * b.change - 2 * rate * (a.x * a.rate + b.x * b.rate);
    return (pm_timed){x, rate, change / square};
}

static pm_timed size(pm_timed a, pm_timed b, double x)
{
    const double rate = (a.x * a.rate + b.x * b.rate) / x, squares = a.rate * a.rate + b.rate * b.rate;
    return (pm_timed){x, rate, (squares + a.x * a.change + b.x * b.change - rate * rate) / x};
}

static pm_timed binary(int op, pm_timed a, pm_timed b)
{
    const double x = pm_operations[op].two(a.x, b.x);
    switch (op) {
    case PM_OP_ADD: return (pm_timed){x, a.rate + b.rate, a.change + b.change};
    case PM_OP_SUB: return (pm_timed){x, a.rate - b.rate, a.change - b.change};
    case PM_OP_MUL: return product(a, b);
    case PM_OP_DIV: return ratio(a, b, x);
    case PM_OP_POW: return power(a, b, x);
    case PM_OP_ATAN2: return direction(a, b, x);
    case PM_OP_HYPOT: return size(a, b, x);
    case PM_OP_MIN: return x == b.x ? b : (pm_timed){x, a.rate, a.change}; /* x may be no number */
    case PM_OP_MAX: return x == a.x ? a : (pm_timed){x, b.rate, b.change};
    default: return (pm_timed){x, 0, 0}; /* comparisons, logic */
    }
}

/* x and the number of a piece. */
static pm_timed look_up(const pm_program_walk *x, const pm_timed *a)
{
    const pm_piecewise p = pm_piecewise_of(x->m, x->arg);
    if (x->op == PM_OP_KNOT) return (pm_timed){pm_piecewise_begin(&p, round(a->x)), 0, 0};
    const double n = x->op == PM_OP_PIECE ? round(a[1].x) : pm_piecewise_number(&p, a->x);
    double derivative[3];
    const double value = pm_piecewise_piece(&p, n, a->x, derivative);
    return along((pm_shape){derivative[0], derivative[1]}, *a, value);
}

/* What an instruction without operands pushes; of: the reader's own. */
typedef pm_timed pm_push(const pm_program_walk *x, const void *of);

static inline pm_timed run(const pm_model *m, int index, pm_push *push, const void *of)
{
    pm_timed stack[PM_STACK];
    stack[0] = stack[1] = stack[2] =
        (pm_timed){NAN, NAN, NAN}; /* no valid code reads them before they are pushed */
    for (pm_program_walk x = pm_program_walk_begin(m, index); pm_program_walk_next(&x);) {
        pm_timed *a = stack + x.at;
        if (pm_operation_of_table(x.op)) {
            *a = look_up(&x, a);
            continue;
        }
        switch (x.takes) {
        case 0: *a = push(&x, of); break;
        case 1: *a = unary(x.op, *a); break;
        case 2: *a = binary(x.op, a[0], a[1]); break;
        default: *a = a[0].x != 0 ? a[1] : a[2];
        }
    }
    return stack[0];
}

typedef struct pm_at_time {
    const double *param, *value;
    double t;
} pm_at_time;

static pm_timed time_or_number(const pm_program_walk *x, const void *of)
{
    const pm_at_time *at = of;
    if (x->op == PM_OP_MEASURE) return (pm_timed){at->t, 1, 0}; /* check.c allows no other */
    return (pm_timed){pm_program_number(x, at->param, at->value), 0, 0};
}

double pm_program_of_time(const pm_model *m, int index, const double *param, const double *value, double t,
                          double derivative[2])
{
    const pm_timed x = run(m, index, time_or_number, &(pm_at_time){param, value, t});
    derivative[0] = x.rate;
    derivative[1] = x.change;
    return x.x;
}

/* One reading of a measure changes, and nothing else. */
typedef struct pm_at_reading {
    pm_workspace *w;
    const int32_t *next; /* of the walk that has come to it */
    double moved;        /* by so much of itself, or of 1 */
} pm_at_reading;

static pm_timed measure_or_number(const pm_program_walk *x, const void *of)
{
    const pm_at_reading *at = of;
    const pm_numbers *numbers = &at->w->numbers;
    if (x->op <= PM_OP_VALUE) return (pm_timed){pm_program_number(x, numbers->param, numbers->value), 0, 0};
    if (x->op == PM_OP_ANSWER) return (pm_timed){at->w->result.out[x->arg], 0, 0};
    const double value = at->w->read_measure(at->w, x->arg);
    const double sign = pm_program_takes_size(x->m, x->arg) && value < 0 ? -1 : 1;
    if (x->next != at->next) return (pm_timed){sign * value, 0, 0};
    return (pm_timed){sign * (value + at->moved * (1 + fabs(value))), sign, 0};
}

/* Where there is no derivative (the length of a vector that is zero) that to the side that is ahead, by a difference. */
double pm_program_slope(pm_workspace *w, int index, const pm_program_walk *reading)
{
    const pm_timed here = run(w->model, index, measure_or_number, &(pm_at_reading){w, reading->next, 0});
    if (isfinite(here.rate)) return here.rate;
    const double by = PM_PROGRAM_AHEAD * (1 + fabs(w->read_measure(w, reading->arg)));
    const pm_at_reading moved = {w, reading->next, PM_PROGRAM_AHEAD};
    const double slope = (run(w->model, index, measure_or_number, &moved).x - here.x) / by;
    return isfinite(slope) ? slope : 0;
}
