/* Modes that are tried: what stays where they do not stand, what is booked where they do, dead centres, modes in turn. */
#include "impact/contact_modes.h"

#include "check.h"
#include "elements/contact.h"
#include "equations/ledger.h"
#include "impact/instant.h"
#include "numerics/tolerances_impact.h"
#include "scene.h"

#define G 9.81
#define QUARTER 1.5707963267948966

/* ---- a bar between two walls, next to where it would lock ----
 *
 * End A is pushed to the left wall and sticks if it can; at the right one a belt runs upwards beside B, whose load N follows
 * from moments about A: N (sin + mu_B cos) l = W l cos/2.  A slip v of A is stopped by m v along the wall and by normal
 * impulses of m v/(2 tan) at either. */
typedef struct bar {
    double mass, length, angle, push, mu_a, mu_b;
} bar;

static scene *between_walls(const bar *x)
{
    scene *s = scene_create();
    const double reach = 0.5 * x->length, width = x->length * cos(x->angle);
    const int body =
        scene_body(s, x->mass, x->mass * x->length * x->length / 12, reach * cos(x->angle), 0, x->angle);
    const int end = scene_point(s, body, -reach, 0);
    const int a = scene_circle(s, end, 0), b = scene_circle(s, scene_point(s, body, reach, 0), 0);
    const int left = scene_floor(s, -QUARTER),
              right = scene_line(s, scene_point(s, PM_GROUND, width, 0), QUARTER);
    scene_contact(s, PM_CONTACT_LINE, a, left, 0, 0, PM_FRICTION_COULOMB, x->mu_a);
    const int belt = scene_contact(s, PM_CONTACT_LINE, b, right, 0, 0, PM_FRICTION_COULOMB, x->mu_b);
    scene_cell(s, PM_TABLE_CONTACT, belt, PM_CONTACT_SPEED, scene_value(s, 3));
    scene_applied(s, end, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, -x->push)), SCENE_PROGRAM(s, scene_k(s, 0)));
    scene_until_time(s, 1e-3);
    return s;
}

/* Lets end A slip by less than counts as slip, downwards, and looks for the modes; the slip that it had. */
static double slip_a_little(scene *s)
{
    pm_workspace *w = s->w;
    pm_frame_look_state(&w->frame, &w->state);
    const double slip = 0.6 * pm_contact_speed(&w->frame);
    w->state.slot[0].mode = PM_STICK;
    w->state.v[0] = w->state.v[2] = 0;
    w->state.v[1] = -slip;
    EQUAL(pm_contact_modes_begin(w), PM_OK);
    EQUAL(pm_contact_modes_settle(w), PM_OK);
    return slip;
}

/* Its impulses close the ledger of momentum, and no friction rides on them. */
static void a_stopped_slip_is_booked(double angle)
{
    const bar x = {2.3, 0.7, angle, 60, 0.6, 0.2};
    scene *s = between_walls(&x);
    EQUAL(scene_begin(s), PM_OK);
    pm_workspace *w = s->w;
    const double *z = w->state.z + pm_ledger_ledger(w->model), y = z[1], moment = z[2], pushed = z[0],
                 lost = w->ledger.energy_lost, told = w->impulses.energy_lost;
    const double slip = slip_a_little(s), momentum = x.mass * slip, arm = 0.5 * x.length * cos(angle);
    EQUAL(w->state.slot[0].mode, PM_STICK);
    CHECK(pm_contact_modes_slides(w->state.slot[1].mode));
    CHECK(fabs(w->state.v[1]) < 1e-6 * slip);
    NEAR(z[1] - y, momentum, 1e-6 * momentum);
    NEAR(z[0] - pushed, 0, 1e-6 * momentum / tan(angle));
    /* about the origin, of what comes to rest */
    NEAR(z[2] - moment, momentum * arm, 1e-6 * momentum * arm);
    NEAR(w->ledger.energy_lost - lost, 0.5 * momentum * slip, 1e-6 * momentum * slip);
    EQUAL(w->impulses.energy_lost, told);
    const double load = 0.5 * x.mass * G / (tan(angle) + x.mu_b);
    NEAR(w->frame.lambda[w->active.slot_normal[0]], x.push + load, 1e-6 * load);
    scene_free(s);
}

