/* contact_modes.c - complementarity at the level of accelerations: a closed contact pushes (lambda_n >= 0) or opens; friction by
 * Coulomb holds within mu lambda_n or slides against the slip; a rough contact never slips, a smooth one has no friction.
 * The present modes stand if they do so (contact_modes_settle.c); else all of them are found as one problem
 * (contact_modes_solve.c). */
#include "impact/contact_modes.h"

#include <math.h>
#include <string.h>

#include "elements/capture.h"
#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/contact_curve.h"
#include "elements/edge.h"
#include "elements/joint_friction.h"
#include "elements/teeth.h"
#include "elements/trigger.h"
#include "equations/active_set.h"
#include "equations/shared_loads.h"
#include "events/event.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

int pm_contact_modes_of_slip(const pm_frame *frame, int contact, int member)
{
    if (pm_capture_kind(frame->model, contact) != PM_CAPTURE_NONE) return PM_CAPTURED;
    switch (pm_contact_friction(frame->model, contact)) {
    case PM_FRICTION_SMOOTH: return PM_SMOOTH;
    case PM_FRICTION_ROUGH: return PM_STICK;
    default: {
        if (pm_contact_static(frame, contact) == 0 && pm_contact_kinetic(frame, contact) == 0)
            return PM_SMOOTH;
        const double slip = pm_contact_member_slip(frame, contact, member);
        if (fabs(slip) <= pm_contact_speed(frame)) return PM_STICK;
        return slip > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
    }
    }
}

int pm_contact_modes_close(pm_workspace *w, int contact, int member, int *slot)
{
    *slot = pm_contact_free_slot(&w->frame, &w->state, contact);
    if (*slot == PM_NONE)
        return pm_fail(&w->result, PM_CONTACT_SLOTS, PM_TABLE_CONTACT, contact, PM_PATTERN_SLOTS,
                       PM_PATTERN_SLOTS);
    w->state.slot[*slot] = (pm_slot){pm_contact_modes_of_slip(&w->frame, contact, member), member};
    pm_active_set_anchor(&w->frame, &w->state, *slot);
    return PM_OK;
}

int pm_contact_modes_slides(int mode) { return mode == PM_SLIDE_FORWARD || mode == PM_SLIDE_BACKWARD; }

/* The constraints of the member in a slot; what is open has them, too. */
static void constraints_of(const pm_frame *frame, const pm_state *state, int slot, pm_constraint *normal,
                           pm_constraint *tangent)
{
    pm_contact_constraint_both(frame, pm_contact_of_slot(frame->model, slot), slot, state->slot[slot].member,
                               normal, tangent);
}

pm_constraint pm_contact_modes_normal(const pm_frame *frame, const pm_state *state, int slot)
{
    pm_constraint normal, tangent;
    constraints_of(frame, state, slot, &normal, &tangent);
    pm_constraint_kind(normal.kind)->evaluate(frame, &normal);
    return normal;
}

pm_constraint pm_contact_modes_tangent(const pm_frame *frame, const pm_state *state, int slot)
{
    pm_constraint normal, tangent;
    constraints_of(frame, state, slot, &normal, &tangent);
    pm_constraint_kind(tangent.kind)->evaluate(frame, &tangent);
    return tangent;
}

/* The way a contact begins to slide: against the friction that would have held it. */
static int slide_against(double friction) { return friction > 0 ? PM_SLIDE_BACKWARD : PM_SLIDE_FORWARD; }

/* Of contacts that share their loads those give way that bound what they can carry. */
static int gives_way(pm_workspace *w, int slot, int how)
{
    const int bound = pm_shared_bound_of(w, slot);
    double slack;
    return !pm_shared_slack(w, slot, &slack) || ((bound & how) && !(bound & ~how & PM_BOUND_NORMAL));
}

static int slide_of(pm_workspace *w, int slot)
{
    const int bound = pm_shared_bound_of(w, slot);
    return slide_against(bound ? (bound & PM_BOUND_FORWARD) - (bound & PM_BOUND_BACKWARD)
                               : w->frame.lambda[w->active.slot_tangent[slot]]);
}

/* The slip goes on, or what holds holds on, where a circle comes to the face of the next edge: no blow, though friction may
 * be another there. */
