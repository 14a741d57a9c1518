/* Waves in what is watched that are shorter than a step, a little or a hundred times: sums of sines of the angle of a rod that
 * turns evenly go through a level as often as their closed form does. */
#include "check.h"
#include "scene.h"

#define SINES 6
#define CASES 1100
#define MANY 30     /* cases of each route with many waves */
#define PIECES 6000 /* of the way, in which the closed form is monotonic or turns once */
#define TOUCHES 1e-8

static double wave = 0.4; /* the first turns so many times as fast as the rod; the last SINES times this */
static double height[SINES], phase[SINES];

static double value(double x)
{
    double sum = 0;
    for (int i = 0; i < SINES; i++) sum += height[i] * sin(wave * (i + 1) * x + phase[i]);
    return sum;
}

static double slope(double x)
{
    double sum = 0;
    for (int i = 0; i < SINES; i++) sum += height[i] * wave * (i + 1) * cos(wave * (i + 1) * x + phase[i]);
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
        const scene_code sine[] = {scene_m(turned),       scene_k(s, wave * (i + 1)), scene_op(PM_OP_MUL),
                                   scene_k(s, phase[i]),  scene_op(PM_OP_ADD),        scene_op(PM_OP_SIN),
                                   scene_k(s, height[i]), scene_op(PM_OP_MUL),        scene_op(PM_OP_ADD)};
        for (int k = 0; k < 9; k++) code[n++] = sine[k];
    }
    return scene_program(s, n, code);
}

/* A rod that turns at 3 rad/s. */
static scene *rod_on_pin(int route, int *turned)
{
    scene *s = scene_create();
    const int rod = scene_body(s, 1, 1.0 / 12, 0, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_start_omega(s, rod, 3);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    *turned = scene_measure(s, PM_MEASURE_TURNED, rod);
    return s;
}

/* How often the event fires until it has turned by `end`; the scene is gone then. */
static double counted(scene *s, int event, int turned, double end)
{
    const int count = scene_ask_count(s, event);
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turned, end)), 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double result = s->out[count];
    scene_free(s);
    return result;
}

static int through_level(int route, double level, double end)
{
    int turned;
    scene *s = rod_on_pin(route, &turned);
    const int event = scene_when(s, PM_TRIGGER_CROSS, program(s, turned, level));
    return (int)counted(s, event, turned, end);
}

/* (u - c)^2 - e falls through zero and rises again, both between two samples: how often it rises, or falls. */
static int through_dip(int route, int trigger, double c, double e)
{
    int turned;
    scene *s = rod_on_pin(route, &turned);
    const int program = SCENE_PROGRAM(s, scene_m(turned), scene_k(s, c), scene_op(PM_OP_SUB), scene_k(s, 2),
                                      scene_op(PM_OP_POW), scene_k(s, e), scene_op(PM_OP_SUB));
    return (int)counted(s, scene_when(s, trigger, program), turned, 3);
}

static void try_route(int route, double longest)
{
    for (int k = 0; k < SINES; k++) {
        height[k] = check_random(-1, 1);
        phase[k] = check_random(0, 6.3);
    }
    const double end = check_random(1, longest), level = check_random(-1.5, 1.5);
    const int expected = crossings(level, end);
    if (expected >= 0) EQUAL(through_level(route, level, end), expected);
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_PATH, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int i = 0; i < CASES; i++) try_route(PM_ROUTE_PATH, 12);
    for (size_t r = 0; r < sizeof routes / sizeof *routes; r++)
        for (int i = 0; i < MANY; i++) {
            wave = pow(10, check_random(-1, 1.3));
            try_route(routes[r], 4);
        }
    for (size_t r = 0; r < sizeof routes / sizeof *routes; r++)
        for (int i = 0; i < MANY; i++) {
            const double c = check_random(0.1, 2.9), e = pow(10, check_random(-8, -3));
            EQUAL(through_dip(routes[r], PM_TRIGGER_RISE, c, e), 1);
            EQUAL(through_dip(routes[r], PM_TRIGGER_FALL, c, e), 1);
        }
    return check_failures();
}
