/* program_class.h - what kind of function a program is, read off its code once per scene; it says what the planner may skip. */
#ifndef PM_PROGRAM_CLASS_H
#define PM_PROGRAM_CLASS_H

#include "state/model.h"

enum pm_program_class {
    PM_CLASS_CONSTANT = 0, /* no measure at all */
    PM_CLASS_TIME = 1,     /* linear in the time, and of nothing else */
    PM_CLASS_PLACE = 2,    /* of the configuration alone: positions, angles, gaps, stretches */
    PM_CLASS_MOTION = 3    /* of anything else */
};

/* How a program changes with the kinetic energy T at a fixed place on a path of one degree of freedom: what is known of
 * it at two values of T then holds for all between. */
enum pm_program_energy {
    PM_ENERGY_CLASS_NONE = 0,    /* the place alone tells it */
    PM_ENERGY_CLASS_LINEAR = 1,  /* a + b T: accelerations, reactions, energies */
    PM_ENERGY_CLASS_ROOT = 2,    /* c sqrt(T): velocities */
    PM_ENERGY_CLASS_STEADY = 3,  /* monotone in T */
    PM_ENERGY_CLASS_CONVEX = 4,  /* greatest at the ends of any range of T */
    PM_ENERGY_CLASS_CONCAVE = 5, /* least at the ends */
    PM_ENERGY_CLASS_UNKNOWN = 6
};

/* Its degree as a polynomial in the time while accelerations are constant: 0, 1, 2, or none of these. */
enum pm_program_degree { PM_DEGREE_MOST = 2, PM_DEGREE_OTHER = 3 };

/* A program that some measure of time (the time itself, or that of an event) enters. */
int pm_program_class_reads_time(const pm_model *m, int program);
/* One that reads no measure but the time itself. */
int pm_program_class_reads_time_alone(const pm_model *m, int program);
/* A program that the count or time of an event enters. */
int pm_program_class_reads_counts(const pm_model *m, int program);

/* An integer, or a yes or no: counts of events or comparisons enter, and nothing else but constants. */
int pm_program_class_is_discrete(const pm_model *m, int program);

#endif
