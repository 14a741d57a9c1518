/* start_positions.h - positions of a start: where the bodies are drawn, moved until joints and written positions hold. */
#ifndef PM_START_POSITIONS_H
#define PM_START_POSITIONS_H

#include "state/workspace.h"

typedef struct pm_start_report {
    double moved;    /* greatest displacement by the assembly, m */
    double opening;  /* greatest residual after it, m */
    double settled;  /* greatest displacement from there to an equilibrium, m */
    int equilibrium; /* enum pm_equilibrium_kind */
} pm_start_report;

/* Moves w->state.q from where the bodies are drawn by the least that meets joints and written positions; the frame looks at
 * it.  PM_ASSEMBLY where that is not possible: the joint or written position that is open most is named. */
int pm_start_assemble(pm_workspace *w, pm_start_report *report);
/* Pitch circles touch, and strands have a way past their circles: no constraint holds that.  PM_ASSEMBLY. */
int pm_start_check_couplings(pm_workspace *w);

/* ---- record i of the table of what is written ---- */
static inline double pm_start_value(const pm_model *model, const pm_numbers *numbers, int i)
{
    return numbers->value[PM_START_ROW(model, i)[PM_START_VALUE]];
}
static inline int pm_start_measure(const pm_model *model, int i)
{
    return PM_START_ROW(model, i)[PM_START_MEASURE];
}
static inline int pm_start_level(const pm_model *model, int i)
{
    return PM_START_ROW(model, i)[PM_START_LEVEL];
}

#endif
