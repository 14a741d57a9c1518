/* bracket - roots and minima inside a bracket: to rounding where they are simple; what did not come close enough is told. */
#include "numerics/bracket.h"

#include <stddef.h>

#include "check.h"

typedef struct call {
    double root;
    int power, values;
    double missing; /* not a number beyond it */
} call;

/* (x - root)^power, power odd; each value is counted. */
static double power_of(void *of, double x, void *context)
{
    call *c = of;
    double f = 1;
    (void)context;
    c->values++;
    for (int i = 0; i < c->power; i++) f *= x - c->root;
    return x > c->missing ? NAN : f;
}

static double power_with_slope(void *of, double x, void *context, double *slope)
{
    const call *c = of;
    const double f = power_of(of, x, context);
    *slope = c->power * f / (x - c->root);
    return f;
}

/* Brent's method takes some 140 values for a triple root: it is to be as near as a simple one. */
static void check_roots(void *solver)
{
    for (int power = 1; power <= 3; power += 2) {
        call c = {.root = 0.2385, .power = power, .missing = INFINITY};
        double root = NAN, newton = NAN;
        EQUAL(pm_bracket_find(solver, power_of, &c, NULL, -1, power_of(&c, -1, NULL), 2,
                              power_of(&c, 2, NULL), &root),
              PM_SEARCH_FOUND);
        NEAR(root, c.root, 3e-14);
        EQUAL(pm_bracket_newton(power_with_slope, &c, NULL, -1, power_of(&c, -1, NULL), 2,
                                power_of(&c, 2, NULL), &newton),
              PM_SEARCH_FOUND);
        NEAR(newton, c.root, power == 1 ? 1e-15 : 1e-5);
    }
}

static void check_failures_are_told(void *solver)
{
    double root = NAN;
    call c = {.root = 0.2385, .power = 1, .missing = 0.1};
    EQUAL(pm_bracket_find(solver, power_of, &c, NULL, -1, -1.2385, 2, 1.7615, &root), PM_SEARCH_NO_NUMBER);
    EQUAL(pm_bracket_newton(power_with_slope, &c, NULL, -1, -1.2385, 2, 1.7615, &root), PM_SEARCH_NO_NUMBER);
}

/* Where there is nothing beyond an end the difference is over what there is. */
static void check_slopes_at_ends(void)
{
    call c = {.root = 0.2385, .power = 1, .missing = 0.5};
    NEAR(pm_bracket_slope(power_of, &c, NULL, 0, 0.5, 0.3, 1e-3), 1, 1e-12);
    NEAR(pm_bracket_slope(power_of, &c, NULL, 0, 0.5, 0.4999, 1e-3), 1, 1e-12);
}

static double valley(double x, void *context)
{
    call *c = context;
    c->values++;
    return (x - c->root) * (x - c->root);
}

/* A height above what was left a short while ago, v (t - t0) - (t - t0)^2, in steps of its rounding: where the steps of two
 * values are one their secant leads anywhere, and the place that was left is nearer to zero than the place that is met. */
static double height_of(double t)
{
    const double quantum = 1e-9, flown = t - 0.25;
    if (flown == 0) return -1e-12;
    return quantum * round(flown * (1e-3 - flown) / quantum) - 2e-12 * (1 + 100 * flown);
}

static double height_along(void *of, double t, void *context)
{
    (void)of;
    (void)context;
    return height_of(t);
}

static int height_exactly(void *of, double t, void *context, double *value)
{
    (void)of;
    (void)context;
    *value = height_of(t);
    return 0;
}

static void check_polish_stays_with_its_root(void)
{
    for (int i = 0; i < 20; i++) {
        double root = 0.251 + 1e-8 * i, taken, off;
        EQUAL(pm_bracket_polish(height_along, height_exactly, NULL, NULL, 0.25, 0.55, -1e-3, &root, &taken,
                                &off),
              0);
        NEAR(root, 0.251, 3e-6);
    }
}

/* A height that changes its sign at once where a mark comes over the end of an edge; elsewhere it may be nearer to zero. */
typedef struct jump {
    double at, before, after, slope;
} jump;

static double jump_along(void *of, double t, void *context)
{
    const jump *x = of;
    (void)context;
    return (t < x->at ? x->before : -x->after) + x->slope * (t - x->at);
}

static int jump_exactly(void *of, double t, void *context, double *value)
{
    *value = jump_along(of, t, context);
    return 0;
}

static void check_polish_stays_at_a_jump(void)
{
    for (int i = 0; i < 200; i++) {
        jump x = {.at = check_random(0.2, 0.8),
                  .before = check_random(1e-3, 1),
                  .after = check_random(1e-3, 1),
                  .slope = check_random(-1, 1)};
        double root = x.at + check_random(-1e-9, 1e-9), taken, off;
        EQUAL(pm_bracket_polish(jump_along, jump_exactly, &x, NULL, 0, 1, NAN, &root, &taken, &off), 0);
        NEAR(root, x.at, 1e-8);
    }
}

static void check_minima(void *solver)
{
    call c = {.root = 0.2385};
    const pm_valley in = {-1, valley(-1, &c), 0, valley(0, &c), 2, valley(2, &c)};
    double place = NAN;
    c.values = 0;
    EQUAL(pm_bracket_minimum(solver, valley, &c, &in, &(pm_closeness){60, 1e-4, 0}, &place), PM_SEARCH_FOUND);
    NEAR(place, c.root, 1e-4);
    EQUAL(pm_bracket_minimum(solver, valley, &c, &in, &(pm_closeness){3, 1e-4, 0}, &place),
          PM_SEARCH_TOO_MANY);
    CHECK(place > -1 && place < 2);
}

int main(void)
{
    void *roots = pm_bracket_create(), *minima = pm_bracket_minimum_create();
    check_roots(roots);
    check_slopes_at_ends();
    check_failures_are_told(roots);
    check_polish_stays_with_its_root();
    check_polish_stays_at_a_jump();
    check_minima(minima);
    pm_bracket_free(roots);
    pm_bracket_minimum_free(minima);
    return check_failures();
}
