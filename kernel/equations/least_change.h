/* least_change.h - the least solution of linear equations that are taken one after the other.
 *
 * Each step of an assembly, and the velocities of a start, are the least change (in the metric of M) that meets
 * constraints of joints, of contacts and of what is written.  Earlier equations decide where later ones disagree.  A row
 * is taken into an orthonormal basis, with which n rows cost n^3; many constraints of joints that clearly do not depend
 * on each other are solved as one block instead, with S = G M^-1 G^T (saddle.h): x = M^-1 G^T S^-1 r, and of each further
 * row d the part across them counts, d - G^T S^-1 G M^-1 d. */
#ifndef PM_LEAST_CHANGE_H
#define PM_LEAST_CHANGE_H

#include "equations/orthonormal_rows.h"
#include "state/workspace.h"

/* The least change x (in the metric of M) that the basis spans with the given components y: x = M^-1/2 B^T y.  A new row
 * with right-hand side r: its component is (r - row.x) / (left * norm). */
typedef struct pm_least_change {
    int n;          /* rows in the basis */
    double *x;      /* [nq] */
    int block;      /* constraints solved as one block: the active ones */
    double *across; /* [nq] part of a row across them */
} pm_least_change;

/* Solves for the constraints of joints, at the level of positions (but those that are anchored later) or velocities, if
 * they are many and clearly independent; whether they are.  They are the active ones then. */
int pm_least_change_block(pm_workspace *w, pm_least_change *s, int level);
/* Takes one equation row.x = rhs, row [nq]; *miss is by how much it is violated if it depends on the others.  1 if it does
 * not. */
int pm_least_change_take(const pm_active_set *active, pm_saddle *saddle, pm_least_change *s,
                         const double *row, double rhs, double *miss);
/* The same of an evaluated constraint; dense [nq] is scratch. */
int pm_least_change_take_constraint(pm_workspace *w, pm_least_change *s, const pm_constraint *c, double rhs,
                                    double *dense, double *miss);
/* Adds a row to the basis if it depends neither on that nor on the block; the new size. */
int pm_least_change_add(const pm_active_set *active, pm_saddle *saddle, const pm_least_change *s,
                        const double *row, pm_orthonormal_rest *rest);

#endif
