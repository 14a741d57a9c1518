/* history.c - appends rows while there is room, and counts all of them.
 *
 * On a grid: where the time along a step takes a value of it (numerics/bracket.h), as asks find their grid values.  Without
 * one: a stretch between two nodes of a step is divided as long as, at the point of division, some program lies farther from
 * its chord over the time than history.bend allows.  That point is not the middle, where a symmetric curve may cross its chord. */
#include "events/history.h"

#include <math.h>
#include <string.h>

#include "equations/saddle.h"
#include "events/ask.h"
#include "expression/program.h"
#include "numerics/bracket.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

int pm_history_create(pm_workspace *w, pm_history *history)
{
    const pm_array array[] = {PM_ARRAY(history->row, (PM_HISTORY_PARTINGS + 2) * (1 + history->nprogram))};
    return pm_arena_take(&w->memory, PM_ARRAYS(array)) ? PM_NO_MEMORY : PM_OK;
}

void pm_history_reset(pm_history *history) { history->needed = history->next = 0; }

static double *row_of(const pm_history *r, int i) { return r->row + i * (1 + r->nprogram); }

/* Numbers of grid times that doubles tell apart: beyond, the grid is over. */
static const int64_t most_times = INT64_C(1) << 53;

static double grid_time(const pm_history *r)
{
    return r->next < most_times ? (double)r->next * r->every : INFINITY;
}

static int64_t most_more(const pm_history *r, double times)
{
    return times < (double)(most_times - r->next) ? (int64_t)times : most_times - r->next;
}

/* The time and the programs at a state. */
static int read(pm_workspace *w, const pm_state *state, double *row)
{
    const pm_history *r = w->record.history;
    pm_frame_look_state(&w->frame, state);
    const int status = pm_saddle_accelerate(w);
    row[0] = state->t;
    for (int64_t i = 0; i < r->nprogram && !status; i++) row[1 + i] = pm_program_run(w, r->program[i]);
    return status;
}

/* The same at place x of the present step. */
static int read_at(pm_workspace *w, double x, double *row)
{
    if (x == w->step.whole_end) return read(w, &w->state, row);
    const int status = w->phase.route->exact(w, x, &w->probe);
    return status ? status : read(w, &w->probe, row);
}

static void keep(pm_history *r, const double *row, int mark)
{
    if (r->needed < r->cap) {
        memcpy(r->history + r->needed * (1 + r->nprogram), row, (size_t)(1 + r->nprogram) * sizeof *row);
        r->mark[r->needed] = mark;
    }
    r->needed++;
}

/* ---- instants ---- */
/* The times of the grid up to t are over. */
static void pass_grid(pm_history *r, double t)
{
    if (r->every > 0 && grid_time(r) <= t + PM_TIME_TOGETHER * fabs(t))
        r->next += most_more(r, floor((t + PM_TIME_TOGETHER * fabs(t)) / r->every) + 1 - (double)r->next);
}

static int record(pm_workspace *w, int mark)
{
    pm_history *r = w->record.history;
    const int status = r->needed < r->cap ? read(w, &w->state, r->row) : PM_OK;
    if (status) return status;
    keep(r, r->row, mark);
    pass_grid(r, w->state.t);
    return PM_OK;
}

int pm_history_append(pm_workspace *w, int mark)
{
    const pm_history *r = w->record.history;
    return r && (mark || r->every == 0) ? record(w, mark) : PM_OK;
}

void pm_history_open(pm_workspace *w)
{
    pm_history *r = w->record.history;
    if (!r || w->phase.kinematic) return;
    r->row[0] = w->state.t;
    for (int64_t i = 0; i < r->nprogram; i++) r->row[1 + i] = pm_program_run(w, r->program[i]);
    keep(r, r->row, 1);
}

void pm_history_take_back(pm_history *history)
{
    if (history) history->needed = 0;
}

int pm_history_end(pm_workspace *w)
{
    const pm_history *r = w->record.history;
    return r && r->every > 0 ? record(w, 0) : PM_OK;
}

/* ---- inside steps ---- */
void pm_history_step(const pm_step *step, pm_record *record)
{
    if (!record->history) return;
    record->history->length = step->end - step->begin;
    record->history->begin = record->history->inside = step->begin;
}

