/* step_window.c - windows are halved until the samples show all, and grow again behind.
 *
 * A corner or a pole is never shown: the window around it is halved down to the least, and taken as it is. */
#include "events/step_window.h"

#include "events/event_search.h"
#include "events/waves.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"

/* Samples [begin, end], a shorter part of it, or less of it still. */
static int take(pm_workspace *w)
{
    pm_step *s = &w->step;
    for (;;) {
        const int status = pm_event_samples_fill(w, 1, &s->shown);
        if (status || s->shown) return status;
        const double middle = s->begin + 0.5 * (s->end - s->begin);
        if (s->end - s->begin <= s->least_window || !(middle > s->begin && middle < s->end)) {
            s->least_window *= 2; /* so that what is never shown is not met at its finest again and again */
            return PM_OK;
        }
        s->end = middle;
    }
}

int pm_step_window_first(pm_workspace *w)
{
    w->step.least_window = PM_WINDOW_LEAST * (w->step.end - w->step.begin);
    return take(w);
}

int pm_step_window_next(pm_workspace *w)
{
    pm_step *s = &w->step;
    const double length = s->end - s->begin;
    s->begin = s->end;
    s->end = pm_min(s->begin + 2 * length, s->whole_end);
    w->result.count[PM_COUNT_STEPS]++;
    return take(w);
}
