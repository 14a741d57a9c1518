/* A body comes down on two walls with two of its points, so slowly that nothing could be seen of how they part, but it slips faster:
 * both are held.  Friction may drive such a body into its walls: with the friction of its slips both points would pull, without it
 * they push.  Then no slip is left.
 *
 * What slips on is told by the same blow a thousand times as fast, which is not held.  From there all ways are enumerated in which
 * two points can be held: friction against the slip where they push, none where they pull. */
#include "check.h"
#include "impact/impact.h"
#include "impact/impact_parts.h"
#include "numerics/dense.h"
#include "scene.h"
#include "state/frame.h"
#include "state/route.h"

#define HIGHER 1.0  /* m, where it starts */
#define FASTER 1000 /* times */

typedef struct body {
    double mass, inertia, mu, angle[2], mark[2][2], at[2]; /* the marks seen from its centre, turned */
    double row[2][2][3];                                   /* normal and tangent at each, by the velocities */
} body;

static body random_body(void)
{
    body x = {.mass = check_random(0.5, 5),
              .mu = check_random(0.3, 1.2),
              .angle = {check_random(-1.3, -0.6), check_random(0.6, 1.3)}};
    const double wide = check_random(0.05, 0.2), high = check_random(0.05, 0.2), turn = check_random(-3, 3);
    x.inertia = x.mass * (wide * wide + high * high) / 3;
    for (int i = 0; i < 2; i++) {
        const double sign = i ? 1 : -1; /* corners across from each other */
        x.mark[i][0] = sign * (wide * cos(turn) - high * sin(turn));
        x.mark[i][1] = sign * (wide * sin(turn) + high * cos(turn));
    }
    double n[2][2], gap[2];
    for (int i = 0; i < 2; i++) {
        n[i][0] = -sin(x.angle[i]);
        n[i][1] = cos(x.angle[i]);
        gap[i] = -n[i][0] * x.mark[i][0] - n[i][1] * x.mark[i][1];
        const double d[2][2] = {{n[i][0], n[i][1]}, {n[i][1], -n[i][0]}};
        for (int k = 0; k < 2; k++) {
            x.row[i][k][0] = d[k][0];
            x.row[i][k][1] = d[k][1];
            x.row[i][k][2] = x.mark[i][0] * d[k][1] - x.mark[i][1] * d[k][0];
        }
    }
    const double det = n[0][0] * n[1][1] - n[0][1] * n[1][0];
    x.at[0] = (gap[0] * n[1][1] - gap[1] * n[0][1]) / det;
    x.at[1] = (gap[1] * n[0][0] - gap[0] * n[1][0]) / det;
    return x;
}

static double times(const double a[3], const double v[3]) { return a[0] * v[0] + a[1] * v[1] + a[2] * v[2]; }

/* Velocities with these rates along both normals and the first tangent. */
static int set_rates(const body *x, const double rate[3], double v[3])
{
    double rows[9];
    int pivot[3];
    memcpy(rows, x->row[0][0], 3 * sizeof *rows);
    memcpy(rows + 3, x->row[1][0], 3 * sizeof *rows);
    memcpy(rows + 6, x->row[0][1], 3 * sizeof *rows);
    memcpy(v, rate, 3 * sizeof *v);
    if (pm_dense_lu_factor(3, rows, pivot)) return 0;
    pm_dense_lu_solve(3, rows, pivot, v);
    return 1;
}

/* What the kernel leaves of v, all as shares of its speed.  Of one blow: HELD or FREE; else NEITHER. */
enum { NEITHER, HELD, FREE };
static int blow(const body *x, const double v[3], double after[3])
{
    scene *s = scene_create();
    const int one = scene_body(s, x->mass, x->inertia, x->at[0], x->at[1] + HIGHER, 0);
    for (int i = 0; i < 2; i++)
        scene_contact(s, PM_CONTACT_LINE,
                      scene_circle(s, scene_point(s, one, x->mark[i][0], x->mark[i][1]), 0),
                      scene_floor(s, x->angle[i]), 0, 0.7, PM_FRICTION_COULOMB, x->mu);
    scene_until_time(s, 1);
    EQUAL(scene_begin(s), PM_OK);
    pm_workspace *w = s->w;
    w->phase.route = &pm_route_path;
    w->state.q[1] -= HIGHER;
    for (int k = 0; k < 3; k++) w->state.v[k] = v[k] * w->numbers.speed;
    for (int i = 0; i < 2; i++) w->state.slot[i].mode = PM_OPEN;
    pm_frame_look_state(&w->frame, &w->state);
    int jumped;
    const int status = pm_impact(w, &jumped);
    for (int k = 0; k < 3; k++) after[k] = w->state.v[k] / w->numbers.speed;
    const int held = w->blow->held[0] && w->blow->held[1];
    scene_free(s);
    return status || jumped != 1 ? NEITHER : held ? HELD : FREE;
}