/* Whether a program lies too far from the chord from row a to row b; what is no number is on it. */
static int is_bent(const pm_history *r, const double *a, const double *row, const double *b)
{
    if (!(b[0] > a[0])) return 0;
    const double part = (row[0] - a[0]) / (b[0] - a[0]);
    for (int64_t i = 1; i <= r->nprogram; i++)
        if (PM_HISTORY_SAFETY * fabs(row[i] - a[i] - part * (b[i] - a[i])) > r->bend[i - 1]) return 1;
    return 0;
}

/* Where a stretch that is left to record ends, and how often it was parted. */
typedef struct stretch {
    double end;
    int parted;
} stretch;

/* Records what a line from place a to place b would miss; their rows are the first two.  The first is then that of b. */
static int record_bends(pm_workspace *w, double a, double b)
{
    pm_history *r = w->record.history;
    stretch left[PM_HISTORY_PARTINGS + 1] = {{b, 0}}; /* the next one last; the row of its end is last + 1 */
    for (int last = 0; last >= 0;) {
        const int more = left[last].parted < PM_HISTORY_PARTINGS;
        const double x = a + PM_HISTORY_PARTING * (left[last].end - a);
        const int status = more ? read_at(w, x, row_of(r, last + 2)) : PM_OK;
        if (status) return status;
        if (more && is_bent(r, r->row, row_of(r, last + 2), row_of(r, last + 1))) {
            const int parted = ++left[last].parted;
            left[++last] = (stretch){x, parted};
            continue;
        }
        memcpy(r->row, row_of(r, last + 1), (size_t)(1 + r->nprogram) * sizeof *r->row);
        if (last > 0) keep(r, r->row, 0);
        a = left[last--].end;
    }
    return PM_OK;
}

static int record_nodes(pm_workspace *w, double x)
{
    pm_history *r = w->record.history;
    const pm_chebyshev_nodes *nodes = w->step.nodes;
    int status = read_at(w, r->inside, r->row);
    for (int k = 0; k <= nodes->n && !status && r->inside < x; k++) {
        const double place = k < nodes->n ? fmin(r->begin + r->length * nodes->at[k], x) : x;
        if (place <= r->inside) continue;
        status = read_at(w, place, row_of(r, 1));
        if (!status) status = record_bends(w, r->inside, place);
        if (!status && place < x) keep(r, r->row, 0);
        r->inside = place;
    }
    return status;
}

/* ---- on a grid ---- */
static int exactly(void *of, double x, void *wanted, double *value)
{
    pm_workspace *w = of;
    const int status = w->phase.route->exact(w, x, &w->probe);
    *value = w->probe.t - *(const double *)wanted;
    return status;
}

static double along(void *of, double x, void *wanted)
{
    double value;
    return exactly(of, x, wanted, &value) ? NAN : value;
}

/* The place up to x where the time is that of the grid; it is less at r->inside and more at x, at time t. */
static int find_time(pm_workspace *w, double x, double t, double *place)
{
    const pm_history *r = w->record.history;
    double wanted = grid_time(r), before;
    *place = fmax(wanted, r->inside);
    if (w->phase.route->in_time) return PM_OK;
    *place = r->inside;
    const int status = exactly(w, r->inside, &wanted, &before);
    if (status || before >= 0) return status;
    return pm_fail_search(&w->result, pm_bracket_find(w->ask->solver, along, w, &wanted, r->inside, before, x,
                                                      t - wanted, place));
}

static int record_grid(pm_workspace *w, double x)
{
    pm_history *r = w->record.history;
    double none = 0, t = x, place;
    int status = w->phase.route->in_time ? PM_OK : exactly(w, x, &none, &t);
    while (!status && grid_time(r) < t - PM_TIME_TOGETHER * fabs(t)) {
        if (r->needed >= r->cap) { /* there is no room: they are only counted */
            const int64_t more =
                most_more(r, ceil((t - PM_TIME_TOGETHER * fabs(t) - grid_time(r)) / r->every));
            r->needed += more;
            r->next += more;
            continue;
        }
        status = find_time(w, x, t, &place);
        if (!status) status = read_at(w, place, r->row);
        if (status) return status;
        r->row[0] = grid_time(r);
        keep(r, r->row, 0);
        r->next++;
        r->inside = place;
    }
    r->inside = x;
    return status;
}

int pm_history_inside(pm_workspace *w, double x)
{
    const pm_history *r = w->record.history;
    if (!r || x <= r->inside) return PM_OK;
    return r->every > 0 ? record_grid(w, x) : record_nodes(w, x);
}
