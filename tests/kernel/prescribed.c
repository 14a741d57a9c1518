/* Places that are prescribed over the time: a corner is a blow, a jump is refused, and no route takes what changes for
 * uniform. */
#include "check.h"
#include "scene.h"
#include "state/workspace.h"

/* A disk on a pin whose angle is given; what is asked at the end: angle, spin. */
static scene *driven_disk(int route, int program, scene *s)
{
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int body = scene_body(s, 2, 0.04, 0, 0, 0);
    scene_drive(s, PM_JOINT_PIN_ANGLE, scene_point(s, body, 0, 0), scene_point(s, PM_GROUND, 0, 0), program,
                PM_NONE);
    scene_until_time(s, 2);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, body));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, body));
    return s;
}

/* 2 |t - 1| - 2 */
static void a_corner(int route)
{
    scene *s = scene_create();
    driven_disk(route,
                SCENE_PROGRAM(s, scene_m(scene_time(s)), scene_k(s, 1), scene_op(PM_OP_SUB),
                              scene_op(PM_OP_ABS), scene_k(s, 2), scene_op(PM_OP_MUL), scene_k(s, 2),
                              scene_op(PM_OP_SUB)),
                s);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->count[PM_COUNT_JUMPS], 1);
    NEAR(s->out[0], 0, 1e-13);
    NEAR(s->out[1], 2, 1e-12);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-12);
    scene_free(s);
}

/* The lesser, or the greater, of k (t - 1) and 0, in either order, less what it is at first: at 1 the two are equal. */
static void a_corner_of_two(int route, int op, int swapped, double k)
{
    scene *s = scene_create();
    const scene_code t = scene_m(scene_time(s)), zero = scene_k(s, 0), one = scene_k(s, 1),
                     by = scene_k(s, k);
    const scene_code minus = scene_op(PM_OP_SUB), times = scene_op(PM_OP_MUL), choice = scene_op(op);
    const double rate = (k > 0) == (op == PM_OP_MAX) ? k : 0, first = rate == 0 ? -k : 0;
    const scene_code at_first = scene_k(s, first);
    const int program = swapped ? SCENE_PROGRAM(s, zero, t, one, minus, by, times, choice, at_first, minus)
                                : SCENE_PROGRAM(s, t, one, minus, by, times, zero, choice, at_first, minus);
    driven_disk(route, program, s);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->count[PM_COUNT_JUMPS], 1);
    NEAR(s->out[0], rate - first, 1e-13);
    NEAR(s->out[1], rate, 1e-12);
    scene_free(s);
}

/* t + 0.1 (t > 1) */
static void a_jump(int route)
{
    scene *s = scene_create();
    const scene_code t = scene_m(scene_time(s));
    driven_disk(route,
                SCENE_PROGRAM(s, t, scene_k(s, 0.1), t, scene_k(s, 1), scene_op(PM_OP_GT),
                              scene_op(PM_OP_MUL), scene_op(PM_OP_ADD)),
                s);
    EQUAL(scene_run(s, NULL), PM_DRIVE_JUMPS);
    scene_free(s);
}

/* A particle that is carried along (t, sin t) by default: its time is stepped through, and one along (t, 2 t) is not. */
static void carried(int straight)
{
    scene *s = scene_create();
    const scene_code t = scene_m(scene_time(s));
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    const int body = scene_body(s, 1, 0.1, 0, 0, 0), point = scene_point(s, body, 0, 0);
    const int up = straight ? SCENE_PROGRAM(s, t, scene_k(s, 2), scene_op(PM_OP_MUL))
                            : SCENE_PROGRAM(s, t, scene_op(PM_OP_SIN));
    const int drive =
        scene_drive(s, PM_JOINT_PLACED, point, scene_point(s, PM_GROUND, 0, 0), SCENE_PROGRAM(s, t), up);
    scene_until_time(s, 2);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, point, PM_PART_Y));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, drive, PM_PART_Y));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_POWER, drive));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double force = 9.81 - (straight ? 0 : sin(2));
    NEAR(s->out[0], straight ? 4 : sin(2), 1e-13);
    NEAR(s->out[1], force, 1e-12);
    NEAR(s->out[2], force * (straight ? 2 : cos(2)), 1e-12);
    EQUAL(s->count[PM_COUNT_ROUTES], (int64_t)1 << (straight ? PM_ROUTE_UNIFORM : PM_ROUTE_RK));
    scene_free(s);
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int k = 0; k < 3; k++) {
        a_corner(routes[k]);
        for (int i = 0; i < 8; i++)
            a_corner_of_two(routes[k], i & 1 ? PM_OP_MIN : PM_OP_MAX, i & 2, i & 4 ? 2 : -2);
        a_jump(routes[k]);
    }
    carried(0);
    carried(1);
    return check_failures();
}
