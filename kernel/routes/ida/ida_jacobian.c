/* ida_jacobian.c - derivatives of the system of ida_system.c.
 *
 * Constraints give G, H and dz'/dlambda as they are.  Differences give M^-1 d(f + H^T lambda)/dq (stiffness of
 * springs and of the geometry), M^-1 df/dv where some force may depend on velocities, and d(G v)/dq.  Left
 * out, because Newton's iteration does not need them: d(M^-1 G^T Mu')/dq, where Mu' is small, and dz'/dq,
 * dz'/dv of what is not stiff. */
#include "routes/ida/ida.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/force.h"
#include "elements/joint_friction.h"
#include "elements/turning_plane.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/workspace.h"

/* What the differences are taken from, in the scratch of the blocks. */
typedef struct pm_ida_differences {
    double *y;                   /* [2 nq + nz] moved in one coordinate at a time */
    double *force, *force_moved; /* [nq] M^-1 (f + H^T lambda) */
    double *rate, *rate_moved;   /* [nconstraint] G v */
    double *z, *z_moved;         /* [nz] */
} pm_ida_differences;

static size_t work_size(const pm_model *m) /* as much as ida_linear.c needs, too */
{
    return 5 * (size_t)m->nq + 3 * (size_t)m->nz + 3 * (size_t)m->nconstraint;
}

static pm_ida_differences differences(const pm_model *m, double *work)
{
    pm_ida_differences d = {.y = work};
    d.force = d.y + 2 * m->nq + m->nz;
    d.force_moved = d.force + m->nq;
    d.rate = d.force_moved + m->nq;
    d.rate_moved = d.rate + m->nconstraint;
    d.z = d.rate_moved + m->nconstraint;
    d.z_moved = d.z + m->nz;
    return d;
}

static int has_damping(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        if (!pm_force_of(m, i)->stores) return 1;
    return 0;
}

int pm_ida_jacobian_create(pm_arena *arena, pm_ida_jacobian *x, const pm_model *m)
{
    const size_t nq = (size_t)m->nq, most = (size_t)m->nconstraint, nz = (size_t)m->nz, both = nq + most;
    const pm_array array[] = {
        PM_ARRAY(x->g, most * nq),
        PM_ARRAY(x->h, most * nq),
        PM_ARRAY(x->gv_slope, most * nq),
        PM_ARRAY(x->spread, nq * most),
        PM_ARRAY(x->share, nq * most),
        PM_ARRAY(x->project, nq * nq),
        PM_ARRAY(x->stiffness, nq * nq),
        PM_ARRAY(x->damping, nq * nq),
        PM_ARRAY(x->ledger, nz * (most + 2 * nq)),
        PM_ARRAY(x->schur, most * most),
        PM_ARRAY(x->inverse_schur, most * most),
        PM_ARRAY(x->bend, nq * both),
        PM_ARRAY(x->system, both * both),
        PM_ARRAY(x->scale, both),
        PM_ARRAY(x->work, work_size(m)),
        PM_ARRAY(x->pivot, both),
        PM_ARRAY(x->bending, nq),
    };
    x->has_forces = m->rows[PM_TABLE_FORCE] > 0 || pm_turning_plane_turns(m);
    x->has_damping = has_damping(m);
    return pm_arena_take(arena, PM_ARRAYS(array));
}

/* A constraint's six numbers on all coordinates. */
static void spread_out(const pm_model *model, const pm_constraint *c, const double *six, double *dense)
{
    memset(dense, 0, (size_t)model->nq * sizeof *dense);
    for (int p = 0; p < 2; p++)
        for (int k = 0; k < 3 && c->body[p] != model->nbody; k++) dense[3 * c->body[p] + k] += six[3 * p + k];
}

/* M^-1 (f + H^T lambda) and G v at the frame, lambda as there. */
static void force_and_rate(pm_workspace *w, const double *v, double *force, double *rate)
{
    for (int i = 0; i < w->model->nq; i++) force[i] = w->numbers.inverse_mass[i] * w->frame.f[i];
    memcpy(w->saddle.rhs, w->frame.lambda, (size_t)w->active.n * sizeof(double));
    pm_saddle_spread(&w->saddle, 1, force);
    for (int i = 0; i < w->active.n; i++)
        rate[i] = pm_constraint_times(&w->frame, &w->active.constraint[i], v);
}

static void constraints(const pm_model *model, pm_active_set *active, pm_ida_jacobian *x)
{
    const int nq = model->nq;
    for (int i = 0; i < active->n; i++) {
        spread_out(model, &active->constraint[i], active->constraint[i].j, x->g + i * nq);
        spread_out(model, &active->constraint[i],
                   active->asymmetric ? active->constraint[i].h : active->constraint[i].j, x->h + i * nq);
    }
}

