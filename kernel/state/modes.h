/* modes.h - small motion about the state that the frame looks at: its natural frequencies and damping. */
#ifndef PM_MODES_H
#define PM_MODES_H

#include "state/workspace.h"

/* Eigenvalues x of the linearised equations of motion, in the order of their sizes: a mode is a pair of complex ones, or one
 * that is real. */
typedef struct pm_modes {
    double *omega;   /* [2 nq] rad/s, natural circular frequency |x| */
    double *damping; /* [2 nq] -Re x / |x|: 0 without damping, 1 where nothing swings, < 0 where it grows */
    int n;
    double growth; /* 1/s, the greatest real part: > 0 where the state is unstable */
    /* the state of which this is known */
    int known;
    double t, *q, *v; /* [nq] */
    int64_t contacts; /* pm_active_set.version */
    /* Works it out at the frame and leaves the frame as it was; nothing is known where it fails (tree/small_motion.h). */
    void (*find)(pm_workspace *w);
    struct pm_small_motion *motion;     /* of `find` */
    struct pm_equilibrium *equilibrium; /* where the scene starts in one (routes/start/equilibrium.h) */
} pm_modes;

#endif
