/* small_motion.c - modes beside closed forms: of pendulums with dampers, of a parallelogram, of what nothing holds, of what
 * falls over; what is asked of them at an event leaves the run as it is; what else may not read them. */
#include "check.h"
#include "scene.h"

#define G 9.81
#define CASES 40
#define GOOD 1e-10
#define SPAN 3.0 /* m, of a parallelogram */

static int mode(scene *s, int kind, int number)
{
    return scene_read(s, scene_measure_with(s, kind, PM_NONE, PM_PART_NONE, PM_MEASURE_MEMBER, number));
}

static scene *at_start(void)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    scene_until(s, scene_on(s, PM_TRIGGER_START, PM_NONE), 1);
    return s;
}

/* A rod that hangs from (x, 0): from it an angle away. */
static int hanging(scene *s, double x, double length, double mass, double angle)
{
    const double at = angle - 0.5 * 3.14159265358979323846;
    const int b = scene_body(s, mass, mass * length * length / 12, x + 0.5 * length * cos(at),
                             0.5 * length * sin(at), at);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5 * length, 0), scene_point(s, PM_GROUND, x, 0), 0);
    return b;
}

/* m l^2/3 a'' + c a' + (m g l/2 + k) a = 0, with a weak or a strong damper. */
static void a_pendulum(double k_of, double c_of)
{
    scene *s = at_start();
    const double l = check_random(0.1, 10), m = check_random(0.1, 10), inertia = m * l * l / 3;
    const double stiffness = m * G * l / 2 * (1 + k_of), w = sqrt(stiffness / inertia),
                 c = 2 * c_of * sqrt(stiffness * inertia);
    const int b = hanging(s, 0, l, m, 0);
    scene_force(s, PM_FORCE_TORSION, b, PM_GROUND, k_of * m * G * l / 2, -0.5 * 3.14159265358979323846);
    scene_force(s, PM_FORCE_ROTARY_DAMPER, b, PM_GROUND, c, 0);
    const int omega = scene_ask_end(s, mode(s, PM_MEASURE_MODE_OMEGA, 1));
    const int damping = scene_ask_end(s, mode(s, PM_MEASURE_MODE_DAMPING, 1));
    const int count = scene_ask_measure(s, scene_measure(s, PM_MEASURE_MODES_COUNT, PM_NONE));
    const int growth = scene_ask_measure(s, scene_measure(s, PM_MEASURE_MODES_GROWTH, PM_NONE));
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, b));
    const int alpha = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ALPHA, b));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[angle], -0.5 * 3.14159265358979323846,
         1e-15); /* what is asked behind them is of the same state */
    NEAR(s->out[alpha], 0, 1e-13 * w * w);
    const double root = c_of > 1 ? sqrt(c_of * c_of - 1) : 0; /* the slower of two that do not swing */
    EQUAL(s->out[count], c_of > 1 ? 2 : 1);
    NEAR(s->out[omega], w * (c_of > 1 ? c_of - root : 1), GOOD * w);
    NEAR(s->out[damping], c_of > 1 ? 1 : c_of, GOOD);
    NEAR(s->out[growth], -w * (c_of > 1 ? c_of - root : c_of), GOOD * w);
    scene_free(s);
}

/* What stands upright: one motion grows, the other dies away. */
static void an_upright_rod(void)
{
    scene *s = at_start();
    const double l = check_random(0.1, 10), w = sqrt(1.5 * G / l);
    hanging(s, 0, l, 2, 3.14159265358979323846);
    const int growth = scene_ask_measure(s, scene_measure(s, PM_MEASURE_MODES_GROWTH, PM_NONE));
    const int first = scene_ask_end(s, mode(s, PM_MEASURE_MODE_DAMPING, 1));
    const int second = scene_ask_end(s, mode(s, PM_MEASURE_MODE_DAMPING, 2));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[growth], w, GOOD * w);
    EQUAL(s->out[first] + s->out[second], 0);
    EQUAL(fabs(s->out[first]), 1);
    scene_free(s);
}

/* Joins the ends of two rods of length l that hang SPAN apart. */
static void coupler(scene *s, int a, int b, double l, double mass, double angle)
{
    const int c = scene_body(s, mass, 1, 0.5 * SPAN + l * sin(angle), -l * cos(angle), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, 0.5 * l, 0), scene_point(s, c, -0.5 * SPAN, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, 0.5 * l, 0), scene_point(s, c, 0.5 * SPAN, 0), 0);
}

/* Two equal rods and a coupler, a loop: at an angle it is no equilibrium, and the tangent to its path is what counts.
 * (2/3 m + M) l a'' = -(m + M) g sin a, at any speed; about an angle a0: w^2 = (m + M) g cos a0 / ((2/3 m + M) l). */
