/* Friction of joints against closed forms, on the routes that do it: bearings between bodies that both turn, bearings
 * that rub by their load, constant or not, sliders on a body that moves, a pendulum that stops and starts again, and what routes refuse. */
#include "check.h"
#include "scene.h"

#define G 9.81

/* Two disks on one axle, one spins: the couple between them passes on its angular momentum until both turn alike. */
static void two_disks(int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const double ia = 0.3, ib = 0.2, omega = -7, couple = 0.4, close = route == PM_ROUTE_IDA ? 1e-6 : 1e-10;
    const int a = scene_body(s, 1, ia, 0, 0, 0), b = scene_body(s, 2, ib, 0, 0, 0);
    const int pa = scene_point(s, a, 0, 0);
    scene_joint(s, PM_JOINT_PIN, pa, scene_point(s, PM_GROUND, 0, 0), 0);
    const int pin = scene_joint(s, PM_JOINT_PIN, scene_point(s, b, 0, 0), pa, 0);
    scene_force(s, PM_FORCE_FRICTION, pin, pin, couple, 0);
    scene_start_omega(s, a, 0);
    scene_start_omega(s, b, omega);
    scene_until_time(s, 4);
    const int turned_a = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, a));
    const int turned_b = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, b));
    const int spin = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, a));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double common = ib * omega / (ia + ib), time = ia * -common / couple;
    NEAR(s->out[spin], common, close);
    NEAR(s->out[turned_a], common * (4 - 0.5 * time), 4 * close);
    NEAR(s->out[turned_b], 0.5 * (omega + common) * time + common * (4 - time), 4 * close);
    CHECK(s->audit[PM_AUDIT_MOMENTUM] < 1e-10);
    scene_free(s);
}

/* A couple c = r t (1 - t/T) lets go of a bearing where it is M, t1, and the bearing stops the disk where the spin, which goes
 * with (t - t1)^2 (t2 - t), is nothing again: t2 = 3 T/2 - 2 t1. */
static void lets_go_and_stops(int route)
{
    const double m = 0.8, r = 4, t1 = 0.5 * (1 - sqrt(1 - 4 * m / r));
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int a = scene_body(s, 1, 0.2, 0, 0, 0), time = scene_time(s);
    const int pin = scene_joint(s, PM_JOINT_PIN, scene_point(s, a, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_force(s, PM_FORCE_FRICTION, pin, pin, m, 0);
    scene_couple(s, a, PM_GROUND,
                 SCENE_PROGRAM(s, scene_m(time), scene_k(s, r), scene_op(PM_OP_MUL), scene_k(s, 1),
                               scene_m(time), scene_op(PM_OP_SUB), scene_op(PM_OP_MUL)));
    const int slips = scene_on(s, PM_TRIGGER_JOINT_SLIP, pin),
              sticks = scene_on(s, PM_TRIGGER_JOINT_STICK, pin);
    const int from = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_TIME, slips));
    const int to = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_TIME, sticks));
    scene_until(s, sticks, 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[from], t1, 1e-9);
    NEAR(s->out[to], 1.5 - 2 * t1, 1e-9);
    scene_free(s);
}

/* A torsion spring against the couple: each half swing is 2 M/k shorter. */
static void swings(int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const double k = 10, m = 0.8, inertia = 0.5;
    const int a = scene_body(s, 1, inertia, 0, 0, 1);
    const int pin = scene_joint(s, PM_JOINT_PIN, scene_point(s, PM_GROUND, 0, 0), scene_point(s, a, 0, 0), 0);
    scene_force(s, PM_FORCE_FRICTION, pin, pin, m, 0);
    scene_force(s, PM_FORCE_TORSION, a, PM_GROUND, k, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_REST, a), 1);
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, a));
    const int time = scene_ask_measure(s, scene_time(s));
    const int couple = scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_COUPLE, pin));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double close = route == PM_ROUTE_IDA ? 1e-5 : 1e-9, left = 1 - 6 * 2 * m / k;
    NEAR(s->out[angle], left, close);
    NEAR(s->out[time], 6 * 0.5 * 6.283185307179586 * sqrt(inertia / k), 10 * close);
    NEAR(s->out[couple], -k * left, 10 * k * close); /* on the ground, its first partner */
    scene_free(s);
}

