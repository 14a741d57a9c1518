/* event_samples.c - what a phase watches, at the nodes of a step.
 *
 * The frame looks at every node once, as deep as any of the functions and asks needs it; contacts are sampled there, but
 * for those out of reach (gap_culling.h), and measures are read, with which the programs of triggers and asks are then run
 * over all nodes at once (watched_samples.h).  Where the nodes do not show all of it, and there are finer ones, these are
 * taken.
 *
 * The samples of one function are a polynomial p through the nodes.  At the nodes of a spectral route (chebyshev_nodes.h)
 * its highest Chebyshev coefficients over its greatest value, the tail, are about the relative error of p (chebyshev.c).  A
 * corner - the nearest of several members changes - leaves them large.  Equidistant nodes show nothing between them. */
#include "events/event_parts.h"

#include <math.h>
#include <string.h>

#include "elements/capture.h"
#include "elements/contact.h"
#include "elements/contact_pattern.h"
#include "elements/edge.h"
#include "events/ask.h"
#include "events/gap_passage.h"
#include "events/step.h"
#include "events/watched_samples.h"
#include "events/waves.h"
#include "expression/program_class.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/route.h"
#include "state/workspace.h"

/* ---- the samples of a step ---- */
/* Nothing is known of the step's zeros yet. */
static void begin_samples(pm_workspace *w)
{
    pm_event_set *e = w->event;
    for (int k = 0; k < w->step.nodes->n; k++) e->place[k] = pm_step_node(&w->step, k);
    for (int i = 0; i < e->nfunction; i++) {
        e->function[i].search = SEARCH_NONE;
        e->function[i].tail = -1;
        e->function[i].ranged = 0;
        e->function[i].turned = 0;
        e->function[i].ends = 0;
    }
    for (int i = 0; i < e->npattern; i++) e->near[i].n = -1;
    e->soonest = INFINITY;
    pm_gap_culling_step(&w->event->culling, w->model);
}

/* As pm_event_sample has it; where the circle is beside the pattern is kept, for pm_event_samples_of_member. */
static double sample_pattern(pm_workspace *w, const pm_event_function *f, int node)
{
    pm_beside *x = w->event->beside + f->pattern * PM_NODES_MOST + node;
    int member;
    *x = pm_contact_pattern_beside(&w->frame, f->index);
    const double gap = pm_contact_pattern_nearest_of(&w->frame, &w->state, f->index, x,
                                                     &w->event->near[f->pattern], &member);
    return isinf(gap) ? w->numbers.size : gap;
}

/* The functions of contacts and of frictions that are sampled, but for contacts out of reach, at a node of the step; the frame
 * looks there. */
static void sample_contacts(pm_workspace *w, int node)
{
    pm_event_set *e = w->event;
    for (int i = e->ntrigger; i < e->nfunction; i++) {
        const pm_event_function *f = &e->function[i];
        if (!pm_event_samples_wanted(w->event, f)) continue;
        if (f->kind == FUNCTION_MEETING && !pm_chebyshev_nodes_spectral(w->step.nodes))
            e->soonest = pm_min(pm_capture_soonest(&w->frame, &w->state, f->index), e->soonest);
        pm_event_samples(w->event, i)[node] =
            f->pattern == PM_NONE ? pm_event_sample(w, f) : sample_pattern(w, f, node);
        if (f->edge != PM_NONE)
            e->beside_edge[f->edge * PM_NODES_MOST + node] = pm_edge_beside(&w->frame, f->index);
    }
}

/* Whatever is sampled at a single place, at all nodes. */
static int look_at_nodes(pm_workspace *w, int functions, int watched)
{
    const int who = (functions ? PM_SAMPLE_TRIGGERS : 0) | (watched ? PM_SAMPLE_ASKS : 0);
    int level = PM_LEVEL_KINEMATIC;
    if (functions && w->event->level > level) level = w->event->level;
    if (watched && w->ask->level > level) level = w->ask->level;
    for (int k = 0; k < w->step.nodes->n; k++) {
        const double x = functions ? w->event->place[k] : pm_step_node(&w->step, k);
        const int status = pm_step_look(w, x, level);
        if (status) return status;
        if (functions) {
            pm_gap_culling_node(&w->event->culling, &w->frame, k);
            sample_contacts(w, k);
        }
        pm_watched_samples_read(w, k, who);
    }
    return PM_OK;
}

static void find_range(pm_event_function *f, const double *g, int n)
{
    f->ranged = 1;
    f->least = INFINITY;
    f->most = -INFINITY;
    for (int k = 0; k < n; k++) {
        f->least = pm_min(g[k], f->least);
        f->most = pm_max(g[k], f->most);
    }
}

