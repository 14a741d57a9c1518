/* event_bound.c - whether a trigger goes through zero and back between two samples: by bounds of its law, part by part.
 *
 * Where its samples are compared with enclosures (waves.h), what these leave out may still be deeper than a sample is above zero.
 * A part whose bound stays on the side of its samples is left out, and so is one along which the value only rises or falls;
 * what is left is halved. */
#include "events/event_bound.h"

#include <math.h>

#include "events/watched_samples.h"
#include "events/waves.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

typedef struct pm_bounded_side {
    const pm_workspace *w;
    int program;
    double sign;    /* of the samples */
    double nothing; /* so little beyond zero is rounding */
    int budget;     /* of parts */
} pm_bounded_side;

/* What the value, times its sign, has at the least over a part. */
static double least_of(const pm_bounded_side *x, const pm_enclosure *e, double h)
{
    const pm_jet *j = &e->jet;
    const double least = x->sign > 0 ? j->value.lo : -j->value.hi;
    const double bend = x->sign > 0 ? j->bend.hi : -j->bend.lo;
    if (e->open > 0 || j->gaps != PM_GAPS_NONE) return least;
    return pm_max(pm_min(x->sign * j->at[0], x->sign * j->at[2]) - pm_max(bend, 0) * h * h / 8, least);
}

static int is_monotonic(const pm_enclosure *e)
{
    return e->open == 0 && e->jet.gaps == PM_GAPS_NONE && (e->jet.rate.lo > 0 || e->jet.rate.hi < 0);
}

/* The first place in [from, to] that is met beyond zero; NaN: there is none. */
static double beyond(pm_bounded_side *x, double from, double to)
{
    const double middle = 0.5 * (from + to), at[3] = {from, middle, to};
    const pm_enclosure e = pm_waves_enclosed(x->w, x->program, from, to);
    if (least_of(x, &e, to - from) >= -x->nothing) return NAN;
    for (int k = 0; k < 3; k++)
        if (x->sign * e.jet.at[k] < -x->nothing) return at[k];
    if (is_monotonic(&e) || to - from <= PM_BOUND_LEAST || --x->budget < 0) return NAN;
    const double first = beyond(x, from, middle);
    return isnan(first) ? beyond(x, middle, to) : first;
}

double pm_event_bound_beyond(const pm_workspace *w, int program, double sign, double nothing, double from,
                             double to)
{
    pm_bounded_side x = {w, program, sign, nothing, PM_BOUND_PARTS};
    if (!pm_waves_may_be(w, program) || !pm_waves_tell_law(w, program, PM_SAMPLE_TRIGGERS)) return NAN;
    return beyond(&x, from, to);
}
