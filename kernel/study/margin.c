/* margin.c - the margin from the logs of two passes.
 *
 * Every decision compares a number x with 0: a function of the phase that did not fire, the rate of one that did, an
 * impulse that must not pull.  Two passes of a case that differ by their errors only give x and x': the margin of the
 * decision is the smaller of both over |x - x'|.  As long as the passes decide alike their logs run in step, which the
 * history proves; near misses are seen by one pass and perhaps not by the other, and are then left out. */
#include "events/event_search.h"
#include "numerics/tolerances.h"
#include "study/accuracy.h"

#include <math.h>

/* Late in a series of ever smaller blows two passes are not at the same blow; its decisions then decide nothing that the
 * errors of the speeds do not hold already. */
static int are_other_blows(const pm_evidence_decision *x, const pm_evidence_decision *y)
{
    if (x->approach == PM_EVIDENCE_LAST_BLOW || y->approach == PM_EVIDENCE_LAST_BLOW) return 1;
    const double low = fmin(x->approach, y->approach), high = fmax(x->approach, y->approach);
    return high > PM_MARGIN_SAME_BLOW * low;
}

/* Since the last instant at another time than that of entry i, s. */
static double time_between(const pm_evidence_log *log, int i)
{
    const pm_evidence_decision *x = &log->entry[i];
    while (i > 0 && log->entry[i - 1].t == x->t) i--;
    return i > 0 ? x->t - log->entry[i - 1].t : INFINITY;
}

/* Passes of which one is at another instant by now: it has seen one more of a series, or one less. */
static int are_other_instants(const pm_evidence_log *a, int i, const pm_evidence_log *b, int j)
{
    const double off = fabs(a->entry[i].t - b->entry[j].t);
    return off > PM_MARGIN_SAME_INSTANT * fmin(time_between(a, i), time_between(b, j));
}

/* How far apart two passes are: where a distance is a part of what counts as touching, by this part, if that is nearer. */
static double apart(const pm_evidence_decision *x, const pm_evidence_decision *y)
{
    const double plain = fabs(x->distance - y->distance);
    if (x->touching == 0 || y->touching == 0) return plain;
    return fmin(plain, fabs(x->distance / x->touching - y->distance / y->touching));
}

static double margin_of(const pm_evidence_decision *x, const pm_evidence_decision *y,
                        const double *trigger_scale)
{
    if (x->kind == PM_EVIDENCE_RATE && x->in_time != y->in_time) return INFINITY;
    if (are_other_blows(x, y)) return INFINITY;
    const double unit = x->unit * (x->trigger == PM_NONE ? 1 : trigger_scale[x->trigger]);
    const double least = fmin(fabs(x->distance), fabs(y->distance));
    if (!pm_evidence_is_open(x, unit) && !pm_evidence_is_open(y, unit)) return INFINITY;
    return least / fmax(apart(x, y), PM_MARGIN_LEAST * unit);
}

static int same(const pm_evidence_decision *x, const pm_evidence_decision *y)
{
    return x->instant == y->instant && x->history == y->history && x->trial == y->trial &&
           x->kind == y->kind && x->what == y->what;
}

/* Whether a function is still held at its last zero, and whether it is seen to come close, depends on the steps. */
static int may_lack(const pm_evidence_decision *x)
{
    return x->kind == PM_EVIDENCE_VALUE || x->kind == PM_EVIDENCE_NEAR;
}

/* In the order in which pm_event_evidence_instant takes them. */
static int comes_first(const pm_evidence_decision *x, const pm_evidence_decision *y)
{
    if (x->instant != y->instant) return x->instant < y->instant;
    return x->what != y->what ? x->what < y->what : x->kind == PM_EVIDENCE_NEAR;
}

static int next_instant(const pm_evidence_log *log, int i)
{
    const int32_t instant = log->entry[i].instant;
    while (i < log->n && log->entry[i].instant == instant) i++;
    return i;
}

static int next_part(const pm_evidence_log *log, int i)
{
    const int32_t part = pm_evidence_part_of(&log->entry[i]);
    while (i < log->n && pm_evidence_part_of(&log->entry[i]) == part) i++;
    return i;
}

/* That of entry i of a and entry j of b, if it is less than x and of one instant. */
static pm_closest closer(pm_closest x, const pm_evidence_log *a, int i, const pm_evidence_log *b, int j,
                         const double *trigger_scale)
{
    const double margin = margin_of(&a->entry[i], &b->entry[j], trigger_scale);
    if (!(margin < x.margin) || are_other_instants(a, i, b, j)) return x;
    return (pm_closest){margin, &a->entry[i], PM_NONE, x.parted};
}

