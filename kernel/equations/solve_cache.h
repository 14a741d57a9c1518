/* solve_cache.h - the accelerations and reactions that were found last, for a state that is looked at again. */
#ifndef PM_SOLVE_CACHE_H
#define PM_SOLVE_CACHE_H

#include "state/workspace.h"

/* Where a row takes hold. */
typedef struct pm_hold {
    int body[2];
    double j[6];
} pm_hold;

typedef struct pm_solve_cache {
    int known;          /* something is kept */
    int closed;         /* nothing else is to be kept for now */
    int64_t rows;       /* w->row_set when it was found */
    double *pose;       /* [nq] x, y, angle, as the frame had them */
    double *velocity;   /* [nq] likewise */
    double *a, *lambda; /* [nq], [nrow] what was found */
    pm_memory *memory;  /* [nmemory] */
    pm_constraint *row; /* [nrow] as they were evaluated there */
    /* the set of rows that was built last */
    int built;
    pm_slot *slot; /* [nslot] */
    double *q;     /* [nq] */
    /* the rows whose S = G M^-1 G^T was factored last (saddle.c) */
    int nfactored;     /* none: 0 */
    pm_hold *factored; /* [nrow] */
    void *block;
} pm_solve_cache;

int pm_solve_cache_create(pm_workspace *w);
void pm_solve_cache_free(pm_workspace *w);
/* Another case begins. */
void pm_solve_cache_forget(pm_workspace *w);

/* Makes the frame DYNAMIC where it looks at what it looked at when pm_solve_cache_keep was called last; 0 if it does not. */
int pm_solve_cache_take(pm_workspace *w);
void pm_solve_cache_keep(pm_workspace *w);
/* Evaluates the active rows in the same case. */
int pm_solve_cache_take_rows(pm_workspace *w);

/* The active rows are those that were built last, here and for the same contacts. */
int pm_solve_cache_is_built(const pm_workspace *w);
void pm_solve_cache_built(pm_workspace *w);
/* They are another set from now on. */
void pm_solve_cache_drop_rows(pm_workspace *w);

/* w->schur holds the factors of the active rows as they are evaluated now. */
int pm_solve_cache_is_factored(const pm_workspace *w);
void pm_solve_cache_factored(pm_workspace *w);
/* It does not. */
void pm_solve_cache_drop_factors(pm_workspace *w);

#endif
