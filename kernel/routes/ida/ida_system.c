/* ida_system.c - stabilised index 2 (Gear, Gupta, Leimkuhler) with integrated multipliers:
 *
 *   q' - v + M^-1 G^T Mu' = 0         the motion, kept on the constraints
 *   v' - M^-1 (f + H^T L') = 0        signs as in saddle.c; v' = 0 where M^-1 = 0 (held)
 *   z' - rates(t, q, v, L') = 0       work, paths, the ledger
 *   g(t, q) = 0
 *   G v = w             prescribed rates: 0 of constraints that are not driven
 *
 * Friction of joints that goes with their load is a part of f that depends on L'.
 *
 * Only L' and Mu' appear, so the multipliers may be wrong by jumps without a trace in the error test, from
 * which L, Mu and the entries of the ledger are left out.  In the test of Newton's iteration L weighs as
 * the velocity that it makes, Mu as the displacement. */
#include "routes/ida/ida.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/force.h"
#include "elements/joint_friction.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

void pm_ida_system_layout(pm_workspace *w)
{
    pm_ida *r = w->ida;
    r->stride = PM_IDA_STOCK ? w->model->nconstraint : w->active.n;
    r->n = 2 * w->model->nq + w->model->nz + 2 * r->stride;
    memset(r->rounding.driven, 0, 2 * (size_t)w->model->nconstraint * sizeof(double));
    r->jacobian.sparse = pm_ida_sparse_serves(w->model, &w->active);
}

void pm_ida_system_look(pm_workspace *w, double t, const double *y, const double *yp)
{
    const int nq = w->model->nq;
    pm_frame *f = &w->frame;
    pm_frame_look(&w->frame, t, y, y + nq, y + 2 * nq, w->state.memory);
    memcpy(f->lambda, yp + pm_ida_place_l(w->model), (size_t)w->active.n * sizeof *yp);
    pm_joint_friction_update(w);
    pm_force_all(w);
    pm_saddle_evaluate(&w->active, &w->frame);
    memcpy(f->a, yp + nq, (size_t)nq * sizeof *yp);
    f->level = PM_LEVEL_DYNAMIC;
}

int pm_ida_system_start(pm_workspace *w, double *y, double *yp)
{
    const int nq = w->model->nq, nz = w->model->nz;
    memset(y, 0, (size_t)w->ida->n * sizeof *y);
    memset(yp, 0, (size_t)w->ida->n * sizeof *yp);
    pm_frame_look_state(&w->frame, &w->state);
    const int status = pm_saddle_accelerate(w);
    if (status) return status;
    memcpy(y, w->state.q, (size_t)(2 * nq + nz) * sizeof *y); /* q, v, z lie together */
    memcpy(yp, w->state.v, (size_t)nq * sizeof *yp);
    memcpy(yp + nq, w->frame.a, (size_t)nq * sizeof *yp);
    pm_ledger_rates(w, yp + 2 * nq);
    memcpy(yp + pm_ida_place_l(w->model), w->frame.lambda, (size_t)w->active.n * sizeof *yp);
    return PM_OK;
}

int pm_ida_system_residual(pm_workspace *w, double t, const double *y, const double *yp, double *r)
{
    const int nq = w->model->nq, nz = w->model->nz, l = pm_ida_place_l(w->model),
              mu = pm_ida_place_mu(w->model, w->ida);
    const double *v = y + nq, *force = w->frame.f;
    pm_ida_system_look(w, t, y, yp);
    for (int i = 0; i < nq; i++) {
        r[i] = yp[i] - v[i];
        r[nq + i] = -w->numbers.inverse_mass[i] * force[i];
    }
    memcpy(w->saddle.rhs, yp + mu, (size_t)w->active.n * sizeof *yp);
    pm_saddle_spread(&w->saddle, 0, r);
    for (int i = 0; i < w->active.n; i++) w->saddle.rhs[i] = -yp[l + i];
    pm_saddle_spread(&w->saddle, 1, r + nq);
    for (int i = 0; i < nq; i++) r[nq + i] += yp[nq + i];
    pm_ledger_rates(w, r + 2 * nq);
    for (int i = 2 * nq; i < 2 * nq + nz; i++) r[i] = yp[i] - r[i];
    for (int i = 0; i < w->ida->stride; i++) {
        const int active = i < w->active.n;
        r[l + i] = active ? w->active.constraint[i].g : yp[l + i];
        r[mu + i] = active ? pm_constraint_times(&w->frame, &w->active.constraint[i], v) -
                                 w->active.constraint[i].rate
                           : yp[mu + i];
    }
    double none = 0;
    for (int i = 0; i < w->ida->n; i++) none += 0 * r[i];
    return !isnan(none);
}

static void weigh_ledger(const pm_frame *frame, const pm_ida *ida, double *weight, double mass)
{
    const pm_model *m = frame->model;
    const double momentum = mass * frame->numbers->speed, energy = momentum * frame->numbers->speed;
    for (int i = 0; i < m->nz_controlled; i++)
        weight[i] = 1 / (ida->tolerance * pm_ledger_controlled_scale(frame, i));
    for (int i = m->nz_controlled; i < m->nz; i++) {
        const int entry = i - m->nz_controlled; /* friction, then impulses along x, y, and their moment */
        const double scale = entry == 0 ? energy : entry < 3 ? momentum : momentum * frame->numbers->size;
        weight[i] = PM_IDA_LEDGER_WEIGHT / (ida->tolerance * scale);
    }
}

void pm_ida_system_scale(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_ida *r = w->ida;
    const int l = pm_ida_place_l(w->model), mu = pm_ida_place_mu(w->model, w->ida);
    const double asked = fmax(w->numbers.tolerance, PM_IDA_FINEST);
    const double tolerance = r->tolerance = PM_IDA_TIGHTER * pow(asked, PM_IDA_POWER);
    const double mass = pm_frame_total_mass(&w->frame);
    double *weight = r->weight;
    for (int i = 0; i < m->nq; i++) {
        const int angle = i % 3 == 2; /* angles by the absolute tolerance only: they grow with every turn */
        weight[i] = 1 / (tolerance * (angle ? 1 : w->numbers.size));
        weight[m->nq + i] = 1 / (tolerance * (angle ? w->numbers.speed / w->numbers.size : w->numbers.speed));
    }
    weigh_ledger(&w->frame, w->ida, weight + 2 * m->nq, mass);
    for (int i = 0; i < r->stride; i++) {
        const double unit = i < w->active.n
                                ? sqrt(pm_constraint_square(&w->frame, &w->active.constraint[i]) / mass)
                                : 1 / mass;
        weight[l + i] = unit / (tolerance * w->numbers.speed);
        weight[mu + i] = unit / (tolerance * w->numbers.size);
    }
    pm_ida_rounding_find(w, N_VGetArrayPointer(r->y), NULL);
}

void pm_ida_system_weights(const pm_model *model, const pm_ida *r, const double *y, double *weight)
{
    /* IDA takes the root mean square over all unknowns: count those under control only */
    const double share = sqrt((double)r->n / (2 * model->nq + model->nz_controlled));
    for (int i = 0; i < r->n; i++)
        weight[i] = share * r->weight[i] /
                    (1 + PM_IDA_ROUNDINGS * r->weight[i] * pm_ida_rounding_at(&r->rounding, i, y[i]));
}
