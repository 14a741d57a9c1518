/* switches.c - sides by a look a little ahead. */
#include "impact/switches.h"

#include <math.h>

#include "elements/trigger.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "numerics/tolerances.h"
#include "state/frame.h"

/* The event of a trigger that tells where a switch becomes positive; PM_NONE: it is another one. */
static int switch_of(const pm_model *m, int trigger)
{
    const int32_t *e = PM_TRIGGER_ROW(m, trigger);
    return e[PM_TRIGGER_KIND] == PM_TRIGGER_RISE && pm_trigger_of_switch(m, trigger) ? e[PM_TRIGGER_EVENT]
                                                                                     : PM_NONE;
}

/* The value of the switch a little later, by the accelerations of the frame. */
static int look_ahead(pm_workspace *w, int trigger, double *value)
{
    const double after = PM_SWITCH_LOOK * w->numbers.size / w->numbers.speed;
    pm_state_copy(&w->probe, &w->state);
    w->probe.t += after;
    for (int i = 0; i < w->model->nq; i++) {
        w->probe.q[i] += after * (w->state.v[i] + 0.5 * after * w->frame.a[i]);
        w->probe.v[i] += after * w->frame.a[i];
    }
    pm_frame_look_state(&w->frame, &w->probe);
    *value = pm_trigger_program(w, trigger);
    pm_frame_look_state(&w->frame, &w->state);
    return pm_saddle_accelerate(w);
}

static int side_of(double x) { return x > 0; }

/* The side to which the motion leads is kept if the force on it leads there, too. */
static int settle(pm_workspace *w, int trigger, int event)
{
    const double here = pm_trigger_program(w, trigger);
    double ahead, otherwise;
    int status = look_ahead(w, trigger, &ahead);
    if (status || fabs(here) > PM_SWITCH_ON_ZERO * fabs(ahead - here) || ahead == here) return status;
    if (side_of(ahead) == w->firing.side[event]) return PM_OK;
    w->firing.side[event] = !w->firing.side[event];
    if ((status = pm_saddle_accelerate(w)) || (status = look_ahead(w, trigger, &otherwise))) return status;
    if (side_of(otherwise) == w->firing.side[event] || otherwise == here) return PM_OK;
    return pm_fail(&w->result, PM_ALTERNATES, PM_TABLE_EVENT, event, 1, 1);
}

static int has_switched(const pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++)
        if (w->firing.fired[i] && pm_trigger_of_switch(w->model, i))
            return PM_TRIGGER_ROW(w->model, i)[PM_TRIGGER_EVENT];
    return PM_NONE;
}

int pm_switches_check(pm_workspace *w)
{
    const int event = has_switched(w);
    if (event == PM_NONE) return PM_OK;
    pm_instant *x = &w->instant;
    const double again = PM_SWITCH_AGAIN * w->numbers.size / w->numbers.speed;
    x->to_and_fro = fabs(w->state.t - x->switched) < again ? x->to_and_fro + 1 : 0;
    x->switched = w->state.t;
    if (x->to_and_fro < PM_SWITCHES_AT_ONCE) return PM_OK;
    const double many = (double)x->to_and_fro;
    return pm_fail(&w->result, PM_ALTERNATES, PM_TABLE_EVENT, event, many, many);
}

void pm_switches_begin(pm_workspace *w)
{
    w->instant.switched = -1;
    w->instant.to_and_fro = 0;
    pm_trigger_take_sides(w);
}

int pm_switches_settle(pm_workspace *w)
{
    int status = PM_OK;
    for (int i = 0; !status && i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int event = switch_of(w->model, i);
        if (event != PM_NONE) status = settle(w, i, event);
    }
    return status;
}
