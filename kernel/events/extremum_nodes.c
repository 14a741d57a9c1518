/* extremum_nodes.c - a watched value where the frame looks, and what is made of it. */
#include "events/extremum_parts.h"

#include <math.h>

#include "events/watched_samples.h"
#include "numerics/minmax.h"
#include "state/workspace.h"

double pm_peak_place(const pm_workspace *w, double s)
{
    return w->step.begin + s * (w->step.sampled_end - w->step.begin);
}

double pm_peak_value(pm_workspace *w, const pm_extremum *p)
{
    if (!p->branch) return p->sign * pm_ask_run(w, p->ask);
    return p->sign *
           pm_watched_samples_here(w, pm_ask_program(PM_ASK_ROW(w->model, p->ask)), &p->branch->here);
}

int pm_peak_reigns(const pm_extremum *p)
{
    if (!p->branch) return 1;
    const pm_switches *x = &p->branch->here;
    for (int i = 0; i < x->n; i++) {
        const double arg = x->arg[i][0];
        if (x->sign[i] * arg < -p->branch->zero[i]) return 0;
    }
    return 1;
}

void pm_peak_offer(pm_workspace *w, const pm_extremum *p, double g, double above)
{
    if (pm_peak_reigns(p)) pm_ask_offer(w, p->ask, p->sign * g, p->sign * above);
}

double pm_peak_best(const pm_workspace *w, const pm_extremum *p)
{
    return pm_max(p->best, p->sign * w->ask->best[p->ask]);
}

void pm_peak_untold(pm_workspace *w, const pm_extremum *p, double g)
{
    double *bound = &w->ask->bound[p->ask];
    *bound = pm_max(*bound, g);
}
