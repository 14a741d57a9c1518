/* path_error.c - errors along paths.
 *
 * Places on a path carry no error but rounding; T does: it is rounded with the energies that make it, in every step, and
 * a blow that leaves m T_end leaves m times the error.  An answer f(place, T) is then known to |df/dT| dT, by a difference.
 * The time's error is that of its quadrature, and what T makes of it.  All this holds as long as places alone decide when
 * something happens; where speeds, forces or the time do, the run says nothing of its errors, and error.c makes its
 * companion. */
#include "path_error.h"

#include <math.h>
#include <string.h>

#include "body.h"
#include "error.h"
#include "grip.h"
#include "nature.h"
#include "path.h"
#include "program.h"
#include "route.h"
#include "saddle.h"
#include "series.h"
#include "tree.h"

#define ROUNDINGS 1e-15 /* of the energies, in a step or a blow: some roundings */
#define FASTER 1e-6     /* of the speeds, for the difference */
#define UNRESOLVED \
    2e-3 /* of the highest coefficients of dt/du: what its integral may be off by; some 1000 times less */
#define RESTING 10.0 /* an error of T moves the place of rest, too */

void pm_path_error_begin(pm_workspace *w, double kinetic)
{
    pm_path *p = w->path;
    if (w->count[PM_COUNT_PHASES] == 0) p->error = p->ended = p->clock_error = 0;
    if (p->ended > 0) p->error *= kinetic / p->ended;
    p->error += ROUNDINGS * kinetic;
}

/* The time of the step: what its nodes do not resolve, and dt = -t dT / 2 T, where it rests at an end of the greatest T. */
static void step_of_clock(const pm_workspace *w, pm_path *p)
{
    double least = INFINITY, greatest = 0;
    if (p->balanced && w->model->reads_time) p->clock_error = INFINITY; /* it takes for ever to leave */
    if (p->clock == PM_CLOCK_NONE) return;
    for (int k = 0; k < p->nodes->n; k++) {
        least = fmin(least, p->node[k * p->every].kinetic);
        greatest = fmax(greatest, p->node[k * p->every].kinetic);
    }
    const double by = p->clock == PM_CLOCK_PLAIN ? least : greatest / RESTING;
    p->clock_error += (w->state.t - p->t0) * (UNRESOLVED * p->tail + 0.5 * p->error / by);
}

void pm_path_error_step(pm_workspace *w, double kinetic)
{
    pm_path *p = w->path;
    const double potential = p->by_work ? 0 : fabs(p->node[0].potential);
    p->ended = kinetic;
    p->error += ROUNDINGS * (p->node[0].kinetic + kinetic + potential);
    step_of_clock(w, p);
}

void pm_path_error_barrier(pm_workspace *w, double distance)
{
    pm_error_decision(w, distance, w->path->error);
}

/* ---- do places alone decide? ---- */
/* An event that is only watched: nothing ends or acts, and nothing is asked or told by the instants when it fires. */
static int only_watched(const pm_model *m, int event)
{
    for (int i = 0; i < m->rows[PM_TABLE_UNTIL]; i++)
        if (PM_UNTIL_ROW(m, i)[PM_UNTIL_EVENT] == event) return 0;
    for (int i = 0; i < m->nask; i++)
        if (PM_ASK_ROW(m, i)[PM_ASK_EVENT_INDEX] == event) return 0;
    for (int i = 0; i < m->rows[PM_TABLE_ACTION]; i++)
        if (PM_ACTION_ROW(m, i)[PM_ACTION_EVENT] == event) return 0;
    for (int i = 0; i < m->rows[PM_TABLE_PROGRAM]; i++)
        if (pm_nature_reads_counts(m, i)) return 0;
    return 1;
}

/* Places tell when a trigger fires, or sqrt(T) does and it fires where the motion turns back. */
static int fires_by_place(const pm_model *m, const int32_t *e)
{
    const int kind = e[PM_TRIGGER_KIND], program = e[PM_TRIGGER_PROGRAM];
    if (kind > PM_TRIGGER_EVERY) return kind == PM_TRIGGER_START || kind == PM_TRIGGER_STRIKE;
    return m->program_nature[program] == PM_NATURE_PLACE || m->program_growth[program] == PM_GROWTH_ROOT;
}

int pm_path_error_by_places(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        if (!fires_by_place(m, e) && !only_watched(m, e[PM_TRIGGER_EVENT])) return 0;
    }
    return 1;
}

/* ---- answers ---- */
static void shift_velocities(pm_workspace *w, double factor)
{
    for (int i = 0; i < w->model->nq; i++) w->frame.velocity[i] = factor * w->frame.v[i];
}

/* The error of the clock in a program that reads nothing but the time, linearly; legs passed over do not tell it. */
static double error_of_time(pm_workspace *w, int program, double value)
{
    pm_frame *f = &w->frame;
    const double t = f->t, shift = fmax(t, w->path->clock_error);
    if (w->count[PM_COUNT_LEGS] > 0) return NAN;
    if (!(shift > 0)) return 0;
    f->t = t + shift;
    const double changed = pm_program_run(w->model, program, w->param, w->value, w);
    f->t = t;
    return fabs(changed - value) / shift * w->path->clock_error;
}

/* A place inside a step, where the active rows are those of the tree: as the route does where no row closes a loop. */
static int accelerate(pm_workspace *w)
{
    const int inside = w->frame.q == w->probe.q && w->tree->nloop == 0;
    return inside && !pm_grip_by_load(w) ? pm_path_accelerate(w, w->frame.v) : pm_saddle_accelerate(w);
}

/* By a difference in the speeds. */
static double error_of_motion(pm_workspace *w, int program, double value)
{
    const double kinetic = pm_body_kinetic(w, PM_NONE);
    const int dynamic = w->model->program_level[program] == PM_LEVEL_DYNAMIC;
    if (w->model->program_growth[program] == PM_GROWTH_UNKNOWN || !(kinetic > 0)) return NAN;
    shift_velocities(w, 1 + FASTER);
    const int failed = dynamic && accelerate(w);
    const double changed = pm_program_run(w->model, program, w->param, w->value, w);
    shift_velocities(w, 1);
    if (dynamic) (void)accelerate(w);
    return failed ? NAN : fabs(changed - value) / (2 * FASTER * kinetic) * w->path->error;
}

void pm_path_error_answer(pm_workspace *w, int ask, int column, int program, double value)
{
    const pm_model *m = w->model;
    if (!w->error->active || w->route != &pm_route_path || !w->error->by_places ||
        w->count[PM_COUNT_ROUTES] != (int64_t)1 << PM_ROUTE_PATH)
        return;
    double error;
    if (isnan(value) || m->program_growth[program] == PM_GROWTH_NONE || w->error->discrete[ask])
        error = 0; /* but for rounding; integers have the margin of their decisions */
    else if (m->program_nature[program] == PM_NATURE_TIME)
        error = error_of_time(w, program, value);
    else
        error = error_of_motion(w, program, value);
    pm_error_answer(w, column, error);
}
