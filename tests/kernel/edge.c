/* Contacts with edges that end: gaps beside them, marks that fall off, what passes under an edge; on every route that takes
 * them. */
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
    const int strikes = scene_ask_count(s, struck);
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

/* It lies exactly on an end as the run begins, and slides outward; a wind blows it back, long before a step would end.  It has
 * fallen off then. */
static void begins_on_the_end(int route, int end, double v)
{
    const double wind = 500, h = 0.8, length = 1.1, out = end ? 1 : -1;
    scene *s = scene_create();
    const int b = scene_body(s, 1.3, 0, end ? length : 0, h, 0), g = scene_point(s, b, 0, 0),
              circle = scene_circle(s, g, 0);
    scene_segment(s, circle, edge(s, h), 0, length, 0.5, PM_FRICTION_SMOOTH, 0);
    const int floor =
        scene_contact(s, PM_CONTACT_LINE, circle, scene_floor(s, 0), 0, 0, PM_FRICTION_SMOOTH, 0);
    scene_set(s, PM_SETTING_GRAVITY_X, -out * wind);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    const int t = scene_ask_measure(s, scene_time(s));
    scene_start_velocity(s, g, out * v, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, floor), 1);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    const double falls = sqrt(2 * h / G);
    NEAR(s->out[t], falls, CLOSE);
    NEAR(s->out[x], (end ? length : 0) + out * (v * falls - 0.5 * wind * falls * falls), 1e-6);
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
    scene_ask_count(s, event);
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

int main(void)
{
    static const int routes[] = {PM_ROUTE_RK, PM_ROUTE_IDA, PM_ROUTE_AUTO};
    gaps();
    for (int k = 0; k < 3; k++) {
        slides_off(routes[k]);
        for (int end = 0; end < 2; end++)
            for (double v = 0.05; v < 1; v *= 4) begins_on_the_end(routes[k], end, v);
        edge_runs_away(routes[k]);
        dropped(routes[k]);
        from_below(routes[k], 0.5, 0);
        from_below(routes[k], -0.2, 0.6);
        from_below(routes[k], -0.02, 0.7);
    }
    slides_off(PM_ROUTE_UNIFORM);
    begins_on_the_end(PM_ROUTE_UNIFORM, 0, 0.05);
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
    overlap_is_told();
    ends_in_order();
    return check_failures();
}
