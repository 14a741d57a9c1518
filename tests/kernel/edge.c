/* Contacts with edges that end: gaps beside them, marks that fall off, circles that go round the corners and come back, what
 * passes under an edge; on every route that takes them. */
#include "elements/edge.h"

#include "check.h"
#include "elements/contact.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define CLOSE 1e-8
#define G 9.81

/* A horizontal edge of the ground from x = 0 to `length` at `height`; its free side is above. */
static int edge(scene *s, double height) { return scene_line(s, scene_point(s, PM_GROUND, 0, height), 0); }

/* ---- gaps ---- */
static void gaps(void)
{
    static const double radius[] = {0, 0.3};
    for (int k = 0; k < 2; k++) {
        const double r = radius[k], length = 2;
        scene *s = scene_create();
        const int b = scene_body(s, 1, 0.1, 0.5, 1, 0);
        scene_segment(s, scene_circle(s, scene_point(s, b, 0, 0), r),
                      scene_line(s, scene_point(s, PM_GROUND, 0, 0), 0), 0, length, 0, PM_FRICTION_SMOOTH, 0);
        scene_until_time(s, 1);
        CHECK(scene_begin(s) == PM_OK);
        pm_workspace *w = s->w;
        for (int n = 0; n < 400; n++) {
            int member;
            double *q = w->state.q;
            q[0] = check_random(-1, length + 1);
            q[1] = check_random(-1, 1);
            pm_frame_look_state(&w->frame, &w->state);
            const double gap = pm_edge_gap(&w->frame, 0, &member);
            const double o = fmax(-q[0], q[0] - length), corner = hypot(o, q[1]) - r;
            const int next = r == 0 || o <= 0 ? PM_SEGMENT_FACE : q[0] < 0 ? PM_SEGMENT_FROM : PM_SEGMENT_TO;
            EQUAL(member, next);
            NEAR(gap, o <= 0 ? fmax(q[1] - r, o) : q[1] < 0 ? fmin(corner, o) : corner, 1e-8);
            EQUAL(pm_edge_is_below(&w->frame, 0), q[1] < r);
            int touched;
            EQUAL(pm_contact_touches(&w->frame, &w->state, 0, &touched),
                  o <= 0 ? q[1] >= 0 && q[1] <= r : corner <= 0);
        }
        /* no jumps where nothing overlaps: round the ends and under them */
        double last = NAN;
        for (int n = 0; n <= 40000; n++) {
            const double phi = 2 * acos(-1.) * n / 40000;
            int member;
            w->state.q[0] = 0.7 * cos(phi);
            w->state.q[1] = 0.7 * sin(phi);
            pm_frame_look_state(&w->frame, &w->state);
            const double gap = pm_edge_gap(&w->frame, 0, &member);
            if (n > 0) NEAR(gap, last, 2e-4);
            last = gap;
        }
        scene_free(s);
    }
}

/* ---- off the end ---- */
/* A particle slides off a table and lands on the floor below. */
static void slides_off(int route)
{
    const double v = 2.3, h = 0.8, length = 1.1, x0 = 0.2;
    scene *s = scene_create();
    const int b = scene_body(s, 1.3, 0, x0, h, 0), g = scene_point(s, b, 0, 0),
              circle = scene_circle(s, g, 0);
    const int table = scene_segment(s, circle, edge(s, h), 0, length, 0.5, PM_FRICTION_SMOOTH, 0);
    const int floor =
        scene_contact(s, PM_CONTACT_LINE, circle, scene_floor(s, 0), 0, 0, PM_FRICTION_SMOOTH, 0);
    const int off = scene_on(s, PM_TRIGGER_OPEN, table), struck = scene_on(s, PM_TRIGGER_STRIKE, table);
    const int t_off = scene_ask_event(s, scene_read(s, scene_time(s)), off, 1, 0);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    const int t = scene_ask_measure(s, scene_time(s));
    const int strikes = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, struck));
    scene_start_velocity(s, g, v, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, floor), 1);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[t_off], (length - x0) / v, CLOSE);
    NEAR(s->out[t], (length - x0) / v + sqrt(2 * h / G), CLOSE);
    NEAR(s->out[x], length + v * sqrt(2 * h / G), CLOSE);
    EQUAL(s->out[strikes], 0);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9 && s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    scene_free(s);
}

