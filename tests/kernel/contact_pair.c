/* Contacts of two curves: flat followers, blows, corners, what has passed them, on every route. */
#include "check.h"
#include "curve_pair.h"
#include "elements/contact.h"
#include "equations/active_set.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define CLOSE 1e-8
#define G 9.81

static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};

/* ---- a line without ends ---- */
/* Through the origin of the body along its x axis: free above. */
static int line(scene *s, int body, int closing)
{
    const scene_code place = scene_m(scene_measure(s, PM_MEASURE_PLACE, PM_NONE));
    return SCENE_ROW(s, PM_TABLE_CURVE, scene_point(s, body, 0, 0), SCENE_PROGRAM(s, place),
                     SCENE_PROGRAM(s, scene_k(s, 0)), scene_value(s, -50), scene_value(s, 50), closing, 1,
                     PM_NONE);
}

/* An ellipse beside it, wherever it is and however deep in: its gap is the distance of its centre less how far it reaches. */
static void beside_a_line(int moving)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.1, 0, 3, 0), plank = moving ? scene_body(s, 1, 0.1, 0, 0, 0) : PM_GROUND;
    touch(s, line(s, plank, PM_CURVE_ENDLESS), ring(s, b, 0, 1.1, 0.6, 0), 0, PM_FRICTION_SMOOTH);
    ring(s, PM_GROUND, 0, 1e3, 1e3, 0);
    scene_until_time(s, 1);
    CHECK(scene_begin(s) == PM_OK);
    pm_workspace *w = s->w;
    CHECK(w->numbers.size < 4); /* neither the line nor a road makes the scene large */
    for (int n = 0; n < 300; n++) {
        int member;
        const double far = n % 3 == 0 ? 1e3 : 2, high = check_random(-0.5, 3), a = check_random(-7, 7),
                     turned = moving ? check_random(-7, 7) : 0, along = check_random(-far, far);
        w->state.q[0] = cos(turned) * along - sin(turned) * high;
        w->state.q[1] = sin(turned) * along + cos(turned) * high;
        w->state.q[2] = a + turned;
        if (moving) w->state.q[5] = turned;
        pm_frame_look_state(&w->frame, &w->state);
        const double gap = high - hypot(1.1 * sin(a), 0.6 * cos(a));
        NEAR(pm_contact_gap(&w->frame, &w->state, 0, &member), gap, 1e-12 * far);
        EQUAL(pm_contact_touches(&w->frame, &w->state, 0, &member), gap < 0);
    }
    scene_free(s);
}

/* An elliptic wheel that rolls far along it, by a joint and by a contact: L along the rim = way on the line. */
static void rolls_far(int route, int joint)
{
    const double a = 0.4, b = 0.3, spin = 9;
    scene *s = scene_create();
    const int wheel = scene_body(s, 1, 0.1, 0, b, 0), g = scene_point(s, wheel, 0, 0);
    const int road = line(s, PM_GROUND, PM_CURVE_ENDLESS), rim = ring(s, wheel, 0, a, b, 0);
    if (joint)
        scene_joint(s, PM_JOINT_ROLLING_CURVES, road, rim, 0);
    else
        touch(s, road, rim, 0, PM_FRICTION_ROUGH);
    scene_start_omega(s, wheel, -spin);
    const int turned = scene_minus(s, scene_measure(s, PM_MEASURE_TURNED, wheel), -3 * TWO_PI);
    scene_until(s, scene_when(s, PM_TRIGGER_FALL, turned), 1);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X)),
              y = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y)),
              omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, wheel));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    double rim_length = 0; /* the trapezoidal rule is exact for what is periodic */
    for (int i = 0; i < 1000; i++)
        rim_length += hypot(a * sin(TWO_PI * i / 1000), b * cos(TWO_PI * i / 1000)) * TWO_PI / 1000;
    NEAR(s->out[x], 3 * rim_length, 1e-6);
    NEAR(s->out[y], b, CLOSE);
    NEAR(s->out[omega], -spin, 1e-6);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-8);
    scene_free(s);
}

/* A curve that bends has ends, and of two that touch the line is the first. */
static void must_be_straight(void)
{
    for (int second = 0; second < 2; second++) {
        scene *s = scene_create();
        const int b = scene_body(s, 1, 0.1, 0, 3, 0), rim = ring(s, b, 0, 1, 1, 0),
                  road = second ? line(s, PM_GROUND, PM_CURVE_ENDLESS) : ring(s, PM_GROUND, 0, 1, 1, 0);
        s->cell[PM_TABLE_CURVE][road * PM_CURVE_COLUMNS + PM_CURVE_CLOSED] = PM_CURVE_ENDLESS;
        touch(s, second ? rim : road, second ? road : rim, 0, PM_FRICTION_SMOOTH);
        scene_until_time(s, 1);
        EQUAL(scene_run(s, NULL), PM_BAD_VALUE);
        scene_free(s);
    }
}

