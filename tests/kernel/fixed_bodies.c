/* Bodies that joints hold still for good: which they are, and that a run with them is that of the scene in which they are
 * ground - on every route in time, by blows, springs and sliding -, and that of the equations of motion of them all. */
#include "equations/fixed_bodies.h"

#include "check.h"
#include "scene.h"
#include "state/workspace.h"

#define SIDE 1.0 /* m: bars of a triangle on the ground */
#define HEIGHT 0.86602540378443865
#define TIME 2.0

/* ---- which ---- */
static int still_of(scene *s)
{
    static const double none = 0;
    pm_start_report report;
    EQUAL(scene_open(s), PM_OK);
    s->w->fixed->wanted = 1;
    pm_run_start(s->w, &none, &report); /* in a singular position it ends there */
    return s->w->fixed->n;
}

static void expect(scene *s, int n)
{
    scene_until_time(s, TIME);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_TOTAL, PM_NONE));
    EQUAL(still_of(s), n);
    scene_free(s);
}

static int pin(scene *s, int a, double xa, double ya, int b, double xb, double yb)
{
    return scene_joint(s, PM_JOINT_PIN, scene_point(s, a, xa, ya), scene_point(s, b, xb, yb), 0);
}

/* A bar from (x, y) by an angle; its ends are at -+l/2. */
static int bar(scene *s, double x, double y, double angle, double length)
{
    return scene_body(s, 2, length * length / 6, x + length / 2 * cos(angle), y + length / 2 * sin(angle),
                      angle);
}

/* Two bars from (x, 0) and (x + SIDE, 0) to their pin at (x + SIDE/2, HEIGHT); the first one. */
static int triangle(scene *s, double x)
{
    const double third = acos(0.5), h = SIDE / 2;
    const int a = bar(s, x, 0, third, SIDE), b = bar(s, x + h, HEIGHT, -third, SIDE);
    pin(s, a, -h, 0, PM_GROUND, x, 0);
    pin(s, b, h, 0, PM_GROUND, x + SIDE, 0);
    pin(s, a, h, 0, b, -h, 0);
    return a;
}

static void welded_bodies_stand_still(void)
{
    scene *s = scene_create();
    int before = PM_GROUND;
    for (int i = 0; i < 4; i++) {
        const int b = bar(s, i, 0, 0, 1);
        scene_joint(s, PM_JOINT_WELD, scene_point(s, before, before == PM_GROUND ? 0 : 0.5, 0),
                    scene_point(s, b, -0.5, 0), 0);
        before = b;
    }
    expect(s, 4);
}

static void what_hangs_on_them_moves(void)
{
    scene *s = scene_create();
    const int a = triangle(s, 0), rod = bar(s, SIDE / 2, HEIGHT, -0.4, 0.5);
    pin(s, a, SIDE / 2, 0, rod, -0.25, 0);
    expect(s, 2);
}

/* A bar more than needed, and triangles upon a triangle. */
static void triangles_stand_on_triangles(void)
{
    scene *s = scene_create();
    const double h = SIDE / 2;
    const int a = triangle(s, 0), c = bar(s, h, 0, acos(0), HEIGHT);
    pin(s, c, -HEIGHT / 2, 0, PM_GROUND, h, 0);
    pin(s, c, HEIGHT / 2, 0, a, h, 0);
    const int d = triangle(s, SIDE), e = bar(s, h, HEIGHT, 0.7, 1), f = bar(s, 3 * h, HEIGHT, acos(-0.2), 1);
    pin(s, e, -0.5, 0, a, h, 0);
    pin(s, f, -0.5, 0, d, h, 0);
    pin(s, e, 0.5, 0, f, 0.5, 0);
    scene_set(s, PM_SETTING_ASSEMBLY, 1);
    expect(s, 7);
}

/* A plate on three bars, which no pair of them holds; where their lines meet in a point it can turn about that. */
static void a_plate_on_three_bars(int meet)
{
    scene *s = scene_create();
    const int plate = scene_body(s, 3, 0.5, 0, 1, 0);
    const double foot[3] = {-1, meet ? 0 : 0.5, 1}, top[3] = {-0.5, 0, 0.5};
    for (int i = 0; i < 3; i++) {
        const double dx = top[i] - foot[i], length = hypot(dx, 1);
        const int b = bar(s, foot[i], 0, atan2(1, dx), length);
        pin(s, b, -length / 2, 0, PM_GROUND, foot[i], 0);
        pin(s, b, length / 2, 0, plate, top[i], 0);
    }
    expect(s, meet ? 0 : 4);
}