/* The edge belongs to a body that runs away under the particle; its own axes are turned. */
static void edge_runs_away(int route)
{
    const double u = 1.7, length = 0.9, turned = 0.6;
    scene *s = scene_create();
    const int slab = scene_body(s, 3, 0.5, 0, 0, turned), b = scene_body(s, 1, 0, 0.1, 0, 0);
    const int line = scene_line(s, scene_point(s, slab, 0, 0), -turned);
    const int contact = scene_segment(s, scene_circle(s, scene_point(s, b, 0, 0), 0), line, -length / 2,
                                      length / 2, 0, PM_FRICTION_SMOOTH, 0);
    for (int i = 0; i < 2; i++) { /* guided on the floor */
        const int at = scene_point(s, slab, cos(-turned) * (i - 0.5), sin(-turned) * (i - 0.5));
        scene_joint(s, PM_JOINT_SLIDER, at, scene_floor(s, 0), 0);
    }
    scene_start_velocity(s, scene_point(s, slab, 0, 0), u, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_OPEN, contact), 1);
    const int t = scene_ask_measure(s, scene_time(s));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[t], (0.1 + length / 2) / u, CLOSE);
    scene_free(s);
}

/* Dropped beside the edge, on it, and exactly on its end. */
static void dropped(int route)
{
    static const double at[] = {-1e-3, 1e-3, 0, 1, 1 - 1e-3, 1 + 1e-3};
    for (int k = 0; k < 6; k++) {
        const double h = 0.4, from = 1.3;
        scene *s = scene_create();
        const int b = scene_body(s, 1, 0, at[k], from, 0), g = scene_point(s, b, 0, 0),
                  c = scene_circle(s, g, 0);
        const int table = scene_segment(s, c, edge(s, h), 0, 1, 0, PM_FRICTION_SMOOTH, 0);
        const int floor =
            scene_contact(s, PM_CONTACT_LINE, c, scene_floor(s, 0), 0, 0, PM_FRICTION_SMOOTH, 0);
        const int end = scene_on(s, PM_TRIGGER_STRIKE, table);
        scene_trigger(s, PM_TRIGGER_STRIKE, end, PM_NONE, floor);
        scene_until(s, end, 1);
        const int t = scene_ask_measure(s, scene_time(s));
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        EQUAL(scene_run(s, NULL), PM_OK);
        const int misses = at[k] < 0 || at[k] > 1;
        NEAR(s->out[t], sqrt(2 * (from - (misses ? 0 : h)) / G), CLOSE);
        scene_free(s);
    }
}

/* ---- round the corner ---- */
typedef struct ball {
    scene *s;
    int body, g, contact;
    double r, m, i;
} ball;

static ball ball_at(double x, double y, double angle, int friction)
{
    ball f = {.s = scene_create(), .r = 0.25, .m = 1.4};
    f.i = 0.4 * f.m * f.r * f.r;
    f.body = scene_body(f.s, f.m, f.i, x, y, angle);
    f.g = scene_point(f.s, f.body, 0, 0);
    f.contact = scene_segment(f.s, scene_circle(f.s, f.g, f.r), edge(f.s, 0), 0, 1, 0, friction, 0);
    return f;
}

/* Over the end with speed v: it leaves the corner where g cos phi = v'^2 / R, that is where
 * (3 + k) cos phi = 2 + (1 + k) v^2 / g R, k = I/mR^2 where it rolls, 0 where it is smooth; at once if v^2 > g R. */
