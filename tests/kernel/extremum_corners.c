/* Extremes of values with corners, random ones: between two that stand between the same nodes of a step, and far from one but
 * beside the start.  u is the angle of a wheel that turns evenly, less c. */
#include "wheel.h"

#define TOPS 300  /* of each route */
#define MORE 5000 /* of the one whose steps are longest beside their nodes */

#define K(number) scene_k(w.s, number)
#define ADD scene_op(PM_OP_ADD)
#define SUB scene_op(PM_OP_SUB)
#define MUL scene_op(PM_OP_MUL)
#define MIN scene_op(PM_OP_MIN)
#define U scene_m(w.turned), K(c), SUB
#define V U, K(place), SUB

/* 1 - bend (u - place)^2 for |u| < half; beyond, lines through its ends there that are steeper than it.  What is left out at a
 * loose accuracy is told. */
static void top_between_corners(int route)
{
    const double end = check_random(0.5, 6), c = check_random(0.1, end - 0.1),
                 half = pow(10, check_random(-3, -1.5)), place = check_random(-0.9, 0.9) * half,
                 bend = pow(10, check_random(-2, 2)), steep = bend * half * pow(10, check_random(0.61, 2));
    const double left = 1 - bend * pow(half + place, 2), right = 1 - bend * pow(half - place, 2);
    wheel w = wheel_turning(route, end);
    const int top = scene_ask_extreme(w.s, PM_ASK_MAX,
                                      SCENE_PROGRAM(w.s, U, K(half), ADD, K(steep), MUL, K(left), ADD, V, V,
                                                    MUL, K(-bend), MUL, K(1), ADD, MIN, U, K(half), SUB,
                                                    K(-steep), MUL, K(right), ADD, MIN),
                                      PM_NONE);
    scene_set(w.s, PM_SETTING_ACCURACY, pow(10, check_random(-8, -2)));
    *scene_setting(w.s, PM_SETTING_ESTIMATE) = 1;
    EQUAL(scene_run(w.s, NULL), PM_OK);
    NEAR(w.s->out[top], 1, w.s->error[top] + 1e-12);
    scene_free(w.s);
}

#define PLACE_COS scene_v(w.c), scene_op(PM_OP_COS)
#define PLACE_SIN scene_v(w.c), scene_op(PM_OP_SIN)
#define COSINE scene_m(w.x), PLACE_COS, MUL, scene_m(w.y), PLACE_SIN, MUL, ADD

/* max(cos u - cos 2 u / (4 cos q), floor): tops at u = +-q that have hardly parted, the second one right after the start; the floor
 * is reached later on. */
static void parted_tops_beside_start(int route)
{
    const double q = pow(10, check_random(-3, -0.5)), b = 0.25 / cos(q), floor = check_random(-0.5, 0.5);
    wheel w = wheel_turning(route, check_random(1.6, 3));
    scene_ask_extreme(w.s, PM_ASK_MAX,
                      SCENE_PROGRAM(w.s, COSINE, COSINE, COSINE, MUL, K(2 * b), MUL, SUB, K(b), ADD, K(floor),
                                    scene_op(PM_OP_MAX)),
                      PM_NONE);
    scene_set(w.s, PM_SETTING_ACCURACY, 1e-10);
    wheel_expect(w, 10, -0.95 * q, 0.95 * q, 0.5 * cos(q) + b, 1e-12);
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_PATH, PM_ROUTE_RK, PM_ROUTE_IDA, PM_ROUTE_UNIFORM};
    for (size_t r = 0; r < sizeof routes / sizeof *routes; r++)
        for (int i = 0; i < TOPS; i++) {
            top_between_corners(routes[r]);
            if (routes[r] != PM_ROUTE_IDA) parted_tops_beside_start(routes[r]);
        }
    for (int i = 0; i < MORE; i++) top_between_corners(PM_ROUTE_UNIFORM);
    return check_failures();
}
