/* energy_level.h - motion without losses keeps its energy. */
#ifndef PM_ENERGY_LEVEL_H
#define PM_ENERGY_LEVEL_H

#include "state/workspace.h"

/* The energy level of a phase. */
typedef struct pm_energy_level_level {
    int kept;        /* nothing in the phase does work that is not a potential's */
    double energy;   /* at its begin */
    double kinetic;  /* the greatest seen in it */
    double returned; /* by all corrections of the case, signs and all: what would have drifted off */
} pm_energy_level_level;

/* A phase begins where the frame looks; `returned` goes on within a case. */
void pm_energy_level_begin(pm_workspace *w, pm_energy_level_level *level);
/* By what velocities at the frame must be multiplied to have the energy of the level; 1 where they say too little of it.
 * *gained: the energy that comes with it. */
double pm_energy_level_factor(pm_workspace *w, const pm_energy_level_level *level, double *gained);
/* Takes note of a step's correction, as evidence against the integration: w->evidence. */
void pm_energy_level_note(const pm_frame *frame, pm_ledger *ledger, pm_energy_level_level *level,
                          double gained);

#endif
