/* slope.h - the derivative of one number by the positions and velocities of the bodies.
 *
 * It is gathered by the chain rule from what the number is made of: places and velocities of points, angles and rates of
 * bodies, measures, programs.  Few bodies have a part in it: those are listed.  What is fixed has none. */
#ifndef PM_SLOPE_H
#define PM_SLOPE_H

#include "state/arena.h"
#include "state/frame.h"
#include "state/workspace.h"

typedef struct pm_slope {
    double *q, *v; /* [nq] each; 0 but of the bodies that are listed */
    int *body;     /* [nbody] those that are listed */
    int *listed;   /* [nbody] 1: it is */
    int n;
} pm_slope;

int pm_slope_create(pm_arena *arena, pm_slope *x, const pm_model *m);
void pm_slope_clear(pm_slope *x);

/* Each adds `weight` times a derivative at the frame. */
void pm_slope_add(pm_slope *to, const pm_slope *from, double weight);
void pm_slope_add_angle(const pm_frame *frame, pm_slope *to, int body, double weight);
void pm_slope_add_omega(const pm_frame *frame, pm_slope *to, int body, double weight);
/* Of the place of a point, of its velocity: weight[2] for x and y. */
void pm_slope_add_place(const pm_frame *frame, pm_slope *to, const pm_point *p, const double weight[2]);
void pm_slope_add_velocity(const pm_frame *frame, pm_slope *to, const pm_point *p, const double weight[2]);
/* j[3n] on the positions (velocities: by 1) of n bodies. */
void pm_slope_add_bodies(const pm_frame *frame, pm_slope *to, int n, const int *body, const double *j,
                         double weight, int velocities);

/* Numbers that are its parts, in any order: to[stride * coordinate] += weight * what it is by it. */
void pm_slope_spread(const pm_slope *x, double weight, int stride, double *by_place, double *by_velocity);

#endif
