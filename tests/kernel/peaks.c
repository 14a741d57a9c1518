/* Peaks with corners and steps, narrow beside a step: extremes where two switches are passed between two nodes, one of them
 * there and back; events on a speed, which has an infinite rate by the way where the motion begins at rest; values right before
 * and right after a jump; stairs without end. */
#include "check.h"
#include "scene.h"

#define CASES 40
#define SUB scene_op(PM_OP_SUB)
#define ABS scene_op(PM_OP_ABS)
#define K(x) scene_k(s, x)
#define U scene_m(read)

static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};

/* A rod on a pin, from its lowest place with 3 rad/s, or let go from the level with weight; *read: how far it has turned, or its
 * speed. */
static scene *rod_on_pin(int route, int falls, int kind, int *read)
{
    scene *s = scene_create();
    const int rod = scene_body(s, 1, 1.0 / 12, falls ? 0.5 : 0, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, falls ? -0.5 : 0, 0), scene_point(s, PM_GROUND, 0, 0),
                0);
    if (!falls) scene_start_omega(s, rod, 3);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    *read = scene_measure(s, kind, rod);
    const int turned = scene_measure(s, PM_MEASURE_TURNED, rod);
    const int end = falls ? scene_minus(s, turned, -3) : scene_minus(s, turned, 3);
    scene_until(s, scene_when(s, falls ? PM_TRIGGER_FALL : PM_TRIGGER_RISE, end), 1);
    return s;
}

static double answer(scene *s, int out)
{
    EQUAL(scene_run(s, NULL), PM_OK);
    const double value = s->out[out];
    scene_free(s);
    return value;
}

/* max(|u - a|, |2 (u - a) - e|) is least at u - a = e/3: e/3. */
static void a_valley_of_two(int route, double a, double e)
{
    int read;
    scene *s = rod_on_pin(route, 0, PM_MEASURE_TURNED, &read);
    const int program = SCENE_PROGRAM(s, U, K(a), SUB, ABS, U, K(a), SUB, K(2), scene_op(PM_OP_MUL), K(e),
                                      SUB, ABS, scene_op(PM_OP_MAX));
    const int out = scene_ask_extreme(s, PM_ASK_MIN, program, PM_NONE);
    NEAR(answer(s, out), e / 3, 1e-11);
}

/* The speed passes -a once as it falls and once as it rises: each time it comes as near as half the width. */
static void a_peak_of_speed(int route, double a, double width)
{
    int read;
    scene *s = rod_on_pin(route, 1, PM_MEASURE_OMEGA, &read);
    const int program = SCENE_PROGRAM(s, K(0.5 * width), U, K(-a), SUB, ABS, SUB);
    const int event = scene_when(s, PM_TRIGGER_RISE, program);
    const int out = scene_ask_count(s, event);
    EQUAL((int)answer(s, out), 2);
}

/* (u < c) (1 + u): 1 + c before c, if that is not attained. */
static void a_jump(int route, double c)
{
    int read;
    scene *s = rod_on_pin(route, 0, PM_MEASURE_TURNED, &read);
    const int program =
        SCENE_PROGRAM(s, U, K(c), scene_op(PM_OP_LT), U, K(1), scene_op(PM_OP_ADD), scene_op(PM_OP_MUL));
    const int out = scene_ask_extreme(s, PM_ASK_MAX, program, PM_NONE);
    NEAR(answer(s, out), 1 + c, 1e-13);
}

/* min(1 - x^2, 1 - 10 (x + d)), x = u - a, is greatest where one takes over from the other, before the first would be. */
static void a_peak_that_is_cut_off(int route, double a, double d)
{
    int read;
    scene *s = rod_on_pin(route, 0, PM_MEASURE_TURNED, &read);
    const int program = SCENE_PROGRAM(s, K(1), U, K(a), SUB, U, K(a), SUB, scene_op(PM_OP_MUL), SUB, K(1), U,
                                      K(a - d), SUB, K(10), scene_op(PM_OP_MUL), SUB, scene_op(PM_OP_MIN));
    const int out = scene_ask_extreme(s, PM_ASK_MAX, program, PM_NONE);
    const double x = 5 - sqrt(25 + 10 * d);
    NEAR(answer(s, out), 1 - x * x, 1e-10);
}

/* n u - floor(n u) comes to 1 before each step, and is 1/2 as often as it rises. */
static void stairs(int route, int n)
{
    int read;
    scene *s = rod_on_pin(route, 0, PM_MEASURE_TURNED, &read);
    const int program = SCENE_PROGRAM(s, U, K(n), scene_op(PM_OP_MUL), U, K(n), scene_op(PM_OP_MUL),
                                      scene_op(PM_OP_FLOOR), SUB, K(0.5), SUB);
    const int event = scene_when(s, PM_TRIGGER_RISE, program);
    const int out = scene_ask_count(s, event);
    EQUAL((int)answer(s, out), 3 * n);
}

int main(void)
{
    for (size_t r = 0; r < sizeof routes / sizeof *routes; r++)
        for (int i = 0; i < CASES; i++) {
            a_valley_of_two(routes[r], check_random(0.2, 2.8), pow(10, check_random(-5, -1)));
            a_peak_of_speed(routes[r], check_random(2.3, 5), pow(10, check_random(-5, -1)));
            a_jump(routes[r], check_random(0.2, 2.8));
            a_peak_that_is_cut_off(routes[r], check_random(0.3, 2.8), pow(10, check_random(-3, -1)));
            if (i % 10 == 0) stairs(routes[r], 5 + i);
        }
    return check_failures();
}
