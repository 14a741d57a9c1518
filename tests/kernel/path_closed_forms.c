/* The path route beside closed forms: periods, turning points, singular positions, extremes, nudges. */
#include "check.h"
#include "path_scenes.h"
#include "scene.h"
#include "state/route.h"
#include "state/workspace.h"

/* ---- closed forms ---- */
/* Complete elliptic integral of the first kind from the complementary modulus: pi / (2 agm(1, kc)). */
static double complete(double kc)
{
    double a = 1, b = kc;
    for (int i = 0; i < 40; i++) { /* converges quadratically */
        const double mean = 0.5 * (a + b);
        b = sqrt(a * b);
        a = mean;
    }
    return PI / (a + b);
}

/* The rod's equation is that of a simple pendulum of length 2/3. */
static const double PACE = 2 / (3 * G);

/* Released at rest: four half swings, and the low point on the way; the amplitude comes within 1e-6 of the top. */
static void periods(void)
{
    static const double short_of_top[] = {PI - 0.02, 2, 1, 0.3, 1e-2, 1e-4, 1e-6};
    for (int i = 0; i < 7; i++) {
        const double amplitude = PI - short_of_top[i], kc = sin(0.5 * short_of_top[i]);
        scene *s = scene_create();
        *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
        const int b = pendulum_rod(s, -0.5 * PI + amplitude), omega = omega_of(s, b);
        const int angle = scene_measure(s, PM_MEASURE_ANGLE, b), time = scene_time(s);
        const int low = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, angle, -0.5 * PI)),
                  turn = scene_when(s, PM_TRIGGER_CROSS, scene_read(s, omega)),
                  back = scene_when(s, PM_TRIGGER_RISE, scene_read(s, omega)),
                  forth = scene_when(s, PM_TRIGGER_FALL, scene_read(s, omega));
        scene_until(s, turn, 4);
        const int at_low = scene_ask_event(s, scene_read(s, time), low, 1, 0),
                  speed = scene_ask_event(s, scene_read(s, omega), low, 1, 0),
                  at_low_again = scene_ask_event(s, scene_read(s, time), low, 4, 0),
                  at_turn = scene_ask(s, PM_ASK_EACH, scene_read(s, time), turn, 1, 0, PM_NONE, PM_NONE, 4),
                  backs = scene_ask_count(s, back), forths = scene_ask_count(s, forth),
                  lowest = scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, angle), PM_NONE),
                  total = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TOTAL, PM_NONE));
        EQUAL(scene_run(s, NULL), PM_OK);
        const double quarter = sqrt(PACE) * complete(kc);
        /* near the top the start itself is known to a rounding of pi only */
        const double exact = 1e-12 * quarter + 4e-16 / short_of_top[i];
        /* and the other turning points, from the energy, to its rounding over a force that vanishes at the top */
        const double later = 7 * exact + 3e-15 / (short_of_top[i] * short_of_top[i]);
        NEAR(s->out[at_low], quarter, exact);
        NEAR(s->out[at_low_again], 7 * quarter, later);
        for (int k = 0; k < 4; k++) NEAR(s->out[at_turn + k], (2 * k + 2) * quarter, later);
        NEAR(s->out[speed], -2 * sin(0.5 * amplitude) / sqrt(PACE), 1e-13);
        EQUAL(s->out[backs], 2);
        EQUAL(s->out[forths], 2);
        NEAR(s->out[lowest], -0.5 * PI - amplitude, 1e-13 + 3e-15 / short_of_top[i]);
        NEAR(s->out[total], -G * cos(amplitude), 1e-14 * 20);
        /* potentials of G / 2 are rounded */
        NEAR(s->audit[PM_AUDIT_ENERGY], 0, 1e-13 + 4e-16 / (1 - cos(amplitude)));
        scene_free(s);
    }
}

