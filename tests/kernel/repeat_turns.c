/* Turns and swings that repeat: until a time, of a wheel that rolls downhill, and for ever. */
#include "check.h"
#include "scene.h"

#define G 9.81
#define PI 3.14159265358979323846

/* ---- laps ---- */
/* An unbalanced crank: 1000 turns are one turn 1000 times, its time included; steady, so that time may be asked. */
static void turns_until_a_time(void)
{
    double period = 0;
    for (int i = 0; i < 3; i++) { /* one turn; until the time of 1000.25 of them; until exactly 1000 */
        scene *s = scene_create();
        *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
        scene_set(s, PM_SETTING_MAX_TIME, 1e5);
        const double r = 0.15, l = 0.5;
        const int crank = scene_body(s, 2, 0.02, 0, 0, 0), rod = scene_body(s, 1.5, 0.04, r + 0.5 * l, 0, 0),
                  piston = scene_body(s, 0.8, 0, r + l, 0, 0), pin = scene_point(s, piston, 0, 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, crank, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5 * l, 0), scene_point(s, crank, r, 0), 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, 0.5 * l, 0), pin, 0);
        scene_joint(s, PM_JOINT_SLIDER, pin, scene_floor(s, 0), 0);
        scene_start_omega(s, crank, 9);
        const int turned = scene_measure(s, PM_MEASURE_TURNED, crank),
                  omega = scene_measure(s, PM_MEASURE_OMEGA, crank);
        const int dead =
            scene_when(s, PM_TRIGGER_RISE, scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, pin, PM_PART_X)));
        const int time = scene_ask_measure(s, scene_time(s)), angle = scene_ask_measure(s, turned),
                  speed = scene_ask_measure(s, omega), n = scene_ask_count(s, dead),
                  slowest = scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, omega), PM_NONE);
        if (i == 0)
            scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turned, 2 * PI)), 1);
        else
            scene_until_time(s, (i == 1 ? 1000.25 : 1000) * period);
        EQUAL(scene_run(s, NULL), PM_OK);
        if (i == 0) {
            period = s->out[time];
            NEAR(s->out[speed], 9, 1e-12);
            scene_free(s);
            continue;
        }
        EQUAL(s->out[time], (i == 1 ? 1000.25 : 1000) * period);
        EQUAL(s->out[n], 1000);
        if (i == 2) NEAR(s->out[angle], 2000 * PI, 1e-8);
        if (i == 2) NEAR(s->out[speed], 9, 1e-9);
        CHECK(s->out[slowest] < 8.9);
        CHECK(s->count[PM_COUNT_REPEATED_SEGMENTS] > 900);
        CHECK(s->count[PM_COUNT_STEPS] < 200);
        CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-11);
        scene_free(s);
    }
}

/* A wheel that is not round in mass rolls down a slope: each turn gains the same energy. */
static void wheel_downhill(void)
{
    const double r = 0.4, slope = 0.03, m = 3, inertia = 0.2, off = 0.1;
    const int turns = 300;
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    *scene_setting(s, PM_SETTING_MAX_TIME) = PM_NONE;
    const double c = cos(slope), n = sin(slope);
    const int b = scene_body(s, m, inertia, r * n + off, r * c, 0), hub = scene_point(s, b, -off, 0);
    scene_joint(s, PM_JOINT_ROLLING_LINE, scene_circle(s, hub, r), scene_floor(s, -slope), 0);
    scene_start_omega(s, b, -3);
    const int turned = scene_measure(s, PM_MEASURE_TURNED, b), omega = scene_measure(s, PM_MEASURE_OMEGA, b);
    scene_until(
        s,
        scene_when(s, PM_TRIGGER_FALL,
                   SCENE_PROGRAM(s, scene_m(turned), scene_k(s, 2 * PI * turns), scene_op(PM_OP_ADD))),
        1);
    const int speed = scene_ask_measure(s, omega),
              place = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, hub, PM_PART_X)),
              fastest = scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, omega), PM_NONE);
    EQUAL(scene_run(s, NULL), PM_OK);
    /* at the same pose: (I + m p^2) w^2 / 2 grows by m g (2 pi r) sin(slope) a turn, p from the contact to G */
    const double px = off + r * n, py = r * c;
    const double mass = inertia + m * (px * px + py * py);
    NEAR(s->out[speed], -sqrt(9 + 2 * m * G * 2 * PI * r * turns * n / mass), 1e-10);
    NEAR(s->out[place], r * n + 2 * PI * r * turns * c, 1e-9);
    CHECK(s->out[fastest] <= s->out[speed]);
    CHECK(s->count[PM_COUNT_REPEATED_SEGMENTS] > turns / 2);
    scene_free(s);
}