/* ---- a flat follower on an eccentric disk ---- */
/* y = r + e sin a over the shaft, from below up; the disk turns at a rate. */
static int follower(scene *s, double r, double e, double rate, double high, double restitution, int friction)
{
    const int cam = scene_body(s, 1, 1, 0, 0, 0), part = scene_body(s, 1, 1, 0, high, 0),
              axle = scene_point(s, PM_GROUND, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, cam, 0, 0), axle, 0);
    scene_drive(s, PM_JOINT_ANGLE, cam, PM_GROUND,
                SCENE_PROGRAM(s, scene_m(scene_time(s)), scene_k(s, rate), scene_op(PM_OP_MUL)), PM_NONE);
    scene_joint(s, PM_JOINT_SLIDER_FIXED, scene_point(s, part, 0, 0), scene_line(s, axle, TWO_PI / 4), 0);
    return touch(s, bottom(s, part, 1, 0), ring(s, cam, e, r, r, 0), restitution, friction);
}

static void follows(int route, int friction)
{
    const double r = 0.3, e = 0.1, rate = 4, t = 1.1, a = rate * t;
    scene *s = scene_create();
    const int contact = follower(s, r, e, rate, r, 0, friction);
    scene_until_time(s, t);
    const int y = scene_ask_measure(s,
                                    scene_part(s, PM_MEASURE_POSITION, scene_point(s, 1, 0, 0), PM_PART_Y)),
              n = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, contact)),
              f = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_FRICTION, contact));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    const double normal = G - rate * rate * e * sin(a);
    NEAR(s->out[y], r + e * sin(a), CLOSE);
    NEAR(s->out[n], normal, 1e-6);
    NEAR(fabs(s->out[f]), friction == PM_FRICTION_COULOMB ? 0.3 * normal : 0, 1e-6);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9 && s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    scene_free(s);
}

/* A cam that turns to and fro, by sin 2 t, rubs on it both ways. */
static void rubs_both_ways(int route)
{
    double friction[2];
    for (int k = 0; k < 2; k++) {
        scene *s = scene_create();
        const int contact = follower(s, 0.3, 0.1, 0, 0.3, 0, PM_FRICTION_COULOMB);
        const scene_code t = scene_m(scene_time(s));
        s->cell[PM_TABLE_JOINT][PM_JOINT_COLUMNS + PM_JOINT_PROGRAM_X] =
            SCENE_PROGRAM(s, t, scene_k(s, 2), scene_op(PM_OP_MUL), scene_op(PM_OP_SIN));
        scene_until_time(s, k ? 1.2 : 0.5);
        const int n = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, contact)),
                  f = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_FRICTION, contact));
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        EQUAL(scene_run(s, NULL), PM_OK);
        CHECK(s->out[n] > 1);
        NEAR(fabs(s->out[f]), 0.3 * s->out[n], 1e-9);
        friction[k] = s->out[f];
        scene_free(s);
    }
    CHECK(friction[0] * friction[1] < 0);
}

/* It falls on the disk at rest, and up again by e^2 of the height. */
static void bounces(int route)
{
    scene *s = scene_create();
    const int contact = follower(s, 0.3, 0.1, 0, 0.8, 0.6, PM_FRICTION_SMOOTH), g = scene_point(s, 1, 0, 0);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, contact), 2);
    const int t = scene_ask_measure(s, scene_time(s)),
              v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    const double fall = sqrt(2 * 0.5 / G);
    NEAR(s->out[t], fall * (1 + 2 * 0.6), CLOSE);
    NEAR(s->out[v], 0.6 * 0.6 * G * fall, 1e-7);
    scene_free(s);
}

/* ---- corners ---- */
/* An edge that rocks on a disk without slip, far enough to go over its corners and back, without a blow. */
static void rocks(int route, int swapped)
{
    const double r = 1, half = 0.3, thick = 0.05, spin = 4;
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.1, 0, r + thick, 0), g = scene_point(s, b, 0, 0);
    const int contact = touch_in_order(s, swapped, bottom(s, b, half, -thick), ring(s, PM_GROUND, 0, r, r, 0),
                                       0, PM_FRICTION_ROUGH);
    scene_start_velocity(s, g, -spin * thick, 0);
    scene_start_omega(s, b, spin);
    scene_until_time(s, 0.2);
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, b)),
              omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b)),
              closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, contact)),
              up = scene_ask_measure(
                  s, scene_measure_with(s, PM_MEASURE_CONTACT_FORCE, contact, PM_PART_Y, PM_MEASURE_ON, b)),
              opened = scene_ask_measure(
                  s, scene_measure(s, PM_MEASURE_EVENT_COUNT, scene_on(s, PM_TRIGGER_OPEN, contact))),
              on_first = scene_ask_measure(s, scene_part(s, PM_MEASURE_CONTACT_FORCE, contact, PM_PART_Y)),
              x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X)),
              y = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[closed], 1);
    EQUAL(s->out[opened], 0);
    CHECK(s->out[up] > 1);
    NEAR(s->out[on_first], swapped ? -s->out[up] : s->out[up], 1e-12);
    CHECK(s->out[angle] >
          half / r); /* it stands on its corner, which stays where it touched: at the angle half / r */
    const double at[2] = {-r * sin(half / r), r * cos(half / r)}, a = s->out[angle];
    NEAR(s->out[x], at[0] + half * cos(a) - thick * sin(a), CLOSE);
    NEAR(s->out[y], at[1] + half * sin(a) + thick * cos(a), CLOSE);
    const double inertia = 0.1 + half * half + thick * thick, w = s->out[omega];
    const double before = 0.5 * (0.1 + thick * thick) * spin * spin + G * (r + thick);
    NEAR(0.5 * inertia * w * w + G * s->out[y], before, 1e-7);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9 && s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    scene_free(s);
}

