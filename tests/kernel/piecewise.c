/* Piecewise polynomials: values, pieces and knots beside a plain search, on both sides of their ends; forces that read them along
 * the motion against closed forms on each route; runs that leave them; tables that are none. */
#include "expression/piecewise.h"

#include "check.h"
#include "expression/program.h"
#include "scene.h"

#define CASES 40
#define MOST 8

static int pick(int n) { return (int)check_random(0, n); }

/* ---- values ---- */
typedef struct sample_table {
    double knot[MOST], coefficient[MOST * 4];
    int knots, degree, beyond;
} sample_table;

static sample_table random_table(int beyond)
{
    sample_table x = {.knots = 2 + pick(MOST - 1), .degree = pick(4), .beyond = beyond};
    for (int i = 0; i < x.knots; i++) x.knot[i] = (i ? x.knot[i - 1] : -2) + check_random(0.01, 1);
    for (int i = 0; i < MOST * 4; i++) x.coefficient[i] = check_random(-2, 2);
    return x;
}

static double power_sum(const sample_table *x, int piece, double u)
{
    double sum = 0;
    for (int k = 0; k <= x->degree; k++) sum += x->coefficient[piece * (x->degree + 1) + k] * pow(u, k);
    return sum;
}

/* The piece by going through all knots; the value there, *slope by differences within the piece. */
static double expected(const sample_table *x, double at, double *number)
{
    const int last = x->knots - 1;
    const double from = x->knot[0], to = x->knot[last], period = to - from;
    double laps = 0;
    if (x->beyond == PM_BEYOND_REPEAT) {
        laps = floor((at - from) / period);
        at -= laps * period;
    }
    int piece = -1;
    while (piece < last && x->knot[piece + 1] <= at) piece++;
    if (at == to && x->beyond == PM_BEYOND_NONE) piece = last - 1;
    *number = piece + laps * last;
    if (piece >= 0 && piece < last) return power_sum(x, piece, at - x->knot[piece]);
    const int end = piece < 0 ? 0 : last - 1;
    const double u = (piece < 0 ? from : to) - x->knot[end], h = 1e-4;
    const double slope = (power_sum(x, end, u + h) - power_sum(x, end, u - h)) / (2 * h);
    switch (x->beyond) {
    case PM_BEYOND_HOLD: return power_sum(x, end, u);
    case PM_BEYOND_EXTEND: return power_sum(x, end, u) + slope * (at - (piece < 0 ? from : to));
    case PM_BEYOND_ZERO: return 0;
    default: return NAN;
    }
}

static void look_at(const sample_table *x, const pm_piecewise *p, double at)
{
    double number, derivative[3];
    const double value = expected(x, at, &number), n = pm_piecewise_number(p, at), h = 1e-6;
    EQUAL(n, number);
    NEAR(pm_piecewise_value(p, at), value, 1e-6 * (1 + fabs(value)));
    CHECK(pm_piecewise_begin(p, n) <= at && at <= pm_piecewise_begin(p, n + 1));
    EQUAL(pm_piecewise_is_outside(p, at), isnan(value));
    const double here = pm_piecewise_piece(p, n, at, derivative);
    if (isnan(here)) return;
    const double a = pm_piecewise_piece(p, n, at - h, NULL), b = pm_piecewise_piece(p, n, at + h, NULL);
    NEAR(derivative[0], (b - a) / (2 * h), 1e-6 * (1 + fabs(derivative[0])));
}

static void values(void)
{
    for (int i = 0; i < 400; i++) {
        scene *s = scene_create();
        const sample_table x = random_table(i % PM_BEYOND_KINDS);
        scene_piecewise(s, x.knots, x.knot, x.degree, x.coefficient, x.beyond);
        if (CHECK(scene_open(s) == PM_OK)) {
            const pm_piecewise p = pm_piecewise_of(s->model, 0);
            for (int k = 0; k < 20; k++) look_at(&x, &p, check_random(-9, 9));
            for (int k = 0; k < x.knots && x.beyond != PM_BEYOND_REPEAT; k++) look_at(&x, &p, x.knot[k]);
            CHECK(isnan(pm_piecewise_value(&p, NAN)) && isnan(pm_piecewise_number(&p, INFINITY)));
        }
        scene_free(s);
    }
}

/* What is on a knot belongs to the piece to which it moves, or to that in which it stays. */
static void pieces_ahead(void)
{
    scene *s = scene_create();
    const double knot[4] = {0, 1, 2, 3}, value[4] = {0, 1, 0, 1};
    scene_lines(s, 4, knot, value, PM_BEYOND_HOLD);
    if (CHECK(scene_open(s) == PM_OK)) {
        const pm_piecewise p = pm_piecewise_of(s->model, 0);
        for (int k = 0; k < 4; k++)
            for (int off = -1; off <= 1; off++) {
                const double x = k + 1e-10 * off;
                EQUAL(pm_piecewise_number_ahead(&p, x, 1, 1e-9, 7), k);
                EQUAL(pm_piecewise_number_ahead(&p, x, -1, 1e-9, 7), k - 1);
                EQUAL(pm_piecewise_number_ahead(&p, x, 0, 1e-9, k - 1), k - 1);
                EQUAL(pm_piecewise_number_ahead(&p, x, 0, 1e-9, k), k);
            }
        EQUAL(pm_piecewise_number_ahead(&p, 1.5, -1, 1e-9, 7), 1);
    }
    scene_free(s);
}

