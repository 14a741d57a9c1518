/* impact_end.c - what a blow leaves: whether the laws allow it, its impulses, the modes after it. */
#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "elements/trigger.h"
#include "equations/active_set.h"
#include "equations/shared_reading.h"
#include "events/blows_left.h"
#include "events/bounce_series.h"
#include "events/event.h"
#include "events/last_bounce.h"
#include "impact/contact_modes.h"
#include "impact/impact_parts.h"
#include "numerics/tolerances_impact.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

/* ---- energy ---- */
/* Friction and restitution together may ask for more than the approach has.  The energy that contacts give:
 * sum P (u + u')/2 relative to what drives prescribe. */
double pm_impact_end_gains(pm_workspace *w, const pm_blow *b)
{
    double given = 0, size = 0, nothing = 0;
    for (int i = 0; i < w->active.n || w->active.constraint[i].normal != PM_NONE; i++) {
        const pm_constraint *c = &w->active.constraint[i];
        if (c->slot == PM_NONE || w->active.slot_normal[c->slot] < 0) continue; /* captured: a joint */
        const double p = i < w->active.n ? w->saddle.rhs[i]
                                         : w->active.constraint[c->normal].slide * w->saddle.rhs[c->normal];
        const double before = pm_impact_trial_rate(w, i),
                     now = pm_constraint_times(&w->frame, c, b->after) - c->rate;
        given += 0.5 * p * (before + now);
        size += fabs(p * before) + fabs(p * now);
        nothing += PM_BLOW_NOTHING * fabs(p) * w->numbers.speed;
    }
    return given <= PM_BLOW_ROUNDING * size + nothing ? 0 : given;
}

/* ---- impulses ---- */
/* Of a captured pair, along the axes of the scene. */
static void record_captured(pm_workspace *w, int slot)
{
    static const double axes[4] = {1, 0, 0, 1};
    memcpy(w->impulses.slot_direction + 4 * slot, axes, sizeof axes);
    for (int k = 0; k < 2; k++) {
        const int active = w->active.slot_held[PM_JOINT_CONSTRAINTS * slot + k];
        if (active >= 0) w->impulses.slot[2 * slot + k] = w->saddle.rhs[active];
    }
}

/* The tangential constraint of a slot, evaluated: the active one, or else *spare. */
static const pm_constraint *tangent_of(const pm_workspace *w, int slot, pm_constraint *spare)
{
    if (w->active.slot_tangent[slot] >= 0) return &w->active.constraint[w->active.slot_tangent[slot]];
    *spare = pm_contact_modes_tangent(&w->frame, &w->state, slot);
    return spare;
}

void pm_impact_end_record_contact(pm_workspace *w, int slot, const pm_constraint *normal,
                                  const pm_constraint *tangent, const double impulse[2])
{
    const pm_constraint *c[] = {normal, tangent};
    memcpy(w->impulses.slot + 2 * slot, impulse, 2 * sizeof *impulse);
    if (!w->model->programs.read_impulses) return;
    const double side = pm_contact_constraint_side(&w->frame, pm_contact_of_slot(w->model, slot), normal);
    for (int k = 0; k < 2; k++) {
        pm_line_of_action along;
        pm_constraint_kind(c[k]->kind)->act(&w->frame, c[k], &along);
        for (int i = 0; i < 2; i++)
            w->impulses.slot_direction[4 * slot + 2 * k + i] = side * along.direction[i];
    }
}

/* A redundant one carries nothing: another one does. */
static void record_contact(pm_workspace *w, int slot)
{
    const int at = w->active.slot_normal[slot], along = w->active.slot_tangent[slot];
    if (at == PM_NONE) return;
    pm_constraint spare;
    const pm_constraint *normal =
        at >= 0 ? &w->active.constraint[at] : &w->active.redundant[PM_REDUNDANT_PLACE(at)];
    const double p = at >= 0 ? w->saddle.rhs[at] : 0;
    const double impulse[] = {p, along >= 0         ? w->saddle.rhs[along]
                                 : along == PM_NONE ? normal->slide * p
                                                    : 0};
    const pm_constraint *tangent = w->model->programs.read_impulses ? tangent_of(w, slot, &spare) : normal;
    pm_impact_end_record_contact(w, slot, normal, tangent, impulse);
}

