/* contact.c - gaps of potential contacts; those to a pattern: contact_pattern.c. */
#include "elements/contact.h"

#include <math.h>

#include "elements/capture.h"
#include "elements/constraint.h"
#include "elements/contact_curve.h"
#include "elements/contact_pattern.h"
#include "elements/edge.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

double pm_contact_length(const pm_frame *frame)
{
    return PM_TOUCHING * frame->numbers->coarse * frame->numbers->size;
}
double pm_contact_end(const pm_frame *frame, const double at[2])
{
    const double far = pm_max(fabs(at[0]), fabs(at[1]));
    return PM_EDGE_END * frame->numbers->coarse * pm_max(frame->numbers->size, far);
}
double pm_contact_speed(const pm_frame *frame)
{
    return PM_NO_SPEED * frame->numbers->coarse * frame->numbers->speed;
}

double pm_contact_reach(const pm_workspace *w)
{
    double reach = w->numbers.size;
    for (int i = 0; i < w->model->nq; i++)
        if (i % 3 != 2) reach = pm_max(fabs(w->state.q[i]), reach);
    return reach;
}

int pm_contact_is_pattern(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND] == PM_CONTACT_PATTERN;
}

int pm_contact_free_slot(const pm_frame *frame, const pm_state *s, int contact)
{
    const int first = frame->model->contact_slot[contact];
    for (int i = first; i < first + pm_contact_slots(frame->model, contact); i++)
        if (s->slot[i].mode == PM_OPEN) return i;
    return PM_NONE;
}

/* Of a segment one member at a time is closed: it stands for all. */
static int is_closed(const pm_frame *frame, const pm_state *s, int contact, int member)
{
    const int first = frame->model->contact_slot[contact];
    for (int i = first; i < first + pm_contact_slots(frame->model, contact); i++)
        if (s->slot[i].mode != PM_OPEN && (s->slot[i].member == member || pm_edge_is(frame->model, contact)))
            return 1;
    return 0;
}

static inline double plain_gap(const pm_frame *frame, int contact, double *rate)
{
    const pm_constraint *c = &frame->numbers->of_contact[contact];
    return pm_constraint_kind(c->kind)->gap(frame, c, rate);
}

double pm_contact_restitution(const pm_frame *frame, int contact)
{
    return frame->numbers->value[PM_CONTACT_ROW(frame->model, contact)[PM_CONTACT_RESTITUTION]];
}

double pm_contact_tangential(const pm_frame *frame, int contact)
{
    const int index = PM_CONTACT_ROW(frame->model, contact)[PM_CONTACT_TANGENTIAL];
    return index == PM_NONE ? 0 : frame->numbers->value[index];
}

double pm_contact_stiffness(const pm_frame *frame, int contact)
{
    const int index = PM_CONTACT_ROW(frame->model, contact)[PM_CONTACT_STIFFNESS];
    return index == PM_NONE ? 0 : frame->numbers->value[index];
}

int pm_contact_law(const pm_model *m, int contact) { return PM_CONTACT_ROW(m, contact)[PM_CONTACT_LAW]; }

int pm_contact_friction(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_FRICTION];
}

int pm_contact_is_cord(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND] == PM_CONTACT_CORD;
}

int pm_contact_has_rim(const pm_model *m, int contact)
{
    return pm_contact_is_cord(m, contact) && PM_CONTACT_ROW(m, contact)[PM_CONTACT_RIM] != PM_NONE;
}

int pm_contact_has_flank(const pm_model *m, int contact)
{
    const int kind = PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND];
    return kind == PM_CONTACT_TEETH || kind == PM_CONTACT_RACK;
}

int pm_contact_measures_itself(const pm_model *m, int contact)
{
    return pm_contact_is_cord(m, contact) || pm_contact_has_flank(m, contact);
}

/* Of a rim as the tensions of its cord have it. */
static double coefficient(const pm_frame *frame, int contact, int column)
{
    const int32_t *e = PM_CONTACT_ROW(frame->model, contact);
    const int lever = e[PM_CONTACT_LEVER];
    if (e[PM_CONTACT_FRICTION] != PM_FRICTION_COULOMB) return 0;
    if (lever != PM_NONE && frame->numbers->value[lever] == 0) return 0;
    const double given = frame->numbers->value[e[column]];
    if (!pm_contact_has_rim(frame->model, contact)) return given;
    pm_constraint c;
    pm_contact_constraint_normal(frame, contact, frame->model->contact_slot[contact], 0, &c);
    return pm_constraint_cord_grip(given, pm_constraint_cord_wrap(frame, &c));
}

