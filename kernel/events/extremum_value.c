/* extremum_value.c - a value in a step: where the frame looks, what is taken of it, and what is left out (extremum_parts.h). */
#include <math.h>

#include "events/ask.h"
#include "events/extremum_parts.h"
#include "events/watched_samples.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

double pm_extremum_place(const pm_step *step, double s)
{
    return step->begin + s * (step->sampled_end - step->begin);
}

double pm_extremum_value(pm_workspace *w, const pm_extremum *p)
{
    if (!p->branch) return p->sign * pm_ask_run(w, p->ask);
    return p->sign *
           pm_watched_samples_here(w, pm_ask_program(PM_ASK_ROW(w->model, p->ask)), &p->branch->here);
}

int pm_extremum_is_taken(const pm_extremum *p)
{
    if (!p->branch) return 1;
    const pm_switches *x = &p->branch->here;
    for (int i = 0; i < x->n; i++) {
        const double arg = x->arg[i][0];
        if (x->sign[i] * arg < -p->branch->zero[i]) return 0;
    }
    return 1;
}

void pm_extremum_offer(pm_workspace *w, const pm_extremum *p, double g, double above)
{
    if (pm_extremum_is_taken(p)) pm_ask_offer(w, p->ask, p->sign * g, p->sign * above);
}

int pm_extremum_offer_at(pm_workspace *w, const pm_extremum *p, double t)
{
    const int status = pm_ask_look(w, t, 1);
    if (!status) pm_extremum_offer(w, p, pm_extremum_value(w, p), 0);
    return status;
}

double pm_extremum_best(const struct pm_ask_set *ask, const pm_extremum *p)
{
    return pm_max(p->best, p->sign * ask->best[p->ask]);
}

void pm_extremum_skip(struct pm_ask_set *ask, const pm_extremum *p, double g)
{
    double *bound = &ask->bound[p->ask];
    *bound = pm_max(*bound, g);
}

double pm_extremum_nothing(const pm_workspace *w, double size)
{
    return pm_max(PM_EXTREMUM_NOTHING, PM_EXTREMUM_SHARE * w->numbers.tolerance) * size;
}

void pm_extremum_take_tail(const pm_workspace *w, pm_extremum *p, double high)
{
    p->tail = high / p->size;
    p->slope_error = PM_EXTREMUM_SLOPE_TAIL * w->step.nodes->n * p->tail * p->size;
    p->nothing = pm_extremum_nothing(w, p->size);
}
