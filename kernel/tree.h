/* tree.h - explicit coordinates of a phase: bodies placed one after the other, outward from the ground.
 *
 * Many active rows can be solved body by body: a pin leaves its body an angle, a weld nothing, a slider that keeps the
 * direction a length, rolling an angle.  What closes a loop stays as a loop row. */
#ifndef PM_TREE_H
#define PM_TREE_H

#include "model.h"

typedef struct pm_tree_node pm_tree_node;

typedef struct pm_tree {
    int n;                 /* coordinates */
    int nloop;             /* active rows that are not solved */
    int *loop;             /* [nrow] their places in w->row */
    int *kind;             /* [nq] of each coordinate: 0, 1 a length (x, y or along a line), 2 an angle */
    pm_tree_node *node;    /* [nbody] in the order of placing */
    unsigned char *used;   /* [nrow] */
    int *placed;           /* [nbody] */
    double *unit, *column; /* [nq] */
    double *jacobian, *residual; /* [nq][nq], [nq]: of the loop rows */
    int *pivot;
    void *block;
} pm_tree;

int pm_tree_create(pm_workspace *w);
void pm_tree_free(pm_workspace *w);
/* From the active rows; called when a phase begins. */
void pm_tree_build(pm_workspace *w);
int pm_tree_is_angle(const pm_workspace *w, int coordinate);

/* Coordinates y[n] of a configuration q[nq] that meets the solved rows (the frame looks at it); and back. */
void pm_tree_read(const pm_workspace *w, double *y);
void pm_tree_place(const pm_workspace *w, const pm_memory *memory, const double *y, double *q);
/* At the frame's pose: velocities v[nq] from rates ydot[n]. */
void pm_tree_spread(const pm_workspace *w, const double *ydot, double *v);
/* At the frame's pose and velocities: accelerations at yddot = 0. */
void pm_tree_bias(const pm_workspace *w, double *a);
/* Columns of v by unit rates: basis[nq][n]. */
void pm_tree_basis(pm_workspace *w, double *basis);
/* The loop rows' Jacobian on the coordinates, [nloop][n], at the frame; the rows are evaluated. */
void pm_tree_loops(pm_workspace *w, const double *basis, double *jacobian);
/* Meets the loop rows by Newton's method with coordinate `held` kept; n = nloop + 1.  Leaves q, the poses of the frame,
 * and the basis and Jacobian of the loop rows there.  PM_SINGULAR or PM_ASSEMBLY if it does not converge. */
int pm_tree_close(pm_workspace *w, double *y, int held, double *q, double *basis, double *jacobian);

#endif
