/* rk_derivative.c - y' of the rk route, and the choice of how accelerations are computed.
 *
 *   y = (coordinates, their rates, z),    y' = (rates, accelerations(t, y), z')
 *
 * Accelerations of small trees need no look of the frame (tree_small.c).  Where the loop constraints nearly depend
 * on each other the coordinates are partitioned (tree_partition.c): then each stage is made to meet these
 * constraints first. */
#include "equations/ledger.h"
#include "routes/rk/rk.h"
#include "state/workspace.h"
#include "tree/tree.h"

/* The rest of y' once its accelerations are there; the ledger's part needs the frame to look at y. */
static void complete(pm_workspace *w, const double *y, int with_ledger, double *k)
{
    const struct pm_rk *r = w->rk;
    for (int i = 0; i < r->n; i++) k[i] = y[r->n + i];
    if (with_ledger) {
        pm_tree_tell(w, k + r->n);
        pm_ledger_rates(w, k + 2 * r->n);
    } else if (r->controlled > 2 * r->n) {
        pm_ledger_controlled_rates(w, k + 2 * r->n);
    }
}

int pm_rk_derivative_here(pm_workspace *w, const double *y, int with_ledger, double *k)
{
    const int status = pm_tree_accelerate(w, k + w->rk->n);
    if (status) return status;
    complete(w, y, with_ledger, k);
    /* all stages by one formula: two that differ by rounding would make a body at rest sway */
    return w->rk->swift ? pm_tree_small_derivative(w, y, k) : PM_OK;
}

int pm_rk_derivative(pm_workspace *w, double t, double *y, int with_ledger, double *k)
{
    const int n = w->rk->n;
    int status = PM_OK;
    if (!with_ledger && w->rk->swift) return pm_tree_small_derivative(w, y, k);
    if (w->tree->part.few) {
        status = pm_tree_settle(w, t, y, y + n, y + 2 * n);
    } else if (!with_ledger && w->rk->controlled == 2 * n) {
        status = pm_tree_accelerate_at(w, t, y, y + n, y + 2 * n, k + n);
        if (!status) complete(w, y, 0, k);
        return status;
    } else {
        pm_tree_look(w, t, y, y + n, y + 2 * n);
    }
    return status ? status : pm_rk_derivative_here(w, y, with_ledger, k);
}

int pm_rk_choose_coordinates(pm_workspace *w)
{
    const int bad = !w->active.asymmetric && (pm_tree_is_steep(w->tree) || pm_tree_is_flat(w->tree));
    if (bad) pm_tree_partition(&w->frame, w->tree);
    w->tree->part.independence = 1;
    w->rk->swift = w->rk->controlled == 2 * w->rk->n && pm_tree_small_applies(w);
    return bad && w->tree->part.few;
}
