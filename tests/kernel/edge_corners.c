/* Corners of edges: circles that go round them and come back, edges that meet, corners that meet. */
#include "check.h"
#include "scene.h"

#define CLOSE 1e-8
#define G 9.81

/* A horizontal edge of the ground from x = 0 to `length` at `height`; its free side is above. */
static int edge(scene *s, double height) { return scene_line(s, scene_point(s, PM_GROUND, 0, height), 0); }

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
    const int sticks = scene_ask_count(s, stick);
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
              opens = scene_ask_count(s, opened), strikes = scene_ask_count(s, struck);
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
              at = scene_ask_measure(s, x), strikes = scene_ask_count(s, strike),
              opens = scene_ask_count(s, open);
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
        const int strikes = scene_ask_count(s, strike);
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
    const int strikes = scene_ask_count(s, struck);
    const int x =
        scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, scene_point(s, 0, 0, 0), PM_PART_X));
    scene_until_time(s, 1.2);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[strikes], 0);
    NEAR(s->out[x], -side * (0.2 + 1.2), CLOSE);
    scene_free(s);
}

/* A box flush with the right face, or over it by less than counts, falls: its upper corner passes the end of the top from before
 * it to behind it, and nothing is struck there. */
static void corner_goes_under(int route, int side)
{
    const double w = 0.2, h = 1, over = 1e-10 * check_random(0, 0.5), above = 0.05, speed = 1, time = 0.1;
    scene *s = scene_create();
    const int b = scene_body(s, 1, (w * w + h * h) / 12, side * (w / 2 - over), above - h / 2, 0);
    const int corner = scene_point(s, PM_GROUND, 0, 0);
    const int top = scene_segment(s, scene_circle(s, scene_point(s, b, -side * w / 2, h / 2), 0),
                                  scene_line(s, corner, 0), side > 0 ? -1 : 0, side > 0 ? 0 : 1, 0,
                                  PM_FRICTION_SMOOTH, 0);
    const int flank = scene_line(s, scene_point(s, b, -side * w / 2, 0), side * acos(0.));
    scene_segment(s, scene_circle(s, corner, 0), flank, -h / 2, h / 2, 0, PM_FRICTION_SMOOTH, 0);
    const int strikes =
        scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, scene_on(s, PM_TRIGGER_STRIKE, top)));
    const int g = scene_point(s, b, 0, 0);
    const int y = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y));
    scene_start_velocity(s, g, 0, -speed);
    scene_until_time(s, time);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[strikes], 0);
    NEAR(s->out[y], above - h / 2 - speed * time - 0.5 * G * time * time, CLOSE);
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
        for (int n = 0; n < 10; n++) corner_goes_under(n % 2 ? PM_ROUTE_RK : PM_ROUTE_AUTO, side);
    }
    static const int routes[] = {PM_ROUTE_RK, PM_ROUTE_IDA, PM_ROUTE_AUTO};
    for (int k = 0; k < 3; k++) {
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
    }
    goes_over(PM_ROUTE_PATH, PM_FRICTION_ROUGH, 0.6);
    comes_up(PM_ROUTE_PATH, PM_FRICTION_ROUGH, 0);
    shared_corner_strikes_once();
    return check_failures();
}
