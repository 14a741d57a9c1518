/* force.c - table of force kinds.  A line force acts along the points' connection; tension is positive. */
#include "elements/force.h"

#include <math.h>

#include "elements/constant_motion.h"
#include "elements/drive.h"
#include "elements/joint_friction.h"
#include "elements/turning_plane.h"
#include "expression/program_class.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

/* ---- between two points: along their connection ---- */
/* Their distance and its rate; the force has the direction from a to b. */
static void line_place(const pm_frame *frame, const int32_t *e, pm_action *x)
{
    const pm_point a = pm_frame_point_of(frame, e[PM_FORCE_A]), b = pm_frame_point_of(frame, e[PM_FORCE_B]);
    const double d[2] = {b.p[0] - a.p[0], b.p[1] - a.p[1]}, length = hypot(d[0], d[1]);
    x->body_a = a.body;
    x->body_b = b.body;
    for (int k = 0; k < 2; k++) {
        x->at_a[k] = a.p[k];
        x->at_b[k] = b.p[k];
        x->force[k] = length > 0 ? d[k] / length : 0;
    }
    x->stretch = length;
    x->rate = (b.v[0] - a.v[0]) * x->force[0] + (b.v[1] - a.v[1]) * x->force[1];
}

/* Beyond the free one; in its free position a spring is at rest, though the places that it joins are rounded. */
static void stretch_beyond(pm_action *x, double free, double places)
{
    const double rounding = PM_STRETCH_ROUNDING * (places + fabs(free));
    x->stretch -= free;
    if (fabs(x->stretch) <= rounding) x->stretch = 0;
}

static void spring_place(const pm_frame *frame, const int32_t *e, pm_action *x)
{
    line_place(frame, e, x);
    const double places = fabs(x->at_a[0]) + fabs(x->at_a[1]) + fabs(x->at_b[0]) + fabs(x->at_b[1]);
    stretch_beyond(x, frame->numbers->value[e[PM_FORCE_VALUE_2]], places);
}

/* `size` N draw them together. */
static void pull(pm_action *x, double size)
{
    for (int k = 0; k < 2; k++) x->force[k] *= size;
    x->power = -size * x->rate;
}

/* Within a phase it is what it was at the begin, so that its law has no corner in a step. */
int pm_force_is_slack(pm_workspace *w, const int32_t *e, double stretch)
{
    if (e[PM_FORCE_OPTION] == PM_SPRING_BOTH) return 0;
    const double side =
        e[PM_FORCE_PROGRAM_X] == PM_NONE ? stretch : pm_drive_program(w, e[PM_FORCE_PROGRAM_X]) - 0.5;
    return e[PM_FORCE_OPTION] == PM_SPRING_PULL ? side < 0 : side > 0;
}

static void spring(pm_workspace *w, const int32_t *e, pm_action *x)
{
    const double stiffness = w->numbers.value[e[PM_FORCE_VALUE_1]];
    const int slack = pm_force_is_slack(w, e, x->stretch);
    if (!slack) x->energy = 0.5 * stiffness * x->stretch * x->stretch;
    pull(x, slack ? 0 : stiffness * x->stretch);
}

static void damper(pm_workspace *w, const int32_t *e, pm_action *x)
{
    pull(x, w->numbers.value[e[PM_FORCE_VALUE_1]] * x->rate);
}

static void line(pm_workspace *w, const int32_t *e, pm_action *x)
{
    pull(x, pm_drive_program(w, e[PM_FORCE_PROGRAM_X]));
}

/* ---- between two bodies: the couple acts on a, the opposite on b ---- */
/* Their relative angle and its rate. */
static void rotary_place(const pm_frame *frame, const int32_t *e, pm_action *x)
{
    x->body_a = pm_model_body_index(frame->model, e[PM_FORCE_A]);
    x->body_b = pm_model_body_index(frame->model, e[PM_FORCE_B]);
    x->rate = frame->velocity[3 * x->body_a + 2] - frame->velocity[3 * x->body_b + 2];
    x->stretch = frame->pose[5 * x->body_a + 2] - frame->pose[5 * x->body_b + 2];
}

static void torsion_place(const pm_frame *frame, const int32_t *e, pm_action *x)
{
    rotary_place(frame, e, x);
    const double *pose = frame->pose;
    stretch_beyond(x, frame->numbers->value[e[PM_FORCE_VALUE_2]],
                   fabs(pose[5 * x->body_a + 2]) + fabs(pose[5 * x->body_b + 2]));
}

