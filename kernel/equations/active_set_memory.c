/* active_set_memory.c - what constraints remember: where they are anchored, the feet of curves, the strands of cords. */
#include "elements/capture.h"
#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/contact_curve.h"
#include "elements/joint.h"
#include "equations/active_set.h"
#include "state/frame.h"
#include "state/workspace.h"

static void remember(const pm_frame *frame, pm_state *s, const pm_constraint *c, int anchor_too)
{
    const int at = c->memory != PM_NONE ? c->memory : c->foot;
    if (at == PM_NONE || !pm_constraint_kind(c->kind)->remember) return;
    pm_constraint_kind(c->kind)->remember(frame, c, &s->memory[at], anchor_too);
}

void pm_active_set_anchor(const pm_frame *frame, pm_state *s, int slot)
{
    pm_constraint normal, tangent;
    const int contact = pm_contact_of_slot(frame->model, slot);
    if (s->slot[slot].mode == PM_SMOOTH && pm_contact_is_single(frame->model, contact) &&
        !pm_contact_measures_itself(frame->model, contact))
        return; /* nothing ever holds it along its tangent */
    const int slips = pm_contact_has_rim(frame->model, contact) || pm_contact_rubs(frame->model, contact);
    if (pm_contact_measures_itself(frame->model, contact) && !slips) return; /* its length stays */
    if (s->slot[slot].mode == PM_CAPTURED) {
        pm_capture_keep(frame, s, slot);
        return;
    }
    pm_contact_constraint_both(frame, contact, slot, s->slot[slot].member, &normal, &tangent);
    if (normal.curve != PM_NONE)
        pm_constraint_curve_find(frame, &normal,
                                 &s->memory[frame->model->nmemory - frame->model->nslot + slot]);
    remember(frame, s, &tangent, 1);
}

void pm_active_set_anchor_joint(const pm_frame *frame, const pm_state *state, pm_state *s, int joint)
{
    pm_constraint c[PM_JOINT_CONSTRAINTS];
    if (frame->model->joint_memory[joint] == PM_NONE) return;
    const int n = pm_joint_constraints(frame, state, joint, c);
    for (int k = 0; k < n; k++) remember(frame, s, &c[k], 1);
}

void pm_active_set_find_feet(const pm_frame *frame, pm_state *s)
{
    for (int i = 0; i < frame->model->rows[PM_TABLE_JOINT]; i++) {
        pm_constraint c[PM_JOINT_CONSTRAINTS];
        if (!pm_joint_of(frame->model, i)->feet) continue;
        pm_joint_constraints_of_any(frame, i, c);
        remember(frame, s, &c[0], 1);
    }
}

/* Measures the cords, as drawn, and what they are slack; the same of flanks, whose anchor is along their pitch curves. */
static void anchor_contacts(const pm_frame *frame, pm_state *s)
{
    for (int i = 0; i < frame->model->rows[PM_TABLE_CONTACT]; i++) {
        if (!pm_contact_measures_itself(frame->model, i)) continue;
        pm_constraint c;
        pm_contact_constraint_normal(frame, i, frame->model->contact_slot[i], 0, &c);
        remember(frame, s, &c, 1);
        const double slack = frame->numbers->value[PM_CONTACT_ROW(frame->model, i)[PM_CONTACT_SLACK]];
        s->memory[c.memory].anchor += c.flank != 0 ? -c.flank * slack / c.teeth[0] : slack;
    }
}

void pm_active_set_anchor_start(const pm_frame *frame, const pm_state *state, pm_state *s)
{
    for (int i = 0; i < frame->model->rows[PM_TABLE_JOINT]; i++)
        pm_active_set_anchor_joint(frame, state, s, i);
    anchor_contacts(frame, s);
}

/* Slack cords are no active constraints, and yet their strands rotate. */
static void follow_slack_cords(const pm_frame *frame, pm_state *s)
{
    for (int i = 0; i < frame->model->rows[PM_TABLE_CONTACT]; i++) {
        const int slot = frame->model->contact_slot[i];
        if (!pm_contact_is_cord(frame->model, i) || s->slot[slot].mode != PM_OPEN) continue;
        pm_constraint strand, unused;
        pm_contact_constraint_both(frame, i, slot, 0, &strand, &unused);
        remember(frame, s, &strand, 0);
    }
}

/* The members of contacts with curves are those that their feet have come to. */
static void follow_members(const pm_frame *frame, pm_state *s)
{
    const pm_model *m = frame->model;
    for (int i = 0; i < m->nslot; i++) {
        const int contact = pm_contact_of_slot(m, i);
        if (s->slot[i].mode == PM_OPEN || !pm_contact_curve_is(m, contact)) continue;
        s->slot[i].member =
            pm_contact_curve_follow(frame, contact, s->slot[i].member, &s->memory[m->nmemory - m->nslot + i]);
    }
}

void pm_active_set_follow(const pm_frame *frame, const pm_active_set *active, pm_state *s)
{
    for (int i = 0; i < active->n; i++) remember(frame, s, &active->constraint[i], 0);
    for (int i = 0; i < active->nredundant; i++) /* they have feet, too */
        if (active->redundant[i].memory == PM_NONE) remember(frame, s, &active->redundant[i], 0);
    follow_members(frame, s);
    follow_slack_cords(frame, s);
}
