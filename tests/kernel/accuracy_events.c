/* Estimated errors of what is counted, and of blows: beside true ones, where a series of bounces is cut off or a blow comes late. */
#include "check.h"
#include "estimating.h"
#include "scene.h"
#include "state/workspace.h"
#include "study/accuracy.h"

/* A rod on its pin goes from its lowest to its highest place; alpha = -3/2 g cos(angle) is least half-way.  How often it
 * passes a threshold `above` that least value, 2 or 0 times, is only counted: no coarse run is made, and the margin falls as
 * the threshold comes near. */
static scene *counting(double above)
{
    scene *s = estimating(1e-10);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    const double quarter = 0.5 * 3.14159265358979323846;
    const int rod = scene_body(s, 3, 0.25, 0, -0.5, -quarter);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_start_omega(s, rod, 9);
    const int there = scene_measure(s, PM_MEASURE_ANGLE, rod), rate = scene_measure(s, PM_MEASURE_ALPHA, rod);
    scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, there, quarter)), 1);
    const int low = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, rate, -1.5 * G * (1 - above)));
    scene_ask_count(s, low);
    return s;
}

static void counted_events(void)
{
    for (int i = 1; i < 12; i++)
        for (int side = -1; side <= 1; side += 2) {
            scene *s = counting(side * pow(10, -i));
            EQUAL(scene_run(s, NULL), PM_OK);
            EQUAL(s->out[0], side > 0 ? 2 : 0);
            EQUAL(s->count[PM_COUNT_PASSES], 1);
            EQUAL(s->margin[0], s->trust[PM_TRUST_MARGIN]);
            CHECK(s->margin[0] > 1);
            CHECK(s->margin[0] < pow(10, 16 - i)); /* some roundings over how close it is */
            scene_free(s);
        }
    int undecided = 0;
    for (int i = -3; i <= 3; i++) {
        scene *s = counting(i * 1e-16);
        undecided += scene_run(s, NULL) == PM_UNDECIDED && s->margin[0] < 1;
        scene_free(s);
    }
    EQUAL(undecided, 7);
}

/* The same, but the rod stops before that: alpha only falls, and how near it comes to the threshold is told by its value
 * where the run ends. */
static scene *counting_to_the_end(double beyond)
{
    scene *s = estimating(1e-10);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    const double quarter = 0.5 * 3.14159265358979323846, end = -0.5;
    const int rod = scene_body(s, 3, 0.25, 0, -0.5, -quarter);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_start_omega(s, rod, 9);
    const int there = scene_measure(s, PM_MEASURE_ANGLE, rod), rate = scene_measure(s, PM_MEASURE_ALPHA, rod);
    scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, there, end)), 1);
    const int low = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, rate, -1.5 * G * cos(end) * (1 + beyond)));
    scene_ask_count(s, low);
    return s;
}

static void counted_to_the_end(void)
{
    for (int i = 2; i < 11; i++)
        for (int side = -1; side <= 1; side += 2) {
            scene *s = counting_to_the_end(side * pow(10, -i));
            EQUAL(scene_run(s, NULL), PM_OK);
            EQUAL(s->out[0], side < 0);
            EQUAL(s->count[PM_COUNT_PASSES], 1);
            CHECK(s->margin[0] > 1);
            CHECK(s->margin[0] < pow(10, 16 - i));
            scene_free(s);
        }
}

/* A ball, or with two feet a crate, let fall from 1 m on a floor. */
static void let_fall(scene *s, double e, int feet)
{
    const int body = scene_body(s, 0.1, 4e-5, 0, 1.03, 0);
    for (int i = 0; i < feet; i++) {
        const int foot = scene_point(s, body, feet == 1 ? 0 : i - 0.5, 0);
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, foot, 0.03), scene_floor(s, 0), 1, e,
                      PM_FRICTION_SMOOTH, 0);
    }
}

static scene *resting(int route, double e, double accuracy, int feet)
{
    scene *s = estimating(accuracy);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    let_fall(s, e, feet);
    scene_until(s, scene_on(s, PM_TRIGGER_REST, PM_NONE), 1);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, scene_on(s, PM_TRIGGER_STRIKE, 0)));
    EQUAL(scene_run(s, NULL), PM_OK);
    return s;
}

/* It rests at sqrt(2 h / g) (1 + e) / (1 - e), after blows without number.  Those that are too small to be followed take
 * their time all the same. */
static void series_cut_off(int route, double e, double accuracy, int feet)
{
    scene *s = resting(route, e, accuracy, feet);
    const double wrong = fabs(s->out[0] - sqrt(2 / G) * (1 + e) / (1 - e));
    CHECK(wrong < (route == PM_ROUTE_RK ? 1e-11 : 2 * s->error[0]) && wrong < 10 * s->error[0]);
    CHECK(isinf(s->out[1]));
    CHECK(s->trust[PM_TRUST_MARGIN] > 100);
    scene_free(s);
}

