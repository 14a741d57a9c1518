/* curve_feet.c - all feet of a point on a curve, and the nearest of them.
 *
 * The curve is a tree of parts, each enclosed (curve_parts.h): a part that is farther away than what was found, or has no
 * foot, is passed over.  Between two nodes the tangent turns by less than PM_CURVE_TURN.  A foot that is a nearest place lies
 * where t.(x - p), t along s, falls from positive to negative; Newton's method finds it, or bisection where that leaves the
 * part. */
#include "elements/curve_feet.h"

#include <math.h>

#include "elements/constraint.h"
#include "numerics/minmax.h"

/* ---- the nodes of a case ---- */
static double bound_of(const pm_frame *frame, int curve, int column)
{
    return frame->numbers->value[PM_CURVE_ROW(frame->model, curve)[column]];
}

static double range_of(const pm_frame *frame, int curve)
{
    return bound_of(frame, curve, PM_CURVE_TO) - bound_of(frame, curve, PM_CURVE_FROM);
}

static int is_closed(const pm_frame *frame, int curve) { return pm_curve_is_round(frame->model, curve); }

double pm_curve_feet_place(const pm_frame *frame, int curve, int node)
{
    return bound_of(frame, curve, PM_CURVE_FROM) + range_of(frame, curve) * node / PM_CURVE_NODES;
}

int pm_curve_feet_node(const pm_frame *frame, int curve, double s)
{
    double part = (s - bound_of(frame, curve, PM_CURVE_FROM)) / range_of(frame, curve);
    if (is_closed(frame, curve)) part -= floor(part);
    return (int)round(PM_CURVE_NODES * fmin(fmax(part, 0), 1));
}

static double apart(const double a[2], const double b[2])
{
    const double d[2] = {a[0] - b[0], a[1] - b[1]};
    return pm_length(d);
}

static int bad(pm_workspace *w, int curve, int column, double value, double bound)
{
    return pm_fail_member(&w->result, PM_BAD_VALUE, PM_TABLE_CURVE, curve, column, value, bound);
}

/* Twice the area of a triangle: on which side of a -> b the place c is. */
static double side_of(const double a[2], const double b[2], const double c[2])
{
    const double ab[2] = {b[0] - a[0], b[1] - a[1]}, ac[2] = {c[0] - a[0], c[1] - a[1]};
    return pm_cross(ab, ac);
}

/* The straight lines from node i and from node k on cross. */
static int cross(const pm_curve_node *node, int i, int k)
{
    const double *a = node[i].p, *b = node[i + 1].p, *c = node[k].p, *d = node[k + 1].p;
    return side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0;
}

/* The first part that a later one crosses; PM_NONE: none does. */
static int crosses_itself(const pm_curve_course *x)
{
    for (int i = 0; i < PM_CURVE_NODES; i++)
        for (int k = i + 2; k < PM_CURVE_NODES;) {
            const double far = apart(x->node[i].p, x->node[k].p);
            if (far < 2 * x->pace && cross(x->node, i, k)) return i;
            k += 1 + (far > 3 * x->pace ? (int)pm_min(far / x->pace, PM_CURVE_NODES) - 3 : 0);
        }
    return PM_NONE;
}

static void take_node(pm_curve_course *x, int i, const pm_curve_place *at)
{
    const double way = at->rate < 0 ? -1 : 1;
    for (int k = 0; k < 2; k++) {
        x->node[i].p[k] = at->p[k];
        x->node[i].t[k] = way * at->t[k];
    }
    x->far = fmax(x->far, pm_length(at->p));
    x->size = fmax(x->size, 2 * apart(at->p, x->node[0].p));
}

/* The part from the node before to node i, which turns the tangent by `turns`. */
static void take_part(pm_curve_course *x, int i, const pm_curve_place *before, const pm_curve_place *at,
                      double way, double turns, double *angle)
{
    const double from = i == 1 ? atan2(before->t[1], before->t[0]) : *angle;
    *angle = from + turns;
    const pm_curve_stop a = {{before->p[0], before->p[1]}, from, before->bend, before->bend_rate},
                        b = {{at->p[0], at->p[1]}, *angle, at->bend, at->bend_rate};
    x->part[PM_CURVE_NODES + i - 1] = pm_curve_part_between(&a, &b, way * (1 + PM_CURVE_TURN));
    x->pace = fmax(x->pace, way);
    if (turns != 0) x->fine = fmin(x->fine, way * PM_CURVE_TURN / fabs(turns));
}

