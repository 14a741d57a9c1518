/* advance.c - steps until something happens.
 *
 * A step is taken, sampled and searched (event_search.h), as a whole or window by window (step_window.h).  Instants in it that
 * only mark something are passed, one after the other; at the first full one it is cut off, and the asks see what is left of
 * it. */
#include <math.h>
#include <string.h>

#include "elements/contact_pattern.h"
#include "equations/active_set.h"
#include "equations/case.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "events/ask.h"
#include "events/blows_left.h"
#include "events/bounce_series.h"
#include "events/event.h"
#include "events/event_multiple.h"
#include "events/event_search.h"
#include "events/history.h"
#include "events/integral_series.h"
#include "events/motion_course.h"
#include "events/step.h"
#include "events/step_window.h"
#include "events/time_course.h"
#include "impact/action.h"
#include "impact/instant.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "run/run.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

/* The exact state at x becomes the present one; it is already in w->probe if it was taken at x. */
static int stop_at(pm_workspace *w, double x, double taken)
{
    const int status = taken == x ? PM_OK : w->phase.route->exact(w, x, &w->probe);
    if (!status) pm_state_copy(&w->state, &w->probe);
    return status;
}

static void look_for_roots(pm_event_set *e, int due)
{
    e->at_root = 0;
    e->at_due = due;
    for (int i = 0; i < e->nfunction; i++) {
        e->hit[i] = 0;
        e->at_root |= e->root[i] != 0;
    }
}

/* A route that finds roots itself has ended its step there, unless something that is sampled comes first. */
static void take_roots(const pm_step *step, pm_event_set *e, double *first)
{
    if (!e->at_root || *first < step->whole_end || !pm_step_is_last(step)) return;
    for (int i = 0; i < e->nfunction; i++) e->hit[i] |= e->root[i] != 0;
    *first = step->end;
}

static void mark_hits(pm_firing *firing, pm_event_set *e)
{
    for (int i = 0; i < e->nfunction; i++)
        if (e->hit[i] && e->function[i].kind == FUNCTION_TRIGGER) {
            firing->fired[e->function[i].index] = 1;
            pm_event_multiple_reach(e, &e->function[i]);
        }
}

static double next_due(const pm_workspace *w)
{
    double next = pm_min(pm_blows_left_next(w), pm_bounce_series_next(w));
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) next = pm_min(w->event->due[i], next);
    return next;
}

/* The step has ended when triggers on time are due. */
static int mark_due(pm_workspace *w)
{
    pm_integral_series_end(w);
    int any = pm_blows_left_strike(w) | pm_bounce_series_end(w);
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        if (w->event->due[i] > w->state.t) continue;
        w->firing.fired[i] = 1;
        w->event->due[i] = INFINITY;
        any = 1;
    }
    return any;
}

/* The time to which the next step may go. */
static double time_limit(pm_workspace *w, double max_time)
{
    if (!w->phase.route->in_time) return max_time;
    const double length = w->event->first_step ? 0 : w->step.whole_end - w->step.whole_begin;
    const double due = fmin(max_time, next_due(w));
    const double limit = fmin(pm_time_course_limit(w, length), w->state.t + pm_motion_course_limit(w));
    return limit < due - PM_TIME_TOGETHER * fabs(due) ? limit : due;
}

static int steps_left(pm_workspace *w)
{
    const int early = pm_fail_early(&w->result, &w->patience);
    if (early) return early;
    const double most = fmin(PM_SETTING(w->model, PM_SETTING_MAX_STEPS),
                             w->evidence.active ? w->evidence.most_steps : INFINITY);
    if ((double)w->result.count[PM_COUNT_STEPS] >= most)
        return pm_fail(&w->result, PM_LIMIT_STEPS, PM_TABLE_SETTING, 0, most, most);
    return PM_OK;
}

static int limit_reached(pm_workspace *w, double max_time)
{
    if (!pm_fail_early(&w->result, &w->patience) && w->state.t >= max_time)
        return pm_fail(&w->result, PM_LIMIT_TIME, PM_TABLE_SETTING, 0, w->state.t, max_time);
    return steps_left(w);
}

static void end_step(pm_workspace *w)
{
    pm_frame_look_state(&w->frame, &w->state);
    pm_active_set_follow(&w->frame, &w->active, &w->state);
    pm_ledger_step(w);
    if (w->phase.route->in_time && w->ask->fresh && pm_ledger_closes(w)) pm_ask_seal(w->model, w->ask);
}

