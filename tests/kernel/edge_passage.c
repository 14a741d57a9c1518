/* Two bodies that fly and turn: a mark of one goes through an edge of the other close to an end of it.  When, beside the known
 * motion, looked at in 200,000 places. */
#include "check.h"
#include "elements/contact.h"
#include "scene.h"

#define END 0.5 /* s */
#define PLACES 200000
#define NEAR_IT 1e-7 /* s: before, and after, the mark touches */

/* A body that flies: its pose at 0 and its velocity, and a mark of it or an edge from there, along its x-axis. */
typedef struct flight {
    double pose[3], v[3], mark[2];
} flight;

typedef struct passage {
    flight body, edge;
    double length, radius;
} passage;

static void at_time(const flight *f, double t, double pose[3])
{
    for (int i = 0; i < 3; i++) pose[i] = f->pose[i] + f->v[i] * t;
}

static void turn(double angle, const double a[2], double out[2])
{
    const double x = cos(angle) * a[0] - sin(angle) * a[1];
    out[1] = sin(angle) * a[0] + cos(angle) * a[1];
    out[0] = x;
}

/* The mark, from the begin of the edge, along it and over it. */
static void beside(const passage *p, double t, double out[2])
{
    double a[3], b[3], mark[2], begin[2];
    at_time(&p->body, t, a);
    at_time(&p->edge, t, b);
    turn(a[2], p->body.mark, mark);
    turn(b[2], p->edge.mark, begin);
    const double d[2] = {a[0] + mark[0] - b[0] - begin[0], a[1] + mark[1] - b[1] - begin[1]};
    turn(-b[2], d, out);
}

/* What falls through zero where the mark touches: of a circle its distance, of a point its height over the line. */
static double clearance(const passage *p, double t)
{
    double x[2];
    beside(p, t, x);
    return p->radius > 0 ? hypot(fmax(fmax(-x[0], x[0] - p->length), 0), x[1]) - p->radius : x[1];
}

/* Where the clearance goes through zero from above, between two times. */
static double zero_between(const passage *p, double low, double high)
{
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        *(clearance(p, middle) > 0 ? &low : &high) = middle;
    }
    return high;
}

/* Of a circle: on the back of the face nothing touches. */
static int is_behind(const passage *p, double t)
{
    double x[2];
    beside(p, t, x);
    return x[1] < 0 && x[0] > 0 && x[0] < p->length;
}

static int is_beyond(const passage *p, double t)
{
    double x[2];
    beside(p, t, x);
    return x[0] < 0 || x[0] > p->length;
}

/* When it touches first; INFINITY: never, NAN: it does not begin on the free side of the edge, or comes
 * through it from the back. */
static double first_touch(const passage *p)
{
    double before = clearance(p, 0), x[2];
    beside(p, 0, x);
    if (x[1] < 0.02) return NAN;
    for (int k = 1; k <= PLACES; k++) {
        const double t = END * k / PLACES, now = clearance(p, t);
        if (now <= 0 && before > 0) {
            const double zero = zero_between(p, END * (k - 1) / PLACES, t);
            if (p->radius > 0 && is_behind(p, zero)) return NAN;
            if (p->radius > 0 || !is_beyond(p, zero)) return zero;
        }
        before = now;
    }
    return INFINITY;
}

/* At a random time the mark is over the edge, or beyond its end, by very little. */
static passage random_passage(void)
{
    passage p = {.length = check_random(0.1, 0.5), .radius = check_random(0, 1) < 0.5 ? 0 : 0.01};
    const double t = check_random(0.05, END), near = pow(10, check_random(-4, -1)) * p.length;
    const double u = check_random(0, 1) < 0.5 ? near : p.length - near;
    double begin[2], mark[2], place[2] = {check_random(0, 1) < 0.8 ? u : -near, p.radius};
    for (int i = 0; i < 2; i++) {
        p.body.v[i] = check_random(-2, 2);
        p.edge.v[i] = check_random(-2, 2);
        p.body.mark[i] = check_random(-0.3, 0.3);
        p.edge.mark[i] = check_random(-0.3, 0.3);
    }
    p.body.v[2] = check_random(-8, 8);
    p.edge.v[2] = check_random(-8, 8);
    const double a = check_random(-3, 3), b = check_random(-3, 3);
    turn(b, p.edge.mark, begin);
    turn(b, place, place);
    turn(a, p.body.mark, mark);
    for (int i = 0; i < 2; i++) {
        p.edge.pose[i] = -p.edge.v[i] * t;
        p.body.pose[i] = begin[i] + place[i] - mark[i] - p.body.v[i] * t;
    }
    p.edge.pose[2] = b - p.edge.v[2] * t;
    p.body.pose[2] = a - p.body.v[2] * t;
    return p;
}

