/* step.c - looks at places of the last step, by the table of its route. */
#include "events/step.h"

#include "equations/saddle.h"
#include "numerics/chebyshev_nodes.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

double pm_step_node(const pm_step *step, int node)
{
    const pm_chebyshev_nodes *nodes = step->nodes;
    return node == nodes->n - 1 ? step->sampled_end
                                : step->begin + (step->sampled_end - step->begin) * nodes->at[node];
}

int pm_step_look(pm_workspace *w, double x, int level)
{
    const pm_state *s = &w->state;
    int status = PM_OK;
    if (w->phase.route->look) return w->phase.route->look(w, x, level);
    if (x != w->step.whole_end) {
        status = w->phase.route->at(w, x, &w->probe);
        s = &w->probe;
    }
    if (status) return status;
    pm_frame_look(&w->frame, s->t, s->q, s->v, s->z, w->state.memory);
    return level == PM_LEVEL_DYNAMIC ? pm_step_react(w) : PM_OK;
}

int pm_step_look_exactly(pm_workspace *w, double x, int level)
{
    const pm_state *s = &w->probe;
    const int status = w->phase.route->exact(w, x, &w->probe);
    if (status) return status;
    pm_frame_look(&w->frame, s->t, s->q, s->v, s->z, w->state.memory);
    return level == PM_LEVEL_DYNAMIC ? pm_saddle_accelerate(w) : PM_OK;
}

int pm_step_react(pm_workspace *w)
{
    return w->phase.route->react ? w->phase.route->react(w) : pm_saddle_accelerate(w);
}
