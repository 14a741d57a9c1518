/* route.c - which routes there are. */
#include "route.h"

static const pm_route_ops *const routes[] = {&pm_route_rk, &pm_route_ida};
enum { NROUTES = sizeof routes / sizeof *routes };

int pm_route_create(pm_workspace *w)
{
    const pm_route_ops *chosen = pm_route_choose(w->model);
    return chosen->create(w);
}

void pm_route_free(pm_workspace *w)
{
    for (int i = 0; i < NROUTES; i++) routes[i]->free(w);
}

const pm_route_ops *pm_route_choose(const pm_model *m)
{
    for (int i = 0; i < NROUTES; i++)
        if (routes[i]->route == PM_SETTING(m, PM_SETTING_ROUTE)) return routes[i];
    return &pm_route_rk; /* auto: smooth, not stiff */
}
