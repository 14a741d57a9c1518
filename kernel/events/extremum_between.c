/* extremum_between.c - tops between two places of a step that do not show them.
 *
 * A top and a dip that have parted by less than the distance of the nodes may both lie between two places where the value
 * rises, or between two where it falls.  The cubic that has both values and rates shows them: then the value is asked for on
 * both sides of its top, and so on in all parts. */
#include <math.h>

#include "events/extremum_parts.h"
#include "numerics/minmax.h"

#define PARTINGS 5 /* what is left of an interval about a level place becomes a sixth each time */

double pm_extremum_between_cubic(const pm_extremum_slope *a, const pm_extremum_slope *b)
{
    const double h = b->s - a->s, secant = (b->g - a->g) / h;
    const double c = (3 * secant - 2 * a->rate - b->rate) / h, d = (a->rate + b->rate - 2 * secant) / (h * h);
    const double root = sqrt(c * c - 3 * d * a->rate); /* its rate is a->rate + 2 c x + 3 d x^2 */
    const double s = a->s + (c > 0 ? -(c + root) / (3 * d) : a->rate / (root - c));
    return s > a->s && s < b->s ? s : NAN;
}

int pm_extremum_between_falls(const pm_extremum_slope *a, const pm_extremum_slope *b)
{
    return a->rate > 0 && b->rate < 0;
}

static int part(pm_workspace *w, const pm_extremum *p, const pm_extremum_parting *x,
                const pm_extremum_slope *a, const pm_extremum_slope *b, int depth)
{
    if (pm_extremum_between_falls(a, b)) return x->top(w, p, a, b);
    if (depth == 0 || (a->rate < 0 && b->rate > 0)) return PM_OK;
    const double makes = (b->s - a->s) * pm_max(fabs(a->rate), fabs(b->rate));
    const double s = pm_extremum_between_cubic(a, b);
    if (isnan(s) || !(makes > PM_PEAK_LEVEL * p->size)) return PM_OK;
    const pm_extremum_slope left = x->slope(w, p, 0.5 * (a->s + s)), right = x->slope(w, p, 0.5 * (s + b->s));
    int status = part(w, p, x, a, &left, depth - 1);
    if (!status) status = part(w, p, x, &left, &right, depth - 1);
    return status ? status : part(w, p, x, &right, b, depth - 1);
}

int pm_extremum_between(pm_workspace *w, const pm_extremum *p, const pm_extremum_parting *x,
                        const pm_extremum_slope *a, const pm_extremum_slope *b)
{
    return part(w, p, x, a, b, PARTINGS);
}
