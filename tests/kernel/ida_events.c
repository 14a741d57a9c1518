/* Events on the ida route: roots that change no sign between steps, bounces to rest; failures that come back as numbers; the
 * same bits always. */
#include "check.h"
#include "routes/ida/ida.h"
#include "scene.h"
#include "state/route.h"
#include "state/workspace.h"

#define G 9.81

/* ---- roots ---- */
typedef struct flight {
    scene *s;
    int body, point, x, y;
} flight;

static flight thrown(double vx, double vy, double accuracy)
{
    flight f = {.s = scene_by(PM_ROUTE_IDA, accuracy)};
    f.body = scene_body(f.s, 0.7, 0, 0, 0, 0);
    f.point = scene_point(f.s, f.body, 0, 0);
    f.x = scene_part(f.s, PM_MEASURE_POSITION, f.point, PM_PART_X);
    f.y = scene_part(f.s, PM_MEASURE_POSITION, f.point, PM_PART_Y);
    scene_start_velocity(f.s, f.point, vx, vy);
    return f;
}

/* Heights just below the top are passed twice within one step, wherever the step begins. */
static void grazes(void)
{
    for (int i = 0; i < 20; i++) {
        flight f = thrown(1, 8 + 0.0137 * i, 1e-7);
        scene *s = f.s;
        const double v = 8 + 0.0137 * i, below = 1e-8 * (1 + i), top = v * v / (2 * G),
                     dt = sqrt(2 * below / G);
        const int event = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, f.y, top - below)),
                  count = scene_ask_count(s, event);
        const int first = scene_ask_event(s, scene_read(s, scene_time(s)), event, 1, 0);
        scene_until_time(s, 1.2);
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[count], 2);
        NEAR(s->out[first], v / G - dt, 0.1 * dt);
        scene_free(s);
    }
}

/* A function that holds zero at the start, or misses it by rounding, counts when it comes back, from either
 * side; multiples count each once. */
static void held_zeros(void)
{
    for (int side = -1; side <= 1; side += 2) {
        flight f = thrown(3 * side, 8, 1e-8);
        scene *s = f.s;
        const int y = SCENE_PROGRAM(s, scene_m(f.y), scene_k(s, 1e-15), scene_op(PM_OP_SUB), scene_k(s, side),
                                    scene_op(PM_OP_MUL));
        const int zero = scene_when(s, PM_TRIGGER_CROSS, y), zeros = scene_ask_count(s, zero);
        const int back = scene_when(s, side > 0 ? PM_TRIGGER_FALL : PM_TRIGGER_RISE, y),
                  backs = scene_ask_count(s, back);
        const int every = scene_when(s, PM_TRIGGER_EVERY, scene_read(s, f.x)),
                  multiples = scene_ask_count(s, every);
        const int t = scene_ask_event(s, scene_read(s, scene_time(s)), zero, 1, 0);
        scene_until_time(s, 1.7);
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[zeros], 1);
        EQUAL(s->out[backs], 1);
        NEAR(s->out[t], 16 / G, 1e-9);
        EQUAL(s->out[multiples], 5);
        scene_free(s);
    }
}

/* Bounces die out after t1 (1 + e) / (1 - e): each flight is found, down to the last; away from the origin,
 * too, where the last flights are lost in rounding. */
static void bounces_to_rest(void)
{
    const double e = 0.6, h = 1.25, t1 = sqrt(2 * h / G);
    for (double away = 0; away < 6000; away += 5000) {
        scene *s = scene_by(PM_ROUTE_IDA, 1e-10);
        const int b = scene_body(s, 0.7, 0, away, away, 0), point = scene_point(s, b, 0, 0);
        const int line = scene_line(s, scene_point(s, PM_GROUND, away, away - h), 0);
        const int c =
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, point, 0), line, 0, e, PM_FRICTION_SMOOTH, 0);
        const int strike = scene_on(s, PM_TRIGGER_STRIKE, c), time = scene_read(s, scene_time(s));
        const int t = scene_ask_end(s, time),
                  each = scene_ask(s, PM_ASK_EACH, time, strike, 1, 0, PM_NONE, PM_NONE, 10);
        scene_until(s, scene_on(s, PM_TRIGGER_REST, b), 1);
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[t], t1 * (1 + e) / (1 - e), away > 0 ? 1e-4 : 1e-6);
        double strikes = t1;
        for (int i = 0; i < 10; i++) {
            NEAR(s->out[each + i], strikes, away > 0 ? 1e-7 : 1e-9);
            strikes += 2 * t1 * pow(e, i + 1);
        }
        CHECK(s->count[PM_COUNT_EVENTS] < 60);
        scene_free(s);
    }
}

/* Rebounds far below the tolerance of positions, beside a fast body a long way off that gives the scene its size and speed: the
 * first bounce ends in its time all the same, and in the middle of the second the mark is on top. */
