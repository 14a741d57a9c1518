/* Thresholds right below or above where something turns back: throws with and without drag, an oscillator and its speed.  They are
 * gone through twice, so close together that a step shows nothing between, or not at all.  Counts are right where the depth is more
 * than rounding and the error of the run; else the run does not say that all is well. */
#include "check.h"
#include "scene.h"

#ifndef CASES
#define CASES 100 /* of each kind of motion, on each route */
#endif
#define G 9.81
#define PI 3.14159265358979323846
#define CLEAR 1e-11 /* depth, of the height, that is no rounding */
#define OFF 100     /* times the accuracy: no error of a run is so large */

enum { THROW, DRAG, SPRING, SPEED, KINDS };

typedef struct grazing {
    scene *s;
    int watched;        /* measure */
    double top, height; /* its greatest value, above where it begins */
    double at;          /* s: when */
} grazing;

/* A body of 1 kg at (0, y), thrown upwards. */
static grazing thrown(int kind, double y, double v)
{
    grazing x = {.s = scene_create()};
    scene *s = x.s;
    const int body = scene_body(s, 1, 0.1, 0, y, 0), point = scene_point(s, body, 0, 0);
    const int up = scene_part(s, PM_MEASURE_VELOCITY, point, PM_PART_Y);
    const double c = pow(10, check_random(-1.5, 0.5));
    scene_start_velocity(s, point, 0, v);
    x.watched = scene_part(s, PM_MEASURE_POSITION, point, PM_PART_Y);
    x.at = kind == DRAG ? log1p(c * v / G) / c : v / G;
    x.height = kind == DRAG ? v / c - G / c * x.at : v * v / (2 * G);
    x.top = y + x.height;
    if (kind == DRAG)
        scene_applied(s, point, PM_GROUND, scene_constant(s, 0),
                      SCENE_PROGRAM(s, scene_m(up), scene_k(s, -c), scene_op(PM_OP_MUL)));
    return x;
}

/* A body of 1 kg at (0, 0), thrown upwards, on a spring of k N/m: its height turns back, or its speed on the way up. */
static grazing on_spring(int kind, double k, double v)
{
    grazing x = {.s = scene_create()};
    scene *s = x.s;
    const int body = scene_body(s, 1, 0.1, 0, 0, 0), point = scene_point(s, body, 0, 0);
    const int y = scene_part(s, PM_MEASURE_POSITION, point, PM_PART_Y);
    const double rate = sqrt(k), low = -G / k, size = hypot(low, v / rate), phase = atan2(v / rate, -low);
    scene_start_velocity(s, point, 0, v);
    scene_applied(s, point, PM_GROUND, scene_constant(s, 0),
                  SCENE_PROGRAM(s, scene_m(y), scene_k(s, -k), scene_op(PM_OP_MUL)));
    x.watched = kind == SPEED ? scene_part(s, PM_MEASURE_VELOCITY, point, PM_PART_Y) : y;
    x.top = kind == SPEED ? size * rate : low + size;
    x.height = kind == SPEED ? x.top - v : x.top;
    x.at = (kind == SPEED ? phase + 1.5 * PI : phase) / rate;
    return x;
}

static grazing drawn(int kind)
{
    const double v = check_random(1, 9);
    return kind <= DRAG ? thrown(kind, check_random(-1, 1), v) : on_spring(kind, check_random(5, 60), v);
}

/* The threshold is `depth` of the height below the top. */
static void try_depth(int route, double accuracy, int kind, int trigger, double depth)
{
    static const int passages[] = {[PM_TRIGGER_CROSS] = 2, [PM_TRIGGER_RISE] = 1, [PM_TRIGGER_FALL] = 1};
    grazing x = drawn(kind);
    scene *s = x.s;
    double nothing = 0;
    scene_route(s, route, accuracy);
    *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
    const int count =
        scene_ask_count(s, scene_when(s, trigger, scene_minus(s, x.watched, x.top - depth * x.height)));
    scene_until_time(s, x.at * check_random(1.1, 1.4));
    const int status = scene_run(s, &nothing), expected = depth > 0 ? passages[trigger] : 0;
    CHECK(status == PM_OK || status == PM_UNDECIDED);
    if (fabs(depth) > fmax(CLEAR, OFF * accuracy)) EQUAL(status, PM_OK);
    if (status == PM_OK && fabs(depth) > CLEAR) EQUAL(s->out[count], expected);
    scene_free(s);
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_RK, PM_ROUTE_IDA, PM_ROUTE_AUTO},
                     triggers[] = {PM_TRIGGER_CROSS, PM_TRIGGER_RISE, PM_TRIGGER_FALL};
    for (int i = 0; i < 3 * KINDS * CASES; i++) {
        const double depth = pow(10, check_random(-13, -3)), accuracy = pow(10, check_random(-12, -5));
        try_depth(routes[i % 3], accuracy, i / 3 % KINDS, triggers[i / 3 / KINDS % 3],
                  i % 7 ? depth : -depth);
    }
    return check_failures();
}
