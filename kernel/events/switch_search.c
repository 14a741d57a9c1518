/* switch_search.c - a root of the argument of a switch: integrals are cut there, and extremes may stand there. */
#include "events/switch_search.h"

#include <math.h>

#include "events/ask.h"
#include "events/watched_samples.h"

double pm_switch_search_argument(void *workspace, double t, void *search)
{
    pm_workspace *w = workspace;
    pm_switch_search *x = search;
    if (pm_ask_look(w, t, x->exactly)) return NAN;
    pm_watched_samples_here(w, x->program, &x->here);
    return x->here.arg[x->i][0];
}

enum pm_search_end pm_switch_search_find(pm_workspace *w, pm_switch_search *x, double from, double fa,
                                         double to, double fb, double *t)
{
    return pm_bracket_find(w->ask->solver, pm_switch_search_argument, w, x, from, fa, to, fb, t);
}
