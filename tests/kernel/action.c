/* Actions of events: impulses against closed forms, the ledgers with them, work, elements that come and go, the order of
 * actions, the firing that counts, and one route against the other. */
#include "check.h"
#include "scene.h"

#define PI 3.14159265358979323846
#define GRAVITY 9.81

static int action(scene *s, int kind, int event, int table, int a, int x, int y)
{
    return SCENE_ROW(s, PM_TABLE_ACTION, kind, event, table, a, x, y);
}
static void add(scene *s, int event, int table, int row)
{
    action(s, PM_ACTION_ADD, event, table, row, PM_NONE, PM_NONE);
}
static void take(scene *s, int event, int table, int row)
{
    action(s, PM_ACTION_REMOVE, event, table, row, PM_NONE, PM_NONE);
}
static int number(scene *s, double x) { return SCENE_PROGRAM(s, scene_k(s, x)); }
static void strike(scene *s, int event, int point, double x, double y)
{
    action(s, PM_ACTION_IMPULSE, event, PM_NONE, point, number(s, x), number(s, y));
}
static void turn(scene *s, int event, int body, double x)
{
    action(s, PM_ACTION_ANGULAR, event, PM_NONE, body, number(s, x), PM_NONE);
}
static void work(scene *s, int event, int body, double x)
{
    action(s, PM_ACTION_WORK, event, PM_NONE, body, number(s, x), PM_NONE);
}
static int start_event(scene *s) { return scene_on(s, PM_TRIGGER_START, PM_NONE); }
static int at_time(scene *s, double t)
{
    return scene_when(s, PM_TRIGGER_RISE, scene_minus(s, scene_time(s), t));
}
static int ask_part(scene *s, int kind, int a, int part)
{
    return scene_ask_measure(s, scene_part(s, kind, a, part));
}
static int ask(scene *s, int kind, int a) { return ask_part(s, kind, a, PM_PART_NONE); }
static int ask_on(scene *s, int joint, int body)
{
    return scene_ask_measure(
        s, scene_measure_with(s, PM_MEASURE_JOINT_IMPULSE, joint, PM_PART_X, PM_MEASURE_ON, body));
}
static void closes(const scene *s)
{
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9);
    CHECK(s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    CHECK(s->audit[PM_AUDIT_CONSTRAINT] < 1e-9);
}

/* Nothing acts and nothing moves until an impulse sends a ball to a wall, by 1e-13 m in a second: it is no rest, and it
 * comes back.  In units in which it moves by a metre in a second it does the same. */
static void slow_start(void)
{
    for (int slow = 0; slow < 2; slow++) {
        const double unit = slow ? 1e13 : 1, e = 0.5; /* s */
        scene *s = scene_create();
        const int b = scene_body(s, 2, 0.1, 0, 1, 0), g = scene_point(s, b, 0, 0);
        scene_set(s, PM_SETTING_GRAVITY_Y, 0);
        scene_set(s, PM_SETTING_MAX_TIME, 10 * unit);
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, 0.5), scene_floor(s, 0), 0, e,
                      PM_FRICTION_SMOOTH, 0);
        strike(s, at_time(s, unit), g, 0, -2 / unit);
        const int vy = ask_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y);
        scene_until_time(s, 2 * unit);
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[vy] * unit, e, 1e-9);
        scene_free(s);
    }
}

/* A free slab off the origin takes two impulses and a couple at once: m v = P, I omega = r x P + C about G. */
static void free_slab(void)
{
    static const double p[2][2] = {{1.3, -0.4}, {0.2, 0.9}}, at[2][2] = {{0.3, 0.1}, {-0.2, 0.4}};
    const double m = 2.5, inertia = 0.37, couple = -0.11, turned = 0.6, c = cos(turned), si = sin(turned);
    scene *s = scene_create();
    const int b = scene_body(s, m, inertia, 3, -2, turned), g = scene_point(s, b, 0, 0), e = start_event(s);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    double spin = couple;
    for (int i = 0; i < 2; i++) {
        const double r[2] = {c * at[i][0] - si * at[i][1], si * at[i][0] + c * at[i][1]};
        spin += r[0] * p[i][1] - r[1] * p[i][0];
        strike(s, e, scene_point(s, b, at[i][0], at[i][1]), p[i][0], p[i][1]);
    }
    turn(s, e, b, couple);
    const int x = ask_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X),
              y = ask_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y);
    const int omega = ask(s, PM_MEASURE_OMEGA, b), lost = ask(s, PM_MEASURE_LOST, PM_NONE);
    scene_until_time(s, 0.8);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[x], (p[0][0] + p[1][0]) / m, 1e-13);
    NEAR(s->out[y], (p[0][1] + p[1][1]) / m, 1e-13);
    NEAR(s->out[omega], spin / inertia, 1e-12);
    NEAR(s->out[lost], 0, 1e-13);
    closes(s);
    scene_free(s);
}