static int hand_over(pm_workspace *w, int mode, int heir)
{
    const int slot = w->model->contact_slot[heir];
    int closed;
    if (w->state.slot[slot].mode != PM_OPEN) return PM_OK;
    const int status = pm_contact_modes_close(w, heir, PM_SEGMENT_FACE, &closed);
    if (!status && mode == PM_STICK && pm_contact_modes_slides(w->state.slot[closed].mode))
        w->state.slot[closed].mode = PM_STICK;
    return status;
}

static int next_member(const pm_workspace *w, int slot, int member, int *heir)
{
    const int contact = pm_contact_of_slot(w->model, slot);
    *heir = PM_NONE;
    return pm_contact_curve_is(w->model, contact) ? pm_contact_curve_next(&w->frame, slot, member)
                                                  : pm_edge_next(&w->frame, &w->state, contact, member, heir);
}

static int way_of(const pm_model *m, int contact, int member)
{
    return pm_edge_way(m, contact, member) * pm_contact_curve_way(m, contact, member);
}

/* A mark has come to the end of what it touches: a circle goes on round the corner, or back, with the same slip - the
 * tangents there run against each other -, or on to the next edge. */
int pm_contact_modes_pass_end(pm_workspace *w, int slot)
{
    pm_slot *s = &w->state.slot[slot];
    int heir;
    /* Between two pieces of a curve nothing changes but the piece (switches.c). */
    if (pm_contact_curve_is_at_knot(&w->frame, slot, s->member)) return PM_OK;
    const int next = next_member(w, slot, s->member, &heir);
    if (next == PM_NONE) {
        const int mode = s->mode;
        s->mode = PM_OPEN;
        w->instant.slot_released[slot] = PM_FOR_GOOD;
        return heir == PM_NONE ? PM_OK : hand_over(w, mode, heir);
    }
    const int contact = pm_contact_of_slot(w->model, slot),
              turns = way_of(w->model, contact, s->member) != way_of(w->model, contact, next);
    s->member = next;
    if (turns && pm_contact_modes_slides(s->mode))
        s->mode = s->mode == PM_SLIDE_FORWARD ? PM_SLIDE_BACKWARD : PM_SLIDE_FORWARD;
    pm_active_set_anchor(&w->frame, &w->state, slot);
    return PM_OK;
}

int pm_contact_modes_begin(pm_workspace *w)
{
    const pm_model *m = w->model;
    memcpy(w->instant.slot_before, w->state.slot, (size_t)m->nslot * sizeof(pm_slot));
    memcpy(w->instant.friction_before, w->state.friction, (size_t)m->nfriction * sizeof(int32_t));
    memset(w->instant.slot_released, 0, (size_t)m->nslot);
    for (int i = 0; i < w->event->nfunction; i++) {
        if (!w->event->hit[i]) continue;
        if (w->event->function[i].kind == FUNCTION_END) {
            const int status = pm_contact_modes_pass_end(w, w->event->function[i].index);
            if (status) return status;
        }
        if (w->event->function[i].kind == FUNCTION_FLANK) pm_teeth_turn(w, w->event->function[i].index);
        if (w->event->function[i].kind == FUNCTION_JOINT_STICK)
            pm_joint_friction_slides(w, w->event->function[i].index);
        if (w->event->function[i].kind == FUNCTION_JOINT_SLIP)
            pm_joint_friction_stops(&w->frame, &w->state, w->event->function[i].index);
        const int what = pm_event_contact_change(w->event, i), slot = w->event->function[i].index;
        if (what == PM_TRIGGER_OPEN && gives_way(w, slot, PM_BOUND_NORMAL)) {
            w->state.slot[slot].mode = PM_OPEN;
            w->instant.slot_released[slot] = PM_LET_GO;
        } else if (what == PM_TRIGGER_SLIP && gives_way(w, slot, PM_BOUND_FORWARD | PM_BOUND_BACKWARD)) {
            w->state.slot[slot].mode = slide_of(w, slot);
        } else if (what == PM_TRIGGER_STICK) {
            w->state.slot[slot].mode = PM_STICK;
            pm_active_set_anchor(&w->frame, &w->state, slot);
        }
    }
    return PM_OK;
}

