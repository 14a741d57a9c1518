/* Several zeros of a trigger between two samples: products of three to five differences of an angle, whose zeros lie close together,
 * are counted either way, rising and falling. */
#include "wheel.h"

#include <stdlib.h>

#ifndef CASES
#define CASES 300 /* of each route */
#endif
#define END 3.0 /* rad */
#define FACTORS 5
#define APART 1e-4 /* rad: of what is between five of them 1e-19 of the greatest value is left */

static int is_greater(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* n zeros in their order, as close together as may be. */
static void draw_zeros(int n, double apart, double *zero)
{
    double least;
    do {
        least = INFINITY;
        zero[0] = check_random(0.3, 2.2);
        for (int i = 1; i < n; i++) zero[i] = zero[0] + pow(10, check_random(log10(apart), -0.3));
        qsort(zero, (size_t)n, sizeof *zero, is_greater);
        for (int i = 1; i < n; i++) least = fmin(zero[i] - zero[i - 1], least);
    } while (least < apart);
}

static int product_of(wheel *x, int n, const double *zero)
{
    scene_code code[4 * FACTORS];
    int m = 0;
    for (int i = 0; i < n; i++) {
        code[m++] = scene_m(x->turned);
        code[m++] = scene_k(x->s, zero[i]);
        code[m++] = scene_op(PM_OP_SUB);
        if (i > 0) code[m++] = scene_op(PM_OP_MUL);
    }
    return scene_program(x->s, m, code);
}

/* The first zero rises if the product is below zero before it. */
static void try_zeros(int route, int kind, int n)
{
    double zero[FACTORS], nothing = 0;
    draw_zeros(n, APART, zero);
    wheel x = wheel_turning(route, END);
    scene_ask_count(x.s, scene_when(x.s, kind, product_of(&x, n, zero)));
    EQUAL(scene_run(x.s, &nothing), PM_OK);
    const int first_kind = n % 2 ? PM_TRIGGER_RISE : PM_TRIGGER_FALL;
    EQUAL(x.s->out[0], kind == PM_TRIGGER_CROSS ? n : kind == first_kind ? (n + 1) / 2 : n / 2);
    scene_free(x.s);
}

/* Passes with other steps see other parts of what leads to zeros beside each other: where it falls on beyond these, how near it came
 * there is no decision, and counts that are right are not in doubt. */
static void are_decided(int route)
{
    int undecided = 0;
    for (int i = 0; i < 2 * CASES; i++) {
        const int n = 3 + i % 3;
        double zero[FACTORS], nothing = 0;
        draw_zeros(n, 10 * APART, zero);
        wheel x = wheel_turning(route, END);
        *scene_setting(x.s, PM_SETTING_ESTIMATE) = 1;
        scene_ask_count(x.s, scene_when(x.s, PM_TRIGGER_CROSS, product_of(&x, n, zero)));
        undecided += scene_run(x.s, &nothing) == PM_UNDECIDED;
        EQUAL(x.s->out[0], n);
        scene_free(x.s);
    }
    CHECK(undecided <= CASES / 10); /* near a threshold is what bends back next to it */
}

/* sin 2u - 2 sin u cos u, and next to nothing: what bounds leave open of a difference that is rounding is told, with the event and
 * the time, whether errors are estimated or not. */
static void bounds_that_tell_nothing(int estimate)
{
    double nothing = 0;
    wheel x = wheel_turning(PM_ROUTE_UNIFORM, END);
    scene *s = x.s;
    const int program = SCENE_PROGRAM(
        s, scene_m(x.turned), scene_k(s, 2), scene_op(PM_OP_MUL), scene_op(PM_OP_SIN), scene_m(x.turned),
        scene_op(PM_OP_SIN), scene_m(x.turned), scene_op(PM_OP_COS), scene_op(PM_OP_MUL), scene_k(s, 2),
        scene_op(PM_OP_MUL), scene_op(PM_OP_SUB), scene_m(x.turned), scene_k(s, 1.5), scene_op(PM_OP_SUB),
        scene_m(x.turned), scene_k(s, 1.5), scene_op(PM_OP_SUB), scene_op(PM_OP_MUL), scene_k(s, 1e-13),
        scene_op(PM_OP_MUL), scene_op(PM_OP_ADD), scene_k(s, 2e-15), scene_op(PM_OP_ADD));
    const int event = scene_when(s, PM_TRIGGER_FALL, program);
    scene_ask_count(s, event);
    *scene_setting(s, PM_SETTING_ESTIMATE) = estimate;
    EQUAL(scene_run(s, &nothing), PM_UNDECIDED);
    EQUAL(s->where[0], PM_TABLE_EVENT);
    EQUAL(s->where[1], event);
    EQUAL(s->where[2], PM_DECISION_UNSEEN);
    CHECK(s->detail[PM_DETAIL_TIME] >= 0 && s->detail[PM_DETAIL_TIME] < END);
    scene_free(s);
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_UNIFORM, PM_ROUTE_PATH, PM_ROUTE_RK, PM_ROUTE_IDA},
                     kinds[] = {PM_TRIGGER_CROSS, PM_TRIGGER_RISE, PM_TRIGGER_FALL};
    for (size_t r = 0; r < sizeof routes / sizeof *routes; r++)
        for (int i = 0; i < CASES; i++) try_zeros(routes[r], kinds[i % 3], 3 + i / 3 % 3);
    are_decided(PM_ROUTE_IDA);
    for (int estimate = 0; estimate < 2; estimate++) bounds_that_tell_nothing(estimate);
    return check_failures();
}
