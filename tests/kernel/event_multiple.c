/* Multiples that a trigger counts: each is met once as it is reached, beside other events, on and about a multiple, many in a step. */
#include "check.h"
#include "path_scenes.h"
#include "scene.h"

#define G 9.81
#define MOST 100 /* times that are asked for */

/* A particle thrown from (0, y); `what` is counted in steps of `d`. */
typedef struct flight {
    scene *s;
    int point, x, y, speed, time;
} flight;

static flight thrown(int route, double y, double vx, double vy)
{
    flight t = {.s = scene_by(route, 1e-9)};
    const int point = scene_point(t.s, scene_body(t.s, 0.7, 0, 0, y, 0), 0, 0);
    t.point = point;
    t.x = scene_part(t.s, PM_MEASURE_POSITION, point, PM_PART_X);
    t.y = scene_part(t.s, PM_MEASURE_POSITION, point, PM_PART_Y);
    t.speed = scene_part(t.s, PM_MEASURE_VELOCITY, point, PM_PART_NORM);
    t.time = scene_time(t.s);
    scene_start_velocity(t.s, point, vx, vy);
    return t;
}

static int counted(scene *s, int measure, double d)
{
    return scene_when(s, PM_TRIGGER_EVERY,
                      SCENE_PROGRAM(s, scene_m(measure), scene_k(s, d), scene_op(PM_OP_DIV)));
}

static int times_of(flight *t, int event, int most)
{
    return scene_ask(t->s, PM_ASK_EACH, scene_read(t->s, t->time), event, 1, 0, PM_NONE, PM_NONE, most);
}

static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};

/* x and t each in their own steps, and a place that x passes: three kinds of events cut each other's steps. */
static void beside_others(void)
{
    static const double step[][3] = {
        {0.36, 0.35, 0.7}, {0.01, 0.35, 0.1}, {0.4, 0.399, 0.4}, {0.3, 0.31, 0.7}, {0.0137, 1.1, 0.0211}};
    for (int route = 0; route < 3; route++)
        for (int k = 0; k < 5; k++) {
            flight t = thrown(routes[route], 0, 1, 3);
            scene *s = t.s;
            const double end = 3.05, dt = step[k][0], place = step[k][1], dx = step[k][2];
            const int in_time = counted(s, t.time, dt), along = counted(s, t.x, dx),
                      over = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, t.x, place));
            const int at[] = {times_of(&t, in_time, MOST), times_of(&t, along, MOST)},
                      n[] = {scene_ask_count(s, in_time), scene_ask_count(s, along),
                             scene_ask_count(s, over)};
            scene_until_time(s, end);
            EQUAL(scene_run(s, NULL), PM_OK);
            for (int i = 0; i < 2; i++) {
                const double d = i ? dx : dt;
                EQUAL(s->out[n[i]], floor(end / d));
                for (int j = 0; j < (int)floor(end / d) && j < MOST; j++)
                    NEAR(s->out[at[i] + j], (j + 1) * d, 1e-12);
            }
            EQUAL(s->out[n[2]], 1);
            scene_free(s);
        }
}

/* Up through the multiples that are above the start, and down again through these and others; it starts on one, or not. */
static void up_and_down(void)
{
    const double vy = 8, top = 0.5 * vy * vy / G, end = 2.5;
    for (int route = 0; route < 3; route++)
        for (int on = 0; on < 2; on++)
            for (double d = 0.011; d < 2; d *= 1.9) {
                const double y = on ? 3 * d : 2.7 * d;
                flight t = thrown(routes[route], y, 1, vy);
                scene *s = t.s;
                const int event = counted(s, t.y, d), at = times_of(&t, event, MOST),
                          n = scene_ask_count(s, event);
                scene_until_time(s, end);
                EQUAL(scene_run(s, NULL), PM_OK);
                const double first = floor(y / d + 1e-9) + 1, highest = floor((y + top) / d),
                             lowest = ceil((y + vy * end - 0.5 * G * end * end) / d);
                int k = 0;
                for (int way = 1; way >= -1; way -= 2)
                    for (double m = way > 0 ? first : highest; way > 0 ? m <= highest : m >= lowest;
                         m += way, k++)
                        if (k < MOST)
                            NEAR(s->out[at + k], (vy - way * sqrt(vy * vy + 2 * G * (y - m * d))) / G, 1e-9);
                EQUAL(s->out[n], k);
                scene_free(s);
            }
}

