/* bracket.h - a bracketed root of a function of time along the last step: by GSL's Brent method, or, where its slope is known,
 * by Newton's method kept inside the bracket. */
#ifndef PM_BRACKET_H
#define PM_BRACKET_H

#include "state/workspace.h"

/* A function of time along the last step. */
typedef double pm_along(pm_workspace *w, double t, void *context);

/* A root of f in [a, b], where f(a) = fa and f(b) = fb differ in sign; to the rounding of t. */
int pm_bracket_find(pm_workspace *w, void *solver, pm_along *f, void *context, double a, double fa, double b,
                    double fb, double *root);
/* The same of a function that tells its slope. */
typedef double pm_sloped(pm_workspace *w, double t, void *context, double *slope);
int pm_bracket_newton(pm_workspace *w, pm_sloped *f, void *context, double a, double fa, double b, double fb,
                      double *root);

/* Value of the same function on the exact state at t, which is left in w->probe and in the frame. */
typedef int pm_exactly(pm_workspace *w, double t, void *context, double *value);

/* Moves a root of the dense output to where the exact state is on it; *taken is where that was looked at last, *off the
 * value there.  slope: of f at the root, or NAN where it is to be found by differences. */
int pm_bracket_polish(pm_workspace *w, pm_along *f, pm_exactly *exactly, void *context, double slope,
                      double *t, double *taken, double *off);
void *pm_bracket_create(void);
void pm_bracket_free(void *solver);

#endif
