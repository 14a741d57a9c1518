/* Events: every kind of trigger at its time, once; several at one instant; roots that touch; zeros that hold; limits. */
#include "check.h"
#include "scene.h"

#define G 9.81

/* A particle thrown from the origin. */
typedef struct flight {
    scene *s;
    int body, point, x, y, vx, vy, time;
} flight;

static flight thrown(double vx, double vy)
{
    flight t = {.s = scene_create()};
    t.body = scene_body(t.s, 0.7, 0, 0, 0, 0);
    t.point = scene_point(t.s, t.body, 0, 0);
    t.x = scene_part(t.s, PM_MEASURE_POSITION, t.point, PM_PART_X);
    t.y = scene_part(t.s, PM_MEASURE_POSITION, t.point, PM_PART_Y);
    t.vx = scene_part(t.s, PM_MEASURE_VELOCITY, t.point, PM_PART_X);
    t.vy = scene_part(t.s, PM_MEASURE_VELOCITY, t.point, PM_PART_Y);
    t.time = scene_time(t.s);
    scene_start(t.s, PM_START_VELOCITY, t.vx, vx);
    scene_start(t.s, PM_START_VELOCITY, t.vy, vy);
    return t;
}

static int time_of(flight *t, int event, int nth)
{
    return scene_ask_event(t->s, scene_read(t->s, t->time), event, nth, 0);
}

static void cross_rise_fall(void)
{
    flight t = thrown(3, 8);
    scene *s = t.s;
    const double h = 2, up = (8 - sqrt(64 - 2 * G * h)) / G, down = (8 + sqrt(64 - 2 * G * h)) / G;
    const int kinds[] = {PM_TRIGGER_CROSS, PM_TRIGGER_RISE, PM_TRIGGER_FALL};
    int event[3], count[3], first[3];
    for (int i = 0; i < 3; i++) {
        event[i] = scene_when(s, kinds[i], scene_minus(s, t.y, h));
        count[i] = scene_ask_count(s, event[i]);
        first[i] = time_of(&t, event[i], 1);
    }
    const int second = time_of(&t, event[0], 2),
              last = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_TIME, event[0]));
    const int each = scene_ask(s, PM_ASK_EACH, scene_read(s, t.x), event[0], 1, 0, PM_NONE, PM_NONE, 3);
    scene_until_time(s, 1.6);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[count[0]], 2);
    EQUAL(s->out[count[1]], 1);
    EQUAL(s->out[count[2]], 1);
    NEAR(s->out[first[0]], up, 1e-12);
    NEAR(s->out[first[1]], up, 1e-12);
    NEAR(s->out[first[2]], down, 1e-12);
    NEAR(s->out[second], down, 1e-12);
    NEAR(s->out[last], down, 1e-12);
    NEAR(s->out[each], 3 * up, 1e-11);
    NEAR(s->out[each + 1], 3 * down, 1e-11);
    CHECK(isnan(s->out[each + 2]));
    scene_free(s);
}

static void every(void)
{
    flight t = thrown(-3, 8); /* backwards through the multiples of 0.4 */
    scene *s = t.s;
    const int step =
        scene_when(s, PM_TRIGGER_EVERY, SCENE_PROGRAM(s, scene_m(t.x), scene_k(s, 0.4), scene_op(PM_OP_DIV)));
    const int each = scene_ask(s, PM_ASK_EACH, scene_read(s, t.x), step, 1, 0, PM_NONE, PM_NONE, 20),
              count = scene_ask_count(s, step);
    const int few = scene_ask(s, PM_ASK_EACH, scene_read(s, t.x), step, 1, 0, PM_NONE, PM_NONE, 5),
              as_many = scene_ask(s, PM_ASK_EACH, scene_read(s, t.x), step, 1, 0, PM_NONE, PM_NONE, 14);
    scene_until_time(s, 1.9);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[count], 14);
    for (int i = 0; i < 14; i++) NEAR(s->out[each + i], -0.4 * (i + 1), 1e-12);
    for (int i = 0; i < 5; i++) NEAR(s->out[few + i], -0.4 * (i + 1), 1e-12);
    NEAR(s->out[as_many + 13], -5.6, 1e-12);
    EQUAL(s->reason[0], PM_REASON_NONE);
    EQUAL(s->reason[2], PM_REASON_CUT);
    EQUAL(s->reason[3], PM_REASON_NONE);
    scene_free(s);
}

