/* path_error.c - errors along paths.
 *
 * Places on a path carry no error but rounding, save where the motion turns back (path_error_time.c); T does: it is rounded
 * with the energies that make it, in every step, and a blow that leaves m T_end leaves m times the error.  An answer f(place, T)
 * is then known to |df/dT| dT, by a difference.
 * The time's error is that of its quadrature, and what T makes of it; what is asked at a time is late by it
 * (path_error_time.c).  All this holds as long as places alone, or the time alone, decide when something happens; where
 * speeds or forces do, the run says nothing of its errors, and accuracy.c makes its coarse run.  Events that speeds or forces
 * fire may be counted, though: their functions are off by no more than their natural size times dT / T, and their counts are
 * right as long as none of their extremes lies that near to zero. */
#include "routes/path/path.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "elements/trigger.h"
#include "equations/saddle.h"
#include "equations/solve_cache.h"
#include "events/ask.h"
#include "events/event.h"
#include "expression/program.h"
#include "expression/program_class.h"
#include "impact/action.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

/* What closes loops is met to rounding: forces do work on what is left of it, at the worst place of the phase.  (It is no sum: the
 * energy is that of the first place.) */
static void take_loops(pm_workspace *w)
{
    const double more = w->tree->part.open - w->tree->part.known;
    double forces = 0;
    if (!(more > 0)) return;
    for (int i = 0; i < w->model->nq; i += 3) forces += pm_length(w->frame.f + i);
    w->path->error += more * forces;
    w->tree->part.known = w->tree->part.open;
}

/* What T is off by where the last digits of coordinates are lost: the place at which the phase before ended, and where its
 * constraints were met anew, are rounded, and forces do work on what is lost. */
static double rounding_of_place(const pm_workspace *w)
{
    const pm_place *x = &w->path->begin;
    double work = fabs(x->force * x->y[w->path->driver]);
    for (int i = 0; i < w->model->nq; i++) work += fabs(w->frame.f[i] * w->state.q[i]);
    return DBL_EPSILON * work;
}

void pm_path_error_begin(pm_workspace *w)
{
    pm_path *p = w->path;
    const double kinetic = p->begin.kinetic;
    const int is_first = w->result.count[PM_COUNT_PHASES] == 0;
    if (is_first) p->error = p->ended = p->clock.error = p->clock.unresolved = p->clock.greatest = 0;
    if (p->ended > 0) p->error *= kinetic / p->ended;
    p->ended = 0;
    p->error += PM_ENERGY_ROUNDINGS * kinetic + (is_first ? 0 : rounding_of_place(w));
    take_loops(w);
}

void pm_path_error_end(pm_workspace *w) { w->path->ended = pm_frame_kinetic(&w->frame, PM_NONE); }

/* The error of T in the step, of its greatest T. */
static double relative_error(const pm_path *p)
{
    double greatest = 0;
    for (int k = 0; k < p->nodes->n; k++) greatest = pm_max(p->node[k * p->every].kinetic, greatest);
    return greatest > 0 ? p->error / greatest : 0;
}

/* The time of the step: what its nodes do not resolve, and dt = -t dT / 2 T, where it rests at an end of the greatest T. */
static void step_of_clock(const pm_model *model, const pm_state *state, pm_path *p)
{
    double least = INFINITY, greatest = 0;
    if (p->balanced && model->programs.read_time) p->clock.error = INFINITY; /* it takes for ever to leave */
    if (p->clock.kind == PM_CLOCK_NONE) return;
    for (int k = 0; k < p->nodes->n; k++) {
        least = pm_min(p->node[k * p->every].kinetic, least);
        greatest = pm_max(p->node[k * p->every].kinetic, greatest);
    }
    const double by = p->clock.kind == PM_CLOCK_PLAIN ? least : greatest / PM_ERROR_RESTING;
    const double dt = state->t - p->clock.t0, unresolved = dt * PM_ERROR_UNRESOLVED * p->clock.tail;
    p->clock.error += unresolved + 0.5 * dt * p->error / by;
    p->clock.unresolved += unresolved;
    p->clock.greatest = pm_max(unresolved, p->clock.greatest);
}

double pm_path_error_unresolved(const pm_clock *clock)
{
    return pm_max(PM_CLOCK_LIKELY * clock->unresolved, clock->greatest);
}

double pm_path_error_after(const pm_path *p, double kinetic)
{
    const double potential = p->by_work ? 0 : fabs(p->node[0].potential);
    return p->error + PM_ENERGY_ROUNDINGS * (p->node[0].kinetic + kinetic + potential);
}