static void goes_over(int route, int friction, double speed)
{
    ball f = ball_at(0.5, 0.25, 0, friction);
    scene *s = f.s;
    const double k = friction == PM_FRICTION_ROUGH ? 0.4 : 0, v = speed * sqrt(G * f.r);
    const int off = scene_on(s, PM_TRIGGER_OPEN, f.contact);
    const int stick = scene_on(s, PM_TRIGGER_STICK, f.contact);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, f.g, PM_PART_X)),
              y = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, f.g, PM_PART_Y));
    const int vx = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, f.g, PM_PART_X));
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, f.body));
    const int sticks = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, stick));
    scene_start_velocity(s, f.g, v, 0);
    scene_start_omega(s, f.body, friction == PM_FRICTION_ROUGH ? -v / f.r : 0);
    scene_until(s, off, 1);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    const double c = fmin(1, (2 + (1 + k) * speed * speed) / (3 + k)), phi = acos(c);
    NEAR(s->out[x], 1 + f.r * sin(phi), 1e-7);
    NEAR(s->out[y], f.r * c, 1e-7);
    const double u = c < 1 ? sqrt(G * f.r * c) : v;
    NEAR(s->out[vx], u * c, 1e-7);
    NEAR(s->out[omega], friction == PM_FRICTION_ROUGH ? -u / f.r : 0, 1e-6);
    EQUAL(s->out[sticks], 0);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9 && s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    scene_free(s);
}

/* From beside a corner up on to the face, with the same contact all the way; slip, friction and normal go on. */
static void comes_up(int route, int friction, int to)
{
    const double phi = 0.5, r = 0.25, side = to ? 1 : -1;
    ball f = ball_at((to ? 1 : 0) + side * r * sin(phi), r * cos(phi), 0, friction);
    scene *s = f.s;
    const double k = friction == PM_FRICTION_ROUGH ? 0.4 : 0, v0 = 0.9;
    const int opened = scene_on(s, PM_TRIGGER_OPEN, f.contact),
              struck = scene_on(s, PM_TRIGGER_STRIKE, f.contact);
    const int vx = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, f.g, PM_PART_X)),
              omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, f.body)),
              slip = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_SLIP, f.contact)),
              slip_before = scene_ask_extreme(
                  s, PM_ASK_MAX, scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_SLIP, f.contact)),
                  PM_NONE),
              opens = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, opened)),
              strikes = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, struck));
    scene_start_velocity(s, f.g, -side * v0 * cos(phi), v0 * sin(phi));
    scene_start_omega(s, f.body, friction == PM_FRICTION_ROUGH ? side * v0 / r : 0);
    scene_until(s,
                scene_when(s, PM_TRIGGER_CROSS,
                           SCENE_PROGRAM(s, scene_m(scene_part(s, PM_MEASURE_POSITION, f.g, PM_PART_X)),
                                         scene_k(s, 0.5), scene_op(PM_OP_SUB))),
                1);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    const double v = sqrt(v0 * v0 - 2 * G * r * (1 - cos(phi)) / (1 + k));
    NEAR(s->out[vx], -side * v, 1e-7);
    NEAR(s->out[omega], friction == PM_FRICTION_ROUGH ? side * v / r : 0, 1e-6);
    NEAR(s->out[slip], friction == PM_FRICTION_ROUGH ? 0 : -side * v, 1e-7);
    if (friction == PM_FRICTION_SMOOTH) NEAR(s->out[slip_before], to ? -v : v0, 1e-7);
    EQUAL(s->out[opens], 0);
    EQUAL(s->out[strikes], 0);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9 && s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    scene_free(s);
}

/* Sliding friction turns with the tangent: over the corner at mu and slip, against a run on a corner alone from there. */
static void slides_over(int route)
{
    double spin[2];
    for (int k = 0; k < 2; k++) {
        const double r = 0.25, v = 1.2, mu = 0.3, t1 = 0.1;
        scene *s = scene_create();
        const double x1 = v * t1 - 0.5 * mu * G * t1 * t1, v1 = v - mu * G * t1, w1 = mu * G * t1 / (0.4 * r);
        const int b = scene_body(s, 1, 0.4 * r * r, k ? 1 : 1 - x1, r, 0), g = scene_point(s, b, 0, 0);
        const int c = scene_circle(s, g, r);
        const int contact =
            k ? scene_contact(s, PM_CONTACT_CIRCLE, c, scene_circle(s, scene_point(s, PM_GROUND, 1, 0), 0), 1,
                              0, PM_FRICTION_COULOMB, mu)
              : scene_segment(s, c, edge(s, 0), 0, 1, 0, PM_FRICTION_COULOMB, mu);
        scene_start_velocity(s, g, k ? v1 : v, 0);
        scene_start_omega(s, b, k ? -w1 : 0);
        const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
        scene_until(s, scene_on(s, PM_TRIGGER_OPEN, contact), 1);
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        EQUAL(scene_run(s, NULL), PM_OK);
        spin[k] = s->out[omega];
        CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9 && s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
        scene_free(s);
    }
    NEAR(spin[0], spin[1], 1e-7);
}

