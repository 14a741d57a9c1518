/* extremum_branch.c - extremes of a value whose program has switches (program.h) that change inside a step.
 *
 * Each branch of the program, run at all nodes, is smooth beyond the nodes where it is taken, too: its samples resolve it as
 * those of any smooth value.  Its extremes count where it is taken.  Between two nodes with different branches, extremes are
 * also where the arguments of the switches go through zero. */
#include <math.h>
#include <string.h>

#include "events/extremum_parts.h"
#include "events/step.h"
#include "events/switch_search.h"
#include "events/watched_samples.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

typedef signed char pm_extremum_signs[PM_SWITCHES];

/* The branches that a program takes in a step. */
typedef struct pm_extremum_branches {
    pm_switches at;                        /* the nodes */
    pm_extremum_signs sign[PM_NODES_MOST]; /* there */
    pm_extremum_of_branch branch;          /* the one that is looked at */
} pm_extremum_branches;

/* 1 if argument i changes its sign between nodes. */
static int changes(const pm_chebyshev_nodes *nodes, pm_extremum_branches *b, int i)
{
    const double *arg = b->at.arg[i];
    double low = 0, high = 0;
    for (int k = 0; k < nodes->n; k++) {
        low = pm_min(arg[k], low);
        high = pm_max(arg[k], high);
    }
    const double zero = PM_ON_ZERO * pm_max(high, -low);
    b->branch.zero[i] = zero;
    return high > zero && low < -zero;
}

/* Signs of argument i at the nodes; where it has none, that of the node before, or of the first that has one. */
static void take_signs(const pm_chebyshev_nodes *nodes, pm_extremum_branches *b, int i)
{
    const double *arg = b->at.arg[i], zero = b->branch.zero[i];
    signed char last = 0;
    for (int k = 0; k < nodes->n && !last; k++) last = (signed char)((arg[k] > zero) - (arg[k] < -zero));
    for (int k = 0; k < nodes->n; k++) {
        if (fabs(arg[k]) > zero) last = arg[k] > 0 ? 1 : -1;
        b->sign[k][i] = last;
    }
}

static int same_branch(const pm_extremum_branches *b, const signed char *one, const signed char *other)
{
    return memcmp(one, other, (size_t)b->at.n) == 0;
}

/* 1 if the branch changes somewhere. */
static int find_branches(pm_workspace *w, const pm_extremum *p, pm_extremum_branches *b)
{
    int found = 0;
    b->at.sign = NULL;
    pm_watched_samples_run(w, pm_ask_program(PM_ASK_ROW(w->model, p->ask)), &b->at, NULL);
    for (int i = 0; i < b->at.n; i++) found |= changes(w->step.nodes, b, i);
    for (int i = 0; i < b->at.n && found; i++) take_signs(w->step.nodes, b, i);
    return found;
}

/* The branch at all nodes; 0 if it has no value somewhere. */
static int sample_branch(pm_workspace *w, const pm_extremum *p, pm_extremum_branches *b,
                         const signed char *sign, pm_extremum *of)
{
    *of = *p;
    of->branch = &b->branch;
    of->size = 0;
    b->branch.here.sign = sign;
    pm_watched_samples_run(w, pm_ask_program(PM_ASK_ROW(w->model, p->ask)), &b->branch.here, of->g);
    for (int k = 0; k < w->step.nodes->n; k++) {
        if (!isfinite(of->g[k])) return 0;
        of->g[k] *= p->sign;
        of->size = pm_max(fabs(of->g[k]), of->size);
    }
    return 1;
}

/* Extremes of a branch beside nodes first .. last; nodes next to these show how far it may rise between them. */
static int extremes_of(pm_workspace *w, pm_extremum *of, int first, int last)
{
    const int from = first > 0 ? first - 1 : 0, to = last + 1 < w->step.nodes->n ? last + 1 : last;
    double least = INFINITY;
    int top = from;
    for (int k = from; k <= to; k++) {
        least = pm_min(of->g[k], least);
        if (of->g[k] > of->g[top]) top = k;
    }
    of->first = first;
    of->last = last;
    of->best = pm_extremum_best(w->ask, of);
    return pm_extremum_find(w, of, top, of->g[top] - least);
}

