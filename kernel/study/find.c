/* find.c - looks for parameters: samples between the bounds, closes in on what the samples bracket, runs what was found.
 *
 * One parameter is sampled at equal distances, both bounds included.  Then
 *   a condition ZERO      every change of its sign between samples is a bracket; of several roots the extreme ask, or the
 *                         parameter itself, decides - without one the first is taken and the status says so;
 *   an extreme ask        every sample that is better than its neighbours is one, and so are the ends, also those of the
 *                         part where the conditions hold;
 *   the parameter itself  the first (last) sample at which the conditions hold and the one before it.
 * What lies between two samples without showing at them is not seen: more samples see it. */
#include "study/find.h"

#include <math.h>
#include <string.h>

#include "equations/case_values.h"
#include "expression/program.h"
#include "numerics/bracket.h"
#include "numerics/tolerances.h"
#include "run/run.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/workspace.h"
#include "study/find_sides.h"

static int nodes_of(const pm_find *f)
{
    return f->nvary == 2 ? (f->samples + 1) * (f->samples + 1) : f->samples + 1;
}

int pm_find_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (m->rows[PM_TABLE_FIND] == 0) return PM_OK;
    if (PM_ARENA_NEW(&w->memory, w->find)) return PM_NO_MEMORY;
    pm_find *f = w->find;
    f->nvary = m->rows[PM_TABLE_VARY];
    f->ncondition = m->rows[PM_TABLE_CONDITION];
    f->goal = PM_FIND_ROW(m, 0)[PM_FIND_GOAL];
    f->program = PM_FIND_ROW(m, 0)[PM_FIND_PROGRAM];
    f->samples = PM_FIND_ROW(m, 0)[PM_FIND_SAMPLES];
    for (int i = 0; i < f->ncondition; i++)
        if (PM_CONDITION_ROW(m, i)[PM_CONDITION_KIND] == PM_CONDITION_ZERO) f->zero[f->nzero++] = i;
    const pm_array array[] = {
        PM_ARRAY(f->param, m->nparam),
        PM_ARRAY(f->node, nodes_of(f)),
        PM_ARRAY(f->found, 2 * nodes_of(f) + 2),
    };
    f->root = pm_bracket_create();
    f->minimum = pm_bracket_minimum_create();
    f->pair = pm_find_pair_create();
    int status = pm_arena_keep(&w->memory, f->root, pm_bracket_free);
    status |= pm_arena_keep(&w->memory, f->minimum, pm_bracket_minimum_free);
    status |= pm_arena_keep(&w->memory, f->pair, pm_find_pair_free);
    if (status || pm_find_sides_create(w)) return PM_NO_MEMORY;
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

/* ---- samples ---- */
static int read_bounds(pm_workspace *w)
{
    pm_find *f = w->find;
    const int status = pm_case_values(w, f->param);
    if (status) return status;
    for (int i = 0; i < f->nvary; i++) {
        const int32_t *e = PM_VARY_ROW(w->model, i);
        f->low[i] = w->numbers.value[e[PM_VARY_LOW]];
        f->high[i] = w->numbers.value[e[PM_VARY_HIGH]];
        if (!(f->high[i] > f->low[i]) || !isfinite(f->high[i] - f->low[i]))
            return pm_fail(&w->result, PM_BAD_VALUE, PM_TABLE_VARY, i, f->high[i], f->low[i]);
    }
    return PM_OK;
}

static double step_of(const pm_find *f) { return (f->high[0] - f->low[0]) / f->samples; }

/* Neighbouring brackets may lead to one place. */
static void add_found(pm_find *f, const pm_look *look)
{
    for (int i = 0; i < f->nfound; i++)
        if (fabs(f->found[i].x[0] - look->x[0]) <= PM_FIND_SAME * (f->high[0] - f->low[0])) return;
    f->found[f->nfound++] = *look;
}

/* ---- a value ---- */
static double zero_at(const pm_find *f, const pm_look *look) { return look->reading[f->zero[0]]; }

/* A root, or a jump over zero, between two looks. */
static int close_bracket(pm_workspace *w, const pm_look *a, const pm_look *b, pm_find_root_place *jump)
{
    pm_find *f = w->find;
    pm_find_root_place place;
    pm_look look;
    int status =
        pm_find_root(w, pm_find_reading, &f->zero[0], a->x[0], zero_at(f, a), b->x[0], zero_at(f, b), &place);
    if (status) return status;
    if (place.jumps) {
        *jump = place;
        return PM_OK;
    }
    status = pm_find_look(w, &place.x, &look);
    if (!status && look.holds) add_found(f, &look);
    return status;
}

