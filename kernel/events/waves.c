/* waves.c - compares the samples of programs with their enclosures.
 *
 * The samples of a smooth program show it if
 *   its second derivative is small everywhere, compared with the range of the samples, or else
 *   the highest coefficients of the polynomial p through them are small,
 *   p' at the nodes is the rate of the program there, and
 *   its second derivative stays, everywhere in between, within what it is at the nodes (shown.h).
 * A program that is made of measures by sums, products and switches alone is, between its switches, as smooth as they are.
 * Where it switches by the motion it has a corner or jumps, which samples do not show.  An ask is an exception: its branches
 * are searched one by one (extremum_branch.c), if every switch changes only once. */
#include "events/waves.h"

#include <math.h>

#include "events/ask.h"
#include "events/event.h"
#include "events/watched_samples.h"
#include "events/wave_kinds.h"
#include "expression/enclosure.h"
#include "expression/program_fold.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/route.h"

typedef struct pm_waves {
    unsigned char *possible; /* [programs] of these */
    pm_measure_series along; /* series[watched measures] */
    int filled; /* PM_SAMPLE_TRIGGERS, PM_SAMPLE_ASKS: those that they read are of the present step */
} pm_waves;

/* ---- which programs ---- */
int pm_waves_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (PM_ARENA_NEW(&w->memory, w->watched->waves)) return PM_NO_MEMORY;
    pm_waves *x = w->watched->waves;
    const pm_array array[] = {PM_ARRAY(x->possible, m->rows[PM_TABLE_PROGRAM]),
                              PM_ARRAY(x->along.series, w->watched->n)};
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    if (status) return status;
    x->along.place = w->watched->place;
    for (int i = 0; i < m->rows[PM_TABLE_PROGRAM]; i++)
        x->possible[i] = (unsigned char)pm_wave_kinds_of(m, i);
    return PM_OK;
}

int pm_waves_may_be(const pm_workspace *w, int program)
{
    return w->watched->waves->possible[program] >= PM_WAVES_DISTANCES;
}

int pm_waves_beyond_distances(const pm_workspace *w, int program)
{
    return w->watched->waves->possible[program] == PM_WAVES_ANY;
}

void pm_waves_forget(pm_workspace *w) { w->watched->waves->filled = 0; }

static int trigger_program(const pm_workspace *w, int function)
{
    return PM_TRIGGER_ROW(w->model, w->event->function[function].index)[PM_TRIGGER_PROGRAM];
}

/* A trigger that is sampled and may have waves. */
static int is_watched(const pm_workspace *w, int function)
{
    return !w->event->function[function].owned && w->watched->waves->possible[trigger_program(w, function)];
}

int pm_waves_possible(const pm_workspace *w, int functions, int watched)
{
    for (int i = 0; functions && i < w->event->ntrigger; i++)
        if (is_watched(w, i)) return 1;
    for (int i = 0; watched && i < w->ask->nobserver; i++)
        if (w->watched->waves->possible[pm_ask_watched(w->model, w->ask, i)]) return 1;
    return 0;
}

/* ---- one program ---- */
typedef struct pm_waves_course {
    const pm_workspace *w;
    const double *sample; /* at the nodes */
    int program;
    int by_branches; /* a switch that is passed once is no harm */
} pm_waves_course;

static pm_enclosure enclose(const pm_waves_course *c, double from, double to)
{
    const pm_workspace *w = c->w;
    return pm_enclosure_along(w->model, c->program, w->numbers.folded, &w->watched->waves->along, from, to);
}

static int is_bounded(pm_interval x) { return isfinite(x.lo) && isfinite(x.hi); }

/* What the samples of a measure tell of it: the polynomial through them; not enough; or noise, of which shorter parts tell no
 * more. */
enum { SERIES_KNOWN, SERIES_SHORTER, SERIES_NOISE };

