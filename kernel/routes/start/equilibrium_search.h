/* equilibrium_search.h - equilibrium.c's search, for contacts that carry or do not. */
#ifndef PM_EQUILIBRIUM_SEARCH_H
#define PM_EQUILIBRIUM_SEARCH_H

#include "tree/free_motion.h"

typedef struct pm_equilibrium {
    pm_free_motion free;
    double *force;                        /* [nq] F at the state */
    double *slope;                        /* [nfree][nfree] K */
    double *left, *right, *value, *spare; /* its singular values and vectors */
    double *step, *part;                  /* [nq] of the state along s; what of it is tried */
    int *pivot;                           /* [nq] */
    double norm;                          /* |F| */
    double unanswered;                    /* of F where no displacement changes it */
    pm_state drawn, before;
} pm_equilibrium;

/* The greatest |x[i]|. */
double pm_equilibrium_search_longest(const double *x, int n);
/* x->force is F at w->state, where the frame looks; 1 where there is none. */
int pm_equilibrium_search_evaluate(pm_workspace *w, pm_equilibrium *x);
/* From w->state, with the contacts that are closed there, to an equilibrium, or to where bodies sink through an open contact;
 * PM_NO_EQUILIBRIUM. */
int pm_equilibrium_search_solve(pm_workspace *w, pm_equilibrium *x);
/* PM_NO_EQUILIBRIUM, with the body and the greatest acceleration that is left at the frame. */
int pm_equilibrium_search_fails(pm_workspace *w);
/* A contact that captures carries nothing before it has. */
int pm_equilibrium_search_holds(const pm_model *m, int contact);
/* Whether bodies overlap at a contact that is open, and may carry; *member tells where. */
int pm_equilibrium_search_overlaps(const pm_frame *frame, const pm_state *state, int contact, int *member);

#endif
