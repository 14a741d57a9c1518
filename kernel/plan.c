/* plan.c - the table of rules that picks the route of a phase: the first that applies.
 *
 * The settings may force a route; where a forced route cannot compute a phase the run fails and says so. */
#include "plan.h"

#include "program.h"
#include "route.h"

typedef struct pm_rule {
    const pm_route_ops *route;
    const char *reason;
} pm_rule;

static const pm_rule rules[] = {
    {&pm_route_path,
     "one degree of freedom, and work that depends on position only: work and energy along the path"},
    {&pm_route_rk, "smooth motion in time: explicit integration of order 8"},
};
enum { NRULES = sizeof rules / sizeof *rules };

static int take(pm_workspace *w, const pm_route_ops *route, int rule)
{
    w->route = route;
    w->rule = rule;
    w->count[PM_COUNT_ROUTES] |= (int64_t)1 << route->route;
    if (route->price > w->price) {
        w->price = route->price;
        w->count[PM_COUNT_ROUTE] = route->route;
    }
    return PM_OK;
}

static int forced(pm_workspace *w, int wanted)
{
    const pm_route_ops *route = pm_route_of(wanted);
    if (!route->applies || route->applies(w)) return take(w, route, PM_NONE);
    return pm_fail(w, PM_UNSUPPORTED, PM_TABLE_SETTING, PM_SETTING_ROUTE, wanted, 0);
}

int pm_plan_phase(pm_workspace *w)
{
    const int wanted = PM_SETTING(w->model, PM_SETTING_ROUTE);
    if (pm_plan_nudged(w) && pm_route_path.applies(w)) return take(w, &pm_route_path, 0);
    if (wanted != PM_ROUTE_AUTO) return forced(w, wanted);
    for (int i = 0; i < NRULES; i++)
        if (!rules[i].route->applies || rules[i].route->applies(w)) return take(w, rules[i].route, i);
    return pm_fail(w, PM_UNSUPPORTED, PM_TABLE_SETTING, PM_SETTING_ROUTE, wanted, 0);
}

int pm_plan_nudged(const pm_workspace *w)
{
    return PM_SETTING(w->model, PM_SETTING_NUDGE) >= 0 && w->count[PM_COUNT_PHASES] == 0;
}

double pm_plan_nudge(pm_workspace *w, const double *tangent)
{
    const int program = PM_SETTING(w->model, PM_SETTING_NUDGE);
    for (int i = 0; i < w->model->nq; i++) w->frame.velocity[i] = tangent[i];
    const double side = pm_program_run(w->model, program, w->param, w->value, w);
    return side > 0 ? 1 : side < 0 ? -1 : 0;
}
