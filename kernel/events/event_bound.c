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

#include "events/bounds.h"
#include "events/watched_samples.h"
#include "events/waves.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"
#include "state/workspace.h"

typedef struct pm_bounded {
    pm_bounds of;
    double nothing; /* so little beyond zero is rounding, or an error of the polynomial */
    int budget;     /* of parts */
} pm_bounded;

/* ---- what is known of it ---- */
/* The program of a trigger. */
static int program_of(const pm_workspace *w, const pm_event_function *f)
{
    return f->kind == FUNCTION_TRIGGER ? PM_TRIGGER_ROW(w->model, f->index)[PM_TRIGGER_PROGRAM] : PM_NONE;
}

int pm_event_bound_is_known(const pm_workspace *w, int i)
{
    const pm_event_function *f = &w->event->function[i];
    if (f->kind != FUNCTION_TRIGGER) return f->kind == FUNCTION_MEETING || f->kind == FUNCTION_STRAND;
    const int program = program_of(w, f);
    return pm_waves_may_be(w, program) && pm_waves_tell_law(w, program, PM_SAMPLE_TRIGGERS);
}

static pm_enclosure law_at(const pm_workspace *w, int program, double x)
{
    const double s = (x - w->step.begin) / (w->step.sampled_end - w->step.begin);
    return pm_waves_enclosed(w, program, s, s);
}

int pm_event_bound_tells(const pm_workspace *w, int i, double x, double value)
{
    const int program = program_of(w, &w->event->function[i]);
    if (program == PM_NONE) return 0;
    return fabs(value) > PM_BOUND_SURE * pm_interval_width(law_at(w, program, x).jet.value);
}

double pm_event_bound_slope(const pm_workspace *w, int i, double x)
{
    const int program = program_of(w, &w->event->function[i]);
    if (program == PM_NONE || !pm_event_bound_is_known(w, i)) return NAN;
    const pm_interval rate = law_at(w, program, x).jet.rate;
    return 0.5 * (rate.lo + rate.hi) / (w->step.sampled_end - w->step.begin);
}

/* 1, and what bounds f; 0 where its samples do not show it. */
static int take(pm_bounded *x, const pm_workspace *w, const pm_event_function *f, const double *g)
{
    x->of.w = w;
    x->of.narrow = 0;
    x->of.program = program_of(w, f);
    x->nothing = 0;
    if (x->of.program != PM_NONE) return 1;
    pm_chebyshev_series_of(&x->of.series, w->step.nodes, g);
    x->nothing = pm_max(x->of.series.high, PM_SERIES_ROUNDING * x->of.series.size);
    return x->of.series.resolved;
}

/* ---- the first place beyond zero ---- */
/* The value at a place is beyond zero, and no rounding. */
static int is_beyond(const pm_bounded *x, double s, double value)
{
    if (!(value > x->nothing)) return 0;
    return x->of.program == PM_NONE || pm_bounds_least(&x->of, s) > 0;
}

/* The first place that is met in [from, to] where the value has the sign of x->of.sign; NaN: there is none.  Before it the function
 * goes through zero once. */
static double beyond(pm_bounded *x, double from, double to)
{
    const double middle = 0.5 * (from + to), at[3] = {from, middle, to};
    const pm_bound part = pm_bounds_over(&x->of, from, to);
    if (part.most <= x->nothing) return NAN;
    const int known = pm_bounds_is_monotonic(&part) || to - from <= PM_BOUND_LEAST || --x->budget < 0;
    for (int k = 0; k < (known ? 3 : 1); k++)
        if (is_beyond(x, at[k], part.at[k])) return at[k];
    if (known) return NAN;
    const double first = beyond(x, from, middle);
    return isnan(first) ? beyond(x, middle, to) : first;
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

/* Its bounds have come to their end before they told whether it goes through zero. */
static void note_unseen(pm_workspace *w, const pm_event_function *f, double t)
{
    int32_t row;
    const int table = pm_event_owner(w->model, f, &row);
    pm_evidence_unseen(&w->evidence, table, row, t);
}

/* The places s[0] and s[1] of the step between which f first goes through zero in a way that counts (NaN: the begin of x); 0: there
 * are none. */
static int first_passage(pm_bounded *known, const pm_event_function *f, double sign, double from, double to,
                         double s[2])
{
    known->of.sign = -sign;
    s[0] = NAN;
    s[1] = beyond(known, from, to);
    if (isnan(s[1]) || pm_event_way_may_cross(f, sign)) return !isnan(s[1]);
    known->of.sign = sign;
    s[0] = s[1];
    s[1] = beyond(known, s[0], to);
    return !isnan(s[1]);
}

int pm_event_bound_first(pm_workspace *w, int i, const double *g, pm_event_at *value_at, pm_span *x)
{
    pm_event_function *f = &w->event->function[i];
    const double h = w->step.sampled_end - w->step.begin, from = (x->a - w->step.begin) / h,
                 to = (x->b - w->step.begin) / h;
    pm_bounded known; /* its series is filled where there is one */
    double s[2];
    known.budget = PM_BOUND_PARTS;
    if (x->ga == 0 || x->gb == 0 || !take(&known, w, f, g)) return 0;
    const int found = first_passage(&known, f, x->ga > 0 ? 1 : -1, from, to, s);
    if (known.budget < 0) note_unseen(w, f, x->a);
    return found && bracket(w, f, s, value_at, x);
}
