/* dependency.h - what the answers of a run depend on; all else costs nothing (prune.h). */
#ifndef PM_DEPENDENCY_H
#define PM_DEPENDENCY_H

#include "state/model.h"

typedef struct pm_dependency {
    unsigned char *row[PM_TABLES]; /* not 0: something depends on this row */
    int *island;                   /* [nbody] parent of each body: union-find */
    int everything;                /* some answer depends on all that there is */
    void *block;
} pm_dependency;

int pm_dependency_find(const pm_model *m, pm_dependency *x);
void pm_dependency_free(pm_dependency *x);

#endif
