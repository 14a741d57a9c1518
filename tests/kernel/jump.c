/* Jumps: triggers that a blow, a closing or a change of mode carries off zero, to zero or across it, on every route that goes
 * on in time; what rests on zero and leaves it; what waits for counts; what fires without end. */
#include "check.h"
#include "scene.h"

#define G 9.81

static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
static const double close[] = {1e-11, 1e-11, 1e-7};

/* A particle over a floor, and two asks of each of up to four events. */
typedef struct watch {
    scene *s;
    int body, point, contact, hit;
    int event[6], count[6], first[6], n;
} watch;

static watch particle(int route, double height, double e, double mu)
{
    watch x = {.s = scene_create()};
    x.body = scene_body(x.s, 1, 0, 0, height, 0);
    x.point = scene_point(x.s, x.body, 0, 0);
    x.contact = scene_contact(x.s, PM_CONTACT_LINE, scene_circle(x.s, x.point, 0), scene_floor(x.s, 0), 0, e,
                              mu > 0 ? PM_FRICTION_COULOMB : PM_FRICTION_SMOOTH, mu);
    x.hit = scene_on(x.s, PM_TRIGGER_STRIKE, x.contact);
    *scene_setting(x.s, PM_SETTING_ROUTE) = routes[route];
    return x;
}

/* Its number among the events that are watched. */
static int watched(watch *x, int kind, int program)
{
    scene *s = x->s;
    const int i = x->n++, event = x->event[i] = scene_when(s, kind, program);
    x->count[i] = scene_ask_count(s, event);
    x->first[i] = scene_ask_event(s, scene_read(s, scene_time(s)), event, 1, 0);
    return i;
}

static void fires(const watch *x, int i, double count, double first, double tolerance)
{
    EQUAL(x->s->out[x->count[i]], count);
    if (count > 0)
        NEAR(x->s->out[x->first[i]], first, tolerance);
    else
        CHECK(isnan(x->s->out[x->first[i]]));
}

/* It falls and stays: what pushes, closes, and the speed that ends on zero. */
static void strikes_and_stays(int route)
{
    watch x = particle(route, 1, 0, 0);
    scene *s = x.s;
    const int normal = scene_measure(s, PM_MEASURE_CONTACT_NORMAL, x.contact),
              closed = scene_measure(s, PM_MEASURE_CONTACT_CLOSED, x.contact),
              vy = scene_part(s, PM_MEASURE_VELOCITY, x.point, PM_PART_Y);
    const int pushes = watched(&x, PM_TRIGGER_RISE, scene_read(s, normal)),
              equals = watched(&x, PM_TRIGGER_CROSS, scene_minus(s, closed, 1)),
              beyond = watched(&x, PM_TRIGGER_RISE, scene_minus(s, closed, 1)),
              stops = watched(&x, PM_TRIGGER_CROSS, scene_read(s, vy)),
              rises = watched(&x, PM_TRIGGER_RISE, scene_read(s, vy)),
              falls = watched(&x, PM_TRIGGER_FALL,
                              SCENE_PROGRAM(s, scene_m(normal), scene_k(s, -1), scene_op(PM_OP_MUL)));
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double t = sqrt(2 / G);
    fires(&x, pushes, 1, t, close[route]);
    fires(&x, falls, 1, t, close[route]);
    fires(&x, equals, 1, t, close[route]);
    fires(&x, stops, 1, t, close[route]);
    fires(&x, beyond, 0, t, 0);
    fires(&x, rises, 0, t, 0);
    scene_free(s);
}

/* It lies on a rough floor: what holds from the start on has not become so.  A force grows until it slides: what has rested
 * on zero leaves it, to one side. */
static void slides_at_last(int route)
{
    watch x = particle(route, 0, 0, 0.2);
    scene *s = x.s;
    const int t = scene_time(s), vx = scene_part(s, PM_MEASURE_VELOCITY, x.point, PM_PART_X),
              normal = scene_measure(s, PM_MEASURE_CONTACT_NORMAL, x.contact);
    scene_applied(s, x.point, PM_GROUND, SCENE_PROGRAM(s, scene_m(t), scene_k(s, 4), scene_op(PM_OP_MUL)),
                  scene_program(s, 1, &(scene_code){PM_OP_VALUE, scene_value(s, 0)}));
    const int forward = watched(&x, PM_TRIGGER_RISE, scene_read(s, vx)),
              backward = watched(&x, PM_TRIGGER_FALL, scene_read(s, vx)),
              pushes = watched(&x, PM_TRIGGER_RISE, scene_minus(s, normal, 5));
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    fires(&x, forward, 1, 0.2 * G / 4, close[route]);
    fires(&x, backward, 0, 0, 0);
    fires(&x, pushes, 0, 0, 0);
    scene_free(s);
}

/* A blow at the start is a jump like any other. */
static void begins_with_a_blow(int route)
{
    watch x = particle(route, 0, 0.5, 0);
    scene *s = x.s;
    const int vy = scene_part(s, PM_MEASURE_VELOCITY, x.point, PM_PART_Y),
              rises = watched(&x, PM_TRIGGER_RISE, scene_read(s, vy));
    scene_start_velocity(s, x.point, 0, -2);
    scene_until_time(s, 0.05);
    EQUAL(scene_run(s, NULL), PM_OK);
    fires(&x, rises, 1, 0, 0);
    scene_free(s);
}