/* ---- edges that meet ---- */
/* Round a square of four edges, drawn to its centre by a spring: over every corner from edge to edge, without a blow, and
 * with the first speed again in the middle of each edge. */
static void round_a_square(int route, int friction, double way)
{
    const double h = 0.4, r = 0.1,
                 v = friction == PM_FRICTION_ROUGH ? 2.4 : 2.85; /* gets over, and stays on */
    static const double turn[] = {0, 1, 2, 3};
    scene *s = scene_create();
    const double i = 0.4 * r * r, quarter = acos(0.);
    const int b = scene_body(s, 1, i, 0, h + r, 0), g = scene_point(s, b, 0, 0), c = scene_circle(s, g, r);
    const int strike = scene_event(s), open = scene_event(s);
    for (int k = 0; k < 4; k++) {
        const double angle = -turn[k] * quarter;
        const int at = scene_point(s, PM_GROUND, -h * sin(angle), h * cos(angle));
        const int edge = scene_segment(s, c, scene_line(s, at, angle), -h, h, 0.5, friction, 0);
        scene_trigger(s, PM_TRIGGER_STRIKE, strike, PM_NONE, edge);
        scene_trigger(s, PM_TRIGGER_OPEN, open, PM_NONE, edge);
    }
    scene_force(s, PM_FORCE_SPRING, g, scene_point(s, PM_GROUND, 0, 0), 40, 0);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    scene_start_velocity(s, g, way * v, 0);
    scene_start_omega(s, b, friction == PM_FRICTION_ROUGH ? -way * v / r : 0);
    const int x = scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X),
              y = scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y);
    /* through the middle of the last edge, upwards, that is on the left or on the right */
    const int program =
        SCENE_PROGRAM(s, scene_m(y), scene_m(x), scene_k(s, 0), scene_op(PM_OP_MUL), scene_op(PM_OP_ADD));
    const int end = scene_when(s, PM_TRIGGER_RISE, program);
    const int vx = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X)),
              vy = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y)),
              at = scene_ask_measure(s, x),
              strikes = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, strike)),
              opens = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, open));
    scene_until(s, end, 1);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[vx], 0, 1e-7);
    NEAR(s->out[vy], v, 1e-7);
    NEAR(s->out[at], -way * (h + r), 1e-8);
    EQUAL(s->out[strikes], 0);
    EQUAL(s->out[opens], 3); /* one edge hands it to the next */
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-8 && s->audit[PM_AUDIT_MOMENTUM] < 1e-8);
    scene_free(s);
}

/* Two edges in one line: neither a circle nor a point notices where one ends. */
static void over_a_joint(int route, double radius, int friction, double mu)
{
    const double v = 3;
    double out[2][3];
    for (int edges = 1; edges <= 2; edges++) {
        scene *s = scene_create();
        const double i = radius > 0 ? 0.4 * radius * radius : 0;
        const int b = scene_body(s, 1, i, -0.5, radius, 0), g = scene_point(s, b, 0, 0),
                  c = scene_circle(s, g, radius);
        const int strike = scene_event(s);
        for (int k = 0; k < edges; k++) {
            const int line = scene_line(s, scene_point(s, PM_GROUND, -1, 0), 0);
            const int edge =
                scene_segment(s, c, line, edges == 1 ? 0 : k, edges == 1 ? 2 : 1 + k, 0, friction, mu);
            scene_trigger(s, PM_TRIGGER_STRIKE, strike, PM_NONE, edge);
        }
        scene_start_velocity(s, g, v, 0);
        if (friction == PM_FRICTION_ROUGH) scene_start_omega(s, b, -v / radius);
        const int x = scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X);
        scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, x, 0.5)), 1);
        const int ask[] = {scene_ask_measure(s, scene_time(s)),
                           scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X)),
                           scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b))};
        const int strikes = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, strike));
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->out[strikes], 0);
        CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9 && s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
        for (int k = 0; k < 3; k++) out[edges - 1][k] = s->out[ask[k]];
        scene_free(s);
    }
    for (int k = 0; k < 3; k++) NEAR(out[1][k], out[0][k], 1e-8 * (1 + fabs(out[0][k])));
}

