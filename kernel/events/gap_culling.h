/* gap_culling.h - open contacts that a step cannot reach: they are not looked at in it. */
#ifndef PM_GAP_CULLING_H
#define PM_GAP_CULLING_H

#include "state/workspace.h"

typedef struct pm_gap_culling {
    double *left; /* [ncontact] m, how far its marks may still move until it is looked at again */
    double
        *moved; /* [nbody + 1] m, how far marks of a body have moved in the step, at most; last: the ground */
    double *from;         /* [nbody][3] pose at the begin of the step */
    double *radius;       /* [nbody] m, of the centre of a circle from its body's origin, the greatest */
    int64_t spared;       /* contacts that were quiet, summed over all steps so far */
    unsigned char *quiet; /* [ncontact] not looked at in this step */
} pm_gap_culling;

int pm_gap_culling_create(const pm_model *m, pm_gap_culling *x);
void pm_gap_culling_free(pm_gap_culling *x);

/* A phase begins: nothing is known of any gap. */
void pm_gap_culling_begin(pm_workspace *w);
/* Chooses what is quiet in the step that has been taken, as the last one lets expect. */
void pm_gap_culling_step(pm_workspace *w);
/* The frame looks at a node of the step. */
void pm_gap_culling_node(pm_workspace *w, int node);
/* All nodes have been looked at: those that were reached after all are not quiet; returns how many. */
int pm_gap_culling_check(pm_workspace *w);
/* The time in which two circles that are open may be missed: what moves through between two of the nodes of a step.  At a
 * state, whose velocities and accelerations the frame knows; INFINITY if there are none, or nothing moves. */
double pm_gap_culling_time(const pm_workspace *w);
/* The gap of a contact that is not quiet at the begin of the step. */
void pm_gap_culling_keep(pm_workspace *w, int contact, double gap);

#endif
