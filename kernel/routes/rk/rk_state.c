/* rk_state.c - y of the rk route as a state of the scene.
 *
 * At the end of a step y is put back on the loop constraints, and on the energy level of the phase where energy is kept
 * (energy_level.h).  Inside a step it is that of the dense output; exact states are those of a step that ends there. */
#include <string.h>

#include "elements/constraint.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "routes/rk/rk.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree.h"

/* ---- at the end of a step ---- */
/* Coordinates y, where the frame looks. */
static void tell(const struct pm_tree *tree, const struct pm_rk *rk, double t, const double *y, pm_state *s)
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
    /* evaluated loop constraints; nothing drives them, so that this is quadratic in the rates */
    for (int i = 0; i < w->tree->nloop && factor != 1; i++)
        w->active.constraint[w->tree->loop[i]].gamma *= factor * factor;
    return gained;
}

int pm_rk_settle(pm_workspace *w, double t, double *y, pm_state *s, double *gained)
{
    const int n = w->rk->n, status = pm_tree_project(w, t, y, y + n, y + 2 * n);
    if (status) return status;
    *gained = restore_energy(w, y + n);
    if (!w->rk->ledger) pm_ledger_follow(&w->frame, w->rk->momentum, y + 2 * n);
    tell(w->tree, w->rk, t, y, s);
    return PM_OK;
}

/* ---- inside it ---- */
int pm_rk_at(pm_workspace *w, double t, pm_state *s)
{
    const struct pm_rk *r = w->rk;
    const int status = pm_rk_dense(w, t);
    if (status) return status;
    pm_tree_look(w, t, r->y, r->y + r->n, r->y + 2 * r->n);
    tell(w->tree, w->rk, t, r->y, s);
    return PM_OK;
}

/* Accelerations and reactions for whoever watches, in the coordinates of the phase; where these are
 * partitioned the loop constraints are not met to rounding inside a step.  The choice of coordinates does not
 * depend on being watched. */
static int accelerate_watched(pm_workspace *w)
{
    pm_tree *t = w->tree;
    const double independence = t->part.independence;
    if (t->part.few) return pm_saddle_accelerate(w);
    const int status = pm_tree_accelerate(w, w->rk->side);
    if (!status) pm_tree_tell(w, w->rk->side);
    t->part.independence = independence;
    return status;
}

int pm_rk_look(pm_workspace *w, double t, int level)
{
    if (t == w->step.whole_end) {
        pm_frame_look_state(&w->frame, &w->state);
        return level == PM_LEVEL_DYNAMIC ? pm_saddle_accelerate(w) : PM_OK;
    }
    const int status = pm_rk_at(w, t, &w->probe);
    return !status && level == PM_LEVEL_DYNAMIC ? accelerate_watched(w) : status;
}

/* From the begin of the step to t in two halves: a phase that one step covers would have the same error in
 * a coarse run (accuracy.c).  Stage 0 is in r->side. */
static int in_halves(pm_workspace *w, double t)
{
    struct pm_rk *r = w->rk;
    double *const y0 = r->y0;
    const double t0 = r->t0, h = 0.5 * (t - t0);
    int status = pm_rk_stages(w, h, r->side, r->y);
    memcpy(r->middle, r->y, (size_t)r->all * sizeof(double));
    r->y0 = r->middle;
    r->t0 = t0 + h;
    if (!status) status = pm_rk_derivative(w, r->t0, r->y0, 1, r->side);
    if (!status) status = pm_rk_stages(w, h, r->side, r->y);
    r->y0 = y0;
    r->t0 = t0;
    return status;
}

/* Where an exact state is wanted in a step of the main run: the step that leads to it ends there.  While an event is looked for each
 * place takes that of the one before. */
static void note_place(struct pm_rk *r, double t)
{
    int i = r->nended - 1;
    if (i < 0 || t <= r->t0 || t >= r->ended[i]) return;
    while (i > 0 && r->ended[i - 1] >= t) i--;
    const double near = PM_RK_SAME_PLACE * r->h;
    const int is_next = i < r->nended - 1 && r->ended[i] - t <= near;
    const int is_last = i > 0 && r->ended[i - 1] > r->t0 && t - r->ended[i - 1] <= near;
    if (is_next || is_last) {
        r->ended[is_next ? i : i - 1] = t;
    } else if (r->nended < PM_RK_NOTED / 2) { /* the rest is for ends of steps */
        memmove(r->ended + i + 1, r->ended + i, (size_t)(r->nended - i) * sizeof *r->ended);
        r->ended[i] = t;
        r->nended++;
    }
}

int pm_rk_exact(pm_workspace *w, double t, pm_state *s)
{
    struct pm_rk *r = w->rk;
    const size_t bytes = (size_t)r->all * sizeof(double);
    double gained;
    int status = PM_OK;
    if (!pm_evidence_is_coarse(&w->evidence)) note_place(r, t);
    if (s != &w->state) pm_state_copy(s, &w->state);
    if (t == r->t0) {
        memcpy(r->y, r->y0, bytes);
    } else {
        memcpy(r->side, r->k, bytes);
        status =
            pm_evidence_in_halves(&w->evidence) ? in_halves(w, t) : pm_rk_stages(w, t - r->t0, r->side, r->y);
    }
    return status ? status : pm_rk_settle(w, t, r->y, s, &gained);
}
