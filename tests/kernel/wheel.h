/* wheel.h - a wheel that turns evenly, 1 rad/s: what is asked along its way has a closed form in its angle. */
#ifndef WHEEL_H
#define WHEEL_H

#include "check.h"
#include "scene.h"

typedef struct wheel {
    scene *s;
    int turned, x,
        y; /* measures: its angle, and the coordinates of a point of its rim at that angle, 1 m from its axle */
    int c; /* the parameter, a value */
} wheel;

/* It stops at the angle `end`. */
static inline wheel wheel_turning(int route, double end)
{
    wheel x = {.s = scene_create()};
    scene *s = x.s;
    const int body = scene_body(s, 2, 0.3, 0, 0, 0), point = scene_point(s, body, 1, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, body, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_start_omega(s, body, 1);
    x.turned = scene_measure(s, PM_MEASURE_TURNED, body);
    x.x = scene_part(s, PM_MEASURE_POSITION, point, PM_PART_X);
    x.y = scene_part(s, PM_MEASURE_POSITION, point, PM_PART_Y);
    x.c = scene_parameter(s);
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, x.turned, end)), 1);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    return x;
}

/* The one answer for so many c from `from` to `to`, and how far it may be off; ends the wheel. */
static inline void wheel_expect(wheel x, int places, double from, double to, double value, double bound)
{
    for (int i = 0; i < places; i++) {
        const double c = from + (to - from) * (i + 0.37) / places;
        EQUAL(scene_run(x.s, &c), PM_OK);
        NEAR(x.s->out[0], value, bound);
    }
    scene_free(x.s);
}

#endif
