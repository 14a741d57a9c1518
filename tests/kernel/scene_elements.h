/* scene_elements.h - the tables of a scene: rows, programs, bodies, joints, contacts and forces.  Read scene.h first. */
#ifndef SCENE_ELEMENTS_H
#define SCENE_ELEMENTS_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "planemotion.h"
#include "state/workspace.h"

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

#endif
