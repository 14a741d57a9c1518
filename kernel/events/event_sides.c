/* event_sides.c - on which side of zero a trigger is: as a step begins and ends, after it has fired, and where it has left its zero.
 *
 * What is next to zero has no sign, but it comes from a side that is known: that of its samples, or, once it has fired, the one to
 * which it went then.  Two zeros may be so close together that no sample lies between them, or that the step ends there.  A trigger
 * that is found on the side from which it would have to go through zero once more has done so, beside the zero that is known. */
#include "events/event_bound.h"
#include "events/event_parts.h"

#include <float.h>
#include <math.h>

#include "elements/trigger.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"
#include "state/workspace.h"

/* So much of a function is rounding, and has no sign. */
static double nothing_of(const pm_event_function *f, double biggest)
{
    return pm_max(PM_ON_ZERO * biggest, f->kind == FUNCTION_TRIGGER ? f->slack : 0);
}

/* ---- as a step begins ---- */
/* At the begin of the phase it may be on its zero by chance. */
static void hold_if_on_zero(const pm_event_set *e, pm_event_function *f, const pm_event_course *of, double at)
{
    if (!e->first_step || at != e->place[0] || !(fabs(of->g[0]) <= PM_ON_ZERO * of->biggest)) return;
    f->held = 1;
    f->since = at;
}

/* It begins beyond zero by little, but more than rounding, and its next definite sample is on the side where it came from: whether it
 * has been through is open.  Where a law switches nobody counts that; what begins to move has been at rest by rounding. */
static void note_open(pm_workspace *w, const pm_event_function *f, const pm_event_course *of, int next)
{
    int32_t row;
    const double begin = of->g[0], rest = w->event->first_step ? f->slack : 0;
    if (!w->evidence.active || f->kind != FUNCTION_TRIGGER || next >= of->n) return;
    if (pm_trigger_of_switch(w->model, f->index) || pm_trigger_is_of_piece(w->model, f->index)) return;
    if (!(f->left * begin < 0 && f->left * of->g[next] > 0)) return;
    if (!(fabs(begin) > pm_max(PM_SERIES_ROUNDING * of->biggest, rest))) return;
    const int table = pm_event_owner(w->model, f, &row);
    pm_evidence_unseen(&w->evidence, table, row, w->event->place[0]);
}

/* A step that ends on a zero, but for rounding, may end before it where the next begins beyond it: that begins where the last
 * one came from.  What stays on zero is not beyond it. */
static void join(pm_workspace *w, const pm_event_function *f, pm_event_course *of)
{
    int k = 0;
    while (k < of->n && fabs(of->g[k]) <= PM_ON_ZERO * of->biggest) k++;
    const int apart = (f->left > 0 && of->g[0] <= 0) || (f->left < 0 && of->g[0] >= 0);
    if (f->held || !apart || k == of->n) return;
    note_open(w, f, of, k > 0 ? k : 1);
    pm_event_course_set(of, 0, copysign(DBL_MIN, f->left));
}

/* It falls towards zero at the end of a step, or rises from it at the begin of one. */
static int falls_to(const pm_step *step, const pm_event_course *of, int node, int beside)
{
    const double g = of->g[node], away = of->g[beside], s = g < 0 ? -1 : 1;
    if (!(fabs(g) < PM_DIP_CLOSE * of->biggest) || !(s * away > fabs(g))) return 0;
    return (beside < node ? -s : s) * pm_chebyshev_slope_at(step->nodes, of->g, node) > 0;
}

/* It is nearest to zero between two steps, by what either shows of it: that is a decision.  What has just fired went through. */
static void note_near(pm_workspace *w, pm_event_function *f, const pm_event_course *of)
{
    const double near = fabs(of->g[0]);
    if (f->held || !f->falls || f->kind != FUNCTION_TRIGGER || !(f->left * of->g[0] > 0) || near >= f->near)
        return;
    if (!falls_to(&w->step, of, 0, 1)) return;
    f->near = near;
    f->near_reach = fabs(of->g[1]);
}

/* The step ends on a zero: the value where it comes from there, which no sample may show; 0: none is beyond rounding. */
static double side_before_end(pm_workspace *w, pm_event_function *f, const pm_event_course *of)
{
    const int last = of->n - 1;
    const double *place = w->event->place, b = place[last],
                 a = f->held ? pm_max(f->since, place[last - 1]) : place[last - 1],
                 beyond = nothing_of(f, of->biggest);
    for (int k = PM_LEAVING_HALVINGS; k > 0; k--) {
        const double g = pm_event_samples_along(w, b - ldexp(b - a, -k), f);
        if (fabs(g) > beyond) return g;
    }
    return 0;
}

static int ends_on_zero(const pm_event_function *f, const pm_event_course *of)
{
    return fabs(of->g[of->n - 1]) <= nothing_of(f, of->biggest);
}

void pm_event_sides_enter(pm_workspace *w, int i, double from, int whole, pm_event_course *of)
{
    pm_event_function *f = &w->event->function[i];
    const int begins = whole && from == w->event->place[0];
    if (begins && !w->event->first_step) note_near(w, f, of);
    if (begins && w->event->first_step && isfinite(f->rested)) note_open(w, f, of, 1);
    if (whole) join(w, f, of);
    hold_if_on_zero(w->event, f, of, from);
    if (f->kind == FUNCTION_TRIGGER && ends_on_zero(f, of)) f->ends = side_before_end(w, f, of);
}

