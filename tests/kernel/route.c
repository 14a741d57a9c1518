/* Routes: the error follows the tolerance, the dense output meets the exact states, and both routes in time give the same
 * answers for swings, rolling, throws, bounces and sliding; what is said at once is what time makes of it. */
#include "state/route.h"

#include "check.h"
#include "equations/active_set.h"
#include "events/event.h"
#include "run/run.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define G 9.81
#define PI 3.14159265358979323846

static scene *swing(void)
{
    scene *s = scene_create();
    const int a = scene_body(s, 1, 1 / 12., 0.5, 0, 0), b = scene_body(s, 1, 1 / 12., 1.5, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), scene_point(s, a, 0.5, 0), 0);
    const int tip = scene_point(s, b, 0.5, 0);
    scene_until_time(s, 2);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, tip, PM_PART_X));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, tip, PM_PART_Y));
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, tip, PM_PART_NORM)),
                      PM_NONE);
    return s;
}

/* A hoop with a collar fixed on it rolls on level ground, one turn. */
static scene *collar(void)
{
    const double r = 0.3, d = 0.2;
    scene *s = scene_create();
    const int hoop = scene_body(s, 2, 2 * r * r, 0, r, 0), c = scene_body(s, 2, 0, 0, r - d, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, hoop, 0, -d), scene_point(s, c, 0, 0), 0);
    scene_joint(s, PM_JOINT_ROLLING_LINE, scene_circle(s, scene_point(s, hoop, 0, 0), r), scene_floor(s, 0),
                0);
    scene_start_omega(s, hoop, -15);
    const int turned = scene_measure(s, PM_MEASURE_TURNED, hoop);
    scene_until(s,
                scene_when(s, PM_TRIGGER_CROSS,
                           SCENE_PROGRAM(s, scene_m(turned), scene_k(s, 4 * acos(0.)), scene_op(PM_OP_ADD))),
                1);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, hoop));
    scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, scene_measure(s, PM_MEASURE_JOINT_NORMAL, 1)), PM_NONE);
    return s;
}

/* A ball thrown on the floor that bounces, and passes a height on its way. */
static scene *ball(void)
{
    scene *s = scene_create();
    const int p = scene_point(s, scene_body(s, 1, 0, 0, 1, 0), 0, 0),
              y = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_Y);
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0.1), scene_floor(s, 0), 0, 0.8,
                                PM_FRICTION_SMOOTH, 0);
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, c),
              height = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, y, 0.3));
    scene_start_velocity(s, p, 1, 1);
    scene_until(s, strike, 3);
    scene_ask_measure(s, scene_time(s));
    scene_ask_count(s, height);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_Y));
    return s;
}

/* A particle leaves a smooth circle. */
static scene *leaves(void)
{
    scene *s = scene_create();
    const int p = scene_point(s, scene_body(s, 1, 0, 0, 1, 0), 0, 0),
              y = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_Y);
    const int c =
        scene_contact(s, PM_CONTACT_CIRCLE, scene_circle(s, p, 0),
                      scene_circle(s, scene_point(s, PM_GROUND, 0, 0), 1), 1, 0, PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, p, 0.5, 0);
    const int opens = scene_on(s, PM_TRIGGER_OPEN, c);
    scene_until(s, opens, 1);
    scene_ask_measure(s, y);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_NORM));
    scene_ask_measure(s, scene_time(s));
    return s;
}

/* A sphere that slides, then rolls. */
static scene *bowl(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 2, 0.008, 0, 0.1, 0), g = scene_point(s, b, 0, 0);
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, 0.1), scene_floor(s, 0), 0, 0,
                                PM_FRICTION_COULOMB, 0.2);
    scene_start(s, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X), 4);
    scene_until_time(s, 1);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, scene_on(s, PM_TRIGGER_STICK, c)));
    return s;
}

typedef scene *maker(void);
static maker *const makers[] = {swing, collar, ball, leaves, bowl};
enum { MAKERS = sizeof makers / sizeof *makers };

static int run(maker *make, int route, double accuracy, double out[3])
{
    scene *s = make();
    scene_route(s, route, accuracy);
    const int status = scene_run(s, NULL);
    for (int i = 0; i < 3; i++) out[i] = s->out[i];
    if (status == PM_OK) {
        EQUAL(s->count[PM_COUNT_ROUTE], route);
        CHECK(s->audit[PM_AUDIT_ENERGY] <= fmax(1e-7, 1e4 * accuracy));
    }
    scene_free(s);
    return status;
}