/* On a corner that two edges share a ball is struck once, as on the corner alone. */
static void shared_corner_strikes_once(void)
{
    double out[2][3];
    for (int k = 0; k < 2; k++) {
        const double r = 0.2, phi = 0.4;
        scene *s = scene_create();
        const int b = scene_body(s, 1, 0.4 * r * r, r * sin(phi), r * cos(phi), 0),
                  g = scene_point(s, b, 0, 0);
        const int c = scene_circle(s, g, r), corner = scene_point(s, PM_GROUND, 0, 0);
        if (k == 0) {
            scene_contact(s, PM_CONTACT_CIRCLE, c, scene_circle(s, corner, 0), 1, 0.6, PM_FRICTION_COULOMB,
                          0.2);
        } else {
            scene_segment(s, c, scene_line(s, corner, 0), -1, 0, 0.6, PM_FRICTION_COULOMB, 0.2);
            scene_segment(s, c, scene_line(s, corner, -acos(0.)), 0, 1, 0.6, PM_FRICTION_COULOMB, 0.2);
        }
        scene_start_velocity(s, g, 0.3, -2);
        scene_until_time(s, 0.01);
        const int ask[] = {scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X)),
                           scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y)),
                           scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b))};
        EQUAL(scene_run(s, NULL), PM_OK);
        EQUAL(s->count[PM_COUNT_JUMPS], 1);
        for (int i = 0; i < 3; i++) out[k][i] = s->out[ask[i]];
        scene_free(s);
    }
    for (int i = 0; i < 3; i++) NEAR(out[1][i], out[0][i], 1e-12);
}

/* ---- from below ---- */
/* A ball thrown up through an edge from its back passes; falling it is held.  It goes under an end as well. */
static void from_below(int route, double x0, double vx)
{
    const double r = 0.1, h = 1, v = 6;
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.004, x0, 0.3, 0), g = scene_point(s, b, 0, 0);
    const int contact = scene_segment(s, scene_circle(s, g, r), edge(s, h), 0, 1, 0, PM_FRICTION_SMOOTH, 0);
    const int struck = scene_on(s, PM_TRIGGER_STRIKE, contact);
    scene_start_velocity(s, g, vx, v);
    scene_until(s, struck, 1);
    const int t = scene_ask_measure(s, scene_time(s)),
              y = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[t], (v + sqrt(v * v - 2 * G * (h + r - 0.3))) / G, CLOSE);
    NEAR(s->out[y], h + r, CLOSE);
    CHECK(s->count[PM_COUNT_EVENTS] < 12);
    scene_free(s);
}

static void overlap_is_told(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.004, 0.5, 0.05, 0);
    scene_segment(s, scene_circle(s, scene_point(s, b, 0, 0), 0.1), edge(s, 0), 0, 1, 0, PM_FRICTION_SMOOTH,
                  0);
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_PENETRATION);
    scene_free(s);
}

static void ends_in_order(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.004, 0.5, 1, 0);
    scene_segment(s, scene_circle(s, scene_point(s, b, 0, 0), 0.1), edge(s, 0), 1, 0, 0, PM_FRICTION_SMOOTH,
                  0);
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_BAD_VALUE);
    scene_free(s);
}

/* ---- with constant accelerations ---- */
enum { EDGES = 4, THROWS = 200 };

/* A ball, or a point, thrown among edges that lie anyhow. */
typedef struct throw
{
    double at[2], velocity[2], radius, restitution;
    double edge[EDGES][4]; /* x, y, angle, length */
}
throw;

