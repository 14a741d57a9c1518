/* curve_parts.h - a curve as a tree of parts, each enclosed: in a circle, its directions and its curvatures between bounds. */
#ifndef PM_CURVE_PARTS_H
#define PM_CURVE_PARTS_H

#include "numerics/tolerances.h"

/* Lengths are in the axes of the curve from its point; t is the tangent that runs with the free side on its left. */
typedef struct pm_curve_part {
    double p[2], radius;  /* m: no place of the part is outside this circle */
    double angle, spread; /* rad: the direction of t is no farther than `spread` from `angle` */
    double low, high;     /* 1/m: curvatures, as pm_curve_place has them */
} pm_curve_part;

/* Part 1 is all of the curve; part k has the halves 2 k and 2 k + 1; part PM_CURVE_NODES + i goes from node i to the next. */
#define PM_CURVE_PARTS (2 * PM_CURVE_NODES)
static inline int pm_curve_part_is_last(int part) { return part >= PM_CURVE_NODES; }

/* What is known where a part between two nodes begins and ends: the place, the direction of t, its curvature and the rate of
 * that along the curve. */
typedef struct pm_curve_stop {
    double p[2], angle, bend, bend_rate;
} pm_curve_stop;

/* The part from one node to the next; `way`: no less than the length of the curve between them, m. */
pm_curve_part pm_curve_part_between(const pm_curve_stop *a, const pm_curve_stop *b, double way);
/* The parts that have halves, from these. */
void pm_curve_parts_join(pm_curve_part part[PM_CURVE_PARTS]);
/* 0: no place within `radius` of d, which begins at the middle of the part, is square to a tangent of it above or below where
 * that touches. */
int pm_curve_part_is_under(const pm_curve_part *part, const double d[2], double radius);

#endif
