/* extremum_hidden.c - extremes that no node of a step shows, of a value that the nodes do not resolve.
 *
 * A top and a dip may have hardly parted, and a top may be right before the end of a step that was shortened, which is no
 * node.  There nodes next to each other are nearly alike, or the step ends; such tops rise above the nodes by no more than those
 * differ about them.  The rates there show them.
 *
 * A top and a dip that have parted by less than the distance of the nodes may both lie between two places where the value
 * rises, or between two where it falls.  The cubic that has both values and rates shows them: then the value is asked for on
 * both sides of its top, and so on in all parts. */
#include <math.h>

#include "events/extremum_parts.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

/* ---- between two places ---- */
double pm_extremum_hidden_cubic(const pm_extremum_slope *a, const pm_extremum_slope *b)
{
    const double h = b->s - a->s, secant = (b->g - a->g) / h;
    const double c = (3 * secant - 2 * a->rate - b->rate) / h, d = (a->rate + b->rate - 2 * secant) / (h * h);
    const double root = sqrt(c * c - 3 * d * a->rate); /* its rate is a->rate + 2 c x + 3 d x^2 */
    const double s = a->s + (c > 0 ? -(c + root) / (3 * d) : a->rate / (root - c));
    return s > a->s && s < b->s ? s : NAN;
}

static int falls(const pm_extremum_slope *a, const pm_extremum_slope *b)
{
    return a->rate > 0 && b->rate < 0;
}

int pm_extremum_hidden_tops(pm_workspace *w, const pm_extremum *p, const pm_extremum_curve *x,
                            const pm_extremum_slope *a, const pm_extremum_slope *b, int partings)
{
    if (falls(a, b)) return x->top(w, p, a, b);
    if (partings == 0 || (a->rate < 0 && b->rate > 0)) return PM_OK;
    const double makes = (b->s - a->s) * pm_max(fabs(a->rate), fabs(b->rate));
    const double s = pm_extremum_hidden_cubic(a, b);
    if (isnan(s) || !(makes > PM_EXTREMUM_LEVEL * p->size)) return PM_OK;
    const pm_extremum_slope left = x->slope(w, p, 0.5 * (a->s + s)), right = x->slope(w, p, 0.5 * (s + b->s));
    int status = pm_extremum_hidden_tops(w, p, x, a, &left, partings - 1);
    if (!status) status = pm_extremum_hidden_tops(w, p, x, &left, &right, partings - 1);
    return status ? status : pm_extremum_hidden_tops(w, p, x, &right, b, partings - 1);
}

/* ---- between two nodes ---- */
/* The first node from k on with a hidden top between it and the next that may beat the best; or n. */
static int next_hidden(const pm_chebyshev_nodes *nodes, const pm_extremum *p, int k)
{
    const double *g = p->g, above = p->best + p->nothing;
    const int n = nodes->n;
    double before = k > 0 ? fabs(g[k] - g[k - 1]) : 0, here = k + 1 < n ? fabs(g[k + 1] - g[k]) : 0, after;
    for (; k + 1 < n && nodes->at[k] < p->end; k++, before = here, here = after) {
        after = k + 2 < n ? fabs(g[k + 2] - g[k + 1]) : 0;
        const double rise = pm_max(here, pm_max(before, after));
        if (!(pm_max(g[k], g[k + 1]) + rise > above)) continue;
        if (nodes->at[k + 1] > p->end || pm_min(here, pm_min(before, after)) <= PM_HIDDEN_ALIKE * rise)
            return k;
    }
    return n;
}

int pm_extremum_hidden_find(pm_workspace *w, pm_extremum *p)
{
    const int n = w->step.nodes->n;
    for (int k = 0; (k = next_hidden(w->step.nodes, p, k)) < n; k++) {
        const int status = p->met >> k & 1 ? PM_OK : pm_extremum_search_root(w, p, k);
        if (status) return status;
        p->best = pm_extremum_best(w->ask, p);
    }
    return PM_OK;
}
