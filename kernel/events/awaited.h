/* awaited.h - whether something waits for a further firing of an event. */
#ifndef PM_AWAITED_H
#define PM_AWAITED_H

#include "state/workspace.h"

/* 1 if one of the next `more` firings of the event is asked for by its number, or may end the run. */
int pm_awaited_nth(const pm_model *model, const pm_firing *firing, int event, int64_t more);
/* The same, or each of them is asked for. */
int pm_awaited(const pm_model *model, const pm_firing *firing, int event, int64_t more);

#endif