/* A height above the top by a billionth is not crossed, below it is crossed twice, at once. */
static void touches_a_height(void)
{
    for (int side = -1; side <= 1; side += 2) {
        flight t = thrown(1, 8);
        scene *s = t.s;
        const double top = 32 / G, dt = sqrt(2e-9 * top / G);
        const int event = scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, t.y, top * (1 + side * 1e-9)));
        const int count = scene_ask_count(s, event), first = time_of(&t, event, 1),
                  second = time_of(&t, event, 2);
        scene_until_time(s, 1.5);
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[count], side > 0 ? 0 : 2);
        if (side < 0) {
            NEAR(s->out[first], 8 / G - dt, 1e-9);
            NEAR(s->out[second], 8 / G + dt, 1e-9);
        } else {
            EQUAL(s->reason[1], PM_REASON_NOT_REACHED);
        }
        scene_free(s);
    }
}

/* A zero that holds at the start is no event; coming back to it is. */
static void held_zero(void)
{
    flight t = thrown(1, 8);
    scene *s = t.s;
    const int event = scene_when(s, PM_TRIGGER_CROSS, scene_read(s, t.y)), count = scene_ask_count(s, event),
              at = time_of(&t, event, 1);
    scene_until_time(s, 2);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[count], 1);
    NEAR(s->out[at], 16 / G, 1e-12);
    scene_free(s);
}

/* Three triggers at one instant, two of one event, are one instant: each event counts once. */
static void at_one_instant(void)
{
    flight t = thrown(2, 8);
    scene *s = t.s;
    const double top = 8 / G;
    const int a = scene_when(s, PM_TRIGGER_FALL, scene_read(s, t.vy)),
              b = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, t.x, 2 * top));
    scene_trigger(s, PM_TRIGGER_RISE, a, scene_minus(s, t.time, top), PM_NONE);
    const int ca = scene_ask_count(s, a), cb = scene_ask_count(s, b), at = time_of(&t, b, 1);
    scene_until_time(s, 1.3);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[ca], 1);
    EQUAL(s->out[cb], 1);
    NEAR(s->out[at], top, 1e-12);
    EQUAL(s->count[PM_COUNT_EVENTS], 3); /* the start, the top, the end */
    scene_free(s);
}

/* A ball that bounces: strike and open, the state before and after; a speed carried through zero by the blow. */
static void bounces(void)
{
    const double e = 0.7, h = 1.5, t1 = sqrt(2 * h / G);
    flight t = thrown(0, 0);
    scene *s = t.s;
    const int line = scene_line(s, scene_point(s, PM_GROUND, 0, -h), 0);
    const int c =
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, t.point, 0), line, 0, e, PM_FRICTION_SMOOTH, 0);
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, c),
              turn = scene_when(s, PM_TRIGGER_RISE, scene_read(s, t.vy));
    const int before = scene_ask_event(s, scene_read(s, t.vy), strike, 1, 1),
              after = scene_ask_event(s, scene_read(s, t.vy), strike, 1, 0);
    const int lost =
        scene_ask_event(s, scene_read(s, scene_measure(s, PM_MEASURE_LOST, PM_NONE)), strike, 1, 0);
    const int impulse = scene_ask_event(
        s, scene_read(s, scene_part(s, PM_MEASURE_CONTACT_IMPULSE, c, PM_PART_Y)), strike, 2, 0);
    const int count = scene_ask_count(s, strike), turns = scene_ask_count(s, turn);
    const int third = time_of(&t, strike, 3);
    scene_until(s, strike, 4);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[before], -G * t1, 1e-12);
    NEAR(s->out[after], e * G * t1, 1e-12);
    NEAR(s->out[lost], 0.35 * (1 - e * e) * G * t1 * G * t1, 1e-11);
    NEAR(s->out[impulse], 0.7 * (1 + e) * e * G * t1, 1e-11);
    NEAR(s->out[third], t1 * (1 + 2 * e + 2 * e * e), 1e-11);
    EQUAL(s->out[count], 4);
    EQUAL(s->out[turns], 4);
    scene_free(s);
}

