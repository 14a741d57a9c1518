/* Blows of several contacts that would be others one by one: what is counted, against runs that take them one by one in either
 * order; cradles; what is chosen is not counted. */
#include "check.h"
#include "scene.h"

#define CLOSE 1e-10
#define CASES 240
#define BODIES 2

typedef struct end {
    double x, slide, e, mu, tangential;
    int law, body;
} end;

/* Bodies with two ends on a floor, at the same instant. */
typedef struct drop {
    double mass[BODIES], inertia[BODIES], height, vx, vy[BODIES], omega[BODIES];
    end of[2];
} drop;

/* Alike: nothing tells apart; struck where the other end is a centre of percussion, or on two bodies: no order matters. */
static drop some(int n)
{
    drop d = {.height = check_random(0, 0.5), .vx = check_random(-1, 1)};
    for (int k = 0; k < BODIES; k++) {
        d.mass[k] = check_random(0.5, 3);
        d.inertia[k] = d.mass[k] * check_random(0.05, 0.5);
        d.vy[k] = check_random(-3, -2);
        d.omega[k] = check_random(-1, 1);
    }
    const int apart = n % 3 == 0, smooth = n % 3 == 1 || n % 4 == 0;
    for (int k = 0; k < 2; k++) {
        d.of[k] = (end){.x = (k ? 1 : -1) * check_random(0.3, 0.8), .e = check_random(0, 1)};
        d.of[k].body = apart ? k : 0;
        d.of[k].mu = smooth ? 0 : check_random(0, 0.8);
        d.of[k].law = n / 3 % (PM_LAWS + 1);
        if (d.of[k].law < PM_LAWS) continue;
        d.of[k].law = PM_LAW_NEWTON;
        d.of[k].tangential = check_random(0.1, 0.9);
    }
    if (n % 3 == 1) d.inertia[0] = d.mass[0] * -d.of[0].x * d.of[1].x;
    return d;
}

/* Velocities after the blow, with contacts in this order. */
static scene *strike(const drop *d, int order, int impacts, double *after)
{
    scene *s = scene_create();
    int ask[3 * BODIES], point[BODIES];
    const int line = scene_floor(s, 0);
    for (int k = 0; k < BODIES; k++) {
        const int b = scene_body(s, d->mass[k], d->inertia[k], 4 * k, d->height, 0);
        point[k] = scene_point(s, b, 0, 0);
        ask[3 * k] = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, point[k], PM_PART_X));
        ask[3 * k + 1] = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, point[k], PM_PART_Y));
        ask[3 * k + 2] = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
        scene_start_velocity(s, point[k], d->vx, d->vy[k]);
        scene_start_omega(s, b, d->omega[k]);
    }
    for (int k = 0; k < 2; k++) {
        const end *x = &d->of[order ? 1 - k : k];
        const int circle = scene_circle(s, scene_point(s, x->body, x->x, -d->height), 0);
        const int c = scene_contact(s, PM_CONTACT_LINE, circle, line, 0, x->e, PM_FRICTION_COULOMB, x->mu);
        scene_cell(s, PM_TABLE_CONTACT, c, PM_CONTACT_LAW, x->law);
        if (x->tangential > 0)
            scene_cell(s, PM_TABLE_CONTACT, c, PM_CONTACT_TANGENTIAL, scene_value(s, x->tangential));
    }
    scene_until_time(s, 1e-3);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_SIMULTANEOUS) = impacts;
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int k = 0; k < 3 * BODIES; k++) after[k] = s->out[ask[k]];
    return s;
}

static double distance(const double *a, const double *b)
{
    double far = 0;
    for (int k = 0; k < 3 * BODIES; k++) far = fmax(far, fabs(a[k] - b[k]));
    return far;
}

