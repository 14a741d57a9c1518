/* disturb.c - rounding errors made visible: a coarse run is disturbed by a multiple of them, which the scene amplifies as it
 * amplifies rounding itself (study/accuracy.c). */
#include "run/run.h"

#include "equations/projection.h"
#include "equations/saddle.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"
#include "state/route.h"
#include "state/workspace.h"

static int sign(pm_evidence *e)
{
    e->noise = e->noise * 6364136223846793005ULL + 1442695040888963407ULL;
    return e->noise >> 63 ? 1 : -1;
}

int pm_disturb(pm_workspace *w)
{
    if (!w->evidence.active || !w->evidence.present->coarse) return PM_OK;
    if (w->result.count[PM_COUNT_PHASES] > 0 && !w->phase.route->in_time)
        return PM_OK; /* segments of a path repeat */
    for (int i = 0; i < w->model->nq; i++) {
        w->state.q[i] *= 1 + PM_DISTURBED_PLACE * sign(&w->evidence);
        w->state.v[i] *= 1 + PM_DISTURBED_SPEED * sign(&w->evidence);
    }
    const int status = pm_projection_apply(w, &w->state);
    if (status) return status;
    pm_frame_look_state(&w->frame, &w->state);
    return pm_saddle_accelerate(w);
}