/* Without the push it falls.  Stick is tried and does not stand: nothing of it is left. */
static void a_slip_that_is_not_held_stays(double angle)
{
    const bar x = {2.3, 0.7, angle, 0, 0.1, 0.2};
    scene *s = between_walls(&x);
    EQUAL(scene_begin(s), PM_OK);
    pm_workspace *w = s->w;
    const double place = w->state.q[1] += 1e-8; /* off where end A would be held */
    const double slip = slip_a_little(s);
    CHECK(pm_contact_modes_slides(w->state.slot[0].mode));
    NEAR(w->state.v[1], -slip, 1e-6 * slip);
    NEAR(w->state.q[1], place, 1e-13);
    scene_free(s);
}

/* ---- a block that a blow should have stopped ---- */
/* It is pushed harder than friction holds.  A slip that is left is stopped where it is against the push, and booked without
 * friction; along the push it goes on. */
static void a_slip_against_its_mode_is_stopped(void)
{
    const double mass = check_random(0.5, 5), mu = check_random(0.1, 0.8),
                 way = check_random(-1, 1) > 0 ? 1 : -1;
    scene *s = scene_create();
    const int p = scene_point(s, scene_body(s, mass, 0, 0, 0, 0), 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0), scene_floor(s, 0), 0, 0, PM_FRICTION_COULOMB,
                  mu);
    scene_applied(s, p, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, way * check_random(1.1, 3) * mu * mass * G)),
                  SCENE_PROGRAM(s, scene_k(s, 0)));
    scene_until_time(s, 1);
    EQUAL(scene_begin(s), PM_OK);
    pm_workspace *w = s->w;
    const double *z = w->state.z + pm_ledger_ledger(w->model), x = z[0], told = w->impulses.energy_lost;
    pm_frame_look_state(&w->frame, &w->state);
    const double slip = check_random(-30, 30) * pm_contact_speed(&w->frame), left = slip * way < 0 ? 0 : slip;
    w->state.slot[0].mode = PM_STICK;
    w->state.v[0] = slip;
    EQUAL(pm_contact_modes_begin(w), PM_OK);
    EQUAL(pm_contact_modes_settle(w), PM_OK);
    EQUAL(w->state.slot[0].mode, way > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD);
    NEAR(w->state.v[0], left, 1e-9 * fabs(slip));
    NEAR(z[0] - x, mass * (left - slip), 1e-9 * mass * fabs(slip));
    NEAR(w->state.v[1], 0, 1e-9 * fabs(slip));
    EQUAL(w->impulses.energy_lost, told);
    CHECK(w->frame.a[0] * way > 0);
    scene_free(s);
}

/* ---- a slider-crank whose block rubs ---- */
typedef struct crank {
    double time, omega, end;
} crank;

typedef struct mechanism {
    double rod, mu, mass, omega, block, top; /* m, -, kg of crank and rod, rad/s, kg, rad */
    double behind;                           /* rad beyond its dead centre it is looked at */
} mechanism;

