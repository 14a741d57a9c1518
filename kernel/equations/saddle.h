/* saddle.h - the one linear system of the kernel, [M H^T; G 0], on the active rows. */
#ifndef PM_SADDLE_H
#define PM_SADDLE_H

#include "state/workspace.h"

/* Evaluates the active rows at the frame (and the tangents that sliding contacts carry). */
void pm_saddle_rows(pm_workspace *w);
/* Factors S = G M^-1 H^T of the active rows. */
int pm_saddle_factor(pm_workspace *w);
/* How far the active rows, evaluated, are from depending on each other: the least part of a row that those before it do not
 * span, relative to it (its square is known to rounding). */
double pm_saddle_independence(pm_workspace *w);
/* The same of the rows at a state, where the frame then looks. */
double pm_saddle_independence_there(pm_workspace *w, const pm_state *s);
/* w->rhs: S x = rhs in place. */
void pm_saddle_solve(pm_workspace *w);
/* x += M^-1 H^T l (use_h) or M^-1 G^T l, with l = w->rhs. */
void pm_saddle_spread(const pm_workspace *w, int use_h, double *x);
/* Motion: accelerations and reactions at the frame; level DYNAMIC. */
/* The rows are factored: x with M x = force + H^T l (force NULL: none), G x = w->wanted; l is in w->rhs. */
int pm_saddle_respond(pm_workspace *w, const double *force, double *x);
int pm_saddle_accelerate(pm_workspace *w);
/* The same right after pm_projection_apply, which may have evaluated the rows. */
int pm_saddle_accelerate_projected(pm_workspace *w);
/* Product of row i with a vector on q. */
double pm_saddle_times(const pm_frame *frame, const pm_constraint *row, const double *x);

#endif