/* Between three samples of one sign: the vertex of the parabola through them, if it comes near to zero. */
static int look_between(pm_workspace *w, int middle, pm_find_root_place *jump)
{
    const pm_find *f = w->find;
    const pm_look *p = &f->node[middle - 1];
    const double left = zero_at(f, p), here = zero_at(f, p + 1), right = zero_at(f, p + 2);
    const double bend = left - 2 * here + right, shift = 0.5 * (left - right) / bend;
    const double nearest = here - 0.125 * (left - right) * (left - right) / bend;
    if (!(fabs(shift) < 1) || !(here * bend > 0) ||
        !(nearest * here < fabs(here) * fabs(here) / PM_FIND_TOUCH))
        return PM_OK;
    const double x = p[1].x[0] + shift * step_of(f);
    pm_look look;
    int status = pm_find_look(w, &x, &look);
    if (status || !(zero_at(f, &look) * here <= 0)) return status;
    if (zero_at(f, &look) == 0) {
        if (look.holds) add_found(w->find, &look);
        return PM_OK;
    }
    status = close_bracket(w, x > p[1].x[0] ? p + 1 : p, &look, jump);
    return status ? status : close_bracket(w, &look, x > p[1].x[0] ? p + 2 : p + 1, jump);
}

/* A root on a bound lies beyond it where the errors of the run there say so: where the line through the readings at the bound and
 * next to it is zero tells how far. */
static void take_bound(pm_workspace *w, const pm_look *bound, const pm_look *next)
{
    pm_find *f = w->find;
    const double here = zero_at(f, bound),
                 size = fmax(fabs(bound->x[0]), PM_FIND_SMALL * (f->high[0] - f->low[0]));
    const double off = fabs(here / (zero_at(f, next) - here)) * step_of(f) / size;
    if (!bound->holds || !(here * zero_at(f, next) > 0) ||
        !(off <= fmax(PM_FIND_OUTCOME, pm_evidence_tolerance(w))))
        return;
    add_found(f, bound);
    f->found[f->nfound - 1].off = off;
}

static void take_bounds(pm_workspace *w)
{
    const pm_find *f = w->find;
    take_bound(w, &f->node[0], &f->node[1]);
    take_bound(w, &f->node[f->samples], &f->node[f->samples - 1]);
}

static int find_value(pm_workspace *w)
{
    pm_find *f = w->find;
    pm_find_root_place jump = {.jumps = 0};
    int status = PM_OK;
    for (int i = 0; i <= f->samples && !status; i++) {
        const pm_look *node = &f->node[i];
        const double value = zero_at(f, node), last = i > 0 ? zero_at(f, node - 1) : NAN;
        if (value == 0 && node->holds) add_found(f, node);
        if (value * last < 0) status = close_bracket(w, node - 1, node, &jump);
        if (!status && i > 1 && value * last > 0 && value * zero_at(f, node - 2) > 0)
            status = look_between(w, i - 1, &jump);
    }
    if (!status && f->nfound == 0 && !jump.jumps) take_bounds(w);
    if (status || f->nfound > 0) return status;
    if (jump.jumps)
        return pm_fail(&w->result, PM_FIND_JUMP, PM_TABLE_CONDITION, f->zero[0], jump.f_below, jump.f_above);
    return pm_fail(&w->result, PM_FIND_NONE, PM_TABLE_CONDITION, f->zero[0], zero_at(f, &f->node[0]),
                   zero_at(f, &f->node[f->samples]));
}

/* ---- an extreme ---- */
static int is_feasible(const pm_look *look) { return look->holds && !isnan(look->goal); }

/* How far a sample's neighbourhood goes on one side: its neighbour, or the last place where the conditions hold. */
static int reach(pm_workspace *w, int i, int side, pm_look *end)
{
    const pm_find *f = w->find;
    const int next = i + side;
    *end = f->node[i];
    if (next < 0 || next > f->samples) return PM_OK;
    if (is_feasible(&f->node[next])) {
        *end = f->node[next];
        return PM_OK;
    }
    return f->node[next].holds ? PM_OK : pm_find_threshold(w, &f->node[next], end);
}

