/* run.c - begin -> phase -> event -> jump -> modes -> next phase.  The table of contents of a run. */
#include "run/run.h"

#include <math.h>
#include <string.h>

#include "elements/joint_friction.h"
#include "elements/trigger.h"
#include "equations/active_set.h"
#include "equations/case.h"
#include "equations/fixed_bodies.h"
#include "equations/gap_bounds.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "equations/solve_cache.h"
#include "events/ask.h"
#include "events/blows_left.h"
#include "events/bounce_series.h"
#include "events/event.h"
#include "events/flight_firings.h"
#include "events/history.h"
#include "events/motion_course.h"
#include "events/time_course.h"
#include "impact/instant.h"
#include "numerics/tolerances.h"
#include "routes/path/repeat.h"
#include "routes/path/repeat_rest.h"
#include "routes/start/equilibrium.h"
#include "routes/start/perturbation.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/modes.h"
#include "state/route.h"
#include "state/workspace.h"

static const pm_where nowhere = {PM_NONE, PM_NONE, PM_NONE, NAN, NAN};

static void forget_segments(pm_workspace *w)
{
    pm_repeat_forget(w->repeat);
    pm_repeat_rest_forget(w->repeat->rest);
}

static int begin_case(pm_workspace *w, const double *param, pm_start_report *report)
{
    pm_ask_reset(w);
    for (int i = 0; i < PM_AUDITS; i++) w->result.audit[i] = NAN;
    memset(w->result.count, 0, sizeof w->result.count);
    w->result.where = w->result.ordered = nowhere;
    w->impulses.energy_lost = 0;
    w->state.t = 0; /* a case that fails before its start reports no time of another */
    pm_solve_cache_forget(w->cache);
    pm_saddle_forget(&w->saddle);
    w->phase.price = w->phase.lap = w->phase.path_left = w->phase.singular = 0;
    w->phase.stiff = PM_NOT_STIFF;
    w->phase.route = pm_routes_default(w->model); /* until the first phase is planned */
    pm_routes_forget(w);
    forget_segments(w);
    w->event->nfunction = 0;
    pm_bounce_series_begin(w);
    pm_blows_left_forget(w);
    pm_flight_firings_forget(w);
    w->step.reverses = 0;
    pm_joint_friction_release(w);
    pm_evidence_begin(w->model, &w->evidence);
    pm_trigger_reset(w->model, &w->firing);
    pm_perturbation_begin(w->model, &w->request);
    pm_fixed_bodies_begin(w);
    memset(w->impulses.joint, 0, (size_t)w->model->njoint_constraint * sizeof(double));
    memset(w->impulses.friction, 0, (size_t)w->model->nfriction * sizeof(double));
    memset(w->impulses.slot, 0, 2 * (size_t)w->model->nslot * sizeof(double));
    w->impulses.nshared = 0;
    if (w->frame.modes) w->frame.modes->known = 0;
    int status = pm_case_begin(w, param);
    if (!status) pm_patience_limit(&w->patience, pm_case_max_cpu(w->model, &w->numbers));
    if (!status) pm_time_course_begin(w);
    if (!status) pm_motion_course_begin(w);
    if (!status) status = pm_start(w, report);
    return status;
}

/* At the state, with what switches on its side. */
static void look_at_forces(pm_workspace *w)
{
    pm_frame_look_state(&w->frame, &w->state);
    pm_trigger_take_sides(w);
    pm_speed_scale(w);
}

static int open_ledger(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_FORCE]; i++) {
        const pm_action x = pm_force_action(w, i);
        const double size = hypot(hypot(x.force[0], x.force[1]), x.couple);
        if (!isfinite(size)) return pm_fail(&w->result, PM_BAD_VALUE, PM_TABLE_FORCE, i, size, INFINITY);
        w->ledger.force_energy_start[i] = x.energy;
    }
    pm_ledger_begin(w);
    return PM_OK;
}

/* The constraints have just been built.  Before contacts and cords are closed, and joints that rub slip: what has no mass may need
 * them, friction may hold what reverses at a dead centre, and accelerations are not known yet. */
static int accelerate_unfastened(pm_workspace *w)
{
    const int status = pm_saddle_accelerate_projected(w);
    if (status != PM_SINGULAR || !(w->numbers.massless || w->model->nfriction > 0)) return status;
    w->result.where = nowhere;
    memset(w->frame.a, 0, (size_t)w->model->nq * sizeof(double));
    w->frame.level = PM_LEVEL_DYNAMIC;
    return PM_OK;
}

/* From the start that is assembled to an equilibrium near it. */
static int settle(pm_workspace *w, pm_start_report *report)
{
    if (!pm_equilibrium_wanted(w->model)) return PM_OK;
    look_at_forces(w);
    return pm_equilibrium_find(w, report);
}