static void low_bounces(double accuracy)
{
    const double v = 1e-4, e = 0.5, flight_time = 2 * v / G;
    scene *s = scene_by(PM_ROUTE_IDA, accuracy);
    const int b = scene_body(s, 0.7, 0, 0, 0, 0), far_one = scene_body(s, 1, 0, 0, 50, 0),
              mark = scene_point(s, b, 0, 0);
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, mark, 0), scene_floor(s, 0), 0, e,
                                PM_FRICTION_SMOOTH, 0);
    scene_start_velocity(s, mark, 0, v);
    scene_start_velocity(s, scene_point(s, far_one, 0, 0), 1, 0);
    const int strikes = scene_ask_count(s, scene_on(s, PM_TRIGGER_STRIKE, c)),
              speed = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, mark, PM_PART_Y));
    scene_until_time(s, (1 + 0.5 * e) * flight_time);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[strikes], 1);
    NEAR(s->out[speed], 0, 0.1 * v);
    scene_free(s);
}

/* ---- failures, sameness ---- */
/* A force whose program has no value from the start on, or from an instant that no step can pass. */
static void fails_with_a_number(void)
{
    const double end[] = {0, 0.5};
    for (int i = 0; i < 2; i++) {
        flight f = thrown(0, 0, 1e-8);
        scene *s = f.s;
        const int push = SCENE_PROGRAM(s, scene_k(s, end[i]), scene_m(scene_time(s)), scene_op(PM_OP_SUB),
                                       scene_op(PM_OP_SQRT));
        scene_applied(s, f.point, PM_GROUND, push, push);
        scene_ask_measure(s, f.x);
        scene_until_time(s, 1);
        EQUAL(scene_run(s, NULL), i == 0 ? PM_SOLVER : PM_STEP_TOO_SMALL);
        if (i == 0) CHECK(s->detail[PM_DETAIL_VALUE] < 0); /* IDA's code */
        NEAR(s->detail[PM_DETAIL_TIME], end[i], 1e-9);
        CHECK(isnan(s->out[0]));
        scene_free(s);
    }
}

/* Where a force has no value, neither has the residual: IDA is told, and tries a smaller step. */
static void residual_without_a_value(void)
{
    flight f = thrown(1, 0, 1e-8);
    scene *s = f.s;
    const int push =
        SCENE_PROGRAM(s, scene_k(s, 0.5), scene_m(f.x), scene_op(PM_OP_SUB), scene_op(PM_OP_SQRT));
    scene_applied(s, f.point, PM_GROUND, push, push);
    scene_until_time(s, 0.1);
    EQUAL(scene_open(s), PM_OK);
    pm_workspace *w = s->w;
    EQUAL(pm_run(w, NULL), PM_OK);
    double y[20] = {0}, yp[20] = {0}, r[20];
    CHECK(w->ida->n <= 20);
    EQUAL(pm_ida_system_residual(w, 0, y, yp, r), 1);
    y[0] = 0.6; /* x, beyond where the force ends */
    EQUAL(pm_ida_system_residual(w, 0, y, yp, r), 0);
    scene_free(s);
}

/* Cases in any order and over any threads give the same bits: nothing is left over from the case before. */
static void same_bits(void)
{
    enum { CASES = 12 };
    flight f = thrown(2, 5, 1e-6);
    scene *s = f.s;
    const int line = scene_line(s, scene_point(s, PM_GROUND, 0, -1), 0), g = scene_parameter(s);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, f.point, 0), line, 0, 0.5, PM_FRICTION_COULOMB, 0.2);
    *scene_setting(s, PM_SETTING_GRAVITY_Y) = g;
    scene_ask_measure(s, f.x);
    scene_until_time(s, 3);
    scene_pack(s);
    double param[2][CASES], out[2][CASES], detail[CASES * PM_DETAIL_COLUMNS], audit[CASES * PM_AUDITS];
    double found[CASES * PM_FOUND_COLUMNS];
    double error[CASES], margin[CASES], trust[CASES * PM_TRUSTS];
    int32_t reason[CASES], status[CASES], where[CASES * PM_WHERE_COLUMNS], stop = 0;
    int64_t progress = 0, count[CASES * PM_COUNT_COLUMNS];
    for (int i = 0; i < CASES; i++) param[0][i] = param[1][CASES - 1 - i] = -9 - 0.3 * i;
    for (int run = 0; run < 2; run++) {
        EQUAL(pm_batch(s->ntable, s->table, s->nconstant, s->constant, CASES, 1, param[run], run + 1, &stop,
                       &progress, 1, out[run], 1, reason, status, where, detail, audit, count, found, error,
                       margin, trust),
              PM_OK);
        for (int i = 0; i < CASES; i++) EQUAL(status[i], PM_OK);
    }
    for (int i = 0; i < CASES; i++) EQUAL(out[0][i], out[1][CASES - 1 - i]);
    scene_free(s);
}

int main(void)
{
    grazes();
    held_zeros();
    bounces_to_rest();
    for (double accuracy = 1e-4; accuracy > 5e-7; accuracy *= 0.1) low_bounces(accuracy);
    fails_with_a_number();
    residual_without_a_value();
    same_bits();
    return check_failures();
}
