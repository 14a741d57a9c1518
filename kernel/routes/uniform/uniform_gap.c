/* uniform_gap.c - when an open contact closes in a phase with constant accelerations, by advancing with bounds, never by
 * sampling.
 *
 * From a place where gap g, its rate g' and a lower bound c of g'' over the next h are known,
 *   g(s) >= g + g' s + c s^2/2,   g(s) >= g - L s   (L: a bound of |g'|),
 * so that it is open up to the first root of either.  Where bodies do not rotate against a line, c is g'' itself and that
 * root is the answer; where they do, the steps close in on it as Newton's do.  A touching contact that leaves starts with
 * g = 0. */
#include <math.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/edge.h"
#include "events/event.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/uniform/uniform.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

enum pm_end_of_advance {
    OPEN = 0,
    NEARLY = 1,
    EXACTLY = 2
}; /* still open; closes, by rounding or as a parabola */

double pm_uniform_gap_first_root(double g, double rate, double bend)
{
    const double square = rate * rate - 2 * bend * g;
    if (bend >= 0) return rate >= 0 || square < 0 ? INFINITY : 2 * g / (-rate + sqrt(square));
    return rate > 0 ? (rate + sqrt(square)) / -bend : 2 * g / (-rate + sqrt(square));
}

/* How long a member stays open, at most h; *exact: it closes there.  Bounds over a long stretch tell little, and those over a
 * short one tell no more than it is long: the length with about the longest answer is looked for between both. */
static double open_for(const pm_frame *frame, const pm_uniform *uniform, const pm_constraint *c, double g,
                       double rate, double h, int *exact)
{
    const double *a = uniform->a;
    double safe = 0, far = h;
    *exact = 0;
    for (int i = 0; i < PM_UNIFORM_REFINEMENTS; i++) {
        pm_constraint_bounds x;
        pm_constraint_kind(c->kind)->bound(frame, c, a, h, &x);
        if (x.exact) {
            safe = pm_uniform_gap_first_root(g, rate, x.bend);
            *exact = safe < h;
            return fmin(safe, h);
        }
        const double by_rate = x.rate > 0 ? g / x.rate : INFINITY;
        safe = pm_max(fmin(h, fmax(pm_uniform_gap_first_root(g, rate, x.bend), by_rate)), safe);
        if (safe < h) far = h;
        if (PM_UNIFORM_WIDER * safe >= far) break;
        h = safe > 0 ? sqrt(safe) * sqrt(far) : PM_UNIFORM_SHORTER * h;
    }
    return safe;
}

static double noise_of(const pm_frame *frame, const pm_constraint *c)
{
    const pm_marks m = pm_constraint_marks(frame, c);
    return PM_UNIFORM_ROUNDING * (fabs(m.a.p[0]) + fabs(m.a.p[1]) + fabs(m.b.p[0]) + fabs(m.b.p[1]) +
                                  fabs(c->radius_a) + fabs(c->radius_b));
}

/* A member that touches when the phase begins touches exactly, and one without speed has none. */
static void begin_exactly(const pm_frame *frame, double *g, double *rate)
{
    if (*g > pm_contact_length(frame) || *rate < -pm_contact_speed(frame)) return;
    *g = 0;
    if (*rate <= pm_contact_speed(frame)) *rate = 0;
}

/* The gap of a member of an open contact at the frame, and its rate. */
static double gap_of(const pm_workspace *w, const pm_constraint *c, double *rate)
{
    const pm_constraint_ops *ops = pm_constraint_kind(c->kind);
    if (ops->gap) return ops->gap(&w->frame, c, rate);
    pm_constraint here = *c;
    ops->evaluate(&w->frame, &here);
    *rate = pm_constraint_times(&w->frame, &here, w->frame.v);
    return here.g;
}

static void keep_first(pm_closing *x, int members, double g, double rate)
{
    x->begun = members == 1;
    x->first = g;
    x->first_rate = rate;
}

/* As gap_of; at the begin of the phase it is known. */
static double gap_again(const pm_workspace *w, const pm_constraint *c, const pm_closing *x, double *rate)
{
    if (x->safe > 0 || !x->begun) return gap_of(w, c, rate);
    *rate = x->first_rate;
    return x->first;
}

void pm_uniform_gap_begin(pm_workspace *w, int contact)
{
    pm_uniform *u = w->uniform;
    int member[PM_UNIFORM_NEAR];
    const int n = pm_contact_near(&w->frame, &w->state, contact, PM_UNIFORM_NEAR, member);
    const int there = !pm_state_is_absent(w->model, &w->state, PM_TABLE_CONTACT, contact);
    if (there && pm_edge_is(w->model, contact)) {
        pm_uniform_edge_begin(w, contact);
        return;
    }
    u->closing[contact] = (pm_closing){.root = INFINITY, .near = INFINITY};
    for (int i = 0; i < n; i++) {
        pm_constraint own;
        const pm_constraint *c = pm_contact_constraint_read(&w->frame, contact, member[i], &own);
        double rate, g = gap_of(w, c, &rate);
        keep_first(&u->closing[contact], n, g, rate);
        begin_exactly(&w->frame, &g, &rate);
        if (g > 0 || rate > 0) continue;
        pm_constraint_bounds x = {.bend = -INFINITY};
        if (rate == 0) pm_constraint_kind(c->kind)->bound(&w->frame, c, u->a, 0, &x);
        u->irregular |= x.bend < -PM_UNIFORM_DEFINITE * u->curve.acceleration; /* must not approach */
    }
}

