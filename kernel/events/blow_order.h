/* blow_order.h - the last blows of several contacts in the order of their times. */
#ifndef PM_BLOW_ORDER_H
#define PM_BLOW_ORDER_H

#include "events/event.h"

/* This contact, one of the first `near` in event->beside_struck, has just been struck: event->order is that of their blows. */
void pm_blow_order_put(pm_event_set *event, int near, int contact);
/* Whether there are so many; they are put in order as far as that. */
int pm_blow_order_has(pm_event_set *event, int near, int n);

#endif