/* ---- between two nodes ---- */
static pm_switch_search search_of(const pm_model *m, const pm_extremum *p, int i)
{
    return (pm_switch_search){.program = pm_ask_program(PM_ASK_ROW(m, p->ask)), .exactly = 1, .i = i};
}

/* Where a switch changes, if that is inside the step. */
static int offer_at(pm_workspace *w, const pm_extremum *p, double t)
{
    return t > w->step.end ? PM_OK : pm_extremum_offer_at(w, p, t);
}

/* The branch that is taken right before a switch is passed, or right after it (at node k or the next one): of the other
 * switches those that stand there as they do beside it. */
static void signs_beside(const pm_extremum_branches *b, const pm_switches *there, int k,
                         pm_extremum_signs sign)
{
    for (int j = 0; j < b->at.n; j++) {
        const double arg = there->arg[j][0];
        sign[j] = fabs(arg) > b->branch.zero[j] ? (signed char)(arg < 0 ? -1 : 1) : b->sign[k][j];
    }
}

/* The value of the branch with these signs where the frame looks; but switch i may have changed what others are told by, which
 * come after it: they stand as that says. */
static double value_beside(pm_workspace *w, const pm_extremum *p, const pm_extremum_branches *b, int i,
                           pm_extremum_signs sign)
{
    pm_switches beside = {.sign = sign};
    const int program = pm_ask_program(PM_ASK_ROW(w->model, p->ask));
    double value = pm_watched_samples_here(w, program, &beside);
    for (int j = i + 1; j < b->at.n; j++) {
        const double arg = beside.arg[j][0];
        if (!(fabs(arg) > b->branch.zero[j]) || (arg < 0) == (sign[j] < 0)) continue;
        sign[j] = arg < 0 ? -1 : 1;
        value = pm_watched_samples_here(w, program, &beside);
    }
    return value;
}

/* The value jumps at switch i, where the frame looks, between node k and the next: what it comes from and what it goes to are
 * its branches there. */
static void offer_jump(pm_workspace *w, const pm_extremum *p, pm_extremum_branches *b, int i, int k)
{
    const int program = pm_ask_program(PM_ASK_ROW(w->model, p->ask));
    pm_switches there = {.sign = NULL};
    pm_extremum_signs sign;
    pm_watched_samples_here(w, program, &there);
    for (int side = 0; side < 2; side++) {
        signs_beside(b, &there, k + side, sign);
        sign[i] = b->sign[k + side][i];
        const double value = value_beside(w, p, b, i, sign);
        if (isfinite(value)) pm_ask_offer(w, p->ask, value, 0);
    }
}

/* The value where switch i changes between node k and the next: *t, or the node where it is zero. */
static int offer_switch(pm_workspace *w, const pm_extremum *p, pm_extremum_branches *b, int i, int k,
                        double *t)
{
    const double from = pm_step_node(&w->step, k), to = pm_step_node(&w->step, k + 1);
    const double fa = b->at.arg[i][k], fb = b->at.arg[i][k + 1];
    pm_switch_search x = search_of(w->model, p, i);
    *t = fabs(fa) < fabs(fb) ? from : to;
    if (!(fa * fb < 0)) return PM_OK;
    const enum pm_search_end end = pm_switch_search_find(w, &x, from, fa, to, fb, t);
    if (end == PM_SEARCH_NO_NUMBER) {
        w->ask->undefined[p->ask] = 1; /* it has no value somewhere */
        return PM_OK;
    }
    int status = pm_fail_search(&w->result, end);
    if (!status) status = offer_at(w, p, *t);
    if (!status && b->at.jumps[i] && *t <= w->step.end) offer_jump(w, p, b, i, k);
    return status;
}

/* Two branches that meet in a corner where neither is better than the other's: no extreme, since beside it there are better
 * values. */
static int only_dips(const pm_extremum_branches *b, int i, int k, const pm_extremum *left,
                     const pm_extremum *right)
{
    return !b->at.jumps[i] && left->g[k] >= right->g[k] && right->g[k + 1] >= left->g[k + 1];
}