static int only_marks(const pm_model *m, const pm_event_set *event)
{
    if (m->programs.watch_counts) return 0;
    for (int i = 0; i < event->nfunction; i++) {
        const pm_event_function *f = &event->function[i];
        if (!event->hit[i]) continue;
        if (f->kind != FUNCTION_TRIGGER) return 0;
        const int of = PM_TRIGGER_ROW(m, f->index)[PM_TRIGGER_EVENT];
        if (PM_EVENT_ROW(m, of)[PM_EVENT_EFFECT] != PM_EFFECT_NONE || (m->acts && pm_action_of(m, of)))
            return 0;
    }
    return 1;
}

/* What has just fired must be left before it fires again.  x is where it is zero exactly; further zeros are looked for on
 * the dense output, which may have the same one a little later. */
static void hold_hits(pm_workspace *w, double x)
{
    pm_event_set *e = w->event;
    for (int i = 0; i < e->nfunction; i++) {
        if (!e->hit[i]) continue;
        pm_event_sides_fired(&e->function[i]);
        pm_event_hold(&e->function[i], fmax(x, e->function[i].located));
    }
    memset(w->firing.fired, 0, (size_t)w->model->rows[PM_TABLE_TRIGGER]);
}

/* Something is marked at x inside the step and the motion goes on: no blow, no change of modes, no new phase. */
static int pass(pm_workspace *w, double x, double taken, int *ended)
{
    int status = pm_history_inside(w, x);
    if (!status && (taken != x || w->record.history)) status = w->phase.route->exact(w, x, &w->probe);
    if (status) return status;
    pm_state_copy(&w->ahead, &w->state);
    pm_state_copy(&w->state, &w->probe);
    mark_hits(&w->firing, w->event);
    status = pm_instant_mark(w, ended);
    if (*ended) return status;
    hold_hits(w, x);
    pm_state_copy(&w->state, &w->ahead);
    return status;
}

/* What fires right before the step's end, where triggers on time are due or a contact changes, belongs to that instant. */
static void join_end(const pm_workspace *w, double *first)
{
    const double same = PM_SAME_PLACE * (w->step.end - w->step.begin);
    if (!pm_step_is_last(&w->step)) return;
    const int something = w->event->at_root || w->event->at_due;
    if (something && *first >= w->step.end - same) *first = w->step.end;
}

/* What happens at the end of the step, found there, only marks something, and the phase goes on in another step. */
static int marks_end(const pm_workspace *w, double first, int due)
{
    return first == w->step.end && !due && !w->step.reverses && !w->phase.lap && !w->event->at_root &&
           only_marks(w->model, w->event);
}

/* Something is marked at the end of the step, where the frame looks. */
static int pass_end(pm_workspace *w, int *ended)
{
    const int status = pm_instant_mark(w, ended);
    if (status || *ended) return status;
    hold_hits(w, w->step.end);
    pm_event_search_leave(
        &w->step, w->event); /* what has left its zero is no more held; in the next step places are others */
    return PM_OK;
}

/* Passes the instants of the step that only mark something; *first is that of a full one, or of the end. */
static int pass_marks(pm_workspace *w, double *first, double *taken, int *ended)
{
    double from = w->step.begin;
    for (;;) {
        int status = pm_fail_early(&w->result, &w->patience);
        if (!status) status = pm_event_search_first(w, from, first, taken);
        if (!status) status = pm_fail_early(&w->result, &w->patience); /* a gap may not have been found */
        if (!status && *first < INFINITY) join_end(w, first);
        if (status || *first >= w->step.whole_end || *first <= w->step.begin ||
            !only_marks(w->model, w->event))
            return status;
        status = pass(w, *first, *taken, ended);
        if (status || *ended) return status;
        from = *first;
    }
}

/* A step of the route; once more from where it began, but shorter, as long as its samples do not show the forces that read the motion. */
static int step_of_route(pm_workspace *w, double limit)
{
    const int needed = pm_motion_course_is_needed(w);
    if (needed) pm_state_copy(&w->ahead, &w->state);
    int status = w->phase.route->step(w, limit);
    while (needed && !status && !pm_motion_course_shown(w, &w->ahead, &limit)) {
        pm_state_copy(&w->state, &w->ahead);
        pm_frame_look_state(&w->frame, &w->state);
        status = pm_saddle_accelerate(w);
        if (!status) status = w->phase.route->begin(w);
        if (!status) status = w->phase.route->step(w, limit);
    }
    return status;
}