/* Held with friction against these slips (0: none): the velocities after it; 1: so it can be. */
static int holds(const body *x, const double v[3], const int way[2], double after[3])
{
    const double by[3] = {1 / x->mass, 1 / x->mass, 1 / x->inertia};
    double force[2][3], rows[4], p[2], most = 0;
    int pivot[2];
    for (int i = 0; i < 2; i++) {
        p[i] = -times(x->row[i][0], v);
        for (int k = 0; k < 3; k++)
            force[i][k] = by[k] * (x->row[i][0][k] - way[i] * x->mu * x->row[i][1][k]);
    }
    for (int i = 0; i < 4; i++) rows[i] = times(x->row[i / 2][0], force[i % 2]);
    if (pm_dense_lu_factor(2, rows, pivot)) return 0;
    pm_dense_lu_solve(2, rows, pivot, p);
    for (int k = 0; k < 3; k++) after[k] = v[k] + force[0][k] * p[0] + force[1][k] * p[1];
    for (int i = 0; i < 2; i++) {
        if (way[i] == 0 ? p[i] > 0 : p[i] < 0) return 0;
        if (way[i] * times(x->row[i][1], after) < 0) return 0;
        most = fmax(most, fabs(p[i]));
    }
    return most > 0;
}

static double differ(const double a[3], const double b[3])
{
    double most = 0;
    for (int k = 0; k < 3; k++) most = fmax(most, fabs(a[k] - b[k]));
    return most;
}

/* What is left: slips; none, as one was slow or the blow ends it; none, as friction drives the body into its walls. */
enum { SLIPS, STOPS, DRIVEN };

/* -1: it is not held, or it would be several blows. */
static int held(void)
{
    const body x = random_body();
    const double slow = pow(10, check_random(-6.2, -5.8)), slips = slow * pow(10, check_random(-0.3, 1.5));
    const double rate[3] = {-slow * check_random(0.6, 1), -slow, copysign(slips, check_random(-1, 1))};
    double v[3], fast[3], after[3], would[3], expected[3], least = INFINITY;
    if (!set_rates(&x, rate, v)) return -1;
    for (int k = 0; k < 3; k++) fast[k] = FASTER * v[k];
    if (blow(&x, v, after) != HELD || blow(&x, fast, would) != FREE) return -1;
    int way[2], n = 0, stops = 0;
    for (int i = 0; i < 2; i++) {
        const double left = times(x.row[i][1], would) / FASTER, slip = times(x.row[i][1], v);
        stops += fabs(slip) <= slow || fabs(left) < 1e-11;
        way[i] = left > 0 ? 1 : -1;
        NEAR(times(x.row[i][0], after), 0, 1e-6 * slow);
    }
    for (int code = 0; code < 4 && !stops; code++) {
        const int with[2] = {code & 1 ? 0 : way[0], code & 2 ? 0 : way[1]};
        if (!holds(&x, v, with, expected)) continue;
        n++;
        least = fmin(least, differ(after, expected));
    }
    memset(expected, 0, sizeof expected);
    if (n == 0) least = differ(after, expected);
    CHECK(least < 1e-6 * slow);
    return n > 0 ? SLIPS : stops ? STOPS : DRIVEN;
}

int main(void)
{
    int count[3] = {0};
    for (int i = 0; i < 20000; i++) {
        const int how = held();
        if (how >= 0) count[how]++;
    }
    CHECK(count[SLIPS] > 500 && count[STOPS] > 100 && count[DRIVEN] > 100);
    return check_failures();
}
