/* Contacts that can never close: each bound of a gap is sharp - just out of reach a contact is dropped, just within it is
 * not -, and a run has the very bits of the run without the contacts that were dropped. */
#include "equations/gap_bounds.h"
#include "check.h"
#include "scene.h"
#include "state/workspace.h"

#define UPPER 1.0 /* m: rods of a double pendulum from the origin */
#define LOWER 0.4
#define R 0.1 /* of the circle at its tip */
#define CLOSE 1e-3
#define PI 3.14159265358979323846

typedef struct chain {
    scene *s;
    int end, tip; /* point, circle round it */
} chain;

/* A rod pinned at (x, y), drawn at an angle. */
static int rod(scene *s, double length, int at, double x, double y, double angle)
{
    const int b = scene_body(s, 1, 0.1, x + 0.5 * length * cos(angle), y + 0.5 * length * sin(angle), angle);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5 * length, 0), at, 0);
    return b;
}

static chain double_pendulum(void)
{
    scene *s = scene_create();
    const int upper = rod(s, UPPER, scene_point(s, PM_GROUND, 0, 0), 0, 0, 0);
    const int lower = rod(s, LOWER, scene_point(s, upper, 0.5 * UPPER, 0), UPPER, 0, 0.5 * PI);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, lower));
    const int end = scene_point(s, lower, 0.5 * LOWER, 0);
    return (chain){s, end, scene_circle(s, end, R)};
}

static int on_ground(scene *s, double x, double y, double radius)
{
    return scene_circle(s, scene_point(s, PM_GROUND, x, y), radius);
}

static int level(scene *s, int body, double y) { return scene_line(s, scene_point(s, body, 0, y), 0); }

enum obstacle {
    FLOOR,
    BALL,
    HOLE,
    HUB, /* the lower rod is too short for it */
    EDGE_AHEAD,
    EDGE_BELOW,
    PLATE, /* a line on a body that hangs */
    OTHER,
    WELDED,
    LINKED,
    WELDED_TWICE,
    POINT,
    OBSTACLES
};

/* What is `clear` farther away than it can be reached. */
static void obstacle(chain c, int kind, double clear)
{
    scene *s = c.s;
    const double far = UPPER + LOWER + R + clear, near = UPPER - LOWER - R - clear;
    switch (kind) {
    case FLOOR:
        scene_contact(s, PM_CONTACT_LINE, c.tip, level(s, PM_GROUND, -far), 0, 0, PM_FRICTION_SMOOTH, 0);
        return;
    case BALL:
        scene_contact(s, PM_CONTACT_CIRCLE, c.tip, on_ground(s, 0.6 * (far + 1), -0.8 * (far + 1), 1), 1, 0,
                      PM_FRICTION_SMOOTH, 0);
        return;
    case HOLE:
        scene_contact(s, PM_CONTACT_CIRCLE, c.tip, on_ground(s, 0, 0, far), -1, 0, PM_FRICTION_SMOOTH, 0);
        return;
    case HUB:
        scene_contact(s, PM_CONTACT_CIRCLE, c.tip, on_ground(s, 0, 0, near), 1, 0, PM_FRICTION_SMOOTH, 0);
        return;
    case EDGE_AHEAD:
        scene_segment(s, c.tip, level(s, PM_GROUND, 0), far, far + 3, 0, PM_FRICTION_SMOOTH, 0);
        return;
    case EDGE_BELOW:
        scene_segment(s, c.tip, level(s, PM_GROUND, -far), -1, 1, 0, PM_FRICTION_SMOOTH, 0);
        return;
    case PLATE: {
        const int plate = rod(s, 1, scene_point(s, PM_GROUND, 3, 0), 3, 0, 0);
        scene_contact(s, PM_CONTACT_LINE, c.tip, level(s, plate, -far - 3), 0, 0, PM_FRICTION_SMOOTH, 0);
        return;
    }
    case OTHER: {
        const int other = rod(s, 1, scene_point(s, PM_GROUND, -far - 1.2, 0), -far - 1.2, 0, PI);
        scene_contact(s, PM_CONTACT_CIRCLE, c.tip, scene_circle(s, scene_point(s, other, 0.5, 0), 0.2), 1, 0,
                      PM_FRICTION_SMOOTH, 0);
        return;
    }
    case WELDED:
    case WELDED_TWICE: {
        const int stand = scene_body(s, 1, 1, 4, -2, PI / 2), top = scene_body(s, 1, 1, 4, 0, 0);
        scene_joint(s, PM_JOINT_WELD, scene_point(s, stand, 0, 0), scene_point(s, PM_GROUND, 4, -2), PI / 2);
        scene_joint(s, PM_JOINT_WELD, scene_point(s, top, 0, -2), scene_point(s, stand, 0, 0), -PI / 2);
        const int line =
            kind == WELDED ? scene_line(s, scene_point(s, stand, 2 - far, 0), -PI / 2) : level(s, top, -far);
        scene_contact(s, PM_CONTACT_LINE, c.tip, line, 0, 0, PM_FRICTION_SMOOTH, 0);
        return;
    }
    case LINKED: {
        const int bob = scene_body(s, 1, 0.1, 0.3, -far - 1.1, 0), mark = scene_point(s, bob, -0.3, 0);
        scene_joint(s, PM_JOINT_LINK, mark, scene_point(s, PM_GROUND, 0, -far - 0.8), 0.3);
        scene_contact(s, PM_CONTACT_CIRCLE, c.tip, scene_circle(s, scene_point(s, bob, 0, 0), 0.2), 1, 0,
                      PM_FRICTION_SMOOTH, 0);
        return;
    }
    default:
        scene_capture(s, PM_CONTACT_POINT, scene_circle(s, c.end, 0), on_ground(s, 0, -far + R, 0), 0,
                      PM_CAPTURE_POINT);
    }
}

