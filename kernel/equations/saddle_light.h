/* saddle_light.h - the linear system of saddle.h where some coordinates have next to no inertia.  For saddle.c alone. */
#ifndef PM_SADDLE_LIGHT_H
#define PM_SADDLE_LIGHT_H

#include "state/workspace.h"

/* Factors the system of the evaluated constraints; 0, or one more than the constraint that it does not determine. */
int pm_saddle_light_factor(pm_saddle *s);
/* S l = rhs in place, with force[nq] (or NULL) on the light coordinates, whose response is then in s->light.response. */
void pm_saddle_light_solve(pm_saddle *s, const double *force);
/* How far the constraints are from depending on each other, as pm_saddle_independence says it.  In M^-1 rows that take hold of one
 * light body look alike: by the metric of orthonormal_rows.c. */
double pm_saddle_light_independence(pm_saddle *s);

#endif
