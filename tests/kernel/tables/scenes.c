/* scenes.c - some models by hand, so that tables are changed where no Python is: together they have rows in most tables. */
#include "scene.h"

#include "tables.h"

/* The tables of a scene, which is freed; a case may compute for a short time only. */
static tables packed(scene *s)
{
    scene_set(s, PM_SETTING_MAX_CPU, 0.005);
    *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    scene_pack(s);
    double param[4] = {0.3, 1, 2, 3};
    const tables given = {.ntable = s->ntable,
                          .nconstant = s->nconstant,
                          .nparam = s->nparam,
                          .table = s->table,
                          .constant = s->constant,
                          .param = param};
    const tables kept = tables_copy(&given);
    scene_free(s);
    return kept;
}

/* A disk that falls on a rough floor and between walls, bounces and rolls. */
static tables bouncing_disk(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 2, 0.01, 0, 0.5, 0), g = scene_point(s, b, 0, 0),
              rim = scene_circle(s, g, 0.1);
    scene_contact(s, PM_CONTACT_LINE, rim, scene_floor(s, 0), 0, 0.5, PM_FRICTION_COULOMB, 0.2);
    scene_segment(s, rim, scene_line(s, scene_point(s, PM_GROUND, 0.4, 0), 1.5), 0, 1, 0.3,
                  PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, g, 1, 0);
    scene_start_omega(s, b, 3);
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, 0),
              x = scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X);
    scene_until_time(s, 2);
    scene_ask_measure(s, x);
    scene_ask_event(s, scene_read(s, scene_measure(s, PM_MEASURE_OMEGA, b)), strike, 2, 1);
    scene_ask(s, PM_ASK_EACH, scene_read(s, scene_time(s)), strike, 1, 0, PM_NONE, PM_NONE, 5);
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, 0)), PM_NONE);
    return packed(s);
}

/* A sphere over bars, their distance sought. */
static tables bars(void)
{
    scene *s = scene_create();
    const int d = scene_parameter(s), b = scene_body(s, 3, 0.075, 0, 0.25, 0), g = scene_point(s, b, 0, 0);
    const int row = SCENE_ROW(s, PM_TABLE_PATTERN, scene_point(s, PM_GROUND, 0, 0), d, scene_value(s, 0),
                              scene_value(s, -1));
    scene_contact(s, PM_CONTACT_PATTERN, scene_circle(s, g, 0.25), row, 0, 0, PM_FRICTION_ROUGH, 0);
    const int w = scene_measure(s, PM_MEASURE_OMEGA, b);
    scene_start(s, PM_START_VELOCITY, w, -1.5);
    scene_on(s, PM_TRIGGER_STRIKE, 0);
    const int turned = scene_when(s, PM_TRIGGER_RISE, scene_read(s, w));
    scene_until(s, turned, 1);
    scene_until_time(s, 3);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, 0));
    scene_find(s, PM_FIND_VALUE, PM_NONE, 4);
    scene_vary(s, 0, 0.02, 0.3);
    scene_where(s, PM_CONDITION_ZERO, scene_minus(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, 0), 2.5));
    return packed(s);
}

