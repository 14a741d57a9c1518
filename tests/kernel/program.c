/* Programs: every operation against libm, the stack's limits, not-a-number. */
#include "expression/program.h"

#include "elements/measure.h"
#include "numerics/chebyshev_nodes.h"

#include "check.h"
#include "scene.h"
#include "state/workspace.h"

/* The value of a program of constants and operations, by way of the value table. */
static double value_of(const scene_code *code, int n, scene *s)
{
    scene_value_of(s, scene_program(s, n, code));
    double result = NAN;
    if (CHECK(scene_open(s) == PM_OK))
        result = pm_program_value(s->model, s->rows[PM_TABLE_PROGRAM] - 1, NULL, s->w->numbers.value);
    scene_free(s);
    return result;
}

static double unary(int op, double a)
{
    scene *s = scene_create();
    const scene_code code[] = {scene_k(s, a), scene_op(op)};
    return value_of(code, 2, s);
}

static double binary(int op, double a, double b)
{
    scene *s = scene_create();
    const scene_code code[] = {scene_k(s, a), scene_k(s, b), scene_op(op)};
    return value_of(code, 3, s);
}

static double choose(double c, double a, double b)
{
    scene *s = scene_create();
    const scene_code code[] = {scene_k(s, c), scene_k(s, a), scene_k(s, b), scene_op(PM_OP_SELECT)};
    return value_of(code, 4, s);
}

static void unary_operations(void)
{
    static const double places[] = {-2.385, -0.7, 0, 0.31, 0.999, 17.25};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const double a = places[i];
        EQUAL(unary(PM_OP_NEG, a), -a);
        EQUAL(unary(PM_OP_NOT, a), a == 0);
        EQUAL(unary(PM_OP_SIN, a), sin(a));
        EQUAL(unary(PM_OP_COS, a), cos(a));
        EQUAL(unary(PM_OP_TAN, a), tan(a));
        EQUAL(unary(PM_OP_ASIN, a), asin(a));
        EQUAL(unary(PM_OP_ACOS, a), acos(a));
        EQUAL(unary(PM_OP_ATAN, a), atan(a));
        EQUAL(unary(PM_OP_SQRT, a), sqrt(a));
        EQUAL(unary(PM_OP_ABS, a), fabs(a));
        EQUAL(unary(PM_OP_EXP, a), exp(a));
        EQUAL(unary(PM_OP_TANH, a), tanh(a));
        EQUAL(unary(PM_OP_LOG, a), log(a));
        EQUAL(unary(PM_OP_FLOOR, a), floor(a));
    }
}

static void binary_operations(void)
{
    static const double places[][2] = {{2.385, -0.6}, {-0.6, 2.385}, {3, 3}, {0, 5.5}, {-1.5, 2}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const double a = places[i][0], b = places[i][1];
        EQUAL(binary(PM_OP_ADD, a, b), a + b);
        EQUAL(binary(PM_OP_SUB, a, b), a - b);
        EQUAL(binary(PM_OP_MUL, a, b), a * b);
        EQUAL(binary(PM_OP_DIV, a, b), a / b);
        EQUAL(binary(PM_OP_POW, a, b), pow(a, b));
        EQUAL(binary(PM_OP_LT, a, b), a < b);
        EQUAL(binary(PM_OP_LE, a, b), a <= b);
        EQUAL(binary(PM_OP_GT, a, b), a > b);
        EQUAL(binary(PM_OP_GE, a, b), a >= b);
        EQUAL(binary(PM_OP_EQ, a, b), a == b);
        EQUAL(binary(PM_OP_NE, a, b), a != b);
        EQUAL(binary(PM_OP_AND, a, b), a != 0 && b != 0);
        EQUAL(binary(PM_OP_OR, a, b), a != 0 || b != 0);
        EQUAL(binary(PM_OP_ATAN2, a, b), atan2(a, b));
        EQUAL(binary(PM_OP_MIN, a, b), fmin(a, b));
        EQUAL(binary(PM_OP_MAX, a, b), fmax(a, b));
        EQUAL(binary(PM_OP_HYPOT, a, b), hypot(a, b));
    }
    EQUAL(binary(PM_OP_OR, 0, 0), 0);
    EQUAL(choose(1, 2.5, 3.5), 2.5);
    EQUAL(choose(0, 2.5, 3.5), 3.5);
}

