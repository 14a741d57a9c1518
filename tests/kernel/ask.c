/* Answers over a run against closed forms: a rod that swings from rest, a throw, a ball that bounces. */
#include "check.h"
#include "scene.h"

#define G 9.81
#define PI 3.14159265358979323846

/* Complete elliptic integral of the first kind by the arithmetic-geometric mean. */
static double elliptic(double k)
{
    double a = 1, b = sqrt(1 - k * k);
    while (fabs(a - b) > 1e-15 * a) {
        const double c = 0.5 * (a + b);
        b = sqrt(a * b);
        a = c;
    }
    return 0.5 * PI / a;
}

/* A rod of length L and mass m on a pin, released level: with phi the angle below level omega^2 = 3 g sin(phi) / L and
 * the pin's horizontal force is 9/4 m g sin(phi) cos(phi). */
typedef struct swing {
    scene *s;
    double m, length;
    int body, turned, omega, fx, fy, time;
} swing;

static swing released(void)
{
    swing x = {.s = scene_create(), .m = 1.7, .length = 0.9};
    x.body = scene_body(x.s, x.m, x.m * x.length * x.length / 12, 0.5 * x.length, 0, 0);
    scene_joint(x.s, PM_JOINT_PIN, scene_point(x.s, x.body, -0.5 * x.length, 0),
                scene_point(x.s, PM_GROUND, 0, 0), 0);
    x.turned = scene_measure(x.s, PM_MEASURE_TURNED, x.body);
    x.omega = scene_measure(x.s, PM_MEASURE_OMEGA, x.body);
    x.fx = scene_part(x.s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_X);
    x.fy = scene_part(x.s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_Y);
    x.time = scene_time(x.s);
    return x;
}

static void extremes_of_a_swing(void)
{
    swing x = released();
    scene *s = x.s;
    const int back = scene_when(
        s, PM_TRIGGER_CROSS, scene_read(s, x.omega)); /* held at the start; then at the far end, and home */
    scene_until(s, back, 2);
    const int fast = scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, x.omega), PM_NONE);
    const int faster = scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, x.omega), PM_NONE);
    const int side = scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, x.fx), PM_NONE);
    const int up = scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, x.fy), PM_NONE);
    const int far = scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, x.turned), PM_NONE);
    const int where = scene_ask_extreme(s, PM_ASK_AT_MAX, scene_read(s, x.turned), scene_read(s, x.fx));
    const int lowest = scene_ask_extreme(s, PM_ASK_AT_MIN, scene_read(s, x.turned), scene_read(s, x.omega));
    const int period = scene_ask_measure(s, x.time), reaction = scene_ask_measure(s, x.fy);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double w = sqrt(3 * G / x.length), scale = x.m * G;
    NEAR(s->out[fast], -w, 1e-10 * w);
    NEAR(s->out[faster], w, 1e-10 * w);
    NEAR(fabs(s->out[side]), 9 / 8. * scale, 1e-9 * scale);
    NEAR(s->out[up], 2.5 * scale, 1e-9 * scale);
    NEAR(s->out[far], -PI, 1e-10);
    NEAR(s->out[lowest], -0.5 * PI, 1e-7);
    CHECK(fabs(s->out[where] + 0.25 * PI) < 1e-6 || fabs(s->out[where] + 0.75 * PI) < 1e-6);
    NEAR(s->out[period], 4 * sqrt(2 * x.length / (3 * G)) * elliptic(sqrt(0.5)), 1e-10);
    NEAR(s->out[reaction], 0.25 * scale, 1e-9 * scale); /* at rest, level */
    scene_free(s);
}

static void grid_over_angle(void)
{
    swing x = released();
    scene *s = x.s;
    const int first = s->rows[PM_TABLE_VALUE];
    for (int i = 0; i < 10; i++) scene_value(s, -0.3 * i);
    const int grid =
        scene_ask(s, PM_ASK_GRID, scene_read(s, x.omega), PM_NONE, 1, 0, scene_read(s, x.turned), first, 10);
    scene_value(s, -4); /* beyond the far end */
    const int never = scene_ask(s, PM_ASK_GRID, scene_read(s, x.omega), PM_NONE, 1, 0,
                                scene_read(s, x.turned), s->rows[PM_TABLE_VALUE] - 1, 1);
    scene_until_time(s, 1.2);
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int i = 0; i < 10; i++) NEAR(s->out[grid + i], -sqrt(3 * G * sin(0.3 * i) / x.length), 1e-9);
    EQUAL(s->reason[0], PM_REASON_NONE);
    CHECK(isnan(s->out[never]));
    EQUAL(s->reason[1], PM_REASON_NOT_REACHED);
    scene_free(s);
}

