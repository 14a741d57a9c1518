/* path_clock.c - dt/du = sqrt(mass / 2T) over a step of the path, and its integral.
 *
 * mass and T are smooth functions of the place, which few nodes resolve; their ratio has poles where T would vanish beyond
 * the step.  So both are interpolated, and the ratio is expanded at nodes of its own,
 *
 *   g(s) = sum a_k T_k(2s - 1),    dt/ds = h g,    h g / sqrt(s),    h g / sqrt(1 - s)
 *
 * where the step begins or ends at rest the root is taken out: T / s, or T / (1 - s), stands for T in g.  The integrals are
 * exact for the series: with w^2 = s, T_k(2s - 1) = T_2k(w), and ds / sqrt(s) = 2 dw.
 *
 * Where the nodes of the step resolve g itself, as well as those would, they do instead. */
#include "routes/path/path.h"

#include <math.h>

#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"

#define INLINE static inline __attribute__((always_inline))
#define FINE PM_CLOCK_FINE

/* T, or what stands for it, at a node: T over the way to where it vanishes; there its slope. */
static double slowness(const pm_path *p, int node)
{
    const pm_place *x = &p->node[node * p->every];
    const double s = p->nodes->at[node];
    if (p->clock.kind == PM_CLOCK_PLAIN) return x->kinetic;
    const double distance = p->clock.kind == PM_CLOCK_LEAVES ? s : 1 - s;
    return distance > 0 ? x->kinetic / distance : fabs(x->force) * p->h;
}

enum {
    MANY = PM_NODES_MOST - 1, /* the last node of a step */
    FEW = MANY / 2,
    PAIRS = PM_CLOCK_PAIRS,
    GROUP = 4 /* coefficients that are looked at together */
};

/* ---- tables ---- */
/* How many fine nodes of the left half are no coarse ones, and which fine node number i of them is. */
static inline int between(int last) { return (FINE - last) / 2; }

static inline int node_between(int last, int i)
{
    const int every = FINE / last;
    return i / (every - 1) * every + 1 + i % (every - 1);
}

/* What the coarse nodes weigh at s: the barycentric formula. */
static void weigh(const pm_chebyshev_nodes *nodes, double s, double *weight)
{
    const int last = nodes->n - 1;
    double sum = 0;
    for (int k = 0; k <= last; k++) {
        weight[k] = (k % 2 ? -1 : 1) * (k == 0 || k == last ? 0.5 : 1) / (s - nodes->at[k]);
        sum += weight[k];
    }
    for (int k = 0; k <= last; k++) weight[k] /= sum;
}

static void fill_weights(const pm_chebyshev_nodes *nodes, pm_lanes same[][PAIRS], pm_lanes other[][PAIRS])
{
    const int last = nodes->n - 1, middle = last / 2;
    double weight[PM_NODES_MOST];
    for (int i = 0; i < between(last); i++) {
        weigh(nodes, 0.5 * (1 - pm_chebyshev_nodes_cosine[node_between(last, i)]), weight);
        for (int k = 0; k < middle; k++) {
            same[k][i / 2][i % 2] = 0.5 * (weight[k] + weight[last - k]);
            other[k][i / 2][i % 2] = 0.5 * (weight[k] - weight[last - k]);
        }
        same[middle][i / 2][i % 2] = weight[middle];
    }
}

void pm_path_clock_fill_table(pm_clock_table *x)
{
    fill_weights(&pm_chebyshev_nodes_9, x->same_9, x->other_9);
    fill_weights(&pm_chebyshev_nodes_17, x->same_17, x->other_17);
    for (int j = 0; j < FINE / 2; j++)
        for (int k = 0; k < FINE / 2; k++)
            x->cosine[j][k / 2][k % 2] = pm_chebyshev_nodes_cosine[j * (2 * k + 1) % (2 * FINE)];
}

/* ---- g ---- */
/* The values at the fine nodes between, number i from the left and number i from the right, of the polynomial through
 * those at the coarse ones. */
