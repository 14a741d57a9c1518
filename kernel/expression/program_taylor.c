/* program_taylor.c - a program of the parameter of a curve with its first three derivatives: every number on the stack is
 * a Taylor series of it (numerics/taylor.h).
 *
 * What switches (a comparison, abs, min, floor) is taken as the branch on which it stands: a curve has corners there, of
 * which its derivatives on either side know nothing. */
#include <math.h>

#include "expression/operation.h"
#include "expression/piecewise.h"
#include "expression/program.h"

static pm_taylor negative(const pm_taylor *a)
{
    const pm_taylor none = pm_taylor_number(0);
    return pm_taylor_sum(&none, a, -1);
}

static pm_taylor unary(int op, const pm_taylor *a)
{
    switch (op) {
    case PM_OP_NEG: return negative(a);
    case PM_OP_SIN: return pm_taylor_sin(a);
    case PM_OP_COS: return pm_taylor_cos(a);
    case PM_OP_TAN: return pm_taylor_tan(a);
    case PM_OP_ASIN: return pm_taylor_asin(a);
    case PM_OP_ACOS: return pm_taylor_acos(a);
    case PM_OP_ATAN: return pm_taylor_atan(a);
    case PM_OP_TANH: return pm_taylor_tanh(a);
    case PM_OP_SQRT: return pm_taylor_sqrt(a);
    case PM_OP_EXP: return pm_taylor_exp(a);
    case PM_OP_LOG: return pm_taylor_log(a);
    case PM_OP_ABS: return a->c[0] < 0 ? negative(a) : *a;
    default: return pm_taylor_number(pm_operations[op].one(a->c[0])); /* not, floor */
    }
}

static pm_taylor binary(int op, const pm_taylor *a, const pm_taylor *b)
{
    switch (op) {
    case PM_OP_ADD: return pm_taylor_sum(a, b, 1);
    case PM_OP_SUB: return pm_taylor_sum(a, b, -1);
    case PM_OP_MUL: return pm_taylor_product(a, b);
    case PM_OP_DIV: return pm_taylor_quotient(a, b);
    case PM_OP_POW: return pm_taylor_power(a, b);
    case PM_OP_ATAN2: return pm_taylor_atan2(a, b);
    case PM_OP_HYPOT: return pm_taylor_hypot(a, b);
    case PM_OP_MIN: return a->c[0] < b->c[0] ? *a : *b;
    case PM_OP_MAX: return a->c[0] > b->c[0] ? *a : *b;
    default: return pm_taylor_number(pm_operations[op].two(a->c[0], b->c[0])); /* comparisons, logic */
    }
}

/* f(a), by the derivatives of f on that piece of the table in which `of` lies. */
static pm_taylor piece(const pm_model *m, int table, const pm_taylor *a, double of)
{
    const pm_piecewise p = pm_piecewise_of(m, table);
    const double *c = a->c;
    double d[3];
    const double f = pm_piecewise_piece(&p, pm_piecewise_number(&p, of), c[0], d);
    return (pm_taylor){{f, d[0] * c[1], d[0] * c[2] + 0.5 * d[1] * c[1] * c[1],
                        d[0] * c[3] + d[1] * c[1] * c[2] + d[2] * c[1] * c[1] * c[1] / 6}};
}

pm_taylor pm_program_of_place(const pm_model *m, int index, const double *param, const double *value,
                              double s, double of)
{
    pm_taylor stack[PM_STACK];
    stack[0] = stack[1] = stack[2] =
        pm_taylor_number(NAN); /* no valid code reads them before they are pushed */
    for (pm_program_walk x = pm_program_walk_begin(m, index); pm_program_walk_next(&x);) {
        pm_taylor *a = stack + x.at;
        switch (x.takes) {
        case 0: /* check.c allows no measure but the place on the curve */
            *a = x.op == PM_OP_MEASURE ? pm_taylor_variable(s)
                                       : pm_taylor_number(pm_program_number(&x, param, value));
            break;
        case 1: *a = x.op == PM_OP_PIECEWISE ? piece(m, x.arg, a, of) : unary(x.op, a); break;
        case 2: *a = binary(x.op, &a[0], &a[1]); break;
        default: *a = a[0].c[0] != 0 ? a[1] : a[2];
        }
    }
    return stack[0];
}