/* With constant accelerations the rest of the series is taken at once, in the coarse run after fewer of its blows: that is no other
 * outcome, and shows all the same what rounding does to the time. */
static void taken_at_once(double e)
{
    scene *s = resting(PM_ROUTE_UNIFORM, e, 1e-8, 1);
    EQUAL(scene_open(s), PM_OK);
    EQUAL(pm_accuracy_run(s->w, NULL, NULL, s->error, s->margin, s->trust), PM_OK);
    const pm_accuracy *a = s->w->accuracy;
    const double truth = sqrt(2 / G) * (1 + e) / (1 - e), wrong = fabs(s->out[0] - truth);
    CHECK(2 * a->other->count[PM_COUNT_PHASES] < a->main->count[PM_COUNT_PHASES]);
    CHECK(pm_margin_same_jumps(a));
    CHECK(wrong <= s->error[0] && s->error[0] < 1e-12 * truth);
    CHECK(isinf(s->out[1]));
    CHECK(s->trust[PM_TRUST_MARGIN] > 100);
    scene_free(s);
}

/* Blow n, by when nothing is left of its speed that is one: where the series is cut its last blows count all the same, and the error
 * of the time tells them. */
static void blow_too_late(double e, int n)
{
    scene *s = estimating(1e-10);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_UNIFORM;
    let_fall(s, e, 1);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, 0), n);
    scene_ask_measure(s, scene_time(s));
    const int status = scene_run(s, NULL);
    CHECK(status == PM_OK || status == PM_UNDECIDED); /* the last of them that has a speed may be open */
    const double first = sqrt(2 / G), truth = first * (1 + 2 * e * (1 - pow(e, n - 1)) / (1 - e));
    CHECK(fabs(s->out[0] - truth) <= s->error[0] + 1e-14);
    CHECK(s->error[0] < 1e-8);
    scene_free(s);
}

/* After its rest another ball, thrown up, passes a height close below its highest place. */
static void decided_after_a_series(int route, double below)
{
    scene *s = estimating(1e-10);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    let_fall(s, 0.3, 1);
    const int thrown_up = scene_body(s, 1, 0, 5, 0, 0), g = scene_point(s, thrown_up, 0, 0);
    scene_start_velocity(s, g, 0, 2 * G);
    const int y = scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y);
    const int up = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, y, 2 * G * (1 - below)));
    scene_until_time(s, 3);
    scene_ask_count(s, up);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, scene_on(s, PM_TRIGGER_STRIKE, 0)));
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[0], 1);
    CHECK(isinf(s->out[1]));
    CHECK(s->margin[0] > 1 && s->margin[0] < 1e16 * below);
    scene_free(s);
}

/* A box that clatters in a gutter: as a series of its blows is cut off another corner parts, at a speed that goes with where it was
 * cut off, to which it is no decision whether it does. */
static void parts_as_a_series_ends(void)
{
    const double w = 0.11639900211229276, h = 0.1345964781375803, mass = 3.8307741582055037,
                 walls[2] = {0.980182882547058, -1.067336342849954};
    scene *s = estimating(1e-10);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    const int box =
        scene_body(s, mass, mass * (w * w + h * h) / 12, 0, 1.546035369806631, 0.6621735198581873);
    const int centre = scene_point(s, box, 0, 0);
    scene_start_velocity(s, centre, 0.8917350609440411, -0.6384994655646254);
    scene_start_omega(s, box, 4.30322852298084);
    for (int i = 0; i < 2; i++) {
        const int wall = scene_line(s, scene_point(s, PM_GROUND, 0, 0), walls[i]);
        for (int k = 0; k < 4; k++) {
            const int corner =
                scene_point(s, box, (k == 1 || k == 2 ? 0.5 : -0.5) * w, (k < 2 ? -0.5 : 0.5) * h);
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, corner, 0), wall, 0, 0.5, PM_FRICTION_COULOMB,
                          0.9);
        }
    }
    scene_until(s, scene_on(s, PM_TRIGGER_REST, box), 1);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, centre, PM_PART_X));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[0], -0.00120375788, 1e-9);
    scene_free(s);
}

int main(void)
{
    counted_events();
    counted_to_the_end();
    for (int route = PM_ROUTE_RK; route <= PM_ROUTE_IDA; route++)
        for (int i = 0; i < 3; i++) {
            series_cut_off(route, 0.3 + 0.3 * i, 1e-6, 1 + i % 2);
            series_cut_off(route, 0.3 + 0.3 * i, 1e-8, 1);
            series_cut_off(route, 0.3 + 0.3 * i, 1e-8, 2);
        }
    for (int n = 20; n < 40; n++) blow_too_late(0.36, n);
    for (int i = 0; i < 3; i++) taken_at_once(0.5 + 0.2 * i);
    for (int i = 4; i < 10; i++) {
        decided_after_a_series(PM_ROUTE_RK, pow(10, -i));
        decided_after_a_series(PM_ROUTE_UNIFORM, pow(10, -i));
    }
    parts_as_a_series_ends();
    return check_failures();
}
