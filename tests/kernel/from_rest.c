/* What is pushed from rest, ever harder, goes far in its first step: circles on its way, reactions that turn with it, the scale of
 * its speed, and the errors of a blow far away. */
#include <math.h>

#include "check.h"
#include "estimating.h"
#include "scene.h"

/* In a horizontal plane, on the route rk. */
static scene *weightless(double accuracy)
{
    scene *s = estimating(accuracy);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    return s;
}

/* c t^power. */
static int growing(scene *s, double c, double power)
{
    return SCENE_PROGRAM(s, scene_m(scene_time(s)), scene_k(s, power), scene_op(PM_OP_POW), scene_k(s, c),
                         scene_op(PM_OP_MUL));
}

/* v is what is told, within its error and what rounding leaves of it at radii so small beside the way. */
static void is(const scene *s, int out, double v, double size)
{
    NEAR(s->out[out], v, 10 * s->error[out] + 1e-13 * size);
}

/* A disk of mass 1 strikes a peg of the ground, at most a part of the radii aside: x'' = c t^power until then.  The scene is far larger
 * than they are: a point of the body is far outside. */
static void strikes_a_peg(int power)
{
    const double way = check_logarithmic(1, 300), radii = way * check_logarithmic(1e-5, 1e-2),
                 own = 0.4 * radii;
    const double aside = check_random(-0.9, 0.9) * radii, e = check_random(0.2, 1),
                 c = way * check_logarithmic(0.1, 10);
    const double along = sqrt(radii * radii - aside * aside), nx = along / radii, ny = aside / radii;
    const double t = pow(way * (power + 1) * (power + 2) / c, 1. / (power + 2)),
                 v = c * pow(t, power + 1) / (power + 1);
    scene *s = weightless(1e-10);
    const int b = scene_body(s, 1, 0.5 * own * own, 0, 0, 0), g = scene_point(s, b, 0, 0);
    scene_point(s, b, 0, way * check_logarithmic(3e-3, 1));
    const int peg = scene_circle(s, scene_point(s, PM_GROUND, way + along, aside), radii - own);
    const int contact =
        scene_contact(s, PM_CONTACT_CIRCLE, scene_circle(s, g, own), peg, 1, e, PM_FRICTION_SMOOTH, 0);
    scene_applied(s, g, PM_GROUND, growing(s, c, power), SCENE_PROGRAM(s, scene_k(s, 0)));
    const int strikes = scene_on(s, PM_TRIGGER_STRIKE, contact);
    const int vx =
        scene_ask_event(s, scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X)), strikes, 1, 0);
    const int vy =
        scene_ask_event(s, scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y)), strikes, 1, 0);
    scene_until_time(s, t * 1.001);
    EQUAL(scene_run(s, NULL), PM_OK);
    is(s, vx, v - (1 + e) * v * nx * nx, v);
    is(s, vy, -(1 + e) * v * nx * ny, v);
    scene_free(s);
}

/* A bob on an arm that a couple turns, as it grows: its reactions, and what they sum up to, are no worse than the bound of the
 * check. */
static void turns(int power, double accuracy)
{
    const double arm = check_logarithmic(0.1, 10), gyration = arm * check_logarithmic(1e-6, 1),
                 mass = check_logarithmic(0.1, 10);
    const double inertia = mass * (arm * arm + gyration * gyration), c = check_logarithmic(0.1, 10);
    scene *s = weightless(accuracy);
    const int b = scene_body(s, mass, mass * gyration * gyration, arm, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -arm, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_couple(s, b, PM_GROUND, growing(s, c * inertia, power));
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
    const double t = pow(check_random(0.5, 6) * (power + 1) * (power + 2) / c, 1. / (power + 2));
    scene_until_time(s, t);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[omega], c * pow(t, power + 1) / (power + 1), 1e-9 * c * pow(t, power + 1));
    CHECK(isfinite(s->error[omega]));
    scene_free(s);
}

/* A small disk on a long arm strikes a peg and bounces: its speed is not measured by how fast a couple would turn it about itself,
 * and its rebound is no slow one. */
