/* Couplings and drives: rows against differences of their residual along a motion, reactions and motions against closed
 * forms, a thousand turns, and one route against the other. */
#include "check.h"
#include "elements/constraint.h"
#include "equations/saddle.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define TWO_PI 6.283185307179586
#define STEP 1e-4

/* ---- rows ---- */
static const double pose[2][3] = {{0.31, -0.22, 0.7}, {-0.93, 0.84, -1.9}};
static const double mark[2][2] = {{0.17, -0.08}, {-0.12, 0.21}};
static const double speed[6] = {0.9, -1.3, 2.1, -0.4, 0.8, -1.7};

/* The residual where the bodies are t later if nothing accelerates. */
static double residual(pm_workspace *w, pm_constraint row, double t)
{
    double q[6];
    for (int i = 0; i < w->model->nq; i++) q[i] = w->state.q[i] + t * w->state.v[i];
    pm_frame_look(&w->frame, t, q, w->state.v, w->state.z, w->state.memory);
    pm_constraint_kind(row.kind)->evaluate(&w->frame, &row);
    return row.g;
}

/* g' = G v - w and g'' = -gamma along the motion; G itself by one body and one coordinate moving at a time. */
static void check_row(pm_workspace *w, pm_constraint row)
{
    pm_frame_look_state(&w->frame, &w->state);
    if (row.memory != PM_NONE)
        pm_constraint_kind(row.kind)->remember(&w->frame, &row, &w->state.memory[row.memory], 1);
    pm_constraint_kind(row.kind)->evaluate(&w->frame, &row);
    if (row.memory != PM_NONE) NEAR(row.g, 0, 1e-14);
    const double here = row.g;
    double before = residual(w, row, -STEP), after = residual(w, row, STEP);
    NEAR((after - before) / (2 * STEP), pm_constraint_times(&w->frame, &row, w->state.v) - row.rate, 1e-7);
    NEAR((after + before - 2 * here) / (STEP * STEP), -row.gamma, 1e-6);
    pm_frame_look_state(&w->frame, &w->state);
    /* the force of a drive is taken at the point of a, friction where the circle touches the line, a pin's at one of both */
    const int apart = row.kind == PM_CONSTRAINT_POINT_X || row.kind == PM_CONSTRAINT_POINT_Y ||
                      row.kind == PM_CONSTRAINT_LINE_NORMAL;
    const int off = apart || row.kind == PM_CONSTRAINT_DRIVE || row.kind == PM_CONSTRAINT_LINE_TANGENT;
    if (!off)
        NEAR(pm_constraint_rate(&w->frame, &row), pm_constraint_times(&w->frame, &row, w->state.v), 1e-13);
    NEAR(pm_constraint_slip(&w->frame, &row), pm_constraint_rate(&w->frame, &row) - row.rate, 1e-15);
    for (int i = 0; i < w->model->nq; i++) {
        double unit[6] = {0};
        const double *kept = w->state.v;
        unit[i] = 1;
        w->state.v = unit;
        before = residual(w, row, -STEP);
        after = residual(w, row, STEP);
        NEAR((after - before) / (2 * STEP), pm_constraint_times(&w->frame, &row, unit) - row.rate, 1e-7);
        w->state.v = (double *)kept;
    }
}

static void check_scene(scene *s)
{
    if (!CHECK(scene_open(s) == PM_OK) || !CHECK(pm_case_begin(s->w, s->constant) == PM_OK)) return;
    pm_workspace *w = s->w;
    for (int i = 0; i < w->model->nq; i++) {
        w->state.q[i] = w->numbers.value[PM_BODY_ROW(w->model, i / 3)[PM_BODY_X + i % 3]];
        w->state.v[i] = speed[i];
    }
    for (int i = 0; i < s->rows[PM_TABLE_JOINT]; i++) {
        pm_constraint row[PM_JOINT_CONSTRAINTS];
        const int n = pm_joint_constraints(&w->frame, &w->state, i, row);
        for (int k = 0; k < n; k++) check_row(w, row[k]);
    }
    for (int i = 0; i < s->rows[PM_TABLE_CONTACT]; i++) {
        pm_constraint row[2];
        pm_contact_constraint_both(&w->frame, i, s->model->contact_slot[i], 0, &row[0], &row[1]);
        check_row(w, row[s->cell[PM_TABLE_CONTACT][i * PM_CONTACT_COLUMNS] != PM_CONTACT_CORD]);
    }
    scene_free(s);
}