/* Started at the low point with little more, or less, than the energy of the top: over it, or back. */
static void barrier(void)
{
    static const double excess[] = {1, 0.1, 1e-3, 1e-6, 1e-9};
    for (int i = 0; i < 10; i++) {
        const int over = i < 5;
        const double e = (over ? 1 : -1) * excess[i % 5] * (over ? 1 : 0.9);
        const double speed = 2 / sqrt(PACE) * sqrt(1 + e);
        scene *s = scene_create();
        *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
        const int b = pendulum_rod(s, -0.5 * PI);
        scene_start_omega(s, b, speed);
        const int angle = scene_measure(s, PM_MEASURE_ANGLE, b);
        const int round = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, angle, 1.5 * PI)),
                  back = scene_when(s, PM_TRIGGER_FALL, scene_minus(s, angle, -0.5 * PI));
        scene_until(s, round, 1);
        SCENE_ROW(s, PM_TABLE_UNTIL, 1, back, 1);
        const int time = scene_ask_measure(s, scene_time(s)), omega = scene_ask_measure(s, omega_of(s, b));
        const int slowest = scene_ask_extreme(
            s, PM_ASK_MIN, SCENE_PROGRAM(s, scene_m(omega_of(s, b)), scene_op(PM_OP_ABS)), PM_NONE);
        EQUAL(scene_run(s, NULL), PM_OK);
        /* k^2 = 1 / (1 + e), or its inverse */
        const double expected =
            over ? 4 * complete(sqrt(e / (1 + e))) / speed : 2 * sqrt(PACE) * complete(sqrt(-e));
        const double slack =
            expected * (1e-12 + 1e-15 / fabs(e)); /* what rounding of the start makes of it */
        NEAR(s->out[time], expected, slack);
        NEAR(s->out[omega], over ? speed : -speed, 1e-12);
        NEAR(s->out[slowest], over ? 2 / sqrt(PACE) * sqrt(e) : 0, 1e-12 + 1e-14 / sqrt(fabs(e)));
        scene_free(s);
    }
}

/* The tip passes a height below its top by so little that both roots lie between two samples. */
static void two_roots(void)
{
    for (double depth = 1e-1; depth > 1e-11; depth *= 0.1) {
        scene *s = scene_create();
        *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
        const int b = pendulum_rod(s, 0.1), y = part(s, scene_point(s, b, 0.5, 0), PM_PART_Y);
        scene_start_omega(s, b, 9);
        const int angle = scene_measure(s, PM_MEASURE_ANGLE, b);
        const int cross = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, y, 1 - depth)),
                  above = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, y, 1 + depth));
        scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, angle, 6)), 1);
        const int at = scene_ask(s, PM_ASK_EACH, scene_read(s, angle), cross, 1, 0, PM_NONE, PM_NONE, 2),
                  n = scene_ask_count(s, cross), none = scene_ask_count(s, above),
                  top = scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, y), PM_NONE);
        EQUAL(scene_run(s, NULL), PM_OK);
        const double half = acos(1 - depth);
        EQUAL(s->out[n], 2);
        EQUAL(s->out[none], 0);
        NEAR(s->out[at], 0.5 * PI - half, 1e-14 + 1e-15 / half);
        NEAR(s->out[at + 1], 0.5 * PI + half, 1e-14 + 1e-15 / half);
        NEAR(s->out[top], 1, 1e-14);
        scene_free(s);
    }
}