/* Two hanging bars, struck at the free end: omega = -6 Q/(7 m L), 30 Q/(7 m L); the pins take -Q/7 and 2 Q/7 (on the
 * lower bar). */
static void hanging_bars(void)
{
    const double m = 1.4, l = 0.6, q = 0.83, inertia = m * l * l / 12;
    scene *s = scene_create();
    const int a = scene_body(s, m, inertia, 0, -l / 2, -PI / 2),
              b = scene_body(s, m, inertia, 0, -1.5 * l, -PI / 2);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -l / 2, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, l / 2, 0), scene_point(s, b, -l / 2, 0), 0);
    const int e = start_event(s);
    strike(s, e, scene_point(s, b, l / 2, 0), q, 0);
    scene_until(s, e, 1);
    const int oa = ask(s, PM_MEASURE_OMEGA, a), ob = ask(s, PM_MEASURE_OMEGA, b);
    const int before = scene_ask_event(s, scene_read(s, scene_measure(s, PM_MEASURE_OMEGA, b)), e, 1, 1);
    const int pa = ask_part(s, PM_MEASURE_JOINT_IMPULSE, 0, PM_PART_X), pb = ask_on(s, 1, b);
    const int lost = ask(s, PM_MEASURE_LOST, PM_NONE);
    EQUAL(scene_run(s, NULL), PM_NO_TIME_ROUTE);
    NEAR(s->out[oa], -6 * q / (7 * m * l), 1e-12);
    NEAR(s->out[ob], 30 * q / (7 * m * l), 1e-12);
    NEAR(s->out[pa], -q / 7, 1e-13);
    NEAR(s->out[pb], 2 * q / 7, 1e-13);
    NEAR(s->out[lost], 0, 1e-13);
    EQUAL(s->out[before], 0);
    closes(s);
    scene_free(s);
}

/* A wheel on its axle, geared to another: work W changes the energy of both by W, and the sense stays. */
static void geared_work(double spin, double amount)
{
    const double inertia[2] = {0.8, 0.3}, r[2] = {0.2, 0.1};
    const double all = inertia[0] + inertia[1] * r[0] * r[0] / (r[1] * r[1]);
    scene *s = scene_create();
    int circle[2], body[2];
    for (int i = 0; i < 2; i++) {
        body[i] = scene_body(s, 1, inertia[i], i * (r[0] + r[1]), 0, 0);
        const int g = scene_point(s, body[i], 0, 0);
        circle[i] = scene_circle(s, g, r[i]);
        scene_joint(s, PM_JOINT_PIN, g, scene_point(s, PM_GROUND, i * (r[0] + r[1]), 0), 0);
    }
    scene_joint(s, PM_JOINT_GEARS, circle[0], circle[1], 1);
    scene_start_omega(s, body[0], spin);
    const int e = start_event(s);
    work(s, e, body[0], amount);
    scene_until_time(s, 0.1);
    const int omega = ask(s, PM_MEASURE_OMEGA, body[0]), kinetic = ask(s, PM_MEASURE_KINETIC, PM_NONE);
    const int status = scene_run(s, NULL);
    const double square = spin * spin + 2 * amount / all;
    if (square < 0 || spin == 0) {
        EQUAL(status, PM_NO_IMPULSE);
        EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_ACTION);
        EQUAL(s->where[PM_WHERE_ROW], 0);
        EQUAL(s->detail[PM_DETAIL_VALUE], amount);
        if (spin != 0) NEAR(s->detail[PM_DETAIL_BOUND], -0.5 * all * spin * spin, 1e-10);
    } else {
        EQUAL(status, PM_OK);
        NEAR(s->out[omega], copysign(sqrt(square), spin), 1e-12);
        NEAR(s->out[kinetic], 0.5 * all * spin * spin + amount, 1e-11);
        closes(s);
    }
    scene_free(s);
}

/* A flying rod is pinned at its end when it is there: angular momentum about the pin is kept, the rest is lost; let go
 * again at once, it flies on freely. */
