/* uniform_motion.c - places of a phase with constant accelerations, and its running integrals.
 *
 * Rates of work and of impulse are linear, moments quadratic in t, so that Simpson's rule is exact; the
 * distance that a point travels is the integral of the root of a parabola,
 *
 *   integral of |u + a t| = integral of sqrt(a^2 s^2 + p^2) by s,   s = t + u.a / a^2,   p = |u x a| / |a| */
#include <math.h>
#include <string.h>

#include "elements/force.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "numerics/tolerances.h"
#include "routes/uniform/uniform.h"
#include "state/frame.h"
#include "state/workspace.h"

/* ---- places ---- */
void pm_uniform_place(const pm_model *model, const pm_uniform *u, double t, double *q, double *v)
{
    for (int i = 0; i < model->nq; i++) {
        q[i] = u->q0[i] + t * (u->v[i] + 0.5 * t * u->a[i]);
        v[i] = u->v[i] + t * u->a[i];
    }
}

void pm_uniform_know_forces(pm_frame *frame, const pm_uniform *u)
{
    memcpy(frame->a, u->a, (size_t)frame->model->nq * sizeof(double));
    memcpy(frame->lambda, u->lambda, (size_t)frame->model->nconstraint * sizeof(double));
    frame->level = PM_LEVEL_DYNAMIC;
}

/* Couples that hold locked bodies may change: then reactions are solved for. */
int pm_uniform_react(pm_workspace *w)
{
    if (w->uniform->curve.levers) return pm_saddle_accelerate(w);
    pm_uniform_know_forces(&w->frame, w->uniform);
    return PM_OK;
}

static void look(pm_workspace *w, double t)
{
    pm_uniform *u = w->uniform;
    u->looked = NAN;
    pm_frame_look(&w->frame, u->t0 + t, u->q_look, u->v_look, w->state.z, w->state.memory);
}

void pm_uniform_look_there(pm_workspace *w, double t)
{
    look(w, t);
    const int status = pm_uniform_react(w);
    if (status) w->uniform->status = status;
}

/* Contact by contact the same place is looked at. */
static int looks_at(const pm_frame *frame, const pm_uniform *u, double t)
{
    return u->looked == t && frame->q == u->q_look && frame->v == u->v_look;
}

void pm_uniform_look(pm_workspace *w, double t)
{
    pm_uniform *u = w->uniform;
    if (looks_at(&w->frame, u, t)) {
        w->frame.level = PM_LEVEL_KINEMATIC;
        return;
    }
    pm_uniform_place(w->model, u, t, u->q_look, u->v_look);
    look(w, t);
    u->looked = t;
}

void pm_uniform_look_at_forces(pm_workspace *w, double t)
{
    pm_uniform_place(w->model, w->uniform, t, w->uniform->q_look, w->uniform->v_look);
    pm_uniform_look_there(w, t);
}

/* ---- running integrals ---- */
void pm_uniform_rates(pm_workspace *w, double *rate)
{
    pm_uniform_look_there(w, 0); /* no rate depends on the time itself */
    pm_force_all(w);             /* powers */
    pm_ledger_rates(w, rate);
}

void pm_uniform_rates_after(pm_workspace *w, double t, double *rate)
{
    pm_uniform_place(w->model, w->uniform, t, w->uniform->q_look, w->uniform->v_look);
    pm_uniform_rates(w, rate);
}

/* Gauss-Legendre, 8 points on [-1, 1]: the positive ones. */
static const double gauss_at[4] = {0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                   0.96028985649753623168};
static const double gauss_weight[4] = {0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                       0.10122853629037625915};

/* Integral of |u + a t| from 0 to h.  With s = t + u.a/a^2 and p = |u x a| / |a|: of sqrt(a^2 s^2 + p^2). */
static double distance_along(const double u[2], const double a[2], double h)
{
    const double speed = pm_length(u), size = pm_length(a);
    if (size * h <= PM_UNIFORM_SLOW_CHANGE * speed) {
        double sum = 0;
        for (int i = 0; i < 8; i++) {
            const double t = 0.5 * h * (1 + (i < 4 ? gauss_at[i] : -gauss_at[i - 4]));
            sum += gauss_weight[i % 4] * hypot(u[0] + a[0] * t, u[1] + a[1] * t);
        }
        return 0.5 * h * sum;
    }
    const double p = fabs(pm_cross(u, a)) / size, from = pm_dot(u, a) / size, to = from + size * h;
    double sum = to * hypot(to, p) - from * hypot(from, p); /* of size s = from .. to */
    if (p > 0) sum += p * p * (asinh(to / p) - asinh(from / p));
    return 0.5 * sum / size;
}

static void integrate_paths(pm_workspace *w, double t, double h, double *z)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->npath; i++) {
        pm_uniform_look(w, t);
        pm_uniform_know_forces(&w->frame, w->uniform);
        const pm_point p = pm_frame_point_of(&w->frame, PM_MEASURE_ROW(m, m->path[i])[PM_MEASURE_A]);
        double a[2];
        pm_frame_acceleration(&w->frame, &p, a);
        z[m->nz_work + i] = w->uniform->z0[m->nz_work + i] + distance_along(p.v, a, h);
    }
}

/* z at t, from the begin of the step; rate[0] is known. */
void pm_uniform_integrate(pm_workspace *w, double t, double *z)
{
    pm_uniform *u = w->uniform;
    const int nz = w->model->nz;
    const double h = t - u->begin;
    if (u->rests) {
        memcpy(z, u->z0, (size_t)nz * sizeof *z);
        return;
    }
    pm_uniform_rates_after(w, u->begin + 0.5 * h, u->rate + nz);
    pm_uniform_rates_after(w, t, u->rate + 2 * nz);
    for (int i = 0; i < nz; i++)
        z[i] = u->z0[i] + h / 6 * (u->rate[i] + 4 * u->rate[nz + i] + u->rate[2 * nz + i]);
    integrate_paths(w, u->begin, h, z);
}