/* Arithmetic keeps a not-a-number, min and max too; a comparison with one is false. */
static void not_a_number(void)
{
    static const int keeps[] = {PM_OP_ADD, PM_OP_SUB, PM_OP_MUL,   PM_OP_DIV,
                                PM_OP_MIN, PM_OP_MAX, PM_OP_HYPOT, PM_OP_ATAN2};
    static const int compares[] = {PM_OP_LT, PM_OP_LE, PM_OP_GT, PM_OP_GE, PM_OP_EQ};
    for (size_t i = 0; i < sizeof keeps / sizeof *keeps; i++) {
        CHECK(isnan(binary(keeps[i], NAN, 1.5)));
        CHECK(isnan(binary(keeps[i], 1.5, NAN)));
    }
    for (size_t i = 0; i < sizeof compares / sizeof *compares; i++) {
        EQUAL(binary(compares[i], NAN, 1.5), 0);
        EQUAL(binary(compares[i], 1.5, NAN), 0);
    }
    EQUAL(binary(PM_OP_NE, NAN, 1.5), 1);
    CHECK(isnan(unary(PM_OP_SQRT, -1)));
    CHECK(isnan(binary(PM_OP_DIV, 0, 0)));
}

/* n constants and n - 1 additions. */
static int status_of_depth(int depth)
{
    scene *s = scene_create();
    scene_code code[2 * PM_STACK + 8];
    int n = 0;
    for (int i = 0; i < depth; i++) code[n++] = scene_k(s, 1);
    for (int i = 1; i < depth; i++) code[n++] = scene_op(PM_OP_ADD);
    const int program = scene_program(s, n, code);
    const int status = scene_open(s);
    if (status == PM_OK) EQUAL(pm_program_value(s->model, program, NULL, s->w->numbers.value), depth);
    scene_free(s);
    return status;
}

static int status_of(const scene_code *code, int n)
{
    scene *s = scene_create();
    scene_constant(s, 1);
    scene_program(s, n, code);
    const int status = scene_run(s, NULL);
    if (status == PM_BAD_TABLE) {
        EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_PROGRAM);
        EQUAL(s->where[PM_WHERE_ROW], s->rows[PM_TABLE_PROGRAM] - 1);
    }
    scene_free(s);
    return status;
}

static void bad_programs(void)
{
    EQUAL(status_of_depth(PM_STACK), PM_OK);
    EQUAL(status_of_depth(PM_STACK + 1), PM_BAD_TABLE);
    const scene_code one = {PM_OP_CONSTANT, 0};
    const scene_code two_left[] = {one, one}, empty_stack[] = {{PM_OP_NEG, 0}},
                     too_few[] = {one, {PM_OP_SELECT, 0}};
    const scene_code unknown[] = {one, {PM_OPS, 0}}, negative[] = {one, {-1, 0}};
    EQUAL(status_of(two_left, 2), PM_BAD_TABLE);
    EQUAL(status_of(empty_stack, 1), PM_BAD_TABLE);
    EQUAL(status_of(too_few, 2), PM_BAD_TABLE);
    EQUAL(status_of(unknown, 2), PM_BAD_TABLE);
    EQUAL(status_of(negative, 2), PM_BAD_TABLE);
    for (int op = PM_OP_CONSTANT; op <= PM_OP_MEASURE; op++) {
        const scene_code below[] = {{op, -1}}, beyond[] = {{op, 100000}};
        EQUAL(status_of(below, 1), PM_BAD_TABLE);
        EQUAL(status_of(beyond, 1), PM_BAD_TABLE);
    }
}

/* A value may use parameters and values of lower index, and nothing of a state. */
static void values(void)
{
    scene *s = scene_create();
    const int p = scene_parameter(s);
    scene_value_of(s, SCENE_PROGRAM(s, scene_v(p), scene_v(p), scene_op(PM_OP_MUL)));
    const double param[] = {-1.25};
    const int square = s->rows[PM_TABLE_VALUE] - 1;
    const int out = scene_ask_end(s, SCENE_PROGRAM(s, scene_v(square), scene_p(0), scene_op(PM_OP_ADD)));
    scene_until(s, scene_on(s, PM_TRIGGER_START, PM_NONE), 1);
    EQUAL(scene_run(s, param), PM_NO_TIME_ROUTE);
    EQUAL(s->out[out], 1.25 * 1.25 - 1.25);
    const double bad[] = {NAN};
    EQUAL(scene_run(s, bad), PM_BAD_VALUE);
    EQUAL(s->where[PM_WHERE_ROW], 0);
    scene_free(s);

    s = scene_create();
    scene_value_of(s, SCENE_PROGRAM(s, scene_v(s->rows[PM_TABLE_VALUE]))); /* itself */
    EQUAL(scene_run(s, NULL), PM_BAD_TABLE);
    EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_PROGRAM);
    scene_free(s);

    s = scene_create();
    scene_value_of(s, SCENE_PROGRAM(s, scene_m(scene_time(s))));
    EQUAL(scene_run(s, NULL), PM_BAD_TABLE);
    scene_free(s);
}

