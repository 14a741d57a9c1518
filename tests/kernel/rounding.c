/* What is lost in last digits, and adds up: elastic blows, bars that leave little of the energy; circles that graze each other. */
#include <math.h>

#include "check.h"
#include "scene.h"

#define G 9.81

static scene *begun(int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    *scene_setting(s, PM_SETTING_MAX_EVENTS) = 100000;
    return s;
}

/* A ball on a floor, each blow at no height at all, however late; nothing changes its drift. */
static void elastic_blows(double height, double drift)
{
    const int blows = 200;
    scene *s = begun(PM_ROUTE_RK);
    const int ball = scene_body(s, 1, 0, 0, height, 0), point = scene_point(s, ball, 0, 0);
    const int floor = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, point, 0), scene_floor(s, 0), 1, 1,
                                    PM_FRICTION_SMOOTH, 0);
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, floor);
    const int y = scene_part(s, PM_MEASURE_POSITION, point, PM_PART_Y);
    const int at_150 = scene_ask_event(s, scene_read(s, y), strike, 150, 0);
    const int at_end = scene_ask_measure(s, y);
    const int vx = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, point, PM_PART_X));
    const int vy = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, point, PM_PART_Y));
    scene_start_velocity(s, point, drift, 0);
    scene_set(s, PM_SETTING_MAX_TIME, 1e4);
    scene_until(s, strike, blows);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[at_150], 0, 1e-15 * height);
    NEAR(s->out[at_end], 0, 1e-15 * height);
    NEAR(s->out[vx], drift, 1e-15);
    NEAR(s->out[vy], sqrt(2 * G * height), 1e-12);
    scene_free(s);
}

/* Two disks, the way of one, with `part` of the sum of their radii, passing the other at `beside` of that. */
static void grazes(double beside, double away, double part)
{
    const double both = 0.2;
    scene *s = begun(PM_ROUTE_RK);
    int circle[2];
    for (int i = 0; i < 2; i++) {
        const int body = scene_body(s, 1, 0.005, i ? 0 : -away * both, i ? 0 : beside * both, 0);
        circle[i] = scene_circle(s, scene_point(s, body, 0, 0), (i ? 1 - part : part) * both);
        if (i == 0) scene_start_velocity(s, scene_point(s, body, 0, 0), 1.5, 0);
    }
    const int contact =
        scene_contact(s, PM_CONTACT_CIRCLE, circle[0], circle[1], 1, 1, PM_FRICTION_SMOOTH, 0);
    const int count = scene_ask_measure(
        s, scene_measure(s, PM_MEASURE_EVENT_COUNT, scene_on(s, PM_TRIGGER_STRIKE, contact)));
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    scene_until_time(s, 2.13 * away * both / 1.5); /* no node is where they are closest */
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[count], beside < 1);
    scene_free(s);
}

/* A sphere that rolls over bars: of T_n+1 = (T_n + W) m - W little is left at the last ones. */
static void over_bars(double r, double d, double start)
{
    const long double half = asinl(0.5L * d / r), drop = 10 * (long double)G * (1 - cosl(half)) / (7 * r),
                      kept = (0.4L + cosl(2 * half)) / 1.4L;
    long double square = (long double)start * start;
    int bars = 0;
    for (;; bars++) {
        const long double next = (square + drop) * kept * kept - drop;
        if (next < 0) break;
        square = next;
    }
    scene *s = begun(PM_ROUTE_AUTO);
    *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
    const int body = scene_body(s, 1, 0.4 * r * r, 0, r, 0), middle = scene_point(s, body, 0, 0);
    const int row = SCENE_ROW(s, PM_TABLE_PATTERN, scene_point(s, PM_GROUND, 0, 0), scene_value(s, d),
                              scene_value(s, 0), scene_value(s, -1));
    scene_contact(s, PM_CONTACT_PATTERN, scene_circle(s, middle, r), row, 0, 0, PM_FRICTION_ROUGH, 0);
    const int x = scene_part(s, PM_MEASURE_POSITION, middle, PM_PART_X);
    const int over = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, x, bars * d));
    const int omega = scene_ask_event(s, scene_read(s, scene_measure(s, PM_MEASURE_OMEGA, body)), over, 1, 0);
    scene_start_omega(s, body, -start);
    scene_until(s, over, 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double wrong = fabs(s->out[omega] + (double)sqrtl(square));
    CHECK(wrong <= s->error[omega]);
    CHECK(s->error[omega] < 1e-6 * fabs(s->out[omega]));
    scene_free(s);
}

int main(void)
{
    elastic_blows(3.4469878364599547, -0.15);
    elastic_blows(1.4925838938619010, 1.7);
    for (int k = 0; k < 200; k++) {
        const double by = pow(10, -1.5 - 0.0125 * k), away = 2.2 + 0.37 * (k % 13);
        grazes(1 - by, away, 0.5);
        grazes(1 + by, away, 0.5);
    }
    for (int k = 0; k < 100; k++) {
        const double by = pow(10, check_random(-6, -2)), away = pow(10, check_random(0.2, 2));
        grazes(k % 2 ? 1 - by : 1 + by, away, check_random(0.01, 0.99));
    }
    over_bars(0.254, 0.0254, 1.5);
    over_bars(0.31, 0.02, 1.1);
    return check_failures();
}
