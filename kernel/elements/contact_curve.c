/* contact_curve.c - a circle (or a point: radius 0) beside a curve.
 *
 * At the nearest place of the curve, with the height h over its tangent, beyond an end by o > 0 along that, R the radius:
 *   within    h - R; behind an open curve, where nothing touches, not below -(way to the nearer end)
 *   beyond    sqrt(o^2 + h^2) - R, the gap to the end; from behind no more than o
 * which is what edge.c has of a straight edge.  A circle in a hollow touches at several feet: each closed one is left out where
 * the next is looked for. */
#include "elements/contact_curve.h"

#include <math.h>

#include "elements/contact.h"
#include "elements/contact_pair.h"
#include "elements/curve_piece.h"
#include "state/frame.h"

int pm_contact_curve_is(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND] == PM_CONTACT_CURVE || pm_contact_pair_is(m, contact);
}

int pm_contact_curve_any(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++)
        if (pm_contact_curve_is(m, i)) return 1;
    return 0;
}

int pm_contact_curve_is_closed(const pm_model *m, const pm_state *s, int contact)
{
    for (int i = m->contact_slot[contact]; i < m->contact_slot[contact] + PM_PATTERN_SLOTS; i++)
        if (s->slot[i].mode != PM_OPEN) return 1;
    return 0;
}

static int curve_of(const pm_model *m, int contact) { return PM_CONTACT_ROW(m, contact)[PM_CONTACT_B]; }

int pm_contact_curve_ends(const pm_model *m, int contact)
{
    return pm_contact_curve_is(m, contact) && pm_curve_has_ends(m, curve_of(m, contact));
}

static int has_corners(const pm_model *m, int contact)
{
    return pm_contact_pair_is(m, contact) && pm_curve_has_ends(m, pm_contact_pair_first(m, contact));
}

int pm_contact_curve_parts(const pm_model *m, int contact)
{
    return pm_contact_curve_ends(m, contact) || has_corners(m, contact) ||
           (pm_contact_curve_is(m, contact) && pm_curve_has_pieces(m, curve_of(m, contact)));
}

static int rolls_on_another(const pm_model *m, int joint)
{
    return PM_JOINT_ROW(m, joint)[PM_JOINT_KIND] == PM_JOINT_ROLLING_CURVES;
}

int pm_contact_curve_looked_at(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++)
        if (rolls_on_another(m, i)) return 1;
    return pm_contact_curve_any(m);
}

static int begin_both(pm_workspace *w, int a, int b)
{
    const int status = pm_curve_feet_begin(w, a);
    return status ? status : pm_curve_feet_begin(w, b);
}

int pm_contact_curve_begin(pm_workspace *w)
{
    const pm_model *m = w->model;
    int status = PM_OK;
    for (int i = 0; !status && i < m->rows[PM_TABLE_CONTACT]; i++) {
        const int32_t *e = PM_CONTACT_ROW(m, i);
        if (pm_contact_pair_is(m, i))
            status = begin_both(w, e[PM_CONTACT_A], e[PM_CONTACT_B]);
        else if (pm_contact_curve_is(m, i))
            status = pm_curve_feet_begin(w, curve_of(m, i));
    }
    for (int i = 0; !status && i < m->rows[PM_TABLE_JOINT]; i++)
        if (rolls_on_another(m, i))
            status = begin_both(w, PM_JOINT_ROW(m, i)[PM_JOINT_A], PM_JOINT_ROW(m, i)[PM_JOINT_B]);
    return status;
}

/* ---- the nearest place ---- */
static double radius_of(const pm_frame *frame, int contact)
{
    return frame->numbers->value[PM_CIRCLE_ROW(
        frame->model, PM_CONTACT_ROW(frame->model, contact)[PM_CONTACT_A])[PM_CIRCLE_RADIUS]];
}

/* The centre of the circle from the point of the curve, in its axes. */
static void centre_of(const pm_frame *frame, int contact, double x[2])
{
    const pm_constraint *c = &frame->numbers->of_contact[contact];
    const pm_point a = pm_frame_point(frame, c->body[0], c->a[0], c->a[1]),
                   b = pm_frame_point(frame, c->body[1], c->b[0], c->b[1]);
    const double *pose = frame->pose + 5 * c->body[1], d[2] = {a.p[0] - b.p[0], a.p[1] - b.p[1]};
    x[0] = pose[3] * d[0] + pose[4] * d[1];
    x[1] = -pose[4] * d[0] + pose[3] * d[1];
}

/* So far beyond an end it is still there. */
static double reach_of(const pm_frame *frame, int contact)
{
    const pm_constraint *c = &frame->numbers->of_contact[contact];
    return pm_contact_end(frame, pm_frame_point(frame, c->body[0], c->a[0], c->a[1]).p);
}