/* ---- for ever ---- */
/* A rod on a pin at its end, below which it hangs with `turned` = 0, begins at this angle and angular velocity. */
static scene *rod_on_pin(double angle, double omega, int *measure)
{
    const double l = 0.8, m = 1.5;
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    *scene_setting(s, PM_SETTING_MAX_TIME) = PM_NONE;
    const int rod =
        scene_body(s, m, m * l * l / 12, 0.5 * l * sin(angle), -0.5 * l * cos(angle), angle - 0.5 * PI);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5 * l, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_start_omega(s, rod, omega);
    measure[0] = scene_measure(s, PM_MEASURE_ANGLE, rod);
    measure[1] = scene_measure(s, PM_MEASURE_OMEGA, rod);
    return s;
}

/* A swing that begins at rest or in motion, and turns, until an angle or an angular velocity that never comes: the run ends
 * when the motion repeats.  What comes after 30 million turns is waited for. */
static void until_what_never_comes(void)
{
    static const struct {
        double angle, omega, bound;
        int of, status;
    } run[] = {
        {1, 0, PI / 2, 0, PM_LIMIT_TIME},    {0.4, 2, PI / 2, 0, PM_LIMIT_TIME},
        {1, 0, 5, 1, PM_LIMIT_TIME},         {0.4, 12, 15, 1, PM_LIMIT_TIME},
        {0.4, -12, 1, 0, PM_LIMIT_TIME},     {1, 0, 0.99 - PI / 2, 0, PM_OK},
        {0.4, 12, 6e7 * PI + 1.5, 0, PM_OK},
    };
    for (size_t i = 0; i < sizeof run / sizeof run[0]; i++) {
        int measure[2];
        scene *s = rod_on_pin(run[i].angle, run[i].omega, measure);
        const int kind = run[i].status == PM_OK && run[i].omega == 0 ? PM_TRIGGER_FALL : PM_TRIGGER_RISE;
        const int of = measure[run[i].of];
        const double shift = run[i].of == 0 ? PI / 2 : 0; /* a rod's own angle is from its axis */
        scene_until(s, scene_when(s, kind, scene_minus(s, of, run[i].bound - shift)), 1);
        scene_value(s, 40); /* of a list, that is not met either */
        scene_ask(s, PM_ASK_GRID, scene_read(s, measure[0]), PM_NONE, 1, 0, scene_read(s, measure[1]),
                  s->rows[PM_TABLE_VALUE] - 1, 1);
        EQUAL(scene_run(s, NULL), run[i].status);
        CHECK(s->count[PM_COUNT_STEPS] < 20);
        if (run[i].status == PM_LIMIT_TIME) EQUAL(s->detail[0], INFINITY);
        scene_free(s);
    }
}

/* Half the way to the turning point is the first step from rest: the second ends there but for rounding, of either sign. */
static void swings_stay_on_the_path(void)
{
    for (double angle = 1; angle < 3.1; angle += 0.01) {
        int measure[2];
        scene *s = rod_on_pin(angle, 0, measure);
        scene_force(s, PM_FORCE_SPRING, scene_point(s, 0, 0.4, 0), scene_point(s, PM_GROUND, 0.9, 0.3), 20,
                    0.5);
        scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, measure[0], 100)), 1);
        EQUAL(scene_run(s, NULL), PM_LIMIT_TIME);
        EQUAL(s->count[PM_COUNT_ROUTES], 1 << PM_ROUTE_PATH);
        CHECK(s->count[PM_COUNT_STEPS] < 40);
        scene_free(s);
    }
}

int main(void)
{
    turns_until_a_time();
    swings_stay_on_the_path();
    until_what_never_comes();
    wheel_downhill();
    return check_failures();
}
