/* nature.h - what kind of function a program is, read off its code once per scene: what the planner may skip follows. */
#ifndef PM_NATURE_H
#define PM_NATURE_H

#include "model.h"

enum pm_nature {
    PM_NATURE_CONSTANT = 0, /* no measure at all */
    PM_NATURE_TIME = 1,     /* linear in the time, and of nothing else */
    PM_NATURE_PLACE = 2,    /* of the configuration alone: positions, angles, gaps, stretches */
    PM_NATURE_MOTION = 3    /* of anything else */
};

/* How a program changes with the kinetic energy T at a fixed place on a path of one degree of freedom: what is known of
 * it at two values of T then holds for all between. */
enum pm_growth {
    PM_GROWTH_NONE = 0,    /* the place alone tells it */
    PM_GROWTH_LINEAR = 1,  /* a + b T: accelerations, reactions, energies */
    PM_GROWTH_ROOT = 2,    /* c sqrt(T): velocities */
    PM_GROWTH_STEADY = 3,  /* monotone in T */
    PM_GROWTH_CONVEX = 4,  /* greatest at the ends of any range of T */
    PM_GROWTH_CONCAVE = 5, /* least at the ends */
    PM_GROWTH_UNKNOWN = 6
};

/* The instructions of a program. */
const int32_t *pm_nature_code(const pm_model *m, int program, int *length);

int pm_nature_of(const pm_model *m, int program);
int pm_nature_growth(const pm_model *m, int program);
/* A program that some measure of time (the time itself, or that of an event) enters. */
int pm_nature_reads_time(const pm_model *m, int program);
/* A program that the count or time of an event enters. */
int pm_nature_reads_counts(const pm_model *m, int program);

/* An integer, or a yes or no: counts of events or comparisons enter, and nothing else but constants. */
int pm_nature_is_discrete(const pm_model *m, int program);

#endif
