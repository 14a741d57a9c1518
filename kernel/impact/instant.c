/* instant.c - one instant: `before` values, blows, modes, firings, answers. */
#include "impact/instant.h"

#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "elements/trigger.h"
#include "equations/saddle.h"
#include "events/ask.h"
#include "events/blows_left.h"
#include "events/bounce_series.h"
#include "events/event.h"
#include "events/event_search.h"
#include "events/flight_firings.h"
#include "events/history.h"
#include "events/step.h"
#include "events/track.h"
#include "impact/action.h"
#include "impact/beyond.h"
#include "impact/contact_modes.h"
#include "impact/drives.h"
#include "impact/impact.h"
#include "impact/meeting.h"
#include "impact/progress.h"
#include "impact/switches.h"
#include "impact/table_ends.h"
#include "numerics/tolerances_impact.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"
#include "tree/tree.h"

static int at_rest(const pm_frame *frame, int body)
{
    const double speed = PM_AT_REST * frame->numbers->speed,
                 acceleration =
                     PM_AT_REST * frame->numbers->speed * frame->numbers->speed / frame->numbers->size;
    const int first = body == PM_NONE ? 0 : 3 * body, last = body == PM_NONE ? frame->model->nq : first + 3;
    for (int i = first; i < last; i++) {
        const double length = i % 3 == 2 ? frame->numbers->size : 1;
        if (fabs(frame->v[i]) * length > speed || fabs(frame->a[i]) * length > acceleration) return 0;
    }
    return 1;
}

/* A body, or PM_NONE: all of them. */
static int rests(const pm_workspace *w, int body)
{
    return at_rest(&w->frame, body) && !pm_bounce_series_moves(w, body);
}

static void mark_rest(pm_workspace *w)
{
    if (rests(w, PM_NONE)) pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_REST, PM_NONE);
    for (int i = 0; i < w->model->nbody; i++)
        if (rests(w, i)) pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_REST, i);
}

/* No contact has changed, and none is met. */
static int contacts_stay(const pm_workspace *w)
{
    int member;
    for (int i = 0; i < w->event->nfunction; i++)
        if (w->event->hit[i] && w->event->function[i].kind != FUNCTION_TRIGGER) return 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++)
        if (pm_contact_touches(&w->frame, &w->state, i, &member)) return 0;
    return 1;
}

/* Nothing can strike, part or slide, or nothing does; no loop can come to a singular position, and places on a path are
 * exact: bodies, constraints and reactions are as they were. */
static int is_settled(const pm_workspace *w)
{
    const pm_model *m = w->model;
    if (w->result.count[PM_COUNT_PHASES] == 0 || !w->phase.route->meets_places || w->tree->nloop > 0)
        return 0;
    return m->nfriction == 0 && m->nteeth == 0 && !m->acts && !m->programs.wait_for_counts &&
           (m->nslot == 0 || contacts_stay(w));
}

/* Blows, and the modes after them.  Where no motion goes on from there an impact without collision may. */
static int strike(pm_workspace *w, int *jumped)
{
    int driven, status = pm_drives_strike(w, &driven);
    if (!status) status = pm_impact(w, jumped);
    if (!status) *jumped += driven;
    if (!status && w->instant.jams) status = pm_impact_without_collision(w, (*jumped)++);
    w->instant.jams = 0;
    if (*jumped) pm_trigger_jump_sides(w);
    for (int i = 0; !status; i++) {
        status = pm_contact_modes_settle_beside(w);
        if (status != PM_PAINLEVE || i == w->model->nslot) return status;
        status = pm_impact_without_collision(w, (*jumped)++);
    }
    return status;
}

/* The same, and what fires by them.  Where nothing is struck as the run begins, what holds then has not become so. */
static int settle(pm_workspace *w, int begins)
{
    int jumped;
    const int status = strike(w, &jumped);
    if (status) return status;
    if (jumped) pm_bounce_series_cut(w);
    if (jumped) pm_blows_left_begin(w);
    pm_contact_modes_mark(w);
    if (begins && !jumped) pm_trigger_look_before(w);
    pm_trigger_look_after(w);
    return PM_OK;
}

/* Actions may make further events fire, which act at the same instant; each event acts once.  Only what then is at rest
 * is at rest. */
static int carry_out(pm_workspace *w)
{
    int acted, marked = 0, status;
    for (;;) {
        if ((status = pm_action_carry_out(w, &acted))) return status;
        if (acted) {
            if ((status = settle(w, 0))) return status;
        } else if (!marked) {
            mark_rest(w);
            marked = 1;
        } else {
            return PM_OK;
        }
    }
}

/* Fires what is due at the frame and answers for it. */
static void fire(pm_workspace *w)
{
    while (pm_trigger_count_marked(w) && w->model->programs.wait_for_counts) pm_trigger_look_after(w);
    pm_flight_firings_note(w);
    pm_event_evidence_close(w);
    for (int event = 0; event < w->model->rows[PM_TABLE_EVENT]; event++)
        if (w->firing.counted[event] == PM_COUNTED_FIRED) pm_ask_fired(w, event);
    pm_trigger_end_instant(w->model, &w->firing);
}

