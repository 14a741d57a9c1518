/* Throws whose speed or angle is looked for. */
#ifndef FIND_THROWS_H
#define FIND_THROWS_H

#include "scene.h"

/* A particle thrown from the origin with speed parameter 0 at the angle parameter 1. */
typedef struct throwing {
    scene *s;
    int point, x, y, time;
} throwing;

static inline throwing thrown(void)
{
    throwing f = {.s = scene_create()};
    scene *s = f.s;
    const int body = scene_body(s, 1, 0, 0, 0, 0);
    f.point = scene_point(s, body, 0, 0);
    const int v = scene_parameter(s), angle = scene_parameter(s);
    const int vx = scene_value_of(
        s, SCENE_PROGRAM(s, scene_v(v), scene_v(angle), scene_op(PM_OP_COS), scene_op(PM_OP_MUL)));
    const int vy = scene_value_of(
        s, SCENE_PROGRAM(s, scene_v(v), scene_v(angle), scene_op(PM_OP_SIN), scene_op(PM_OP_MUL)));
    SCENE_ROW(s, PM_TABLE_START, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, f.point, PM_PART_X),
              vx);
    SCENE_ROW(s, PM_TABLE_START, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, f.point, PM_PART_Y),
              vy);
    f.x = scene_part(s, PM_MEASURE_POSITION, f.point, PM_PART_X);
    f.y = scene_part(s, PM_MEASURE_POSITION, f.point, PM_PART_Y);
    f.time = scene_time(s);
    return f;
}

/* The run ends when the particle comes down to a height. */
static inline throwing thrown_down_to(double height)
{
    throwing f = thrown();
    scene_until(f.s, scene_when(f.s, PM_TRIGGER_FALL, scene_minus(f.s, f.y, height)), 1);
    return f;
}

static inline int range_less(const throwing *f, double wanted) { return scene_minus(f->s, f->x, wanted); }

#endif
