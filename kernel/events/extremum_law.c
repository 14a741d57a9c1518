/* extremum_law.c - extremes of a value that may have waves or narrow tops along a step: by its law, that is, by what the program
 * makes of its measures, which the samples do show (waves.h). */
#include <math.h>

#include "events/extremum_parts.h"
#include "events/watched_samples.h"
#include "events/waves.h"
#include "numerics/bracket.h"
#include "state/workspace.h"

static int program_of(const pm_workspace *w, int ask) { return pm_ask_program(PM_ASK_ROW(w->model, ask)); }

int pm_extremum_law_known(const pm_workspace *w, int ask)
{
    return pm_chebyshev_nodes_spectral(w->step.nodes) &&
           pm_waves_tell_law(w, program_of(w, ask), PM_SAMPLE_ASKS);
}

static pm_jet law(const pm_workspace *w, const pm_extremum *p, double s)
{
    return pm_waves_law(w, program_of(w, p->ask), p->branch ? p->branch->here.sign : NULL, s);
}

static double middle(pm_interval x) { return 0.5 * (x.lo + x.hi); }

pm_extremum_slope pm_extremum_law_slope(pm_workspace *w, const pm_extremum *p, double s)
{
    const pm_jet x = law(w, p, s);
    return (pm_extremum_slope){s, p->sign * x.at[1], p->sign * middle(x.rate)};
}

static double rate_at(void *of, double s, void *context, double *bend)
{
    const pm_extremum *const *p = context;
    const pm_jet x = law(of, *p, s);
    *bend = (*p)->sign * middle(x.bend);
    return (*p)->sign * middle(x.rate);
}

int pm_extremum_law_top(pm_workspace *w, const pm_extremum *p, const pm_extremum_slope *a,
                        const pm_extremum_slope *b)
{
    double s;
    const int end = pm_bracket_newton(rate_at, w, &p, a->s, a->rate, b->s, b->rate, &s);
    const int status = end == PM_SEARCH_NO_NUMBER ? PM_OK : pm_fail_search(&w->result, end);
    return status ? status : pm_extremum_offer_at(w, p, pm_extremum_place(&w->step, s));
}
