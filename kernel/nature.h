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

int pm_nature_of(const pm_model *m, int program);
/* A program that some measure of time (the time itself, or that of an event) enters. */
int pm_nature_reads_time(const pm_model *m, int program);
/* A program that the count or time of an event enters. */
int pm_nature_reads_counts(const pm_model *m, int program);

/* An integer, or a yes or no: only counts of events, constants and comparisons enter. */
int pm_nature_is_discrete(const pm_model *m, int program);

#endif
