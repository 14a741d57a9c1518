/* edge.c - a circle (or a point: radius 0) beside a straight edge that ends.
 *
 * Along the edge s, from its front h, beyond its nearer end by o > 0 (o < 0: within), R the radius:
 *   beyond    in front   sqrt(o^2 + h^2) - R, the gap to the corner;   behind it no more than o
 *   within    h - R, but on the back, where nothing touches, not below o
 * so that it is continuous where nothing overlaps, and falls through zero also where a mark passes under an end: that is
 * no contact (pm_edge_touches).  As long as a mark is below the face what is watched is
 *   beyond    sqrt(o^2 + h^2) - R           within    R - h
 * which falls through zero where it touches a corner, where it comes through the face, or comes over it from beyond.
 * The corner of a body that lies in part behind the face goes over an end (goes_over_end).  Once it is there it touches nothing
 * before it has gone further in: what is watched is the gap to an edge that ends so much sooner (pm_edge_gap_over_end).
 * A corner is a circle of radius 0: where a circle goes over to it from the face both
 * have the same normal.
 *
 * Edges of one body that meet share a corner.  It belongs to the contact that the circle comes from, as long as that is
 * closed; where the circle comes to the face of the other edge this one takes over. */
#include "elements/edge.h"

#include <math.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "numerics/lanes.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

int pm_edge_is(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND] == PM_CONTACT_SEGMENT;
}

static double end_of(const pm_frame *frame, int contact, int column)
{
    return frame->numbers->value[PM_CONTACT_ROW(frame->model, contact)[column]];
}

pm_edge_place pm_edge_beside(const pm_frame *frame, int contact)
{
    const pm_model *m = frame->model;
    const int32_t *e = PM_CONTACT_ROW(m, contact);
    const int32_t *circle = PM_CIRCLE_ROW(m, e[PM_CONTACT_A]), *line = PM_LINE_ROW(m, e[PM_CONTACT_B]);
    const pm_point a = pm_frame_point_of(frame, circle[PM_CIRCLE_POINT]),
                   b = pm_frame_point_of(frame, line[PM_LINE_POINT]);
    const double angle = frame->pose[5 * b.body + 2] + frame->numbers->value[line[PM_LINE_ANGLE]];
    const double d[2] = {a.p[0] - b.p[0], a.p[1] - b.p[1]};
    double t[2];
    pm_lanes_store(t, pm_lanes_axis(angle));
    const double along = pm_dot(d, t), reach = pm_contact_end(frame, a.p);
    return (pm_edge_place){.height = pm_cross(t, d),
                           .radius = frame->numbers->value[circle[PM_CIRCLE_RADIUS]],
                           .from = end_of(frame, contact, PM_CONTACT_FROM) - along - reach,
                           .to = along - end_of(frame, contact, PM_CONTACT_TO) - reach,
                           .along = {t[0], t[1]}};
}

static double gap_beyond(const pm_edge_place *x, double beyond)
{
    if (beyond <= 0) return fmax(x->height - x->radius, beyond);
    const double gap = hypot(beyond, x->height) - x->radius;
    return x->height < 0 ? fmin(gap, beyond) : gap;
}

double pm_edge_gap(const pm_frame *frame, int contact, int *member)
{
    const pm_edge_place x = pm_edge_beside(frame, contact);
    const double beyond = fmax(x.from, x.to);
    *member = PM_SEGMENT_FACE;
    if (beyond > 0 && x.radius > 0) *member = x.from > x.to ? PM_SEGMENT_FROM : PM_SEGMENT_TO;
    return gap_beyond(&x, beyond);
}