/* What touches and has come over its corner a little leaves nothing there to strike. */
static void passed(int swapped)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.1, 0.29, 1, 0);
    touch_in_order(s, swapped, bottom(s, b, 0.3, 0), ring(s, PM_GROUND, 0, 1, 1, 0), 0, PM_FRICTION_SMOOTH);
    scene_until_time(s, 1);
    CHECK(scene_begin(s) == PM_OK);
    pm_workspace *w = s->w;
    for (int closed = 0; closed < 2; closed++)
        for (int k = 0; k < 2; k++) {
            int member;
            w->state.q[0] = 0.29;
            w->state.slot[0].mode = PM_OPEN;
            pm_frame_look_state(&w->frame, &w->state);
            CHECK(pm_contact_touches(&w->frame, &w->state, 0, &member));
            w->state.slot[0] = (pm_slot){closed ? PM_SMOOTH : PM_OPEN, member};
            if (closed) pm_active_set_anchor(&w->frame, &w->state, 0);
            w->state.q[0] = k == 0 ? 0.29 : 0.301;
            pm_frame_look_state(&w->frame, &w->state);
            const double gap = pm_contact_gap(&w->frame, &w->state, 0, &member);
            if (closed)
                CHECK(isinf(gap));
            else
                NEAR(gap, k == 0 ? 0 : hypot(0.001, 1) - 1, 1e-12);
        }
    scene_free(s);
}

/* An edge that looks away is not touched from behind. */
static void from_behind(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.1, 0, -1.2, 0);
    touch(s, bottom(s, b, 0.3, 0), ring(s, PM_GROUND, 0, 1, 1, 0), 0, PM_FRICTION_SMOOTH);
    scene_until_time(s, 1);
    CHECK(scene_begin(s) == PM_OK);
    int member;
    CHECK(pm_contact_gap(&s->w->frame, &s->w->state, 0, &member) > 0.19);
    CHECK(!pm_contact_touches(&s->w->frame, &s->w->state, 0, &member));
    scene_free(s);
}

/* The end of an open curve high above the edge of a crate is not in it, though its foot is within: it goes round. */
static void ends_above(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.1, 0, 0.3, 0), loop = ring(s, PM_GROUND, 0, 2, 2, 0);
    s->cell[PM_TABLE_CURVE][loop * PM_CURVE_COLUMNS + PM_CURVE_CLOSED] = PM_CURVE_WITH_ENDS;
    s->cell[PM_TABLE_CURVE][loop * PM_CURVE_COLUMNS + PM_CURVE_SIDE] = 1;
    s->cell[PM_TABLE_CURVE][loop * PM_CURVE_COLUMNS + PM_CURVE_FROM] = scene_value(s, -1.8);
    s->cell[PM_TABLE_CURVE][loop * PM_CURVE_COLUMNS + PM_CURVE_TO] = scene_value(s, 1.45);
    touch(s, bottom(s, b, 0.3, -0.1), loop, 0, PM_FRICTION_SMOOTH);
    scene_until_time(s, 1);
    CHECK(scene_begin(s) == PM_OK);
    for (int n = 0; n < 40; n++) {
        int member;
        s->w->state.q[0] = check_random(0, 0.5);
        s->w->state.q[1] = check_random(-1.6, 0.5);
        pm_frame_look_state(&s->w->frame, &s->w->state);
        CHECK(pm_contact_gap(&s->w->frame, &s->w->state, 0, &member) > 0);
    }
    scene_free(s);
}

int main(void)
{
    for (int swapped = 0; swapped < 2; swapped++) passed(swapped);
    for (int k = 0; k < 3; k++) {
        follows(routes[k], PM_FRICTION_SMOOTH);
        follows(routes[k], PM_FRICTION_COULOMB);
        bounces(routes[k]);
        rubs_both_ways(routes[k]);
        rocks(routes[k], 0);
        rocks(routes[k], 1);
    }
    for (int joint = 0; joint < 2; joint++) {
        rolls_far(PM_ROUTE_AUTO, joint);
        rolls_far(PM_ROUTE_RK, joint);
    }
    beside_a_line(0);
    beside_a_line(1);
    must_be_straight();
    from_behind();
    ends_above();
    return check_failures();
}
