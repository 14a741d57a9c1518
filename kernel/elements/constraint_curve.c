/* constraint_curve.c - a circle (or a point: radius 0) and a curve of another body.
 *
 * At the foot of the circle's centre on the curve (curve.h), with its t and n = k x t in the scene, its height h and the
 * curvature b there; d = p_a - p_b, p_b the point from which the curve is drawn, u = v_a - v_b, w = omega_b, R the radius.
 * As an observer on b sees it the centre moves at  along = u.t + w d.n  and  across = u.n - w d.t, the foot at along / (1 - b h).
 * The height is the distance from the curve, whose gradient is n and whose second derivative is -b / (1 - b h) along t:
 *   normal    C = h - R     Cdot = across     gamma = -(quad.n - 2 w u.t - w^2 d.n) + b along^2 / (1 - b h)
 * which is constraint_line.c's with the curvature more: where the curve is hollow (b > 0) the point is pressed to it.
 * As the foot goes on the circle rolls: without slip the length L along the curve and the angle f that t turns by obey
 *   tangent   C = L - R f + R (angle_a - angle_b) - anchor            L' = along / (1 - b h),  f' = b L'
 *             Cdot = e along + R (omega_a - w),  e = (1 - b R) / (1 - b h)
 *             gamma = -(e' along + e (quad.t + 2 w u.n - w^2 d.t + f' across))
 * e is 1 where they touch, and Cdot their slip.
 *
 * The foot is the one that the constraint remembers, followed from there: a curve may cross itself.  That of a curve by points
 * is on the piece of what is remembered (curve_piece.h). */
#include <math.h>

#include "elements/constraint.h"
#include "elements/curve.h"
#include "elements/curve_piece.h"
#include "elements/pair.h"
#include "state/workspace.h"

/* The foot, its axes in the scene, and what an observer on the curve sees. */
typedef struct pm_curve_look {
    pm_curve_place foot;
    double height, t[2], n[2], along;
} pm_curve_look;

static void into_scene(const double *pose, const double a[2], double out[2])
{
    out[0] = pose[3] * a[0] - pose[4] * a[1];
    out[1] = pose[4] * a[0] + pose[3] * a[1];
}

/* d in the axes of the curve. */
static void into_axes(const double *pose, const double d[2], double x[2])
{
    x[0] = pose[3] * d[0] + pose[4] * d[1];
    x[1] = -pose[4] * d[0] + pose[3] * d[1];
}

/* Where the search for the foot begins. */
static double begin_of(const pm_frame *frame, const pm_constraint *c)
{
    return c->foot == PM_NONE ? c->near[0] : frame->memory[c->foot].foot;
}

/* On the piece that is followed, or without a memory wherever it is near there. */
static pm_curve_place foot_of(const pm_frame *frame, const pm_constraint *c, const double x[2],
                              double *height)
{
    const double begin = begin_of(frame, c);
    return c->foot == PM_NONE ? pm_curve_foot(frame, c->curve, x, begin, height)
                              : pm_curve_foot_along(frame, c->curve, x, begin, height);
}

static pm_curve_look look_from(const pm_frame *frame, const pm_constraint *c, const pm_marks *m, int anywhere)
{
    const double *pose = frame->pose + 5 * c->body[1];
    double x[2];
    pm_curve_look l;
    into_axes(pose, m->d, x);
    l.foot = anywhere ? pm_curve_nearest(frame, c->curve, x, &l.height) : foot_of(frame, c, x, &l.height);
    into_scene(pose, l.foot.t, l.t);
    into_scene(pose, l.foot.n, l.n);
    l.along = pm_dot(m->u, l.t) + m->omega_b * pm_dot(m->d, l.n);
    return l;
}

static pm_curve_look look(const pm_frame *frame, const pm_constraint *c, const pm_marks *m)
{
    return look_from(frame, c, m, 0);
}

static void evaluate_normal(const pm_frame *frame, pm_constraint *c)
{
    const pm_marks m = pm_constraint_marks(frame, c);
    const pm_curve_look l = look(frame, c, &m);
    const double w = m.omega_b, slope = 1 - l.foot.bend * l.height;
    pm_constraint_along(c->j, &m, l.n, 1);
    c->j[5] -= pm_dot(m.d, l.t);
    c->g = l.height - c->radius_a;
    c->gamma = -(pm_dot(m.quad, l.n) - 2 * w * pm_dot(m.u, l.t) - w * w * pm_dot(m.d, l.n)) +
               l.foot.bend * l.along * l.along / slope;
}

/* What the circle has rolled from the place `from` of the curve, but for its own rotation. */
static double rolled_from(const pm_frame *frame, const pm_constraint *c, double from,
                          const pm_curve_place *to)
{
    const double of = c->foot == PM_NONE ? from : begin_of(frame, c);
    const pm_curve_place x = pm_curve_along(frame, c->curve, from, of);
    const double turned = atan2(pm_cross(x.t, to->t), pm_dot(x.t, to->t));
    return pm_curve_way(frame, c->curve, from, to->s, of) - c->radius_a * turned;
}

