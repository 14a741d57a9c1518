/* percentile.c - values below which an expression is for a part of the time, beside closed forms: of what swings, of what falls
 * and jumps at a blow, of what stays, and where a condition holds; the estimate covers what they err by. */
#include "check.h"
#include "scene.h"

#define PI 3.14159265358979323846
#define CASES 20
#define COVERED 1e-13 /* rounding of the closed form */

static int ask(scene *s, int program, double part, int condition)
{
    return scene_ask(s, PM_ASK_PERCENTILE, program, PM_NONE, 1, 0, condition, scene_value(s, part), 1);
}

static scene *on_route(int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    return s;
}

static void is(const scene *s, int out, double true, double size)
{
    NEAR(s->out[out], true, 1e-9 * size);
    CHECK(fabs(s->out[out] - true) <= s->error[out] + COVERED * size);
}

/* x = a cos w t over a period: below -a cos(pi p) for the part p. */
static void what_swings(int route)
{
    scene *s = on_route(route);
    const double a = check_random(0.1, 1), k = check_random(1, 100), m = check_random(0.5, 3),
                 w = sqrt(k / m), p = check_random(0.05, 0.95);
    const int b = scene_body(s, m, 0, a, 0, 0), g = scene_point(s, b, 0, 0),
              o = scene_point(s, PM_GROUND, 0, 0);
    scene_joint(s, PM_JOINT_SLIDER, g, scene_line(s, o, 0), 0);
    scene_force(s, PM_FORCE_SPRING, g, o, k, 0);
    const int x = scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X);
    const int all = ask(s, scene_read(s, x), p, PM_NONE);
    const int low = ask(s, scene_read(s, x), 0.004, PM_NONE); /* next to where it turns */
    const int half = ask(s, scene_read(s, x), 0.5, PM_NONE);
    const int size = ask(s, SCENE_PROGRAM(s, scene_m(x), scene_op(PM_OP_ABS)), p, PM_NONE);
    const int right = SCENE_PROGRAM(s, scene_m(x), scene_k(s, 0), scene_op(PM_OP_GT));
    const int there = SCENE_PROGRAM(s, scene_m(x), scene_k(s, 0), scene_op(PM_OP_GT), scene_m(x),
                                    scene_k(s, 0), scene_op(PM_OP_SELECT));
    const int part = ask(s, there, p, right);
    scene_until_time(s, 2 * PI / w);
    EQUAL(scene_run(s, NULL), PM_OK);
    is(s, all, -a * cos(PI * p), a);
    is(s, low, -a * cos(PI * 0.004), a);
    is(s, half, 0, a);
    is(s, size, a * sin(PI * p / 2), a);
    is(s, part, a * sin(PI * p / 2), a);
    scene_free(s);
}

/* v t up to a wall, and back e times as fast: speeds are v, then e v; places below x for x/v, and what of the way back. */
static void what_jumps(void)
{
    scene *s = on_route(PM_ROUTE_AUTO);
    const double v = check_random(1, 3), e = check_random(0.3, 0.9), p = check_random(0.1, 0.9);
    const int b = scene_body(s, 2, 0, 0, 0, 0), g = scene_point(s, b, 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, 0),
                  scene_line(s, scene_point(s, PM_GROUND, 1, 0), PI / 2), 0, e, PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, g, v, 0);
    const int speed = ask(s, scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X)), p, PM_NONE);
    const int x = ask(s, scene_read(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X)), p, PM_NONE);
    const double there = 1 / v, back = 1 / (e * v);
    scene_until_time(s, there + back); /* it is where it began */
    EQUAL(scene_run(s, NULL), PM_OK);
    is(s, speed, p * (there + back) < back ? -e * v : v, v);
    is(s, x, p, 1);
    scene_free(s);
}

int main(void)
{
    for (int i = 0; i < CASES; i++) {
        what_swings(PM_ROUTE_AUTO);
        what_swings(PM_ROUTE_RK);
        what_jumps();
    }
    return check_failures();
}
