/* equilibrium.c - starts in an equilibrium beside closed forms: of what swings, of what lies on a floor or is lifted from it, of
 * what friction holds; whether each is stable; and what is none. */
#include "check.h"
#include "scene.h"

#define G 9.81
#define PI 3.14159265358979323846
#define CASES 30

static scene *in_equilibrium(void)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    *scene_setting(s, PM_SETTING_EQUILIBRIUM) = 1;
    scene_until_time(s, 0.1);
    return s;
}

/* A rod on a pin, drawn at an angle. */
static int rod(scene *s, double length, double mass, double angle)
{
    const int b = scene_body(s, mass, mass * length * length / 12, 0.5 * length * cos(angle),
                             0.5 * length * sin(angle), angle);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5 * length, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    return b;
}

/* k (a - free) + m g l/2 cos a = 0 */
static void a_rod_on_a_torsion_spring(void)
{
    scene *s = in_equilibrium();
    const double l = check_random(0.1, 10), m = check_random(0.1, 10), weight = m * G * l / 2,
                 k = weight * check_random(1.1, 5), free = check_random(-3, 3);
    const int b = rod(s, l, m, check_random(-3, 3));
    scene_force(s, PM_FORCE_TORSION, b, PM_GROUND, k, free);
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, b));
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
    const int turned = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, b)); /* since it starts */
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(k * (s->out[angle] - free) + weight * cos(s->out[angle]), 0, 1e-13 * k * (1 + fabs(free)));
    NEAR(s->out[omega], 0, 1e-9);
    NEAR(s->out[turned], 0, 1e-9);
    EQUAL(s->count[PM_COUNT_UNSTABLE_STARTS], 0); /* it is stiffer than the weight */
    scene_free(s);
}

/* Two rods that hang from each other, from wherever: each hangs down or stands. */
static void a_double_pendulum(void)
{
    scene *s = in_equilibrium();
    const double l = check_random(0.2, 2), r = check_random(0.2, 2), a = check_random(-3, 3),
                 c = check_random(-3, 3);
    const int first = rod(s, l, 2, a);
    const int second =
        scene_body(s, 1, r * r / 12, l * cos(a) + 0.5 * r * cos(c), l * sin(a) + 0.5 * r * sin(c), c);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, second, -0.5 * r, 0), scene_point(s, first, 0.5 * l, 0), 0);
    const int one = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, first));
    const int other = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, second));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(cos(s->out[one]), 0, 1e-14);
    NEAR(cos(s->out[other]), 0, 1e-14);
    const int stands = sin(s->out[one]) > 0 || sin(s->out[other]) > 0;
    EQUAL(s->count[PM_COUNT_UNSTABLE_STARTS], stands);
    scene_free(s);
}

/* A disk above a floor on a spring from above: it is let down, or lifted off. */
static void a_disk_above_a_floor(void)
{
    scene *s = in_equilibrium();
    const double r = check_random(0.1, 0.3), m = check_random(0.5, 5), k = check_random(5, 100),
                 high = check_random(0, 1) < 0.3 ? 0 : check_random(0.1, 1);
    const int b = scene_body(s, m, 0.5 * m * r * r, 0, r + high, 0);
    const int center = scene_point(s, b, 0, 0);
    scene_force(s, PM_FORCE_SPRING, center, scene_point(s, PM_GROUND, 0, 3), k, 1);
    const int floor = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, center, r), scene_floor(s, 0), 0, 0,
                                    PM_FRICTION_SMOOTH, 0);
    const int height = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, center, PM_PART_Y));
    const int normal = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, floor));
    const double free = 2 - m * G / k, load = m * G - k * (2 - r);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[height], fmax(free, r), 1e-12);
    NEAR(s->out[normal], fmax(load, 0), 1e-10 * m * G);
    scene_free(s);
}

/* What sticks on a slope is in equilibrium where it is drawn, or told not to be; where smooth, it has none. */
static void a_particle_on_a_slope(double friction)
{
    scene *s = in_equilibrium();
    const double slope = check_random(0.1, 1), mu = friction * tan(slope);
    const int b = scene_body(s, 2, 0, cos(slope), sin(slope), 0);
    const int g = scene_point(s, b, 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, 0), scene_floor(s, slope), 0, 0,
                  friction > 0 ? PM_FRICTION_COULOMB : PM_FRICTION_SMOOTH, mu);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    EQUAL(scene_run(s, NULL), friction == 0 ? PM_NO_EQUILIBRIUM : friction < 1 ? PM_EQUILIBRIUM_OPEN : PM_OK);
    if (friction > 1) NEAR(s->out[x], cos(slope), 1e-15);
    if (friction > 0 && friction < 1) {
        EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_CONTACT);
        NEAR(s->detail[PM_DETAIL_VALUE], tan(slope), 1e-9);
        NEAR(s->detail[PM_DETAIL_BOUND], mu, 1e-15);
    }
    scene_free(s);
}

/* A bearing that holds the rod, or cannot. */
static void a_bearing(double share)
{
    scene *s = in_equilibrium();
    const double angle = check_random(-1, 1);
    const int b = rod(s, 2, 3, angle);
    scene_force(s, PM_FORCE_FRICTION, 0, 0, share * 3 * G * cos(angle), 0);
    const int at = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, b));
    EQUAL(scene_run(s, NULL), share < 1 ? PM_EQUILIBRIUM_OPEN : PM_OK);
    if (share > 1) NEAR(s->out[at], angle, 1e-15);
    if (share < 1) EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_FORCE);
    scene_free(s);
}

static void what_moves(void)
{
    scene *s = in_equilibrium();
    const int b = rod(s, 1, 1, 0);
    scene_drive(s, PM_JOINT_RATE, b, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, 2)), PM_NONE);
    EQUAL(scene_run(s, NULL), PM_EQUILIBRIUM_MOVES);
    EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_BODY);
    scene_free(s);
}

int main(void)
{
    for (int i = 0; i < CASES; i++) {
        a_rod_on_a_torsion_spring();
        a_double_pendulum();
        a_disk_above_a_floor();
        a_particle_on_a_slope(i % 3 == 0 ? 0 : i % 3 == 1 ? 0.9 : 1.1);
        a_bearing(i % 2 ? 0.9 : 1.1);
    }
    what_moves();
    return check_failures();
}
