/* path_motion.c - accelerations and reactions at a place on the path, without the saddle-point system.
 *
 * With one freedom all velocities are t udot, t those at a unit rate u, and the accelerations a = t uddot + c, c what the
 * velocities make of them.  d'Alembert's principle with the virtual displacement t leaves the reactions out:
 *
 *   (t . M t) uddot = t . (f - M c)
 *
 * and the reactions follow from M a - f body by body (tree_dynamics.c).  Where constraints close loops the coordinates are
 * partitioned with the driver as the independent one (tree_partition.c). */
#include "elements/force.h"
#include "elements/joint_friction.h"
#include "equations/saddle.h"
#include "routes/path/path.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree.h"

static void accelerate_open(pm_workspace *w, const double *t)
{
    const double *f = w->frame.f;
    double *a = w->frame.a, mass = 0, force = 0;
    pm_force_all(w);
    pm_tree_bias(w->tree, &w->frame, a);
    for (int i = 0; i < w->model->nq; i++) {
        const double inertia = i % 3 == 2 ? pm_frame_inertia(&w->frame, i / 3) : w->numbers.mass[i / 3];
        mass += inertia * t[i] * t[i];
        force += t[i] * (f[i] - inertia * a[i]);
    }
    for (int i = 0; i < w->model->nq; i++) a[i] += t[i] * force / mass;
}

static int accelerate_closed(pm_workspace *w)
{
    pm_tree *t = w->tree;
    pm_tree_hold(t, w->path->driver);
    pm_tree_evaluate_loops(t, &w->frame);
    return pm_tree_accelerate_few(w, t->force);
}

int pm_path_accelerate(pm_workspace *w, const double *along)
{
    int status = PM_OK;
    pm_tree_marks(w->tree, &w->frame);
    w->result.count[PM_COUNT_SOLVES]++;
    w->tree->part.few = w->tree->nloop > 0;
    if (w->tree->part.few)
        status = accelerate_closed(w);
    else
        accelerate_open(w, along);
    if (!status) pm_tree_react(w);
    w->tree->part.few = 0;
    return status;
}

/* Nothing is factored where no constraint closes a loop. */
int pm_path_react(pm_workspace *w)
{
    if (w->tree->nloop > 0 || pm_joint_friction_by_load(&w->frame, &w->state)) return pm_saddle_accelerate(w);
    return pm_path_accelerate(w, w->frame.v);
}