static int count(pm_workspace *w, int *ended)
{
    w->result.count[PM_COUNT_EVENTS]++;
    *ended = pm_trigger_until(w->model, &w->firing);
    const int most = PM_SETTING(w->model, PM_SETTING_MAX_EVENTS);
    if (!*ended && w->result.count[PM_COUNT_EVENTS] >= most)
        return pm_fail(&w->result, PM_LIMIT_EVENTS, PM_TABLE_SETTING, 0, most, most);
    return PM_OK;
}

static int close(pm_workspace *w, int *ended)
{
    fire(w);
    pm_ask_instant(w);
    return count(w, ended);
}

/* What the scene looks like before something happens to it. */
static int look_before(pm_workspace *w)
{
    pm_ask_look_before(w);
    pm_trigger_look_before(w);
    return pm_contact_modes_begin(w);
}

/* A blow and what is done because of it; what waits for a count of events fires, and acts, as these are counted.  Where it
 * fails, what was before it has been nevertheless. */
static int blow(pm_workspace *w, int begins)
{
    pm_action_instant(w->model, w->event);
    int status = settle(w, begins);
    if (!status && !begins) status = pm_beyond_leave_out(w);
    if (!status && w->model->acts) status = carry_out(w);
    while (!status && w->model->programs.wait_for_counts && pm_trigger_count_marked(w)) {
        pm_trigger_look_after(w);
        if (w->model->acts) status = carry_out(w);
    }
    for (int event = 0; status && event < w->model->rows[PM_TABLE_EVENT]; event++)
        if (pm_trigger_fires(w->model, &w->firing, event)) pm_ask_fails(w, event);
    return status;
}

/* Closes the instant of one blow and opens that of the next, at the same time. */
static int go_on(pm_workspace *w, int *ended)
{
    int status = close(w, ended);
    if (!status) status = pm_history_append(w, 2);
    pm_trigger_next_blow(w->model, &w->firing);
    if (status || *ended) return status;
    memset(w->event->hit, 0, (size_t)w->event->nfunction * sizeof(int));
    if ((status = pm_history_append(w, 1))) return status;
    return look_before(w);
}

/* What happens to the bodies, as the run begins or later.  The frame is DYNAMIC before and after. */
static int act(pm_workspace *w, int begins, int *ended)
{
    *ended = 0;
    pm_event_evidence_instant(w, 0);
    if (is_settled(w)) {
        pm_ask_look_before(w);
        return PM_OK;
    }
    int status = look_before(w);
    if (!status) status = blow(w, begins);
    for (int i = 1; !status && !*ended && pm_impact_goes_on(w); i++) {
        if (i == PM_BLOWS_AT_ONCE)
            return pm_fail(&w->result, PM_BLOWS_ENDLESS, PM_TABLE_CONTACT, PM_NONE, i, i);
        status = go_on(w, ended);
        if (!status && !*ended) status = blow(w, 0);
    }
    return status;
}

/* Nothing will change any more, and the end is not reached. */
static int check_rest(pm_workspace *w)
{
    if (w->model->programs.use_time || w->request.program != PM_NONE || !at_rest(&w->frame, PM_NONE))
        return PM_OK;
    if (pm_bounce_series_moves(w, PM_NONE)) return pm_bounce_series_check(w);
    return pm_fail(&w->result, PM_STAYS_AT_REST, PM_NONE, PM_NONE, w->state.t,
                   (double)w->result.count[PM_COUNT_STEPS]);
}

int pm_instant_finish(pm_workspace *w, int *ended)
{
    mark_rest(w);
    const int status = close(w, ended);
    return status || *ended ? status : check_rest(w);
}

int pm_instant_start(pm_workspace *w)
{
    pm_progress_begin(w);
    int ended; /* is set again when the start is closed */
    const int64_t jumps = w->result.count[PM_COUNT_JUMPS];
    pm_switches_begin(w);
    pm_trigger_mark_start(w);
    pm_history_open(w);
    int status = act(w, 1, &ended);
    if (!status) status = pm_switches_settle(w, 0);
    if (!status) status = pm_table_ends_leave(w);
    if (w->result.count[PM_COUNT_JUMPS] == jumps) pm_history_take_back(w->record.history);
    return status;
}

