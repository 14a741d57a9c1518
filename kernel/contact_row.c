/* contact_row.c - the normal and the tangential row of a contact that is closed, or may close. */
#include "mark.h"
#include "segment.h"

static int memory_of(const pm_model *m, int slot) { return m->nmemory - m->nslot + slot; }

static void corner_of_segment(const pm_workspace *w, pm_row *row, int contact, int member)
{
    pm_segment_corner(w, contact, member, row->b);
    pm_mark_radii(row, row->radius_a, 0, 1);
}

void pm_row_normal_of_contact(const pm_workspace *w, int contact, int slot, int member, pm_row *normal)
{
    const pm_model *m = w->model;
    const int32_t *e = PM_CONTACT_ROW_OF(m, contact);
    const int a = e[PM_CONTACT_A], b = e[PM_CONTACT_B];
    switch ((enum pm_contact_kind)e[PM_CONTACT_KIND]) {
    case PM_CONTACT_LINE:
        *normal = pm_row_blank(PM_ROW_LINE_NORMAL);
        pm_mark_circle_and_line(w, normal, a, b);
        break;
    case PM_CONTACT_SEGMENT:
        *normal = pm_row_blank(member == PM_SEGMENT_FACE ? PM_ROW_LINE_NORMAL : PM_ROW_DISTANCE);
        pm_mark_circle_and_line(w, normal, a, b);
        if (member != PM_SEGMENT_FACE) corner_of_segment(w, normal, contact, member);
        break;
    case PM_CONTACT_CIRCLE:
        *normal = pm_row_blank(PM_ROW_DISTANCE);
        pm_mark_circles(w, normal, a, b, w->value[e[PM_CONTACT_SIDE]]);
        break;
    case PM_CONTACT_POINT:
        *normal = pm_row_blank(PM_ROW_DISTANCE);
        pm_mark_circles(w, normal, a, b, 1);
        break;
    case PM_CONTACT_CORD:
        *normal = pm_row_blank(PM_ROW_STRAND);
        pm_mark_strand(w, normal, a, b, e[PM_CONTACT_SENSE_A], e[PM_CONTACT_SENSE_B]);
        break;
    case PM_CONTACT_ROW:
    case PM_CONTACT_KINDS:
        *normal = pm_row_blank(PM_ROW_DISTANCE);
        pm_mark_member(w, normal, a, b, member);
        break;
    }
    normal->slot = slot;
    if (normal->kind == PM_ROW_STRAND) normal->memory = memory_of(m, slot);
}

void pm_row_tangent_of_contact(const pm_workspace *w, int contact, const pm_row *normal, pm_row *tangent)
{
    const int32_t *e = PM_CONTACT_ROW_OF(w->model, contact);
    *tangent = *normal;
    tangent->memory = memory_of(w->model, normal->slot);
    if (normal->kind == PM_ROW_STRAND) return; /* nothing acts across a cord: it is smooth */
    tangent->kind = normal->kind == PM_ROW_LINE_NORMAL ? PM_ROW_LINE_TANGENT : PM_ROW_CIRCLE_TANGENT;
    if (tangent->kind == PM_ROW_LINE_TANGENT) tangent->drive = e[PM_CONTACT_SPEED]; /* corners do not run */
}

void pm_row_of_contact(const pm_workspace *w, int contact, int slot, int member, pm_row *normal,
                       pm_row *tangent)
{
    pm_row_normal_of_contact(w, contact, slot, member, normal);
    pm_row_tangent_of_contact(w, contact, normal, tangent);
}
