/* Series through samples: of polynomials they are exact, with their derivatives, and their bounds over any part hold every value
 * that is found there. */
#include "numerics/chebyshev_series.h"

#include "check.h"

#define CASES 300

typedef struct polynomial {
    double c[PM_NODES_MOST];
    int n;
} polynomial;

/* Its derivative of that order at s. */
static double derivative(const polynomial *p, int order, double s)
{
    double sum = 0;
    for (int k = p->n - 1; k >= order; k--) {
        double factor = p->c[k];
        for (int i = 0; i < order; i++) factor *= k - i;
        sum = sum * s + factor;
    }
    return sum;
}

static int holds(pm_interval x, double value, double rounding)
{
    return value >= x.lo - rounding && value <= x.hi + rounding;
}

static void check_polynomial(const pm_chebyshev_nodes *nodes, int n)
{
    polynomial p = {.n = n};
    pm_chebyshev_series x;
    double sample[PM_NODES_MOST];
    for (int k = 0; k < n; k++) p.c[k] = check_random(-1, 1);
    for (int k = 0; k < nodes->n; k++) sample[k] = derivative(&p, 0, nodes->at[k]);
    pm_chebyshev_series_of(&x, nodes, sample);
    CHECK(x.resolved || n + 2 > nodes->n);
    for (int i = 0; i < 10; i++) {
        const double from = check_random(0, 1), to = check_random(from, 1), s = check_random(from, to);
        const pm_chebyshev_part part = pm_chebyshev_series_over(&x, from, to);
        NEAR(part.at[0], derivative(&p, 0, from), 1e-12);
        NEAR(part.at[1], derivative(&p, 0, 0.5 * (from + to)), 1e-12);
        NEAR(part.at[2], derivative(&p, 0, to), 1e-12);
        CHECK(holds(part.value, derivative(&p, 0, s), 1e-12));
        CHECK(holds(part.rate, derivative(&p, 1, s), 1e-10));
        CHECK(holds(part.bend, derivative(&p, 2, s), 1e-8));
        const pm_chebyshev_part here = pm_chebyshev_series_over(&x, s, s);
        NEAR(here.rate.lo, derivative(&p, 1, s), 1e-10);
        NEAR(here.bend.hi, derivative(&p, 2, s), 1e-8);
    }
}

/* No rate is smaller than the least, no bend either, and narrow bounds hold; of one polynomial in three each has one. */
static void check_least(const pm_chebyshev_nodes *nodes, int strong)
{
    polynomial p = {.n = nodes->n};
    pm_chebyshev_series x, bends;
    double sample[PM_NODES_MOST];
    for (int k = 0; k < p.n; k++) p.c[k] = k == strong ? check_random(2, 4) : check_random(-1, 1) / pow(4, k);
    for (int k = 0; k < nodes->n; k++) sample[k] = derivative(&p, 0, nodes->at[k]);
    pm_chebyshev_series_begin(&x, nodes, sample);
    const double rate = pm_chebyshev_series_least_rate(&x), bend = pm_chebyshev_series_least_bend(&x);
    CHECK(strong != 1 || rate > 0);
    CHECK(strong != 2 || (bend > 0 && x.value[2] > 0));
    pm_chebyshev_series_bends(&x, &bends);
    for (int i = 0; i <= 20; i++) {
        const double s = i / 20.0, to = check_random(s, 1), at = check_random(s, to);
        CHECK(fabs(derivative(&p, 1, s)) >= rate - 1e-10);
        CHECK(fabs(derivative(&p, 2, s)) >= bend - 1e-8);
        const pm_chebyshev_part part = pm_chebyshev_series_narrow(&x, &bends, s, to);
        CHECK(holds(part.value, derivative(&p, 0, at), 1e-12));
        CHECK(holds(part.rate, derivative(&p, 1, at), 1e-10));
        CHECK(holds(part.bend, derivative(&p, 2, at), 1e-8));
    }
}

/* What the nodes do not resolve is told. */
static void check_waves_are_not_resolved(const pm_chebyshev_nodes *nodes)
{
    pm_chebyshev_series x;
    double sample[PM_NODES_MOST];
    for (int k = 0; k < nodes->n; k++) sample[k] = cos(4.0 * nodes->n * nodes->at[k]);
    pm_chebyshev_series_of(&x, nodes, sample);
    CHECK(!x.resolved);
    for (int k = 0; k < nodes->n; k++) sample[k] = 7;
    pm_chebyshev_series_of(&x, nodes, sample);
    CHECK(x.resolved);
}

int main(void)
{
    static const pm_chebyshev_nodes *const nodes[] = {&pm_chebyshev_nodes_equal, &pm_chebyshev_nodes_9,
                                                      &pm_chebyshev_nodes_17};
    for (size_t i = 0; i < sizeof nodes / sizeof *nodes; i++) {
        for (int k = 0; k < CASES; k++) check_polynomial(nodes[i], 1 + k % nodes[i]->n);
        for (int k = 0; k < CASES; k++) check_least(nodes[i], k % 3);
        check_waves_are_not_resolved(nodes[i]);
    }
    return check_failures();
}
