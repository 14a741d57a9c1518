/* orthonormal_rows.h - which rows are independent: an orthonormal basis of rows, such as the gradients of constraints in
 * the metric of M^-1. */
#ifndef PM_ORTHONORMAL_ROWS_H
#define PM_ORTHONORMAL_ROWS_H

#include "state/workspace.h"

/* Memory of a basis, of whoever made it. */
typedef struct pm_orthonormal {
    double *row;        /* [rows + 1][wide] the basis, then the row that is looked at */
    int *range;         /* [rows + 1][2] columns between which each is not zero: from, and the first behind */
    int wide;           /* columns */
    double independent; /* part of a row, relative to the row, above which it counts */
} pm_orthonormal;

/* What is left of a row when its components along the first n rows of the basis are taken off. */
typedef struct pm_orthonormal_rest {
    double left; /* relative to the row's own norm, 0..1 */
    double norm; /* of the row */
} pm_orthonormal_rest;

/* Row n is written, zero outside its range: makes it orthonormal to those before it if it does not depend on them; the new
 * number of rows. */
int pm_orthonormal_rows_add(const pm_orthonormal *x, int n, pm_orthonormal_rest *rest);

/* The same of a row of G, or of any row[nq], in the metric of M^-1, in the basis of the system. */
int pm_orthonormal_rows_add_constraint(pm_saddle *s, int n, const pm_constraint *c,
                                       pm_orthonormal_rest *rest);
int pm_orthonormal_rows_add_dense(pm_saddle *s, int n, const double *row, pm_orthonormal_rest *rest);

#endif
