/* wedge.h - two contacts that are struck by turns without a loss, as the sides of a wedge (wedge.c). */
#ifndef PM_WEDGE_H
#define PM_WEDGE_H

#include "elements/constraint.h"
#include "state/workspace.h"

/* Its sides are A, of the last blow, and B. */
typedef struct pm_wedge {
    int contact[2];
    pm_constraint normal[2];
    double size[2]; /* |d| of both */
    double cosine, sine, angle;
    double *along, *off; /* [nq] unit vectors along A and off it; along: zeros between parallel sides */
    double a, b;         /* velocity along and off A */
    double far;          /* how far it is to B */
    double flight;       /* s, until B is struck */
} pm_wedge;

/* A blow to come: how much later, s; how far from here along A and off it; the velocity after it, along its side and off it. */
typedef struct pm_met {
    double time, along, off, a, b;
} pm_met;

/* The normal constraint of a contact at the frame, without rounding. */
pm_constraint pm_wedge_side(const pm_workspace *w, int contact);
/* Adds to out[nq] what an impulse of so many N s of the constraint changes the velocities by. */
void pm_wedge_respond(const pm_numbers *numbers, const pm_constraint *c, double impulse, double *out);
/* From its sides, the flight and the velocities of the phase, right after a blow at A; 0: there is none, or rounding counts in it. */
int pm_wedge_find(pm_workspace *w, pm_wedge *x);
/* Where the way has turned by n angles: at side A (0) if n is even, else at B (1). */
pm_met pm_wedge_met(const pm_wedge *x, int side, double n);
/* Of the next n blows at a side: the sum of their b, and by that the mean of times and places. */
pm_met pm_wedge_mean(const pm_wedge *x, int side, double n, double *sum);
/* How many pairs of blows there are to come; without an end between parallel sides. */
double pm_wedge_pairs_left(const pm_wedge *x);
/* The place q[nq] of a blow; the velocities v[nq] with the components a along A and b off it. */
void pm_wedge_place(const pm_workspace *w, const pm_wedge *x, const pm_met *at, double *q);
void pm_wedge_velocity(const pm_workspace *w, const pm_wedge *x, double a, double b, double *v);
/* The frame looks at the place of a blow, with the velocities in uniform->v_look. */
void pm_wedge_look(pm_workspace *w, const pm_wedge *x, const pm_met *at);

#endif
