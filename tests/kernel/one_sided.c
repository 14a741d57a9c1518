/* Springs that only push: a particle meets one head on, is in it for half a period, and flies back, however far it came from. */
#include "check.h"
#include "estimating.h"
#include "scene.h"
#include "state/workspace.h"

#include <math.h>

/* 1 where the stretch of force number `force` is above zero. */
static int side_of(scene *s, int force)
{
    const int event = SCENE_ROW(s, PM_TABLE_EVENT, 0, PM_EFFECT_SWITCH),
              stretch = scene_read(s, scene_measure(s, PM_MEASURE_FORCE_STRETCH, force));
    scene_trigger(s, PM_TRIGGER_RISE, event, stretch, PM_NONE);
    scene_trigger(s, PM_TRIGGER_FALL, event, stretch, PM_NONE);
    return scene_read(s, scene_measure(s, PM_MEASURE_EVENT_SIDE, event));
}

static void flies_back(int route)
{
    for (int i = 0; i < (route == PM_ROUTE_IDA ? 10 : 100); i++) {
        const double length = pow(10, check_random(-2, 0)),
                     far = length * pow(10, check_random(0.1, route == PM_ROUTE_IDA ? 1 : 3)),
                     speed = pow(10, check_random(-1, 1)),
                     rate = speed / length * pow(10, check_random(0.1, 3)), meets = (far - length) / speed,
                     leaves = meets + 3.14159265358979323846 / rate,
                     end = leaves + check_random(0.1, 1) * meets;
        scene *s = estimating(1e-10);
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        scene_set(s, PM_SETTING_MAX_TIME, 1e9);
        scene_set(s, PM_SETTING_GRAVITY_Y, 0);
        const int p = scene_point(s, scene_body(s, 1, 0, -far, 0, 0), 0, 0);
        scene_start_velocity(s, p, speed, 0);
        const int force = SCENE_ROW(s, PM_TABLE_FORCE, PM_FORCE_SPRING, p, scene_point(s, PM_GROUND, 0, 0),
                                    scene_value(s, rate * rate), scene_value(s, length), side_of(s, 0),
                                    PM_NONE, PM_SPRING_PUSH);
        scene_until_time(s, end);
        scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, p, PM_PART_X));
        scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, scene_measure(s, PM_MEASURE_FORCE_STRETCH, force)),
                          PM_NONE);
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[0], -length - speed * (end - leaves), 5 * s->error[0] + 1e-13 * far);
        NEAR(s->out[1], -speed / rate, 5 * s->error[1] + 1e-13 * far);
        scene_free(s);
    }
}

/* A spring of no stiffness: the event alone looks at the distance, which is small for a moment. */
static void is_seen(int route)
{
    for (int i = 0; i < 100; i++) {
        const double far = pow(10, check_random(0, 3)), beside = 0.1 * check_random(-0.999, 0.999);
        scene *s = estimating(1e-10);
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        scene_set(s, PM_SETTING_MAX_TIME, 1e9);
        scene_set(s, PM_SETTING_GRAVITY_Y, 0);
        const int p = scene_point(s, scene_body(s, 1, 0, -far, beside, 0), 0, 0);
        scene_start_velocity(s, p, 1, 0);
        const int force = scene_force(s, PM_FORCE_SPRING, p, scene_point(s, PM_GROUND, 0, 0), 0, 0.1),
                  stretch = scene_read(s, scene_measure(s, PM_MEASURE_FORCE_STRETCH, force));
        scene_until_time(s, far * check_random(1.2, 3));
        scene_ask_count(s, scene_when(s, PM_TRIGGER_FALL, stretch));
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[0], 1);
        scene_free(s);
    }
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int i = 0; i < 3; i++) {
        flies_back(routes[i]);
        is_seen(routes[i]);
    }
    return check_failures();
}
