/* The search for events: in long steps and at their ends, far from surfaces that come near, small and fast bodies. */
#include "check.h"
#include "scene.h"

#define G 9.81
#define PI 3.14159265358979323846

/* Steps so long that the dense output has a zero a little beside where it is exactly: each is passed once. */
static void once_in_long_steps(void)
{
    enum { MARKS = 200 };
    scene *s = scene_create();
    const int rod = scene_body(s, 1, 1.0 / 12, 0.5, 0, 0), end = scene_point(s, rod, -0.5, 0);
    scene_joint(s, PM_JOINT_PIN, end, scene_point(s, PM_GROUND, 0, 0), 0);
    scene_start_omega(s, rod, 9);
    scene_route(s, PM_ROUTE_RK, 1e-2);
    const int turned = scene_measure(s, PM_MEASURE_TURNED, rod);
    int count[MARKS];
    for (int i = 0; i < MARKS; i++)
        count[i] =
            scene_ask_count(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turned, 0.01 + 0.03 * i)));
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turned, 6.2)), 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int i = 0; i < MARKS; i++) EQUAL(s->out[count[i]], 1);
    scene_free(s);
}

/* Marks where steps end: each is passed once and the phase goes on; the same as on a route whose steps end elsewhere. */
static void at_ends_of_steps(void)
{
    enum { TURNS = 3 };
    for (int k = 0; k < 2; k++) {
        scene *s = scene_create();
        const int rod = scene_body(s, 1, 1.0 / 12, 0, -0.5, 0), top = scene_point(s, rod, 0, 0.5);
        scene_joint(s, PM_JOINT_PIN, top, scene_point(s, PM_GROUND, 0, 0), 0);
        scene_start_omega(s, rod, 9);
        scene_route(s, k ? PM_ROUTE_RK : PM_ROUTE_PATH, 1e-12);
        const int turned = scene_measure(s, PM_MEASURE_TURNED, rod),
                  omega = scene_read(s, scene_measure(s, PM_MEASURE_OMEGA, rod));
        const int above = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, turned, PI)),
                  halves = scene_when(s, PM_TRIGGER_EVERY,
                                      SCENE_PROGRAM(s, scene_m(turned), scene_k(s, PI), scene_op(PM_OP_DIV))),
                  quarter = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turned, PI / 2));
        const int once = scene_ask_count(s, above), each = scene_ask_count(s, halves),
                  inside = scene_ask_count(s, quarter), slowest = scene_ask_event(s, omega, above, 1, 0),
                  later = scene_ask_event(s, omega, halves, 3, 0);
        scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turned, (2 * TURNS + 0.5) * PI)), 1);
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[once], 1);
        EQUAL(s->out[each], 2 * TURNS);
        EQUAL(s->out[inside], 1);
        NEAR(s->out[slowest], sqrt(81 - 6 * G), 1e-9); /* (l^2 / 3) (w1^2 - w^2) / 2 = g l */
        NEAR(s->out[later], s->out[slowest], 1e-9);
        CHECK(s->count[PM_COUNT_PHASES] <= 1 + TURNS); /* a path that has closed begins anew */
        scene_free(s);
    }
}

/* On the path, where the zeros of smooth functions are those of a polynomial: one with a corner at its zero, which a
 * polynomial has somewhat before or after, still comes before what comes a little later.  Angles of a rod on its pin. */
static void corner_comes_first(void)
{
    for (int i = 0; i < 40; i++) {
        const double there = check_random(0.3, 5), later = there + pow(10, check_random(-9, -3));
        scene *s = scene_create();
        const int rod = scene_body(s, 1, 1.0 / 12, 0, -0.5, 0), top = scene_point(s, rod, 0, 0.5);
        scene_joint(s, PM_JOINT_PIN, top, scene_point(s, PM_GROUND, 0, 0), 0);
        scene_start_omega(s, rod, 9);
        *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
        const int turned = scene_measure(s, PM_MEASURE_TURNED, rod);
        const int bent = SCENE_PROGRAM(s, scene_m(turned), scene_k(s, there), scene_op(PM_OP_SUB),
                                       scene_m(turned), scene_k(s, there), scene_op(PM_OP_SUB), scene_k(s, 5),
                                       scene_op(PM_OP_MUL), scene_op(i % 2 ? PM_OP_MAX : PM_OP_MIN));
        const int corner = scene_when(s, PM_TRIGGER_RISE, bent),
                  mark = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turned, later));
        const int before = scene_ask_event(s, scene_read(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, corner)),
                                           mark, 1, 0),
                  angle = scene_ask_event(s, scene_read(s, turned), corner, 1, 0);
        scene_until(s, mark, 1);
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[before], 1);
        NEAR(s->out[angle], there, 1e-12);
        scene_free(s);
    }
}

