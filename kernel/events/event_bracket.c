/* event_bracket.c - between which places of a step a function goes through zero, from its samples.
 *
 * Two samples of different sign bracket a zero.  Where it dips towards zero between nodes, through at none of them, the bottom
 * is looked for.  Of three nodes x_0 < x_1 < x_2 the middle one is lowest: the vertex of the parabola through them,
 *
 *   x = x_1 - g' / (2 b),    g = g_1 - g'^2 / (4 b)      g' its slope at x_1, 2 b its bend
 *
 * Two nodes at a distance h, with values a and b, show a dip by the slopes p / h < 0 < q / h of the polynomial there: the
 * minimum of the cubic through both values and slopes,
 *
 *   g(t) = a + p t + c2 t^2 + c3 t^3,    c2 = 3 (b - a) - 2 p - q,    c3 = 2 (a - b) + p + q
 *   t = -p / (c2 + sqrt(c2^2 - 3 c3 p))
 *
 * If that comes near to zero, Newton's method on differences of the dense output leads to the bottom itself.
 *
 * A function that is on its zero when the step begins has no side yet: it is looked for where it has left.  One that has
 * rested there until the phase began is through when it leaves. */
#include "events/edge_passage.h"
#include "events/event_bound.h"
#include "events/event_parts.h"
#include "events/step.h"

#include <float.h>
#include <math.h>

#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

/* ---- by bounds ---- */
/* Between five nodes or more, whose samples tell the bends (PM_WAVES_CALM times their range), no dip is deeper. */
static int may_reach(const pm_event_course *of, const pm_span *x)
{
    return of->n < PM_NODES || pm_min(fabs(x->ga), fabs(x->gb)) < PM_DIP_FAR * (of->high - of->low);
}

/* The first zero within x: by bounds, where there are any, else if the values at its ends show one. */
static int first_within(pm_workspace *w, int i, const pm_event_course *of, pm_span *x)
{
    const int shown = pm_event_way_crosses(&w->event->function[i], x->ga, x->gb);
    return (of->bounded && (shown || may_reach(of, x)) &&
            pm_event_bound_first(w, i, of->g, pm_event_samples_along, x)) ||
           shown;
}

/* ---- dips ---- */
/* From near the bottom of a dip to it, by Newton's method on differences; s is the side of zero. */
static double bottom(pm_workspace *w, pm_event_function *f, double s, double low, double high, double *where)
{
    const double d = PM_DIP_STEP * (high - low);
    double value = s * pm_event_samples_along(w, *where, f);
    for (int i = 0; i < PM_DIP_STEPS && value > 0; i++) {
        const double a = s * pm_event_samples_along(w, *where - d, f),
                     b = s * pm_event_samples_along(w, *where + d, f), bend = a - 2 * value + b;
        if (!(bend > 0)) break;
        const double next = fmin(fmax(*where + 0.5 * d * (a - b) / bend, low), high),
                     there = s * pm_event_samples_along(w, next, f);
        if (!(there < value)) break;
        *where = next;
        value = there;
    }
    return value;
}

/* What falls on where it goes `out` of what is searched has no bottom there: what is next shows how near to zero it comes. */
static int falls_on(pm_workspace *w, pm_event_function *f, double s, double least, double x, double out)
{
    return out != 0 && s * pm_event_samples_along(w, x + PM_DIP_STEP * out, f) < least;
}

/* A function that came close to zero at `where` goes through it there, or has gone back: a decision to be noted. */
static int reaches(pm_workspace *w, pm_event_function *f, double s, double around, double low, double high,
                   double *where, double *value)
{
    const double least = bottom(w, f, s, low, high, where);
    *value = s * least;
    const double out = *where >= high ? high - low : *where <= low ? low - high : 0;
    if (least > 0 && least < f->near && f->kind != FUNCTION_MEETING && f->kind != FUNCTION_STRAND &&
        !falls_on(w, f, s, least, *where, out)) {
        f->near = least;
        f->near_reach = around;
    }
    return least <= 0;
}

