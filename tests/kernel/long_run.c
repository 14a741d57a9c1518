/* Long runs and answers that cancel: clocks, roundings, terms. */
#include <math.h>

#include "check.h"
#include "scene.h"

#define G 9.81

/* A rod on a pin, let go from the level: four quarters of its period sqrt(2 L / 3 g) K(1/2) each. */
static double quarter(double length) { return 1.8540746773013719 * sqrt(2 * length / (3 * G)); }

static int rod_of(scene *s, double length)
{
    const int rod = scene_body(s, 3, 3 * length * length / 12, 0.5 * length, 0, 0);
    const int end = scene_point(s, rod, -length / 2, 0);
    scene_joint(s, PM_JOINT_PIN, end, scene_point(s, PM_GROUND, 0, 0), 0);
    return rod;
}

static scene *estimating(int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    return s;
}

/* After so many periods and a quarter it hangs, to a rounding of the time and what is told. */
static void keeps_phase(int route, int periods)
{
    scene *s = estimating(route);
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, rod_of(s, 1.2)));
    const double end = (4. * periods + 1) * quarter(1.2), omega = sqrt(3 * G / 1.2);
    scene_until_time(s, end);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double wrong = fabs(s->out[angle] + 1.5707963267948966);
    CHECK(wrong < 1e-14 * end * omega);
    CHECK(wrong <= s->error[angle]);
    scene_free(s);
}

/* At a time close to a place of rest it is there where it is at that time. */
static void ends_near_rest(double before)
{
    scene *s = estimating(PM_ROUTE_AUTO);
    const int rod = rod_of(s, 1.2), angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, rod)),
              time = scene_ask_measure(s, scene_time(s));
    const double end = 4 * quarter(1.2) - before;
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, scene_time(s), end)), 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[time], end, 1e-10 * end);
    NEAR(s->out[angle], -0.5 * 1.5 * G / 1.2 * before * before, 1e-3 * before * before + 1e-13);
    scene_free(s);
}

/* An elastic blow loses nothing: to a rounding of the energies that it moves, and no more passes are made. */
static void loses_nothing(int route)
{
    scene *s = estimating(route);
    const int ball = scene_body(s, 1, 0.4 * 0.01, 0, 1.37, 0);
    const int floor = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, ball, 0, 0), 0.1),
                                    scene_floor(s, 0), 1, 1, PM_FRICTION_SMOOTH, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, floor), 3);
    const int lost = scene_ask_measure(s, scene_measure(s, PM_MEASURE_LOST, PM_NONE));
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(fabs(s->out[lost]) <= s->error[lost]);
    CHECK(s->error[lost] > 1e-15 && s->error[lost] < 1e-12);
    EQUAL(s->count[PM_COUNT_PASSES], 2);
    scene_free(s);
}

int main(void)
{
    keeps_phase(PM_ROUTE_AUTO, 100);
    keeps_phase(PM_ROUTE_AUTO, 400);
    keeps_phase(PM_ROUTE_RK, 300);
    for (int i = 1; i <= 4; i++) {
        ends_near_rest(pow(10, -i));
        ends_near_rest(-pow(10, -i));
    }
    loses_nothing(PM_ROUTE_AUTO);
    loses_nothing(PM_ROUTE_RK);
    return check_failures();
}
