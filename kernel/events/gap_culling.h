/* gap_culling.h - open contacts that a step cannot reach: they are not looked at in it. */
#ifndef PM_GAP_CULLING_H
#define PM_GAP_CULLING_H

#include "state/workspace.h"

typedef struct pm_gap_culling {
    double *left;           /* [ncontact] m, how far its marks may still move until it is looked at again */
    double *moved;          /* [nbody + 1] m, most that marks of a body moved in the step; last: the ground */
    double *pose;           /* [PM_NODES_MOST][nbody][3] at the nodes of the step */
    double *radius;         /* [nbody] m, greatest, of the centre of a circle from its body's origin */
    unsigned char *skipped; /* [ncontact] not looked at in this step */
    int64_t nskipped;       /* contacts that were skipped, summed over all steps so far */
} pm_gap_culling;

/* A phase begins: nothing is known of any gap. */
void pm_gap_culling_begin(pm_gap_culling *x, const pm_frame *frame);
/* Chooses what is skipped in the step that has been taken, as the last one lets expect. */
void pm_gap_culling_step(pm_gap_culling *x, const pm_model *m);
/* The frame looks at a node of the step. */
void pm_gap_culling_node(pm_gap_culling *x, const pm_frame *frame, int node);
/* All nodes have been looked at: those that were reached after all are not skipped; returns how many. */
int pm_gap_culling_check(pm_gap_culling *x, const pm_model *m);
/* The gap of a contact that is not skipped at the begin of the step. */
void pm_gap_culling_keep(pm_gap_culling *x, const pm_model *m, int contact, double gap);

/* The bodies of a contact whose gap changes by no more than its marks move; 0: it is none, as a line that rotates. */
int pm_gap_culling_bodies(const pm_model *m, int contact, int body[2]);

#endif
