/* Nudges: how an unstable rest or steady motion of several freedoms is left, at the start and by an event; what is not left. */
#include <math.h>

#include "check.h"
#include "routes/start/fastest_growth.h"
#include "scene.h"
#include "state/workspace.h"

#define PI 3.14159265358979323846
#define G 9.81

static int used(const scene *s, int route) { return (int)(s->count[PM_COUNT_ROUTES] >> route & 1); }

/* A program that is positive on one side of a measure. */
static int side_of(scene *s, int measure, double side)
{
    return SCENE_PROGRAM(s, scene_k(s, side), scene_m(measure), scene_op(PM_OP_MUL));
}
static void nudge(scene *s, int measure, double side)
{
    *scene_setting(s, PM_SETTING_NUDGE) = side_of(s, measure, side);
}
static void nudge_at(scene *s, int event, int measure, double side)
{
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_NUDGE, event, PM_NONE, PM_NONE, side_of(s, measure, side),
              PM_NONE);
}
static void take(scene *s, int event, int joint)
{
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_REMOVE, event, PM_TABLE_JOINT, joint, PM_NONE, PM_NONE);
}
static int x_in(scene *s, int point, int body, int kind)
{
    return scene_measure_with(s, kind, point, PM_PART_X, PM_MEASURE_IN, body);
}
static void no_gravity(scene *s) { scene_set(s, PM_SETTING_GRAVITY_Y, 0); }

/* ---- a bead on a bar that turns freely ---- */
typedef struct bead_scene {
    scene *s;
    int bar, bead, bore, out_omega, out_place, out_speed, out_angular;
} bead_scene;

static bead_scene bead_on_bar(int route, double inertia, double m, double spin, double angle)
{
    bead_scene x = {.s = scene_create()};
    scene *s = x.s;
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    no_gravity(s);
    x.bar = scene_body(s, 1, inertia, 0.2, -0.1, angle);
    x.bead = scene_body(s, m, 0, 0.2, -0.1, 0);
    const int g = scene_point(s, x.bead, 0, 0), c = scene_point(s, x.bar, 0, 0);
    scene_joint(s, PM_JOINT_PIN, c, scene_point(s, PM_GROUND, 0.2, -0.1), 0);
    x.bore = scene_joint(s, PM_JOINT_SLIDER, g, scene_line(s, c, 0), 0);
    scene_start_omega(s, x.bar, spin);
    scene_start_velocity(s, g, 0, 0);
    return x;
}

static void end_at(bead_scene *x, double r)
{
    scene *s = x->s;
    const int g = scene_point(s, x->bead, 0, 0), place = x_in(s, g, x->bar, PM_MEASURE_POSITION);
    const int far = SCENE_PROGRAM(s, scene_m(place), scene_op(PM_OP_ABS), scene_k(s, r), scene_op(PM_OP_SUB));
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, far), 1);
    x->out_omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x->bar));
    x->out_place = scene_ask_measure(s, place);
    x->out_speed = scene_ask_measure(s, x_in(s, g, x->bar, PM_MEASURE_VELOCITY));
    const int axis = scene_point(s, PM_GROUND, 0.2, -0.1);
    x->out_angular = scene_ask_measure(
        s, scene_measure_with(s, PM_MEASURE_ANGULAR_MOMENTUM, PM_NONE, PM_PART_NONE, PM_MEASURE_ABOUT, axis));
}

/* H = I W = (I + m r^2) w,  I W^2 = (I + m r^2) w^2 + m r'^2, whatever the side, the spin and the angle. */
static void bead(int route, double spin, double angle, double side, double slack)
{
    const double inertia = 0.3, m = 0.7, r = 0.8;
    bead_scene x = bead_on_bar(route, inertia, m, spin, angle);
    nudge(x.s, x_in(x.s, scene_point(x.s, x.bead, 0, 0), x.bar, PM_MEASURE_VELOCITY), side);
    end_at(&x, r);
    EQUAL(scene_run(x.s, NULL), PM_OK);
    CHECK(used(x.s, route));
    const double all = inertia + m * r * r, omega = inertia * spin / all;
    NEAR(x.s->out[x.out_angular], inertia * spin, slack);
    NEAR(x.s->out[x.out_omega], omega, slack);
    NEAR(x.s->out[x.out_place], side * r, slack);
    NEAR(x.s->out[x.out_speed], side * sqrt((inertia * spin * spin - all * omega * omega) / m), slack);
    scene_free(x.s);
}

