/* Contacts of circles with curves: gaps to the nearest place, several feet, ends, blows and rolling, on every route. */
#include "elements/contact_curve.h"

#include "check.h"
#include "elements/contact.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define CLOSE 1e-8
#define G 9.81

static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};

/* y = a s^2 / 2 over x = s, on a body; free above. */
static int parabola(scene *s, int body, double a, double from, double to)
{
    const scene_code place = scene_m(scene_measure(s, PM_MEASURE_PLACE, PM_NONE));
    const int x = SCENE_PROGRAM(s, place), y = SCENE_PROGRAM(s, place, place, scene_op(PM_OP_MUL),
                                                             scene_k(s, 0.5 * a), scene_op(PM_OP_MUL));
    return SCENE_ROW(s, PM_TABLE_CURVE, scene_point(s, body, 0, 0), x, y, scene_value(s, from),
                     scene_value(s, to), 0, 1, PM_NONE);
}

/* Half axes a, b; free inside (side 1) or outside. */
static int ellipse(scene *s, double a, double b, int side)
{
    const scene_code place = scene_m(scene_measure(s, PM_MEASURE_PLACE, PM_NONE));
    const int x = SCENE_PROGRAM(s, scene_k(s, a), place, scene_op(PM_OP_COS), scene_op(PM_OP_MUL)),
              y = SCENE_PROGRAM(s, scene_k(s, b), place, scene_op(PM_OP_SIN), scene_op(PM_OP_MUL));
    return SCENE_ROW(s, PM_TABLE_CURVE, scene_point(s, PM_GROUND, 0, 0), x, y, scene_value(s, 0),
                     scene_value(s, 2 * acos(-1.)), 1, side, PM_NONE);
}

static int touch(scene *s, int body, double radius, int curve, double e, int friction)
{
    return scene_contact(s, PM_CONTACT_CURVE, scene_circle(s, scene_point(s, body, 0, 0), radius), curve, 0,
                         e, friction, 0.3);
}

/* ---- gaps ---- */
/* Least distance of (x, y) from the ellipse, by looking at all of it, then closer and closer. */
static double least(double a, double b, double x, double y)
{
    double from = 0, to = 2 * acos(-1.), best = 0;
    for (int pass = 0; pass < 6; pass++) {
        const double step = (to - from) / 2000;
        double d = INFINITY, at = from;
        for (int i = 0; i <= 2000; i++) {
            const double s = from + i * step, here = hypot(x - a * cos(s), y - b * sin(s));
            if (here < d) d = here, at = s;
        }
        best = d;
        from = at - step;
        to = at + step;
    }
    return best;
}

static void gaps(int side)
{
    const double a = 2, b = 0.7, r = 0.1;
    scene *s = scene_create();
    const int body = scene_body(s, 1, 0.1, side > 0 ? 0 : 3, 0, 0);
    touch(s, body, r, ellipse(s, a, b, side), 0, PM_FRICTION_SMOOTH);
    scene_until_time(s, 1);
    CHECK(scene_begin(s) == PM_OK);
    pm_workspace *w = s->w;
    for (int n = 0; n < 200; n++) {
        int member;
        double *q = w->state.q;
        q[0] = n == 0 ? 0 : check_random(-3, 3);
        q[1] = n == 0 ? 0 : check_random(-2, 2);
        const int inside = hypot(q[0] / a, q[1] / b) < 1;
        const double height = (inside == (side > 0) ? 1 : -1) * least(a, b, q[0], q[1]);
        pm_frame_look_state(&w->frame, &w->state);
        NEAR(pm_contact_gap(&w->frame, &w->state, 0, &member), height - r, 1e-8);
        EQUAL(pm_contact_touches(&w->frame, &w->state, 0, &member), height - r < 0);
    }
    scene_free(s);
}

/* ---- feet ---- */
/* R = 1 in y = x^2: two feet, with the centre 1.25 high. */
static void rests_on_two(int route)
{
    scene *s = scene_create();
    const int b = scene_body(s, 2, 1, 0.1, 1.6, 0);
    const int contact = touch(s, b, 1, parabola(s, PM_GROUND, 2, -3, 3), 0, PM_FRICTION_SMOOTH);
    scene_until_time(s, 1.5);
    const int feet = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, contact)),
              force = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, contact)),
              y = scene_ask_measure(s,
                                    scene_part(s, PM_MEASURE_POSITION, scene_point(s, b, 0, 0), PM_PART_Y));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[feet], 2);
    NEAR(s->out[y], 1.25, CLOSE);
    NEAR(s->out[force], 4 * G, 1e-6);
    scene_free(s);
}

