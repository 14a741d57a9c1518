/* Segments that repeat: hundreds of bars against the closed form, and against the same run with every segment computed. */
#include "check.h"
#include "scene.h"

#define G 9.81

enum { MOST = 40 };

/* A sphere that rolls on a row of bars, down to the right where slope > 0; it starts over a bar. */
typedef struct bars {
    scene *s;
    int body, g, contact, strike;
    double r, d, lean, slope;
} bars;

static bars make_bars(double r, double d, double slope, double omega)
{
    bars x = {.s = scene_create(), .r = r, .d = d, .lean = asin(0.5 * d / r), .slope = slope};
    scene *s = x.s;
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    *scene_setting(s, PM_SETTING_MAX_EVENTS) = 2000000;
    *scene_setting(s, PM_SETTING_MAX_TIME) = PM_NONE; /* nobody asks for the time */
    const double c = cos(slope), n = sin(slope);
    x.body = scene_body(s, 1, 0.4 * r * r, r * n, r * c, 0);
    const int row = SCENE_ROW(s, PM_TABLE_PATTERN, scene_point(s, PM_GROUND, 0, 0), scene_value(s, d * c),
                              scene_value(s, -d * n), scene_value(s, -1));
    x.g = scene_point(s, x.body, 0, 0);
    x.contact =
        scene_contact(s, PM_CONTACT_PATTERN, scene_circle(s, x.g, r), row, 0, 0, PM_FRICTION_ROUGH, 0);
    x.strike = scene_on(s, PM_TRIGGER_STRIKE, x.contact);
    scene_start_omega(s, x.body, -omega);
    return x;
}

/* T per unit of (7/5) m r^2 / 2: w^2.  Over a bar and down to the next: w^2 + gain; in the blow a plastic one keeps
 * 1 - (5/7) (1 - cos 2 lean) = k of the rate; the top of a bar costs `hill`. */
static void against_recursion(void)
{
    static const double slopes[] = {0, 0.01, -0.002, 0.02};
    for (int i = 0; i < 4; i++) {
        const double r = 0.25, d = 0.02, slope = slopes[i], start = i == 3 ? 1 : 6;
        bars x = make_bars(r, d, slope, start);
        scene *s = x.s;
        const int every = 150;
        const int count = scene_ask_count(s, x.strike);
        const int omega = scene_measure(s, PM_MEASURE_OMEGA, x.body);
        const int at[] = {scene_ask_event(s, scene_read(s, omega), x.strike, 57, 0),
                          scene_ask_event(s, scene_read(s, omega), x.strike, 57, 1),
                          scene_ask_event(s, scene_read(s, omega), x.strike, every, 0)};
        const int last = scene_ask_measure(s, omega);
        const int least = scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, omega), PM_NONE);
        const int moved = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, x.g, PM_PART_X));
        scene_until(s, x.strike, every);
        /* or it rolls back */
        SCENE_ROW(s, PM_TABLE_UNTIL, 1, scene_when(s, PM_TRIGGER_CROSS, scene_read(s, omega)), 1);
        EQUAL(scene_run(s, NULL), PM_OK);
        const double gain = 10 / 7. * G / (r * r) * d * sin(slope);
        const double top =
            10 / 7. * G / r * (1 - cos(x.lean - slope)); /* from the begin of a segment to its top */
        const double k = 1 - 5 / 7. * (1 - cos(2 * x.lean));
        /* the first segment begins over its bar, gone by lean: as if it had begun there with */
        double square = start * start + 10 / 7. * G / r * (cos(slope) - cos(x.lean - slope)), before = 0,
               slowest = start * start;
        slowest -= slope < 0 ? 10 / 7. * G / r * (1 - cos(slope)) : 0;
        int n = 0;
        while (n < every && square > top) {
            if (n > 0) slowest = fmin(slowest, square - (slope < x.lean ? top : 0));
            before = square + gain;
            square = k * k * before;
            n++;
            if (n == 57) {
                NEAR(s->out[at[0]], -sqrt(square), 1e-10);
                NEAR(s->out[at[1]], -sqrt(before), 1e-10);
            }
        }
        EQUAL(s->out[count], n);
        if (n == every) {
            NEAR(s->out[at[2]], -sqrt(square), 1e-10);
            NEAR(s->out[last], -sqrt(square), 1e-10);
            NEAR(s->out[least], -sqrt(fmin(slowest, square)), 1e-10);
            NEAR(s->out[moved], (every - 0.5) * d * cos(slope) + r * cos(x.lean) * sin(slope), 1e-9);
            CHECK(s->count[PM_COUNT_REPEATED_SEGMENTS] > every / 2);
        } else {
            CHECK(n > 5);
            NEAR(s->out[last], 0, 1e-7);
            CHECK(s->count[PM_COUNT_REPEATED_SEGMENTS] > 0);
        }
        EQUAL(s->count[PM_COUNT_JUMPS], n);
        CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-12);
        scene_free(s);
    }
}

