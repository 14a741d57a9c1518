/* Belts and cords: reactions and motions against closed forms, cords that wind up, slacken and tighten, bodies on a belt
 * that runs. */
#include "check.h"
#include "scene.h"

#define TWO_PI 6.283185307179586

/* ---- belts ---- */
/* Two pulleys and a tight belt, crossed or not: one turns the other by the ratio of radii; what the strands carry is not
 * unique, and so is not told. */
static void belt(double crossed)
{
    scene *s = scene_create();
    const double ra = 0.1, rb = 0.25, couple = 2, ia = 0.02, ib = 0.3, ratio = crossed * ra / rb;
    const int a = scene_body(s, 1, ia, 0, 0, 0), b = scene_body(s, 1, ib, 0.7, 0.1, 0);
    const int pa = scene_point(s, a, 0, 0), pb = scene_point(s, b, 0, 0);
    scene_joint(s, PM_JOINT_PIN, pa, scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, pb, scene_point(s, PM_GROUND, 0.7, 0.1), 0);
    const int joint =
        scene_joint(s, PM_JOINT_BELT, scene_circle(s, pa, ra), scene_circle(s, pb, rb), crossed);
    scene_couple(s, a, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, couple)));
    scene_until_time(s, 5);
    const int turned_a = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, a));
    const int turned_b = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, b));
    const int tension = scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_NORMAL, joint));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double end = 12.5 * couple / (ia + ib * ratio * ratio);
    NEAR(s->out[turned_a], end, 1e-9 * end);
    NEAR(s->out[turned_b], ratio * s->out[turned_a], 1e-11 * end);
    CHECK(isnan(s->out[tension]));
    scene_free(s);
}

/* ---- cords ---- */
/* A particle on a cord swings round a fixed drum and winds the cord up (no weight): its speed stays v, and the free length l
 * shrinks by R for each radian, so that l dl/dt = -+ R v. */
static void winds_up(int sense, int route)
{
    scene *s = scene_create();
    const double R = 0.2, l = 2, v = 3, t = 1.5;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    /* from the drum, passed counterclockwise, the strand leaves (R, 0) upward */
    const int body = scene_body(s, 0.7, 0, R, sense * l, 0), g = scene_point(s, body, 0, 0);
    const int drum = scene_circle(s, scene_point(s, PM_GROUND, 0, 0), R);
    scene_cord(s, drum, sense, scene_circle(s, g, 0), 1, 0, 0);
    scene_start_velocity(s, g, -v, 0);
    scene_until_time(s, t);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    const int y = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y));
    const int tension = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, 0));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double left = sqrt(l * l - 2 * R * v * t),
                 turned = (l - left) / R; /* the strand turns by as much */
    const double close = route == PM_ROUTE_IDA ? 1e-5 : 1e-9;
    NEAR(s->out[x], R * cos(turned) - left * sin(turned), close);
    NEAR(s->out[y], sense * (R * sin(turned) + left * cos(turned)), close);
    NEAR(s->out[tension], 0.7 * v * v / left, 10 * close);
    scene_free(s);
}

/* A cylinder drops from the height at which its cord is slack, is caught with restitution, bounces, and unwinds. */
static void caught(double e)
{
    scene *s = scene_create();
    const double r = 0.3, slack = 0.5, m = 2, inertia = 0.5 * m * r * r, g = 9.81;
    const int body = scene_body(s, m, inertia, 0, 0, 0), centre = scene_point(s, body, 0, 0);
    const int hook = scene_circle(s, scene_point(s, PM_GROUND, r, 1), 0);
    const int c = scene_cord(s, hook, 1, scene_circle(s, centre, r), -1, slack, e);
    const int tight = scene_on(s, PM_TRIGGER_STRIKE, c);
    scene_until(s, tight, 1);
    const int fall = scene_part(s, PM_MEASURE_VELOCITY, centre, PM_PART_Y);
    const int before = scene_ask_event(s, scene_read(s, fall), tight, 1, 1);
    const int after = scene_ask_event(s, scene_read(s, fall), tight, 1, 0);
    const int spin = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, body));
    const int blow = scene_ask_measure(s, scene_part(s, PM_MEASURE_CONTACT_IMPULSE, c, PM_PART_NORM));
    const int gap = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_GAP, c));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double v = sqrt(2 * g * slack), impulse = (1 + e) * v / (1 / m + r * r / inertia);
    NEAR(s->out[before], -v, 1e-9);
    NEAR(s->out[after], -v + impulse / m, 1e-9);
    NEAR(s->out[spin], impulse * r / inertia, 1e-8); /* the cord leaves its right side upward */
    NEAR(s->out[blow], impulse, 1e-9);
    NEAR(s->out[gap], 0, 1e-9);
    scene_free(s);
}