/* A run that ends inside a step answers nothing of what is beyond, also where no place gives the value to the last bit: an
 * angle that is added to a large number (1.2e-10 apart) and stretched misses every second of the numbers there. */
static void grid_beyond_end(int route)
{
    const double large = 530000, stretch = 1.97;
    swing x = released();
    scene *s = x.s;
    const int first = s->rows[PM_TABLE_VALUE], count = 60;
    for (int i = 0; i < count; i++) scene_value(s, nextafter(stretch * (large - 1.003 - 0.007 * i), 0));
    const int grid = scene_ask(s, PM_ASK_GRID, scene_read(s, x.omega), PM_NONE, 1, 0,
                               SCENE_PROGRAM(s, scene_m(x.turned), scene_k(s, large), scene_op(PM_OP_ADD),
                                             scene_k(s, stretch), scene_op(PM_OP_MUL)),
                               first, count);
    const int end = scene_when(s, PM_TRIGGER_FALL,
                               SCENE_PROGRAM(s, scene_m(x.turned), scene_k(s, 1), scene_op(PM_OP_ADD)));
    scene_until(s, end, 1);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int i = 0; i < count; i++) CHECK(isnan(s->out[grid + i]));
    scene_free(s);
}

/* When a particle passes grid values of its place, in a scene of any size: none is met before it is there, however short the
 * way is in metres; one that the run begins on, but for a rounding, is. */
static void grid_of_any_size(double size)
{
    const double speed = 3 * size, off = 4e-17 * size;
    scene *s = scene_create();
    const int p = scene_point(s, scene_body(s, 2, 0, off, 0, 0), 0, 0);
    const int x = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_X), time = scene_time(s);
    scene_start_velocity(s, p, speed, 0);
    const int first = s->rows[PM_TABLE_VALUE];
    for (int i = 0; i < 3; i++) scene_value(s, 0.5 * i * size);
    const int all = scene_ask(s, PM_ASK_GRID, scene_read(s, time), PM_NONE, 1, 0, scene_read(s, x), first, 3);
    const int begin =
        scene_ask(s, PM_ASK_GRID, scene_read(s, time), PM_NONE, 1, 0, scene_read(s, x), first, 1);
    scene_until_time(s, 0.7);
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int i = 0; i < 3; i++) NEAR(s->out[all + i], i / 6., 1e-12);
    NEAR(s->out[begin], 0, 1e-12);
    scene_free(s);
}

/* Each mark of a wheel that turns evenly goes its own way: omega r t. */
static void two_paths(int route)
{
    const double omega = 3, r[] = {0.2, 0.7};
    int way[2];
    scene *s = scene_create();
    const int wheel = scene_body(s, 2, 0.3, 0, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, wheel, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_start_omega(s, wheel, omega);
    for (int i = 0; i < 2; i++)
        way[i] = scene_ask_measure(
            s, scene_part(s, PM_MEASURE_PATH, scene_point(s, wheel, 0, r[i]), PM_PART_NONE));
    scene_until_time(s, 1.5);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int i = 0; i < 2; i++)
        NEAR(s->out[way[i]], 1.5 * omega * r[i], route == PM_ROUTE_IDA ? 1e-7 : 1e-12);
    scene_free(s);
}