/* Accumulating bounces end in finite time t1 (1 + e) / (1 - e), at rest. */
static void comes_to_rest(void)
{
    const double e = 0.5, h = 1, t1 = sqrt(2 * h / G);
    flight t = thrown(0, 0);
    scene *s = t.s;
    const int line = scene_line(s, scene_point(s, PM_GROUND, 0, -h), 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, t.point, 0), line, 0, e, PM_FRICTION_SMOOTH, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_REST, t.body), 1);
    const int at = scene_ask_measure(s, t.time), y = scene_ask_measure(s, t.y);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[at], t1 * (1 + e) / (1 - e), 1e-6);
    NEAR(s->out[y], -h, 1e-9);
    scene_free(s);
}

/* A particle that a spring of rate 100/s^2 draws to `behind` a floor, let go 0.1 m above it: flights of 2/w atan(v / (w behind)).
 * Where nothing presses it on it bounces without end, and its blows are no longer counted.  What is told is right. */
static void bounces_about_its_equilibrium(double e, double behind)
{
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    scene_set(s, PM_SETTING_ACCURACY, 1e-8);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_RK;
    *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
    const int b = scene_body(s, 1, 0, 0, 0.1, 0), p = scene_point(s, b, 0, 0);
    scene_force(s, PM_FORCE_SPRING, p, scene_point(s, PM_GROUND, 0, -behind), 100, 0);
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0), scene_floor(s, 0), 0, e,
                                PM_FRICTION_SMOOTH, 0);
    const int count = scene_ask_count(s, scene_on(s, PM_TRIGGER_STRIKE, c));
    const int at = scene_ask_measure(s, scene_time(s));
    scene_until(s, scene_on(s, PM_TRIGGER_REST, b), 1);
    const double v = 10 * sqrt(0.01 + 0.2 * behind);
    double t = 0.1 * acos(behind / (0.1 + behind));
    for (double u = e * v; behind > 0 && u > 1e-20; u *= e) t += 0.2 * atan(u / (10 * behind));
    const int status = scene_run(s, NULL);
    if (behind == 0) {
        EQUAL(status, PM_BOUNCES_ON);
        CHECK(isnan(s->out[at]) && isnan(s->out[count]));
    } else {
        EQUAL(status, PM_OK);
        NEAR(s->out[at], t, 4 * s->error[at] + 1e-9);
        CHECK(isinf(s->out[count]) && s->error[at] < 0.05);
    }
    scene_free(s);
}

/* The same, drawn to the floor itself, moves along it to a wall.  One that leans over it presses it on: there it stays.  Beside an
 * upright one it bounces on. */
static void bounces_until_it_is_pressed(double leans)
{
    flight t = thrown(0.02, 0);
    scene *s = t.s;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_RK;
    *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
    const int floor = scene_line(s, scene_point(s, PM_GROUND, 0, -0.1), 0),
              wall = scene_line(s, scene_point(s, PM_GROUND, 0.2, -0.1), M_PI_2 + leans),
              rim = scene_circle(s, t.point, 0);
    scene_contact(s, PM_CONTACT_LINE, rim, floor, 0, 0.2, PM_FRICTION_SMOOTH, 0);
    scene_contact(s, PM_CONTACT_LINE, rim, wall, 0, 0, PM_FRICTION_SMOOTH, 0);
    scene_applied(s, t.point, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, 0)),
                  SCENE_PROGRAM(s, scene_k(s, -100), scene_m(t.y), scene_k(s, 0.1), scene_op(PM_OP_ADD),
                                scene_op(PM_OP_MUL)));
    scene_until(s, scene_on(s, PM_TRIGGER_REST, t.body), 1);
    const int at = scene_ask_measure(s, t.time), status = scene_run(s, NULL);
    EQUAL(status, leans > 0 ? PM_OK : PM_BOUNCES_ON);
    if (leans > 0) NEAR(s->out[at], 10, 1e-8);
    scene_free(s);
}

static void start_event(void)
{
    flight t = thrown(2, 8);
    scene *s = t.s;
    const int begin = scene_on(s, PM_TRIGGER_START, PM_NONE),
              v = scene_ask_event(s, scene_read(s, t.vx), begin, 1, 0);
    scene_until(s, begin, 1);
    EQUAL(scene_run(s, NULL), PM_NO_TIME_ROUTE);
    EQUAL(s->out[v], 2);
    EQUAL(s->count[PM_COUNT_STEPS], 0);
    scene_free(s);
}

