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
    scene_set(s, PM_SETTING_MAX_TIME, 2 * end);
    EQUAL(scene_run(s, NULL), PM_OK);
    if (route == PM_ROUTE_AUTO) CHECK(s->count[PM_COUNT_STEPS] < 12);
    const double wrong = fabs(s->out[angle] + 1.5707963267948966);
    CHECK(wrong < 1e-14 * end * omega);
    CHECK(wrong <= s->error[angle]);
    scene_free(s);
}

/* Pi / 2 K(sin a) is the arithmetic-geometric mean of 1 and cos a. */
static double elliptic(double a)
{
    double x = 1, y = cos(a);
    for (int i = 0; i < 40; i++) {
        const double mean = 0.5 * (x + y);
        y = sqrt(x * y);
        x = mean;
    }
    return 1.5707963267948966 / x;
}

/* A rod let go at `from` off its hanging passes that after an odd number of quarters, slow where it turns back near the top. */
static void keeps_phase_from(double from, int periods)
{
    const double length = 1.2, turned = from - 1.5707963267948966,
                 end = (4. * periods + 1) * sqrt(2 * length / (3 * G)) * elliptic(0.5 * from);
    scene *s = estimating(PM_ROUTE_AUTO);
    const int rod = scene_body(s, 3, 3 * length * length / 12, 0.5 * length * cos(turned),
                               0.5 * length * sin(turned), turned);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -length / 2, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, rod));
    scene_until_time(s, end);
    scene_set(s, PM_SETTING_MAX_TIME, 2 * end);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double wrong = fabs(s->out[angle] + 1.5707963267948966);
    CHECK(wrong <= s->error[angle]);
    CHECK(s->count[PM_COUNT_STEPS] < 200);
    scene_free(s);
}

/* What swings pass is counted, their ways and extremes are those of all: it hangs for the nth time after 2 n - 1 quarters. */
static void counts_swings(int route, int nth, int periods)
{
    scene *s = estimating(route);
    const int rod = rod_of(s, 1.2), angle = scene_measure(s, PM_MEASURE_ANGLE, rod), time = scene_time(s),
              g = scene_point(s, rod, 0, 0);
    const int hangs = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, angle, -1.5707963267948966));
    const int count = scene_ask_count(s, hangs), at = scene_ask_event(s, scene_read(s, time), hangs, nth, 0),
              way = scene_ask_measure(s, scene_measure(s, PM_MEASURE_PATH, g)),
              pull = scene_ask_extreme(s, PM_ASK_MAX,
                                       scene_read(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_NORM)),
                                       PM_NONE),
              left = scene_ask_extreme(s, PM_ASK_AT_MIN, scene_read(s, angle), scene_read(s, angle));
    scene_until_time(s, (4. * periods + 0.5) * quarter(1.2));
    scene_set(s, PM_SETTING_MAX_TIME, 1e6);
    *scene_setting(s, PM_SETTING_MAX_EVENTS) = INT32_MAX;
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[count], 2 * periods);
    const int reached = nth <= 2 * periods;
    EQUAL(s->reason[1], reached ? PM_REASON_NONE : PM_REASON_NOT_REACHED);
    if (reached) NEAR(s->out[at], (2. * nth - 1) * quarter(1.2), s->error[at] + 1e-15 * s->out[at]);
    if (reached) CHECK(s->error[at] < 1e-11 * s->out[at] + 1e-14 * 4 * periods * quarter(1.2));
    CHECK(s->out[way] > 2 * periods * 0.6 * 3.141592653589793);
    CHECK(s->out[way] < (2 * periods + 0.5) * 0.6 * 3.141592653589793);
    NEAR(s->out[pull], 2.5 * 3 * G, 1e-9); /* m g + m w^2 L/2, w^2 = 3 g / L */
    NEAR(s->out[left], -3.141592653589793, 1e-9);
    scene_free(s);
}

/* Swings whose count is watched are computed one by one: what rounding leaves out of each does not add up. */
static void adds_swings(double length, int periods)
{
    scene *s = estimating(PM_ROUTE_AUTO);
    const int angle = scene_measure(s, PM_MEASURE_ANGLE, rod_of(s, length)),
              hangs = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, angle, -1.5707963267948966)),
              count = scene_measure(s, PM_MEASURE_EVENT_COUNT, hangs);
    const int most = scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, count), PM_NONE),
              end = scene_ask_measure(s, scene_time(s));
    const double exact = (4. * periods - 1) * quarter(length);
    scene_until(s, hangs, 2 * periods);
    scene_set(s, PM_SETTING_MAX_TIME, 2 * exact);
    *scene_setting(s, PM_SETTING_MAX_EVENTS) = INT32_MAX;
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(s->count[PM_COUNT_STEPS] > 2 * periods);
    EQUAL(s->out[most], 2 * periods);
    NEAR(s->out[end], exact, 1e-14 * exact);
    scene_free(s);
}

/* A rod that falls against a wall and loses a part in 1e15 of its speed there comes back to rest in the same place, to what
 * can be told of one blow, not of ten thousand. */
static void blows_are_no_swings(void)
{
    const double e = 1 - 1e-15, blows = 10000;
    scene *s = estimating(PM_ROUTE_AUTO);
    const int rod = rod_of(s, 1.2), tip = scene_circle(s, scene_point(s, rod, 0.6, 0), 0.1),
              wall = scene_line(s, scene_point(s, PM_GROUND, -0.1, 0), -1.5707963267948966);
    const int contact = scene_contact(s, PM_CONTACT_LINE, tip, wall, 1, e, PM_FRICTION_SMOOTH, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, contact), (int)blows);
    const int kinetic = scene_ask_measure(s, scene_measure(s, PM_MEASURE_KINETIC, rod));
    scene_set(s, PM_SETTING_MAX_TIME, 1e6);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->count[PM_COUNT_ROUTE], PM_ROUTE_PATH);
    NEAR(s->out[kinetic], 3 * G * 0.6 * pow(e, 2 * blows), s->error[kinetic]);
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
    keeps_phase(PM_ROUTE_AUTO, 1000000);
    for (int nth = 1; nth < 100000; nth *= 9) {
        counts_swings(PM_ROUTE_AUTO, nth, 20000);
        counts_swings(PM_ROUTE_AUTO, nth, nth);
    }
    counts_swings(PM_ROUTE_RK, 81, 100);
    for (int i = 1; i < 12; i++) {
        keeps_phase_from(0.28 * i, 300);
        keeps_phase_from(0.28 * i, 1000000);
    }
    for (int i = 0; i < 8; i++) adds_swings(check_random(0.1, 10), 3000);
    blows_are_no_swings();
    keeps_phase(PM_ROUTE_RK, 300);
    for (int i = 1; i <= 4; i++) {
        ends_near_rest(pow(10, -i));
        ends_near_rest(-pow(10, -i));
    }
    loses_nothing(PM_ROUTE_AUTO);
    loses_nothing(PM_ROUTE_RK);
    return check_failures();
}