static void throw_in_time(void)
{
    scene *s = scene_create();
    const double vx = 3, vy = 7;
    const int p = scene_point(s, scene_body(s, 2, 0, 0, 0, 0), 0, 0),
              y = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_Y);
    const int time = scene_time(s), path = scene_part(s, PM_MEASURE_PATH, p, PM_PART_NONE);
    scene_start_velocity(s, p, vx, vy);
    const int first = s->rows[PM_TABLE_VALUE];
    for (int i = 0; i <= 8; i++) scene_value(s, 0.15 * i);
    const int grid =
        scene_ask(s, PM_ASK_GRID, scene_read(s, y), PM_NONE, 1, 0, scene_read(s, time), first, 9);
    const int top = scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, y), PM_NONE);
    const int when = scene_ask_extreme(s, PM_ASK_AT_MAX, scene_read(s, time), scene_read(s, y));
    const int slow = scene_ask_extreme(
        s, PM_ASK_MIN, scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_NORM)), PM_NONE);
    const int last = scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, time), PM_NONE);
    const int way = scene_ask_measure(s, path);
    const int steep = scene_ask_extreme(
        s, PM_ASK_MAX, SCENE_PROGRAM(s, scene_k(s, 1), scene_m(time), scene_op(PM_OP_DIV)), PM_NONE);
    const int undefined = scene_ask_extreme(
        s, PM_ASK_MAX, SCENE_PROGRAM(s, scene_m(y), scene_k(s, 1), scene_op(PM_OP_SUB), scene_op(PM_OP_SQRT)),
        PM_NONE);
    const int end = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, time, 1.2));
    scene_until(s, end, 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int i = 0; i <= 8; i++) {
        const double t = 0.15 * i;
        NEAR(s->out[grid + i], vy * t - 0.5 * G * t * t, 1e-10);
    }
    NEAR(s->out[top], 0.5 * vy * vy / G, 1e-10);
    NEAR(s->out[when], vy / G, 1e-7);
    NEAR(s->out[slow], vx, 1e-10);
    NEAR(s->out[last], 1.2, 1e-12);
    /* arc length of a parabola: integral of sqrt(vx^2 + u^2) du / g */
    const double a = vy, b = vy - 1.2 * G;
    const double upper = 0.5 * (a * hypot(vx, a) + vx * vx * asinh(a / vx)),
                 lower = 0.5 * (b * hypot(vx, b) + vx * vx * asinh(b / vx));
    NEAR(s->out[way], (upper - lower) / G, 1e-9);
    CHECK(isinf(s->out[steep]) || isnan(s->out[steep])); /* 1/0 at the start */
    CHECK(isnan(s->out[undefined]));
    EQUAL(s->reason[s->rows[PM_TABLE_ASK] - 1], PM_REASON_UNDEFINED);
    scene_free(s);
}

/* Three waves and what dies away, by the angle x of a rod: a value begins a little below its later, lopsided top. */
typedef struct waves {
    double wide[3], phase[3], end, hump;
} waves;

static double wave(const waves *f, double x, int slope)
{
    double sum = f->hump * exp(-3 * x) * (slope ? -3 : 1);
    for (int i = 0; i < 3; i++) {
        const double by = 0.4 * (i + 1), at = by * x + f->phase[i];
        sum += f->wide[i] * (slope ? by * cos(at) : sin(at));
    }
    return sum;
}

/* The highest of the tops from x = 3 on, by halving wherever the slope changes its sign. */
static double later_top(const waves *f)
{
    const double fine = 1e-2;
    double top = -INFINITY;
    for (double x = 3; x + fine < f->end; x += fine) {
        double low = x, high = x + fine;
        if (!(wave(f, low, 1) > 0 && wave(f, high, 1) < 0)) continue;
        for (int i = 0; i < 60; i++) {
            const double middle = 0.5 * (low + high);
            if (wave(f, middle, 1) > 0)
                low = middle;
            else
                high = middle;
        }
        top = fmax(top, wave(f, low, 0));
    }
    return top;
}

static int program_of_waves(scene *s, const waves *f, int x)
{
    scene_code code[64] = {scene_m(x), scene_k(s, -3), scene_op(PM_OP_MUL), scene_op(PM_OP_EXP)};
    int n = 4;
    code[n++] = scene_k(s, f->hump);
    code[n++] = scene_op(PM_OP_MUL);
    for (int i = 0; i < 3; i++) {
        const scene_code term[] = {
            scene_m(x),          scene_k(s, 0.4 * (i + 1)), scene_op(PM_OP_MUL),    scene_k(s, f->phase[i]),
            scene_op(PM_OP_ADD), scene_op(PM_OP_SIN),       scene_k(s, f->wide[i]), scene_op(PM_OP_MUL),
            scene_op(PM_OP_ADD)};
        memcpy(code + n, term, sizeof term);
        n += (int)(sizeof term / sizeof *term);
    }
    return scene_program(s, n, code);
}

