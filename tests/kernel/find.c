/* Finds: values, extremes and thresholds of parameters by whole runs, against closed forms of throws and pendulums. */
#include "check.h"
#include "find_throws.h"
#include "scene.h"

#define G 9.81
#define PI 3.14159265358979323846

/* The speed for a range, and what is asked of the run with it. */
static void one_value(void)
{
    throwing f = thrown_down_to(0);
    scene_find(f.s, PM_FIND_VALUE, PM_NONE, 32);
    scene_vary(f.s, 0, 1, 40);
    scene_where(f.s, PM_CONDITION_ZERO, range_less(&f, 20));
    const int speed = scene_ask_end(f.s, SCENE_PROGRAM(f.s, scene_p(0)));
    const int range = scene_ask_measure(f.s, f.x), time = scene_ask_measure(f.s, f.time);
    const double param[] = {NAN, 0.7}, v = sqrt(20 * G / sin(1.4));
    EQUAL(scene_run(f.s, param), PM_OK);
    NEAR(f.s->found[PM_FOUND_FIRST], v, 1e-10 * v);
    EQUAL(f.s->out[speed], f.s->found[PM_FOUND_FIRST]);
    NEAR(f.s->out[range], 20, 1e-9);
    NEAR(f.s->out[time], 2 * v * sin(0.7) / G, 1e-9);
    EQUAL(f.s->count[PM_COUNT_FOUND], 1);
    CHECK(f.s->count[PM_COUNT_RUNS] > 33 && f.s->count[PM_COUNT_RUNS] < 60);
    CHECK(isnan(f.s->found[PM_FOUND_SECOND]));
    const double own[] = {f.s->found[PM_FOUND_FIRST], 0.7}, x = f.s->out[range];
    f.s->rows[PM_TABLE_FIND] = 0; /* a run with what was found is the same run, bit for bit */
    EQUAL(scene_run(f.s, own), PM_OK);
    EQUAL(f.s->out[range], x);
    scene_free(f.s);
}

/* Flat and steep throw: the first is taken and the status says that there are two; the least and greatest are one. */
static void several_values(void)
{
    static const int goal[] = {PM_FIND_VALUE, PM_FIND_LEAST, PM_FIND_GREATEST};
    const double flat = 0.5 * asin(20 * G / 400);
    for (int i = 0; i < 3; i++) {
        throwing f = thrown_down_to(0);
        scene_find(f.s, goal[i], PM_NONE, 16);
        scene_vary(f.s, 1, 0.01, 1.56);
        scene_where(f.s, PM_CONDITION_ZERO, range_less(&f, 20));
        const double param[] = {20, 0};
        EQUAL(scene_run(f.s, param), i == 0 ? PM_FIND_SEVERAL : PM_OK);
        NEAR(f.s->found[0], i == 2 ? PI / 2 - flat : flat, 1e-10);
        EQUAL(f.s->count[PM_COUNT_FOUND], 2);
        if (i == 0) {
            NEAR(f.s->detail[PM_DETAIL_VALUE], PI / 2 - flat, 1e-10);
            EQUAL(f.s->detail[PM_DETAIL_BOUND], 2);
        }
        scene_free(f.s);
    }
}

/* Of two roots the one with the shorter flight. */
static void best_of_several(void)
{
    throwing f = thrown_down_to(0);
    scene_find(f.s, PM_FIND_GREATEST, scene_read(f.s, f.time), 16);
    scene_vary(f.s, 1, 0.01, 1.56);
    scene_where(f.s, PM_CONDITION_ZERO, range_less(&f, 20));
    const double param[] = {20, 0};
    EQUAL(scene_run(f.s, param), PM_OK);
    NEAR(f.s->found[0], PI / 2 - 0.5 * asin(20 * G / 400), 1e-10);
    scene_free(f.s);
}

/* Two roots between two samples, near the greatest range. */
static void roots_close_together(void)
{
    throwing f = thrown_down_to(0);
    const double most = 400 / G, wanted = most * (1 - 1e-4);
    scene_find(f.s, PM_FIND_LEAST, PM_NONE, 8);
    scene_vary(f.s, 1, 0.01, 1.5);
    scene_where(f.s, PM_CONDITION_ZERO, range_less(&f, wanted));
    const double param[] = {20, 0};
    EQUAL(scene_run(f.s, param), PM_OK);
    EQUAL(f.s->count[PM_COUNT_FOUND], 2);
    NEAR(f.s->found[0], 0.5 * asin(1 - 1e-4), 1e-8);
    scene_free(f.s);
}

