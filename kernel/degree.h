/* degree.h - programs that are polynomials in the time while accelerations are constant. */
#ifndef PM_DEGREE_H
#define PM_DEGREE_H

#include "model.h"
#include "steady.h"

enum pm_degree { PM_DEGREE_MOST = 2, PM_DEGREE_OTHER = 3 }; /* 0, 1, 2, or no such polynomial */

/* Degree of a program in the time, along the curve. */
int pm_degree_of(const pm_workspace *w, const pm_steady *x, int program);
/* The program is the size of a vector whose components are linear in the time: its square is a parabola. */
int pm_degree_is_size(const pm_workspace *w, const pm_steady *x, int program);

#endif
