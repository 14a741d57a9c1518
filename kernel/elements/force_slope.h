/* force_slope.h - derivatives of what springs and dampers do, by positions and velocities of the bodies. */
#ifndef PM_FORCE_SLOPE_H
#define PM_FORCE_SLOPE_H

#include "elements/force.h"
#include "elements/slope.h"

/* The line of a force from its point a to its point b: direction, relative velocity. */
typedef struct pm_sight {
    pm_point a, b;
    double n[2], u[2], length; /* n = 0 where they coincide: no direction, no derivative */
} pm_sight;

pm_sight pm_force_sight(const pm_frame *frame, const int32_t *e);
/* weight . dn */
void pm_force_add_direction(const pm_frame *frame, const pm_sight *x, const double weight[2], pm_slope *to);
/* Of the angle (velocities: of its rate) between the two bodies of a force. */
void pm_force_add_relative(const pm_frame *frame, const int32_t *e, double weight, int velocities,
                           pm_slope *to);
/* Of the tension of a spring or a damper; of the couple of one between two bodies. */
void pm_force_add_tension(pm_workspace *w, const int32_t *e, const pm_action *action, const pm_sight *x,
                          double weight, pm_slope *to);
void pm_force_add_own_couple(pm_workspace *w, const int32_t *e, double weight, pm_slope *to);

/* Those of what is read off force i: stretch and rate of any, the rest of springs and dampers. */
void pm_force_add_stretch(const pm_frame *frame, int i, double weight, pm_slope *to);
void pm_force_add_rate(const pm_frame *frame, int i, double weight, pm_slope *to);
void pm_force_add_force(pm_workspace *w, int i, const double weight[2], pm_slope *to);
void pm_force_add_couple(pm_workspace *w, int i, double weight, pm_slope *to);
void pm_force_add_power(pm_workspace *w, int i, double weight, pm_slope *to);
void pm_force_add_energy(pm_workspace *w, int i, double weight, pm_slope *to);

#endif