/* A block on a smooth slope against a spring, with a force that grows by the place: x = x0 + A cos(w t). */
static void oscillator(void)
{
    const double m = 2, k = 50, push = 18, slope = 0.4, start = 0.3;
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    const int b = scene_body(s, m, 0, start * cos(slope), start * sin(slope), 0), g = scene_point(s, b, 0, 0);
    scene_joint(s, PM_JOINT_SLIDER, g, scene_floor(s, slope), 0);
    scene_force(s, PM_FORCE_SPRING, g, ground(s, -cos(slope), -sin(slope)), k, 1);
    const int direction = scene_value(s, slope);
    const int x = scene_measure_with(s, PM_MEASURE_POSITION, g, PM_PART_ALONG, PM_MEASURE_VALUE, direction),
              v = scene_measure_with(s, PM_MEASURE_VELOCITY, g, PM_PART_ALONG, PM_MEASURE_VALUE, direction),
              time = scene_time(s);
    /* push x along the slope, to the outside: the spring is weaker by it */
    const int f = scene_applied(
        s, g, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, push * cos(slope)), scene_m(x), scene_op(PM_OP_MUL)),
        SCENE_PROGRAM(s, scene_k(s, push * sin(slope)), scene_m(x), scene_op(PM_OP_MUL)));
    const double rest = -m * G * sin(slope) / (k - push), amplitude = start - rest, w = sqrt((k - push) / m);
    const int middle = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, x, rest));
    scene_until_time(s, 3);
    const int at = scene_ask_event(s, scene_read(s, time), middle, 3, 0), place = scene_ask_measure(s, x),
              speed = scene_ask_measure(s, v),
              work = scene_ask_measure(s, scene_measure(s, PM_MEASURE_FORCE_WORK, f)),
              fastest = scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, v), PM_NONE),
              farthest = scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, x), PM_NONE),
              when = scene_ask_extreme(s, PM_ASK_AT_MAX, scene_read(s, time), scene_read(s, v)),
              grid = scene_ask(s, PM_ASK_GRID, scene_read(s, x), PM_NONE, 1, 0, scene_read(s, time),
                               scene_value(s, 0.7), 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double end = rest + amplitude * cos(3 * w);
    NEAR(s->out[at], 2.5 * PI / w, 1e-13);
    NEAR(s->out[place], end, 1e-13);
    NEAR(s->out[speed], -amplitude * w * sin(3 * w), 1e-12);
    NEAR(s->out[work], 0.5 * push * (end * end - start * start), 1e-13);
    NEAR(s->out[fastest], amplitude * w, 1e-13);
    NEAR(s->out[farthest], rest - amplitude, 1e-13);
    NEAR(remainder(s->out[when] - 1.5 * PI / w, 2 * PI / w), 0, 1e-6); /* flat, and reached twice */
    NEAR(s->out[grid], rest + amplitude * cos(0.7 * w), 1e-13);
    scene_free(s);
}

/* ---- singular positions ---- */
/* Two hinged rods of length 1, the free end guided level through the first pin, fall from level.  With c = cos, s = sin
 * of the first one's fall, omega^2 = 3 g s / (1 + 3 s^2).  At 90 deg the guided end passes the pin, where the rows
 * lose their rank and the end could as well stay: the answers there are the limits, and the motion goes straight on. */
static scene *folding(double fall, int route, int *omega, int *lift, int *time)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int a = pendulum_rod(s, 0), b = scene_body(s, 2, 2 / 12., 1.5, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, 0.5, 0), scene_point(s, b, -0.5, 0), 0);
    scene_joint(s, PM_JOINT_SLIDER, scene_point(s, b, 0.5, 0), scene_floor(s, 0), 0);
    const int angle = scene_measure(s, PM_MEASURE_ANGLE, a), rate = omega_of(s, a),
              centre = scene_point(s, a, 0, 0);
    const int early = scene_when(s, PM_TRIGGER_FALL, scene_minus(s, angle, -0.5));
    scene_until(s, scene_when(s, PM_TRIGGER_FALL, scene_minus(s, angle, -fall)), 1);
    *omega = scene_ask_measure(s, rate);
    *lift = scene_ask_measure(s, scene_part(s, PM_MEASURE_ACCELERATION, centre, PM_PART_Y));
    *time = scene_ask_measure(s, scene_time(s));
    scene_ask_event(s, PM_ASK_EVENT, early, 1, rate);
    return s;
}

static double folding_rate(double fall) { return sqrt(3 * G * sin(fall) / (1 + 3 * sin(fall) * sin(fall))); }