static throw any_throw(int k)
{
    throw x = {.at = {0, 0}, .radius = k % 2 ? 0.1 : 0, .restitution = check_random(0.5, 1)};
    const double speed = check_random(1, 6), angle = check_random(0, 6.28);
    x.velocity[0] = speed * cos(angle);
    x.velocity[1] = speed * sin(angle);
    for (int i = 0; i < EDGES; i++) {
        const double phi = check_random(0, 6.28), far = check_random(0.3, 1.2);
        x.edge[i][0] = far * cos(phi);
        x.edge[i][1] = far * sin(phi);
        x.edge[i][2] = phi + 1.57 + check_random(-0.5, 0.5); /* its free side looks at the start, mostly */
        x.edge[i][3] = check_random(0.2, 0.9);
    }
    return x;
}

static scene *thrown(const throw *x, int route)
{
    scene *s = scene_create();
    const int ball = scene_body(s, 1, 0.004, x->at[0], x->at[1], 0), g = scene_point(s, ball, 0, 0);
    const int circle = scene_circle(s, g, x->radius), event = scene_event(s);
    for (int i = 0; i < EDGES; i++) {
        const double *e = x->edge[i];
        const int line = scene_line(s, scene_point(s, PM_GROUND, e[0], e[1]), e[2]);
        const int contact =
            scene_segment(s, circle, line, -e[3] / 2, e[3] / 2, x->restitution, PM_FRICTION_SMOOTH, 0);
        scene_trigger(s, PM_TRIGGER_STRIKE, event, PM_NONE, contact);
    }
    scene_start_velocity(s, g, x->velocity[0], x->velocity[1]);
    scene_until_time(s, 0.7);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, event));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_NORM));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    return s;
}

/* The polynomials of the route uniform find what rk finds step by step. */
static void edges_among_which_something_flies(void)
{
    int strikes = 0, uniform = 0;
    for (int k = 0; k < THROWS; k++) {
        const throw x = any_throw(k);
        scene *s = thrown(&x, PM_ROUTE_AUTO), *stepped = thrown(&x, PM_ROUTE_RK);
        const int status = scene_run(stepped, NULL);
        EQUAL(scene_run(s, NULL), status);
        for (int i = 0; i < s->nout && status == PM_OK; i++) NEAR(s->out[i], stepped->out[i], 1e-7);
        if (status == PM_OK) strikes += (int)s->out[0];
        uniform += s->count[PM_COUNT_ROUTE] == PM_ROUTE_UNIFORM;
        scene_free(s);
        scene_free(stepped);
    }
    CHECK(strikes > THROWS / 2);
    CHECK(uniform > THROWS * 9 / 10);
}

/* A slab flies past below a ball, both in free fall: it is struck if it has come so far, and not yet too far. */
static void strikes_what_flies_past(int route)
{
    for (int k = 0; k < 3; k++) {
        const double length = 0.5, r = 0.1, down = 2, u = 3, t = (1 - r) / down;
        const double from = k == 0 ? -u * t : k == 1 ? -u * t - 0.6 * length : -u * t + 0.6 * length;
        scene *s = scene_create();
        const int slab = scene_body(s, 3, 0.5, from, 0, 0), ball = scene_body(s, 1, 0.004, 0, 1, 0);
        const int contact = scene_segment(s, scene_circle(s, scene_point(s, ball, 0, 0), r),
                                          scene_line(s, scene_point(s, slab, 0, 0), 0), -length / 2,
                                          length / 2, 1, PM_FRICTION_SMOOTH, 0);
        const int strike = scene_on(s, PM_TRIGGER_STRIKE, contact);
        scene_start_velocity(s, scene_point(s, slab, 0, 0), u, 0);
        scene_start_velocity(s, scene_point(s, ball, 0, 0), 0, -down);
        scene_until(s, strike, 1);
        scene_trigger(s, PM_TRIGGER_RISE, strike, scene_minus(s, scene_time(s), 1.2 * t), PM_NONE);
        const int time = scene_ask_measure(s, scene_time(s));
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        EQUAL(scene_run(s, NULL), PM_OK);
        if (k == 0) NEAR(s->out[time], t, CLOSE);
        if (k > 0) CHECK(fabs(s->out[time] - t) > 1e-3); /* the corner, or nothing */
        scene_free(s);
    }
}

