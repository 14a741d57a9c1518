/* Decisions that no error can turn: what is counted against the margin, and what is not. */
#include <math.h>

#include "check.h"
#include "scene.h"

#define G 9.81
#define PI 3.14159265358979323846

static scene *estimating(int route)
{
    scene *s = scene_create();
    scene_set(s, PM_SETTING_ACCURACY, 1e-10);
    *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    return s;
}

/* A rod on a pin at one end, which is at (x, 0). */
static int hang(scene *s, double length, double x, double angle)
{
    const int rod = scene_body(s, 3, 3 * length * length / 12, x + 0.5 * length * cos(angle),
                               0.5 * length * sin(angle), angle);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -length / 2, 0), scene_point(s, PM_GROUND, x, 0), 0);
    return rod;
}

/* Where a rod turns back its speed is zero: an event that watches the speed to fall has not nearly fired as it rises. */
static void turning_back(int route)
{
    for (int i = 0; i < 20; i++) {
        const double length = check_random(0.3, 3), angle = check_random(-1, 0.7);
        scene *s = estimating(route);
        const int omega = scene_measure(s, PM_MEASURE_OMEGA, hang(s, length, 0, angle)),
                  place = scene_read(s, scene_measure(s, PM_MEASURE_TURNED, 0)),
                  out = scene_ask_end(s, place);
        scene_ask_event(s, place, scene_when(s, PM_TRIGGER_RISE, scene_read(s, omega)), 1, 0);
        scene_until(s, scene_when(s, PM_TRIGGER_FALL, scene_read(s, omega)), 1);
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[out], 0, 1e-8);
        NEAR(s->out[out + 1], -PI - 2 * angle, 1e-8);
        CHECK(s->trust[PM_TRUST_MARGIN] > 100);
        scene_free(s);
    }
}

/* A bob on a spring is looked at just before it turns back, its speed none but for errors: what watches the speed to fall
 * has not nearly fired there, for that speed is negative already. */
static void before_turning_back(int route)
{
    for (int i = 0; i < 20; i++) {
        const double omega = check_random(0.5, 5), back = PI / omega;
        scene *s = estimating(route);
        scene_set(s, PM_SETTING_GRAVITY_Y, 0);
        const int bob = scene_body(s, 1, 0, 1, 0, 0), c = scene_point(s, bob, 0, 0);
        scene_joint(s, PM_JOINT_SLIDER, c, scene_floor(s, 0), 0);
        scene_force(s, PM_FORCE_SPRING, c, scene_point(s, PM_GROUND, -5, 0), omega * omega, 6 - 1);
        const int v = scene_part(s, PM_MEASURE_VELOCITY, c, PM_PART_X);
        const int look = scene_when(s, PM_TRIGGER_RISE,
                                    scene_minus(s, scene_time(s), back * (1 - check_random(1, 9) * 1e-12)));
        const int at = scene_ask_event(s, scene_read(s, v), look, 1, 0);
        scene_until(s, scene_when(s, PM_TRIGGER_FALL, scene_read(s, v)), 1);
        const int end = scene_ask_measure(s, scene_time(s));
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[at], 0, 1e-8);
        NEAR(s->out[end], 2 * back, 1e-8);
        CHECK(s->trust[PM_TRUST_MARGIN] > 100);
        scene_free(s);
    }
}

/* A rod tips over from upright and passes an angle, which one pass may meet on its first step along the path and the
 * other after it, in time: omega^2 = 3 g (1 - cos turned) / L. */
static void on_the_first_step(int route)
{
    for (int i = 0; i < 40; i++) {
        const double length = check_random(0.3, 3), there = 0.05 * (i + 1);
        scene *s = estimating(route);
        const int rod = hang(s, length, 0, 0.5 * PI), omega = scene_measure(s, PM_MEASURE_OMEGA, rod);
        *scene_setting(s, PM_SETTING_NUDGE) = scene_read(s, omega);
        const int turned = scene_measure(s, PM_MEASURE_TURNED, rod);
        scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turned, there)), 1);
        const int out = scene_ask_measure(s, omega);
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[out], sqrt(3 * G * (1 - cos(there)) / length), 1e-9);
        CHECK(s->trust[PM_TRUST_MARGIN] > 100);
        scene_free(s);
    }
}