/* A slider-crank with a spring, a damper, dry friction, a push read from a table, an action, integrals and a grid. */
static tables linkage(void)
{
    scene *s = scene_create();
    const int crank = scene_body(s, 1, 0.02, 0.1, 0, 0), rod = scene_body(s, 1, 0.05, 0.45, 0, 0),
              slide = scene_body(s, 2, 0, 0.7, 0, 0), o = scene_point(s, PM_GROUND, 0, 0);
    const int end = scene_point(s, slide, 0, 0),
              pin = scene_joint(s, PM_JOINT_PIN, scene_point(s, crank, -0.1, 0), o, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, crank, 0.1, 0), scene_point(s, rod, -0.25, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, 0.25, 0), end, 0);
    scene_joint(s, PM_JOINT_SLIDER, end, scene_floor(s, 0), 0);
    scene_force(s, PM_FORCE_SPRING, end, o, 50, 0.5);
    scene_force(s, PM_FORCE_DAMPER, end, o, 0.5, 0);
    scene_force(s, PM_FORCE_FRICTION, pin, pin, 0.1, 0.01);
    const double knot[] = {0, 0.2, 1}, height[] = {0, 3, 1};
    const int piecewise = scene_lines(s, 3, knot, height, PM_BEYOND_HOLD), time = scene_time(s);
    const int push = SCENE_PROGRAM(s, scene_m(time), (scene_code){PM_OP_PIECEWISE, piecewise});
    scene_applied(s, end, PM_GROUND, push, scene_read(s, time));
    scene_start_omega(s, crank, 6);
    const int turn = scene_measure(s, PM_MEASURE_ANGLE, crank),
              e = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turn, 1));
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_REMOVE, e, PM_TABLE_FORCE, 0, PM_NONE, PM_NONE);
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_ANGULAR, e, PM_NONE, crank, push, PM_NONE);
    scene_until_time(s, 1);
    const int speed = scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, end, PM_PART_X)),
              first = scene_value(s, 0.1);
    for (int k = 2; k < 5; k++) scene_value(s, 0.1 * k);
    scene_ask(s, PM_ASK_GRID, speed, PM_NONE, 1, 0, scene_read(s, time), first, 4);
    scene_ask(s, PM_ASK_RMS, speed, PM_NONE, 1, 0, PM_NONE, PM_NONE, 1);
    scene_ask_extreme(s, PM_ASK_AT_MIN, scene_read(s, time), speed);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, pin, PM_PART_NORM));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_FORCE_WORK, 2));
    return packed(s);
}

/* A bead on a parabola, in a plane that turns. */
static tables turning_bead(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0, 0.2, 0.04, 0), g = scene_point(s, b, 0, 0),
              o = scene_point(s, PM_GROUND, 0, 0);
    const scene_code place = scene_m(scene_measure(s, PM_MEASURE_PLACE, PM_NONE));
    const int x = SCENE_PROGRAM(s, place), y = SCENE_PROGRAM(s, place, place, scene_op(PM_OP_MUL));
    const int curve =
        SCENE_ROW(s, PM_TABLE_CURVE, o, x, y, scene_value(s, -1), scene_value(s, 1), 0, 1, PM_NONE);
    scene_joint(s, PM_JOINT_SLOT, g, curve, 0);
    SCENE_ROW(s, PM_TABLE_SPIN, scene_value(s, 0), scene_value(s, 0), scene_value(s, 1.5707963267948966),
              scene_value(s, 0.1), scene_value(s, 2), PM_NONE);
    SCENE_ROW(s, PM_TABLE_SECOND, scene_value(s, 0), scene_value(s, 0), scene_value(s, 0));
    scene_until_time(s, 1);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_SPIN_OMEGA, PM_NONE));
    scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y)),
                      PM_NONE);
    return packed(s);
}

/* Two particles at a cord, one drawn by a motor; they are caught where they meet. */
static tables cord(void)
{
    scene *s = scene_create();
    const int a = scene_body(s, 1, 0, 0, 0, 0), b = scene_body(s, 2, 0, 0.5, -0.2, 0);
    const int ga = scene_point(s, a, 0, 0), gb = scene_point(s, b, 0, 0), ca = scene_circle(s, ga, 0),
              cb = scene_circle(s, gb, 0);
    const int time = scene_time(s), o = scene_point(s, PM_GROUND, 0, 0);
    scene_cord(s, ca, 1, cb, 1, 0.3, 0.2);
    scene_capture(s, PM_CONTACT_POINT, ca, cb, 0, PM_CAPTURE_POINT);
    scene_drive(s, PM_JOINT_PLACED, ga, o, scene_read(s, time),
                SCENE_PROGRAM(s, scene_m(time), scene_op(PM_OP_SIN)));
    scene_until_time(s, 1);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, gb, PM_PART_Y));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, 0));
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, 0)), PM_NONE);
    return packed(s);
}

void corpus_build(corpus *c)
{
    corpus_add(c, bouncing_disk());
    corpus_add(c, bars());
    corpus_add(c, linkage());
    corpus_add(c, turning_bead());
    corpus_add(c, cord());
}
