/* scene.h - builds the flat tables of a scene by hand, and runs it: for tests only.
 *
 *   scene *s = scene_create();
 *   const int b = scene_body(s, 2, 0.1, 0, 1, 0);                     mass, inertia (0: a particle), x, y, angle
 *   const int v = scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y);
 *   const int out = scene_ask_end(s, scene_read(s, v));
 *   scene_run(s, NULL);    s->status, s->out[out], s->audit ...
 *   scene_free(s);
 *
 * Every function returns the row that it added.  A program is written in postfix order:
 *   SCENE_PROGRAM(s, scene_m(v), scene_k(s, 3), scene_op(PM_OP_SUB))  */
#ifndef SCENE_H
#define SCENE_H

#include <stdio.h>

#include "equations/case.h"
#include "equations/start.h"
#include "run/run.h"
#include "scene/build.h"
#include "scene_elements.h"
#include "state/workspace.h"
#include "study/accuracy.h"

/* ---- measures, start ---- */
static inline int scene_part(scene *s, int kind, int a, int part)
{
    return SCENE_ROW(s, PM_TABLE_MEASURE, kind, a, part, PM_NONE, PM_NONE, PM_NONE, PM_NONE, PM_NONE);
}
static inline int scene_measure(scene *s, int kind, int a) { return scene_part(s, kind, a, PM_PART_NONE); }
/* The same with an option: PM_MEASURE_IN, _ON, _ABOUT, _VALUE or _MEMBER. */
static inline int scene_measure_with(scene *s, int kind, int a, int part, int column, int option)
{
    const int row = scene_part(s, kind, a, part);
    s->cell[PM_TABLE_MEASURE][row * PM_MEASURE_COLUMNS + column] = option;
    return row;
}
static inline int scene_start(scene *s, int level, int measure, double number)
{
    return SCENE_ROW(s, PM_TABLE_START, level, measure, scene_value(s, number));
}
static inline void scene_start_velocity(scene *s, int point, double vx, double vy)
{
    scene_start(s, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, point, PM_PART_X), vx);
    scene_start(s, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, point, PM_PART_Y), vy);
}
static inline void scene_start_omega(scene *s, int body, double omega)
{
    scene_start(s, PM_START_VELOCITY, scene_measure(s, PM_MEASURE_OMEGA, body), omega);
}

/* ---- programs of measures ---- */
static inline int scene_read(scene *s, int measure) { return SCENE_PROGRAM(s, scene_m(measure)); }
static inline int scene_minus(scene *s, int measure, double x)
{
    return SCENE_PROGRAM(s, scene_m(measure), scene_k(s, x), scene_op(PM_OP_SUB));
}
static inline int scene_time(scene *s) { return scene_measure(s, PM_MEASURE_TIME, PM_NONE); }

/* ---- events and asks ---- */
static inline int scene_event(scene *s) { return SCENE_ROW(s, PM_TABLE_EVENT, 0, 0); }
static inline int scene_trigger(scene *s, int kind, int event, int program, int a)
{
    return SCENE_ROW(s, PM_TABLE_TRIGGER, kind, event, program, a);
}
/* A new event with one trigger: a program (cross, rise, fall, every), or what it is of (strike, open ..). */
static inline int scene_when(scene *s, int kind, int program)
{
    const int event = scene_event(s);
    scene_trigger(s, kind, event, program, PM_NONE);
    return event;
}
static inline int scene_on(scene *s, int kind, int a)
{
    const int event = scene_event(s);
    scene_trigger(s, kind, event, PM_NONE, a);
    return event;
}
static inline void scene_until(scene *s, int event, int nth) { SCENE_ROW(s, PM_TABLE_UNTIL, 0, event, nth); }
static inline void scene_until_time(scene *s, double t)
{
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, scene_time(s), t)), 1);
}

static inline int scene_ask(scene *s, int kind, int program, int event, int nth, int before, int program_2,
                            int first, int count)
{
    const int out = s->nout;
    SCENE_ROW(s, PM_TABLE_ASK, kind, program, event, nth, before, program_2, first, out, count);
    s->nout += count;
    return out;
}
static inline int scene_ask_end(scene *s, int program)
{
    return scene_ask(s, PM_ASK_END, program, PM_NONE, 1, 0, PM_NONE, PM_NONE, 1);
}
static inline int scene_ask_event(scene *s, int program, int event, int nth, int before)
{
    return scene_ask(s, PM_ASK_EVENT, program, event, nth, before, PM_NONE, PM_NONE, 1);
}
static inline int scene_ask_extreme(scene *s, int kind, int program, int program_2)
{
    return scene_ask(s, kind, program, PM_NONE, 1, 0, program_2, PM_NONE, 1);
}
static inline int scene_ask_measure(scene *s, int measure)
{
    return scene_ask_end(s, scene_read(s, measure));
}
/* How often an event has fired by the end. */
static inline int scene_ask_count(scene *s, int event)
{
    return scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, event));
}

