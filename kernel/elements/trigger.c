/* trigger.c - which triggers fire at an instant, and what that means for the named events. */
#include "elements/trigger.h"

#include <math.h>
#include <string.h>

#include "expression/piecewise.h"
#include "expression/program.h"
#include "expression/program_class.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"
#include "state/workspace.h"

void pm_trigger_reset(const pm_model *model, pm_firing *x)
{
    for (int i = 0; i < model->rows[PM_TABLE_EVENT]; i++) {
        x->count[i] = x->seen[i] = 0;
        x->time[i] = NAN;
    }
    memset(x->fired, 0, (size_t)model->rows[PM_TABLE_TRIGGER]);
    for (int i = 0; i < model->rows[PM_TABLE_TRIGGER]; i++) x->size[i] = 0;
    x->jumped = NAN;
    pm_trigger_end_instant(model, x);
}

double pm_trigger_count(const pm_firing *firing, int event)
{
    const int64_t count = firing->count[event];
    return count < 0 ? NAN : count >= PM_COUNTLESS ? INFINITY : (double)count;
}

static void lose_count(const pm_model *model, pm_firing *firing, int event, double t, int64_t count)
{
    const int once = PM_EVENT_ROW(model, event)[PM_EVENT_NTH] > 0;
    if (once && firing->count[event] > 0) return;
    firing->seen[event] = count;
    firing->count[event] = once && count == PM_COUNTLESS ? 1 : count;
    firing->time[event] = t;
}

void pm_trigger_countless(const pm_model *model, pm_firing *firing, int event, double t)
{
    lose_count(model, firing, event, t, PM_COUNTLESS);
}

void pm_trigger_uncounted(const pm_model *model, pm_firing *firing, int event, double t)
{
    lose_count(model, firing, event, t, PM_UNCOUNTED);
}

static void add_one(pm_firing *x, int event, double t)
{
    x->count[event] += x->count[event] >= 0 && x->count[event] < PM_COUNTLESS; /* else it has no number */
    x->time[event] = t;
}

void pm_trigger_count_earlier(const pm_model *model, pm_firing *x, int event, double t)
{
    const int nth = PM_EVENT_ROW(model, event)[PM_EVENT_NTH];
    if (nth == 0 || x->seen[event] + 1 == nth) add_one(x, event, t);
    x->seen[event]++;
}

void pm_trigger_lose_strikes(pm_workspace *w, int contact, int64_t count)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(w->model, i);
        if (e[PM_TRIGGER_KIND] == PM_TRIGGER_STRIKE && e[PM_TRIGGER_A] == contact)
            lose_count(w->model, &w->firing, e[PM_TRIGGER_EVENT], w->state.t, count);
    }
}

double pm_trigger_time(const pm_firing *firing, int event) { return firing->time[event]; }

double pm_trigger_program(pm_workspace *w, int trigger)
{
    return pm_program_run(w, PM_TRIGGER_ROW(w->model, trigger)[PM_TRIGGER_PROGRAM]);
}

int pm_trigger_of_switch(const pm_model *model, int i)
{
    const int event = PM_TRIGGER_ROW(model, i)[PM_TRIGGER_EVENT];
    return PM_EVENT_ROW(model, event)[PM_EVENT_EFFECT] == PM_EFFECT_SWITCH;
}

int pm_trigger_on_time(const pm_model *model, int trigger)
{
    const int32_t *e = PM_TRIGGER_ROW(model, trigger);
    return e[PM_TRIGGER_KIND] <= PM_TRIGGER_FALL &&
           model->programs.class[e[PM_TRIGGER_PROGRAM]] == PM_CLASS_TIME;
}

int pm_trigger_time_is_due(const pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++)
        if (w->firing.fired[i] && pm_trigger_on_time(w->model, i)) return 1;
    return 0;
}

double pm_trigger_time_slope(pm_workspace *w, int program, double here)
{
    const double now = w->frame.t, unit = pm_max(fabs(now), 1);
    w->frame.t = now + unit;
    const double slope = (pm_program_run(w, program) - here) / unit;
    w->frame.t = now;
    return slope;
}

