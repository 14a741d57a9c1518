/* What comes to zero and stays there: speeds that friction ends, springs in their free position; and searches that the end of all
 * time does not lengthen. */
#include "check.h"
#include "run/run.h"
#include "scene.h"
#include "state/workspace.h"

#define G 9.81

static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
static const double close[] = {1e-10, 1e-10, 1e-6};

/* c f + d g of two measures. */
static int mixed(scene *s, double c, int f, double d, int g)
{
    return SCENE_PROGRAM(s, scene_m(f), scene_k(s, c), scene_op(PM_OP_MUL), scene_m(g), scene_k(s, d),
                         scene_op(PM_OP_MUL), scene_op(PM_OP_ADD));
}

/* A block slides along a floor, which stops it: v > 0 along the floor, which lies at an angle with the weight across it. */
static void slides_until_it_stops(int route, double angle, double v, double mu)
{
    scene *s = scene_create();
    const double m = check_random(0.5, 3), c = cos(angle), d = sin(angle), stops = v / (mu * G);
    const int body = scene_body(s, m, 0, 0, 0, 0), point = scene_point(s, body, 0, 0), time = scene_time(s);
    scene_set(s, PM_SETTING_GRAVITY_X, G * d);
    scene_set(s, PM_SETTING_GRAVITY_Y, -G * c);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, point, 0), scene_floor(s, angle), 0, 0,
                  PM_FRICTION_COULOMB, mu);
    const int vx = scene_part(s, PM_MEASURE_VELOCITY, point, PM_PART_X),
              vy = scene_part(s, PM_MEASURE_VELOCITY, point, PM_PART_Y);
    const int event[] = {scene_when(s, PM_TRIGGER_FALL, mixed(s, c, vx, d, vy)),
                         scene_when(s, PM_TRIGGER_RISE, mixed(s, c, vx, d, vy)),
                         scene_when(s, PM_TRIGGER_CROSS, mixed(s, c, vx, d, vy))};
    int count[3];
    for (int i = 0; i < 3; i++) count[i] = scene_ask_count(s, event[i]);
    const int zero_at = scene_ask_event(s, scene_read(s, time), event[2], 1, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = routes[route];
    scene_start_velocity(s, point, v * c, v * d);
    scene_until_time(s, 3 * stops);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[count[0]], 0);
    EQUAL(s->out[count[1]], 0);
    EQUAL(s->out[count[2]], 1);
    NEAR(s->out[zero_at], stops, close[route] * stops);
    scene_free(s);
}

/* A wheel in the free position of its spring, but for the last digit of that: it does not move, and the spring tells its speed. */
static void rests_in_spring(int route, double angle, double stiffness)
{
    scene *s = scene_create();
    const double inertia = 0.5;
    const int wheel = scene_body(s, 1, inertia, 0, 0, angle), centre = scene_point(s, wheel, 0, 0);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    scene_joint(s, PM_JOINT_PIN, centre, scene_point(s, PM_GROUND, 0, 0), 0);
    scene_force(s, PM_FORCE_TORSION, wheel, PM_GROUND, stiffness, nextafter(angle, 10));
    scene_start_omega(s, wheel, 0);
    scene_until_time(s, 3);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, wheel));
    *scene_setting(s, PM_SETTING_ROUTE) = routes[route];
    EQUAL(scene_open(s), PM_OK);
    EQUAL(pm_run(s->w, NULL), PM_OK);
    EQUAL(s->w->result.out[omega], 0);
    const double speed = sqrt(stiffness / inertia) * s->w->numbers.size;
    CHECK(s->w->numbers.speed > 0.1 * speed && s->w->numbers.speed < 10 * speed);
    scene_free(s);
}

/* A weight is thrown up from beside its hook and falls into its cord: when, and in how many steps, however long it might take. */
static void cord_tightens(double max_time)
{
    scene *s = scene_create();
    const double l = 0.3, x = 0.2, v = 2.5;
    const int body = scene_body(s, 1, 0, x, 0, 0), point = scene_point(s, body, 0, 0);
    const int cord = scene_cord(s, scene_circle(s, point, 0), 1,
                                scene_circle(s, scene_point(s, PM_GROUND, 0, 0), 0), 1, l - x, 0.5);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    scene_set(s, PM_SETTING_MAX_TIME, max_time);
    scene_start_velocity(s, point, 0, v);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, cord), 1);
    const int t = scene_ask_measure(s, scene_time(s));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double up = sqrt(l * l - x * x); /* the first place on the circle */
    NEAR(s->out[t], (v - sqrt(v * v - 2 * G * up)) / G, 1e-12);
    EQUAL(s->count[PM_COUNT_STEPS], 1);
    scene_free(s);
}

/* The last blow that was computed of an endless series is none that a later time may come before. */
static void ends_series(double e)
{
    scene *s = scene_create();
    const int body = scene_body(s, 1, 0, 0, 1, 0), point = scene_point(s, body, 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, point, 0), scene_floor(s, 0), 0, e, PM_FRICTION_SMOOTH,
                  0);
    const double rests = sqrt(2 / G) * (1 + e) / (1 - e);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    scene_until_time(s, 1.1 * rests);
    EQUAL(scene_open(s), PM_OK);
    EQUAL(pm_run(s->w, NULL), PM_OK);
    CHECK(isnan(s->w->firing.jumped));
    scene_free(s);
}

int main(void)
{
    for (int route = 0; route < 3; route++) {
        for (int i = 0; i < 12; i++) {
            const double angle = check_random(-1.5, 1.5), mu = check_random(0.1, 0.6);
            slides_until_it_stops(route, angle, check_random(0.5, 3), mu);
        }
        rests_in_spring(route, 0.6457718232379019, 17.26);
        rests_in_spring(route, -1.5707963267948966, 221.7);
    }
    for (double max_time = 10; max_time < 1e12; max_time *= 100) cord_tightens(max_time);
    for (double e = 0.1; e < 0.95; e += 0.2) ends_series(e);
    return check_failures();
}
