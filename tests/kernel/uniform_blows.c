/* Bounces with constant accelerations: infinitely many blows in finite work, the tops between them. */
#include "uniform.h"

#define PI 3.14159265358979323846

/* ---- infinitely many blows ---- */
enum { TIME, FIRST, COUNT, PLACE, SPEED, EACH };

/* A ball on an incline; `listed` strikes are asked for one by one. */
static scene *bouncing(double e, double slope, double h, double v, int friction, double mu, double omega,
                       int listed)
{
    const double r = 0.1;
    scene *s = scene_create();
    const double n[2] = {-sin(slope), cos(slope)}, t[2] = {cos(slope), sin(slope)};
    const int b = scene_body(s, 1, 0.4 * r * r, (r + h) * n[0], (r + h) * n[1], 0),
              p = scene_point(s, b, 0, 0);
    const int c =
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, r), scene_floor(s, slope), 0, e, friction, mu);
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, c);
    scene_start_velocity(s, p, v * t[0], v * t[1]);
    scene_start_omega(s, b, omega);
    const int closed = scene_measure(s, PM_MEASURE_CONTACT_CLOSED, c);
    const int rest = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, closed, 0.5));
    scene_until(s, rest, 1);
    scene_ask_measure(s, scene_time(s));
    scene_ask_event(s, scene_read(s, scene_time(s)), strike, 1, 0);
    scene_ask_count(s, strike);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, p, PM_PART_X));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_X));
    if (listed > 0)
        scene_ask(s, PM_ASK_EACH, scene_read(s, scene_time(s)), strike, 1, 0, PM_NONE, PM_NONE, listed);
    return s;
}

static void zeno_values(void)
{
    scene *s = bouncing(0.9, 0, 1, 0, PM_FRICTION_SMOOTH, 0, 0, 0);
    if (runs_uniformly(s)) {
        NEAR(s->out[FIRST], 0.4515236409857, CLOSE);
        NEAR(s->out[TIME], 8.578949178729, CLOSE);
        EQUAL(s->out[COUNT], INFINITY);
        EQUAL(s->reason[COUNT], PM_REASON_INFINITE);
        CHECK(s->count[PM_COUNT_STEPS] < 100);
    }
    scene_free(s);
    for (double e = 0.05; e < 1; e += 0.1) {
        s = bouncing(e, 0, 0.3, 0, PM_FRICTION_SMOOTH, 0, 0, 0);
        const double fall = sqrt(2 * 0.3 / G);
        if (runs_uniformly(s)) NEAR(s->out[TIME], fall * (1 + e) / (1 - e), CLOSE * s->out[TIME]);
        scene_free(s);
    }
}

/* Frictionless on an incline: along it the motion does not notice the blows. */
static void zeno_goes_on(void)
{
    const double slope = -0.3, e = 0.7, h = 0.5;
    scene *s = bouncing(e, slope, h, 1.5, PM_FRICTION_SMOOTH, 0, 4, 0);
    const double fall = sqrt(2 * h / (G * cos(slope))), t = fall * (1 + e) / (1 - e);
    if (runs_uniformly(s)) {
        NEAR(s->out[TIME], t, CLOSE * t);
        const double way = 1.5 * t - 0.5 * G * sin(slope) * t * t, speed = 1.5 - G * sin(slope) * t;
        NEAR(s->out[PLACE], way * cos(slope) - 0.1 * sin(slope), 4 * CLOSE * way);
        NEAR(s->out[SPEED], speed * cos(slope), CLOSE * speed);
    }
    scene_free(s);
}

/* The leap gives what one blow after the other gives; strikes that are asked for are all there. */
static void zeno_one_by_one(void)
{
    /* a sphere's slip changes by 7/2 mu of each blow: it ends where 3e-4 of all blows are left */
    const double late = 3.5 * 0.1 * sqrt(2 * G * 0.4) * (1 + 0.8) / (1 - 0.8) * (1 - 3e-4);
    const struct {
        double slope, v, mu, omega;
        int friction;
    } x[] = {{0, 1, 0, 0, PM_FRICTION_SMOOTH},
             {-0.2, 0.3, 0.05, 20, PM_FRICTION_COULOMB},
             {-0.2, 0.3, 0.9, 20, PM_FRICTION_COULOMB},
             {0.1, 0.5, 0, -3, PM_FRICTION_ROUGH},
             {0, late, 0.1, 0, PM_FRICTION_COULOMB}};
    for (int i = 0; i < 5; i++) {
        enum { LISTED = 60 };
        const double e = 0.8;
        scene *a = bouncing(e, x[i].slope, 0.4, x[i].v, x[i].friction, x[i].mu, x[i].omega, 0);
        scene *b = bouncing(e, x[i].slope, 0.4, x[i].v, x[i].friction, x[i].mu, x[i].omega, LISTED);
        if (runs_uniformly(a)) CHECK(a->count[PM_COUNT_STEPS] < 70);
        scene_route(b, PM_ROUTE_UNIFORM, 1e-11);
        EQUAL(scene_run(b, NULL), PM_OK);
        const double size = 1 + fabs(a->out[TIME]), a_n = G * cos(x[i].slope);
        NEAR(b->out[TIME], a->out[TIME], CLOSE * size);
        NEAR(b->out[PLACE], a->out[PLACE], 4 * CLOSE * size);
        NEAR(b->out[SPEED], a->out[SPEED], 4 * CLOSE * size);
        double t = sqrt(2 * 0.4 / a_n), flight = 2 * t;
        for (int k = 0; k < 50; k++) {
            NEAR(b->out[EACH + k], t, CLOSE * size);
            t += flight *= e;
        }
        scene_free(a);
        scene_free(b);
    }
}