static int body_of(scene *s, const flight *f)
{
    const int b = scene_body(s, 1, 0.01, f->pose[0], f->pose[1], f->pose[2]);
    scene_start_velocity(s, scene_point(s, b, 0, 0), f->v[0], f->v[1]);
    scene_start_omega(s, b, f->v[2]);
    return b;
}

static double strikes_until(const passage *p, int route, double t)
{
    scene *s = scene_create();
    const int a = body_of(s, &p->body), b = body_of(s, &p->edge);
    const int circle = scene_circle(s, scene_point(s, a, p->body.mark[0], p->body.mark[1]), p->radius),
              line = scene_line(s, scene_point(s, b, p->edge.mark[0], p->edge.mark[1]), 0);
    const int contact = scene_segment(s, circle, line, 0, p->length, 0.5, PM_FRICTION_SMOOTH, 0);
    const int strikes = scene_ask_measure(
        s, scene_measure(s, PM_MEASURE_EVENT_COUNT, scene_on(s, PM_TRIGGER_STRIKE, contact)));
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    scene_until_time(s, t);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    const double count = s->out[strikes];
    scene_free(s);
    return count;
}

static int is_seen(int route)
{
    const passage p = random_passage();
    const double t = first_touch(&p);
    if (isnan(t) || t < 1e-3) return 0;
    if (isinf(t)) {
        EQUAL(strikes_until(&p, route, END), 0);
        return 0;
    }
    EQUAL(strikes_until(&p, route, t - NEAR_IT), 0);
    CHECK(strikes_until(&p, route, fmin(t + NEAR_IT, END)) >= 1);
    CHECK(strikes_until(&p, route, END) >= 1);
    return 1;
}

/* A mark that rotates comes through a fixed edge from behind, close to its end, and falls on its front a moment later. */
static void comes_from_behind(int route)
{
    const passage p = {
        .body = {.v = {1.43332096, 1.38075499, 25.0556439}, .mark = {-0.06788291483, -0.0003948593729}},
        .edge = {.pose = {1.931918040254, 1.774273859999, -2.565215254048}},
        .length = 0.09729829995};
    const double behind = 1.325, before = 1.3305, after = 1.332;
    CHECK(clearance(&p, behind) < 0 && clearance(&p, before) > 0 && clearance(&p, after) < 0);
    const double t = zero_between(&p, before, after);
    CHECK(!is_beyond(&p, t));
    scene *s = scene_create();
    const int mark = scene_circle(s, scene_point(s, body_of(s, &p.body), p.body.mark[0], p.body.mark[1]), 0);
    const double *at = p.edge.pose;
    const int line = scene_line(s, scene_point(s, PM_GROUND, at[0], at[1]), at[2]);
    const int contact = scene_segment(s, mark, line, 0, p.length, 0, PM_FRICTION_SMOOTH, 0);
    const int struck = scene_ask_end(s, scene_read(s, scene_time(s)));
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, contact), 1);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    scene_set(s, PM_SETTING_MAX_TIME, 2);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[struck], t, NEAR_IT);
    scene_free(s);
}

int main(void)
{
    comes_from_behind(PM_ROUTE_AUTO);
    comes_from_behind(PM_ROUTE_RK);
    static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int k = 0; k < 3; k++) {
        int struck = 0;
        for (int i = 0; i < (k == 2 ? 60 : 200); i++) struck += is_seen(routes[k]);
        CHECK(struck > (k == 2 ? 15 : 50));
    }
    return check_failures();
}
