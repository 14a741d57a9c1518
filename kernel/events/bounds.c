/* bounds.c - a watched value over a part of a step, by its law or by a polynomial: above the chord of a part whose bends are known,
 * it rises no more than the parabola with the least of them. */
#include "events/bounds.h"

#include "events/waves.h"
#include "numerics/minmax.h"

static pm_enclosure enclosed(const pm_bounds *x, double from, double to)
{
    if (x->program != PM_NONE) return pm_waves_enclosed(x->w, x->program, from, to);
    const pm_chebyshev_part part = x->narrow ? pm_chebyshev_series_narrow(&x->series, &x->bends, from, to)
                                             : pm_chebyshev_series_over(&x->series, from, to);
    return (pm_enclosure){.jet = {.at = {part.at[0], part.at[1], part.at[2]},
                                  .value = part.value,
                                  .rate = part.rate,
                                  .bend = part.bend}};
}

static pm_interval with_sign(double sign, pm_interval x) { return sign > 0 ? x : pm_interval_negative(x); }

pm_bound pm_bounds_over(const pm_bounds *x, double from, double to)
{
    const pm_enclosure e = enclosed(x, from, to);
    const double h = to - from;
    pm_bound part = {.most = with_sign(x->sign, e.jet.value).hi,
                     .rate = with_sign(x->sign, e.jet.rate),
                     .bend = with_sign(x->sign, e.jet.bend),
                     .smooth = e.open == 0 && e.jet.gaps == PM_GAPS_NONE};
    for (int k = 0; k < 3; k++) part.at[k] = x->sign * e.jet.at[k];
    const double above_chord = pm_max(part.at[0], part.at[2]) + pm_max(-part.bend.lo, 0) * h * h / 8;
    if (part.smooth && above_chord < part.most) part.most = above_chord;
    return part;
}

double pm_bounds_least(const pm_bounds *x, double s)
{
    return with_sign(x->sign, enclosed(x, s, s).jet.value).lo;
}

int pm_bounds_is_monotonic(const pm_bound *part)
{
    return part->smooth && (part->rate.lo > 0 || part->rate.hi < 0);
}