/* Two rods that whirl elsewhere: steps are so short that others hardly move in one. */
static void whirl(scene *s)
{
    const int a = scene_body(s, 1, 1.0 / 12, 100.5, 0, 0), b = scene_body(s, 1, 1.0 / 12, 101, 0.5, PI / 2);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -0.5, 0), scene_point(s, PM_GROUND, 100, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), scene_point(s, a, 0.5, 0), 0);
    scene_start_omega(s, a, 40);
    scene_start_omega(s, b, -30);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
}

/* The tip of a wheel turns almost once before it strikes: a contact that is far for long, and whose mark moves because
 * its body turns.  Time and speed of the blow as the path route has them. */
static void far_until_a_turn_is_over(void)
{
    double found[2][3];
    for (int k = 0; k < 2; k++) {
        scene *s = scene_create();
        const int wheel = scene_body(s, 2, 0.3, 0.02, 0, 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, wheel, -0.02, 0), scene_point(s, PM_GROUND, 0, 0), 0);
        scene_start_omega(s, wheel, -3);
        const int tip = scene_circle(s, scene_point(s, wheel, 0.9, 0.3), 0.02),
                  wall = scene_line(s, scene_point(s, PM_GROUND, 0, 0.7), PI);
        const int contact = scene_contact(s, PM_CONTACT_LINE, tip, wall, 0, 0.5, PM_FRICTION_SMOOTH, 0);
        const int struck = scene_on(s, PM_TRIGGER_STRIKE, contact);
        const int t = scene_ask_event(s, scene_read(s, scene_time(s)), struck, 1, 0),
                  omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, wheel)),
                  turned = scene_ask_event(s, scene_read(s, scene_measure(s, PM_MEASURE_TURNED, wheel)),
                                           struck, 1, 0);
        scene_route(s, k ? PM_ROUTE_PATH : PM_ROUTE_RK, 1e-13);
        scene_until(s, struck, 1);
        EQUAL(scene_run(s, NULL), PM_OK);
        found[k][0] = s->out[t];
        found[k][1] = s->out[omega];
        found[k][2] = s->out[turned];
        if (!k) CHECK(s->count[PM_COUNT_STEPS] > 20);
        scene_free(s);
    }
    CHECK(found[0][2] < -4);
    for (int i = 0; i < 3; i++) NEAR(found[0][i], found[1][i], 1e-10);
}

/* One ball rests, the other comes from afar in many steps: whichever is named first. */
static void far_until_the_other_comes(void)
{
    for (int k = 0; k < 2; k++) {
        scene *s = scene_create();
        const int rests = scene_body(s, 1, 0.1, 0, 0, 0), comes = scene_body(s, 1, 0.1, 40, 0, 0);
        const int a = scene_circle(s, scene_point(s, rests, 0, 0), 0.5),
                  b = scene_circle(s, scene_point(s, comes, 0, 0), 0.5);
        scene_start_velocity(s, scene_point(s, comes, 0, 0), -13, 0);
        const int contact =
            scene_contact(s, PM_CONTACT_CIRCLE, k ? a : b, k ? b : a, 1, 1, PM_FRICTION_SMOOTH, 0);
        const int struck = scene_on(s, PM_TRIGGER_STRIKE, contact);
        const int t = scene_ask_event(s, scene_read(s, scene_time(s)), struck, 1, 0),
                  count = scene_ask_count(s, struck);
        *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_RK;
        scene_set(s, PM_SETTING_GRAVITY_Y, 0);
        whirl(s);
        scene_until_time(s, 3.5);
        EQUAL(scene_run(s, NULL), PM_OK);
        CHECK(s->count[PM_COUNT_STEPS] > 200);
        EQUAL(s->out[count], 1);
        NEAR(s->out[t], 3, 1e-10);
        scene_free(s);
    }
}

/* A small ball comes to a small peg, at a constant speed or falling: no step carries it through between two samples. */
static void small_and_fast(void)
{
    const double radii = 0.01, speed = 13;
    for (int k = 0; k < 40; k++) {
        const int falls = k % 2;
        const double way = 0.3 + 0.23 * k;
        scene *s = scene_create();
        const int ball = scene_body(s, 1, 0.1, 0, way + radii, 0);
        const int peg = scene_body(s, 1, 0.1, 0, 0, 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, peg, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
        scene_point(s, peg, 20, 0); /* the scene is much larger than the way */
        const int a = scene_circle(s, scene_point(s, ball, 0, 0), 0.6 * radii),
                  b = scene_circle(s, scene_point(s, peg, 0, 0), 0.4 * radii);
        const int contact = scene_contact(s, PM_CONTACT_CIRCLE, a, b, 1, 1, PM_FRICTION_SMOOTH, 0);
        const int struck = scene_on(s, PM_TRIGGER_STRIKE, contact);
        const int t = scene_ask_event(s, scene_read(s, scene_time(s)), struck, 1, 0),
                  count = scene_ask_count(s, struck);
        scene_start_velocity(s, scene_point(s, ball, 0, 0), 0, falls ? 0 : -speed);
        if (!falls) scene_set(s, PM_SETTING_GRAVITY_Y, 0);
        scene_until_time(s, 1.1 * (falls ? sqrt(2 * way / 9.81) : way / speed));
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[count], 1);
        NEAR(s->out[t], falls ? sqrt(2 * way / 9.81) : way / speed, 1e-11);
        CHECK(s->count[PM_COUNT_STEPS] < 60);
        scene_free(s);
    }
}

