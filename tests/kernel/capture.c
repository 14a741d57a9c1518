/* Contacts that capture: momenta about the place of capture, closed forms of bullets, hooks and packages, points that
 * meet, turned and mirrored scenes, the routes after a capture against each other. */
#include "check.h"
#include "elements/constraint.h"
#include "impact/impact.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define CLOSE 1e-11
#define MOST 6

static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};

static void routes_agree(double got, double expected, double tolerance) { NEAR(got, expected, tolerance); }

/* ---- a bullet flies into a pinned rod ---- */
typedef struct view {
    double turn, mirror;
} view;

static void seen(const view *x, double a, double b, double out[2])
{
    const double mx = x->mirror * a;
    out[0] = cos(x->turn) * mx - sin(x->turn) * b;
    out[1] = sin(x->turn) * mx + cos(x->turn) * b;
}

/* The rod hangs from the origin; the bullet comes from the left and is at its foot after 0.3 s.  H about the pin and the
 * energy give all: omega = m v L / I with I = M L^2/3 + m L^2, until the rod has turned by 1. */
static void bullet(const view *x, int route, int capture)
{
    const double rod = 4, l = 1.2, m = 0.3, v = 9, inertia = rod * l * l / 3 + m * l * l;
    const double omega = m * v * l / inertia, close = route == PM_ROUTE_IDA ? 1e-6 : 1e-9;
    double at[2], foot[2], u[2];
    seen(x, 0, -l / 2, at);
    seen(x, -0.3 * v, -l, foot);
    seen(x, v, 0, u);
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int a = scene_body(s, rod, rod * l * l / 12, at[0], at[1], x->turn);
    const int b = scene_body(s, m, 0, foot[0], foot[1], 0);
    const int centre = scene_point(s, b, 0, 0), end = scene_point(s, a, 0, -l / 2);
    const int pin =
        scene_joint(s, PM_JOINT_PIN, scene_point(s, a, 0, l / 2), scene_point(s, PM_GROUND, 0, 0), 0);
    const int hit =
        scene_capture(s, PM_CONTACT_POINT, scene_circle(s, centre, 0), scene_circle(s, end, 0), 0, capture);
    scene_start_velocity(s, centre, u[0], u[1]);
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, hit), spin = scene_measure(s, PM_MEASURE_OMEGA, a);
    const int turned = scene_measure(s, PM_MEASURE_TURNED, a);
    scene_until(s,
                scene_when(s, PM_TRIGGER_CROSS,
                           SCENE_PROGRAM(s, scene_m(turned), scene_k(s, x->mirror), scene_op(PM_OP_SUB))),
                1);
    const int time = scene_ask_event(s, scene_read(s, scene_time(s)), strike, 1, 0);
    const int after = scene_ask_event(s, scene_read(s, spin), strike, 1, 0);
    const int lost =
        scene_ask_event(s, scene_read(s, scene_measure(s, PM_MEASURE_LOST, PM_NONE)), strike, 1, 0);
    int blow[2], reaction[2], force[2];
    for (int k = 0; k < 2; k++) {
        const int part = k ? PM_PART_Y : PM_PART_X;
        blow[k] = scene_ask_event(s, scene_read(s, scene_part(s, PM_MEASURE_CONTACT_IMPULSE, hit, part)),
                                  strike, 1, 0);
        reaction[k] = scene_ask_event(s, scene_read(s, scene_part(s, PM_MEASURE_JOINT_IMPULSE, pin, part)),
                                      strike, 1, 0);
        force[k] = scene_ask_measure(s, scene_part(s, PM_MEASURE_CONTACT_FORCE, hit, part));
    }
    const int end_spin = scene_ask_measure(s, spin);
    const int closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, hit));
    const int strikes = scene_ask_count(s, strike);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[time], 0.3, close);
    NEAR(s->out[after], x->mirror * omega, close * omega);
    NEAR(s->out[lost], 0.5 * (m * v * v - inertia * omega * omega), close * m * v * v);
    double p[2], r[2], f[2];
    seen(x, m * (l * omega - v), 0, p);
    seen(x, (rod * l / 2 + m * l) * omega - m * v, 0, r);
    seen(x, -m * l * omega * omega * sin(1), m * l * omega * omega * cos(1), f);
    for (int k = 0; k < 2; k++) {
        NEAR(s->out[blow[k]], p[k], close * m * v);
        NEAR(s->out[reaction[k]], r[k], close * m * v);
        NEAR(s->out[force[k]], f[k], 1e2 * close * m * v);
    }
    routes_agree(s->out[end_spin], x->mirror * omega, close * omega);
    EQUAL(s->out[closed], 1);
    EQUAL(s->out[strikes], 1);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-8 && s->audit[PM_AUDIT_MOMENTUM] < 1e-8);
    scene_free(s);
}

