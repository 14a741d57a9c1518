/* curve.h - curves as marks: places on them with tangent and curvature, and the foot of a point. */
#ifndef PM_CURVE_H
#define PM_CURVE_H

#include "state/workspace.h"

/* A place of a curve, in the axes of its body from its point.  t runs along the curve, so that the free side is on its left:
 * n = k x t points there.  Lengths along the curve count with t. */
typedef struct pm_curve_place {
    double s; /* of the curve; of a closed one it counts on past its ends */
    double p[2], t[2], n[2];
    double rate;     /* of the length along the curve by s: negative where the free side is on the right */
    double quickens; /* its own rate, by s */
    double bend;     /* curvature, 1/m: dt = bend n along the curve; positive where the free side is hollow */
    double bend_rate; /* the same along the curve, 1/m^2 */
} pm_curve_place;

/* PM_CURVE_FROM or PM_CURVE_TO of the case. */
static inline double pm_curve_bound(const pm_frame *frame, int curve, int column)
{
    return frame->numbers->value[PM_CURVE_ROW(frame->model, curve)[column]];
}

static inline int pm_curve_is_round(const pm_model *m, int curve)
{
    return PM_CURVE_ROW(m, curve)[PM_CURVE_CLOSED] == PM_CURVE_ROUND;
}
static inline int pm_curve_has_ends(const pm_model *m, int curve)
{
    return PM_CURVE_ROW(m, curve)[PM_CURVE_CLOSED] == PM_CURVE_WITH_ENDS;
}
static inline int pm_curve_is_endless(const pm_model *m, int curve)
{
    return PM_CURVE_ROW(m, curve)[PM_CURVE_CLOSED] == PM_CURVE_ENDLESS;
}

/* The place s; beyond the ends of a curve that is not closed by its series there, with the derivatives it ends with. */
pm_curve_place pm_curve_at(const pm_frame *frame, int curve, double s);
/* The same as that piece of the curve goes on in which `of` lies (curve_piece.h). */
pm_curve_place pm_curve_along(const pm_frame *frame, int curve, double s, double of);

/* The foot of a point x (in the axes of the curve): where x - p is along n, at the height n.(x - p).  The search starts from
 * the foot s that the point had before; it ends without a foot (a place that is no number) where the tangent turns by more than
 * PM_CURVE_WINDOW. */
pm_curve_place pm_curve_foot(const pm_frame *frame, int curve, const double x[2], double s, double *height);
/* The same on the piece in which s lies. */
pm_curve_place pm_curve_foot_along(const pm_frame *frame, int curve, const double x[2], double s,
                                   double *height);
/* The foot that is nearest to x of all. */
pm_curve_place pm_curve_nearest(const pm_frame *frame, int curve, const double x[2], double *height);

/* How far the tangent turns along a short way from there, rad, by the curvature and its rate; the step of s that goes it. */
double pm_curve_turn_along(const pm_curve_place *x, double way);
double pm_curve_step(const pm_curve_place *x, double way);

/* The length along the curve from one place to another, with the sign of t, on the piece in which `of` lies. */
double pm_curve_way(const pm_frame *frame, int curve, double from, double to, double of);

/* How far a place is from the nearer end along the curve, m; INFINITY where there are no ends, negative beyond an end. */
double pm_curve_room(const pm_frame *frame, int curve, const pm_curve_place *x);
/* Greatest distance of two of its places, about, m. */
double pm_curve_extent(const pm_frame *frame, int curve);
/* case.c: whether the numbers of the case make a curve of it: PM_OK, or PM_BAD_VALUE with where and detail. */
int pm_curve_check(pm_workspace *w, int curve);

#endif
