/* What fires in each flight of a ball that bounces, beside closed forms: a ball is let fall from h, comes with v = sqrt(2 g h) at
 * t1 = v / g, bounces with restitution e, and its k-th flight takes 2 e^k t1.  It rises at each blow, and falls from the middle of each
 * flight on.  Runs end inside the series, or when it is over, and ask for counts, or for the n-th of the firings. */
#include "check.h"
#include "estimating.h"
#include "scene.h"

typedef struct bounces {
    scene *s;
    double e, h, v;
    int vy, blow, rise, fall, fast; /* events */
} bounces;

static bounces bouncing(int route, double low, double high)
{
    bounces x = {.s = estimating(1e-10), .e = check_random(low, high), .h = pow(10, check_random(-2, 2))};
    scene *s = x.s;
    x.v = sqrt(2 * G * x.h);
    const int g = scene_point(s, scene_body(s, 1, 0, 0, x.h, 0), 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, 0), scene_floor(s, 0), 0, x.e, PM_FRICTION_SMOOTH,
                  0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    x.vy = scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y);
    x.blow = scene_on(s, PM_TRIGGER_STRIKE, 0);
    x.rise = scene_event(s);
    scene_trigger(s, PM_TRIGGER_RISE, x.rise, scene_read(s, x.vy), PM_NONE);
    x.fall = scene_event(s);
    scene_trigger(s, PM_TRIGGER_FALL, x.fall, scene_read(s, x.vy), PM_NONE);
    x.fast = scene_event(s);
    scene_trigger(s, PM_TRIGGER_RISE, x.fast, scene_minus(s, x.vy, x.v * pow(x.e, 2.5)), PM_NONE);
    return x;
}

static double time_of(const bounces *x, int blow)
{
    return x->v / G * (1 + 2 * x->e * (1 - pow(x->e, blow - 1)) / (1 - x->e));
}

static double end_of(const bounces *x) { return x->v / G * (1 + x->e) / (1 - x->e); }

/* The run ends after blow n, before or after the top of the flight. */
static void ends_inside(int route)
{
    bounces x = bouncing(route, 0.1, 0.8);
    const int n = (int)(log(check_random(0, 1) < 0.5 ? 1e-3 : 1e-7) / log(x.e)) + 2;
    const double part = check_random(0, 1) < 0.5 ? check_random(0.1, 0.4) : check_random(0.6, 0.9);
    scene_until_time(x.s, time_of(&x, n) + part * (time_of(&x, n + 1) - time_of(&x, n)));
    const int blows = scene_ask_count(x.s, x.blow), rises = scene_ask_count(x.s, x.rise),
              falls = scene_ask_count(x.s, x.fall), fast = scene_ask_count(x.s, x.fast);
    EQUAL(scene_run(x.s, NULL), PM_OK);
    EQUAL(x.s->out[blows], n);
    EQUAL(x.s->out[rises], n);
    EQUAL(x.s->out[falls], n - (part < 0.5)); /* it falls from its start on, which is no change */
    EQUAL(x.s->out[fast], 2);
    scene_free(x.s);
}

/* The series is over. */
static void ends_later(int route)
{
    bounces x = bouncing(route, 0.1, 0.8);
    scene_until_time(x.s, end_of(&x) * check_random(1.001, 1.5));
    const int rises = scene_ask_count(x.s, x.rise), falls = scene_ask_count(x.s, x.fall),
              fast = scene_ask_count(x.s, x.fast);
    EQUAL(scene_run(x.s, NULL), PM_OK);
    CHECK(isinf(x.s->out[rises]));
    CHECK(isinf(x.s->out[falls]));
    EQUAL(x.s->out[fast], 2);
    scene_free(x.s);
}

/* The n-th time that it rises, or falls; the run ends with it or goes on. */
static void nth(int route)
{
    bounces x = bouncing(route, 0.1, 0.5);
    const int n = (int)check_random(2, 14), rises = check_random(0, 1) < 0.5;
    const int event = rises ? x.rise : x.fall;
    const double truth = rises ? time_of(&x, n) : 0.5 * (time_of(&x, n) + time_of(&x, n + 1));
    if (end_of(&x) - truth < 1e-13 * end_of(&x)) {
        scene_free(x.s);
        return;
    }
    if (check_random(0, 1) < 0.5)
        scene_until(x.s, event, n);
    else
        scene_until_time(x.s, 2 * end_of(&x));
    const int there = scene_ask_event(x.s, scene_read(x.s, scene_time(x.s)), event, n, 0);
    EQUAL(scene_run(x.s, NULL), PM_OK);
    NEAR(x.s->out[there], truth, 1e-9 * truth);
    scene_free(x.s);
}

/* What waits for a speed that the flights which are not followed pass is not countless, whoever counts it. */
static void not_in_all(int route)
{
    bounces x = bouncing(route, 0.3, 0.8);
    const int slow = scene_event(x.s);
    scene_trigger(x.s, PM_TRIGGER_RISE, slow, scene_minus(x.s, x.vy, 3e-6 * x.v), PM_NONE);
    *scene_setting(x.s, PM_SETTING_ESTIMATE) = 0;
    scene_until_time(x.s, 2 * end_of(&x));
    const int out = scene_ask_count(x.s, slow);
    EQUAL(scene_run(x.s, NULL), PM_OK);
    CHECK(!isinf(x.s->out[out]));
    scene_free(x.s);
}

int main(void)
{
    static const int route[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 30; i++) {
            if (route[k] != PM_ROUTE_IDA || i < 10) ends_inside(route[k]);
            ends_later(route[k]);
            nth(route[k]);
            not_in_all(route[k]);
        }
    return check_failures();
}
