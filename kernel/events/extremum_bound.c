/* extremum_bound.c - what no search beside nodes has met: a value is bounded by its law, part by part of a step.
 *
 * A part whose bound is not above the best is left out; so is one along which the value only rises or falls, but for its ends,
 * and one along which it bends down all the way has its one top by the rate.  What is left is halved.  Searches beside nodes
 * may miss a top that stands between them, or one whose one node is in it by chance. */
#include "events/extremum_bound.h"

#include <math.h>

#include "events/extremum_parts.h"
#include "events/waves.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

typedef struct pm_bound_part {
    double from, to;
} pm_bound_part;

/* What is known of g along a part. */
typedef struct pm_bound {
    double most;
    pm_interval rate, bend;
    double at[3];
    int smooth; /* no switch is open */
} pm_bound;

static pm_interval signed_interval(double sign, pm_interval x)
{
    return sign > 0 ? x : (pm_interval){-x.hi, -x.lo};
}

static pm_bound bound_of(const pm_workspace *w, const pm_extremum *p, const pm_bound_part *part)
{
    const pm_enclosure e =
        pm_waves_enclosed(w, pm_ask_program(PM_ASK_ROW(w->model, p->ask)), part->from, part->to);
    const double h = part->to - part->from;
    pm_bound x = {.most = signed_interval(p->sign, e.jet.value).hi,
                  .rate = signed_interval(p->sign, e.jet.rate),
                  .bend = signed_interval(p->sign, e.jet.bend),
                  .smooth = e.open == 0 && e.jet.gaps == PM_GAPS_NONE};
    for (int k = 0; k < 3; k++) x.at[k] = p->sign * e.jet.at[k];
    const double above_chord = pm_max(x.at[0], x.at[2]) + pm_max(-x.bend.lo, 0) * h * h / 8;
    if (x.smooth && above_chord < x.most) x.most = above_chord;
    return x;
}

/* A place where the law has more than the best. */
static int offer_place(pm_workspace *w, pm_extremum *p, double s, double g)
{
    if (!isfinite(g) || !(g > p->best + p->above)) return PM_OK;
    const int status = pm_extremum_offer_at(w, p, pm_extremum_place(&w->step, s));
    p->best = pm_extremum_best(w->ask, p);
    return status;
}

static int offer_places(pm_workspace *w, pm_extremum *p, const pm_bound_part *part, const pm_bound *x)
{
    int status = PM_OK;
    for (int k = 0; k < 3 && !status; k++)
        status = offer_place(w, p, part->from + 0.5 * k * (part->to - part->from), x->at[k]);
    return status;
}

/* The one top of a part along which the value bends down. */
static int offer_top(pm_workspace *w, pm_extremum *p, const pm_bound_part *part)
{
    const pm_extremum_slope a = pm_extremum_law_slope(w, p, part->from),
                            b = pm_extremum_law_slope(w, p, part->to);
    if (!(a.rate > 0 && b.rate < 0)) return PM_OK;
    const int status = pm_extremum_law_top(w, p, &a, &b);
    p->best = pm_extremum_best(w->ask, p);
    return status;
}

/* Whether a part has to be halved: what is known of it does not tell its greatest value. */
static int is_left(const pm_extremum *p, const pm_bound_part *part, const pm_bound *x)
{
    if (x->most <= p->best + p->above || part->to - part->from <= PM_BOUND_LEAST) return 0;
    return !(x->smooth && (x->rate.lo > 0 || x->rate.hi < 0 || x->bend.hi < 0));
}

/* Halves the parts that are left; *n of them are left then. */
static int halve(pm_workspace *w, pm_extremum *p, pm_bound_part *part, int *n)
{
    pm_bound_part left[2 * PM_BOUND_PARTS];
    int most = 0;
    for (int i = 0; i < *n; i++) {
        const pm_bound x = bound_of(w, p, part + i);
        const double middle = 0.5 * (part[i].from + part[i].to);
        if (x.most <= p->best + p->above) continue;
        int status = offer_places(w, p, part + i, &x);
        if (!status && x.smooth && x.bend.hi < 0) status = offer_top(w, p, part + i);
        if (status) return status;
        if (!is_left(p, part + i, &x)) continue;
        left[most++] = (pm_bound_part){part[i].from, middle};
        left[most++] = (pm_bound_part){middle, part[i].to};
    }
    *n = most;
    for (int i = 0; i < most && most <= PM_BOUND_PARTS; i++) part[i] = left[i];
    return PM_OK;
}

static int search(pm_workspace *w, int ask)
{
    const double *sample = pm_ask_samples(w, ask);
    pm_extremum p = {.ask = ask,
                     .sign = pm_ask_greatest(PM_ASK_ROW(w->model, ask)) ? 1 : -1,
                     .end = (w->step.end - w->step.begin) / (w->step.sampled_end - w->step.begin)};
    pm_bound_part part[PM_BOUND_PARTS];
    int n = 1, status = PM_OK;
    part[0] = (pm_bound_part){0, p.end};
    for (int k = 0; k < w->step.nodes->n; k++) p.size = pm_max(fabs(sample[k]), p.size);
    p.best = p.sign * w->ask->best[ask];
    p.above = w->numbers.tolerance * p.size;
    while (n > 0 && n <= PM_BOUND_PARTS && !status) status = halve(w, &p, part, &n);
    return status;
}

int pm_extremum_bound_take(pm_workspace *w, int ask)
{
    return w->ask->undefined[ask] || !pm_extremum_law_known(w, ask) ? PM_OK : search(w, ask);
}
