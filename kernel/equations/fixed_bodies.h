/* fixed_bodies.h - bodies that joints fix for good: they cost nothing after the start (numbers.fixed, which all others read). */
#ifndef PM_FIXED_BODIES_H
#define PM_FIXED_BODIES_H

#include "state/workspace.h"

typedef struct pm_fixed_bodies {
    unsigned char *moves;    /* [nbody] not to be taken for fixed, whatever holds it */
    unsigned char *is_left;  /* [nbody] in this case it is left to the equations of motion */
    unsigned char *is_asked; /* [njoint] something of it is asked: its bodies are not both taken for fixed */
    int *first; /* [nbody] of the constraints on each body: twice the constraint, plus its side; or PM_NONE */
    int *next;  /* [2 njoint_constraint] the next of them */
    int n;      /* fixed bodies */
    int possible; /* in some case of the scene a body may be */
    int counts;   /* constraints are counted, not measured */
    int wanted;   /* they are looked for: not where all is asked, as by a check or a history */
} pm_fixed_bodies;

/* Memory, and what follows from the scene alone; PM_NO_MEMORY. */
int pm_fixed_bodies_create(pm_workspace *w);

/* A case begins: nothing but the ground is fixed. */
void pm_fixed_bodies_begin(pm_workspace *w);
/* The start is assembled: finds them.  From here on they have no velocity, and an infinite mass where they are hit. */
void pm_fixed_bodies_find(pm_workspace *w);

#endif