/* ---- the same run with every segment computed ---- */
/* A program that reads the time keeps an uneven run from passing segments over. */
static void compute_every_leg(scene *s) { scene_set(s, PM_SETTING_MAX_TIME, 1e6); }

typedef void asker(bars *x);

/* Runs the scene with and without segments passed over, and compares every answer. */
static void compare(double r, double d, double slope, double omega, asker *ask, int64_t fewest,
                    const char *name)
{
    bars x[2];
    const int before = check_count;
    for (int i = 0; i < 2; i++) {
        x[i] = make_bars(r, d, slope, omega);
        ask(&x[i]);
        if (i) compute_every_leg(x[i].s);
        scene_run(x[i].s, NULL);
    }
    const scene *a = x[0].s, *b = x[1].s;
    EQUAL(a->status, b->status);
    for (int i = 0; i < a->nout; i++) NEAR(a->out[i], b->out[i], 1e-11 * (1 + fabs(b->out[i])));
    for (int i = 0; i < a->rows[PM_TABLE_ASK]; i++) EQUAL(a->reason[i], b->reason[i]);
    CHECK(a->count[PM_COUNT_REPEATED_SEGMENTS] >= fewest);
    EQUAL(b->count[PM_COUNT_REPEATED_SEGMENTS], 0);
    EQUAL(a->count[PM_COUNT_EVENTS], b->count[PM_COUNT_EVENTS]);
    EQUAL(a->count[PM_COUNT_JUMPS], b->count[PM_COUNT_JUMPS]);
    if (fewest > 0) CHECK(a->count[PM_COUNT_STEPS] < b->count[PM_COUNT_STEPS]);
    if (check_count > before) fprintf(stderr, "in %s\n", name);
    for (int i = 0; i < 2; i++) scene_free(x[i].s);
}

static int omega_of(bars *x) { return scene_measure(x->s, PM_MEASURE_OMEGA, x->body); }

static int place_of(bars *x) { return scene_part(x->s, PM_MEASURE_POSITION, x->g, PM_PART_X); }

static int count_of(bars *x, int event)
{
    return scene_ask_measure(x->s, scene_measure(x->s, PM_MEASURE_EVENT_COUNT, event));
}

static int height_of(bars *x) { return scene_part(x->s, PM_MEASURE_POSITION, x->g, PM_PART_Y); }

/* What the sphere is at the end, and extremes of all kinds. */
static void ask_state(bars *x)
{
    scene *s = x->s;
    scene_ask_measure(s, omega_of(x));
    scene_ask_measure(s, place_of(x));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, x->body));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_PATH, x->g));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_LOST, PM_NONE));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_CONTACT_IMPULSE, x->contact, PM_PART_NORM));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_KINETIC, PM_NONE));
    count_of(x, x->strike);
}

static void ask_extremes(bars *x)
{
    scene *s = x->s;
    const int kinds[] = {PM_ASK_MAX, PM_ASK_MIN};
    for (int k = 0; k < 2; k++) {
        scene_ask_extreme(s, kinds[k], scene_read(s, omega_of(x)), PM_NONE);
        scene_ask_extreme(s, kinds[k], scene_read(s, height_of(x)), PM_NONE);
        scene_ask_extreme(s, kinds[k], scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, x->contact)),
                          PM_NONE);
        scene_ask_extreme(s, kinds[k], scene_read(s, scene_measure(s, PM_MEASURE_ALPHA, x->body)), PM_NONE);
        /* what moves on and what slows down: its extreme may lie anywhere */
        scene_ask_extreme(s, kinds[k],
                          SCENE_PROGRAM(s, scene_m(omega_of(x)), scene_k(s, 0.7), scene_op(PM_OP_MUL),
                                        scene_m(place_of(x)), scene_op(PM_OP_ADD)),
                          PM_NONE);
    }
}

static void extremes_only(bars *x)
{
    scene *s = x->s;
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, omega_of(x)), PM_NONE);
    scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, x->contact)),
                      PM_NONE);
    scene_ask_extreme(s, PM_ASK_MAX,
                      scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_FRICTION_NEEDED, x->contact)),
                      PM_NONE);
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, place_of(x)), PM_NONE);
}

static void hundred_strikes(bars *x)
{
    ask_state(x);
    extremes_only(x);
    scene_until(x->s, x->strike, 100);
}

static void hundred_strikes_all_extremes(bars *x)
{
    ask_state(x);
    ask_extremes(x);
    scene_until(x->s, x->strike, 100);
}