int pm_curve_feet_begin(pm_workspace *w, int curve)
{
    const pm_frame *frame = &w->frame;
    pm_curve_course *x = &w->numbers.course[curve];
    const double part = range_of(frame, curve) / PM_CURVE_NODES;
    pm_curve_place before = {.s = NAN};
    double angle = 0;
    x->pace = x->size = x->far = 0;
    x->fine = INFINITY;
    for (int i = 0; i <= PM_CURVE_NODES; i++) {
        const double s = pm_curve_feet_place(frame, curve, i);
        const pm_curve_place at = pm_curve_at(frame, curve, s);
        take_node(x, i, &at);
        if (i > 0) {
            const double turns = atan2(pm_cross(before.t, at.t), pm_dot(before.t, at.t));
            const double way = part * fmax(fabs(before.rate), fabs(at.rate));
            if (!(fabs(turns) <= PM_CURVE_TURN)) return bad(w, curve, PM_CURVE_SIDE, s, turns);
            take_part(x, i, &before, &at, way, turns, &angle);
        }
        before = at;
    }
    x->pace *= 1 + PM_CURVE_TURN;
    pm_curve_parts_join(x->part);
    x->fine = fmin(x->fine, x->size);
    if (pm_curve_is_endless(frame->model, curve)) x->fine = x->size = x->part[1].radius = INFINITY;
    const int crossing = crosses_itself(x);
    return crossing == PM_NONE
               ? PM_OK
               : bad(w, curve, PM_CURVE_POINT, pm_curve_feet_place(frame, curve, crossing), 0);
}

/* ---- the search ---- */
typedef struct pm_curve_search {
    const pm_frame *frame;
    int curve;
    const double *x;
    const pm_curve_taken *taken;
    double best; /* distance of what was found */
} pm_curve_search;

static double along(const pm_curve_node *node, const double x[2])
{
    const double d[2] = {x[0] - node->p[0], x[1] - node->p[1]};
    return pm_dot(d, node->t);
}

int pm_curve_feet_is_taken(const pm_frame *frame, int curve, const pm_curve_taken *taken, double s)
{
    const double all = range_of(frame, curve);
    for (int i = 0; i < taken->n; i++) {
        double off = fabs(s - taken->s[i]);
        if (is_closed(frame, curve)) off = fabs(off - all * round(off / all));
        if (off <= PM_CURVE_SAME * all) return 1;
    }
    return 0;
}

/* Beside what touches at another foot: the far side of a body is seen from within.  No circle sinks in as far between two
 * samples of a step (events/gap_culling.h). */
static int is_behind(const pm_curve_search *f, double height)
{
    return f->taken->n > 0 && height < -f->frame->numbers->course[f->curve].fine;
}

/* Keeps what was found if it is nearer than all before. */
static void keep(pm_curve_search *f, const pm_curve_place *foot, int end, double distance,
                 pm_curve_near *near)
{
    const double d[2] = {f->x[0] - foot->p[0], f->x[1] - foot->p[1]}, way = pm_dot(d, foot->t);
    if (!(distance < f->best) || pm_curve_feet_is_taken(f->frame, f->curve, f->taken, foot->s) ||
        is_behind(f, pm_dot(d, foot->n)))
        return;
    f->best = distance;
    *near = (pm_curve_near){.foot = *foot,
                            .height = pm_dot(d, foot->n),
                            .end = end,
                            .beyond = end == PM_CURVE_WITHIN ? 0 : fabs(way),
                            .node = pm_curve_feet_node(f->frame, f->curve, foot->s)};
}

