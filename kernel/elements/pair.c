/* pair.c - two curves that face each other: where t_a = -t_b and the places are one above the other.
 *
 * With d = p_a - p_b, h = d.n, b_a and b_b their curvatures, each positive where its own free side is hollow, and s_a, s_b the
 * lengths along both, each with its free side on the left:
 *   d.t_b = r        by  ds_a + (1 - h b_b) ds_b = r
 *   -t_a is turned by f from t_b        by  b_a ds_a - b_b ds_b = -f
 * which is Newton's method:
 *   ds_b = (b_a r + f) / D,  ds_a = (b_b r - (1 - h b_b) f) / D,  D = b_a + b_b - h b_a b_b
 * D is the curvature of one curve against the other: where they touch and neither goes through the other it is negative.  A
 * straight edge is a curve with b_a = 0, and so is a line without ends. */
#include "elements/pair.h"

#include <math.h>

#include "elements/curve.h"
#include "numerics/tolerances.h"

pm_pair pm_pair_of(const pm_frame *frame, const pm_constraint *c)
{
    const pm_point a = pm_frame_point(frame, c->body[0], c->a[0], c->a[1]),
                   b = pm_frame_point(frame, c->body[1], c->b[0], c->b[1]);
    const double *of = frame->pose + 5 * c->body[0], *pose = frame->pose + 5 * c->body[1];
    const double d[2] = {a.p[0] - b.p[0], a.p[1] - b.p[1]};
    return (pm_pair){.frame = frame,
                     .a = c->other,
                     .b = c->curve,
                     .at = {pose[3] * d[0] + pose[4] * d[1], -pose[4] * d[0] + pose[3] * d[1]},
                     .axis = {of[3] * pose[3] + of[4] * pose[4], of[4] * pose[3] - of[3] * pose[4]},
                     .angle = of[2] - pose[2]};
}

static void turn(const double axis[2], const double x[2], double out[2])
{
    out[0] = axis[0] * x[0] - axis[1] * x[1];
    out[1] = axis[1] * x[0] + axis[0] * x[1];
}

/* The same two as the body of a sees them. */
static pm_pair swapped(const pm_pair *x)
{
    pm_pair y = {
        .frame = x->frame, .a = x->b, .b = x->a, .axis = {x->axis[0], -x->axis[1]}, .angle = -x->angle};
    const double back[2] = {-x->at[0], -x->at[1]};
    turn(y.axis, back, y.at);
    return y;
}

/* So that the curve of a corner comes first. */
static pm_pair seen_from(const pm_pair *x, int corner) { return pm_pair_is_second(corner) ? swapped(x) : *x; }

static pm_curve_place place_of_a(const pm_pair *x, double s)
{
    const pm_curve_place own = pm_curve_at(x->frame, x->a, s);
    pm_curve_place at = own;
    turn(x->axis, own.p, at.p);
    turn(x->axis, own.t, at.t);
    turn(x->axis, own.n, at.n);
    for (int k = 0; k < 2; k++) at.p[k] += x->at[k];
    return at;
}

/* The s of an end of a. */
static double end_of(const pm_pair *x, int corner)
{
    return pm_curve_bound(x->frame, x->a, corner == PM_PAIR_FROM ? PM_CURVE_FROM : PM_CURVE_TO);
}

/* ---- places that face each other ---- */
static int is_endless(const pm_pair *x, int curve) { return pm_curve_is_endless(x->frame->model, curve); }

static double range_of(const pm_pair *x, int curve)
{
    return pm_curve_bound(x->frame, curve, PM_CURVE_TO) - pm_curve_bound(x->frame, curve, PM_CURVE_FROM);
}

/* A step of s, no more than a part of what it goes through. */
static double step_of(const pm_pair *x, int curve, const pm_curve_place *at, double way)
{
    const double most = is_endless(x, curve) ? INFINITY : PM_CURVE_PART * range_of(x, curve);
    return fmin(fmax(pm_curve_step(at, way), -most), most);
}

/* The part of a step of both by which neither turns too far. */
static double part_of(const pm_pair_place *at, const double way[2])
{
    const double turned = fmax(pm_curve_turn_along(&at->a, way[0]), pm_curve_turn_along(&at->b, way[1]));
    return turned > PM_CURVE_STEP ? PM_CURVE_STEP / turned : 1;
}

