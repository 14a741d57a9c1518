/* Constant accelerations: the same answers as the rk route and as closed forms; gaps with a sinusoid found without
 * sampling; runs that need no motion at all. */
#include "uniform.h"

#define PI 3.14159265358979323846

typedef scene *maker(double size);

/* ---- the same as rk ---- */
/* A cylinder rolls down an incline against a stop, and comes back. */
static scene *cylinder(double size)
{
    const double r = 0.2 * size, slope = -0.4;
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, -G * size);
    const int b = scene_body(s, 3, 1.5 * r * r, -sin(slope) * r, cos(slope) * r, 0);
    const int circle = scene_circle(s, scene_point(s, b, 0, 0), r);
    const int stop = scene_line(s, scene_point(s, PM_GROUND, 2 * size * cos(slope), 2 * size * sin(slope)),
                                slope + PI / 2);
    scene_joint(s, PM_JOINT_ROLLING_LINE, circle, scene_floor(s, slope), 0);
    const int c = scene_contact(s, PM_CONTACT_LINE, circle, stop, 0, 0.5, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1.5);
    scene_ask_event(s, scene_read(s, scene_time(s)), scene_on(s, PM_TRIGGER_STRIKE, c), 1, 0);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, scene_point(s, b, 0, 0), PM_PART_X));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_FRICTION, 0));
    return s;
}

/* A block thrown along the floor on its two corners stops by friction. */
static scene *block(double size)
{
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, -G * size);
    const int b = scene_body(s, 2, 0.3 * size * size, 0, 0.2 * size, 0), g = scene_point(s, b, 0, 0),
              line = scene_floor(s, 0);
    for (int i = -1; i <= 1; i += 2)
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, i * 0.5 * size, -0.2 * size), 0),
                      line, 0, 0, PM_FRICTION_COULOMB, 0.3);
    scene_start_velocity(s, g, 3 * size, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_REST, PM_NONE), 1);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_PATH, g, PM_PART_NONE));
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, 0)), PM_NONE);
    return s;
}

/* A couple turns a disk on its axle, which drives a second one. */
static scene *gears(double size)
{
    const double r = 0.1 * size, big = 0.25 * size;
    scene *s = scene_create();
    const int a = scene_body(s, 1, 0.5 * r * r, 0, 0, 0),
              b = scene_body(s, 4, 2 * big * big, r + big, 0, 0.3);
    const int pa = scene_point(s, a, 0, 0), pb = scene_point(s, b, 0, 0);
    scene_joint(s, PM_JOINT_PIN, pa, scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, pb, scene_point(s, PM_GROUND, r + big, 0), 0);
    scene_joint(s, PM_JOINT_ROLLING_CIRCLE, scene_circle(s, pa, r), scene_circle(s, pb, big), 1);
    const int couple = scene_couple(s, a, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, 0.7 * size * size)));
    scene_until(s,
                scene_when(s, PM_TRIGGER_FALL,
                           SCENE_PROGRAM(s, scene_m(scene_measure(s, PM_MEASURE_TURNED, b)), scene_k(s, 20),
                                         scene_op(PM_OP_ADD))),
                1);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, a));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_FORCE_WORK, couple));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 1, PM_PART_NORM));
    return s;
}

/* A cylinder rolls on a carriage that is pulled along a rail: its weight wanders over the carriage, whose rail holds the
 * moment. */
static scene *carriage(double size)
{
    const double r = 0.2 * size, h = 0.3 * size;
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, -G * size);
    const int b = scene_body(s, 3, size * size, 0, 0, 0), a = scene_body(s, 8, 4 * r * r, 0, h + r, 0);
    scene_joint(s, PM_JOINT_SLIDER_FIXED, scene_point(s, b, 0, 0), scene_floor(s, 0), 0);
    scene_joint(s, PM_JOINT_ROLLING_LINE, scene_circle(s, scene_point(s, a, 0, 0), r),
                scene_line(s, scene_point(s, b, 0, h), 0), 0);
    const int force = SCENE_PROGRAM(s, scene_k(s, 10 * size)), none = SCENE_PROGRAM(s, scene_k(s, 0));
    scene_applied(s, scene_point(s, b, 0.1 * size, 0.1 * size), PM_GROUND, force, none);
    scene_until_time(s, 1.2);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, a));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_MOVED, scene_point(s, b, 0, 0), PM_PART_X));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_COUPLE, 0));
    const int couple = scene_measure(s, PM_MEASURE_JOINT_COUPLE, 0);
    scene_ask_event(
        s, scene_read(s, scene_time(s)),
        scene_when(s, PM_TRIGGER_CROSS,
                   SCENE_PROGRAM(s, scene_m(couple), scene_k(s, 15 * size * size), scene_op(PM_OP_ADD))),
        1, 0);
    return s;
}