/* A block slides on a plank that is free to run: their friction goes with the block's weight, and they end up together. */
static void on_a_plank(int route, double sense)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const double m = 2, plank_mass = 3, mu = 0.25, v = 4 * sense;
    const int plank = scene_body(s, plank_mass, 1, 0, 0, 0), block = scene_body(s, m, 0, 0, 0, 0);
    const int line = scene_line(s, scene_point(s, plank, 0, 0), 0);
    const int ground = scene_line(s, scene_point(s, PM_GROUND, 0, 0), 0);
    const int pb = scene_point(s, block, 0, 0), pp = scene_point(s, plank, 0, 0);
    scene_joint(s, PM_JOINT_SLIDER_FIXED, pp, ground, 0);
    const int slide = scene_joint(s, PM_JOINT_SLIDER, pb, line, 0);
    scene_force(s, PM_FORCE_FRICTION, slide, slide, 0, mu);
    scene_start_velocity(s, pb, v, 0);
    scene_start_velocity(s, pp, 0, 0);
    scene_until_time(s, 2);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_MOVED, pb, PM_PART_X));
    const int y = scene_ask_measure(s, scene_part(s, PM_MEASURE_MOVED, pp, PM_PART_X));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double common = m * v / (m + plank_mass), time = fabs(v - common) / (mu * G);
    CHECK(time < 2);
    NEAR(s->out[x], 0.5 * (v + common) * time + common * (2 - time), 1e-9);
    NEAR(s->out[y], 0.5 * common * time + common * (2 - time), 1e-9);
    scene_free(s);
}

/* Pushed into its slider as strongly as it is pulled along: the reaction changes its sign, friction does not. */
static void pressed(double press)
{
    scene *s = scene_create();
    const double m = 2, mu = 0.3, pull = 30;
    const int body = scene_body(s, m, 0, 0, 0, 0), p = scene_point(s, body, 0, 0);
    const int line = scene_line(s, scene_point(s, PM_GROUND, 0, 0), 0);
    const int slide = scene_joint(s, PM_JOINT_SLIDER, p, line, 0);
    scene_force(s, PM_FORCE_FRICTION, slide, slide, 0, mu);
    scene_applied(s, p, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, pull)), SCENE_PROGRAM(s, scene_k(s, press)));
    scene_until_time(s, 1);
    const int v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_X));
    const int rub = scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_FRICTION, slide));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double friction = mu * fabs(m * G - press);
    NEAR(s->out[v], fmax(0, (pull - friction) / m), 1e-10);
    NEAR(s->out[rub], -fmin(friction, pull), 1e-10);
    scene_free(s);
}

/* A cord's load on a bearing that rubs by it: I a/R = T R - c (W + T), T = m (g - a). */
static void by_load(int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const double r = 0.2, drum = 4, inertia = 0.08, m = 3, c = 0.03;
    const int a = scene_body(s, drum, inertia, 0, 0, 0), b = scene_body(s, m, 0, r, -2, 0);
    const int pa = scene_point(s, a, 0, 0), pb = scene_point(s, b, 0, 0);
    const int pin = scene_joint(s, PM_JOINT_PIN, pa, scene_point(s, PM_GROUND, 0, 0), 0);
    scene_cord(s, scene_circle(s, pa, r), -1, scene_circle(s, pb, 0), 1, 0, 0);
    scene_force(s, PM_FORCE_FRICTION, pin, pin, 0, c);
    scene_until_time(s, 1);
    const int v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, pb, PM_PART_Y));
    const int couple = scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_COUPLE, pin));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double fall = (m * G * (r - c) - c * drum * G) / (inertia / r + m * (r - c));
    NEAR(s->out[v], -fall, 1e-10);
    NEAR(s->out[couple], c * (drum * G + m * (G - fall)), 1e-10);
    scene_free(s);
}

