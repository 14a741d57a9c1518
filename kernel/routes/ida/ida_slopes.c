/* ida_slopes.c - derivatives of forces, and of what ida integrates along with the motion: works, paths, the ledger.
 *
 * Forces have their own derivatives (elements/force_action_slope.h).  The momentum of the scene changes by what acts on all its bodies:
 * its rate is the sum of f + H^T lambda, moments about the origin likewise, and so are its derivatives, which cost no look at a
 * force.  Reactions between two bodies are left out of that sum, inner forces cancel in it. */
#include <math.h>

#include "elements/constraint.h"
#include "elements/force_action_slope.h"
#include "elements/measure.h"
#include "elements/turning_plane.h"
#include "equations/ledger.h"
#include "routes/ida/ida.h"
#include "state/frame.h"
#include "state/workspace.h"

/* Where the derivatives of integral z by positions begin, nz apart, and those by velocities. */
static double *by_place(const pm_workspace *w, int z)
{
    return w->ida->jacobian.ledger + w->model->nz * w->model->nconstraint + z;
}
static double *by_velocity(const pm_workspace *w, int z)
{
    return by_place(w, z) + w->model->nz * w->model->nq;
}

static void integral(const pm_workspace *w, int z, const pm_slope *slope, double weight)
{
    pm_slope_spread(slope, weight, w->model->nz, by_place(w, z), by_velocity(w, z));
}

/* ---- forces ---- */
static void row(pm_workspace *w, int i, const pm_slope *slope, double weight)
{
    pm_ida_jacobian *x = &w->ida->jacobian;
    const int nq = w->model->nq;
    if (weight != 0) pm_slope_spread(slope, weight, 1, x->stiffness + i * nq, x->damping + i * nq);
}

/* What an action does to one of its bodies: the force at r from its mass centre, and the couple. */
static void on_body(pm_workspace *w, const pm_action *action, const pm_action_slope *slope, int body,
                    const double at[2], double sign)
{
    if (w->numbers.fixed[body]) return;
    const double *pose = w->frame.pose + 5 * body;
    const double r[2] = {at[0] - pose[0], at[1] - pose[1]};
    const int angle = 3 * body + 2;
    row(w, 3 * body, &slope->force[0], sign);
    row(w, 3 * body + 1, &slope->force[1], sign);
    row(w, angle, &slope->couple, sign);
    row(w, angle, &slope->force[1], sign * r[0]);
    row(w, angle, &slope->force[0], -sign * r[1]);
    w->ida->jacobian.stiffness[angle * w->model->nq + angle] -=
        sign * (r[0] * action->force[0] + r[1] * action->force[1]);
}

static void one_force(pm_workspace *w, int i)
{
    pm_action_slope *slope = w->ida->jacobian.slope;
    if (PM_FORCE_ROW(w->model, i)[PM_FORCE_KIND] == PM_FORCE_FRICTION) return; /* ida_jacobian.c has it */
    const pm_action action = pm_force_slope(w, i, slope);
    on_body(w, &action, slope, action.body_a, action.at_a, 1);
    on_body(w, &action, slope, action.body_b, action.at_b, -1);
    if (w->model->force_z[i] != PM_NONE) integral(w, w->model->force_z[i], &slope->power, 1);
}

static void path(pm_workspace *w, int i)
{
    pm_slope *slope = &w->ida->jacobian.slope->size;
    const pm_point p =
        pm_frame_point_of(&w->frame, PM_MEASURE_ROW(w->model, w->model->path[i])[PM_MEASURE_A]);
    const double speed = hypot(p.v[0], p.v[1]);
    if (speed == 0) return;
    pm_slope_clear(slope);
    pm_slope_add_velocity(&w->frame, slope, &p, (double[]){p.v[0] / speed, p.v[1] / speed});
    integral(w, w->model->nz_work + i, slope, 1);
}

