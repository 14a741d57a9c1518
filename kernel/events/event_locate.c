/* event_locate.c - where in its bracket a function is zero.
 *
 * First on the dense output: the root of the polynomial through the samples where these resolve the function, else Brent's
 * method.  Then on exact states (bracket.c), so that an event is as accurate as the trajectory and never only as good as an
 * interpolant.  Where what the route looks at is exact itself, one step of Newton's method from the root r of the
 * polynomial is enough,
 *
 *   x = r - d,    d = g(r) / g'(r)        off by no more than d (e + n^2 d / h)
 *
 * e = n^2 tail |g| / (h |g'|) the relative error of the slope by n nodes in a step of length h, |g| the greatest of
 * the samples. */
#include "events/event_bound.h"
#include "events/event_parts.h"

#include <math.h>

#include "events/last_bounce.h"
#include "events/step.h"
#include "numerics/bracket.h"
#include "numerics/chebyshev.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"
#include "state/route.h"
#include "state/workspace.h"

/* What rounding leaves of the samples tells where a zero is, and its slope there; not where others are right beside it. */
static int tell_slope(const pm_step *step, const pm_event_function *f, double slope)
{
    const double part = PM_SERIES_ROUNDING * f->biggest / (fabs(slope) * (step->end - step->begin));
    return part <= PM_PLACE_SHARP;
}

/* ---- on the dense output ---- */
/* The root of the polynomial through the samples, and its slope there. */
static int root_of_samples(pm_workspace *w, int i, const pm_span *x, double *place)
{
    const double begin = w->step.begin, h = w->step.end - begin;
    double s, slope;
    pm_event_course of;
    pm_event_samples_take(&w->step, w->event, i, &of);
    const int status =
        pm_fail_search(&w->result, pm_chebyshev_root(w->step.nodes, of.g, (x->a - begin) / h, x->ga,
                                                     (x->b - begin) / h, x->gb, &s, &slope));
    *place = begin + s * h;
    w->event->function[i].slope = slope / h;
    return status;
}

int pm_event_locate_root(pm_workspace *w, int i, const pm_span *x, double *place)
{
    pm_event_set *e = w->event;
    *place = x->a;
    e->function[i].slope = NAN;
    if (!(x->b > x->a)) return PM_OK;
    if (!pm_event_samples_resolve(&w->step, w->event, i)) pm_event_samples_of_member(w, i, x->b);
    if (pm_event_samples_resolve(&w->step, w->event, i)) {
        const int status = root_of_samples(w, i, x, place);
        if (status || tell_slope(&w->step, &e->function[i], e->function[i].slope)) return status;
    }
    return pm_fail_search(&w->result, pm_bracket_find(e->solver, pm_event_samples_along, w, &e->function[i],
                                                      x->a, x->ga, x->b, x->gb, place));
}

/* ---- on exact states ---- */
static int exactly(void *of, double x, void *context, double *value)
{
    pm_workspace *w = of;
    const pm_event_function *f = context;
    const int status = pm_step_look_exactly(w, x, f->level);
    if (!status) *value = pm_event_value(w, f);
    return status;
}

/* Where what the route looks at is exact, one step of Newton's method from the root of the polynomial leads to the zero
 * itself, but for the error of the slope: *near, if that is nothing. */
static int step_onto(pm_workspace *w, int i, double slope, double size, double *place, int *near)
{
    pm_event_function *f = &w->event->function[i];
    const double h = w->step.end - w->step.begin, n = w->step.nodes->n,
                 value = pm_event_samples_along(w, *place, f);
    const double shift = -value / slope, next = *place + shift;
    const double error =
        n * n * fmax(f->tail, PM_PLACE_ROUNDING) * f->biggest / fabs(slope * h); /* of the slope */
    *near = fabs(value) <= PM_OFF_ZERO * size && next > w->step.begin && next < w->step.end &&
            fabs(shift) * (error + n * n * fabs(shift) / h) <= PM_PLACE_ROUNDING * h;
    if (*near) *place = next;
    return isnan(value) ? PM_SOLVER : PM_OK;
}

/* The samples show where a trigger is zero as well as any look would.  (What closes a gap is met to the last bit.) */
static int resolves_zero(const pm_phase *phase, const pm_step *step, const pm_event_function *f, double slope)
{
    const double h = step->end - step->begin;
    return f->kind == FUNCTION_TRIGGER && phase->route->look &&
           pm_event_samples_residual(f, f->biggest) <= PM_PLACE_RESOLVED * fabs(slope * h);
}

