/* reach.h - contacts that can never close. */
#ifndef PM_REACH_H
#define PM_REACH_H

#include "model.h"

/* What is known of where a body is: its point `hinge` stays at a distance in [low, high] from `at`. */
typedef struct pm_hang {
    int known;
    int fixed; /* it does not move at all */
    double at[2], hinge[2], low, high;
} pm_hang;

/* The start is assembled.  Contacts whose gap stays positive wherever the joints let their bodies be are taken as not
 * there, for good: nothing watches them. */
void pm_reach_drop(pm_workspace *w);

#endif
