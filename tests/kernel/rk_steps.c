/* rk_steps.c - forces of time that begin within a step of rk, beside their integrals: weakly beside a strong one, from rest, and
 * late. */
#include "check.h"
#include "scene.h"

#define CASES 600
#define ACCURACY 1e-8
#define ROOT_OF_PI 1.7724538509055159
#define PI 3.1415926535897932

/* A program: a bell in time of that integral. */
static int bell(scene *s, int t, double middle, double width, double integral)
{
    return SCENE_PROGRAM(s, scene_m(t), scene_k(s, middle), scene_op(PM_OP_SUB), scene_k(s, width),
                         scene_op(PM_OP_DIV), scene_k(s, 2), scene_op(PM_OP_POW), scene_op(PM_OP_NEG),
                         scene_op(PM_OP_EXP), scene_k(s, integral / (width * ROOT_OF_PI)),
                         scene_op(PM_OP_MUL));
}

/* A program: the half of a sine about its middle, of that integral; else 0. */
static int half_sine(scene *s, int t, double middle, double width, double integral)
{
    return SCENE_PROGRAM(s, scene_m(t), scene_k(s, middle), scene_op(PM_OP_SUB), scene_k(s, PI / width),
                         scene_op(PM_OP_MUL), scene_op(PM_OP_COS), scene_m(t),
                         scene_k(s, middle - 0.5 * width), scene_op(PM_OP_GE), scene_op(PM_OP_MUL),
                         scene_m(t), scene_k(s, middle + 0.5 * width), scene_op(PM_OP_LT),
                         scene_op(PM_OP_MUL), scene_k(s, 0.5 * PI * integral / width), scene_op(PM_OP_MUL));
}

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

static double weak_beside_strong(void)
{
    int point, speed;
    scene *s = at_rest(&point, &speed);
    const int t = scene_time(s);
    const double weak = check_random(0.1, 0.5);
    push(s, point, bell(s, t, check_random(0.4, 0.6), check_random(0.05, 0.1), 1));
    push(s, point, bell(s, t, check_random(0.3, 0.7), check_random(0.002, 0.01), weak));
    scene_until_time(s, 1.2);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double off = fabs(s->out[speed] - 1 - weak);
    scene_free(s);
    return off;
}

/* The bell is some 1e-100 N where it begins, and the half of a sine 0. */
static double from_rest(void)
{
    int point, speed;
    scene *s = at_rest(&point, &speed);
    const int t = scene_time(s);
    push(s, point, bell(s, t, 0.5, 0.03, 1));
    push(s, point, half_sine(s, t, check_random(0.02, 0.2), pow(10, check_random(-4.5, -2)), 1));
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(s->count[PM_COUNT_STEPS] < 150);
    const double off = fabs(s->out[speed] - 2);
    scene_free(s);
    return off;
}

/* Some roundings of the time are much to it. */
static double late_and_narrow(void)
{
    int point, speed;
    scene *s = at_rest(&point, &speed);
    const double width = pow(10, check_random(-6, -5));
    scene_set(s, PM_SETTING_ACCURACY, 1e-12);
    push(s, point, bell(s, scene_time(s), check_random(0.5, 0.99), width, 1));
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(s->count[PM_COUNT_STEPS] < 250);
    const double off = fabs(s->out[speed] - 1);
    scene_free(s);
    return off;
}

static double greatest(double (*error)(void))
{
    double most = 0;
    for (int i = 0; i < CASES; i++) most = fmax(error(), most);
    return most;
}

int main(void)
{
    NEAR(greatest(weak_beside_strong), 0, 2 * ACCURACY); /* 30 of it, where the stages alone tell */
    NEAR(greatest(late_and_narrow), 0, 3e-10);           /* one rounding of the time is 1e-10 of the bell */
    NEAR(greatest(from_rest), 0, 2 * ACCURACY);
    return check_failures();
}
