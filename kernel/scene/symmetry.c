/* symmetry.c - invariance of a scene under a shift along its lines and patterns, and under whole revolutions.
 *
 * A body that is rotated by anything but whole revolutions must be round: all marks by which it is held, touched or
 * pulled lie at its mass centre.  Weight is the same everywhere; the height that is lost or gained is the caller's
 * affair. */
#include "scene/symmetry.h"

#include <math.h>

#include "elements/force.h"
#include "elements/joint.h"
#include "elements/turning_plane.h"
#include "expression/operation.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

static int whole(double ratio) { return fabs(ratio - round(ratio)) <= PM_SYMMETRY_SAME; }

static double rotation_of(const pm_symmetry_shift *s, int body) { return body < 0 ? 0 : s->rotation[body]; }
static int is_rotated(const pm_symmetry_shift *s, int body)
{
    return !whole(rotation_of(s, body) / (2 * M_PI));
}
static int moved(const pm_symmetry_shift *s) { return s->by[0] != 0 || s->by[1] != 0; }

/* ---- marks ---- */
static int point_stays(const pm_frame *frame, const pm_symmetry_shift *s, int point)
{
    const int32_t *e = PM_POINT_ROW(frame->model, point);
    if (e[PM_POINT_BODY] == PM_GROUND) return !moved(s);
    return !is_rotated(s, e[PM_POINT_BODY]) ||
           (frame->numbers->value[e[PM_POINT_X]] == 0 && frame->numbers->value[e[PM_POINT_Y]] == 0);
}

static int circle_stays(const pm_frame *frame, const pm_symmetry_shift *s, int circle)
{
    return point_stays(frame, s, PM_CIRCLE_ROW(frame->model, circle)[PM_CIRCLE_POINT]);
}

static int line_stays(const pm_frame *frame, const pm_symmetry_shift *s, int line)
{
    const int32_t *e = PM_LINE_ROW(frame->model, line);
    const int body = pm_model_body_of(frame->model, PM_TABLE_LINE, line);
    if (body != PM_GROUND) return !is_rotated(s, body);
    const double angle = frame->numbers->value[e[PM_LINE_ANGLE]],
                 across = s->by[1] * cos(angle) - s->by[0] * sin(angle);
    return fabs(across) <= PM_SYMMETRY_SAME * hypot(s->by[0], s->by[1]);
}

static int pattern_stays(const pm_frame *frame, const pm_symmetry_shift *s, int row)
{
    const int32_t *e = PM_PATTERN_ROW(frame->model, row);
    const int body = pm_model_body_of(frame->model, PM_TABLE_PATTERN, row);
    if (body != PM_GROUND) return !is_rotated(s, body);
    if (!moved(s)) return 1;
    const double x = frame->numbers->value[e[PM_PATTERN_STEP_X]],
                 y = frame->numbers->value[e[PM_PATTERN_STEP_Y]], step = hypot(x, y);
    const double along = (s->by[0] * x + s->by[1] * y) / (step * step);
    const double across = (s->by[0] * y - s->by[1] * x) / (step * step);
    return frame->numbers->value[e[PM_PATTERN_COUNT]] < 0 && whole(along) && fabs(across) <= PM_SYMMETRY_SAME;
}

/* Two bodies keep their relative angle, whole revolutions included. */
static int together(const pm_symmetry_shift *s, int a, int b)
{
    return fabs(rotation_of(s, a) - rotation_of(s, b)) <= PM_SYMMETRY_SAME * 2 * M_PI;
}

static int mark_stays(const pm_frame *frame, const pm_symmetry_shift *s, int table, int mark)
{
    if (table == PM_TABLE_POINT) return point_stays(frame, s, mark);
    return table == PM_TABLE_LINE ? line_stays(frame, s, mark) : circle_stays(frame, s, mark);
}

/* ---- elements ---- */
static int joint_stays(const pm_frame *frame, const pm_symmetry_shift *s, int joint)
{
    const int32_t *e = PM_JOINT_ROW(frame->model, joint);
    const pm_joint_ops *ops = pm_joint_of(frame->model, joint);
    const int a = e[PM_JOINT_A], b = e[PM_JOINT_B];
    if (ops->repeats == PM_REPEATS_NEVER || !mark_stays(frame, s, ops->a, a) ||
        !mark_stays(frame, s, ops->b, b))
        return 0;
    return ops->repeats == PM_REPEATS_MARKS ||
           together(s, pm_model_body_of(frame->model, ops->a, a), pm_model_body_of(frame->model, ops->b, b));
}

