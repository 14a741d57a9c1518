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
#include "path_clock.h"

#include <math.h>

#include "greater.h"
#include "series.h"

#define FINE PM_CLOCK_FINE
#define NOISE 1e-6 /* a tail below it that no halving makes smaller is rounding */
#define GAINS \
    0.5 /* of the tail with fewer nodes, or over a longer step: it is smaller where it is no rounding */
#define FEWER \
    4.0 /* the same with the nodes of a step, which are fewer: these coefficients weigh more in the integral */
#define OPEN \
    32.0 /* for its error the same: inside a step what they leave out weighs by 1 / 2k, not by 1 / k^2 */
#define NOTHING_MORE 1e-17 /* of the greatest coefficient: those that are dropped */

/* T, or what stands for it, at a node: T over the way to where it vanishes; there its slope. */
static double slowness(const pm_path *p, int node)
{
    const pm_place *x = &p->node[node * p->every];
    const double s = p->nodes->at[node];
    if (p->clock == PM_CLOCK_PLAIN) return x->kinetic;
    const double distance = p->clock == PM_CLOCK_LEAVES ? s : 1 - s;
    return distance > 0 ? x->kinetic / distance : fabs(x->force) * p->h;
}

/* ---- tables ---- */
/* How many fine nodes are no coarse ones, and which fine node number i of them is. */
static int between(const pm_nodes *nodes) { return FINE - (nodes->n - 1); }

static int node_between(const pm_nodes *nodes, int i)
{
    const int every = FINE / (nodes->n - 1);
    return i / (every - 1) * every + 1 + i % (every - 1);
}

/* The barycentric weights of the coarse nodes at the fine ones between them. */
static void fill_weights(const pm_nodes *nodes, double *weight, double *below)
{
    const int last = nodes->n - 1;
    for (int k = 0; k <= last; k++)
        for (int i = 0; i < between(nodes); i++, weight++) {
            const double s = 0.5 * (1 - pm_nodes_cosine[node_between(nodes, i)]);
            *weight = (k % 2 ? -1 : 1) * (k == 0 || k == last ? 0.5 : 1) / (s - nodes->at[k]);
            below[i] += *weight;
        }
}

/* cos(pi j k / FINE), k even first, then odd. */
static void fill_cosines(double *cosine)
{
    for (int j = 0; j <= FINE / 2; j++)
        for (int odd = 0; odd < 2; odd++)
            for (int k = odd; k <= FINE; k += 2) *cosine++ = pm_nodes_cosine[j * k % (2 * FINE)];
}

void pm_clock_fill_table(pm_clock_table *x)
{
    fill_weights(&pm_nodes_9, x->weight_9[0], x->below_9);
    fill_weights(&pm_nodes_17, x->weight_17[0], x->below_17);
    fill_cosines(x->cosine[0]);
}

enum {
    EVEN = FINE / 2 + 1,      /* cosines of even multiples in a row of the table */
    MANY = PM_NODES_MOST - 1, /* the last node of a step */
    FEW = MANY / 2
};

/* ---- g ---- */
/* g at its nodes, from the polynomials through mass and T; 0 if T vanishes between the nodes. */
static int expand(const pm_path *p, const double *mass, const double *kinetic, double *g)
{
    const pm_nodes *nodes = p->nodes;
    const int last = nodes->n - 1, every = FINE / last, n = between(nodes), many = every == 2;
    const double *weight = many ? p->table.weight_17[0] : p->table.weight_9[0];
    const double *below = many ? p->table.below_17 : p->table.below_9;
    double m[FINE] = {0}, t[FINE] = {0};
    for (int k = 0; k <= last; k++, weight += n) {
        if (!(kinetic[k] > 0 && mass[k] > 0)) return 0;
        g[every * k] = sqrt(0.5 * mass[k] / kinetic[k]);
        for (int i = 0; i < n; i++) {
            m[i] += weight[i] * mass[k];
            t[i] += weight[i] * kinetic[k];
        }
    }
    for (int i = 0; i < n; i++) {
        m[i] /= below[i];
        t[i] /= below[i];
        if (!(t[i] > 0 && m[i] > 0)) return 0;
        g[node_between(nodes, i)] = sqrt(0.5 * m[i] / t[i]);
    }
    return 1;
}

/* The coefficients of g from its values at `n` + 1 nodes, as many as matter; how far the highest stand off.  Nodes at both
 * sides of the middle share their cosines. */
static inline double transform(pm_path *p, const double *g, const int n)
{
    const int even = n / 2 + 1, every = FINE / n;
    const double *const middle = p->table.cosine[FINE / 2];
    double up[FINE / 2 + 1], down[FINE / 2], greatest = 0; /* sums of even and of odd ones */
    for (int k = 0; k < even; k++) up[k] = g[n / 2] * middle[k];
    for (int k = 0; k < n / 2; k++) down[k] = g[n / 2] * middle[EVEN + k];
    for (int j = 0; j < n / 2; j++) {
        const double half = j == 0 ? 0.5 : 1, *cosine = p->table.cosine[j * every];
        const double same = half * (g[n - j] + g[j]), other = half * (g[n - j] - g[j]);
        for (int k = 0; k < even; k++) up[k] += same * cosine[k];
        for (int k = 0; k < n / 2; k++) down[k] += other * cosine[EVEN + k];
    }
    for (int k = 0; k <= n; k++) {
        p->series[k] = (k == 0 || k == n ? 1.0 : 2.0) / n * (k % 2 ? down[k / 2] : up[k / 2]);
        greatest = pm_greater(fabs(p->series[k]), greatest);
    }
    const double tail = pm_greater(fabs(p->series[n]), fabs(p->series[n - 1])) / greatest;
    p->terms = n + 1;
    while (p->terms > 1 && fabs(p->series[p->terms - 1]) < NOTHING_MORE * greatest) p->terms--;
    return tail;
}

