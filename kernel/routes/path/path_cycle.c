/* path_cycle.c - a step that begins like the last one, but for a shift that the scene does not notice (symmetry.c).
 *
 * Its places are those of the step before: positions and potential differ from them as those of its begin do from the begin
 * of that step, directions and forces do not, and
 *
 *   T(u) = T_begin + (T(u) - T_begin) of the step before
 */
#include <math.h>

#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "state/workspace.h"

int pm_path_cycle(const pm_workspace *w)
{
    pm_path *p = w->path;
    const pm_place *const then = &p->node[0], *now = &p->begin;
    double size = 0, off = 0;
    if (p->driver != p->node_driver || p->sense != p->node_sense) return 0;
    for (int i = 0; i < w->model->nq; i++) {
        const double length = i % 3 == 2 ? w->numbers.size : 1;
        size = pm_max(fabs(then->tangent[i]) * length, size);
        off = pm_max(fabs(now->tangent[i] - then->tangent[i]) * length, off);
    }
    for (int k = 0; k < p->nodes->n; k++)
        if (!pm_path_node(p, k)->determined) return 0;
    return off <= PM_PATH_SAME_DIRECTION * size;
}

static void shift(const pm_model *model, const pm_path *path, const pm_place *from, pm_place *x)
{
    for (int i = 0; i < model->nbody; i++) {
        const double *to = path->begin.q + 3 * i;
        double *q = x->q + 3 * i, *pose = x->pose + 5 * i;
        const double rotation = to[2] - from->q[3 * i + 2];
        for (int k = 0; k < 3; k++) q[k] = pose[k] += to[k] - from->q[3 * i + k];
        if (rotation == 0) continue;
        pose[3] = cos(pose[2]);
        pose[4] = sin(pose[2]);
    }
}

void pm_path_cycle_of(const pm_model *model, pm_path *p, double kinetic)
{
    const pm_place *begin = &p->begin, *from = &p->node[0];
    const double more = kinetic - from->kinetic, higher = begin->potential - from->potential;
    for (int k = p->nodes->n; k-- > 0;) { /* the first, from which the others are shifted, is the last */
        pm_place *x = pm_path_node(p, k);
        for (int i = 0; i < p->n; i++) x->y[i] += begin->y[i] - from->y[i];
        shift(model, p, from, x);
        x->kinetic += more;
        x->potential += higher;
    }
    p->u0 = begin->y[p->driver];
}