/* A ball thrown through heights, with friction and spin when it lands. */
static scene *throw_of(double size)
{
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, -G * size);
    const double r = 0.1 * size;
    const int b = scene_body(s, 1, 0.4 * r * r, 0, size, 0), p = scene_point(s, b, 0, 0);
    const int x = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_X),
              y = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_Y);
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, r), scene_floor(s, 0), 0, 0.8,
                                PM_FRICTION_COULOMB, 0.2);
    scene_start_velocity(s, p, 2 * size, 4 * size);
    scene_start_omega(s, b, 30);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, c), 4);
    scene_ask_measure(s, x);
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, y), PM_NONE);
    scene_ask_extreme(s, PM_ASK_AT_MAX, scene_read(s, x), scene_read(s, y));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT,
                                       scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, y, 0.7 * size))));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_PATH, p, PM_PART_NONE));
    scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_NORM)),
                      PM_NONE);
    const int metres = scene_value(s, 0.5 * size);
    for (int i = 1; i < 3; i++) scene_value(s, (0.5 + i) * size);
    scene_ask(s, PM_ASK_GRID, scene_read(s, y), PM_NONE, 1, 0, scene_read(s, x), metres, 3);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT,
                                       scene_when(s, PM_TRIGGER_EVERY,
                                                  SCENE_PROGRAM(s, scene_m(y), scene_k(s, 0.13 * size),
                                                                scene_op(PM_OP_DIV)))));
    return s;
}

/* Through a hoop, past two posts: round things, and one inside the other. */
static scene *billiard(double size)
{
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int p = scene_point(s, scene_body(s, 1, 0, 0.3 * size, 0.1 * size, 0), 0, 0),
              ball = scene_circle(s, p, 0.1 * size);
    const int ring = scene_circle(s, scene_point(s, PM_GROUND, 0, 0), size),
              post = scene_circle(s, scene_point(s, PM_GROUND, -0.2 * size, 0.1 * size), 0.15 * size);
    const int c = scene_contact(s, PM_CONTACT_CIRCLE, ball, ring, -1, 1, PM_FRICTION_SMOOTH, 0);
    scene_contact(s, PM_CONTACT_CIRCLE, ball, post, 1, 0.9, PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, p, 2 * size, 1.3 * size);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, c), 7);
    scene_ask_measure(s, scene_time(s));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, p, PM_PART_X));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, p, PM_PART_Y));
    return s;
}

static maker *const makers[] = {cylinder, block, gears, carriage, throw_of, billiard};
enum { MAKERS = sizeof makers / sizeof *makers };

static void routes_agree(void)
{
    for (int i = 0; i < MAKERS; i++) {
        scene *a = makers[i](1), *b = makers[i](1);
        scene_route(b, PM_ROUTE_RK, 1e-13);
        EQUAL(scene_run(b, NULL), PM_OK);
        if (runs_uniformly(a))
            for (int k = 0; k < a->nout; k++) NEAR(a->out[k], b->out[k], 2e-12 * (1 + fabs(b->out[k])));
        CHECK(a->count[PM_COUNT_STEPS] < b->count[PM_COUNT_STEPS]);
        scene_free(a);
        scene_free(b);
    }
}

/* Times do not change with the size where weight and speeds go along. */
static void scales(void)
{
    for (int i = 0; i < MAKERS; i++) {
        scene *a = makers[i](1), *b = makers[i](1000);
        if (runs_uniformly(a) && runs_uniformly(b)) {
            const int is_time = i != 3 && i != 4;
            if (is_time) NEAR(b->out[0], a->out[0], CLOSE * (1 + fabs(a->out[0])));
            EQUAL(b->count[PM_COUNT_PHASES], a->count[PM_COUNT_PHASES]);
        }
        scene_free(a);
        scene_free(b);
    }
}

static void same_bits(void)
{
    double out[SCENE_OUTS];
    scene *s = throw_of(1);
    scene_open(s);
    static const double none = 0;
    scene_route(s, PM_ROUTE_UNIFORM, 1e-11);
    EQUAL(scene_open(s), PM_OK);
    for (int i = 0; i < 3; i++) {
        EQUAL(pm_run(s->w, &none), PM_OK);
        if (i > 0) EQUAL(memcmp(out, s->out, (size_t)s->nout * sizeof *out), 0);
        memcpy(out, s->out, sizeof out);
    }
    scene_free(s);
}

/* ---- closed forms ---- */
static void friction_stops_it(void)
{
    scene *s = block(1);
    if (runs_uniformly(s)) {
        const double a = 0.3 * G;
        NEAR(s->out[0], 3 / a, CLOSE);
        NEAR(s->out[1], 4.5 / a, CLOSE);
        NEAR(s->out[2], 4.5 / a, CLOSE);
    }
    scene_free(s);
}

