/* Integrals over a series of bounces of which the last are not followed, beside closed forms: a ball is let fall from h and bounces with
 * restitution e.  It comes with v = sqrt(2 g h), and its flight k takes 2 v e^k / g.  It lies still after
 *   T = v / g (1 + e) / (1 - e). */
#include "events/integral_series.h"
#include "check.h"
#include "estimating.h"
#include "scene.h"

typedef struct bounce {
    double e, h, v, end;
} bounce;

static bounce random_bounce(double low, double high)
{
    bounce x = {.e = check_random(low, high), .h = pow(10, check_random(-2, 2))};
    x.v = sqrt(2 * G * x.h);
    x.end = x.v / G * (1 + x.e) / (1 - x.e);
    return x;
}

/* ---- the sum alone ---- */
/* Flights that shrink by r, and what the mean over them is off its limit by s. */
static void as_it_shrinks(double s)
{
    const double r = check_random(0.05, 0.95), limit = check_random(-1, 1), d = check_random(-1, 1);
    pm_integral_flights x = {.n = 4};
    double t = 0, sum = 0, rest = 0;
    for (int k = 0; k < 4; k++) {
        x.at[3 - k] = (pm_integral_at){t, sum, 2 * t};
        t += pow(r, k);
        sum += pow(r, k) * (limit + d * pow(s, k));
    }
    for (int k = 3; k < 2000; k++) rest += pow(r, k) * (limit + d * pow(s, k));
    const double time = pow(r, 3) / (1 - r);
    const pm_integral_tail tail = pm_integral_series_tail(&x, 0, r, time, limit),
                           weight = pm_integral_series_tail(&x, 1, r, time, 2);
    NEAR(tail.value, rest, 1e-10);
    CHECK(tail.error < 1e-10);
    NEAR(weight.value, 2 * time, 1e-12);
    x.n = 3; /* one ratio of what shrinks: nothing is known of it */
    CHECK(pm_integral_series_tail(&x, 0, r, time, limit).error >= 0.99 * time * fabs(d) * pow(s, 2));
}

/* ---- runs ---- */
static scene *ball(const bounce *x, int route, double accuracy, int *vy, int *y)
{
    scene *s = estimating(accuracy);
    const int b = scene_body(s, 1, 0, 0, x->h, 0), g = scene_point(s, b, 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, 0), scene_floor(s, 0), 0, x->e, PM_FRICTION_SMOOTH,
                  0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    *vy = scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y);
    *y = scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y);
    return s;
}

static int integral(scene *s, int program)
{
    return scene_ask(s, PM_ASK_INTEGRAL, program, PM_NONE, 1, 0, PM_NONE, PM_NONE, 1);
}

static void as_told(const scene *s, int out, double truth, double good)
{
    CHECK(fabs(s->out[out] - truth) <= fmax(5 * s->error[out], 1e-15 * fabs(truth)));
    NEAR(s->out[out], truth, good * fabs(truth));
}

static double length(const bounce *x) { return x->h * (1 + 2 * x->e * x->e / (1 - x->e * x->e)); }

static double area(const bounce *x)
{
    const double q = pow(x->e, 3);
    return x->v * x->v * x->v / (G * G) * (1. / 3 + 2. / 3 * q / (1 - q));
}

/* The way, and the area below it, whether the run ends with the series or later. */
static void whole(const bounce *x, int route, double accuracy)
{
    int vy, y;
    scene *s = ball(x, route, accuracy, &vy, &y);
    scene_until_time(s, x->end * check_random(1.001, 1.3));
    const int way = integral(s, SCENE_PROGRAM(s, scene_m(vy), scene_op(PM_OP_ABS))),
              below = integral(s, scene_read(s, y));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double good = route == PM_ROUTE_IDA ? 100 * accuracy : fmax(accuracy, 1e-12);
    as_told(s, way, length(x), good);
    as_told(s, below, area(x), good);
    scene_free(s);
}

/* The speed beyond a threshold, which only the first flights reach: |v| - c where |v| > c. */
static void beyond(const bounce *x, int route)
{
    int vy, y;
    scene *s = ball(x, route, 1e-10, &vy, &y);
    const double c = x->v * pow(x->e, 6.5);
    double truth = pow(x->v - c, 2) / (2 * G);
    for (int k = 1; k <= 6; k++) truth += pow(x->v * pow(x->e, k) - c, 2) / G;
    scene_until_time(s, x->end * 1.1);
    const int out = integral(s, SCENE_PROGRAM(s, scene_m(vy), scene_op(PM_OP_ABS), scene_k(s, c),
                                              scene_op(PM_OP_SUB), scene_k(s, 0), scene_op(PM_OP_MAX)));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[out], truth, (route == PM_ROUTE_IDA ? 1e-7 : 1e-9) * truth);
    scene_free(s);
}

/* The run ends while the contact is closed and the ball still bounces: what it has not bounced is told. */
static void inside(const bounce *x, int route)
{
    int vy, y;
    scene *s = ball(x, route, 1e-10, &vy, &y);
    const double left = pow(10, check_random(-6.5, -5.5)) * x->v / G * 2 / (1 - x->e); /* s */
    scene_until_time(s, x->end - left);
    const int way = integral(s, SCENE_PROGRAM(s, scene_m(vy), scene_op(PM_OP_ABS)));
    scene_run(s, NULL);
    double truth = x->h, t = x->v / G, v = x->v * x->e;
    for (; t + 2 * v / G < x->end - left; v *= x->e) t += 2 * v / G, truth += v * v / G;
    const double on = x->end - left - t, up = fmin(on, v / G), down = on - up;
    truth += up * (v - 0.5 * G * up) + 0.5 * G * down * down;
    as_told(s, way, truth, 1e-7);
    scene_free(s);
}

int main(void)
{
    static const int route[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int i = 0; i < 500; i++) {
        as_it_shrinks(check_random(0, 0.95));
        as_it_shrinks(1);
    }
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 30; i++) {
            const bounce low = random_bounce(0.03, 0.2), any = random_bounce(0.03, 0.9);
            whole(&low, route[k], pow(10, -check_random(4, 12)));
            whole(&any, route[k], pow(10, -check_random(4, 12)));
            if (i < 10) beyond(&any, route[k]);
            inside(&any, route[k]);
        }
    return check_failures();
}