/* A dip of three nodes towards zero: the vertex of their parabola, if the function goes through zero there. */
static int dips(pm_workspace *w, pm_event_function *f, const double *g, double biggest, const double *x,
                double *where, double *value)
{
    if (fabs(g[1]) > PM_DIP_FAR * biggest) return 0;
    const double s = g[1] > 0 ? 1 : -1, a = s * g[0], b = s * g[1], c = s * g[2];
    if (!(b < a && b < c) || !(a > 0 && b > 0 && c > 0)) return 0;
    const double left = (a - b) / (x[1] - x[0]), right = (c - b) / (x[2] - x[1]);
    const double bend = (left + right) / (x[2] - x[0]);
    const double slope = (right * (x[1] - x[0]) - left * (x[2] - x[1])) / (x[2] - x[0]);
    if (b - slope * slope / (4 * bend) > PM_DIP_CLOSE * b) return 0;
    *where = x[1] - slope / (2 * bend);
    return reaches(w, f, s, fmax(a, c), x[0], x[2], where, value);
}

/* Slope at a node of the polynomial through the values there. */
static double slope_at(const pm_step *step, const double *g, int k)
{
    return pm_chebyshev_slope_at(step->nodes, g, k) / (step->end - step->begin);
}

/* The gap of circles that pass each other bends within their radii: no polynomial through samples so far apart has its slopes. */
static int hides_slopes(pm_workspace *w, const pm_event_function *f)
{
    return f->kind == FUNCTION_GAP &&
           !pm_event_samples_resolve(&w->step, w->event, (int)(f - w->event->function));
}

/* Slope at node k, which lies at x, by a value a little way towards another place where the samples do not tell it. */
static double slope_towards(pm_workspace *w, pm_event_function *f, const double *g, int k, double x,
                            double other)
{
    if (!hides_slopes(w, f)) return slope_at(&w->step, g, k);
    const double d = PM_DIP_STEP * (other - x);
    return (pm_event_samples_along(w, x + d, f) - g[k]) / d;
}

/* The least of the cubic between values a and b with slopes p < 0 < q, and at which part t of the way. */
static double bottom_of_cubic(double a, double b, double p, double q, double *t)
{
    const double c2 = 3 * (b - a) - 2 * p - q, c3 = 2 * (a - b) + p + q;
    *t = -p / (c2 + sqrt(fmax(c2 * c2 - 3 * c3 * p, 0)));
    return *t > 0 && *t < 1 ? a + *t * (p + *t * (c2 + *t * c3)) : INFINITY;
}

/* A dip between node k and the next, shown by the slopes there: also one beside an end of the step, where three nodes do
 * not show it.  The bottom of the cubic through both values and slopes. */
static int returns(pm_workspace *w, pm_event_function *f, const double *g, int k, const double *x,
                   double *where, double *value)
{
    const double s = g[k] > 0 ? 1 : -1, a = s * g[k], b = s * g[k + 1], h = x[1] - x[0];
    if (!(a > 0 && b > 0)) return 0;
    double slope[2];
    for (int i = 0; i < 2; i++) { /* the values show one of them: first the other */
        const int at = b < a ? 1 - i : i;
        slope[at] = s * slope_towards(w, f, g, k + at, x[at], x[1 - at]) * h;
        if (!(at ? slope[at] > 0 : slope[at] < 0)) return 0;
    }
    const double close = (hides_slopes(w, f) ? PM_DIP_HIDDEN : PM_DIP_CLOSE) * fmin(a, b);
    double t;
    if (!(bottom_of_cubic(a, b, slope[0], slope[1], &t) <= close)) return 0;
    *where = x[0] + t * h;
    return reaches(w, f, s, fmax(a, b), x[0], x[1], where, value);
}

/* All samples, five or more, are on one side, so far from zero that no parabola of three nodes (of which one interval is at most
 * three times the other) comes near to it. */
static int stays_away(const pm_event_course *x)
{
    const double least = x->low > 0 ? x->low : -x->high;
    return x->n >= PM_NODES && least > PM_DIP_FAR * x->biggest;
}

/* A dip between node k and the next shows at one of them, unless the function is not smooth: it is lower there than beside
 * it, or at an end of the step. */
static int shows_dip(const pm_event_course *x, int k)
{
    const double *g = x->g, a = fabs(g[k]), b = fabs(g[k + 1]);
    return b < a ? k + 2 >= x->n || !(fabs(g[k + 2]) < b) : k == 0 || !(fabs(g[k - 1]) < a);
}

/* ---- what was on its zero ---- */
/* A slip held at zero is beyond it at b, where it is no slip in the way of its mode: it rests on zero as long as it is nothing.
 * Other slips, with which it goes, may end before that. */
static void leaves_later(pm_workspace *w, pm_event_function *f, double a, double b, pm_span *x)
{
    for (int i = 0; i < PM_BOUNCE_HALVINGS; i++) {
        const double middle = 0.5 * (a + b);
        if (middle <= a || middle >= b) break;
        *(pm_event_samples_along(w, middle, f) < -f->slack ? &b : &a) = middle;
    }
    *x = (pm_span){a, a, 0, 0};
}