/* The deviation itself: r grows at the rate W, seen in the scene with r W across. */
static void deviation(double spin, double angle)
{
    bead_scene x = bead_on_bar(PM_ROUTE_RK, 0.3, 0.7, spin, angle);
    pm_fastest_growth e;
    int status;
    EQUAL(scene_begin(x.s), PM_OK);
    pm_workspace *w = x.s->w;
    EQUAL(pm_fastest_growth_create(&w->memory, w->model, &e), PM_OK);
    for (int i = 0; i < 6; i++) {
        e.free[i] = 1;
        e.push[i] = i == 3 ? cos(angle) : i == 4 ? sin(angle) : 0;
    }
    CHECK(pm_fastest_growth_is_steady(w, &e, &status));
    EQUAL(status, PM_OK);
    EQUAL(pm_fastest_growth_find(w, &e), PM_OK);
    const double along[] = {cos(angle), sin(angle)}, r = e.q[3] * along[0] + e.q[4] * along[1];
    NEAR(e.spin, spin, 0);
    NEAR(e.rate, fabs(spin), 1e-9);
    NEAR(e.v[3] * along[0] + e.v[4] * along[1], fabs(spin) * r, 1e-9);
    NEAR(e.v[4] * along[0] - e.v[3] * along[1], spin * r, 1e-9);
    NEAR(e.q[4] * along[0] - e.q[3] * along[1], 0, 1e-9); /* no step off the bar */
    CHECK(fabs(r) > 0.1);
    scene_free(x.s);
}

/* The bead is held, and let go by an event with a nudge; how long it takes from there depends on the accuracy. */
static void bead_let_go(void)
{
    const double inertia = 0.3, m = 0.7, r = 0.8, spin = 3;
    double took[2];
    for (int i = 0; i < 2; i++) {
        bead_scene x = bead_on_bar(PM_ROUTE_RK, inertia, m, spin, 0.4);
        scene *s = x.s;
        scene_set(s, PM_SETTING_ACCURACY, i ? 1e-11 : 1e-9);
        const int g = scene_point(s, x.bead, 0, 0);
        const int held = scene_joint(s, PM_JOINT_PIN, g, scene_point(s, PM_GROUND, 0.2, -0.1), 0);
        const int e = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, scene_time(s), 0.5));
        take(s, e, held);
        nudge_at(s, e, x_in(s, g, x.bar, PM_MEASURE_VELOCITY), -1);
        end_at(&x, r);
        const int time = scene_ask_measure(s, scene_time(s));
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[x.out_omega], inertia * spin / (inertia + m * r * r), i ? 1e-9 : 1e-8);
        NEAR(s->out[x.out_place], -r, 1e-9);
        took[i] = s->out[time];
        scene_free(s);
    }
    NEAR(took[1] - took[0], log(10) / spin, 1e-4); /* a tenth of the size: ln 10 / rate longer */
}

/* ---- a bar hinged on a turntable, pointing inward or outward ---- */
/* Turned inward it is in unstable steady motion: H and E are kept while it swings out; outward nothing leaves. */
static void turntable(int route, int inward)
{
    const double inertia = 2, m = 0.5, l = 0.4, own = m * l * l / 12, a = 0.9, spin = -2.5;
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    no_gravity(s);
    const int table = scene_body(s, 3, inertia, 0, 0, 0);
    const int bar = scene_body(s, m, own, inward ? a - l / 2 : a + l / 2, 0, inward ? PI : 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, table, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, table, a, 0), scene_point(s, bar, -l / 2, 0), 0);
    scene_start_omega(s, table, spin);
    scene_start_omega(s, bar, spin);
    nudge(s, scene_measure_with(s, PM_MEASURE_OMEGA, bar, PM_PART_NONE, PM_MEASURE_IN, table), 1);
    const int relative = scene_measure_with(s, PM_MEASURE_ANGLE, bar, PM_PART_NONE, PM_MEASURE_IN, table);
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, relative, 1.5 * PI)), 1);
    const int kinetic = scene_ask_measure(s, scene_measure(s, PM_MEASURE_KINETIC, PM_NONE));
    const int angular = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGULAR_MOMENTUM, PM_NONE));
    const int status = scene_run(s, NULL);
    const double at = inward ? a - l / 2 : a + l / 2, all = inertia + own + m * at * at;
    EQUAL(status, inward ? PM_OK : PM_NUDGE_STABLE);
    if (inward) {
        const double slack = route == PM_ROUTE_IDA ? 1e-7 : 1e-10;
        NEAR(s->out[kinetic], 0.5 * all * spin * spin, slack);
        NEAR(s->out[angular], all * spin, slack);
    }
    scene_free(s);
}

