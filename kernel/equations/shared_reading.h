/* shared_reading.h - what may be read of reactions and impulses that are not unique (shared_loads.h): what is the same for
 * all distributions of the loads; or, where the scene asks for it (solve.shared = "least"), what the least distribution gives. */
#ifndef PM_SHARED_READING_H
#define PM_SHARED_READING_H

#include "state/workspace.h"

/* The scene leaves shared reactions without a number, and some are. */
int pm_shared_matters(const pm_workspace *w);
/* Whether the value of a program at the frame, which is DYNAMIC where it reads reactions, is the same for all distributions. */
int pm_shared_is_unique(pm_workspace *w, int program);
/* pm_workspace.read_measure of scenes that ask for the least distribution: of all that the contacts allow, that with the
 * least sum of squares of forces (couples over the size of the scene). */
double pm_shared_read_least(pm_workspace *w, int measure);
/* The blow that was found last, with impulses w->impulses: how they might be others.  The active set is that of the blow. */
void pm_shared_note_impulses(pm_workspace *w);
/* Some reactions are shared, and the scene asks for the least. */
int pm_shared_are_told(const pm_workspace *w);

#endif
