/* free_motion.h - the equations of motion next to a state in as many coordinates as the scene has freedoms there. */
#ifndef PM_FREE_MOTION_H
#define PM_FREE_MOTION_H

#include "tree/tree.h"

typedef struct pm_free_motion {
    pm_tree *tree; /* its own: that of a phase goes on */
    int n, nloop, nfree;
    double *y0, *rate0;              /* [nq] at the state */
    double *y, *rate, *acceleration; /* [nq] */
    double *basis;                   /* [n][n] columns R, then N */
    double *triangle, *tau;          /* [nq][nconstraint], [nconstraint] of the factorisation that gives it */
    double *entry;                   /* [nconstraint][nq] */
    int *low, *high;                 /* [nconstraint] */
    double *on_rows;                 /* [nconstraint][nconstraint] J D R */
    int *pivot;                      /* [nconstraint] */
    double *off;                     /* [nconstraint] */
    double *shift, *response, *change; /* [2 nq] s and s'; [nq] F; [nq] */
} pm_free_motion;

int pm_free_motion_create(pm_workspace *w, pm_free_motion *x);
/* Its tree, made from the active constraints, and its coordinates at w->state; the tree of the phase is what it returns, to be
 * put back into w->tree at the end. */
pm_tree *pm_free_motion_begin(pm_workspace *w, pm_free_motion *x);
/* x->response is F at x->shift; 1 where there is none. */
int pm_free_motion_respond(pm_workspace *w, pm_free_motion *x);
/* x->change is the derivative of F by one of s and s', by differences of length h; likewise. */
int pm_free_motion_differ(pm_workspace *w, pm_free_motion *x, int by, double h);
/* w->state.q goes along s, and meets the constraints there. */
int pm_free_motion_move(pm_workspace *w, pm_free_motion *x, const double *s);

#endif
