/* impact.h - blows: the impulsive change of velocities while positions stay. */
#ifndef PM_IMPACT_H
#define PM_IMPACT_H

#include "state/workspace.h"

/* Memory of a blow. */
int pm_impact_create(pm_workspace *w);

/* Closes the contacts that touch and do not part, and resolves the blows at this instant: all of them, or, where the
 * settings want them one by one, the next; *jumped = how many.  The frame looks at w->state afterwards (KINEMATIC);
 * struck contacts' triggers are marked. */
int pm_impact(pm_workspace *w, int *jumped);
/* Blows come one by one, and there is a next one. */
int pm_impact_goes_on(pm_workspace *w);
/* Makes the velocities ones that all that holds allows: joints, contacts that rest and would approach, rough ones. */
int pm_impact_hold(pm_workspace *w);
/* A contact whose slip has come so far that its friction all but draws it together, where no step goes on: its slot, or
 * PM_NONE. */
int pm_impact_jammed(pm_workspace *w);
/* Where no motion obeys the laws of contact: an impact without collision of one contact that slips, whose settings allow it;
 * PM_PAINLEVE: there is none, or others would have to take part.  jumped: whether this instant has had a blow. */
int pm_impact_without_collision(pm_workspace *w, int jumped);

#endif
