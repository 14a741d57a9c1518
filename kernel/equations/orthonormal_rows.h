/* orthonormal_rows.h - which rows are independent: an orthonormal basis of rows in the metric of M^-1. */
#ifndef PM_ORTHONORMAL_ROWS_H
#define PM_ORTHONORMAL_ROWS_H

#include "state/workspace.h"

#define PM_INDEPENDENT 1e-9 /* independent part of a row, relative to the row, above which it counts */

/* What is left of a row when its components along the first n rows of the basis are taken off. */
typedef struct pm_orthonormal_rest {
    double left; /* relative to the row's own norm, 0..1 */
    double norm; /* of the row */
} pm_orthonormal_rest;

/* Adds a row to the first n rows of w->basis if it does not depend on them; returns the new n. */
int pm_orthonormal_rows_add(pm_workspace *w, int n, const double j[6], const int body[2],
                            pm_orthonormal_rest *rest);
int pm_orthonormal_rows_add_dense(pm_workspace *w, int n, const double *row, pm_orthonormal_rest *rest);

#endif
