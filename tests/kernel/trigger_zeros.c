/* Several zeros of a trigger between two samples: products of three to five differences of an angle, whose zeros lie close together,
 * are counted either way, rising and falling. */
#include "wheel.h"

#include <stdlib.h>

#ifndef CASES
#define CASES 300 /* of each route */
#endif
#define END 3.0 /* rad */
#define FACTORS 5
#define APART 0.01 /* rad: nearer zeros leave nothing between them but rounding */

static int is_greater(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* n zeros in their order, as close together as may be. */
static void draw_zeros(int n, double *zero)
{
    double least;
    do {
        least = INFINITY;
        zero[0] = check_random(0.3, 2.2);
        for (int i = 1; i < n; i++) zero[i] = zero[0] + pow(10, check_random(-2, -0.3));
        qsort(zero, (size_t)n, sizeof *zero, is_greater);
        for (int i = 1; i < n; i++) least = fmin(zero[i] - zero[i - 1], least);
    } while (least < APART);
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
    draw_zeros(n, zero);
    wheel x = wheel_turning(route, END);
    scene_ask_count(x.s, scene_when(x.s, kind, product_of(&x, n, zero)));
    EQUAL(scene_run(x.s, &nothing), PM_OK);
    const int first_kind = n % 2 ? PM_TRIGGER_RISE : PM_TRIGGER_FALL;
    EQUAL(x.s->out[0], kind == PM_TRIGGER_CROSS ? n : kind == first_kind ? (n + 1) / 2 : n / 2);
    scene_free(x.s);
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_UNIFORM, PM_ROUTE_PATH, PM_ROUTE_RK, PM_ROUTE_IDA},
                     kinds[] = {PM_TRIGGER_CROSS, PM_TRIGGER_RISE, PM_TRIGGER_FALL};
    for (size_t r = 0; r < sizeof routes / sizeof *routes; r++)
        for (int i = 0; i < CASES; i++) try_zeros(routes[r], kinds[i % 3], 3 + i / 3 % 3);
    return check_failures();
}
