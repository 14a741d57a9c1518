/* path_motion.c - accelerations and reactions at a place on the path, without the saddle-point system.
 *
 * With one freedom all velocities are t udot, t those at a unit rate u, and the accelerations a = t uddot + c, c what the
 * velocities make of them.  d'Alembert's principle with the virtual displacement t leaves the reactions out:
 *
 *   (t . M t) uddot = t . (f - M c)
 *
 * where no row closes a loop c = udot^2 dt/du: at a place that is looked at more than once, or at several speeds, dt/du and
 * the levers of the tree are kept.  The reactions follow from M a - f body by body (tree_dynamics.c).  Where rows close loops the coordinates are
 * partitioned with the driver as the independent one (tree_partition.c). */
#include <math.h>

#include "body.h"
#include "force.h"
#include "path.h"
#include "row.h"
#include "tree.h"

static void accelerate_open(pm_workspace *w, const double *t)
{
    const double *f = w->frame.f;
    double *a = w->frame.a, mass = 0, force = 0;
    pm_force_all(w);
    pm_tree_bias(w, a);
    for (int i = 0; i < w->model->nq; i++) {
        const double inertia = i % 3 == 2 ? pm_body_inertia(w, i / 3) : w->mass[i / 3];
        mass += inertia * t[i] * t[i];
        force += t[i] * (f[i] - inertia * a[i]);
    }
    for (int i = 0; i < w->model->nq; i++) a[i] += t[i] * force / mass;
}

static int accelerate_closed(pm_workspace *w)
{
    pm_tree *t = w->tree;
    pm_tree_hold(w, w->path->driver);
    for (int i = 0; i < t->nloop; i++) {
        pm_row *row = &w->row[t->loop[i]];
        pm_row_kind(row->kind)->evaluate(w, row);
    }
    return pm_tree_accelerate_few(w, t->force);
}

int pm_path_accelerate(pm_workspace *w, const double *along)
{
    int status = PM_OK;
    pm_tree_marks(w);
    w->count[PM_COUNT_SOLVES]++;
    w->tree->few = w->tree->nloop > 0;
    if (w->tree->few)
        status = accelerate_closed(w);
    else
        accelerate_open(w, along);
    if (!status) pm_tree_react(w);
    w->tree->few = 0;
    return status;
}

void pm_path_bend(pm_workspace *w, pm_place *x)
{
    const double *t = x->tangent;
    pm_tree_bias(w, x->bend);
    pm_tree_keep_arms(w, x->arm);
    x->change = 0;
    for (int i = 0; i < w->model->nbody; i++) {
        const double *c = x->bend + 3 * i;
        x->change += w->mass[i] * (t[3 * i] * c[0] + t[3 * i + 1] * c[1]) +
                     pm_body_inertia(w, i) * t[3 * i + 2] * c[2];
    }
}

void pm_path_accelerate_at(pm_workspace *w, const pm_place *x)
{
    const double square = 2 * fmax(x->kinetic, 0) / x->mass, own = (x->force - x->change * square) / x->mass;
    double *a = w->frame.a;
    w->count[PM_COUNT_SOLVES]++;
    pm_force_all(w);
    pm_tree_give_arms(w, x->arm);
    for (int i = 0; i < w->model->nq; i++) a[i] = x->tangent[i] * own + x->bend[i] * square;
    pm_tree_react(w);
}
