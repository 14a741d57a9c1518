/* case_values.h - the value table of a case, and what each of its numbers must keep. */
#ifndef PM_CASE_VALUES_H
#define PM_CASE_VALUES_H

#include "state/workspace.h"

int pm_case_values_create(pm_workspace *w);
/* The values, from param[nparam]. */
int pm_case_values(pm_workspace *w, const double *param);
/* PM_BAD_VALUE where one of them does not keep its bounds. */
int pm_case_values_check(pm_workspace *w);

#endif
