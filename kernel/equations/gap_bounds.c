/* gap_bounds.c - bounds of gaps from what the joints allow, whatever the motion.
 *
 * A body that hangs by pins, welds and links from the ground keeps one of its points, the hinge H, at a distance from a
 * fixed place O that lies in [low, high]: for a pin on the ground both are 0; by a mark m of a body that hangs, and a
 * link of length l (a pin: 0), what hangs there has H in
 *     [max(0, |m - H| - high, low - |m - H|) - l, |m - H| + high + l]
 * about the same O (triangle inequality).  What is welded to the ground is as fixed as the ground.  Joints that
 * some event adds or removes bound nothing.
 *
 * The gap of two marks, each in a ring [low, high] about O_a and O_b, d = |O_a - O_b|, then is at least
 *     circles outside each other     max(d - high_a - high_b, low_a - d - high_b, low_b - d - high_a) - r_a - r_b
 *     a within b                     r_b - r_a - (d + high_a + high_b)
 *     a over a fixed line            height of O_a - high_a - r_a
 *     a over a line that hangs       height of its hinge over it - (d + high_a + high_H) - r_a
 *     a beside a fixed edge          distance of O_a from it - high_a - r_a
 * Cords and patterns keep their own bounds. */
#include "equations/gap_bounds.h"

#include <math.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "numerics/lanes.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

static int is_fixed(const pm_hinge_bounds *x) { return x->known && x->fixed; }

/* ---- marks ---- */
typedef struct pm_ring {
    double at[2], low, high;
    int known;
} pm_ring;

static pm_ring ring_of(const pm_workspace *w, int point)
{
    const int32_t *e = PM_POINT_ROW(w->model, point);
    const double m[2] = {w->numbers.value[e[PM_POINT_X]], w->numbers.value[e[PM_POINT_Y]]};
    const pm_hinge_bounds *x = &w->reach.hinge[pm_model_body_index(w->model, e[PM_POINT_BODY])];
    if (is_fixed(x)) {
        const pm_point p = pm_frame_point_of(&w->frame, point);
        return (pm_ring){.at = {p.p[0], p.p[1]}, .known = 1};
    }
    const double r = hypot(m[0] - x->hinge[0], m[1] - x->hinge[1]);
    return (pm_ring){.at = {x->at[0], x->at[1]},
                     .low = fmax(0, fmax(r - x->high, x->low - r)),
                     .high = r + x->high,
                     .known = x->known};
}

/* ---- bodies ---- */
/* What point b hangs from by point a; 1: it is bounded more closely than before. */
static int hang(pm_workspace *w, int a, int b, double length, int welded)
{
    const pm_model *m = w->model;
    const int32_t *e = PM_POINT_ROW(m, b);
    const int body = pm_model_body_index(m, e[PM_POINT_BODY]);
    const pm_ring from = ring_of(w, a);
    pm_hinge_bounds *x = &w->reach.hinge[body];
    if (!from.known || is_fixed(x)) return 0;
    const int fixed =
        welded && is_fixed(&w->reach.hinge[pm_model_body_index(m, PM_POINT_ROW(m, a)[PM_POINT_BODY])]);
    const double high = from.high + length;
    if (x->known && !fixed && !(high < x->high)) return 0;
    *x = (pm_hinge_bounds){.known = 1,
                           .fixed = fixed,
                           .at = {from.at[0], from.at[1]},
                           .hinge = {w->numbers.value[e[PM_POINT_X]], w->numbers.value[e[PM_POINT_Y]]},
                           .low = fmax(0, from.low - length),
                           .high = high};
    return 1;
}

static int hang_by_joint(pm_workspace *w, int joint)
{
    const int32_t *e = PM_JOINT_ROW(w->model, joint);
    const int kind = e[PM_JOINT_KIND], a = e[PM_JOINT_A], b = e[PM_JOINT_B];
    if (kind != PM_JOINT_PIN && kind != PM_JOINT_WELD && kind != PM_JOINT_LINK) return 0;
    if (pm_model_is_changed(w->model, PM_TABLE_JOINT, joint)) return 0;
    const double length = kind == PM_JOINT_LINK ? w->numbers.value[e[PM_JOINT_VALUE]] : 0;
    return hang(w, a, b, length, kind == PM_JOINT_WELD) | hang(w, b, a, length, kind == PM_JOINT_WELD);
}

/* Bounds pass on from the ground; each pass bounds at least one more body for good. */
static void hang_all(pm_workspace *w)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->nbody; i++)
        w->reach.hinge[i] = (pm_hinge_bounds){.known = w->numbers.fixed[i], .fixed = w->numbers.fixed[i]};
    w->reach.hinge[m->nbody] = (pm_hinge_bounds){.known = 1, .fixed = 1};
    for (int more = 1, pass = 0; more && pass <= m->nbody; pass++) {
        more = 0;
        for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++) more |= hang_by_joint(w, i);
    }
}

/* ---- gaps ---- */
static double apart(const pm_ring *a, const pm_ring *b)
{
    return hypot(a->at[0] - b->at[0], a->at[1] - b->at[1]);
}

