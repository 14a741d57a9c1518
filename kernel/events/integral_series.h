/* integral_series.h - integrals over the flights of a series that are not followed. */
#ifndef PM_INTEGRAL_SERIES_H
#define PM_INTEGRAL_SERIES_H

#include "state/workspace.h"

#define PM_INTEGRAL_FLIGHTS 3 /* of a series that tell those to come */

/* Where a flight between two blows began: what an ask had gathered by then (integral.h). */
typedef struct pm_integral_at {
    double t, sum, weight;
} pm_integral_at;

/* Of a contact and an integral: where the last flights began, the latest first. */
typedef struct pm_integral_flights {
    int n;         /* that are known */
    int64_t jumps; /* PM_COUNT_JUMPS before the latest */
    pm_integral_at at[PM_INTEGRAL_FLIGHTS + 1];
} pm_integral_flights;

/* What the rest of a series adds, and what is not known of it. */
typedef struct pm_integral_tail {
    double value, error;
} pm_integral_tail;

/* PM_NO_MEMORY. */
int pm_integral_series_create(pm_workspace *w);
/* Nothing is known of the flights of a contact any more. */
void pm_integral_series_forget(const pm_workspace *w, int contact);
/* The contact is struck now: a flight begins. */
void pm_integral_series_mark(const pm_workspace *w, int contact);
/* What the flights add that come now, each `ratio` times as long as the one before, all of them in `time`; of the sum, or of its weight.
 * At their end the value is `limit`. */
pm_integral_tail pm_integral_series_tail(const pm_integral_flights *flights, int weight, double ratio,
                                         double time, double limit);

/* The same of an ask, and of its weight, where the flights of a contact begin now; the frame looks at their end.  It is noted for
 * pm_integral_series_leap; 0 if the last flights do not tell it. */
int pm_integral_series_is_clear(pm_workspace *w, int contact, int ask, double ratio, double time);
/* The series is passed. */
void pm_integral_series_leap(pm_workspace *w, double time);

/* Series of contacts that were closed before are over now: what their flights would have added takes the place of what was added
 * since, as far as it is known. */
void pm_integral_series_end(const pm_workspace *w);
/* The run ends before some are. */
void pm_integral_series_break(const pm_workspace *w);

#endif
