/* projection.h - removes drift: q and v back onto the active constraints, by the least change in the metric of M. */
#ifndef PM_PROJECTION_H
#define PM_PROJECTION_H

#include "numerics/tolerances.h"
#include "state/workspace.h"

/* Newton's sweeps back onto constraints end: they are met, or rounding keeps sweeps from gaining.  Residuals now and before, m. */
static inline int pm_projection_ends(const pm_numbers *numbers, int sweep, double worst, double before)
{
    return worst <= PM_MET * numbers->size || sweep == PM_PROJECTION_SWEEPS ||
           (sweep > 1 && worst > PM_GAIN * before);
}

/* The same where a first sweep always pays: it takes off nearly all, and what is left of a drive a later blow may make much of. */
static inline int pm_projection_ends_exactly(const pm_numbers *numbers, int sweep, double worst,
                                             double before)
{
    if (sweep == 0 && worst > PM_MET_AT_ONCE * numbers->size) return 0;
    return pm_projection_ends(numbers, sweep, worst, before);
}

/* Projects the state; on return the frame looks at it (KINEMATIC, constraints evaluated). */
int pm_projection_apply(pm_workspace *w, pm_state *s);
/* The same where the state is near.  One that is far off is left there: its constraints have come to where they end, such as a
 * strand at its tangent point, and the nearest place that meets them is none of the motion. */
int pm_projection_near(pm_workspace *w, pm_state *s);
/* The same where the active constraints have just been built at this state, and the frame looks at it. */
int pm_projection_built(pm_workspace *w, pm_state *s);
/* Velocities only: G v = 0 at the state's position. */
int pm_projection_velocity(pm_workspace *w, pm_state *s);
/* Residuals of the active constraints at the frame relative to size and speed: the greater one. */
double pm_projection_residual(const pm_frame *frame, const pm_active_set *active);

#endif