/* All of the start but what happens at its instant. */
static int assemble(pm_workspace *w, const double *param, pm_start_report *report)
{
    int status = begin_case(w, param, report);
    if (status) return status;
    pm_fixed_bodies_find(w);
    if ((status = settle(w, report))) return status;
    pm_gap_bounds_drop(w);
    look_at_forces(w);
    if ((status = open_ledger(w))) return status;
    pm_frame_look_state(&w->frame, &w->state);
    pm_joint_friction_close(&w->frame, &w->state);
    w->phase.kinematic = pm_plan_kinematic(w->model, w->ask);
    status = pm_active_set_build(w);
    return !status && !w->phase.kinematic ? accelerate_unfastened(w) : status;
}

/* The instant of the start; an equilibrium is one by the laws of contacts, too. */
static int start_at_once(pm_workspace *w)
{
    const int status = pm_instant_start(w);
    return !status && pm_equilibrium_wanted(w->model) ? pm_equilibrium_check(w) : status;
}

/* What was found when the case had been given up does not count: a search may have been left (elements/pair.c). */
static int unless_given_up(pm_workspace *w, int status)
{
    const int early = pm_fail_early(&w->result, &w->patience);
    return early ? early : status;
}

int pm_run_start(pm_workspace *w, const double *param, pm_start_report *report)
{
    int status = unless_given_up(w, assemble(w, param, report));
    if (!status) status = unless_given_up(w, start_at_once(w));
    return status;
}

/* Segments, and periods of swings, that go like one before are passed over. */
static int pass_segments(pm_workspace *w, int *passed)
{
    const int status = pm_repeat_begin(w, passed);
    return status || *passed ? status : pm_repeat_rest_begin(w, passed);
}

static int phase(pm_workspace *w, int *ended)
{
    int passed = 0, status = pm_fail_early(&w->result, &w->patience);
    if (!status) status = pm_disturb(w);
    if (!status) status = pm_perturbation_leave(w);
    if (!status) status = pm_plan_phase(w);
    if (!status && w->phase.route->reuses_segments) {
        pm_frame_look_state(&w->frame, &w->state);
        status = pass_segments(w, &passed);
    } else {
        forget_segments(w);
    }
    if (!status && passed) status = pm_plan_phase(w);
    if (status) return status;
    pm_frame_look_state(&w->frame, &w->state);
    if ((status = pm_saddle_accelerate(w))) return status;
    pm_event_begin(w);
    if ((status = pm_event_check_unique(w))) return status;
    if (w->phase.lap)
        w->event->first_step = 0; /* the motion goes on: what is on zero need not be left first */
    w->phase.lap = 0;
    if ((status = w->phase.route->begin(w))) return status;
    w->result.count[PM_COUNT_PHASES]++;
    pm_perturbation_end(&w->request);
    if ((status = pm_phase_report_add(w))) return status;
    if ((status = pm_advance(w, ended)) || !*ended) return status;
    /* the end is inside a step: answers there may need accelerations, which a singular position does not give */
    pm_frame_look_state(&w->frame, &w->state);
    return w->ask->instant_level == PM_LEVEL_DYNAMIC ? pm_saddle_accelerate(w) : PM_OK;
}

/* A path that cannot be followed (it approaches an equilibrium for ever, its constraints are singular) is left to the next
 * rule, from where the last step ended. */
static int to_next_rule(pm_workspace *w, int status)
{
    const int lost = status == PM_STEP_TOO_SMALL || status == PM_SINGULAR || status == PM_ASSEMBLY;
    if (!lost || PM_SETTING(w->model, PM_SETTING_ROUTE) != PM_ROUTE_AUTO) return 0;
    w->phase.path_left = 1;
    w->result.where = nowhere;
    pm_frame_look_state(&w->frame, &w->state);
    return pm_active_set_build(w) == PM_OK;
}

/* Near a singular position there is no step that the route can make: the same phase goes on as the plan knows. */
static int to_passage(pm_phase *phase, pm_result *result, int status)
{
    const int lost = status == PM_STEP_TOO_SMALL || status == PM_SINGULAR || status == PM_SOLVER;
    if (!lost || !phase->singular) return 0;
    result->where = nowhere;
    phase->lap = 1;
    return 1;
}

/* A route that was taken because of stiffness and has lost its way leaves the rest to the one before. */
static int to_route_before(pm_phase *phase, pm_result *result, int status)
{
    const int lost = status == PM_STEP_TOO_SMALL || status == PM_SINGULAR || status == PM_SOLVER;
    if (!lost || phase->stiff != PM_STIFF) return 0;
    result->where = nowhere;
    phase->stiff = PM_STIFF_IN_VAIN;
    phase->lap = 1;
    return 1;
}

/* Whether another route goes on where the present one failed with this status. */
static int hand_over(pm_workspace *w, int status)
{
    switch ((enum pm_when_lost)w->phase.route->when_lost) {
    case PM_LOST_TO_NEXT_RULE: return to_next_rule(w, status);
    case PM_LOST_TO_PASSAGE:
        return to_passage(&w->phase, &w->result, status) || to_route_before(&w->phase, &w->result, status);
    case PM_LOST_FAILS: break;
    }
    return 0;
}