/* A wheel on a pin through its centre is stopped by a bar: nothing presses on it afterwards but rounding. */
static void nothing_presses(int route)
{
    for (int i = 0; i < 20; i++) {
        const double radius = check_random(0.1, 2), angle = check_random(0.5, 2.5);
        scene *s = estimating(route);
        scene_set(s, PM_SETTING_GRAVITY_Y, 0);
        const int wheel = scene_body(s, 2, radius * radius, 0, 0, angle);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, wheel, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
        scene_start_omega(s, wheel, check_random(-5, -1));
        const int bar =
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, wheel, radius, 0), 0),
                          scene_floor(s, 0), 0, 0, PM_FRICTION_SMOOTH, 0);
        scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, bar), 1);
        const int out = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, wheel));
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[out], 0, 1e-12);
        CHECK(s->trust[PM_TRUST_MARGIN] > 100);
        scene_free(s);
    }
}

/* Two equal rods fall to both sides and strike the floor at one instant, whichever of the two zeros is found. */
static void both_at_once(int route)
{
    for (int i = 0; i < 20; i++) {
        const double length = check_random(0.3, 3), up = check_random(0.3, 1.4),
                     apart = check_random(0.01, 1);
        scene *s = estimating(route);
        for (int side = 0; side < 2; side++) {
            const int rod = hang(s, length, side ? apart : -apart, side ? up : PI - up);
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, rod, length / 2, 0), 0),
                          scene_floor(s, 0), 0, 0, PM_FRICTION_SMOOTH, 0);
        }
        scene_until(s, scene_on(s, PM_TRIGGER_REST, PM_NONE), 1);
        const int out = scene_ask_measure(s, scene_time(s));
        EQUAL(scene_run(s, NULL), PM_OK);
        CHECK(s->out[out] > 0);
        EQUAL(s->count[PM_COUNT_JUMPS], 1);
        CHECK(s->trust[PM_TRUST_MARGIN] > 100);
        scene_free(s);
    }
}

/* A ball falls on a floor and is looked at `late` of its time of fall after the blow. */
static scene *dropped(int route, double height, double late)
{
    scene *s = estimating(route);
    const int ball = scene_body(s, 1, 0, 0, height, 0), g = scene_point(s, ball, 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, 0), scene_floor(s, 0), 0, 0.5, PM_FRICTION_SMOOTH,
                  0);
    scene_until_time(s, sqrt(2 * height / G) * (1 + late));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y));
    return s;
}

/* A blow when the run ends: which comes first is not known.  Earlier or later it is, the surer the farther. */
static void blow_at_the_end(int route)
{
    for (int i = 0; i < 8; i++) {
        const double height = pow(10, check_random(-2, 2)), fall = sqrt(2 * G * height);
        scene *s = dropped(route, height, 0);
        EQUAL(scene_run(s, NULL), PM_UNDECIDED);
        EQUAL(s->trust[PM_TRUST_MARGIN], 0);
        scene_free(s);
        for (int k = 5; k < 10; k++)
            for (int side = -1; side < 2; side += 2) {
                const double late = side * pow(10, -k);
                s = dropped(route, height, late);
                const int status = scene_run(s, NULL);
                CHECK(status == PM_OK || status == PM_UNDECIDED);
                if (status == PM_OK) NEAR(s->out[0], side < 0 ? -fall : 0.5 * fall, 1e-4 * fall);
                CHECK(s->trust[PM_TRUST_MARGIN] < 1e16 * fabs(late));
                scene_free(s);
            }
    }
}

/* A blow leaves a part of a speed, or nothing: it leaves as much of its error. */
static void error_after_a_blow(void)
{
    static const double restitution[] = {0, 1e-6, 0.3, 1};
    for (int i = 0; i < 4; i++) {
        const double length = 1.2, e = restitution[i];
        scene *s = estimating(PM_ROUTE_AUTO);
        const int rod = hang(s, length, 0, 0);
        const int stop = scene_line(s, scene_point(s, PM_GROUND, 0, 0), -PI / 2);
        const int struck =
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, rod, length / 2, 0), 0), stop, 0,
                          e, PM_FRICTION_SMOOTH, 0);
        const int event = scene_on(s, PM_TRIGGER_STRIKE, struck);
        scene_until(s, event, 1);
        const int program = scene_read(s, scene_measure(s, PM_MEASURE_OMEGA, rod));
        const int before = scene_ask_event(s, program, event, 1, 1),
                  after = scene_ask_event(s, program, event, 1, 0);
        const double omega = sqrt(3 * G / length);
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[before], -omega, s->error[before]);
        NEAR(s->out[after], e * omega, s->error[after]);
        CHECK(s->error[after] < 1e-11 * omega);
        scene_free(s);
    }
}