static void pinned_in_flight(int let_go)
{
    const double m = 1.7, l = 0.9, inertia = m * l * l / 12, vx = 0.7, vy = 1.9, spin = 2.2;
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int b = scene_body(s, m, inertia, 0, 0, 0), g = scene_point(s, b, 0, 0);
    const int pin =
        scene_joint(s, PM_JOINT_PIN, scene_point(s, b, l / 2, 0), scene_point(s, PM_GROUND, l / 2, 0), 0);
    take(s, PM_NONE, PM_TABLE_JOINT, pin);
    scene_start_velocity(s, g, vx, vy);
    scene_start_omega(s, b, spin);
    const int e = start_event(s);
    add(s, e, PM_TABLE_JOINT, pin);
    if (let_go) take(s, e, PM_TABLE_JOINT, pin);
    const double omega_1 = (inertia * spin - m * vy * l / 2) / (inertia + m * l * l / 4);
    const double kinetic = 0.5 * (m * (vx * vx + vy * vy) + inertia * spin * spin);
    const int omega = ask(s, PM_MEASURE_OMEGA, b), y = ask_part(s, PM_MEASURE_VELOCITY, g, PM_PART_NORM);
    const int lost = ask(s, PM_MEASURE_LOST, PM_NONE),
              force = ask_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_NORM);
    scene_until_time(s, 0.5);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[omega], omega_1, 1e-10);
    NEAR(s->out[y], fabs(omega_1) * l / 2, 1e-10);
    NEAR(s->out[lost], kinetic - 0.5 * (inertia + m * l * l / 4) * omega_1 * omega_1, 1e-11);
    NEAR(s->out[force], let_go ? 0 : m * omega_1 * omega_1 * l / 2, 1e-8);
    closes(s);
    scene_free(s);
}

/* Of a joint that is added its partners must be there. */
static void does_not_fit(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.1, 0, 0, 0);
    const int pin =
        scene_joint(s, PM_JOINT_PIN, scene_point(s, b, 0.5, 0), scene_point(s, PM_GROUND, 0.5, 0), 0);
    take(s, PM_NONE, PM_TABLE_JOINT, pin);
    const int e = at_time(s, 0.5);
    add(s, e, PM_TABLE_JOINT, pin);
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_ASSEMBLY);
    EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_ACTION);
    EQUAL(s->where[PM_WHERE_ROW], 1);
    NEAR(s->detail[PM_DETAIL_VALUE], 0.5 * GRAVITY * 0.25, 1e-9);
    NEAR(s->detail[PM_DETAIL_TIME], 0.5, 1e-12);
    scene_free(s);
}

static void overlaps(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.1, 0, 0.3, 0), circle = scene_circle(s, scene_point(s, b, 0, 0), 0.1);
    const int floor =
        scene_contact(s, PM_CONTACT_LINE, circle, scene_floor(s, 0), 0, 0, PM_FRICTION_SMOOTH, 0);
    take(s, PM_NONE, PM_TABLE_CONTACT, floor);
    add(s, at_time(s, 0.25), PM_TABLE_CONTACT, floor);
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_PENETRATION);
    EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_ACTION);
    NEAR(s->detail[PM_DETAIL_VALUE], 0.2 - 0.5 * GRAVITY * 0.0625, 1e-9);
    scene_free(s);
}

/* A ball bounces on a floor that is taken away at t1 and comes back at t2, below a second one. */
static void floors(int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int b = scene_body(s, 1, 0, 0, 1, 0), g = scene_point(s, b, 0, 0), circle = scene_circle(s, g, 0);
    const int high =
        scene_contact(s, PM_CONTACT_LINE, circle, scene_floor(s, 0), 0, 1, PM_FRICTION_SMOOTH, 0);
    const int low =
        scene_contact(s, PM_CONTACT_LINE, circle, scene_line(s, scene_point(s, PM_GROUND, 0, -1), 0), 0, 0,
                      PM_FRICTION_SMOOTH, 0);
    const int e = at_time(s, 0.5);
    take(s, PM_NONE, PM_TABLE_CONTACT, low);
    take(s, e, PM_TABLE_CONTACT, high);
    add(s, e, PM_TABLE_CONTACT, low);
    const int struck = scene_on(s, PM_TRIGGER_STRIKE, low);
    scene_until_time(s, 3);
    const double fall = sqrt(2 / GRAVITY), v = GRAVITY * fall,
                 from = 0.5 - fall; /* first strike before t = 0.5 */
    const int time = ask(s, PM_MEASURE_EVENT_TIME, struck),
              y = ask_part(s, PM_MEASURE_POSITION, g, PM_PART_Y);
    const int normal = ask(s, PM_MEASURE_CONTACT_NORMAL, low), none = ask(s, PM_MEASURE_CONTACT_CLOSED, high);
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(from > 0);
    NEAR(s->out[time], fall + (v + sqrt(v * v + 2 * GRAVITY)) / GRAVITY, 1e-9);
    NEAR(s->out[y], -1, 1e-11);
    NEAR(s->out[normal], GRAVITY, 1e-9);
    EQUAL(s->out[none], 0);
    closes(s);
    scene_free(s);
}

