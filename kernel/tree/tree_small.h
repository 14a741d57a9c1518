/* tree_small.h - accelerations of small trees from coordinates and rates alone.  For the tree's own files and rk. */
#ifndef PM_TREE_SMALL_H
#define PM_TREE_SMALL_H

#include "state/workspace.h"

#define PM_SWIFT_MOST 4 /* coordinates: each number of them has code of its own */

/* a cos y + b sin y */
typedef struct pm_tree_small_wave {
    double a, b;
} pm_tree_small_wave;

/* A loop row  g = constant + sum_k (shift_k y_k + wave_k), and its Jacobian's square in the metric of M^-1 if nothing held
 * its bodies: with the levers of its own marks. */
typedef struct pm_tree_small_row {
    double constant;
    double shift[PM_SWIFT_MOST];
    pm_tree_small_wave wave[PM_SWIFT_MOST];
    double square;
    int turning[2]; /* the coordinates that turn its bodies, or PM_NONE */
    pm_tree_small_wave lever[2];
    double inverse_inertia[2];
} pm_tree_small_row;

typedef struct pm_tree_small {
    int on, n, nloop;
    /* coordinates i > k: see tree_augmented.c */
    double same[PM_SWIFT_MOST][PM_SWIFT_MOST], cross[PM_SWIFT_MOST][PM_SWIFT_MOST],
        level[PM_SWIFT_MOST][PM_SWIFT_MOST];
    int shifts;
    pm_tree_small_wave fixed[PM_SWIFT_MOST][PM_SWIFT_MOST]; /* e_i . R_k d_k, summed */
    double weight[PM_SWIFT_MOST];
    pm_tree_small_wave turned_weight[PM_SWIFT_MOST];
    int owner[PM_SWIFT_MOST];      /* the body whose direction it is, or PM_NONE */
    double turning[PM_SWIFT_MOST]; /* 1, or 0 where it turns nothing */
    pm_tree_small_row row[PM_SWIFT_MOST - 1];
    /* where directions were computed last */
    double y[PM_SWIFT_MOST], cosine[PM_SWIFT_MOST], sine[PM_SWIFT_MOST];
} pm_tree_small;

/* Once a phase, after pm_tree_sum_up, where the frame looks and the loop rows are evaluated. */
void pm_tree_small_sum_up(pm_workspace *w);
/* Whether the functions below may be called. */
int pm_tree_small_applies(const pm_workspace *w);
/* Directions are computed at y; near it they are turned on from there. */
void pm_tree_small_refer(pm_workspace *w, const double *y);
/* Of y[2 n], coordinates and their rates: rates and accelerations.  The frame stays where it is. */
int pm_tree_small_derivative(pm_workspace *w, const double *y, double *rate);
/* pm_tree_project without the last look. */
int pm_tree_small_project(pm_workspace *w, double *y, double *ydot);

#endif
