/* rk_steps.c - steps of rk that are accepted, though they should not be: where the estimators of their error would pass through zero,
 * and where forces of time begin within a step, beside their integrals: weakly beside a strong one, from rest, and late. */
#include "check.h"
#include "pulses.h"
#include "routes/rk/dop853.h"

#define CASES 600
#define ACCURACY 1e-8

/* 1 kg at rest, where nothing else acts. */
static scene *at_rest(int *point, int *speed)
{
    scene *s = scene_create();
    *point = scene_point(s, scene_body(s, 1, 0, 0, 0, 0), 0, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_RK;
    scene_set(s, PM_SETTING_ACCURACY, ACCURACY);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *speed = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, *point, PM_PART_X));
    return s;
}

static void push(scene *s, int point, int program)
{
    scene_applied(s, point, PM_GROUND, program, SCENE_PROGRAM(s, scene_k(s, 0)));
}

static void push_by_bell(scene *s, int point, double middle, double width, double integral)
{
    const pulse p = {.impulse = integral / sqrt(pi()), .middle = middle, .width = width};
    push(s, point, pulse_bell(s, scene_time(s), &p));
}

static void push_by_half_sine(scene *s, int point, double middle, double width, double integral)
{
    const pulse p = {.impulse = 0.5 * pi() * integral, .middle = middle, .width = width};
    push(s, point, pulse_half_sine(s, scene_time(s), &p));
}

/* By how much the speed is off at the end, after no more steps than these. */
static double off_after(scene *s, double end, int most_steps, int speed, double expected)
{
    scene_until_time(s, end);
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(s->count[PM_COUNT_STEPS] < most_steps);
    const double off = fabs(s->out[speed] - expected);
    scene_free(s);
    return off;
}

static double weak_beside_strong(void)
{
    int point, speed;
    scene *s = at_rest(&point, &speed);
    const double weak = check_random(0.1, 0.5);
    push_by_bell(s, point, check_random(0.4, 0.6), check_random(0.05, 0.1), 1);
    push_by_bell(s, point, check_random(0.3, 0.7), check_random(0.002, 0.01), weak);
    return off_after(s, 1.2, 250, speed, 1 + weak);
}

/* The bell is some 1e-100 N where it begins, and the half of a sine 0. */
static double from_rest(void)
{
    int point, speed;
    scene *s = at_rest(&point, &speed);
    push_by_bell(s, point, 0.5, 0.03, 1);
    push_by_half_sine(s, point, check_random(0.02, 0.2), pow(10, check_random(-4.5, -2)), 1);
    return off_after(s, 1, 150, speed, 2);
}

/* Some roundings of the time are much to it. */
static double late_and_narrow(void)
{
    int point, speed;
    scene *s = at_rest(&point, &speed);
    scene_set(s, PM_SETTING_ACCURACY, 1e-12);
    push_by_bell(s, point, check_random(0.5, 0.99), pow(10, check_random(-6, -5)), 1);
    return off_after(s, 1, 250, speed, 1);
}

/* Estimators of order 5 tell nothing of polynomials to degree 4. */
static void estimators(void)
{
    for (int power = 0; power < 5; power++) {
        double sum = 0, beside = 0;
        for (int i = 0; i < STAGES; i++) {
            const double place = pow(stage_time[i], power);
            sum += error_weight_5[i] * place;
            beside += error_weight_5_beside[i] * place;
        }
        NEAR(sum, 0, 2e-15);
        NEAR(beside, 0, 2e-15);
    }
}

/* The angle of the lower of two rods in series, let go from the horizontal and whipped round once, after 2.4 s. */
static double angle(double accuracy)
{
    scene *s = scene_create();
    int body = PM_GROUND;
    for (int i = 0; i < 2; i++) {
        const int last = body;
        body = scene_body(s, 1, 1 / 12., i + 0.5, 0, 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, body, -0.5, 0), scene_point(s, last, i > 0 ? 0.5 : 0, 0),
                    0);
    }
    const int lower = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, body));
    scene_route(s, PM_ROUTE_RK, accuracy);
    scene_until_time(s, 2.4);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double found = s->out[lower];
    scene_free(s);
    return found;
}

/* The greatest error over the accuracy asked. */
static double whipped(void)
{
    const double exact = angle(1e-12);
    double most = 0;
    for (int i = 0; i < CASES; i++) {
        const double accuracy = pow(10, -3 - 3. * i / CASES);
        most = fmax(fabs(angle(accuracy) - exact) / accuracy, most);
    }
    return most;
}

static double greatest(double (*error)(void))
{
    double most = 0;
    for (int i = 0; i < CASES; i++) most = fmax(error(), most);
    return most;
}

int main(void)
{
    estimators();
    NEAR(whipped(), 0, 1);                               /* 3.6, where one estimator alone tells */
    NEAR(greatest(weak_beside_strong), 0, 2 * ACCURACY); /* 30 of it, where the stages alone tell */
    NEAR(greatest(late_and_narrow), 0, 3e-10);           /* one rounding of the time is 1e-10 of the bell */
    NEAR(greatest(from_rest), 0, 2 * ACCURACY);
    return check_failures();
}