double pm_edge_gap_rate(const pm_frame *frame, int contact)
{
    const pm_model *m = frame->model;
    const int32_t *e = PM_CONTACT_ROW(m, contact);
    const pm_edge_place x = pm_edge_beside(frame, contact);
    const pm_point a = pm_frame_point_of(frame, PM_CIRCLE_ROW(m, e[PM_CONTACT_A])[PM_CIRCLE_POINT]),
                   b = pm_frame_point_of(frame, PM_LINE_ROW(m, e[PM_CONTACT_B])[PM_LINE_POINT]);
    const double d[2] = {a.p[0] - b.p[0], a.p[1] - b.p[1]}, turns = frame->velocity[3 * b.body + 2],
                 v[2] = {a.v[0] - b.v[0] + turns * d[1],
                         a.v[1] - b.v[1] - turns * d[0]}; /* as the edge sees it */
    const double rise = pm_cross(x.along, v), beyond = fmax(x.from, x.to),
                 out = (x.to > x.from ? 1 : -1) * pm_dot(x.along, v);
    if (beyond <= 0) return x.height - x.radius >= beyond ? rise : out;
    const double off = hypot(beyond, x.height);
    return x.height < 0 && beyond < off - x.radius ? out : (beyond * out + x.height * rise) / off;
}

int pm_edge_is_below(const pm_frame *frame, int contact)
{
    const pm_edge_place x = pm_edge_beside(frame, contact);
    return x.height < x.radius - PM_EDGE_SUNK * pm_contact_length(frame);
}

double pm_edge_gap_from_below(const pm_frame *frame, int contact)
{
    const pm_edge_place x = pm_edge_beside(frame, contact);
    const double beyond = fmax(x.from, x.to);
    return beyond > 0 ? hypot(beyond, x.height) - x.radius : x.radius - x.height;
}

void pm_edge_corner(const pm_frame *frame, int contact, int member, double at[2])
{
    const pm_model *m = frame->model;
    const int32_t *line = PM_LINE_ROW(m, PM_CONTACT_ROW(m, contact)[PM_CONTACT_B]);
    const int32_t *point = PM_POINT_ROW(m, line[PM_LINE_POINT]);
    const double angle = frame->numbers->value[line[PM_LINE_ANGLE]];
    const double along = end_of(frame, contact, member == PM_SEGMENT_FROM ? PM_CONTACT_FROM : PM_CONTACT_TO);
    at[0] = frame->numbers->value[point[PM_POINT_X]] + along * cos(angle);
    at[1] = frame->numbers->value[point[PM_POINT_Y]] + along * sin(angle);
}

/* ---- corners that meet ---- */
/* The direction from a corner of a body along its edge, in the axes of the body, where `contact` has this edge and the corner is
 * an end of it. */
static int goes_from(const pm_frame *frame, int contact, const int32_t *corner, double direction[2])
{
    const pm_model *m = frame->model;
    const int32_t *line = PM_LINE_ROW(m, PM_CONTACT_ROW(m, contact)[PM_CONTACT_B]);
    if (PM_POINT_ROW(m, line[PM_LINE_POINT])[PM_POINT_BODY] != corner[PM_POINT_BODY]) return 0;
    const double angle = frame->numbers->value[line[PM_LINE_ANGLE]];
    for (int end = PM_SEGMENT_FROM; end <= PM_SEGMENT_TO; end++) {
        double at[2];
        pm_edge_corner(frame, contact, end, at);
        const double off = hypot(at[0] - frame->numbers->value[corner[PM_POINT_X]],
                                 at[1] - frame->numbers->value[corner[PM_POINT_Y]]);
        if (off > pm_contact_length(frame)) continue;
        const int way = end == PM_SEGMENT_FROM ? 1 : -1;
        direction[0] = way * cos(angle);
        direction[1] = way * sin(angle);
        return 1;
    }
    return 0;
}

/* At an end of the edge: the point is the corner of a body that lies in part behind the face.  It goes over the end: two boxes
 * that slide on each other do not catch where their corners pass. */