/* ---- two free bodies ---- */
/* Momentum of a body about p with velocities v: x, y, angular. */
static void momentum(const pm_workspace *w, int body, const double *v, const double *p, double out[3])
{
    const double m = w->numbers.mass[body], *q = w->state.q + 3 * body, *u = v + 3 * body;
    out[0] = m * u[0];
    out[1] = m * u[1];
    out[2] = (q[0] - p[0]) * out[1] - (q[1] - p[1]) * out[0];
    if (w->numbers.inverse_mass[3 * body + 2] > 0) out[2] += u[2] / w->numbers.inverse_mass[3 * body + 2];
}

/* Velocity at p of body a relative to b. */
static void relative(const pm_workspace *w, const double *v, const double *p, double out[2])
{
    const double *qa = w->state.q, *qb = qa + 3, *va = v, *vb = v + 3;
    out[0] = va[0] - va[2] * (p[1] - qa[1]) - (vb[0] - vb[2] * (p[1] - qb[1]));
    out[1] = va[1] + va[2] * (p[0] - qa[0]) - (vb[1] + vb[2] * (p[0] - qb[0]));
}

/* Places mark (x, y) of a body, turned by angle, at p. */
static int body_at(scene *s, double mass, double inertia, const double *p, double angle, double x, double y)
{
    return scene_body(s, mass, inertia, p[0] - cos(angle) * x + sin(angle) * y,
                      p[1] - sin(angle) * x - cos(angle) * y, angle);
}