/* A function held at zero is negative at b: it has gone up and come back (a short bounce), or it went the wrong way at
 * once and the event is now. */
static void leaves_and_returns(pm_workspace *w, pm_event_function *f, double a, double b, double gb,
                               pm_span *x)
{
    const double end = b;
    *x = (pm_span){a, a, 0, 0};
    for (int i = 0; i < PM_BOUNCE_HALVINGS; i++) {
        const double middle = 0.5 * (a + b), g = pm_event_samples_along(w, middle, f);
        if (middle <= a) break;
        if (g > 0) {
            *x = (pm_span){middle, b, g, gb};
            break;
        }
        b = middle;
        gb = g;
    }
    if (x->a != x->b) return;
    if (f->kind == FUNCTION_SLIP) leaves_later(w, f, a, end, x);
    if (f->kind == FUNCTION_GAP) w->event->spent[f->index] = 1;
}

/* A function held at zero at node k - 1 is above it at node k, but goes the wrong way before: *x to where it shows that. */
static int dips_at_once(pm_workspace *w, pm_event_function *f, const pm_event_course *of, int k, pm_span *x)
{
    const double h = x->b - x->a, p = slope_at(&w->step, of->g, k - 1) * h;
    double t;
    if (!(p < 0)) return 0;
    const double q = slope_at(&w->step, of->g, k) * h;
    if (!(q > 0) || !(bottom_of_cubic(of->g[k - 1], of->g[k], p, q, &t) < -f->slack)) return 0;
    const double place = x->a + t * h, value = pm_event_samples_along(w, place, f);
    if (!(value < -f->slack)) return 0;
    *x = (pm_span){x->a, place, 0, value};
    return 1;
}

/* Node k is the first on which a gap, or a load, that was on zero is off it. */
static int returns_after(pm_workspace *w, int i, const pm_event_course *of, int k, pm_span *x)
{
    const double a = w->event->place[k - 1];
    pm_event_function *f = &w->event->function[i];
    *x = (pm_span){a, w->event->place[k], 0, of->g[k]};
    if (!(of->g[k] < 0) && !dips_at_once(w, f, of, k, x) &&
        (f->edge == PM_NONE || !pm_edge_passage_after(w, i, k - 1, pm_event_samples_along, x)))
        return 0;
    if (x->a == a) leaves_and_returns(w, f, a, x->b, x->gb, x);
    return 1;
}

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
        return now || first_within(w, i, of, x);
    }
    return 0;
}

/* ---- the step ---- */
/* At the begin of the phase it may be on its zero by chance. */
static void hold_if_on_zero(const pm_event_set *e, pm_event_function *f, const pm_event_course *of, double at)
{
    if (!e->first_step || at != e->place[0] || !(fabs(of->g[0]) <= PM_ON_ZERO * of->biggest)) return;
    f->held = 1;
    f->since = at;
}

/* A step that ends on a zero, but for rounding, may end before it where the next begins beyond it: that begins where the last
 * one came from.  What stays on zero is not beyond it. */
static void join(const pm_event_function *f, pm_event_course *of)
{
    int k = 0;
    while (k < of->n && fabs(of->g[k]) <= PM_ON_ZERO * of->biggest) k++;
    const int apart = (f->left > 0 && of->g[0] <= 0) || (f->left < 0 && of->g[0] >= 0);
    if (!f->held && apart && k < of->n) pm_event_course_set(of, 0, copysign(DBL_MIN, f->left));
}

/* Moves *first on to the node from which its side is known (n: none); 1 if there is a bracket before it. */
static int enter(pm_workspace *w, int i, const pm_event_course *of, int *first, pm_span *x)
{
    const double *place = w->event->place, *g = of->g;
    const pm_event_set *e = w->event;
    pm_event_function *f = &w->event->function[i];
    const int changes_sign = pm_event_changes_sign(f);
    int k = *first;
    if (f->held && changes_sign) { /* enters on the side where it goes */
        const double since = pm_max(f->since, place[0]);
        while (k < of->n - 1 && (place[k] <= since || fabs(g[k]) < f->slack)) k++;
        *first = k;
        const double beyond = left_beyond(e, f, of, since);
        return leaves_and_crosses(w, i, of, since, place[k], g[k], beyond, x);
    }
    if (f->held) { /* a contact starts on the open side, and counts again from where it has left its zero */
        for (k = 1; k < of->n && fabs(g[k]) <= f->slack;) k++;
        *first = k;
        return k < of->n && returns_after(w, i, of, k, x);
    }
    if (changes_sign || !(g[0] <= 0)) return 0;
    *x = (pm_span){place[0], place[0], 0, 0}; /* the last step ended on its zero */
    return 1;
}

