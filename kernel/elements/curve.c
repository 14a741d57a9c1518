/* curve.c - places on a curve c(s) = (x(s), y(s)), and the foot of a point.
 *
 * With the derivatives by s from Taylor series, v = |c'| and side = 1 or -1:
 *   t = side c' / v,  n = k x t,  rate = side v,  bend = side (c' x c'') / v^3,
 *   bend_rate = ((c' x c''') v^2 - 3 (c' x c'') (c'.c'')) / v^6
 *
 * The foot of x is where t.(x - p) = 0.  With the height h = n.(x - p) that changes by -(1 - bend h) along the curve:
 * Newton's method, whose steps turn the tangent by no more than PM_CURVE_STEP.  Steps along the curve become steps of s by
 * way = rate ds + quickens ds^2 / 2. */
#include "elements/curve.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <math.h>

#include "elements/constraint.h"
#include "elements/curve_piece.h"
#include "expression/program.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"

typedef struct pm_curve_series {
    pm_taylor x, y;
} pm_curve_series;

static pm_curve_series series_at(const pm_frame *frame, int curve, double s, double of)
{
    const int32_t *e = PM_CURVE_ROW(frame->model, curve);
    const pm_numbers *n = frame->numbers;
    return (pm_curve_series){.x = pm_program_of_place(frame->model, e[PM_CURVE_X], n->param, n->value, s, of),
                             .y =
                                 pm_program_of_place(frame->model, e[PM_CURVE_Y], n->param, n->value, s, of)};
}

/* The same series about a place h further on. */
static pm_taylor moved(const pm_taylor *a, double h)
{
    const double *c = a->c;
    return (pm_taylor){{c[0] + h * (c[1] + h * (c[2] + h * c[3])), c[1] + h * (2 * c[2] + 3 * h * c[3]),
                        c[2] + 3 * h * c[3], c[3]}};
}

/* What is not closed is known between its bounds. */
static double within(const pm_frame *frame, int curve, double s)
{
    return fmin(fmax(s, pm_curve_bound(frame, curve, PM_CURVE_FROM)),
                pm_curve_bound(frame, curve, PM_CURVE_TO));
}

static pm_curve_place place_of(const pm_curve_series *c, double side, double s)
{
    const double first[2] = {c->x.c[1], c->y.c[1]}, second[2] = {2 * c->x.c[2], 2 * c->y.c[2]},
                 third[2] = {6 * c->x.c[3], 6 * c->y.c[3]};
    const double v = pm_length(first), across = pm_cross(first, second), along = pm_dot(first, second);
    const double cube = v * v * v;
    pm_curve_place x = {.s = s, .p = {c->x.c[0], c->y.c[0]}, .rate = side * v};
    for (int k = 0; k < 2; k++) x.t[k] = side * first[k] / v;
    x.n[0] = -x.t[1];
    x.n[1] = x.t[0];
    x.quickens = pm_dot(second, x.t);
    x.bend = side * across / cube;
    x.bend_rate = (pm_cross(first, third) * v * v - 3 * across * along) / (cube * cube);
    return x;
}

pm_curve_place pm_curve_along(const pm_frame *frame, int curve, double s, double of)
{
    const int32_t *e = PM_CURVE_ROW(frame->model, curve);
    const double in = pm_curve_has_pieces(frame->model, curve) ? of : s,
                 laps = pm_curve_laps(frame, curve, in);
    const int is_round = pm_curve_is_round(frame->model, curve);
    const double known = is_round ? s - laps : within(frame, curve, s);
    pm_curve_series c = series_at(frame, curve, known, within(frame, curve, in - laps));
    if (!is_round && s != known) {
        c.x = moved(&c.x, s - known);
        c.y = moved(&c.y, s - known);
    }
    return place_of(&c, e[PM_CURVE_SIDE], s);
}

pm_curve_place pm_curve_at(const pm_frame *frame, int curve, double s)
{
    return pm_curve_along(frame, curve, s, s);
}

/* ---- the foot ---- */
double pm_curve_turn_along(const pm_curve_place *x, double way)
{
    return fabs(way) * (fabs(x->bend) + 0.5 * fabs(x->bend_rate * way));
}

/* The longest way along which it turns by `turn`. */
static double way_of_turn(const pm_curve_place *x, double turn)
{
    const double bend = fabs(x->bend);
    return 2 * turn / (bend + sqrt(bend * bend + 2 * turn * fabs(x->bend_rate)));
}