/* Two bodies that touch at p, with any velocities: what is kept about p, and what is not left over. */
static void free_bodies(int kind, int capture, int particle)
{
    const double p[2] = {check_random(-1, 1), check_random(-1, 1)}, n = check_random(-3, 3);
    const double ra = kind == PM_CONTACT_POINT || particle ? 0 : 0.3,
                 rb = kind == PM_CONTACT_CIRCLE ? 0.7 : 0;
    const double angle[2] = {check_random(-3, 3), check_random(-3, 3)};
    /* n: direction of the normal from b to a */
    const double ca[2] = {p[0] + ra * cos(n), p[1] + ra * sin(n)},
                 cb[2] = {p[0] - rb * cos(n), p[1] - rb * sin(n)};
    const double mark[4] = {particle ? 0 : 0.4, particle ? 0 : -0.2, 0.1, 0.5};
    scene *s = scene_create();
    const int a = body_at(s, 1.3, particle ? 0 : 0.4, ca, particle ? 0 : angle[0], mark[0], mark[1]);
    const int b = body_at(s, 2.1, 0.9, cb, angle[1], mark[2], mark[3]);
    const int pa = scene_point(s, a, mark[0], mark[1]), pb = scene_point(s, b, mark[2], mark[3]);
    const int other =
        kind == PM_CONTACT_LINE ? scene_line(s, pb, n - acos(0.) - angle[1]) : scene_circle(s, pb, rb);
    const int hit = scene_capture(s, kind, scene_circle(s, pa, ra), other, 1, capture);
    double v[MOST], before[2][3], after[2][3], u[2];
    for (int i = 0; i < MOST; i++) v[i] = i == 2 && particle ? 0 : check_random(-2, 2);
    scene_until_time(s, 1);
    EQUAL(scene_open(s), PM_OK);
    pm_workspace *w = s->w;
    static const double none = 0;
    pm_start_report report;
    EQUAL(pm_run_start(w, &none, &report), PM_OK); /* at rest: caught without a blow */
    EQUAL(w->result.count[PM_COUNT_JUMPS], 0);
    EQUAL(w->state.slot[hit].mode, PM_CAPTURED);
    relative(w, v, p, u);
    if (kind != PM_CONTACT_POINT && u[0] * cos(n) + u[1] * sin(n) > 0) /* towards each other */
        for (int i = 0; i < MOST; i++) v[i] = -v[i];
    w->state.slot[hit].mode = PM_OPEN;
    memcpy(w->state.v, v, sizeof v);
    w->numbers.speed = 2;
    pm_frame_look_state(&w->frame, &w->state);
    int jumped;
    EQUAL(pm_impact(w, &jumped), PM_OK);
    EQUAL(jumped, 1);
    EQUAL(w->state.slot[hit].mode, PM_CAPTURED);
    const double *impulse = w->impulses.slot + 2 * hit;
    for (int i = 0; i < 2; i++) {
        momentum(w, i, v, p, before[i]);
        momentum(w, i, w->state.v, p, after[i]);
        for (int k = 0; k < 2; k++) NEAR(after[i][k] - before[i][k], (i ? -1 : 1) * impulse[k], CLOSE);
        if (capture == PM_CAPTURE_POINT || particle) NEAR(after[i][2], before[i][2], CLOSE);
    }
    NEAR(after[0][2] + after[1][2], before[0][2] + before[1][2], CLOSE);
    relative(w, w->state.v, p, u);
    NEAR(hypot(u[0], u[1]), 0, CLOSE);
    if (capture == PM_CAPTURE_BODY && !particle) NEAR(w->state.v[2], w->state.v[5], CLOSE);
    CHECK(w->impulses.energy_lost > 0);
    scene_free(s);
}

/* Two bodies in a row, held as one from the start on, of which b is turned: what turns a goes through the place of contact. */
static void couple_between(int route)
{
    scene *s = scene_create();
    const double ma = 1.3, mb = 2.1, ia = 0.4, ib = 0.9, size = 0.7;
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int a = scene_body(s, ma, ia, 0, 0, 0), b = scene_body(s, mb, ib, 1, 0, 0);
    const int hit = scene_capture(s, PM_CONTACT_POINT, scene_circle(s, scene_point(s, a, 0.4, 0), 0),
                                  scene_circle(s, scene_point(s, b, -0.6, 0), 0), 1, PM_CAPTURE_BODY);
    scene_couple(s, b, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, size)));
    scene_until_time(s, 0.5);
    const int couple = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_COUPLE, hit));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double middle = mb / (ma + mb), alpha = size / (ia + ib + ma * mb / (ma + mb));
    NEAR(s->out[couple], alpha * (ia + ma * 0.4 * middle), 1e-7);
    scene_free(s);
}

/* ---- what stands beside ---- */
/* A rod on a pin at its middle has caught a lump at one end; it rests when another flies against the other end.  The first
 * takes part in that blow: H = m v L/2 = (M L^2/12 + 2 m L^2/4) omega, and it gets m omega L/2. */
