/* chebyshev_series.c - coefficients by a cosine transform, derivatives by their recurrence (J. P. Boyd, Chebyshev and Fourier
 * Spectral Methods, 2001, sections 4.5 and A.2), bounds over a part by Taylor's formula about its middle. */
#include "numerics/chebyshev_series.h"

#include <math.h>
#include <string.h>

#include "numerics/lanes.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"

/* cos(pi k / 16), k from 0 to 8; then by its symmetries. */
#define FIRST(k)                       \
    ((k) == 0   ? 1                    \
     : (k) == 1 ? 0.980785280403230449 \
     : (k) == 2 ? 0.923879532511286756 \
     : (k) == 3 ? 0.831469612302545237 \
     : (k) == 4 ? 0.707106781186547524 \
     : (k) == 5 ? 0.555570233019602225 \
     : (k) == 6 ? 0.382683432365089772 \
     : (k) == 7 ? 0.195090322016128268 \
                : 0)
#define HALF(k) ((k) <= 8 ? FIRST(k) : -FIRST(16 - (k)))
#define COSINE(k) ((k) % 32 <= 16 ? HALF((k) % 32) : HALF(32 - (k) % 32))
#define PAIR(i, m)                                         \
    {                                                      \
        COSINE(2 * (i) * (m)), COSINE((2 * (i) + 1) * (m)) \
    }
#define ROW(i)                                                                                          \
    {                                                                                                   \
        PAIR(i, 0), PAIR(i, 1), PAIR(i, 2), PAIR(i, 3), PAIR(i, 4), PAIR(i, 5), PAIR(i, 6), PAIR(i, 7), \
            PAIR(i, 8)                                                                                  \
    }
/* cos(pi j m / 16) for two j at once, the even one and the next. */
static const double cosine[PM_NODES_MOST / 2 + 1][PM_NODES_MOST / 2 + 1][2] = {
    ROW(0), ROW(1), ROW(2), ROW(3), ROW(4), ROW(5), ROW(6), ROW(7), ROW(8)};

/* c[j] = 2 / last sum of f[m] cos(pi j m / last), f[m] the sample at x = cos(pi m / last), ends halved.  Samples m and
 * last - m, at x and -x, have the same cosine but for a sign: their sums give the even coefficients, their differences the
 * odd ones. */
static void transform(const pm_chebyshev_nodes *nodes, const double *sample, double *c)
{
    const int last = nodes->n - 1, half = last / 2, every = (PM_NODES_MOST - 1) / last;
    const pm_lanes whole = {last, last};
    pm_lanes pair[PM_NODES_MOST / 2 + 1], factor = {1, 2};
    for (int m = 0; m < half; m++)
        pair[m] = (pm_lanes){sample[last - m] + sample[m], sample[last - m] - sample[m]};
    pair[half] = (pm_lanes){sample[half], 0};
    for (int j = 0; j <= last; j += 2) {
        const double *weight = cosine[j / 2][0];
        pm_lanes sum = 0.5 * pair[0];
        for (int m = 1; m <= half; m++) sum += pair[m] * pm_lanes_load(weight += 2 * every);
        sum = sum * factor / whole;
        if (j < last)
            pm_lanes_store(c + j, sum);
        else
            c[j] = 0.5 * sum[0];
        factor = (pm_lanes){2, 2};
    }
}

/* The polynomial through five equidistant samples at those Chebyshev-Lobatto nodes that are none of theirs. */
static const double between[2][PM_NODES] = {
    {0.20118446353109126, 1.1380711874576981, -0.5, 0.19526214587563501, -0.034517796864424591},
    {-0.034517796864424577, 0.19526214587563498, -0.49999999999999989, 1.1380711874576983,
     0.20118446353109115}};

/* Samples at Chebyshev-Lobatto nodes. */
static const double *at_nodes(const pm_chebyshev_nodes *nodes, const double *sample, double *moved)
{
    if (nodes->n != PM_NODES) return sample;
    for (int i = 0; i < 2; i++) {
        moved[2 * i] = sample[2 * i];
        moved[2 * i + 1] = 0;
        for (int k = 0; k < PM_NODES; k++) moved[2 * i + 1] += between[i][k] * sample[k];
    }
    moved[4] = sample[4];
    return moved;
}

/* The series of the derivative by s. */
static void derive(int n, const double *c, double *d)
{
    double after = 0, further = 0;
    d[n - 1] = 0;
    for (int j = n - 1; j > 0; j--) {
        d[j - 1] = further + 4.0 * j * c[j];
        further = after;
        after = d[j - 1];
    }
    d[0] *= 0.5;
}

static double sum_of_sizes(int n, const double *c)
{
    double sum = 0;
    for (int j = 0; j < n; j++) sum += fabs(c[j]);
    return sum;
}

static void derive_all(pm_chebyshev_series *x)
{
    double third[PM_NODES_MOST];
    derive(x->n, x->value, x->rate);
    derive(x->n, x->rate, x->bend);
    derive(x->n, x->bend, third);
    x->third = sum_of_sizes(x->n, third);
}