static int is_end(int member) { return member > PM_CURVE_NODES; }
static int end_node(int member) { return member == PM_CURVE_FROM_END ? 0 : PM_CURVE_NODES; }

static double place_of(const pm_frame *frame, int contact, int member)
{
    return pm_curve_feet_place(frame, curve_of(frame->model, contact),
                               is_end(member) ? end_node(member) : member);
}

/* The s of the foot of a member, or of the end beyond which it has gone. */
static double foot_of(const pm_frame *frame, int contact, int member, const double x[2])
{
    const int curve = curve_of(frame->model, contact);
    const double at = place_of(frame, contact, member);
    double height;
    if (is_end(member)) return at;
    const double s = pm_curve_foot(frame, curve, x, at, &height).s;
    return pm_contact_curve_ends(frame->model, contact)
               ? fmin(fmax(s, pm_curve_feet_place(frame, curve, 0)),
                      pm_curve_feet_place(frame, curve, PM_CURVE_NODES))
               : s;
}

static pm_curve_taken taken_of(const pm_frame *frame, const pm_state *s, int contact, const double x[2])
{
    const int first = frame->model->contact_slot[contact];
    pm_curve_taken taken = {.n = 0};
    for (int i = first; i < first + pm_contact_slots(frame->model, contact); i++)
        if (s->slot[i].mode != PM_OPEN) taken.s[taken.n++] = foot_of(frame, contact, s->slot[i].member, x);
    return taken;
}

static int nearest(const pm_frame *frame, const pm_state *s, int contact, pm_curve_near *near)
{
    double x[2];
    centre_of(frame, contact, x);
    const pm_curve_taken taken = taken_of(frame, s, contact, x);
    const int found = pm_curve_feet_nearest(frame, curve_of(frame->model, contact), x, &taken, near);
    if (found) near->beyond = fmax(near->beyond - reach_of(frame, contact), 0); /* as far as it stands */
    return found;
}

static double gap_of(const pm_frame *frame, int contact, const pm_curve_near *near)
{
    const double radius = radius_of(frame, contact);
    if (near->end != PM_CURVE_WITHIN) {
        const double gap = hypot(near->beyond, near->height) - radius;
        return near->height < 0 ? fmin(gap, near->beyond) : gap;
    }
    return fmax(near->height - radius, -pm_curve_room(frame, curve_of(frame->model, contact), &near->foot));
}

static int member_of(const pm_frame *frame, int contact, const pm_curve_near *near)
{
    if (near->end == PM_CURVE_WITHIN || !(radius_of(frame, contact) > 0)) return near->node;
    return near->end == PM_CURVE_AT_FROM ? PM_CURVE_FROM_END : PM_CURVE_TO_END;
}

double pm_contact_curve_gap(const pm_frame *frame, const pm_state *s, int contact, int *member)
{
    pm_curve_near near;
    if (pm_contact_pair_is(frame->model, contact)) return pm_contact_pair_gap(frame, s, contact, member);
    if (!nearest(frame, s, contact, &near)) return INFINITY;
    *member = member_of(frame, contact, &near);
    return gap_of(frame, contact, &near);
}

int pm_contact_curve_touches(const pm_frame *frame, const pm_state *s, int contact, int *member)
{
    pm_curve_near near;
    if (pm_contact_pair_is(frame->model, contact)) return pm_contact_pair_touches(frame, s, contact, member);
    const double radius = radius_of(frame, contact), length = pm_contact_length(frame);
    if (!nearest(frame, s, contact, &near)) return 0;
    *member = member_of(frame, contact, &near);
    if (near.end != PM_CURVE_WITHIN) return hypot(near.beyond, near.height) - radius <= length;
    const int behind = pm_contact_curve_ends(frame->model, contact) && near.height < -length;
    return !behind && near.height - radius <= length;
}

int pm_contact_curve_is_below(const pm_frame *frame, const pm_state *s, int contact)
{
    pm_curve_near near;
    if (pm_contact_pair_is(frame->model, contact)) return 0; /* behind a curve it has no gap */
    return pm_contact_curve_ends(frame->model, contact) && nearest(frame, s, contact, &near) &&
           near.height < radius_of(frame, contact) - pm_contact_length(frame);
}

double pm_contact_curve_gap_from_below(const pm_frame *frame, const pm_state *s, int contact)
{
    pm_curve_near near;
    const double radius = radius_of(frame, contact);
    if (!nearest(frame, s, contact, &near)) return INFINITY;
    return near.end != PM_CURVE_WITHIN ? hypot(near.beyond, near.height) - radius : radius - near.height;
}