static void second_lump(int capture, int route)
{
    const double rod = 2, l = 1.4, m = 0.5, v = 3,
                 omega = 0.5 * m * v * l / (rod * l * l / 12 + 0.5 * m * l * l);
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int a = scene_body(s, rod, rod * l * l / 12, 0, 0, 0);
    const int first = scene_body(s, m, 0, -l / 2, 0, 0), second = scene_body(s, m, 0, l / 2, -0.6, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    int hit[2], impulse[2];
    for (int i = 0; i < 2; i++) {
        const int lump = scene_circle(s, scene_point(s, i ? second : first, 0, 0), 0);
        const int end = scene_circle(s, scene_point(s, a, i ? l / 2 : -l / 2, 0), 0);
        hit[i] = scene_capture(s, PM_CONTACT_POINT, lump, end, 0, capture);
    }
    scene_start_velocity(s, scene_point(s, second, 0, 0), 0, v);
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, hit[1]);
    for (int i = 0; i < 2; i++)
        impulse[i] = scene_ask_event(
            s, scene_read(s, scene_part(s, PM_MEASURE_CONTACT_IMPULSE, hit[i], PM_PART_Y)), strike, 1, 0);
    scene_until_time(s, 1);
    const int spin = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, a));
    const int held = scene_ask_measure(s, scene_part(s, PM_MEASURE_CONTACT_FORCE, hit[0], PM_PART_NORM));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double close = route == PM_ROUTE_IDA ? 1e-6 : 1e-9;
    routes_agree(s->out[spin], omega, close);
    NEAR(s->out[held], m * omega * omega * l / 2, close);
    NEAR(s->out[impulse[0]], -m * omega * l / 2, close);
    NEAR(s->out[impulse[1]], m * (omega * l / 2 - v), close);
    scene_free(s);
}

/* A hook with a given speed catches one end of a rod on a floor: (17.103) m v/3 by the hook, m v/6 by the floor below the
 * other end; with the floor above the rod (it would have to pull) the rod goes round its own G: m v/4 and nothing. */
static void hook(int below)
{
    const double m = 2.4, l = 0.9, v = 1.7;
    scene *s = scene_create();
    const int rod = scene_body(s, m, m * l * l / 12, 0, 0, 0), ring = scene_body(s, 5, 0, -l / 2, 0, 0);
    const int a = scene_point(s, rod, -l / 2, 0), b = scene_point(s, rod, l / 2, 0),
              c = scene_point(s, ring, 0, 0);
    const int up = SCENE_PROGRAM(s, scene_k(s, v)), none = SCENE_PROGRAM(s, scene_k(s, 0));
    const int drive = scene_drive(s, PM_JOINT_DRIVE, c, scene_point(s, PM_GROUND, 0, 0), none, up);
    const int caught =
        scene_capture(s, PM_CONTACT_POINT, scene_circle(s, a, 0), scene_circle(s, c, 0), 0, PM_CAPTURE_POINT);
    const int floor = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, b, 0),
                                    scene_floor(s, below ? 0 : 2 * acos(0.)), 0, 0, PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, scene_point(s, rod, 0, 0), 0, 0);
    scene_start_omega(s, rod, 0);
    scene_until(s, scene_when(s, PM_TRIGGER_START, PM_NONE), 1);
    const int pull = scene_ask_measure(s, scene_part(s, PM_MEASURE_CONTACT_IMPULSE, caught, PM_PART_Y));
    const int push = scene_ask_measure(s, scene_part(s, PM_MEASURE_CONTACT_IMPULSE, floor, PM_PART_Y));
    const int carried = scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_IMPULSE, drive, PM_PART_Y));
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, rod));
    EQUAL(scene_run(s, NULL), PM_NO_TIME_ROUTE);
    NEAR(s->out[pull], m * v / (below ? 3 : 4), CLOSE);
    NEAR(s->out[carried], m * v / (below ? 3 : 4), CLOSE);
    NEAR(s->out[push], below ? m * v / 6 : 0, CLOSE);
    NEAR(s->out[omega], -(below ? 1 : 1.5) * v / l, CLOSE);
    CHECK(s->audit[PM_AUDIT_ENERGY] < CLOSE && s->audit[PM_AUDIT_MOMENTUM] < CLOSE);
    scene_free(s);
}

/* A bat that is driven up at V strikes a ball that falls at v: the ball leaves at V + e (V + v), the bat keeps its speed, and
 * with e = 0 the ball rides on it.  The drive's work is in the ledger. */