static void a_parallelogram(double angle, double speed)
{
    scene *s = at_start();
    const double l = check_random(0.2, 2), m = check_random(0.5, 2), M = check_random(0.5, 4);
    const int a = hanging(s, 0, l, m, angle), b = hanging(s, SPAN, l, m, angle);
    coupler(s, a, b, l, M, angle);
    if (speed != 0) scene_start_omega(s, a, speed);
    const int omega = scene_ask_end(s, mode(s, PM_MEASURE_MODE_OMEGA, 1));
    const int count = scene_ask_measure(s, scene_measure(s, PM_MEASURE_MODES_COUNT, PM_NONE));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double w = sqrt((m + M) * G * cos(angle) / ((2. / 3 * m + M) * l));
    EQUAL(s->out[count], 1);
    NEAR(s->out[omega], w, 10 * GOOD * w);
    scene_free(s);
}

/* Two free bodies and a spring between them that is not stretched: it draws back one of six freedoms alone. */
static void what_nothing_draws_back(void)
{
    scene *s = at_start();
    const int a = scene_body(s, 2, 0.3, 0, 0, 0.4), b = scene_body(s, 6, 0.5, 3, 4, 0);
    const int out[] = {scene_point(s, a, 0, 0), scene_point(s, b, 0, 0)};
    scene_force(s, PM_FORCE_SPRING, out[0], out[1], 27, 5);
    const int count = scene_ask_measure(s, scene_measure(s, PM_MEASURE_MODES_COUNT, PM_NONE));
    const int growth = scene_ask_measure(s, scene_measure(s, PM_MEASURE_MODES_GROWTH, PM_NONE));
    const int slow = scene_ask_end(s, mode(s, PM_MEASURE_MODE_OMEGA, 5));
    const int swings = scene_ask_end(s, mode(s, PM_MEASURE_MODE_OMEGA, 6));
    const int none_such = scene_ask_end(s, mode(s, PM_MEASURE_MODE_OMEGA, 7));
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[count], 6);
    EQUAL(s->out[growth], 0);
    EQUAL(s->out[slow], 0);
    NEAR(s->out[swings], sqrt(27 / 1.5), GOOD * 5);
    EQUAL(s->reason[none_such], PM_REASON_UNDEFINED);
    scene_free(s);
}

/* A parallelogram that swings and is asked on its way or not: the rest of its answers stays, to the bit. */
static void asking_changes_nothing(int route)
{
    double end[2];
    for (int asked = 0; asked < 2; asked++) {
        scene *s = scene_create();
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        const int a = hanging(s, 0, 1, 1, 1);
        coupler(s, a, hanging(s, SPAN, 1, 1, 1), 1, 2, 1);
        const int omega = scene_measure(s, PM_MEASURE_OMEGA, a),
                  angle = scene_measure(s, PM_MEASURE_ANGLE, a);
        const int down = scene_when(s, PM_TRIGGER_FALL, scene_minus(s, angle, -1));
        scene_until_time(s, 1.3);
        const int last = scene_ask_measure(s, omega);
        if (asked) scene_ask_event(s, mode(s, PM_MEASURE_MODE_OMEGA, 1), down, 1, 0);
        EQUAL(scene_run(s, NULL), PM_OK);
        if (asked) CHECK(s->out[1] > 1);
        end[asked] = s->out[last];
        scene_free(s);
    }
    EQUAL(end[0], end[1]);
}

static void what_may_not_read_them(void)
{
    for (int use = 0; use < 4; use++) {
        scene *s = at_start();
        const int b = hanging(s, 0, 1, 1, 0), read = mode(s, PM_MEASURE_MODE_OMEGA, use == 3 ? 0 : 1);
        if (use == 0) scene_ask_extreme(s, PM_ASK_MAX, read, PM_NONE);
        if (use == 1) scene_couple(s, b, PM_GROUND, read);
        if (use == 2) scene_when(s, PM_TRIGGER_RISE, read);
        if (use == 3) scene_ask_end(s, read);
        EQUAL(scene_run(s, NULL), PM_BAD_TABLE);
        scene_free(s);
    }
}

int main(void)
{
    for (int i = 0; i < CASES; i++) {
        a_pendulum(0, 0);
        a_pendulum(check_random(0, 3), check_random(0.01, 0.9));
        a_pendulum(check_random(0, 3), check_random(1.1, 3));
        an_upright_rod();
        a_parallelogram(0, 0);
        a_parallelogram(check_random(-1, 1), 0);
        a_parallelogram(check_random(-1, 1), check_random(-3, 3));
    }
    what_nothing_draws_back();
    asking_changes_nothing(PM_ROUTE_AUTO);
    asking_changes_nothing(PM_ROUTE_RK);
    what_may_not_read_them();
    return check_failures();
}
