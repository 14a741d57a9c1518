/* impact_trial.c - the blow of given contacts in given modes.
 *
 *   G v' = -e (G v) at struck normals, w at joints and at tangents that hold                           (17.19)
 *
 * w is what a drive prescribes, 0 elsewhere.  A tangent with a restitution of its own is left with -e_t times its slip
 * where it can be held; only while its normal rebounds: what stays in contact holds.  One contact alone with friction is
 * followed through its blow (impact_course.c). */
#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "equations/active_set.h"
#include "equations/saddle.h"
#include "events/last_bounce.h"
#include "impact/contact_modes.h"
#include "impact/impact_parts.h"
#include "numerics/minmax.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

/* The mode in which a contact stands in the equations: one whose end is given carries its tangent by a ratio (build_given). */
static int32_t mode_in(const pm_blow *b, int slot)
{
    if (!pm_blow_has(b, slot)) return PM_OPEN;
    return b->given[slot].is ? PM_SLIDE_FORWARD : b->trial[slot];
}

/* Constraints of this trial: modes of the contacts that take part; the others are open for the blow. */
static int build(pm_workspace *w, const pm_blow *b)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->nslot; i++) w->state.slot[i].mode = mode_in(b, i);
    pm_frame_look_state(&w->frame, &w->state);
    const int status = pm_active_set_build(w);
    if (!status && !w->active.evaluated) pm_saddle_evaluate(&w->active, &w->frame);
    return status;
}

/* Where corners meet, constraints of contacts may depend on each other at this place, though not next to it.  Nothing moves
 * during the blow, so those that add nothing to the others hold whenever the others do. */
static int build_independent(pm_workspace *w, const pm_blow *b)
{
    const int status = build(w, b);
    if (!status && !w->active.clear && pm_active_set_let_loose(w) > 0)
        pm_saddle_evaluate(&w->active, &w->frame);
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
    if (slot != PM_NONE && b->given[slot].is) return b->given[slot].normal - u;
    if (slot == PM_NONE || b->plastic || b->held[slot] || b->share[slot] != PM_STRUCK ||
        w->active.slot_normal[slot] < 0)
        return -u;
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
    for (int i = 0; i < w->active.n; i++) w->saddle.wanted[i] = change_wanted(w, b, i);
    int status = pm_saddle_factor(w);
    if (status || (status = pm_saddle_respond(w, NULL, b->after))) return status;
    if (w->active.n > 1 && !w->saddle.light.is_used) pm_saddle_correct(w, b->after);
    for (int i = 0; i < nq; i++) b->after[i] += w->state.v[i];
    return PM_OK;
}

static int takes_part(const pm_blow *b, int slot)
{
    return pm_blow_has(b, slot) && !(b->share[slot] == PM_JOINED && b->trial[slot] == PM_CAPTURED);
}

int pm_impact_trial_contacts(const pm_model *m, const pm_blow *b)
{
    int n = 0;
    for (int i = 0; i < m->nslot; i++) n += takes_part(b, i);
    return n;
}

/* The slot that takes part alone and whose blow is to be followed, or PM_NONE.  Pairs that were captured before are joints. */
static int find_alone(const pm_model *model, const pm_blow *b)
{
    int alone = PM_NONE;
    for (int i = 0; i < model->nslot; i++)
        if (takes_part(b, i) && pm_impact_course_applies(model, i)) alone = i;
    return pm_impact_trial_contacts(model, b) == 1 && !b->equations ? alone : PM_NONE;
}

/* The constraints of contacts whose end is given: each normal carries its tangent with the ratio of its impulses.  1: none of
 * these depends on the others. */
static int build_given(pm_workspace *w, pm_blow *b, int *independent)
{
    *independent = 1;
    const int status = build(w, b);
    if (status) return status;
    for (int i = 0; i < w->model->nslot; i++) {
        if (!b->given[i].is) continue;
        if (w->active.slot_normal[i] < 0)
            *independent = 0;
        else
            pm_active_set_carry(w, i, b->given[i].ratio);
    }
    pm_saddle_evaluate(&w->active, &w->frame);
    return PM_OK;
}

int pm_impact_trial_solve_given(pm_workspace *w, pm_blow *b, int *independent)
{
    const int status = build_given(w, b, independent);
    return status || !*independent ? status : respond(w, b);
}

