/* motion_course.c - forces along a step: each is enclosed along the polynomials of the measures that it reads. */
#include "events/motion_course.h"

#include <math.h>

#include "elements/force.h"
#include "elements/measure.h"
#include "events/shown.h"
#include "events/waves.h"
#include "expression/operation.h"
#include "expression/program_fold.h"
#include "numerics/chebyshev_nodes.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/route.h"

typedef struct pm_motion_course {
    int *program; /* [n] of forces, that may have waves along a step */
    double *size; /* [n] greatest value that an enclosure has shown in the run */
    int n;
    int *measure; /* [nmeasure] that they read */
    int *place;   /* [measures] of each among these */
    int nmeasure;
    double *value; /* [nmeasure][PM_NODES_MOST] */
    pm_measure_series along;
    double longest; /* step that may be taken next */
} pm_motion_course;

/* ---- which programs ---- */
static void add_measures(const pm_model *m, pm_motion_course *c, int program)
{
    const pm_program_fold *f = m->programs.fold;
    for (int k = f->first[program]; k < f->first[program + 1]; k++) {
        if (f->step[k].kind != STEP_MEASURE) continue;
        const int measure = f->step[k].arg;
        int i = 0;
        while (i < c->nmeasure && c->measure[i] != measure) i++;
        c->place[measure] = i;
        if (i == c->nmeasure) c->measure[c->nmeasure++] = measure;
    }
}

static int is_of_motion(const pm_model *m, int measure)
{
    return PM_MEASURE_ROW(m, measure)[PM_MEASURE_KIND] != PM_MEASURE_TIME;
}

static void add_forces(const pm_workspace *w, pm_motion_course *c)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        for (int k = 0; k < pm_force_of(m, i)->programs; k++) {
            const int program = PM_FORCE_ROW(m, i)[PM_FORCE_PROGRAM_X + k];
            if (!pm_waves_beyond_distances(w, program) ||
                pm_program_walk_reads(m, program, is_of_motion) == PM_NONE)
                continue;
            c->program[c->n++] = program;
            add_measures(m, c, program);
        }
}

int pm_motion_course_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    const int measures = m->rows[PM_TABLE_MEASURE], most = 2 * m->rows[PM_TABLE_FORCE];
    if (PM_ARENA_NEW(&w->memory, w->step.motion)) return PM_NO_MEMORY;
    pm_motion_course *c = w->step.motion;
    const pm_array array[] = {PM_ARRAY(c->program, most),
                              PM_ARRAY(c->size, most),
                              PM_ARRAY(c->measure, measures),
                              PM_ARRAY(c->place, measures),
                              PM_ARRAY(c->value, measures * PM_NODES_MOST),
                              PM_ARRAY(c->along.series, measures)};
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    if (!status) add_forces(w, c);
    c->along.place = c->place;
    return status;
}

void pm_motion_course_begin(pm_workspace *w)
{
    pm_motion_course *c = w->step.motion;
    c->longest = INFINITY;
    for (int i = 0; i < c->n; i++) c->size[i] = 0;
}

double pm_motion_course_limit(const pm_workspace *w) { return w->step.motion->longest; }

/* ---- along a step ---- */
static pm_enclosure enclose(const pm_shown *x, double from, double to)
{
    return pm_enclosure_along(x->w->model, x->program, x->w->numbers.folded, x->along, from, to);
}

/* The cubic through places and velocities at both ends of the step, at fraction x of it.  (The dense output of a step into which a
 * peak falls may be anything.) */
static void look_between(pm_workspace *w, const pm_state *begin, double x)
{
    const pm_state *end = &w->state;
    const double h = end->t - begin->t, rest = 1 - x;
    const double first = rest * rest * (1 + 2 * x), last = x * x * (3 - 2 * x);
    const double out = h * x * rest * rest, in = -h * x * x * rest, turn = 6 * x * rest / h;
    pm_state_copy(&w->probe, end);
    w->probe.t = begin->t + x * h;
    for (int i = 0; i < w->model->nq; i++) {
        const double *v[2] = {&begin->v[i], &end->v[i]}, way = end->q[i] - begin->q[i];
        w->probe.q[i] = first * begin->q[i] + last * end->q[i] + out * *v[0] + in * *v[1];
        w->probe.v[i] = turn * way + rest * (1 - 3 * x) * *v[0] + x * (3 * x - 2) * *v[1];
    }
    pm_frame_look_state(&w->frame, &w->probe);
    w->frame.t = pm_frame_side_time(&w->frame, w->frame.t);
}

/* What the forces read, from the begin of the step to a fraction of it. */
static void sample(pm_workspace *w, const pm_state *begin, double to)
{
    pm_motion_course *c = w->step.motion;
    const pm_chebyshev_nodes *nodes = &pm_chebyshev_nodes_9;
    for (int k = 0; k < nodes->n; k++) {
        look_between(w, begin, nodes->at[k] * to);
        for (int i = 0; i < c->nmeasure; i++)
            c->value[i * PM_NODES_MOST + k] = pm_measure_signed(w, c->measure[i]);
    }
    for (int i = 0; i < c->nmeasure; i++) {
        pm_chebyshev_series_of(&c->along.series[i], nodes, c->value + i * PM_NODES_MOST);
        pm_chebyshev_series_cut(&c->along.series[i], PM_MOTION_CUT);
    }
}

static int are_shown(const pm_workspace *w)
{
    const pm_motion_course *c = w->step.motion;
    for (int i = 0; i < c->n; i++) {
        const pm_shown x = {enclose, w, c->program[i], &c->along, &c->size[i]};
        if (!pm_shown_between(&x, 0, 1)) return 0;
    }
    return 1;
}

/* How much of the step is shown; all of it where not even a short part is: at a pole or a corner, or where a root begins, the error
 * of the step tells. */
static double part_shown(pm_workspace *w, const pm_state *begin)
{
    const double least = PM_MOTION_LEAST * w->numbers.size / w->numbers.speed, length = w->state.t - begin->t;
    double part = 1;
    for (int i = 0; i < PM_MOTION_HALVINGS && part * length > least; i++, part *= 0.5) {
        sample(w, begin, part);
        if (are_shown(w)) return part;
    }
    return 1;
}

int pm_motion_course_is_needed(const pm_workspace *w)
{
    return w->step.motion->n > 0 && w->phase.route->in_time;
}

int pm_motion_course_shown(pm_workspace *w, const pm_state *begin, double *end)
{
    const double length = w->state.t - begin->t, part = part_shown(w, begin);
    *end = part < 1 ? begin->t + part * length : w->state.t;
    w->step.motion->longest = PM_MOTION_GROW * part * length;
    pm_frame_look_state(&w->frame, &w->state);
    return part == 1;
}
