/* measure.h - what can be read off a state: the table of measure kinds. */
#ifndef PM_MEASURE_H
#define PM_MEASURE_H

#include "state/workspace.h"

/* Value of measure i at the frame, which must be filled to pm_measure_level.  Not a number where it has none. */
double pm_measure(pm_workspace *w, int i);
/* The same; where it is the size of something, that with its sign (what programs read: pm_workspace.read_measure). */
double pm_measure_signed(pm_workspace *w, int i);
/* The table that `a` of a kind points into; -1: none. */
int pm_measure_of(int kind);
int pm_measure_level(const pm_model *m, int i);
int pm_measure_validate(const pm_model *m, pm_where *where);
/* 1 if measure i may be written in the start table at this level (its value is linear in v, or its rate is). */
int pm_measure_can_start(const pm_model *m, int i, int level);
/* Row of a start value on v: coefficient[nq] of d(measure)/dt (POSITION) or of the measure itself (VELOCITY). */
void pm_measure_start_row(pm_workspace *w, int i, int level, double *coefficient);

#endif
