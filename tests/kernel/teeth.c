/* Teeth against closed forms, on the routes that do them: a couple that reverses loads the other flank, so that the wheels are
 * pressed apart by |F_t| tan(phi) throughout, with losses and without; the same of an impulse, and of a pinion on a rack. */
#include "check.h"
#include "scene.h"

#define PHI 0.35

static const double ra = 0.1, rb = 0.2, ia = 0.01, ib = 0.12, size = 3, quick = 20;

/* A couple size cos(quick t + 0.3) on wheel a, which meshes with b, on its right. */
static int swinging_couple(scene *s, int body)
{
    return scene_couple(s, body, PM_GROUND,
                        SCENE_PROGRAM(s, scene_k(s, quick), scene_m(scene_time(s)), scene_op(PM_OP_MUL),
                                      scene_k(s, 0.3), scene_op(PM_OP_ADD), scene_op(PM_OP_COS),
                                      scene_k(s, size), scene_op(PM_OP_MUL)));
}

typedef struct wheels {
    scene *s;
    int body[2], pin[2], mesh;
} wheels;

static wheels wheels_create(int route, double backlash)
{
    wheels x = {.s = scene_create()};
    const double inertia[2] = {ia, ib}, radius[2] = {ra, rb};
    int circle[2];
    scene_set(x.s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(x.s, PM_SETTING_ROUTE) = route;
    for (int i = 0; i < 2; i++) {
        const double at = i * (ra + rb);
        x.body[i] = scene_body(x.s, 1.3, inertia[i], at, 0, 0);
        const int g = scene_point(x.s, x.body[i], 0, 0);
        circle[i] = scene_circle(x.s, g, radius[i]);
        x.pin[i] = scene_joint(x.s, PM_JOINT_PIN, g, scene_point(x.s, PM_GROUND, at, 0), 0);
    }
    x.mesh = backlash > 0 ? scene_flanks(x.s, circle[0], circle[1], 1, PHI, backlash, 0.5)
                          : scene_teeth(x.s, circle[0], circle[1], 1, PHI);
    return x;
}

/* c: the couple of friction by the force at the pitch circles; a turns forward.  From a to b inertias count by the share. */
static double share(double c, int sense) { return (ra + sense * c) / (rb - sense * c) * ra / rb; }

static void reverses(int route, double c)
{
    wheels x = wheels_create(route, 0);
    scene *s = x.s;
    swinging_couple(s, x.body[0]);
    scene_force(s, PM_FORCE_FRICTION, x.mesh, x.mesh, 0, c * cos(PHI));
    scene_start_omega(s, x.body[0], 40);
    scene_until_time(s, 0.2);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x.body[0]));
    const int axle = scene_part(s, PM_MEASURE_JOINT_FORCE, x.pin[0], PM_PART_X);
    const int apart = scene_ask_measure(s, axle);
    const int least = scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, axle), PM_NONE);
    const int along = scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, x.mesh, PM_PART_Y));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double turns = (asin(1) - 0.3) / quick, close = route == PM_ROUTE_IDA ? 1e-6 : 1e-10;
    const double way[2] = {size / quick * (sin(quick * turns + 0.3) - sin(0.3)),
                           size / quick * (sin(quick * 0.2 + 0.3) - sin(quick * turns + 0.3))};
    const double of[2] = {ia + ib * share(c, 1), ia + ib * share(c, -1)};
    NEAR(s->out[omega], 40 + way[0] / of[0] + way[1] / of[1], 40 * close);
    const double alpha = size * cos(quick * 0.2 + 0.3) / of[1], force = ib * alpha * ra / rb / (rb + c);
    CHECK(force < 0);
    NEAR(s->out[along], -force, fabs(force) * close * 10);
    NEAR(s->out[apart], -force * tan(PHI), fabs(force) * close * 10);
    NEAR(s->out[least], 0, 1e-6); /* where the flank changes */
    CHECK(s->audit[PM_AUDIT_MOMENTUM] < 1e-8);
    scene_free(s);
}

/* With backlash and friction: from the blow that closes it on, one flank pushes and rubs; a turns forward, or backward. */
static void rubs_with_backlash(int route, int sense)
{
    const double backlash = 1e-3, c = 0.2 * 0.03, into = ra * cos(PHI) + c, out = rb * cos(PHI) - c;
    const double whole = ra * into / ia + rb * out / ib;
    const double first = sqrt(backlash / ra * ia / size), end = 0.3;
    const double force = ra * size / ia / whole;
    wheels x = wheels_create(route, backlash);
    scene *s = x.s;
    for (int i = 0; i < 2; i++) {
        scene_cell(s, PM_TABLE_CONTACT, x.mesh + i, PM_CONTACT_FRICTION, PM_FRICTION_COULOMB);
        scene_cell(s, PM_TABLE_CONTACT, x.mesh + i, PM_CONTACT_STATIC, scene_value(s, 0.2));
        scene_cell(s, PM_TABLE_CONTACT, x.mesh + i, PM_CONTACT_KINETIC, scene_value(s, 0.2));
        scene_cell(s, PM_TABLE_CONTACT, x.mesh + i, PM_CONTACT_LEVER, scene_value(s, 0.03));
        scene_cell(s, PM_TABLE_CONTACT, x.mesh + i, PM_CONTACT_RESTITUTION, scene_value(s, 0));
    }
    scene_couple(s, x.body[0], PM_GROUND, SCENE_PROGRAM(s, scene_k(s, sense * size)));
    scene_until_time(s, end);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x.body[0]));
    int couple[2];
    for (int i = 0; i < 2; i++)
        couple[i] = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_COUPLE, x.mesh + i));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double closes = size / ia * first * (1 - ra * into / ia / whole);
    const double close = route == PM_ROUTE_IDA ? 1e-7 : 1e-10;
    NEAR(s->out[omega], sense * (closes + (size - into * force) / ia * (end - first)), 40 * close);
    NEAR(s->out[couple[0]] + s->out[couple[1]], -sense * c * force, close);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9);
    scene_free(s);
}