static void lists(bars *x)
{
    ask_state(x);
    scene_ask(x->s, PM_ASK_EACH, scene_read(x->s, omega_of(x)), x->strike, 1, 0, PM_NONE, PM_NONE, 12);
    scene_ask_event(x->s, scene_read(x->s, omega_of(x)), x->strike, 57, 1);
    scene_ask_event(x->s, scene_read(x->s, place_of(x)), x->strike, 58, 0);
    scene_until(x->s, x->strike, 80);
}

static void grid(bars *x)
{
    scene *s = x->s;
    const int first = scene_value(s, 0.135);
    scene_value(s, 0.555);
    scene_value(s, 0.315);
    scene_ask(s, PM_ASK_GRID, scene_read(s, omega_of(x)), PM_NONE, 1, 0, scene_read(s, place_of(x)), first,
              3);
    ask_state(x);
    scene_until(s, x->strike, 80);
}

/* Ends in the middle of a segment, at a place: segments before it went further. */
static void until_place(bars *x)
{
    ask_state(x);
    extremes_only(x);
    scene_until(x->s, scene_when(x->s, PM_TRIGGER_RISE, scene_minus(x->s, place_of(x), 1.713)), 1);
}

/* Ends when the sphere's top of the 70th bar is passed: in the middle of a segment, by its count. */
static void until_tops(bars *x)
{
    scene *s = x->s;
    const int top = scene_when(s, PM_TRIGGER_EVERY,
                               SCENE_PROGRAM(s, scene_m(place_of(x)), scene_k(s, 0.003), scene_op(PM_OP_SUB),
                                             scene_k(s, x->d * cos(x->slope)), scene_op(PM_OP_DIV)));
    ask_state(x);
    extremes_only(x);
    scene_until(s, top, 70);
}

/* Slower than .. for the first time: between two blows, or in one. */
static void until_slow(bars *x)
{
    ask_state(x);
    scene_until(x->s, scene_when(x->s, PM_TRIGGER_RISE, scene_minus(x->s, omega_of(x), -5)), 1);
    SCENE_ROW(x->s, PM_TABLE_UNTIL, 1, x->strike, 300);
}

static void marks_of_speed(bars *x)
{
    scene *s = x->s;
    const int slow = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, omega_of(x), -5)),
              steps =
                  scene_when(s, PM_TRIGGER_EVERY,
                             SCENE_PROGRAM(s, scene_m(omega_of(x)), scene_k(s, 0.25), scene_op(PM_OP_DIV))),
              rises = scene_when(s, PM_TRIGGER_CROSS,
                                 scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, x->g, PM_PART_Y))),
              light = scene_when(s, PM_TRIGGER_CROSS,
                                 scene_minus(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, x->contact), 3));
    ask_state(x);
    count_of(x, slow);
    count_of(x, steps);
    count_of(x, rises);
    count_of(x, light);
    scene_ask_event(s, scene_read(s, place_of(x)), slow, 1, 0);
    scene_ask_event(s, scene_read(s, place_of(x)), light, 3, 0);
    scene_until(s, x->strike, 200);
}

/* To the first time that a bar lets go between two blows: found by halving, wherever it is. */
static void until_lift(bars *x)
{
    scene *s = x->s;
    const int lifts = scene_when(
        s, PM_TRIGGER_FALL, scene_minus(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, x->contact), 0.5));
    ask_state(x);
    count_of(x, scene_on(s, PM_TRIGGER_OPEN, x->contact));
    scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, omega_of(x)), PM_NONE);
    scene_until(s, lifts, 1);
}

static void few_events(bars *x)
{
    *scene_setting(x->s, PM_SETTING_MAX_EVENTS) = 60;
    hundred_strikes(x);
}

static void until_stop(bars *x)
{
    ask_state(x);
    scene_until(x->s, scene_when(x->s, PM_TRIGGER_CROSS, scene_read(x->s, omega_of(x))), 1);
}

/* Triggers that the last segment over the barrier may be the first to set off. */
static void until_stop_with_marks(bars *x)
{
    scene *s = x->s;
    static const double slow[] = {0.1, 0.2, 0.3, 0.5, 0.8, 1.2};
    for (int i = 0; i < 6; i++)
        count_of(x, scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, omega_of(x), -slow[i])));
    scene_ask_measure(s, place_of(x));
    scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_read(s, omega_of(x))), 1);
}