/* A condition on time that is met at the start fires there, on its own side of zero, and not again. */
static void due_at_the_start(void)
{
    static const int kind[] = {PM_TRIGGER_CROSS, PM_TRIGGER_RISE, PM_TRIGGER_FALL};
    static const int route[] = {PM_ROUTE_AUTO, PM_ROUTE_RK};
    for (int r = 0; r < 2; r++) {
        flight t = thrown(2, 8);
        scene *s = t.s;
        *scene_setting(s, PM_SETTING_ROUTE) = route[r];
        int fired[3];
        for (int i = 0; i < 3; i++)
            fired[i] = scene_ask_count(s, scene_when(s, kind[i], scene_minus(s, t.time, 0)));
        scene_until_time(s, 1);
        EQUAL(scene_run(s, NULL), PM_OK);
        for (int i = 0; i < 3; i++) EQUAL(s->out[fired[i]], kind[i] != PM_TRIGGER_FALL);
        scene_free(s);
    }
    flight t = thrown(2, 8);
    scene_until(t.s, scene_when(t.s, PM_TRIGGER_CROSS, scene_minus(t.s, t.time, 0)), 1);
    EQUAL(scene_run(t.s, NULL), PM_NO_TIME_ROUTE);
    EQUAL(t.s->count[PM_COUNT_STEPS], 0);
    scene_free(t.s);
}

/* The run ends when all events of one group have fired. */
static void groups(void)
{
    flight t = thrown(2, 8);
    scene *s = t.s;
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, t.x, 1)), 1);
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, t.x, 2)), 1);
    SCENE_ROW(s, PM_TABLE_UNTIL, 1, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, t.x, 2.6)), 1);
    const int x = scene_ask_measure(s, t.x);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[x], 2, 1e-12);
    scene_free(s);
}

static void limits(void)
{
    for (int i = 0; i < 4; i++) {
        flight t = thrown(2, 8);
        scene *s = t.s;
        const int never = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, t.y, 100)),
                  x1 = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, t.x, 0.5));
        scene_until(s, never, 1);
        const int end = scene_ask_measure(s, t.x),
                  reached = scene_ask_event(s, scene_read(s, t.time), x1, 1, 0);
        if (i == 0) scene_set(s, PM_SETTING_MAX_TIME, 3);
        if (i == 1) *scene_setting(s, PM_SETTING_MAX_EVENTS) = 3;
        if (i == 2) *scene_setting(s, PM_SETTING_MAX_STEPS) = 5;
        if (i == 1) { /* events that nobody needs are none */
            const int every = scene_when(s, PM_TRIGGER_EVERY, scene_read(s, t.x));
            scene_ask_count(s, every);
        }
        if (i == 3) { /* caught by a plastic floor: nothing moves any more */
            const int line = scene_line(s, scene_point(s, PM_GROUND, 0, -1), 0);
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, t.point, 0), line, 0, 0, PM_FRICTION_ROUGH, 0);
        }
        const int expected[] = {PM_LIMIT_TIME, PM_LIMIT_EVENTS, PM_LIMIT_STEPS, PM_STAYS_AT_REST};
        EQUAL(scene_run(s, NULL), expected[i]);
        CHECK(isnan(s->out[end])); /* the end did not come; what was answered stands */
        EQUAL(s->reason[0], PM_REASON_NOT_REACHED);
        if (i != 2) NEAR(s->out[reached], 0.25, 1e-12);
        if (i == 0) NEAR(s->detail[PM_DETAIL_TIME], 3, 0);
        if (i == 2) EQUAL(s->count[PM_COUNT_STEPS], 5);
        CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9);
        scene_free(s);
    }
}

int main(void)
{
    cross_rise_fall();
    every();
    touches_a_height();
    held_zero();
    at_one_instant();
    bounces();
    comes_to_rest();
    for (double e = 0.06; e < 0.9; e += 0.2) {
        bounces_about_its_equilibrium(e, 0);
        for (double behind = 3e-6; behind < 1; behind *= 10) bounces_about_its_equilibrium(e, behind);
    }
    bounces_until_it_is_pressed(0);
    bounces_until_it_is_pressed(0.3);
    start_event();
    due_at_the_start();
    groups();
    limits();
    return check_failures();
}