/* A random expression of n leaves that stay the same in a case and of such that do not. */
static void append_random(scene *s, int leaves, const int *measure, int parameter, scene_code *code, int *n)
{
    static const int binaries[] = {PM_OP_ADD, PM_OP_SUB, PM_OP_MUL,  PM_OP_DIV,
                                   PM_OP_MIN, PM_OP_LT,  PM_OP_ATAN2};
    static const int unaries[] = {PM_OP_NEG, PM_OP_SIN, PM_OP_ABS, PM_OP_FLOOR};
    if (leaves == 1) {
        switch ((int)check_random(0, 5)) {
        case 0: code[(*n)++] = scene_k(s, check_random(-2, 2)); break;
        case 1: code[(*n)++] = scene_p(0); break;
        case 2: code[(*n)++] = scene_v(parameter); break;
        case 3: code[(*n)++] = scene_m(measure[0]); break;
        default: code[(*n)++] = scene_m(measure[1]);
        }
    } else if (leaves > 2 && check_random(0, 1) < 0.2) {
        append_random(s, 1, measure, parameter, code, n);
        append_random(s, 1, measure, parameter, code, n);
        append_random(s, leaves - 2, measure, parameter, code, n);
        code[(*n)++] = scene_op(PM_OP_SELECT);
    } else {
        const int left = 1 + (int)check_random(0, leaves - 1);
        append_random(s, left, measure, parameter, code, n);
        append_random(s, leaves - left, measure, parameter, code, n);
        code[(*n)++] = scene_op(binaries[(int)check_random(0, 7)]);
    }
    if (check_random(0, 1) < 0.2) code[(*n)++] = scene_op(unaries[(int)check_random(0, 4)]);
}

static int same(double a, double b) { return isnan(a) ? isnan(b) : a == b; }

/* At all nodes together a program gives the same bits as at one after the other; what it reads stands in another order. */
static void run_at_nodes(scene *s, int program, int body, const int *measure)
{
    double measured[2 * PM_NODES_MOST], each[PM_NODES_MOST], together[PM_NODES_MOST + 1];
    int place[PM_MEASURE_KINDS] = {0};
    for (int i = 0; i < 2; i++) place[measure[i]] = 1 - i;
    for (int n = 1; n <= PM_NODES_MOST; n += 8) {
        for (int k = 0; k < n; k++) {
            s->w->frame.pose[5 * body] = k % 3 ? check_random(-2, 2) : 0;
            for (int i = 0; i < 2; i++) measured[(1 - i) * PM_NODES_MOST + k] = pm_measure(s->w, measure[i]);
            each[k] = pm_program_run(s->w, program);
        }
        together[n] = 17.5;
        pm_program_run_nodes(s->w, program, n, place, measured, NULL, together);
        for (int k = 0; k < n; k++) CHECK(same(each[k], together[k]));
        EQUAL(together[n], 17.5); /* and no further */
    }
}

/* What stays the same in a case is worked out once, and the programs give the same bits as instruction by instruction; the
 * next case has numbers of its own. */
static void folded(void)
{
    for (int round = 0; round < 60; round++) {
        scene *s = scene_create();
        const int parameter = scene_parameter(s);
        const int b = scene_body(s, 2.5, 0.3, 0.7, -0.2, 0);
        s->cell[PM_TABLE_BODY][PM_BODY_MASS] = parameter;
        const int measure[] = {scene_part(s, PM_MEASURE_POSITION, scene_point(s, b, 0, 0), PM_PART_X),
                               scene_measure(s, PM_MEASURE_WEIGHT, b)};
        scene_code code[200];
        int n = 0;
        append_random(s, 1 + round / 4, measure, parameter, code, &n);
        const int program = scene_program(s, n, code);
        if (!CHECK(scene_open(s) == PM_OK)) return;
        for (int k = 0; k < 2; k++) {
            const double param[] = {k ? 1.75 : 0.5};
            pm_start_report report;
            EQUAL(pm_run_start(s->w, param, &report), PM_OK);
            EQUAL(s->w->numbers.is_folded, 1);
            const double quick = pm_program_run(s->w, program);
            s->w->numbers.is_folded = 0;
            const double slow = pm_program_run(s->w, program);
            CHECK(same(slow, quick));
            s->w->numbers.is_folded = 1;
            run_at_nodes(s, program, b, measure);
        }
        scene_free(s);
    }
}

int main(void)
{
    folded();
    unary_operations();
    binary_operations();
    not_a_number();
    bad_programs();
    values();
    return check_failures();
}
