/* dependence.c - a constraint that depends on others here, at the frame, is looked at once more a little further on. */
#include "equations/dependence.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "equations/orthonormal_rows.h"
#include "equations/projection.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

/* The basis of the constraints that are active so far, at the frame; its size. */
static int basis_of_active(pm_workspace *w)
{
    pm_orthonormal_rest rest;
    int n = 0;
    for (int i = 0; i < w->active.n; i++) {
        pm_constraint_kind(w->active.constraint[i].kind)->evaluate(&w->frame, &w->active.constraint[i]);
        n = pm_orthonormal_rows_add_constraint(&w->saddle, n, &w->active.constraint[i], &rest);
    }
    return n;
}

/* A neighbour of the state on the active constraints: a little along the motion or, at rest, any way that they allow. */
static int go_nearby(pm_workspace *w, pm_state *s)
{
    static const double step[3] = {0.91, 0.57, 0.73}; /* no direction of the scene */
    const int nq = w->model->nq;
    double norm = 0;
    pm_state_copy(s, &w->state);
    for (int i = 0; i < nq; i++) norm += s->v[i] * s->v[i];
    norm = sqrt(norm);
    for (int i = 0; i < nq; i++) {
        const double along = norm > 0 ? s->v[i] / norm : step[i % 3] * (1 + 0.1 * (i / 3));
        s->q[i] += PM_NEIGHBOUR * w->numbers.size * along * (w->numbers.inverse_mass[i] > 0);
    }
    return pm_projection_apply(w, s);
}

/* Whether the basis leaves a body nowhere to go: a velocity of it alone, of whatever kind, is in its span. */
static int is_immobile(pm_workspace *w, int nbasis, int body)
{
    double *unit = w->saddle.previous;
    pm_orthonormal_rest rest;
    for (int k = 3 * body; k < 3 * body + 3 && body != w->model->nbody; k++) {
        if (!(w->numbers.inverse_mass[k] > 0)) continue;
        memset(unit, 0, (size_t)w->model->nq * sizeof *unit);
        unit[k] = 1;
        pm_orthonormal_rows_add_dense(&w->saddle, nbasis, unit, &rest);
        if (rest.left > PM_INDEPENDENT) return 0;
    }
    return 1;
}

/* Marks the bodies that active constraints join to those that are marked; whether there were any. */
static int mark_joined(const pm_active_set *active, int ground, int *marked)
{
    int more = 0;
    for (int i = 0; i < active->n; i++) {
        const pm_constraint *c = &active->constraint[i];
        for (int p = 0; p < pm_constraint_bodies(c); p++) {
            const int a = c->body[p], b = c->body[(p + 1) % pm_constraint_bodies(c)];
            if (a == ground || b == ground || marked[a] == marked[b]) continue;
            marked[a] = marked[b] = more = 1;
        }
    }
    return more;
}

/* Whether the active constraints hold fast both bodies of another one and all that they are joined to: for good, and not only
 * where a mechanism reverses. */
static int joins_fast(pm_workspace *w, const pm_constraint *c, int nbasis)
{
    const int ground = w->model->nbody;
    int *marked = w->active.body_place;
    memset(marked, 0, (size_t)ground * sizeof *marked);
    for (int p = 0; p < pm_constraint_bodies(c); p++)
        if (c->body[p] != ground) marked[c->body[p]] = 1;
    while (mark_joined(&w->active, ground, marked)) continue;
    for (int i = 0; i < ground; i++)
        if (marked[i] && !is_immobile(w, nbasis, i)) return 0;
    return 1;
}

/* Whether a constraint that depends on the active ones here does so nearby, too: so does one between bodies that these hold
 * fast. */
int pm_dependence_nearby(pm_workspace *w, const pm_constraint *c, int *depends)
{
    const int nbasis = basis_of_active(w);
    *depends = c->drive == PM_NONE && joins_fast(w, c, nbasis);
    if (*depends) return PM_OK;
    int status = go_nearby(w, &w->probe);
    if (!status) {
        pm_constraint copy = *c;
        pm_orthonormal_rest rest;
        pm_constraint_kind(copy.kind)->evaluate(&w->frame, &copy);
        pm_orthonormal_rows_add_constraint(&w->saddle, basis_of_active(w), &copy, &rest);
        *depends = rest.left < PM_DEPENDENT_NEARBY;
    } else if (status == PM_SINGULAR) {
        *depends = PM_DEPENDENCE_UNKNOWN;
        status = PM_OK;
    }
    pm_frame_look_state(&w->frame, &w->state);
    basis_of_active(w);
    return status;
}

int pm_dependence_on_all(pm_workspace *w, const pm_constraint *c, int *depends)
{
    pm_constraint copy = *c;
    pm_orthonormal_rest rest;
    const int nbasis = basis_of_active(w);
    pm_constraint_kind(copy.kind)->evaluate(&w->frame, &copy);
    pm_orthonormal_rows_add_constraint(&w->saddle, nbasis, &copy, &rest);
    *depends = PM_DEPENDENCE_NONE;
    return rest.left <= PM_INDEPENDENT ? pm_dependence_nearby(w, c, depends) : PM_OK;
}