/* A blow is counted if, and only if, one of the two ways to take it one by one leaves another motion. */
static void against_one_by_one(void)
{
    int same = 0, other = 0;
    for (int n = 0; n < CASES; n++) {
        const drop d = some(n);
        double one[2][3 * BODIES], all[2][3 * BODIES], chosen[3 * BODIES];
        int64_t counted[2];
        for (int order = 0; order < 2; order++) {
            scene_free(strike(&d, order, PM_SIMULTANEOUS_ONE_BY_ONE, one[order]));
            scene *s = strike(&d, order, PM_SIMULTANEOUS_OPEN, all[order]);
            counted[order] = s->count[PM_COUNT_ORDERED_BLOWS];
            EQUAL(s->where[PM_WHERE_TABLE], counted[order] ? PM_TABLE_CONTACT : PM_NONE);
            if (counted[order]) EQUAL(s->where[PM_WHERE_ROW] + s->where[PM_WHERE_MEMBER], 1);
            if (counted[order]) EQUAL(s->detail[PM_DETAIL_VALUE], 0);
            scene_free(s);
        }
        scene *s = strike(&d, 0, PM_SIMULTANEOUS_TOGETHER, chosen);
        EQUAL(s->count[PM_COUNT_ORDERED_BLOWS], 0);
        scene_free(s);
        EQUAL(distance(chosen, all[0]), 0);
        const double far = fmax(distance(one[0], all[0]), distance(one[1], all[0]));
        CHECK(far < CLOSE || far > 1e-4);
        EQUAL(counted[0], far > CLOSE);
        EQUAL(counted[1], counted[0]);
        if (n % 3 == 0) EQUAL(counted[0], 0);
        same += !counted[0];
        other += counted[0] != 0;
    }
    CHECK(same > 60 && other > 60);
}

/* Balls in a row that touch, and one that comes after a time. */
static void row(scene *s, int n, int backward, double e, double y, double after)
{
    int circle[5];
    for (int x = 0; x < n; x++) {
        const double away = x == 0 ? -2 * after : 0;
        const int g = scene_point(s, scene_body(s, 1, 0.1, 0.4 * x + away, y, 0), 0, 0);
        circle[x] = scene_circle(s, g, 0.2);
        if (x == 0) scene_start_velocity(s, g, 2, 0);
    }
    for (int i = 0; i < n - 1; i++) {
        const int x = backward ? n - 2 - i : i;
        scene_contact(s, PM_CONTACT_CIRCLE, circle[x], circle[x + 1], 1, e, PM_FRICTION_SMOOTH, 0);
    }
}

/* Whatever the order of the contacts, the blow is told, with its time, and with two contacts of one ball; of two blows the
 * first in time. */
static void cradle(int n, int backward, double e)
{
    scene *s = scene_create();
    row(s, n, backward, e, 0, 0.05);
    row(s, n, backward, e, 5, 0.1);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    scene_ask_measure(s, scene_time(s));
    scene_until_time(s, 0.2);
    *scene_setting(s, PM_SETTING_SIMULTANEOUS) = PM_SIMULTANEOUS_OPEN;
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    EQUAL(scene_run(s, NULL), PM_OK);
    const int matters = n > 2 && e > 0;
    EQUAL(s->count[PM_COUNT_ORDERED_BLOWS], 2 * matters);
    EQUAL(s->where[PM_WHERE_ROW], !matters ? PM_NONE : backward ? n - 2 : 0);
    EQUAL(s->where[PM_WHERE_MEMBER], !matters ? PM_NONE : backward ? n - 3 : 1);
    if (matters) NEAR(s->detail[PM_DETAIL_VALUE], 0.05, CLOSE);
    scene_free(s);
}

/* Without restitution one by one ends, after many blows, where all at once does. */
static void cradles(void)
{
    for (int n = 2; n <= 5; n++)
        for (int backward = 0; backward < 2; backward++)
            for (double e = 0; e < 1.1; e += 0.5) cradle(n, backward, e);
}

int main(void)
{
    against_one_by_one();
    cradles();
    return check_failures();
}