double pm_curve_step(const pm_curve_place *x, double way)
{
    const double square = x->rate * x->rate + 2 * x->quickens * way;
    const double root = square > 0 ? sqrt(square) : fabs(x->rate);
    return 2 * way / (x->rate + copysign(root, x->rate));
}

/* The longest way on which the foot stays one, and the next is not come to: part of that to where the slope 1 - bend h is 0. */
static double way_of_basin(const pm_curve_place *x, double height, double slope)
{
    return slope > PM_CURVE_CENTRE ? PM_CURVE_BASIN * slope / fabs(x->bend_rate * height) : INFINITY;
}

/* The way to the foot as Newton's method has it; beyond the centre of curvature as far as may be. */
static double way_to_foot(const pm_curve_place *x, const double d[2])
{
    const double along = pm_dot(d, x->t), height = pm_dot(d, x->n), slope = 1 - x->bend * height;
    const double most = fmin(way_of_turn(x, PM_CURVE_STEP), way_of_basin(x, height, slope));
    if (slope > PM_CURVE_CENTRE && fabs(along) < most * slope) return along / slope;
    return copysign(most, along);
}

/* On the piece of `of`; not a number: on that of each place. */
static pm_curve_place search(const pm_frame *frame, int curve, const double x[2], double s, double of,
                             double *height)
{
    const double all =
        pm_curve_bound(frame, curve, PM_CURVE_TO) - pm_curve_bound(frame, curve, PM_CURVE_FROM);
    const double most = pm_curve_is_endless(frame->model, curve) ? INFINITY : PM_CURVE_PART * all;
    double turned = 0;
    for (int tries = 0, last = 0; tries < PM_CURVE_STEPS; tries++) {
        const pm_curve_place at = pm_curve_along(frame, curve, s, isnan(of) ? s : of);
        const double d[2] = {x[0] - at.p[0], x[1] - at.p[1]}, way = way_to_foot(&at, d);
        const double nothing = PM_CURVE_FOUND * PM_EPSILON * (pm_length(x) + pm_length(at.p));
        *height = pm_dot(d, at.n);
        if (last || fabs(way) <= nothing) return at;
        if (!(turned <= PM_CURVE_WINDOW)) break;
        turned += pm_curve_turn_along(&at, way);
        const double whole = pm_curve_step(&at, way), step = fmin(fmax(whole, -most), most);
        last = step == whole && pm_curve_turn_along(&at, way) <= PM_CURVE_LAST;
        s += step;
    }
    *height = NAN;
    return (pm_curve_place){.s = NAN, .p = {NAN, NAN}, .t = {NAN, NAN}, .n = {NAN, NAN}};
}

pm_curve_place pm_curve_foot(const pm_frame *frame, int curve, const double x[2], double s, double *height)
{
    return search(frame, curve, x, s, NAN, height);
}

pm_curve_place pm_curve_foot_along(const pm_frame *frame, int curve, const double x[2], double s,
                                   double *height)
{
    return search(frame, curve, x, s, s, height);
}

/* ---- lengths ---- */
typedef struct pm_curve_line {
    const pm_frame *frame;
    int curve;
    double of;
} pm_curve_line;

static double rate_at(double s, void *of)
{
    const pm_curve_line *x = of;
    return pm_curve_along(x->frame, x->curve, s, x->of).rate;
}

/* By Patterson's quadrature, in halves where it does not come to an end. */
static double way_of(gsl_function *f, double from, double to, int halvings)
{
    double way, error;
    size_t n;
    const int status = gsl_integration_qng(f, from, to, 0, PM_CURVE_LENGTH, &way, &error, &n);
    if (status == GSL_SUCCESS || halvings == 0) return way;
    const double middle = 0.5 * (from + to);
    return way_of(f, from, middle, halvings - 1) + way_of(f, middle, to, halvings - 1);
}

double pm_curve_way(const pm_frame *frame, int curve, double from, double to, double of)
{
    pm_curve_line x = {frame, curve, of};
    gsl_function f = {.function = rate_at, .params = &x};
    return from == to ? 0 : way_of(&f, from, to, PM_CURVE_HALVINGS);
}

/* ---- looking at all of it ---- */
static double sample(const pm_frame *frame, int curve, int i)
{
    const double from = pm_curve_bound(frame, curve, PM_CURVE_FROM),
                 to = pm_curve_bound(frame, curve, PM_CURVE_TO);
    return from + (to - from) * i / PM_CURVE_SAMPLES;
}

