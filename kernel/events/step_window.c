/* step_window.c - windows until the samples show all.
 *
 * Where a switch is known to be next, a window ends before it, and one about it is as short as it can be: that one is taken as
 * it is.  Else a window is halved until its samples show all; the next ones grow again.  What is never shown, such as a pole,
 * is taken as it is in the least window; least windows grow where they follow each other, so that what stays on its switch is
 * passed, too. */
#include "events/step_window.h"

#include <math.h>

#include "events/ask.h"
#include "events/event.h"
#include "events/event_search.h"
#include "events/waves.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"

/* Half the window about a switch: doubles of the time must tell it. */
static double about_switch(const pm_step *s)
{
    const double part = PM_WINDOW_SWITCH * (s->whole_end - s->whole_begin);
    return pm_max(part, 16 * PM_EPSILON * pm_max(fabs(s->begin), fabs(s->end)));
}

/* Where the window ends that begins like one that does not show all; *as_it_is: it will not show it, either. */
static double shorter_end(pm_workspace *w, int *as_it_is)
{
    pm_step *s = &w->step;
    const double length = s->end - s->begin, middle = s->begin + 0.5 * length, half = about_switch(s);
    const double place = length * pm_waves_first_switch(w, w->event->nsampled > 0, w->ask->nobserver > 0);
    *as_it_is = place <= 2 * half;
    if (*as_it_is) return s->begin + pm_min(s->stuck * 4 * half, length);
    if (place < length) return s->begin + place - half;
    s->reach = 0.5 * length;
    return middle > s->begin && middle < s->end ? middle : s->end;
}

/* Samples [begin, end], a shorter part of it, or less of it still. */
static int take(pm_workspace *w)
{
    pm_step *s = &w->step;
    int as_it_is = 0;
    for (;;) {
        const int status = pm_event_samples_fill(w, 1, &s->shown);
        if (s->shown) s->stuck = 1;
        if (status || s->shown || as_it_is) return status;
        if (s->end - s->begin <= s->least_window) {
            s->least_window *= 2; /* so that what is never shown is not met at its finest again and again */
            return PM_OK;
        }
        const double end = shorter_end(w, &as_it_is);
        if (as_it_is) s->stuck *= 2;
        if (!(end < s->end)) return PM_OK;
        s->end = end;
    }
}

int pm_step_window_first(pm_workspace *w)
{
    pm_step *s = &w->step;
    s->reach = s->end - s->begin;
    s->least_window = PM_WINDOW_LEAST * s->reach;
    s->stuck = 1;
    return take(w);
}

int pm_step_window_next(pm_workspace *w)
{
    pm_step *s = &w->step;
    s->begin = s->end;
    s->reach *= 2;
    s->end = pm_min(s->begin + s->reach, s->whole_end);
    w->result.count[PM_COUNT_STEPS]++;
    return take(w);
}
