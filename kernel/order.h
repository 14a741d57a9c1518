/* order.h - the order of the joints' rows. */
#ifndef PM_ORDER_H
#define PM_ORDER_H

#include "model.h"

/* Sets w->joint_order; depends on the structure of the scene alone. */
void pm_order_find(pm_workspace *w);

#endif
