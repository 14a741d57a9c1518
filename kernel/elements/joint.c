/* joint.c - the table of kinds of joints and couplings, and their constraints.
 *
 * A new kind is one entry of the table and the function that composes its constraints; where no constraint of
 * constraint.h says what it needs, a file constraint_name.c with it. */
#include "elements/joint.h"

#include <string.h>

#include "elements/constraint.h"
#include "state/workspace.h"

static void put(const pm_frame *frame, const int32_t *e, pm_constraint *c, int kind,
                void (*marks)(const pm_frame *frame, pm_constraint *c, int a, int b))
{
    c->kind = kind;
    marks(frame, c, e[PM_JOINT_A], e[PM_JOINT_B]);
}

/* A constraint with the marks of another. */
static void put_beside(pm_constraint *c, int kind, const pm_constraint *other)
{
    *c = *other;
    c->kind = kind;
}

static double number(const pm_frame *frame, const int32_t *e)
{
    return frame->numbers->value[e[PM_JOINT_VALUE]];
}

static void keep_angle(const pm_frame *frame, const int32_t *e, pm_constraint *c, const pm_constraint *first)
{
    c->kind = PM_CONSTRAINT_ANGLE;
    c->body[0] = first->body[0];
    c->body[1] = first->body[1];
    c->value = number(frame, e);
}

static void pin(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    put(frame, e, &c[0], PM_CONSTRAINT_POINT_X, pm_constraint_marks_points);
    put_beside(&c[1], PM_CONSTRAINT_POINT_Y, &c[0]);
}

static void slot(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    put(frame, e, &c[0], PM_CONSTRAINT_CURVE_NORMAL, pm_constraint_marks_curve);
}

static void weld(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    pin(frame, e, c);
    keep_angle(frame, e, &c[2], &c[0]);
}

static void slider(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    put(frame, e, &c[0], PM_CONSTRAINT_LINE_NORMAL, pm_constraint_marks_point_and_line);
}

static void slider_fixed(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    slider(frame, e, c);
    keep_angle(frame, e, &c[1], &c[0]);
}

static void link(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    put(frame, e, &c[0], PM_CONSTRAINT_DISTANCE, pm_constraint_marks_points);
    c[0].value = number(frame, e);
}

static void rolling_line(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    put(frame, e, &c[0], PM_CONSTRAINT_LINE_NORMAL, pm_constraint_marks_circle_and_line);
    put_beside(&c[1], PM_CONSTRAINT_LINE_TANGENT, &c[0]);
}

static void rolling_curve(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    put(frame, e, &c[0], PM_CONSTRAINT_CURVE_NORMAL, pm_constraint_marks_circle_and_curve);
    put_beside(&c[1], PM_CONSTRAINT_CURVE_TANGENT, &c[0]);
}

static void rolling_curves(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    put(frame, e, &c[0], PM_CONSTRAINT_PAIR_NORMAL, pm_constraint_marks_curves);
    put_beside(&c[1], PM_CONSTRAINT_PAIR_TANGENT, &c[0]);
}

static void gears(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    c->kind = PM_CONSTRAINT_CIRCLE_TANGENT;
    pm_constraint_marks_circles(frame, c, e[PM_JOINT_A], e[PM_JOINT_B], number(frame, e));
}

static void teeth(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    gears(frame, e, c);
    c->kind = PM_CONSTRAINT_TEETH;
    pm_constraint_marks_pressure(c, frame->numbers->value[e[PM_JOINT_VALUE_2]]);
}

static void rack(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    put(frame, e, c, PM_CONSTRAINT_RACK, pm_constraint_marks_circle_and_line);
    pm_constraint_marks_pressure(c, frame->numbers->value[e[PM_JOINT_VALUE_2]]);
}

static void rolling_circle(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    gears(frame, e, &c[1]);
    put_beside(&c[0], PM_CONSTRAINT_DISTANCE, &c[1]);
}

/* The strand that leaves circle a counterclockwise, and the one that leaves it clockwise. */
static void belt(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    for (int k = 0; k < 2; k++) {
        const double sense = k == 0 ? 1 : -1;
        pm_constraint_marks_strand(frame, &c[k], e[PM_JOINT_A], e[PM_JOINT_B], sense,
                                   number(frame, e) * sense);
    }
}

/* Its tension given, what the strands carry differs by what the belt drives with. */
static void belt_drives(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    pm_constraint_marks_strand(frame, c, e[PM_JOINT_A], e[PM_JOINT_B], 1, number(frame, e));
    c->kind = PM_CONSTRAINT_BELT;
}

static void rate(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    c->kind = PM_CONSTRAINT_RATIO;
    c->body[0] = pm_model_body_index(frame->model, e[PM_JOINT_A]);
    c->body[1] = pm_model_body_index(frame->model, e[PM_JOINT_B]);
    c->drive = e[PM_JOINT_PROGRAM_X];
}