void pm_path_error_step(pm_workspace *w, double kinetic)
{
    pm_path *p = w->path;
    p->error = pm_path_error_after(p, kinetic);
    take_loops(w);
    step_of_clock(w->model, &w->state, p);
    if (w->evidence.active && w->state.t > 0)
        w->evidence.present->late = pm_path_error_unresolved(&p->clock) / w->state.t;
    if (w->evidence.active)
        w->evidence.present->relative = pm_max(relative_error(p), w->evidence.present->relative);
}

void pm_path_error_barrier(pm_evidence *evidence, const pm_path *path, double distance)
{
    pm_evidence_decide(evidence, distance, path->error);
}

/* ---- do places alone decide? ---- */
/* Counts are read by what is an integer or a yes or no itself, and decide nothing in the run; nobody reads the times. */
static int only_counted(const pm_model *m)
{
    if (m->programs.watch_counts) return 0;
    for (int i = 0; i < m->rows[PM_TABLE_MEASURE]; i++)
        if (PM_MEASURE_ROW(m, i)[PM_MEASURE_KIND] == PM_MEASURE_EVENT_TIME) return 0;
    for (int i = 0; i < m->rows[PM_TABLE_PROGRAM]; i++)
        if (pm_program_class_reads_counts(m, i) && !pm_program_class_is_discrete(m, i)) return 0;
    return 1;
}

/* An event that is only watched: nothing ends or acts, and nothing is asked or known of the instants when it fires. */
static int only_watched(const pm_model *m, int event)
{
    for (int i = 0; i < m->rows[PM_TABLE_UNTIL]; i++)
        if (PM_UNTIL_ROW(m, i)[PM_UNTIL_EVENT] == event) return 0;
    for (int i = 0; i < m->nask; i++)
        if (PM_ASK_ROW(m, i)[PM_ASK_EVENT_INDEX] == event) return 0;
    for (int i = 0; i < m->rows[PM_TABLE_ACTION]; i++)
        if (PM_ACTION_ROW(m, i)[PM_ACTION_EVENT] == event) return 0;
    return only_counted(m);
}

/* The time alone tells when it fires, and nothing comes of that but answers: no place goes with it. */
static int fires_by_time(const pm_model *m, int trigger)
{
    const int event = PM_TRIGGER_ROW(m, trigger)[PM_TRIGGER_EVENT];
    return pm_trigger_on_time(m, trigger) && PM_EVENT_ROW(m, event)[PM_EVENT_EFFECT] == PM_EFFECT_NONE &&
           !pm_action_of(m, event) && !m->programs.watch_counts && !m->programs.wait_for_counts;
}

/* Places tell when a trigger fires, or sqrt(T) does and it fires where the motion reverses. */
static int fires_by_place(const pm_model *m, const int32_t *e)
{
    const int kind = e[PM_TRIGGER_KIND], program = e[PM_TRIGGER_PROGRAM];
    if (kind > PM_TRIGGER_EVERY) return kind == PM_TRIGGER_START || kind == PM_TRIGGER_STRIKE;
    return m->programs.class[program] == PM_CLASS_PLACE ||
           m->programs.energy[program] == PM_ENERGY_CLASS_ROOT;
}

int pm_path_error_by_places(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        if (!fires_by_place(m, e) && !fires_by_time(m, i) && !only_watched(m, e[PM_TRIGGER_EVENT])) return 0;
    }
    return 1;
}

/* A function that is watched, at the nodes; how far it may be from the polynomial through them. */
typedef struct pm_approach {
    const double *value;
    double reach, remainder;
} pm_approach;

/* An extreme between node k and the next, at the root of the secant of the slopes. */
static void take_extreme(const pm_workspace *w, int trigger, const pm_approach *x, int k)
{
    const pm_chebyshev_nodes *nodes = w->step.nodes;
    double *extreme = w->evidence.present->extreme + trigger;
    const double a = pm_chebyshev_slope_at(nodes, x->value, k),
                 b = pm_chebyshev_slope_at(nodes, x->value, k + 1);
    if (a * b > 0) return;
    const double s = nodes->at[k] + (a == b ? 0 : a / (a - b)) * (nodes->at[k + 1] - nodes->at[k]);
    const double there = fabs(pm_chebyshev_value(nodes, x->value, 1, s)) - x->remainder;
    if (there <= 0 && x->remainder > 0) w->evidence.present->unsure = 1;
    if (!(there < *extreme)) return;
    *extreme = there;
    extreme[w->model->rows[PM_TABLE_TRIGGER]] = x->reach;
}