/* ---- two point masses on light bars, upright ---- */
typedef struct upright_scene {
    scene *s;
    int lower, upper, first, second, kinetic, potential;
} upright_scene;

static upright_scene upright(int route, double tilt, double end)
{
    const double m = 1.3, l = 0.6, light = 1e-9;
    upright_scene x = {.s = scene_create()};
    scene *s = x.s;
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const double c = cos(tilt), si = sin(tilt);
    x.lower = scene_body(s, m, light, -l * si, l * c, 0.5 * PI + tilt);
    x.upper = scene_body(s, m, light, -2 * l * si, 2 * l * c, 0.5 * PI + tilt);
    const int top = scene_point(s, x.lower, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, x.lower, -l, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, x.upper, -l, 0), top, 0);
    const int first = scene_measure(s, PM_MEASURE_TURNED, x.lower);
    const int far =
        SCENE_PROGRAM(s, scene_m(first), scene_op(PM_OP_ABS), scene_k(s, end), scene_op(PM_OP_SUB));
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, far), 1);
    x.first = scene_ask_measure(s, first);
    x.second = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, x.upper));
    x.kinetic = scene_ask_measure(s, scene_measure(s, PM_MEASURE_KINETIC, PM_NONE));
    x.potential = scene_ask_measure(s, scene_measure(s, PM_MEASURE_POTENTIAL, PM_NONE));
    return x;
}

/* Of two deviations that grow, at (2 +- sqrt 2) g/l, it leaves along the faster: the upper bar turns -sqrt 2 times as far as
 * the lower. */
static void fastest(int route)
{
    const double end = 1e-3;
    for (int side = -1; side <= 1; side += 2) {
        upright_scene x = upright(route, 0, end);
        nudge(x.s, scene_measure(x.s, PM_MEASURE_OMEGA, x.upper), side);
        EQUAL(scene_run(x.s, NULL), PM_OK);
        NEAR(x.s->out[x.first], -side * end, 1e-12);
        NEAR(x.s->out[x.second], side * sqrt(2) * end, route == PM_ROUTE_IDA ? 1e-7 : 3e-9); /* cubic terms */
        scene_free(x.s);
    }
}

/* Far out the energy is exact, and both sides mirror each other. */
static void mirrors(int route)
{
    const double m = 1.3, l = 0.6;
    double second[2], slack = route == PM_ROUTE_IDA ? 1e-6 : 1e-9;
    for (int i = 0; i < 2; i++) {
        upright_scene x = upright(route, 0, 1.2);
        nudge(x.s, scene_measure(x.s, PM_MEASURE_OMEGA, x.lower), i ? 1 : -1);
        EQUAL(scene_run(x.s, NULL), PM_OK);
        second[i] = x.s->out[x.second];
        NEAR(x.s->out[x.first], i ? 1.2 : -1.2, 1e-10);
        NEAR(x.s->out[x.kinetic] + x.s->out[x.potential], 3 * m * G * l, slack);
        CHECK(x.s->out[x.kinetic] > 1);
        scene_free(x.s);
    }
    NEAR(second[0], -second[1], slack);
}

/* ---- what is not left ---- */
/* Tilted, the forces decide: to the side that is asked for, or not. */
static void tilted(void)
{
    for (int side = -1; side <= 1; side += 2) {
        upright_scene x = upright(PM_ROUTE_RK, 0.1, 0.5);
        nudge(x.s, scene_measure(x.s, PM_MEASURE_OMEGA, x.lower), side);
        EQUAL(scene_run(x.s, NULL), side > 0 ? PM_OK : PM_NUDGE_UNSTEADY);
        if (side < 0) EQUAL(x.s->where[PM_WHERE_TABLE], PM_TABLE_SETTING);
        scene_free(x.s);
    }
}

/* Hanging it is stable; what is asked of a body beside it does not grow. */
static void stable(void)
{
    upright_scene x = upright(PM_ROUTE_RK, PI, 0.5);
    nudge(x.s, scene_measure(x.s, PM_MEASURE_OMEGA, x.lower), 1);
    EQUAL(scene_run(x.s, NULL), PM_NUDGE_STABLE);
    scene_free(x.s);
    x = upright(PM_ROUTE_RK, 0, 0.5);
    const int wheel = scene_body(x.s, 1, 0.2, 3, 0, 0);
    scene_joint(x.s, PM_JOINT_PIN, scene_point(x.s, wheel, 0, 0), scene_point(x.s, PM_GROUND, 3, 0), 0);
    const int e = scene_on(x.s, PM_TRIGGER_START, PM_NONE);
    nudge_at(x.s, e, scene_measure(x.s, PM_MEASURE_OMEGA, wheel), 1);
    EQUAL(scene_run(x.s, NULL), PM_NUDGE_STABLE);
    EQUAL(x.s->where[PM_WHERE_TABLE], PM_TABLE_ACTION);
    EQUAL(x.s->where[PM_WHERE_ROW], 0);
    scene_free(x.s);
}

