/* force_slope.c - derivatives of stretches and rates, and of what springs and dampers do.
 *
 * With d the way from a to b, L = |d|, n = d/L, u = v_b - v_a:  dL = n.dd,  dn = (1 - n n) dd / L,  d(u.n) = n.du + u.dn. */
#include "elements/force_slope.h"

#include <math.h>

#include "state/frame.h"

/* ---- along a line ---- */
pm_sight pm_force_sight(const pm_frame *frame, const int32_t *e)
{
    pm_sight x = {.a = pm_frame_point_of(frame, e[PM_FORCE_A]), .b = pm_frame_point_of(frame, e[PM_FORCE_B])};
    const double d[2] = {x.b.p[0] - x.a.p[0], x.b.p[1] - x.a.p[1]};
    x.length = hypot(d[0], d[1]);
    for (int k = 0; k < 2; k++) {
        x.n[k] = x.length > 0 ? d[k] / x.length : 0;
        x.u[k] = x.b.v[k] - x.a.v[k];
    }
    return x;
}

/* weight . (the one at b less that at a) */
static void add_between(const pm_frame *frame, const pm_sight *x, const double weight[2], pm_slope *to)
{
    const double back[2] = {-weight[0], -weight[1]};
    pm_slope_add_place(frame, to, &x->b, weight);
    pm_slope_add_place(frame, to, &x->a, back);
}

/* weight . dn */
void pm_force_add_direction(const pm_frame *frame, const pm_sight *x, const double weight[2], pm_slope *to)
{
    const double along = weight[0] * x->n[0] + weight[1] * x->n[1];
    double across[2];
    if (!(x->length > 0)) return;
    for (int k = 0; k < 2; k++) across[k] = (weight[k] - along * x->n[k]) / x->length;
    add_between(frame, x, across, to);
}

static void add_length(const pm_frame *frame, const pm_sight *x, double weight, pm_slope *to)
{
    add_between(frame, x, (double[]){weight * x->n[0], weight * x->n[1]}, to);
}

static void add_line_rate(const pm_frame *frame, const pm_sight *x, double weight, pm_slope *to)
{
    const double along[2] = {weight * x->n[0], weight * x->n[1]}, back[2] = {-along[0], -along[1]};
    pm_slope_add_velocity(frame, to, &x->b, along);
    pm_slope_add_velocity(frame, to, &x->a, back);
    pm_force_add_direction(frame, x, (double[]){weight * x->u[0], weight * x->u[1]}, to);
}

/* ---- between two bodies ---- */
void pm_force_add_relative(const pm_frame *frame, const int32_t *e, double weight, int velocities,
                           pm_slope *to)
{
    const int body[2] = {pm_model_body_index(frame->model, e[PM_FORCE_A]),
                         pm_model_body_index(frame->model, e[PM_FORCE_B])};
    pm_slope_add_bodies(frame, to, 2, body, (double[]){0, 0, 1, 0, 0, -1}, weight, velocities);
}

/* ---- springs and dampers ---- */
/* Of the tension of a spring or a damper. */
void pm_force_add_tension(pm_workspace *w, const int32_t *e, const pm_action *action, const pm_sight *x,
                          double weight, pm_slope *to)
{
    const double number = w->numbers.value[e[PM_FORCE_VALUE_1]];
    if (e[PM_FORCE_KIND] == PM_FORCE_DAMPER)
        add_line_rate(&w->frame, x, weight * number, to);
    else if (!pm_force_is_slack(w, e, action->stretch))
        add_length(&w->frame, x, weight * number, to);
}

/* Of the couple of a torsion spring or a rotary damper. */
void pm_force_add_own_couple(pm_workspace *w, const int32_t *e, double weight, pm_slope *to)
{
    pm_force_add_relative(&w->frame, e, -weight * w->numbers.value[e[PM_FORCE_VALUE_1]],
                          e[PM_FORCE_KIND] == PM_FORCE_ROTARY_DAMPER, to);
}

/* ---- what is read off forces ---- */
static int is_rotary(const pm_model *m, int i) { return pm_force_of(m, i)->a == PM_TABLE_BODY; }

void pm_force_add_stretch(const pm_frame *frame, int i, double weight, pm_slope *to)
{
    const int32_t *e = PM_FORCE_ROW(frame->model, i);
    if (!pm_force_of(frame->model, i)->place) return; /* it has none */
    if (is_rotary(frame->model, i)) {
        pm_force_add_relative(frame, e, weight, 0, to);
    } else {
        const pm_sight x = pm_force_sight(frame, e);
        add_length(frame, &x, weight, to);
    }
}

void pm_force_add_rate(const pm_frame *frame, int i, double weight, pm_slope *to)
{
    const int32_t *e = PM_FORCE_ROW(frame->model, i);
    if (!pm_force_of(frame->model, i)->place) return;
    if (is_rotary(frame->model, i)) {
        pm_force_add_relative(frame, e, weight, 1, to);
    } else {
        const pm_sight x = pm_force_sight(frame, e);
        add_line_rate(frame, &x, weight, to);
    }
}

void pm_force_add_force(pm_workspace *w, int i, const double weight[2], pm_slope *to)
{
    const int32_t *e = PM_FORCE_ROW(w->model, i);
    if (is_rotary(w->model, i)) return;
    const pm_action action = pm_force_action(w, i);
    const pm_sight x = pm_force_sight(&w->frame, e);
    const double tension = action.force[0] * x.n[0] + action.force[1] * x.n[1];
    pm_force_add_tension(w, e, &action, &x, weight[0] * x.n[0] + weight[1] * x.n[1], to);
    pm_force_add_direction(&w->frame, &x, (double[]){tension * weight[0], tension * weight[1]}, to);
}

void pm_force_add_couple(pm_workspace *w, int i, double weight, pm_slope *to)
{
    if (is_rotary(w->model, i)) pm_force_add_own_couple(w, PM_FORCE_ROW(w->model, i), weight, to);
}

void pm_force_add_power(pm_workspace *w, int i, double weight, pm_slope *to)
{
    const int32_t *e = PM_FORCE_ROW(w->model, i);
    const pm_action action = pm_force_action(w, i);
    if (is_rotary(w->model, i)) {
        pm_force_add_own_couple(w, e, weight * action.rate, to);
        pm_force_add_rate(&w->frame, i, weight * action.couple, to);
        return;
    }
    const pm_sight x = pm_force_sight(&w->frame, e);
    const double tension = action.force[0] * x.n[0] + action.force[1] * x.n[1];
    pm_force_add_tension(w, e, &action, &x, -weight * action.rate, to);
    add_line_rate(&w->frame, &x, -weight * tension, to);
}

void pm_force_add_energy(pm_workspace *w, int i, double weight, pm_slope *to)
{
    const pm_action action = pm_force_action(w, i);
    if (action.energy > 0) /* half the stiffness times the square of the stretch */
        pm_force_add_stretch(&w->frame, i, 2 * weight * action.energy / action.stretch, to);
}
