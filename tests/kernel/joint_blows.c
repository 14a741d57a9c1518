/* Joints that rub by their load in blows: closed forms of a sled on a rail and of a bar on a bearing; random problems, whose
 * solution obeys the laws that it was posed for. */
#include "impact/contact_problem_joints.h"
#include "numerics/dense.h"

#include "check.h"
#include "scene.h"

#define CLOSE 1e-11

/* ---- a sled on a rail, struck by smooth bodies ---- */
typedef struct blow {
    double mass, ball, mu, e, slip, angle,
        speed; /* of the sled, of what strikes, ...; against the contact's normal */
    int law, route;
} blow;

static int sled_of(scene *s, double mass, double mu, double slip, int *joint)
{
    const int line = scene_line(s, scene_point(s, PM_GROUND, 0, 0), 0);
    const int sled = scene_body(s, mass, 0, 0, 0, 0), p = scene_point(s, sled, 0, 0);
    *joint = scene_joint(s, PM_JOINT_SLIDER, p, line, 0);
    scene_force(s, PM_FORCE_FRICTION, *joint, *joint, 0, mu);
    scene_start_velocity(s, p, slip, 0);
    return p;
}

static int strike_with(scene *s, int on, double x, double mass, double angle, double speed, double e, int law)
{
    const double n[2] = {cos(angle), sin(angle)};
    const int ball = scene_body(s, mass, 1, x + 0.1 * n[0], 0.1 * n[1], 0),
              centre = scene_point(s, ball, 0, 0);
    scene_start_velocity(s, centre, -speed * n[0], -speed * n[1]);
    scene_start_omega(s, ball, 0);
    const int c = scene_contact(s, PM_CONTACT_CIRCLE, scene_circle(s, on, 0), scene_circle(s, centre, 0.1), 1,
                                e, PM_FRICTION_SMOOTH, 0);
    scene_cell(s, PM_TABLE_CONTACT, c, PM_CONTACT_LAW, law);
    return c;
}

/* Velocity of the sled after the blow, and the impulse of the joint on it. */
static double struck(const blow *x, double impulse[2])
{
    scene *s = scene_create();
    int joint;
    *scene_setting(s, PM_SETTING_ROUTE) = x->route;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int sled = sled_of(s, x->mass, x->mu, x->slip, &joint);
    const int c = strike_with(s, sled, 0, x->ball, x->angle, x->speed, x->e, x->law);
    const int v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, sled, PM_PART_X));
    const int hit = scene_on(s, PM_TRIGGER_STRIKE, c);
    int out[2];
    for (int k = 0; k < 2; k++)
        out[k] = scene_ask_event(
            s, scene_read(s, scene_part(s, PM_MEASURE_JOINT_IMPULSE, joint, k == 0 ? PM_PART_X : PM_PART_Y)),
            hit, 1, 0);
    scene_until_time(s, 1e-6);
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int k = 0; k < 2; k++) impulse[k] = s->out[out[k]];
    const double found = s->out[v];
    scene_free(s);
    return found;
}

/* Newton's law, by hand: it slips with the rates of a slip to the right, then holds, or slips to the left. */
static double expected(const blow *x, double *rubbed)
{
    const double c = cos(x->angle), s = fabs(sin(x->angle)), end = x->e * (x->speed + x->slip * c);
    double u = -(x->speed + x->slip * c), v = x->slip, p = 0;
    *rubbed = 0;
    for (int stage = v > 0 ? 0 : 1; stage < 2; stage++) {
        const int slides = stage == 0 || c > x->mu * s;
        const double friction = !slides ? c : stage == 0 ? -x->mu * s : x->mu * s;
        const double a = (friction - c) / x->mass, rate = 1 / x->ball - c * a;
        const double all = (end - u) / rate, until = stage == 0 ? fmin(all, -v / a) : all;
        p += until;
        u += rate * until;
        v += a * until;
        *rubbed += friction * until;
        if (until == all) break;
        v = 0;
    }
    return v;
}

static void sleds(void)
{
    static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int i = 0; i < 36; i++) {
        blow x = {.mass = 2,
                  .ball = 0.8,
                  .mu = 0.1 + 0.4 * (i % 3),
                  .e = 0.3 * (i % 4),
                  .slip = i / 12 == 0   ? 5
                          : i / 12 == 1 ? 0.3
                                        : 0,
                  .angle = i % 2 ? 0.9 : 1.2,
                  .speed = 2,
                  .law = PM_LAW_NEWTON,
                  .route = routes[i % 3]};
        double impulse[2], rubbed;
        const double v = expected(&x, &rubbed);
        for (int below = 0; below < 2; below++) {
            if (below) x.angle = -x.angle;
            NEAR(struck(&x, impulse), v, 1e-10);
            NEAR(fabs(impulse[0]), fabs(rubbed), 1e-10);
            CHECK(impulse[1] * x.angle > 0); /* the rail bears it */
        }
    }
}