INLINE void interpolate(const double *value, const int last, const pm_lanes (*same)[PAIRS],
                        const pm_lanes (*other)[PAIRS], pm_lanes *left, pm_lanes *right)
{
    const int n = between(last) / 2, middle = last / 2;
    pm_lanes up[PAIRS], down[PAIRS] = {{0, 0}};
    for (int i = 0; i < n; i++) up[i] = value[middle] * same[middle][i];
    for (int k = 0; k < middle; k++) {
        const double sum = value[k] + value[last - k], less = value[k] - value[last - k];
        for (int i = 0; i < n; i++) up[i] += sum * same[k][i];
        for (int i = 0; i < n; i++) down[i] += less * other[k][i];
    }
    for (int i = 0; i < n; i++) {
        left[i] = up[i] + down[i];
        right[i] = up[i] - down[i];
    }
}

/* g where mass and T are these; NAN if one of them is not positive. */
static inline double slow(double mass, double kinetic)
{
    return kinetic > 0 && mass > 0 ? sqrt(0.5 * mass / kinetic) : NAN;
}

/* g at its nodes, from the polynomials through mass and T. */
INLINE void expand(const double *mass, const double *kinetic, const int last, const pm_lanes (*same)[PAIRS],
                   const pm_lanes (*other)[PAIRS], double *g)
{
    const int every = FINE / last;
    pm_lanes m[2][PAIRS], t[2][PAIRS];
    interpolate(mass, last, same, other, m[0], m[1]);
    interpolate(kinetic, last, same, other, t[0], t[1]);
    for (int k = 0; k <= last; k++) g[every * k] = slow(mass[k], kinetic[k]);
    for (int i = 0; i < between(last); i++) {
        const int k = node_between(last, i);
        g[k] = slow(m[0][i / 2][i % 2], t[0][i / 2][i % 2]);
        g[FINE - k] = slow(m[1][i / 2][i % 2], t[1][i / 2][i % 2]);
    }
}

/* The odd coefficients of values at m + 1 nodes x = cos(pi j / m), times m / 2, every `step`-th of `sum`; what is left are
 * the even ones, those of m / 2 + 1 values. */
INLINE void take_odd(const pm_clock_table *table, double *value, const int m, int step, double *sum)
{
    const int half = m / 2, n = (half + 1) / 2;
    pm_lanes odd[PAIRS] = {{0, 0}};
    for (int j = 0; j < half; j++) {
        const double less = (j == 0 ? 0.5 : 1) * (value[j] - value[m - j]);
        for (int k = 0; k < n; k++) odd[k] += less * table->cosine[j * (FINE / m)][k];
        value[j] += value[m - j];
    }
    value[half] *= 2;
    for (int k = 0; k < half; k++) sum[(2 * k + 1) * step] = odd[k / 2][k % 2];
}

/* The coefficients of values at n + 1 nodes; the greatest of them, not a number where a value is none. */
INLINE double transform(const pm_clock_table *table, const double *given, const int n, double *series)
{
    double value[PM_NODES_CLOCK], sum[PM_NODES_CLOCK], greatest = 0, all = 0;
    for (int k = 0; k <= n; k++) value[k] = given[n - k];
    /* one after the other, so that each has numbers that the compiler knows */
    if (n == FINE) take_odd(table, value, FINE, 1, sum);
    if (n >= MANY) take_odd(table, value, MANY, n / MANY, sum);
    take_odd(table, value, FEW, n / FEW, sum);
    take_odd(table, value, 4, n / 4, sum);
    take_odd(table, value, 2, n / 2, sum);
    sum[0] = 0.5 * (value[0] + value[1]);
    sum[n] = 0.5 * (value[0] - value[1]);
    for (int k = 0; k <= n; k++) {
        series[k] = (k == 0 || k == n ? 1.0 : 2.0) / n * sum[k];
        greatest = pm_max(fabs(series[k]), greatest);
        all += series[k];
    }
    return isnan(all) ? NAN : greatest;
}

/* ---- what is left out ---- */
/* The greatest of GROUP coefficients. */
static inline double greatest_from(const double *series)
{
    double greatest = 0;
    for (int k = 0; k < GROUP; k++) greatest = pm_max(fabs(series[k]), greatest);
    return greatest;
}

/* What the coefficients have fallen to at the last two; *falls: from group to group, 1 at the most.  The last may be nearly zero, as
 * they pass through it slowly where poles are beside an end of the step; the greatest of a group is not. */
static inline double fallen(const double *series, int n, double *falls)
{
    const double before = greatest_from(series + n - 2 * GROUP + 1),
                 here = greatest_from(series + n - GROUP + 1),
                 last = pm_max(fabs(series[n]), fabs(series[n - 1]));
    *falls = here < before ? here / before : 1;
    return pm_max(last, here * sqrt(*falls));
}

