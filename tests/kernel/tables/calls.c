/* calls.c - tables through all that planemotion.h offers; every array that the kernel writes has its own length and no more. */
#include "calls.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fenced.h"
#include "planemotion.h"

#define MOST_OUT 100000 /* answers of a case: beyond, it is refused like a wrong count */

typedef struct results {
    int64_t ncase, nout, nask, progress;
    double *out, *error, *margin, *trust, *audit, *detail, *found;
    int32_t *reason, *status, *where;
    int64_t *count;
} results;

#define SCENE_OF(x) (x)->ntable, (x)->table, (x)->nconstant, (x)->constant

static int64_t answers(const tables *x)
{
    int64_t n = 0;
    for (int i = 0; i < tables_rows(x, PM_TABLE_ASK); i++) n += tables_row(x, PM_TABLE_ASK, i)[PM_ASK_COUNT];
    return n < 0 || n > MOST_OUT ? 0 : n;
}

static results results_create(const tables *x, int64_t ncase)
{
    results y = {.ncase = ncase, .nout = answers(x), .nask = tables_rows(x, PM_TABLE_ASK)};
    const size_t number = sizeof(double);
    y.out = fenced_room(ncase * y.nout, number);
    y.error = fenced_room(ncase * y.nout, number);
    y.margin = fenced_room(ncase * y.nask, number);
    y.trust = fenced_room(ncase * PM_TRUSTS, number);
    y.audit = fenced_room(ncase * PM_AUDITS, number);
    y.detail = fenced_room(ncase * PM_DETAIL_COLUMNS, number);
    y.found = fenced_room(ncase * PM_FOUND_COLUMNS, number);
    y.reason = fenced_room(ncase * y.nask, sizeof *y.reason);
    y.status = fenced_room(ncase, sizeof *y.status);
    y.where = fenced_room(ncase * PM_WHERE_COLUMNS, sizeof *y.where);
    y.count = fenced_room(ncase * PM_COUNT_COLUMNS, sizeof *y.count);
    return y;
}

static void results_free(results *y)
{
    void *const array[] = {y->out,   y->error,  y->margin, y->trust, y->audit, y->detail,
                           y->found, y->reason, y->status, y->where, y->count};
    for (size_t i = 0; i < sizeof array / sizeof *array; i++) fenced_leave(array[i]);
}

static int batch(const tables *x, const double *param, int workers, const int32_t *stop, results *y)
{
    return pm_batch(SCENE_OF(x), y->ncase, x->nparam, param, workers, stop, &y->progress, y->nout, y->out,
                    y->nask, y->reason, y->status, y->where, y->detail, y->audit, y->count, y->found,
                    y->error, y->margin, y->trust);
}

/* Numbers of an ask that says nothing against them: a list is filled from its begin. */
static int has_numbers(const int32_t *ask, const double *out)
{
    const int n = ask[PM_ASK_COUNT], list = ask[PM_ASK_KIND] == PM_ASK_EACH;
    int k = 0;
    while (k < n && isfinite(out[k])) k++;
    if (k == n) return 1;
    for (int i = k; i < n; i++)
        if (!list || !isnan(out[i])) return 0;
    return 1;
}

/* A case is ok only with numbers: where an ask has none it says why; the audit was made. */
static const char *not_sound(const tables *x, const results *y)
{
    for (int i = 0; i < y->nask; i++) {
        const int32_t *ask = tables_row(x, PM_TABLE_ASK, i);
        if (y->reason[i] == PM_REASON_NONE && !has_numbers(ask, y->out + ask[PM_ASK_OUT]))
            return "an answer is not finite and nothing says why";
    }
    for (int k = 0; k < PM_AUDITS; k++)
        if (!isfinite(y->audit[k])) return "an audit is not finite";
    return NULL;
}

static int run(const tables *x, const int32_t *stop, const char **fault)
{
    results y = results_create(x, 1);
    const int refused = batch(x, x->param, 1, stop, &y), status = refused ? refused : y.status[0];
    if (status == PM_OK) *fault = not_sound(x, &y);
    results_free(&y);
    return refused                                            ? CALLS_REFUSED
           : status == PM_BAD_TABLE || status == PM_BAD_VALUE ? CALLS_REFUSED
           : status < 0                                       ? CALLS_FAILED
           : status > 0                                       ? CALLS_EARLY
                                                              : CALLS_OK;
}

