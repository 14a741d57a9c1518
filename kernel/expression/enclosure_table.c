/* enclosure_table.c - jets of piecewise polynomials, by the chain rule to the second order (enclosure_rules.c). */
#include "expression/enclosure.h"
#include "expression/operation.h"
#include "expression/piecewise.h"

/* The argument, where each piece is a stretch between two integers: what floor makes of it tells the piece. */
pm_jet pm_jet_of_pieces(const pm_model *m, int row, const pm_jet *a)
{
    const pm_piecewise p = pm_piecewise_of(m, row);
    pm_jet f = *a;
    for (int k = 0; k < 3; k++) f.at[k] = pm_piecewise_number(&p, a->at[k]);
    f.value.lo = pm_piecewise_number(&p, a->value.lo);
    f.value.hi = pm_piecewise_number(&p, a->value.hi);
    if (isnan(f.value.lo) || isnan(f.value.hi)) f.value = PM_INTERVAL_ALL;
    return f;
}

/* Bounds of the value and of derivative k over the argument; n: of one piece alone, or not a number. */
static pm_interval bounds(const pm_piecewise *p, double n, int k, pm_interval x)
{
    return isnan(n) ? pm_piecewise_bounds(p, k, x) : pm_piecewise_bounds_of(p, n, k, x);
}

static pm_jet knot_jet(const pm_piecewise *p, const pm_jet *a)
{
    pm_jet f = {.motion = a->motion, .gaps = a->gaps, .value = PM_INTERVAL_ALL};
    for (int k = 0; k < 3; k++) f.at[k] = pm_piecewise_begin(p, round(a->at[k]));
    if (isfinite(f.at[0]) && isfinite(f.at[2]))
        f.value = pm_interval_hull(pm_interval_of(f.at[0]), pm_interval_of(f.at[2]));
    return f;
}

pm_jet pm_jet_of_table(const pm_model *m, int op, int row, const pm_jet *a)
{
    const pm_piecewise p = pm_piecewise_of(m, row);
    if (op == PM_OP_KNOT) return knot_jet(&p, a);
    const int chosen = op == PM_OP_PIECE;
    const double n = chosen ? round(a[1].at[1]) : NAN;
    pm_jet f = {.motion = a->motion || (chosen && a[1].motion), .gaps = a->gaps};
    for (int k = 0; k < 3; k++)
        f.at[k] = chosen ? pm_piecewise_piece(&p, n, a->at[k], NULL) : pm_piecewise_value(&p, a->at[k]);
    const int beyond = pm_piecewise_is_outside(&p, a->value.lo) + pm_piecewise_is_outside(&p, a->value.hi);
    if (!chosen && beyond && f.gaps != PM_GAPS_EVERYWHERE)
        f.gaps = pm_piecewise_number(&p, a->value.lo) == pm_piecewise_number(&p, a->value.hi)
                     ? PM_GAPS_EVERYWHERE
                     : PM_GAPS_SOMEWHERE;
    const pm_interval first = bounds(&p, n, 1, a->value), second = bounds(&p, n, 2, a->value);
    f.value = bounds(&p, n, 0, a->value);
    f.rate = pm_interval_product(first, a->rate);
    f.bend = pm_interval_sum(pm_interval_product(second, pm_interval_square(a->rate)),
                             pm_interval_product(first, a->bend));
    return f;
}
