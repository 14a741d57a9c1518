/* find_pair.h - two conditions met by two parameters. */
#ifndef PM_FIND_PAIR_H
#define PM_FIND_PAIR_H

#include "study/find_look.h"

void *pm_find_pair_create(void);
void pm_find_pair_free(void *solver);

/* Fills find->found with the places within the bounds where both conditions ZERO are met. */
int pm_find_pair(pm_workspace *w);

#endif