/* Follows the blow of one contact: its end is given then, unless its bounce is over and rounding has left it a speed. */
static int follow_alone(pm_workspace *w, pm_blow *b)
{
    const int slot = b->alone, contact = pm_contact_of_slot(w->model, slot);
    const unsigned char part = b->share[slot];
    pm_impact_course x;
    pm_impact_course_end end = {0};
    b->share[slot] = PM_OUT;
    int status = build(w, b);
    if (!status) status = pm_impact_course_read(w, slot, b->response, &x);
    b->share[slot] = part;
    if (status) return status;
    if (!(x.normal < 0)) {
        b->alone = PM_NONE;
        return PM_OK;
    }
    x.restitution = part == PM_STRUCK && !b->plastic && !b->held[slot]
                        ? pm_last_bounce_restitution(w, contact, x.normal)
                        : 0; /* what rests is pressed on */
    const int ends = pm_impact_course_follow(&x, &end);
    if (pm_contact_friction_jumps(&w->frame, contact))
        pm_evidence_sign(&w->evidence, PM_SITE_SLIP_LEFT, slot, end.slip, w->numbers.speed);
    if (!ends) return pm_fail(&w->result, PM_BLOW_UNDECIDED, PM_TABLE_CONTACT, contact, x.normal, 0);
    b->given[slot] = (pm_impact_given){1, end.normal, end.ratio, end.slip == 0};
    return PM_OK;
}

int pm_impact_trial_solve(pm_workspace *w, pm_blow *b)
{
    int independent;
    memset(b->given, 0, (size_t)w->model->nslot * sizeof *b->given);
    int status = PM_OK;
    b->alone = find_alone(w->model, b);
    if (b->alone != PM_NONE && (status = follow_alone(w, b))) return status;
    if (b->alone == PM_NONE) return (status = build_independent(w, b)) ? status : respond(w, b);
    status = pm_impact_trial_solve_given(w, b, &independent);
    return status || independent ? status
                                 : pm_fail(&w->result, PM_SINGULAR, PM_TABLE_CONTACT,
                                           pm_contact_of_slot(w->model, b->alone), 0, 0);
}

int32_t pm_impact_trial_mode(const pm_frame *frame, int slot)
{
    const int contact = pm_contact_of_slot(frame->model, slot),
              friction = pm_contact_friction(frame->model, contact);
    const int rubs = friction == PM_FRICTION_ROUGH || pm_contact_static(frame, contact) > 0 ||
                     pm_contact_kinetic(frame, contact) > 0;
    return friction != PM_FRICTION_SMOOTH && rubs ? PM_STICK : PM_SMOOTH;
}

/* ---- one contact alone ---- */
int pm_impact_one_by_one(const pm_model *m)
{
    return PM_SETTING(m, PM_SETTING_SIMULTANEOUS) == PM_SIMULTANEOUS_ONE_BY_ONE;
}

/* A contact that does not take part, and whose pair would approach. */
static int one_approaches(pm_workspace *w, const pm_blow *b)
{
    for (int i = 0; i < w->model->nslot; i++) {
        const int waits = b->share[i] == PM_DROPPED || (b->share[i] == PM_OUT && b->resting[i] != PM_OPEN);
        if (!waits) continue;
        const pm_constraint normal = pm_contact_modes_normal(&w->frame, &w->state, i);
        const double rate = pm_constraint_times(&w->frame, &normal, b->after) - normal.rate;
        pm_evidence_sign(&w->evidence, PM_SITE_JOINS, i, rate, w->numbers.speed);
        if (rate < -pm_contact_speed(&w->frame)) return 1;
    }
    return 0;
}

int pm_impact_trial_is_whole(pm_workspace *w, const pm_blow *b)
{
    double size = 0;
    for (int i = 0; i < w->active.n; i++) size = pm_max(fabs(w->saddle.rhs[i]), size);
    return pm_contact_modes_pulling(w, w->saddle.rhs, PM_SITE_PULLS_IN_BLOW, size) == PM_NONE &&
           pm_contact_modes_overcome(w, w->saddle.rhs, PM_SITE_SLIDES_IN_BLOW, size) == PM_NONE &&
           (pm_impact_one_by_one(w->model) || !one_approaches(w, b));
}