/* w = 0.3 + 0.7 t + sin 2t, and its integral. */
static int program_of_time(scene *s)
{
    const scene_code t = scene_m(scene_time(s));
    return SCENE_PROGRAM(s, scene_k(s, 0.3), scene_k(s, 0.7), t, scene_op(PM_OP_MUL), scene_op(PM_OP_ADD),
                         scene_k(s, 2), t, scene_op(PM_OP_MUL), scene_op(PM_OP_SIN), scene_op(PM_OP_ADD));
}
static double way(double t) { return 0.3 * t + 0.35 * t * t + 0.5 * (1 - cos(2 * t)); }

static void rows(int ground_side)
{
    scene *s = scene_create();
    int body[2], circle[2], line;
    for (int k = 0; k < 2; k++) {
        body[k] =
            ground_side == k ? PM_GROUND : scene_body(s, 1.5 + k, 0.2, pose[k][0], pose[k][1], pose[k][2]);
        const int point = scene_point(s, body[k], mark[k][0], mark[k][1]);
        circle[k] = scene_circle(s, point, 0.15 + 0.07 * k);
        line = scene_line(s, point, 0.4);
    }
    const int end = scene_circle(s, 0, 0), program = program_of_time(s);
    for (int a = -1; a < 2; a += 2)
        for (int b = -1; b < 2; b += 2) scene_cord(s, circle[0], a, circle[1], b, 0, 0);
    scene_cord(s, end, 1, circle[1], -1, 0, 0);
    scene_joint(s, PM_JOINT_BELT, circle[0], circle[1], 1);
    scene_joint(s, PM_JOINT_BELT, circle[0], circle[1], -1);
    scene_drive(s, PM_JOINT_RATE, body[0], body[1], program, PM_NONE);
    scene_joint(s, PM_JOINT_RATIO, body[0], body[1], -2.5);
    scene_drive(s, PM_JOINT_DRIVE, 0, 1, program, SCENE_PROGRAM(s, scene_k(s, 0.6)));
    const int other =
        SCENE_PROGRAM(s, scene_k(s, 2), scene_m(scene_time(s)), scene_op(PM_OP_COS), scene_op(PM_OP_SUB));
    scene_drive(s, PM_JOINT_PLACED, 0, 1, program, other);
    scene_drive(s, PM_JOINT_ANGLE, body[0], body[1], program, PM_NONE);
    scene_drive(s, PM_JOINT_LENGTH, 0, 1, other, PM_NONE);
    scene_drive(s, PM_JOINT_PIN_ANGLE, 0, 1, other, PM_NONE);
    scene_drive(s, PM_JOINT_SLIDER_PLACE, 0, line, program, PM_NONE);
    const int fixed = scene_drive(s, PM_JOINT_SLIDER_FIXED_PLACE, 0, line, other, PM_NONE);
    s->cell[PM_TABLE_JOINT][fixed * PM_JOINT_COLUMNS + PM_JOINT_VALUE] = scene_value(s, 0.3);
    const int touch = scene_contact(s, PM_CONTACT_LINE, circle[0], line, 0, 0, PM_FRICTION_ROUGH, 0);
    s->cell[PM_TABLE_CONTACT][touch * PM_CONTACT_COLUMNS + PM_CONTACT_SPEED] = program;
    check_scene(s);
}

