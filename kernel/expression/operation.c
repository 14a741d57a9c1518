/* operation.c - the table of operations.  A comparison with a not-a-number is false; arithmetic keeps it. */
#include "expression/operation.h"

#include <math.h>

static double negative(double a) { return -a; }
static double is_not(double a) { return a == 0; }
static double sum(double a, double b) { return a + b; }
static double difference(double a, double b) { return a - b; }
static double product(double a, double b) { return a * b; }
static double quotient(double a, double b) { return a / b; }
static double is_less(double a, double b) { return a < b; }
static double is_at_most(double a, double b) { return a <= b; }
static double is_greater(double a, double b) { return a > b; }
static double is_at_least(double a, double b) { return a >= b; }
static double is_equal(double a, double b) { return a == b; }
static double is_other(double a, double b) { return a != b; }
static double are_both(double a, double b) { return a != 0 && b != 0; }
static double is_either(double a, double b) { return a != 0 || b != 0; }
/* fmin and fmax would drop a not-a-number: here it must stay visible. */
static double lesser(double a, double b) { return isnan(a) || a < b ? a : b; }
static double greater(double a, double b) { return isnan(a) || a > b ? a : b; }

enum {
    COMPARES = PM_OPERATION_JUMPS | PM_OPERATION_COUNTS,
    CORNERS = PM_OPERATION_CORNERS,
    COUNTS = PM_OPERATION_COUNTS,
    RISES = PM_OPERATION_RISES
};

const pm_operation pm_operations[PM_OPS] = {
    [PM_OP_CONSTANT] = {0},
    [PM_OP_PARAMETER] = {0},
    [PM_OP_VALUE] = {0},
    [PM_OP_MEASURE] = {0},
    [PM_OP_ANSWER] = {0},
    [PM_OP_NEG] = {1, .one = negative},
    [PM_OP_NOT] = {1, COUNTS, .one = is_not},
    [PM_OP_SIN] = {1, .one = sin},
    [PM_OP_COS] = {1, .one = cos},
    [PM_OP_TAN] = {1, .one = tan},
    [PM_OP_ASIN] = {1, .one = asin},
    [PM_OP_ACOS] = {1, .one = acos},
    [PM_OP_ATAN] = {1, RISES, .one = atan},
    [PM_OP_TANH] = {1, RISES, .one = tanh},
    [PM_OP_SQRT] = {1, RISES, .one = sqrt},
    [PM_OP_ABS] = {1, CORNERS, .one = fabs},
    [PM_OP_EXP] = {1, RISES, .one = exp},
    [PM_OP_LOG] = {1, RISES, .one = log},
    [PM_OP_FLOOR] = {1, COUNTS, .one = floor},
    [PM_OP_ADD] = {2, .two = sum},
    [PM_OP_SUB] = {2, .two = difference},
    [PM_OP_MUL] = {2, .two = product},
    [PM_OP_DIV] = {2, .two = quotient},
    [PM_OP_POW] = {2, .two = pow},
    [PM_OP_LT] = {2, COMPARES, .two = is_less},
    [PM_OP_LE] = {2, COMPARES, .two = is_at_most},
    [PM_OP_GT] = {2, COMPARES, .two = is_greater},
    [PM_OP_GE] = {2, COMPARES, .two = is_at_least},
    [PM_OP_EQ] = {2, COMPARES, .two = is_equal},
    [PM_OP_NE] = {2, COMPARES, .two = is_other},
    [PM_OP_AND] = {2, COUNTS, .two = are_both},
    [PM_OP_OR] = {2, COUNTS, .two = is_either},
    [PM_OP_ATAN2] = {2, .two = atan2},
    [PM_OP_MIN] = {2, CORNERS, .two = lesser},
    [PM_OP_MAX] = {2, CORNERS, .two = greater},
    [PM_OP_HYPOT] = {2, .two = hypot},
    [PM_OP_SELECT] = {3},
    [PM_OP_PIECEWISE] = {1}, /* these three: expression/piecewise.c */
    [PM_OP_PIECE] = {2},
    [PM_OP_KNOT] = {1},
};

int pm_program_rules_apply(const pm_model *m, int program, const pm_program_rules *rules, const void *of)
{
    int stack[PM_STACK];
    for (pm_program_walk x = pm_program_walk_begin(m, program); pm_program_walk_next(&x);) {
        int *a = stack + x.at;
        if (x.takes == 0) *a = rules->read(&x, of);
        if (x.takes == 1) *a = rules->one(&x, *a);
        for (int k = 1; k < x.takes; k++) *a = rules->two(&x, *a, a[k]);
    }
    return stack[0];
}

int pm_program_walk_reads(const pm_model *m, int program, pm_measure_is *is)
{
    for (pm_program_walk x = pm_program_walk_begin(m, program); pm_program_walk_next(&x);)
        if (x.op == PM_OP_MEASURE && is(m, x.arg)) return x.arg;
    return PM_NONE;
}