static void angle(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    rate(frame, e, c);
    c->prescribes = PM_PRESCRIBES_PLACE;
}

static void ratio(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    rate(frame, e, c);
    c->ratio = number(frame, e);
}

static void drive(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    put(frame, e, &c[0], PM_CONSTRAINT_DRIVE, pm_constraint_marks_points);
    c[1] = c[0];
    for (int k = 0; k < 2; k++) {
        c[k].axis[k] = 1;
        c[k].drive = e[PM_JOINT_PROGRAM_X + k];
    }
}

static void placed(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    drive(frame, e, c);
    for (int k = 0; k < 2; k++) c[k].prescribes = PM_PRESCRIBES_PLACE;
}

static void prescribe(const int32_t *e, pm_constraint *c)
{
    c->drive = e[PM_JOINT_PROGRAM_X];
    c->prescribes = PM_PRESCRIBES_PLACE;
}

static void length(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    put(frame, e, c, PM_CONSTRAINT_DISTANCE, pm_constraint_marks_points);
    prescribe(e, c);
}

static void pin_angle(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    pin(frame, e, c);
    c[2].kind = PM_CONSTRAINT_RATIO;
    for (int k = 0; k < 2; k++) c[2].body[k] = c[0].body[k];
    prescribe(e, &c[2]);
}

static void slider_place(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    slider(frame, e, c);
    put_beside(&c[1], PM_CONSTRAINT_LINE_TANGENT, &c[0]);
    prescribe(e, &c[1]);
}

static void slider_fixed_place(const pm_frame *frame, const int32_t *e, pm_constraint *c)
{
    slider_fixed(frame, e, c);
    put_beside(&c[2], PM_CONSTRAINT_LINE_TANGENT, &c[0]);
    prescribe(e, &c[2]);
}

enum {
    BODY = PM_TABLE_BODY,
    POINT = PM_TABLE_POINT,
    LINE = PM_TABLE_LINE,
    CIRCLE = PM_TABLE_CIRCLE,
    CURVE = PM_TABLE_CURVE
};