static int known_of(const pm_waves_course *c, int measure, const pm_chebyshev_series *x)
{
    /* The corner of a distance between the last two nodes is seen by the last one alone.  What sees the ends of its steps alone takes
     * short ones, which are smooth to its tolerance. */
    const int strict = !c->w->phase.route->sees_ends && pm_wave_kinds_distance(c->w->model, measure);
    if (strict ? pm_chebyshev_series_resolved(x, PM_TAIL_DISTANCE)
               : x->resolved || x->high <= c->w->numbers.tolerance * x->size)
        return SERIES_KNOWN;
    return x->scatters ? SERIES_NOISE : SERIES_SHORTER;
}

/* The same of all the measures that it reads. */
static int known(const pm_waves_course *c)
{
    const pm_program_fold *f = c->w->model->programs.fold;
    const pm_measure_series *x = &c->w->watched->waves->along;
    int all = SERIES_KNOWN;
    for (int k = f->first[c->program]; k < f->first[c->program + 1]; k++) {
        if (f->step[k].kind != STEP_MEASURE) continue;
        const int one = known_of(c, f->step[k].arg, &x->series[x->place[f->step[k].arg]]);
        if (one > all) all = one;
    }
    return all;
}

/* Least and greatest sample; not bounded where one is no number. */
static pm_interval range_of(const pm_waves_course *c)
{
    pm_interval x = {INFINITY, -INFINITY};
    for (int k = 0; k < c->w->step.nodes->n; k++) {
        if (!isfinite(c->sample[k])) return PM_INTERVAL_ALL;
        x.lo = pm_min(c->sample[k], x.lo);
        x.hi = pm_max(c->sample[k], x.hi);
    }
    return x;
}

static double nothing_of(const pm_waves_course *c, pm_interval range)
{
    return c->w->numbers.tolerance * pm_interval_size(range);
}

static int is_calm(const pm_waves_course *c, pm_interval range)
{
    const pm_enclosure all = enclose(c, 0, 1);
    const double calm = PM_WAVES_CALM * pm_interval_width(range) + nothing_of(c, range);
    return !all.open && pm_interval_size(all.jet.bend) <= calm;
}

/* The bends at the nodes; 0 if the polynomial has other rates there. */
static int take_bends(const pm_waves_course *c, pm_interval range, pm_interval *bend)
{
    const pm_chebyshev_nodes *nodes = c->w->step.nodes;
    double off = 0, steepest = 0;
    for (int k = 0; k < nodes->n; k++) {
        const pm_jet here = enclose(c, nodes->at[k], nodes->at[k]).jet;
        if (!is_bounded(here.rate) || !is_bounded(here.bend)) return 0;
        bend[k] = here.bend;
        steepest = pm_max(pm_interval_size(here.rate), steepest);
        off = pm_max(fabs(pm_chebyshev_slope_at(nodes, c->sample, k) - here.rate.lo), off);
    }
    return c->by_branches || off <= PM_WAVES_RATES * steepest + nodes->n * nodes->n * nothing_of(c, range);
}

/* What those at the nodes near node k and the next tell of the bends between these, widened by what changes nothing. */
static pm_interval bends_near(const pm_waves_course *c, const pm_interval *bend, int k, pm_interval range)
{
    const int last = pm_min(k + 2, c->w->step.nodes->n - 1);
    pm_interval near = bend[k];
    for (int j = k > 0 ? k - 1 : 0; j <= last; j++) near = pm_interval_hull(near, bend[j]);
    return pm_enclosure_sampled_bends(near, nothing_of(c, range));
}

/* How a program goes from one node to another. */
typedef struct pm_passage {
    pm_interval bends; /* it may have */
    int budget;        /* of parts */
    int passed;        /* switches, part by part */
} pm_passage;

/* A switch stands otherwise at the end: some part passes it, however short the parts are. */
static int passes_switch(const pm_waves_course *c, const pm_enclosure *e)
{
    return !c->by_branches && e->changes > 0;
}