/* No tolerance gives an error far above it, and a finer one a smaller error. */
static void converges(void)
{
    for (int i = 0; i < MAKERS; i++) {
        double best[3], out[3];
        EQUAL(run(makers[i], PM_ROUTE_RK, 1e-13, best), PM_OK);
        for (double accuracy = 1e-4; accuracy > 1e-12; accuracy *= 1e-2) {
            EQUAL(run(makers[i], PM_ROUTE_RK, accuracy, out), PM_OK);
            for (int k = 0; k < 3; k++) NEAR(out[k], best[k], 100 * accuracy * (1 + fabs(best[k])));
        }
    }
}

/* Two rods in motion.  The route `state` says the accelerations and the force on the pin at the start; the same by
 * differences of velocities and momentum that a route in time has a little later. */
static scene *two_rods(void)
{
    scene *s = scene_create();
    const int a = scene_body(s, 1, 1 / 12., 0.5, 0, 0), b = scene_body(s, 1, 1 / 12., 1, -0.5, 1.5 * PI);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), scene_point(s, a, 0.5, 0), 0);
    scene_start_omega(s, a, 2);
    scene_start_omega(s, b, -3);
    return s;
}

static void at_once(double out[5])
{
    scene *s = two_rods();
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_STATE;
    const int tip = scene_point(s, 1, 0.5, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_START, PM_NONE), 1);
    for (int k = 0; k < 2; k++)
        scene_ask_measure(s, scene_part(s, PM_MEASURE_ACCELERATION, tip, PM_PART_X + k));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_ALPHA, 1));
    for (int k = 0; k < 2; k++) scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_X + k));
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->count[PM_COUNT_ROUTE], PM_ROUTE_STATE);
    memcpy(out, s->out, 5 * sizeof *out);
    scene_free(s);
}

/* The slope of f at 0 is (-25 f(0) + 48 f(h) - 36 f(2h) + 16 f(3h) - 3 f(4h)) / 12 h, to the fourth order in h. */
static void by_differences(int route, double h, double out[5])
{
    static const double weight[] = {48, -36, 16, -3};
    scene *s = two_rods();
    scene_route(s, route, route == PM_ROUTE_IDA ? 1e-10 : 1e-13);
    const int tip = scene_point(s, 1, 0.5, 0), a = scene_point(s, 0, 0, 0), b = scene_point(s, 1, 0, 0);
    const int start = scene_on(s, PM_TRIGGER_START, PM_NONE),
              later =
                  scene_when(s, PM_TRIGGER_EVERY,
                             SCENE_PROGRAM(s, scene_m(scene_time(s)), scene_k(s, h), scene_op(PM_OP_DIV)));
    int program[5];
    program[2] = scene_read(s, scene_measure(s, PM_MEASURE_OMEGA, 1));
    for (int k = 0; k < 2; k++) {
        program[k] = scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, tip, PM_PART_X + k));
        program[3 + k] =
            SCENE_PROGRAM(s, scene_m(scene_part(s, PM_MEASURE_VELOCITY, a, PM_PART_X + k)),
                          scene_m(scene_part(s, PM_MEASURE_VELOCITY, b, PM_PART_X + k)), scene_op(PM_OP_ADD));
    }
    for (int i = 0; i < 5; i++) {
        scene_ask_event(s, program[i], start, 1, 0);
        scene_ask(s, PM_ASK_EACH, program[i], later, 1, 0, PM_NONE, PM_NONE, 4);
    }
    scene_until(s, later, 4);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->count[PM_COUNT_ROUTE], route);
    for (int i = 0; i < 5; i++) {
        const double *f = s->out + 5 * i;
        double sum = -25 * f[0];
        for (int k = 0; k < 4; k++) sum += weight[k] * f[1 + k];
        out[i] = sum / (12 * h) + (i == 4 ? 2 * G : 0); /* force on both rods but for their weight */
    }
    scene_free(s);
}

/* A rod flies into a cord, which is just tight and gives back e of its speed (the route `jump`), or into a very stiff spring
 * with a damper, in time: while they pull on the mass m, half a period of ln(1/e) = pi z / sqrt(1 - z^2). */
