/* uniform_edge.c - edges that end, in a phase with constant accelerations.
 *
 * Where an edge keeps its direction and the centre of a circle goes along a parabola seen from it, its height h over the
 * edge and how far it is beyond either end, o, are parabolas of the time, and
 *   the face is struck where h - R falls through zero while o <= 0 at both ends,
 *   a corner where o^2 + h^2 - R^2 does, a quartic, while o > 0,
 *   what touches the face comes to its end where o rises through zero.
 * So all that an edge can do in the phase is known when it begins.  Roots of polynomials are distinguished by those of
 * their derivatives: between two of these they are monotonic. */
#include <math.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/edge.h"
#include "numerics/tolerances.h"
#include "routes/uniform/uniform.h"
#include "state/frame.h"
#include "state/workspace.h"

#define MOST_DEGREE 4
#define SIDES 2

/* c[0] + c[1] t + .. + c[n] t^n */
typedef struct pm_poly {
    int n;
    double c[MOST_DEGREE + 1];
} pm_poly;

static double value_of(const pm_poly *p, double t)
{
    double sum = 0;
    for (int i = p->n; i >= 0; i--) sum = sum * t + p->c[i];
    return sum;
}

static pm_poly derivative_of(const pm_poly *p)
{
    pm_poly d = {.n = p->n > 0 ? p->n - 1 : 0};
    for (int i = 1; i <= p->n; i++) d.c[i - 1] = i * p->c[i];
    return d;
}

static pm_poly square_of(const pm_poly *p)
{
    pm_poly s = {.n = 2 * p->n};
    for (int i = 0; i <= p->n; i++)
        for (int k = 0; k <= p->n; k++) s.c[i + k] += p->c[i] * p->c[k];
    return s;
}

/* No root is farther from zero (Cauchy). */
static double farthest_root(const pm_poly *p)
{
    double most = 0;
    for (int i = 0; i < p->n; i++) most = fmax(most, fabs(p->c[i] / p->c[p->n]));
    return 1 + most;
}

/* Where p changes its sign between a and b. */
static double root_between(const pm_poly *p, double a, double b)
{
    const int rises = value_of(p, b) > 0;
    for (int i = 0; i < PM_UNIFORM_HALVINGS; i++) {
        const double middle = a + 0.5 * (b - a);
        if (middle <= a || middle >= b) break;
        if ((value_of(p, middle) > 0) == rises)
            b = middle;
        else
            a = middle;
    }
    return b;
}

/* The places t > 0 where p changes its sign, in order; how many. */
static int roots_of(pm_poly p, double root[MOST_DEGREE])
{
    while (p.n > 0 && p.c[p.n] == 0) p.n--;
    if (p.n == 0) return 0;
    double top[MOST_DEGREE];
    const pm_poly slope = derivative_of(&p);
    int ntop = roots_of(slope, top), n = 0;
    const double end = farthest_root(&p);
    double from = 0;
    for (int i = 0; i <= ntop; i++) {
        const double to = i < ntop ? top[i] : fmax(end, from);
        if (to > from && (value_of(&p, from) > 0) != (value_of(&p, to) > 0))
            root[n++] = root_between(&p, from, to);
        from = to;
    }
    return n;
}

/* What the frame sees at the begin of the phase: height less radius, and how far beyond each end. */
typedef struct pm_edge_motion {
    double radius;
    pm_poly height, beyond[SIDES];
} pm_edge_motion;

static void bodies_of(const pm_model *m, int contact, int point[2], int body[2])
{
    const int32_t *e = PM_CONTACT_ROW(m, contact);
    point[0] = PM_CIRCLE_ROW(m, e[PM_CONTACT_A])[PM_CIRCLE_POINT];
    point[1] = PM_LINE_ROW(m, e[PM_CONTACT_B])[PM_LINE_POINT];
    for (int i = 0; i < 2; i++) body[i] = pm_model_body_index(m, PM_POINT_ROW(m, point[i])[PM_POINT_BODY]);
}

static pm_edge_motion motion_of(const pm_frame *frame, const pm_uniform *u, int contact)
{
    const pm_edge_place x = pm_edge_beside(frame, contact);
    int point[2], body[2];
    bodies_of(frame->model, contact, point, body);
    double v[2], a[2];
    for (int k = 0; k < 2; k++) {
        v[k] = u->v[3 * body[0] + k] - u->v[3 * body[1] + k];
        a[k] = u->a[3 * body[0] + k] - u->a[3 * body[1] + k];
    }
    const double vs = pm_dot(x.along, v), as = 0.5 * pm_dot(x.along, a);
    return (pm_edge_motion){
        .radius = x.radius,
        .height = {2, {x.height, pm_cross(x.along, v), 0.5 * pm_cross(x.along, a)}},
        .beyond = {{2, {x.from, -vs, -as}}, {2, {x.to, vs, as}}},
    };
}

