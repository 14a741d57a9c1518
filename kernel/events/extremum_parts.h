/* extremum_parts.h - the extremes of one watched value inside a step: what the files that look for them share.
 *
 * g is the value, or its negative: the greater the better.  s is the fraction of what is sampled.  Where a program has
 * switches (program.h), g is one branch of it, and what is found counts where that is the one that is taken. */
#ifndef PM_EXTREMUM_PARTS_H
#define PM_EXTREMUM_PARTS_H

#include "events/ask.h"
#include "expression/program.h"
#include "numerics/chebyshev_nodes.h"

/* A branch of a program: the signs that make it, and what its arguments are where the frame looks. */
typedef struct pm_extremum_of_branch {
    pm_switches here;
    double zero[PM_SWITCHES]; /* so small an argument has no sign */
} pm_extremum_of_branch;

/* A value in a step. */
typedef struct pm_extremum {
    int ask;
    double sign; /* of the value in g */
    double g[PM_NODES_MOST];
    double size;    /* greatest of g */
    double tail;    /* highest coefficients over it */
    double best;    /* known before it is looked for, as g */
    double nothing; /* so much more is not looked for */
    double end;     /* of the step, as a fraction of what is sampled */
    double slope_error;
    int spectral; /* the samples are at nodes of Chebyshev polynomials, and nothing is asked where another is extreme */
    int bounded; /* what the program makes of its measures is known along the step, and bounds the value (extremum_law.c) */
    int law;                       /* likewise, and what the nodes show of it may not be all */
    pm_extremum_of_branch *branch; /* NULL: the program has no switches, or none changes */
    int first, last;               /* nodes beside which extremes are looked for */
    uint32_t met;                  /* bit k: between node k and the next one has been found */
    int ntop;                      /* that have been found by the polynomial through the nodes; where */
    double top[PM_NODES_MOST];
} pm_extremum;

/* The polynomial somewhere: its value less that of the nearest node, slope and bend; w'/w; w, 1 where it is greatest. */
typedef struct pm_extremum_fit {
    double s, value, slope, bend, pull, w;
} pm_extremum_fit;

/* What a look shows of the extreme near it. */
typedef struct pm_extremum_estimate {
    double s, value, rate, rate_error;
    double gain, place; /* the extreme is that much above the value, and there */
    double residual;    /* and may be so much more */
} pm_extremum_estimate;

/* A place in a step: the value and its rate there, of one step a unit. */
typedef struct pm_extremum_slope {
    double s, g, rate;
} pm_extremum_slope;

/* What reads values and rates, and what finds the one top between a place where the value rises and one where it falls. */
typedef struct pm_extremum_curve {
    pm_extremum_slope (*slope)(pm_workspace *w, const pm_extremum *p, double s);
    int (*top)(pm_workspace *w, const pm_extremum *p, const pm_extremum_slope *a, const pm_extremum_slope *b);
} pm_extremum_curve;

/* ---- extremum_value.c: a value where the frame looks, and what is made of it ---- */
/* The place in the step of a fraction of what is sampled. */
double pm_extremum_place(const pm_step *step, double s);
/* g where the frame looks. */
double pm_extremum_value(pm_workspace *w, const pm_extremum *p);
/* Whether the branch is the one that is taken where pm_extremum_value was asked for last. */
int pm_extremum_is_taken(const pm_extremum *p);
/* Takes g at the frame, and so much above it, if the branch is taken there. */
void pm_extremum_offer(pm_workspace *w, const pm_extremum *p, double g, double above);
/* Nothing above g is looked for. */
void pm_extremum_skip(struct pm_ask_set *ask, const pm_extremum *p, double g);
/* What its highest coefficients tell of the polynomial through the samples. */
void pm_extremum_take_tail(const pm_workspace *w, pm_extremum *p, double high);
/* So much more than the best is not looked for, of values of that size. */
double pm_extremum_nothing(const pm_workspace *w, double size);
/* The best so far: of what was known before, and what has been offered since. */
double pm_extremum_best(const struct pm_ask_set *ask, const pm_extremum *p);
/* Looks at place t, exactly, and takes the value there. */
int pm_extremum_offer_at(pm_workspace *w, const pm_extremum *p, double t);

