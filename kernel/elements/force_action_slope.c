/* force_action_slope.c - derivatives of what forces do, law by law.
 *
 * A force along the line is S n, one in the axes of a body R (fx, fy); what a program gives has the derivatives of the program
 * by what it reads times those of the measures. */
#include "elements/force_action_slope.h"

#include "elements/force_slope.h"
#include "elements/measure.h"
#include "expression/operation.h"
#include "expression/program.h"
#include "state/frame.h"

int pm_action_slope_create(pm_arena *arena, pm_action_slope *x, const pm_model *m)
{
    pm_slope *const all[] = {&x->force[0], &x->force[1], &x->couple, &x->power, &x->size};
    for (int i = 0; i < 5; i++) {
        const int status = pm_slope_create(arena, all[i], m);
        if (status) return status;
    }
    return PM_OK;
}

/* ---- programs ---- */
void pm_force_add_program(pm_workspace *w, int program, double weight, pm_slope *to)
{
    const double t = w->frame.t;
    w->frame.t = pm_frame_side_time(&w->frame, t);
    for (pm_program_walk x = pm_program_walk_begin(w->model, program); pm_program_walk_next(&x);)
        if (x.op == PM_OP_MEASURE && pm_measure_moves(w->model, x.arg))
            pm_measure_slope(w, x.arg, weight * pm_program_slope(w, program, &x), to);
    w->frame.t = t;
}

/* ---- along a line ---- */
/* The derivatives of the tension are in slope->size. */
static void pulls(const pm_frame *frame, const pm_sight *x, const pm_action *action, pm_action_slope *slope)
{
    const double tension = action->force[0] * x->n[0] + action->force[1] * x->n[1];
    for (int k = 0; k < 2; k++) {
        pm_slope_add(&slope->force[k], &slope->size, x->n[k]);
        pm_force_add_direction(frame, x, (double[]){k == 0 ? tension : 0, k == 1 ? tension : 0},
                               &slope->force[k]);
    }
}

static void along_line(pm_workspace *w, const int32_t *e, const pm_action *action, pm_action_slope *slope)
{
    const pm_sight x = pm_force_sight(&w->frame, e);
    if (e[PM_FORCE_KIND] == PM_FORCE_LINE)
        pm_force_add_program(w, e[PM_FORCE_PROGRAM_X], 1, &slope->size);
    else
        pm_force_add_tension(w, e, action, &x, 1, &slope->size);
    pulls(&w->frame, &x, action, slope);
}

/* ---- between two bodies ---- */
static void rotary(pm_workspace *w, const int32_t *e, const pm_action *action, pm_action_slope *slope)
{
    (void)action;
    if (e[PM_FORCE_KIND] == PM_FORCE_COUPLE)
        pm_force_add_program(w, e[PM_FORCE_PROGRAM_X], 1, &slope->couple);
    else
        pm_force_add_own_couple(w, e, 1, &slope->couple);
}

/* ---- at a point, in the axes of a body ---- */
static void applied(pm_workspace *w, const int32_t *e, const pm_action *action, pm_action_slope *slope)
{
    const int axes_of = pm_model_body_index(w->model, e[PM_FORCE_B]);
    const double *axes = w->frame.pose + 5 * axes_of;
    for (int k = 0; k < 2; k++) {
        pm_slope_clear(&slope->size);
        pm_force_add_program(w, e[k == 0 ? PM_FORCE_PROGRAM_X : PM_FORCE_PROGRAM_Y], 1, &slope->size);
        pm_slope_add(&slope->force[0], &slope->size, k == 0 ? axes[3] : -axes[4]);
        pm_slope_add(&slope->force[1], &slope->size, k == 0 ? axes[4] : axes[3]);
    }
    pm_slope_add_angle(&w->frame, &slope->force[0], axes_of, -action->force[1]);
    pm_slope_add_angle(&w->frame, &slope->force[1], axes_of, action->force[0]);
}

typedef void pm_law_slope(pm_workspace *w, const int32_t *e, const pm_action *action, pm_action_slope *slope);

static pm_law_slope *const laws[PM_FORCE_KINDS] = {
    [PM_FORCE_SPRING] = along_line, [PM_FORCE_DAMPER] = along_line,    [PM_FORCE_LINE] = along_line,
    [PM_FORCE_TORSION] = rotary,    [PM_FORCE_ROTARY_DAMPER] = rotary, [PM_FORCE_COUPLE] = rotary,
    [PM_FORCE_APPLIED] = applied,
};

/* ---- all kinds ---- */
/* How fast one of its partners moves, times `weight`: P += F.u, dP = u.dF + F.du. */
static void add_point_power(const pm_frame *frame, int point, const pm_action *action, double sign,
                            pm_action_slope *slope)
{
    const pm_point p = pm_frame_point_of(frame, point);
    for (int k = 0; k < 2; k++) pm_slope_add(&slope->power, &slope->force[k], sign * p.v[k]);
    pm_slope_add_velocity(frame, &slope->power, &p,
                          (double[]){sign * action->force[0], sign * action->force[1]});
}

static void add_power(const pm_frame *frame, const pm_force_ops *ops, const int32_t *e,
                      const pm_action *action, pm_action_slope *slope)
{
    if (ops->a == PM_TABLE_POINT) add_point_power(frame, e[PM_FORCE_A], action, 1, slope);
    if (ops->b == PM_TABLE_POINT) add_point_power(frame, e[PM_FORCE_B], action, -1, slope);
    if (ops->a != PM_TABLE_BODY) return;
    pm_slope_add(&slope->power, &slope->couple, action->rate);
    pm_force_add_relative(frame, e, action->couple, 1, &slope->power);
}

pm_action pm_force_slope(pm_workspace *w, int i, pm_action_slope *x)
{
    const int32_t *e = PM_FORCE_ROW(w->model, i);
    const pm_action action = pm_force_action(w, i);
    pm_slope *const all[] = {&x->force[0], &x->force[1], &x->couple, &x->power, &x->size};
    for (int k = 0; k < 5; k++) pm_slope_clear(all[k]);
    if (!laws[e[PM_FORCE_KIND]] || pm_state_is_absent(w->model, &w->state, PM_TABLE_FORCE, i)) return action;
    laws[e[PM_FORCE_KIND]](w, e, &action, x);
    add_power(&w->frame, pm_force_of(w->model, i), e, &action, x);
    return action;
}