/* ---- as it ends ---- */
/* The last sample of function i not after `place` that is beyond rounding, or what it was before; 0: not known. */
static double last_side(const pm_event_set *e, const pm_event_function *f, const pm_event_course *of,
                        double place)
{
    const double fired = f->held ? f->since : -INFINITY, end = e->place[of->n - 1];
    const double beyond = nothing_of(f, of->biggest);
    if (f->ends != 0 && place >= end && fired < end) return f->ends;
    for (int k = of->n - 1; k >= 0; k--)
        if (e->place[k] <= place && e->place[k] > fired && fabs(of->g[k]) > beyond) return of->g[k];
    return f->held && f->kind != FUNCTION_TRIGGER ? 0 : f->left;
}

double pm_event_sides_last(const pm_step *step, pm_event_set *e, int i, double place)
{
    pm_event_course of;
    pm_event_samples_take(step, e, i, &of);
    return last_side(e, &e->function[i], &of, place);
}

void pm_event_sides_leave(const pm_step *step, pm_event_set *e, int i)
{
    pm_event_function *f = &e->function[i];
    pm_event_course of;
    pm_event_samples_take(step, e, i, &of);
    const double side = last_side(e, f, &of, INFINITY), last = of.g[of.n - 1];
    f->falls = falls_to(step, &of, of.n - 1, of.n - 2);
    /* it may just have fired, and be beyond zero by rounding */
    f->left = side == 0 && f->held && fabs(last) > f->slack ? last : side;
}

void pm_event_sides_fired(pm_event_function *f)
{
    const pm_span *x = &f->bracket;
    const double went = x->gb != 0          ? x->gb
                        : x->ga != 0        ? -x->ga
                        : f->direction != 0 ? f->direction
                                            : -f->left;
    if (f->kind == FUNCTION_TRIGGER && !f->every) f->left = (went > 0) - (went < 0);
}

/* ---- where it has left its zero ---- */
/* How far from zero a held trigger has left it; one that was zero throughout the step before fires as it leaves to its side. */
static double left_beyond(const pm_event_set *e, pm_event_function *f, const pm_event_course *of,
                          double since)
{
    const double rounding = PM_ON_ZERO * of->biggest, beyond = pm_max(f->slack, rounding);
    const int fresh = e->first_step || (f->slack > 0 && isfinite(f->rested)), zero = fabs(of->g[0]) <= beyond;
    const int rests = fresh && since == e->place[0] && zero && f->rested <= beyond;
    const double least =
        f->rested > 0 || pm_event_set_sticks(e) ? PM_EVENT_RESTED * f->slack : 0; /* rounding of what rests */
    if (!rests) f->rested = INFINITY;
    return rests ? pm_max(pm_max(pm_max(f->rested, fabs(of->g[0])), rounding), least) : beyond;
}

/* So close to a zero that was located at x nothing has left it.  A jump lies within what its argument scatters by, which may
 * be more than the rounding of the place: so close to it its window shows nothing. */
static double least_leaving(const pm_step *step, double x)
{
    const double jump = PM_LEAVING_JUMP * PM_WINDOW_SWITCH * (step->whole_end - step->whole_begin);
    return pm_max(step->shown ? 0 : jump, PM_LEAVING_LEAST * fabs(x));
}

/* At `place` it is where it has definitely left the zero at a, and comes from the other side: it has been through once more between
 * these.  Where looks show its side before, *x is from there, else it is at once. */
static void went_back(pm_workspace *w, pm_event_function *f, double a, double place, double g, double least,
                      pm_span *x)
{
    *x = (pm_span){a, a, 0, 0};
    for (double d = 0.5 * (place - a); d > least; d *= 0.5) {
        const double before = pm_event_samples_along(w, a + d, f);
        if (f->left * before > 0) {
            *x = (pm_span){a + d, place, before, g};
            return;
        }
    }
}

/* A trigger that was on zero at a: its side is where it has definitely left; it may have come back before b.  The
 * samples show that where they resolve it, beyond their error. */
static int leaves_and_crosses(pm_workspace *w, int i, const pm_event_course *of, double a, double b,
                              double gb, double noise, pm_span *x)
{
    pm_event_function *f = &w->event->function[i];
    const double begin = w->step.begin, h = w->step.end - begin, least = least_leaving(&w->step, a);
    const int resolved = pm_event_samples_resolved(&w->step, w->event, i, of);
    const int since_began = w->event->first_step && a == w->event->place[0];
    for (int k = PM_LEAVING_HALVINGS; k > 0; k--) {
        const double place = a + ldexp(b - a, -k);
        if (place - a <= least) continue; /* where it jumps, a may still be before that */
        double g = resolved ? pm_chebyshev_value(w->step.nodes, of->g, 1, (place - begin) / h) : 0;
        if (!(fabs(g) > fmax(noise, pm_event_samples_residual(f, of->biggest))))
            g = pm_event_samples_along(w, place, f);
        if (!(fabs(g) > noise) && !(of->bounded && pm_event_bound_tells(w, i, place, g))) continue;
        const int now = (isfinite(f->rested) && g * f->direction > 0) ||
                        (since_began && pm_event_way_crosses(f, f->left, g));
        *x = now ? (pm_span){a, a, 0, 0} : (pm_span){place, b, g, gb};
        if (now) return 1;
        if (f->kind != FUNCTION_TRIGGER || g * gb < 0 || !pm_event_way_crosses(f, f->left, g))
            return pm_event_bracket_within(w, i, of, x);
        went_back(w, f, a, place, g, least, x);
        return 1;
    }
    return 0;
}

int pm_event_sides_leaves(pm_workspace *w, int i, const pm_event_course *of, pm_span *x)
{
    const double a = x->a, noise = left_beyond(w->event, &w->event->function[i], of, a);
    return leaves_and_crosses(w, i, of, a, x->b, x->gb, noise, x);
}
