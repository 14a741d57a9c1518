/* Errors of the time along paths, told from how the coefficients of a step fall: where they fall slowly, pass through zero, or
 * do not show a corner between their nodes. */
#include "check.h"
#include "estimating.h"
#include "scene.h"
#include "state/workspace.h"

#include <math.h>

#define HALF_TURN 1.57079632679489661923

typedef struct tally {
    int all, covered, close;
} tally;

static void take(tally *x, const scene *s, double exact)
{
    const double error = fmax(fabs(s->out[0] - exact), 1e-14 * exact);
    x->all++;
    x->covered += error <= s->error[0];
    x->close += s->error[0] <= 1000 * error;
    CHECK(error <= 3 * s->error[0]);
}

static scene *on_a_path(double accuracy)
{
    scene *s = estimating(accuracy);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    return s;
}

/* A rod of length 1 and mass 3 on its pin, with a spin. */
static int spin_rod(scene *s, double angle, double omega)
{
    const int rod = scene_body(s, 3, 0.25, 0.5 * cos(angle), 0.5 * sin(angle), angle);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_start_omega(s, rod, omega);
    return rod;
}

/* Asks for the time when it has turned so far. */
static void until_turned(scene *s, int rod, double angle)
{
    const int turned = scene_measure(s, PM_MEASURE_TURNED, rod);
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turned, angle)), 1);
    scene_ask_measure(s, scene_time(s));
}

/* Just fast enough to come over the top: T is small there, and what is rounded of it makes the time uncertain by much more
 * than its own rounding, the more the slower the rod is (part: of the energy that the top needs, left over there).  How fast it
 * goes has poles beside the end of a step: its coefficients fall slowly, and pass through zero slowly. */
static void slow_over_the_top(void)
{
    const double w2 = 1.5 * G;
    tally x = {0, 0, 0};
    for (int i = 0; i < 1000; i++) {
        const double part = pow(10, check_random(-9, -5)), omega = sqrt(4 * w2 * (1 + part));
        const double accuracy = pow(10, check_random(-10, -2));
        scene *s = on_a_path(accuracy);
        until_turned(s, spin_rod(s, -HALF_TURN, omega), 4 * HALF_TURN);
        EQUAL(scene_run(s, NULL), PM_OK);
        const long double fast = omega, slow = sqrtl(fast * fast - 4 * (long double)w2);
        CHECK(s->count[PM_COUNT_PASSES] == 1 || accuracy < 1e-6); /* rounding alone allows no more */
        take(&x, s, 4 * HALF_TURN / mean(fast, slow));
        scene_free(s);
    }
    CHECK(x.covered >= 0.97 * x.all);
    CHECK(x.close >= 0.5 * x.all);
}

/* A spring from the tip to a point beside its circle: its length is nearly zero on the way, where the force jumps nearly. */
typedef struct near_zero {
    double omega, stiffness, length, beside;
} near_zero;

static long double stored(const near_zero *x, long double u)
{
    const long double half = 2 * sinl(u / 2),
                      away = sqrtl((long double)x->beside * x->beside + (1 + x->beside) * half * half);
    return 0.5L * x->stiffness * (away - x->length) * (away - x->length);
}

static long double slowness(const near_zero *x, long double u)
{
    const long double twice = x->omega * (long double)x->omega + 2 * (stored(x, -1) - stored(x, u));
    return 1 / sqrtl(twice); /* the moment of inertia is 1 */
}

/* The time from the nearest place to `far` on one side: u = beside sinh(v), and v by the tanh-sinh rule. */
static long double time_on(const near_zero *x, int side, double far)
{
    const long double end = asinhl(far / (long double)x->beside), step = 0.01L, quarter = HALF_TURN;
    long double sum = 0;
    for (int k = -330; k <= 330; k++) {
        const long double a = quarter * sinhl(step * k), cosine = coshl(a),
                          weight = step * quarter * coshl(step * k) / (cosine * cosine);
        const long double v = 0.5L * end * (1 + tanhl(a));
        sum += 0.5L * end * weight * x->beside * coshl(v) * slowness(x, side * x->beside * sinhl(v));
    }
    return sum;
}

static near_zero draw(void)
{
    return (near_zero){check_random(2, 6), check_random(1, 8), check_random(0, 0.6),
                       pow(10, check_random(-4, -0.3))};
}

static scene *past(const near_zero *x, double accuracy, int *rod)
{
    scene *s = on_a_path(accuracy);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *rod = spin_rod(s, -1, x->omega);
    scene_force(s, PM_FORCE_SPRING, scene_point(s, *rod, 0.5, 0), scene_point(s, PM_GROUND, 1 + x->beside, 0),
                x->stiffness, x->length);
    return s;
}

/* The time to a place, and the place at that time. */
static void nearly_a_corner(void)
{
    tally places = {0, 0, 0}, times = {0, 0, 0};
    const near_zero none = {3, 0, 0.1, 0.001};
    NEAR((double)(time_on(&none, -1, 1) + time_on(&none, 1, 0.5)), 0.5, 1e-15); /* the reference itself */
    for (int i = 0; i < 3000; i++) {
        const near_zero x = draw();
        const double accuracy = pow(10, check_random(-12, -2)), end = check_random(0.1, 1),
                     time = (double)(time_on(&x, -1, 1) + time_on(&x, 1, end));
        int rod;
        scene *s = past(&x, accuracy, &rod);
        until_turned(s, rod, end + 1);
        EQUAL(scene_run(s, NULL), PM_OK);
        take(&times, s, time);
        scene_free(s);
        s = past(&x, accuracy, &rod);
        scene_until_time(s, time);
        scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, rod));
        EQUAL(scene_run(s, NULL), PM_OK);
        take(&places, s, end);
        scene_free(s);
    }
    CHECK(times.covered >= 0.97 * times.all);
    CHECK(places.covered >= 0.97 * places.all);
}

int main(void)
{
    slow_over_the_top();
    nearly_a_corner();
    return check_failures();
}
