/* constraint_belt.c - a belt round two circles does not slip: as much of it runs off one as runs up on the other.
 *
 * Going along the strand that leaves circle a counterclockwise one passes b counterclockwise (R_b > 0: an open belt) or
 * clockwise (R_b < 0: a crossed one); R_a > 0.  With C_1 and C_2 what this strand and the other are slack
 * (constraint_strand.c), phi the angle of d = p_b - p_a, D = |d|, h = R_b - R_a, n = d/D, t = k x n, u = v_a - v_b:
 *   S = (C_1 - C_2) / 2 = anchor + R_a angle_a - R_b angle_b + h phi
 *   Sdot = R_a omega_a - R_b omega_b - (h/D) u.t        gamma = (h/D) (quad.t + 2 (u.n) (u.t) / D)
 * Its reaction F = T_1 - T_2 is the difference of the tensions: on a it is F R_a, a couple, and -F (h/D) t at p_a.  What
 * holds the belt tight, (T_1 + T_2) / 2, is none of its business. */
#include <math.h>

#include "elements/constant_motion.h"
#include "elements/constraint.h"
#include "state/workspace.h"

/* The way from a to b. */
typedef struct pm_belt {
    pm_marks marks;
    double n[2], t[2], distance;
    double lever; /* h/D: the sine of the angle of a strand with the line of centres */
} pm_belt;

static pm_belt look(const pm_frame *frame, const pm_constraint *c)
{
    pm_belt x = {.marks = pm_constraint_marks(frame, c)};
    x.distance = pm_length(x.marks.d);
    for (int k = 0; k < 2; k++) x.n[k] = -x.marks.d[k] / x.distance;
    x.t[0] = -x.n[1];
    x.t[1] = x.n[0];
    x.lever = (c->radius_b - c->radius_a) / x.distance;
    return x;
}

/* The angle of the way, next to where it was. */
static double direction_of(const pm_belt *x, double reference)
{
    const double direction = atan2(x->n[1], x->n[0]);
    return direction + 2 * M_PI * round((reference - direction) / (2 * M_PI));
}

static double passed(const pm_frame *frame, const pm_constraint *c, double direction)
{
    const double *pose = frame->pose;
    return c->radius_a * pose[5 * c->body[0] + 2] - c->radius_b * pose[5 * c->body[1] + 2] +
           (c->radius_b - c->radius_a) * direction;
}

static void evaluate(const pm_frame *frame, pm_constraint *c)
{
    const pm_memory *memory = &frame->memory[c->memory];
    const pm_belt x = look(frame, c);
    pm_constraint_along(c->j, &x.marks, x.t, -x.lever);
    c->j[2] += c->radius_a;
    c->j[5] -= c->radius_b;
    c->g = passed(frame, c, direction_of(&x, memory->direction)) + memory->anchor;
    c->gamma = x.lever *
               (pm_dot(x.marks.quad, x.t) + 2 * pm_dot(x.marks.u, x.n) * pm_dot(x.marks.u, x.t) / x.distance);
}

static void remember(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    const pm_belt x = look(frame, c);
    memory->direction = direction_of(&x, anchor_too ? 0 : memory->direction);
    if (anchor_too) memory->anchor = -passed(frame, c, memory->direction);
}

/* The rest of what the force is at p_b is the couple on b: (h/D) D - R_b = -R_a. */
static void act(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    const pm_belt y = look(frame, c);
    for (int k = 0; k < 2; k++) {
        x->at[k] = y.marks.a.p[k];
        x->direction[k] = -y.lever * y.t[k];
    }
    x->couple[0] = c->radius_a;
    x->couple[1] = -c->radius_a;
}

const pm_constraint_ops pm_constraint_belt = {
    .evaluate = evaluate, .act = act, .remember = remember, .steady = pm_constant_motion_together};
