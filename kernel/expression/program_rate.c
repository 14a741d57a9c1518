/* program_rate.c - a program of the time alone with its rate: every number on the stack carries its derivative by t
 * (forward differentiation).  Steps and kinks have the rate of one of their sides. */
#include <math.h>

#include "expression/program.h"

typedef struct pm_timed {
    double x, rate;
} pm_timed;

static pm_timed unary(int op, pm_timed a)
{
    const double x = pm_program_unary(op, a.x);
    double slope;
    switch (op) {
    case PM_OP_NEG: slope = -1; break;
    case PM_OP_SIN: slope = cos(a.x); break;
    case PM_OP_COS: slope = -sin(a.x); break;
    case PM_OP_TAN: slope = 1 + x * x; break;
    case PM_OP_ASIN: slope = 1 / sqrt(1 - a.x * a.x); break;
    case PM_OP_ACOS: slope = -1 / sqrt(1 - a.x * a.x); break;
    case PM_OP_ATAN: slope = 1 / (1 + a.x * a.x); break;
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
    const double x = pm_program_binary(op, a.x, b.x), square = a.x * a.x + b.x * b.x;
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

double pm_program_of_time(const pm_model *m, int index, const double *param, const double *value, double t,
                          double *rate)
{
    const int32_t *program = pm_table_row(m, PM_TABLE_PROGRAM, index, PM_PROGRAM_COLUMNS);
    const int32_t *code = pm_table_row(m, PM_TABLE_CODE, program[PM_PROGRAM_FIRST], PM_CODE_COLUMNS);
    pm_timed stack[PM_STACK];
    int top = -1;
    for (int i = 0; i < program[PM_PROGRAM_LENGTH]; i++, code += PM_CODE_COLUMNS) {
        const int op = code[PM_CODE_OP], arg = code[PM_CODE_ARG];
        switch (op) {
        case PM_OP_CONSTANT: stack[++top] = (pm_timed){m->constant[arg], 0}; break;
        case PM_OP_PARAMETER: stack[++top] = (pm_timed){param[arg], 0}; break;
        case PM_OP_VALUE: stack[++top] = (pm_timed){value[arg], 0}; break;
        case PM_OP_MEASURE: stack[++top] = (pm_timed){t, 1}; break; /* build.c allows the time only */
        case PM_OP_SELECT:
            top -= 2;
            stack[top] = stack[top].x != 0 ? stack[top + 1] : stack[top + 2];
            break;
        default:
            if (pm_program_operands(op) == 1) {
                stack[top] = unary(op, stack[top]);
            } else {
                top--;
                stack[top] = binary(op, stack[top], stack[top + 1]);
            }
        }
    }
    *rate = stack[0].rate;
    return stack[0].x;
}