/* A path with a slow crossing of rest, nearly back on itself: by a quadrature with many points. */
static void travels(void)
{
    for (double vx = 1e-9; vx < 10; vx *= 100) {
        scene *s = scene_create();
        const int p = scene_point(s, scene_body(s, 1, 0, 0, 0, 0), 0, 0);
        scene_start_velocity(s, p, vx, 2);
        scene_until_time(s, 0.7);
        scene_ask_measure(s, scene_part(s, PM_MEASURE_PATH, p, PM_PART_NONE));
        double sum = 0;
        enum { N = 200000 };
        for (int i = 0; i < N; i++) sum += hypot(vx, 2 - G * 0.7 * (i + 0.5) / N) * 0.7 / N;
        if (runs_uniformly(s)) NEAR(s->out[0], sum, 1e-9);
        scene_free(s);
    }
}

/* Straight up and down again: the speed has a corner where it vanishes. */
static void stands_still(void)
{
    for (double v = 1; v < 15; v += 0.7) {
        scene *s = scene_create();
        const int p = scene_point(s, scene_body(s, 1, 0, 0, 0, 0), 0, 0);
        const int speed = scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_NORM));
        scene_start_velocity(s, p, 0, v);
        scene_until_time(s, 2);
        scene_ask_extreme(s, PM_ASK_MIN, speed, PM_NONE);
        scene_ask_extreme(s, PM_ASK_AT_MIN, scene_read(s, scene_time(s)), speed);
        if (runs_uniformly(s)) {
            NEAR(s->out[0], 0, CLOSE);
            NEAR(s->out[1], v / G, CLOSE);
        }
        CHECK(s->count[PM_COUNT_STEPS] < 6);
        scene_free(s);
    }
}

/* What does not stay the same is left to other routes. */
static void applies_where_it_should(void)
{
    for (int what = 0; what < 7; what++) {
        scene *s = scene_create();
        const int b = scene_body(s, 1, 0.1, 0, 1, 0), g = scene_point(s, b, 0, 0),
                  end = scene_point(s, b, 0.4, 0);
        const int one = SCENE_PROGRAM(s, scene_k(s, 1)), zero = SCENE_PROGRAM(s, scene_k(s, 0));
        const int time = SCENE_PROGRAM(s, scene_m(scene_time(s)));
        scene_start_omega(s, b, what == 5 ? 0 : 3);
        scene_until_time(s, 0.3);
        switch (what) {
        case 0: scene_joint(s, PM_JOINT_PIN, end, scene_point(s, PM_GROUND, 0.4, 1), 0); break;
        case 1: scene_force(s, PM_FORCE_SPRING, g, scene_point(s, PM_GROUND, 0, 0), 5, 1); break;
        case 2: scene_applied(s, end, PM_GROUND, one, zero); break;
        case 3: scene_applied(s, g, b, one, zero); break;
        case 4: scene_couple(s, b, PM_GROUND, time); break;
        case 6: scene_line_force(s, g, scene_point(s, PM_GROUND, 1, 1), one); break;
        default: scene_force(s, PM_FORCE_DAMPER, g, scene_point(s, PM_GROUND, 0, 0), 1, 0); break;
        }
        scene_route(s, PM_ROUTE_UNIFORM, 1e-11);
        EQUAL(scene_run(s, NULL), PM_UNSUPPORTED);
        scene_route(s, PM_ROUTE_AUTO, 1e-11);
        EQUAL(scene_run(s, NULL), PM_OK);
        CHECK(s->count[PM_COUNT_ROUTE] != PM_ROUTE_UNIFORM);
        scene_free(s);
    }
}

/* ---- a rod that spins fast ---- */
/* Without weight: its centre sinks with c from y, its end goes round; mirror: along x. */
static scene *rod(double y, double c, double omega, double length, int mirrored)
{
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const double sign = mirrored ? -1 : 1;
    const int b = scene_body(s, 1, 0.2, mirrored ? y : 0, mirrored ? 0 : y, mirrored ? PI / 2 : 0);
    const int g = scene_point(s, b, 0, 0), end = scene_circle(s, scene_point(s, b, length, 0), 0);
    const int k = scene_contact(s, PM_CONTACT_LINE, end, scene_floor(s, mirrored ? -PI / 2 : 0), 0, 1,
                                PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, g, mirrored ? -c : 0, mirrored ? 0 : -c);
    scene_start_omega(s, b, sign * omega);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, k), 1);
    scene_ask_measure(s, scene_time(s));
    return s;
}