/* No value between nodes k and k + 1 is far above those of the branches there. */
static int stays_below(const struct pm_ask_set *ask, const pm_extremum *left, const pm_extremum *right, int k)
{
    const double most = pm_max(pm_max(left->g[k], left->g[k + 1]), pm_max(right->g[k], right->g[k + 1]));
    const double spread = pm_max(fabs(left->g[k] - left->g[k + 1]), fabs(right->g[k] - right->g[k + 1]));
    return most + spread < pm_extremum_best(ask, left);
}

/* The branch between two places where switches change, if it is none of those at the nodes: its extremes. */
static int extremes_within(pm_workspace *w, const pm_extremum *p, pm_extremum_branches *b, int k, double t)
{
    pm_switch_search x = search_of(w->model, p, 0);
    pm_extremum_signs sign;
    pm_extremum of;
    (void)pm_switch_search_argument(w, t, &x);
    for (int i = 0; i < b->at.n; i++) sign[i] = x.here.arg[i][0] < 0 ? -1 : b->sign[k][i] != 0;
    if (same_branch(b, sign, b->sign[k]) || same_branch(b, sign, b->sign[k + 1])) return PM_OK;
    return sample_branch(w, p, b, sign, &of) ? extremes_of(w, &of, k, k + 1) : PM_OK;
}

/* Several switches change between node k and the next. */
static int several_switches(pm_workspace *w, const pm_extremum *p, pm_extremum_branches *b, int k)
{
    double switch_at[PM_SWITCHES];
    int n = 0;
    for (int i = 0; i < b->at.n; i++) {
        if (b->sign[k][i] == b->sign[k + 1][i]) continue;
        double t;
        const int status = offer_switch(w, p, b, i, k, &t);
        if (status) return status;
        int j = n++;
        for (; j > 0 && switch_at[j - 1] > t; j--) switch_at[j] = switch_at[j - 1];
        switch_at[j] = t;
    }
    const double apart = PM_SWITCHES_APART * (pm_step_node(&w->step, k + 1) - pm_step_node(&w->step, k));
    for (int j = 0; j + 1 < n; j++) {
        if (switch_at[j + 1] - switch_at[j] <= apart) continue;
        const int status = extremes_within(w, p, b, k, 0.5 * (switch_at[j] + switch_at[j + 1]));
        if (status) return status;
    }
    return PM_OK;
}

/* Corners and jumps between node k and the next, where one branch gives way to another. */
static int switches_between(pm_workspace *w, const pm_extremum *p, pm_extremum_branches *b, int k,
                            const pm_extremum *left, const pm_extremum *right)
{
    int n = 0, only = 0;
    for (int i = 0; i < b->at.n; i++)
        if (b->sign[k][i] != b->sign[k + 1][i]) n++, only = i;
    if (pm_step_node(&w->step, k) >= w->step.end || stays_below(w->ask, left, right, k)) return PM_OK;
    double t;
    if (n > 1) return several_switches(w, p, b, k);
    return only_dips(b, only, k, left, right) ? PM_OK : offer_switch(w, p, b, only, k, &t);
}

int pm_extremum_branch_all(pm_workspace *w, const pm_extremum *p, int *taken)
{
    pm_extremum_branches b;
    const int n = w->step.nodes->n;
    pm_extremum of[2]; /* before, now */
    *taken = find_branches(w, p, &b);
    for (int first = 0, last, i = 0; *taken && first < n; first = last + 1, i = !i) {
        for (last = first; last + 1 < n && same_branch(&b, b.sign[first], b.sign[last + 1]);) last++;
        *taken = sample_branch(w, p, &b, b.sign[first], &of[i]);
        if (!*taken) return PM_OK;
        int status = extremes_of(w, &of[i], first > 0 ? first - 1 : 0, last + 1 < n ? last + 1 : last);
        if (!status && first > 0) status = switches_between(w, p, &b, first - 1, &of[!i], &of[i]);
        if (status) return status;
    }
    return PM_OK;
}