/* The triggers that are sampled, at all nodes, which have been read. */
static void sample_triggers(pm_workspace *w)
{
    pm_event_set *e = w->event;
    for (int i = 0; i < e->ntrigger; i++) {
        pm_event_function *f = &e->function[i];
        double *value = pm_event_samples(w->event, i);
        if (f->owned) continue;
        pm_watched_samples_run(w, PM_TRIGGER_ROW(w->model, f->index)[PM_TRIGGER_PROGRAM], NULL, value);
        find_range(f, value, w->step.nodes->n);
        f->ranged = !f->every; /* its course is from one of its multiples */
        f->multiple = f->every ? round(*value) : 0;
        e->last[f->index] = pm_max(pm_max(f->most, -f->least), 0);
        e->least[f->index] = pm_min(f->least, e->least[f->index]);
        e->greatest[f->index] = pm_max(f->most, e->greatest[f->index]);
    }
}

/* The step came closer to contacts than was expected: they are looked at, too. */
static int sample_reached(pm_workspace *w)
{
    for (int k = 0; k < w->step.nodes->n; k++) {
        const int status = pm_step_look(w, pm_step_node(&w->step, k), w->event->level);
        if (status) return status;
        sample_contacts(w, k);
    }
    return PM_OK;
}

/* How far the contacts that were looked at are: some can be left alone in the next steps. */
static void keep_gaps(const pm_model *model, pm_event_set *e)
{
    for (int i = 0; i < e->nfunction; i++) {
        const pm_event_function *f = &e->function[i];
        if (f->kind == FUNCTION_GAP && !f->born && pm_event_samples_wanted(e, f))
            pm_gap_culling_keep(&e->culling, model, f->index, *pm_event_samples(e, i));
    }
}

/* On which side of zero the functions begin the step; of its own a route that finds roots knows that. */
static void note_sides(pm_event_set *e)
{
    for (int i = 0; i < e->nfunction; i++) {
        pm_event_function *f = &e->function[i];
        if (f->owned) continue;
        const double x = pm_event_of_sample(f, *pm_event_samples(e, i));
        f->side = f->held || f->every ? 0 : (x > 0) - (x < 0);
    }
}

static int is_resolved(const pm_step *step, const double *sample)
{
    return !(pm_chebyshev_tail(step->nodes, sample) > PM_TAIL_WAVES);
}

/* Whether the samples of trigger i show it.  The search for its zeros needs the tail, too. */
static int is_trigger_resolved(const pm_step *step, pm_event_set *e, int i)
{
    pm_event_course of;
    pm_event_samples_take(step, e, i, &of);
    return !(pm_event_samples_tail(step, e, i, &of) > PM_TAIL_WAVES);
}

/* Speeds fall to zero as the root of the energy does, where the motion reverses: that is no wave. */
static int may_wave(const pm_model *model, const pm_event_function *f)
{
    return !f->owned && model->programs.energy[PM_TRIGGER_ROW(model, f->index)[PM_TRIGGER_PROGRAM]] !=
                            PM_ENERGY_CLASS_ROOT;
}

/* Between few nodes something that is watched may reverse unseen: they do not resolve it.  (An ask with corners is resolved by its
 * branches.) */
static int are_resolved(const pm_workspace *w, int functions, int watched)
{
    const pm_event_set *e = w->event;
    const pm_ask_set *a = w->ask;
    for (int i = 0; functions && i < e->ntrigger; i++)
        if (may_wave(w->model, &e->function[i]) && !is_trigger_resolved(&w->step, w->event, i)) return 0;
    for (int i = 0; watched && i < a->nobserver; i++)
        if (a->switches[a->observer[i]] == 0 && !is_resolved(&w->step, pm_ask_samples(w, a->observer[i])))
            return 0;
    return 1;
}

/* Two points may meet between nodes, and be nearest there more than once: few nodes do not show that. */
static int may_meet(const pm_step *step, const pm_event_set *e)
{
    return e->soonest <= PM_MEETING_SOON * (step->end - step->begin) / (step->nodes->n - 1);
}

static int sample_at_nodes(pm_workspace *w, int functions, int watched)
{
    if (functions) begin_samples(w);
    const int status = look_at_nodes(w, functions, watched);
    if (status) return status;
    if (functions) sample_triggers(w);
    if (watched) pm_ask_sample(w);
    return PM_OK;
}

static int finish_functions(pm_workspace *w)
{
    const int status = pm_gap_culling_check(&w->event->culling, w->model) ? sample_reached(w) : PM_OK;
    keep_gaps(w->model, w->event);
    note_sides(w->event);
    return status;
}

static int is_whole(const pm_step *step)
{
    return step->begin == step->whole_begin && step->end == step->whole_end;
}

/* Samples at spectral nodes, at finer ones while they do not show all. */
static int sample_finer(pm_workspace *w, int functions, int watched, int waves, int *shown)
{
    int status = sample_at_nodes(w, functions, watched);
    for (;;) {
        *shown = status || !waves || pm_waves_are_shown(w, functions, watched);
        if (status || !w->step.nodes->finer || (*shown && are_resolved(w, functions, watched))) return status;
        w->step.nodes = w->step.nodes->finer;
        status = sample_at_nodes(w, functions, watched);
    }
}

