/* Waves in what is watched that are shorter than a step: sums of sines of the angle of a rod that turns evenly go through a
 * level as often as their closed form does. */
#include "check.h"
#include "scene.h"

#define SINES 6
#define WAVE 0.4 /* the first turns so many times as fast as the rod; the last SINES times this */
#define CASES 1100
#define PIECES 3000 /* of the way, in which the closed form is monotonic or turns once */
#define TOUCHES 1e-8

static double height[SINES], phase[SINES];

static double value(double x)
{
    double sum = 0;
    for (int i = 0; i < SINES; i++) sum += height[i] * sin(WAVE * (i + 1) * x + phase[i]);
    return sum;
}

static double slope(double x)
{
    double sum = 0;
    for (int i = 0; i < SINES; i++) sum += height[i] * WAVE * (i + 1) * cos(WAVE * (i + 1) * x + phase[i]);
    return sum;
}

/* Between a and b, where the slope changes sign. */
static double turn(double a, double b)
{
    const double sign = slope(a);
    for (int i = 0; i < 60; i++) {
        const double x = 0.5 * (a + b);
        if (slope(x) * sign > 0)
            a = x;
        else
            b = x;
    }
    return a;
}

/* How often the sum goes through the level from 0 to `end`; -1 if it but touches it. */
static int crossings(double level, double end)
{
    double last = value(0) - level;
    int count = 0;
    for (int i = 0; i < PIECES; i++) {
        const double a = end * i / PIECES, b = end * (i + 1) / PIECES;
        if (slope(a) * slope(b) < 0) {
            const double x = value(turn(a, b)) - level;
            if (fabs(x) < TOUCHES) return -1;
            count += x * last < 0;
            last = x;
        }
        const double x = value(b) - level;
        count += x * last < 0;
        last = x;
    }
    return count;
}

static int program(scene *s, int turned, double level)
{
    scene_code code[9 * SINES + 1];
    int n = 0;
    code[n++] = scene_k(s, -level);
    for (int i = 0; i < SINES; i++) {
        const scene_code sine[] = {scene_m(turned),       scene_k(s, WAVE * (i + 1)), scene_op(PM_OP_MUL),
                                   scene_k(s, phase[i]),  scene_op(PM_OP_ADD),        scene_op(PM_OP_SIN),
                                   scene_k(s, height[i]), scene_op(PM_OP_MUL),        scene_op(PM_OP_ADD)};
        for (int k = 0; k < 9; k++) code[n++] = sine[k];
    }
    return scene_program(s, n, code);
}

static double counted(double level, double end)
{
    scene *s = scene_create();
    const int rod = scene_body(s, 1, 1.0 / 12, 0, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_start_omega(s, rod, 3);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    const int turned = scene_measure(s, PM_MEASURE_TURNED, rod);
    const int event = scene_when(s, PM_TRIGGER_CROSS, program(s, turned, level));
    const int count = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, event));
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turned, end)), 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double result = s->out[count];
    scene_free(s);
    return result;
}

int main(void)
{
    for (int i = 0; i < CASES; i++) {
        for (int k = 0; k < SINES; k++) {
            height[k] = check_random(-1, 1);
            phase[k] = check_random(0, 6.3);
        }
        const double end = check_random(1, 12), level = check_random(-1.5, 1.5);
        const int expected = crossings(level, end);
        if (expected >= 0) EQUAL((int)counted(level, end), expected);
    }
    return check_failures();
}
