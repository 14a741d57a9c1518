/* Programs and measures without a derivative: ida takes differences of them. */
#include "check.h"
#include "elements/constraint.h"
#include "elements/force.h"
#include "elements/measure.h"
#include "elements/slope.h"
#include "routes/ida/ida.h"
#include "scene.h"
#include "state/workspace.h"

enum { MOST = 400 };

/* At rest the size of the velocity has no derivative, and F = -(3 + 2 |v|) v has -3 all the same; what overflows in a peak has none
 * that counts. */
static void program_without_derivative(void)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_IDA;
    const int body = scene_body(s, 1, 0, 0, 0, 0), point = scene_point(s, body, 0, 0);
    const scene_code vx = scene_m(scene_part(s, PM_MEASURE_VELOCITY, point, PM_PART_X)),
                     vy = scene_m(scene_part(s, PM_MEASURE_VELOCITY, point, PM_PART_Y)),
                     x = scene_m(scene_part(s, PM_MEASURE_POSITION, point, PM_PART_X));
    const scene_code mul = scene_op(PM_OP_MUL), add = scene_op(PM_OP_ADD);
    const int drag = SCENE_PROGRAM(s, scene_k(s, 2), vx, vy, scene_op(PM_OP_HYPOT), mul, scene_k(s, 3), add,
                                   vx, mul, scene_op(PM_OP_NEG));
    const int peak =
        SCENE_PROGRAM(s, scene_k(s, 1), scene_k(s, 1), x, add, scene_k(s, 1000), mul, scene_op(PM_OP_EXP),
                      scene_k(s, 2), scene_op(PM_OP_POW), scene_op(PM_OP_DIV));
    scene_applied(s, point, PM_GROUND, drag, peak);
    if (EQUAL(scene_begin(s), PM_OK)) {
        double y[MOST] = {0}, yp[MOST] = {0};
        pm_ida_system_layout(s->w);
        EQUAL(pm_ida_system_start(s->w, y, yp), PM_OK);
        pm_ida_jacobian_evaluate(s->w, 0, 24, y, yp);
        NEAR(s->w->ida->jacobian.damping[0], -3, 1e-6);
        for (int i = 0; i < 9; i++) EQUAL(s->w->ida->jacobian.stiffness[i], 0);
    }
    scene_free(s);
}

/* Accelerations have no derivative in closed form: with those of the body as they are, a_x - alpha r_y - omega^2 r_x. */
static void measure_without_derivative(void)
{
    scene *s = scene_create();
    const int body = scene_body(s, 1, 0.2, 0.3, 0, 0), point = scene_point(s, body, 0.4, 0.7);
    const int read = scene_part(s, PM_MEASURE_ACCELERATION, point, PM_PART_X);
    scene_couple(s, body, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, 0.5)));
    scene_start_omega(s, body, 1.5);
    if (EQUAL(scene_begin(s), PM_OK)) {
        pm_slope slope;
        pm_arena arena = {NULL};
        EQUAL(pm_slope_create(&arena, &slope, s->w->model), PM_OK);
        CHECK(pm_measure_moves(s->w->model, read));
        pm_measure_slope(s->w, read, 2, &slope);
        NEAR(slope.v[2], 2 * -2 * 1.5 * 0.4, 1e-8);
        NEAR(slope.q[2], 2 * (1.5 * 1.5 * 0.7 - 2.5 * 0.4), 1e-8);
        NEAR(slope.q[0], 0, 1e-8);
        EQUAL(s->w->frame.level, PM_LEVEL_DYNAMIC);
        pm_arena_free(&arena);
    }
    scene_free(s);
}

int main(void)
{
    measure_without_derivative();
    program_without_derivative();
    return check_failures();
}
