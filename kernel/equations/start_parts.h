/* start_parts.h - what start.c calls one after the other, and what its parts share. */
#ifndef PM_START_PARTS_H
#define PM_START_PARTS_H

#include "equations/start.h"

/* ---- start_positions.c ---- */
/* Moves w->state.q from where the bodies are drawn until joints and written positions hold; the frame looks at it. */
int pm_start_assemble(pm_workspace *w, pm_start_report *report);
/* Pitch circles touch, and strands have a way past their circles: no row holds that. */
int pm_start_check_couplings(pm_workspace *w);

/* ---- start_velocities.c ---- */
/* Sets w->state.v.  What is written may break a resting contact: that is no contradiction but a blow, or a parting, at
 * t = 0. */
int pm_start_velocities(pm_workspace *w);

/* ---- row i of the table of what is written ---- */
static inline double pm_start_value(const pm_workspace *w, int i)
{
    return w->numbers.value[PM_START_ROW(w->model, i)[PM_START_VALUE]];
}
static inline int pm_start_measure(const pm_workspace *w, int i)
{
    return PM_START_ROW(w->model, i)[PM_START_MEASURE];
}
static inline int pm_start_level(const pm_workspace *w, int i)
{
    return PM_START_ROW(w->model, i)[PM_START_LEVEL];
}

#endif