/* A speed has a sharp least value, which few nodes of a step do not show. */
static void turns_between_nodes(void)
{
    for (int route = 0; route < 3; route++)
        for (double vy = 2; vy < 8; vy *= 1.03) {
            const double d = 0.0082 * vy, end = 1.7 * vy / G, last = hypot(1, vy - G * end);
            flight t = thrown(routes[route], 0, 1, vy);
            const int n = scene_ask_count(t.s, counted(t.s, t.speed, d));
            scene_until_time(t.s, end);
            EQUAL(scene_run(t.s, NULL), PM_OK);
            const double below = ceil(1 / d); /* the least multiple that is reached */
            EQUAL(t.s->out[n], floor(hypot(1, vy) / d) - below + 1 + floor(last / d) - below + 1);
            scene_free(t.s);
        }
}

/* What rests on a multiple does not reach it; what is hit off it and comes back does. */
static void rests_on_one(void)
{
    for (int route = 0; route < 3; route++) {
        flight t = thrown(routes[route], 0.6, 1, 8);
        scene *s = t.s;
        const int rests = scene_point(s, scene_body(s, 1, 0, 0.9, 0, 0), 0, 0);
        const int x = scene_part(s, PM_MEASURE_POSITION, rests, PM_PART_X);
        const int never = scene_ask_count(s, counted(s, x, 0.3));
        const int twice = scene_ask_count(s, counted(s, t.y, 0.6));
        scene_when(s, PM_TRIGGER_RISE, scene_minus(s, t.x, 0.4));
        scene_until_time(s, 16.01 / G);
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[never], 0);
        EQUAL(s->out[twice],
              2 * floor(32 / G / 0.6) + 1); /* those above, up and down, and the first as it returns */
        scene_free(s);
    }
}

/* A blow comes right before a multiple, or right after it: it is met once. */
static void beside_a_blow(void)
{
    const double h = 1.5, struck = sqrt(2 * h / G);
    for (double beside = -1e-10; beside <= 1e-10; beside += 0.4e-10) {
        flight t = thrown(PM_ROUTE_AUTO, h, 1, 0);
        scene *s = t.s;
        const int line = scene_line(s, scene_point(s, PM_GROUND, 0, 0), 0);
        const double d = (struck + beside) / 3;
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, t.point, 0), line, 0, 0.7, PM_FRICTION_SMOOTH, 0);
        const int n = scene_ask_count(s, counted(s, t.time, d));
        scene_until_time(s, 6.5 * d);
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[n], 6);
        scene_free(s);
    }
}

/* A pendulum: times that are counted where a step is long, and its angle, which turns back. */
static void on_a_path(void)
{
    for (double dt = 0.008; dt < 0.3; dt *= 1.7) {
        scene *s = scene_create();
        pendulum_rod(s, 0);
        const int time = scene_time(s), event = counted(s, time, dt),
                  at = scene_ask(s, PM_ASK_EACH, scene_read(s, time), event, 1, 0, PM_NONE, PM_NONE, MOST),
                  n = scene_ask_count(s, event);
        scene_until_time(s, 1.003);
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[n], floor(1.003 / dt));
        for (int k = 0; k < (int)floor(1.003 / dt) && k < MOST; k++)
            NEAR(s->out[at + k], (k + 1) * dt, 1e-12);
        scene_free(s);
    }
}

int main(void)
{
    beside_others();
    up_and_down();
    turns_between_nodes();
    rests_on_one();
    beside_a_blow();
    on_a_path();
    return check_failures();
}
