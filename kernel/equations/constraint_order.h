/* constraint_order.h - the order of the joints' constraints. */
#ifndef PM_CONSTRAINT_ORDER_H
#define PM_CONSTRAINT_ORDER_H

#include "state/workspace.h"

/* Sets w->joint_order; depends on the structure of the scene alone. */
void pm_constraint_order_find(pm_workspace *w);

#endif