/* A foot on a curve goes on from member to member. */
static int is_same(const pm_model *model, int contact, int a, int b)
{
    return a == b || pm_contact_curve_is_same(model, contact, a, b);
}

int pm_contact_modes_released(const pm_model *model, const pm_instant *instant, int contact, int member)
{
    const int first = model->contact_slot[contact];
    for (int i = first; i < first + pm_contact_slots(model, contact); i++)
        if (instant->slot_released[i] && is_same(model, contact, instant->slot_before[i].member, member))
            return 1;
    return 0;
}

/* Forces that contacts share are judged together (shared_stand). */
static int is_shared(pm_workspace *w, const double *load, int slot)
{
    double slack;
    return load == w->frame.lambda && pm_shared_slack(w, slot, &slack);
}

int pm_contact_modes_pulling(pm_workspace *w, const double *load, int site, double size)
{
    int worst = PM_NONE;
    double least = -PM_PULLS * size;
    for (int i = 0; i < w->model->nslot; i++) {
        const int normal = w->active.slot_normal[i];
        if (normal < 0 || is_shared(w, load, i)) continue;
        pm_evidence_sign(&w->evidence, site, i, load[normal], size);
        if (load[normal] >= least) continue;
        if (site == PM_SITE_PULLS_IN_BLOW && w->event->spent[pm_contact_of_slot(w->model, i)]) continue;
        least = load[normal];
        worst = i;
    }
    return worst;
}

int pm_contact_modes_overcome(pm_workspace *w, const double *load, int site, double size)
{
    for (int i = 0; i < w->model->nslot; i++) {
        const int contact = pm_contact_of_slot(w->model, i);
        if (w->active.slot_tangent[i] < 0 || w->active.slot_normal[i] < 0 || is_shared(w, load, i)) continue;
        if (pm_contact_friction(w->model, contact) != PM_FRICTION_COULOMB) continue;
        const double room = pm_contact_static(&w->frame, contact) * load[w->active.slot_normal[i]] -
                            fabs(load[w->active.slot_tangent[i]]);
        if (pm_contact_friction_jumps(&w->frame, contact))
            pm_evidence_sign(&w->evidence, site, i, room, size);
        if (!(room >= -PM_PULLS * size)) return i;
    }
    return PM_NONE;
}

static int was_closed_with(const pm_model *model, const pm_slot *slots, int contact, int member)
{
    const int first = model->contact_slot[contact];
    for (int i = first; i < first + pm_contact_slots(model, contact); i++)
        if (slots[i].mode != PM_OPEN &&
            (is_same(model, contact, slots[i].member, member) || pm_edge_is(model, contact)))
            return i;
    return PM_NONE;
}

/* What a joint does at the start is no change, as with contacts. */
static void mark_friction(pm_workspace *w)
{
    for (int k = 0; k < w->model->nfriction && w->result.count[PM_COUNT_EVENTS] > 0; k++) {
        const int before = w->instant.friction_before[k], now = w->state.friction[k],
                  joint = pm_joint_friction_joint(w->model, k);
        if (before == PM_STICK && pm_contact_modes_slides(now))
            pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_JOINT_SLIP, joint);
        if (pm_contact_modes_slides(before) && now == PM_STICK)
            pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_JOINT_STICK, joint);
    }
}

void pm_contact_modes_mark(pm_workspace *w)
{
    mark_friction(w);
    for (int i = 0; i < w->model->nslot; i++) {
        const int contact = pm_contact_of_slot(w->model, i);
        if (w->instant.slot_before[i].mode == PM_OPEN) continue;
        const int now = was_closed_with(w->model, w->state.slot, contact, w->instant.slot_before[i].member);
        if (now == PM_NONE)
            pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_OPEN, contact);
        else if (pm_contact_modes_slides(w->state.slot[now].mode) &&
                 !pm_contact_modes_slides(w->instant.slot_before[i].mode))
            pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_SLIP, contact);
        else if (!pm_contact_modes_slides(w->state.slot[now].mode) &&
                 pm_contact_modes_slides(w->instant.slot_before[i].mode))
            pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_STICK, contact);
    }
}
