/* impact_together.c - several contacts in one blow: Newton's restitution along each normal, friction by the slip after the blow
 * (Moreau), all at once (contact_problem.h).
 *
 *   u_n' + e u_n >= 0,  P_n >= 0,  one of them zero          |P_t| <= mu_s P_n without slip after the blow
 *                                                            P_t = -mu_k P_n sgn(u_t') with slip
 *
 * u before, u' after it, relative to what drives prescribe; e = 0 for what rests.  The modes that the problem has are then
 * solved as the equations of a trial, exactly (impact_trial.c).
 *
 * With friction such a blow may gain energy.  A blow without restitution never does, and blows between the two obey all
 * inequalities: then P = k P(e) + (1 - k) P(0), with the largest k <= 1 that gains none. */
#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "equations/active_set.h"
#include "equations/saddle.h"
#include "equations/shared_reading.h"
#include "events/event.h"
#include "events/last_bounce.h"
#include "impact/contact_system.h"
#include "impact/impact_parts.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

/* ---- the problem ---- */
/* Blows one by one are those of one contact. */
static int rests_in_it(const pm_model *m, const pm_blow *b, int slot)
{
    return b->resting[slot] != PM_OPEN && !pm_impact_one_by_one(m);
}

/* What is struck, or rests; captured pairs are joints. */
static void list(pm_workspace *w, const pm_blow *b, pm_contact_system *x)
{
    x->problem.n = 0;
    for (int i = 0; i < w->model->nslot; i++) {
        const int captured = b->share[i] != PM_OUT && b->trial[i] == PM_CAPTURED;
        w->state.slot[i].mode = captured ? PM_CAPTURED : PM_OPEN;
        if (!captured && (b->share[i] != PM_OUT || rests_in_it(w->model, b, i))) x->slot[x->problem.n++] = i;
    }
}

void pm_impact_respond_free(pm_workspace *w, pm_contact_system *x)
{
    memset(x->free, 0, (size_t)w->model->nq * sizeof *x->free);
    for (int i = 0; i < w->active.n; i++) w->saddle.wanted[i] = -pm_impact_trial_rate(w, i);
    if (w->active.n > 0) pm_saddle_respond_roughly(w, NULL, x->free);
    for (int i = 0; i < w->model->nq; i++) x->free[i] += w->state.v[i];
}

int pm_impact_list(pm_workspace *w, pm_blow *b)
{
    pm_contact_system *x = &b->system;
    list(w, b, x);
    const int status = pm_contact_system_respond(w, x);
    if (status) return status;
    pm_impact_respond_free(w, x);
    pm_contact_system_friction(&w->frame, x);
    return PM_OK;
}

/* A bounce that is over is closed, though rounding may have left it a speed. */
static double restitution_rate(const pm_workspace *w, const pm_blow *b, int slot, double before, double now)
{
    const int contact = pm_contact_of_slot(w->model, slot);
    if (w->event->spent[contact]) return -fabs(now);
    return b->share[slot] != PM_STRUCK || b->plastic
               ? now
               : now + pm_last_bounce_restitution(w, contact, before) * fmin(before, 0);
}

/* The slip after the blow, and what a tangential restitution adds where the contact rebounds. */
static double slip_rate(const pm_workspace *w, const pm_blow *b, int slot, double normal, double before,
                        double now)
{
    const int contact = pm_contact_of_slot(w->model, slot);
    const int rebounds =
        b->share[slot] == PM_STRUCK && !b->plastic && pm_last_bounce_restitution(w, contact, normal) > 0;
    return rebounds ? now + pm_contact_tangential(&w->frame, contact) * before : now;
}

void pm_impact_pose(pm_workspace *w, pm_blow *b)
{
    pm_contact_system *x = &b->system;
    for (int i = 0; i < x->problem.n; i++) {
        const pm_constraint *c[2] = {&x->normal[i], &x->tangent[i]};
        double before[2], now[2];
        for (int k = 0; k < 2; k++) {
            before[k] = pm_constraint_times(&w->frame, c[k], w->state.v) - c[k]->rate;
            now[k] = pm_constraint_times(&w->frame, c[k], x->free) - c[k]->rate;
        }
        x->problem.contact[i].bias[0] = restitution_rate(w, b, x->slot[i], before[0], now[0]);
        x->problem.contact[i].bias[1] = slip_rate(w, b, x->slot[i], before[0], before[1], now[1]);
        if (b->share[x->slot[i]] == PM_OUT) x->problem.contact[i].prefers = PM_OPEN;
    }
}

/* ---- what it says ---- */
static void take_modes(pm_blow *b, const pm_contact_system *x)
{
    for (int i = 0; i < x->problem.n; i++) {
        const int slot = x->slot[i], mode = x->problem.mode[i];
        const int struck = b->share[slot] == PM_STRUCK || b->share[slot] == PM_DROPPED;
        b->share[slot] = mode == PM_OPEN ? (struck ? PM_DROPPED : PM_OUT) : struck ? PM_STRUCK : PM_JOINED;
        if (mode != PM_OPEN) b->trial[slot] = mode;
    }
}

/* The blow in these modes.  A contact that carries all of it is followed as one that is struck alone, if nothing else
 * approaches then. */
static int solve_modes(pm_workspace *w, pm_blow *b)
{
    b->equations = 0;
    int status = pm_impact_trial_solve(w, b);
    if (status || b->alone == PM_NONE || pm_impact_trial_is_whole(w, b)) return status;
    b->equations = 1;
    return pm_impact_trial_solve(w, b);
}

/* Where contacts depend on each other their impulses are not unique: those of the problem obey the laws one by one, those of
 * the trial only together. */
