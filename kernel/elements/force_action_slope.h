/* force_action_slope.h - derivatives of the actions of all forces, by positions and velocities of the bodies. */
#ifndef PM_FORCE_ACTION_SLOPE_H
#define PM_FORCE_ACTION_SLOPE_H

#include "elements/force.h"
#include "elements/slope.h"

/* Of an action (force.h): of its force by components, of its couple, of its power. */
typedef struct pm_action_slope {
    pm_slope force[2], couple, power;
    pm_slope size; /* scratch: of what a program gives */
} pm_action_slope;

int pm_action_slope_create(pm_arena *arena, pm_action_slope *x, const pm_model *m);

/* The action of force i and its derivatives, but of friction of joints: their size goes with reactions, their direction is that
 * of a constraint (constraint_bend.c), and nothing of them is here. */
pm_action pm_force_slope(pm_workspace *w, int i, pm_action_slope *x);
/* Adds the derivative of a program, by the measures that it reads. */
void pm_force_add_program(pm_workspace *w, int program, double weight, pm_slope *to);

#endif