static void a_particle_on_two_links(void)
{
    scene *s = scene_create();
    const int p = scene_point(s, scene_body(s, 1, 0, 0, 0, 0), 0, 0);
    scene_joint(s, PM_JOINT_LINK, p, scene_point(s, PM_GROUND, 3, 4), 5);
    scene_joint(s, PM_JOINT_LINK, p, scene_point(s, PM_GROUND, -3, 4), 5);
    expect(s, 1);
}

static void mechanisms_move(void)
{
    scene *s = scene_create(); /* a parallelogram of three bars */
    const int a = bar(s, 0, 0, 1, 1), c = bar(s, 2, 0, 1, 1), b = bar(s, cos(1), sin(1), 0, 2);
    pin(s, a, -0.5, 0, PM_GROUND, 0, 0);
    pin(s, c, -0.5, 0, PM_GROUND, 2, 0);
    pin(s, a, 0.5, 0, b, -1, 0);
    pin(s, c, 0.5, 0, b, 1, 0);
    expect(s, 0);
    s = scene_create(); /* two bars in one line: the rows hold their joint only nearly */
    const int d = bar(s, 0, 0, 0, 1), e = bar(s, 1, 0, 0, 1);
    pin(s, d, -0.5, 0, PM_GROUND, 0, 0);
    pin(s, d, 0.5, 0, e, -0.5, 0);
    pin(s, e, 0.5, 0, PM_GROUND, 2, 0);
    expect(s, 0);
}

/* What the scene says alone: with fewer rows than freedoms no case is searched; as many may hold, or not. */
static void possible_or_not(void)
{
    for (int bars = 2; bars <= 3; bars++) {
        scene *s = scene_create();
        int before = PM_GROUND;
        for (int i = 0; i < bars; i++) {
            const int b = bar(s, i, 0, 0, 1);
            pin(s, b, -0.5, 0, before, before == PM_GROUND ? 0 : 0.5, 0);
            before = b;
        }
        pin(s, before, 0.5, 0, PM_GROUND, bars, 0);
        scene_until_time(s, TIME);
        scene_ask_measure(s, scene_measure(s, PM_MEASURE_TOTAL, PM_NONE));
        EQUAL(still_of(s), 0);
        EQUAL(s->w->fixed->possible, bars == 2);
        scene_free(s);
    }
}

enum reason { NOTHING, DRIVEN, REMOVED, ASKED, WATCHED, RUBS, PUSHED, TOUCHES, REASONS };

static void what_is_not_ground(void)
{
    for (int reason = NOTHING; reason < REASONS; reason++) {
        scene *s = scene_create();
        const int a = triangle(s, 0), joint = 2;
        const int force = scene_part(s, PM_MEASURE_JOINT_FORCE, joint, PM_PART_NORM);
        const int when = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, scene_time(s), 0.3));
        const int zero = SCENE_PROGRAM(s, scene_k(s, 0));
        triangle(s, 3 * SIDE);
        bar(s, -3, 0, 0, 1);
        switch (reason) {
        case DRIVEN: scene_drive(s, PM_JOINT_RATE, a, PM_GROUND, zero, PM_NONE); break;
        case REMOVED:
            SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_REMOVE, when, PM_TABLE_JOINT, joint, PM_NONE, PM_NONE);
            break;
        case ASKED: scene_ask_measure(s, force); break;
        case WATCHED: scene_when(s, PM_TRIGGER_RISE, scene_minus(s, force, 1)); break;
        case RUBS: scene_force(s, PM_FORCE_FRICTION, joint, joint, 0.1, 0); break;
        case PUSHED: SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_ANGULAR, when, PM_NONE, a, zero, PM_NONE); break;
        case TOUCHES:
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, a, 0, 0), 0.1),
                          scene_line(s, scene_point(s, PM_GROUND, 0, -1), 0), 0, 0, PM_FRICTION_SMOOTH, 0);
            break;
        default: break;
        }
        expect(s, reason == NOTHING ? 4 : 2);
    }
}

/* ---- a run ---- */
enum frame { BARS, GROUND, EQUATIONS };

