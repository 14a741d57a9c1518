/* build.h - flat tables become a model: they are checked, and what follows from them alone is computed. */
#ifndef PM_BUILD_H
#define PM_BUILD_H

#include "state/model.h"

/* A model of the caller's tables, which it points into: they must outlive it.  PM_BAD_TABLE with *where, or PM_NO_MEMORY; then
 * there is no model. */
int pm_model_create(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant,
                    int64_t nparam, pm_model **model, pm_where *where);
void pm_model_free(pm_model *model);
/* check.c: where the tables are and how long (the directory), then what stands in them, references first. */
int pm_check_directory(pm_model *m, int64_t ntable, const int32_t *table, pm_where *where);
int pm_check_tables(pm_model *m, pm_where *where);
/* check_reads.c: what programs read, of tables that have been checked. */
int pm_check_reads(const pm_model *m, pm_where *where);
/* Something has a prescribed motion. */
int pm_model_is_driven(const pm_model *model);

#endif