static void singular(void)
{
    const double falls[] = {0.5 * PI - 0.3,  0.5 * PI - 0.012, 0.5 * PI - 0.008, 0.5 * PI - 1e-6, 0.5 * PI,
                            0.5 * PI + 1e-5, 0.5 * PI + 0.009, 0.5 * PI + 0.4,   0.5 * PI + 1.2};
    double before = 0, end_before = 0;
    for (int i = 0; i < (int)(sizeof falls / sizeof *falls); i++) {
        int omega, lift, time;
        const double fall = falls[i], d = 1e-5, rate = folding_rate(fall),
                     gain = (folding_rate(fall + d) - folding_rate(fall - d)) / (2 * d) * rate;
        scene *s = folding(fall, i % 2 ? PM_ROUTE_PATH : PM_ROUTE_AUTO, &omega, &lift, &time);
        EQUAL(scene_run(s, NULL), PM_OK);
        CHECK(used(s, PM_ROUTE_PATH) && !used(s, PM_ROUTE_RK));
        NEAR(s->out[omega], -rate, 1e-12 * rate);
        NEAR(s->out[lift], 0.5 * (rate * rate * sin(fall) - gain * cos(fall)), 1e-8);
        if (fall - end_before < 0.01) NEAR(s->out[time] - before, (fall - end_before) / rate, 1e-6);
        before = s->out[time];
        end_before = fall;
        scene_free(s);
    }
}

/* ---- nudge ---- */
/* An upright rod leaves to the side that the nudge says, on every route: the first step is one along the path. */
static void nudge(void)
{
    static const int routes[] = {PM_ROUTE_PATH, PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int i = 0; i < 8; i++) {
        const int side = i < 4 ? 1 : -1, route = routes[i % 4];
        scene *s = scene_create();
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        const int b = pendulum_rod(s, 0.5 * PI), omega = omega_of(s, b);
        const int angle = scene_measure(s, PM_MEASURE_ANGLE, b);
        *scene_setting(s, PM_SETTING_NUDGE) =
            SCENE_PROGRAM(s, scene_k(s, side), scene_m(omega), scene_op(PM_OP_MUL));
        scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, angle, (0.5 + side) * PI)), 1);
        const int speed = scene_ask_measure(s, omega),
                  force = scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_Y));
        EQUAL(scene_run(s, NULL), PM_OK);
        const double slack = route == PM_ROUTE_IDA ? 1e-6 : route == PM_ROUTE_RK ? 1e-9 : 1e-13;
        NEAR(s->out[speed], side * sqrt(6 * G), slack * 10);
        NEAR(s->out[force], 2 * G + 2 * 0.5 * 6 * G, slack * 1000);
        CHECK(used(s, PM_ROUTE_PATH));
        EQUAL(used(s, PM_ROUTE_RK), route == PM_ROUTE_RK);
        EQUAL(used(s, PM_ROUTE_IDA), route == PM_ROUTE_IDA);
        scene_free(s);
    }
    scene *s = scene_create(); /* nobody nudges: it stays */
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    const int b = pendulum_rod(s, 0.5 * PI);
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, scene_measure(s, PM_MEASURE_ANGLE, b), 2)),
                1);
    scene_ask_measure(s, omega_of(s, b));
    EQUAL(scene_run(s, NULL), PM_STAYS_AT_REST);
    scene_free(s);
}

/* Two degrees of freedom are not for this route, nor are forces that depend on the speed. */
static void unsupported(void)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    const int b = scene_body(s, 1, 0.1, 0, 1, 0);
    scene_until_time(s, 1);
    scene_ask_measure(s, omega_of(s, b));
    EQUAL(scene_run(s, NULL), PM_UNSUPPORTED);
    scene_free(s);
    for (int i = 0; i < 2; i++) {
        s = scene_create();
        *scene_setting(s, PM_SETTING_ROUTE) = i ? PM_ROUTE_AUTO : PM_ROUTE_PATH;
        const int rod = pendulum_rod(s, 0);
        scene_force(s, PM_FORCE_ROTARY_DAMPER, rod, PM_GROUND, 0.3, 0);
        scene_until_time(s, 1);
        scene_ask_measure(s, omega_of(s, rod));
        EQUAL(scene_run(s, NULL), i ? PM_OK : PM_UNSUPPORTED);
        if (i) CHECK(!used(s, PM_ROUTE_PATH));
        scene_free(s);
    }
}