/* A pendulum with a spring hangs from the top of a triangle, a ball strikes one of its bars and slides down on it. */
static scene *yard(int frame, int route)
{
    scene *s = scene_create();
    const double third = acos(0.5), h = SIDE / 2;
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int a = frame == GROUND ? PM_GROUND : triangle(s, 0);
    const double x = h, y = frame == GROUND ? HEIGHT : 0;
    const int rod = bar(s, h, HEIGHT, -2, 0.4), ball = scene_body(s, 0.5, 0.4 * 0.5 * 0.01, 0.2, 1.2, 0);
    const int top = scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.2, 0), scene_point(s, a, x, y), 0);
    const double middle[2] = {frame == GROUND ? h / 2 : 0, frame == GROUND ? HEIGHT / 2 : 0};
    const int at = scene_point(s, a, middle[0], middle[1]);
    scene_force(s, PM_FORCE_SPRING, at, scene_point(s, rod, 0.2, 0), 30, 0.3);
    const int strike = scene_on(
        s, PM_TRIGGER_STRIKE,
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, ball, 0, 0), 0.1),
                      scene_line(s, at, frame == GROUND ? third : 0), 0, 0.3, PM_FRICTION_COULOMB, 0.2));
    scene_until_time(s, 0.8);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, rod));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, ball));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, scene_point(s, ball, 0, 0), PM_PART_Y));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, top, PM_PART_NORM));
    scene_ask_event(s, scene_read(s, scene_measure(s, PM_MEASURE_KINETIC, PM_NONE)), strike, 1, 0);
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_measure(s, PM_MEASURE_KINETIC, PM_NONE)), PM_NONE);
    if (frame == EQUATIONS) /* of the apex: then the bars are no ground */
        scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 2, PM_PART_NORM));
    return s;
}

static void they_are_as_ground(int route, double tolerance)
{
    scene *bars = yard(BARS, route), *ground = yard(GROUND, route), *all = yard(EQUATIONS, route);
    EQUAL(still_of(bars), 2);
    EQUAL(still_of(all), 0);
    EQUAL(scene_run(bars, NULL), PM_OK);
    EQUAL(scene_run(ground, NULL), PM_OK);
    EQUAL(scene_run(all, NULL), PM_OK);
    CHECK(bars->out[0] != 0 && bars->out[1] != 0);
    for (int i = 0; i < ground->nout; i++) {
        NEAR(bars->out[i], ground->out[i], tolerance * fmax(1, fabs(ground->out[i])));
        NEAR(all->out[i], ground->out[i], tolerance * fmax(1, fabs(ground->out[i])));
    }
    for (int k = 0; k < PM_AUDITS; k++) CHECK(bars->audit[k] < 1e-6);
    scene_free(bars);
    scene_free(ground);
    scene_free(all);
}

/* What is asked of a body that stands still. */
static void they_can_be_asked(void)
{
    scene *s = scene_create();
    const int a = triangle(s, 0), rod = bar(s, -3, 0, 0, 1), end = scene_point(s, a, SIDE / 2, 0);
    scene_until_time(s, TIME);
    pin(s, rod, -0.5, 0, PM_GROUND, -3, 0);
    const int asked[] = {scene_part(s, PM_MEASURE_POSITION, end, PM_PART_Y),
                         scene_part(s, PM_MEASURE_VELOCITY, end, PM_PART_NORM),
                         scene_part(s, PM_MEASURE_ACCELERATION, end, PM_PART_NORM),
                         scene_measure(s, PM_MEASURE_ANGLE, a),
                         scene_measure(s, PM_MEASURE_INERTIA, a),
                         scene_measure(s, PM_MEASURE_MASS, a),
                         scene_measure(s, PM_MEASURE_TOTAL, PM_NONE)};
    const double known[] = {HEIGHT, 0, 0, acos(0.5), 1 / 6.0, 2, 9.81 * 2 * HEIGHT};
    for (int i = 0; i < 7; i++) scene_ask_measure(s, asked[i]);
    EQUAL(still_of(s), 2);
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int i = 0; i < 7; i++) NEAR(s->out[i], known[i], 1e-9);
    scene_free(s);
}

int main(void)
{
    welded_bodies_stand_still();
    what_hangs_on_them_moves();
    triangles_stand_on_triangles();
    a_plate_on_three_bars(0);
    a_plate_on_three_bars(1);
    a_particle_on_two_links();
    mechanisms_move();
    possible_or_not();
    what_is_not_ground();
    they_are_as_ground(PM_ROUTE_AUTO, 1e-8);
    they_are_as_ground(PM_ROUTE_RK, 1e-8);
    they_are_as_ground(PM_ROUTE_IDA, 1e-6);
    they_can_be_asked();
    return check_failures();
}
