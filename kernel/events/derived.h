/* derived.h - asks at the end of a run that read the answers of others: "t3 - t1". */
#ifndef PM_DERIVED_H
#define PM_DERIVED_H

#include "state/workspace.h"

/* 1 if the program reads answers; it is run when these are there. */
int pm_derived_is(const pm_model *model, int program);
/* Why it has no value: the reason of the first answer that it reads and that is not there; PM_REASON_NONE. */
int pm_derived_reason(const pm_workspace *w, int program);
/* What the errors of these answers, as far as the route knows them, make of its own; NaN if it knows
 * one of them not, or if the program reads measures as well. */
double pm_derived_error(pm_workspace *w, int program, double value);
/* The sum of what each of these answers makes of it: size[ask] is how large its terms are. */
double pm_derived_terms(pm_workspace *w, int program, const double *size);

#endif
