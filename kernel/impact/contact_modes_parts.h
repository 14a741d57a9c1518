/* contact_modes_parts.h - modes that are tried as a search begins, as its files share them. */
#ifndef PM_CONTACT_MODES_PARTS_H
#define PM_CONTACT_MODES_PARTS_H

#include "state/workspace.h"

/* The state as it was when the search began. */
void pm_contact_modes_take_back(pm_workspace *w);
/* Whether the present modes stand there. */
int pm_contact_modes_stand(pm_workspace *w);
/* To close a gap of rounding the bodies have gone to another place, or there is none near. */
int pm_contact_modes_is_put_elsewhere(const pm_workspace *w);
/* Loads that rounding may have made, or those of another place. */
int pm_contact_modes_are_in_doubt(const pm_workspace *w);
/* The pair of an open contact accelerates towards each other, by more than so much of the natural acceleration. */
int pm_contact_modes_approach(const pm_workspace *w, int slot, double part);

/* Contacts that others hold for an instant are let go, as few as may be: 1 where all stand then. */
int pm_contact_modes_let_few_go(pm_workspace *w);
/* Slips that others hold for an instant go on, as few as may be: 1 where all stand then. */
int pm_contact_modes_let_few_slip(pm_workspace *w);

#endif