/* Crank 0.1 m; the block is on the guide by a joint that rubs by its load, or by a contact. */
static crank slider_crank(const mechanism *of, int as_contact, int route)
{
    const double r = 0.1, l = of->rod, mu = of->mu, mass = of->mass, top = of->top,
                 tilt = -asin(r * sin(top) / l);
    const double x = r * cos(top), y = r * sin(top), reach = l * cos(tilt);
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int a = scene_body(s, mass, mass * r * r / 12, 0.5 * x, 0.5 * y, top),
              b = scene_body(s, mass, mass * l * l / 12, x + 0.5 * reach, 0.5 * y, tilt),
              c = scene_body(s, of->block, 0, x + reach, 0, 0);
    const int block = scene_point(s, c, 0, 0), guide = scene_floor(s, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, PM_GROUND, 0, 0), scene_point(s, a, -0.5 * r, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, 0.5 * r, 0), scene_point(s, b, -0.5 * l, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, 0.5 * l, 0), block, 0);
    if (as_contact) {
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, block, 0), guide, 0, 0, PM_FRICTION_COULOMB, mu);
        scene_start(s, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, block, PM_PART_Y), 0);
    } else {
        const int slide = scene_joint(s, PM_JOINT_SLIDER, block, guide, 0);
        scene_force(s, PM_FORCE_FRICTION, slide, slide, 0, mu);
    }
    scene_start_omega(s, a, of->omega);
    const int angle = scene_measure(s, PM_MEASURE_ANGLE, a), omega = scene_measure(s, PM_MEASURE_OMEGA, a);
    const int dead = scene_when(s, PM_TRIGGER_RISE, scene_minus(s, angle, 2 * QUARTER + of->behind));
    const int at = scene_ask_event(s, scene_read(s, scene_time(s)), dead, 1, 0),
              speed = scene_ask_event(s, scene_read(s, omega), dead, 1, 0), end = scene_ask_measure(s, angle);
    scene_until(s, scene_on(s, PM_TRIGGER_REST, PM_NONE), 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    const crank found = {s->out[at], s->out[speed], s->out[end]};
    scene_free(s);
    return found;
}

/* Beside the equation of its one coordinate, integrated elsewhere; a joint and a contact alike. */
static void passes_its_dead_centre(int route)
{
    const double close = route == PM_ROUTE_IDA ? 1e-5 : 1e-8;
    const mechanism of = {0.3, 0.1, 0.1, 5, 5, 1.0471975511965976, 1.7e-6};
    const crank joint = slider_crank(&of, 0, route), contact = slider_crank(&of, 1, route);
    NEAR(joint.time, 0.481153, 1e-6);
    NEAR(joint.omega, 14.41, 5e-3);
    NEAR(joint.end, 234.17 * QUARTER / 90, 1e-4);
    NEAR(contact.time, joint.time, close);
    NEAR(contact.omega, joint.omega, 14 * close);
    NEAR(contact.end, joint.end, 1e3 * close);
}

/* Looked at in its dead centre, where the joints give a slip that nothing holds, or begun there. */
static void is_at_its_dead_centre(int route)
{
    const mechanism of[] = {
        {0.4127998423162591, 0.051868655505172175, 0.062263092401780108, 14.622620606071262,
         4.6827346831068963, 0.54571685791195768, 0},
        {0.41062440712282638, 0.095305510987654912, 0.0256874300171471, 10.564069709828811,
         2.6565240322036252, 0.86933746880480567, 0},
        {0.3, 0.1, 0.1, 5, 5, 2 * QUARTER, 0},
        {0.4, 0.1, 0.2, -6, 3, 0, 0},
    };
    for (int i = 0; i < 4; i++) {
        const crank joint = slider_crank(of + i, 0, route), contact = slider_crank(of + i, 1, route);
        NEAR(contact.time, joint.time, 1e-8);
        NEAR(contact.omega, joint.omega, 1e-6);
        NEAR(contact.end, joint.end, 1e-5);
    }
}

/* Angle of the crank some time after it began at its dead centre; with a block beside it that is let go, or pushed off. */
static double from_dead_centre(int route, double before, double up, double along)
{
    const double r = 0.1, l = 0.3, mass = 0.1, top = 2 * QUARTER - before, tilt = -asin(r * sin(top) / l);
    const double x = r * cos(top), y = r * sin(top), reach = l * cos(tilt);
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int a = scene_body(s, mass, mass * r * r / 12, 0.5 * x, 0.5 * y, top),
              b = scene_body(s, mass, mass * l * l / 12, x + 0.5 * reach, 0.5 * y, tilt),
              c = scene_body(s, 5, 0, x + reach, 0, 0), d = scene_body(s, 1, 0, 3, 0, 0);
    const int block = scene_point(s, c, 0, 0), other = scene_point(s, d, 0, 0), guide = scene_floor(s, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, PM_GROUND, 0, 0), scene_point(s, a, -0.5 * r, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, 0.5 * r, 0), scene_point(s, b, -0.5 * l, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, 0.5 * l, 0), block, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, block, 0), guide, 0, 0, PM_FRICTION_COULOMB, 0.1);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, other, 0), guide, 0, 0, PM_FRICTION_COULOMB, 0.1);
    scene_applied(s, other, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, along)), SCENE_PROGRAM(s, scene_k(s, up)));
    scene_start_omega(s, a, 5);
    scene_start(s, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, block, PM_PART_Y), 0);
    scene_start_velocity(s, other, 0, 0);
    scene_until_time(s, 0.05);
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, a));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double found = s->out[angle];
    scene_free(s);
    return found;
}

