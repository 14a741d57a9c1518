/* piecewise.h - tables of measured values as piecewise polynomials (PM_TABLE_PIECEWISE): value and derivatives, the piece in
 * which an argument lies, and bounds over a stretch of arguments. */
#ifndef PM_PIECEWISE_H
#define PM_PIECEWISE_H

#include "numerics/interval.h"
#include "state/model.h"

typedef struct pm_piecewise {
    const double *knot;        /* [pieces + 1] */
    const double *coefficient; /* [pieces][degree + 1], that of u^0 first */
    int pieces, degree, beyond;
} pm_piecewise;

pm_piecewise pm_piecewise_of(const pm_model *m, int row);

/* Number of the piece in which x lies, a knot belonging to the piece above it; not a number if x is none. */
double pm_piecewise_number(const pm_piecewise *p, double x);
/* The same of an argument that moves `way` from there: what is no farther than `nothing` from a knot is on it, and belongs to
 * the piece to which it moves, or stays in the piece `present` if it does not move. */
double pm_piecewise_number_ahead(const pm_piecewise *p, double x, double way, double nothing, double present);
/* Where piece n begins: the knot, or -+PM_BEYOND_KNOTS where none is below, or above. */
double pm_piecewise_begin(const pm_piecewise *p, double n);
/* Piece n at x, and beyond its ends; derivative[3]: its derivatives by x, or NULL. */
double pm_piecewise_piece(const pm_piecewise *p, double n, double x, double *derivative);
double pm_piecewise_value(const pm_piecewise *p, double x);
/* x lies where the table has no value. */
int pm_piecewise_is_outside(const pm_piecewise *p, double x);

/* Bounds of the value (k = 0) and of derivative k = 1, 2 over [x.lo, x.hi]: of piece n alone, or of all that lie there. */
pm_interval pm_piecewise_bounds_of(const pm_piecewise *p, double n, int k, pm_interval x);
pm_interval pm_piecewise_bounds(const pm_piecewise *p, int k, pm_interval x);

/* The operations that read a table, by operands a[0], a[1]. */
double pm_piecewise_operation(const pm_model *m, int op, int row, const double *a);
/* The rows of the table: PM_OK, or PM_BAD_TABLE for constants that are not there, knots that do not increase. */
int pm_piecewise_check(const pm_model *m, pm_where *where);

#endif
