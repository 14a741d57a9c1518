/* batch.c - cases over threads, and the other public entries.  One workspace per thread, cases from one atomic counter;
 * a case's numbers depend on its own parameters only. */
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

#include "equations/active_set.h"
#include "equations/shared_loads.h"
#include "events/history.h"
#include "run/run.h"
#include "scene/build.h"
#include "scene/dependency.h"
#include "scene/prune.h"
#include "state/workspace.h"
#include "study/accuracy.h"

#define MOST_WORKERS 256

static const pm_where nowhere = {PM_NONE, PM_NONE, PM_NONE, NAN, NAN};

typedef struct pm_job {
    const pm_model *model;
    int64_t ncase;
    const double *param;
    const int32_t *stop; /* read, and *progress added to, by atomic operations: other threads use them, too */
    int64_t *progress;
    double *out, *detail, *audit, *found, *error, *margin, *trust;
    int32_t *reason, *status, *where;
    int64_t *count;
    atomic_llong next;
} pm_job;

typedef struct pm_worker {
    pthread_t thread;
    int started;
    pm_job *job;
    pm_workspace *workspace;
} pm_worker;

static void report(const pm_where *x, double t, int32_t *where, double *detail)
{
    where[PM_WHERE_TABLE] = x->table;
    where[PM_WHERE_ROW] = x->row;
    where[PM_WHERE_MEMBER] = x->member;
    detail[PM_DETAIL_VALUE] = x->value;
    detail[PM_DETAIL_BOUND] = x->bound;
    detail[PM_DETAIL_TIME] = t;
}

/* Where a case failed, by the rows of the caller's own tables. */
static void report_case(const pm_workspace *w, int32_t *where, double *detail)
{
    pm_where x = w->result.where;
    x.row = pm_prune_original(w->model, x.table, x.row);
    report(&x, w->state.t, where, detail);
}

/* The blow that a case has to tell of, likewise. */
static void report_ordered(const pm_workspace *w, int32_t *where, double *detail)
{
    pm_where x = w->result.ordered;
    x.row = pm_prune_original(w->model, x.table, x.row);
    x.member = pm_prune_original(w->model, x.table, x.member);
    report(&x, w->state.t, where, detail);
}

static void run_one(pm_workspace *w, pm_job *job, int64_t i)
{
    const pm_model *m = job->model;
    w->result.out = job->out + i * m->nout;
    w->result.reason = job->reason + i * m->nask;
    w->result.audit = job->audit + i * PM_AUDITS;
    job->status[i] =
        pm_accuracy_run(w, job->param + i * m->nparam, job->found + i * PM_FOUND_COLUMNS,
                        job->error + i * m->nout, job->margin + i * m->nask, job->trust + i * PM_TRUSTS);
    (job->status[i] == PM_OK ? report_ordered : report_case)(w, job->where + i * PM_WHERE_COLUMNS,
                                                             job->detail + i * PM_DETAIL_COLUMNS);
    memcpy(job->count + i * PM_COUNT_COLUMNS, w->result.count, sizeof w->result.count);
}

/* A case that the stop flag keeps from being begun. */
static void cancel_one(pm_job *job, int64_t i)
{
    const pm_model *m = job->model;
    for (int k = 0; k < m->nout; k++) job->out[i * m->nout + k] = job->error[i * m->nout + k] = NAN;
    for (int k = 0; k < PM_TRUSTS; k++) job->trust[i * PM_TRUSTS + k] = NAN;
    for (int k = 0; k < m->nask; k++) {
        job->reason[i * m->nask + k] = PM_REASON_FAILED;
        job->margin[i * m->nask + k] = NAN;
    }
    for (int k = 0; k < PM_AUDITS; k++) job->audit[i * PM_AUDITS + k] = NAN;
    for (int k = 0; k < PM_WHERE_COLUMNS; k++) job->where[i * PM_WHERE_COLUMNS + k] = PM_NONE;
    for (int k = 0; k < PM_DETAIL_COLUMNS; k++) job->detail[i * PM_DETAIL_COLUMNS + k] = NAN;
    for (int k = 0; k < PM_FOUND_COLUMNS; k++) job->found[i * PM_FOUND_COLUMNS + k] = NAN;
    memset(job->count + i * PM_COUNT_COLUMNS, 0, PM_COUNT_COLUMNS * sizeof *job->count);
    job->status[i] = PM_CANCELLED;
}

static void *work(void *x)
{
    pm_worker *worker = x;
    pm_job *job = worker->job;
    for (;;) {
        const int64_t i = atomic_fetch_add(&job->next, 1);
        if (i >= job->ncase) return NULL;
        if (pm_patience_is_stopped(job->stop))
            cancel_one(job, i);
        else
            run_one(worker->workspace, job, i);
        if (job->progress) __atomic_fetch_add(job->progress, 1, __ATOMIC_RELAXED);
    }
}