/* A roller on a turning ellipse, whose far side has a foot as well. */
static void stays_on_the_near_side(int route)
{
    scene *s = scene_create();
    const int cam = scene_body(s, 1, 1e3, 0, 0, 0), roller = scene_body(s, 0.1, 5e-4, 0, 0.42, 0);
    const scene_code place = scene_m(scene_measure(s, PM_MEASURE_PLACE, PM_NONE));
    const int x = SCENE_PROGRAM(s, scene_k(s, 0.5), place, scene_op(PM_OP_COS), scene_op(PM_OP_MUL)),
              y = SCENE_PROGRAM(s, scene_k(s, 0.3), place, scene_op(PM_OP_SIN), scene_op(PM_OP_MUL));
    const int curve = SCENE_ROW(s, PM_TABLE_CURVE, scene_point(s, cam, 0.1, 0), x, y, scene_value(s, 0),
                                scene_value(s, 2 * acos(-1.)), 1, -1, PM_NONE);
    const int g = scene_point(s, roller, 0, 0), axle = scene_point(s, PM_GROUND, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, cam, 0, 0), axle, 0);
    scene_joint(s, PM_JOINT_SLIDER_FIXED, g, scene_line(s, axle, acos(-1.) / 2), 0);
    const int contact = touch(s, roller, 0.1, curve, 0, PM_FRICTION_SMOOTH);
    scene_start_omega(s, cam, 2);
    scene_until_time(s, 0.3);
    const int closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, contact));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[closed], 1);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9 && s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    scene_free(s);
}

/* A point slides in a round bowl from 0.2 rad under its rim to the same on the other side, the tangent turning by 2.7 rad. */
static void slides_far(int route)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0, -cos(0.2), -sin(0.2), 0), g = scene_point(s, b, 0, 0);
    touch(s, b, 0, ellipse(s, 1, 1, 1), 0, PM_FRICTION_SMOOTH);
    const int at = scene_when(s, PM_TRIGGER_RISE,
                              scene_minus(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X), cos(0.3)));
    scene_until(s, at, 1);
    const int y = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y)),
              v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_NORM));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[y], -sin(0.3), CLOSE);
    NEAR(s->out[v], sqrt(2 * G * (sin(0.3) - sin(0.2))), 1e-7);
    scene_free(s);
}

/* ---- rolling ---- */
/* From x0 to the bottom of y = a x^2/2, held by a joint or by friction that never slips. */
static void rolls(int route, int joint)
{
    const double a = 0.5, r = 0.2, s0 = 1, size = hypot(1, a * s0);
    scene *s = scene_create();
    const double h = 0.5 * a * s0 * s0 + r / size;
    const int b = scene_body(s, 2, 2 * r * r / 2, s0 - r * a * s0 / size, h, 0),
              curve = parabola(s, PM_GROUND, a, -3, 3), g = scene_point(s, b, 0, 0);
    if (joint)
        scene_joint(s, PM_JOINT_ROLLING_CURVE, scene_circle(s, g, r), curve, 0);
    else
        touch(s, b, r, curve, 0, PM_FRICTION_ROUGH);
    const int low =
        scene_when(s, PM_TRIGGER_FALL, scene_read(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X)));
    scene_until(s, low, 1);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b)),
              turned = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, b));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    const double way = 0.5 * (s0 * size + asinh(a * s0) / a);
    NEAR(s->out[omega], sqrt(2 * G * (h - r) / 1.5) / r, 1e-7);
    NEAR(s->out[turned], way / r - atan(a * s0), CLOSE);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9 && s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    scene_free(s);
}

/* ---- ends ---- */
/* A flat curve that ends at x = 1, and the same as a segment. */
static void goes_over(int route, double radius, int friction)
{
    double x[2], omega[2];
    for (int k = 0; k < 2; k++) {
        scene *s = scene_create();
        const int b = scene_body(s, 1, 0.5 * (radius > 0 ? radius * radius : 1), 0.5, radius, 0),
                  g = scene_point(s, b, 0, 0), circle = scene_circle(s, g, radius);
        if (k == 0)
            scene_segment(s, circle, scene_floor(s, 0), -1, 1, 0, friction, 0.3);
        else
            touch(s, b, radius, parabola(s, PM_GROUND, 0, -1, 1), 0, friction);
        scene_start_velocity(s, g, 0.4, 0);
        scene_start_omega(s, b, radius > 0 ? -0.4 / radius : 0);
        const int low = scene_when(s, PM_TRIGGER_FALL,
                                   scene_minus(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y), -1));
        scene_until(s, low, 1);
        const int out_x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X)),
                  out_omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        EQUAL(scene_run(s, NULL), PM_OK);
        x[k] = s->out[out_x];
        omega[k] = s->out[out_omega];
        scene_free(s);
    }
    NEAR(x[1], x[0], 1e-8);
    NEAR(omega[1], omega[0], 1e-7);
}

/* A point that comes from behind an open curve does not touch it, and lands on it from above. */
static void from_behind(int route)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0, 0.5, -0.5, 0), g = scene_point(s, b, 0, 0);
    const int contact = touch(s, b, 0, parabola(s, PM_GROUND, 0, -1, 1), 0, PM_FRICTION_SMOOTH);
    scene_start_velocity(s, g, -0.1, 4);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, contact), 1);
    const int t = scene_ask_measure(s, scene_time(s));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[t], (4 + sqrt(16 - G)) / G, CLOSE);
    scene_free(s);
}

int main(void)
{
    gaps(1);
    gaps(-1);
    for (int k = 0; k < 3; k++) {
        if (k < 2) rests_on_two(routes[k]);
        stays_on_the_near_side(routes[k]);
        slides_far(routes[k]);
        rolls(routes[k], 0);
        rolls(routes[k], 1);
        goes_over(routes[k], 0, PM_FRICTION_SMOOTH);
        goes_over(routes[k], 0.3, PM_FRICTION_ROUGH);
        goes_over(routes[k], 0.3, PM_FRICTION_COULOMB);
        from_behind(routes[k]);
    }
    return check_failures();
}