/* Its end comes lowest, as far as the sinking goes, at the time when its speed is -c: omega L cos = c on the way down. */
static double lowest(int turn, double c, double omega, double length)
{
    return (2 * PI * turn + 2 * PI - acos(c / (omega * length))) / omega;
}

static void spins_past(void)
{
    const double c = 0.02, omega = 400, length = 0.3;
    const int turn = 50;
    const double t = lowest(turn, c, omega, length), y = c * t - length * sin(omega * t);
    for (int mirrored = 0; mirrored < 2; mirrored++)
        for (int side = -1; side <= 1; side += 2) {
            scene *s = rod(y + side * 1e-8, c, omega, length, mirrored);
            if (runs_uniformly(s)) {
                const double gap = y + side * 1e-8 - c * s->out[0] + length * sin(omega * s->out[0]);
                NEAR(gap, 0, 1e-14);
                /* just before the lowest place of this turn, or on the way to that of the next */
                if (side < 0) CHECK(s->out[0] < t && s->out[0] > t - 1e-4);
                if (side > 0)
                    CHECK(s->out[0] > t + 1 / omega && s->out[0] < lowest(turn + 1, c, omega, length));
            }
            CHECK(s->count[PM_COUNT_STEPS] == 1);
            scene_free(s);
        }
}

/* With weight and growing spin: the first root against a fine scan of the closed form. */
static void tumbles(void)
{
    const double y = 3, length = 0.5, inertia = 0.1, couple = 12;
    scene *s = scene_create();
    const int b = scene_body(s, 1, inertia, 0, y, 0.4), g = scene_point(s, b, 0, 0);
    const int line = scene_floor(s, 0);
    for (int side = -1; side <= 1; side += 2)
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, side * length, 0), 0), line, 0,
                      0.5, PM_FRICTION_SMOOTH, 0);
    scene_couple(s, b, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, couple)));
    scene_start_velocity(s, g, 1, 5);
    scene_start_omega(s, b, 150);
    const int event = scene_event(s);
    for (int k = 0; k < 2; k++) scene_trigger(s, PM_TRIGGER_STRIKE, event, PM_NONE, k);
    scene_until(s, event, 1);
    scene_ask_measure(s, scene_time(s));
    double t = 0, gap = 1;
    while (gap > 0) {
        t += 2e-7;
        const double angle = 0.4 + 150 * t + 0.5 * couple / inertia * t * t;
        gap = y + 5 * t - 0.5 * G * t * t - length * fabs(sin(angle));
    }
    if (runs_uniformly(s)) {
        CHECK(s->out[0] <= t && s->out[0] > t - 2e-7);
        const double angle = 0.4 + 150 * s->out[0] + 0.5 * couple / inertia * s->out[0] * s->out[0];
        NEAR(y + 5 * s->out[0] - 0.5 * G * s->out[0] * s->out[0] - length * fabs(sin(angle)), 0, 1e-13);
    }
    scene_free(s);
}

/* ---- runs without motion ---- */
static void no_motion(void)
{
    for (int what = 0; what < 3; what++) {
        scene *s = scene_by(PM_ROUTE_AUTO, 1e-11);
        const int b = scene_body(s, 2, 0.1, 0, 0.1, 0), p = scene_point(s, b, 0, 0),
                  end = scene_point(s, b, 0.3, 0);
        scene_start_velocity(s, p, 1, -2);
        scene_start_omega(s, b, 3);
        if (what == 1)
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0.1), scene_floor(s, 0), 0, 0.5,
                          PM_FRICTION_SMOOTH, 0);
        scene_until(s, scene_on(s, PM_TRIGGER_START, PM_NONE), 1);
        scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, end, PM_PART_Y));
        if (what == 2) scene_ask_measure(s, scene_part(s, PM_MEASURE_ACCELERATION, end, PM_PART_X));
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[0], (what == 1 ? 1 : -2) + 0.9, CLOSE);
        if (what == 2) NEAR(s->out[1], -9 * 0.3, CLOSE);
        EQUAL(s->count[PM_COUNT_ROUTE], what == 1 ? PM_ROUTE_JUMP : PM_ROUTE_STATE);
        EQUAL(s->count[PM_COUNT_ROUTES], 1 << s->count[PM_COUNT_ROUTE]);
        EQUAL(s->count[PM_COUNT_PHASES], 0);
        scene_free(s);
    }
    scene *s = rod(1, 1, 1, 0.3, 0);
    scene_route(s, PM_ROUTE_STATE, 1e-11);
    EQUAL(scene_run(s, NULL), PM_UNSUPPORTED);
    scene_free(s);
}

int main(void)
{
    routes_agree();
    scales();
    same_bits();
    friction_stops_it();
    travels();
    stands_still();
    applies_where_it_should();
    spins_past();
    tumbles();
    no_motion();
    return check_failures();
}
