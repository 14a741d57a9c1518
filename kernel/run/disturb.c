/* disturb.c - rounding errors made visible: a coarse run is disturbed by a multiple of them, which the scene amplifies as it
 * amplifies rounding itself (study/accuracy.c). */
#include "run/run.h"

#include "equations/projection.h"
#include "equations/saddle.h"
#include "state/evidence.h"
#include "state/route.h"
#include "state/workspace.h"

#define DISTURBANCE 3e-14  /* of velocities: PM_COARSER times some roundings */
#define DISPLACEMENT 2e-15 /* of positions: a contact that has just been left must not seem overlapped */

/* 1 or -1, at random: the same in every companion. */
static int sign(pm_evidence *e)
{
    e->noise = e->noise * 6364136223846793005ULL + 1442695040888963407ULL;
    return e->noise >> 63 ? 1 : -1;
}

int pm_disturb(pm_workspace *w)
{
    if (!w->evidence.active || !w->evidence.present->companion) return PM_OK;
    if (w->result.count[PM_COUNT_PHASES] > 0 && !w->phase.route->in_time)
        return PM_OK; /* legs of a path repeat */
    for (int i = 0; i < w->model->nq; i++) {
        w->state.q[i] *= 1 + DISPLACEMENT * sign(&w->evidence);
        w->state.v[i] *= 1 + DISTURBANCE * sign(&w->evidence);
    }
    const int status = pm_projection_apply(w, &w->state);
    if (status) return status;
    pm_frame_look_state(&w->frame, &w->state);
    return pm_saddle_accelerate(w);
}