/* Gears touch as drawn: outside, a in b, b in a. */
static void gear_rows(double side)
{
    scene *s = scene_create();
    double at[2][2];
    int circle[2];
    for (int k = 0; k < 2; k++) {
        const double c = cos(pose[k][2]), n = sin(pose[k][2]);
        at[k][0] = pose[k][0] + c * mark[k][0] - n * mark[k][1];
        at[k][1] = pose[k][1] + n * mark[k][0] + c * mark[k][1];
    }
    const double apart = hypot(at[0][0] - at[1][0], at[0][1] - at[1][1]);
    const double radius[2] = {side == -2 ? 1.4 * apart : 0.4 * apart, side == 1    ? 0.6 * apart
                                                                      : side == -1 ? 1.4 * apart
                                                                                   : 0.4 * apart};
    for (int k = 0; k < 2; k++) {
        const int body = scene_body(s, 1.5 + k, 0.2, pose[k][0], pose[k][1], pose[k][2]);
        circle[k] = scene_circle(s, scene_point(s, body, mark[k][0], mark[k][1]), radius[k]);
    }
    scene_joint(s, PM_JOINT_GEARS, circle[0], circle[1], side);
    check_scene(s);
}

/* ---- gears ---- */
/* A planet on a carrier round a fixed sun (or in a fixed ring): its angle is that of the carrier times 1 + R/r (or
 * 1 - R/r), and the couple on the carrier gives all of it the acceleration of the reduced inertia. */
typedef struct planetary {
    scene *s;
    int carrier, gear;
    double r, inertia, ratio, alpha;
} planetary;

static planetary planetary_create(double side, int route, double couple)
{
    planetary x = {.s = scene_create(), .r = 0.2, .inertia = 0.03};
    scene *s = x.s;
    const double sun = side > 0 ? 0.5 : 0.9, arm = side > 0 ? sun + x.r : sun - x.r, mass = 1.3, own = 0.4;
    x.ratio = side > 0 ? 1 + sun / x.r : 1 - sun / x.r;
    x.alpha = couple / (own + mass * arm * arm + x.inertia * x.ratio * x.ratio);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    x.carrier = scene_body(s, 2, own, 0, 0, 0);
    x.gear = scene_body(s, mass, x.inertia, arm, 0, 0);
    const int axle = scene_point(s, PM_GROUND, 0, 0), hub = scene_point(s, x.carrier, 0, 0);
    const int tip = scene_point(s, x.carrier, arm, 0), centre = scene_point(s, x.gear, 0, 0);
    scene_joint(s, PM_JOINT_PIN, hub, axle, 0);
    scene_joint(s, PM_JOINT_PIN, centre, tip, 0);
    scene_joint(s, PM_JOINT_GEARS, scene_circle(s, centre, x.r), scene_circle(s, axle, sun), side);
    scene_couple(s, x.carrier, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, couple)));
    return x;
}

/* A thousand turns, watched. */
static void planet(double side, int route)
{
    const planetary x = planetary_create(side, route, 3);
    scene *s = x.s;
    const int gear = x.gear;
    const double ratio = x.ratio, alpha = x.alpha, inertia = x.inertia, r = x.r;
    const int turned = scene_measure(s, PM_MEASURE_TURNED, x.carrier);
    const double turns = route == PM_ROUTE_IDA ? 3 : 1000, end = TWO_PI * turns;
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, turned, end)), 1);
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, gear));
    const int time = scene_ask_measure(s, scene_time(s));
    const int tooth = scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 2, PM_PART_NORM));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double close = route == PM_ROUTE_IDA ? 1e-5 : 1e-9;
    NEAR(s->out[angle], ratio * end, route == PM_ROUTE_IDA ? 1e-6 : 1e-11 * fabs(ratio) * end);
    NEAR(s->out[time], sqrt(2 * end / alpha), close * s->out[time]);
    NEAR(s->out[tooth], inertia * fabs(ratio) * alpha / r, 10 * close * s->out[tooth]);
    CHECK(s->audit[PM_AUDIT_CONSTRAINT] < 1e-11);
    CHECK(s->audit[PM_AUDIT_MOMENTUM] < 1e-7);
    scene_free(s);
}

