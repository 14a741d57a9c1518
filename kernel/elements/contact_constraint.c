/* contact_constraint.c - the normal and the tangential constraint of a contact that is closed, or may close. */
#include "elements/constraint.h"
#include "elements/edge.h"
#include "state/workspace.h"

static int memory_of(const pm_model *m, int slot) { return m->nmemory - m->nslot + slot; }

static void corner_of_segment(const pm_frame *frame, pm_constraint *c, int contact, int member)
{
    pm_edge_corner(frame, contact, member, c->b);
    pm_constraint_marks_radii(c, c->radius_a, 0, 1);
}

void pm_contact_constraint_normal(const pm_frame *frame, int contact, int slot, int member,
                                  pm_constraint *normal)
{
    const pm_model *m = frame->model;
    const int32_t *e = PM_CONTACT_ROW(m, contact);
    const int a = e[PM_CONTACT_A], b = e[PM_CONTACT_B];
    switch ((enum pm_contact_kind)e[PM_CONTACT_KIND]) {
    case PM_CONTACT_LINE:
        *normal = pm_constraint_marks_blank(PM_CONSTRAINT_LINE_NORMAL);
        pm_constraint_marks_circle_and_line(frame, normal, a, b);
        break;
    case PM_CONTACT_SEGMENT:
        *normal = pm_constraint_marks_blank(member == PM_SEGMENT_FACE ? PM_CONSTRAINT_LINE_NORMAL
                                                                      : PM_CONSTRAINT_DISTANCE);
        pm_constraint_marks_circle_and_line(frame, normal, a, b);
        if (member != PM_SEGMENT_FACE) corner_of_segment(frame, normal, contact, member);
        break;
    case PM_CONTACT_CIRCLE:
        *normal = pm_constraint_marks_blank(PM_CONSTRAINT_DISTANCE);
        pm_constraint_marks_circles(frame, normal, a, b, frame->numbers->value[e[PM_CONTACT_SIDE]]);
        break;
    case PM_CONTACT_POINT:
        *normal = pm_constraint_marks_blank(PM_CONSTRAINT_DISTANCE);
        pm_constraint_marks_circles(frame, normal, a, b, 1);
        break;
    case PM_CONTACT_CORD:
        *normal = pm_constraint_marks_blank(PM_CONSTRAINT_STRAND);
        pm_constraint_marks_strand(frame, normal, a, b, e[PM_CONTACT_SENSE_A], e[PM_CONTACT_SENSE_B]);
        break;
    case PM_CONTACT_PATTERN:
    case PM_CONTACT_KINDS:
        *normal = pm_constraint_marks_blank(PM_CONSTRAINT_DISTANCE);
        pm_constraint_marks_member(frame, normal, a, b, member);
        break;
    }
    normal->slot = slot;
    if (normal->kind == PM_CONSTRAINT_STRAND) normal->memory = memory_of(m, slot);
}

void pm_contact_constraint_tangent(const pm_frame *frame, int contact, const pm_constraint *normal,
                                   pm_constraint *tangent)
{
    const int32_t *e = PM_CONTACT_ROW(frame->model, contact);
    *tangent = *normal;
    tangent->memory = memory_of(frame->model, normal->slot);
    if (normal->kind == PM_CONSTRAINT_STRAND) return; /* nothing acts across a cord: it is smooth */
    tangent->kind =
        normal->kind == PM_CONSTRAINT_LINE_NORMAL ? PM_CONSTRAINT_LINE_TANGENT : PM_CONSTRAINT_CIRCLE_TANGENT;
    if (tangent->kind == PM_CONSTRAINT_LINE_TANGENT)
        tangent->drive = e[PM_CONTACT_SPEED]; /* corners do not run */
}

void pm_contact_constraint_both(const pm_frame *frame, int contact, int slot, int member,
                                pm_constraint *normal, pm_constraint *tangent)
{
    pm_contact_constraint_normal(frame, contact, slot, member, normal);
    pm_contact_constraint_tangent(frame, contact, normal, tangent);
}