/* How many are dropped. */
static int out_of_reach(scene *s)
{
    EQUAL(scene_begin(s), PM_OK);
    return s->w->reach.ncontact;
}

static void bounds_are_sharp(void)
{
    for (int kind = 0; kind < OBSTACLES; kind++)
        for (int out = 0; out < 2; out++) {
            const chain c = double_pendulum();
            obstacle(c, kind, out ? CLOSE : -CLOSE);
            EQUAL(out_of_reach(c.s), out);
            scene_free(c.s);
        }
}

/* What may be let go, or is moved by something else than joints, is bounded by nothing. */
static void only_what_stays(void)
{
    for (int k = 0; k < 3; k++) {
        const chain c = double_pendulum();
        scene *s = c.s;
        obstacle(c, FLOOR, 5);
        const int event = scene_when(s, PM_TRIGGER_FALL, scene_minus(s, scene_time(s), -1));
        if (k == 1)
            SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_REMOVE, event, PM_TABLE_JOINT, 1, PM_NONE, PM_NONE);
        if (k == 2)
            SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_REMOVE, event, PM_TABLE_CONTACT, 0, PM_NONE, PM_NONE);
        EQUAL(out_of_reach(s), k == 0);
        scene_free(s);
    }
    scene *s = scene_create();
    const int free = scene_body(s, 1, 0.1, 0, 0, 0);
    scene_joint(s, PM_JOINT_SLIDER, scene_point(s, free, 0, 0), scene_floor(s, 0), 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, free, 0, 0), 0.1),
                  level(s, PM_GROUND, -9), 0, 0, PM_FRICTION_SMOOTH, 0);
    EQUAL(out_of_reach(s), 0);
    scene_free(s);
}

/* The same bits as without them. */
static void run_is_the_same(int route)
{
    scene *made[2];
    for (int k = 0; k < 2; k++) {
        const chain c = double_pendulum();
        if (k == 1) { /* lines: the scene keeps its size */
            obstacle(c, FLOOR, 0.2);
            obstacle(c, EDGE_AHEAD, 0.2);
            obstacle(c, EDGE_BELOW, 0.2);
        }
        *scene_setting(c.s, PM_SETTING_ROUTE) = route;
        scene_until_time(c.s, 2);
        EQUAL(scene_run(c.s, NULL), PM_OK);
        made[k] = c.s;
    }
    NEAR(made[0]->out[0], made[1]->out[0], 0);
    CHECK(made[0]->out[0] != 0);
    for (int k = 0; k < 2; k++) scene_free(made[k]);
}

int main(void)
{
    bounds_are_sharp();
    only_what_stays();
    run_is_the_same(PM_ROUTE_RK);
    run_is_the_same(PM_ROUTE_IDA);
    return check_failures();
}