static int goes_over_end(const pm_frame *frame, int contact, const pm_edge_place *x)
{
    const pm_model *m = frame->model;
    const int32_t *corner =
        PM_POINT_ROW(m, PM_CIRCLE_ROW(m, PM_CONTACT_ROW(m, contact)[PM_CONTACT_A])[PM_CIRCLE_POINT]);
    if (x->radius > 0 || fmax(x->from, x->to) < -PM_EDGE_HANDING_OVER * pm_contact_length(frame)) return 0;
    const double *pose = frame->pose + 5 * pm_model_body_index(m, corner[PM_POINT_BODY]);
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) {
        double d[2];
        if (!pm_edge_is(m, i) || !goes_from(frame, i, corner, d)) continue;
        const double along[2] = {pose[3] * d[0] - pose[4] * d[1], pose[4] * d[0] + pose[3] * d[1]};
        if (pm_cross(x->along, along) < -PM_EDGE_BEHIND) return 1;
    }
    return 0;
}

int pm_edge_is_over_end(const pm_frame *frame, int contact)
{
    const pm_edge_place x = pm_edge_beside(frame, contact);
    return gap_beyond(&x, fmax(x.from, x.to)) <= pm_contact_length(frame) &&
           goes_over_end(frame, contact, &x);
}

double pm_edge_gap_over_end(const pm_frame *frame, int contact)
{
    const pm_edge_place x = pm_edge_beside(frame, contact);
    const double beyond = fmax(x.from, x.to);
    const int over = goes_over_end(frame, contact, &x);
    return gap_beyond(&x, over ? beyond + PM_EDGE_HANDING_OVER * pm_contact_length(frame) : beyond);
}

int pm_edge_touches(const pm_frame *frame, int contact)
{
    const pm_edge_place x = pm_edge_beside(frame, contact);
    const double beyond = fmax(x.from, x.to), length = pm_contact_length(frame);
    if (goes_over_end(frame, contact, &x)) return 0;
    if (beyond > 0) return hypot(beyond, x.height) - x.radius <= length;
    return x.height >= -PM_EDGE_SUNK * length && x.height - x.radius <= length;
}

/* ---- edges that meet ---- */
static int same_circle(const pm_frame *frame, int contact, int other)
{
    const pm_model *m = frame->model;
    const int32_t *a = PM_CIRCLE_ROW(m, PM_CONTACT_ROW(m, contact)[PM_CONTACT_A]),
                  *b = PM_CIRCLE_ROW(m, PM_CONTACT_ROW(m, other)[PM_CONTACT_A]);
    const int32_t *p = PM_POINT_ROW(m, a[PM_CIRCLE_POINT]), *q = PM_POINT_ROW(m, b[PM_CIRCLE_POINT]);
    return p[PM_POINT_BODY] == q[PM_POINT_BODY] &&
           frame->numbers->value[p[PM_POINT_X]] == frame->numbers->value[q[PM_POINT_X]] &&
           frame->numbers->value[p[PM_POINT_Y]] == frame->numbers->value[q[PM_POINT_Y]] &&
           frame->numbers->value[a[PM_CIRCLE_RADIUS]] == frame->numbers->value[b[PM_CIRCLE_RADIUS]];
}

static int body_of_edge(const pm_model *m, int contact)
{
    const int point = PM_LINE_ROW(m, PM_CONTACT_ROW(m, contact)[PM_CONTACT_B])[PM_LINE_POINT];
    return PM_POINT_ROW(m, point)[PM_POINT_BODY];
}

/* The end of `other` that is the corner `member` of `contact`, with the same circle beside both; PM_NONE: none is. */
static int shared_corner(const pm_frame *frame, const pm_state *state, int contact, int member, int other)
{
    if (other == contact || pm_state_is_absent(frame->model, state, PM_TABLE_CONTACT, other) ||
        !pm_edge_is(frame->model, other) || !same_circle(frame, contact, other) ||
        body_of_edge(frame->model, contact) != body_of_edge(frame->model, other))
        return PM_NONE;
    double at[2], there[2];
    pm_edge_corner(frame, contact, member, at);
    for (int end = PM_SEGMENT_FROM; end <= PM_SEGMENT_TO; end++) {
        pm_edge_corner(frame, other, end, there);
        if (hypot(at[0] - there[0], at[1] - there[1]) <= pm_contact_length(frame)) return end;
    }
    return PM_NONE;
}

