/* dependence.h - whether a constraint that depends on the active ones does so for good, or here only (a dead centre).
 *
 * For good: it also does so at a neighbouring configuration on the constraints; or the active ones hold fast both of its
 * bodies, and all that these are joined to. */
#ifndef PM_DEPENDENCE_H
#define PM_DEPENDENCE_H

#include "state/workspace.h"

/* PM_DEPENDENCE_UNKNOWN: no neighbour could be reached. */
enum pm_dependence { PM_DEPENDENCE_UNKNOWN = -1, PM_DEPENDENCE_NONE = 0, PM_DEPENDENCE_FOR_GOOD = 1 };

/* *depends (enum pm_dependence): whether a constraint that depends on the active ones at the frame does so for good.  The frame
 * looks at w->state, and the basis is that of the active ones, afterwards. */
int pm_dependence_nearby(pm_workspace *w, const pm_constraint *c, int *depends);
/* The same of one that is not among the active ones and may not depend on them here. */
int pm_dependence_on_all(pm_workspace *w, const pm_constraint *c, int *depends);

#endif