/* The way that its slip has taken stands while modes of others are looked for. */
static void others_leave_its_way(int route, double before)
{
    const double alone = from_dead_centre(route, before, 0, 0), close = route == PM_ROUTE_IDA ? 1e-6 : 1e-9;
    CHECK(alone > 0.1);
    NEAR(from_dead_centre(route, before, 20, 0), alone, close);
    NEAR(from_dead_centre(route, before, 0, 30), alone, close);
}

/* ---- modes in turn ---- */
/* Instants between which no time passes, `late` of them a moment later; the status of the last. */
static int instants(int n, int late)
{
    scene *s = scene_create();
    const int p = scene_point(s, scene_body(s, 2, 0, 0, 0, 0), 0, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0), scene_floor(s, 0), 0, 0, PM_FRICTION_COULOMB,
                  0.3);
    scene_start_velocity(s, p, 1, 0);
    scene_until_time(s, 10);
    EQUAL(scene_begin(s), PM_OK);
    int ended, status = PM_OK;
    s->w->state.t = 1;
    for (int i = 0; i < n && !status; i++) {
        if (i == n - late) s->w->state.t += 1e-9;
        status = pm_instant_full(s->w, &ended);
    }
    scene_free(s);
    return status;
}

static void instants_without_time_come_to_an_end(void)
{
    EQUAL(instants(PM_INSTANTS_AT_ONCE - 1, 0), PM_OK);
    EQUAL(instants(PM_INSTANTS_AT_ONCE, 0), PM_ALTERNATES);
    EQUAL(instants(PM_INSTANTS_AT_ONCE + 9, 10), PM_OK);
}

/* ---- a box in a gutter, a hair from lying flat on one wall ----
 *
 * Its corner C sticks to the other wall and turns it; B, in the corner next to C, slides along the first wall, at right angles to
 * BC.  To the first order C alone holds B, to the second B leaves its wall: the box turns about C, alpha = W r / I_C.  Two boxes
 * do so at the same instant. */
static void a_corner_held_for_an_instant_is_let_go(double hair, int boxes)
{
    const double m = 1.43, inertia = 0.0268, wide = 0.34, high = 0.33, one = -1.14, other = 0.715,
                 omega = 9e-5, end = 1e-4;
    const double way = high * cos(other - one) / sin(one - other); /* of B down the first wall */
    const double b[2] = {-way * cos(one), -way * sin(one)},
                 c[2] = {b[0] - high * sin(one), b[1] + high * cos(one)};
    const double angle = one + hair, gx = c[0] - 0.5 * (wide * cos(angle) - high * sin(angle)),
                 gy = c[1] - 0.5 * (wide * sin(angle) + high * cos(angle));
    scene *s = scene_create();
    int turns[2];
    for (int k = 0; k < boxes; k++) {
        const int box = scene_body(s, m, inertia, gx + 3 * k, gy, angle);
        const int wall[2] = {scene_line(s, scene_point(s, PM_GROUND, 3 * k, 0), one),
                             scene_line(s, scene_point(s, PM_GROUND, 3 * k, 0), other)};
        for (int i = 0; i < 2; i++)
            scene_contact(s, PM_CONTACT_LINE,
                          scene_circle(s, scene_point(s, box, 0.5 * wide, (i - 0.5) * high), 0), wall[i], 0,
                          0.5, PM_FRICTION_COULOMB, 0.9);
        scene_start_omega(s, box, omega);
        scene_start_velocity(s, scene_point(s, box, 0, 0), -omega * (gy - c[1]), omega * (gx - c[0]));
        turns[k] = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, box));
    }
    scene_until_time(s, end);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double alpha = -m * G * (gx - c[0]) / (inertia + 0.25 * m * (wide * wide + high * high));
    for (int k = 0; k < boxes; k++) NEAR(s->out[turns[k]], omega + alpha * end, 1e-6 * alpha * end);
    scene_free(s);
}