/* The next step of the route, sampled as far as the nodes show it. */
static int make_step(pm_workspace *w)
{
    pm_event_set *e = w->event;
    const double max_time = pm_case_max_time(w->model, &w->numbers);
    int status = limit_reached(w, max_time);
    if (status) return status;
    memset(e->root, 0, (size_t)e->nfunction * sizeof(int));
    if (!e->first_step) pm_frame_look_state(&w->frame, &w->state);
    w->step.nodes = w->phase.route->nodes;
    status = step_of_route(w, time_limit(w, max_time));
    pm_history_step(&w->step, &w->record);
    look_for_roots(w->event, w->phase.route->in_time && next_due(w) <= w->state.t);
    return status ? status : pm_step_window_first(w);
}

/* What is left of the step that was looked at in part. */
static int go_on_in_step(pm_workspace *w)
{
    const int status = steps_left(w);
    return status ? status : pm_step_window_next(w);
}

/* A step of the route or a window of it, sampled; its instants that only mark something are passed.  *first: where the phase
 * may end, at `taken` if the state was taken there already. */
static int take_step(pm_workspace *w, double *first, double *taken, int *ended)
{
    int status = w->event->first_step || pm_step_is_last(&w->step) ? make_step(w) : go_on_in_step(w);
    if (status || w->event->nsampled == 0) return status;
    if (w->phase.route->sampled) w->phase.route->sampled(w);
    status = pass_marks(w, first, taken, ended);
    pm_event_search_keep_sides(w, *first);
    if (!status) pm_event_search_leave(&w->step, w->event);
    return status;
}

/* The step, or a window of it, ends at `first` if that is inside, and w->state is there; the asks see it up to there. */
static int close_step(pm_workspace *w, double first, double taken, int ended)
{
    int status = PM_OK, shown;
    if (first < w->step.whole_end) {
        if (!ended && (status = stop_at(w, first, taken))) return status;
        pm_step_set(&w->step, w->step.begin, first);
        if (!pm_ask_keeps_samples(&w->step, w->ask) && (status = pm_event_samples_fill(w, 0, &shown)))
            return status;
    }
    if (w->step.end > w->step.begin && (status = pm_ask_step(w))) return status;
    if ((status = pm_history_inside(w, w->step.end)) || !pm_step_is_last(&w->step)) return status;
    end_step(w);
    return pm_contact_pattern_check(w);
}

/* What is due within rounding of now happens now: no step fits between. */
static int is_due_now(pm_workspace *w)
{
    const double due = next_due(w);
    if (!w->phase.route->in_time || due - w->state.t > PM_TIME_TOGETHER * fabs(w->state.t)) return 0;
    w->state.t = fmax(w->state.t, due);
    return mark_due(w);
}

int pm_advance(pm_workspace *w, int *ended)
{
    *ended = 0;
    if (is_due_now(w)) return PM_OK;
    for (;;) {
        double first = INFINITY, taken = NAN;
        int status = take_step(w, &first, &taken, ended);
        if (status) return status;
        if (!*ended) take_roots(&w->step, w->event, &first);
        const int inside = first < w->step.whole_end;
        if ((status = close_step(w, first, taken, *ended))) return status;
        w->event->first_step = 0;
        if (!pm_step_is_last(&w->step)) continue;
        const int due = (first >= w->step.end && mark_due(w)) | pm_time_course_switch(w);
        if (*ended) return PM_OK;
        if (first < INFINITY) mark_hits(&w->firing, w->event);
        if (!inside && marks_end(w, first, due)) {
            if ((status = pass_end(w, ended)) || *ended) return status;
            continue;
        }
        if (first < INFINITY || due || w->step.reverses) {
            w->phase.lap = 0;
            return PM_OK;
        }
        w->phase.lap |= pm_plan_has_passed(w);
        if (!w->phase.lap && w->phase.route->in_time && (status = pm_active_set_renew(w, &w->phase.lap)))
            return status;
        if (w->phase.lap) return PM_OK;
        if (w->record.history && (status = pm_history_append(w, 0))) return status;
    }
}
