/* ida_rounding.c - how far rounding moves the unknowns of ida_system.c.
 *
 * The terms of the residual are known to eps of themselves: of a constraint to eps sum |G_k| (|q_k| + size), of its rate
 * likewise, of what is prescribed at t, and of forces, to eps t times its rate, of y' to eps cj y.  What meets the equations
 * to that moves about by J^-1 of it, a light wheel on a long cord by many times its own rounding.  J^-1 is applied to such
 * residuals with several patterns of signs; until the first factors are there each constraint is taken alone:
 * W |G| r / (G W G^T). */
#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/drive.h"
#include "elements/force.h"
#include "equations/ledger.h"
#include "events/time_course.h"
#include "numerics/tolerances.h"
#include "routes/ida/ida.h"
#include "state/workspace.h"

#define PATTERNS 3 /* of signs */

int pm_ida_rounding_create(pm_arena *arena, pm_ida_rounding *x, const pm_model *m, int most)
{
    const size_t n = (size_t)most + 1;
    const pm_array array[] = {
        PM_ARRAY(x->all, n),   PM_ARRAY(x->own, n),   PM_ARRAY(x->residual, n),
        PM_ARRAY(x->shift, n), PM_ARRAY(x->timed, n), PM_ARRAY(x->driven, 2 * (size_t)m->nconstraint + 1),
    };
    return pm_arena_take(arena, PM_ARRAYS(array));
}

/* Of G x from that of x[nq]. */
static double of_sum(const pm_model *m, const pm_constraint *c, const double *rounding)
{
    double sum = 0;
    for (int p = 0; p < pm_constraint_bodies(c); p++)
        for (int k = 0; k < 3 && c->body[p] != m->nbody; k++)
            sum += fabs(c->j[3 * p + k]) * rounding[3 * c->body[p] + k];
    return sum;
}

/* Of the places of its marks, which may lie far from all that moves. */
static double of_marks(const pm_constraint *c)
{
    return PM_EPSILON * (fabs(c->a[0]) + fabs(c->a[1]) + fabs(c->b[0]) + fabs(c->b[1]));
}

/* What a reaction of that size makes of x[nq], added. */
static void pass_on(const pm_frame *frame, const pm_constraint *c, double reaction, double *rounding)
{
    for (int p = 0; p < pm_constraint_bodies(c); p++)
        for (int k = 0; k < 3 && c->body[p] != frame->model->nbody; k++) {
            const int i = 3 * c->body[p] + k;
            rounding[i] += frame->numbers->inverse_mass[i] * fabs(c->j[3 * p + k]) * reaction;
        }
}

/* Of the numbers themselves, those near zero as parts of the scale of their kind; L and Mu have none. */
static void of_numbers(const pm_model *m, const pm_ida *r, const double *y, double *own)
{
    for (int i = 0; i < r->n; i++) {
        const double scale = i < pm_ida_place_l(m) ? 1 / (r->tolerance * r->weight[i]) : 0;
        own[i] = PM_EPSILON * (fabs(y[i]) + scale);
    }
}

/* What is prescribed moves so fast, and as hard, as it ever did in the phase: at this very instant it may do neither. */
static const double *drive(pm_workspace *w, int i)
{
    double *driven = w->ida->rounding.driven + 2 * i;
    const pm_constraint *c = &w->active.constraint[i];
    driven[0] = fmax(driven[0], fabs(c->rate));
    driven[1] = fmax(driven[1], fabs(pm_drive_of(&w->frame, c).change));
    return driven;
}

/* Forces and the rates of what they integrate at the frame, by a part of the mass: [nq + nz_controlled]. */
static void read_forces(pm_workspace *w, double *of)
{
    const int nq = w->model->nq;
    pm_force_all(w);
    for (int i = 0; i < nq; i++) of[i] = w->numbers.inverse_mass[i] * w->frame.f[i];
    pm_ledger_controlled_rates(w, of + nq);
}

/* What forces change by in a part of the step, which rounding of the time makes that part of: at this very instant they may
 * not change at all. */
static void of_forces(pm_workspace *w)
{
    pm_ida_rounding *x = &w->ida->rounding;
    const int n = w->model->nq + w->model->nz_controlled;
    const double t = w->frame.t, rounded = PM_EPSILON * fabs(t);
    double step;
    memset(x->timed, 0, (size_t)n * sizeof *x->timed);
    if (!pm_time_course_is_any(w) || IDAGetCurrentStep(w->ida->memory, &step)) return;
    const double later = fmax(PM_IDA_LATER * step, PM_IDA_LATER_ROUNDINGS * rounded);
    w->frame.t = t + later <= w->frame.side.to ? t + later : t - later;
    read_forces(w, x->timed);
    w->frame.t = t;
    read_forces(w, x->shift);
    for (int i = 0; i < n; i++) x->timed[i] = rounded / later * fabs(x->timed[i] - x->shift[i]);
}

void pm_ida_rounding_find(pm_workspace *w, const double *y, const double *slope)
{
    const pm_model *m = w->model;
    pm_ida_rounding *x = &w->ida->rounding;
    const int nq = m->nq, l = pm_ida_place_l(m), mu = pm_ida_place_mu(m, w->ida);
    const double of_time = PM_EPSILON * fabs(w->frame.t);
    of_numbers(m, w->ida, y, x->own);
    memcpy(x->all, x->own, (size_t)w->ida->n * sizeof *x->all);
    for (int i = 0; i < w->active.n; i++) {
        const pm_constraint *c = &w->active.constraint[i];
        const double square = pm_constraint_square(&w->frame, c);
        double open = of_sum(m, c, x->own) + of_marks(c);
        double slip = of_sum(m, c, x->own + nq);
        if (c->drive != PM_NONE) {
            const double *driven = drive(w, i);
            open += of_time * driven[0];
            slip += of_time * driven[1];
        }
        for (int k = 0; slope && k < nq; k++) slip += fabs(slope[i * nq + k]) * x->own[k];
        pass_on(&w->frame, c, open / square, x->all);
        pass_on(&w->frame, c, slip / square, x->all + nq);
        x->all[l + i] += slip / square;
        x->all[mu + i] += open / square;
        x->residual[l + i] = open;
        x->residual[mu + i] = slip;
    }
    if (slope) of_forces(w);
}

/* Those of the differential equations; the constraints' are there. */
static void of_residual(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_ida_rounding *x = &w->ida->rounding;
    const int l = pm_ida_place_l(m);
    const double cj = w->ida->jacobian.cj;
    for (int i = 0; i < l; i++) x->residual[i] = cj * x->own[i];
    for (int i = 0; i < m->nq + m->nz_controlled; i++) x->residual[m->nq + i] += x->timed[i];
    for (int i = 0; i < w->active.n; i++)
        pass_on(&w->frame, &w->active.constraint[i], cj * x->own[l + i], x->residual + m->nq);
}

void pm_ida_rounding_solve(pm_workspace *w)
{
    const int n = w->ida->n;
    pm_ida_rounding *x = &w->ida->rounding;
    of_residual(w);
    for (unsigned pattern = 0; pattern < PATTERNS; pattern++) {
        for (int i = 0; i < n; i++) {
            const unsigned mixed = (unsigned)i * 2654435761u; /* Knuth's multiplicative hash */
            x->shift[i] = mixed >> (28 - 3 * pattern) & 1 ? x->residual[i] : -x->residual[i];
        }
        pm_ida_linear_solve(w->model, w->ida, x->shift, x->shift);
        for (int i = 0; i < n; i++) x->all[i] = fmax(x->all[i], fabs(x->shift[i]));
    }
}