/* A spinning bar in gravity: seen from it the weight of the bead turns round. */
static void not_steady(void)
{
    bead_scene x = bead_on_bar(PM_ROUTE_RK, 0.3, 0.7, 4, 0);
    scene_set(x.s, PM_SETTING_GRAVITY_Y, -G);
    nudge(x.s, x_in(x.s, scene_point(x.s, x.bead, 0, 0), x.bar, PM_MEASURE_VELOCITY), 1);
    end_at(&x, 0.8);
    EQUAL(scene_run(x.s, NULL), PM_NUDGE_UNSTEADY);
    scene_free(x.s);
}

/* ---- one freedom, at an event ---- */
/* A bar is held upright until 0.3 s, and then falls to the side that the nudge says; hanging it would not, nor out of a
 * slant to the upper side, nor while it turns. */
static void one_freedom(int route, double angle, double spin, double side, int expected)
{
    const double l = 1, m = 2;
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int b = scene_body(s, m, m * l * l / 12, 0.5 * l * cos(angle), 0.5 * l * sin(angle), angle);
    const int end = scene_point(s, b, -0.5 * l, 0), base = scene_point(s, PM_GROUND, 0, 0);
    scene_joint(s, PM_JOINT_PIN, end, base, 0);
    const int e = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, scene_time(s), spin == 0 ? 0.3 : 0.1));
    if (spin == 0) take(s, e, scene_joint(s, PM_JOINT_WELD, end, base, angle));
    if (spin != 0) scene_start_omega(s, b, spin);
    const int omega = scene_measure(s, PM_MEASURE_OMEGA, b);
    nudge_at(s, e, omega, side);
    const int turned = scene_measure(s, PM_MEASURE_ANGLE, b);
    scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, turned, (0.5 + side) * PI)), 1);
    const int speed = scene_ask_measure(s, omega);
    EQUAL(scene_run(s, NULL), expected);
    if (expected == PM_OK) {
        NEAR(s->out[speed], side * sqrt(3 * G * (1 + sin(angle)) / l), route == PM_ROUTE_IDA ? 1e-6 : 1e-8);
        CHECK(used(s, PM_ROUTE_PATH));
    } else {
        EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_ACTION);
    }
    scene_free(s);
}

int main(void)
{
    bead(PM_ROUTE_RK, 3, 0.4, 1, 1e-9);
    bead(PM_ROUTE_RK, -8, 0.4, -1, 1e-9);
    bead(PM_ROUTE_RK, 0.05, 2, 1, 1e-9);
    bead(PM_ROUTE_IDA, 3, 0.4, -1, 1e-7);
    deviation(3, 0.4);
    deviation(-2, 2.5);
    bead_let_go();
    turntable(PM_ROUTE_RK, 1);
    turntable(PM_ROUTE_IDA, 1);
    turntable(PM_ROUTE_RK, 0);
    fastest(PM_ROUTE_RK);
    fastest(PM_ROUTE_IDA);
    mirrors(PM_ROUTE_RK);
    mirrors(PM_ROUTE_IDA);
    tilted();
    stable();
    not_steady();
    one_freedom(PM_ROUTE_AUTO, 0.5 * PI, 0, 1, PM_OK);
    one_freedom(PM_ROUTE_RK, 0.5 * PI, 0, -1, PM_OK);
    one_freedom(PM_ROUTE_IDA, 0.5 * PI, 0, 1, PM_OK);
    one_freedom(PM_ROUTE_AUTO, -0.5 * PI, 0, 1, PM_NUDGE_STABLE);
    one_freedom(PM_ROUTE_AUTO, 0.4 * PI, 0, 1, PM_NUDGE_UNSTEADY);
    one_freedom(PM_ROUTE_AUTO, 0.4 * PI, 0, -1, PM_OK);
    one_freedom(PM_ROUTE_AUTO, 0.5 * PI, 0.5, 1, PM_NUDGE_UNSTEADY);
    return check_failures();
}