/* Where p(t) goes through zero, or INFINITY. */
static double root_of(pm_workspace *w, int trigger)
{
    const int kind = PM_TRIGGER_ROW(w->model, trigger)[PM_TRIGGER_KIND];
    const double now = w->frame.t, here = pm_trigger_program(w, trigger),
                 slope =
                     pm_trigger_time_slope(w, PM_TRIGGER_ROW(w->model, trigger)[PM_TRIGGER_PROGRAM], here);
    if (slope == 0 || (kind == PM_TRIGGER_RISE && slope < 0) || (kind == PM_TRIGGER_FALL && slope > 0))
        return INFINITY;
    double due = now - here / slope;
    w->frame.t = due; /* once more from there: a far root is not left to the rounding of now */
    due -= pm_trigger_program(w, trigger) / slope;
    w->frame.t = now;
    return due;
}

double pm_trigger_due(pm_workspace *w, int trigger)
{
    const double due = root_of(w, trigger);
    return due > w->frame.t ? due : INFINITY;
}

void pm_trigger_mark_start(pm_workspace *w)
{
    pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_START, PM_NONE);
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++)
        if (pm_trigger_on_time(w->model, i) && root_of(w, i) == w->frame.t) w->firing.fired[i] = PM_FIRED_NOW;
}

/* No jump takes it past its zero: it reads nothing that jumps. */
static int outlasts_jumps(const pm_model *m, int i)
{
    return PM_TRIGGER_ROW(m, i)[PM_TRIGGER_KIND] > PM_TRIGGER_FALL ||
           (pm_trigger_on_time(m, i) && !pm_trigger_of_switch(m, i));
}

void pm_trigger_look_before(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++)
        if (!outlasts_jumps(w->model, i)) w->firing.before[i] = pm_trigger_program(w, i);
}

/* ---- switches of forces ---- */
int pm_trigger_is_of_piece(const pm_model *model, int i)
{
    const int event = PM_TRIGGER_ROW(model, i)[PM_TRIGGER_EVENT];
    return PM_EVENT_ROW(model, event)[PM_EVENT_EFFECT] == PM_EFFECT_PIECE;
}

double pm_trigger_argument(pm_workspace *w, int reading)
{
    return pm_program_run(w, PM_READING_ROW(w->model, reading)[PM_READING_PROGRAM]);
}

static double piece_of(pm_workspace *w, int reading)
{
    const pm_piecewise p = pm_piecewise_of(w->model, PM_READING_ROW(w->model, reading)[PM_READING_TABLE]);
    return pm_piecewise_number(&p, pm_trigger_argument(w, reading));
}

static void take_pieces(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_READING]; i++)
        w->firing.side[PM_READING_ROW(w->model, i)[PM_READING_EVENT]] = piece_of(w, i);
}

void pm_trigger_take_sides(pm_workspace *w)
{
    take_pieces(w);
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++)
        if (pm_trigger_of_switch(w->model, i))
            w->firing.side[PM_TRIGGER_ROW(w->model, i)[PM_TRIGGER_EVENT]] = pm_trigger_program(w, i) > 0;
}

void pm_trigger_jump_sides(pm_workspace *w)
{
    take_pieces(w);
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        if (!pm_trigger_of_switch(w->model, i)) continue;
        const double before = w->firing.before[i], after = pm_trigger_program(w, i);
        if (fabs(after - before) > PM_ON_ZERO * fmax(fabs(before), fabs(after)))
            w->firing.side[PM_TRIGGER_ROW(w->model, i)[PM_TRIGGER_EVENT]] = after > 0;
    }
}

/* ---- jumps ---- */
/* Which side of zero x is on; rounding has none. */
static int side_of(double x, double rounding) { return fabs(x) <= rounding ? 0 : (x > 0) - (x < 0); }

/* What a jump from `before` to `after` makes true was not true before. */
static int jump_fires(int kind, int before, int after)
{
    switch (kind) {
    case PM_TRIGGER_RISE: return before <= 0 && after > 0;
    case PM_TRIGGER_FALL: return before >= 0 && after < 0;
    default: return before != 0 && after != before;
    }
}