/* The phase, or a lap of it, ends at w->state: what repeats on a path begins here. */
static void close_segment(pm_workspace *w)
{
    if (!w->phase.lap && !w->phase.route->reuses_segments) return;
    pm_frame_look_state(&w->frame, &w->state);
    if (w->phase.route->reuses_segments) pm_repeat_end(w);
}

static int run_phases(pm_workspace *w)
{
    int64_t left =
        PM_NONE; /* phases when a route was left last: where none has begun since, there is no going on */
    int ended, status = pm_instant_finish(w, &ended);
    if (ended) pm_plan_no_phase(&w->result);
    if (!status) status = pm_history_append(w, 2);
    while (!status && !ended) {
        status = phase(w, &ended);
        if (status && w->result.count[PM_COUNT_PHASES] != left && hand_over(w, status)) {
            left = w->result.count[PM_COUNT_PHASES];
            status = PM_OK;
            continue;
        }
        if (status) status = pm_instant_jams(w, status);
        if (status || ended) break;
        close_segment(w);
        if (!w->phase.lap) status = pm_instant_full(w, &ended);
    }
    return status;
}

void pm_run_fail_asks(const pm_model *model, pm_result *result)
{
    for (int i = 0; i < model->nout; i++) result->out[i] = NAN;
    for (int i = 0; i < model->nask; i++) result->reason[i] = PM_REASON_FAILED;
}

/* An early stop keeps what was answered; what is asked at the end was not reached. */
static int end_early(pm_workspace *w, int status)
{
    const pm_where where = w->result.where; /* of the stop itself */
    (void)pm_history_end(w);                /* a state that has no accelerations has no row */
    const int audit = pm_ledger_close(w);
    pm_ask_keep(w, audit != PM_OK, audit ? PM_REASON_FAILED : PM_REASON_NOT_REACHED);
    /* of a strand's end, and of a singular position, the cause is known */
    if (audit && status != PM_STRAND_ENDS && status != PM_ENDS_SINGULAR) return audit;
    w->result.where = where;
    return status;
}

/* What was answered before a run failed stands if the ledgers closed after it: at the last accepted step, or earlier. */
static void keep_sound(pm_workspace *w, int status)
{
    const pm_where where = w->result.where; /* of the failure itself */
    const int sound = status == PM_AUDIT || pm_ledger_close(w) != PM_OK;
    w->result.where = where;
    pm_ask_keep(w, sound, PM_REASON_FAILED);
}

/* A route that integrates velocities knows next to nothing of them where its steps end at a singular position. */
static int ends_at_singular(pm_workspace *w)
{
    const int route = w->phase.route->route, steps = w->result.count[PM_COUNT_STEPS] > 0;
    if (!steps || (route != PM_ROUTE_RK && route != PM_ROUTE_IDA) || w->active.n == 0) return PM_OK;
    if (pm_saddle_independence_there(w, &w->state) < PM_RUN_ENDS_SINGULAR)
        return pm_fail(&w->result, PM_ENDS_SINGULAR, PM_NONE, PM_NONE, 0, 0);
    return w->ask->instant_level == PM_LEVEL_DYNAMIC ? pm_saddle_accelerate(w) : PM_OK;
}

static int end(pm_workspace *w)
{
    const int status = ends_at_singular(w);
    if (status) return status;
    pm_ask_end(w);
    return pm_ledger_close(w);
}

/* Where next to nothing of a constraint is left beside the others, velocities are rounding: no ledger closes, and what ida has
 * handed over there finds no step that is small enough.  (What began on rk may, in a pass at another tolerance.) */
static int explain(pm_workspace *w, int status)
{
    status = pm_event_explain_strand(w, status);
    if (status == PM_SINGULAR && w->result.count[PM_COUNT_STEPS] > 0) return PM_ENDS_SINGULAR;
    const int asked = PM_SETTING(w->model, PM_SETTING_ROUTE),
              handed = asked == PM_ROUTE_IDA && status == PM_STEP_TOO_SMALL;
    if (status != PM_AUDIT && !handed) return status;
    if (!(pm_saddle_independence_there(w, &w->state) < PM_RUN_SINGULAR)) return status;
    return pm_fail(&w->result, PM_ENDS_SINGULAR, PM_NONE, PM_NONE, 0, 0);
}

int pm_run(pm_workspace *w, const double *param)
{
    pm_start_report report;
    w->fixed->wanted = 1;
    int status = unless_given_up(w, assemble(w, param, &report));
    const int started = status == PM_OK, nothing = !started && w->patience.over;
    if (!status) status = unless_given_up(w, start_at_once(w));
    if (!status) status = run_phases(w);
    pm_phase_report_end(w);
    if (!status) status = end(w);
    if (status && started) status = explain(w, status);
    if (status > 0 && !nothing) status = end_early(w, status);
    if (status < 0 && started)
        keep_sound(w, status);
    else if (status < 0 || nothing)
        pm_run_fail_asks(w->model, &w->result);
    return status;
}