static void against_computed(void)
{
    compare(0.25, 0.02, 0, 6, hundred_strikes, 80, "a hundred strikes");
    compare(0.25, 0.02, 0.02, 1, hundred_strikes, 60, "a hundred strikes, faster and faster");
    compare(0.25, 0.02, 0, 6, hundred_strikes_all_extremes, 0, "a hundred strikes, all extremes");
    compare(0.25, 0.02, 0.002, 6, hundred_strikes_all_extremes, 0, "all extremes downhill");
    compare(0.25, 0.02, 0, 6, lists, 40, "lists");
    compare(0.25, 0.02, 0, 6, grid, 20, "grid");
    compare(0.25, 0.02, 0, 6, until_place, 50, "until a place");
    compare(0.25, 0.02, 0, 6, until_tops, 50, "until the tops");
    compare(0.25, 0.02, 0, 6, until_slow, 10, "until it is slow");
    compare(0.25, 0.02, 0.02, 2, until_slow, 10, "until it is slow, faster and faster");
    compare(0.25, 0.02, 0, 6, marks_of_speed, 0, "marks of speed");
    compare(0.25, 0.02, 0.018, 2, marks_of_speed, 0, "marks of speed, downhill");
    compare(0.25, 0.02, 0.06, 2, until_lift, 10, "until it lifts");
    compare(0.25, 0.02, 0.045, 1, until_lift, 10, "until it lifts late");
    compare(0.25, 0.02, 0, 6, few_events, 20, "few events");
    compare(0.25, 0.02, 0, 6, until_stop, 10, "until it stops");
    compare(0.25, 0.005, -0.001, 6, until_stop, 10, "until it stops uphill");
    for (int i = 0; i < 8; i++)
        compare(0.25, 0.05, 0, 1.5 + 0.1 * i, until_stop_with_marks, 0, "marks until it stops");
}

/* ---- the last segment over the barrier ---- */
/* What is greatest on a top: T and what goes with it are least there in the last segment that gets over it, but the one that
 * falls back does not come there. */
static void on_top(bars *x, int kind, int measure, double weight)
{
    scene *s = x->s;
    scene_ask_extreme(s, kind,
                      SCENE_PROGRAM(s, scene_m(measure), scene_m(height_of(x)), scene_k(s, weight),
                                    scene_op(PM_OP_MUL), scene_op(PM_OP_ADD)),
                      PM_NONE);
}

/* Told by the places of the segment before; computed, as the impulse of its blow is asked; with all others computed. */
static void last_over_barrier(double d, double slope, double omega, int estimated)
{
    enum { TOLD, ASKED, ALL, RUNS };
    bars x[RUNS];
    for (int i = 0; i < RUNS; i++) {
        x[i] = make_bars(0.25, d, slope, omega);
        scene *s = x[i].s;
        const int normal = scene_measure(s, PM_MEASURE_CONTACT_NORMAL, x[i].contact);
        on_top(&x[i], PM_ASK_MIN, scene_measure(s, PM_MEASURE_KINETIC, PM_NONE), -1e5);
        on_top(&x[i], PM_ASK_MAX, normal, 1e5);
        scene_ask_measure(s, place_of(&x[i]));
        scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, normal), PM_NONE);
        count_of(&x[i], x[i].strike);
        scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_read(s, omega_of(&x[i]))), 1);
        *scene_setting(s, PM_SETTING_ESTIMATE) = estimated;
        if (i == ASKED)
            scene_ask_measure(s, scene_part(s, PM_MEASURE_CONTACT_IMPULSE, x[i].contact, PM_PART_NORM));
        if (i == ALL) compute_every_leg(s);
        EQUAL(scene_run(s, NULL), PM_OK);
    }
    const scene *told = x[TOLD].s;
    for (int i = ASKED; i < RUNS; i++) {
        const scene *s = x[i].s;
        for (int k = 0; k < told->nout; k++) NEAR(told->out[k], s->out[k], 1e-13 * fabs(s->out[k]));
        EQUAL(told->count[PM_COUNT_JUMPS], s->count[PM_COUNT_JUMPS]);
        EQUAL(told->count[PM_COUNT_EVENTS], s->count[PM_COUNT_EVENTS]);
    }
    EQUAL(told->count[PM_COUNT_REPEATED_SEGMENTS], x[ASKED].s->count[PM_COUNT_REPEATED_SEGMENTS] + 1);
    CHECK(told->count[PM_COUNT_STEPS] < x[ASKED].s->count[PM_COUNT_STEPS]);
    CHECK(told->audit[PM_AUDIT_ENERGY] < 1e-12);
    for (int i = 0; i < RUNS; i++) scene_free(x[i].s);
}

int main(void)
{
    against_recursion();
    against_computed();
    for (int estimated = 0; estimated < 2; estimated++) {
        last_over_barrier(0.02, 0, 6, estimated);
        last_over_barrier(0.03, 0, 3, estimated);
        last_over_barrier(0.1, 0, 2.5, estimated); /* none is passed but the last */
    }
    return check_failures();
}
