/* plan.c - the table of rules that picks the route of a phase: the first that applies.
 *
 * The settings may force a route; where a forced route cannot compute a phase the run fails and says so. */
#include "run/run.h"

#include <math.h>
#include <stdio.h>

#include "equations/saddle.h"
#include "events/ask.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

#define ONE_FREEDOM "one degree of freedom, and work that depends on position only"

typedef struct pm_rule {
    const pm_route_ops *route;
    const char *reason;
    int (*when)(const pm_workspace *w); /* NULL: always */
} pm_rule;

static int has_nudge(const pm_workspace *w) { return w->request.program != PM_NONE; }
static int is_singular(const pm_workspace *w) { return w->phase.singular; } /* known by ida alone */
static int is_stiff(const pm_workspace *w) { return w->phase.stiff == PM_STIFF && w->ida; }

enum {
    NUDGED = 0,
    PASSING = 1,
    FIRST = 2
}; /* the rules from FIRST on are tried in turn, where no route is forced */
static const pm_rule rules[] = {
    {&pm_route_path, "it leaves an unstable rest on the side that a nudge states: by energy along the path",
     has_nudge},
    {&pm_route_rk,
     "a singular position, where the constraints do not determine the motion: passed in "
     "independent coordinates",
     is_singular},
    {&pm_route_uniform,
     "no force changes and no constraint rotates: constant accelerations, polynomials of the time", NULL},
    {&pm_route_path, ONE_FREEDOM ": work and energy along the path", NULL},
    {&pm_route_ida, "stiff: stability, not accuracy, made the steps of rk short; implicit integration",
     is_stiff},
    {&pm_route_rk, "smooth motion in time: explicit integration of order 8", NULL},
};
enum { NRULES = sizeof rules / sizeof *rules };

/* What each route takes: told where the route that was asked for does not take the scene. */
static const char *const scope[PM_ROUTES] = {
    [PM_ROUTE_AUTO] = "all that any route takes",
    [PM_ROUTE_RK] = "all smooth motion",
    [PM_ROUTE_IDA] = "smooth motion of bodies that have mass",
    [PM_ROUTE_STATE] = "what is answered at the start; here time passes",
    [PM_ROUTE_JUMP] = "what is answered before and after a blow at the start; here time passes",
    [PM_ROUTE_UNIFORM] = "constant forces, and joints and contacts that do not rotate with the motion",
    [PM_ROUTE_PATH] = ONE_FREEDOM,
};

static int take(pm_phase *phase, pm_result *result, const pm_route_ops *route, int rule)
{
    phase->route = route;
    phase->rule = rule;
    result->count[PM_COUNT_ROUTES] |= (int64_t)1 << route->route;
    if (route->price > phase->price) {
        phase->price = route->price;
        result->count[PM_COUNT_ROUTE] = route->route;
    }
    return PM_OK;
}

int pm_plan_has_passed(pm_workspace *w)
{
    if (w->phase.rule != PASSING) return 0;
    if (!(pm_saddle_independence_there(w, &w->state) > PM_PLAN_PASSED)) return 0;
    w->phase.singular = 0;
    return 1;
}

static int forced(pm_workspace *w, int wanted)
{
    const pm_route_ops *route = pm_routes_find(wanted); /* none: state and jump, which have no phase */
    if (route && pm_route_prepare(w, route)) return take(&w->phase, &w->result, route, PM_NONE);
    return pm_fail(&w->result, PM_UNSUPPORTED, PM_TABLE_SETTING, PM_SETTING_ROUTE, wanted, 0);
}

/* Takes the route of a rule that applies; 0 if it does not. */
static int try_rule(pm_workspace *w, int rule)
{
    const pm_rule *r = &rules[rule];
    return (!r->when || r->when(w)) && pm_route_prepare(w, r->route) &&
           !take(&w->phase, &w->result, r->route, rule);
}

int pm_plan_phase(pm_workspace *w)
{
    const int wanted = PM_SETTING(w->model, PM_SETTING_ROUTE);
    if (try_rule(w, NUDGED) || try_rule(w, PASSING)) return PM_OK;
    if (wanted != PM_ROUTE_AUTO) return forced(w, wanted);
    for (int i = FIRST; i < NRULES; i++)
        if (try_rule(w, i)) return PM_OK;
    return pm_fail(&w->result, PM_UNSUPPORTED, PM_TABLE_SETTING, PM_SETTING_ROUTE, wanted, 0);
}

int pm_rule_text(int rule, int64_t ntext, int8_t *text)
{
    const char *reason = rule >= 0 && rule < NRULES ? rules[rule].reason : "solve.route says so";
    return snprintf((char *)text, (size_t)ntext, "%s", reason);
}

int pm_route_text(int route, int64_t ntext, int8_t *text)
{
    const char *known = route >= 0 && route < PM_ROUTES ? scope[route] : "nothing: there is no such route";
    return snprintf((char *)text, (size_t)ntext, "%s", known);
}

static int fires_at_start(const pm_model *m, int event)
{
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        const int first = PM_EVENT_ROW(m, event)[PM_EVENT_NTH] <= 1;
        if (e[PM_TRIGGER_KIND] == PM_TRIGGER_START && e[PM_TRIGGER_EVENT] == event) return first;
    }
    return 0;
}

/* A group of `until` whose events all fire at the start. */
static int ends_at_start(const pm_model *m, int group)
{
    int any = 0;
    for (int i = 0; i < m->rows[PM_TABLE_UNTIL]; i++) {
        const int32_t *e = PM_UNTIL_ROW(m, i);
        if (e[PM_UNTIL_GROUP] != group) continue;
        if (e[PM_UNTIL_NTH] > 1 || !fires_at_start(m, e[PM_UNTIL_EVENT])) return 0;
        any = 1;
    }
    return any;
}

int pm_plan_kinematic(const pm_model *m, const struct pm_ask_set *ask)
{
    int ends = 0;
    if (m->nslot > 0 || m->nfriction > 0 || ask->instant_level > PM_LEVEL_KINEMATIC) return 0;
    for (int i = 0; i < m->rows[PM_TABLE_UNTIL] && !ends; i++)
        ends = ends_at_start(m, PM_UNTIL_ROW(m, i)[PM_UNTIL_GROUP]);
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER] && ends; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        const int program = e[PM_TRIGGER_KIND] <= PM_TRIGGER_EVERY;
        if (e[PM_TRIGGER_KIND] == PM_TRIGGER_REST) return 0;
        if (program && m->programs.level[e[PM_TRIGGER_PROGRAM]] > PM_LEVEL_KINEMATIC) return 0;
    }
    return ends;
}

void pm_plan_no_phase(pm_result *result)
{
    const int route = result->count[PM_COUNT_JUMPS] > 0 ? PM_ROUTE_JUMP : PM_ROUTE_STATE;
    result->count[PM_COUNT_ROUTE] = route;
    result->count[PM_COUNT_ROUTES] = (int64_t)1 << route;
}

int pm_plan_end(const pm_model *model, pm_result *result, int status)
{
    const int wanted = PM_SETTING(model, PM_SETTING_ROUTE);
    const int in_time = wanted == PM_ROUTE_RK || wanted == PM_ROUTE_IDA;
    if (status != PM_OK || !in_time || result->count[PM_COUNT_PHASES] > 0) return status;
    return pm_fail(result, PM_NO_TIME_ROUTE, PM_TABLE_SETTING, PM_SETTING_ROUTE, wanted, NAN);
}