/* Where the motion reverses speeds are zero: triggers that read them change sign as the velocities do. */
static int mark_reversal(pm_workspace *w)
{
    const pm_model *m = w->model;
    double *velocity = w->frame.velocity;
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int kind = PM_TRIGGER_ROW(m, i)[PM_TRIGGER_KIND];
        double value[2];
        if (kind > PM_TRIGGER_FALL || w->firing.fired[i]) continue;
        for (int side = 0; side < 2; side++) {
            for (int k = 0; k < m->nq; k++)
                velocity[k] = (side ? -PM_REVERSAL : PM_REVERSAL) * w->step.reversed[k];
            const int status = pm_saddle_accelerate(w);
            if (status) return status;
            value[side] = pm_trigger_program(w, i);
        }
        const int rises = value[0] < 0 && value[1] > 0, falls = value[0] > 0 && value[1] < 0;
        w->firing.fired[i] =
            (unsigned char)((rises && kind != PM_TRIGGER_FALL) || (falls && kind != PM_TRIGGER_RISE));
    }
    for (int k = 0; k < m->nq; k++) velocity[k] = w->state.v[k];
    return pm_saddle_accelerate(w);
}

int pm_instant_jams(pm_workspace *w, int status)
{
    if (status != PM_STEP_TOO_SMALL && status != PM_SOLVER && status != PM_SINGULAR &&
        status != PM_ALTERNATES)
        return status;
    const int slot = pm_impact_jammed(w);
    if (slot == PM_NONE) return status;
    const int contact = pm_contact_of_slot(w->model, slot);
    w->instant.jams = PM_CONTACT_ROW(w->model, contact)[PM_CONTACT_PAINLEVE] == PM_PAINLEVE_STRIKES;
    if (w->instant.jams) return PM_OK;
    return pm_fail(&w->result, PM_PAINLEVE, PM_TABLE_CONTACT, contact, pm_contact_kinetic(&w->frame, contact),
                   1);
}

static int reads_accelerations(const pm_model *m, int trigger)
{
    const int32_t *e = PM_TRIGGER_ROW(m, trigger);
    return PM_EVENT_ROW(m, e[PM_TRIGGER_EVENT])[PM_EVENT_EFFECT] != PM_EFFECT_NONE ||
           (e[PM_TRIGGER_PROGRAM] != PM_NONE && m->programs.level[e[PM_TRIGGER_PROGRAM]] == PM_LEVEL_DYNAMIC);
}

/* Whether accelerations before what happens now are asked for: before a blow on a path as a rule they are not, and the modes after
 * it find their own. */
static int looks_at_accelerations(const pm_workspace *w)
{
    const pm_model *m = w->model;
    const pm_event_set *e = w->event;
    int strikes = 0;
    if (w->evidence.active || w->phase.route->in_time || w->phase.kinematic || m->acts || m->nfriction > 0 ||
        m->nteeth > 0 || w->ask->instant_level == PM_LEVEL_DYNAMIC)
        return 1;
    for (int i = 0; i < e->nfunction; i++) {
        if (!e->hit[i] || e->function[i].kind == FUNCTION_TRIGGER) continue;
        if (e->function[i].kind != FUNCTION_GAP) return 1;
        strikes = 1;
    }
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++)
        if (reads_accelerations(m, i)) return 1;
    return !strikes;
}

int pm_instant_full(pm_workspace *w, int *ended)
{
    *ended = 0;
    pm_blows_left_count(w);
    pm_frame_look_state(&w->frame, &w->state);
    int status = pm_progress_check(w);
    if (!status) status = pm_history_append(w, 1);
    if (!status && looks_at_accelerations(w)) status = pm_saddle_accelerate(w);
    if (!status) status = pm_meeting_reach(w);
    if (!status) status = pm_switches_check(w);
    if (!status) status = pm_switches_reach(w);
    if (!status) status = pm_event_check_strands(w);
    if (!status) status = pm_track_check(w);
    if (!status && w->step.reverses) status = mark_reversal(w);
    const int located = pm_event_evidence_located(w);
    const int64_t jumps = w->result.count[PM_COUNT_JUMPS];
    if (!status) status = act(w, 0, ended);
    if (located && w->result.count[PM_COUNT_JUMPS] > jumps) pm_event_evidence_jump(w);
    if (!status && !*ended) status = pm_switches_settle(w, 0);
    if (status || *ended) return status;
    status = pm_instant_finish(w, ended);
    if (!status && !*ended) status = pm_table_ends_leave(w);
    return status ? status : pm_history_append(w, 2);
}

/* What a mark needs to know: what is asked then; and where errors are estimated, how far all that is watched is from zero. */
static int level_of_mark(const pm_workspace *w)
{
    const int asked = w->ask->instant_level, watched = w->event->level;
    if (!w->evidence.active) return w->ask->fired_level;
    return asked > watched ? asked : watched;
}

/* Extremes and grids are those of the step: nothing jumps here. */
int pm_instant_mark(pm_workspace *w, int *ended)
{
    const int level = level_of_mark(w);
    int status = pm_history_append(w, 1);
    pm_blows_left_count(w);
    pm_frame_look_state(&w->frame, &w->state);
    if (!status && level == PM_LEVEL_DYNAMIC) status = pm_step_react(w);
    if (status) return status;
    pm_event_evidence_instant(w, 1);
    pm_ask_look_before(w);
    fire(w);
    status = count(w, ended);
    return status ? status : pm_history_append(w, 2);
}
