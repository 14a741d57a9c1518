/* rk_stiff.c - whether stability, and not accuracy, makes the steps short (E. Hairer, G. Wanner, Solving Ordinary Differential
 * Equations II, 2nd ed., section IV.2).  The last stage Y and the end y of a step are at the same time, so that
 *
 *   |h lambda| = h |f(y) - f(Y)| / |y - Y|
 *
 * is near the greatest; at the bound of stability of the formula it stays, whatever accuracy allows.  Left to another route
 * where as many steps have been made as that one would need. */
#include <math.h>

#include "numerics/tolerances.h"
#include "routes/rk/dop853.h"
#include "routes/rk/rk.h"
#include "state/workspace.h"

static double stretch(const pm_workspace *w)
{
    const struct pm_rk *r = w->rk;
    double rates = 0, values = 0;
    pm_rk_last_stage(r, r->y);
    for (int i = 0; i < r->controlled; i++) {
        const double rate = r->scale[i] * (r->k[STAGES * r->all + i] - r->k[(STAGES - 1) * r->all + i]),
                     value = r->scale[i] * (r->now[i] - r->y[i]);
        rates += rate * rate;
        values += value * value;
    }
    return values > 0 ? r->h * sqrt(rates / values) : 0;
}

void pm_rk_look_for_stiffness(pm_workspace *w)
{
    struct pm_rk *r = w->rk;
    const int64_t made = w->result.count[PM_COUNT_STEPS] - r->first;
    if (w->phase.stiff || made < PM_RK_STIFF_STEPS) return;
    if (r->suspect == 0 && made % PM_RK_STIFF_EVERY != 0) return;
    if (stretch(w) > PM_RK_STABLE) {
        r->suspect++;
        r->clear = 0;
    } else if (++r->clear == PM_RK_STIFF_CLEAR) {
        r->suspect = 0;
    }
    if (r->suspect < PM_RK_STIFF_LOOKS) return;
    w->phase.stiff = PM_STIFF;
    w->result.count[PM_COUNT_STIFF_PHASES]++;
    w->phase.lap = PM_SETTING(w->model, PM_SETTING_ROUTE) == PM_ROUTE_AUTO; /* planned anew */
}
