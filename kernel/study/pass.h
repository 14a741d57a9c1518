/* pass.h - one pass of a case. */
#ifndef PM_PASS_H
#define PM_PASS_H

#include "state/evidence.h"
#include "state/workspace.h"

/* Runs the case into p: factor of the tolerance that the accuracy gives; a coarse one is to be compared with the main pass. */
void pm_pass_make(pm_workspace *w, const double *param, pm_pass *p, double factor, int coarse);
/* Its answers hold, as far as it came. */
int pm_pass_stands(const pm_pass *p);
/* Some phase of it, or all, ran on rk. */
int pm_pass_steps_on_rk(const pm_pass *p);
/* It took more steps than a pass is waited for, not more than the scene allows. */
int pm_pass_took_too_long(const pm_evidence *evidence, const pm_pass *p);

#endif