/* A rod on a pin after many swings, on rk: its angle then as a function of its first speed. */
static scene *swinging(int *angle)
{
    scene *s = scene_create();
    const int omega = scene_parameter(s);
    const int b = scene_body(s, 2, 0.2, 0, -0.5, -PI / 2);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    SCENE_ROW(s, PM_TABLE_START, PM_START_VELOCITY, scene_measure(s, PM_MEASURE_OMEGA, b), omega);
    scene_until_time(s, 20);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_RK;
    *angle = scene_measure(s, PM_MEASURE_TURNED, b);
    return s;
}

static double angle_after(double speed)
{
    int angle;
    scene *s = swinging(&angle);
    const int out = scene_ask_measure(s, angle);
    EQUAL(scene_run(s, &speed), PM_OK);
    const double found = s->out[out];
    scene_free(s);
    return found;
}

static double speed_for(double wanted, double low, double high)
{
    int angle;
    scene *s = swinging(&angle);
    scene_find(s, PM_FIND_VALUE, PM_NONE, 4);
    scene_vary(s, 0, low, high);
    scene_where(s, PM_CONDITION_ZERO, scene_minus(s, angle, wanted));
    const double param[] = {0};
    EQUAL(scene_run(s, param), PM_OK);
    EQUAL(s->count[PM_COUNT_FOUND], 1);
    const double found = s->found[PM_FOUND_FIRST];
    scene_free(s);
    return found;
}

/* Samples of whose readings only the sign is used are run loosely: a root beside one, nearer than the loose run tells, is
 * found all the same, as it is where no sample is near. */
static void roots_at_samples(void)
{
    static const double off[] = {0, 1e-13, -1e-13, 1e-10, -1e-10, 1e-8, -1e-8, 3e-7, -3e-7};
    const double root = 2.0, step = 1e-3, wanted = angle_after(root);
    for (int i = 0; i < 9; i++) {
        const double low = root - 2 * step + off[i];
        NEAR(speed_for(wanted, low, low + 4 * step), root, 1e-10);
    }
}

/* The angle of the farthest throw onto a level below: tan = v / sqrt(v^2 + 2 g h). */
static void extremes(void)
{
    for (int goal = PM_FIND_GREATEST; goal <= PM_FIND_LEAST; goal++) {
        throwing f = thrown_down_to(-3);
        const int program = goal == PM_FIND_GREATEST ? scene_read(f.s, f.x)
                                                     : SCENE_PROGRAM(f.s, scene_m(f.x), scene_op(PM_OP_NEG));
        scene_find(f.s, goal, program, 32);
        scene_vary(f.s, 1, 0, 1.5);
        scene_ask_measure(f.s, f.x);
        const double param[] = {7, 0};
        EQUAL(scene_run(f.s, param), PM_OK);
        NEAR(f.s->found[0], atan(7 / sqrt(49 + 6 * G)), 1e-9);
        NEAR(f.s->out[0], 7 / G * sqrt(49 + 6 * G), 1e-9);
        scene_free(f.s);
    }
}

/* The ends count, those of the bounds and those of the part where a condition holds. */
static void extremes_at_ends(void)
{
    throwing f = thrown_down_to(0);
    scene_find(f.s, PM_FIND_GREATEST, scene_read(f.s, f.x), 10);
    scene_vary(f.s, 1, 0.1, 0.6);
    const double param[] = {7, 0};
    EQUAL(scene_run(f.s, param), PM_FIND_AT_BOUND);
    EQUAL(f.s->found[0], 0.6);
    EQUAL(f.s->where[PM_WHERE_TABLE], PM_TABLE_VARY);
    f.s->cell[PM_TABLE_FIND][PM_FIND_GOAL] = PM_FIND_LEAST;
    EQUAL(scene_run(f.s, param), PM_FIND_AT_BOUND);
    EQUAL(f.s->found[0], 0.1);
    f.s->cell[PM_TABLE_FIND][PM_FIND_GOAL] = PM_FIND_GREATEST;
    /* no longer than 0.7 s in flight: sin = g t / (2 v) = 0.49 */
    scene_where(f.s, PM_CONDITION_NOT_NEGATIVE,
                SCENE_PROGRAM(f.s, scene_k(f.s, 0.7), scene_m(f.time), scene_op(PM_OP_SUB)));
    EQUAL(scene_run(f.s, param), PM_OK);
    NEAR(f.s->found[0], asin(0.35 * G / 7), 1e-10);
    scene_free(f.s);
}

