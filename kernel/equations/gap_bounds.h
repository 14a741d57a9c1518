/* gap_bounds.h - contacts that can never close. */
#ifndef PM_GAP_BOUNDS_H
#define PM_GAP_BOUNDS_H

#include "state/workspace.h"

/* What is known of where a body is: its point `hinge` stays at a distance in [low, high] from `at`. */
typedef struct pm_hinge_bounds {
    int known;
    int fixed; /* it does not move at all */
    double at[2], hinge[2], low, high;
} pm_hinge_bounds;

/* The start is assembled.  Contacts whose gap stays positive wherever the joints let their bodies be are taken as not
 * there, for good: nothing watches them. */
void pm_gap_bounds_drop(pm_workspace *w);

#endif