static int run_workers(pm_job *job, int nworker)
{
    pm_worker worker[MOST_WORKERS];
    int status = PM_OK, n = 0;
    if (nworker > job->ncase) nworker = (int)job->ncase;
    if (nworker > MOST_WORKERS) nworker = MOST_WORKERS;
    if (nworker < 1) nworker = 1;
    if (job->progress) __atomic_store_n(job->progress, 0, __ATOMIC_RELAXED);
    for (; n < nworker && !status; n++) {
        worker[n] = (pm_worker){.job = job};
        status = pm_accuracy_create(job->model, &worker[n].workspace);
        if (!status) worker[n].workspace->patience.stop = job->stop;
    }
    if (!status) {
        for (int i = 1; i < n; i++)
            worker[i].started = pthread_create(&worker[i].thread, NULL, work, &worker[i]) == 0;
        work(&worker[0]); /* fewer threads than asked still do all cases */
        for (int i = 1; i < n; i++)
            if (worker[i].started) pthread_join(worker[i].thread, NULL);
    }
    for (int i = 0; i < n; i++) pm_workspace_free(worker[i].workspace);
    return status;
}

int pm_batch(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t ncase,
             int64_t nparam, const double *param, int nworker, const int32_t *stop, int64_t *progress,
             int64_t nout, double *out, int64_t nask, int32_t *reason, int32_t *status, int32_t *where,
             double *detail, double *audit, int64_t *count, double *found, double *error, double *margin,
             double *trust)
{
    pm_model *model;
    pm_where place = nowhere;
    int result = pm_prune_create(ntable, table, nconstant, constant, nparam, &model, &place);
    if (!result && (model->nout != nout || model->nask != nask)) {
        place = (pm_where){PM_TABLE_ASK, PM_NONE, PM_NONE, (double)nout, model->nout};
        result = PM_BAD_TABLE;
    }
    if (!result && ncase > 0) {
        pm_job job = {.model = model,
                      .ncase = ncase,
                      .param = param,
                      .stop = stop,
                      .progress = progress,
                      .out = out,
                      .detail = detail,
                      .audit = audit,
                      .reason = reason,
                      .status = status,
                      .where = where,
                      .count = count,
                      .found = found,
                      .error = error,
                      .margin = margin,
                      .trust = trust};
        result = run_workers(&job, nworker);
    }
    if (result && ncase > 0) report(&place, NAN, where, detail);
    pm_model_free(model);
    return result;
}

typedef int pm_create(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant,
                      int64_t nparam, pm_model **model, pm_where *where);

/* One case in a workspace of its own; `create`: of the whole scene, or of what its answers need. */
static int open_one(pm_create *create, int64_t ntable, const int32_t *table, int64_t nconstant,
                    const double *constant, int64_t nparam, pm_model **model, pm_workspace **w,
                    int32_t *where, double *detail)
{
    pm_where place = nowhere;
    int status = create(ntable, table, nconstant, constant, nparam, model, &place);
    if (!status) status = pm_accuracy_create(*model, w);
    report(&place, NAN, where, detail);
    if (status) pm_model_free(*model);
    return status;
}

static int close_one(pm_model *model, pm_workspace *w, int status)
{
    pm_workspace_free(w);
    pm_model_free(model);
    return status;
}

/* The answers of a case for whose answers nobody has asked: its asks are answered all the same, from its start on. */
static int keep_answers(pm_workspace *w)
{
    const pm_array array[] = {PM_ARRAY(w->result.out, w->model->nout),
                              PM_ARRAY(w->result.reason, w->model->nask),
                              PM_ARRAY(w->result.audit, PM_AUDITS)};
    return pm_arena_take(&w->memory, PM_ARRAYS(array)) ? PM_NO_MEMORY : PM_OK;
}

/* Runs a case for what it records of itself. */
static int run_recorded(pm_workspace *w, const double *param, int32_t *where, double *detail)
{
    double trust[PM_TRUSTS], *error, *margin;
    const pm_array array[] = {PM_ARRAY(error, w->model->nout), PM_ARRAY(margin, w->model->nask)};
    if (keep_answers(w) || pm_arena_take(&w->memory, PM_ARRAYS(array))) return PM_NO_MEMORY;
    const int status = pm_accuracy_run(w, param, NULL, error, margin, trust);
    report_case(w, where, detail);
    return status;
}