/* The sum of the coefficients after those of the values at n + 1 nodes; 0: below `rounding`. */
INLINE double remainder_of(const pm_clock_table *table, const double *value, const int n, double rounding)
{
    double series[PM_NODES_MOST], falls;
    transform(table, value, n, series);
    const double last = fallen(series, n, &falls), ratio = sqrt(sqrt(falls));
    return last > rounding ? last * ratio / pm_max(1 - ratio, PM_CLOCK_SLOWEST) : 0;
}

/* What the nodes take for a constant, of the last coefficient: number 2n, and its multiples.  As a power of the number it falls from
 * group to group, as where a corner is in the step. */
INLINE double taken_for_constant(const int n, double falls)
{
    const double power = 1 / log2((n - 0.5 * (GROUP - 1)) / (n - 0.5 * (3 * GROUP - 1)));
    return falls > PM_CLOCK_FALLS ? pm_min(1, PM_CLOCK_CONSTANT * pow(falls, power)) : 0;
}

/* g by its values at n + 1 nodes, with as many coefficients as matter.  How far the highest of them stand off, times
 * PM_ERROR_UNRESOLVED what its integral leaves out: `weight` times as far, or by what is taken for a constant. */
INLINE double set_series(pm_path *p, const double *g, const int n, double weight, double *high)
{
    double falls;
    const double greatest = transform(&p->clock.table, g, n, p->clock.series);
    p->clock.terms = n + 1;
    while (p->clock.terms > 1 && fabs(p->clock.series[p->clock.terms - 1]) < PM_CLOCK_NOTHING * greatest)
        p->clock.terms--;
    *high = fallen(p->clock.series, n, &falls) / greatest;
    return pm_max(weight, taken_for_constant(n, falls) / PM_ERROR_UNRESOLVED) * *high;
}

/* The nodes of the step, if they resolve g itself. */
static int set_by_nodes(pm_path *p, const double *mass, const double *kinetic, double most)
{
    const int last = p->nodes->n - 1;
    double g[PM_NODES_MOST], high;
    for (int k = 0; k <= last; k++) g[k] = slow(mass[k], kinetic[k]);
    const double tail = last == MANY ? set_series(p, g, MANY, PM_CLOCK_OPEN, &high)
                                     : set_series(p, g, FEW, PM_CLOCK_OPEN, &high);
    if (!(PM_CLOCK_FEWER * high <= most)) return 0;
    p->clock.tail = tail;
    return 1;
}

/* How far the polynomials through mass and T are off, of the least T; what is rounded of T counts elsewhere (path_error.c). */
INLINE double off_between(const pm_path *p, const double *mass, const double *kinetic, const int last)
{
    double heaviest = 0, least = INFINITY, greatest = 0;
    for (int k = 0; k <= last; k++) {
        heaviest = pm_max(mass[k], heaviest);
        least = pm_min(kinetic[k], least);
        greatest = pm_max(kinetic[k], greatest);
    }
    if (!(least > 0)) return INFINITY;
    const double rounded = p->error + PM_ENERGY_ROUNDINGS * (fabs(p->energy) + greatest);
    return remainder_of(&p->clock.table, mass, last, PM_CLOCK_ROUNDED * heaviest) / heaviest +
           remainder_of(&p->clock.table, kinetic, last, rounded) / least;
}

/* The fine nodes, by the polynomials through mass and T.  How far the highest coefficients of all stand off. */
static double set_by_fine(pm_path *p, const double *mass, const double *kinetic)
{
    const pm_clock_table *table = &p->clock.table;
    const int many = p->nodes->n - 1 == MANY;
    double g[PM_NODES_CLOCK], high;
    if (many)
        expand(mass, kinetic, MANY, table->same_17, table->other_17, g);
    else
        expand(mass, kinetic, FEW, table->same_9, table->other_9, g);
    const double tail = set_series(p, g, FINE, 1, &high),
                 off = many ? off_between(p, mass, kinetic, MANY) : off_between(p, mass, kinetic, FEW);
    return isnan(tail) ? INFINITY : pm_max(PM_CLOCK_OFF * off, tail);
}

