/* case.h - the numbers of one case: values, masses, scales. */
#ifndef PM_CASE_H
#define PM_CASE_H

#include "state/workspace.h"

/* Computes the value table from the parameters and checks it; fills masses, gravity, size, tolerance. */
int pm_case_begin(pm_workspace *w, const double *param);
/* s of computing time, INFINITY where there is no limit. */
double pm_case_max_cpu(const pm_model *model, const pm_numbers *numbers);
/* When a run ends at the latest, s. */
double pm_case_max_time(const pm_model *model, const pm_numbers *numbers);
/* Lets the speed scale follow v; 1 if it grew noticeably. */
int pm_case_speed(const pm_model *model, pm_numbers *numbers, const double *v);

/* Of gravity, and such that change its motion within its size, m/s^2. */
double pm_case_acceleration(const pm_numbers *numbers);
/* Forces of the size of the scene's weight, or that change its motion within its size, N. */
double pm_case_force(const pm_model *model, const pm_numbers *numbers);

/* The shortest time in which motion with velocities v and accelerations a changes its own kind, s: 1/omega,
 * sqrt(size/a), size/v; INFINITY at rest without forces. */
double pm_case_time_scale(const pm_model *model, const pm_numbers *numbers, const double *v, const double *a);

/* w->state with everything in it moved by a part of its natural size, no two coordinates alike: what a function changes by,
 * over that part, is its own natural size.  Returns the part. */
double pm_case_shift(const pm_workspace *w, pm_state *shifted);
/* w->state so much later, s, as it goes on with its velocities and the accelerations of the frame, which looks there (DYNAMIC). */
void pm_case_later(const pm_workspace *w, double later, pm_state *to);
/* How far two states are apart, a[2][nq] and b[2][nq] of positions and velocities: the greatest part of its natural size by which
 * a coordinate differs. */
double pm_case_apart(const pm_numbers *numbers, int nq, const double *a, const double *b);

#endif