/* o^2 + h^2 - R^2 of a corner. */
static pm_poly corner_of(const pm_edge_motion *x, int side)
{
    const pm_poly along = square_of(&x->beyond[side]);
    pm_poly p = square_of(&x->height);
    for (int i = 0; i <= p.n; i++) p.c[i] += along.c[i];
    p.c[0] -= x->radius * x->radius;
    return p;
}

/* At the begin of a phase what touches touches exactly, and what has no speed has none; 0: it may go either way. */
static int begin_exactly(const pm_uniform *uniform, pm_poly *p, double length, double speed)
{
    if (fabs(p->c[0]) > length) return 1;
    p->c[0] = 0;
    if (fabs(p->c[1]) <= speed) p->c[1] = 0;
    if (p->c[1] != 0) return p->c[1] > 0;
    return p->c[2] >= -PM_UNIFORM_DEFINITE * uniform->curve.acceleration;
}

/* The first place where p falls through zero and `holds` there; INFINITY if there is none. */
static double first_fall(const pm_poly *p, const pm_edge_motion *x, int side,
                         int (*holds)(const pm_edge_motion *x, int side, double t))
{
    double root[MOST_DEGREE];
    const pm_poly slope = derivative_of(p);
    const int n = roots_of(*p, root);
    for (int i = 0; i < n; i++)
        if (value_of(&slope, root[i]) < 0 && holds(x, side, root[i])) return root[i];
    return INFINITY;
}

static int is_within(const pm_edge_motion *x, int side, double t)
{
    (void)side;
    return value_of(&x->beyond[0], t) <= 0 && value_of(&x->beyond[1], t) <= 0;
}

static int is_beyond(const pm_edge_motion *x, int side, double t)
{
    return value_of(&x->beyond[side], t) > 0;
}

static int always(const pm_edge_motion *x, int side, double t)
{
    (void)x;
    (void)side;
    (void)t;
    return 1;
}

/* Just after the begin of the phase: what is at an end and goes on beyond it is no longer there. */
static int is_leaving(const pm_frame *frame, const pm_edge_motion *x)
{
    for (int side = 0; side < SIDES; side++)
        if (x->beyond[side].c[0] > -2 * pm_contact_length(frame) &&
            x->beyond[side].c[1] > pm_contact_speed(frame))
            return 1;
    return 0;
}

static double strikes_face(const pm_frame *frame, pm_uniform *uniform, pm_edge_motion *x)
{
    pm_poly gap = x->height;
    const double length = pm_contact_length(frame);
    const int within = is_within(x, 0, 0) && !is_leaving(frame, x);
    gap.c[0] -= x->radius;
    if (within && gap.c[0] < -length && gap.c[0] > -2 * x->radius + length) uniform->irregular = 1;
    if (!begin_exactly(uniform, &gap, length, pm_contact_speed(frame)) && within) uniform->irregular = 1;
    return first_fall(&gap, x, 0, is_within);
}

static double strikes_corner(const pm_frame *frame, pm_uniform *uniform, const pm_edge_motion *x, int side)
{
    pm_poly gap = corner_of(x, side);
    const double length = 2 * x->radius * pm_contact_length(frame),
                 speed = 2 * x->radius * pm_contact_speed(frame);
    if (!(x->radius > 0)) return INFINITY;
    if (is_beyond(x, side, 0)) {
        if (gap.c[0] < -length) uniform->irregular = 1;
        if (!begin_exactly(uniform, &gap, length, speed)) uniform->irregular = 1;
    }
    return first_fall(&gap, x, side, is_beyond);
}

static double comes_to_end(const pm_frame *frame, pm_uniform *uniform, const pm_edge_motion *x)
{
    double end = INFINITY;
    for (int side = 0; side < SIDES; side++) {
        pm_poly room = x->beyond[side];
        for (int i = 0; i <= room.n; i++) room.c[i] = -room.c[i];
        if (room.c[0] < 0) room.c[0] = 0;
        if (!begin_exactly(uniform, &room, 0, pm_contact_speed(frame))) uniform->irregular = 1;
        end = fmin(end, first_fall(&room, x, side, always));
    }
    return end;
}

