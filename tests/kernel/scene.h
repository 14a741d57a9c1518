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

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "equations/case.h"
#include "equations/start.h"
#include "run/run.h"
#include "scene/build.h"
#include "state/workspace.h"
#include "study/accuracy.h"

#define SCENE_CELLS 8192
#define SCENE_OUTS 256

typedef struct scene_code {
    int32_t op, arg;
} scene_code;

typedef struct scene {
    int32_t cell[PM_TABLES][SCENE_CELLS];
    int columns[PM_TABLES], rows[PM_TABLES];
    double constant[SCENE_CELLS];
    int nconstant, nparam, nout;
    int32_t *table; /* as packed for the kernel */
    int64_t ntable;
    /* what the last run gave */
    double out[SCENE_OUTS], error[SCENE_OUTS], margin[SCENE_OUTS], trust[PM_TRUSTS], audit[PM_AUDITS],
        detail[PM_DETAIL_COLUMNS];
    int32_t reason[SCENE_OUTS], where[PM_WHERE_COLUMNS];
    int64_t count[PM_COUNT_COLUMNS];
    double found[PM_FOUND_COLUMNS];
    int status;
    /* an open workspace, for tests that look inside */
    pm_model *model;
    pm_workspace *w;
} scene;

/* ---- rows ---- */
static inline int scene_row(scene *s, int table, int columns, const int32_t *cell)
{
    const int row = s->rows[table]++;
    if ((row + 1) * columns > SCENE_CELLS) abort();
    s->columns[table] = columns;
    memcpy(s->cell[table] + row * columns, cell, (size_t)columns * sizeof *cell);
    return row;
}
#define SCENE_ROW(s, table, ...) \
    scene_row(s, table, (int)(sizeof((int32_t[]){__VA_ARGS__}) / sizeof(int32_t)), (int32_t[]){__VA_ARGS__})

/* ---- programs and values ---- */
static inline int scene_constant(scene *s, double x)
{
    s->constant[s->nconstant] = x;
    return s->nconstant++;
}
static inline scene_code scene_op(int op) { return (scene_code){op, 0}; }
static inline scene_code scene_k(scene *s, double x)
{
    return (scene_code){PM_OP_CONSTANT, scene_constant(s, x)};
}
static inline scene_code scene_v(int value) { return (scene_code){PM_OP_VALUE, value}; }
static inline scene_code scene_p(int parameter) { return (scene_code){PM_OP_PARAMETER, parameter}; }
static inline scene_code scene_m(int measure) { return (scene_code){PM_OP_MEASURE, measure}; }

static inline int scene_program(scene *s, int n, const scene_code *code)
{
    const int first = s->rows[PM_TABLE_CODE];
    for (int i = 0; i < n; i++) SCENE_ROW(s, PM_TABLE_CODE, code[i].op, code[i].arg);
    return SCENE_ROW(s, PM_TABLE_PROGRAM, first, n);
}
#define SCENE_PROGRAM(s, ...)                                                         \
    scene_program(s, (int)(sizeof((scene_code[]){__VA_ARGS__}) / sizeof(scene_code)), \
                  (scene_code[]){__VA_ARGS__})

static inline int scene_value_of(scene *s, int program) { return SCENE_ROW(s, PM_TABLE_VALUE, program); }
static inline int scene_value(scene *s, double x)
{
    return scene_value_of(s, SCENE_PROGRAM(s, scene_k(s, x)));
}
/* A value that is the next parameter of the case. */
static inline int scene_parameter(scene *s)
{
    return scene_value_of(s, SCENE_PROGRAM(s, scene_p(s->nparam++)));
}

/* A piecewise polynomial: knot[knots], coefficient[(knots - 1) (degree + 1)]. */
static inline int scene_piecewise(scene *s, int knots, const double *knot, int degree,
                                  const double *coefficient, int beyond)
{
    const int first = s->nconstant;
    for (int i = 0; i < knots; i++) scene_constant(s, knot[i]);
    for (int i = 0; i < (knots - 1) * (degree + 1); i++) scene_constant(s, coefficient[i]);
    return SCENE_ROW(s, PM_TABLE_PIECEWISE, first, knots, degree, beyond);
}
/* Straight lines between values. */
static inline int scene_lines(scene *s, int knots, const double *knot, const double *value, int beyond)
{
    double coefficient[2 * 64];
    for (int i = 0; i + 1 < knots; i++) {
        coefficient[2 * i] = value[i];
        coefficient[2 * i + 1] = (value[i + 1] - value[i]) / (knot[i + 1] - knot[i]);
    }
    return scene_piecewise(s, knots, knot, 1, coefficient, beyond);
}

