/* evidence.c - the log of decisions of a pass, and what routes note of their own errors.
 *
 * The log keeps every stride-th instant: it never grows.  What came of each instant is mixed into a history, which proves
 * that two logs run in step.  Where a series of blows without end is over another part of the run begins, at which passes
 * are in step again, however many of the blows each has seen. */
#include "state/evidence.h"

#include <math.h>
#include <stdlib.h>

#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/route.h"
#include "state/workspace.h"

#define FIRST 2166136261u
#define PART (1 << 18) /* numbers of instants, for each part of a run */

static uint32_t mixed(uint32_t history, uint32_t what) { return (history ^ what) * 16777619u; } /* FNV-1a */

void pm_evidence_mix(pm_evidence_log *log, uint32_t what) { log->history = mixed(log->history, what); }

static void begin_log(pm_evidence_log *log)
{
    log->n = 0;
    log->instant = 0;
    log->stride = 1;
    log->history = FIRST;
    log->trial = 0;
}

void pm_evidence_begin(const pm_model *model, pm_evidence *evidence)
{
    pm_pass *p = evidence->present;
    evidence->unseen.t = NAN;
    if (!evidence->active) return;
    evidence->noise = PM_EVIDENCE_SEED + (uint64_t)p->number;
    for (int i = 0; i < model->nout; i++) p->error[i] = NAN, p->more[i] = 0;
    p->margin = INFINITY;
    p->relative = p->late = 0;
    p->unsure = 0;
    p->cut = 0;
    p->alike = 0;
    p->tied = NAN;
    for (int i = 0; i < model->rows[PM_TABLE_TRIGGER]; i++) p->extreme[i] = INFINITY;
    begin_log(&p->log);
}

static double of_pass(const pm_workspace *w)
{
    const pm_evidence *e = &w->evidence;
    if (!e->active) return w->numbers.accuracy;
    const double tightest =
        fmax(fmin(w->numbers.accuracy, PM_EVIDENCE_LOOSEST / PM_COARSER) * e->present->factor,
             w->phase.route->finest);
    return e->present->coarse ? PM_COARSER * tightest : tightest;
}

double pm_evidence_tolerance(const pm_workspace *w) { return fmax(of_pass(w), w->evidence.loosest); }

int pm_evidence_is_coarse(const pm_evidence *evidence)
{
    return evidence->active && evidence->present->coarse;
}

int pm_evidence_is_fine(const pm_evidence *evidence) { return evidence->active && evidence->present->fine; }

int pm_evidence_in_halves(const pm_evidence *evidence)
{
    return evidence->active && evidence->present->halves;
}

double pm_evidence_noise(pm_evidence *evidence, int i)
{
    if (!pm_evidence_is_coarse(evidence)) return 0;
    evidence->noise = evidence->noise * 6364136223846793005ULL + 1442695040888963407ULL;
    return (evidence->noise >> 63 ? 1 : -1) + (i % 2 ? PM_EVIDENCE_DRIFT : -PM_EVIDENCE_DRIFT);
}

void pm_evidence_answer(pm_evidence *evidence, int column, double error)
{
    if (evidence->active) evidence->present->error[column] = error;
}

void pm_evidence_more(pm_evidence *evidence, int column, double more)
{
    if (evidence->active) evidence->present->more[column] += more;
}

void pm_evidence_cut(pm_evidence *evidence)
{
    if (evidence->active) evidence->present->cut = 1;
}

void pm_evidence_ties(pm_evidence *evidence, double t)
{
    if (evidence->active && !evidence->seeks) evidence->present->tied = t;
}

void pm_evidence_unseen(pm_evidence *evidence, int table, int row, double t)
{
    if (evidence->seeks || !isnan(evidence->unseen.t)) return;
    evidence->unseen = (pm_unseen){t, table, row};
}

int pm_evidence_has_series(const pm_pass *pass) { return pass->cut || pass->log.instant >= PART; }

void pm_evidence_decide(pm_evidence *evidence, double distance, double error)
{
    if (evidence->active && !evidence->seeks) /* what is sought lies on a threshold */
        evidence->present->margin = pm_min(fabs(distance) / error, evidence->present->margin);
}

