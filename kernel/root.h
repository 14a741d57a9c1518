/* root.h - a bracketed root of a function of time along the last step, by GSL's Brent method. */
#ifndef PM_ROOT_H
#define PM_ROOT_H

#include "model.h"

/* A function of time along the last step. */
typedef double pm_along(pm_workspace *w, double t, void *context);

/* A root of f in [a, b], where f(a) = fa and f(b) = fb differ in sign; to the rounding of t. */
int pm_root_find(pm_workspace *w, void *solver, pm_along *f, void *context, double a, double fa, double b, double fb,
                 double *root);
void *pm_root_create(void);
void pm_root_free(void *solver);

#endif
