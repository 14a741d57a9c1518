/* Errors that are told cover the true ones: ends of edges, places where a motion turns back, beads on curves, times of extremes. */
#include <math.h>

#include "check.h"
#include "estimating.h"
#include "scene.h"

/* What is told covers what is wrong, but for the last digits of the answer itself. */
static void covers(const scene *s, int out, long double truth)
{
    const double wrong = (double)fabsl(s->out[out] - truth);
    CHECK(wrong <= fmax(s->error[out], 4.5e-16 * fabs((double)truth)));
}

/* A mass slides over the end of an edge that is far longer than its way, and falls off: it does not come to it again. */
static void leaves_an_edge(int route)
{
    const double way = check_logarithmic(0.1, 5), length = way * check_logarithmic(1, 30),
                 speed = check_logarithmic(0.1, 10);
    scene *s = estimating(1e-10);
    const int b = scene_body(s, 1, 0, -way, 0, 0), p = scene_point(s, b, 0, 0);
    const int contact =
        scene_segment(s, scene_circle(s, p, 0), scene_floor(s, 0), -length, 0, 0, PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, p, speed, 0);
    const int off = scene_on(s, PM_TRIGGER_OPEN, contact);
    const int t = scene_ask_event(s, scene_read(s, scene_time(s)), off, 1, 0);
    const int y = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_Y);
    scene_until(s, scene_when(s, PM_TRIGGER_FALL, scene_minus(s, y, -1)), 1);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    covers(s, t, (long double)way / speed);
    NEAR(s->out[t], way / speed, 1e-14 * (way + length) / speed);
    CHECK(s->trust[PM_TRUST_MARGIN] > 1e6);
    scene_free(s);
}

/* y = x^2 / 4 f, as far as 7 f. */
static int parabola(scene *s, double focus)
{
    const scene_code place = scene_m(scene_measure(s, PM_MEASURE_PLACE, PM_NONE));
    const int x = SCENE_PROGRAM(s, place), y = SCENE_PROGRAM(s, place, place, scene_op(PM_OP_MUL),
                                                             scene_k(s, 4 * focus), scene_op(PM_OP_DIV));
    return SCENE_ROW(s, PM_TABLE_CURVE, scene_point(s, PM_GROUND, 0, 0), x, y, scene_value(s, -7 * focus),
                     scene_value(s, 7 * focus), 0, 1, PM_NONE);
}

/* From rest to the bottom, some times; the curve is far larger than the way.  Nobody asks for the time. */
static void bead(void)
{
    const double focus = check_logarithmic(0.05, 5), x = focus * check_logarithmic(0.01, 6);
    const int n = 1 + (int)check_random(0, 8);
    scene *s = estimating(1e-10);
    const int b = scene_body(s, 1, 0, x, x * x / (4 * focus), 0), p = scene_point(s, b, 0, 0);
    scene_joint(s, PM_JOINT_SLOT, p, parabola(s, focus), 0);
    const int at = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_X);
    scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_read(s, at)), n);
    const int v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_X));
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    *scene_setting(s, PM_SETTING_MAX_TIME) = PM_NONE;
    EQUAL(scene_run(s, NULL), PM_OK);
    const long double speed = x * sqrtl((long double)G / (2 * (long double)focus));
    covers(s, v, n % 2 ? -speed : speed);
    /* what is left of its energy is of its last digits and the curve's */
    NEAR(fabs(s->out[v]) * (double)speed, (double)(speed * speed),
         n * 5e-13 * (focus + (double)(speed * speed)));
    scene_free(s);
}

/* A rod swings up to next to its top: the nearer, the less its energy tells of the place. */
static void turns_back(void)
{
    const double short_of = check_logarithmic(1e-9, 0.3);
    const long double most = sqrtl(6 * (long double)G);
    const double omega = (double)(most * (1 - short_of));
    scene *s = estimating(1e-10);
    const int b = scene_body(s, 1, 1. / 12, 0, -0.5, -0.5 * acos(-1.));
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_start_omega(s, b, omega);
    const int turned = scene_measure(s, PM_MEASURE_TURNED, b);
    scene_until(s, scene_when(s, PM_TRIGGER_FALL, scene_read(s, turned)), 1);
    const int top = scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, turned), PM_NONE);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    EQUAL(scene_run(s, NULL), PM_OK);
    covers(s, top, 2 * asinl(omega / most));
    CHECK(s->error[top] <= 1e-13 / sqrt(short_of));
    scene_free(s);
}

/* The time of the top of a throw with linear drag, on other steps than those that end there: its rate is known, and no difference
 * of heights. */
static void time_of_top(void)
{
    const double k = check_logarithmic(0.01, 10), up = check_logarithmic(1, 100);
    scene *s = estimating(1e-12);
    const int b = scene_body(s, 1, 0, 0, 0, 0), p = scene_point(s, b, 0, 0);
    const scene_code vy = scene_m(scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_Y));
    scene_applied(s, p, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, 0)),
                  SCENE_PROGRAM(s, vy, scene_k(s, -k), scene_op(PM_OP_MUL)));
    scene_start_velocity(s, p, 1, up);
    const double top = log1p(k * up / G) / k;
    const int y = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_Y);
    const int when = scene_ask_extreme(s, PM_ASK_AT_MAX, scene_read(s, scene_time(s)), scene_read(s, y));
    scene_until_time(s, check_random(1.2, 2) * top);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_RK;
    EQUAL(scene_run(s, NULL), PM_OK);
    covers(s, when, log1pl((long double)k * up / G) / k);
    NEAR(s->out[when], top, 3e-14 * top);
    scene_free(s);
}

int main(void)
{
    static const int route[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int i = 0; i < 90; i++) leaves_an_edge(route[i % 3]);
    for (int i = 0; i < 60; i++) bead();
    for (int i = 0; i < 60; i++) turns_back();
    for (int i = 0; i < 60; i++) time_of_top();
    return check_failures();
}
