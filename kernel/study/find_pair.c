/* find_pair.c - two conditions met by two parameters.
 *
 * The bounds are divided into a grid of cells.  From the middle of every cell at whose corners both conditions have both
 * signs - from the best node where there is no such cell - GSL's hybrid method (Newton's with differences and Broyden's
 * updates, in a region of trust) goes on to a root; beyond the bounds it sees the conditions as they are at the bound, so
 * that it is drawn back.  A root counts if it lies within the bounds and the conditions nearly vanish there. */
#include "study/find.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multiroots.h>
#include <math.h>

#include "numerics/tolerances.h"
#include "state/workspace.h"

typedef struct pm_find_pair_context {
    pm_workspace *w;
    double size[2]; /* greatest size of the conditions on the grid */
    pm_look look;   /* at the last place */
    int status;
} pm_find_pair_context;

void *pm_find_pair_create(void) { return gsl_multiroot_fsolver_alloc(gsl_multiroot_fsolver_hybrids, 2); }

void pm_find_pair_free(void *solver)
{
    if (solver) gsl_multiroot_fsolver_free(solver);
}

static double reading(const pm_find *f, const pm_look *look, int k) { return look->reading[f->zero[k]]; }

/* The conditions, of size 1, at u (the bounds are 0 and 1). */
static int conditions(const gsl_vector *u, void *context, gsl_vector *value)
{
    pm_find_pair_context *c = context;
    const pm_find *f = c->w->find;
    double x[2];
    for (int k = 0; k < 2; k++) {
        const double part = fmin(fmax(gsl_vector_get(u, (size_t)k), 0), 1);
        x[k] = f->low[k] + part * (f->high[k] - f->low[k]);
    }
    if (!c->status) c->status = pm_find_look(c->w, x, &c->look);
    for (int k = 0; k < 2; k++) {
        const double scaled = reading(f, &c->look, k) / c->size[k];
        if (c->status || !isfinite(scaled)) return GSL_EBADFUNC;
        gsl_vector_set(value, (size_t)k, scaled);
    }
    return GSL_SUCCESS;
}

static int sample(pm_workspace *w, double size[2])
{
    pm_find *f = w->find;
    const int n = f->samples, side = n + 1;
    size[0] = size[1] = 0;
    for (int i = 0; i < side * side; i++) {
        const double part[2] = {(double)(i / side) / n, (double)(i % side) / n};
        double x[2];
        for (int k = 0; k < 2; k++)
            x[k] = part[k] < 1 ? f->low[k] + part[k] * (f->high[k] - f->low[k]) : f->high[k];
        const int status = pm_find_look(w, x, &f->node[i]);
        if (status) return status;
        for (int k = 0; k < 2; k++)
            if (isfinite(reading(f, &f->node[i], k)))
                size[k] = fmax(size[k], fabs(reading(f, &f->node[i], k)));
    }
    return PM_OK;
}

/* Both conditions have both signs at the corners of a cell. */
static int is_crossed(const pm_find *f, int cell_x, int cell_y)
{
    for (int k = 0; k < 2; k++) {
        int below = 0, above = 0;
        for (int i = 0; i < 4; i++) {
            const double value =
                reading(f, &f->node[(cell_x + i / 2) * (f->samples + 1) + cell_y + i % 2], k);
            if (isnan(value)) return 0;
            below |= value <= 0;
            above |= value >= 0;
        }
        if (!below || !above) return 0;
    }
    return 1;
}

static int is_new(const pm_find *f, const pm_look *look)
{
    for (int i = 0; i < f->nfound; i++) {
        double apart = 0;
        for (int k = 0; k < 2; k++)
            apart = fmax(apart, fabs(look->x[k] - f->found[i].x[k]) / (f->high[k] - f->low[k]));
        if (apart <= PM_PAIR_SAME) return 0;
    }
    return 1;
}

static int go_from(pm_find_pair_context *c, double ux, double uy)
{
    pm_find *f = c->w->find;
    gsl_multiroot_fsolver *solver = f->pair;
    gsl_multiroot_function function = {conditions, 2, c};
    double start[2] = {ux, uy};
    const gsl_vector_view u = gsl_vector_view_array(start, 2);
    int result = gsl_multiroot_fsolver_set(solver, &function, &u.vector);
    for (int i = 0; i < PM_PAIR_STEPS && !result; i++) {
        result = gsl_multiroot_fsolver_iterate(solver);
        if (fabs(gsl_vector_get(solver->dx, 0)) <= PM_PAIR_STILL &&
            fabs(gsl_vector_get(solver->dx, 1)) <= PM_PAIR_STILL)
            break;
    }
    if (c->status) return c->status;
    double x[2];
    for (int k = 0; k < 2; k++) {
        const double part = gsl_vector_get(solver->x, (size_t)k);
        if (!(part >= 0 && part <= 1)) return PM_OK;
        x[k] = f->low[k] + part * (f->high[k] - f->low[k]);
    }
    const int status = pm_find_look(c->w, x, &c->look);
    if (status) return status;
    for (int k = 0; k < 2; k++)
        if (!(fabs(reading(f, &c->look, k)) <= PM_PAIR_MET * c->size[k])) return PM_OK;
    if (c->look.holds && is_new(f, &c->look)) f->found[f->nfound++] = c->look;
    return PM_OK;
}

static int best_node(const pm_find *f, const double size[2])
{
    int best = PM_NONE;
    double least = INFINITY;
    for (int i = 0; i < (f->samples + 1) * (f->samples + 1); i++) {
        const double miss = hypot(reading(f, &f->node[i], 0) / size[0], reading(f, &f->node[i], 1) / size[1]);
        if (!(miss < least)) continue;
        least = miss;
        best = i;
    }
    return best;
}

int pm_find_pair(pm_workspace *w)
{
    pm_find *f = w->find;
    pm_find_pair_context c = {.w = w};
    const int n = f->samples, side = n + 1;
    int crossed = 0, status = sample(w, c.size);
    for (int i = 0; i < n * n && !status; i++) {
        if (!is_crossed(f, i / n, i % n)) continue;
        crossed++;
        status = go_from(&c, (i / n + 0.5) / n, (i % n + 0.5) / n);
    }
    const int best = status || crossed ? PM_NONE : best_node(f, c.size);
    if (best != PM_NONE) status = go_from(&c, (double)(best / side) / n, (double)(best % side) / n);
    return status;
}
