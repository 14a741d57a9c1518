/* needed.h - what the answers of a run depend on; all else costs nothing (reduce.h). */
#ifndef PM_NEEDED_H
#define PM_NEEDED_H

#include "model.h"

typedef struct pm_needed {
    unsigned char *row[PM_TABLES]; /* not 0: something depends on this row */
    int *island;                   /* [nbody] parent of each body: union-find */
    int everything;                /* some answer depends on all that there is */
    void *block;
} pm_needed;

int pm_needed_find(const pm_model *m, pm_needed *x);
void pm_needed_free(pm_needed *x);

#endif