/* Moves the root to where the function is zero on an exact state.  A function with a corner is no polynomial: where the
 * polished place is not on its zero it is looked for once more. */
static int polish(pm_workspace *w, int i, const pm_span *x, double slope, double *first, double *taken)
{
    pm_event_function *f = &w->event->function[i];
    const int spectral = !isnan(slope);
    const double size = fmax(fabs(x->ga), fabs(x->gb));
    double off;
    int near = spectral && resolves_zero(&w->phase, &w->step, f, slope), status = PM_OK;
    if (spectral && w->phase.route->look && !near) status = step_onto(w, i, slope, size, first, &near);
    if (near) {
        *taken = *first;
        return status ? status : w->phase.route->exact(w, *first, &w->probe);
    }
    if (!status)
        status = pm_bracket_polish(pm_event_samples_along, exactly, w, f, w->step.begin, w->step.end, slope,
                                   first, taken, &off);
    if (status || !(fabs(off) > PM_OFF_ZERO * size) || !spectral) return status;
    status = pm_fail_search(&w->result, pm_bracket_find(w->event->solver, pm_event_samples_along, w, f, x->a,
                                                        x->ga, x->b, x->gb, first));
    return status ? status
                  : pm_bracket_polish(pm_event_samples_along, exactly, w, f, w->step.begin, w->step.end, NAN,
                                      first, taken, &off);
}

/* ---- what it is there ---- */
static double rate_beside(pm_workspace *w, pm_event_function *f, double x, double step)
{
    const double begin = w->step.begin, end = w->step.end;
    return pm_bracket_slope(pm_event_samples_along, w, f, begin, end, x, step * (end - begin));
}

/* What is watched of a gap, or of the room on an edge, falls at once by more than touching where a mark comes over an edge that it
 * was below, from beyond an end: differences grow there as their step shrinks. */
static int jumps(pm_workspace *w, pm_event_function *f, double x, double rate)
{
    const double closer = PM_EVENT_RATE_STEP / PM_EVENT_RATE_CLOSER, h = w->step.end - w->step.begin;
    if (f->kind != FUNCTION_GAP && f->kind != FUNCTION_END) return 0;
    if (!(2 * PM_EVENT_RATE_STEP * h * fabs(rate) > pm_contact_length(&w->frame))) return 0;
    return fabs(rate_beside(w, f, x, closer)) > PM_EVENT_RATE_JUMPS * PM_EVENT_RATE_CLOSER * fabs(rate);
}

/* How fast the function goes through its zero: a decision, for it might not have reached it.  slope: of the polynomial
 * there, if its samples resolve it. */
static void take_rate(pm_workspace *w, int function, double x, double slope)
{
    if (!w->evidence.active || (!w->step.shown && isnan(slope))) return; /* a jump has no rate */
    pm_event_function *f = &w->event->function[function];
    const double rate = isnan(slope) ? rate_beside(w, f, x, PM_EVENT_RATE_STEP) : slope;
    if (f->kind == FUNCTION_GAP && pm_last_bounce_is_near(w, f->index, rate)) return;
    if (isnan(slope) && jumps(w, f, x, rate)) return;
    pm_event_evidence_rate(w, function, rate);
}

static double slope_of_samples(const pm_step *step, pm_event_set *event, int i, double place)
{
    const double h = step->end - step->begin;
    double here;
    pm_event_course of;
    pm_event_samples_take(step, event, i, &of);
    return pm_chebyshev_slope(step->nodes, of.g, (place - step->begin) / h, &here) / h;
}

/* Its slope at the root, by the samples, or by its law; not a number where these do not resolve it. */
static double slope_at_root(pm_workspace *w, int i, double place)
{
    if (!pm_event_samples_resolve(&w->step, w->event, i)) return NAN;
    const pm_event_function *f = &w->event->function[i];
    const double slope = isnan(f->slope) ? slope_of_samples(&w->step, w->event, i, place) : f->slope;
    return tell_slope(&w->step, f, slope) ? slope : pm_event_bound_slope(w, i, place);
}

int pm_event_locate_settle(pm_workspace *w, int i, const pm_span *x, double *place, double *taken)
{
    const int at_end = *place >= w->step.end && x->gb == 0; /* exactly there: nothing to polish */
    if (at_end && !w->evidence.active) return PM_OK;
    const double slope = slope_at_root(w, i, *place);
    if (!at_end || !w->step.reverses) take_rate(w, i, *place, slope);
    return at_end ? PM_OK : polish(w, i, x, slope, place, taken);
}