static void rebounds_on_an_arm(void)
{
    const double arm = check_logarithmic(1, 10), own = arm * check_logarithmic(1e-4, 1e-3), k = 1e-3 * own,
                 e = check_random(0.2, 0.6);
    const double alpha = check_logarithmic(0.1, 10), way = check_random(0.5, 2),
                 contact_at = way + asin(own / arm);
    scene *s = weightless(1e-8);
    const int b = scene_body(s, 1, k * k, arm, 0, 0), g = scene_point(s, b, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -arm, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_couple(s, b, PM_GROUND, growing(s, alpha * (arm * arm + k * k), 0));
    const double reach = arm * cos(asin(own / arm)); /* the peg is a point that the rim meets head-on */
    const int peg =
        scene_circle(s, scene_point(s, PM_GROUND, reach * cos(contact_at), reach * sin(contact_at)), 0);
    const int contact =
        scene_contact(s, PM_CONTACT_CIRCLE, scene_circle(s, g, own), peg, 1, e, PM_FRICTION_SMOOTH, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, contact), 1);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[omega], -e * sqrt(2 * alpha * way), 1e-9 * sqrt(2 * alpha * way) * arm / own);
    CHECK(s->trust[PM_TRUST_MARGIN] > 10);
    scene_free(s);
}

/* What a pin holds on a long arm strikes with its mass, which turns it back: its own moment of inertia, however small, leaves no more
 * rounding than there is. */
static void turns_back_on_an_arm(void)
{
    const double arm = check_logarithmic(0.1, 10), k = arm * check_logarithmic(1e-3, 1),
                 e = check_random(0, 1), omega = check_random(0.5, 5), at = check_random(0.3, 2);
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int b = scene_body(s, 1, k * k, arm, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -arm, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    const double own = 0.1 * arm, out = arm + 0.3 * own;
    const int peg = scene_circle(s, scene_point(s, PM_GROUND, out * cos(at), out * sin(at)), 0.2 * own);
    const int contact = scene_contact(s, PM_CONTACT_CIRCLE, scene_circle(s, scene_point(s, b, 0, 0), own),
                                      peg, 1, e, PM_FRICTION_SMOOTH, 0);
    scene_start_omega(s, b, omega);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, contact), 1);
    const int after = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[after], -e * omega, 2e-14 * omega);
    scene_free(s);
}

/* Beside a place far away the rounding of places is a part of small radii: that is told. */
static void tells_what_is_rounded(void)
{
    int beyond = 0;
    for (int i = 0; i < 40; i++) {
        const double way = check_logarithmic(10, 50), radius = check_logarithmic(3e-3, 1e-2),
                     aside = check_random(0.3, 0.9) * radius;
        const double v = check_logarithmic(1, 100), nx = sqrt(1 - aside * aside / (radius * radius)),
                     ny = aside / radius;
        scene *s = weightless(1e-12);
        const int b = scene_body(s, 1, radius * radius, 0, 0, 0), g = scene_point(s, b, 0, 0);
        const int peg = scene_circle(s, scene_point(s, PM_GROUND, way, aside), 0.5 * radius);
        const int contact = scene_contact(s, PM_CONTACT_CIRCLE, scene_circle(s, g, 0.5 * radius), peg, 1, 1,
                                          PM_FRICTION_SMOOTH, 0);
        scene_start_velocity(s, g, v, 0);
        scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, contact), 1);
        const int vy = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y));
        EQUAL(scene_run(s, NULL), PM_OK);
        beyond += fabs(s->out[vy] + 2 * v * nx * ny) > 3 * s->error[vy];
        scene_free(s);
    }
    CHECK(beyond <= 1);
}

int main(void)
{
    for (int i = 0; i < 8; i++)
        for (int power = 1; power <= 3; power++) strikes_a_peg(power);
    for (int i = 0; i < 10; i++)
        for (int power = 1; power <= 3; power++) {
            turns(power, 1e-10);
            turns(power, 1e-6);
        }
    for (int i = 0; i < 10; i++) rebounds_on_an_arm();
    for (int i = 0; i < 100; i++) turns_back_on_an_arm();
    tells_what_is_rounded();
    return check_failures();
}
