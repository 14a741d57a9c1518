/* force.h - forces that do not depend on reactions: weight, springs, dampers, applied forces and couples. */
#ifndef PM_FORCE_H
#define PM_FORCE_H

#include "model.h"

/* The action of force i: `force` on its first partner at `at` (the opposite at `at_b` on body_b), and a couple. */
typedef struct pm_action {
    int body_a, body_b; /* nbody: the ground */
    double at_a[2], at_b[2], force[2], couple;
    double stretch,
        rate;      /* of springs and dampers: length - free length (or angle), and d/dt of the length */
    double power;  /* on the bodies, W */
    double energy; /* stored */
} pm_action;

pm_action pm_force_action(pm_workspace *w, int i);
/* Fills frame.f (all applied forces on q, weight included) and frame.power. */
void pm_force_all(pm_workspace *w);
double pm_force_potential(pm_workspace *w);
/* Its generalised forces stay the same along a motion with constant accelerations (steady.h). */
struct pm_steady;
int pm_force_steady(const pm_workspace *w, int i, const struct pm_steady *x);

#endif
