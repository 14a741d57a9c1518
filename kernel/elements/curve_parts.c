/* curve_parts.c - the parts of a curve, by halves.
 *
 * Between two nodes, with the way L from one to the other, a place is no farther than L / 2 from the middle of both.  There a
 * quantity leaves the range of its two ends by a part of what its rate makes on L: half of that is allowed for.  The circle
 * about two circles has them on either side. */
#include "elements/curve_parts.h"

#include <math.h>

/* Half of the range of two ends, and what is left beyond them. */
static double half_of(double a, double b, double rate, double way)
{
    return 0.5 * fabs(b - a) + 0.25 * fabs(rate) * way;
}

pm_curve_part pm_curve_part_between(const pm_curve_stop *a, const pm_curve_stop *b, double way)
{
    const double rate = fmax(fabs(a->bend_rate), fabs(b->bend_rate)), turns = fabs(b->angle - a->angle);
    const double bends = half_of(a->bend, b->bend, rate, way), bend = 0.5 * (a->bend + b->bend);
    return (pm_curve_part){.p = {0.5 * (a->p[0] + b->p[0]), 0.5 * (a->p[1] + b->p[1])},
                           .radius = 0.5 * way,
                           .angle = 0.5 * (a->angle + b->angle),
                           .spread = half_of(a->angle, b->angle, 0.5 * turns / way + rate * way, way),
                           .low = bend - bends,
                           .high = bend + bends};
}

static void join_circles(const pm_curve_part *a, const pm_curve_part *b, pm_curve_part *x)
{
    const double d[2] = {b->p[0] - a->p[0], b->p[1] - a->p[1]}, apart = hypot(d[0], d[1]);
    const pm_curve_part *larger = a->radius > b->radius ? a : b;
    if (apart <= fabs(a->radius - b->radius)) {
        for (int k = 0; k < 2; k++) x->p[k] = larger->p[k];
        x->radius = larger->radius;
        return;
    }
    x->radius = 0.5 * (apart + a->radius + b->radius);
    for (int k = 0; k < 2; k++) x->p[k] = a->p[k] + (x->radius - a->radius) / apart * d[k];
}

static pm_curve_part joined(const pm_curve_part *a, const pm_curve_part *b)
{
    pm_curve_part x;
    const double from = fmin(a->angle - a->spread, b->angle - b->spread),
                 to = fmax(a->angle + a->spread, b->angle + b->spread);
    join_circles(a, b, &x);
    x.angle = 0.5 * (from + to);
    x.spread = 0.5 * (to - from);
    x.low = fmin(a->low, b->low);
    x.high = fmax(a->high, b->high);
    return x;
}

void pm_curve_parts_join(pm_curve_part part[PM_CURVE_PARTS])
{
    for (int k = PM_CURVE_NODES - 1; k > 0; k--) part[k] = joined(&part[2 * k], &part[2 * k + 1]);
}

int pm_curve_part_is_under(const pm_curve_part *part, const double d[2], double radius)
{
    const double far = hypot(d[0], d[1]), radii = radius + part->radius;
    if (far <= radii) return 1;
    const double along = fabs(d[0] * cos(part->angle) + d[1] * sin(part->angle)) / far;
    return along <= sin(fmin(asin(radii / far) + part->spread, 0.5 * M_PI));
}