/* Extremes near zero are beside nodes that are nearer to it than those next to them, and nearer by less than these are
 * farther: what no node shows would not be resolved.  A corner may hide one that is nearer than the samples tell. */
static void take_extremes(const pm_workspace *w, int trigger, const double *value)
{
    const int n = w->step.nodes->n;
    const double *known = w->evidence.present->extreme + trigger;
    pm_approach x = {.value = value};
    for (int k = 0; k < n; k++) x.reach = pm_max(fabs(value[k]), x.reach);
    const double high = pm_chebyshev_high(w->step.nodes, value);
    x.remainder = high < PM_ERROR_EXACT * x.reach ? 0 : PM_ERROR_RESIDUAL * high;
    for (int k = 0; k < n; k++) {
        const double here = fabs(value[k]), before = fabs(value[k > 0 ? k - 1 : k + 1]),
                     after = fabs(value[k + 1 < n ? k + 1 : k - 1]);
        if (!(here <= before && here <= after)) continue;
        if (here - PM_ERROR_WIDE * (pm_max(before, after) - here) - x.remainder > *known) continue;
        if (k > 0) take_extreme(w, trigger, &x, k - 1);
        if (k + 1 < n) take_extreme(w, trigger, &x, k);
    }
}

void pm_path_error_sampled(pm_workspace *w)
{
    const pm_event_set *e = w->event;
    if (!w->evidence.active || !w->evidence.by_places) return;
    for (int i = 0; i < e->nfunction; i++) {
        const pm_event_function *f = &e->function[i];
        if (f->kind != FUNCTION_TRIGGER || fires_by_place(w->model, PM_TRIGGER_ROW(w->model, f->index)) ||
            pm_trigger_on_time(w->model, f->index)) /* the time has no extremes */
            continue;
        if (f->every)
            w->evidence.present->unsure = 1;
        else
            take_extremes(w, f->index, pm_event_samples(w->event, i));
    }
}

/* Gaps, and times since a jump, are values without a trigger: known as T is.  Of the place alone, and at a time besides, a
 * value is known as the time is. */
static int goes_with_energy(const pm_model *model, const pm_evidence_decision *x)
{
    if (x->trigger == PM_NONE) return x->kind == PM_EVIDENCE_VALUE;
    return x->kind != PM_EVIDENCE_RATE && !fires_by_place(model, PM_TRIGGER_ROW(model, x->trigger));
}

/* Values at instants are in the log; a rate tells nothing here that the extremes do not tell better. */
pm_closest pm_path_error_margin(const pm_model *model, const pm_pass *pass, const double *trigger_scale)
{
    const int ntrigger = model->rows[PM_TABLE_TRIGGER];
    const double relative = fmax(pass->relative, DBL_EPSILON);
    pm_closest closest = {INFINITY, NULL, PM_NONE, 0};
    for (int i = 0; i < pass->log.n; i++) {
        const pm_evidence_decision *x = &pass->log.entry[i];
        const int by_energy = goes_with_energy(model, x);
        if (!by_energy && x->error == 0) continue;
        const double unit = x->unit * (x->trigger == PM_NONE ? 1 : trigger_scale[x->trigger]);
        const double margin = fabs(x->distance) / ((by_energy ? unit * relative : 0) + x->error);
        if (pm_evidence_is_open(x, unit) && margin < closest.margin)
            closest = (pm_closest){margin, x, PM_NONE, 0};
    }
    for (int i = 0; i < ntrigger; i++) {
        const pm_evidence_decision x = {.reach = pass->extreme[ntrigger + i]};
        if (isinf(pass->extreme[i]) || !pm_evidence_is_open(&x, trigger_scale[i])) continue;
        const double margin = pass->extreme[i] / (trigger_scale[i] * relative);
        if (margin < closest.margin) closest = (pm_closest){margin, NULL, i, 0};
    }
    return closest;
}

/* ---- answers ---- */
static void shift_velocities(pm_frame *frame, double factor)
{
    for (int i = 0; i < frame->model->nq; i++) frame->velocity[i] = factor * frame->v[i];
}

/* The error of the clock in a program that reads nothing but the time, linearly; a given time has none. */
static double error_of_time(pm_workspace *w, int ask, int program, double value)
{
    pm_frame *f = &w->frame;
    if (pm_path_aside_is_timed(w, ask) && !pm_model_ask_is_extreme(PM_ASK_ROW(w->model, ask))) return 0;
    const double t = f->t, error = pm_path_aside_clock(w), shift = pm_max(error, t);
    if (!(shift > 0)) return 0;
    f->t = t + shift;
    const double changed = pm_program_run(w, program);
    f->t = t;
    return fabs(changed - value) / shift * error;
}