/* ---- finds ---- */
static inline void scene_find(scene *s, int goal, int program, int samples)
{
    SCENE_ROW(s, PM_TABLE_FIND, goal, program, samples);
}
static inline void scene_vary(scene *s, int parameter, double low, double high)
{
    SCENE_ROW(s, PM_TABLE_VARY, parameter, scene_value(s, low), scene_value(s, high));
}
static inline void scene_where(scene *s, int kind, int program)
{
    SCENE_ROW(s, PM_TABLE_CONDITION, kind, program);
}

/* ---- settings ---- */
static inline int32_t *scene_setting(scene *s, int column) { return &s->cell[PM_TABLE_SETTING][column]; }
/* A setting that is a value. */
static inline void scene_set(scene *s, int column, double number)
{
    *scene_setting(s, column) = scene_value(s, number);
}
static inline void scene_route(scene *s, int route, double accuracy)
{
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    scene_set(s, PM_SETTING_ACCURACY, accuracy);
}

static inline scene *scene_create(void)
{
    scene *s = calloc(1, sizeof *s);
    if (!s) abort();
    const int none = scene_value(s, 0);
    SCENE_ROW(s, PM_TABLE_SETTING, none, scene_value(s, -9.81), scene_value(s, 1e-11), scene_value(s, 1000),
              scene_value(s, 1e-12), PM_ROUTE_RK, 20000, 40000, PM_NONE, 0, PM_SIMULTANEOUS_TOGETHER, PM_NONE,
              PM_SHARED_NONE, scene_value(s, 1), 0);
    return s;
}

static inline scene *scene_by(int route, double accuracy)
{
    scene *s = scene_create();
    scene_route(s, route, accuracy);
    return s;
}

static inline void scene_close(scene *s)
{
    pm_workspace_free(s->w);
    pm_model_free(s->model);
    s->w = NULL;
    s->model = NULL;
}

static inline void scene_free(scene *s)
{
    scene_close(s);
    free(s->table);
    free(s);
}

/* ---- to the kernel ---- */
static inline void scene_pack(scene *s)
{
    int64_t n = 2 * PM_TABLES;
    for (int i = 0; i < PM_TABLES; i++) n += (int64_t)s->rows[i] * s->columns[i];
    free(s->table);
    s->table = calloc((size_t)n, sizeof *s->table);
    if (!s->table) abort();
    s->ntable = n;
    int32_t offset = 2 * PM_TABLES;
    for (int i = 0; i < PM_TABLES; i++) {
        const int32_t cells = s->rows[i] * s->columns[i];
        s->table[2 * i] = offset;
        s->table[2 * i + 1] = s->rows[i];
        if (cells > 0) memcpy(s->table + offset, s->cell[i], (size_t)cells * sizeof *s->table);
        offset += cells;
    }
}

/* Runs one case through the public entry; returns its status, or that of the batch where no case ran.  Scenes ask for
 * the route rk unless a test says otherwise: those that end at their start end as PM_NO_TIME_ROUTE. */
static inline int scene_run(scene *s, const double *param)
{
    const double none = 0;
    int32_t status = PM_OK;
    const int32_t stop = 0;
    int64_t progress = 0;
    scene_pack(s);
    const int result =
        pm_batch(s->ntable, s->table, s->nconstant, s->constant, 1, s->nparam, param ? param : &none, 1,
                 &stop, &progress, s->nout, s->out, s->rows[PM_TABLE_ASK], s->reason, &status, s->where,
                 s->detail, s->audit, s->count, s->found, s->error, s->margin, s->trust);
    s->status = result ? result : status;
    return s->status;
}

/* Opens a workspace on the scene: s->w, with places for answers. */
static inline int scene_open(scene *s)
{
    pm_where where;
    scene_close(s);
    scene_pack(s);
    int status =
        pm_model_create(s->ntable, s->table, s->nconstant, s->constant, s->nparam, &s->model, &where);
    if (!status) status = pm_accuracy_create(s->model, &s->w);
    if (status) return status;
    s->w->result.out = s->out;
    s->w->result.reason = s->reason;
    s->w->result.audit = s->audit;
    return PM_OK;
}

/* Opens it and brings it to its start: assembled, blows at the start done, rows built, accelerations known. */
static inline int scene_begin(scene *s)
{
    static const double none = 0;
    pm_start_report report;
    const int status = scene_open(s);
    return status ? status : pm_run_start(s->w, &none, &report);
}

#endif