/* Where it is decided by the side on which a jump ended whether it fired. */
static void note_side(pm_workspace *w, int trigger, int before, double after)
{
    const int kind = PM_TRIGGER_ROW(w->model, trigger)[PM_TRIGGER_KIND];
    if (!w->evidence.active || jump_fires(kind, before, 1) == jump_fires(kind, before, -1)) return;
    pm_evidence_take_after(&w->evidence,
                           &(pm_evidence_decision){.kind = PM_EVIDENCE_VALUE,
                                                   .what = INT32_MAX - trigger, /* after those of a phase */
                                                   .trigger = trigger,
                                                   .distance = after,
                                                   .reach = fabs(after),
                                                   .unit = 1});
}

/* The value before and after the jump, by the greatest of such values so far. */
static int has_fired(pm_workspace *w, int trigger, double before, double after)
{
    double *size = &w->firing.size[trigger];
    if (isfinite(before)) *size = pm_max(fabs(before), *size);
    if (isfinite(after)) *size = pm_max(fabs(after), *size);
    if (before == after || isnan(before) || isnan(after)) return 0;
    const int from = side_of(before, PM_ON_ZERO * *size);
    note_side(w, trigger, from, after);
    return jump_fires(PM_TRIGGER_ROW(w->model, trigger)[PM_TRIGGER_KIND], from,
                      side_of(after, PM_ON_ZERO * *size));
}

void pm_trigger_look_after(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        if (outlasts_jumps(w->model, i) || w->firing.fired[i] == PM_FIRED_NOW) continue;
        if (has_fired(w, i, w->firing.before[i], pm_trigger_program(w, i))) w->firing.fired[i] = PM_FIRED_NOW;
    }
}

void pm_trigger_mark(const pm_model *model, pm_firing *firing, int kind, int a)
{
    for (int i = 0; i < model->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(model, i);
        if (e[PM_TRIGGER_KIND] == kind && (kind == PM_TRIGGER_START || e[PM_TRIGGER_A] == a))
            firing->fired[i] = PM_FIRED_NOW;
    }
}

void pm_trigger_next_blow(const pm_model *model, pm_firing *firing)
{
    for (int i = 0; i < model->rows[PM_TABLE_TRIGGER]; i++)
        if (firing->fired[i]) firing->fired[i] = PM_FIRED_EARLIER;
}

static int is_marked(const pm_model *model, const pm_firing *firing, int event)
{
    int marked = 0;
    for (int i = 0; i < model->rows[PM_TABLE_TRIGGER]; i++)
        marked |= firing->fired[i] == PM_FIRED_NOW && PM_TRIGGER_ROW(model, i)[PM_TRIGGER_EVENT] == event;
    return marked;
}

int pm_trigger_fires(const pm_model *model, const pm_firing *firing, int event)
{
    const int nth = PM_EVENT_ROW(model, event)[PM_EVENT_NTH];
    if (firing->counted[event]) return firing->counted[event] == PM_COUNTED_FIRED;
    return is_marked(model, firing, event) && (nth == 0 || firing->seen[event] + 1 == nth);
}

/* The marks stay until the next phase has begun: they tell which triggers start on zero. */
int pm_trigger_count_marked(pm_workspace *w)
{
    pm_firing *x = &w->firing;
    int any = 0;
    for (int event = 0; event < w->model->rows[PM_TABLE_EVENT]; event++) {
        if (x->counted[event] || !is_marked(w->model, x, event)) continue;
        const int fires = pm_trigger_fires(w->model, x, event);
        any = 1;
        x->seen[event]++;
        x->counted[event] = fires ? PM_COUNTED_FIRED : PM_COUNTED_MARKED;
        if (!fires) continue;
        add_one(x, event, w->state.t);
    }
    return any;
}

void pm_trigger_end_instant(const pm_model *model, pm_firing *firing)
{
    memset(firing->counted, PM_COUNTED_NOT, (size_t)model->rows[PM_TABLE_EVENT]);
}

int pm_trigger_until(const pm_model *m, const pm_firing *firing)
{
    for (int i = 0; i < m->rows[PM_TABLE_UNTIL]; i++) {
        const int group = PM_UNTIL_ROW(m, i)[PM_UNTIL_GROUP];
        int all = 1;
        for (int k = 0; k < m->rows[PM_TABLE_UNTIL]; k++) {
            const int32_t *e = PM_UNTIL_ROW(m, k);
            if (e[PM_UNTIL_GROUP] == group && firing->count[e[PM_UNTIL_EVENT]] < e[PM_UNTIL_NTH]) all = 0;
        }
        if (all) return 1;
    }
    return 0;
}