/* A crate that clatters to rest: late in its blows one pass is at another of them than the other, and decides nothing. */
static void clatters_to_rest(void)
{
    int undecided = 0;
    for (int i = 0; i < 40; i++) {
        const double w = check_random(0.1, 0.5), h = check_random(0.05, 0.15);
        scene *s = estimating(PM_ROUTE_AUTO);
        const int b = scene_body(s, 1, (w * w + h * h) / 12, 0, 1.2, check_random(-3, 3)),
                  c = scene_point(s, b, 0, 0);
        const int floor = scene_floor(s, 0);
        for (int k = 0; k < 4; k++) {
            const int corner = scene_point(s, b, (k % 3 ? 0.5 : -0.5) * w, (k < 2 ? -0.5 : 0.5) * h);
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, corner, 0), floor, 0, 0.5, PM_FRICTION_COULOMB,
                          0.5);
        }
        scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, c, PM_PART_X));
        scene_start_velocity(s, c, check_random(-2, 2), 0);
        scene_start_omega(s, b, check_random(-8, 8));
        scene_until(s, scene_on(s, PM_TRIGGER_REST, PM_NONE), 1);
        const int status = scene_run(s, NULL);
        CHECK(status == PM_OK || status == PM_UNDECIDED);
        undecided += status == PM_UNDECIDED;
        scene_free(s);
    }
    CHECK(undecided <= 1);
}

/* A wheel with its mass aside that bounces until it rolls, beside what is far away, if anything is: its angle, with the error. */
static double rolls_in_the_end(const double x[4], double far, double *error)
{
    scene *s = estimating(PM_ROUTE_RK);
    const int b = scene_body(s, 1, 0.05, 0, 1, x[0]), g = scene_point(s, b, 0, 0);
    const int contact = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, x[1], x[2]), 0.3),
                                      scene_floor(s, 0), 0, x[3], PM_FRICTION_ROUGH, 0);
    if (far > 0) {
        const int other = scene_body(s, 1, 0.1, far, 0, 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, other, 0, 0), scene_point(s, PM_GROUND, far, 0), 0);
    }
    scene_start_omega(s, b, 2);
    scene_start_velocity(s, g, 0.5, 0);
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, b));
    const int closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, contact));
    scene_until_time(s, 1.6);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double found = s->out[closed] == 1 ? s->out[angle] : NAN;
    *error = s->error[angle];
    scene_free(s);
    return found;
}

/* Beside something far or fast a motion is as it is alone, within the errors; 0 where one of both is not known. */
static int is_alike(double (*run)(const double x[4], double other, double *error), const double x[4],
                    double other)
{
    double error, error_alone;
    const double beside = run(x, other, &error), alone = run(x, 0, &error_alone);
    if (isnan(beside) || isnan(alone)) return 0;
    CHECK(fabs(beside - alone) <= 5 * (error + error_alone));
    return 1;
}

/* In a large scene a series of bounces ends where its ratio has settled, which loses more: the error says so. */
static void ends_where_it_settles(void)
{
    int compared = 0;
    for (int i = 0; i < 30; i++) {
        const double x[4] = {check_random(-3, 3), check_random(-0.1, 0.1), check_random(-0.1, 0.1),
                             check_random(0.1, 0.5)};
        compared += is_alike(rolls_in_the_end, x, 60);
    }
    CHECK(compared > 10);
}

/* A crate that clatters as it slides to rest, beside what flies so fast, if anything does: where it comes to, with the error. */
static double slides_to_rest(const double x[4], double fast, double *error)
{
    scene *s = estimating(PM_ROUTE_RK);
    const int b = scene_body(s, 1, (x[0] * x[0] + 0.04) / 12, 0, 0.5, x[1]), c = scene_point(s, b, 0, 0);
    const int floor = scene_floor(s, 0);
    for (int k = 0; k < 4; k++) {
        const int corner = scene_point(s, b, (k % 3 ? 0.5 : -0.5) * x[0], k < 2 ? -0.1 : 0.1);
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, corner, 0), floor, 0, x[2], PM_FRICTION_COULOMB,
                      0.3);
    }
    if (fast > 0) {
        const int other = scene_point(s, scene_body(s, 1, 0.1, 0, 9, 0), 0, 0);
        scene_start_velocity(s, other, fast, 0);
        scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, other, PM_PART_X));
    }
    scene_start_velocity(s, c, x[3], 0);
    const int place = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, c, PM_PART_X));
    scene_until_time(s, 4);
    const int status = scene_run(s, NULL);
    const double found = status == PM_OK ? s->out[place] : NAN;
    *error = s->error[place];
    scene_free(s);
    return found;
}

/* What a series loses where it is cut off a coarse run shows by ending it earlier; beside what is fast it is cut off earlier. */
static void cut_off_without_a_ratio(void)
{
    int compared = 0;
    for (int i = 0; i < 30; i++) {
        const double x[4] = {check_random(0.1, 0.5), check_random(-1, 1), check_random(0.1, 0.6),
                             check_random(1, 4)};
        compared += is_alike(slides_to_rest, x, 100);
    }
    CHECK(compared > 20);
}

