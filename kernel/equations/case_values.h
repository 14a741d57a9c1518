/* case_values.h - the value table of a case, and what each of its numbers must keep. */
#ifndef PM_CASE_VALUES_H
#define PM_CASE_VALUES_H

#include "state/workspace.h"

int pm_case_values_create(pm_workspace *w);
/* The values, from param[nparam]. */
int pm_case_values(pm_workspace *w, const double *param);
/* What stays the same of programs in the case: its masses and its weight are known.  From here on all programs of the workspace are
 * run by these numbers, until pm_case_values is told of other parameters. */
void pm_case_values_fold(pm_workspace *w);
/* PM_BAD_VALUE where one of them does not keep its bounds. */
int pm_case_values_check(pm_workspace *w);

#endif
