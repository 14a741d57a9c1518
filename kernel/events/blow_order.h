/* blow_order.h - the last blows of several contacts in the order of their times. */
#ifndef PM_BLOW_ORDER_H
#define PM_BLOW_ORDER_H

#include "events/event.h"

/* This contact, one of the first `near` in event->beside_struck, has just been struck: event->order is that of their blows. */
void pm_blow_order_put(pm_event_set *event, int near, int contact);
/* Whether there are so many; they are put in order as far as that. */
int pm_blow_order_has(pm_event_set *event, int near, int n);

/* Some of them, without the latest. */
typedef struct pm_blows {
    int n;
    const int *contact;
    const double *time;
} pm_blows;

static inline double pm_blows_flight(const pm_blows *x, int i) { return x->time[i] - x->time[i + 1]; }

/* The last n blows were of the same contacts as those k before them. */
int pm_blows_come_again(const pm_blows *x, int k, int n);
/* The last of the flights that are looked at: the one before a cycle of k blows, which tells whether the ratio has settled. */
int pm_blows_last_looked_at(const pm_blows *x, int k);

#endif