/* Nothing is watched and all accelerations are constant: steps as long as the ledger of the turning reactions allows. */
static void long_steps(double side)
{
    for (int i = 0; i < 40; i++) {
        const planetary x = planetary_create(side, PM_ROUTE_RK, check_random(1, 300));
        scene *s = x.s;
        const double end = check_random(1, 5);
        scene_set(s, PM_SETTING_ACCURACY, pow(10, check_random(-11, -4)));
        scene_until_time(s, end);
        const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x.gear));
        const int turned = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, x.gear));
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[omega], x.ratio * x.alpha * end, 1e-10 * fabs(s->out[omega]));
        NEAR(s->out[turned], x.ratio * x.alpha * end * end / 2, 1e-10 * fabs(s->out[turned]));
        CHECK(s->audit[PM_AUDIT_CONSTRAINT] < 1e-9);
        scene_free(s);
    }
}

/* ---- drives ---- */
/* A motor turns a disk on a free plate, a thousand turns and as its program says. */
static void motor(int route)
{
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const double ia = 0.3, ib = 0.02, t = route == PM_ROUTE_IDA ? 3 : 180;
    const int a = scene_body(s, 1, ia, 0, 0, 0), b = scene_body(s, 1, ib, 0, 0, 0);
    const int pa = scene_point(s, a, 0, 0);
    scene_joint(s, PM_JOINT_PIN, pa, scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, 0, 0), pa, 0);
    const int drive = scene_drive(s, PM_JOINT_RATE, b, a, program_of_time(s), PM_NONE);
    scene_start_omega(s, a, 0);
    scene_until_time(s, t);
    const int plate = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, a));
    const int disk = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, b));
    const int couple = scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_COUPLE, drive));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double close = route == PM_ROUTE_IDA ? 1e-6 : 1e-9;
    /* at the start the motor runs at 0.3 already and the plate stands: ib (0.3) is the momentum that stays */
    const double share = ib / (ia + ib), relative = way(t), turned = share * (0.3 * t - relative);
    NEAR(s->out[disk] - s->out[plate], relative, close * relative);
    NEAR(s->out[plate], turned, close * relative);
    NEAR(s->out[couple], ia * share * (0.7 + 2 * cos(2 * t)), 1e4 * close * ia);
    CHECK(s->audit[PM_AUDIT_CONSTRAINT] < 1e-11);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-8);
    scene_free(s);
}

/* ---- ratios ---- */
/* A couple on one side of a gear box whose bodies are free to go: angle_a = r angle_b, l on a and -r l on b, so that
 * b turns with M r / (Ia r^2 + Ib); the ground gives (1 - r) l. */
