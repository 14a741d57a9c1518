/* contact_constraint.c - the normal and the tangential constraint of a contact that is closed, or may close. */
#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/contact_curve.h"
#include "elements/edge.h"
#include "state/workspace.h"

static int memory_of(const pm_model *m, int slot) { return m->nmemory - m->nslot + slot; }

static void flank(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    pm_constraint_marks_pressure(c, frame->numbers->value[e[PM_CONTACT_PRESSURE]]);
    c->flank = e[PM_CONTACT_SENSE_A];
}

static void over_rim(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    const int circle[3] = {e[PM_CONTACT_A], e[PM_CONTACT_B], e[PM_CONTACT_RIM]};
    const int32_t sense[3] = {e[PM_CONTACT_SENSE_A], e[PM_CONTACT_SENSE_B], e[PM_CONTACT_SENSE_RIM]};
    pm_constraint_marks_cord(frame, c, circle, sense);
    c->turns = frame->numbers->value[e[PM_CONTACT_TURNS]];
    if (e[PM_CONTACT_KINETIC] >= 0) c->value = frame->numbers->value[e[PM_CONTACT_KINETIC]];
}

/* The normal constraint with the face of a segment, or member 0 of a pattern, as its partner. */
static void compose(const pm_frame *frame, int contact, pm_constraint *normal)
{
    const int32_t *e = PM_CONTACT_ROW(frame->model, contact);
    const int a = e[PM_CONTACT_A], b = e[PM_CONTACT_B];
    switch ((enum pm_contact_kind)e[PM_CONTACT_KIND]) {
    case PM_CONTACT_LINE:
    case PM_CONTACT_SEGMENT:
        pm_constraint_marks_blank(normal, PM_CONSTRAINT_LINE_NORMAL);
        pm_constraint_marks_circle_and_line(frame, normal, a, b);
        break;
    case PM_CONTACT_CIRCLE:
        pm_constraint_marks_blank(normal, PM_CONSTRAINT_DISTANCE);
        pm_constraint_marks_circles(frame, normal, a, b, frame->numbers->value[e[PM_CONTACT_SIDE]]);
        break;
    case PM_CONTACT_POINT:
        pm_constraint_marks_blank(normal, PM_CONSTRAINT_DISTANCE);
        pm_constraint_marks_circles(frame, normal, a, b, 1);
        break;
    case PM_CONTACT_CORD:
        pm_constraint_marks_blank(normal, PM_CONSTRAINT_STRAND);
        if (e[PM_CONTACT_RIM] == PM_NONE)
            pm_constraint_marks_strand(frame, normal, a, b, e[PM_CONTACT_SENSE_A], e[PM_CONTACT_SENSE_B]);
        else
            over_rim(frame, e, normal);
        break;
    case PM_CONTACT_TEETH:
        pm_constraint_marks_blank(normal, PM_CONSTRAINT_TEETH);
        pm_constraint_marks_circles(frame, normal, a, b, frame->numbers->value[e[PM_CONTACT_SIDE]]);
        flank(frame, e, normal);
        break;
    case PM_CONTACT_RACK:
        pm_constraint_marks_blank(normal, PM_CONSTRAINT_RACK);
        pm_constraint_marks_circle_and_line(frame, normal, a, b);
        flank(frame, e, normal);
        break;
    case PM_CONTACT_CURVE:
        pm_constraint_marks_blank(normal, PM_CONSTRAINT_CURVE_NORMAL);
        pm_constraint_marks_circle_and_curve(frame, normal, a, b);
        break;
    case PM_CONTACT_CURVES:
        pm_constraint_marks_blank(normal, PM_CONSTRAINT_PAIR_NORMAL);
        pm_constraint_marks_curves(frame, normal, a, b);
        break;
    case PM_CONTACT_PATTERN:
    case PM_CONTACT_KINDS:
        pm_constraint_marks_blank(normal, PM_CONSTRAINT_DISTANCE);
        pm_constraint_marks_pattern(frame, normal, a, b);
        break;
    }
}

void pm_contact_compose(const pm_frame *frame)
{
    for (int i = 0; i < frame->model->rows[PM_TABLE_CONTACT]; i++)
        compose(frame, i, frame->numbers->of_contact + i);
}