static void driven_bat(double e)
{
    const double m = 0.4, v = 3, bat_speed = 2;
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int ball = scene_body(s, m, 0, 0, 1, 0), bat = scene_body(s, 5, 0, 0, 0, 0);
    const int c = scene_point(s, ball, 0, 0), p = scene_point(s, bat, 0, 0);
    const int up = SCENE_PROGRAM(s, scene_k(s, bat_speed)), none = SCENE_PROGRAM(s, scene_k(s, 0));
    const int drive = scene_drive(s, PM_JOINT_DRIVE, p, scene_point(s, PM_GROUND, 0, 0), none, up);
    const int hit = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, c, 0), scene_line(s, p, 0), 0, e,
                                  PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, c, 0, -v);
    scene_until_time(s, 0.5);
    const int after = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, c, PM_PART_Y));
    const int of_bat = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_Y));
    const int carried = scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_IMPULSE, drive, PM_PART_Y));
    const int closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, hit));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[after], bat_speed + e * (bat_speed + v), 1e-9);
    NEAR(s->out[of_bat], bat_speed, 1e-9);
    NEAR(s->out[carried], m * (1 + e) * (bat_speed + v), 1e-9);
    EQUAL(s->out[closed], e == 0);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9 && s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    scene_free(s);
}

/* A cube slides on a floor into an obstruction and goes round it as far as h = I omega^2 / (2 m g): rises until G is at
 * r sin(45 deg + theta); the floor below its other corner lets go.  The hinge pulls at first: no push could do it. */
static void package(int route)
{
    const double b = 0.5, m = 3, v = 1.6, g = 9.81, inertia = 2 * m * b * b / 3;
    const double omega = 0.5 * m * v * b / inertia, lift = inertia * omega * omega / (2 * m * g);
    const double r = b / sqrt(2), rest = atan2(1, 1), theta = asin(sin(rest) + lift / r) - rest;
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int cube = scene_body(s, m, m * b * b / 6, 0.2 + b / 2, b / 2, 0);
    const int corner = scene_point(s, cube, -b / 2, -b / 2), far = scene_point(s, cube, b / 2, -b / 2);
    const int floor = scene_floor(s, 0);
    const int trip = scene_capture(s, PM_CONTACT_POINT, scene_circle(s, corner, 0),
                                   scene_circle(s, scene_point(s, PM_GROUND, 0, 0), 0), 0, PM_CAPTURE_POINT);
    const int below =
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, far, 0), floor, 0, 0, PM_FRICTION_SMOOTH, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, corner, 0), floor, 0, 0, PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, scene_point(s, cube, 0, 0), -v, 0);
    const int spin = scene_measure(s, PM_MEASURE_OMEGA, cube), strike = scene_on(s, PM_TRIGGER_STRIKE, trip);
    scene_until(s, scene_when(s, PM_TRIGGER_FALL, scene_read(s, spin)), 1);
    const int time = scene_ask_event(s, scene_read(s, scene_time(s)), strike, 1, 0);
    const int after = scene_ask_event(s, scene_read(s, spin), strike, 1, 0);
    const int pulled = scene_ask_event(
        s, scene_read(s, scene_part(s, PM_MEASURE_CONTACT_FORCE, trip, PM_PART_X)), strike, 1, 0);
    const int pushed = scene_ask_event(
        s, scene_read(s, scene_part(s, PM_MEASURE_CONTACT_IMPULSE, below, PM_PART_Y)), strike, 1, 0);
    const int turned = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, cube));
    const int closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, below));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double close = route == PM_ROUTE_IDA ? 1e-6 : 1e-9;
    /* alpha = -m g (b/2) / I; the acceleration of G: alpha (-b/2, b/2) - omega^2 (b/2, b/2) */
    const double alpha = -m * g * b / 2 / inertia, ax = -0.5 * b * (alpha + omega * omega);
    NEAR(s->out[time], 0.2 / v, close);
    NEAR(s->out[after], omega, close);
    NEAR(s->out[pulled], m * ax, 1e2 * close);
    EQUAL(s->out[pushed], 0);
    EQUAL(s->out[closed], 0);
    routes_agree(s->out[turned], theta, 1e2 * close);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-8);
    scene_free(s);
}

