/* event_search.c - which functions of a phase go through zero first in a step.
 *
 * Every function is sampled at the nodes of each step (event_samples.c).  A change of sign between two nodes, or a dip that
 * goes through zero, is bracketed (event_bracket.c) and located on the route's dense output; the first of all is then polished
 * on exact states (event_locate.c). */
#include "events/event_search.h"

#include <math.h>
#include <string.h>

#include "elements/capture.h"
#include "events/event_multiple.h"
#include "events/event_parts.h"
#include "events/step.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

/* Two points go by each other at a distance, or a strand is shortest, and not at its end: nothing happens. */
static int goes_by(pm_workspace *w, int i, double place)
{
    pm_event_function *f = &w->event->function[i];
    if (f->kind != FUNCTION_MEETING && f->kind != FUNCTION_STRAND) return 0;
    pm_event_samples_along(w, place, f);
    double nothing;
    if (f->kind == FUNCTION_STRAND) return pm_event_strand_left(w, f->index, &nothing) > nothing;
    return pm_capture_distance(&w->frame, f->index) > PM_POINTS_PASS * w->numbers.size;
}

/* A strand that was shortest at the place that was found, where the motion ends, was so before if it is longer between:
 * function i is then bracketed there. */
static int was_shortest_before(pm_workspace *w, int i)
{
    pm_event_function *f = &w->event->function[i];
    const double middle = 0.5 * (f->bracket.a + f->found);
    if (f->kind != FUNCTION_STRAND || !(middle > f->bracket.a && middle < f->found)) return 0;
    const double value = pm_event_samples_along(w, middle, f);
    if (!(value > 0 && f->bracket.ga < 0)) return 0;
    f->bracket.b = middle;
    f->bracket.gb = value;
    f->search = SEARCH_BRACKETED;
    return 1;
}

static int brackets_first(pm_workspace *w, int i, double from, pm_span *x)
{
    return w->event->function[i].every ? pm_event_multiple_first(w, i, pm_event_samples_along, x)
                                       : pm_event_bracket_first(w, i, from, x);
}

/* The first place of the step, after `from`, where something happens to function i; *x brackets it; or INFINITY.  What
 * was found from an earlier place on still holds, as long as the function has not fired. */
static int first_of(pm_workspace *w, int i, double from, double not_after, pm_span *x, double *place)
{
    pm_event_function *f = &w->event->function[i];
    *place = INFINITY;
    for (;;) {
        if (f->search == SEARCH_NONE)
            f->search = brackets_first(w, i, from, &f->bracket) ? SEARCH_BRACKETED : SEARCH_NO_ZERO;
        if (f->search == SEARCH_NO_ZERO || f->bracket.a > not_after) return PM_OK;
        *x = f->bracket;
        if (f->search == SEARCH_BRACKETED) {
            const int status = pm_event_locate_root(w, i, x, &f->found);
            if (status) return status;
            f->search = SEARCH_LOCATED;
        }
        if (!goes_by(w, i, f->found)) break;
        if (was_shortest_before(w, i)) continue;
        if (f->found <= from) return PM_OK; /* that place again */
        pm_event_hold(f, from = f->found);  /* as what has fired */
    }
    *place = f->found;
    return PM_OK;
}

/* The function that fires first: w->event->hit it and all that do at the same place; PM_NONE if none does. */
static int find_earliest(pm_workspace *w, double from, int *earliest, double *first, pm_span *of_first)
{
    pm_event_set *e = w->event;
    const double same = PM_SAME_PLACE * (w->step.end - w->step.begin);
    pm_span x;
    *earliest = PM_NONE;
    *first = INFINITY;
    for (int i = 0; i < e->nfunction; i++) {
        e->hit[i] = 0;
        if (!pm_event_samples_wanted(w->event, &e->function[i])) continue;
        double place;
        const int status = first_of(w, i, from, *first, &x, &place);
        if (status) return status;
        if (place == INFINITY) continue;
        if (place < *first - same)
            for (int k = 0; k < i; k++) e->hit[k] = 0;
        if (place > *first + same) continue;
        e->hit[i] = 1;
        e->function[i].located = place;
        if (place < *first) {
            *first = place;
            *earliest = i;
            *of_first = x;
        }
    }
    return PM_OK;
}

/* What has parted so slowly that on exact states no time shows in which it comes back has not bounced. */
static void note_spent(pm_event_set *e, const pm_step *step, int earliest, double first)
{
    const pm_event_function *f = &e->function[earliest];
    if (f->kind == FUNCTION_GAP && f->held && first <= step->begin) e->spent[f->index] = 1;
}

static int fires_alone(const pm_event_set *e, int i)
{
    for (int k = 0; k < e->nfunction; k++)
        if (e->hit[k] && k != i) return 0;
    return 1;
}

/* On exact states two points do not meet that did so on the dense output, but for its error: they go by. */
static int misses(pm_workspace *w, int i, double place, int *status)
{
    const pm_event_function *f = &w->event->function[i];
    *status = PM_OK;
    if (f->kind != FUNCTION_MEETING || place >= w->step.end || !fires_alone(w->event, i)) return 0;
    *status = pm_step_look_exactly(w, place, f->level);
    return !*status &&
           !pm_capture_meets(&w->numbers, &w->evidence, f->index, pm_capture_distance(&w->frame, f->index));
}

int pm_event_search_first(pm_workspace *w, double from, double *first, double *taken)
{
    pm_event_set *e = w->event;
    int earliest, status;
    pm_span x;
    for (;;) {
        status = find_earliest(w, from, &earliest, first, &x);
        if (status || earliest == PM_NONE || *first <= w->step.begin) return status;
        status = pm_event_locate_settle(w, earliest, &x, first, taken);
        if (status || !misses(w, earliest, *first, &status)) break;
        pm_event_hold(&e->function[earliest], pm_max(*first, e->function[earliest].located));
        /* where the distance of two points is rounding they go by each other all the time */
        if ((status = pm_fail_early(&w->result, &w->patience))) return status;
    }
    note_spent(e, &w->step, earliest, *first);
    return status;
}

void pm_event_search_keep_sides(pm_workspace *w, double first)
{
    pm_event_set *e = w->event;
    memset(e->came, 0, (size_t)w->model->rows[PM_TABLE_TRIGGER] * sizeof(double));
    e->came_jumps = w->result.count[PM_COUNT_JUMPS];
    for (int i = 0; i < e->ntrigger; i++) {
        const pm_event_function *f = &e->function[i];
        if (f->every) continue; /* it knows between which multiples it is */
        e->came[f->index] = pm_event_sides_last(&w->step, e, i, first);
    }
}

void pm_event_search_leave(const pm_step *step, pm_event_set *e)
{
    for (int i = 0; i < e->nfunction; i++) {
        pm_event_function *f = &e->function[i];
        if (!pm_event_samples_wanted(e, f)) continue;
        const double last = pm_event_of_sample(f, pm_event_samples(e, i)[step->nodes->n - 1]);
        if (pm_event_changes_sign(f) && !f->every)
            pm_event_sides_leave(step, e, i); /* others have one side alone */
        if (f->every ? !pm_event_multiple_holds(e, f, last) : fabs(last) > f->slack) f->held = 0;
        f->since = 0;
    }
}