void pm_impact_end_record(pm_workspace *w)
{
    const pm_model *m = w->model;
    memset(w->impulses.joint, 0, (size_t)m->njoint_constraint * sizeof(double));
    memset(w->impulses.friction, 0, (size_t)m->nfriction * sizeof(double));
    memset(w->impulses.slot, 0, 2 * (size_t)m->nslot * sizeof(double));
    for (int i = 0; i < m->njoint_constraint; i++)
        if (w->active.of_joint[i] >= 0) w->impulses.joint[i] = w->saddle.rhs[w->active.of_joint[i]];
    for (int i = 0; i < m->nslot; i++) {
        if (w->state.slot[i].mode == PM_CAPTURED) record_captured(w, i);
        record_contact(w, i);
    }
    pm_shared_note_impulses(w);
}

static int slid(const pm_workspace *w, int slot, const double *v)
{
    pm_constraint spare;
    const pm_constraint *tangent = tangent_of(w, slot, &spare);
    return fabs(pm_constraint_times(&w->frame, tangent, v) - tangent->rate) > pm_contact_speed(&w->frame);
}

/* ---- modes ---- */
/* Where a series of blows has ended the passes go on alike only if all contacts stand alike. */
static void tell_modes(pm_workspace *w)
{
    if (!w->evidence.active) return;
    for (int i = 0; i < w->model->nslot; i++)
        pm_evidence_mix(&w->evidence.present->log, (uint32_t)w->state.slot[i].mode);
}

/* Nothing else is to be found of what has one member, and parts, and whose bounce is not over. */
static void note_parting(const pm_workspace *w, pm_blow *b, int contact, double rate)
{
    if (pm_contact_is_single(w->model, contact) && !w->evidence.active &&
        !pm_last_bounce_is_spent(w, contact, rate))
        b->apart[contact] = PM_PARTED;
}

/* What was closed, and the blow presses beyond rounding, does not bounce any more. */
static void press(const pm_workspace *w, const pm_blow *b)
{
    double most = 0;
    for (int i = 0; i < w->model->nslot; i++) most = fmax(most, w->impulses.slot[2 * i]);
    for (int i = 0; i < w->model->nslot; i++)
        if (b->share[i] == PM_JOINED && w->impulses.slot[2 * i] > PM_BLOW_ROUNDING * most)
            pm_bounce_series_press(w, pm_contact_of_slot(w->model, i));
}

/* Modes after the blow: what parts is open; what stays is closed with the friction its slip asks for.  A struck contact
 * that slid and stays without slip sticks from the blow on. */
void pm_impact_end_modes(pm_workspace *w, pm_blow *b)
{
    int series_ends = 0;
    press(w, b);
    for (int i = 0; i < w->model->nslot; i++) {
        const int contact = pm_contact_of_slot(w->model, i), member = w->state.slot[i].member;
        double rate;
        if (w->state.slot[i].mode == PM_CAPTURED) continue;
        w->state.slot[i].mode = PM_OPEN;
        if (b->share[i] == PM_OUT && b->resting[i] == PM_OPEN) continue;
        pm_contact_member_gap(&w->frame, contact, member, &rate);
        if (rate > pm_contact_speed(&w->frame)) note_parting(w, b, contact, rate);
        if (fabs(rate) > pm_contact_speed(&w->frame))
            continue; /* parts, or is struck again by the next blow */
        w->state.slot[i].mode = pm_contact_modes_of_slip(&w->frame, contact, member);
        if (b->given[i].sticks && pm_contact_modes_slides(w->state.slot[i].mode))
            w->state.slot[i].mode = PM_STICK;
        const int closed_here =
            b->share[i] == PM_STRUCK && w->state.slot[i].mode != PM_CAPTURED; /* anchored then */
        if (!closed_here && (b->share[i] != PM_OUT || w->state.slot[i].mode != b->resting[i]))
            pm_active_set_anchor(&w->frame, &w->state, i);
        if (b->held[i] || (b->share[i] == PM_STRUCK && pm_contact_restitution(&w->frame, contact) > 0)) {
            pm_blows_left_hold(w, contact, b->before);
            pm_evidence_part(&w->evidence, contact);
            pm_evidence_cut(&w->evidence);
            pm_bounce_series_hold(w, contact);
            series_ends = 1;
        }
        if (b->share[i] == PM_STRUCK && w->state.slot[i].mode == PM_STICK && slid(w, i, b->before))
            pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_STICK, contact);
    }
    if (series_ends) tell_modes(w);
    b->series_ends |= series_ends;
}
