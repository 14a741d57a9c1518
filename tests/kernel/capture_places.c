/* Where a capture is met: points that meet and points that pass, others that meet beside, one that comes round. */
#include "check.h"
#include "elements/constraint.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#ifndef THROWS
#define THROWS 600
#endif

static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};

/* ---- meeting and passing ---- */
/* A ball thrown up past a post's tip that it misses by `miss` on the way down; a steep one goes by on its way up, too, which
 * may be in the same step. */
static void passes(double miss, int steep, int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int b = scene_body(s, 1, 0, 0, 0, 0), centre = scene_point(s, b, 0, 0);
    const double g = 9.81, vx = steep ? 0.2 : 2, vy = steep ? 20 : 5, t = steep ? 2.4 : 0.8,
                 end = steep ? 3 : 1;
    const int tip = scene_point(s, PM_GROUND, vx * t + miss, vy * t - 0.5 * g * t * t);
    const int hit = scene_capture(s, PM_CONTACT_POINT, scene_circle(s, centre, 0), scene_circle(s, tip, 0), 0,
                                  PM_CAPTURE_POINT);
    scene_start_velocity(s, centre, vx, vy);
    scene_until_time(s, end);
    const int closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, hit));
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, centre, PM_PART_X));
    const int weight = scene_ask_measure(s, scene_part(s, PM_MEASURE_CONTACT_FORCE, hit, PM_PART_Y));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double close = route == PM_ROUTE_IDA ? 1e-6 : 1e-9;
    EQUAL(s->out[closed], miss == 0);
    NEAR(s->out[x], miss == 0 ? vx * t : vx * end, close);
    NEAR(s->out[weight], miss == 0 ? g : 0, close);
    if (miss != 0 && route != PM_ROUTE_IDA) EQUAL(s->count[PM_COUNT_PHASES], 1); /* nothing has happened */
    scene_free(s);
}

/* Thrown all but straight up, past a post's tip on its way up, a ball meets it on its way down, t later; the accuracy lets long
 * steps hold both. */
static void meets_on_its_way_down(double vx, double vy, double t, double accuracy, int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    scene_set(s, PM_SETTING_ACCURACY, accuracy);
    const double g = 9.81;
    const int centre = scene_point(s, scene_body(s, 1, 0, 0, 0, 0), 0, 0);
    const int tip = scene_point(s, PM_GROUND, vx * t, vy * t - 0.5 * g * t * t);
    const int hit = scene_capture(s, PM_CONTACT_POINT, scene_circle(s, centre, 0), scene_circle(s, tip, 0), 0,
                                  PM_CAPTURE_POINT);
    scene_start_velocity(s, centre, vx, vy);
    scene_until_time(s, 2.2 * vy / g);
    const int closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, hit));
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[closed], 1);
    scene_free(s);
}

/* What goes by a post has not met it when something else happens beside it: a ball that strikes a wall, or one that meets a
 * post of its own. */
static void others_meet_beside(double miss, int meets, int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int post = scene_circle(s, scene_point(s, PM_GROUND, 0, 0), 0),
              away = scene_point(s, PM_GROUND, 0, 9);
    int hit[2], x[2];
    for (int i = 0; i < 2; i++) {
        const int ball = scene_body(s, 1, 0, -2, i ? 9 : miss, 0), centre = scene_point(s, ball, 0, 0);
        const int rim = scene_circle(s, centre, 0);
        if (i == 0 || meets)
            hit[i] = scene_capture(s, PM_CONTACT_POINT, rim, i ? scene_circle(s, away, 0) : post, 0,
                                   PM_CAPTURE_POINT);
        else
            hit[i] = scene_contact(s, PM_CONTACT_LINE, rim, scene_line(s, away, acos(0.)), 0, 0.5,
                                   PM_FRICTION_SMOOTH, 0);
        scene_start_velocity(s, centre, 2, 0);
        x[i] = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, centre, PM_PART_X));
    }
    scene_until_time(s, 2);
    const int closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, hit[0]));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double close = route == PM_ROUTE_IDA ? 1e-6 : 1e-9;
    EQUAL(s->out[closed], 0);
    NEAR(s->out[x[0]], 2, close);
    NEAR(s->out[x[1]], meets ? 0 : -1, close);
    scene_free(s);
}

/* A bead on a rotating arm comes back to a post every turn, a hair's breadth off or not. */
static void comes_round(double miss, int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int arm = scene_body(s, 1, 0.2, 0, 0, 0), end = scene_point(s, arm, 0.8, 0);
    for (int i = 0; i < 2; i++) /* a pin of two sliders: no bound of reach tells that a miss is one */
        scene_joint(s, PM_JOINT_SLIDER, scene_point(s, arm, 0, 0), scene_floor(s, i * acos(0.)), 0);
    const int post = scene_point(s, PM_GROUND, 0, -0.8 - miss);
    const int hit = scene_capture(s, PM_CONTACT_POINT, scene_circle(s, end, 0), scene_circle(s, post, 0), 0,
                                  PM_CAPTURE_POINT);
    /* its distance from the pin stays: that is no meeting, whatever the rounding of its rate says */
    scene_capture(s, PM_CONTACT_POINT, scene_circle(s, end, 0),
                  scene_circle(s, scene_point(s, PM_GROUND, 0, 0), 0), 0, PM_CAPTURE_BODY);
    scene_start_omega(s, arm, 3);
    scene_until_time(s, 8);
    const int turned = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, arm));
    const int closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, hit));
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[closed], miss == 0);
    if (route == PM_ROUTE_AUTO) CHECK(s->count[PM_COUNT_ROUTES] >> PM_ROUTE_PATH & 1);
    NEAR(s->out[turned], miss == 0 ? 3 * acos(0.) : 24, route == PM_ROUTE_IDA ? 1e-5 : 1e-9);
    scene_free(s);
}

int main(void)
{
    for (int k = 0; k < THROWS; k++) {
        const double vy = pow(10, check_random(0, 2)), top = vy / 9.81,
                     t = top * (1 + pow(10, check_random(-2.5, 0)));
        const double near =
            pow(10, check_random(-7, -4)) * vy * top / (2 * (t - top)); /* where it goes by, hardly */
        const double vx = k % 2 ? near : pow(10, check_random(-3, 1));
        meets_on_its_way_down(vx, vy, t, pow(10, check_random(-11, -4)), routes[k / 2 % 3]);
    }
    for (int i = 0; i < 3; i++) {
        for (int steep = 0; steep < 2; steep++)
            for (int k = 0; k < 3; k++)
                passes((k == 0 ? 0 : k == 1 ? 1e-3 : -1e-4) * (steep ? 10 : 1), steep, routes[i]);
        for (int k = 0; k < 4; k++) others_meet_beside(k < 2 ? 1e-3 : -0.05, k % 2, routes[i]);
        comes_round(0, routes[i]); /* along the path, if it may */
        comes_round(1e-4, routes[i]);
        comes_round(-1e-4, routes[i]);
    }
    return check_failures();
}