/* A ball bounces on a plank that bounces on the floor, until neither does: each is struck without end, and both rest at one
 * instant, in every pass. */
static void rest_together(double e_floor, double e_ball, double mass, double height)
{
    scene *s = estimating(PM_ROUTE_AUTO);
    const int plank = scene_body(s, 1, 1 / 12., 0, 0.3, 0), ball = scene_body(s, mass, 0, 0, 0.3 + height, 0);
    const int middle = scene_point(s, plank, 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, middle, 0), scene_floor(s, 0), 0, e_floor,
                  PM_FRICTION_SMOOTH, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, ball, 0, 0), 0),
                  scene_line(s, middle, 0), 0, e_ball, PM_FRICTION_SMOOTH, 0);
    int ask[2];
    for (int i = 0; i < 2; i++)
        ask[i] = scene_ask_event(s, scene_read(s, scene_time(s)),
                                 scene_on(s, PM_TRIGGER_REST, i == 0 ? plank : ball), 1, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_REST, PM_NONE), 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[ask[0]], s->out[ask[1]]);
    CHECK(s->error[ask[0]] < 1e-5);
    scene_free(s);
}

/* A particle between four walls and a disk goes another way in each pass after some fifty blows: where the numbers of blows differ,
 * and the answers, the run is undecided, however clear each blow by itself was. */
static void billiards(void)
{
    int undecided = 0;
    for (int i = 0; i < 8; i++) {
        scene *s = estimating(PM_ROUTE_AUTO);
        scene_set(s, PM_SETTING_GRAVITY_Y, 0);
        const double heading = check_random(0, 6);
        const int b = scene_body(s, 1, 0, -0.8, 0.7, 0), c = scene_point(s, b, 0, 0),
                  ball = scene_circle(s, c, 0);
        const int disk = scene_circle(s, scene_point(s, PM_GROUND, 0, 0), 0.5);
        scene_contact(s, PM_CONTACT_CIRCLE, ball, disk, 1, 1, PM_FRICTION_SMOOTH, 0);
        for (int k = 0; k < 4; k++) {
            const double turn = k * PI / 2;
            const int line = scene_line(s, scene_point(s, PM_GROUND, sin(turn), -cos(turn)), turn);
            scene_contact(s, PM_CONTACT_LINE, ball, line, 0, 1, PM_FRICTION_SMOOTH, 0);
        }
        scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, c, PM_PART_X));
        scene_start_velocity(s, c, cos(heading), sin(heading));
        scene_until_time(s, 150);
        const int status = scene_run(s, NULL);
        CHECK(status == PM_UNDECIDED || s->trust[PM_TRUST_EXCESS] > 1);
        undecided += status == PM_UNDECIDED && s->trust[PM_TRUST_MARGIN] == 0;
        scene_free(s);
    }
    CHECK(undecided > 0);
}

/* A ball that bounces to rest: heights of its last bounces are known to some percent only, and what they nearly did decides
 * nothing.  They would take a tenth and more of the margin that the other blows have. */
static void last_bounces(void)
{
    const int balls = 40;
    double digits = 0;
    for (int i = 0; i < balls; i++) {
        scene *s = estimating(PM_ROUTE_RK);
        const double h = check_random(0.1, 1);
        const int ball = scene_body(s, 1, 0, 0, h, 0), c = scene_point(s, ball, 0, 0);
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, c, 0), scene_floor(s, 0), 0, check_random(0.1, 0.8),
                      PM_FRICTION_SMOOTH, 0);
        scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, c, PM_PART_Y));
        scene_until_time(s, 5);
        EQUAL(scene_run(s, NULL), PM_OK);
        digits += log10(s->trust[PM_TRUST_MARGIN]) / balls;
        scene_free(s);
    }
    CHECK(digits > 8); /* 8.7 on average; 7.3 where the last bounces count */
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int i = 0; i < 2; i++) {
        turning_back(routes[i]);
        before_turning_back(routes[i]);
        on_the_first_step(routes[i]);
        nothing_presses(routes[i]);
        both_at_once(routes[i]);
        blow_at_the_end(routes[i]);
    }
    for (int i = 0; i < 20; i++) blow_at_the_end(PM_ROUTE_AUTO);
    error_after_a_blow();
    clatters_to_rest();
    billiards();
    last_bounces();
    ends_where_it_settles();
    cut_off_without_a_ratio();
    rest_together(0.5, 0.1, 1, 0.2);
    rest_together(0.5, 0.1, 0.1, 0.2);
    rest_together(0.5, 0.1, 0.5, 0.2);
    return check_failures();
}
