/* time_course.c - switches of programs of the time, and how far samples show them between (events/shown.h).
 *
 * A switch is found by bisection: stretches over which all switches are decided (expression/enclosure.h) are passed, from
 * left to right, until the stretch that is left is between two neighbouring numbers. */
#include "events/time_course.h"

#include <math.h>

#include "elements/force.h"
#include "elements/turning_plane.h"
#include "equations/case.h"
#include "equations/solve_cache.h"
#include "events/shown.h"
#include "expression/enclosure.h"
#include "expression/program_class.h"
#include "numerics/tolerances.h"
#include "scene/reference.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/route.h"

typedef struct pm_time_course {
    int *program; /* [n] that are not linear in the time */
    double *size; /* [n] greatest value that an enclosure has shown in the run */
    int n;
    double end;       /* of the run, s */
    double next;      /* the next switch, s; INFINITY: there is none before the end */
    double after;     /* the number behind it */
    double shown;     /* up to where all programs are shown */
    double apart;     /* s, distance of the samples that tell them */
    double strongest; /* greatest sum of the squares of the programs where a step began */
    double rounded;   /* of the last coarse run: pm_time_course_rounded */
} pm_time_course;

/* ---- which programs ---- */
static void add(const pm_model *m, pm_time_course *c, int program)
{
    if (program < 0 || m->programs.class[program] == PM_CLASS_TIME ||
        !pm_program_class_reads_time(m, program))
        return;
    for (int i = 0; i < c->n; i++)
        if (c->program[i] == program) return;
    c->program[c->n++] = program;
}

static void add_all(const pm_model *m, pm_time_course *c)
{
    int table, row, program;
    for (int k = 0; (program = pm_reference_drive(m, k, &table, &row)) != PM_NONE; k++) add(m, c, program);
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        for (int k = 0; k < pm_force_of(m, i)->programs; k++)
            add(m, c, PM_FORCE_ROW(m, i)[PM_FORCE_PROGRAM_X + k]);
    add(m, c, pm_turning_plane_program(m));
}

int pm_time_course_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (PM_ARENA_NEW(&w->memory, w->step.course)) return PM_NO_MEMORY;
    const int most = m->rows[PM_TABLE_PROGRAM];
    const pm_array array[] = {PM_ARRAY(w->step.course->program, most), PM_ARRAY(w->step.course->size, most)};
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    if (!status) add_all(m, w->step.course);
    return status;
}

int pm_time_course_is_any(const pm_workspace *w) { return w->step.course->n > 0; }

static pm_enclosure enclose(const pm_workspace *w, int i, double from, double to)
{
    return pm_enclosure_of_time(w->model, w->step.course->program[i], w->numbers.param, w->numbers.value,
                                from, to);
}

/* ---- switches ---- */
/* Open switches of all programs; *changes: those that stand otherwise at the end. */
static int open_switches(const pm_workspace *w, double from, double to, int *changes)
{
    int open = 0;
    *changes = 0;
    for (int i = 0; i < w->step.course->n; i++) {
        const pm_enclosure e = enclose(w, i, from, to);
        open += e.open;
        *changes += e.changes;
    }
    return open;
}

/* The first switch after `from`: between two neighbouring numbers, or, where they lie too dense, as near as the budget
 * leads.  1 if there is one up to the end. */
static int first_switch(const pm_workspace *w, double from, double *before, double *after)
{
    double ends[PM_TIME_HALVINGS];
    int n = 0, changes;
    ends[n++] = w->step.course->end;
    for (int budget = PM_TIME_BUDGET; n > 0; budget--) {
        const double to = ends[n - 1], middle = 0.5 * (from + to);
        const int open = open_switches(w, from, to, &changes);
        const int close = to - from <= PM_TIME_SAME * fmax(fabs(to), PM_TIME_SAME * w->step.course->end);
        if (!open || (close && !changes)) {
            from = to;
            n--;
        } else if (close || budget <= 0 || n == PM_TIME_HALVINGS) {
            *before = from;
            *after = to;
            return 1;
        } else {
            ends[n++] = middle;
        }
    }
    return 0;
}

/* ---- what rounding times does ---- */
/* Of the squares of all programs, and by how much they grow. */
static void find_strength(const pm_workspace *w, double t, double *strength, double *growth)
{
    *strength = *growth = 0;
    for (int i = 0; i < w->step.course->n; i++) {
        const pm_jet x = enclose(w, i, t, t).jet;
        *strength += x.value.lo * x.value.lo;
        *growth += x.value.lo * x.rate.lo;
    }
}

static int shows_rounding(const pm_evidence *evidence)
{
    return pm_evidence_is_coarse(evidence) && !evidence->calm;
}