static void record(pm_workspace *w, const pm_blow *b)
{
    const pm_contact_system *x = &b->system;
    pm_impact_end_record(w);
    for (int i = 0; i < x->problem.n && w->active.nredundant > 0 && !pm_shared_are_told(w); i++)
        memcpy(w->impulses.slot + 2 * x->slot[i], x->problem.load + 2 * i, 2 * sizeof(double));
}

/* No blow obeys the laws, or several do. */
int pm_impact_fail(pm_workspace *w, const pm_contact_system *x, int n, int at)
{
    int status = n == 0 ? PM_BLOW_UNDECIDED : PM_NOT_UNIQUE;
    for (int k = 0; k < x->problem.n && n == 0; k++)
        if (x->problem.contact[k].friction == PM_FRICTION_ROUGH) {
            status = PM_ROUGH_IMPOSSIBLE;
            at = k;
        }
    return pm_fail(&w->result, status, PM_TABLE_CONTACT, pm_contact_of_slot(w->model, x->slot[at]),
                   x->problem.contact[at].rub, x->problem.n);
}

/* One blow of what is listed, with or without restitution, solved as a trial. */
static int solve(pm_workspace *w, pm_blow *b, int plastic)
{
    pm_contact_system *x = &b->system;
    b->plastic = plastic;
    memset(b->given, 0, (size_t)w->model->nslot * sizeof *b->given);
    int status = pm_impact_list(w, b);
    if (status) return status;
    if (pm_impact_is_followed(w->model, x)) return pm_impact_follow_several(w, b);
    pm_impact_pose(w, b);
    const int n = pm_contact_problem_solve(&x->problem);
    if (n != 1) return pm_impact_fail(w, x, n, n == 0 ? 0 : x->problem.differs);
    take_modes(b, x);
    status = solve_modes(w, b);
    if (!status) record(w, b);
    return status;
}

/* ---- energy ---- */
/* What the contacts give with the impulses p[2 nslot] and the velocities after a blow: sum P (u + u')/2. */
static double given(const pm_workspace *w, const pm_contact_system *x, const double *p, const double *after)
{
    double sum = 0;
    for (int i = 0; i < 2 * x->problem.n; i++) {
        const pm_constraint *c = i % 2 == 0 ? &x->normal[i / 2] : &x->tangent[i / 2];
        sum += p[2 * x->slot[i / 2] + i % 2] * 0.5 *
               (pm_constraint_times(&w->frame, c, w->state.v) + pm_constraint_times(&w->frame, c, after) -
                2 * c->rate);
    }
    return sum;
}

/* The largest k <= 1 with which the blow between the plastic one (0) and the elastic one (1) gains nothing: the energy is
 * c + b k + a k^2, a >= 0. */
static double share_of(const pm_workspace *w, const pm_blow *b)
{
    const pm_contact_system *x = &b->system;
    const double *p = w->impulses.slot, *q = b->elastic.slot;
    const double none = given(w, x, p, b->after), all = given(w, x, q, b->elastic.after);
    const double a = none + all - given(w, x, p, b->elastic.after) - given(w, x, q, b->after);
    const double slope = all - none - a;
    if (!(all > 0)) return 1;
    if (!(none < 0)) return 0;
    const double root = sqrt(fmax(0, slope * slope - 4 * a * none));
    return slope > 0 ? -2 * none / (slope + root) : (root - slope) / (2 * a);
}

static void mix(size_t n, double share, const double *all, double *x)
{
    for (size_t i = 0; i < n; i++) x[i] = share * all[i] + (1 - share) * x[i];
}

/* The blow with impulses and velocities in between, as one whose ends are given. */
static int solve_between(pm_workspace *w, pm_blow *b, double k, int *independent)
{
    const pm_model *m = w->model;
    const pm_contact_system *x = &b->system;
    mix(m->nq, k, b->elastic.after, b->after);
    mix(2 * (size_t)m->nslot, k, b->elastic.slot, w->impulses.slot);
    memset(b->given, 0, (size_t)m->nslot * sizeof *b->given);
    for (int i = 0; i < x->problem.n; i++) {
        const int slot = x->slot[i];
        const double *p = w->impulses.slot + 2 * slot;
        const int pushes = p[0] > 0, struck = b->share[slot] == PM_STRUCK || b->share[slot] == PM_DROPPED;
        if (pushes)
            b->given[slot] =
                (pm_impact_given){1, pm_constraint_times(&w->frame, &x->normal[i], b->after), p[1] / p[0], 0};
        b->share[slot] = struck ? (pushes ? PM_STRUCK : PM_DROPPED) : pushes ? PM_JOINED : PM_OUT;
    }
    return pm_impact_trial_solve_given(w, b, independent);
}

int pm_impact_limit(pm_workspace *w, pm_blow *b)
{
    const pm_model *m = w->model;
    int independent;
    memcpy(b->elastic.after, b->after, (size_t)m->nq * sizeof(double));
    memcpy(b->elastic.slot, w->impulses.slot, 2 * (size_t)m->nslot * sizeof(double));
    w->result.count[PM_COUNT_LIMITED_BLOWS]++;
    int status = solve(w, b, 1);
    if (status) return status;
    status = solve_between(w, b, share_of(w, b), &independent);
    if (status) return status;
    if (!independent) return solve(w, b, 1); /* nothing tells how they share: the blow without restitution */
    pm_impact_end_record(w);
    return PM_OK;
}

int pm_impact_together(pm_workspace *w, pm_blow *b)
{
    b->several = !b->ends_bounce;
    return solve(w, b, 0);
}
