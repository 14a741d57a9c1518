/* recorded.h - the outputs of a run at any time, from the dense output of the kernel. */
#ifndef PM_RECORDED_H
#define PM_RECORDED_H

#include "scene_file.h"

/* A run on a grid of times `every` s: rows (t, outputs), how it ended and when. */
typedef struct pm_recorded {
    int64_t rows, room;
    double *row;
    int32_t *mark;
    double every, end;
    int status;
} pm_recorded;

/* Records the run with rows at multiples of `every`.  Returns PM_OK, or PM_NO_MEMORY; how the run ended is its status. */
int pm_recorded_make(pm_recorded *record, const pm_scene_file *scene, double every);

/* Whether `t` is at a row of the grid, or behind the end of the run. */
int pm_recorded_has(const pm_recorded *record, double t);

/* The outputs at `t`, behind what happened there; those of the end behind it. */
const double *pm_recorded_at(const pm_recorded *record, const pm_scene_file *scene, double t);

void pm_recorded_free(pm_recorded *record);

#endif