static void caught(double stiffness, double out[3])
{
    const double e = 0.6, angle = 0.4, mass = 2, inertia = 0.2;
    const double arm[] = {0.5 * cos(angle), 0.5 * sin(angle)}, at[] = {0.3 + arm[0], 0.2 + arm[1]};
    const double reach = hypot(at[0], at[1]), lever = (arm[0] * at[1] - arm[1] * at[0]) / reach,
                 felt = 1 / (1 / mass + lever * lever / inertia), z = -log(e) / hypot(PI, log(e));
    scene *s = scene_create();
    const int rod = scene_body(s, mass, inertia, 0.3, 0.2, angle);
    const int end = scene_point(s, rod, 0.5, 0), g = scene_point(s, rod, 0, 0),
              hook = scene_point(s, PM_GROUND, 0, 0);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    scene_start_velocity(s, g, 1.5, 0.5);
    scene_start_omega(s, rod, 2);
    if (stiffness > 0) {
        const int spring = scene_force(s, PM_FORCE_SPRING, end, hook, stiffness, reach);
        scene_force(s, PM_FORCE_DAMPER, end, hook, 2 * z * sqrt(stiffness * felt), 0);
        scene_route(s, PM_ROUTE_RK, 1e-10);
        const int stretch = scene_read(s, scene_measure(s, PM_MEASURE_FORCE_STRETCH, spring));
        scene_until(s, scene_when(s, PM_TRIGGER_FALL, stretch), 1);
    } else {
        scene_cord(s, scene_circle(s, end, 0), 1, scene_circle(s, hook, 0), 1, 0, e);
        *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_JUMP;
        scene_until(s, scene_on(s, PM_TRIGGER_START, PM_NONE), 1);
    }
    scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, rod));
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->count[PM_COUNT_ROUTE], stiffness > 0 ? PM_ROUTE_RK : PM_ROUTE_JUMP);
    memcpy(out, s->out, 3 * sizeof *out);
    scene_free(s);
}

static void routes_agree(void)
{
    for (int i = 0; i < MAKERS; i++) {
        double rk[3], ida[3];
        EQUAL(run(makers[i], PM_ROUTE_RK, 1e-12, rk), PM_OK);
        EQUAL(run(makers[i], PM_ROUTE_IDA, 1e-9, ida), PM_OK);
        for (int k = 0; k < 3; k++) NEAR(ida[k], rk[k], 1e-5 * (1 + fabs(rk[k])));
    }
    double state[5], later[5], jump[3], spring[3];
    at_once(state);
    by_differences(PM_ROUTE_RK, 5e-4, later);
    for (int k = 0; k < 5; k++) NEAR(later[k], state[k], 1e-8 * (1 + fabs(state[k])));
    by_differences(PM_ROUTE_IDA, 4e-3, later);
    for (int k = 0; k < 5; k++) NEAR(later[k], state[k], 1e-5 * (1 + fabs(state[k])));
    caught(0, jump);
    caught(1e12, spring);
    for (int k = 0; k < 3; k++) NEAR(jump[k], spring[k], 1e-4);
}

/* Inside a step the dense output is as good as the order that it has, and continuous at both ends. */
static void dense_output(int route, double tolerance)
{
    scene *s = swing();
    scene_route(s, route, 1e-9);
    if (CHECK(scene_begin(s) == PM_OK)) {
        pm_workspace *w = s->w;
        const int nq = w->model->nq;
        w->event->nfunction = 0;
        CHECK(pm_plan_phase(w) == PM_OK);
        pm_event_begin(w);
        CHECK(w->phase.route->begin(w) == PM_OK);
        for (int step = 0; step < 40; step++) {
            double begin[12], dense[12], x[12];
            memcpy(begin, w->state.q, sizeof(double) * 2 * (size_t)nq);
            memset(w->event->root, 0, sizeof(int) * (size_t)w->event->nfunction);
            if (!CHECK(w->phase.route->step(w, 1.9) == PM_OK) || w->state.t >= 1.9) break;
            CHECK(w->step.begin < w->step.end && w->step.end == w->state.t);
            for (int k = 0; k <= 8; k++) {
                const double t = w->step.begin + (w->step.end - w->step.begin) * k / 8.;
                CHECK(w->phase.route->at(w, t, &w->probe) == PM_OK);
                memcpy(dense, w->probe.q, sizeof dense);
                CHECK(w->phase.route->exact(w, t, &w->probe) == PM_OK);
                memcpy(x, w->probe.q, sizeof x);
                for (int i = 0; i < 2 * nq; i++) NEAR(dense[i], x[i], tolerance);
                if (k == 0)
                    for (int i = 0; i < 2 * nq; i++) NEAR(dense[i], begin[i], tolerance);
                if (k == 8)
                    for (int i = 0; i < 2 * nq; i++) NEAR(dense[i], w->state.q[i], tolerance);
            }
            pm_frame_look_state(&w->frame, &w->state);
            pm_active_set_follow(&w->frame, &w->active, &w->state);
        }
    }
    scene_free(s);
}

int main(void)
{
    converges();
    dense_output(PM_ROUTE_RK, 1e-8);
    routes_agree();
    return check_failures();
}
