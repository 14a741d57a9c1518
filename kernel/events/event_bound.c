/* event_bound.c - where a function first goes through zero between two samples: by bounds, part by part.
 *
 * What a trigger watches is bounded by its law, where its samples are compared with enclosures (waves.h): what these leave out may
 * still be deeper than a sample is above zero.  How two points approach each other, or the circles of a strand, is bounded by the
 * polynomial through the samples: they may be nearest twice between two nodes, and meet at one of these places.
 *
 * A part whose bound stays on the side where it begins is left out.  One along which the function only rises or falls ends beyond
 * zero, or is left out.  What is left is halved. */
#include "events/event_bound.h"

#include <math.h>

#include "events/watched_samples.h"
#include "events/waves.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

typedef struct pm_bounded {
    const pm_workspace *w;
    int program;                /* that is watched; PM_NONE: a polynomial */
    pm_chebyshev_series series; /* that */
    double nothing;             /* so little beyond zero is rounding, or an error of the polynomial */
    int budget;                 /* of parts */
} pm_bounded;

/* ---- what is known of it ---- */
int pm_event_bound_is_known(const pm_workspace *w, int i)
{
    const pm_event_function *f = &w->event->function[i];
    if (f->kind != FUNCTION_TRIGGER) return f->kind == FUNCTION_MEETING || f->kind == FUNCTION_STRAND;
    const int program = PM_TRIGGER_ROW(w->model, f->index)[PM_TRIGGER_PROGRAM];
    return !f->every && pm_waves_may_be(w, program) && pm_waves_tell_law(w, program, PM_SAMPLE_TRIGGERS);
}

/* 1, and what bounds f; 0 where its samples do not show it. */
static int take(pm_bounded *x, const pm_event_function *f, const double *g, double biggest)
{
    if (f->kind == FUNCTION_TRIGGER) {
        x->program = PM_TRIGGER_ROW(x->w->model, f->index)[PM_TRIGGER_PROGRAM];
        x->nothing = PM_SERIES_ROUNDING * biggest;
        return 1;
    }
    x->program = PM_NONE;
    pm_chebyshev_series_of(&x->series, x->w->step.nodes, g);
    x->nothing = pm_max(x->series.high, PM_SERIES_ROUNDING * x->series.size);
    return x->series.resolved;
}

static pm_enclosure enclosed(const pm_bounded *x, double from, double to)
{
    if (x->program != PM_NONE) return pm_waves_enclosed(x->w, x->program, from, to);
    return (pm_enclosure){.jet = pm_enclosure_of_series(&x->series, from, to)};
}

static int is_smooth(const pm_enclosure *e) { return e->open == 0 && e->jet.gaps == PM_GAPS_NONE; }

/* ---- the first place beyond zero ---- */
/* What the value, times its sign, has at the least over a part. */
static double least_of(const pm_enclosure *e, double sign, double h)
{
    const pm_jet *j = &e->jet;
    const double least = sign > 0 ? j->value.lo : -j->value.hi;
    const double bend = sign > 0 ? j->bend.hi : -j->bend.lo;
    if (!is_smooth(e)) return least;
    return pm_max(pm_min(sign * j->at[0], sign * j->at[2]) - pm_max(bend, 0) * h * h / 8, least);
}

static int is_monotonic(const pm_enclosure *e)
{
    return is_smooth(e) && (e->jet.rate.lo > 0 || e->jet.rate.hi < 0);
}

/* The first place that is met in [from, to] where the value times `sign` is below zero; NaN: there is none.  Before it the function
 * goes through zero once. */
static double beyond(pm_bounded *x, double sign, double from, double to)
{
    const double middle = 0.5 * (from + to), at[3] = {from, middle, to};
    const pm_enclosure e = enclosed(x, from, to);
    if (least_of(&e, sign, to - from) >= -x->nothing) return NAN;
    const int known = is_monotonic(&e) || to - from <= PM_BOUND_LEAST || --x->budget < 0;
    for (int k = 0; k < (known ? 3 : 1); k++)
        if (sign * e.jet.at[k] < -x->nothing) return at[k];
    if (known) return NAN;
    const double first = beyond(x, sign, from, middle);
    return isnan(first) ? beyond(x, sign, middle, to) : first;
}

/* ---- the zero ---- */
/* Between s[0] and s[1] of the step; *x stays as it is where the function itself has no other sign there. */
static int bracket(pm_workspace *w, pm_event_function *f, const double s[2], pm_event_at *value_at,
                   pm_span *x)
{
    const double h = w->step.sampled_end - w->step.begin, a = isnan(s[0]) ? x->a : w->step.begin + s[0] * h,
                 b = w->step.begin + s[1] * h;
    const double ga = isnan(s[0]) ? x->ga : value_at(w, a, f), gb = b == x->b ? x->gb : value_at(w, b, f);
    if (!pm_event_way_crosses(f, ga, gb)) return 0;
    *x = (pm_span){a, b, ga, gb};
    return 1;
}

int pm_event_bound_first(pm_workspace *w, int i, const double *g, double biggest, pm_event_at *value_at,
                         pm_span *x)
{
    pm_event_function *f = &w->event->function[i];
    const double h = w->step.sampled_end - w->step.begin, from = (x->a - w->step.begin) / h,
                 to = (x->b - w->step.begin) / h, sign = x->ga > 0 ? 1 : -1;
    pm_bounded known; /* its series is filled where there is one */
    known.w = w;
    known.budget = PM_BOUND_PARTS;
    if (x->ga == 0 || x->gb == 0 || !take(&known, f, g, biggest)) return 0;
    double s[2] = {NAN, beyond(&known, sign, from, to)};
    if (isnan(s[1])) return 0;
    if (pm_event_way_may_cross(f, sign)) return bracket(w, f, s, value_at, x);
    s[0] = s[1];
    s[1] = beyond(&known, -sign, s[0], to);
    return !isnan(s[1]) && bracket(w, f, s, value_at, x);
}