int pm_uniform_edge_hold(const pm_workspace *w)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT] && m->nedge > 0; i++) {
        if (!pm_edge_is(m, i) || pm_state_is_absent(m, &w->state, PM_TABLE_CONTACT, i)) continue;
        const pm_slot *slot = &w->state.slot[m->contact_slot[i]];
        int point[2], body[2];
        bodies_of(w->model, i, point, body);
        if (w->uniform->curve.rotates[body[1]] ||
            !pm_constant_motion_point(&w->frame, &w->uniform->curve, point[0]))
            return 0;
        if (slot->mode == PM_OPEN) continue;
        if (slot->member != PM_SEGMENT_FACE || pm_edge_meets_another(&w->frame, &w->state, i)) return 0;
    }
    return 1;
}

void pm_uniform_edge_begin(pm_workspace *w, int contact)
{
    pm_uniform *u = w->uniform;
    pm_closing *x = &u->closing[contact];
    const int slot = w->model->contact_slot[contact];
    pm_edge_motion edge = motion_of(&w->frame, w->uniform, contact);
    *x = (pm_closing){.root = INFINITY, .near = INFINITY, .safe = INFINITY};
    if (w->state.slot[slot].mode != PM_OPEN) {
        u->edge_end[slot] = comes_to_end(&w->frame, w->uniform, &edge);
        return;
    }
    x->root = strikes_face(&w->frame, w->uniform, &edge);
    for (int side = 0; side < SIDES; side++)
        x->root = fmin(x->root, strikes_corner(&w->frame, w->uniform, &edge, side));
}

/* ---- decisions ---- */
static void keep_least(pm_closing *x, double gap, double reach)
{
    if (!(gap > 0 && gap < x->near)) return;
    x->near = gap;
    x->near_reach = reach;
}

static int is_inside(double t, const double step[2]) { return t >= step[0] && t <= step[1]; }

/* Along an edge: how near to an end it reversed; how fast it comes to it. */
static void note_end(pm_closing *x, const pm_edge_motion *edge, double reach, const double step[2])
{
    double top[MOST_DEGREE], nearest = -INFINITY;
    for (int side = 0; side < SIDES; side++) {
        const pm_poly *beyond = &edge->beyond[side], rate = derivative_of(beyond);
        const int n = roots_of(rate, top);
        for (int i = 0; i < n; i++)
            if (is_inside(top[i], step)) keep_least(x, -value_of(beyond, top[i]), reach);
        if (value_of(beyond, step[1]) < nearest) continue;
        nearest = value_of(beyond, step[1]);
        x->rate = -value_of(&rate, step[1]);
    }
}

static double over(const pm_edge_motion *x, double t) { return value_of(&x->height, t) - x->radius; }

static double off(const pm_edge_motion *x, int side, double t)
{
    return hypot(value_of(&x->beyond[side], t), value_of(&x->height, t)) - x->radius;
}

/* Beside an edge: how near it came to its face and its corners; how fast it strikes what is next.  What has just gone over an end,
 * as near to it as `left`, does not come to it. */
static void note_open(pm_closing *x, const pm_edge_motion *edge, double left, double reach,
                      const double step[2])
{
    double top[MOST_DEGREE];
    const pm_poly fall = derivative_of(&edge->height);
    const int nfall = roots_of(fall, top);
    for (int i = 0; i < nfall; i++)
        if (is_inside(top[i], step) && is_within(edge, 0, top[i]) && !(over(edge, top[i]) <= left))
            keep_least(x, over(edge, top[i]), reach);
    x->rate = value_of(&fall, step[1]);
    for (int side = 0; side < SIDES; side++) {
        const pm_poly corner = corner_of(edge, side), rate = derivative_of(&corner);
        const int n = roots_of(rate, top);
        for (int i = 0; i < n; i++)
            if (is_inside(top[i], step) && is_beyond(edge, side, top[i]) &&
                !(off(edge, side, top[i]) <= left))
                keep_least(x, off(edge, side, top[i]), reach);
        if (edge->radius > 0 && is_beyond(edge, side, step[1]))
            x->rate = value_of(&rate, step[1]) / (2 * edge->radius);
    }
}

void pm_uniform_edge_note(pm_workspace *w, int contact)
{
    pm_uniform *u = w->uniform;
    const double step[2] = {u->begin, u->end};
    pm_uniform_look(w, 0);
    const pm_edge_motion edge = motion_of(&w->frame, w->uniform, contact);
    if (w->state.slot[w->model->contact_slot[contact]].mode == PM_OPEN)
        note_open(&u->closing[contact], &edge,
                  is_leaving(&w->frame, &edge) ? pm_contact_length(&w->frame) : -INFINITY, w->numbers.size,
                  step);
    else
        note_end(&u->closing[contact], &edge, w->numbers.size, step);
}
