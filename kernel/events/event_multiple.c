/* event_multiple.c - the multiples of a trigger of kind PM_TRIGGER_EVERY: which of them is next in a step.
 *
 * Its program p reaches integers.  Known is between which two of them it is, or on which; that is kept from step to step and from
 * phase to phase, so that none is lost, or met twice, where one begins on a multiple but for rounding.
 *
 *   low < p < high,   high = low + 1;     on a multiple: p = low + 1, high = low + 2
 *
 * A step is gone through from place to place: its nodes, and the places between them where p turns back.  From one of them to the
 * next p only rises or falls, and the multiple that it reaches first is `low` or `high`.  From one on which it is it must first
 * part, to either side, and may then come back to it. */
#include "events/event_multiple.h"

#include <math.h>

#include "events/step.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

/* ---- between which multiples ---- */
void pm_event_multiple_reach(pm_event_set *event, const pm_event_function *f)
{
    if (!f->every) return;
    event->multiples[f->index].low = f->multiple - 1;
    event->multiples[f->index].high = f->multiple + 1;
}

/* So much of p, next to a multiple, is `part` of what one can tell. */
static double nothing(double p, double part) { return part * pm_max(1, fabs(p)); }

static int is_on(const pm_multiples *m) { return m->high - m->low > 1.5; }

int pm_event_multiple_holds(const pm_event_set *e, const pm_event_function *f, double value)
{
    const pm_multiples *m = &e->multiples[f->index];
    const double multiple = m->low + 1;
    return is_on(m) && fabs(value + f->multiple - multiple) <= nothing(multiple, PM_ON_MULTIPLE);
}

/* On a multiple, p has parted from it to the side where it is now, or not yet. */
static void part(pm_multiples *m, double p, double by)
{
    const double multiple = m->low + 1;
    if (!is_on(m) || fabs(p - multiple) <= nothing(multiple, by)) return;
    m->low = p > multiple ? multiple : multiple - 1;
    m->high = m->low + 1;
}

/* p begins a step where it ended the last one, but for rounding, unless it has jumped or others were passed over. */
static void begin(const pm_event_set *e, pm_event_function *f, double p)
{
    pm_multiples *m = &e->multiples[f->index];
    const double rounding = nothing(p, PM_ON_MULTIPLE), nearest = round(p);
    if (!(p >= m->low - rounding && p <= m->high + rounding)) {
        const int holds = fabs(p - nearest) <= rounding;
        m->low = holds ? nearest - 1 : floor(p);
        m->high = m->low + 1 + holds;
    }
    part(m, p, PM_ON_MULTIPLE);
    f->held = is_on(m);
    f->since = e->place[0];
}

/* From now on f is counted from this one. */
static void count_from(pm_event_function *f, double multiple)
{
    if (f->multiple == multiple) return;
    f->multiple = multiple;
    f->ranged = 0;
    f->tail = -1;
}

/* ---- where it turns back ---- */
/* Three places of which s p is least at the middle one. */
typedef struct pm_multiple_dip {
    double s;
    pm_multiple_place at[3];
    pm_event_at *value_at;
} pm_multiple_dip;

/* Where the parabola through the three is least, or at least a little beside the middle one, on the longer side. */
static double next_look(const pm_multiple_dip *x)
{
    const pm_multiple_place *a = &x->at[0], *m = &x->at[1], *b = &x->at[2];
    const double left = m->place - a->place, right = b->place - m->place,
                 from = x->s * (a->value - m->value) / left, to = x->s * (b->value - m->value) / right,
                 least = PM_DIP_STEP * (left + right), side = right > left ? least : -least;
    const double shift = 0.5 * (from * right - to * left) / (from + to);
    return m->place + (fabs(shift) > least ? shift : side);
}

/* The three come closer and closer about the place where p turns back. */
static void close_in(pm_workspace *w, pm_event_function *f, pm_multiple_dip *x)
{
    const double enough = PM_TURN_PLACE * (x->at[2].place - x->at[0].place);
    for (int i = 0; i < PM_TURN_LOOKS && x->at[2].place - x->at[0].place > enough; i++) {
        const double place = next_look(x);
        if (!(place > x->at[0].place && place < x->at[2].place)) return;
        const pm_multiple_place here = {place, f->multiple + x->value_at(w, place, f)};
        const int after = place > x->at[1].place, deeper = x->s * here.value < x->s * x->at[1].value;
        if (deeper) x->at[after ? 0 : 2] = x->at[1];
        x->at[deeper ? 1 : after ? 2 : 0] = here;
    }
}

/* It came close to a multiple, and went back: a decision to be noted. */
static void note_near(pm_event_function *f, double s, double p, double around)
{
    const double next = s > 0 ? floor(p) : ceil(p), near = fabs(p - next);
    if (near >= f->near || near > PM_MULTIPLE_CLOSE) return;
    f->near = near;
    f->near_reach = pm_max(fabs(around - next), near);
}

/* From p to the next multiple, where s p falls, it is deeper than it may be; or that is rounding. */
static int is_shallow(double s, double p, double depth)
{
    const double next = ceil(s * p) - 1;
    return depth <= nothing(p, PM_ON_ZERO) || s * p - next > depth + PM_MULTIPLE_CLOSE;
}