double pm_contact_static(const pm_frame *frame, int contact)
{
    return coefficient(frame, contact, PM_CONTACT_STATIC);
}
double pm_contact_kinetic(const pm_frame *frame, int contact)
{
    return coefficient(frame, contact, PM_CONTACT_KINETIC);
}
int pm_contact_friction_jumps(const pm_frame *frame, int contact)
{
    return pm_contact_friction(frame->model, contact) == PM_FRICTION_COULOMB &&
           pm_contact_static(frame, contact) > pm_contact_kinetic(frame, contact);
}

/* Two points that are at one place have no direction: nothing is known of the rate. */
static double meeting_gap(const pm_frame *frame, int contact, double *rate)
{
    const double distance = pm_capture_distance(frame, contact);
    if (rate) *rate = distance > 0 ? pm_capture_approach(frame, contact) / distance : 0;
    return distance;
}

/* By the constraint with the numbers of the case, if its kind and that member need no other. */
static const pm_constraint_ops *ops_of_gap(const pm_model *m, const pm_constraint *c, int contact, int member)
{
    const pm_constraint_ops *ops = pm_constraint_kind(c->kind);
    return ops->gap && (member == PM_SEGMENT_FACE || !pm_edge_is(m, contact)) ? ops : NULL;
}

double pm_contact_member_gap(const pm_frame *frame, int contact, int member, double *rate)
{
    const pm_constraint *own = &frame->numbers->of_contact[contact];
    if (pm_contact_is_plain(frame->model, contact)) return plain_gap(frame, contact, rate);
    if (pm_capture_is_meeting(frame->model, contact)) return meeting_gap(frame, contact, rate);
    if (pm_contact_is_pattern(frame->model, contact))
        return pm_contact_pattern_member_gap(frame, contact, member, rate);
    const pm_constraint_ops *ops = ops_of_gap(frame->model, own, contact, member);
    if (ops) return ops->gap(frame, own, rate);
    pm_constraint normal;
    pm_contact_constraint_normal(frame, contact, frame->model->contact_slot[contact], member, &normal);
    pm_constraint_kind(normal.kind)->evaluate(frame, &normal);
    if (rate) *rate = pm_constraint_times(frame, &normal, frame->v);
    return normal.g;
}

double pm_contact_member_slip(const pm_frame *frame, int contact, int member)
{
    pm_constraint normal, tangent;
    pm_contact_constraint_both(frame, contact, frame->model->contact_slot[contact], member, &normal,
                               &tangent);
    return pm_constraint_slip(frame, &tangent);
}

int pm_contact_near(const pm_frame *frame, const pm_state *s, int contact, int most, int *member)
{
    const int32_t *e = PM_CONTACT_ROW(frame->model, contact);
    if (pm_state_is_absent(frame->model, s, PM_TABLE_CONTACT, contact)) return 0;
    member[0] = 0;
    if (pm_contact_is_plain(frame->model, contact))
        return !pm_contact_plain_is_closed(frame->model, s, contact);
    if (e[PM_CONTACT_KIND] == PM_CONTACT_PATTERN)
        return pm_contact_pattern_near(frame, s, contact, most, member);
    return !is_closed(frame, s, contact, 0);
}

double pm_contact_gap(const pm_frame *frame, const pm_state *s, int contact, int *member)
{
    *member = 0;
    return pm_state_is_absent(frame->model, s, PM_TABLE_CONTACT, contact)
               ? INFINITY
               : pm_contact_apart(frame, s, contact, member);
}

double pm_contact_apart(const pm_frame *frame, const pm_state *s, int contact, int *member)
{
    const int32_t *e = PM_CONTACT_ROW(frame->model, contact);
    *member = 0;
    if (pm_contact_is_plain(frame->model, contact))
        return pm_contact_plain_is_closed(frame->model, s, contact) ? INFINITY
                                                                    : plain_gap(frame, contact, NULL);
    if (e[PM_CONTACT_KIND] == PM_CONTACT_PATTERN) return pm_contact_pattern_gap(frame, s, contact, member);
    if (pm_contact_curve_is(frame->model, contact)) return pm_contact_curve_gap(frame, s, contact, member);
    if (is_closed(frame, s, contact, 0)) return INFINITY;
    if (!pm_edge_is(frame->model, contact)) return pm_contact_member_gap(frame, contact, 0, 0);
    return pm_edge_is_covered(frame, s, contact) ? INFINITY : pm_edge_gap(frame, contact, member);
}

int pm_contact_touches(const pm_frame *frame, const pm_state *s, int contact, int *member)
{
    if (pm_contact_gap(frame, s, contact, member) > pm_contact_length(frame)) return 0;
    if (pm_contact_is_plain(frame->model, contact)) return 1;
    if (pm_contact_curve_is(frame->model, contact))
        return pm_contact_curve_touches(frame, s, contact, member);
    return !pm_edge_is(frame->model, contact) || pm_edge_touches(frame, contact);
}