/* The log is full: from now on only every second instant of those kept so far. */
static void thin_out(pm_evidence_log *log)
{
    int n = 0;
    log->stride *= 2;
    for (int i = 0; i < log->n; i++)
        if (pm_evidence_is_kept(log->entry[i].instant, log->stride)) log->entry[n++] = log->entry[i];
    log->n = n;
}

/* Whether one more decision finds room; without memory the log is as good as full. */
static int has_room(pm_evidence_log *log)
{
    if (log->n < log->room) return 1;
    if (log->room == PM_DECISIONS) return 0;
    const int room = log->room ? 2 * log->room : PM_DECISIONS_FEW;
    pm_evidence_decision *const entry = realloc(log->entry, (size_t)room * sizeof *entry);
    if (!entry) return 0;
    log->entry = entry;
    log->room = room;
    return 1;
}

void pm_evidence_free_log(void *log) { free(((pm_evidence_log *)log)->entry); }

void pm_evidence_take(pm_evidence *evidence, const pm_evidence_decision *decision)
{
    pm_evidence_log *log = &evidence->present->log;
    while (pm_evidence_is_kept(log->instant, log->stride) && !has_room(log)) {
        if (log->stride > log->instant) return;
        thin_out(log);
    }
    if (!pm_evidence_is_kept(log->instant, log->stride)) return;
    log->entry[log->n] = *decision;
    log->entry[log->n].instant = log->instant;
    log->entry[log->n].trial = log->trial;
    log->entry[log->n++].history = log->history;
}

void pm_evidence_take_after(pm_evidence *evidence, const pm_evidence_decision *decision)
{
    const pm_evidence_log *log = &evidence->present->log;
    const pm_evidence_decision *last = log->n > 0 ? &log->entry[log->n - 1] : NULL;
    pm_evidence_decision x = *decision;
    if (last && last->instant == log->instant) x.approach = last->approach;
    pm_evidence_take(evidence, &x);
}

void pm_evidence_sign(pm_evidence *evidence, int site, int what, double x, double unit)
{
    if (!evidence->active) return;
    pm_evidence_take(evidence, &(pm_evidence_decision){.kind = PM_EVIDENCE_SIGN,
                                                       .what = PM_EVIDENCE_SITES * what + site,
                                                       .trigger = PM_NONE,
                                                       .distance = x,
                                                       .reach = fabs(x),
                                                       .unit = unit});
}

void pm_evidence_blow(pm_evidence *evidence, double approach)
{
    if (!evidence->active) return;
    pm_evidence_log *log = &evidence->present->log;
    for (int i = log->n - 1; i >= 0 && log->entry[i].instant == log->instant; i--)
        if (log->entry[i].approach == 0) log->entry[i].approach = approach;
}

void pm_evidence_date(pm_evidence_log *log, double t)
{
    double approach = 0;
    int first = log->n;
    while (first > 0 && log->entry[first - 1].instant == log->instant) first--;
    for (int i = first; i < log->n; i++)
        if (log->entry[i].approach != 0) approach = log->entry[i].approach;
    for (int i = first; i < log->n; i++) {
        log->entry[i].t = t;
        if (log->entry[i].approach == 0) log->entry[i].approach = approach;
    }
}

void pm_evidence_try(pm_evidence *evidence, uint32_t trial)
{
    if (evidence->active) evidence->present->log.trial = trial;
}

int32_t pm_evidence_part_of(const pm_evidence_decision *x) { return x->instant / PART; }

void pm_evidence_part(pm_evidence *evidence, int contact)
{
    if (!evidence->active) return;
    pm_evidence_log *log = &evidence->present->log;
    const int32_t part = log->instant / PART + 1;
    if (part > INT32_MAX / PART - 1) return;
    log->instant = part * PART;
    log->history = mixed(FIRST, (uint32_t)contact);
}

void pm_evidence_leap(pm_evidence *evidence, int contact, int alike)
{
    if (!evidence->active) return;
    evidence->present->alike += alike;
    pm_evidence_part(evidence, contact);
}

int pm_evidence_is_open(const pm_evidence_decision *x, double unit)
{
    return x->reach > PM_EVIDENCE_NOTHING * unit;
}
