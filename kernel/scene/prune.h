/* prune.h - models without what no answer needs. */
#ifndef PM_PRUNE_H
#define PM_PRUNE_H

#include "state/model.h"

/* As pm_model_create, with only those rows of the tables that dependency.h names: the bits of a case are those of the scene
 * written without the others. */
int pm_prune_create(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant,
                    int64_t nparam, pm_model **model, pm_where *where);
/* The caller's row of a row of the model. */
int pm_prune_original(const pm_model *m, int table, int row);

#endif