static double least_distance(const pm_ring *a, const pm_ring *b)
{
    const double d = apart(a, b);
    return fmax(d - a->high - b->high, fmax(a->low - d - b->high, b->low - d - a->high));
}

static double least_over_circle(const pm_workspace *w, const int32_t *e, const pm_ring *a, double ra)
{
    const int32_t *circle = PM_CIRCLE_ROW(w->model, e[PM_CONTACT_B]);
    const pm_ring b = ring_of(w, circle[PM_CIRCLE_POINT]);
    const double rb = w->numbers.value[circle[PM_CIRCLE_RADIUS]];
    const double side = e[PM_CONTACT_KIND] == PM_CONTACT_POINT ? 1 : w->numbers.value[e[PM_CONTACT_SIDE]];
    if (!b.known) return -INFINITY;
    if (side > 0) return least_distance(a, &b) - ra - rb;
    return fabs(ra - rb) - (apart(a, &b) + a->high + b.high);
}

/* Place and direction of a line in its body's axes. */
typedef struct pm_straight {
    double at[2], t[2];
    int body;
} pm_straight;

static pm_straight straight(const pm_model *model, const pm_numbers *numbers, int line)
{
    const int32_t *e = PM_LINE_ROW(model, line), *p = PM_POINT_ROW(model, e[PM_LINE_POINT]);
    const double angle = numbers->value[e[PM_LINE_ANGLE]];
    pm_straight x = {.at = {numbers->value[p[PM_POINT_X]], numbers->value[p[PM_POINT_Y]]},
                     .body = pm_model_body_index(model, p[PM_POINT_BODY])};
    pm_lanes_store(x.t, pm_lanes_axis(angle));
    return x;
}

/* A place of the scene in the axes of a body, as it is now. */
static void into_body(const pm_frame *frame, int body, const double p[2], double out[2])
{
    const double *x = frame->pose + 5 * body, d[2] = {p[0] - x[0], p[1] - x[1]};
    out[0] = x[3] * d[0] + x[4] * d[1];
    out[1] = -x[4] * d[0] + x[3] * d[1];
}

static double height_over(const pm_straight *line, const double p[2])
{
    const double d[2] = {p[0] - line->at[0], p[1] - line->at[1]};
    return pm_cross(line->t, d);
}

static double least_over_line(const pm_workspace *w, const int32_t *e, const pm_ring *a, double ra)
{
    const pm_straight line = straight(w->model, &w->numbers, e[PM_CONTACT_B]);
    const pm_hinge_bounds *b = &w->reach.hinge[line.body];
    double at[2];
    if (!b->known) return -INFINITY;
    if (!b->fixed) {
        const double d = hypot(a->at[0] - b->at[0], a->at[1] - b->at[1]);
        return height_over(&line, b->hinge) - (d + a->high + b->high) - ra;
    }
    into_body(&w->frame, line.body, a->at, at);
    return height_over(&line, at) - a->high - ra;
}

static double least_beside_edge(const pm_workspace *w, const int32_t *e, const pm_ring *a, double ra)
{
    const pm_straight line = straight(w->model, &w->numbers, e[PM_CONTACT_B]);
    double at[2];
    if (!is_fixed(&w->reach.hinge[line.body])) return -INFINITY;
    into_body(&w->frame, line.body, a->at, at);
    const double d[2] = {at[0] - line.at[0], at[1] - line.at[1]}, along = pm_dot(line.t, d);
    const double beyond =
        fmax(w->numbers.value[e[PM_CONTACT_FROM]] - along, along - w->numbers.value[e[PM_CONTACT_TO]]);
    return hypot(fmax(beyond, 0), height_over(&line, at)) - a->high - ra;
}

/* The gap is never less. */
static double least_gap(const pm_workspace *w, int contact)
{
    const int32_t *e = PM_CONTACT_ROW(w->model, contact);
    if (e[PM_CONTACT_KIND] == PM_CONTACT_CURVES) return -INFINITY;
    const int32_t *circle = PM_CIRCLE_ROW(w->model, e[PM_CONTACT_A]);
    const pm_ring a = ring_of(w, circle[PM_CIRCLE_POINT]);
    const double ra = w->numbers.value[circle[PM_CIRCLE_RADIUS]];
    if (!a.known) return -INFINITY;
    switch ((enum pm_contact_kind)e[PM_CONTACT_KIND]) {
    case PM_CONTACT_CIRCLE:
    case PM_CONTACT_POINT: return least_over_circle(w, e, &a, ra);
    case PM_CONTACT_LINE: return least_over_line(w, e, &a, ra);
    case PM_CONTACT_SEGMENT: return least_beside_edge(w, e, &a, ra);
    default: return -INFINITY;
    }
}

void pm_gap_bounds_drop(pm_workspace *w)
{
    const pm_model *m = w->model;
    w->reach.ncontact = 0;
    if (m->rows[PM_TABLE_CONTACT] == 0) return;
    hang_all(w);
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) {
        if (pm_model_is_changed(m, PM_TABLE_CONTACT, i)) continue;
        if (!(least_gap(w, i) > PM_OUT_OF_REACH * pm_contact_reach(w))) continue;
        w->state.absent[pm_model_element(m, PM_TABLE_CONTACT, i)] = 1;
        w->reach.ncontact++;
    }
}
