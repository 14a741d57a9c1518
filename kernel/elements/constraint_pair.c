/* constraint_pair.c - two curves of two bodies that touch.
 *
 * At the places of both that face each other (pair.h), with the height h of p_a over p_b on n = n_b, t = t_b, t_a = -t, D the
 * curvature of one against the other, u = v_a - v_b the velocities of the bodies there, w = omega_b, W = omega_a - w: as the
 * places go on by s_a' and s_b' along their own tangents,
 *   s_a' + (1 - h b_b) s_b' = T = u.t + h w       b_a s_a' - b_b s_b' = -W
 *   s_b' = (b_a T + W) / D,  s_a' = (b_b T - (1 - h b_b) W) / D,  n' = -f t,  t' = f n,  f = w + b_b s_b'
 *   normal    C = h       Cdot = u.n      gamma = -(quad.n - omega_a s_a' - w s_b' - f u.t)
 * Where they touch without slip both go on by the same length:
 *   tangent   C = L_a + L_b - anchor      Cdot = e T + m W,  e = (b_a + b_b) / D,  m = h b_b / D,  e = 1 and m = 0 at h = 0
 *             gamma = -(e' T + e T' + m' W),  T' = quad.t + u.n (f + w)
 * with b_a' and b_b' their rates along the curves times s_a' and s_b', h' = u.n. */
#include <math.h>

#include "elements/constraint.h"
#include "elements/curve.h"
#include "elements/curve_piece.h"
#include "elements/pair.h"
#include "state/workspace.h"

/* Both places, and the axes of the second in the scene. */
typedef struct pm_pair_look {
    pm_pair_place at;
    double t[2], n[2];
    double u[2], quad[2]; /* of the bodies where they are, a from b; of accelerations what velocities make */
    double r[2][2];       /* the places from their mass centres, in the scene */
    double omega[2], along, ways[2], turning;
} pm_pair_look;

static void into_scene(const double *pose, const double a[2], double out[2])
{
    out[0] = pose[3] * a[0] - pose[4] * a[1];
    out[1] = pose[4] * a[0] + pose[3] * a[1];
}

static pm_pair_place meet(const pm_frame *frame, const pm_constraint *c, const pm_pair *x)
{
    if (c->foot == PM_NONE) return pm_pair_meet(x, c->near[1], c->near[0], NAN);
    const pm_memory *memory = &frame->memory[c->foot];
    return pm_pair_meet(x, memory->other[0], memory->foot, memory->foot);
}

/* What the bodies do there. */
static void move(const pm_frame *frame, const pm_constraint *c, pm_pair_look *l)
{
    const double *pose = frame->pose + 5 * c->body[1];
    double place[2][2], v[2][2];
    into_scene(pose, l->at.b.p, place[1]);
    for (int k = 0; k < 2; k++) {
        const pm_point b = pm_frame_point(frame, c->body[1], c->b[0], c->b[1]);
        place[1][k] += b.p[k];
        place[0][k] = place[1][k] + l->at.height * l->n[k];
    }
    for (int i = 0; i < 2; i++) {
        const double *of = frame->pose + 5 * c->body[i], *rate = frame->velocity + 3 * c->body[i];
        l->omega[i] = rate[2];
        for (int k = 0; k < 2; k++) l->r[i][k] = place[i][k] - of[k];
        v[i][0] = rate[0] - rate[2] * l->r[i][1];
        v[i][1] = rate[1] + rate[2] * l->r[i][0];
    }
    for (int k = 0; k < 2; k++) {
        l->u[k] = v[0][k] - v[1][k];
        l->quad[k] = -l->omega[0] * l->omega[0] * l->r[0][k] + l->omega[1] * l->omega[1] * l->r[1][k];
    }
}

static pm_pair_look look_at(const pm_frame *frame, const pm_constraint *c, const pm_pair_place *at)
{
    const double *pose = frame->pose + 5 * c->body[1];
    pm_pair_look l = {.at = *at};
    into_scene(pose, at->b.t, l.t);
    into_scene(pose, at->b.n, l.n);
    move(frame, c, &l);
    const double a = at->a.bend, b = at->b.bend, h = at->height, turns = l.omega[0] - l.omega[1];
    l.along = pm_dot(l.u, l.t) + h * l.omega[1];
    l.ways[0] = (b * l.along - (1 - h * b) * turns) / at->closer;
    l.ways[1] = (a * l.along + turns) / at->closer;
    l.turning = l.omega[1] + b * l.ways[1];
    return l;
}

static pm_pair_look look(const pm_frame *frame, const pm_constraint *c)
{
    const pm_pair x = pm_pair_of(frame, c);
    const pm_pair_place at = meet(frame, c, &x);
    return look_at(frame, c, &at);
}