static int contact_stays(const pm_frame *frame, const pm_symmetry_shift *s, int contact)
{
    const int32_t *e = PM_CONTACT_ROW(frame->model, contact);
    const int a = e[PM_CONTACT_A], b = e[PM_CONTACT_B];
    if (e[PM_CONTACT_KIND] == PM_CONTACT_CURVES || e[PM_CONTACT_CAPTURE] != PM_CAPTURE_NONE) return 0;
    if (!circle_stays(frame, s, a)) return 0;
    switch ((enum pm_contact_kind)e[PM_CONTACT_KIND]) {
    case PM_CONTACT_LINE: return line_stays(frame, s, b);
    case PM_CONTACT_CIRCLE: return circle_stays(frame, s, b);
    case PM_CONTACT_PATTERN: return pattern_stays(frame, s, b);
    default: return 0;
    }
}

static int program_stays(const pm_frame *frame, const pm_symmetry_shift *s, int program)
{
    double change;
    return pm_symmetry_program(frame, s, program, &change) && change == 0;
}

static int force_stays(const pm_frame *frame, const pm_symmetry_shift *s, int force)
{
    const int32_t *e = PM_FORCE_ROW(frame->model, force);
    const int a = e[PM_FORCE_A], b = e[PM_FORCE_B];
    switch ((enum pm_force_kind)e[PM_FORCE_KIND]) {
    case PM_FORCE_SPRING: return point_stays(frame, s, a) && point_stays(frame, s, b);
    case PM_FORCE_TORSION: return together(s, a, b);
    case PM_FORCE_APPLIED:
        return point_stays(frame, s, a) && !is_rotated(s, b) &&
               program_stays(frame, s, e[PM_FORCE_PROGRAM_X]) &&
               program_stays(frame, s, e[PM_FORCE_PROGRAM_Y]);
    case PM_FORCE_LINE:
        return point_stays(frame, s, a) && point_stays(frame, s, b) &&
               program_stays(frame, s, e[PM_FORCE_PROGRAM_X]);
    case PM_FORCE_COUPLE: return program_stays(frame, s, e[PM_FORCE_PROGRAM_X]);
    default: return 0;
    }
}

/* The inertia about the axis of a spin stays under whole revolutions in place. */
static int spin_stays(const pm_frame *frame, const pm_symmetry_shift *s)
{
    if (!pm_turning_plane_turns(frame->model)) return 1;
    for (int i = 0; i < frame->model->nbody; i++)
        if (is_rotated(s, i)) return 0;
    return !moved(s);
}

int pm_symmetry_holds(const pm_frame *frame, const pm_symmetry_shift *shift)
{
    const pm_model *m = frame->model;
    if (!spin_stays(frame, shift)) return 0;
    if (m->acts) return 0; /* what an event does is not part of a segment */
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++)
        if (!joint_stays(frame, shift, i)) return 0;
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++)
        if (!contact_stays(frame, shift, i)) return 0;
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        if (!force_stays(frame, shift, i)) return 0;
    return 1;
}

/* ---- programs ---- */
enum pm_response {
    NUMBER,
    SAME_VALUE,
    SHIFTED,
    LOST
}; /* a constant; unchanged; changed by `change`; unknown */

typedef struct pm_entry {
    int response;
    double number; /* the constant, or the change */
} pm_entry;

static pm_entry shifted(double change)
{
    return change == 0 ? (pm_entry){SAME_VALUE, 0} : (pm_entry){SHIFTED, change};
}

static const pm_entry lost = {LOST, 0}, same_value = {SAME_VALUE, 0};

static pm_entry place_of(const pm_frame *frame, const pm_symmetry_shift *s, const int32_t *e)
{
    const int body = pm_model_body_of(frame->model, PM_TABLE_POINT, e[PM_MEASURE_A]);
    if (body == PM_GROUND) return same_value;
    if (!moved(s)) return point_stays(frame, s, e[PM_MEASURE_A]) ? same_value : lost;
    if (!point_stays(frame, s, e[PM_MEASURE_A])) return lost;
    switch (e[PM_MEASURE_PART]) {
    case PM_PART_X: return shifted(s->by[0]);
    case PM_PART_Y: return shifted(s->by[1]);
    case PM_PART_ALONG: {
        const double angle = frame->numbers->value[e[PM_MEASURE_VALUE]];
        return shifted(s->by[0] * cos(angle) + s->by[1] * sin(angle));
    }
    default: return lost;
    }
}

