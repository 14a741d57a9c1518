/* curve_feet.h - all feet of a point on a curve that contacts touch. */
#ifndef PM_CURVE_FEET_H
#define PM_CURVE_FEET_H

#include "elements/curve.h"
#include "elements/curve_parts.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

/* A place of the curve, and its direction as s grows. */
typedef struct pm_curve_node {
    double p[2], t[2];
} pm_curve_node;

/* A curve of a case at equal parts of s; the last node of a closed one is its first. */
typedef struct pm_curve_course {
    pm_curve_node node[PM_CURVE_NODES + 1];
    pm_curve_part part[PM_CURVE_PARTS];
    double pace; /* m: of the longest way from node to node */
    double size; /* m: of its extent */
    double
        fine; /* m: of the shortest way along which its tangent turns by PM_CURVE_TURN; no more than its size */
    double far; /* m: of the node farthest from its point */
} pm_curve_course;

/* Places of feet that are not looked for, in s. */
typedef struct pm_curve_taken {
    int n;
    double s[PM_PATTERN_SLOTS];
} pm_curve_taken;

enum pm_curve_end { PM_CURVE_WITHIN = 0, PM_CURVE_AT_FROM = 1, PM_CURVE_AT_TO = 2 };

/* What is nearest to a point. */
typedef struct pm_curve_near {
    pm_curve_place foot;
    double height; /* over its tangent, m */
    double beyond; /* of an end: how far beyond it along its tangent, m */
    int end;       /* enum pm_curve_end */
    int node;      /* next to the foot */
} pm_curve_near;

/* case.c: looks at the curve of a case, for the others: PM_OK, or PM_BAD_VALUE where contacts cannot follow it. */
int pm_curve_feet_begin(pm_workspace *w, int curve);
/* The s of a node, and the node next to s. */
double pm_curve_feet_place(const pm_frame *frame, int curve, int node);
int pm_curve_feet_node(const pm_frame *frame, int curve, double s);
/* A foot at s is one of those. */
int pm_curve_feet_is_taken(const pm_frame *frame, int curve, const pm_curve_taken *taken, double s);
/* The nearest foot or end, but for those that are taken, of a point x in the axes of the curve; 0: there is none. */
int pm_curve_feet_nearest(const pm_frame *frame, int curve, const double x[2], const pm_curve_taken *taken,
                          pm_curve_near *near);

#endif