/* By the sign of t.(x - p). */
static pm_curve_place bisect(const pm_curve_search *f, double low, double high)
{
    pm_curve_place at = pm_curve_at(f->frame, f->curve, 0.5 * (low + high));
    for (int i = 0; i < PM_CURVE_BISECTIONS; i++) {
        const double d[2] = {f->x[0] - at.p[0], f->x[1] - at.p[1]};
        if (pm_dot(d, at.t) * (at.rate < 0 ? -1 : 1) > 0)
            low = at.s;
        else
            high = at.s;
        at = pm_curve_at(f->frame, f->curve, 0.5 * (low + high));
    }
    return at;
}

/* The foot in the part behind node i. */
static void look_into(pm_curve_search *f, int i, double d, double d_next, pm_curve_near *near)
{
    const double low = pm_curve_feet_place(f->frame, f->curve, i),
                 high = pm_curve_feet_place(f->frame, f->curve, i + 1), slack = 0.5 * (high - low);
    double height;
    pm_curve_place foot = pm_curve_foot(f->frame, f->curve, f->x, d < d_next ? low : high, &height);
    if (!(foot.s >= low - slack && foot.s <= high + slack)) foot = bisect(f, low, high);
    keep(f, &foot, PM_CURVE_WITHIN, apart(f->x, foot.p), near);
}

/* The ends of an open curve beyond which the point is. */
static void look_at_ends(pm_curve_search *f, pm_curve_near *near)
{
    const pm_curve_node *node = f->frame->numbers->course[f->curve].node;
    for (int end = PM_CURVE_AT_FROM; end <= PM_CURVE_AT_TO && !is_closed(f->frame, f->curve); end++) {
        const int i = end == PM_CURVE_AT_FROM ? 0 : PM_CURVE_NODES;
        const double way = along(&node[i], f->x), d = apart(f->x, node[i].p);
        if (!(end == PM_CURVE_AT_FROM ? way < 0 : way >= 0) || !(d < f->best)) continue;
        const pm_curve_place at = pm_curve_at(f->frame, f->curve, pm_curve_feet_place(f->frame, f->curve, i));
        keep(f, &at, end, d, near);
    }
}

/* Some node is as near: no foot is farther that is not taken. */
static int nearest_node(const pm_curve_search *f, double *least)
{
    const pm_curve_node *node = f->frame->numbers->course[f->curve].node;
    int nearest = 0;
    *least = INFINITY;
    for (int i = 0; i <= PM_CURVE_NODES; i += PM_CURVE_STRIDE) {
        const double d = apart(f->x, node[i].p);
        if (!(d < *least)) continue;
        *least = d;
        nearest = i;
    }
    return nearest;
}

/* In the parts that come as near and have a tangent square to the way to the point. */
static void look_along(pm_curve_search *f, int part, double bound, pm_curve_near *near)
{
    const pm_curve_course *c = &f->frame->numbers->course[f->curve];
    const pm_curve_part *p = &c->part[part];
    const double d[2] = {f->x[0] - p->p[0], f->x[1] - p->p[1]};
    if (pm_length(d) - p->radius > fmin(bound, f->best) || !pm_curve_part_is_under(p, d, 0)) return;
    if (!pm_curve_part_is_last(part)) {
        for (int half = 0; half < 2; half++) look_along(f, 2 * part + half, bound, near);
        return;
    }
    const int i = part - PM_CURVE_NODES;
    if (along(&c->node[i], f->x) >= 0 && along(&c->node[i + 1], f->x) < 0)
        look_into(f, i, apart(f->x, c->node[i].p), apart(f->x, c->node[i + 1].p), near);
}

/* Where all places are as near no foot is found: then a node is one. */
int pm_curve_feet_nearest(const pm_frame *frame, int curve, const double x[2], const pm_curve_taken *taken,
                          pm_curve_near *near)
{
    pm_curve_search f = {.frame = frame, .curve = curve, .x = x, .taken = taken, .best = INFINITY};
    double bound = INFINITY;
    const int node = taken->n == 0 ? nearest_node(&f, &bound) : 0;
    look_at_ends(&f, near);
    look_along(&f, 1, bound, near);
    if (isinf(f.best) && taken->n == 0) {
        const pm_curve_place at = pm_curve_at(frame, curve, pm_curve_feet_place(frame, curve, node));
        keep(&f, &at, PM_CURVE_WITHIN, bound, near);
    }
    return !isinf(f.best);
}