/* Thrown up from a taut cord it slackens at once, and is taut again at the same height. */
static void slackens(void)
{
    scene *s = scene_create();
    const int body = scene_body(s, 1, 0, 0, -1, 0), g = scene_point(s, body, 0, 0);
    const int c =
        scene_cord(s, scene_circle(s, g, 0), 1, scene_circle(s, scene_point(s, PM_GROUND, 0, 0), 0), 1, 0, 0);
    scene_start_velocity(s, g, 0, 2);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, c), 1);
    const int time = scene_ask_measure(s, scene_time(s));
    const int closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, c));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[time], 4 / 9.81, 1e-10);
    EQUAL(s->out[closed], 1);
    scene_free(s);
}

/* A spring keeps a particle on a circle round a drum, and its slack cord is wound up, R for each radian: taut after more than
 * a turn and a half. */
static void winds_up_slack(int sense, int route)
{
    scene *s = scene_create();
    const double R = 0.2, l = 2, m = 0.7, k = 2.8, rate = sqrt(k / m), angle = 10;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int body = scene_body(s, m, 0, R, sense * l, 0), g = scene_point(s, body, 0, 0);
    const int centre = scene_point(s, PM_GROUND, 0, 0);
    scene_force(s, PM_FORCE_SPRING, g, centre, k, 0);
    const int c = scene_cord(s, scene_circle(s, centre, R), sense, scene_circle(s, g, 0), 1, angle * R, 0);
    scene_start_velocity(s, g, -rate * l, sense * rate * R);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, c), 1);
    const int time = scene_ask_measure(s, scene_time(s));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[time], angle / rate, route == PM_ROUTE_IDA ? 1e-6 : 1e-9);
    scene_free(s);
}

/* ---- bodies on a belt ---- */
/* A disk is put on a running belt: it slips for v r m / (2 mu m g r) and sticks. */
static void on_a_belt(double way_of_belt)
{
    scene *s = scene_create();
    const double r = 0.2, mu = 0.3, v = 7, m = 3, g = 9.81;
    const int disk = scene_body(s, m, 0.5 * m * r * r, 0, r, 0), centre = scene_point(s, disk, 0, 0);
    scene_joint(s, PM_JOINT_SLIDER, centre, scene_line(s, scene_point(s, PM_GROUND, 0, 0), TWO_PI / 4), 0);
    const int touch = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, centre, r), scene_floor(s, 0), 0, 0,
                                    PM_FRICTION_COULOMB, mu);
    s->cell[PM_TABLE_CONTACT][touch * PM_CONTACT_COLUMNS + PM_CONTACT_SPEED] =
        SCENE_PROGRAM(s, scene_k(s, way_of_belt * v));
    const int sticks = scene_on(s, PM_TRIGGER_STICK, touch);
    scene_until_time(s, 3);
    const int time = scene_ask_event(s, scene_read(s, scene_time(s)), sticks, 1, 0);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, disk));
    const int turned = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, disk));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double t = v / (2 * mu * g);
    NEAR(s->out[time], t, 1e-9);
    NEAR(s->out[omega], way_of_belt * v / r, 1e-9);
    NEAR(s->out[turned], way_of_belt * (v / r) * (3 - t / 2), 1e-8);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9);
    scene_free(s);
}

/* A rough belt below a disk that turns on an axle begins to run: by an impulse J along it the disk turns with it at once. */
static void belt_that_starts(int route)
{
    scene *s = scene_create();
    const double r = 0.2, v = 3, m = 4, inertia = 0.5 * m * r * r;
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int disk = scene_body(s, m, inertia, 0, r, 0), centre = scene_point(s, disk, 0, 0);
    scene_joint(s, PM_JOINT_SLIDER, centre, scene_line(s, scene_point(s, PM_GROUND, 0, 0), TWO_PI / 4), 0);
    const int touch = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, centre, r), scene_floor(s, 0), 0, 0,
                                    PM_FRICTION_ROUGH, 0);
    const scene_code t = scene_m(scene_time(s));
    scene_cell(s, PM_TABLE_CONTACT, touch, PM_CONTACT_SPEED,
               SCENE_PROGRAM(s, t, scene_k(s, 0.5), scene_op(PM_OP_GT), scene_k(s, v), scene_op(PM_OP_MUL)));
    scene_until_time(s, 2);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, disk)),
              turned = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, disk));
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->count[PM_COUNT_JUMPS], 1);
    NEAR(s->out[omega], v / r, 1e-9);
    NEAR(s->out[turned], 1.5 * v / r, route == PM_ROUTE_IDA ? 1e-6 : 1e-9);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-8);
    scene_free(s);
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int i = 0; i < 2; i++) {
        belt_that_starts(routes[i]);
        winds_up(1, routes[i]);
        winds_up(-1, routes[i]);
        winds_up_slack(-1, routes[i]);
        winds_up_slack(1, routes[i]);
        belt(i == 0 ? 1 : -1);
        on_a_belt(i == 0 ? 1 : -1);
    }
    caught(0);
    caught(0.4);
    slackens();
    return check_failures();
}