/* Two at once, without restitution: the sled stands after the blow, though it slipped before it. */
static void two_at_once(void)
{
    scene *s = scene_create();
    int joint;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_SIMULTANEOUS) = PM_SIMULTANEOUS_TOGETHER;
    const int sled = sled_of(s, 2, 0.6, 0.3, &joint);
    strike_with(s, sled, 0, 1, 1.0, 3, 0, PM_LAW_NEWTON);
    strike_with(s, sled, 0, 1, 2.0, 3, 0, PM_LAW_NEWTON);
    const int v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, sled, PM_PART_X));
    scene_until_time(s, 1e-6);
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(fabs(2 * 0.3 - 3 * (cos(1.0) + cos(2.0))) < 0.6 * 3 * (sin(1.0) + sin(2.0)));
    NEAR(s->out[v], 0, CLOSE);
    scene_free(s);
}

/* ---- a bar on a bearing ---- */
/* A body strikes a bar that turns on, at right angles: I dw = -P a - c |R|, R = m h dw + P. */
static void bar(double at)
{
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const double m = 3, h = 0.5, inertia = 1, c = 0.05, w = 8, e = 0.4, ball = 1, speed = 1;
    const int body = scene_body(s, m, inertia - m * h * h, h, 0, 0), ground = scene_point(s, PM_GROUND, 0, 0);
    const int pin = scene_joint(s, PM_JOINT_PIN, scene_point(s, body, -h, 0), ground, 0);
    scene_force(s, PM_FORCE_FRICTION, pin, pin, 0, c);
    scene_start_omega(s, body, w);
    strike_with(s, scene_point(s, body, at - h, 0), at, ball, 0.5 * 3.14159265358979323846, speed, e,
                PM_LAW_STRONGE);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, body));
    scene_until_time(s, 1e-9);
    EQUAL(scene_run(s, NULL), PM_OK);
    double rate = 0; /* dw of a unit impulse: both signs of R are tried, one is its own */
    for (int sign = -1; sign <= 1; sign += 2) {
        const double turn = (-at - sign * c) / (inertia + sign * c * m * h);
        if (sign * (m * h * turn + 1) > 0) rate = turn;
    }
    const double p = (1 + e) * (speed + w * at) / (1 / ball - rate * at);
    CHECK(w + rate * p > 0);
    NEAR(s->out[omega], w + rate * p, 1e-7);
    scene_free(s);
}

/* A ball comes to rest on a sled: the rail bears its weight and the sled's, in all blows together. */
static void bounces(int route)
{
    scene *s = scene_create();
    int joint;
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int line = scene_line(s, scene_point(s, PM_GROUND, 0, 0), 0);
    const int sled = scene_body(s, 2, 1, 0, 0, 0), p = scene_point(s, sled, 0, 0);
    joint = scene_joint(s, PM_JOINT_SLIDER_FIXED, p, line, 0);
    scene_force(s, PM_FORCE_FRICTION, joint, joint, 0, 0.1);
    scene_start_velocity(s, p, 5, 0);
    const int ball = scene_body(s, 1, 1, 0, 0.6, 0), centre = scene_point(s, ball, 0, 0);
    scene_start_velocity(s, centre, 0, 0);
    scene_start_omega(s, ball, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, centre, 0.1), scene_line(s, p, 0), 1, 0.6,
                  PM_FRICTION_SMOOTH, 0);
    const int v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_X));
    scene_until_time(s, 2);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[v], 5 - 0.1 * 1.5 * 9.81 * 2, 2e-6);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-10);
    scene_free(s);
}

/* ---- random problems ---- */
enum { CONTACTS = 2, JOINTS = 5, COORDINATES = 16, ALL = 2 * CONTACTS + JOINTS };
static pm_contact_problem contacts;
static pm_contact_problem_joints problem;