/* Of a velocity along `direction` where both are. */
static void along(const pm_pair_look *l, const double direction[2], double factor, double j[6])
{
    for (int i = 0; i < 2; i++) {
        const double sign = i == 0 ? factor : -factor;
        for (int k = 0; k < 2; k++) j[3 * i + k] = sign * direction[k];
        j[3 * i + 2] = sign * pm_cross(l->r[i], direction);
    }
}

static void evaluate_normal(const pm_frame *frame, pm_constraint *c)
{
    const pm_pair_look l = look(frame, c);
    along(&l, l.n, 1, c->j);
    c->g = l.at.height;
    c->gamma = -(pm_dot(l.quad, l.n) - l.omega[0] * l.ways[0] - l.omega[1] * l.ways[1] -
                 l.turning * pm_dot(l.u, l.t));
}

/* ---- without slip ---- */
static double rolled_from(const pm_frame *frame, const pm_constraint *c, double a, double b,
                          const pm_pair_place *to)
{
    const double of = c->foot == PM_NONE ? b : frame->memory[c->foot].foot;
    return pm_curve_way(frame, c->other, a, to->a.s, a) + pm_curve_way(frame, c->curve, b, to->b.s, of);
}

static void evaluate_tangent(const pm_frame *frame, pm_constraint *c)
{
    const pm_pair_look l = look(frame, c);
    const pm_memory *memory = &frame->memory[c->memory];
    const double a = l.at.a.bend, b = l.at.b.bend, h = l.at.height, d = l.at.closer;
    const double a_rate = l.at.a.bend_rate * l.ways[0], b_rate = l.at.b.bend_rate * l.ways[1];
    const double rises = pm_dot(l.u, l.n), turns = l.omega[0] - l.omega[1];
    const double d_rate = a_rate + b_rate - rises * a * b - h * (a_rate * b + a * b_rate);
    const double e = (a + b) / d, m = h * b / d;
    const double e_rate = (a_rate + b_rate) / d - e * d_rate / d,
                 m_rate = (rises * b + h * b_rate) / d - m * d_rate / d;
    const double along_rate = pm_dot(l.quad, l.t) + rises * (l.turning + l.omega[1]);
    along(&l, l.t, e, c->j);
    c->j[2] += m;
    c->j[5] += e * h - m;
    c->g = rolled_from(frame, c, memory->other[1], memory->direction, &l.at) - memory->anchor;
    c->gamma = -(e_rate * l.along + e * along_rate + m_rate * turns);
}

static void remember_tangent(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    const pm_pair x = pm_pair_of(frame, c);
    const pm_pair_place at = meet(frame, c, &x);
    memory->anchor =
        anchor_too ? 0 : memory->anchor - rolled_from(frame, c, memory->other[1], memory->direction, &at);
    memory->direction = at.b.s;
    memory->other[1] = at.a.s;
}

/* ---- the places ---- */
static pm_pair_place nearest(const pm_frame *frame, const pm_constraint *c, const pm_pair *x)
{
    const pm_pair_closed none = {.feet = {.n = 0}};
    pm_pair_near near;
    return pm_pair_nearest(x, &none, &near) ? near.at : meet(frame, c, x);
}

/* anchor_too: they are found anew, wherever they are. */
static void remember_feet(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    const pm_pair x = pm_pair_of(frame, c);
    const pm_pair_place at = anchor_too ? nearest(frame, c, &x) : meet(frame, c, &x);
    memory->other[0] = at.a.s;
    memory->foot = pm_curve_piece_within(frame, c->curve, at.b.s, anchor_too ? at.b.s : memory->foot);
}

pm_pair_place pm_constraint_pair_places(const pm_frame *frame, const pm_constraint *c)
{
    const pm_pair x = pm_pair_of(frame, c);
    return meet(frame, c, &x);
}

/* ---- where they act ---- */
static void act_along(const pm_frame *frame, const pm_constraint *c, int across, pm_line_of_action *x)
{
    const pm_pair_look l = look(frame, c);
    const double *pose = frame->pose + 5 * c->body[0];
    *x = (pm_line_of_action){.couple = {0, 0}};
    for (int k = 0; k < 2; k++) {
        x->at[k] = pose[k] + l.r[0][k];
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

const pm_constraint_ops pm_constraint_pair_normal = {
    .evaluate = evaluate_normal, .act = act_normal, .remember = remember_feet};
const pm_constraint_ops pm_constraint_pair_tangent = {
    .evaluate = evaluate_tangent, .act = act_tangent, .remember = remember_tangent};