/* Node k and the next are on one side of zero: a place beyond it, *where, and the node behind that; 0: there is none. */
static int through_and_back(pm_workspace *w, int i, const pm_event_course *of, int k, double *where,
                            double *value)
{
    const double *place = w->event->place + k, *g = of->g, close = PM_DIP_NEAR * of->biggest;
    pm_event_function *f = &w->event->function[i];
    const int near = fabs(g[k]) < close || fabs(g[k + 1]) < close;
    if (shows_dip(of, k) ||
        (near && pm_event_samples_tail(&w->step, w->event, i, of) >= PM_CHEBYSHEV_SMOOTH)) {
        if (near && returns(w, f, g, k, place, where, value)) return k + 1;
        if (k + 2 < of->n && dips(w, f, g + k, of->biggest, place, where, value)) return k + 2;
    }
    return 0;
}

/* Beyond this, between two nodes of five or more on one side of zero, neither bounds nor dips show a zero. */
static double far_from_zero(const pm_event_function *f, const pm_event_course *of)
{
    if (of->n < PM_NODES || f->edge != PM_NONE) return INFINITY;
    return PM_DIP_FAR * pm_max(of->biggest, of->high - of->low);
}

/* The first node from k on between which and the next there may be one. */
static int next_near(const pm_event_course *of, double far, int k)
{
    const double *g = of->g, side = g[k] < 0 ? -1 : 1;
    while (side * g[k] > far && k + 1 < of->n && side * g[k + 1] > far) k++;
    return k;
}

/* The first bracket between node k and the next. */
static int search_between(pm_workspace *w, int i, const pm_event_course *of, int k, pm_span *x)
{
    const double *place = w->event->place, *g = of->g;
    pm_event_function *f = &w->event->function[i];
    const int one_side = g[k] * g[k + 1] > 0;
    double where, value;
    if (of->bounded || !one_side) {
        *x = (pm_span){place[k], place[k + 1], g[k], g[k + 1]};
        if (first_within(w, i, of, x)) return 1;
    }
    const int after = one_side ? through_and_back(w, i, of, k, &where, &value) : 0;
    if (!after) return 0;
    *x = (pm_span){place[k], place[after], g[k], g[after]};
    if (of->bounded && pm_event_bound_first(w, i, of->g, pm_event_samples_along, x)) return 1;
    *x = pm_event_way_may_cross(f, g[k]) ? (pm_span){place[k], where, g[k], value}
                                         : (pm_span){where, place[after], value, g[after]};
    return 1;
}

/* The first bracket between two nodes, from node `first` on. */
static int search(pm_workspace *w, int i, const pm_event_course *of, int first, double from, pm_span *x)
{
    const pm_event_function *f = &w->event->function[i];
    const double far = far_from_zero(f, of);
    for (int k = first; (k = next_near(of, far, k)) + 1 < of->n; k++) {
        if (f->edge != PM_NONE && of->g[k] > 0 &&
            pm_edge_passage_between(w, i, k, pm_event_samples_along, x) && x->b > from)
            return 1;
        if (search_between(w, i, of, k, x) && x->b > from) return 1;
    }
    return 0;
}

int pm_event_bracket_first(pm_workspace *w, int i, double from, pm_span *x)
{
    pm_event_set *e = w->event;
    pm_event_function *f = &e->function[i];
    pm_event_course of;
    pm_event_samples_take(&w->step, w->event, i, &of);
    of.bounded = pm_event_bound_is_known(w, i);
    int first = 0;
    const int last = of.n - 1, ends = (e->at_root || e->at_due) && pm_step_is_last(&w->step);
    if (ends && fabs(of.g[last]) <= PM_ON_ZERO * of.biggest)
        pm_event_course_set(&of, last, 0); /* there the phase ends */
    while (first < last && e->place[first + 1] <= from) first++;
    if (first == last) return 0;
    if (pm_event_changes_sign(f) && first == 0) join(f, &of);
    if (pm_event_changes_sign(f)) hold_if_on_zero(w->event, f, &of, from);
    if (enter(w, i, &of, &first, x)) return 1;
    return (f->edge != PM_NONE || !stays_away(&of)) && search(w, i, &of, first, from, x);
}