int pm_edge_meets_another(const pm_frame *frame, const pm_state *state, int contact)
{
    for (int i = 0; i < frame->model->rows[PM_TABLE_CONTACT]; i++)
        for (int end = PM_SEGMENT_FROM; end <= PM_SEGMENT_TO; end++)
            if (shared_corner(frame, state, contact, end, i) != PM_NONE) return 1;
    return 0;
}

static double beyond_end(const pm_edge_place *x, int end) { return end == PM_SEGMENT_FROM ? x->from : x->to; }

/* How far beyond their shared corner the circle is from the face of an edge that meets `contact` there; *heir: which. */
static double room_to_next_edge(const pm_frame *frame, const pm_state *state, int contact, int member,
                                int *heir)
{
    double room = INFINITY;
    *heir = PM_NONE;
    for (int i = 0; i < frame->model->rows[PM_TABLE_CONTACT]; i++) {
        const int end = shared_corner(frame, state, contact, member, i);
        if (end == PM_NONE) continue;
        const pm_edge_place x = pm_edge_beside(frame, i);
        if (x.height <= 0 || beyond_end(&x, end) >= room) continue;
        room = beyond_end(&x, end);
        *heir = i;
    }
    return room;
}

int pm_edge_is_covered(const pm_frame *frame, const pm_state *s, int contact)
{
    const pm_model *m = frame->model;
    int nearest;
    pm_edge_gap(frame, contact, &nearest);
    const pm_edge_place x = pm_edge_beside(frame, contact);
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT] && m->nedge > 1; i++) {
        const pm_slot *slot = &s->slot[m->contact_slot[i]];
        if (slot->mode == PM_OPEN || !pm_edge_is(m, i)) continue;
        for (int end = PM_SEGMENT_FROM; end <= PM_SEGMENT_TO; end++) {
            const int begins = nearest == PM_SEGMENT_FACE &&
                               beyond_end(&x, end) > -PM_EDGE_HANDING_OVER * pm_contact_length(frame);
            if ((nearest == end || begins) && shared_corner(frame, s, contact, end, i) != PM_NONE) return 1;
        }
    }
    return 0;
}

double pm_edge_room(const pm_frame *frame, const pm_state *state, int contact, int member)
{
    const pm_edge_place x = pm_edge_beside(frame, contact);
    if (member == PM_SEGMENT_FACE) return -fmax(x.from, x.to);
    int heir;
    return fmin(beyond_end(&x, member) + pm_contact_length(frame),
                room_to_next_edge(frame, state, contact, member, &heir));
}

int pm_edge_next(const pm_frame *frame, const pm_state *state, int contact, int member, int *heir)
{
    *heir = PM_NONE;
    const pm_edge_place x = pm_edge_beside(frame, contact);
    if (!(x.radius > 0)) return PM_NONE;
    const int corner = member != PM_SEGMENT_FACE ? member : x.from > x.to ? PM_SEGMENT_FROM : PM_SEGMENT_TO;
    const double back = beyond_end(&x, corner) + pm_contact_length(frame);
    int next;
    const double on = room_to_next_edge(frame, state, contact, corner, &next);
    if (member == PM_SEGMENT_FACE && on > 0) return corner;
    if (member != PM_SEGMENT_FACE && back < on) return PM_SEGMENT_FACE;
    *heir = next;
    return PM_NONE;
}

int pm_edge_way(const pm_model *m, int contact, int member)
{
    return pm_edge_is(m, contact) && member != PM_SEGMENT_FACE ? -1 : 1;
}