static pm_pair_place places(const pm_pair *x, double a, double b, double of)
{
    pm_pair_place at = {.a = place_of_a(x, a), .b = pm_curve_along(x->frame, x->b, b, isnan(of) ? b : of)};
    const double d[2] = {at.a.p[0] - at.b.p[0], at.a.p[1] - at.b.p[1]};
    at.height = pm_dot(d, at.b.n);
    at.closer = at.a.bend + at.b.bend - at.height * at.a.bend * at.b.bend;
    return at;
}

/* Newton's step, as ways along both; 0: it has come to its end. */
static int ways_to_meet(const pm_pair_place *at, double way[2])
{
    const double d[2] = {at->a.p[0] - at->b.p[0], at->a.p[1] - at->b.p[1]}, r = pm_dot(d, at->b.t);
    const double f = atan2(-pm_cross(at->b.t, at->a.t), -pm_dot(at->b.t, at->a.t));
    way[0] = (at->b.bend * r - (1 - at->height * at->b.bend) * f) / at->closer;
    way[1] = (at->a.bend * r + f) / at->closer;
    return fabs(way[0]) + fabs(way[1]) >
           PM_CURVE_FOUND * PM_EPSILON * (pm_length(at->a.p) + pm_length(at->b.p));
}

pm_pair_place pm_pair_meet(const pm_pair *x, double a, double b, double of)
{
    double turned = 0;
    for (int tries = 0, last = 0; tries < PM_CURVE_STEPS; tries++) {
        const pm_pair_place at = places(x, a, b, of);
        double way[2];
        if (!(at.closer < 0)) break;
        if (last || !ways_to_meet(&at, way)) return at;
        if (!(turned <= PM_CURVE_WINDOW)) break;
        const double part = part_of(&at, way);
        const double turns = pm_curve_turn_along(&at.a, way[0]) + pm_curve_turn_along(&at.b, way[1]);
        turned += part * turns;
        const double step[2] = {step_of(x, x->a, &at.a, part * way[0]),
                                step_of(x, x->b, &at.b, part * way[1])};
        last = part == 1 && turns <= PM_CURVE_LAST && step[0] == pm_curve_step(&at.a, way[0]) &&
               step[1] == pm_curve_step(&at.b, way[1]);
        a += step[0];
        b += step[1];
    }
    pm_pair_place none = {.height = NAN, .closer = NAN};
    none.a.s = none.b.s = NAN;
    for (int k = 0; k < 2; k++)
        none.a.p[k] = none.a.t[k] = none.a.n[k] = none.b.p[k] = none.b.t[k] = none.b.n[k] = NAN;
    return none;
}

/* ---- the nearest of all ---- */
typedef struct pm_pair_search {
    const pm_pair *x;
    const pm_pair_closed *closed;
    pm_pair_near *near;
    int found;
} pm_pair_search;

static const pm_curve_part *part(const pm_pair_search *f, int curve, int i)
{
    return &f->x->frame->numbers->course[curve].part[i];
}

/* By their curvatures parts may touch and not go through each other. */
static int bend_apart(const pm_curve_part *a, const pm_curve_part *b) { return a->low + b->low < 0; }

/* Their directions allow that they face each other. */
static int turns_against(const pm_pair *x, const pm_curve_part *a, const pm_curve_part *b)
{
    return fabs(remainder(a->angle + x->angle - b->angle - M_PI, 2 * M_PI)) <= a->spread + b->spread;
}

/* A place of one may be above or below a place of the other, square to its tangent. */
static int stands_over(const pm_pair *x, const pm_curve_part *a, const pm_curve_part *b)
{
    double d[2];
    turn(x->axis, a->p, d);
    for (int k = 0; k < 2; k++) d[k] += x->at[k] - b->p[k];
    return pm_curve_part_is_under(b, d, a->radius);
}

/* Places at which both are smooth enough for one step to tell where they meet. */
static int is_one(const pm_curve_part *a, const pm_curve_part *b)
{
    return a->high + b->high < 0 && a->spread + b->spread <= PM_CURVE_TURN;
}

static double place_in(const pm_pair *x, int curve, int i, double part)
{
    int level = 1;
    while (2 * level <= i) level *= 2;
    return pm_curve_bound(x->frame, curve, PM_CURVE_FROM) + range_of(x, curve) * (i - level + part) / level;
}

/* A little more than the part, so that nothing between two is missed; what is endless is one part. */
static int lies_in(const pm_pair *x, int curve, int i, double s)
{
    if (is_endless(x, curve)) return 1;
    const double slack = PM_CURVE_SAME * range_of(x, curve);
    return s >= place_in(x, curve, i, 0) - slack && s <= place_in(x, curve, i, 1) + slack;
}