/* The instant before that of entry i, s: the histories there tell what came of it. */
static double time_before(const pm_evidence_log *log, int i)
{
    const int32_t instant = log->entry[i].instant;
    while (i > 0 && log->entry[i].instant == instant) i--;
    return log->entry[i].instant < instant ? log->entry[i].t : 0;
}

static int have_parted(const pm_evidence_decision *x, const pm_evidence_decision *y)
{
    return x->instant == y->instant && x->history != y->history;
}

pm_closest pm_margin_of_logs(const pm_evidence_log *a, const pm_evidence_log *b, const double *trigger_scale)
{
    const int32_t stride = a->stride > b->stride ? a->stride : b->stride;
    pm_closest closest = {INFINITY, NULL, PM_NONE, 0};
    for (int i = 0, j = 0; i < a->n && j < b->n;) {
        const pm_evidence_decision *x = &a->entry[i], *y = &b->entry[j];
        if (closest.parted == 0 && have_parted(x, y)) closest.parted = time_before(a, i);
        if (!pm_evidence_is_kept(x->instant, stride)) {
            i++;
        } else if (!pm_evidence_is_kept(y->instant, stride)) {
            j++;
        } else if (pm_evidence_part_of(x) < pm_evidence_part_of(y)) {
            i++;
        } else if (pm_evidence_part_of(x) > pm_evidence_part_of(y)) {
            j++;
        } else if (same(x, y)) {
            closest = closer(closest, a, i++, b, j++, trigger_scale);
        } else if (may_lack(x) && (!may_lack(y) || comes_first(x, y))) {
            i++;
        } else if (may_lack(y)) {
            j++;
        } else if (x->instant == y->instant && x->history == y->history) {
            i = next_instant(a, i); /* the same outcome by another way */
            j = next_instant(b, j);
        } else {
            i = next_part(a, i); /* from here on the passes have gone different ways */
            j = next_part(b, j);
        }
    }
    return closest;
}

/* ---- of a case ---- */
/* Those of a series of which the rest was taken at once do not count: a coarse run takes it earlier. */
static int64_t jumps_of(const pm_pass *p) { return p->count[PM_COUNT_JUMPS] - p->alike; }

int pm_margin_same_jumps(const pm_accuracy *e)
{
    const pm_pass *a = e->main, *b = e->other;
    return a->cut || b->cut || jumps_of(a) == jumps_of(b);
}

static int is_tied(const pm_pass *p) { return !isnan(p->tied); }
static int is_unseen(const pm_pass *p) { return !isnan(p->unseen.t); }

double pm_margin_judge(pm_accuracy *e, double share)
{
    const pm_pass *a = e->main, *b = e->other;
    pm_closest closest = pm_margin_of_logs(&a->log, &b->log, e->size.trigger);
    e->closest.parted = closest.parted;
    if (a->outcome != b->outcome || is_tied(a) || is_tied(b) || is_unseen(a) || is_unseen(b)) return 0;
    closest.margin /= share;
    if (closest.margin < e->closest.margin) e->closest = closest;
    return fmin(e->closest.margin, a->margin);
}

static pm_where where_unseen(const pm_unseen *x)
{
    return (pm_where){x->table, x->row, PM_DECISION_UNSEEN, 0, 1};
}

int pm_margin_unseen(pm_workspace *w)
{
    const pm_unseen *x = &w->evidence.unseen;
    if (isnan(x->t)) return PM_OK;
    w->result.where = where_unseen(x);
    w->state.t = x->t;
    return PM_UNDECIDED;
}

void pm_margin_undecided(const pm_model *model, pm_accuracy *e, double margin)
{
    pm_pass *p = e->main;
    double t = is_tied(p) ? p->tied : e->other->tied;
    p->status = PM_UNDECIDED;
    p->where = (pm_where){PM_NONE, PM_NONE, PM_DECISION_OUTCOME, 0, 0};
    const pm_pass *unseen = is_unseen(p) ? p : e->other;
    if (!isnan(t))
        p->where.member = PM_DECISION_ORDER;
    else if (is_unseen(unseen)) {
        p->where = where_unseen(&unseen->unseen);
        t = unseen->unseen.t;
    } else if (e->closest.margin <= margin)
        p->where = pm_event_evidence_where(model, &e->closest, &t);
    else if (e->other->status != PM_OK) {
        p->where = (pm_where){e->other->where.table, e->other->where.row, PM_DECISION_ENDS, 0, 0};
        t = e->other->t;
    } else if (e->closest.parted > 0)
        t = e->closest.parted;
    p->where.value = margin;
    p->where.bound = 1;
    if (!isnan(t)) p->t = t;
}
