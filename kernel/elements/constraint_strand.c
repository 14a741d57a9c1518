/* constraint_strand.c - a straight strand of cord or belt between two circles (a point: radius 0) on which it does not slip.
 *
 * Going along the strand from a to b one passes each circle counterclockwise (R > 0) or clockwise (R < 0).  With u the
 * direction of the strand, n = k x u, psi its angle, d = p_b - p_a, h = R_b - R_a:
 *   d = l u + h n,   l = sqrt(d^2 - h^2),   tangent points P = p - R n
 * What is wound on the circles before a and behind b changes by R_a (psi - angle_a) and -R_b (psi - angle_b), the rest of
 * the cord is in the strand; its slack is
 *   C = anchor + h psi + R_a angle_a - R_b angle_b - l
 * From d' = l' u + psi' (l n - h u):  h psi' - l' = -d'.u  and  psi' = d'.n / l, so that
 *   Cdot = u.(v_a - v_b) + R_a omega_a - R_b omega_b,   the relative velocity of the cord's ends at the tangent points
 *   gamma = (d'.n)^2 / l - u.quad
 * The reaction is the tension: it pulls a along u. */
#include <math.h>

#include "elements/constant_motion.h"
#include "elements/constraint.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

typedef struct pm_strand {
    double u[2], n[2], length, direction; /* in (-pi, pi] */
} pm_strand;

static pm_strand strand_of(const pm_constraint *c, const double d[2])
{
    const double h = c->radius_b - c->radius_a, square = pm_dot(d, d);
    pm_strand x = {.length = sqrt(square - h * h)};
    for (int k = 0; k < 2; k++) {
        const double across = k == 0 ? d[1] : -d[0]; /* -k x d */
        x.u[k] = (x.length * d[k] + h * across) / square;
    }
    x.n[0] = -x.u[1];
    x.n[1] = x.u[0];
    x.direction = atan2(x.u[1], x.u[0]);
    return x;
}

static double unwrapped(double direction, double reference)
{
    return direction + 2 * M_PI * round((reference - direction) / (2 * M_PI));
}

/* The slack but for the anchor. */
static double paid_out(const pm_frame *frame, const pm_constraint *c, const pm_strand *x, double direction)
{
    const double *pose = frame->pose;
    return (c->radius_b - c->radius_a) * direction + c->radius_a * pose[5 * c->body[0] + 2] -
           c->radius_b * pose[5 * c->body[1] + 2] - x->length;
}

static pm_strand look(const pm_frame *frame, const pm_constraint *c, pm_marks *marks)
{
    *marks = pm_constraint_marks(frame, c);
    const double d[2] = {-marks->d[0], -marks->d[1]};
    return strand_of(c, d);
}

void pm_constraint_strand_look(const pm_frame *frame, pm_constraint *c, double reference, double *direction)
{
    pm_marks y;
    const pm_strand x = look(frame, c, &y);
    const double across = pm_dot(y.u, x.n);
    *direction = unwrapped(x.direction, reference);
    pm_constraint_along(c->j, &y, x.u, 1);
    c->j[2] += c->radius_a;
    c->j[5] -= c->radius_b;
    c->g = paid_out(frame, c, &x, *direction);
    c->gamma = across * across / x.length - pm_dot(x.u, y.quad);
}

static void evaluate(const pm_frame *frame, pm_constraint *c)
{
    const pm_memory *memory = &frame->memory[c->memory];
    double direction;
    pm_constraint_strand_look(frame, c, memory->direction, &direction);
    c->g += memory->anchor;
}

static void remember(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    pm_marks y;
    const pm_strand x = look(frame, c, &y);
    memory->direction = anchor_too ? x.direction : unwrapped(x.direction, memory->direction);
    if (anchor_too) memory->anchor = -paid_out(frame, c, &x, memory->direction);
}

static void act(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    pm_marks y;
    const pm_strand strand = look(frame, c, &y);
    x->couple[0] = x->couple[1] = 0;
    for (int k = 0; k < 2; k++) {
        x->at[k] = y.a.p[k] - c->radius_a * strand.n[k];
        x->direction[k] = strand.u[k];
    }
}

/* The strand keeps its direction: its ends part along it. */
static int steady(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    if (!pm_constant_motion_marks(frame, c, x)) return 0;
    pm_marks y;
    const pm_strand strand = look(frame, c, &y);
    double speed = 0, acceleration = 0;
    for (int k = 0; k < 2; k++) {
        const int a = 3 * c->body[0] + k, b = 3 * c->body[1] + k;
        speed += (x->v[a] - x->v[b]) * strand.n[k];
        acceleration += (x->a[a] - x->a[b]) * strand.n[k];
    }
    return fabs(speed) <= x->speed && fabs(acceleration) <= x->acceleration;
}

void pm_constraint_strand_course(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x,
                                 double course[3])
{
    pm_marks y;
    const pm_strand strand = look(frame, c, &y);
    course[0] = isnan(strand.length) ? 0 : strand.length;
    course[1] = course[2] = 0;
    for (int k = 0; k < 2; k++) {
        const int a = 3 * c->body[0] + k, b = 3 * c->body[1] + k;
        course[1] += (x->v[b] - x->v[a]) * strand.u[k];
        course[2] += (x->a[b] - x->a[a]) * strand.u[k];
    }
}

/* C'' = u.d'' + R_a alpha_a - R_b alpha_b - (d'.n)^2 / l: the last part counts against, as long as some strand is left. */
static void bound(const pm_frame *frame, const pm_constraint *c, const double *a, double h,
                  pm_constraint_bounds *x)
{
    const pm_marks m = pm_constraint_marks(frame, c);
    const pm_constraint_reach r = pm_constraint_reach_of(c, &m, a, h);
    const double alpha_a = a[3 * c->body[0] + 2], alpha_b = a[3 * c->body[1] + 2];
    const double past = c->radius_b - c->radius_a, nearest = pm_length(m.d) - r.rate * h;
    const double square = nearest * fabs(nearest) - past * past;
    const double wound = c->radius_a * alpha_a - c->radius_b * alpha_b;
    x->rate = r.rate + fabs(c->radius_a) * (fabs(m.omega_a) + fabs(alpha_a) * h) +
              fabs(c->radius_b) * (fabs(m.omega_b) + fabs(alpha_b) * h);
    x->exact = 0;
    x->bend = square > 0 ? wound - pm_length(r.apart) - r.swing - r.rate * r.rate / sqrt(square) : -INFINITY;
}

double pm_constraint_strand_left(const pm_frame *frame, const pm_constraint *c, double *approach)
{
    const pm_marks y = pm_constraint_marks(frame, c);
    const double h = c->radius_b - c->radius_a, square = pm_dot(y.d, y.d) - h * h;
    *approach = pm_dot(y.d, y.u);
    if (fabs(*approach) <= PM_STRAND_ACROSS * pm_length(y.d) * pm_length(y.u)) *approach = 0;
    return square > 0 ? sqrt(square) : 0;
}

const pm_constraint_ops pm_constraint_strand = {
    .evaluate = evaluate, .act = act, .remember = remember, .steady = steady, .bound = bound};