/* An ask with a corner, and one that is best inside the first interval between samples. */
static void corners(void)
{
    scene *s = scene_create();
    scene_parameter(s);
    scene_body(s, 1, 1, 0, 0, 0);
    scene_until(s, scene_when(s, PM_TRIGGER_START, PM_NONE), 1);
    const int corner =
        SCENE_PROGRAM(s, scene_p(0), scene_k(s, 0.3), scene_op(PM_OP_SUB), scene_op(PM_OP_ABS));
    const int top = SCENE_PROGRAM(s, scene_p(0), scene_k(s, 0.01), scene_op(PM_OP_SUB), scene_op(PM_OP_COS));
    scene_find(s, PM_FIND_LEAST, corner, 7);
    scene_vary(s, 0, 0, 1);
    scene_ask_end(s, SCENE_PROGRAM(s, scene_p(0)));
    const double param[] = {0};
    EQUAL(scene_run(s, param), PM_NO_TIME_ROUTE);
    NEAR(s->found[0], 0.3, 1e-11);
    s->cell[PM_TABLE_FIND][PM_FIND_GOAL] = PM_FIND_GREATEST;
    s->cell[PM_TABLE_FIND][PM_FIND_PROGRAM] = top;
    EQUAL(scene_run(s, param), PM_NO_TIME_ROUTE);
    NEAR(s->found[0], 0.01, 1e-11);
    scene_free(s);
}

/* The least speed with which a rod on a pin goes over the top: omega^2 = 6 g / L for a rod of length L from rest below. */
static void thresholds(void)
{
    const double length = 0.8, wanted = sqrt(6 * G / length);
    for (int goal = PM_FIND_GREATEST; goal <= PM_FIND_LEAST; goal++) {
        scene *s = scene_create();
        const int omega = scene_parameter(s);
        const int b = scene_body(s, 2, 2 * length * length / 12, 0, -length / 2, -PI / 2);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -length / 2, 0), scene_point(s, PM_GROUND, 0, 0), 0);
        const int angle = scene_measure(s, PM_MEASURE_TURNED, b),
                  spin = scene_measure(s, PM_MEASURE_OMEGA, b);
        SCENE_ROW(s, PM_TABLE_START, PM_START_VELOCITY, spin, omega);
        const int over = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, angle, PI));
        const int back = scene_when(s, PM_TRIGGER_FALL, scene_read(s, spin));
        SCENE_ROW(s, PM_TABLE_UNTIL, 0, over, 1);
        SCENE_ROW(s, PM_TABLE_UNTIL, 1, back, 1);
        const int happens =
            scene_read(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, goal == PM_FIND_LEAST ? over : back));
        scene_find(s, goal, PM_NONE, 8);
        scene_vary(s, 0, 1, 20);
        scene_where(s, PM_CONDITION_HOLDS, happens);
        scene_ask_measure(s, angle);
        const double param[] = {0};
        EQUAL(scene_run(s, param), PM_OK);
        NEAR(s->found[0], wanted, 1e-9 * wanted);
        NEAR(s->out[0], PI, 1e-3); /* the last run is on the side where the condition holds */
        EQUAL(s->status, PM_OK);
        scene_free(s);
    }
}

/* x > c at the end has a size: its root, to the rounding, in few runs. */
static void smooth_threshold(void)
{
    throwing f = thrown_down_to(0);
    scene_find(f.s, PM_FIND_LEAST, PM_NONE, 16);
    scene_vary(f.s, 0, 1, 40);
    scene_where(f.s, PM_CONDITION_POSITIVE, range_less(&f, 20));
    const double param[] = {0, 0.7}, v = sqrt(20 * G / sin(1.4));
    EQUAL(scene_run(f.s, param), PM_OK);
    NEAR(f.s->found[0], v, 1e-10 * v);
    CHECK(f.s->count[PM_COUNT_RUNS] < 40);
    f.s->cell[PM_TABLE_VARY][PM_VARY_LOW] = scene_value(f.s, 20); /* it holds everywhere */
    EQUAL(scene_run(f.s, param), PM_FIND_AT_BOUND);
    EQUAL(f.s->found[0], 20);
    scene_free(f.s);
}

/* Speed and angle to be at a place at a time. */
static void two_parameters(void)
{
    throwing f = thrown();
    scene_until_time(f.s, 1.2);
    scene_find(f.s, PM_FIND_VALUE, PM_NONE, 8);
    scene_vary(f.s, 0, 1, 30);
    scene_vary(f.s, 1, 0.05, 1.5);
    scene_where(f.s, PM_CONDITION_ZERO, range_less(&f, 9));
    scene_where(f.s, PM_CONDITION_ZERO, scene_minus(f.s, f.y, 2));
    const int out = scene_ask_measure(f.s, f.y);
    const double vx = 9 / 1.2, vy = 2 / 1.2 + 0.6 * G, param[] = {0, 0};
    EQUAL(scene_run(f.s, param), PM_OK);
    NEAR(f.s->found[PM_FOUND_FIRST], hypot(vx, vy), 1e-10 * vx);
    NEAR(f.s->found[PM_FOUND_SECOND], atan2(vy, vx), 1e-10);
    NEAR(f.s->out[out], 2, 1e-10);
    f.s->cell[PM_TABLE_VARY][PM_VARY_HIGH] = scene_value(f.s, 5); /* too slow */
    EQUAL(scene_run(f.s, param), PM_FIND_NONE);
    CHECK(isnan(f.s->out[out]));
    scene_free(f.s);
}

