/* disturb.c - rounding errors made visible: a coarse run is disturbed by a multiple of them, which the scene amplifies as it
 * amplifies rounding itself (study/accuracy.c). */
#include "run/run.h"

#include "equations/projection.h"
#include "equations/saddle.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"
#include "state/route.h"
#include "state/workspace.h"

int pm_disturb(pm_workspace *w)
{
    if (!pm_evidence_is_coarse(&w->evidence)) return PM_OK;
    if (w->result.count[PM_COUNT_PHASES] > 0 && !w->phase.route->in_time)
        return PM_OK; /* segments of a path repeat */
    for (int i = 0; i < w->model->nq; i++) {
        w->state.q[i] *= 1 + PM_DISTURBED_PLACE * pm_evidence_noise(&w->evidence, i);
        w->state.v[i] *= 1 + PM_DISTURBED_SPEED * pm_evidence_noise(&w->evidence, i);
    }
    const int status = pm_projection_apply(w, &w->state);
    if (status) return status;
    pm_frame_look_state(&w->frame, &w->state);
    return pm_saddle_accelerate(w);
}