/* A block on two points slides down an incline that ends, with friction, until the first of them is at its end. */
static void block_comes_to_the_end(int route)
{
    const double angle = 0.5, mu = 0.3, length = 1.3, half = 0.2, high = 0.05;
    scene *s = scene_create();
    const double t[2] = {cos(angle), sin(angle)}, n[2] = {-sin(angle), cos(angle)};
    const double from = 1.0; /* of its middle, from the lower end */
    const int b = scene_body(s, 2, 0.3, from * t[0] + high * n[0], from * t[1] + high * n[1], angle);
    const int line = scene_line(s, scene_point(s, PM_GROUND, 0, 0), angle);
    int contact[2];
    for (int i = 0; i < 2; i++)
        contact[i] = scene_segment(s, scene_circle(s, scene_point(s, b, i ? half : -half, -high), 0), line, 0,
                                   length, 0, PM_FRICTION_COULOMB, mu);
    scene_until(s, scene_on(s, PM_TRIGGER_OPEN, contact[0]), 1);
    const int time = scene_ask_measure(s, scene_time(s));
    const int v =
        scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, scene_point(s, b, 0, 0), PM_PART_NORM));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    const double a = G * (sin(angle) - mu * cos(angle)), way = from - half;
    NEAR(s->out[time], sqrt(2 * way / a), CLOSE);
    NEAR(s->out[v], sqrt(2 * way * a), CLOSE);
    scene_free(s);
}

/* Slower and slower up to just before the end, and back. */
static void turns_back_before_the_end(int route)
{
    for (int over = 0; over < 2; over++) {
        scene *s = scene_create();
        const double a = 3, length = 1.5, v = sqrt(2 * a * length) * (over ? 1 + 1e-6 : 1 - 1e-6);
        const int b = scene_body(s, 1, 0, 0, 0, 0), g = scene_point(s, b, 0, 0);
        const int table =
            scene_segment(s, scene_circle(s, g, 0), edge(s, 0), -1, length, 0, PM_FRICTION_SMOOTH, 0);
        scene_applied(s, g, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, -a)), SCENE_PROGRAM(s, scene_k(s, 0)));
        scene_start_velocity(s, g, v, 0);
        const int off = scene_on(s, PM_TRIGGER_OPEN, table);
        scene_until(s, off, 1);
        const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[x], over ? length : -1, CLOSE);
        scene_free(s);
    }
}

/* ---- corners that meet ---- */
/* A box slides on the top of the ground, whose right face ends there; both have contacts with the corners of the other. */
static scene *box_on_a_ledge(double x, double speed, double mu, int side, int contact[4])
{
    const double w = 1, h = 0.2;
    const int friction = mu > 0 ? PM_FRICTION_COULOMB : PM_FRICTION_SMOOTH;
    scene *s = scene_create();
    const int b = scene_body(s, 1, (w * w + h * h) / 12, side * x, h / 2, 0),
              corner = scene_point(s, PM_GROUND, 0, 0);
    const int top = scene_line(s, corner, 0),
              face = scene_line(s, corner, side > 0 ? -acos(0.) : acos(0.) + acos(-1.));
    const int bottom = scene_line(s, scene_point(s, b, 0, -h / 2), acos(-1.));
    const int right = scene_circle(s, scene_point(s, b, side * w / 2, -h / 2), 0),
              left = scene_circle(s, scene_point(s, b, -side * w / 2, -h / 2), 0);
    const double from = side > 0 ? -5 : 0, to = side > 0 ? 0 : 5;
    contact[3] = scene_segment(s, right, face, side > 0 ? 0 : -1, side > 0 ? 1 : 0, 0, friction, mu);
    contact[0] = scene_segment(s, scene_circle(s, corner, 0), bottom, -w / 2, w / 2, 0, friction, mu);
    contact[1] = scene_segment(s, right, top, from, to, 0, friction, mu);
    contact[2] = scene_segment(s, left, top, from, to, 0, friction, mu);
    scene_start_velocity(s, scene_point(s, b, 0, 0), -side * speed, 0);
    return s;
}