/* The best place between `left` and `right`, of which `best` is one or lies between. */
static int climb(pm_workspace *w, const pm_look *left, const pm_look *right, pm_look *best)
{
    const double step = PM_FIND_PROBE * step_of(w->find), width = right->x[0] - left->x[0];
    pm_look probe;
    if (!(width > 2 * step)) return PM_OK;
    if (best->x[0] == left->x[0] || best->x[0] == right->x[0]) {
        const double x = best->x[0] + (best->x[0] == left->x[0] ? step : -step);
        const int status = pm_find_look(w, &x, &probe);
        if (status || !(probe.goal > best->goal)) return status; /* it gets worse away from the end */
        *best = probe;
    }
    return pm_find_extremum(w, left->x[0], right->x[0], best);
}

static int climb_from(pm_workspace *w, int i)
{
    pm_find *f = w->find;
    pm_look left, right, best = f->node[i];
    int status = reach(w, i, -1, &left);
    if (!status) status = reach(w, i, 1, &right);
    if (status) return status;
    if (left.goal > best.goal) best = left;
    if (right.goal > best.goal) best = right;
    status = climb(w, &left, &right, &best);
    if (!status) add_found(f, &best);
    return status;
}

/* A sample with no better neighbour; of equal neighbours the first. */
static int is_peak(const pm_find *f, int i)
{
    const pm_look *p = &f->node[i];
    if (!is_feasible(p)) return 0;
    const int left = i == 0 || !is_feasible(p - 1) || p[-1].goal < p->goal;
    const int right = i == f->samples || !is_feasible(p + 1) || p[1].goal <= p->goal;
    return left && right;
}

static int find_extreme(pm_workspace *w)
{
    pm_find *f = w->find;
    int status = PM_OK;
    for (int i = 0; i <= f->samples && !status; i++)
        if (is_peak(f, i)) status = climb_from(w, i);
    if (status || f->nfound > 0) return status;
    const double sign = f->goal == PM_FIND_GREATEST ? 1 : -1;
    return pm_fail(&w->result, PM_FIND_NONE, PM_TABLE_FIND, 0, sign * f->node[0].goal,
                   sign * f->node[f->samples].goal);
}

/* ---- a threshold ---- */
static int find_threshold(pm_workspace *w)
{
    pm_find *f = w->find;
    const int side = f->goal == PM_FIND_LEAST ? 1 : -1;
    int i = side > 0 ? 0 : f->samples;
    for (int k = 0; k < f->samples; k++) f->changes += f->node[k].holds != f->node[k + 1].holds;
    while (i >= 0 && i <= f->samples && !f->node[i].holds) i += side;
    if (i < 0 || i > f->samples) {
        int row = 0; /* what keeps the last sample from holding */
        while (row < f->ncondition - 1 && f->node[f->samples].reading[row] > 0) row++;
        return pm_fail(&w->result, PM_FIND_NONE, PM_TABLE_CONDITION, row, f->node[0].reading[row],
                       f->node[f->samples].reading[row]);
    }
    pm_look yes = f->node[i];
    const int first = i == (side > 0 ? 0 : f->samples);
    const int status = first ? PM_OK : pm_find_threshold(w, &f->node[i - side], &yes);
    if (!status) add_found(f, &yes);
    return status;
}

/* ---- what was found ---- */
static int is_better(const pm_find *f, const pm_look *a, const pm_look *b)
{
    if (f->goal != PM_FIND_VALUE && f->program != PM_NONE) return a->goal > b->goal;
    return f->goal == PM_FIND_GREATEST ? a->x[0] > b->x[0] : a->x[0] < b->x[0];
}

/* Whether nothing that is asked prefers one to the other. */
static int is_tied(const pm_find *f, const pm_look *a, const pm_look *b)
{
    if (f->goal == PM_FIND_VALUE) return 1;
    return f->program != PM_NONE && fabs(a->goal - b->goal) <= PM_FIND_TIE * fabs(a->goal);
}

/* The one to be taken, how many are as good, and another one of them. */
static const pm_look *choose(const pm_find *f, int *several, const pm_look **other)
{
    const pm_look *best = f->found;
    for (int i = 1; i < f->nfound; i++)
        if (is_better(f, &f->found[i], best)) best = &f->found[i];
    *several = 1;
    *other = best;
    for (int i = 0; i < f->nfound; i++) {
        if (&f->found[i] == best || !is_tied(f, best, &f->found[i])) continue;
        ++*several;
        if (*other == best || is_better(f, &f->found[i], *other)) *other = &f->found[i];
    }
    return best;
}

