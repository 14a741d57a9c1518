/* Errors at given times on the path route, which makes no coarse run for them: beside true ones, also after many periods, and
 * margins of what happens at a place right before or after such a time. */
#include "check.h"
#include "estimating.h"
#include "scene.h"
#include "state/workspace.h"

#define QUARTER 1.57079632679489661923L
#define W2 (1.5L * 9.81) /* of a rod of length 1 on its pin: phi'' = -W2 sin phi */

static long double period(long double rise)
{
    long double a = 1, b = cosl(0.5L * rise);
    for (int i = 0; i < 40; i++) {
        const long double c = 0.5L * (a + b);
        b = sqrtl(a * b);
        a = c;
    }
    return 4 * QUARTER / (a * sqrtl(W2));
}

/* A rod let go at an angle above its lowest place. */
static scene *let_go(double rise, double accuracy)
{
    scene *s = estimating(accuracy);
    const double angle = rise - (double)QUARTER;
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    scene_set(s, PM_SETTING_MAX_TIME, 1e9);
    *scene_setting(s, PM_SETTING_MAX_EVENTS) = 1000000000;
    const int rod = scene_body(s, 3, 0.25, 0.5 * cos(angle), 0.5 * sin(angle), angle);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    return s;
}

/* Asks how often it has passed its lowest place. */
static int ask_passes(scene *s)
{
    const int there = scene_measure(s, PM_MEASURE_ANGLE, 0);
    return scene_ask_count(s, scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, there, -(double)QUARTER)));
}

typedef struct tally {
    int all, covered, close, alone;
} tally;

static void compare(tally *x, const scene *s, int column, long double truth)
{
    const double error = fmax(fabs((double)(s->out[column] - truth)), 1e-14 * fabs((double)truth));
    x->all++;
    x->covered += error <= s->error[column];
    x->close += s->error[column] <= 100 * error;
    CHECK(error <= 10 * s->error[column]);
}

/* At a quarter of a period the rod is at its lowest place, at a half at its highest, from which it comes back. */
static void at_times(int most)
{
    tally x = {0, 0, 0, 0};
    for (int i = 0; i < 80; i++) {
        const double rise = check_random(0.2, 2.8), accuracy = pow(10, check_random(-9, -6));
        const int periods = (int)pow(10, check_random(0, most)), half = i % 2;
        const long double exact = (periods + (half ? 0.5L : 0.25L)) * period(rise);
        const double t =
            (double)(exact + (i % 4 == 1 ? 1e-6L : 0)); /* else rounding decides what comes first */
        scene *s = let_go(rise, accuracy);
        const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, 0)),
                  omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, 0)),
                  count = half ? ask_passes(s) : PM_NONE;
        scene_until_time(s, t);
        EQUAL(scene_run(s, NULL), PM_OK);
        x.alone += s->count[PM_COUNT_PASSES] == 1; /* no coarse run, and none at a tighter tolerance */
        const long double fastest = -2 * sqrtl(W2) * sinl(0.5L * rise), off = t - exact;
        if (half) {
            EQUAL(s->out[count], 2 * periods + 1);
            compare(&x, s, angle, -QUARTER - rise + 0.5L * W2 * sinl(rise) * off * off);
            compare(&x, s, omega, W2 * sinl(rise) * off);
        } else {
            compare(&x, s, angle, -QUARTER + fastest * off);
            compare(&x, s, omega, fastest);
        }
        CHECK(most < 2 || periods < 10 || s->count[PM_COUNT_REPEATED_SEGMENTS] >= periods - 9);
        scene_free(s);
    }
    CHECK(x.covered >= 0.97 * x.all);
    CHECK(x.close >= 0.4 * x.all);
    CHECK(x.alone >= 25);
}

/* The rod passes its lowest place right before the end, or would right after it: the nearer, the smaller the margin. */
static void beside_a_place(int periods)
{
    const double rise = 1.3;
    for (int i = 3; i < 10; i++)
        for (int side = -1; side <= 1; side += 2) {
            scene *s = let_go(rise, 1e-10);
            ask_passes(s);
            scene_until_time(s, (double)((periods + 0.25L) * period(rise) + side * powl(10, -i)));
            EQUAL(scene_run(s, NULL), PM_OK);
            EQUAL(s->out[0], 2 * periods + (side > 0));
            CHECK(s->margin[0] > 1);
            CHECK(s->margin[0] < pow(10, 16 - i) / periods);
            scene_free(s);
        }
}

int main(void)
{
    at_times(1);
    at_times(6);
    beside_a_place(1);
    beside_a_place(1000);
    return check_failures();
}