void pm_chebyshev_series_begin(pm_chebyshev_series *x, const pm_chebyshev_nodes *nodes, const double *sample)
{
    const int n = x->n = nodes->n;
    double moved[PM_NODES];
    transform(nodes, at_nodes(nodes, sample, moved), x->value);
    x->size = sum_of_sizes(n, x->value);
    x->high = pm_max(fabs(x->value[n - 1]), fabs(x->value[n - 2]));
}

void pm_chebyshev_series_of(pm_chebyshev_series *x, const pm_chebyshev_nodes *nodes, const double *sample)
{
    pm_chebyshev_series_begin(x, nodes, sample);
    derive_all(x);
    const int n = x->n;
    const double changes = x->size - fabs(x->value[0]), upper = sum_of_sizes(n / 2, x->value + n - n / 2);
    x->scatters = upper > PM_SERIES_SCATTERS * (changes - upper);
    x->resolved = pm_chebyshev_series_resolved(x, n > PM_NODES ? PM_TAIL_WAVES : PM_TAIL_FEW);
}

int pm_chebyshev_series_resolved(const pm_chebyshev_series *x, double tail)
{
    return x->high <= tail * (x->size - fabs(x->value[0])) + PM_SERIES_ROUNDING * x->size;
}

void pm_chebyshev_series_cut(pm_chebyshev_series *x, double part)
{
    const double changes = x->size - fabs(x->value[0]),
                 least = pm_max(part * changes, PM_SERIES_ROUNDING * x->size);
    int j = x->n - 1;
    for (; j > 0 && fabs(x->value[j]) <= least; j--) x->value[j] = 0;
    if (j == 0) x->size = 0; /* what holds for a phase, 0 or 1, has no rounding */
    derive_all(x);
}

/* Clenshaw's recurrence at two places, for two series; the number of coefficients is odd. */
static pm_lanes sum_up(int n, const double *one, const double *other, pm_lanes s)
{
    const pm_lanes x = 2.0 * s - 1.0;
    pm_lanes b = {0, 0}, after = b;
    for (int j = n - 1; j > 0; j -= 2) {
        after = 2.0 * x * b - after + (pm_lanes){one[j], other[j]};
        b = 2.0 * x * after - b + (pm_lanes){one[j - 1], other[j - 1]};
    }
    return x * b - after + (pm_lanes){one[0], other[0]};
}

static pm_interval about(double middle, double by) { return (pm_interval){middle - by, middle + by}; }

/* The bounds of rate and value that follow from those of the bend about the rate and the value in the middle. */
static void bound_by_bend(const pm_chebyshev_series *x, double rate, double half, pm_chebyshev_part *part)
{
    part->rate = about(rate, half * pm_interval_size(part->bend));
    part->value = about(part->at[1], half * pm_interval_size(part->rate) + PM_SERIES_ROUNDING * x->size);
}

pm_chebyshev_part pm_chebyshev_series_over(const pm_chebyshev_series *x, double from, double to)
{
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    const pm_lanes ends = sum_up(x->n, x->value, x->value, (pm_lanes){from, to}),
                   first = sum_up(x->n, x->value, x->rate, (pm_lanes){middle, middle}),
                   second = sum_up(x->n, x->bend, x->bend, (pm_lanes){middle, middle});
    pm_chebyshev_part part = {.at = {ends[0], first[0], ends[1]}};
    part.bend = about(second[0], half * x->third);
    bound_by_bend(x, first[1], half, &part);
    return part;
}

/* The slope of a Chebyshev polynomial of degree j is j^2 at the most; s goes half as far as its argument. */
double pm_chebyshev_series_least_rate(const pm_chebyshev_series *x)
{
    double others = 0;
    for (int j = 2; j < x->n; j++) others += j * j * fabs(x->value[j]);
    return 2 * (fabs(x->value[1]) - others);
}

/* Likewise, with bends of j^2 (j^2 - 1) / 3. */
double pm_chebyshev_series_least_bend(const pm_chebyshev_series *x)
{
    double others = 0;
    for (int j = 3; j < x->n; j++) others += j * j * (j * j - 1) * fabs(x->value[j]);
    return 4.0 / 3 * (12 * fabs(x->value[2]) - others);
}

void pm_chebyshev_series_bends(pm_chebyshev_series *x, pm_chebyshev_series *bends)
{
    derive(x->n, x->value, x->rate);
    derive(x->n, x->rate, x->bend);
    bends->n = x->n;
    memcpy(bends->value, x->bend, (size_t)x->n * sizeof *x->bend);
    bends->size = sum_of_sizes(x->n, x->bend);
    derive_all(bends);
    x->third = sum_of_sizes(x->n, bends->rate);
}

pm_chebyshev_part pm_chebyshev_series_narrow(const pm_chebyshev_series *x, const pm_chebyshev_series *bends,
                                             double from, double to)
{
    pm_chebyshev_part part = pm_chebyshev_series_over(x, from, to);
    part.bend = pm_chebyshev_series_over(bends, from, to).value;
    bound_by_bend(x, 0.5 * (part.rate.lo + part.rate.hi), 0.5 * (to - from), &part);
    return part;
}
