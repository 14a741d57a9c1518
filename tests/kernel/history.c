/* Histories: on a grid of times and along each step, for all routes; what is recorded changes nothing. */
#include "check.h"
#include "scene.h"

#define G 9.81
#define MOST 5000
#define COLUMNS 3

typedef struct record {
    double row[MOST][1 + COLUMNS];
    int32_t mark[MOST];
    int64_t n;
    int status;
} record;

static void trace(const scene *s, int n, const int32_t *program, const double *bend, double every, record *x)
{
    const double none = 0;
    int32_t where[3];
    double detail[3];
    static double flat[MOST * (1 + COLUMNS)];
    x->status = pm_trace(s->ntable, s->table, s->nconstant, s->constant, 0, &none, NULL, every, n, program,
                         bend, MOST, flat, x->mark, &x->n, where, detail);
    CHECK(x->n > 1 && x->n <= MOST);
    for (int64_t i = 0; i < x->n; i++)
        for (int k = 0; k <= n; k++) x->row[i][k] = flat[i * (1 + n) + k];
}

/* A ball thrown up from y = 1 at 3 m/s that strikes the floor and rebounds by half. */
static scene *ball(int route)
{
    scene *s = scene_create();
    const int p = scene_point(s, scene_body(s, 1, 0, 0, 1, 0), 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0.1), scene_floor(s, 0), 0, 0.5, PM_FRICTION_SMOOTH,
                  0);
    SCENE_ROW(s, PM_TABLE_START, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_Y),
              scene_value(s, 3));
    scene_until_time(s, 1.1);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, p, PM_PART_Y));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    scene_pack(s);
    return s;
}

/* The height as a formula. */
static double height(double t)
{
    const double strike = (3 + sqrt(9 + 2 * G * 0.9)) / G, speed = 3 - G * strike;
    const double since = t - strike;
    return since <= 0 ? 1 + 3 * t - 0.5 * G * t * t : 0.1 - 0.5 * speed * since - 0.5 * G * since * since;
}

static void thrown(int route, double close)
{
    scene *s = ball(route);
    static record x;
    const int32_t height_of[] = {s->cell[PM_TABLE_ASK][PM_ASK_PROGRAM]};
    const double any[] = {INFINITY}, fine[] = {1e-3};
    trace(s, 1, height_of, any, 0.01, &x);
    EQUAL(x.status, PM_OK);
    int k = 0, sides = 0;
    EQUAL(x.mark[0], 2); /* nothing jumps there: the start has one row */
    for (int64_t i = 0; i < x.n; i++) {
        if (x.mark[i] == 0) EQUAL(x.row[i][0], 0.01 * ++k); /* the grid, and nothing but the grid */
        sides += x.mark[i] == 1;
        NEAR(x.row[i][1], height(x.row[i][0]), close);
    }
    EQUAL(k, 109); /* the end at 1.1 s is an instant */
    EQUAL(sides, 2);
    const double last = x.row[x.n - 1][1];
    trace(s, 1, height_of, fine, 0, &x);
    EQUAL(x.row[x.n - 1][1], last); /* what is recorded changes nothing */
    CHECK(x.n > 40 && x.n < 600);
    for (int64_t i = 1; i < x.n; i++) /* a parabola is farthest from its chord in the middle */
        CHECK(G / 8 * pow(x.row[i][0] - x.row[i - 1][0], 2) <= fine[0] * (1 + 1e-6));
    scene_free(s);
}

/* The ball is put on the floor at 3 m/s downwards: it is struck as the run begins, and both sides are there. */
static void struck_at_once(int route, double close)
{
    scene *s = scene_create();
    const int p = scene_point(s, scene_body(s, 1, 0, 0, 0.1, 0), 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0.1), scene_floor(s, 0), 0, 0.5, PM_FRICTION_SMOOTH,
                  0);
    SCENE_ROW(s, PM_TABLE_START, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_Y),
              scene_value(s, -3));
    scene_until_time(s, 0.1);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_Y));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    scene_pack(s);
    static record x;
    const int32_t speed_of[] = {s->cell[PM_TABLE_ASK][PM_ASK_PROGRAM]};
    const double any[] = {INFINITY};
    trace(s, 1, speed_of, any, 0.01, &x);
    EQUAL(x.status, PM_OK);
    for (int i = 0; i < 2; i++) {
        EQUAL(x.mark[i], i + 1);
        EQUAL(x.row[i][0], 0);
        NEAR(x.row[i][1], i ? 1.5 : -3, close);
    }
    EQUAL(x.mark[2], 0);
    NEAR(x.row[2][1], 1.5 - G * 0.01, close);
    scene_free(s);
}