/* Where runs begin to fail is said to be a bound. */
static void edges(void)
{
    for (int by_ask = 0; by_ask < 2; by_ask++) {
        scene *s = scene_create();
        const int mass =
            scene_value_of(s, SCENE_PROGRAM(s, scene_p(s->nparam++), scene_k(s, 0.3), scene_op(PM_OP_SUB)));
        scene_body(s, 1, 1, 0, 0, 0);
        s->cell[PM_TABLE_BODY][PM_BODY_MASS] = mass;
        scene_until(s, scene_when(s, PM_TRIGGER_START, PM_NONE), 1);
        const int program = SCENE_PROGRAM(s, scene_p(0));
        scene_find(s, PM_FIND_LEAST, by_ask ? program : PM_NONE, 7);
        scene_vary(s, 0, 0, 1);
        if (!by_ask) scene_where(s, PM_CONDITION_POSITIVE, program);
        const double param[] = {1};
        EQUAL(scene_run(s, param), PM_FIND_AT_BOUND);
        NEAR(s->found[0], 0.3, 1e-15);
        scene_free(s);
    }
}

/* An outcome that changes three times: the least of all, and how often it changes. */
static void islands(void)
{
    throwing f = thrown_down_to(0);
    scene_find(f.s, PM_FIND_LEAST, PM_NONE, 16);
    scene_vary(f.s, 0, 1, 10);
    const int cosine = SCENE_PROGRAM(f.s, scene_p(0), scene_op(PM_OP_COS));
    scene_where(f.s, PM_CONDITION_POSITIVE, cosine); /* not from pi/2 to 3 pi/2, nor beyond 5 pi/2 */
    const double param[] = {0, 0.7};
    EQUAL(scene_run(f.s, param), PM_FIND_AT_BOUND);
    EQUAL(f.s->count[PM_COUNT_FOUND], 3);
    f.s->cell[PM_TABLE_FIND][PM_FIND_GOAL] = PM_FIND_GREATEST;
    EQUAL(scene_run(f.s, param), PM_OK);
    NEAR(f.s->found[0], 2.5 * PI, 1e-14);
    scene_free(f.s);
}

/* What is found lies where the particle passes a mark as it comes down: whether it has passed is told of the side on which the
 * condition holds, else of the lower speed. */
static void sides(void)
{
    for (int i = 0; i < 24; i++) {
        const int goal = i % 2 ? PM_FIND_LEAST : PM_FIND_VALUE;
        const double wanted = 12 + i / 4;
        throwing f = thrown_down_to(0);
        *scene_setting(f.s, PM_SETTING_ROUTE) = i % 4 < 2 ? PM_ROUTE_RK : PM_ROUTE_AUTO;
        const int mark = scene_when(f.s, PM_TRIGGER_RISE, range_less(&f, wanted));
        scene_find(f.s, goal, PM_NONE, 4);
        scene_vary(f.s, 0, 1, 40);
        scene_where(f.s, goal == PM_FIND_VALUE ? PM_CONDITION_ZERO : PM_CONDITION_NOT_NEGATIVE,
                    range_less(&f, wanted));
        const int passed = scene_ask_measure(f.s, scene_measure(f.s, PM_MEASURE_EVENT_COUNT, mark));
        const int time = scene_ask_measure(f.s, f.time);
        const double param[] = {NAN, 0.7}, v = sqrt(wanted * G / sin(1.4));
        EQUAL(scene_run(f.s, param), PM_OK);
        EQUAL(f.s->out[passed], goal == PM_FIND_LEAST);
        EQUAL(f.s->reason[0], PM_REASON_TWO_SIDED);
        EQUAL(f.s->reason[1], PM_REASON_NONE);
        NEAR(f.s->found[0], v, 1e-9 * v);
        NEAR(f.s->out[time], 2 * v * sin(0.7) / G, 1e-8);
        scene_free(f.s);
    }
}

int main(void)
{
    one_value();
    several_values();
    best_of_several();
    roots_close_together();
    roots_at_samples();
    extremes();
    extremes_at_ends();
    corners();
    thresholds();
    smooth_threshold();
    two_parameters();
    edges();
    islands();
    sides();
    return check_failures();
}
