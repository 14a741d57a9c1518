/* program_degree.c - abstract interpretation of programs while accelerations and reactions are constant: each stack entry carries
 * its degree in the time instead of a number.  Speeds are linear, places and angles quadratic, and so are energies. */
#include "scene/program_degree.h"

#include "expression/program.h"
#include "expression/program_class.h"
#include "state/frame.h"
#include "state/workspace.h"

/* ---- measures ---- */
static int observer_turns(const pm_frame *frame, const pm_constant_motion *x, const int32_t *e)
{
    return e[PM_MEASURE_IN] != PM_NONE && x->turns[pm_body_index(frame->model, e[PM_MEASURE_IN])];
}

static int point_is_steady(const pm_frame *frame, const pm_constant_motion *x, int point)
{
    const int32_t *p = PM_POINT_ROW(frame->model, point);
    const double at[2] = {frame->numbers->value[p[PM_POINT_X]], frame->numbers->value[p[PM_POINT_Y]]};
    return pm_constant_motion_mark(frame, x, pm_body_index(frame->model, p[PM_POINT_BODY]), at);
}

/* Size and direction of a vector are no polynomials of its components, unless these are constant. */
static int part(const int32_t *e, int degree)
{
    const int of_both = e[PM_MEASURE_PART] == PM_PART_NORM || e[PM_MEASURE_PART] == PM_PART_ANGLE;
    return of_both && degree > 0 ? PM_DEGREE_OTHER : degree;
}

static int of_point(const pm_frame *frame, const pm_constant_motion *x, const int32_t *e, int degree)
{
    if (observer_turns(frame, x, e) || !point_is_steady(frame, x, e[PM_MEASURE_A])) return PM_DEGREE_OTHER;
    return part(e, degree);
}

/* Gap and slip on a straight line that keeps its direction. */
static int of_contact(const pm_frame *frame, const pm_constant_motion *x, const int32_t *e, int degree)
{
    const int32_t *c = PM_CONTACT_ROW_OF(frame->model, e[PM_MEASURE_A]);
    if (c[PM_CONTACT_KIND] != PM_CONTACT_LINE) return PM_DEGREE_OTHER;
    const int line = PM_LINE_ROW(frame->model, c[PM_CONTACT_B])[PM_LINE_POINT];
    const int point = PM_CIRCLE_ROW(frame->model, c[PM_CONTACT_A])[PM_CIRCLE_POINT];
    const int body = pm_body_index(frame->model, PM_POINT_ROW(frame->model, line)[PM_POINT_BODY]);
    return !x->turns[body] && point_is_steady(frame, x, point) ? degree : PM_DEGREE_OTHER;
}

static int measure_degree(const pm_frame *frame, const pm_constant_motion *x, int measure)
{
    const int32_t *e = PM_MEASURE_ROW(frame->model, measure);
    switch ((enum pm_measure_kind)e[PM_MEASURE_KIND]) {
    case PM_MEASURE_ALPHA:
    case PM_MEASURE_MASS:
    case PM_MEASURE_WEIGHT:
    case PM_MEASURE_JOINT_FORCE:
    case PM_MEASURE_JOINT_IMPULSE:
    case PM_MEASURE_JOINT_NORMAL:
    case PM_MEASURE_JOINT_FRICTION:
    case PM_MEASURE_JOINT_FRICTION_NEEDED:
    case PM_MEASURE_CONTACT_CLOSED:
    case PM_MEASURE_CONTACT_NORMAL:
    case PM_MEASURE_CONTACT_FRICTION:
    case PM_MEASURE_CONTACT_FRICTION_NEEDED:
    case PM_MEASURE_CONTACT_FORCE:
    case PM_MEASURE_CONTACT_IMPULSE:
    case PM_MEASURE_FORCE_FORCE:
    case PM_MEASURE_FORCE_COUPLE:
    case PM_MEASURE_EVENT_COUNT: /* they change at instants only */
    case PM_MEASURE_EVENT_TIME:
    case PM_MEASURE_LOST: return 0;
    case PM_MEASURE_TIME:
    case PM_MEASURE_OMEGA:
    case PM_MEASURE_FORCE_POWER: return 1;
    case PM_MEASURE_JOINT_COUPLE: return x->levers ? 2 : 0; /* holds a body with moving levers */
    case PM_MEASURE_ANGLE:
    case PM_MEASURE_TURNED:
    case PM_MEASURE_KINETIC:
    case PM_MEASURE_POTENTIAL:
    case PM_MEASURE_TOTAL: return 2;
    case PM_MEASURE_INERTIA: return e[PM_MEASURE_ABOUT] == PM_NONE ? 0 : PM_DEGREE_OTHER;
    case PM_MEASURE_MOMENTUM: return part(e, 1);
    case PM_MEASURE_ANGULAR_MOMENTUM:
        return e[PM_MEASURE_A] != PM_NONE && e[PM_MEASURE_ABOUT] == PM_NONE ? 1 : PM_DEGREE_OTHER;
    case PM_MEASURE_POSITION:
    case PM_MEASURE_MOVED: return of_point(frame, x, e, 2);
    case PM_MEASURE_VELOCITY: return of_point(frame, x, e, 1);
    case PM_MEASURE_ACCELERATION: return of_point(frame, x, e, 0);
    case PM_MEASURE_CONTACT_GAP: return of_contact(frame, x, e, 2);
    case PM_MEASURE_CONTACT_SLIP: return of_contact(frame, x, e, 1);
    default: return PM_DEGREE_OTHER;
    }
}