/* The second of these waits for the third blow, the third for the second. */
static void waits_for_counts(int route)
{
    watch x = particle(route, 1, 0.9, 0);
    scene *s = x.s;
    const int third =
        watched(&x, PM_TRIGGER_RISE, scene_minus(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, x.hit), 2));
    const int after = watched(&x, PM_TRIGGER_CROSS,
                              scene_minus(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, x.event[third]), 1));
    const int zero = SCENE_PROGRAM(s, scene_k(s, 0)), two = SCENE_PROGRAM(s, scene_k(s, 2));
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_IMPULSE, x.event[third], PM_NONE, x.point, two, zero);
    const int vx = scene_part(s, PM_MEASURE_VELOCITY, x.point, PM_PART_X),
              speed = scene_ask_event(s, scene_read(s, vx), x.event[after], 1, 0);
    scene_until_time(s, 2.2);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double t = sqrt(2 / G) * (1 + 2 * 0.9 + 2 * 0.81);
    fires(&x, third, 1, t, close[route]);
    fires(&x, after, 1, t, close[route]);
    NEAR(s->out[speed], 2, 1e-9);
    scene_free(s);
}

/* Of a series of rebounds without end: what each fires, and what only the fast ones do. */
static void fires_without_end(void)
{
    watch x = particle(0, 1, 0.5, 0);
    scene *s = x.s;
    const int vy = scene_part(s, PM_MEASURE_VELOCITY, x.point, PM_PART_Y),
              rises = watched(&x, PM_TRIGGER_RISE, scene_read(s, vy)),
              falls = watched(&x, PM_TRIGGER_FALL, scene_read(s, vy)),
              fast = watched(&x, PM_TRIGGER_RISE, scene_minus(s, vy, 1e-5));
    scene_until_time(s, 2);
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(isinf(s->out[x.count[rises]]) && isinf(s->out[x.count[falls]]));
    fires(&x, fast, floor(log2(sqrt(2 * G) / 1e-5)), sqrt(2 / G), 1e-11);
    scene_free(s);
}

/* It bounces without end: what waits for one of its blows fires once, whether that is computed or not. */
static void strikes_without_end(int route)
{
    watch x = particle(route, 1, 0.5, 0);
    scene *s = x.s;
    int nth[] = {0, 3, 1000000}, count[3];
    for (int i = 0; i < 3; i++) {
        const int event = scene_on(s, PM_TRIGGER_STRIKE, x.contact);
        s->cell[PM_TABLE_EVENT][event * PM_EVENT_COLUMNS + PM_EVENT_NTH] = nth[i];
        count[i] = scene_ask_count(s, event);
        if (i == 1) x.first[0] = scene_ask_event(s, scene_read(s, scene_time(s)), event, 1, 0);
    }
    scene_until_time(s, 2);
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(isinf(s->out[count[0]]));
    EQUAL(s->out[count[1]], 1);
    EQUAL(s->out[count[2]], 1);
    NEAR(s->out[x.first[0]], sqrt(2 / G) * (1 + 2 * 0.5 + 2 * 0.25), 1e-9);
    scene_free(s);
}

/* ---- what holds before a blow ---- */
/* A rod swings down to a wall below its pin, whose force drops in the blow. */
static scene *swings_to_wall(int route, int *strike, int *force)
{
    scene *s = scene_create();
    const int rod = scene_body(s, 1, 1.0 / 12, 0.5, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    const int end = scene_circle(s, scene_point(s, rod, 0.5, 0), 0.1);
    const int wall =
        scene_contact(s, PM_CONTACT_LINE, end, scene_floor(s, -2 * atan(1)), 0, 0.5, PM_FRICTION_SMOOTH, 0);
    *strike = scene_on(s, PM_TRIGGER_STRIKE, wall);
    *force = scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_Y);
    scene_start_omega(s, rod, 0);
    scene_until_time(s, 0.8);
    *scene_setting(s, PM_SETTING_ROUTE) = routes[route];
    return s;
}

/* Where the end touches, sin of the angle s: omega^2 = 3 g s/l, and the force upwards is m g (1 + 9 s^2)/4. */
static void force_before(int route)
{
    const double square = 0.99, force = G * (1 + 9 * square) / 4;
    int strike, of;
    scene *s = swings_to_wall(route, &strike, &of);
    const int before = scene_ask_event(s, scene_read(s, of), strike, 1, 1);
    if (scene_run(s, NULL) == PM_OK) NEAR(s->out[before], force, close[route] * force);
    EQUAL(s->status, PM_OK);
    scene_free(s);
    s = swings_to_wall(route, &strike, &of);
    const int drops = scene_when(s, PM_TRIGGER_FALL, scene_minus(s, of, force - 1e-3));
    const int never = scene_ask_count(s, scene_when(s, PM_TRIGGER_FALL, scene_minus(s, of, force + 1e-3)));
    const int at = scene_ask_event(s, scene_read(s, scene_time(s)), drops, 1, 0),
              hit = scene_ask_event(s, scene_read(s, scene_time(s)), strike, 1, 0);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[at], s->out[hit]);
    EQUAL(s->out[never], 0);
    scene_free(s);
}

int main(void)
{
    for (int route = 0; route < 3; route++) {
        strikes_without_end(route);
        strikes_and_stays(route);
        slides_at_last(route);
        begins_with_a_blow(route);
        waits_for_counts(route);
        force_before(route);
    }
    fires_without_end();
    return check_failures();
}
