/* find_sides.c - answers that differ on the two sides of what was found.
 *
 * What is sought may lie where something else changes: an event that happens on one side only, another turn in which it happens
 * first.  On which side the run with what was found comes out is then a matter of rounding.  The answers are looked at on both
 * sides of the place x, at the distance d at which the outcome of a run is known again, and at 4 d.  An answer differs where
 *
 *     |a(x + d) - a(x - d)| > PM_FIND_STEP (|a(x + 4 d) - a(x + d)| + |a(x - d) - a(x - 4 d)|)
 *
 * and more than what a run leaves open: that of a smooth answer shrinks with d, that of a root or a logarithm on one side of x does
 * not grow towards it.  The answers are those of the side on which the conditions hold, else of the lower parameter: where the run
 * at x is not of that side, x moves there, by d at the most. */
#include "study/find_sides.h"

#include <math.h>
#include <string.h>

#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/workspace.h"

enum { FAR_BELOW, BELOW, HERE, ABOVE, FAR_ABOVE, PLACES };
static const double place[PLACES] = {-4, -1, 0, 1, 4}; /* times d */
_Static_assert((int)PLACES == PM_FIND_PLACES, "find_look.h has as many");

int pm_find_sides_create(pm_workspace *w)
{
    pm_find *f = w->find;
    const int n = w->model->nout;
    const pm_array array[] = {PM_ARRAY(f->answer[FAR_BELOW], n), PM_ARRAY(f->answer[BELOW], n),
                              PM_ARRAY(f->answer[HERE], n),      PM_ARRAY(f->answer[ABOVE], n),
                              PM_ARRAY(f->answer[FAR_ABOVE], n), PM_ARRAY(f->moved, n),
                              PM_ARRAY(f->sided, w->model->nask)};
    return pm_arena_take(&w->memory, PM_ARRAYS(array)) || pm_natural_size_create(w, &f->size);
}

static double distance(const pm_workspace *w, double x, double range)
{
    return PM_FIND_BESIDE * fmax(PM_FIND_OUTCOME, pm_evidence_tolerance(w)) *
           fmax(fabs(x), PM_FIND_SMALL * range);
}

/* The answers at one of the places beside x; *known becomes 0 where the run does not come to them. */
static int look_beside(pm_workspace *w, const pm_look *at, int k, double d, int p, int *known)
{
    pm_look look;
    double x[PM_FIND_MOST];
    memcpy(x, at->x, sizeof x);
    x[k] += place[p] * d;
    const int status = pm_find_look(w, x, &look);
    memcpy(w->find->answer[p], w->result.out, (size_t)w->model->nout * sizeof(double));
    *known = *known && look.status == PM_OK;
    return status;
}

static double between(const pm_find *f, int p, int q, int column)
{
    return fabs(f->answer[p][column] - f->answer[q][column]);
}

static int differs(const pm_workspace *w, int ask, int column, int p, int q)
{
    const pm_find *f = w->find;
    const double a = f->answer[p][column], b = f->answer[q][column];
    if (isnan(a) || isnan(b)) return isnan(a) != isnan(b);
    if (w->evidence.discrete[ask]) return a != b;
    const double size = fmax(fmax(f->size.ask[ask], f->size.terms[ask]), fmin(fabs(a), fabs(b)));
    const double within = between(f, ABOVE, FAR_ABOVE, column) + between(f, BELOW, FAR_BELOW, column);
    return fabs(a - b) > PM_FIND_STEP * within + PM_FIND_SEEN * pm_evidence_tolerance(w) * size;
}

static int ask_differs(const pm_workspace *w, int ask, int p, int q)
{
    const int32_t *row = PM_ASK_ROW(w->model, ask);
    for (int i = row[PM_ASK_OUT]; i < row[PM_ASK_OUT] + row[PM_ASK_COUNT]; i++)
        if (differs(w, ask, i, p, q)) return 1;
    return 0;
}

/* How many asks differ at two places. */
static int asks_differ(const pm_workspace *w, int p, int q)
{
    int n = 0;
    for (int i = 0; i < w->model->nask; i++) n += ask_differs(w, i, p, q);
    return n;
}

/* What has no value beyond a threshold is no answer of the other side. */
static void mark(pm_workspace *w, const pm_look *at)
{
    pm_find *f = w->find;
    const double *beyond = f->answer[at->side > 0 ? BELOW : ABOVE];
    for (int i = 0; i < w->model->nask; i++) {
        const int has_value = !isnan(beyond[PM_ASK_ROW(w->model, i)[PM_ASK_OUT]]);
        if (ask_differs(w, i, BELOW, ABOVE) && (has_value || !at->side)) f->sided[i] = 1;
    }
}

/* Moves to the nearest place at which the run is of the side `near`.  An answer is known no better there than the move changes
 * it. */
static int move(pm_workspace *w, pm_look *at, int k, double d, int near)
{
    pm_find *f = w->find;
    const int far = near == ABOVE ? FAR_ABOVE : FAR_BELOW;
    const double x = at->x[k];
    double step = PM_EPSILON * fabs(x);
    for (int known = 1; step < d && asks_differ(w, HERE, near) > 0; step *= 4) {
        at->x[k] = x + place[near] * step;
        const int status = look_beside(w, at, k, 0, HERE, &known);
        if (status) return status;
    }
    if (!(step < d)) at->x[k] = x + place[near] * d;
    const double moved = fabs(at->x[k] - x);
    for (int i = 0; i < w->model->nout; i++)
        if (isfinite(between(f, near, far, i))) f->moved[i] += moved / d * between(f, near, far, i);
    f->resolution = fmax(f->resolution, moved / fabs(at->x[k]));
    return PM_OK;
}

static int look_at_both(pm_workspace *w, pm_look *at, int k)
{
    const pm_find *f = w->find;
    const double d = distance(w, at->x[k], f->high[k] - f->low[k]);
    const int near = at->side > 0 ? ABOVE : BELOW, order[PLACES] = {BELOW, ABOVE, HERE, FAR_BELOW, FAR_ABOVE};
    if (at->x[k] - 4 * d < f->low[k] || at->x[k] + 4 * d > f->high[k]) return PM_OK;
    int known = 1, status = PM_OK;
    for (int i = 0; i < PLACES && known; i++) {
        status = look_beside(w, at, k, d, order[i], &known);
        if (status) return status;
        if (order[i] == HERE) pm_natural_size_find(w, &w->find->size, f->answer[FAR_BELOW], w->firing.before);
    }
    if (!known) return PM_OK;
    mark(w, at);
    return asks_differ(w, HERE, near) > 0 ? move(w, at, k, d, near) : PM_OK;
}

int pm_find_sides(pm_workspace *w, pm_look *at)
{
    pm_find *f = w->find;
    int status = PM_OK;
    memset(f->sided, 0, (size_t)w->model->nask);
    memset(f->moved, 0, (size_t)w->model->nout * sizeof *f->moved);
    for (int k = 0; k < f->nvary && !status; k++) status = look_at_both(w, at, k);
    return status;
}

void pm_find_sides_tell(pm_workspace *w)
{
    const pm_find *f = w->find;
    for (int i = 0; i < w->model->nask; i++)
        if (f->sided[i] && w->result.reason[i] == PM_REASON_NONE) w->result.reason[i] = PM_REASON_TWO_SIDED;
    for (int i = 0; i < w->model->nout; i++) pm_evidence_more(&w->evidence, i, f->moved[i]);
}
