/* Bodies without mass against closed forms: ends of cords that are pulled, a plate that is struck, a light lever, and
 * what nothing determines. */
#include "check.h"
#include "scene.h"

#define G 9.81

/* A force draws a cord off a drum by its free end, upward beside it: the tension is the force, whatever moves. */
static void pulled(int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const double r = 0.2, inertia = 0.3, pull = 7;
    const int drum = scene_body(s, 4, inertia, 0, 0, 0), end = scene_body(s, 0, 0, r, 1, 0);
    const int centre = scene_point(s, drum, 0, 0), p = scene_point(s, end, 0, 0);
    scene_joint(s, PM_JOINT_PIN, centre, scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_SLIDER, p, scene_line(s, scene_point(s, PM_GROUND, r, 0), 2 * atan(1)), 0);
    const int cord = scene_cord(s, scene_circle(s, centre, r), 1, scene_circle(s, p, 0), 1, 0, 0);
    scene_applied(s, p, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, 0)), SCENE_PROGRAM(s, scene_k(s, pull)));
    scene_until_time(s, 1.5);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, drum));
    const int v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_Y));
    const int tension = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, cord));
    const int energy = scene_ask_measure(s, scene_measure(s, PM_MEASURE_KINETIC, PM_NONE));
    if (route == PM_ROUTE_IDA) {
        EQUAL(scene_run(s, NULL), PM_UNSUPPORTED);
    } else {
        EQUAL(scene_run(s, NULL), PM_OK);
        const double spin = pull * r / inertia * 1.5;
        NEAR(s->out[omega], spin, 1e-10);
        NEAR(s->out[v], r * spin, 1e-10);
        NEAR(s->out[tension], pull, 1e-10);
        NEAR(s->out[energy], 0.5 * inertia * spin * spin, 1e-9);
    }
    scene_free(s);
}

/* A particle falls on a light plate that hangs on a wound drum: e is of the relative velocity, the moment stays. */
static void struck(double e)
{
    scene *s = scene_create();
    const double r = 0.2, inertia = 0.3, m = 2, h = 0.4;
    const double upright = 2 * atan(1);
    const int drum = scene_body(s, 4, inertia, 0, 0, 0), plate = scene_body(s, 0, 0, r, -1, 0);
    const int ball = scene_body(s, m, 0, r, h - 1, 0);
    const int centre = scene_point(s, drum, 0, 0), pp = scene_point(s, plate, 0, 0),
              pb = scene_point(s, ball, 0, 0);
    const int line = scene_line(s, scene_point(s, PM_GROUND, r, 0), upright);
    scene_joint(s, PM_JOINT_PIN, centre, scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_SLIDER, pp, line, 0);
    scene_joint(s, PM_JOINT_SLIDER, pb, line, 0);
    scene_cord(s, scene_circle(s, centre, r), -1, scene_circle(s, pp, 0), 1, 0, 0);
    const int hit = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, pb, 0), scene_line(s, pp, 0), 0, e,
                                  PM_FRICTION_SMOOTH, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, hit), 1);
    const int v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, pb, PM_PART_Y));
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, drum));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double fall = sqrt(2 * G * h), spin = m * r * fall * (1 + e) / (inertia + m * r * r);
    NEAR(s->out[omega], -spin, 1e-10);
    NEAR(s->out[v], -(r * spin - e * fall), 1e-10);
    scene_free(s);
}

/* A light lever on a pivot between two loads: l2 m2 on one side, l1 m1 on the other, and no inertia of its own. */
static void lever(int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const double m = 1.3, big = 2.1, a = 0.7, b = 0.4;
    const int bar = scene_body(s, 0, 0, 0, 0, 0), one = scene_body(s, m, 0, -a, 0, 0),
              two = scene_body(s, big, 0, b, 0, 0);
    scene_cell(s, PM_TABLE_BODY, bar, PM_BODY_ROTATES, 1);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, bar, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, bar, -a, 0), scene_point(s, one, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, bar, b, 0), scene_point(s, two, 0, 0), 0);
    const int turned = scene_measure(s, PM_MEASURE_TURNED, bar);
    scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, turned, 0.5)), 1);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, bar));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double drop = G * (m * a - big * b) * sin(0.5), inertia = m * a * a + big * b * b;
    NEAR(s->out[omega], sqrt(2 * drop / inertia), 1e-9);
    scene_free(s);
}

/* Nothing holds what is pulled, or nothing has mass. */
static void undetermined(double mass_of_other, int wanted)
{
    scene *s = scene_create();
    const int light = scene_body(s, 0, 0, 0, 0, 0);
    scene_body(s, mass_of_other, 0, 1, 0, 0);
    scene_applied(s, scene_point(s, light, 0, 0), PM_GROUND, SCENE_PROGRAM(s, scene_k(s, 1)),
                  SCENE_PROGRAM(s, scene_k(s, 0)));
    scene_until_time(s, 1);
    scene_ask_measure(s, scene_time(s));
    EQUAL(scene_run(s, NULL), wanted);
    EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_BODY);
    EQUAL(s->where[PM_WHERE_ROW], 0);
    scene_free(s);
}

int main(void)
{
    pulled(PM_ROUTE_AUTO);
    pulled(PM_ROUTE_RK);
    pulled(PM_ROUTE_IDA);
    struck(0);
    struck(0.8);
    lever(PM_ROUTE_AUTO);
    lever(PM_ROUTE_RK);
    undetermined(1, PM_SINGULAR);
    undetermined(0, PM_BAD_VALUE);
    return check_failures();
}
