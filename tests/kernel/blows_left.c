/* Balls let fall on inclines: the n-th blow, though it is long after the last one whose rebound can be computed, beside the closed
 * form.  The first fall takes t1, the flight after blow k is 2 e^k t1 long, and blow k comes with e^(k - 1) times the speed of the
 * first; along the incline nothing happens. */
#include "check.h"
#include "estimating.h"
#include "scene.h"
#include "scene_elements.h"

#define MOST 16

typedef struct fall {
    double restitution, slope, height;
    int n; /* blow that is waited for */
} fall;

static fall random_fall(double low, double high)
{
    return (fall){.restitution = check_random(low, high),
                  .slope = check_random(-1, 1),
                  .height = check_random(0.2, 3),
                  .n = (int)check_random(2, MOST + 1)};
}

static double time_of(const fall *x, int blow)
{
    const double e = x->restitution;
    return sqrt(2 * x->height / G) * (1 + 2 * e * (1 - pow(e, blow - 1)) / (1 - e));
}

/* With which it comes to a blow, along the normal. */
static double approach_of(const fall *x, int blow)
{
    return G * cos(x->slope) * sqrt(2 * x->height / G) * pow(x->restitution, blow - 1);
}

/* Just before the blow or after it, upwards. */
static double rise_of(const fall *x, double after)
{
    const double along = G * sin(x->slope) * time_of(x, x->n), approach = approach_of(x, x->n);
    return -along * sin(x->slope) + (after > 0 ? x->restitution : -1) * approach * cos(x->slope);
}

static int ball(scene *s, const fall *x, int route)
{
    const int b = scene_body(s, 1, 0, 0, x->height, 0), g = scene_point(s, b, 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, 0),
                  scene_line(s, scene_point(s, PM_GROUND, 0, 0), -x->slope), 0, x->restitution,
                  PM_FRICTION_SMOOTH, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    return g;
}

static void as_told(const scene *s, int out, double truth)
{
    CHECK(fabs(s->out[out] - truth) <= 5 * s->error[out]);
}

/* The run ends at the n-th blow, and is asked for what there is then. */
static void ends_there(const fall *x, int route)
{
    scene *s = estimating(1e-10);
    const int g = ball(s, x, route), blow = scene_on(s, PM_TRIGGER_STRIKE, 0),
              vy = scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y);
    scene_until(s, blow, x->n);
    const int t = scene_ask_measure(s, scene_time(s)), count = scene_ask_count(s, blow),
              there = scene_ask_event(s, scene_read(s, scene_time(s)), blow, x->n, 0),
              before = scene_ask_event(s, scene_read(s, vy), blow, x->n, 1),
              after = scene_ask_event(s, scene_read(s, vy), blow, x->n, 0);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[count], x->n);
    NEAR(s->out[t], time_of(x, x->n), 1e-9);
    NEAR(s->out[there], time_of(x, x->n), 1e-9);
    as_told(s, t, time_of(x, x->n));
    as_told(s, before, rise_of(x, -1));
    as_told(s, after, rise_of(x, 1));
    CHECK(s->error[after] < 1e-3);
    scene_free(s);
}

/* The run goes on, and each of the first n blows is asked for; in the end they are countless. */
static void each_of_them(const fall *x, int route)
{
    scene *s = estimating(1e-10);
    ball(s, x, route);
    const int blow = scene_on(s, PM_TRIGGER_STRIKE, 0);
    scene_until_time(s, time_of(x, 1) * (1 + x->restitution) / (1 - x->restitution) + 0.1);
    const int count = scene_ask_count(s, blow), each = scene_ask(s, PM_ASK_EACH, scene_read(s, scene_time(s)),
                                                                 blow, 1, 0, PM_NONE, PM_NONE, MOST);
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(isinf(s->out[count]));
    for (int k = 1; k <= MOST; k++) {
        if (time_of(x, k + 1) - time_of(x, k) < 1e-12) break;
        NEAR(s->out[each + k - 1], time_of(x, k), 1e-9);
    }
    scene_free(s);
}

/* The n-th blow is an event of its own. */
static void nth_event(const fall *x, int route)
{
    scene *s = estimating(1e-10);
    ball(s, x, route);
    const int blow = scene_on(s, PM_TRIGGER_STRIKE, 0);
    const int nth = SCENE_ROW(s, PM_TABLE_EVENT, x->n, 0);
    scene_trigger(s, PM_TRIGGER_STRIKE, nth, PM_NONE, 0);
    scene_until(s, nth, 1);
    const int t = scene_ask_measure(s, scene_time(s)), count = scene_ask_count(s, blow);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[count], x->n);
    NEAR(s->out[t], time_of(x, x->n), 1e-9);
    scene_free(s);
}

/* The run ends within the flight that begins with blow n; passes that have followed more blows than others may call that undecided. */
static void within_a_flight(const fall *x, int route)
{
    const double sine = sin(x->slope), cosine = cos(x->slope), speed = x->restitution * approach_of(x, x->n);
    const double flight = 2 * speed / (G * cosine), late = check_random(0.1, 0.9) * flight,
                 end = time_of(x, x->n) + late;
    if (flight < 1e-7) return;
    scene *s = estimating(1e-10);
    const int g = ball(s, x, route);
    scene_until_time(s, end);
    const int y = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y)),
              vy = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y));
    const int status = scene_run(s, NULL);
    CHECK(status == PM_OK || status == PM_UNDECIDED);
    as_told(s, y,
            (speed - G * cosine * late / 2) * late * cosine + (x->height - G * end * end / 2) * sine * sine);
    as_told(s, vy, (speed - G * cosine * late) * cosine - G * sine * sine * end);
    CHECK(s->error[vy] < 1e-3);
    scene_free(s);
}

int main(void)
{
    static const int route[] = {PM_ROUTE_RK, PM_ROUTE_IDA, PM_ROUTE_UNIFORM};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 30; i++) {
            const fall low = random_fall(0.05, 0.45), any = random_fall(0.05, 0.95);
            ends_there(&low, route[k]);
            ends_there(&any, route[k]);
            each_of_them(&low, route[k]);
            nth_event(&low, route[k]);
            if (route[k] != PM_ROUTE_UNIFORM) within_a_flight(&low, route[k]);
        }
    return check_failures();
}
