/* impact_trial.c - the blow of given contacts in given modes, and what its impulses forbid of these.
 *
 *   G v' = -e (G v) at struck normals, w at joints and at tangents that hold                           (17.19)
 *
 * w is what a drive prescribes, 0 elsewhere.  A tangent with a restitution of its own is left with -e_t times its slip
 * where it can be held; only while its normal rebounds: what stays in contact holds.  One contact alone with friction is
 * followed through its blow (impact_course.c).
 *
 * A contact whose impulse would pull drops out, one that needs |P_t| > mu P_n slides, a resting one whose pair would
 * approach joins: one of these at a time. */
#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "equations/active_set.h"
#include "equations/saddle.h"
#include "events/last_bounce.h"
#include "impact/contact_modes.h"
#include "impact/impact.h"
#include "impact/impact_parts.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

/* Constraints of this trial: modes of the contacts that take part; the others are open for the blow. */
static int build(pm_workspace *w, const pm_blow *b)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->nslot; i++) w->state.slot[i].mode = pm_blow_has(b, i) ? b->trial[i] : PM_OPEN;
    pm_frame_look_state(&w->frame, &w->state);
    const int status = pm_active_set_build(w);
    if (!status && !w->active.evaluated) pm_saddle_evaluate(&w->active, &w->frame);
    return status;
}

double pm_impact_trial_rate(const pm_workspace *w, int i)
{
    return pm_constraint_times(&w->frame, &w->active.constraint[i], w->state.v) -
           w->active.constraint[i].rate;
}

static int is_normal(const pm_active_set *active, int i)
{
    return active->constraint[i].slot != PM_NONE && active->slot_normal[active->constraint[i].slot] == i;
}

/* How much the rate of active constraint i is to change. */
static double change_wanted(const pm_workspace *w, const pm_blow *b, int i)
{
    const int slot = w->active.constraint[i].slot;
    const double u = pm_impact_trial_rate(w, i);
    if (slot == PM_NONE || b->share[slot] != PM_STRUCK || w->active.slot_normal[slot] == PM_NONE) return -u;
    const double e = pm_last_bounce_restitution(w, pm_contact_of_slot(w->model, slot),
                                                pm_impact_trial_rate(w, w->active.slot_normal[slot]));
    if (is_normal(&w->active, i)) return -(1 + e) * u;
    return e > 0 ? -(1 + pm_contact_tangential(&w->frame, pm_contact_of_slot(w->model, slot))) * u : -u;
}

/* Impulses and the velocities after the blow. */
static int respond(pm_workspace *w, pm_blow *b)
{
    const int nq = w->model->nq;
    memcpy(b->after, w->state.v, (size_t)nq * sizeof *b->after);
    if (w->active.n == 0) return PM_OK;
    for (int i = 0; i < w->active.n; i++)
        w->saddle.wanted[i] = b->alone != PM_NONE && is_normal(&w->active, i)
                                  ? b->end.normal - pm_impact_trial_rate(w, i)
                                  : change_wanted(w, b, i);
    int status = pm_saddle_factor(w);
    if (status || (status = pm_saddle_respond(w, NULL, b->after))) return status;
    for (int i = 0; i < nq; i++) b->after[i] += w->state.v[i];
    return PM_OK;
}

/* The slot that takes part alone and whose blow is to be followed; a law for one contact is refused where several take
 * part.  Pairs that were captured before are joints. */
static int find_alone(const pm_model *model, pm_result *result, pm_blow *b)
{
    int n = 0, single = PM_NONE;
    b->alone = PM_NONE;
    for (int i = 0; i < model->nslot; i++) {
        if (!pm_blow_has(b, i) || (b->share[i] == PM_JOINED && b->trial[i] == PM_CAPTURED)) continue;
        const int contact = pm_contact_of_slot(model, i);
        if (pm_contact_law(model, contact) != PM_LAW_NEWTON) single = contact;
        if (pm_impact_course_applies(model, i)) b->alone = i;
        n++;
    }
    if (n == 1) return PM_OK;
    b->alone = PM_NONE;
    return single == PM_NONE ? PM_OK : pm_fail(result, PM_BLOW_SEVERAL, PM_TABLE_CONTACT, single, n, 1);
}