static int is_at_bound(const pm_find *f, const pm_look *look)
{
    return f->goal != PM_FIND_VALUE && f->nzero == 0 &&
           (look->x[0] == f->low[0] || look->x[0] == f->high[0] || look->edge);
}

/* The run with what was found is the case's own. */
static int finish(pm_workspace *w, double *found)
{
    pm_find *f = w->find;
    int several;
    const pm_look *other, *chosen = choose(f, &several, &other);
    pm_look last, at = *chosen;
    f->resolution = fmax(chosen->off, chosen->bisected ? PM_FIND_OUTCOME : 0);
    int status = pm_find_sides(w, &at);
    if (!status) status = pm_find_look(w, at.x, &last);
    if (status) return status;
    pm_find_sides_tell(w);
    for (int k = 0; k < f->nvary; k++) found[PM_FOUND_FIRST + k] = at.x[k];
    status = last.status;
    if (status) return status;
    if (several > 1) {
        const int table = f->nzero > 0 ? PM_TABLE_CONDITION : PM_TABLE_FIND;
        return pm_fail(&w->result, PM_FIND_SEVERAL, table, f->nzero > 0 ? f->zero[0] : 0, other->x[0],
                       several);
    }
    if (is_at_bound(f, chosen))
        return pm_fail(&w->result, PM_FIND_AT_BOUND, PM_TABLE_VARY, 0, chosen->x[0], chosen->x[0]);
    return PM_OK;
}

static int says_nothing(const pm_find *f, const pm_look *look)
{
    if (look->status == PM_OK) return 0;
    for (int i = 0; i < f->ncondition; i++)
        if (!isnan(look->reading[i])) return 0;
    return 1;
}

/* If no sample could be run to where something is read, the first one's own status says more. */
static int all_failed(const pm_find *f)
{
    for (int i = 0; i < nodes_of(f); i++)
        if (!says_nothing(f, &f->node[i])) return 0;
    return 1;
}

static int search(pm_workspace *w)
{
    pm_find *f = w->find;
    int status = read_bounds(w);
    if (status) return status;
    if (f->nvary == 2) {
        status = pm_find_pair(w);
    } else {
        status = pm_find_sample(w);
        if (!status && f->nzero > 0)
            status = find_value(w);
        else if (!status && f->program != PM_NONE)
            status = find_extreme(w);
        else if (!status)
            status = find_threshold(w);
    }
    if ((status == PM_OK && f->nfound > 0) || w->patience.over) return status;
    if (all_failed(f)) {
        pm_look first;
        const int stopped = pm_find_look(w, f->node[0].x, &first);
        return stopped ? stopped : first.status;
    }
    return status ? status
                  : pm_fail(&w->result, PM_FIND_NONE, PM_TABLE_CONDITION, f->zero[0],
                            f->node[0].reading[f->zero[0]], f->node[nodes_of(f) - 1].reading[f->zero[0]]);
}

static void fail(const pm_model *model, pm_result *result)
{
    pm_run_fail_asks(model, result);
    for (int i = 0; i < PM_AUDITS; i++) result->audit[i] = NAN;
}

int pm_find_run(pm_workspace *w, const double *param, double *found)
{
    pm_find *f = w->find;
    for (int i = 0; i < PM_FOUND_COLUMNS; i++) found[i] = NAN;
    if (!f) {
        const int result = pm_run(w, param);
        w->result.count[PM_COUNT_RUNS] = 1;
        return result;
    }
    memcpy(f->param, param, (size_t)w->model->nparam * sizeof *param);
    for (int i = 0; i < f->nvary; i++) f->param[PM_VARY_ROW(w->model, i)[PM_VARY_PARAMETER]] = 0;
    f->nfound = f->changes = 0;
    f->runs = 0;
    f->resolution = 0;
    int status = search(w);
    if (status)
        fail(w->model, &w->result);
    else
        status = finish(w, found);
    w->result.count[PM_COUNT_RUNS] = f->runs;
    w->result.count[PM_COUNT_FOUND] = f->changes > f->nfound ? f->changes : f->nfound;
    return status;
}

double pm_find_resolution(const pm_find *find) { return find ? find->resolution : 0; }