/* The slope at the node beside such a top tells too little of how far it rises: it is looked for. */
static void little_above_the_start(void)
{
    const waves cases[] = {{{-0.7, 0.8, 0.5}, {0.3, 2.8, 3}, 5.9, 0},
                           {{-1, -0.7, 0.7}, {1.9, 5, 3.5}, 4.6, 0},
                           {{0.3, -1, -0.4}, {1.7, 0.4, 1.6}, 6, 0}};
    for (int k = 0; k < 3; k++)
        for (int i = 2; i < 8; i++) {
            waves f = cases[k];
            for (int again = 0; again < 3; again++) /* the hump raises the later top, too, by very little */
                f.hump += later_top(&f) - pow(10, -i) - wave(&f, 0, 0);
            scene *s = scene_create();
            const int rod = scene_body(s, 1, 1.0 / 12, 0, 0, 0);
            scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
            scene_start_omega(s, rod, 3);
            *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
            const int x = scene_measure(s, PM_MEASURE_TURNED, rod);
            const int most = scene_ask_extreme(s, PM_ASK_MAX, program_of_waves(s, &f, x), PM_NONE);
            scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, x, f.end)), 1);
            EQUAL(scene_run(s, NULL), PM_OK);
            NEAR(s->out[most], later_top(&f), 1e-12);
            scene_free(s);
        }
}

/* The greatest value may be the one just after a blow, or the one just before. */
static void extremes_at_a_blow(void)
{
    const double e = 0.8, h = 1.1, v = sqrt(2 * G * h);
    scene *s = scene_create();
    const int p = scene_point(s, scene_body(s, 2, 0, 0, h, 0), 0, 0),
              vy = scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_Y);
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0), scene_floor(s, 0), 0, e,
                                PM_FRICTION_SMOOTH, 0);
    const int most = scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, vy), PM_NONE),
              least = scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, vy), PM_NONE);
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, c);
    const int before = scene_ask(s, PM_ASK_EACH, scene_read(s, vy), strike, 1, 1, PM_NONE, PM_NONE, 4);
    const int after = scene_ask(s, PM_ASK_EACH, scene_read(s, vy), strike, 1, 0, PM_NONE, PM_NONE, 4);
    scene_until(s, strike, 3);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[most], e * v, 1e-11);
    NEAR(s->out[least], -v, 1e-11);
    for (int i = 0; i < 3; i++) {
        NEAR(s->out[before + i], -pow(e, i) * v, 1e-11);
        NEAR(s->out[after + i], pow(e, i + 1) * v, 1e-11);
    }
    CHECK(isnan(s->out[after + 3]));
    scene_free(s);
}

/* Answers that are made of others: their reasons, and on a path their errors. */
static void asks_of_asks(void)
{
    swing x = released();
    scene *s = x.s;
    const int back = scene_when(s, PM_TRIGGER_CROSS, scene_read(s, x.omega));
    const int low = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, x.turned, -0.5 * PI));
    scene_until(s, back, 1);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
    scene_set(s, PM_SETTING_ACCURACY, 1e-6);
    const scene_code half = {PM_OP_ANSWER, scene_ask_measure(s, x.time)};
    const scene_code quarter = {PM_OP_ANSWER, scene_ask_event(s, scene_read(s, x.time), low, 1, 0)};
    const scene_code never = {PM_OP_ANSWER, scene_ask_event(s, scene_read(s, x.time), low, 2, 0)};
    const int off = scene_ask_end(
        s, SCENE_PROGRAM(s, half, scene_k(s, 0.5), scene_op(PM_OP_MUL), quarter, scene_op(PM_OP_SUB)));
    const int open = scene_ask_end(s, SCENE_PROGRAM(s, never, quarter, scene_op(PM_OP_SUB)));
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->count[PM_COUNT_ROUTES], 1 << PM_ROUTE_PATH);
    NEAR(s->out[off], 0, 1e-6);
    CHECK(fabs(s->out[off]) <= s->error[off]);
    CHECK(s->error[off] >= 0.5 * s->error[quarter.arg] && s->error[off] < 1e-5);
    CHECK(isnan(s->out[open]));
    EQUAL(s->reason[4], PM_REASON_NOT_REACHED);
    scene_free(s);
}

/* None is read before it is there. */
static void no_ask_of_a_later_one(void)
{
    swing x = released();
    scene *s = x.s;
    scene_ask_end(s, SCENE_PROGRAM(s, ((scene_code){PM_OP_ANSWER, 1})));
    scene_ask_measure(s, x.time);
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_BAD_TABLE);
    scene_free(s);
}

int main(void)
{
    asks_of_asks();
    no_ask_of_a_later_one();
    extremes_of_a_swing();
    grid_over_angle();
    grid_beyond_end(PM_ROUTE_PATH);
    grid_beyond_end(PM_ROUTE_RK);
    grid_of_any_size(1);
    grid_of_any_size(1e-12);
    throw_in_time();
    little_above_the_start();
    two_paths(PM_ROUTE_RK);
    two_paths(PM_ROUTE_IDA);
    two_paths(PM_ROUTE_AUTO);
    extremes_at_a_blow();
    return check_failures();
}