static void act_by_couple(pm_action *x, double size)
{
    x->couple = size;
    x->power = size * x->rate;
}

static void torsion(pm_workspace *w, const int32_t *e, pm_action *x)
{
    const double stiffness = w->numbers.value[e[PM_FORCE_VALUE_1]];
    x->energy = 0.5 * stiffness * x->stretch * x->stretch;
    act_by_couple(x, -stiffness * x->stretch);
}

static void rotary_damper(pm_workspace *w, const int32_t *e, pm_action *x)
{
    act_by_couple(x, -w->numbers.value[e[PM_FORCE_VALUE_1]] * x->rate);
}

static void couple(pm_workspace *w, const int32_t *e, pm_action *x)
{
    act_by_couple(x, pm_drive_program(w, e[PM_FORCE_PROGRAM_X]));
}

/* ---- at a point; in a joint ---- */

static void applied(pm_workspace *w, const int32_t *e, pm_action *x)
{
    const pm_point a = pm_frame_point_of(&w->frame, e[PM_FORCE_A]);
    const double *axes = w->frame.pose + 5 * pm_model_body_index(w->model, e[PM_FORCE_B]);
    const double fx = pm_drive_program(w, e[PM_FORCE_PROGRAM_X]);
    const double fy = pm_drive_program(w, e[PM_FORCE_PROGRAM_Y]);
    x->body_a = a.body;
    x->at_a[0] = a.p[0];
    x->at_a[1] = a.p[1];
    x->force[0] = axes[3] * fx - axes[4] * fy;
    x->force[1] = axes[4] * fx + axes[3] * fy;
    x->power = x->force[0] * a.v[0] + x->force[1] * a.v[1];
}

static int number_of(const pm_frame *frame, const int32_t *e)
{
    return (int)((e - frame->model->table[PM_TABLE_FORCE]) / PM_FORCE_COLUMNS);
}

static void friction(pm_workspace *w, const int32_t *e, pm_action *x)
{
    pm_joint_friction_action(w, number_of(&w->frame, e), x);
}

/* ---- which forces stay the same along a motion with constant accelerations; the others never do ---- */
static int constant(const pm_frame *frame, int program)
{
    return frame->model->programs.class[program] == PM_CLASS_CONSTANT;
}

static int steady_couple(const pm_frame *frame, const int32_t *e, const pm_constant_motion *x)
{
    (void)x;
    return constant(frame, e[PM_FORCE_PROGRAM_X]);
}

static int steady_applied(const pm_frame *frame, const int32_t *e, const pm_constant_motion *x)
{
    return constant(frame, e[PM_FORCE_PROGRAM_X]) && constant(frame, e[PM_FORCE_PROGRAM_Y]) &&
           !x->rotates[pm_model_body_index(frame->model, e[PM_FORCE_B])] &&
           pm_constant_motion_point(frame, x, e[PM_FORCE_A]);
}

/* Its points stay apart as they are: no spin moves them, and they go alike. */
static int steady_line(const pm_frame *frame, const int32_t *e, const pm_constant_motion *x)
{
    pm_constraint c;
    pm_constraint_marks_blank(&c, PM_CONSTRAINT_DISTANCE);
    pm_constraint_marks_points(frame, &c, e[PM_FORCE_A], e[PM_FORCE_B]);
    return constant(frame, e[PM_FORCE_PROGRAM_X]) && pm_constant_motion_together(frame, &c, x);
}

static int steady_friction(const pm_frame *frame, const int32_t *e, const pm_constant_motion *x)
{
    return pm_joint_friction_steady(frame, number_of(frame, e), x);
}

enum { BODY = PM_TABLE_BODY, POINT = PM_TABLE_POINT, JOINT = PM_TABLE_JOINT };