static double distance_at(const pm_frame *frame, int curve, const double x[2], int i)
{
    const pm_curve_place at = pm_curve_at(frame, curve, sample(frame, curve, i));
    return hypot(x[0] - at.p[0], x[1] - at.p[1]);
}

pm_curve_place pm_curve_nearest(const pm_frame *frame, int curve, const double x[2], double *height)
{
    double least = INFINITY, before = INFINITY, here = distance_at(frame, curve, x, 0);
    pm_curve_place best = {.s = NAN, .p = {NAN, NAN}, .t = {NAN, NAN}, .n = {NAN, NAN}};
    *height = NAN;
    for (int i = 0; i <= PM_CURVE_SAMPLES; i++) {
        const double after = i < PM_CURVE_SAMPLES ? distance_at(frame, curve, x, i + 1) : INFINITY;
        if (here <= before && here <= after) {
            double h;
            const pm_curve_place at = pm_curve_foot(frame, curve, x, sample(frame, curve, i), &h);
            if (fabs(h) < least) {
                least = fabs(h);
                *height = h;
                best = at;
            }
        }
        before = here;
        here = after;
    }
    return best;
}

double pm_curve_room(const pm_frame *frame, int curve, const pm_curve_place *x)
{
    if (!pm_curve_has_ends(frame->model, curve)) return INFINITY;
    const double from = pm_curve_bound(frame, curve, PM_CURVE_FROM),
                 to = pm_curve_bound(frame, curve, PM_CURVE_TO);
    const int first = x->s - from < to - x->s;
    const pm_curve_place end = pm_curve_at(frame, curve, first ? from : to);
    const double room = hypot(x->p[0] - end.p[0], x->p[1] - end.p[1]);
    return x->s < from || x->s > to ? -room : room;
}

double pm_curve_extent(const pm_frame *frame, int curve)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i <= PM_CURVE_SAMPLES; i++) {
        const pm_curve_place at = pm_curve_at(frame, curve, sample(frame, curve, i));
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], at.p[k]);
            high[k] = fmax(high[k], at.p[k]);
        }
    }
    return hypot(high[0] - low[0], high[1] - low[1]);
}

/* ---- what must hold of it ---- */
static int bad(pm_workspace *w, int curve, int column, double value, double bound)
{
    return pm_fail_member(&w->result, PM_BAD_VALUE, PM_TABLE_CURVE, curve, column, value, bound);
}

/* A cusp between two samples: there the direction turns back. */
static int has_cusp(const pm_curve_place *a, const pm_curve_place *b, double size)
{
    return !(fmin(fabs(a->rate), fabs(b->rate)) > PM_CURVE_CUSP * size) || pm_dot(a->t, b->t) < 0;
}

int pm_curve_check(pm_workspace *w, int curve)
{
    const pm_frame *frame = &w->frame;
    const double from = pm_curve_bound(frame, curve, PM_CURVE_FROM),
                 to = pm_curve_bound(frame, curve, PM_CURVE_TO);
    if (!isfinite(from)) return bad(w, curve, PM_CURVE_FROM, from, 0);
    if (!isfinite(to) || !(to > from)) return bad(w, curve, PM_CURVE_TO, to, from);
    const double extent = pm_curve_extent(frame, curve), size = extent / (to - from);
    pm_curve_place before = pm_curve_at(frame, curve, from);
    for (int i = 0; i <= PM_CURVE_SAMPLES; i++) {
        const double s = sample(frame, curve, i);
        const pm_curve_place at = pm_curve_at(frame, curve, s);
        const double far = pm_max(fabs(at.p[0]), fabs(at.p[1]));
        if (!isfinite(at.p[0]) || !(far <= PM_CURVE_FARTHEST) || !isfinite(at.rate))
            return bad(w, curve, PM_CURVE_X, s, PM_CURVE_FARTHEST);
        if (has_cusp(&before, &at, size)) return bad(w, curve, PM_CURVE_Y, s, NAN);
        if (pm_curve_is_endless(frame->model, curve) && at.bend != 0)
            return bad(w, curve, PM_CURVE_CLOSED, at.bend, 0);
        before = at;
    }
    if (!pm_curve_is_round(frame->model, curve)) return PM_OK;
    const pm_curve_series a = series_at(frame, curve, from, from), b = series_at(frame, curve, to, to);
    const double gap = hypot(a.x.c[0] - b.x.c[0], a.y.c[0] - b.y.c[0]);
    return gap <= PM_CURVE_CLOSES * extent ? PM_OK
                                           : bad(w, curve, PM_CURVE_CLOSED, gap, PM_CURVE_CLOSES * extent);
}
