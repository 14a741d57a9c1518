/* Scenes that estimate their errors. */
#ifndef ESTIMATING_H
#define ESTIMATING_H

#include "scene.h"
#include "state/workspace.h"

#define G 9.81

static inline scene *estimating(double accuracy)
{
    scene *s = scene_create();
    scene_set(s, PM_SETTING_ACCURACY, accuracy);
    *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
    return s;
}

/* A double pendulum of two equal rods that hangs from the origin; the lower one. */
static inline int hang_two_rods(scene *s, double upper_angle, double lower_angle)
{
    const double elbow[] = {cos(upper_angle), sin(upper_angle)},
                 half[] = {0.5 * cos(lower_angle), 0.5 * sin(lower_angle)};
    const int upper = scene_body(s, 1, 1. / 12, 0.5 * elbow[0], 0.5 * elbow[1], upper_angle),
              lower = scene_body(s, 1, 1. / 12, elbow[0] + half[0], elbow[1] + half[1], lower_angle);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, upper, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, upper, 0.5, 0), scene_point(s, lower, -0.5, 0), 0);
    return lower;
}

/* A ball thrown up towards a ceiling: it strikes if v^2 > 2 g h.  The nearer to it, the smaller the margin; nearer than
 * rounding the outcome is not decided. */
static inline scene *thrown(double above, double accuracy)
{
    scene *s = estimating(accuracy);
    const double v = sqrt(2 * G * 1.5 * (1 + above));
    const int ball = scene_body(s, 1, 0, 0, 0, 0), g = scene_point(s, ball, 0, 0);
    scene_start_velocity(s, g, 0.3, v);
    const int y = scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y), up = scene_event(s);
    scene_trigger(s, PM_TRIGGER_RISE, up, scene_minus(s, y, 1.5), PM_NONE);
    scene_until_time(s, 2);
    scene_ask_count(s, up);
    return s;
}

static inline double mean(long double a, long double b) /* arithmetic-geometric */
{
    for (int i = 0; i < 40; i++) {
        const long double c = (a + b) / 2;
        b = sqrtl(a * b);
        a = c;
    }
    return (double)a;
}

#endif
