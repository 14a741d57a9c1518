/* routes.c - which routes there are. */
#include "state/route.h"

#include <stddef.h>

#include "routes/start/perturbation.h"
#include "state/workspace.h"

static const pm_route_ops *const routes[] = {&pm_route_rk, &pm_route_ida, &pm_route_uniform, &pm_route_path};
enum { NROUTES = sizeof routes / sizeof *routes };

/* IDA's memory is large, and made only for scenes that ask for it, or that may be stiff: something follows speeds.  A nudge takes one step along the path, and rk leads
 * ida past singular positions. */
static int needed(const pm_model *m, int route)
{
    const int wanted = PM_SETTING(m, PM_SETTING_ROUTE);
    if (wanted == PM_ROUTE_AUTO) return route != PM_ROUTE_IDA || !m->programs.forces_by_place;
    if (route == PM_ROUTE_RK && (wanted == PM_ROUTE_IDA || !pm_routes_find(wanted))) return 1;
    return route == wanted || (route == PM_ROUTE_PATH && pm_perturbation_any(m));
}

int pm_routes_create(pm_workspace *w)
{
    int status = PM_OK;
    for (int i = 0; i < NROUTES && !status; i++)
        if (needed(w->model, routes[i]->route)) status = routes[i]->create(w);
    return status;
}

void pm_routes_forget(pm_workspace *w)
{
    for (int i = 0; i < NROUTES; i++)
        if (routes[i]->forget && needed(w->model, routes[i]->route)) routes[i]->forget(w);
}

const pm_route_ops *pm_routes_find(int route)
{
    for (int i = 0; i < NROUTES; i++)
        if (routes[i]->route == route) return routes[i];
    return NULL;
}

const pm_route_ops *pm_routes_default(const pm_model *m)
{
    const pm_route_ops *wanted = pm_routes_find(PM_SETTING(m, PM_SETTING_ROUTE));
    return wanted ? wanted : &pm_route_rk;
}
