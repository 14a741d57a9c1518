/* beyond.c - what came to its zero as a phase ended, and does not go beyond it.
 *
 * A trigger fires where its value g goes through zero as the motion of the phase leads it.  Where the phase ends there - friction
 * stops a body, a contact closes - another motion goes on: the speed that became zero stays zero.  What it does is told by g a
 * little later on the new motion,
 *
 *   q + v d + a d^2 / 2,   v + a d
 *
 * beside what g changes by as places and speeds change by as much of their own sizes.  What has not gone beyond is held on its
 * zero, and still comes from where it came from: the next phase sees whether it goes through later. */
#include "impact/beyond.h"

#include <math.h>

#include "elements/trigger.h"
#include "equations/case.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "numerics/tolerances.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"

/* Something else than a trigger has ended the phase. */
static int changes_course(const pm_event_set *e, const pm_step *step)
{
    for (int i = e->ntrigger; i < e->nfunction; i++)
        if (e->hit[i]) return 1;
    return step->reverses;
}

/* It fires on the way up, or down, and reads places and speeds. */
static int may_stay(const pm_workspace *w, const pm_event_function *f)
{
    const int program = PM_TRIGGER_ROW(w->model, f->index)[PM_TRIGGER_PROGRAM];
    return w->firing.fired[f->index] == PM_FIRED_NOW && f->direction != 0 && !f->every &&
           w->model->programs.level[program] == PM_LEVEL_KINEMATIC &&
           !pm_trigger_on_time(w->model, f->index) && !pm_trigger_of_switch(w->model, f->index);
}

static int goes_beyond(pm_workspace *w, const pm_event_function *f, double here)
{
    const double natural = fabs(pm_event_value_at(w, f, &w->probe) - here);
    const double change = pm_event_value_at(w, f, &w->ahead) - here;
    if (f->direction * here > PM_EVENT_ON_ZERO * natural / PM_SHIFT) return 1; /* by a jump */
    return !isfinite(change) || !isfinite(natural) || f->direction * change > PM_BEYOND * natural;
}

int pm_beyond_leave_out(pm_workspace *w)
{
    const pm_event_set *e = w->event;
    int looked = 0;
    if (!changes_course(e, &w->step)) return PM_OK;
    for (int i = 0; i < e->ntrigger; i++) {
        const pm_event_function *f = &e->function[i];
        if (!e->hit[i] || !may_stay(w, f)) continue;
        if (!looked) {
            pm_case_later(w, pm_case_shift(w, &w->probe) * w->numbers.size / w->numbers.speed, &w->ahead);
            looked = 1;
        }
        if (!goes_beyond(w, f, pm_event_value_at(w, f, &w->state)))
            w->firing.fired[f->index] = PM_FIRED_SHORT;
    }
    if (!looked) return PM_OK;
    pm_frame_look_state(&w->frame, &w->state);
    return pm_saddle_accelerate(w);
}