/* ---- bodies and marks ---- */
static inline int scene_body(scene *s, double mass, double inertia, double x, double y, double angle)
{
    return SCENE_ROW(s, PM_TABLE_BODY, inertia > 0, scene_value(s, mass), scene_value(s, inertia),
                     scene_value(s, x), scene_value(s, y), scene_value(s, angle));
}
static inline int scene_point(scene *s, int body, double x, double y)
{
    return SCENE_ROW(s, PM_TABLE_POINT, body, scene_value(s, x), scene_value(s, y));
}
static inline int scene_line(scene *s, int point, double angle)
{
    return SCENE_ROW(s, PM_TABLE_LINE, point, scene_value(s, angle));
}
static inline int scene_circle(scene *s, int point, double radius)
{
    return SCENE_ROW(s, PM_TABLE_CIRCLE, point, scene_value(s, radius));
}
static inline int scene_floor(scene *s, double angle)
{
    return scene_line(s, scene_point(s, PM_GROUND, 0, 0), angle);
}

/* ---- joints, contacts, forces ---- */
static inline int scene_joint(scene *s, int kind, int a, int b, double number)
{
    return SCENE_ROW(s, PM_TABLE_JOINT, kind, a, b, scene_value(s, number), PM_NONE, PM_NONE, PM_NONE);
}
/* Circle a by teeth with circle b, or with line b (side 0), at a pressure angle. */
static inline int scene_teeth(scene *s, int a, int b, double side, double pressure)
{
    return SCENE_ROW(s, PM_TABLE_JOINT, side == 0 ? PM_JOINT_RACK : PM_JOINT_TEETH, a, b,
                     side == 0 ? PM_NONE : scene_value(s, side), PM_NONE, PM_NONE, scene_value(s, pressure));
}
/* A belt with a tension at rest, open (1) or crossed (-1): PM_JOINT_BELT_GRIPS or PM_JOINT_BELT_SLIPS. */
static inline int scene_belt(scene *s, int kind, int a, int b, double sense, double tension)
{
    return SCENE_ROW(s, PM_TABLE_JOINT, kind, a, b, scene_value(s, sense), PM_NONE, PM_NONE,
                     scene_value(s, tension));
}
/* friction: PM_FRICTION_...; static and kinetic coefficient mu */
static inline int scene_contact(scene *s, int kind, int a, int b, double side, double e, int friction,
                                double mu)
{
    const int value = friction == PM_FRICTION_COULOMB ? scene_value(s, mu) : PM_NONE;
    return SCENE_ROW(s, PM_TABLE_CONTACT, kind, a, b,
                     kind == PM_CONTACT_CIRCLE ? scene_value(s, side) : PM_NONE, scene_value(s, e), friction,
                     value, value, PM_NONE, PM_NONE, 1, 1, PM_CAPTURE_NONE, PM_NONE, PM_LAW_NEWTON, PM_NONE,
                     PM_NONE, PM_PAINLEVE_STOPS, PM_NONE, PM_NONE, PM_NONE, PM_NONE, PM_NONE, PM_NONE);
}
/* A contact that captures: PM_CONTACT_POINT (circles of radius 0) and any kind but a cord. */
static inline int scene_capture(scene *s, int kind, int a, int b, double side, int capture)
{
    const int row = scene_contact(s, kind, a, b, side, 0, PM_FRICTION_SMOOTH, 0);
    s->cell[PM_TABLE_CONTACT][row * PM_CONTACT_COLUMNS + PM_CONTACT_CAPTURE] = capture;
    return row;
}
/* Sets a cell of a row that is there. */
static inline void scene_cell(scene *s, int table, int row, int column, int32_t value)
{
    s->cell[table][row * s->columns[table] + column] = value;
}
/* Circle a on line b between two places of it. */
static inline int scene_segment(scene *s, int a, int b, double from, double to, double e, int friction,
                                double mu)
{
    const int contact = scene_contact(s, PM_CONTACT_SEGMENT, a, b, 0, e, friction, mu);
    scene_cell(s, PM_TABLE_CONTACT, contact, PM_CONTACT_FROM, scene_value(s, from));
    scene_cell(s, PM_TABLE_CONTACT, contact, PM_CONTACT_TO, scene_value(s, to));
    return contact;
}
static inline int scene_cord(scene *s, int a, int sense_a, int b, int sense_b, double slack, double e)
{
    return SCENE_ROW(s, PM_TABLE_CONTACT, PM_CONTACT_CORD, a, b, PM_NONE, scene_value(s, e),
                     PM_FRICTION_SMOOTH, PM_NONE, PM_NONE, PM_NONE, scene_value(s, slack), sense_a, sense_b,
                     PM_CAPTURE_NONE, PM_NONE, PM_LAW_NEWTON, PM_NONE, PM_NONE, PM_PAINLEVE_STOPS, PM_NONE,
                     PM_NONE, PM_NONE, PM_NONE, PM_NONE, PM_NONE);
}
/* A cord from circle a over a rim, where it has friction, to circle b; senses of a, b and the rim. */
static inline int scene_cord_over(scene *s, int a, int b, int rim, const int sense[3], double turns,
                                  double mu_static, double mu_kinetic)
{
    return SCENE_ROW(s, PM_TABLE_CONTACT, PM_CONTACT_CORD, a, b, PM_NONE, scene_value(s, 0),
                     PM_FRICTION_COULOMB, scene_value(s, mu_static), scene_value(s, mu_kinetic), PM_NONE,
                     scene_value(s, 0), sense[0], sense[1], PM_CAPTURE_NONE, PM_NONE, PM_LAW_NEWTON, PM_NONE,
                     PM_NONE, PM_PAINLEVE_STOPS, PM_NONE, PM_NONE, rim, sense[2], scene_value(s, turns),
                     PM_NONE);
}
/* Both flanks of wheels a, b, or (side 0) of wheel a and a rack on line b, in the middle of their backlash, m. */
static inline int scene_flanks(scene *s, int a, int b, double side, double pressure, double backlash,
                               double e)
{
    int row = 0;
    for (int flank = 1; flank >= -1; flank -= 2)
        row = SCENE_ROW(s, PM_TABLE_CONTACT, side == 0 ? PM_CONTACT_RACK : PM_CONTACT_TEETH, a, b,
                        side == 0 ? PM_NONE : scene_value(s, side), scene_value(s, e), PM_FRICTION_SMOOTH,
                        PM_NONE, PM_NONE, PM_NONE, scene_value(s, 0.5 * backlash * cos(pressure)), flank, 1,
                        PM_CAPTURE_NONE, PM_NONE, PM_LAW_NEWTON, PM_NONE, PM_NONE, PM_PAINLEVE_STOPS, PM_NONE,
                        scene_value(s, pressure), PM_NONE, PM_NONE, PM_NONE, PM_NONE);
    return row - 1;
}
/* A drive: PM_JOINT_RATE of bodies or PM_JOINT_DRIVE of points, by programs of the time. */
static inline int scene_drive(scene *s, int kind, int a, int b, int program_x, int program_y)
{
    return SCENE_ROW(s, PM_TABLE_JOINT, kind, a, b, PM_NONE, program_x, program_y, PM_NONE);
}
static inline int scene_force(scene *s, int kind, int a, int b, double value_1, double value_2)
{
    return SCENE_ROW(s, PM_TABLE_FORCE, kind, a, b, scene_value(s, value_1), scene_value(s, value_2), PM_NONE,
                     PM_NONE, PM_SPRING_BOTH);
}
static inline int scene_applied(scene *s, int point, int axes, int program_x, int program_y)
{
    return SCENE_ROW(s, PM_TABLE_FORCE, PM_FORCE_APPLIED, point, axes, PM_NONE, PM_NONE, program_x, program_y,
                     0);
}
static inline int scene_couple(scene *s, int a, int b, int program)
{
    return SCENE_ROW(s, PM_TABLE_FORCE, PM_FORCE_COUPLE, a, b, PM_NONE, PM_NONE, program, PM_NONE, 0);
}
/* Draws points a and b together. */
static inline int scene_line_force(scene *s, int a, int b, int program)
{
    return SCENE_ROW(s, PM_TABLE_FORCE, PM_FORCE_LINE, a, b, PM_NONE, PM_NONE, program, PM_NONE, 0);
}

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