static double rotated(const pm_frame *frame, const pm_constraint *c)
{
    return c->radius_a * (frame->pose[5 * c->body[0] + 2] - frame->pose[5 * c->body[1] + 2]);
}

static void evaluate_tangent(const pm_frame *frame, pm_constraint *c)
{
    const pm_marks m = pm_constraint_marks(frame, c);
    const pm_curve_look l = look(frame, c, &m);
    const pm_memory *memory = &frame->memory[c->memory];
    const double w = m.omega_b, b = l.foot.bend, slope = 1 - b * l.height, own = 1 - b * c->radius_a;
    const double e = own / slope, way = l.along / slope, across = pm_dot(m.u, l.n) - w * pm_dot(m.d, l.t);
    const double bends = l.foot.bend_rate * way;
    const double e_rate =
        (-bends * c->radius_a * slope + own * (bends * l.height + b * across)) / (slope * slope);
    pm_constraint_along(c->j, &m, l.t, e);
    c->j[2] += c->radius_a;
    c->j[5] += e * pm_dot(m.d, l.n) - c->radius_a;
    c->g = rolled_from(frame, c, memory->direction, &l.foot) + rotated(frame, c) - memory->anchor;
    c->gamma = -(e_rate * l.along + e * (pm_dot(m.quad, l.t) + 2 * w * pm_dot(m.u, l.n) -
                                         w * w * pm_dot(m.d, l.t) + b * way * across));
}

/* The memory has the place up to which what has been rolled is part of the anchor. */
static void remember_tangent(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    const pm_marks m = pm_constraint_marks(frame, c);
    const pm_curve_place foot = look(frame, c, &m).foot;
    if (anchor_too)
        memory->anchor = rotated(frame, c);
    else
        memory->anchor -= rolled_from(frame, c, memory->direction, &foot);
    memory->direction = foot.s;
}

/* anchor_too: the foot is found anew, wherever it is. */
static void remember_foot(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    const pm_marks m = pm_constraint_marks(frame, c);
    const double s = look_from(frame, c, &m, anchor_too).foot.s;
    memory->foot = pm_curve_piece_within(frame, c->curve, s, anchor_too ? s : begin_of(frame, c));
}

static void act_along(const pm_frame *frame, const pm_constraint *c, int across, pm_line_of_action *x)
{
    const pm_marks m = pm_constraint_marks(frame, c);
    const pm_curve_look l = look(frame, c, &m);
    *x = (pm_line_of_action){.couple = {0, 0}};
    for (int k = 0; k < 2; k++) {
        x->at[k] = m.a.p[k] - c->radius_a * l.n[k];
        x->direction[k] = across ? l.n[k] : l.t[k];
    }
}

static void act_normal(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    act_along(frame, c, 1, x);
}

static void act_tangent(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    act_along(frame, c, 0, x);
}

/* The foot of the one, or where the other curve faces it. */
static pm_curve_place place_on(const pm_frame *frame, const pm_constraint *c)
{
    const pm_marks m = pm_constraint_marks(frame, c);
    return c->other == PM_NONE ? look(frame, c, &m).foot : pm_constraint_pair_places(frame, c).b;
}

double pm_constraint_curve_foot(const pm_frame *frame, const pm_constraint *c)
{
    return place_on(frame, c).s;
}

void pm_constraint_curve_find(const pm_frame *frame, const pm_constraint *c, pm_memory *memory)
{
    memory->foot = pm_constraint_curve_foot(frame, c);
    if (c->other != PM_NONE) memory->other[0] = pm_constraint_pair_places(frame, c).a.s;
}

double pm_constraint_curve_room(const pm_frame *frame, const pm_constraint *c)
{
    const pm_curve_place foot = place_on(frame, c);
    return pm_curve_has_pieces(frame->model, c->curve)
               ? pm_curve_piece_room(frame, c->curve, &foot, begin_of(frame, c))
               : pm_curve_room(frame, c->curve, &foot);
}

void pm_constraint_curve_go_on(const pm_frame *frame, const pm_constraint *c, double way, double nothing,
                               pm_memory *memory)
{
    const double s = pm_constraint_curve_foot(frame, c);
    memory->foot = pm_curve_piece_ahead(frame, c->curve, s, way, nothing);
}

const pm_constraint_ops pm_constraint_curve_normal = {
    .evaluate = evaluate_normal, .act = act_normal, .remember = remember_foot};
const pm_constraint_ops pm_constraint_curve_tangent = {
    .evaluate = evaluate_tangent, .act = act_tangent, .remember = remember_tangent};
