/* rk_settle.c - y of the rk route as a state of the scene; that at the end of a step is put back on the
 * loop rows, and on the energy level of the phase where energy is kept (energy_level.h). */
#include <string.h>

#include "elements/constraint.h"
#include "equations/ledger.h"
#include "routes/rk/rk.h"
#include "state/workspace.h"
#include "tree/tree.h"

void pm_rk_tell(const struct pm_tree *tree, const struct pm_rk *rk, double t, const double *y, pm_state *s)
{
    memcpy(s->q, tree->q, (size_t)tree->model->nq * sizeof *y);
    memcpy(s->v, tree->v, (size_t)tree->model->nq * sizeof *y);
    memcpy(s->z, y + 2 * rk->n, (size_t)tree->model->nz * sizeof *y);
    s->t = t;
}

/* Rates, where the frame looks, to the energy of the phase; the energy that they gain. */
static double restore_energy(pm_workspace *w, double *rates)
{
    double gained;
    const double factor = pm_energy_level_factor(w, &w->rk->level, &gained);
    for (int i = 0; i < w->rk->n && factor != 1; i++) rates[i] *= factor;
    for (int i = 0; i < w->model->nq && factor != 1; i++) w->frame.velocity[i] = w->tree->v[i] *= factor;
    /* evaluated loop rows; nothing drives them, so that this is quadratic in the rates */
    for (int i = 0; i < w->tree->nloop && factor != 1; i++)
        w->active.row[w->tree->loop[i]].gamma *= factor * factor;
    return gained;
}

int pm_rk_settle(pm_workspace *w, double t, double *y, pm_state *s, double *gained)
{
    const int n = w->rk->n, status = pm_tree_project(w, t, y, y + n, y + 2 * n);
    if (status) return status;
    *gained = restore_energy(w, y + n);
    if (!w->rk->ledger) pm_ledger_follow(&w->frame, w->rk->momentum, y + 2 * n);
    pm_rk_tell(w->tree, w->rk, t, y, s);
    return PM_OK;
}