/* ---- along the motion ---- */
/* A particle of mass 1 at place 0 that a force pushes along y. */
typedef struct particle {
    scene *s;
    int point, place, speed, out_place, out_speed;
} particle;

static particle particle_with(double speed, int route)
{
    particle p = {.s = scene_create()};
    *scene_setting(p.s, PM_SETTING_ROUTE) = route;
    scene_set(p.s, PM_SETTING_GRAVITY_Y, 0);
    p.point = scene_point(p.s, scene_body(p.s, 1, 0, 0, 0, 0), 0, 0);
    p.place = scene_part(p.s, PM_MEASURE_POSITION, p.point, PM_PART_Y);
    p.speed = scene_part(p.s, PM_MEASURE_VELOCITY, p.point, PM_PART_Y);
    p.out_place = scene_ask_measure(p.s, p.place);
    p.out_speed = scene_ask_measure(p.s, p.speed);
    scene_start_velocity(p.s, p.point, 0, speed);
    return p;
}

/* The table, read at a measure by its piece. */
static int read_by_piece(scene *s, int table, int measure)
{
    const int event = SCENE_ROW(s, PM_TABLE_EVENT, 0, PM_EFFECT_PIECE);
    const int piece = scene_measure(s, PM_MEASURE_EVENT_SIDE, event);
    const scene_code knot = {PM_OP_KNOT, table}, read = {PM_OP_PIECE, table};
    scene_trigger(s, PM_TRIGGER_FALL, event,
                  SCENE_PROGRAM(s, scene_m(measure), scene_m(piece), knot, scene_op(PM_OP_SUB)), PM_NONE);
    scene_trigger(s, PM_TRIGGER_RISE, event,
                  SCENE_PROGRAM(s, scene_m(measure), scene_m(piece), scene_k(s, 1), scene_op(PM_OP_ADD), knot,
                                scene_op(PM_OP_SUB)),
                  PM_NONE);
    SCENE_ROW(s, PM_TABLE_READING, event, table, scene_read(s, measure));
    return SCENE_PROGRAM(s, scene_m(measure), scene_m(piece), read);
}

static void push(particle *p, int program)
{
    scene_applied(p->s, p->point, PM_GROUND, SCENE_PROGRAM(p->s, scene_k(p->s, 0)), program);
}

static void ends_at_place(particle *p, double place, double speed, double close)
{
    scene_until(p->s, scene_when(p->s, PM_TRIGGER_RISE, scene_minus(p->s, p->place, place)), 1);
    EQUAL(scene_run(p->s, NULL), PM_OK);
    NEAR(p->s->out[p->out_speed], speed, close);
    scene_free(p->s);
}

/* A triangular spike along the way, however narrow, gives its area as kinetic energy. */
static void a_spike_of_place(int route)
{
    for (double width = 0.5; width > 1e-6; width *= 0.1) {
        const double work = check_random(0.5, 3), v = check_random(0.5, 2);
        const double knot[5] = {-1, 1, 1 + width, 1 + 2 * width, 9}, value[5] = {0, 0, work / width, 0, 0};
        particle p = particle_with(v, route);
        push(&p, read_by_piece(p.s, scene_lines(p.s, 5, knot, value, PM_BEYOND_NONE), p.place));
        ends_at_place(&p, 3, sqrt(v * v + 2 * work), 1e-8);
    }
}

/* A step, but for a ramp that may be less than a step of the run can tell. */
static void nearly_a_step(int route)
{
    for (double width = 1e-2; width > 1e-14; width *= 0.1) {
        const double force = check_random(-0.1, 2), v = check_random(1, 2), end = 1 + width;
        const double knot[4] = {-1, 1, end, 9}, value[4] = {0, 0, force, force};
        particle p = particle_with(v, route);
        push(&p, read_by_piece(p.s, scene_lines(p.s, 4, knot, value, PM_BEYOND_NONE), p.place));
        ends_at_place(&p, 3, sqrt(v * v + force * (end - 1) + 2 * force * (3 - end)), 1e-8);
    }
}

/* The area of a spike in time is momentum. */
static void a_spike_of_time(int route)
{
    for (double width = 0.5; width > 1e-6; width *= 0.1) {
        const double area = check_random(0.5, 3), v = check_random(0.5, 2);
        const double knot[5] = {-1, 1, 1 + width, 1 + 2 * width, 9}, value[5] = {0, 0, area / width, 0, 0};
        particle p = particle_with(v, route);
        const scene_code read = {PM_OP_PIECEWISE, scene_lines(p.s, 5, knot, value, PM_BEYOND_NONE)};
        push(&p, SCENE_PROGRAM(p.s, scene_m(scene_time(p.s)), read));
        scene_until_time(p.s, 3);
        EQUAL(scene_run(p.s, NULL), PM_OK);
        NEAR(p.s->out[p.out_speed], v + area, 1e-9);
        scene_free(p.s);
    }
}

