/* fixed_bodies.h - bodies that joints hold still for good: they cost nothing after the start. */
#ifndef PM_FIXED_BODIES_H
#define PM_FIXED_BODIES_H

#include "state/workspace.h"

typedef struct pm_fixed_bodies {
    unsigned char *
        body; /* [nbody + 1] it stands still (numbers.fixed, which all others read); last: the ground, which does */
    unsigned char *moves; /* [nbody] it is not to be taken for still, whatever holds it */
    unsigned char *left;  /* [nbody] in this case it is left to the equations of motion */
    unsigned char *told;  /* [njoint] its two bodies are not both to be taken for still */
    int *first;           /* [nbody] of the rows on each body: twice the row, plus its side; or PM_NONE */
    int *next;            /* [2 njoint_row] the next of them */
    int n;                /* bodies that stand still */
    int possible;         /* in some case of the scene a body may */
    int counts;           /* rows are counted, not measured */
    int wanted;           /* they are looked for: not where all is to be told, as by a check or a history */
    void *block;
} pm_fixed_bodies;

int pm_fixed_bodies_create(pm_workspace *w);
void pm_fixed_bodies_free(pm_workspace *w);

/* A case begins: everything may move. */
void pm_fixed_bodies_begin(pm_workspace *w);
/* The start is assembled: finds the bodies.  From here on they have no velocity, and an infinite mass where they are hit. */
void pm_fixed_bodies_find(pm_workspace *w);

#endif