/* The nodes of the step, if they resolve g itself. */
static int set_by_nodes(pm_path *p, const double *mass, const double *kinetic, double most)
{
    const int last = p->nodes->n - 1;
    double g[PM_NODES_MOST];
    for (int k = 0; k <= last; k++) {
        if (!(kinetic[k] > 0 && mass[k] > 0)) return 0;
        g[k] = sqrt(0.5 * mass[k] / kinetic[k]);
    }
    const double high = last == MANY ? transform(p, g, MANY) : transform(p, g, FEW);
    if (!(FEWER * high <= most)) return 0;
    p->tail = OPEN * high;
    return 1;
}

/* The fine nodes, by the polynomials through mass and T.  How far the highest coefficients of all stand off. */
static double set_by_fine(pm_path *p, const double *mass, const double *kinetic)
{
    double g[PM_NODES_CLOCK], least = INFINITY, greatest = 0;
    for (int k = 0; k < p->nodes->n; k++) {
        least = pm_less(kinetic[k], least);
        greatest = pm_greater(kinetic[k], greatest);
    }
    if (!(least > 0) || !expand(p, mass, kinetic, g)) return INFINITY;
    return fmax(fmax(pm_series_tail(p->nodes, mass), pm_series_tail(p->nodes, kinetic) * greatest / least),
                transform(p, g, FINE));
}

int pm_clock_set(pm_path *p, int clock, double most)
{
    double mass[PM_NODES_MOST], kinetic[PM_NODES_MOST];
    const double before = p->tail;
    p->clock = clock;
    p->terms = 0;
    if (clock == PM_CLOCK_NONE) return 1;
    for (int k = 0; k < p->nodes->n; k++) {
        mass[k] = pm_path_node(p, k)->mass;
        kinetic[k] = slowness(p, k);
    }
    if (set_by_nodes(p, mass, kinetic, most)) return 1;
    p->tail = set_by_fine(p, mass, kinetic);
    return p->tail <= most || (p->tail < NOISE && p->tail > GAINS * before);
}

/* The whole integral: what is odd about the middle leaves nothing of it. */
static double whole(const pm_path *p)
{
    double sum = 0;
    for (int k = 0; k < p->terms; k += 2) sum += p->series[k] / (1 - k * k);
    return sum;
}

/* Integral of the series from 0 to s: of T_k(x) by x it is (T_k+1 / (k + 1) - T_k-1 / (k - 1)) / 2. */
static double plain(const pm_path *p, double s)
{
    const double x = 2 * s - 1;
    double before = 1, here = x, sum = p->series[0] * (x + 1), sign = -1;
    if (p->terms > 1) sum += p->series[1] * 0.5 * (x * x - 1);
    for (int k = 2; k < p->terms; k++) { /* `here` is T_k-1(x) */
        const double next = 2 * x * here - before, after = 2 * x * next - here;
        sign = -sign; /* (-1)^k: the same at x = -1 */
        const double to = after / (k + 1) - here / (k - 1), from = -sign / (k + 1) + sign / (k - 1);
        sum += 0.5 * p->series[k] * (to - from);
        before = here;
        here = next;
    }
    return 0.5 * sum;
}

/* Integral of g / sqrt(s) from 0 to w^2 (of T_2k(w) by 2 dw), or with the series turned round. */
static double from_rest(const pm_path *p, double w, int reversed)
{
    const double x = 2 * w * w - 1; /* T_2k(w) = T_k(x); odd ones by the same step: T_m+2 = 2 x T_m - T_m-2 */
    double before = w, here = w * (2 * x - 1), sum = 2 * p->series[0] * w, sign = 1;
    for (int k = 1; k < p->terms; k++) { /* before: T_2k-1(w), here: T_2k+1(w) */
        sign = reversed ? -sign : 1;
        sum += sign * p->series[k] * (here / (2 * k + 1) - before / (2 * k - 1));
        const double next = 2 * x * here - before;
        before = here;
        here = next;
    }
    return sum;
}

double pm_clock_at(const pm_path *p, double s)
{
    switch (p->clock) {
    case PM_CLOCK_PLAIN: return p->t0 + p->h * (s == 1 ? whole(p) : plain(p, s));
    case PM_CLOCK_LEAVES: return p->t0 + p->h * from_rest(p, sqrt(s), 0);
    case PM_CLOCK_RESTS: return p->t0 + p->h * (from_rest(p, 1, 1) - from_rest(p, sqrt(1 - s), 1));
    default: return p->t0; /* nobody asks; an equilibrium takes for ever to leave */
    }
}