static void gear_box(double r, int route)
{
    scene *s = scene_create();
    const double ia = 0.3, ib = 0.7, couple = 2, t = 1.5, start = 0.4;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int a = scene_body(s, 2, ia, 0.3, 0.1, 0.7), b = scene_body(s, 3, ib, 1.1, -0.4, -0.2);
    for (int k = 0; k < 2; k++) {
        const int centre = scene_point(s, k ? b : a, 0, 0);
        if (route == PM_ROUTE_PATH)
            scene_joint(s, PM_JOINT_PIN, centre, scene_point(s, PM_GROUND, k ? 1.1 : 0.3, k ? -0.4 : 0.1), 0);
        else
            scene_start_velocity(s, centre, 0.2, k);
    }
    const int box = scene_joint(s, PM_JOINT_RATIO, a, b, r);
    scene_couple(s, a, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, couple)));
    scene_start_omega(s, b, start);
    scene_until_time(s, t);
    const int turned_a = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, a));
    const int turned_b = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, b));
    const int on_a = scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_COUPLE, box));
    const int there = scene_measure(s, PM_MEASURE_JOINT_COUPLE, box);
    s->cell[PM_TABLE_MEASURE][there * PM_MEASURE_COLUMNS + PM_MEASURE_ON] = b;
    const int on_b = scene_ask_measure(s, there);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double alpha = couple * r / (ia * r * r + ib), close = route == PM_ROUTE_IDA ? 1e-6 : 1e-11;
    const double turned = start * t + 0.5 * alpha * t * t;
    NEAR(s->out[turned_b], turned, close);
    NEAR(s->out[turned_a], r * turned, close * fabs(r));
    NEAR(s->out[on_a], ia * r * alpha - couple, 100 * close);
    NEAR(s->out[on_b], ib * alpha, 100 * close);
    CHECK(s->audit[PM_AUDIT_MOMENTUM] < 1e-8);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-8);
    CHECK(s->audit[PM_AUDIT_CONSTRAINT] < 1e-11);
    EQUAL(s->count[PM_COUNT_ROUTES], (int64_t)1 << route);
    scene_free(s);
}

/* A pendulum on a cart that is driven with a constant acceleration swings about the apparent vertical as one of length l in
 * the apparent weight: energy in the cart's frame. */
static void driven_cart(int route)
{
    scene *s = scene_create();
    const double l = 0.8, m = 1.4, b = 4, g = 9.81;
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int cart = scene_body(s, 1, 0, 0, 0, 0),
              bob = scene_body(s, m, m * l * l / 12, 0, -l / 2, -TWO_PI / 4);
    const int pc = scene_point(s, cart, 0, 0);
    const int speed_x = SCENE_PROGRAM(s, scene_k(s, b), scene_m(scene_time(s)), scene_op(PM_OP_MUL));
    scene_drive(s, PM_JOINT_DRIVE, pc, scene_point(s, PM_GROUND, 0, 0), speed_x,
                SCENE_PROGRAM(s, scene_k(s, 0)));
    scene_joint(s, PM_JOINT_PIN, scene_point(s, bob, -l / 2, 0), pc, 0);
    const int turned = scene_measure(s, PM_MEASURE_TURNED, bob);
    scene_until(s,
                scene_when(s, PM_TRIGGER_FALL,
                           SCENE_PROGRAM(s, scene_m(turned), scene_k(s, 0.5), scene_op(PM_OP_ADD))),
                1);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, bob));
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, pc, PM_PART_X));
    const int time = scene_ask_measure(s, scene_time(s));
    EQUAL(scene_run(s, NULL), PM_OK);
    /* half a radian back: m l^2/6 omega^2 = m l/2 (b sin 0.5 - g (1 - cos 0.5)) */
    const double close = route == PM_ROUTE_IDA ? 1e-5 : 1e-8;
    NEAR(s->out[omega], -sqrt(3 / l * (b * sin(0.5) - g * (1 - cos(0.5)))), close);
    NEAR(s->out[x], b * s->out[time] * s->out[time] / 2, close);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-7);
    scene_free(s);
}

int main(void)
{
    static const int all[] = {PM_ROUTE_UNIFORM, PM_ROUTE_PATH, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int k = 0; k < 4; k++) {
        gear_box(-2.5, all[k]);
        gear_box(0.3, all[k]);
    }
    static const double sides[] = {1, -1, -2};
    static const int routes[] = {PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int ground_side = -1; ground_side < 2; ground_side++) rows(ground_side);
    for (int i = 0; i < 3; i++) gear_rows(sides[i]);
    for (int i = 0; i < 2; i++) {
        planet(1, routes[i]);
        planet(-1, routes[i]);
        motor(routes[i]);
        driven_cart(routes[i]);
        long_steps(i == 0 ? 1 : -1);
    }
    planet(1, PM_ROUTE_PATH);
    return check_failures();
}