/* Follows the blow of one contact and leaves its constraints as build does. */
static int follow_alone(pm_workspace *w, pm_blow *b)
{
    const int slot = b->alone, contact = pm_contact_of_slot(w->model, slot);
    const unsigned char part = b->share[slot];
    pm_impact_course x;
    b->share[slot] = PM_OUT;
    int status = build(w, b);
    if (!status) status = pm_impact_course_read(w, slot, b->response, &x);
    b->share[slot] = part;
    if (status) return status;
    x.restitution = part == PM_STRUCK ? pm_last_bounce_restitution(w, contact, x.normal)
                                      : 0; /* what rests is pressed on */
    const int ends = pm_impact_course_follow(&x, &b->end);
    pm_evidence_sign(&w->evidence, PM_SITE_SLIP_LEFT, slot, b->end.slip, w->numbers.speed);
    if (!ends) return pm_fail(&w->result, PM_BLOW_UNDECIDED, PM_TABLE_CONTACT, contact, x.normal, 0);
    w->state.slot[slot].mode = PM_SLIDE_FORWARD;
    if ((status = pm_active_set_build(w))) return status;
    if (w->active.slot_normal[slot] == PM_NONE)
        return pm_fail(&w->result, PM_SINGULAR, PM_TABLE_CONTACT, contact, 0, 0);
    pm_active_set_carry(w, slot, b->end.ratio);
    pm_saddle_evaluate(&w->active, &w->frame);
    return PM_OK;
}

int pm_impact_trial_solve(pm_workspace *w, pm_blow *b)
{
    int status = find_alone(w->model, &w->result, b);
    if (!status) status = b->alone != PM_NONE ? follow_alone(w, b) : build(w, b);
    return status ? status : respond(w, b);
}

/* ---- what the impulses forbid ---- */
static int drop_pulling(pm_workspace *w, pm_blow *b, double size)
{
    const int slot = pm_contact_modes_pulling(w, w->saddle.rhs, PM_SITE_PULLS_IN_BLOW, size);
    if (slot != PM_NONE) b->share[slot] = PM_DROPPED;
    return slot != PM_NONE;
}

static int slide_where_it_must(pm_workspace *w, pm_blow *b, double size)
{
    const int i = pm_contact_modes_overcome(w, w->saddle.rhs, PM_SITE_SLIDES_IN_BLOW, size);
    if (i == PM_NONE) return 0;
    const double slip =
        pm_contact_member_slip(&w->frame, pm_contact_of_slot(w->model, i), w->state.slot[i].member);
    const int slips = fabs(slip) > pm_contact_speed(&w->frame);
    const int forward = slips ? slip > 0 : w->saddle.rhs[w->active.slot_tangent[i]] < 0;
    b->trial[i] = forward ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
    return 1;
}

int32_t pm_impact_trial_mode(const pm_model *m, int slot)
{
    return pm_contact_friction(m, pm_contact_of_slot(m, slot)) == PM_FRICTION_SMOOTH ? PM_SMOOTH : PM_STICK;
}

/* A resting contact whose pair would approach joins. */
static int join_approaching(pm_workspace *w, pm_blow *b)
{
    for (int i = 0; i < w->model->nslot; i++) {
        if (b->share[i] != PM_OUT || b->resting[i] == PM_OPEN) continue;
        const pm_constraint normal = pm_contact_modes_normal(&w->frame, &w->state, i);
        const double rate = pm_constraint_times(&w->frame, &normal, b->after);
        pm_evidence_sign(&w->evidence, PM_SITE_JOINS, i, rate, w->numbers.speed);
        if (rate >= -pm_contact_speed(&w->frame)) continue;
        b->share[i] = PM_JOINED;
        b->trial[i] = pm_impact_trial_mode(w->model, i);
        return 1;
    }
    return 0;
}

int pm_impact_trial_change(pm_workspace *w, pm_blow *b)
{
    double size = 0;
    for (int i = 0; i < w->active.n; i++) size = fmax(size, fabs(w->saddle.rhs[i]));
    return drop_pulling(w, b, size) || slide_where_it_must(w, b, size) ||
           (!pm_impact_one_by_one(w->model) && join_approaching(w, b));
}