/* Keeps the least gap between the place looked at last, where it shrank, and this one, where it grows: by the rates at
 * both ends.  A decision: with other numbers it might have closed there. */
static void note_near(pm_closing *x, double t, double g, double rate)
{
    const double h = t - x->looked;
    if (x->rate < 0 && rate >= 0) {
        const double least = x->g + 0.5 * x->rate * h * x->rate / (x->rate - rate);
        if (least > 0 && least < x->near) {
            x->near = least;
            x->near_reach = fmax(x->g, g);
        }
    }
    x->looked = t;
    x->g = g;
    x->rate = rate;
}

void pm_uniform_gap_note(pm_workspace *w, int contact)
{
    int member;
    double rate;
    if (pm_state_is_absent(w->model, &w->state, PM_TABLE_CONTACT, contact)) return;
    if (pm_edge_is(w->model, contact)) {
        pm_uniform_edge_note(w, contact);
        return;
    }
    pm_uniform_look(w, w->uniform->end);
    const double gap = pm_contact_gap(&w->frame, &w->state, contact, &member);
    if (gap == INFINITY) return; /* closed */
    pm_contact_member_gap(&w->frame, contact, member, &rate);
    note_near(&w->uniform->closing[contact], w->uniform->end, gap, rate);
}

/* One advance from the frame, at most h: how far it is safe; *root: there the contact closes. */
static double advance(pm_workspace *w, int contact, double h, int *root)
{
    int member[PM_UNIFORM_NEAR];
    const int n = pm_contact_near(&w->frame, &w->state, contact, PM_UNIFORM_NEAR, member);
    const int first = w->uniform->closing[contact].safe == 0;
    double safe = h, least = INFINITY, least_rate = 0;
    *root = OPEN;
    for (int i = 0; i < n; i++) {
        pm_constraint own;
        const pm_constraint *c = pm_contact_constraint_read(&w->frame, contact, member[i], &own);
        double rate, g = gap_again(w, c, &w->uniform->closing[contact], &rate);
        if (first) begin_exactly(&w->frame, &g, &rate);
        if (g == 0 && rate == 0) continue; /* touches and stays clear of it */
        if (g < least) {
            least = g;
            least_rate = rate;
        }
        if (!(first && g == 0) && g <= noise_of(&w->frame, c) && rate < 0) {
            *root = NEARLY;
            return -g / rate;
        }
        int exact;
        const double open = open_for(&w->frame, w->uniform, c, fmax(g, 0), rate, h, &exact);
        if (open < safe || (exact && open == safe)) {
            safe = open;
            *root = exact ? EXACTLY : OPEN;
        }
        if (i + 2 >= n &&
            n == PM_UNIFORM_NEAR) { /* members farther off have a larger gap than the outermost of these */
            pm_constraint_bounds x;
            pm_constraint_kind(c->kind)->bound(&w->frame, c, w->uniform->a, h, &x);
            if (x.rate > 0 && fmax(g, 0) / x.rate < safe) {
                safe = fmax(g, 0) / x.rate;
                *root = OPEN;
            }
        }
    }
    pm_closing *x = &w->uniform->closing[contact];
    note_near(x, x->safe, least, least_rate);
    return safe;
}

void pm_uniform_gap(pm_workspace *w, int contact, double end)
{
    pm_uniform *u = w->uniform;
    pm_closing *x = &u->closing[contact];
    if (pm_state_is_absent(w->model, &w->state, PM_TABLE_CONTACT, contact)) x->safe = end;
    for (int i = 0; i < PM_UNIFORM_ADVANCES && x->safe < end && x->root == INFINITY; i++) {
        int root; /* enum pm_end_of_advance */
        pm_uniform_look(w, x->safe);
        const double step = advance(w, contact, end - x->safe, &root);
        if (root != OPEN || step <= PM_UNIFORM_TIME_ROUNDING * (fabs(u->t0) + x->safe)) {
            x->root = fmax(0, x->safe + step);
            x->exact = root == EXACTLY;
            /* it has parted, and no time shows in which it comes back */
            if (u->t0 + x->root == u->t0) w->event->spent[contact] = 1;
        } else {
            x->safe = step >= end - x->safe ? end : x->safe + step;
        }
    }
}

int pm_uniform_resolves(const pm_workspace *w, int contact)
{
    const pm_closing *x = &w->uniform->closing[contact];
    return x->exact && x->root <= w->uniform->end * (1 + PM_UNIFORM_TOGETHER);
}