int pm_path_clock_set(pm_path *p, int clock, double most)
{
    double mass[PM_NODES_MOST], kinetic[PM_NODES_MOST];
    /* more nodes of the same step tell nothing of rounding */
    if (p->h < p->clock.length) p->clock.longer = p->clock.tail;
    p->clock.length = p->h;
    p->clock.kind = clock;
    p->clock.terms = 0;
    if (clock == PM_CLOCK_NONE) return 1;
    for (int k = 0; k < p->nodes->n; k++) {
        mass[k] = pm_path_node(p, k)->mass;
        kinetic[k] = slowness(p, k);
    }
    if (set_by_nodes(p, mass, kinetic, most)) return 1;
    p->clock.tail = set_by_fine(p, mass, kinetic);
    return p->clock.tail <= most ||
           (p->clock.tail < PM_CLOCK_NOISE && p->clock.tail > PM_CLOCK_GAINS * p->clock.longer);
}

/* The whole integral: what is odd about the middle leaves nothing of it. */
static double whole(const pm_path *p)
{
    double sum = 0;
    for (int k = 0; k < p->clock.terms; k += 2) sum += p->clock.series[k] / (1 - k * k);
    return sum;
}

/* Integral of the series from 0 to s: of T_k(x) by x it is (T_k+1 / (k + 1) - T_k-1 / (k - 1)) / 2. */
static double plain(const pm_path *p, double s)
{
    const double x = 2 * s - 1;
    double before = 1, here = x, sum = p->clock.series[0] * (x + 1), sign = -1;
    if (p->clock.terms > 1) sum += p->clock.series[1] * 0.5 * (x * x - 1);
    for (int k = 2; k < p->clock.terms; k++) { /* `here` is T_k-1(x) */
        const double next = 2 * x * here - before, after = 2 * x * next - here;
        sign = -sign; /* (-1)^k: the same at x = -1 */
        const double to = after / (k + 1) - here / (k - 1), from = -sign / (k + 1) + sign / (k - 1);
        sum += 0.5 * p->clock.series[k] * (to - from);
        before = here;
        here = next;
    }
    return 0.5 * sum;
}

/* Integral of g / sqrt(s) from 0 to w^2 (of T_2k(w) by 2 dw), or with the series turned round. */
static double from_rest(const pm_path *p, double w, int reversed)
{
    const double x = 2 * w * w - 1; /* T_2k(w) = T_k(x); odd ones by the same step: T_m+2 = 2 x T_m - T_m-2 */
    double before = w, here = w * (2 * x - 1), sum = 2 * p->clock.series[0] * w, sign = 1;
    for (int k = 1; k < p->clock.terms; k++) { /* before: T_2k-1(w), here: T_2k+1(w) */
        sign = reversed ? -sign : 1;
        sum += sign * p->clock.series[k] * (here / (2 * k + 1) - before / (2 * k - 1));
        const double next = 2 * x * here - before;
        before = here;
        here = next;
    }
    return sum;
}

/* From the begin of the step to s. */
static double elapsed(const pm_path *p, double s)
{
    switch (p->clock.kind) {
    case PM_CLOCK_PLAIN: return p->h * (s == 1 ? whole(p) : plain(p, s));
    case PM_CLOCK_LEAVES: return p->h * from_rest(p, sqrt(s), 0);
    case PM_CLOCK_RESTS: return p->h * (from_rest(p, 1, 1) - from_rest(p, sqrt(1 - s), 1));
    default: return 0; /* nobody asks; an equilibrium takes for ever to leave */
    }
}

double pm_path_clock_at(const pm_path *p, double s)
{
    if (p->clock.kind == PM_CLOCK_NONE) return p->clock.t0;
    return p->clock.t0 + (p->clock.late + p->clock.rate * elapsed(p, s));
}

double pm_path_clock_between(const pm_path *p, double from, double to)
{
    return p->clock.rate * (elapsed(p, to) - elapsed(p, from));
}

double pm_path_clock_left(const pm_path *p, double t, double s)
{
    const double late = p->clock.t0 - t + p->clock.rate * elapsed(p, s) + p->clock.late;
    return fabs(late) <= PM_CLOCK_LATE * t ? late : 0; /* else it is not that step's end */
}

/* Compensated summation (Kahan): swings of a pendulum are rounded alike, each late in a long run to the same side. */
void pm_path_clock_begin(pm_path *p, double t, double s)
{
    p->clock.late = pm_path_clock_left(p, t, s);
    p->clock.t0 = t;
}
