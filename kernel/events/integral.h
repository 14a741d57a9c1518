/* integral.h - integrals of a value over the time of a run, and the means and root mean squares made of them. */
#ifndef PM_INTEGRAL_H
#define PM_INTEGRAL_H

#include "events/integral_series.h"
#include "state/workspace.h"

/* What an ask has gathered so far.  f: its program, of root mean squares the square of it. */
typedef struct pm_integral {
    double sum;                         /* of f by the time */
    double weight;                      /* s, time in which its condition holds: all of it without one */
    double span;                        /* s, time that both of these cover */
    double size;                        /* greatest |f| at a node */
    double terms;                       /* about the integral of |f| */
    double error;                       /* of the sum, as the quadrature tells it */
    double weight_error;                /* s, of the weight, as series tell it that are not followed */
    double last, last_weight;           /* f, and whether its condition holds, at the end of the last step */
    pm_integral_tail leap, leap_weight; /* of a series of flights that may be passed at once */
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

static inline int pm_integral_is_percentile(const int32_t *e) { return e[PM_ASK_KIND] == PM_ASK_PERCENTILE; }
/* Of root mean squares the square of the program is integrated. */
static inline int pm_integral_is_squared(const int32_t *e) { return e[PM_ASK_KIND] == PM_ASK_RMS; }

#endif