/* -k x out of a table swings as a spring does, from rest on a knot, too; turns lie within a piece or on its end. */
static void a_spring(int route)
{
    for (int i = 0; i < CASES / 4; i++) {
        const double k = check_random(1, 9), v = check_random(0.5, 2), w = sqrt(k), t = check_random(2, 9);
        const double edge = i % 2 ? v / w : check_random(0.3, 0.9) * v / w;
        const double knot[5] = {-9, -edge, 0, edge, 9}, value[5] = {9 * k, edge * k, 0, -edge * k, -9 * k};
        particle p = particle_with(v, route);
        push(&p, read_by_piece(p.s, scene_lines(p.s, 5, knot, value, PM_BEYOND_NONE), p.place));
        scene_until_time(p.s, t);
        EQUAL(scene_run(p.s, NULL), PM_OK);
        NEAR(p.s->out[p.out_place], v / w * sin(w * t), 1e-8);
        scene_free(p.s);
    }
}

/* A force by the speed: a table that falls to zero at v1 makes v = v1 (1 - exp(-c t)), and beyond its end goes on so. */
static void a_table_of_speed(int route)
{
    for (int i = 0; i < CASES / 4; i++) {
        const double c = check_random(0.5, 3), v1 = check_random(1, 4), t = check_random(0.5, 3);
        const double v = i % 2 ? 0 : 1.5 * v1;
        const double knot[4] = {-9, 0, 0.5 * v1, v1}, value[4] = {c * (v1 + 9), c * v1, 0.5 * c * v1, 0};
        particle p = particle_with(v, route);
        push(&p, read_by_piece(p.s, scene_lines(p.s, 4, knot, value, PM_BEYOND_EXTEND), p.speed));
        scene_until_time(p.s, t);
        EQUAL(scene_run(p.s, NULL), PM_OK);
        NEAR(p.s->out[p.out_speed], v1 + (v - v1) * exp(-c * t), 1e-9);
        scene_free(p.s);
    }
}

/* It is at the end of the table at t = 2; up to there it has a value. */
static void an_end(int route, int in_time)
{
    for (int late = 0; late < 2; late++) {
        const double knot[3] = {0, 1, 2}, value[3] = {0, 0, 0};
        particle p = particle_with(1, route);
        const int table = scene_lines(p.s, 3, knot, value, PM_BEYOND_NONE);
        const scene_code read = {PM_OP_PIECEWISE, table};
        push(&p, in_time ? SCENE_PROGRAM(p.s, scene_m(scene_time(p.s)), read)
                         : read_by_piece(p.s, table, p.place));
        scene_until_time(p.s, late ? 2.5 : 2 - 1e-9 * !in_time);
        EQUAL(scene_run(p.s, NULL), late ? PM_TABLE_ENDS : PM_OK);
        if (late) {
            EQUAL(p.s->where[PM_WHERE_TABLE], PM_TABLE_PIECEWISE);
            EQUAL(p.s->where[PM_WHERE_ROW], table);
            NEAR(p.s->detail[PM_DETAIL_VALUE], 2, 1e-9);
            EQUAL(p.s->detail[PM_DETAIL_BOUND], 2);
        }
        scene_free(p.s);
    }
}

/* ---- what is no table ---- */
static void refused(int what)
{
    scene *s = scene_create();
    double knot[3] = {0, 1, 2};
    const double line[4] = {0, 1, 1, 1};
    if (what == 1) knot[1] = 2;
    if (what == 2) knot[2] = INFINITY;
    scene_piecewise(s, 3, knot, 1, line, what == 3 ? PM_BEYOND_KINDS : PM_BEYOND_NONE);
    if (what == 4) s->cell[PM_TABLE_PIECEWISE][PM_PIECEWISE_FIRST] = s->nconstant - 2;
    if (what == 5) s->cell[PM_TABLE_PIECEWISE][PM_PIECEWISE_KNOTS] = 1;
    if (what == 6) SCENE_PROGRAM(s, scene_k(s, 1), (scene_code){PM_OP_PIECEWISE, 1});
    EQUAL(scene_open(s), what ? PM_BAD_TABLE : PM_OK);
    scene_free(s);
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    values();
    pieces_ahead();
    for (int i = 0; i < 3; i++) {
        a_spike_of_place(routes[i]);
        nearly_a_step(routes[i]);
        a_spike_of_time(routes[i]);
        a_spring(routes[i]);
        a_table_of_speed(routes[i]);
        an_end(routes[i], 0);
        an_end(routes[i], 1);
    }
    for (int what = 0; what <= 6; what++) refused(what);
    return check_failures();
}