/* An impulse against the sense of a couple that turns on: it has its own flank, and the couple the other. */
static void struck(double sense)
{
    wheels x = wheels_create(PM_ROUTE_AUTO, 0);
    scene *s = x.s;
    scene_couple(s, x.body[0], PM_GROUND, SCENE_PROGRAM(s, scene_k(s, size)));
    const int e = scene_when(s, PM_TRIGGER_CROSS,
                             SCENE_PROGRAM(s, scene_m(scene_time(s)), scene_k(s, 0.1), scene_op(PM_OP_SUB)));
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_ANGULAR, e, PM_NONE, x.body[0],
              SCENE_PROGRAM(s, scene_k(s, 4 * sense)), PM_NONE);
    scene_until_time(s, 0.2);
    const int apart = scene_ask_event(
        s, scene_read(s, scene_part(s, PM_MEASURE_JOINT_IMPULSE, x.pin[1], PM_PART_X)), e, 1, 0);
    const int along = scene_ask_event(
        s, scene_read(s, scene_part(s, PM_MEASURE_JOINT_IMPULSE, x.mesh, PM_PART_Y)), e, 1, 0);
    const int now = scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, x.mesh, PM_PART_X));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double of = ia + ib * ra * ra / (rb * rb), impulse = ib * 4 * sense / of * ra / rb / rb;
    NEAR(s->out[along], -impulse, 1e-10);
    NEAR(s->out[apart], -fabs(impulse) * tan(PHI), 1e-10);
    NEAR(s->out[now], -ib * size / of * ra / rb / rb * tan(PHI), 1e-9);
    scene_free(s);
}

/* A rack below a pinion, on a rail. */
static void on_a_rack(int route)
{
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const double m = 5;
    const int pinion = scene_body(s, 1, ia, 0, 0, 0), rack = scene_body(s, m, 0.4, 0, -ra, 0);
    const int g = scene_point(s, pinion, 0, 0), middle = scene_point(s, rack, 0, 0);
    const int pin = scene_joint(s, PM_JOINT_PIN, g, scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_SLIDER_FIXED, middle, scene_line(s, scene_point(s, PM_GROUND, 0, -ra), 0), 0);
    scene_teeth(s, scene_circle(s, g, ra), scene_line(s, middle, 0), 0, PHI);
    swinging_couple(s, pinion);
    scene_until_time(s, 0.2);
    const int speed = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, middle, PM_PART_X));
    const int apart = scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, pin, PM_PART_Y));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double of = ia / ra + m * ra, close = route == PM_ROUTE_IDA ? 1e-6 : 1e-10;
    NEAR(s->out[speed], size / quick * (sin(quick * 0.2 + 0.3) - sin(0.3)) / of, close);
    NEAR(s->out[apart], -m * fabs(size * cos(quick * 0.2 + 0.3)) / of * tan(PHI), 100 * close);
    scene_free(s);
}

/* A wheel that bounces on a flank, until it lies on it: the couple has then turned both.  Whichever flank it is. */
static void bounces(int route, double sense)
{
    wheels x = wheels_create(route, 1e-3);
    scene *s = x.s;
    scene_couple(s, x.body[0], PM_GROUND, SCENE_PROGRAM(s, scene_k(s, size * sense)));
    scene_until_time(s, 0.2);
    const int a = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, x.body[0]));
    const int b = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, x.body[1]));
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x.body[0]));
    const int apart = scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, x.pin[1], PM_PART_X));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double of = ia + ib * ra * ra / (rb * rb), close = route == PM_ROUTE_IDA ? 1e-6 : 1e-10;
    NEAR(s->out[omega], size * sense * 0.2 / of, 30 * close);
    NEAR(ra * s->out[a] + rb * s->out[b], sense * 0.5e-3, 1e-11);
    NEAR(s->out[apart], -ib * size / of * ra / rb / rb * tan(PHI), 100 * close);
    scene_free(s);
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int i = 0; i < 3; i++) {
        reverses(routes[i], 0);
        reverses(routes[i], 0.005);
        on_a_rack(routes[i]);
        bounces(routes[i], 1);
        bounces(routes[i], -1);
        rubs_with_backlash(routes[i], 1);
        rubs_with_backlash(routes[i], -1);
    }
    struck(1);
    struck(-1);
    return check_failures();
}