static int is_near_end(const pm_pair *x, int curve, int corner, double s)
{
    const double from = pm_curve_bound(x->frame, curve, PM_CURVE_FROM),
                 to = pm_curve_bound(x->frame, curve, PM_CURVE_TO);
    return (pm_pair_end(corner) == PM_PAIR_FROM ? s - from : to - s) < PM_CURVE_PART * (to - from);
}

/* What is closed has come over a corner to there, or from there. */
static int is_left_to_closed(const pm_pair_search *f, const pm_pair_place *at)
{
    for (int i = PM_PAIR_FROM; i <= PM_PAIR_SECOND_TO; i++)
        if (f->closed->passed[i] && is_near_end(f->x, pm_pair_is_second(i) ? f->x->b : f->x->a, i,
                                                pm_pair_is_second(i) ? at->b.s : at->a.s))
            return 1;
    return 0;
}

/* Beyond the ends of what is open nothing is. */
static int lies_on(const pm_pair *x, int curve, double s)
{
    if (!pm_curve_has_ends(x->frame->model, curve)) return 1;
    return s >= pm_curve_bound(x->frame, curve, PM_CURVE_FROM) &&
           s <= pm_curve_bound(x->frame, curve, PM_CURVE_TO);
}

/* A place of a that is behind b is in it where no other place of b is nearer.  All that is behind a line without ends is in it. */
static int is_in(const pm_pair *x, const pm_pair_place *at)
{
    if (is_endless(x, x->a) || is_endless(x, x->b)) return 1;
    const pm_curve_taken none = {.n = 0};
    const double rounding = PM_CURVE_FOUND * PM_EPSILON * (pm_length(at->a.p) + pm_length(at->b.p));
    pm_curve_near near;
    return pm_curve_feet_nearest(x->frame, x->b, at->a.p, &none, &near) &&
           near.height <= (1 - PM_PAIR_BEHIND) * at->height + rounding;
}

/* What overlaps comes before what does not. */
static int is_nearer(const pm_pair_search *f, double height)
{
    if (!f->found) return 1;
    const double best = f->near->at.height;
    return (height < 0) != (best < 0) ? height < 0 : fabs(height) < fabs(best);
}

/* x: the pair, or the same swapped; taken: the feet on its b. */
static int is_better(const pm_pair_search *f, const pm_pair *x, const pm_curve_taken *taken,
                     const pm_pair_place *at)
{
    return is_nearer(f, at->height) && !pm_curve_feet_is_taken(x->frame, x->b, taken, at->b.s) &&
           (at->height >= 0 || is_in(x, at));
}

static void keep(pm_pair_search *f, const pm_pair_place *at, int corner)
{
    *f->near = (pm_pair_near){.at = *at, .corner = corner};
    f->found = 1;
}

static void keep_within(pm_pair_search *f, const pm_pair_place *at)
{
    if (is_better(f, f->x, &f->closed->feet, at)) keep(f, at, PM_PAIR_WITHIN);
}

/* Whether the places where both parts meet are known: there are some, or none. */
static int meet(pm_pair_search *f, int a, int b, int last)
{
    const pm_pair *x = f->x;
    const pm_pair_place at = pm_pair_meet(x, place_in(x, x->a, a, 0.5), place_in(x, x->b, b, 0.5), NAN);
    if (!(at.closer < 0) || !lies_in(x, x->a, a, at.a.s) || !lies_in(x, x->b, b, at.b.s)) return last;
    if (lies_on(x, x->a, at.a.s) && lies_on(x, x->b, at.b.s) && !is_left_to_closed(f, &at))
        keep_within(f, &at);
    return 1;
}

/* Where no bound parts the curves there are as many pairs of parts as both have parts; what a case that is given up finds in them
 * does not count (run.c). */
static void look(pm_pair_search *f, int i, int k)
{
    if (pm_patience_ends(f->x->frame->patience)) return;
    const pm_curve_part *a = part(f, f->x->a, i), *b = part(f, f->x->b, k);
    if (!bend_apart(a, b) || !turns_against(f->x, a, b) || !stands_over(f->x, a, b)) return;
    const int last_a = pm_curve_part_is_last(i) || is_endless(f->x, f->x->a),
              last_b = pm_curve_part_is_last(k);
    if ((is_one(a, b) || (last_a && last_b)) && meet(f, i, k, last_a && last_b)) return;
    const int halve_a = !last_a && (last_b || a->spread + a->radius * fabs(b->low) >= b->spread);
    for (int half = 0; half < 2; half++)
        if (halve_a)
            look(f, 2 * i + half, k);
        else
            look(f, i, 2 * k + half);
}

