/* Extremes of expressions inside a step, in closed form: of u = angle - c of a wheel that turns evenly, for many places c
 * between the nodes of a step. */
#include "wheel.h"

#define PLACES 20
#define END 3.0 /* rad */

static const int routes[] = {PM_ROUTE_PATH, PM_ROUTE_RK, PM_ROUTE_IDA, PM_ROUTE_UNIFORM};

/* squares of how far from their middle two tops have parted */
#define PARTED 6
static const double parted[PARTED] = {1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1};

static wheel turning(int route) { return wheel_turning(route, END); }

#define U scene_m(x.turned), scene_v(x.c), scene_op(PM_OP_SUB)
#define K(number) scene_k(x.s, number)
#define ADD scene_op(PM_OP_ADD)
#define SUB scene_op(PM_OP_SUB)
#define MUL scene_op(PM_OP_MUL)
#define SQUARE K(2), scene_op(PM_OP_POW)
#define MIN scene_op(PM_OP_MIN)
#define MAX scene_op(PM_OP_MAX)
#define ABS scene_op(PM_OP_ABS)

/* max(1 - u^2, 0.9 + u / 20): the top of the first, and beside it the second, which is greater at the next node. */
static void top_beside_corner(int route)
{
    wheel x = turning(route);
    scene_ask_extreme(
        x.s, PM_ASK_MAX,
        SCENE_PROGRAM(x.s, K(1), U, SQUARE, SUB, U, K(20), scene_op(PM_OP_DIV), K(0.9), ADD, MAX), PM_NONE);
    wheel_expect(x, PLACES, 2, 2.6, 1, 1e-11);
}

/* min(1 + u, (1 - u)^2): the corner at u = 0. */
static void top_at_corner(int route)
{
    wheel x = turning(route);
    scene_ask_extreme(x.s, PM_ASK_MAX, SCENE_PROGRAM(x.s, K(1), U, ADD, K(1), U, SUB, SQUARE, MIN), PM_NONE);
    wheel_expect(x, PLACES, 1.2, 2.5, 1, 1e-11);
}

/* min(1 - u^2, 0.95 - u): the corner before the top of the first, at which the second is taken. */
static void top_beyond_corner(int route)
{
    wheel x = turning(route);
    scene_ask_extreme(x.s, PM_ASK_MAX, SCENE_PROGRAM(x.s, K(1), U, SQUARE, SUB, K(0.95), U, SUB, MIN),
                      PM_NONE);
    const double u = 0.5 * (1 - sqrt(1.2));
    wheel_expect(x, PLACES, 0.5, 2.5, 1 - u * u, 1e-11);
}

/* |u| (1 + u^2) + 0.1: the corner at u = 0. */
static void bottom_at_corner(int route)
{
    wheel x = turning(route);
    scene_ask_extreme(x.s, PM_ASK_MIN, SCENE_PROGRAM(x.s, U, ABS, U, SQUARE, K(1), ADD, MUL, K(0.1), ADD),
                      PM_NONE);
    wheel_expect(x, PLACES, 0.3, 2.7, 0.1, 1e-11);
}

/* 1 + u as long as u < 0, then -u: the end of the first. */
static void top_at_jump(int route)
{
    wheel x = turning(route);
    scene_ask_extreme(x.s, PM_ASK_MAX,
                      SCENE_PROGRAM(x.s, U, K(0), scene_op(PM_OP_LT), K(1), U, ADD, U, scene_op(PM_OP_NEG),
                                    scene_op(PM_OP_SELECT)),
                      PM_NONE);
    wheel_expect(x, PLACES, 0.3, 2.7, 1, 1e-11);
}