/* The sideways force on the pin of a rod that is let go at rest, at a below the level:
 *   F = m g cos b (9/4 sin b - 3/2 sin a),   greatest where 9/2 sin^2 b - 3/2 sin a sin b = 9/4;
 * and 1 / (sharp max F - F), which no polynomial tells.  What is not looked for is a small part of the accuracy asked,
 * and in the estimates. */
static void extremes_in_long_steps(void)
{
    int asks = 0, covered = 0;
    for (int i = 0; i < 120; i++) {
        const double a = -0.8 + 0.2 * (i % 8), sharp = 1.01 + 0.09 * (i / 8), accuracy = pow(10, -5 - i % 9);
        const double sine = (1.5 * sin(a) + sqrt(2.25 * sin(a) * sin(a) + 40.5)) / 9;
        const double top = 2 * G * sqrt(1 - sine * sine) * (2.25 * sine - 1.5 * sin(a));
        scene *s = scene_create();
        const int b = pendulum_rod(s, -a);
        const int force = scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_X);
        const int peak = SCENE_PROGRAM(s, scene_k(s, 1), scene_k(s, sharp * top), scene_m(force),
                                       scene_op(PM_OP_SUB), scene_op(PM_OP_DIV));
        const int ask[] = {scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, force), PM_NONE),
                           scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, force), PM_NONE),
                           scene_ask_extreme(s, PM_ASK_MAX, peak, PM_NONE)};
        const double truth[] = {top, -top, 1 / ((sharp - 1) * top)};
        scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_read(s, omega_of(s, b))), 1);
        scene_set(s, PM_SETTING_ACCURACY, accuracy);
        *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
        *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
        EQUAL(scene_run(s, NULL), PM_OK);
        for (int k = 0; k < 3; k++) {
            const double scale = fabs(truth[k]), rounding = k < 2 ? 1e-13 : 3e-14 * sharp / (sharp - 1);
            NEAR(s->out[ask[k]], truth[k], fmax(rounding, 0.05 * accuracy) * scale);
            CHECK(s->error[ask[k]] <= fmax(100 * rounding, 0.1 * accuracy) * scale);
            covered += fabs(s->out[ask[k]] - truth[k]) <= s->error[ask[k]] + rounding * scale;
            asks++;
        }
        scene_free(s);
    }
    CHECK(covered >= 0.97 * asks);
}

/* Let go level, or nearly so, the first step ends half way to the turning point, and steps of that length right before it: it is
 * met in few steps, and in time. */
static void turns_behind_a_step(void)
{
    for (int i = 0; i < 26; i++) {
        const double angle = i == 0 ? 0 : (i % 2 ? 1 : -1) * pow(10, -12 + 0.5 * (double)((i - 1) / 2 * 2));
        scene *s = scene_create();
        const int b = pendulum_rod(s, angle);
        scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_read(s, omega_of(s, b))), 1);
        const int half = scene_ask_measure(s, scene_time(s));
        *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
        EQUAL(scene_run(s, NULL), PM_OK);
        CHECK(s->count[PM_COUNT_STEPS] <= 8);
        NEAR(s->out[half], 2 * sqrt(PACE) * complete(cos(0.5 * (0.5 * PI + angle))), 1e-12);
        scene_free(s);
    }
}

/* A rod let go level strikes a table, 0.8 of its length below: it is fastest right before the blow, inside a step. */
static void extreme_before_a_blow(void)
{
    scene *s = scene_create();
    const int b = pendulum_rod(s, 0);
    const int table = scene_line(s, ground(s, 0, -0.8), 0);
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, 0.5, 0), 0), table, 0,
                                0.5, PM_FRICTION_SMOOTH, 0);
    const int least = scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, omega_of(s, b)), PM_NONE);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, c), 1);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[least], -sqrt(2.4 * G), 1e-12);
    scene_free(s);
}

int main(void)
{
    extreme_before_a_blow();
    turns_behind_a_step();
    extremes_in_long_steps();
    periods();
    barrier();
    two_roots();
    oscillator();
    singular();
    nudge();
    unsupported();
    return check_failures();
}