/* A spring holds a weight; taken away, the weight falls; its work stays what it was, and the ledger closes. */
static void spring_goes(void)
{
    const double m = 2, k = 40;
    scene *s = scene_create();
    const int b = scene_body(s, m, 0, 0, -1, 0), g = scene_point(s, b, 0, 0);
    const int spring = scene_force(s, PM_FORCE_SPRING, g, scene_point(s, PM_GROUND, 0, 0), k, 0.2);
    const int e = at_time(s, 0.4), again = at_time(s, 0.6);
    take(s, e, PM_TABLE_FORCE, spring);
    add(s, again, PM_TABLE_FORCE, spring);
    const int w = scene_measure(s, PM_MEASURE_FORCE_WORK, spring),
              y = scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y);
    const int v = scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y);
    const int y_1 = scene_ask_event(s, scene_read(s, y), e, 1, 0),
              v_1 = scene_ask_event(s, scene_read(s, v), e, 1, 0);
    const int w_1 = scene_ask_event(s, scene_read(s, w), e, 1, 0);
    const int y_2 = scene_ask_event(s, scene_read(s, y), again, 1, 1),
              w_2 = scene_ask_event(s, scene_read(s, w), again, 1, 1);
    const int v_3 = scene_ask_measure(s, v), y_3 = scene_ask_measure(s, y), w_3 = scene_ask_measure(s, w);
    scene_until_time(s, 0.9);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[y_2], s->out[y_1] + 0.2 * s->out[v_1] - 0.5 * GRAVITY * 0.04, 1e-9);
    NEAR(s->out[w_1], 0.5 * m * s->out[v_1] * s->out[v_1] + m * GRAVITY * (s->out[y_1] + 1), 1e-8);
    NEAR(s->out[w_2], s->out[w_1], 1e-12);
    NEAR(s->out[w_3], 0.5 * m * s->out[v_3] * s->out[v_3] + m * GRAVITY * (s->out[y_3] + 1), 1e-8);
    closes(s);
    scene_free(s);
}

/* What is pushed down on a floor stays; pushed up it flies; pushed along, a smooth floor carries nothing and a rough one
 * makes it roll: v = 2 P/(3 m) for a disk struck at its centre. */
static void resting_disk(int friction, double px, double py, double vx, double vy, double ix, double iy)
{
    const double m = 3, r = 0.2;
    scene *s = scene_create();
    const int b = scene_body(s, m, 0.5 * m * r * r, 0, r, 0), g = scene_point(s, b, 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, r), scene_floor(s, 0), 0, 0.7, friction, 0.1);
    const int e = start_event(s);
    strike(s, e, g, px, py);
    const int x = ask_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X),
              y = ask_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y);
    const int jx = ask_part(s, PM_MEASURE_CONTACT_IMPULSE, 0, PM_PART_X),
              jy = ask_part(s, PM_MEASURE_CONTACT_IMPULSE, 0, PM_PART_Y);
    scene_until(s, e, 1);
    EQUAL(scene_run(s, NULL), PM_NO_TIME_ROUTE);
    NEAR(s->out[x], vx, 1e-12);
    NEAR(s->out[y], vy, 1e-12);
    NEAR(s->out[jx], ix, 1e-12);
    NEAR(s->out[jy], iy, 1e-12);
    closes(s);
    scene_free(s);
}