int pm_trace(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t nparam,
             const double *param, const int32_t *stop, double every, int64_t ntrace,
             const int32_t *trace_program, const double *bend, int64_t cap, double *history, int32_t *mark,
             int64_t *needed, int32_t *where, double *detail)
{
    pm_model *model;
    pm_workspace *w;
    *needed = 0;
    int status =
        open_one(pm_model_create, ntable, table, nconstant, constant, nparam, &model, &w, where, detail);
    if (status) return status;
    pm_history record = {.nprogram = ntrace,
                         .cap = cap,
                         .program = trace_program,
                         .bend = bend,
                         .every = every,
                         .history = history,
                         .mark = mark};
    for (int64_t i = 0; i < ntrace && !status; i++)
        if (trace_program[i] < 0 || trace_program[i] >= w->model->rows[PM_TABLE_PROGRAM])
            status = PM_BAD_TABLE;
    if (!(every >= 0) || isinf(every)) status = PM_BAD_TABLE;
    w->record.history = &record;
    w->patience.stop = stop;
    if (!status) status = pm_history_create(w, &record);
    if (!status) status = run_recorded(w, param, where, detail);
    *needed = record.needed;
    return close_one(model, w, status);
}

int pm_phases(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t nparam,
              const double *param, const int32_t *stop, int64_t most, int64_t cap, int32_t *phase,
              double *time, int64_t njoint, int32_t *joint, int64_t ncontact, int32_t *contact,
              int64_t *needed, int32_t *where, double *detail)
{
    pm_model *model;
    pm_workspace *w;
    *needed = 0;
    int status =
        open_one(pm_prune_create, ntable, table, nconstant, constant, nparam, &model, &w, where, detail);
    if (status) return status;
    pm_phase_report list = {.cap = cap,
                            .most = most,
                            .row = phase,
                            .time = time,
                            .njoint = njoint,
                            .joint = joint,
                            .ncontact = ncontact,
                            .contact = contact};
    w->record.phases = &list;
    w->patience.stop = stop;
    status = run_recorded(w, param, where, detail);
    *needed = list.needed;
    return close_one(model, w, status);
}

static void report_check(const pm_workspace *w, const pm_start_report *report, int32_t *info, double *number)
{
    const pm_model *m = w->model;
    int coordinates = 0, closed = 0;
    for (int i = 0; i < m->nq; i++) coordinates += w->numbers.inverse_mass[i] > 0;
    for (int i = 0; i < m->nslot; i++) closed += w->state.slot[i].mode != PM_OPEN;
    info[PM_CHECK_COORDINATES] = coordinates;
    info[PM_CHECK_CONSTRAINTS] = w->active.n + w->active.nredundant;
    info[PM_CHECK_REDUNDANT] = w->active.nredundant;
    info[PM_CHECK_FREEDOM] = coordinates - w->active.n;
    info[PM_CHECK_CLOSED] = closed;
    number[PM_CHECK_MOVED] = report->moved;
    number[PM_CHECK_SIZE] = w->numbers.size;
    number[PM_CHECK_OPENING] = report->opening;
    info[PM_CHECK_EQUILIBRIUM] = report->equilibrium;
    number[PM_CHECK_SETTLED] = report->settled;
}

int pm_check(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t nparam,
             const double *param, const int32_t *stop, int32_t *info, double *number, int64_t nbody,
             double *pose, double *velocity, int64_t njoint, int32_t *joint, int64_t ncontact,
             int32_t *contact, int32_t *where, double *detail)
{
    pm_model *model;
    pm_workspace *w;
    int status =
        open_one(pm_model_create, ntable, table, nconstant, constant, nparam, &model, &w, where, detail);
    if (status) return status;
    if (w->model->nbody != nbody || njoint < model->rows[PM_TABLE_JOINT] ||
        ncontact < model->rows[PM_TABLE_CONTACT]) {
        status = PM_BAD_TABLE;
    } else if (!(status = keep_answers(w))) {
        pm_start_report report = {0};
        memset(info, 0, PM_CHECK_COLUMNS * sizeof *info);
        w->patience.stop = stop;
        pm_patience_begin(&w->patience);
        status = pm_run_start(w, param, &report);
        report_case(w, where, detail);
        report_check(w, &report, info, number);
        if (!status) pm_shared_elements(w, joint, contact);
        memcpy(pose, w->state.q, (size_t)w->model->nq * sizeof *pose);
        memcpy(velocity, w->state.v, (size_t)w->model->nq * sizeof *velocity);
    }
    return close_one(model, w, status);
}

int pm_needs(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t nparam,
             int of, int64_t nrow, int32_t *needed, int32_t *where, double *detail)
{
    pm_model *model;
    pm_dependency x = {.block = NULL};
    pm_where place = nowhere;
    int status = pm_model_create(ntable, table, nconstant, constant, nparam, &model, &place);
    if (!status) status = pm_dependency_find(model, &x);
    if (!status && (of < 0 || of >= PM_TABLES || nrow != model->rows[of])) status = PM_BAD_TABLE;
    for (int64_t i = 0; i < nrow && !status; i++) needed[i] = x.row[of][i] != 0;
    report(&place, NAN, where, detail);
    pm_dependency_free(&x);
    pm_model_free(model);
    return status;
}
