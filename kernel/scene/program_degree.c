/* program_degree.c - abstract interpretation of programs while accelerations and reactions are constant: each stack entry carries
 * its degree in the time instead of a number.  Speeds are linear, places and angles quadratic, and so are energies. */
#include "scene/program_degree.h"

#include "elements/joint_friction.h"
#include "elements/measure.h"
#include "expression/operation.h"
#include "state/frame.h"
#include "state/workspace.h"

/* ---- measures ---- */
static int observer_rotates(const pm_frame *frame, const pm_constant_motion *x, const int32_t *e)
{
    return e[PM_MEASURE_IN] != PM_NONE && x->rotates[pm_model_body_index(frame->model, e[PM_MEASURE_IN])];
}

/* Gap and slip are on a straight line that keeps its direction. */
static int line_is_steady(const pm_frame *frame, const pm_constant_motion *x, int contact)
{
    const int32_t *c = PM_CONTACT_ROW(frame->model, contact);
    if (c[PM_CONTACT_KIND] != PM_CONTACT_LINE) return 0;
    const int body =
        pm_model_body_index(frame->model, pm_model_body_of(frame->model, PM_TABLE_LINE, c[PM_CONTACT_B]));
    return !x->rotates[body] &&
           pm_constant_motion_point(frame, x, PM_CIRCLE_ROW(frame->model, c[PM_CONTACT_A])[PM_CIRCLE_POINT]);
}

/* The Jacobian of the slip stays as it is. */
static int slip_is_steady(const pm_frame *frame, const pm_constant_motion *x, int joint)
{
    pm_constraint c;
    if (pm_joint_friction_find(frame, joint, &c) == PM_NONE) return 0;
    const pm_constraint_ops *ops = pm_constraint_kind(c.kind);
    return ops->steady && ops->steady(frame, &c, x);
}

/* What a measure is of lets it be the polynomial that its kind is. */
static int is_steady(const pm_frame *frame, const pm_constant_motion *x, const int32_t *e)
{
    switch ((enum pm_measure_kind)e[PM_MEASURE_KIND]) {
    case PM_MEASURE_INERTIA: return e[PM_MEASURE_ABOUT] == PM_NONE;
    case PM_MEASURE_ANGULAR_MOMENTUM: return e[PM_MEASURE_A] != PM_NONE && e[PM_MEASURE_ABOUT] == PM_NONE;
    case PM_MEASURE_POSITION:
    case PM_MEASURE_MOVED:
    case PM_MEASURE_VELOCITY:
    case PM_MEASURE_ACCELERATION:
        return !observer_rotates(frame, x, e) && pm_constant_motion_point(frame, x, e[PM_MEASURE_A]);
    case PM_MEASURE_CONTACT_GAP:
    case PM_MEASURE_CONTACT_SLIP: return line_is_steady(frame, x, e[PM_MEASURE_A]);
    case PM_MEASURE_JOINT_SLIP: return slip_is_steady(frame, x, e[PM_MEASURE_A]);
    default: return 1;
    }
}

/* Size and direction of a vector are no polynomials of its components, unless these are constant. */
static int measure_degree(const pm_frame *frame, const pm_constant_motion *x, int measure)
{
    const int32_t *e = PM_MEASURE_ROW(frame->model, measure);
    const pm_measure_ops *ops = pm_measure_kind(e[PM_MEASURE_KIND]);
    const int part = ops->vector ? e[PM_MEASURE_PART] : PM_PART_NONE;
    if (!is_steady(frame, x, e)) return PM_DEGREE_OTHER;
    if (e[PM_MEASURE_KIND] == PM_MEASURE_JOINT_COUPLE && x->levers)
        return 2; /* holds a body with moving levers */
    return (part == PM_PART_NORM || part == PM_PART_ANGLE) && ops->degree > 0 ? PM_DEGREE_OTHER : ops->degree;
}

/* ---- operators ---- */
static int bounded(int degree) { return degree > PM_DEGREE_MOST ? PM_DEGREE_OTHER : degree; }

/* What a degree is read of. */
typedef struct pm_curve_of {
    const pm_frame *frame;
    const pm_constant_motion *motion;
} pm_curve_of;

static int read_degree(const pm_program_walk *x, const void *of)
{
    const pm_curve_of *curve = of;
    return x->op == PM_OP_MEASURE ? measure_degree(curve->frame, curve->motion, x->arg) : 0;
}

static int alone(const pm_program_walk *x, int a)
{
    return x->op != PM_OP_NEG && a > 0 ? PM_DEGREE_OTHER : a;
}

/* It squares: its second operand is the constant two. */
static int squares(const pm_program_walk *x)
{
    const int32_t *before = x->next - 2 * PM_CODE_COLUMNS;
    return x->op == PM_OP_POW && before[PM_CODE_OP] == PM_OP_CONSTANT &&
           x->m->constant[before[PM_CODE_ARG]] == 2;
}

static int combine(const pm_program_walk *x, int a, int b)
{
    switch (x->op) {
    case PM_OP_ADD:
    case PM_OP_SUB: return a > b ? a : b;
    case PM_OP_MUL: return bounded(a + b);
    case PM_OP_DIV: return b == 0 ? a : PM_DEGREE_OTHER;
    case PM_OP_PIECE:
        return bounded(
            a * pm_model_row(x->m, PM_TABLE_PIECEWISE, x->arg, PM_PIECEWISE_COLUMNS)[PM_PIECEWISE_DEGREE_OF]);
    default:
        if (squares(x)) return bounded(2 * a);
        return a == 0 && b == 0 ? 0 : PM_DEGREE_OTHER;
    }
}

int pm_program_degree_of(const pm_frame *frame, const pm_constant_motion *x, int program)
{
    static const pm_program_rules rules = {read_degree, alone, combine};
    return pm_program_rules_apply(frame->model, program, &rules, &(pm_curve_of){frame, x});
}

int pm_program_degree_is_size(const pm_frame *frame, const pm_constant_motion *x, int program)
{
    pm_program_walk read = pm_program_walk_begin(frame->model, program);
    if (!pm_program_walk_next(&read) || read.next != read.end || read.op != PM_OP_MEASURE) return 0;
    const int32_t *e = PM_MEASURE_ROW(frame->model, read.arg);
    if (e[PM_MEASURE_PART] != PM_PART_NORM) return 0;
    if (e[PM_MEASURE_KIND] == PM_MEASURE_MOMENTUM) return 1;
    return e[PM_MEASURE_KIND] == PM_MEASURE_VELOCITY && !observer_rotates(frame, x, e) &&
           pm_constant_motion_point(frame, x, e[PM_MEASURE_A]);
}