/* ---- corners ---- */
static double rises(const pm_pair *x, int end, const double n[2])
{
    const pm_curve_place at = place_of_a(x, end_of(x, end));
    const double inwards = (end == PM_PAIR_FROM) == (at.rate > 0) ? 1 : -1;
    return inwards * pm_dot(at.t, n);
}

double pm_pair_corner_rises(const pm_pair *x, int corner, const double n[2])
{
    const pm_pair own = seen_from(x, corner);
    return rises(&own, pm_pair_end(corner), n);
}

/* The place as the pair has it, which a second corner sees the other way round. */
static pm_pair_place unswapped(const pm_pair_place *at, int corner)
{
    if (!pm_pair_is_second(corner)) return *at;
    return (pm_pair_place){.a = at->b, .b = at->a, .height = at->height};
}

/* What of b is nearest to a corner, and not beyond an end. */
static int is_beside(const pm_pair *x, const pm_pair_place *corner, const pm_curve_taken *taken,
                     pm_curve_near *near)
{
    if (!is_endless(x, x->b))
        return pm_curve_feet_nearest(x->frame, x->b, corner->a.p, taken, near) &&
               near->end == PM_CURVE_WITHIN;
    near->foot = pm_curve_foot(x->frame, x->b, corner->a.p, 0, &near->height);
    return 1;
}

/* Whether a, which is behind b with its end, has not gone round an end of b: from there, on a way that grows from what the end
 * is deep, it comes to the front of b, or all of it is behind. */
static int comes_through(const pm_pair *x, int end, double depth)
{
    const pm_curve_taken none = {.n = 0};
    const double from = end_of(x, end), range = range_of(x, x->a);
    const double inwards = end == PM_PAIR_FROM ? range : -range;
    double part = depth / fabs(place_of_a(x, from).rate * range);
    for (; part <= 1; part *= PM_PAIR_FARTHER) {
        const pm_pair_place at = {.a = place_of_a(x, from + part * inwards)};
        pm_curve_near near;
        if (!is_beside(x, &at, &none, &near)) return 0;
        if (near.height >= 0) return 1;
    }
    return 1;
}

static void look_at_corner(pm_pair_search *f, int corner)
{
    const pm_pair own = seen_from(f->x, corner);
    if (!pm_curve_has_ends(own.frame->model, own.a)) return;
    const int end = pm_pair_end(corner);
    const pm_curve_taken *taken = pm_pair_is_second(corner) ? &f->closed->first : &f->closed->feet;
    pm_pair_place at = {.a = place_of_a(&own, end_of(&own, end))};
    pm_curve_near near;
    if (!is_beside(&own, &at, taken, &near) || rises(&own, end, near.foot.n) < 0) return;
    at.b = near.foot;
    at.height = near.height;
    if (!is_better(f, &own, taken, &at)) return;
    if (at.height < 0 && pm_pair_is_second(corner) && !comes_through(&own, end, -at.height)) return;
    at = unswapped(&at, corner);
    keep(f, &at, corner);
}

/* Where all places are as near none is found: then one is. */
static void take_any(pm_pair_search *f)
{
    const pm_pair *x = f->x;
    pm_pair_place at = {.a = place_of_a(x, end_of(x, PM_PAIR_FROM))};
    pm_curve_near near;
    if (!pm_curve_feet_nearest(x->frame, x->b, at.a.p, &f->closed->feet, &near) ||
        near.end != PM_CURVE_WITHIN)
        return;
    at.b = near.foot;
    at.height = near.height;
    keep_within(f, &at);
}

int pm_pair_nearest(const pm_pair *x, const pm_pair_closed *closed, pm_pair_near *near)
{
    pm_pair_search f = {.x = x, .closed = closed, .near = near};
    look(&f, 1, 1);
    for (int corner = PM_PAIR_FROM; corner <= PM_PAIR_SECOND_TO; corner++)
        if (!closed->passed[corner]) look_at_corner(&f, corner);
    if (!f.found && closed->feet.n == 0 && pm_curve_is_round(x->frame->model, x->a)) take_any(&f);
    return f.found;
}
