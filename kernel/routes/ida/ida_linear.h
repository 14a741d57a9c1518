/* ida_linear.h - the linear systems of Newton's iteration by elimination. */
#ifndef PM_IDA_LINEAR_H
#define PM_IDA_LINEAR_H

#include "routes/ida/ida.h"

/* Inverts the blocks of w->ida->jacobian; PM_SINGULAR if the rows depend on each other, PM_SOLVER if the
 * rest has no pivot. */
int pm_ida_linear_factor(pm_workspace *w);
/* J x = b for all unknowns of the phase; x may be b. */
void pm_ida_linear_solve(pm_workspace *w, const double *b, double *x);

/* pm_projection_apply by the rows of the last matrix, if it is of this phase and what they are missed by is slight. */
int pm_ida_linear_project(pm_workspace *w, pm_state *s);

/* The same as objects of SUNDIALS; NULL: out of memory.  The workspace must outlive them. */
SUNMatrix pm_ida_linear_matrix(SUNContext context);
SUNLinearSolver pm_ida_linear_solver(pm_workspace *w, SUNContext context);
void pm_ida_linear_free(SUNMatrix matrix, SUNLinearSolver solver);
/* Jacobian function for IDA: evaluates the blocks. */
int pm_ida_linear_jacobian(double t, double cj, N_Vector y, N_Vector yp, N_Vector r, SUNMatrix matrix,
                           void *workspace, N_Vector a, N_Vector b, N_Vector c);

#endif