/* min(1.5 + 10 u, 1 - 4 u^2, 1.5 - 10 u): between two corners that may both be between the same nodes. */
static void top_between_corners(int route)
{
    wheel x = turning(route);
    scene_ask_extreme(x.s, PM_ASK_MAX,
                      SCENE_PROGRAM(x.s, K(1.5), U, K(10), MUL, ADD, K(1), U, SQUARE, K(4), MUL, SUB, MIN,
                                    K(1.5), U, K(10), MUL, SUB, MIN),
                      PM_NONE);
    wheel_expect(x, PLACES, 0.5, 2.5, 1, 1e-11);
}

/* Where |sin 3 u| / (1.2 + u) is greatest, in its first wave before u = 0 (the second is lower). */
static void place_beside_corner(int route)
{
    wheel x = turning(route);
    scene_ask_extreme(
        x.s, PM_ASK_AT_MAX, SCENE_PROGRAM(x.s, U),
        SCENE_PROGRAM(x.s, U, K(3), MUL, scene_op(PM_OP_SIN), ABS, U, K(4), ADD, scene_op(PM_OP_DIV)));
    double u = -0.5; /* tan 3 u = 3 (u + 4) */
    for (int i = 0; i < 100; i++) u = (atan(3 * (u + 4)) - M_PI) / 3;
    wheel_expect(x, PLACES, 1.05, 1.25, u, 1e-6);
}

/* A rod falls round its end from the angle b of its free end above the level: that moves down fastest at the angle a from the
 * lowest position where 3 cos^2 a - 2 cos a cos a0 = 1.  The place is known as well as is told. */