/* Between an end of the step and the node next to it p goes on beyond the end, and turns back: 1, and a place beyond it. */
static int dips_beside_end(pm_workspace *w, pm_event_function *f, const double *p, int end, int beside,
                           pm_multiple_dip *x)
{
    const double *place = w->event->place, h = place[beside] - place[end], rise = p[beside] - p[end],
                 slope = pm_chebyshev_slope_at(w->step.nodes, p, end) * h / (w->step.end - w->step.begin);
    if (slope * rise > 0 && fabs(slope) > PM_TURN_SLOPE * fabs(rise)) return 0;
    const double near = place[end] + PM_DIP_STEP * h, there = f->multiple + x->value_at(w, near, f);
    x->s = there < p[end] ? 1 : -1;
    x->at[end < beside ? 0 : 2] = (pm_multiple_place){place[end], p[end]};
    x->at[1] = (pm_multiple_place){near, there};
    x->at[end < beside ? 2 : 0] = (pm_multiple_place){place[beside], p[beside]};
    return x->s * there < x->s * p[beside] && !is_shallow(x->s, p[end], fabs(there - p[end]) / PM_DIP_STEP);
}

/* Of three nodes the middle one is lowest, or highest. */
static int dips_at_node(const double *place, const double *p, int k, pm_multiple_dip *x)
{
    const double before = p[k] - p[k - 1], after = p[k] - p[k + 1];
    if (!(before * after > 0)) return 0;
    x->s = before < 0 ? 1 : -1;
    for (int i = 0; i < 3; i++) x->at[i] = (pm_multiple_place){place[k + i - 1], p[k + i - 1]};
    return !is_shallow(x->s, p[k], pm_max(fabs(before), fabs(after)));
}

/* Where p turns back beside a node, if it may reach a multiple there. */
static pm_multiple_place turn_beside(pm_workspace *w, int i, int k, pm_event_at *value_at)
{
    const double *p = pm_event_samples(w->event, i);
    const int last = w->step.nodes->n - 1;
    pm_event_function *f = &w->event->function[i];
    pm_multiple_dip x = {.value_at = value_at};
    const int dips = k > 0 && k < last ? dips_at_node(w->event->place, p, k, &x)
                                       : dips_beside_end(w, f, p, k, k > 0 ? k - 1 : 1, &x);
    if (!dips) return (pm_multiple_place){NAN, NAN};
    const double around = x.s * pm_max(x.s * x.at[0].value, x.s * x.at[2].value);
    close_in(w, f, &x);
    note_near(f, x.s, x.at[1].value, around);
    return x.at[1];
}

/* The same; looked for once in a step. */
static const pm_multiple_place *turns_of(pm_workspace *w, int i, pm_event_at *value_at)
{
    pm_event_function *f = &w->event->function[i];
    pm_multiple_place *turn = w->event->multiples[f->index].turn;
    for (int k = 0; !f->turned && k < w->step.nodes->n; k++) turn[k] = turn_beside(w, i, k, value_at);
    f->turned = 1;
    return turn;
}

/* ---- the step ---- */
/* From one place to the next p only rises or falls: 1, and the bracket of the multiple that it reaches first.  Else *from is there. */
static int reaches(pm_multiples *m, pm_event_function *f, pm_multiple_place *from, pm_multiple_place to,
                   pm_span *x)
{
    part(m, to.value, PM_ON_ZERO);
    const int rises = to.value >= m->high;
    if (is_on(m) || !(rises || to.value <= m->low)) {
        *from = to;
        return 0;
    }
    count_from(f, rises ? m->high : m->low);
    *x = (pm_span){from->place, to.place, from->value - f->multiple, to.value - f->multiple};
    return 1;
}

/* Where the phase ends at the end of the step, a multiple is there but for rounding. */
static double last_value(const pm_step *step, const pm_event_set *e, double p)
{
    const int ends = (e->at_root || e->at_due) && pm_step_is_last(step);
    return ends && fabs(p - round(p)) <= nothing(p, PM_ON_ZERO) ? round(p) : p;
}

/* It begins beyond what it was between: 1, and it is there at once. */
static int begins_beyond(const pm_multiples *m, pm_event_function *f, pm_multiple_place at, pm_span *x)
{
    const int above = at.value >= m->high;
    if (is_on(m) || !(above || at.value <= m->low)) return 0;
    count_from(f, above ? m->high : m->low);
    *x = (pm_span){at.place, at.place, 0, 0};
    return 1;
}

int pm_event_multiple_first(pm_workspace *w, int i, pm_event_at *value_at, pm_span *x)
{
    const pm_event_set *e = w->event;
    pm_event_function *f = &w->event->function[i];
    pm_multiples *m = &e->multiples[f->index];
    const double *p = pm_event_samples(w->event, i);
    const int last = w->step.nodes->n - 1, fired = f->held && f->since > e->place[0];
    pm_multiple_place from = {e->place[0], *p};
    if (!fired) {
        begin(e, f, *p);
        if (begins_beyond(m, f, from, x)) return 1;
    }
    if (f->held) from = (pm_multiple_place){f->since, m->low + 1};
    const pm_multiple_place *turn = turns_of(w, i, value_at);
    for (int k = 0; k < last; k++) {
        if (e->place[k + 1] <= from.place) continue;
        const pm_multiple_place node = {e->place[k + 1],
                                        k + 1 < last ? p[k + 1] : last_value(&w->step, e, p[last])};
        const pm_multiple_place *const way[] = {&turn[k], &turn[k + 1], &node};
        for (int n = 0; n < 3; n++)
            if (way[n]->place > from.place && way[n]->place <= node.place && reaches(m, f, &from, *way[n], x))
                return 1;
    }
    return 0;
}