/* ---- extremum.c ---- */
/* Looks for extremes that are better than the best so far; top: the best node of those that are asked for, spread: of all
 * of these. */
int pm_extremum_find(pm_workspace *w, pm_extremum *p, int top, double spread);
/* The extreme near one of the polynomial, beside node k, if it may be better than the best. */
int pm_extremum_near(pm_workspace *w, const pm_extremum *p, int k, const pm_extremum_fit *x);

/* ---- extremum_hidden.c ---- */
/* Extremes that no node shows, where the nodes do not resolve the value; those at nodes have been looked for. */
int pm_extremum_hidden_find(pm_workspace *w, pm_extremum *p);
/* Where the cubic with these values and rates is greatest between a and b; NaN if it has no top there. */
double pm_extremum_hidden_cubic(const pm_extremum_slope *a, const pm_extremum_slope *b);
/* All tops between a and b, which may be parted so often (PM_HIDDEN_PARTINGS). */
int pm_extremum_hidden_tops(pm_workspace *w, const pm_extremum *p, const pm_extremum_curve *x,
                            const pm_extremum_slope *a, const pm_extremum_slope *b, int partings);

/* ---- extremum_bound.c ---- */
/* Likewise, where the nodes resolve it: by the polynomial through them, part by part. */
int pm_extremum_bound_by_samples(pm_workspace *w, pm_extremum *p);

/* ---- extremum_rise.c: where the nodes resolve the value nearly ---- */
/* The interval of s, next to node k. */
int pm_extremum_rise_side(const pm_chebyshev_nodes *nodes, int k, double s);
/* The polynomial's extreme near s, beside node k; nearly: as far as its slope shows it.  The bend is not below zero if there
 * is none. */
pm_extremum_fit pm_extremum_rise_top(const pm_chebyshev_nodes *nodes, const pm_extremum *p, int k, double s);
/* The node before s, but for the last. */
int pm_extremum_rise_interval(const pm_chebyshev_nodes *nodes, double s);
/* The polynomial at s, or right beside the node there. */
pm_extremum_fit pm_extremum_rise_fit(const pm_chebyshev_nodes *nodes, const pm_extremum *p, double s);
/* From a place near an extreme to it; *found is 0 if the looks do not resolve it. */
int pm_extremum_rise_climb(pm_workspace *w, const pm_extremum *p, int k, const pm_extremum_fit *near,
                           int *found);

/* ---- extremum_search.c: where they do not ---- */
/* Between node k and the next where the value may have an extreme better than the best so far: the root of its rate. */
int pm_extremum_search_root(pm_workspace *w, const pm_extremum *p, int k);
/* The same between two places of the step. */
int pm_extremum_search_part(pm_workspace *w, const pm_extremum *p, double from, double to);

/* ---- extremum_law.c ---- */
/* Whether the program's law is known along the step. */
int pm_extremum_law_known(const pm_workspace *w, int ask);
/* Value and rate by it. */
pm_extremum_slope pm_extremum_law_slope(pm_workspace *w, const pm_extremum *p, double s);
/* Between two places where it rises and falls: the value at the root of its rate. */
int pm_extremum_law_top(pm_workspace *w, const pm_extremum *p, const pm_extremum_slope *a,
                        const pm_extremum_slope *b);

/* ---- extremum_branch.c: where a program takes one branch after the other ---- */
/* Extremes of all branches and the corners between them; *taken is 0 if there is only one branch, or they are not resolved. */
int pm_extremum_branch_all(pm_workspace *w, const pm_extremum *p, int *taken);

#endif