static void corner_of_segment(const pm_frame *frame, pm_constraint *c, int contact, int member)
{
    c->kind = PM_CONSTRAINT_DISTANCE;
    pm_edge_corner(frame, contact, member, c->b);
    pm_constraint_marks_radii(c, c->radius_a, 0, 1);
}

static void member_of_pattern(const pm_frame *frame, pm_constraint *c, int of, int member)
{
    const int32_t *e = PM_PATTERN_ROW(frame->model, of);
    c->b[0] += member * frame->numbers->value[e[PM_PATTERN_STEP_X]];
    c->b[1] += member * frame->numbers->value[e[PM_PATTERN_STEP_Y]];
}

void pm_contact_constraint_normal(const pm_frame *frame, int contact, int slot, int member,
                                  pm_constraint *normal)
{
    const pm_model *m = frame->model;
    const int32_t *e = PM_CONTACT_ROW(m, contact);
    *normal = frame->numbers->of_contact[contact];
    normal->slot = slot;
    switch (e[PM_CONTACT_KIND]) {
    case PM_CONTACT_SEGMENT:
        if (member != PM_SEGMENT_FACE) corner_of_segment(frame, normal, contact, member);
        break;
    case PM_CONTACT_CORD:
    case PM_CONTACT_TEETH:
    case PM_CONTACT_RACK: normal->memory = memory_of(m, slot); break;
    case PM_CONTACT_CURVES:
    case PM_CONTACT_CURVE: pm_contact_curve_constraint(frame, contact, member, normal); break;
    case PM_CONTACT_PATTERN: member_of_pattern(frame, normal, e[PM_CONTACT_B], member); break;
    default: break;
    }
}

const pm_constraint *pm_contact_constraint_read(const pm_frame *frame, int contact, int member,
                                                pm_constraint *own)
{
    const pm_model *m = frame->model;
    const int kind = PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND];
    if (pm_contact_is_plain(m, contact) || kind == PM_CONTACT_POINT ||
        (kind == PM_CONTACT_SEGMENT && member == PM_SEGMENT_FACE))
        return &frame->numbers->of_contact[contact];
    pm_contact_constraint_normal(frame, contact, m->contact_slot[contact], member, own);
    return own;
}

void pm_contact_constraint_tangent(const pm_frame *frame, int contact, const pm_constraint *normal,
                                   pm_constraint *tangent)
{
    const int32_t *e = PM_CONTACT_ROW(frame->model, contact);
    *tangent = *normal;
    tangent->memory = memory_of(frame->model, normal->slot);
    if (normal->over) tangent->kind = PM_CONSTRAINT_CORD_SLIP;
    if (normal->teeth[0] > 0 && e[PM_CONTACT_LEVER] != PM_NONE) {
        tangent->kind = PM_CONSTRAINT_TEETH_SLIP;
        tangent->value = frame->numbers->value[e[PM_CONTACT_LEVER]];
    }
    if (normal->over || normal->kind == PM_CONSTRAINT_STRAND || normal->teeth[0] > 0)
        return; /* nothing else acts across a cord or a flank */
    tangent->kind = normal->kind == PM_CONSTRAINT_LINE_NORMAL    ? PM_CONSTRAINT_LINE_TANGENT
                    : normal->kind == PM_CONSTRAINT_CURVE_NORMAL ? PM_CONSTRAINT_CURVE_TANGENT
                    : normal->kind == PM_CONSTRAINT_PAIR_NORMAL  ? PM_CONSTRAINT_PAIR_TANGENT
                                                                 : PM_CONSTRAINT_CIRCLE_TANGENT;
    if (tangent->kind == PM_CONSTRAINT_LINE_TANGENT)
        tangent->drive = e[PM_CONTACT_SPEED]; /* corners do not run */
}

void pm_contact_constraint_both(const pm_frame *frame, int contact, int slot, int member,
                                pm_constraint *normal, pm_constraint *tangent)
{
    pm_contact_constraint_normal(frame, contact, slot, member, normal);
    pm_contact_constraint_tangent(frame, contact, normal, tangent);
}

double pm_contact_constraint_side(const pm_frame *frame, int contact, const pm_constraint *normal)
{
    return normal->body[0] == frame->numbers->of_contact[contact].body[0] ? 1 : -1;
}