/* Inside a step nothing has jumped, and the route knows its own way. */
static int accelerate(pm_workspace *w)
{
    return w->frame.q == w->probe.q ? pm_path_react(w) : pm_saddle_accelerate(w);
}

/* The frame's accelerations and reactions, while others are looked at. */
static void set_aside(pm_workspace *w, double *keep)
{
    memcpy(keep, w->frame.a, (size_t)w->model->nq * sizeof *keep);
    memcpy(keep + w->model->nq, w->frame.lambda, (size_t)w->active.n * sizeof *keep);
    w->cache->closed = 1;
}

static void put_back(pm_workspace *w, const double *keep)
{
    memcpy(w->frame.a, keep, (size_t)w->model->nq * sizeof *keep);
    memcpy(w->frame.lambda, keep + w->model->nq, (size_t)w->active.n * sizeof *keep);
    w->cache->closed = 0;
}

/* The error of T at the frame: what a blow at the end of the phase leaves of T it leaves of its error. */
static double error_of_kinetic(const pm_path *p, double kinetic)
{
    return p->ended > 0 ? p->error * kinetic / p->ended : p->error;
}

/* By a difference in the speeds. */
static double error_of_motion(pm_workspace *w, int program, double value)
{
    const double kinetic = pm_frame_kinetic(&w->frame, PM_NONE);
    const int dynamic = w->model->programs.level[program] == PM_LEVEL_DYNAMIC;
    if (w->model->programs.energy[program] == PM_ENERGY_CLASS_NONE) return 0;
    if (w->model->programs.energy[program] == PM_ENERGY_CLASS_UNKNOWN || !(kinetic > 0)) return NAN;
    if (dynamic) set_aside(w, w->scratch);
    shift_velocities(&w->frame, 1 + PM_ERROR_FASTER);
    const int failed = dynamic && accelerate(w);
    const double changed = pm_program_run(w, program);
    shift_velocities(&w->frame, 1);
    if (dynamic) put_back(w, w->scratch);
    return failed
               ? NAN
               : fabs(changed - value) / (2 * PM_ERROR_FASTER * kinetic) * error_of_kinetic(w->path, kinetic);
}

static double error_of_state(pm_workspace *w, int ask, int column, double value)
{
    const int program = PM_ASK_ROW(w->model, ask)[PM_ASK_PROGRAM];
    if (w->model->programs.class[program] == PM_CLASS_CONSTANT) return 0;
    const double by_kinetic = error_of_motion(w, program, value);
    return pm_path_aside_is_timed(w, ask) ? pm_path_aside_error(w, ask, column, value, by_kinetic)
                                          : by_kinetic + pm_path_aside_turn(w, program, value);
}

/* Asked where another value has its extreme (a count has it where it is counted), or one of a list, and that goes with T: what T
 * and rounding make of the place the run does not tell, unless it is the time that is listed. */
static int is_at_other(const pm_model *m, int ask)
{
    const int32_t *row = PM_ASK_ROW(m, ask);
    if (pm_ask_at_extreme(row)) return !pm_program_class_is_discrete(m, row[PM_ASK_PROGRAM_2]);
    return row[PM_ASK_KIND] == PM_ASK_GRID && m->programs.class[row[PM_ASK_PROGRAM_2]] != PM_CLASS_TIME &&
           m->programs.energy[row[PM_ASK_PROGRAM_2]] != PM_ENERGY_CLASS_NONE;
}

void pm_path_error_answer(pm_workspace *w, int ask, int column, int program, double value)
{
    const pm_model *m = w->model;
    if (w->evidence.seeks) return; /* what is sought errs, and all with it: two finds are compared */
    if (!w->evidence.active || !w->evidence.by_places ||
        w->result.count[PM_COUNT_ROUTES] != (int64_t)1 << PM_ROUTE_PATH || is_at_other(m, ask))
        return;
    double error = 0; /* but for rounding; integers have the margin of their decisions */
    if (!isnan(value) && !w->evidence.discrete[ask])
        error = m->programs.class[program] == PM_CLASS_TIME ? error_of_time(w, ask, program, value)
                                                            : error_of_state(w, ask, column, value);
    pm_evidence_answer(&w->evidence, column, error);
}
