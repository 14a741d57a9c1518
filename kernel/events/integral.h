/* integral.h - integrals of a value over the time of a run, and the means and root mean squares made of them. */
#ifndef PM_INTEGRAL_H
#define PM_INTEGRAL_H

#include "state/workspace.h"

/* Where a flight between two blows began. */
typedef struct pm_integral_at {
    double t, sum, weight;
} pm_integral_at;

/* What an ask has gathered so far.  f: its program, of root mean squares the square of it. */
typedef struct pm_integral {
    double sum;               /* of f by the time */
    double weight;            /* s, time in which its condition holds: all of it without one */
    double span;              /* s, time that both of these cover */
    double size;              /* greatest |f| at a node */
    double terms;             /* about the integral of |f| */
    double error;             /* of the sum, as the quadrature tells it */
    pm_integral_at flight[3]; /* of the last two, and of the one that begins */
    double leap, leap_weight; /* means over a series of flights that may be passed at once */
} pm_integral;

/* Of each ask; PM_NO_MEMORY. */
int pm_integral_create(pm_workspace *w);
void pm_integral_reset(pm_workspace *w);
/* [w->step.begin, w->step.end] is added; its nodes have been sampled (pm_ask_sample). */
int pm_integral_step(pm_workspace *w, int ask);
/* The answer at the end of the run: not a number if no time has passed in which its condition holds. */
double pm_integral_answer(pm_workspace *w, int ask);
/* How large the terms of the answer are: it is an integral of what may have either sign. */
double pm_integral_terms(const pm_workspace *w, int ask);

/* A flight between two blows begins. */
void pm_integral_mark(pm_workspace *w);
/* A series of flights, each e times as long as the one before and alike, takes `time` from now on: what it adds is noted for
 * pm_integral_leap; 0 if the last two flights do not tell it. */
int pm_integral_leap_is_clear(pm_workspace *w, int ask, double e, double time);
/* The series is passed. */
void pm_integral_leap(pm_workspace *w, double time);

#endif