/* A particle that parts from a little below the floor, as deep as touching allows and deeper than it will rise: it strikes again
 * when it is back where it was. */
static void parts_from_too_deep(int route)
{
    static const double depth[] = {0, 5e-12, 2e-11, 6e-11};
    for (int k = 0; k < 4; k++) {
        const double v = 1e-5;
        scene *s = scene_create();
        const int b = scene_body(s, 1, 0, 0, -depth[k], 0), c = scene_point(s, b, 0, 0);
        scene_point(s, PM_GROUND, 1, 1); /* it gives the scene its size */
        const int floor = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, c, 0), scene_floor(s, 0), 0, 0.5,
                                        PM_FRICTION_SMOOTH, 0);
        const int t = scene_ask_measure(s, scene_time(s));
        scene_start_velocity(s, c, 0, v);
        scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, floor), 1);
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[t], 2 * v / 9.81, 1e-9);
        scene_free(s);
    }
}

/* A block is pushed by a hair more than friction holds, and ever less: it slips for so short a time that no slip shows, and is held
 * until the push has turned round.  Then it slides back. */
static void slips_for_an_instant(int route)
{
    const double m = check_random(0.5, 5), mu = check_random(0.1, 0.8), hold = mu * m * 9.81,
                 rate = hold * check_random(10, 40), hair = exp(check_random(log(1e-10), log(1e-8)));
    const double back = (2 + hair) * hold / rate, end = check_random(1.2, 1.5) * back;
    scene *s = scene_create();
    const int p = scene_point(s, scene_body(s, m, 0, 0, 0, 0), 0, 0), t = scene_time(s);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0), scene_floor(s, 0), 0, 0, PM_FRICTION_COULOMB,
                  mu);
    scene_applied(s, p, PM_GROUND,
                  SCENE_PROGRAM(s, scene_k(s, (1 + hair) * hold), scene_m(t), scene_k(s, rate),
                                scene_op(PM_OP_MUL), scene_op(PM_OP_SUB)),
                  SCENE_PROGRAM(s, scene_k(s, 0)));
    scene_until_time(s, end);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, p, PM_PART_X));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[x], -rate / m * pow(end - back, 3) / 6, 1e-8);
    scene_free(s);
}

/* ---- ties ---- */
/* A ball that is thrown and turns, until what drives it changes at T: by the time, or where it is down.  What is zero there, but
 * for rounding, fires once: its place, its angle, or the time. */
static void fires_where_a_phase_ends(int route, int by_time, int what)
{
    const double height = check_random(0.1, 3), t = sqrt(2 * height / G), at = check_random(-5, 5),
                 speed = check_random(-3, 3), spin = check_random(-3, 3), off = check_random(-4e-16, 4e-16);
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int ball = scene_body(s, 1, 1, at, height, 0), centre = scene_point(s, ball, 0, 0),
              time = scene_time(s), up = scene_part(s, PM_MEASURE_POSITION, centre, PM_PART_Y);
    const int drives = SCENE_PROGRAM(s, scene_m(by_time ? time : up), scene_k(s, by_time ? t : 0),
                                     scene_op(by_time ? PM_OP_GT : PM_OP_LT), scene_k(s, check_random(-3, 3)),
                                     scene_op(PM_OP_MUL));
    scene_applied(s, centre, PM_GROUND, drives, drives);
    scene_start_velocity(s, centre, speed, 0);
    scene_start_omega(s, ball, spin);
    const int along = scene_part(s, PM_MEASURE_POSITION, centre, PM_PART_X),
              turned = scene_measure(s, PM_MEASURE_TURNED, ball);
    const int watched[] = {along, turned, time};
    const double zero[] = {at + speed * t, spin * t, t}, rate[] = {speed, spin, 1};
    const int event = scene_when(s, rate[what] > 0 ? PM_TRIGGER_RISE : PM_TRIGGER_FALL,
                                 scene_minus(s, watched[what], zero[what] * (1 + off)));
    const int count = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, event));
    scene_until_time(s, 1.05 * t);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[count], 1);
    scene_free(s);
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int k = 0; k < 360; k++) fires_where_a_phase_ends(routes[k % 3], k / 3 % 2, k / 6 % 3);
    for (int i = 0; i < 100; i++) slips_for_an_instant(i % 2 ? PM_ROUTE_RK : PM_ROUTE_AUTO);
    parts_from_too_deep(PM_ROUTE_RK);
    parts_from_too_deep(PM_ROUTE_IDA);
    parts_from_too_deep(PM_ROUTE_UNIFORM);
    once_in_long_steps();
    at_ends_of_steps();
    corner_comes_first();
    far_until_a_turn_is_over();
    far_until_the_other_comes();
    small_and_fast();
    return check_failures();
}