/* Whether it stays within its bends over [from, to], and passes no switch that is not known there. */
static int stays(const pm_waves_course *c, pm_passage *x, double from, double to)
{
    const double middle = 0.5 * (from + to);
    const pm_enclosure e = enclose(c, from, to);
    if (passes_switch(c, &e)) return 0;
    if (e.open <= (c->by_branches ? e.changes : 0) && pm_interval_inside(e.jet.bend, x->bends)) {
        x->passed += e.changes;
        return 1;
    }
    if (--x->budget < 0) return 0;
    return stays(c, x, from, middle) && stays(c, x, middle, to);
}

/* The same from node k to the next: a switch that is passed there and back stands at both as it does at one. */
static int stays_between(const pm_waves_course *c, pm_passage *x, int k)
{
    const double *at = c->w->step.nodes->at;
    x->passed = 0;
    return stays(c, x, at[k], at[k + 1]) &&
           (x->passed == 0 || x->passed == enclose(c, at[k], at[k + 1]).changes);
}

/* From one node to another only switches are passed that are known. */
static int has_known_switches(const pm_waves_course *c, int first, int last)
{
    const double *at = c->w->step.nodes->at;
    const int middle = (first + last) / 2;
    pm_passage x = {.bends = PM_INTERVAL_ALL, .budget = PM_TIME_PARTS};
    if (last - first == 1) return stays_between(c, &x, first);
    const pm_enclosure e = enclose(c, at[first], at[last]);
    if (e.open == 0 || passes_switch(c, &e)) return e.open == 0;
    return has_known_switches(c, first, middle) && has_known_switches(c, middle, last);
}

/* The first switch over [from, to], to a part of 2^-halvings of it; INFINITY: there is none, or they are not told apart. */
static double first_switch(const pm_waves_course *c, double from, double to, int halvings, int *budget)
{
    const double middle = 0.5 * (from + to);
    if (--*budget < 0 || enclose(c, from, to).open == 0) return INFINITY;
    if (halvings == 0) return from;
    const double before = first_switch(c, from, middle, halvings - 1, budget);
    return before < INFINITY ? before : first_switch(c, middle, to, halvings - 1, budget);
}

static int switches_only(const pm_waves_course *c)
{
    return c->w->watched->waves->possible[c->program] == PM_WAVES_SWITCHES_ONLY;
}

/* By the nodes of routes that do not care for waves. */
static int is_calm_by_few(const pm_waves_course *c)
{
    const pm_interval range = range_of(c);
    if (!is_bounded(range)) return 1;
    if (known(c) != SERIES_KNOWN) return 0;
    return switches_only(c) ? has_known_switches(c, 0, c->w->step.nodes->n - 1) : is_calm(c, range);
}

static int is_shown(const pm_waves_course *c)
{
    const pm_chebyshev_nodes *nodes = c->w->step.nodes;
    const pm_interval range = range_of(c);
    pm_interval bend[PM_NODES_MOST];
    pm_passage x = {.budget = PM_TIME_PARTS};
    if (!is_bounded(range)) return 1; /* whoever watches says so */
    const int told = known(c);
    if (told != SERIES_KNOWN) return told == SERIES_NOISE;
    if (switches_only(c)) return has_known_switches(c, 0, nodes->n - 1);
    if (is_calm(c, range)) return 1;
    if (!c->by_branches && pm_chebyshev_tail(nodes, c->sample) > PM_TAIL_WAVES) return 0;
    if (!take_bends(c, range, bend)) return 0;
    for (int k = 0; k + 1 < nodes->n; k++) {
        x.bends = bends_near(c, bend, k, range);
        if (!stays_between(c, &x, k)) return 0;
    }
    return 1;
}

/* The few nodes of a route would show it, too: what their polynomial leaves out is little. */
static int is_shown_by_few(const pm_waves_course *c)
{
    const pm_interval range = range_of(c);
    pm_chebyshev_series own;
    double left_out = 0;
    if (!is_bounded(range)) return 1;
    if (c->by_branches) return 0; /* its switches need nodes between them */
    pm_chebyshev_series_of(&own, c->w->step.nodes, c->sample);
    for (int k = PM_NODES; k < own.n; k++) left_out += fabs(own.value[k]);
    return left_out <= PM_WAVES_FEW * pm_interval_width(range) + nothing_of(c, range);
}