/* A mass strikes a wall back and forth between two blows of an event that acts the third time only. */
static void third_time(void)
{
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int b = scene_body(s, 1, 0, 0.5, 0, 0), g = scene_point(s, b, 0, 0), circle = scene_circle(s, g, 0);
    const int left =
        scene_contact(s, PM_CONTACT_LINE, circle, scene_line(s, scene_point(s, PM_GROUND, 0, 0), -PI / 2), 0,
                      1, PM_FRICTION_SMOOTH, 0);
    scene_contact(s, PM_CONTACT_LINE, circle, scene_line(s, scene_point(s, PM_GROUND, 1, 0), PI / 2), 0, 1,
                  PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, g, -1, 0);
    const int e = SCENE_ROW(s, PM_TABLE_EVENT, 3, 0), passes = SCENE_ROW(s, PM_TABLE_EVENT, 0, 0);
    scene_trigger(s, PM_TRIGGER_STRIKE, e, PM_NONE, left);
    scene_trigger(s, PM_TRIGGER_STRIKE, passes, PM_NONE, left);
    strike(s, e, g, 1, 0);
    const int v = ask_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X), n = ask(s, PM_MEASURE_EVENT_COUNT, e);
    const int t = ask(s, PM_MEASURE_EVENT_TIME, e), all = ask(s, PM_MEASURE_EVENT_COUNT, passes);
    scene_until_time(s, 5.8);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[n], 1);
    NEAR(s->out[t], 4.5, 1e-10);
    NEAR(s->out[v], 2, 1e-10); /* twice as fast since then: at the right wall at 5, at the left one at 5.5 */
    EQUAL(s->out[all], 4);
    scene_free(s);
}

/* A double pendulum: the lower pin is let go at t = 0.4, a pull comes, a blow at 0.6; rk and IDA agree, and after the
 * release the lower bar's spin stays. */
static scene *double_pendulum(int route)
{
    const double m = 1, l = 0.8, inertia = m * l * l / 12;
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int a = scene_body(s, m, inertia, l / 2, 0, 0), b = scene_body(s, m, inertia, 1.5 * l, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -l / 2, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    const int pin =
        scene_joint(s, PM_JOINT_PIN, scene_point(s, a, l / 2, 0), scene_point(s, b, -l / 2, 0), 0);
    const int pull = scene_applied(s, scene_point(s, a, l / 2, 0), PM_GROUND, number(s, 3), number(s, 1));
    take(s, PM_NONE, PM_TABLE_FORCE, pull);
    const int e = at_time(s, 0.4), blow = at_time(s, 0.6);
    take(s, e, PM_TABLE_JOINT, pin);
    add(s, e, PM_TABLE_FORCE, pull);
    strike(s, blow, scene_point(s, a, l / 2, 0), -0.4, 0.2);
    const int ob = scene_measure(s, PM_MEASURE_OMEGA, b);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, a));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, a));
    scene_ask_measure(s, ob);
    scene_ask_event(s, scene_read(s, ob), e, 1, 1);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_FORCE_WORK, pull));
    scene_until_time(s, 1);
    return s;
}

static void routes_agree(void)
{
    scene *rk = double_pendulum(PM_ROUTE_RK), *ida = double_pendulum(PM_ROUTE_IDA);
    EQUAL(scene_run(rk, NULL), PM_OK);
    EQUAL(scene_run(ida, NULL), PM_OK);
    for (int i = 0; i < 5; i++) NEAR(rk->out[i], ida->out[i], 1e-7);
    NEAR(rk->out[2], rk->out[3], 1e-11);
    closes(rk);
    scene_free(rk);
    scene_free(ida);
}

int main(void)
{
    slow_start();
    free_slab();
    hanging_bars();
    geared_work(7, 3);
    geared_work(-7, -3);
    geared_work(2, -30);
    geared_work(0, 3);
    pinned_in_flight(0);
    pinned_in_flight(1);
    does_not_fit();
    overlaps();
    floors(PM_ROUTE_RK);
    floors(PM_ROUTE_UNIFORM);
    floors(PM_ROUTE_IDA);
    spring_goes();
    resting_disk(PM_FRICTION_SMOOTH, 1, 0, 1.0 / 3, 0, 0, 0);
    resting_disk(PM_FRICTION_ROUGH, 1, 0, 2.0 / 9, 0, -1.0 / 3, 0);
    resting_disk(PM_FRICTION_SMOOTH, 1, -2, 1.0 / 3, 0, 0, 2);
    resting_disk(PM_FRICTION_COULOMB, 1, -2, 0.8 / 3, 0, -0.2, 2); /* slides in the blow: mu 0.1 */
    resting_disk(PM_FRICTION_ROUGH, 1, 2, 1.0 / 3, 2.0 / 3, 0, 0);
    third_time();
    routes_agree();
    return check_failures();
}