/* Moves *y by a small step of its scale; returns the step as a difference of two numbers. */
static double move(double *y, double scale)
{
    const double old = *y;
    volatile double moved = old + sqrt(DBL_EPSILON) * fmax(scale, fabs(old));
    *y = moved;
    return moved - old;
}

/* Sliding friction of joints leans the direction of the reactions that it goes with: df/dlambda, by differences. */
static void friction(pm_workspace *w, pm_ida_jacobian *x, const pm_ida_differences *d)
{
    const int nq = w->model->nq;
    double *lambda = w->frame.lambda, most = 1;
    if (!pm_joint_friction_by_load(&w->frame, &w->state)) return;
    memcpy(d->force, w->frame.f, (size_t)nq * sizeof *d->force);
    for (int k = 0; k < w->active.n; k++) most = fmax(most, fabs(lambda[k]));
    for (int k = 0; k < w->active.n; k++) {
        const double old = lambda[k];
        if (w->active.constraint[k].joint == PM_NONE) continue;
        const double step = move(&lambda[k], most);
        pm_joint_friction_update(w);
        pm_force_all(w);
        lambda[k] = old;
        for (int i = 0; i < nq; i++) x->h[k * nq + i] += (w->frame.f[i] - d->force[i]) / step;
    }
    pm_joint_friction_update(w);
    pm_force_all(w);
}

/* One column of the derivatives of z', from the rates at the frame. */
static void ledger_column(pm_workspace *w, pm_ida_jacobian *x, const pm_ida_differences *d, int column,
                          double step)
{
    const int nz = w->model->nz;
    pm_ledger_rates(w, d->z_moved);
    for (int i = 0; i < nz; i++) x->ledger[column * nz + i] = (d->z_moved[i] - d->z[i]) / step;
}

/* dz'/dlambda: the rates are linear in the reactions. */
static void ledger(pm_workspace *w, pm_ida_jacobian *x, const pm_ida_differences *d)
{
    pm_ledger_rates(w, d->z);
    for (int k = 0; k < w->active.n; k++) {
        const double old = w->frame.lambda[k], step = fmax(1, fabs(old));
        w->frame.lambda[k] = old + step;
        ledger_column(w, x, d, k, step);
        w->frame.lambda[k] = old;
    }
}

static void velocities(pm_workspace *w, pm_ida_jacobian *x, double t, const pm_ida_differences *d)
{
    const int nq = w->model->nq;
    double *v = d->y + nq;
    memcpy(d->force, w->frame.f, (size_t)nq * sizeof *d->force);
    for (int k = 0; k < nq; k++) {
        const double old = v[k],
                     step = move(&v[k], k % 3 == 2 ? w->numbers.speed / w->numbers.size : w->numbers.speed);
        pm_frame_look(&w->frame, t, d->y, v, v + nq, w->state.memory);
        pm_force_all(w);
        v[k] = old;
        for (int i = 0; i < nq; i++)
            x->damping[i * nq + k] = w->numbers.inverse_mass[i] * (w->frame.f[i] - d->force[i]) / step;
        ledger_column(w, x, d, w->model->nconstraint + nq + k, step);
    }
}

static void positions(pm_workspace *w, pm_ida_jacobian *x, double t, const double *yp,
                      const pm_ida_differences *d)
{
    const int nq = w->model->nq;
    pm_ida_system_look(w, t, d->y, yp);
    force_and_rate(w, d->y + nq, d->force, d->rate);
    for (int k = 0; k < nq; k++) {
        const double old = d->y[k], step = move(&d->y[k], k % 3 == 2 ? 1 : w->numbers.size);
        pm_ida_system_look(w, t, d->y, yp);
        force_and_rate(w, d->y + nq, d->force_moved, d->rate_moved);
        d->y[k] = old;
        for (int i = 0; i < nq; i++) x->stiffness[i * nq + k] = (d->force_moved[i] - d->force[i]) / step;
        for (int i = 0; i < w->active.n; i++)
            x->gv_slope[i * nq + k] = (d->rate_moved[i] - d->rate[i]) / step;
        if (x->has_forces) ledger_column(w, x, d, w->model->nconstraint + k, step);
    }
}

void pm_ida_jacobian_evaluate(pm_workspace *w, double t, double cj, const double *y, const double *yp)
{
    const pm_model *m = w->model;
    pm_ida_jacobian *x = &w->ida->jacobian;
    const pm_ida_differences d = differences(m, x->work);
    memcpy(d.y, y, (size_t)(2 * m->nq + m->nz) * sizeof *y);
    x->nactive = w->active.n;
    x->cj = cj;
    pm_ida_system_look(w, t, d.y, yp);
    if (x->sparse) x->independence = pm_saddle_independence(&w->saddle);
    constraints(w->model, &w->active, x);
    friction(w, x, &d);
    ledger(w, x, &d);
    if (x->has_damping) velocities(w, x, t, &d);
    positions(w, x, t, yp, &d);
    pm_ida_rounding_find(w, y, x->gv_slope);
}