/* What a coarse run adds to the time of a switch, or to that at which forces are taken in a step: what rises begins earlier, what
 * falls ends later, lest the ends of a narrow pulse are off alike and nobody sees it. */
static double switch_rounding(pm_workspace *w, double from, double before, double after)
{
    pm_time_course *c = w->step.course;
    const double off = PM_TIME_ROUNDED * before;
    double one, other, growth;
    if (isinf(before) || !shows_rounding(&w->evidence)) return 0;
    find_strength(w, before, &one, &growth);
    find_strength(w, after, &other, &growth);
    if (from > 0 && other != one) c->rounded = fmax(off / (before - from), c->rounded);
    return copysign(off, one - other);
}

static double force_rounding(pm_workspace *w)
{
    pm_time_course *c = w->step.course;
    const double off = PM_TIME_ROUNDED * w->state.t;
    double strength, growth;
    if (!shows_rounding(&w->evidence)) return 0;
    find_strength(w, w->state.t, &strength, &growth);
    c->strongest = fmax(strength, c->strongest);
    if (c->strongest > 0) c->rounded = fmax(off * fabs(growth) / c->strongest, c->rounded);
    return copysign(off, growth);
}

double pm_time_course_rounded(const pm_workspace *w) { return w->step.course->rounded; }

/* The next switch behind `from`, which is on the side that holds until then. */
static void find_next(pm_workspace *w, double from)
{
    pm_time_course *c = w->step.course;
    double before = INFINITY, after = INFINITY;
    while (first_switch(w, from, &before, &after) && before <= w->state.t) {
        from = after;
        before = after = INFINITY;
    }
    c->next = before + switch_rounding(w, from, before, after);
    c->after = after;
    c->shown = -INFINITY;
    w->frame.side = (pm_side){from, before};
}

void pm_time_course_begin(pm_workspace *w)
{
    pm_time_course *c = w->step.course;
    w->frame.side = (pm_side){-INFINITY, INFINITY};
    c->next = INFINITY;
    if (c->n == 0) return;
    c->apart = 0;
    c->strongest = 0;
    if (pm_evidence_is_coarse(&w->evidence)) c->rounded = 0;
    w->frame.time_off = 0;
    c->end = pm_case_max_time(w->model, &w->numbers);
    for (int i = 0; i < c->n; i++) c->size[i] = 0;
    find_next(w, w->state.t);
}

int pm_time_course_switch(pm_workspace *w)
{
    const double next = w->step.course->next;
    if (!(w->state.t >= next - PM_TIME_TOGETHER * fabs(next))) return 0;
    find_next(w, w->step.course->after);
    pm_solve_cache_forget(w->cache);
    return 1;
}

/* ---- between them ---- */
static pm_enclosure enclose_time(const pm_shown *x, double from, double to)
{
    return pm_enclosure_of_time(x->w->model, x->program, x->w->numbers.param, x->w->numbers.value, from, to);
}

static int is_shown(const pm_workspace *w, double from, double to)
{
    for (int i = 0; i < w->step.course->n; i++) {
        const pm_shown x = {enclose_time, w, w->step.course->program[i], NULL, &w->step.course->size[i]};
        if (!pm_shown_between(&x, from, to)) return 0;
    }
    return 1;
}

/* What is shown, or for a step that sees its end alone the next sample. */
static double reach(const pm_workspace *w)
{
    const pm_time_course *c = w->step.course;
    const double shown = fmin(c->shown, c->next);
    return w->phase.route->sees_ends ? fmin(shown, w->state.t + c->apart) : shown;
}

/* How far programs are shown at once, by a last step of this length.  Steps that see their ends alone are as short as the
 * samples are apart, at least: these may become twice as long. */
static double ahead(const pm_workspace *w, double length)
{
    const double apart = fmax(length, w->step.course->apart);
    return w->phase.route->sees_ends ? 2 * (PM_SHOWN_SAMPLES - 1) * apart : PM_TIME_AHEAD * length;
}

double pm_time_course_limit(pm_workspace *w, double length)
{
    pm_time_course *c = w->step.course;
    const double from = w->state.t, most = fmin(c->next, c->end);
    if (c->n == 0) return INFINITY;
    w->frame.time_off = force_rounding(w);
    if (c->shown >= most || from + PM_TIME_ENOUGH * length < c->shown) return reach(w);
    double to = length > 0 ? fmin(most, from + ahead(w, length)) : most;
    for (int i = 0; i < PM_TIME_HALVINGS && to > from && !is_shown(w, fmax(from, w->frame.side.from), to);
         i++)
        to = from + 0.5 * (to - from);
    c->shown = to;
    c->apart = (to - from) / (PM_SHOWN_SAMPLES - 1);
    return reach(w);
}