/* ---- operators ---- */
static int bounded(int degree) { return degree > PM_DEGREE_MOST ? PM_DEGREE_OTHER : degree; }

static int combine(int op, int a, int b)
{
    switch (op) {
    case PM_OP_ADD:
    case PM_OP_SUB: return a > b ? a : b;
    case PM_OP_MUL: return bounded(a + b);
    case PM_OP_DIV: return b == 0 ? a : PM_DEGREE_OTHER;
    default: return a == 0 && b == 0 ? 0 : PM_DEGREE_OTHER;
    }
}

/* The power at code[i] squares. */
static int squares(const pm_model *m, const int32_t *code)
{
    const int32_t *before = code - PM_CODE_COLUMNS;
    return code[PM_CODE_OP] == PM_OP_POW && before[PM_CODE_OP] == PM_OP_CONSTANT &&
           m->constant[before[PM_CODE_ARG]] == 2;
}

int pm_program_degree_of(const pm_frame *frame, const pm_constant_motion *x, int program)
{
    int stack[PM_STACK], top = -1, length;
    const int32_t *code = pm_program_code(frame->model, program, &length);
    for (int i = 0; i < length; i++, code += PM_CODE_COLUMNS) {
        const int op = code[PM_CODE_OP], takes = pm_program_operands(op);
        if (takes == 0) {
            stack[++top] = op == PM_OP_MEASURE ? measure_degree(frame, x, code[PM_CODE_ARG]) : 0;
        } else if (takes == 1) {
            if (op != PM_OP_NEG && stack[top] > 0) stack[top] = PM_DEGREE_OTHER;
        } else if (takes == 2) {
            top--;
            stack[top] = squares(frame->model, code) ? bounded(2 * stack[top])
                                                     : combine(op, stack[top], stack[top + 1]);
        } else {
            top -= 2;
            stack[top] = combine(op, stack[top], combine(op, stack[top + 1], stack[top + 2]));
        }
    }
    return stack[0];
}

int pm_program_degree_is_size(const pm_frame *frame, const pm_constant_motion *x, int program)
{
    int length;
    const int32_t *code = pm_program_code(frame->model, program, &length);
    if (length != 1 || code[PM_CODE_OP] != PM_OP_MEASURE) return 0;
    const int32_t *e = PM_MEASURE_ROW(frame->model, code[PM_CODE_ARG]);
    if (e[PM_MEASURE_PART] != PM_PART_NORM) return 0;
    if (e[PM_MEASURE_KIND] == PM_MEASURE_MOMENTUM) return 1;
    return e[PM_MEASURE_KIND] == PM_MEASURE_VELOCITY && !observer_turns(frame, x, e) &&
           point_is_steady(frame, x, e[PM_MEASURE_A]);
}
