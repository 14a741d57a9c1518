/* table_ends.h - tables of values that forces and drives read beyond their ends. */
#ifndef PM_TABLE_ENDS_H
#define PM_TABLE_ENDS_H

#include "state/workspace.h"

/* The motion goes on from w->state, at which the frame looks (DYNAMIC): it leaves tables at whose ends it is.  PM_TABLE_ENDS,
 * where = table: something that acts there reads a table where it has no value. */
int pm_table_ends_leave(pm_workspace *w);

#endif