/* Strikes far down the series, lower than positions could tell. */
static void zeno_counts(void)
{
    scene *s = scene_create();
    const int p = scene_point(s, scene_body(s, 1, 0, 0, 1, 0), 0, 0);
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0), scene_floor(s, 0), 0, 0.9,
                                PM_FRICTION_SMOOTH, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, c), 200);
    scene_ask_measure(s, scene_time(s));
    const double fall = sqrt(2 / G);
    if (runs_uniformly(s)) {
        NEAR(s->out[0], fall * (1 + 2 * 0.9 * (1 - pow(0.9, 199)) / 0.1), 10 * CLOSE);
        EQUAL(s->count[PM_COUNT_JUMPS], 200);
    }
    scene_free(s);
}

/* What is asked within the rest of the series is found: a time, a place, an extreme, another contact. */
static void zeno_meets(void)
{
    const double e = 0.9, fall = sqrt(2 / G), limit = fall * (1 + e) / (1 - e);
    for (double early = 1e-3; early > 1e-7; early *= 0.1) {
        scene *s = bouncing(e, 0, 1, 1, PM_FRICTION_SMOOTH, 0, 0, 0);
        const int p = 0, x = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_X);
        const int passes = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, x, limit - early));
        scene_ask_event(s, scene_read(s, scene_time(s)), passes, 1, 0);
        scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, x), PM_NONE);
        if (runs_uniformly(s)) {
            NEAR(s->out[EACH], limit - early, 1e-11);
            NEAR(s->out[EACH + 1], limit, CLOSE * limit);
            NEAR(s->out[TIME], limit, CLOSE * limit);
        }
        scene_free(s);
    }
    scene *s = bouncing(e, 0, 1, 1, PM_FRICTION_SMOOTH, 0, 0, 0); /* a wall right before the limit */
    const int wall = scene_line(s, scene_point(s, PM_GROUND, 0.1 + limit - 1e-4, 0), PI / 2);
    const int c = scene_contact(s, PM_CONTACT_LINE, 0, wall, 0, 1, PM_FRICTION_SMOOTH, 0);
    scene_ask_event(s, scene_read(s, scene_time(s)), scene_on(s, PM_TRIGGER_STRIKE, c), 1, 0);
    if (runs_uniformly(s)) {
        /* in the middle of a low bounce its height is known to the rounding of positions only */
        NEAR(s->out[EACH], limit - 1e-4, CLOSE * limit);
        NEAR(s->out[TIME], limit, 1e-10);
        NEAR(s->out[PLACE], limit - 2e-4, 1e-10);
    }
    scene_free(s);
}

/* A block that falls flat bounces on all its feet alike, however low, and does not turn. */
static void bounces_flat(int reversed)
{
    const double e = 0.08;
    scene *s = scene_create();
    const int b = scene_body(s, 2, 0.05, 0, 0.5, 0);
    for (int i = 0; i < 3; i++) {
        const double x = 0.37 * (reversed ? 1 - i : i - 1);
        const int foot = scene_circle(s, scene_point(s, b, x, -0.2), 0);
        scene_contact(s, PM_CONTACT_LINE, foot, scene_floor(s, 0), 0, e, PM_FRICTION_SMOOTH, 0);
    }
    const int g = scene_point(s, b, 0, 0);
    scene_start_velocity(s, g, 0.7, 0);
    scene_until_time(s, 0.5);
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, b));
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_measure(s, PM_MEASURE_OMEGA, b)), PM_NONE);
    if (runs_uniformly(s)) {
        NEAR(s->out[0], 0.7 * 0.5, CLOSE);
        NEAR(s->out[1], 0, CLOSE);
        NEAR(s->out[2], 0, CLOSE);
        CHECK(s->count[PM_COUNT_JUMPS] > 4); /* the rest is summed up */
    }
    scene_free(s);
}

/* ---- tops ---- */
/* Where the speed of a ball that bounces changes sign its height has its extremum, at which steps end: each top is seen. */
static void sees_tops(void)
{
    for (int i = 0; i < 60; i++) {
        const double e = 0.3 + 0.011 * i, height = 0.6, r = 0.03;
        scene *s = scene_create();
        scene_set(s, PM_SETTING_GRAVITY_Y, -G);
        const int p = scene_point(s, scene_body(s, 1, 0, 0, 1 + r, 0), 0, 0);
        const int vy = scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_Y),
                  y = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_Y);
        const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, r), scene_floor(s, 0), 0, e,
                                    PM_FRICTION_SMOOTH, 0);
        scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, c), 4);
        const int top = scene_when(s, PM_TRIGGER_FALL, scene_minus(s, vy, 0)),
                  high = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, y, height + r));
        scene_ask_count(s, top);
        scene_ask_count(s, high);
        if (runs_uniformly(s)) {
            EQUAL(s->out[0], 3);
            EQUAL(s->out[1], (e * e > height) + (pow(e, 4) > height) + (pow(e, 6) > height));
        }
        scene_free(s);
    }
}

int main(void)
{
    sees_tops();
    zeno_values();
    zeno_goes_on();
    zeno_one_by_one();
    zeno_counts();
    zeno_meets();
    bounces_flat(0);
    bounces_flat(1);
    return check_failures();
}
