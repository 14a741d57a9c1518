/* basis.h - which rows are independent: an orthonormal basis of rows in the metric of M^-1. */
#ifndef PM_BASIS_H
#define PM_BASIS_H

#include "model.h"

#define PM_INDEPENDENT 1e-9 /* independent part of a row, relative to the row, above which it counts */

/* What is left of a row when its components along the first n rows of the basis are taken off. */
typedef struct pm_basis_rest {
    double left; /* relative to the row's own norm, 0..1 */
    double norm; /* of the row */
} pm_basis_rest;

/* Adds a row to the first n rows of w->basis if it does not depend on them; returns the new n. */
int pm_basis_add(pm_workspace *w, int n, const double j[6], const int body[2], pm_basis_rest *rest);
int pm_basis_add_dense(pm_workspace *w, int n, const double *row, pm_basis_rest *rest);

#endif