/* ---- a pendulum whose bearing rubs by a load that changes ---- */
typedef struct pendulum {
    double mass, inertia, arm, factor; /* c: friction couple of a unit load, m */
} pendulum;

/* Moments about the bearing: (I + m l^2) a = -m g l cos(angle) - sgn(w) c |R|, with R = m (acceleration - g). */
static double acceleration(const pendulum *p, double angle, double w)
{
    double a = 0;
    for (int i = 0; i < 60; i++) { /* c m l / (I + m l^2) is small: each time a twentieth is left */
        const double along = p->mass * (G * sin(angle) - p->arm * w * w),
                     across = p->mass * (G * cos(angle) + p->arm * a);
        a = (-p->mass * G * p->arm * cos(angle) - copysign(p->factor, w) * hypot(along, across)) /
            (p->inertia + p->mass * p->arm * p->arm);
    }
    return a;
}

/* By Runge and Kutta's classical steps, from the horizontal; x: angle and rate. */
static void step_pendulum(const pendulum *p, double time, double x[2])
{
    enum { STEPS = 4000 };
    const double h = time / STEPS;
    for (int n = 0; n < STEPS; n++) {
        double k[4][2], weight[4] = {1, 2, 2, 1};
        for (int i = 0; i < 4; i++) {
            const double part = i == 0 ? 0 : i == 3 ? h : 0.5 * h, *before = k[i > 0 ? i - 1 : 0];
            const double angle = x[0] + (i ? part * before[0] : 0), w = x[1] + (i ? part * before[1] : 0);
            k[i][0] = w;
            k[i][1] = acceleration(p, angle, w);
        }
        for (int i = 0; i < 4; i++)
            for (int c = 0; c < 2; c++) x[c] += h / 6 * weight[i] * k[i][c];
    }
}

static void swings_by_load(int route, double start)
{
    const pendulum p = {2, 0.02, 0.4, 0.02};
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int a = scene_body(s, p.mass, p.inertia, p.arm, 0, 0);
    const int pin =
        scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -p.arm, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_force(s, PM_FORCE_FRICTION, pin, pin, 0, p.factor);
    scene_start_omega(s, a, start);
    scene_until_time(s, 0.5);
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, a)),
              omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, a));
    double x[2] = {0, start};
    step_pendulum(&p, 0.5, x);
    CHECK(x[1] * start > 0); /* one phase: it does not stop */
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->count[PM_COUNT_ROUTE], route);
    NEAR(s->out[angle], x[0], 1e-8);
    NEAR(s->out[omega], x[1], 1e-8);
    scene_free(s);
}

/* Friction is a number that is not negative, of a joint that leaves one way to slip. */
static void bad(int kind, double size, double factor, int wanted)
{
    scene *s = scene_create();
    const int a = scene_body(s, 1, 1, 0, 0, 0);
    const int joint = scene_joint(s, kind, scene_point(s, a, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_force(s, PM_FORCE_FRICTION, joint, joint, size, factor);
    scene_until_time(s, 1);
    scene_ask_measure(s, scene_time(s));
    EQUAL(scene_run(s, NULL), wanted);
    EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_FORCE);
    scene_free(s);
}

int main(void)
{
    lets_go_and_stops(PM_ROUTE_RK);
    lets_go_and_stops(PM_ROUTE_AUTO);
    static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int i = 0; i < 3; i++) {
        two_disks(routes[i]);
        swings(routes[i]);
        by_load(routes[i]);
        on_a_plank(routes[i], 1);
        on_a_plank(routes[i], -1);
    }
    for (int i = 1; i < 3; i++) {
        swings_by_load(routes[i], -12);
        swings_by_load(routes[i], 20);
    }
    pressed(0);
    pressed(-10);
    pressed(60);
    pressed(200);
    bad(PM_JOINT_PIN, -1, 0, PM_BAD_VALUE);
    bad(PM_JOINT_PIN, 1, -1e-3, PM_BAD_VALUE);
    bad(PM_JOINT_WELD, 1, 0, PM_BAD_TABLE);
    return check_failures();
}