static const pm_force_ops kinds[PM_FORCE_KINDS] = {
    [PM_FORCE_SPRING] = {POINT,
                         POINT,
                         {PM_FORCE_NOT_NEGATIVE, PM_FORCE_ANY},
                         .stores = 1,
                         .place = spring_place,
                         .law = spring},
    [PM_FORCE_TORSION] = {BODY,
                          BODY,
                          {PM_FORCE_NOT_NEGATIVE, PM_FORCE_ANY},
                          .stores = 1,
                          .place = torsion_place,
                          .law = torsion},
    [PM_FORCE_DAMPER] = {POINT, POINT, {PM_FORCE_NOT_NEGATIVE}, .place = line_place, .law = damper},
    [PM_FORCE_ROTARY_DAMPER] =
        {BODY, BODY, {PM_FORCE_NOT_NEGATIVE}, .place = rotary_place, .law = rotary_damper},
    [PM_FORCE_APPLIED] = {POINT, BODY, .programs = 2, .law = applied, .steady = steady_applied},
    [PM_FORCE_COUPLE] = {BODY, BODY, .programs = 1, .place = rotary_place, .law = couple,
                         .steady = steady_couple},
    [PM_FORCE_LINE] = {POINT, POINT, .programs = 1, .place = line_place, .law = line, .steady = steady_line},
    [PM_FORCE_FRICTION] = {JOINT,
                           JOINT,
                           {PM_FORCE_NOT_NEGATIVE, PM_FORCE_NOT_NEGATIVE},
                           .law = friction,
                           .steady = steady_friction},
};

const pm_force_ops *pm_force_kind(int kind) { return &kinds[kind]; }

const pm_force_ops *pm_force_of(const pm_model *m, int force)
{
    return &kinds[PM_FORCE_ROW(m, force)[PM_FORCE_KIND]];
}

int pm_force_programs(const int32_t *e)
{
    const int sided = e[PM_FORCE_KIND] == PM_FORCE_SPRING && e[PM_FORCE_PROGRAM_X] != PM_NONE;
    return kinds[e[PM_FORCE_KIND]].programs + sided;
}

int pm_force_all_steady(const pm_frame *frame, const pm_state *state, const pm_constant_motion *x)
{
    if (pm_turning_plane_turns(frame->model)) return 0;
    for (int i = 0; i < frame->model->rows[PM_TABLE_FORCE]; i++) {
        const pm_force_ops *ops = pm_force_of(frame->model, i);
        if (pm_state_is_absent(frame->model, state, PM_TABLE_FORCE, i)) continue;
        if (!ops->steady || !ops->steady(frame, PM_FORCE_ROW(frame->model, i), x)) return 0;
    }
    return 1;
}

pm_action pm_force_place(const pm_frame *frame, int i)
{
    pm_action x = {.body_a = frame->model->nbody, .body_b = frame->model->nbody};
    const pm_force_ops *ops = pm_force_of(frame->model, i);
    if (ops->place) ops->place(frame, PM_FORCE_ROW(frame->model, i), &x);
    return x;
}

pm_action pm_force_action(pm_workspace *w, int i)
{
    pm_action x = pm_force_place(&w->frame, i);
    pm_force_of(w->model, i)->law(w, PM_FORCE_ROW(w->model, i), &x);
    if (pm_state_is_absent(w->model, &w->state, PM_TABLE_FORCE, i))
        x.force[0] = x.force[1] = x.couple = x.power = x.energy = 0;
    return x;
}

static void add(const pm_frame *frame, int body, const double at[2], const double force[2], double couple,
                double sign)
{
    if (body == frame->model->nbody) return;
    const double *pose = frame->pose + 5 * body;
    double *f = frame->f + 3 * body;
    f[0] += sign * force[0];
    f[1] += sign * force[1];
    f[2] += sign * (couple + (at[0] - pose[0]) * force[1] - (at[1] - pose[1]) * force[0]);
}

void pm_force_all(pm_workspace *w)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->nbody; i++) {
        w->frame.f[3 * i] = w->numbers.mass[i] * w->numbers.gravity[0];
        w->frame.f[3 * i + 1] = w->numbers.mass[i] * w->numbers.gravity[1];
        w->frame.f[3 * i + 2] = 0;
    }
    pm_turning_plane_forces(&w->frame);
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++) {
        const pm_action x = pm_force_action(w, i);
        add(&w->frame, x.body_a, x.at_a, x.force, x.couple, 1);
        add(&w->frame, x.body_b, x.at_b, x.force, x.couple, -1);
        w->frame.power[i] = x.power;
    }
}

double pm_force_potential(pm_workspace *w)
{
    double sum = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_FORCE]; i++)
        if (w->model->force_z[i] == PM_NONE) sum += pm_force_action(w, i).energy;
    return sum;
}