/* Its momentum and its angle, and the power of the couple. */
static void turning_plane(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_slope *couple = &w->ida->jacobian.slope->couple, *omega = &w->ida->jacobian.slope->size;
    if (!pm_turning_plane_turns(m)) return;
    pm_turning_plane_add_forces(&w->frame, w->ida->jacobian.stiffness);
    pm_slope_clear(omega);
    pm_turning_plane_add_omega(&w->frame, omega, 1);
    if (m->spin_angle_z != PM_NONE) integral(w, m->spin_angle_z, omega, 1);
    if (m->spin_z == PM_NONE) return;
    const double speed = pm_turning_plane_omega(&w->frame), power = pm_turning_plane_power(w);
    pm_slope_clear(couple);
    pm_force_add_program(w, pm_turning_plane_program(m), 1, couple);
    integral(w, m->spin_z, couple, 1);
    integral(w, pm_ledger_power(m), couple, speed);
    if (speed != 0) integral(w, pm_ledger_power(m), omega, power / speed);
}

void pm_ida_slopes_forces(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_FORCE]; i++) one_force(w, i);
    for (int i = 0; i < w->model->npath; i++) path(w, i);
    turning_plane(w);
}

/* ---- power of sliding contacts and of drives ---- */
void pm_ida_slopes_power(pm_workspace *w)
{
    const pm_active_set *active = &w->active;
    double *power = w->ida->jacobian.ledger + pm_ledger_power(w->model);
    for (int i = 0; i < active->n; i++) power[i * w->model->nz] += active->constraint[i].rate;
    if (!active->asymmetric) return;
    for (int i = active->n; active->constraint[i].normal != PM_NONE; i++) {
        const pm_constraint *c = &active->constraint[i];
        power[c->normal * w->model->nz] +=
            active->constraint[c->normal].slide * pm_constraint_rate(&w->frame, c);
    }
}

void pm_ida_slopes_rub(pm_workspace *w, int z, const pm_constraint *c, const double *turn, double size)
{
    pm_slope *slope = &w->ida->jacobian.slope->size;
    pm_slope_clear(slope);
    pm_slope_add_bodies(&w->frame, slope, pm_constraint_bodies(c), c->body, turn, size, 0);
    pm_slope_add_bodies(&w->frame, slope, pm_constraint_bodies(c), c->body, c->j, size, 1);
    integral(w, z, slope, 1);
}

/* ---- momentum ---- */
/* The sum over the bodies of what acts on them by one number: of[stride * coordinate] of each. */
static void sum(const pm_workspace *w, const double *of, int stride, double *out)
{
    for (int i = 0; i < w->model->nbody; i++) {
        const double *pose = w->frame.pose + 5 * i, x = of[stride * 3 * i], y = of[stride * (3 * i + 1)];
        if (w->numbers.fixed[i]) continue;
        out[0] += x;
        out[1] += y;
        out[2] += of[stride * (3 * i + 2)] + pose[0] * y - pose[1] * x;
    }
}

void pm_ida_slopes_momentum(pm_workspace *w)
{
    const pm_ida_jacobian *x = &w->ida->jacobian;
    const int nq = w->model->nq, nz = w->model->nz, z = pm_ledger_ledger(w->model);
    double *place = by_place(w, z), *velocity = by_velocity(w, z);
    for (int i = 0; i < x->nactive; i++) sum(w, x->h + i * nq, 1, x->ledger + i * nz + z);
    for (int k = 0; k < nq; k++) {
        if (x->has_forces) sum(w, x->stiffness + k, nq, place + k * nz);
        if (x->has_damping) sum(w, x->damping + k, nq, velocity + k * nz);
    }
    for (int i = 0; i < w->model->nbody; i++) { /* and its arm */
        if (w->numbers.fixed[i]) continue;
        place[3 * i * nz + 2] += x->force[3 * i + 1];
        place[(3 * i + 1) * nz + 2] -= x->force[3 * i];
    }
}