/* Directions d in coordinates of mass 1, held by h: W = d (1 - h^T (h h^T)^-1 h) d^T, L = -(h h^T)^-1 h d^T. */
static void any_problem(int n, int m, int nload)
{
    double d[ALL][COORDINATES], h[2 * JOINTS][COORDINATES], a[4 * JOINTS * JOINTS], x[2 * JOINTS];
    const int all = 2 * n + m, held = nload * m;
    int pivot[2 * JOINTS];
    for (int i = 0; i < all; i++)
        for (int k = 0; k < COORDINATES; k++) d[i][k] = check_random(-1, 1);
    for (int i = 0; i < held; i++)
        for (int k = 0; k < COORDINATES; k++) h[i][k] = check_random(-1, 1);
    contacts.n = n;
    problem.m = m;
    memset(problem.reaction, 0, sizeof(double) * 2 * m * all);
    for (int i = 0; i < all; i++) {
        for (int r = 0; r < held; r++) {
            x[r] = 0;
            for (int k = 0; k < COORDINATES; k++) x[r] -= h[r][k] * d[i][k];
            for (int c = 0; c < held; c++) {
                a[r * held + c] = 0;
                for (int k = 0; k < COORDINATES; k++) a[r * held + c] += h[r][k] * h[c][k];
            }
        }
        pm_dense_lu_factor(held, a, pivot);
        pm_dense_lu_solve(held, a, pivot, x);
        for (int r = 0; r < held; r++) problem.reaction[(2 * (r / nload) + r % nload) * all + i] = x[r];
        for (int j = 0; j < all; j++) {
            problem.response[j * all + i] = 0;
            for (int k = 0; k < COORDINATES; k++) {
                double v = d[i][k];
                for (int r = 0; r < held; r++) v += h[r][k] * x[r];
                problem.response[j * all + i] += d[j][k] * v;
            }
        }
    }
    for (int i = 0; i < n; i++) {
        contacts.contact[i] =
            (pm_contact_problem_contact){.friction = i % 2 ? PM_FRICTION_SMOOTH : PM_FRICTION_COULOMB,
                                         .hold = 0.2,
                                         .rub = 0.2,
                                         .prefers = PM_NONE};
        problem.bias[2 * i] = check_random(-1, 0.2);
        problem.bias[2 * i + 1] = check_random(-1, 1);
    }
    for (int k = 0; k < m; k++)
        problem.joint[k] =
            (pm_contact_problem_joint){.coefficient = check_random(0, 0.4),
                                       .nload = nload,
                                       .bias = check_random(-0.1, 0.1),
                                       .start = {check_random(-0.2, 0.2), nload > 1 ? 0.1 : 0}};
}

/* What was found obeys the laws, computed anew; how many joints hold. */
static int laws(int n, int m)
{
    const int all = 2 * n + m;
    double p[ALL], holds = 0;
    memcpy(p, contacts.load, sizeof(double) * 2 * n);
    for (int k = 0; k < m; k++) p[2 * n + k] = problem.joint[k].friction;
    for (int k = 0; k < all; k++) {
        double u = k < 2 * n ? problem.bias[k] : problem.joint[k - 2 * n].bias;
        for (int i = 0; i < all; i++) u += problem.response[k * all + i] * p[i];
        if (k < 2 * n) {
            if (k % 2 == 0) CHECK(u > -1e-9 && p[k] > -1e-9 && fabs(u * p[k]) < 1e-8);
            if (k % 2 == 1) CHECK(fabs(p[k]) <= (k == 1 ? 0.2 : 0) * p[k - 1] + 1e-9 && u * p[k] < 1e-8);
            continue;
        }
        const pm_contact_problem_joint *c = &problem.joint[k - 2 * n];
        double r[2] = {c->start[0], c->start[1]};
        for (int j = 0; j < 2; j++)
            for (int i = 0; i < all; i++) r[j] += problem.reaction[(2 * (k - 2 * n) + j) * all + i] * p[i];
        const double most = c->coefficient * hypot(r[0], r[1]);
        if (fabs(u) < 1e-9)
            CHECK(fabs(c->friction) <= most + 1e-9);
        else
            NEAR(c->friction, -copysign(most, u), 1e-8);
        holds += fabs(u) < 1e-9;
    }
    return holds;
}

static void problems(void)
{
    int found = 0, holds = 0, several = 0, none = 0;
    for (int i = 0; i < 3000; i++) {
        const int n = i % 3, m = 1 + i % JOINTS, nload = 1 + i / 7 % 2;
        any_problem(n, m, nload);
        const int motions = pm_contact_problem_joints_solve(&problem);
        several += motions > 1;
        none += motions == 0;
        if (motions == 0) continue;
        found++;
        holds += laws(n, m);
    }
    CHECK(found > 2800);
    CHECK(holds > 500);
    CHECK(several < 30);
    CHECK(none < 200);
}

int main(void)
{
    pm_arena arena = {0};
    if (pm_contact_problem_create(&contacts, &arena, CONTACTS) ||
        pm_contact_problem_joints_create(&problem, &arena, &contacts, CONTACTS, JOINTS))
        return 1;
    problems();
    sleds();
    two_at_once();
    bar(0.8);
    bar(0.3);
    bounces(PM_ROUTE_AUTO);
    bounces(PM_ROUTE_RK);
    pm_arena_free(&arena);
    return check_failures();
}
