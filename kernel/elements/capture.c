/* capture.c - contacts that capture: a bullet embeds, a hook engages, a package stays on its edge.
 *
 * A pair is caught where it touches and does not part - two points: wherever they meet - and is a joint from then on.
 * Its place P is kept in the axes of both bodies, r_a and r_b; with A(q) the rotation of a body,
 *     point:  x_a + A_a r_a - x_b - A_b r_b = 0                   a pin
 *     body:   the same, and angle_a - angle_b as it was           a weld
 * The blow that catches it is plastic through all of these constraints: the relative velocity of a and b at P (and their
 * relative spin) is taken away by an impulse at P of any direction (and a couple), so that the angular momentum about P
 * of each body free of other impulses is kept by a point, that of both together by a body.
 *
 * Two points have no gap that changes its sign: their distance D = |d| touches zero and grows again.  D^2 is least where
 * d.u = 0 while it rises, u their relative velocity; there they meet if D is zero but for the errors of the run. */
#include "elements/capture.h"

#include <math.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

int pm_capture_kind(const pm_model *m, int contact) { return PM_CONTACT_ROW(m, contact)[PM_CONTACT_CAPTURE]; }

int pm_capture_is_meeting(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND] == PM_CONTACT_POINT;
}

static pm_marks marks_of(const pm_frame *frame, int contact)
{
    pm_constraint normal, tangent;
    pm_contact_constraint_both(frame, contact, frame->model->contact_slot[contact], 0, &normal, &tangent);
    return pm_constraint_marks(frame, &normal);
}

double pm_capture_distance(const pm_frame *frame, int contact)
{
    const pm_marks x = marks_of(frame, contact);
    return pm_length(x.d);
}

double pm_capture_approach(const pm_frame *frame, int contact)
{
    const pm_marks x = marks_of(frame, contact);
    const double approach = pm_dot(x.d, x.u);
    return fabs(approach) > PM_CAPTURE_ACROSS * pm_length(x.d) * pm_length(x.u) ? approach : 0;
}

double pm_capture_soonest(const pm_frame *frame, const pm_state *state, int contact)
{
    int member;
    if (isinf(pm_contact_gap(frame, state, contact, &member))) return INFINITY;
    const pm_marks x = marks_of(frame, contact);
    return pm_length(x.d) / pm_length(x.u);
}

int pm_capture_meets(const pm_numbers *numbers, pm_evidence *evidence, int contact, double distance)
{
    const double room = PM_CAPTURE_MEETS * numbers->size - distance;
    if (isinf(distance)) return 0;
    pm_evidence_sign(evidence, PM_SITE_MEETS, contact, room, numbers->size);
    return room >= 0;
}

/* ---- the kept place ---- */
static pm_kept *kept_of(const pm_frame *frame, const pm_state *s, int slot)
{
    const int contact = pm_contact_of_slot(frame->model, slot);
    return s->kept + frame->model->contact_kept[contact] + slot - frame->model->contact_slot[contact];
}

/* In the axes of a body. */
static void into_body(const pm_frame *frame, int body, const double at[2], double out[2])
{
    const double *pose = frame->pose + 5 * body, x = at[0] - pose[0], y = at[1] - pose[1];
    out[0] = pose[3] * x + pose[4] * y;
    out[1] = -pose[4] * x + pose[3] * y;
}

void pm_capture_keep(const pm_frame *frame, pm_state *s, int slot)
{
    const int contact = pm_contact_of_slot(frame->model, slot);
    pm_kept *kept = kept_of(frame, s, slot);
    pm_constraint normal, tangent;
    pm_line_of_action x;
    pm_contact_constraint_both(frame, contact, slot, s->slot[slot].member, &normal, &tangent);
    if (pm_capture_is_meeting(frame->model, contact)) {
        const pm_marks marks = pm_constraint_marks(frame, &normal);
        for (int k = 0; k < 2; k++) x.at[k] = marks.a.p[k];
    } else {
        pm_constraint_kind(normal.kind)->act(frame, &normal, &x);
    }
    into_body(frame, normal.body[0], x.at, kept->a);
    into_body(frame, normal.body[1], x.at, kept->b);
    kept->angle = frame->pose[5 * normal.body[0] + 2] - frame->pose[5 * normal.body[1] + 2];
}

/* A particle has no direction that could be held. */
static int can_rotate(const pm_frame *frame, int body)
{
    return body == frame->model->nbody || PM_BODY_ROW(frame->model, body)[PM_BODY_ROTATES];
}

int pm_capture_constraints(const pm_frame *frame, const pm_state *state, int slot,
                           pm_constraint c[PM_JOINT_CONSTRAINTS])
{
    static const int kind[PM_JOINT_CONSTRAINTS] = {PM_CONSTRAINT_POINT_X, PM_CONSTRAINT_POINT_Y,
                                                   PM_CONSTRAINT_ANGLE};
    const int contact = pm_contact_of_slot(frame->model, slot);
    const pm_kept *kept = kept_of(frame, state, slot);
    pm_constraint normal, tangent;
    pm_contact_constraint_both(frame, contact, slot, state->slot[slot].member, &normal, &tangent);
    const int whole = pm_capture_kind(frame->model, contact) == PM_CAPTURE_BODY;
    const int n = whole && can_rotate(frame, normal.body[0]) && can_rotate(frame, normal.body[1]) ? 3 : 2;
    for (int i = 0; i < n; i++) {
        c[i] = (pm_constraint){.kind = kind[i],
                               .body = {normal.body[0], normal.body[1]},
                               .a = {kept->a[0], kept->a[1]},
                               .b = {kept->b[0], kept->b[1]},
                               .value = kept->angle,
                               .sign = 1,
                               .memory = PM_NONE,
                               .joint = PM_NONE,
                               .slot = slot,
                               .normal = PM_NONE,
                               .drive = PM_NONE};
    }
    return n;
}

double pm_capture_speed(const pm_frame *frame, const pm_state *state, int slot)
{
    pm_constraint c[PM_JOINT_CONSTRAINTS];
    const int n = pm_capture_constraints(frame, state, slot, c);
    double fastest = 0;
    for (int i = 0; i < n; i++) {
        const double length = c[i].kind == PM_CONSTRAINT_ANGLE ? frame->numbers->size : 1;
        fastest = fmax(fastest, fabs(pm_constraint_rate(frame, &c[i])) * length);
    }
    return fastest;
}

/* ---- what a phase has ---- */
int pm_capture_holds(const pm_model *model, const pm_state *state)
{
    for (int i = 0; i < model->nslot; i++)
        if (state->slot[i].mode == PM_CAPTURED) return 1;
    return 0;
}

int pm_capture_awaits(const pm_frame *frame, const pm_state *state)
{
    int member;
    for (int i = 0; i < frame->model->rows[PM_TABLE_CONTACT]; i++)
        if (pm_capture_is_meeting(frame->model, i) && !isinf(pm_contact_gap(frame, state, i, &member)))
            return 1;
    return 0;
}
