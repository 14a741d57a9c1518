/* flight_firings.c - what fires in each flight of a contact that bounces: as a speed changes its sign at its blow and at its top.
 *
 * The flights of a series are alike but for their size.  What has fired in the last ones, in each at the same part of it, fires in
 * those to come, if it waits for a zero that is at the end of the series. */
#include "events/flight_firings.h"

#include <math.h>
#include <string.h>

#include "elements/trigger.h"
#include "events/event.h"
#include "numerics/tolerances.h"
#include "state/arena.h"

#define PM_FIRINGS_KEPT 64 /* the last of a run */

struct pm_flight_firings {
    int n;
    int trigger[PM_FIRINGS_KEPT]; /* the latest last */
    double time[PM_FIRINGS_KEPT]; /* s */
};

int pm_flight_firings_create(pm_workspace *w) { return PM_ARENA_NEW(&w->memory, w->event->firings); }

void pm_flight_firings_forget(const pm_workspace *w) { w->event->firings->n = 0; }

/* The blows themselves are known, and what rests is at the end of all. */
static int is_of_flights(const pm_model *m, int trigger)
{
    const int32_t *e = PM_TRIGGER_ROW(m, trigger);
    const int kind = e[PM_TRIGGER_KIND];
    return kind != PM_TRIGGER_START && kind != PM_TRIGGER_STRIKE && kind != PM_TRIGGER_REST &&
           PM_EVENT_ROW(m, e[PM_TRIGGER_EVENT])[PM_EVENT_EFFECT] == PM_EFFECT_NONE &&
           !pm_trigger_on_time(m, trigger);
}

static void put(struct pm_flight_firings *x, int trigger, double time)
{
    if (x->n == PM_FIRINGS_KEPT) {
        x->n--;
        memmove(x->trigger, x->trigger + 1, (size_t)x->n * sizeof *x->trigger);
        memmove(x->time, x->time + 1, (size_t)x->n * sizeof *x->time);
    }
    x->trigger[x->n] = trigger;
    x->time[x->n++] = time;
}

void pm_flight_firings_note(const pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++)
        if (w->firing.fired[i] == PM_FIRED_NOW && is_of_flights(w->model, i))
            put(w->event->firings, i, w->state.t);
}

/* Part of the flight from s[1] to s[0], the later one, at which a trigger fires for the n-th time in it; not a number if it does not. */
static double phase_of(const struct pm_flight_firings *x, const double *s, int trigger, int n)
{
    for (int i = 0; i < x->n; i++)
        if (x->trigger[i] == trigger && x->time[i] >= s[1] && x->time[i] < s[0] && n-- == 0)
            return (x->time[i] - s[1]) / (s[0] - s[1]);
    return NAN;
}

int pm_flight_firings_find(const pm_workspace *w, int contact, pm_flight_firing *found)
{
    const struct pm_flight_firings *x = w->event->firings;
    const pm_bounce_series *series = &w->event->series[contact];
    const double *s = series->struck;
    int n = 0;
    for (int i = 0; i < x->n && series->known > 2; i++) {
        if (!(x->time[i] >= s[1] && x->time[i] < s[0])) continue;
        int before = 0;
        for (int k = 0; k < i; k++) before += x->trigger[k] == x->trigger[i] && x->time[k] >= s[1];
        const double phase = (x->time[i] - s[1]) / (s[0] - s[1]);
        const int again = fabs(phase_of(x, s + 1, x->trigger[i], before) - phase) <= PM_FIRINGS_ALIKE;
        if (again && n < PM_FIRINGS_MOST) found[n++] = (pm_flight_firing){x->trigger[i], phase};
    }
    return n;
}

int pm_flight_firings_last(pm_workspace *w, int trigger)
{
    const int kind = PM_TRIGGER_ROW(w->model, trigger)[PM_TRIGGER_KIND];
    if (kind > PM_TRIGGER_EVERY) return 1;
    const double p = pm_trigger_program(w, trigger), low = w->event->least[trigger],
                 high = w->event->greatest[trigger];
    const double off = fabs(kind == PM_TRIGGER_EVERY ? p - round(p) : p),
                 range = kind == PM_TRIGGER_EVERY ? high - low : fmax(-low, high);
    return off <= fmax(PM_FIRINGS_ON_ZERO * range, PM_ON_ZERO * w->firing.size[trigger]);
}