/* Samples at the few nodes of the route, if these tell what more of them do. */
static int sample_few(pm_workspace *w, int functions, int watched, int waves, int *shown)
{
    const pm_chebyshev_nodes *const few = w->step.nodes;
    const int status = sample_at_nodes(w, functions, watched);
    const int meets = functions && may_meet(&w->step, w->event);
    *shown = status || !waves || pm_waves_are_excluded(w, functions, watched);
    if (*shown && !meets) return status;
    w->step.nodes = &pm_chebyshev_nodes_9;
    const int finer = sample_finer(w, functions, watched, waves, shown);
    if (finer || meets || !*shown || !is_whole(&w->step) || !pm_waves_are_shown_by_few(w, functions, watched))
        return finer;
    w->step.nodes = few;
    return sample_at_nodes(w, functions, watched);
}

int pm_event_samples_fill(pm_workspace *w, int with_functions, int *shown)
{
    const int functions = with_functions && w->event->nsampled > 0, watched = w->ask->nobserver > 0;
    const int few = !pm_chebyshev_nodes_spectral(w->step.nodes);
    w->step.sampled_end = w->step.end;
    *shown = 1;
    if (!functions && !watched) return PM_OK;
    const int waves = pm_waves_possible(w, functions, watched);
    pm_waves_forget(w);
    int status = (few ? sample_few : sample_finer)(w, functions, watched, waves, shown);
    if (status || !functions) return status;
    status = finish_functions(w);
    *shown = *shown && pm_gap_passage_is_shown(w);
    return status;
}

/* ---- the samples of one function ---- */
double pm_event_samples_along(void *of, double x, void *function)
{
    pm_workspace *w = of;
    const pm_event_function *f = function;
    if (pm_step_look(w, x, f->level)) return NAN;
    return pm_event_value(w, f);
}

void pm_event_samples_take(const pm_step *step, pm_event_set *event, int i, pm_event_course *x)
{
    pm_event_function *f = &event->function[i];
    const double *value = pm_event_samples(event, i);
    const int n = x->n = step->nodes->n;
    for (int k = 0; f->every && k < n; k++) x->own[k] = pm_event_of_sample(f, value[k]);
    x->g = f->every ? x->own : value;
    if (!f->ranged) find_range(f, x->g, n);
    x->low = f->least;
    x->high = f->most;
    x->biggest = pm_max(f->most, -f->least);
}

void pm_event_course_set(pm_event_course *x, int node, double value)
{
    if (x->g != x->own) memcpy(x->own, x->g, (size_t)x->n * sizeof *x->own);
    x->g = x->own;
    x->own[node] = value;
}

double pm_event_samples_tail(const pm_step *step, pm_event_set *event, int i, const pm_event_course *x)
{
    pm_event_function *f = &event->function[i];
    if (!pm_chebyshev_nodes_spectral(step->nodes)) return INFINITY;
    if (f->tail < 0) {
        f->tail = pm_chebyshev_tail(step->nodes, x->g);
        f->biggest = x->biggest;
    }
    return f->tail;
}

int pm_event_samples_resolved(const pm_step *step, pm_event_set *event, int i, const pm_event_course *x)
{
    return pm_event_samples_tail(step, event, i, x) < PM_TAIL_RESOLVED;
}

int pm_event_samples_resolve(const pm_step *step, pm_event_set *event, int i)
{
    const pm_event_function *f = &event->function[i];
    pm_event_course x;
    if (f->tail >= 0) return f->tail < PM_TAIL_RESOLVED;
    if (!pm_chebyshev_nodes_spectral(step->nodes)) return 0;
    pm_event_samples_take(step, event, i, &x);
    return pm_event_samples_resolved(step, event, i, &x);
}

double pm_event_samples_residual(const pm_event_function *f, double biggest)
{
    return PM_TAIL_RESIDUAL * f->tail * biggest;
}

/* ---- one member of a pattern ---- */
/* The member that is met at x, of those that are open; 0 if there is none. */
static int member_at(pm_workspace *w, const pm_event_function *f, double x, int *member)
{
    const pm_event_set *e = w->event;
    for (int k = 0; k < w->step.nodes->n; k++)
        if (e->place[k] == x)
            return !isinf(pm_contact_pattern_nearest(&w->frame, &w->state, f->index,
                                                     e->beside + f->pattern * PM_NODES_MOST + k, member));
    return !pm_step_look(w, x, PM_LEVEL_KINEMATIC) &&
           !isinf(pm_contact_gap(&w->frame, &w->state, f->index, member));
}

void pm_event_samples_of_member(pm_workspace *w, int i, double x)
{
    pm_event_set *e = w->event;
    pm_event_function *f = &e->function[i];
    int member;
    if (f->pattern == PM_NONE || !pm_chebyshev_nodes_spectral(w->step.nodes) || !member_at(w, f, x, &member))
        return;
    for (int k = 0; k < w->step.nodes->n; k++)
        pm_event_samples(w->event, i)[k] =
            pm_contact_pattern_gap_beside(e->beside + f->pattern * PM_NODES_MOST + k, member);
    f->tail = -1;
    f->ranged = 0;
}