static pm_entry read_measure(const pm_frame *frame, const pm_symmetry_shift *s, int measure)
{
    const int32_t *e = PM_MEASURE_ROW(frame->model, measure);
    const int a = e[PM_MEASURE_A], in = e[PM_MEASURE_IN], kind = e[PM_MEASURE_KIND];
    if (in != PM_NONE && kind != PM_MEASURE_ANGLE && kind != PM_MEASURE_OMEGA &&
        (is_rotated(s, in) || moved(s)))
        return lost;
    if (e[PM_MEASURE_ABOUT] != PM_NONE) return moved(s) ? lost : same_value;
    if (e[PM_MEASURE_MEMBER] != PM_NONE && moved(s)) return lost;
    switch ((enum pm_measure_kind)kind) {
    case PM_MEASURE_ANGLE:
    case PM_MEASURE_TURNED: return shifted(rotation_of(s, a) - (in == PM_NONE ? 0 : rotation_of(s, in)));
    case PM_MEASURE_POSITION:
    case PM_MEASURE_MOVED: return in == PM_NONE ? place_of(frame, s, e) : same_value;
    case PM_MEASURE_VELOCITY:
    case PM_MEASURE_ACCELERATION:
        return point_stays(frame, s, a) || !is_rotated(s, pm_model_body_of(frame->model, PM_TABLE_POINT, a))
                   ? same_value
                   : lost;
    case PM_MEASURE_ANGULAR_MOMENTUM: return a == PM_NONE && moved(s) ? lost : same_value;
    case PM_MEASURE_POLE:
    case PM_MEASURE_POTENTIAL:
    case PM_MEASURE_TOTAL: return moved(s) ? lost : same_value;
    case PM_MEASURE_TIME:
    case PM_MEASURE_PATH:
    case PM_MEASURE_FORCE_WORK:
    case PM_MEASURE_EVENT_COUNT:
    case PM_MEASURE_EVENT_TIME: return lost;
    default: return same_value;
    }
}

static pm_entry sum(pm_entry a, pm_entry b, double sign)
{
    if (a.response == LOST || b.response == LOST) return lost;
    if (a.response == NUMBER && b.response == NUMBER) return (pm_entry){NUMBER, a.number + sign * b.number};
    const double change =
        (a.response == SHIFTED ? a.number : 0) + (b.response == SHIFTED ? sign * b.number : 0);
    return shifted(change);
}

/* Products and quotients with a constant stretch the change; all else needs operands that do not change. */
static pm_entry binary(int op, pm_entry a, pm_entry b)
{
    if (op == PM_OP_ADD) return sum(a, b, 1);
    if (op == PM_OP_SUB) return sum(a, b, -1);
    if (a.response == LOST || b.response == LOST) return lost;
    if (a.response == NUMBER && b.response == NUMBER)
        return (pm_entry){NUMBER, pm_operations[op].two(a.number, b.number)};
    if (a.response != SHIFTED && b.response != SHIFTED) return same_value;
    if (op == PM_OP_MUL && (a.response == NUMBER || b.response == NUMBER))
        return shifted(a.number * b.number);
    return op == PM_OP_DIV && b.response == NUMBER ? shifted(a.number / b.number) : lost;
}

static pm_entry unary(int op, pm_entry a)
{
    if (a.response == NUMBER) return (pm_entry){NUMBER, pm_operations[op].one(a.number)};
    if (a.response != SHIFTED) return a;
    return op == PM_OP_NEG ? shifted(-a.number) : lost;
}

/* A choice, or a table, keeps its value where all operands do. */
static pm_entry look_up(const pm_entry *a, int takes)
{
    for (int k = 0; k < takes; k++)
        if (a[k].response > SAME_VALUE) return lost;
    return same_value;
}

static pm_entry pushed(const pm_frame *frame, const pm_symmetry_shift *s, const pm_program_walk *x)
{
    if (x->op == PM_OP_MEASURE) return read_measure(frame, s, x->arg);
    if (x->op == PM_OP_ANSWER) return lost;
    return (pm_entry){NUMBER, pm_program_number(x, frame->numbers->param, frame->numbers->value)};
}

int pm_symmetry_program(const pm_frame *frame, const pm_symmetry_shift *shift, int program, double *change)
{
    pm_entry stack[PM_STACK];
    stack[0] = stack[1] = stack[2] = lost; /* no valid code reads them before they are pushed */
    for (pm_program_walk x = pm_program_walk_begin(frame->model, program); pm_program_walk_next(&x);) {
        pm_entry *a = stack + x.at;
        if (pm_operation_of_table(x.op)) {
            *a = look_up(a, x.takes);
            continue;
        }
        switch (x.takes) {
        case 0: *a = pushed(frame, shift, &x); break;
        case 1: *a = unary(x.op, *a); break;
        case 2: *a = binary(x.op, a[0], a[1]); break;
        default: *a = look_up(a, 3);
        }
    }
    *change = stack[0].response == SHIFTED ? stack[0].number : 0;
    return stack[0].response != LOST;
}