int pm_waves_tell_law(const pm_workspace *w, int program, int who)
{
    const pm_waves *x = w->watched->waves;
    return (x->filled & who) && x->possible[program] != PM_WAVES_NONE &&
           known(&(pm_waves_course){.w = w, .program = program}) == SERIES_KNOWN;
}

pm_jet pm_waves_law(const pm_workspace *w, int program, const signed char *sign, double s)
{
    return pm_enclosure_at(w->model, program, w->numbers.folded, &w->watched->waves->along, sign, s);
}

pm_enclosure pm_waves_enclosed(const pm_workspace *w, int program, double from, double to)
{
    return enclose(&(pm_waves_course){.w = w, .program = program}, from, to);
}

/* ---- all of them ---- */
/* The series of the measures that such programs read. */
static void fill_series(pm_workspace *w, int functions, int watched)
{
    const pm_watched_samples *s = w->watched;
    const int who = (functions ? PM_SAMPLE_TRIGGERS : 0) | (watched ? PM_SAMPLE_ASKS : 0);
    w->watched->waves->filled = who;
    for (int i = 0; i < s->n; i++)
        if (s->who[i] & who)
            pm_chebyshev_series_of(w->watched->waves->along.series + i, w->step.nodes,
                                   s->value + i * PM_NODES_MOST);
}

static pm_waves_course course_of_trigger(pm_workspace *w, int function)
{
    return (pm_waves_course){w, pm_event_samples(w->event, function), trigger_program(w, function), 0};
}

static pm_waves_course course_of_ask(pm_workspace *w, int observer)
{
    const int ask = w->ask->observer[observer];
    return (pm_waves_course){w, pm_ask_samples(w, ask), pm_ask_watched(w->model, w->ask, observer),
                             w->ask->switches[ask] > 0};
}

/* The next of all triggers and asks that were sampled and may have waves; *i of them all were looked at.  0: there is none. */
static int next_course(pm_workspace *w, int functions, int watched, int *i, pm_waves_course *c)
{
    const int triggers = functions ? w->event->ntrigger : 0, asks = watched ? w->ask->nobserver : 0;
    while (*i < triggers + asks) {
        const int k = (*i)++, is_trigger = k < triggers;
        if (is_trigger && !is_watched(w, k)) continue;
        *c = is_trigger ? course_of_trigger(w, k) : course_of_ask(w, k - triggers);
        if (is_trigger || w->watched->waves->possible[c->program]) return 1;
    }
    return 0;
}

static int holds_for_all(pm_workspace *w, int functions, int watched, int (*is)(const pm_waves_course *))
{
    pm_waves_course c;
    int i = 0;
    while (next_course(w, functions, watched, &i, &c))
        if (!is(&c)) return 0;
    return 1;
}

/* Of one program that is not looked at branch by branch. */
static double first_switch_of(const pm_waves_course *c)
{
    int budget = PM_SWITCH_PARTS;
    if (c->by_branches || known(c) != SERIES_KNOWN) return INFINITY;
    return first_switch(c, 0, 1, PM_SWITCH_HALVINGS, &budget);
}

double pm_waves_first_switch(pm_workspace *w, int functions, int watched)
{
    pm_waves_course c;
    double first = INFINITY;
    for (int i = 0; next_course(w, functions, watched, &i, &c);) first = pm_min(first_switch_of(&c), first);
    return first;
}

int pm_waves_are_excluded(pm_workspace *w, int functions, int watched)
{
    fill_series(w, functions, watched);
    return holds_for_all(w, functions, watched, is_calm_by_few);
}

int pm_waves_are_shown_by_few(pm_workspace *w, int functions, int watched)
{
    return holds_for_all(w, functions, watched, is_shown_by_few);
}

int pm_waves_are_shown(pm_workspace *w, int functions, int watched)
{
    fill_series(w, functions, watched);
    return holds_for_all(w, functions, watched, is_shown);
}