static const pm_joint_ops kinds[PM_JOINT_KINDS] = {
    [PM_JOINT_PIN] = {POINT, POINT, .nconstraint = 2, .slip = PM_CONSTRAINT_RATIO,
                      .repeats = PM_REPEATS_MARKS, .compose = pin},
    [PM_JOINT_SLIDER] = {POINT, LINE, .nconstraint = 1, .slip = PM_CONSTRAINT_LINE_TANGENT,
                         .repeats = PM_REPEATS_MARKS, .compose = slider},
    [PM_JOINT_SLIDER_FIXED] = {POINT, LINE, PM_NUMBER_ANY, .nconstraint = 2,
                               .slip = PM_CONSTRAINT_LINE_TANGENT, .repeats = PM_REPEATS_ROTATION,
                               .compose = slider_fixed},
    /* a slot is one too: a circle round a point */
    [PM_JOINT_LINK] = {POINT, POINT, PM_NUMBER_LENGTH, .nconstraint = 1, .slip = PM_CONSTRAINT_CIRCLE_TANGENT,
                       .repeats = PM_REPEATS_MARKS, .compose = link},
    [PM_JOINT_WELD] = {POINT, POINT, PM_NUMBER_ANY, .nconstraint = 3, .slip = PM_NONE,
                       .repeats = PM_REPEATS_ROTATION, .compose = weld},
    [PM_JOINT_ROLLING_LINE] = {CIRCLE, LINE, .nconstraint = 2, .memories = 1, .presses = 1, .slip = PM_NONE,
                               .repeats = PM_REPEATS_MARKS, .compose = rolling_line},
    [PM_JOINT_ROLLING_CIRCLE] = {CIRCLE, CIRCLE, PM_NUMBER_SIDE, .nconstraint = 2, .memories = 1,
                                 .presses = 1, .slip = PM_NONE, .repeats = PM_REPEATS_MARKS,
                                 .compose = rolling_circle},
    /* teeth rub on each other as the bodies turn against each other */
    [PM_JOINT_GEARS] = {CIRCLE, CIRCLE, PM_NUMBER_SIDE, .nconstraint = 1, .memories = 1,
                        .slip = PM_CONSTRAINT_RATIO, .compose = gears},
    [PM_JOINT_TEETH] = {CIRCLE, CIRCLE, PM_NUMBER_SIDE, .nconstraint = 1, .memories = 1, .flanks = 1,
                        .slip = PM_CONSTRAINT_RATIO, .compose = teeth},
    [PM_JOINT_RACK] = {CIRCLE, LINE, .nconstraint = 1, .memories = 1, .flanks = 1,
                       .slip = PM_CONSTRAINT_RATIO, .compose = rack},
    [PM_JOINT_BELT] = {CIRCLE, CIRCLE, PM_NUMBER_ANY, .nconstraint = 2, .memories = 2, .presses = 1,
                       .slip = PM_NONE, .compose = belt},
    [PM_JOINT_RATE] = {BODY, BODY, .programs = 1, .nconstraint = 1, .memories = 1, .slip = PM_NONE,
                       .compose = rate},
    [PM_JOINT_DRIVE] = {POINT, POINT, .programs = 2, .nconstraint = 2, .memories = 2, .slip = PM_NONE,
                        .compose = drive},
    [PM_JOINT_RATIO] = {BODY, BODY, PM_NUMBER_ANY, .nconstraint = 1, .memories = 1, .slip = PM_NONE,
                        .compose = ratio},
    [PM_JOINT_PLACED] = {POINT, POINT, .programs = 2, .nconstraint = 2, .slip = PM_NONE, .compose = placed},
    [PM_JOINT_ANGLE] = {BODY, BODY, .programs = 1, .nconstraint = 1, .slip = PM_NONE, .compose = angle},
    [PM_JOINT_LENGTH] = {POINT, POINT, .programs = 1, .nconstraint = 1, .slip = PM_NONE, .compose = length},
    [PM_JOINT_PIN_ANGLE] = {POINT, POINT, .programs = 1, .nconstraint = 3, .slip = PM_CONSTRAINT_RATIO,
                            .compose = pin_angle},
    [PM_JOINT_SLIDER_PLACE] = {POINT, LINE, .programs = 1, .nconstraint = 2,
                               .slip = PM_CONSTRAINT_LINE_TANGENT, .compose = slider_place},
    [PM_JOINT_SLIDER_FIXED_PLACE] = {POINT, LINE, PM_NUMBER_ANY, .programs = 1, .nconstraint = 3,
                                     .slip = PM_CONSTRAINT_LINE_TANGENT, .compose = slider_fixed_place},
    [PM_JOINT_SLOT] = {POINT, CURVE, .nconstraint = 1, .feet = 1, .slip = PM_CONSTRAINT_CURVE_TANGENT,
                       .compose = slot},
    [PM_JOINT_ROLLING_CURVE] = {CIRCLE, CURVE, .nconstraint = 2, .memories = 1, .feet = 1, .presses = 1,
                                .slip = PM_NONE, .compose = rolling_curve},
    [PM_JOINT_ROLLING_CURVES] = {CURVE, CURVE, .nconstraint = 2, .memories = 1, .feet = 1, .presses = 1,
                                 .slip = PM_NONE, .compose = rolling_curves},
    [PM_JOINT_BELT_GRIPS] = {CIRCLE, CIRCLE, PM_NUMBER_ANY, .nconstraint = 1, .memories = 1, .strands = 1,
                             .slip = PM_NONE, .compose = belt_drives},
    [PM_JOINT_BELT_SLIPS] = {CIRCLE, CIRCLE, PM_NUMBER_ANY, .nconstraint = 1, .by_friction = 1, .strands = 1,
                             .slip = PM_CONSTRAINT_BELT, .compose = belt_drives},
};

const pm_joint_ops *pm_joint_kind(int kind) { return &kinds[kind]; }

const pm_joint_ops *pm_joint_of(const pm_model *m, int joint)
{
    return &kinds[PM_JOINT_ROW(m, joint)[PM_JOINT_KIND]];
}

int pm_joint_constraints(const pm_frame *frame, const pm_state *state, int joint,
                         pm_constraint c[PM_JOINT_CONSTRAINTS])
{
    if (pm_joint_of(frame->model, joint)->by_friction ||
        pm_state_is_absent(frame->model, state, PM_TABLE_JOINT, joint))
        return 0;
    return pm_joint_constraints_of_any(frame, joint, c);
}

int pm_joint_constraints_of_any(const pm_frame *frame, int joint, pm_constraint c[PM_JOINT_CONSTRAINTS])
{
    const int n = pm_joint_of(frame->model, joint)->nconstraint;
    memcpy(c, frame->numbers->of_joint + frame->model->joint_constraint[joint], (size_t)n * sizeof *c);
    return n;
}

static void compose(const pm_frame *frame, int joint, pm_constraint *c)
{
    const pm_joint_ops *ops = pm_joint_of(frame->model, joint);
    for (int k = 0; k < ops->nconstraint; k++) {
        pm_constraint_marks_blank(&c[k], PM_NONE);
        c[k].joint = joint;
    }
    ops->compose(frame, PM_JOINT_ROW(frame->model, joint), c);
    const int memory = frame->model->joint_memory[joint], first = ops->nconstraint - ops->memories;
    for (int k = first; k < ops->nconstraint; k++) c[k].memory = memory + k - first;
    for (int k = 0; ops->feet && k < ops->nconstraint; k++) c[k].foot = memory + ops->memories;
}

void pm_joint_compose(const pm_frame *frame)
{
    for (int i = 0; i < frame->model->rows[PM_TABLE_JOINT]; i++)
        compose(frame, i, frame->numbers->of_joint + frame->model->joint_constraint[i]);
}