/* Its hanging corner comes in over the end: nothing catches, and the face is not struck. */
static void corner_comes_in(int route, int side)
{
    int contact[4];
    scene *s = box_on_a_ledge(-0.2, 1, 0, side, contact);
    const int struck = scene_on(s, PM_TRIGGER_STRIKE, contact[3]);
    const int strikes = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, struck));
    const int x =
        scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, scene_point(s, 0, 0, 0), PM_PART_X));
    scene_until_time(s, 1.2);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[strikes], 0);
    NEAR(s->out[x], -side * (0.2 + 1.2), CLOSE);
    scene_free(s);
}

/* Where the corners are at one place two of the three contacts are one; a little later any two hold the box.  One is left out,
 * whatever their order is, and friction slows the box as if nothing else were there. */
static void corners_at_one_place(int side)
{
    int contact[4];
    scene *s = box_on_a_ledge(-0.5, 1, 0.3, side, contact);
    const int v =
        scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, scene_point(s, 0, 0, 0), PM_PART_X));
    scene_until_time(s, 0.2);
    if (CHECK(scene_begin(s) == PM_OK)) EQUAL(s->w->active.n, 2);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_RK;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[v], -side * (1 - 0.3 * G * 0.2), CLOSE);
    scene_free(s);
}

int main(void)
{
    for (int side = -1; side <= 1; side += 2) {
        corner_comes_in(PM_ROUTE_RK, side);
        corner_comes_in(PM_ROUTE_AUTO, side);
        corners_at_one_place(side);
    }
    static const int routes[] = {PM_ROUTE_RK, PM_ROUTE_IDA, PM_ROUTE_AUTO};
    gaps();
    for (int k = 0; k < 3; k++) {
        slides_off(routes[k]);
        edge_runs_away(routes[k]);
        dropped(routes[k]);
        goes_over(routes[k], PM_FRICTION_SMOOTH, 0.5);
        goes_over(routes[k], PM_FRICTION_ROUGH, 0.6);
        goes_over(routes[k], PM_FRICTION_SMOOTH, 1.2);
        for (int to = 0; to < 2; to++) {
            comes_up(routes[k], PM_FRICTION_SMOOTH, to);
            comes_up(routes[k], PM_FRICTION_ROUGH, to);
        }
        slides_over(routes[k]);
        for (int way = -1; way <= 1; way += 2) {
            round_a_square(routes[k], PM_FRICTION_SMOOTH, way);
            round_a_square(routes[k], PM_FRICTION_ROUGH, way);
        }
        over_a_joint(routes[k], 0, PM_FRICTION_SMOOTH, 0);
        over_a_joint(routes[k], 0, PM_FRICTION_COULOMB, 0.3);
        over_a_joint(routes[k], 0.1, PM_FRICTION_COULOMB, 0.3);
        over_a_joint(routes[k], 0.1, PM_FRICTION_ROUGH, 0);
        from_below(routes[k], 0.5, 0);
        from_below(routes[k], -0.2, 0.6);
        from_below(routes[k], -0.02, 0.7);
    }
    slides_off(PM_ROUTE_UNIFORM);
    dropped(PM_ROUTE_UNIFORM);
    edges_among_which_something_flies();
    for (int k = 0; k < 3; k++) {
        strikes_what_flies_past(routes[k]);
        block_comes_to_the_end(routes[k]);
        turns_back_before_the_end(routes[k]);
    }
    strikes_what_flies_past(PM_ROUTE_UNIFORM);
    block_comes_to_the_end(PM_ROUTE_UNIFORM);
    turns_back_before_the_end(PM_ROUTE_UNIFORM);
    goes_over(PM_ROUTE_PATH, PM_FRICTION_ROUGH, 0.6);
    comes_up(PM_ROUTE_PATH, PM_FRICTION_ROUGH, 0);
    shared_corner_strikes_once();
    overlap_is_told();
    ends_in_order();
    return check_failures();
}
