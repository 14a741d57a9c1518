/* fastest_growth.h - how a steady motion is left: the small deviation from it that grows fastest. */
#ifndef PM_FASTEST_GROWTH_H
#define PM_FASTEST_GROWTH_H

#include "state/workspace.h"

typedef struct pm_fastest_growth {
    unsigned char *free; /* [nq] the coordinates that may deviate */
    double *push;        /* [nq] velocities of a small blow: the deviation is what they excite */
    /* what is found */
    double *q, *v; /* [nq] the deviation; its greatest part is 1 of the scene's size or time */
    double spin;   /* of the axes in which the motion is steady, rad/s */
    double rate;   /* at which the deviation grows, 1/s; 0: none does */
    /* scratch */
    int n;                          /* free coordinates */
    int *at;                        /* [nq] which they are */
    double *dq, *dv, *da;           /* [nq] */
    double *x, *y;                  /* [2 nq] */
    double *matrix, *power, *spare; /* [2 nq][2 nq] */
} pm_fastest_growth;

int pm_fastest_growth_create(pm_arena *arena, const pm_model *m, pm_fastest_growth *e);

/* The motion of the free coordinates from w->state is steady, seen in axes that rotate at some body's spin, or do not; 0 if
 * it is not.  *status: of the systems that were solved. */
int pm_fastest_growth_is_steady(pm_workspace *w, pm_fastest_growth *e, int *status);
/* After it: the deviation, where e->rate > 0. */
int pm_fastest_growth_find(pm_workspace *w, pm_fastest_growth *e);

#endif