/* ---- members ---- */
void pm_contact_curve_constraint(const pm_frame *frame, int contact, int member, pm_constraint *normal)
{
    if (pm_contact_pair_is(frame->model, contact)) {
        pm_contact_pair_constraint(frame, contact, member, normal);
        return;
    }
    normal->near[0] = place_of(frame, contact, member);
    if (!is_end(member)) return;
    const pm_curve_node *at = &frame->numbers->course[curve_of(frame->model, contact)].node[end_node(member)];
    normal->kind = PM_CONSTRAINT_DISTANCE;
    normal->curve = PM_NONE;
    for (int k = 0; k < 2; k++) normal->b[k] += at->p[k];
    pm_constraint_marks_radii(normal, normal->radius_a, 0, 1);
}

int pm_contact_curve_is_same(const pm_model *m, int contact, int a, int b)
{
    if (!pm_contact_curve_is(m, contact)) return 0;
    if (pm_contact_pair_is(m, contact)) return pm_contact_pair_is_same(m, contact, a, b);
    int off = (is_end(a) ? end_node(a) : a) - (is_end(b) ? end_node(b) : b);
    off = off < 0 ? -off : off;
    return off <= 1 || (!pm_contact_curve_ends(m, contact) && off >= PM_CURVE_NODES - 1);
}

int pm_contact_curve_way(const pm_model *m, int contact, int member)
{
    return pm_contact_curve_is(m, contact) && !pm_contact_pair_is(m, contact) && is_end(member) ? -1 : 1;
}

int pm_contact_curve_follow(const pm_frame *frame, int contact, int member, const pm_memory *memory)
{
    if (pm_contact_pair_is(frame->model, contact))
        return pm_contact_pair_follow(frame, contact, member, memory);
    return is_end(member) ? member : pm_curve_feet_node(frame, curve_of(frame->model, contact), memory->foot);
}

int pm_contact_curve_outcome(const pm_model *m, int contact, int member)
{
    if (pm_contact_pair_is(m, contact)) return pm_contact_pair_corner(member);
    return is_end(member) ? member : 0;
}

/* ---- ends ---- */
/* How far the centre is beyond an end, along its tangent. */
static double beyond_end(const pm_frame *frame, int contact, int member)
{
    const pm_curve_node *at = &frame->numbers->course[curve_of(frame->model, contact)].node[end_node(member)];
    double x[2];
    centre_of(frame, contact, x);
    const double d[2] = {x[0] - at->p[0], x[1] - at->p[1]}, along = pm_dot(d, at->t);
    return member == PM_CURVE_FROM_END ? -along : along;
}

int pm_contact_curve_on(const pm_frame *frame, int slot, int member, pm_constraint *normal)
{
    const pm_model *m = frame->model;
    const int contact = pm_contact_of_slot(m, slot);
    if (!pm_contact_curve_is(m, contact) || (!pm_contact_pair_is(m, contact) && is_end(member))) return 0;
    pm_contact_constraint_normal(frame, contact, slot, member, normal);
    normal->foot = m->nmemory - m->nslot + slot;
    return 1;
}

double pm_contact_curve_room(const pm_frame *frame, int slot, int member)
{
    pm_constraint normal;
    const int contact = pm_contact_of_slot(frame->model, slot),
              on = pm_contact_curve_on(frame, slot, member, &normal);
    if (pm_contact_pair_is(frame->model, contact))
        return pm_contact_pair_room(frame, &normal, contact, member);
    return on ? pm_constraint_curve_room(frame, &normal) + reach_of(frame, contact)
              : beyond_end(frame, contact, member);
}

int pm_contact_curve_is_at_knot(const pm_frame *frame, int slot, int member)
{
    pm_constraint normal;
    const int contact = pm_contact_of_slot(frame->model, slot);
    if (!pm_contact_curve_on(frame, slot, member, &normal)) return 0;
    if (pm_contact_pair_is(frame->model, contact) &&
        !pm_contact_pair_is_at_foot(frame, &normal, contact, member))
        return 0;
    return pm_curve_has_pieces(frame->model, normal.curve) &&
           !pm_curve_piece_is_last(frame, normal.curve, pm_constraint_curve_foot(frame, &normal));
}

int pm_contact_curve_next(const pm_frame *frame, int slot, int member)
{
    const int contact = pm_contact_of_slot(frame->model, slot);
    pm_constraint normal;
    if (pm_contact_pair_is(frame->model, contact) && pm_contact_curve_on(frame, slot, member, &normal))
        return pm_contact_pair_next(frame, &normal, contact, member);
    if (is_end(member)) return end_node(member);
    if (!(radius_of(frame, contact) > 0)) return PM_NONE;
    return member < PM_CURVE_NODES / 2 ? PM_CURVE_FROM_END : PM_CURVE_TO_END;
}