/* A rod that falls from rest at the level: the path route, whose places are no times.  Its energy is kept at each. */
static void falls(int route, double close)
{
    scene *s = scene_create();
    const int rod = scene_body(s, 1, 1 / 12., 0.5, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_until(s,
                scene_when(s, PM_TRIGGER_CROSS,
                           SCENE_PROGRAM(s, scene_m(scene_measure(s, PM_MEASURE_ANGLE, rod)), scene_k(s, 1.5),
                                         scene_op(PM_OP_ADD))),
                1);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, rod));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, rod));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    scene_pack(s);
    const int32_t program[] = {s->cell[PM_TABLE_ASK][PM_ASK_PROGRAM],
                               s->cell[PM_TABLE_ASK][PM_ASK_COLUMNS + PM_ASK_PROGRAM]};
    const double any[] = {INFINITY, INFINITY}, bend[] = {1e-3, INFINITY};
    static record x, fine;
    trace(s, 2, program, any, 0.001, &x);
    EQUAL(x.status, PM_OK);
    CHECK(x.n > 400);
    for (int64_t i = 0; i < x.n; i++) NEAR(x.row[i][2] * x.row[i][2], -3 * G * sin(x.row[i][1]), close);
    for (int64_t i = 1; i + 1 < x.n; i++) {
        if (x.mark[i]) continue;
        EQUAL(x.row[i][0], 0.001 * (double)i);
        /* Simpson's rule: the angle goes with its rate over the times that the rows name */
        if (i % 2 && !x.mark[i + 1])
            NEAR(x.row[i + 1][1] - x.row[i - 1][1],
                 0.001 / 3 * (x.row[i - 1][2] + 4 * x.row[i][2] + x.row[i + 1][2]), 1e-11 + close);
    }
    fine = x;
    trace(s, 2, program, bend, 0, &x);
    CHECK(x.n > 20);
    int64_t i = 1; /* each fine row lies near the line between its neighbours */
    for (int64_t k = 0; k < fine.n; k++) {
        const double t = fine.row[k][0];
        while (i + 1 < x.n && x.row[i][0] < t) i++;
        const double *a = x.row[i - 1], *b = x.row[i], part = (t - a[0]) / fmax(b[0] - a[0], 1e-300);
        NEAR(fine.row[k][1], a[1] + part * (b[1] - a[1]), bend[0]);
    }
    scene_free(s);
}

/* Rows that are wanted of a grid, with room for four of them. */
static int64_t wanted(const scene *s, double every, int expected, double few[4][2])
{
    const int32_t program[] = {s->cell[PM_TABLE_ASK][PM_ASK_PROGRAM]};
    const double any[] = {INFINITY}, none = 0;
    double detail[3];
    int32_t mark[4], where[3];
    int64_t needed;
    EQUAL(pm_trace(s->ntable, s->table, s->nconstant, s->constant, 0, &none, NULL, every, 1, program, any, 4,
                   few[0], mark, &needed, where, detail),
          expected);
    return needed;
}

/* More times than there is room for are counted, not computed, also more than an integer holds; a distance that is negative or
 * infinite is refused. */
static void counted(void)
{
    scene *s = ball(PM_ROUTE_UNIFORM);
    double few[4][2];
    NEAR((double)wanted(s, 1e-12, PM_OK, few), 1.1e12, 10);
    EQUAL(few[3][0], 3e-12);
    CHECK(wanted(s, 1e-300, PM_OK, few) >= INT64_C(1) << 53);
    EQUAL(few[3][0], 3e-300);
    EQUAL(wanted(s, -1, PM_BAD_TABLE, few), 0);
    EQUAL(wanted(s, INFINITY, PM_BAD_TABLE, few), 0);
    scene_free(s);
}

/* A run that ends early has a row where it ends, also between two times of the grid. */
static void early(void)
{
    scene *s = scene_create();
    const int p = scene_point(s, scene_body(s, 1, 0, 0, 0, 0), 0, 0);
    const int y = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_Y);
    scene_until(
        s, scene_when(s, PM_TRIGGER_RISE, SCENE_PROGRAM(s, scene_m(y), scene_k(s, 1), scene_op(PM_OP_SUB))),
        1);
    scene_ask_measure(s, y);
    *scene_setting(s, PM_SETTING_MAX_TIME) = scene_value(s, 0.25);
    scene_pack(s);
    const int32_t program[] = {s->cell[PM_TABLE_ASK][PM_ASK_PROGRAM]};
    const double any[] = {INFINITY};
    static record x;
    trace(s, 1, program, any, 0.1, &x);
    EQUAL(x.status, PM_LIMIT_TIME);
    EQUAL(x.n, 4);
    EQUAL(x.row[3][0], 0.25);
    NEAR(x.row[3][1], -0.5 * G * 0.0625, 1e-12);
    scene_free(s);
}

int main(void)
{
    thrown(PM_ROUTE_UNIFORM, 1e-13);
    thrown(PM_ROUTE_RK, 1e-12);
    thrown(PM_ROUTE_IDA, 1e-8);
    struck_at_once(PM_ROUTE_UNIFORM, 1e-14);
    struck_at_once(PM_ROUTE_RK, 1e-12);
    struck_at_once(PM_ROUTE_IDA, 1e-8);
    falls(PM_ROUTE_PATH, 1e-11);
    falls(PM_ROUTE_RK, 1e-9);
    falls(PM_ROUTE_IDA, 1e-7);
    counted();
    early();
    return check_failures();
}