/* A spinning disk falls on a post of an endless row, beside its middle: as a pin there it keeps its H about the post; as
 * one body with the ground it stands. */
static void post_of_a_row(int capture)
{
    const double r = 0.3, m = 2, inertia = 0.5 * m * r * r, v = 1.5, spin = 2, off = 0.2;
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int disk = scene_body(s, m, inertia, 7 + off, 1, 0), centre = scene_point(s, disk, 0, 0);
    const int row = SCENE_ROW(s, PM_TABLE_PATTERN, scene_point(s, PM_GROUND, 0, 0), scene_value(s, 1),
                              scene_value(s, 0), scene_value(s, -1));
    const int hit = scene_capture(s, PM_CONTACT_PATTERN, scene_circle(s, centre, r), row, 0, capture);
    scene_start_velocity(s, centre, 0, -v);
    scene_start_omega(s, disk, spin);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, hit), 1);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, disk));
    const int upward = scene_ask_measure(
        s, scene_measure_with(s, PM_MEASURE_CONTACT_IMPULSE, hit, PM_PART_Y, PM_MEASURE_MEMBER, 7));
    const int here = scene_ask_measure(
        s, scene_measure_with(s, PM_MEASURE_CONTACT_CLOSED, hit, PM_PART_NONE, PM_MEASURE_MEMBER, 7));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double after =
        capture == PM_CAPTURE_BODY ? 0 : (inertia * spin - off * m * v) / (inertia + m * r * r);
    NEAR(s->out[omega], after, 1e-9);
    NEAR(s->out[upward], m * (off * after + v), 1e-9);
    EQUAL(s->out[here], 1);
    scene_free(s);
}

/* ---- tables ---- */
static void refused(int kind, int capture, int friction)
{
    scene *s = scene_create();
    const int a = scene_body(s, 1, 1, 0, 1, 0), centre = scene_point(s, a, 0, 0);
    const int b = scene_point(s, PM_GROUND, 0, 0);
    const int other = kind == PM_CONTACT_LINE ? scene_line(s, b, 0) : scene_circle(s, b, 0);
    const int hit = scene_contact(s, kind, scene_circle(s, centre, 0), other, 1, 0, friction, 0.3);
    s->cell[PM_TABLE_CONTACT][hit * PM_CONTACT_COLUMNS + PM_CONTACT_CAPTURE] = capture;
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_BAD_TABLE);
    EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_CONTACT);
    scene_free(s);
}

int main(void)
{
    static const view views[] = {{0, 1}, {1.1, 1}, {0, -1}, {-2.3, -1}};
    static const int kinds[] = {PM_CONTACT_POINT, PM_CONTACT_LINE, PM_CONTACT_CIRCLE};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++) bullet(&views[k], routes[i], k % 2 ? PM_CAPTURE_BODY : PM_CAPTURE_POINT);
        package(routes[i]);
        second_lump(i % 2 ? PM_CAPTURE_BODY : PM_CAPTURE_POINT, routes[i]);
    }
    for (int i = 0; i < 200; i++)
        free_bodies(kinds[i % 3], i / 3 % 2 ? PM_CAPTURE_BODY : PM_CAPTURE_POINT, i / 6 % 2 && i % 3 < 2);
    driven_bat(0);
    driven_bat(0.6);
    driven_bat(1);
    post_of_a_row(PM_CAPTURE_POINT);
    post_of_a_row(PM_CAPTURE_BODY);
    hook(0);
    hook(1);
    refused(PM_CONTACT_POINT, PM_CAPTURE_NONE, PM_FRICTION_SMOOTH);
    refused(PM_CONTACT_LINE, PM_CAPTURE_BODY, PM_FRICTION_COULOMB);
    refused(PM_CONTACT_LINE, PM_CAPTURES, PM_FRICTION_SMOOTH);
    couple_between(PM_ROUTE_AUTO);
    couple_between(PM_ROUTE_RK);
    couple_between(PM_ROUTE_IDA);
    return check_failures();
}