/* Likewise at rest, its mass centre below C: B and C stick.  Of the friction at C, after both normals, a hair is left, and all of that
 * at B: whichever is written first, what clearly holds is held. */
static void what_clearly_holds_is_held(double hair, int last)
{
    const double one = -1.14, other = 0.715, high = 0.33, below = 0.1;
    const double way = high * cos(other - one) / sin(one - other), far = high / cos(hair);
    const double c[2] = {-way * cos(one) - high * sin(one), -way * sin(one) + high * cos(one)};
    const double at[2][2] = {{0, below}, {far * sin(one + hair), below - far * cos(one + hair)}}; /* C, B */
    scene *s = scene_create();
    const int box = scene_body(s, 1.43, 0.0268, c[0], c[1] - below, 0);
    for (int i = 0; i < 2; i++) {
        const int k = i ^ last, wall = scene_line(s, scene_point(s, PM_GROUND, 0, 0), k ? one : other);
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, box, at[k][0], at[k][1]), 0), wall,
                      0, 0, PM_FRICTION_COULOMB, 0.9);
    }
    scene_until_time(s, 1e-3);
    const int turns = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, box));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[turns], 0, 1e-9);
    scene_free(s);
}

/* A rod whose foot is all but drawn in by its friction, or drawn away from there: where its modes change in turn it jams, or not.
 * Friction draws it in from mu = W_n / W_nt on. */
static void jams(double angle, int way)
{
    const double c = cos(angle), d = sin(angle), critical = (1 + 3 * c * c) / (3 * c * d);
    scene *s = scene_create();
    const int b = scene_body(s, 1, 1 / 12., 0.5 * c, 0.5 * d, 0),
              foot = scene_point(s, b, -0.5 * c, -0.5 * d);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, foot, 0), scene_floor(s, 0), 0, 0, PM_FRICTION_COULOMB,
                  (1 - 1e-12) * critical);
    scene_start_velocity(s, foot, -4 * way, 0);
    scene_start_omega(s, b, 0);
    scene_until_time(s, 0.1);
    EQUAL(scene_begin(s), PM_OK);
    EQUAL(pm_instant_jams(s->w, PM_ALTERNATES), way > 0 ? PM_PAINLEVE : PM_ALTERNATES);
    scene_free(s);
}

int main(void)
{
    for (int k = 1; k < 6; k++) {
        jams(0.25 * k, 1);
        jams(0.25 * k, -1);
    }
    others_leave_its_way(PM_ROUTE_RK, 0);
    others_leave_its_way(PM_ROUTE_RK, 1e-9);
    others_leave_its_way(PM_ROUTE_IDA, 1e-5);
    passes_its_dead_centre(PM_ROUTE_RK);
    passes_its_dead_centre(PM_ROUTE_IDA);
    is_at_its_dead_centre(PM_ROUTE_AUTO);
    is_at_its_dead_centre(PM_ROUTE_RK);
    instants_without_time_come_to_an_end();

    for (int i = 0; i < 200; i++) a_slip_against_its_mode_is_stopped();
    a_stopped_slip_is_booked(1e-2);
    a_stopped_slip_is_booked(1e-5);
    a_slip_that_is_not_held_stays(1e-2);
    a_slip_that_is_not_held_stays(1e-5);
    for (int boxes = 1; boxes <= 2; boxes++) {
        a_corner_held_for_an_instant_is_let_go(-1e-9, boxes);
        a_corner_held_for_an_instant_is_let_go(-1e-8, boxes);
    }
    for (int last = 0; last < 2; last++)
        for (int k = 5; k < 10; k++) what_clearly_holds_is_held(pow(10, -k), last);
    return check_failures();
}