static int place_of_fastest_fall(double b)
{
    const double l = 1.3, m = 2, c = cos(b + 0.5 * M_PI);
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    *scene_setting(s, PM_SETTING_MAX_TIME) = PM_NONE;
    *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
    const int rod = scene_body(s, m, m * l * l / 12, 0.5 * l * cos(b), 0.5 * l * sin(b), b);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5 * l, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    const int angle = scene_measure(s, PM_MEASURE_ANGLE, rod),
              fall = scene_part(s, PM_MEASURE_VELOCITY, scene_point(s, rod, 0.5 * l, 0), PM_PART_Y);
    const int place = scene_ask_extreme(s, PM_ASK_AT_MIN, scene_read(s, angle), scene_read(s, fall));
    scene_until(s, scene_when(s, PM_TRIGGER_FALL, scene_minus(s, angle, -2.9)), 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double off = fabs(s->out[place] - (acos((c + sqrt(c * c + 3)) / 3) - 0.5 * M_PI));
    CHECK(off < 1e-12);
    CHECK(off <= 5 * s->error[place] && s->error[place] < 1e-10);
    const int beyond = off > s->error[place];
    scene_free(s);
    return beyond;
}

/* cos(u^2 - e): flat where e = 0, two tops that have hardly parted where it is little more. */
static void flat_top(int route, double e)
{
    wheel x = turning(route);
    scene_ask_extreme(x.s, PM_ASK_MAX, SCENE_PROGRAM(x.s, U, SQUARE, K(e), SUB, scene_op(PM_OP_COS)),
                      PM_NONE);
    wheel_expect(x, PLACES, 1, 2, 1, 1e-11);
}

/* cos(a (u^2 - e)) with two tops that have parted by little, and the dip between them about where the run begins or ends: one
 * top is left. */
static void parted_tops(int route, double a, double e, double middle, double end)
{
    wheel x = wheel_turning(route, end);
    const double near = 0.95 * sqrt(e);
    scene_ask_extreme(x.s, PM_ASK_MAX,
                      SCENE_PROGRAM(x.s, U, SQUARE, K(e), SUB, K(a), MUL, scene_op(PM_OP_COS)), PM_NONE);
    wheel_expect(x, PLACES, middle - near, middle + near, 1, 1e-11);
}

/* max(1 - sqrt(u^2 + e^2), -9): narrow beside the way, most of them beside a part of it by halves, where a window ends: each half
 * of the top is a straight line with a corner at its end. */
static void narrow_top(int route, double e, int halvings)
{
    wheel x = turning(route);
    scene_ask_extreme(
        x.s, PM_ASK_MAX,
        SCENE_PROGRAM(x.s, K(1), U, SQUARE, K(e * e), ADD, scene_op(PM_OP_SQRT), SUB, K(-9), MAX), PM_NONE);
    const double middle = END / (1 << halvings);
    wheel_expect(x, PLACES, middle - 2 * e, middle + 2 * e, 1 - e, 1e-11);
}

/* max(exp(-(u / e)^2), 0.9 - u / 100): no node or one by chance stands in its top. */
static void top_over_floor(int route, double e)
{
    wheel x = turning(route);
    scene_ask_extreme(x.s, PM_ASK_MAX,
                      SCENE_PROGRAM(x.s, U, K(e), scene_op(PM_OP_DIV), SQUARE, scene_op(PM_OP_NEG),
                                    scene_op(PM_OP_EXP), K(0.95), U, K(100), scene_op(PM_OP_DIV), SUB, MAX),
                      PM_NONE);
    wheel_expect(x, PLACES, 0.3, 2.7, 1, 1e-11);
}

/* 0.0008 exp(-(u / 0.07)^2) - (angle - 1.2)^4 / 27: a low top between nodes, where all the rest is nearly level. */
static void low_top_on_a_level_place(int route)
{
    wheel x = turning(route);
    scene_ask_extreme(x.s, PM_ASK_MAX,
                      SCENE_PROGRAM(x.s, U, K(0.07), scene_op(PM_OP_DIV), SQUARE, scene_op(PM_OP_NEG),
                                    scene_op(PM_OP_EXP), K(8e-4), MUL, scene_m(x.turned), K(1.2), SUB, K(4),
                                    scene_op(PM_OP_POW), K(27), scene_op(PM_OP_DIV), SUB),
                      PM_NONE);
    for (int i = 0; i < 10 * PLACES; i++) {
        const double c = 0.7 + (i + 0.37) / (10 * PLACES);
        EQUAL(scene_run(x.s, &c), PM_OK);
        CHECK(x.s->out[0] >= 8e-4 - pow(c - 1.2, 4) / 27 - 1e-12);
    }
    scene_free(x.s);
}

/* |(u > 0) - 0.4|: 0.4, then 0.6, and nothing between though what is between the bars jumps through zero. */
static void jump_before_a_corner(int route, int kind)
{
    wheel x = turning(route);
    scene_ask_extreme(
        x.s, kind,
        SCENE_PROGRAM(x.s, U, K(0), scene_op(PM_OP_GT), K(0.4), SUB, ABS, U, SQUARE, K(1e-3), MUL, ADD),
        PM_NONE);
    for (int i = 0; i < PLACES; i++) {
        const double c = 0.3 + 2.4 * (i + 0.37) / PLACES, far = pow(END - c, 2) * 1e-3;
        EQUAL(scene_run(x.s, &c), PM_OK);
        NEAR(x.s->out[0], kind == PM_ASK_MAX ? 0.6 + far : 0.4, 1e-11);
    }
    scene_free(x.s);
}

/* u^3 / 3 - e u, just what the cubic through two nodes is: the top at u = -sqrt(e), up to where the value rises again. */
static void cubic_top(int route, double e)
{
    wheel x = turning(route);
    const double far = sqrt(e);
    scene_ask_extreme(
        x.s, PM_ASK_MAX,
        SCENE_PROGRAM(x.s, U, K(3), scene_op(PM_OP_POW), K(3), scene_op(PM_OP_DIV), U, K(e), MUL, SUB),
        PM_NONE);
    wheel_expect(x, PLACES, END - 1.9 * far, END + 0.9 * far, 2 * e * far / 3, 1e-11);
}

/* 1 - u^2, but no value where |u| < 0.01, its greatest place included: that answer has none, the run has. */
static void no_value_at_top(int route)
{
    wheel x = turning(route);
    scene *s = x.s;
    const int none = scene_ask_extreme(s, PM_ASK_AT_MAX, SCENE_PROGRAM(s, U),
                                       SCENE_PROGRAM(s, K(1), U, SQUARE, SUB, U, SQUARE, K(1e-4), SUB,
                                                     scene_op(PM_OP_SQRT), K(0), MUL, ADD));
    const int end = scene_ask_measure(s, x.turned);
    for (int i = 0; i < 2 * PLACES; i++) {
        const double c = 0.5 + 2 * (i + 0.37) / (2 * PLACES);
        EQUAL(scene_run(s, &c), PM_OK);
        CHECK(isnan(s->out[none]));
        EQUAL(s->reason[0], PM_REASON_UNDEFINED);
        NEAR(s->out[end], END, 1e-9);
    }
    scene_free(s);
}

/* At loose accuracies an extreme is not looked for where it makes little difference: what that leaves out is told. */
static void what_is_left_out_is_told(int route)
{
    int off = 0;
    for (int digits = 2; digits <= 6; digits++) {
        wheel x = turning(route);
        const int top = scene_ask_extreme(x.s, PM_ASK_MAX,
                                          SCENE_PROGRAM(x.s, U, K(1.7), MUL, scene_op(PM_OP_COS)), PM_NONE);
        scene_set(x.s, PM_SETTING_ACCURACY, pow(10, -digits));
        *scene_setting(x.s, PM_SETTING_ESTIMATE) = 1;
        for (int i = 0; i < 10 * PLACES; i++) {
            const double c = 0.3 + 2.4 * (i + 0.37) / (10 * PLACES);
            EQUAL(scene_run(x.s, &c), PM_OK);
            off += 1 - x.s->out[top] > 1e-13;
            CHECK(fabs(1 - x.s->out[top]) <= x.s->error[top] + 1e-15);
        }
        scene_free(x.s);
    }
    if (route == PM_ROUTE_PATH) CHECK(off > 0); /* else nothing has been shown */
}

int main(void)
{
    for (size_t i = 0; i < sizeof routes / sizeof *routes; i++) {
        top_beside_corner(routes[i]);
        top_at_corner(routes[i]);
        top_beyond_corner(routes[i]);
        bottom_at_corner(routes[i]);
        top_at_jump(routes[i]);
        top_between_corners(routes[i]);
        place_beside_corner(routes[i]);
        flat_top(routes[i], 0);
        flat_top(routes[i], 1e-4);
        flat_top(routes[i], 1e-2);
        for (int k = 0; k < PARTED; k++) {
            parted_tops(routes[i], 0.3, parted[k], 0, END);
            parted_tops(routes[i], 0.7, parted[k], 0, END);
            for (double end = END; end > 2.6; end -= 0.13) {
                parted_tops(routes[i], 0.3, parted[k], end, end);
                parted_tops(routes[i], 0.7, parted[k], end, end);
            }
        }
        for (int k = 0; k < PARTED; k++) cubic_top(routes[i], parted[k]);
        for (int halvings = 1; halvings < 6; halvings++) {
            narrow_top(routes[i], 1e-3, halvings);
            narrow_top(routes[i], 1e-5, halvings);
        }
        top_over_floor(routes[i], 1e-2);
        top_over_floor(routes[i], 1e-3);
        if (routes[i] != PM_ROUTE_IDA) { /* which takes a hundred times as long, and searches alike */
            low_top_on_a_level_place(routes[i]);
            jump_before_a_corner(routes[i], PM_ASK_MIN);
            jump_before_a_corner(routes[i], PM_ASK_MAX);
        }
        no_value_at_top(routes[i]);
        what_is_left_out_is_told(routes[i]);
    }
    int beyond = 0;
    for (double b = 0.01; b < 1.3; b += 0.01) beyond += place_of_fastest_fall(b);
    CHECK(beyond <= 10); /* of 129 */
    return check_failures();
}