static void check(const tables *x, const int32_t *stop)
{
    const int njoint = tables_rows(x, PM_TABLE_JOINT), ncontact = tables_rows(x, PM_TABLE_CONTACT),
              nbody = tables_rows(x, PM_TABLE_BODY);
    int32_t info[PM_CHECK_COLUMNS], where[PM_WHERE_COLUMNS];
    double number[PM_CHECK_NUMBERS], detail[PM_DETAIL_COLUMNS];
    int32_t *joint = fenced_room(njoint, sizeof *joint), *contact = fenced_room(ncontact, sizeof *contact);
    double *pose = fenced_room(3 * nbody, sizeof *pose), *velocity = fenced_room(3 * nbody, sizeof *velocity);
    pm_check(SCENE_OF(x), x->nparam, x->param, stop, info, number, nbody, pose, velocity, njoint, joint,
             ncontact, contact, where, detail);
    fenced_leave(joint);
    fenced_leave(contact);
    fenced_leave(pose);
    fenced_leave(velocity);
}

static void explain(const tables *x, int64_t most, const int32_t *stop)
{
    const int cap = 3, njoint = tables_rows(x, PM_TABLE_JOINT), ncontact = tables_rows(x, PM_TABLE_CONTACT);
    int32_t phase[3 * PM_PHASE_COLUMNS], where[PM_WHERE_COLUMNS];
    double time[3], detail[PM_DETAIL_COLUMNS];
    int64_t needed;
    int32_t *joint = fenced_room(cap * njoint, sizeof *joint),
            *contact = fenced_room(cap * ncontact, sizeof *contact);
    pm_phases(SCENE_OF(x), x->nparam, x->param, stop, most, cap, phase, time, njoint, joint, ncontact,
              contact, &needed, where, detail);
    fenced_leave(joint);
    fenced_leave(contact);
}

static void needs(const tables *x, int of)
{
    const int rows = tables_rows(x, of);
    int32_t *needed = fenced_room(rows, sizeof *needed), where[PM_WHERE_COLUMNS];
    double detail[PM_DETAIL_COLUMNS];
    pm_needs(SCENE_OF(x), x->nparam, of, rows, needed, where, detail);
    fenced_leave(needed);
}

static void trace(const tables *x, uint64_t *r, const int32_t *stop)
{
    static const double grids[] = {0, 0, 0.01, 1e-300, NAN, -1, INFINITY},
                        bends[] = {1e-3, INFINITY, 0, NAN, 1e-300};
    const int64_t ntrace = tables_below(r, 4), cap = tables_below(r, 60);
    int32_t *program = fenced_room(ntrace, sizeof *program), *mark = fenced_room(cap, sizeof *mark);
    double *bend = fenced_room(ntrace, sizeof *bend),
           *history = fenced_room(cap * (1 + ntrace), sizeof *history);
    for (int64_t i = 0; i < ntrace; i++) {
        program[i] = (int32_t)tables_below(r, tables_rows(x, PM_TABLE_PROGRAM) + 1);
        bend[i] = bends[tables_below(r, 5)];
    }
    int64_t needed;
    int32_t where[PM_WHERE_COLUMNS];
    double detail[PM_DETAIL_COLUMNS];
    pm_trace(SCENE_OF(x), x->nparam, x->param, stop, grids[tables_below(r, 7)], ntrace, program, bend, cap,
             history, mark, &needed, where, detail);
    fenced_leave(program);
    fenced_leave(mark);
    fenced_leave(bend);
    fenced_leave(history);
}

int calls_all(const tables *x, uint64_t number, const int32_t *stop, const char **fault)
{
    uint64_t r = ~number;
    *fault = NULL;
    const int outcome = run(x, stop, fault);
    needs(x, (int)tables_below(&r, PM_TABLES));
    check(x, stop);
    if (outcome == CALLS_REFUSED) return outcome;
    if (tables_below(&r, 2))
        explain(x, tables_below(&r, 4), stop);
    else
        trace(x, &r, stop);
    return outcome;
}

static int same(const results *y, int64_t i)
{
    const size_t number = sizeof(double);
    return !memcmp(y->out, y->out + i * y->nout, (size_t)y->nout * number) &&
           !memcmp(y->error, y->error + i * y->nout, (size_t)y->nout * number) &&
           y->status[i] == y->status[0];
}

int calls_batch_differs(const tables *x, int ncase, int workers)
{
    results y = results_create(x, ncase);
    double *param = fenced_room(ncase * x->nparam, sizeof *param);
    const int32_t stop = 0;
    for (int i = 0; i < ncase; i++)
        if (x->nparam > 0) memcpy(param + i * x->nparam, x->param, (size_t)x->nparam * sizeof *param);
    int differs = batch(x, param, workers, &stop, &y) != PM_OK;
    for (int i = 1; i < ncase; i++) differs |= !same(&y, i);
    fenced_leave(param);
    results_free(&y);
    return differs;
}
