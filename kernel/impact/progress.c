/* progress.c - whether a motion gets on from one instant to the next. */
#include "impact/progress.h"

#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "events/event.h"
#include "impact/instant.h"
#include "numerics/tolerances_impact.h"
#include "state/route.h"
#include "state/workspace.h"

static int contact_hit(const pm_workspace *w)
{
    const pm_event_set *e = w->event;
    for (int i = e->ntrigger; i < e->nfunction; i++)
        if (e->hit[i] && e->function[i].kind == FUNCTION_GAP) return e->function[i].index;
    for (int i = e->ntrigger; i < e->nfunction; i++)
        if (e->hit[i] && pm_event_contact_change(e, i) != PM_NONE)
            return pm_contact_of_slot(w->model, e->function[i].index);
    return PM_NONE;
}

/* A rough contact whose load vanishes can neither push nor let go while its friction is needed (contact_modes_solve.c): what
 * pushes by rounding alone only puts that off. */
static int rough_lets_go(const pm_workspace *w)
{
    const pm_event_set *e = w->event;
    for (int i = e->ntrigger; i < e->nfunction; i++)
        if (e->hit[i] && e->function[i].kind == FUNCTION_NORMAL &&
            pm_contact_friction(w->model, pm_contact_of_slot(w->model, e->function[i].index)) ==
                PM_FRICTION_ROUGH)
            return 1;
    return 0;
}

/* Contacts that close again and again and are left open each time: nothing else goes on. */
static void note_vain(pm_workspace *w)
{
    const pm_event_set *e = w->event;
    for (int i = e->ntrigger; i < e->nfunction; i++) {
        const int contact = e->function[i].index;
        if (e->hit[i] && e->function[i].kind == FUNCTION_GAP &&
            pm_contact_is_open(w->model, &w->state, contact) && e->vain[contact] < PM_VAIN_MOST)
            e->vain[contact]++;
    }
}

static void forget_vain(pm_workspace *w)
{
    memset(w->event->vain, 0, (size_t)w->model->rows[PM_TABLE_CONTACT]);
}

void pm_progress_begin(pm_workspace *w)
{
    w->instant.since = -1;
    forget_vain(w);
}

/* Modes that change in turn lead nowhere where no time passes between their instants; a route along a path may keep no
 * time, and gets on if it has gone some way. */
int pm_progress_check(pm_workspace *w)
{
    const int goes = !w->phase.route->in_time && w->step.whole_end > PM_AT_ONCE * w->numbers.size;
    if (goes || fabs(w->state.t - w->instant.since) > PM_AT_ONCE * fabs(w->state.t)) {
        w->instant.since = w->state.t;
        w->instant.at_once = w->instant.let_go = 0;
        forget_vain(w);
    }
    w->instant.let_go |= rough_lets_go(w);
    const int most = w->instant.let_go ? PM_LET_GO_AT_ONCE : PM_INSTANTS_AT_ONCE;
    if (++w->instant.at_once > PM_VAIN_INSTANTS) note_vain(w);
    if (w->instant.at_once < most) return PM_OK;
    const double many = (double)w->instant.at_once;
    const int status = pm_fail(&w->result, w->instant.let_go ? PM_ROUGH_IMPOSSIBLE : PM_ALTERNATES,
                               PM_TABLE_CONTACT, contact_hit(w), many, many);
    return pm_instant_jams(w, status);
}
