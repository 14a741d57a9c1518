/* constraint_teeth.c - toothed wheels, and a toothed wheel on a rack: involute teeth whose flanks meet at a pressure angle.
 *
 * With t and n the tangent and the normal of the pitch curves where they touch, C_t their slip (constraint_tangent.c,
 * constraint_line.c) and C_n how far apart they are (constraint_distance.c, constraint_line.c), the flanks that are loaded
 * touch along the line of action, at the pressure angle phi from t:
 *   C = s cos(phi) C_t + sin(phi) C_n        s = 1, -1: the flank that pushes a along t, or against it (teeth.h)
 * The reaction is the force of the flanks on a, which pushes: along s cos(phi) t + sin(phi) n, through the point where the
 * pitch curves touch.  What holds C_n carries the part that drives the teeth apart. */
#include "elements/constant_motion.h"
#include "elements/constraint.h"
#include "elements/teeth.h"
#include "state/workspace.h"

/* The constraints that it is made of. */
typedef struct pm_pitch {
    const pm_constraint_ops *tangent, *normal;
} pm_pitch;

static const pm_pitch wheels = {&pm_constraint_circle_tangent, &pm_constraint_distance};
static const pm_pitch on_rack = {&pm_constraint_line_tangent, &pm_constraint_line_normal};

static void evaluate(const pm_pitch *of, const pm_frame *frame, pm_constraint *c)
{
    pm_constraint t = *c, n = *c;
    of->tangent->evaluate(frame, &t);
    of->normal->evaluate(frame, &n);
    const double along = pm_teeth_flank(frame, c) * c->teeth[0], across = c->teeth[1];
    for (int k = 0; k < 6; k++) c->j[k] = along * t.j[k] + across * n.j[k];
    c->g = along * t.g + across * n.g;
    c->gamma = along * t.gamma + across * n.gamma;
}

static void act(const pm_pitch *of, const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    pm_line_of_action n;
    of->tangent->act(frame, c, x);
    of->normal->act(frame, c, &n);
    for (int k = 0; k < 2; k++)
        x->direction[k] =
            pm_teeth_flank(frame, c) * c->teeth[0] * x->direction[k] + c->teeth[1] * n.direction[k];
}

static int steady(const pm_pitch *of, const pm_frame *frame, const pm_constraint *c,
                  const pm_constant_motion *x)
{
    return of->tangent->steady(frame, c, x) && of->normal->steady(frame, c, x);
}

static void evaluate_wheels(const pm_frame *frame, pm_constraint *c) { evaluate(&wheels, frame, c); }
static void evaluate_rack(const pm_frame *frame, pm_constraint *c) { evaluate(&on_rack, frame, c); }

static void act_wheels(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    act(&wheels, frame, c, x);
}
static void act_rack(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    act(&on_rack, frame, c, x);
}

static void remember_wheels(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    wheels.tangent->remember(frame, c, memory, anchor_too);
}
static void remember_rack(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    on_rack.tangent->remember(frame, c, memory, anchor_too);
}

static int steady_wheels(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    return steady(&wheels, frame, c, x);
}
static int steady_rack(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    return steady(&on_rack, frame, c, x);
}

/* The slip of the pitch circles is not quicker, and its rate does not change by more beside that of the rotations: the line
 * of centres turns by no more than what their centres do. */
static void bound_wheels(const pm_frame *frame, const pm_constraint *c, const double *a, double h,
                         pm_constraint_bounds *x)
{
    const pm_marks m = pm_constraint_marks(frame, c);
    const pm_constraint_reach r = pm_constraint_reach_of(c, &m, a, h);
    const double alpha_a = a[3 * c->body[0] + 2], alpha_b = a[3 * c->body[1] + 2],
                 s = pm_teeth_flank(frame, c), nearest = pm_length(m.d) - r.rate * h;
    const double turn = nearest > 0 ? r.rate / nearest : INFINITY,
                 hardest = r.rate > 0 || r.swing > 0 || pm_length(r.apart) > 0
                               ? (pm_length(r.apart) + r.swing) / nearest + 2 * turn * turn
                               : 0;
    wheels.normal->bound(frame, c, a, h, x);
    x->rate =
        c->teeth[1] * x->rate +
        c->teeth[0] * (fabs(c->value) * turn + fabs(c->radius_a) * (fabs(m.omega_a) + fabs(alpha_a) * h) +
                       fabs(c->radius_b) * (fabs(m.omega_b) + fabs(alpha_b) * h));
    x->bend = c->teeth[1] * x->bend -
              c->teeth[0] * (s * (c->radius_a * alpha_a + c->radius_b * alpha_b) + fabs(c->value) * hardest);
    if (!(nearest > 0)) x->bend = -INFINITY;
    x->exact = 0;
}

static void bound_rack(const pm_frame *frame, const pm_constraint *c, const double *a, double h,
                       pm_constraint_bounds *x)
{
    const pm_marks m = pm_constraint_marks(frame, c);
    const pm_constraint_reach r = pm_constraint_reach_of(c, &m, a, h);
    const double alpha_a = a[3 * c->body[0] + 2], alpha_b = a[3 * c->body[1] + 2];
    const double slides = pm_length(r.apart) + r.swing + 2 * r.omega * r.rate + r.spin * r.distance;
    on_rack.normal->bound(frame, c, a, h, x);
    x->rate = c->teeth[1] * x->rate + c->teeth[0] * (r.rate + r.omega * r.distance +
                                                     c->radius_a * (fabs(m.omega_a) + fabs(m.omega_b) +
                                                                    (fabs(alpha_a) + fabs(alpha_b)) * h));
    x->bend = c->teeth[1] * x->bend - c->teeth[0] * (slides + c->radius_a * (fabs(alpha_a) + fabs(alpha_b)));
    x->exact = 0;
}

/* ---- how teeth slide on each other ---- */
/* As the wheels turn against each other they slide at a lever from where the pitch curves touch: r (angle_a - angle_b).  Friction
 * is a couple between the wheels. */
static double angle_between(const pm_frame *frame, const pm_constraint *c)
{
    return frame->pose[5 * c->body[0] + 2] - frame->pose[5 * c->body[1] + 2];
}

static void evaluate_slip(const pm_frame *frame, pm_constraint *c)
{
    for (int k = 0; k < PM_CONSTRAINT_COORDINATES; k++) c->j[k] = 0;
    c->j[2] = c->value;
    c->j[5] = -c->value;
    c->g = c->value * angle_between(frame, c) - frame->memory[c->memory].slip;
    c->gamma = 0;
}

static void act_slip(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    for (int k = 0; k < 2; k++) {
        x->at[k] = frame->pose[5 * c->body[0] + k];
        x->direction[k] = 0;
    }
    x->couple[0] = c->value;
    x->couple[1] = -c->value;
}

static void remember_slip(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    if (anchor_too) memory->slip = c->value * angle_between(frame, c);
}

static int steady_slip(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    (void)frame;
    (void)c;
    (void)x;
    return 1;
}

const pm_constraint_ops pm_constraint_teeth_slip = {
    .evaluate = evaluate_slip, .act = act_slip, .remember = remember_slip, .steady = steady_slip};
const pm_constraint_ops pm_constraint_teeth = {.evaluate = evaluate_wheels,
                                               .act = act_wheels,
                                               .remember = remember_wheels,
                                               .steady = steady_wheels,
                                               .bound = bound_wheels};
const pm_constraint_ops pm_constraint_rack = {.evaluate = evaluate_rack,
                                              .act = act_rack,
                                              .remember = remember_rack,
                                              .steady = steady_rack,
                                              .bound = bound_rack};
