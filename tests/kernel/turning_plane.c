/* Planes that turn about an axis in them: forces against differences of the energy, motions against closed forms and against
 * an integration of Lagrange's equations with the angle of the plane as a coordinate, ledgers, other axes, other routes. */
#include "elements/turning_plane.h"
#include "check.h"
#include "elements/force.h"
#include "elements/measure.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define PI 3.14159265358979323846
#define G 9.81
#define STEP 1e-5

/* The axis: through (x, y) at an angle; what else turns along; the rate at the start. */
static void spin(scene *s, double x, double y, double angle, double inertia, double omega)
{
    SCENE_ROW(s, PM_TABLE_SPIN, scene_value(s, x), scene_value(s, y), scene_value(s, angle),
              scene_value(s, inertia), scene_value(s, omega), PM_NONE);
}
static void spin_couple(scene *s, int program) { s->cell[PM_TABLE_SPIN][PM_SPIN_COUPLE] = program; }

/* A body whose second moments are x, y, z; those in the plane add up to its inertia. */
static int body(scene *s, double mass, double xx, double yy, double zz, double x, double y, double angle)
{
    SCENE_ROW(s, PM_TABLE_SECOND, scene_value(s, xx), scene_value(s, yy), scene_value(s, zz));
    return scene_body(s, mass, xx + yy, x, y, angle);
}

static int spin_measure(scene *s, int kind) { return scene_measure(s, kind, PM_NONE); }

static void gravity(scene *s, double x, double y)
{
    scene_set(s, PM_SETTING_GRAVITY_X, x);
    scene_set(s, PM_SETTING_GRAVITY_Y, y);
}

/* ---- forces ---- */
/* The centrifugal forces are the rates at which H^2 / 2J falls, and have the resultant and moment of those on the elements. */
static void forces(void)
{
    scene *s = scene_create();
    gravity(s, 0, 0);
    spin(s, 0.3, -0.2, 0.7, 0.4, 3);
    body(s, 2, 0.05, 0.31, 0.07, 0.9, 0.4, 0.35);
    body(s, 1.3, 0.2, 0, 0, -0.5, 1.1, -2.1);
    body(s, 0.7, 0, 0, 0, 0.1, -0.6, 0);
    if (!CHECK(scene_begin(s) == PM_OK)) return;
    pm_workspace *w = s->w;
    double inertia = 0.4 + 0.07;
    const double moments[3][4] = {{2, 0.05, 0.31, 0.35}, {1.3, 0.2, 0, -2.1}, {0.7, 0, 0, 0}};
    for (int i = 0; i < 3; i++) {
        const double *x = moments[i], *q = w->state.q + 3 * i, f = x[3] - 0.7;
        const double d = (q[1] + 0.2) * cos(0.7) - (q[0] - 0.3) * sin(0.7);
        inertia += x[0] * d * d + x[1] * sin(f) * sin(f) + x[2] * cos(f) * cos(f);
    }
    NEAR(pm_turning_plane_inertia(&w->frame), inertia, 1e-14);
    double f[9], outer[3], sum[3] = {0, 0, 0};
    const double momentum = pm_turning_plane_momentum(&w->frame);
    pm_force_all(w);
    memcpy(f, w->frame.f, sizeof f);
    pm_turning_plane_outer(&w->frame, outer);
    for (int i = 0; i < 9; i++) {
        double energy[2];
        if (i == 8) continue; /* a particle does not turn */
        for (int side = 0; side < 2; side++) {
            const double kept = w->state.q[i];
            w->state.q[i] += side ? STEP : -STEP;
            pm_frame_look_state(&w->frame, &w->state);
            energy[side] = 0.5 * momentum * momentum / pm_turning_plane_inertia(&w->frame);
            NEAR(pm_turning_plane_kinetic(&w->frame, PM_NONE), energy[side], 1e-14);
            w->state.q[i] = kept;
        }
        NEAR(f[i], (energy[0] - energy[1]) / (2 * STEP), 1e-8);
    }
    for (int i = 0; i < 3; i++) {
        sum[0] += f[3 * i];
        sum[1] += f[3 * i + 1];
        sum[2] += f[3 * i + 2] + w->state.q[3 * i] * f[3 * i + 1] - w->state.q[3 * i + 1] * f[3 * i];
    }
    for (int k = 0; k < 3; k++) NEAR(outer[k], sum[k], 1e-13);
    pm_frame_look_state(&w->frame, &w->state);
    double parts = 0.5 * 0.4 * 9; /* what else turns along */
    for (int i = 0; i < 3; i++) parts += pm_turning_plane_kinetic(&w->frame, i);
    NEAR(parts, pm_turning_plane_kinetic(&w->frame, PM_NONE), 1e-13);
    scene_free(s);
}

/* ---- a bead on a ring that spins about its vertical diameter ---- */
typedef struct bead {
    scene *s;
    int theta, omega, energy, momentum;
} bead;

#define RADIUS 0.4
#define MASS 0.6
#define RING 0.09 /* inertia of the ring about its diameter */

/* At the angle theta from the lowest point; the scene turned by `turn`, or seen in a mirror. */
static bead on_ring(double theta, double omega, double turn, double mirror, int route)
{
    bead b = {.s = scene_create()};
    scene *s = b.s;
    const double at = turn - 0.5 * PI + mirror * theta;
    gravity(s, G * cos(turn - 0.5 * PI), G * sin(turn - 0.5 * PI));
    spin(s, 0, 0, turn + 0.5 * PI, RING, omega);
    const int i = body(s, MASS, 0, 0, 0, RADIUS * cos(at), RADIUS * sin(at), 0);
    const int g = scene_point(s, i, 0, 0);
    scene_joint(s, PM_JOINT_LINK, g, scene_point(s, PM_GROUND, 0, 0), RADIUS);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    /* how far from the axis, and how high */
    b.theta =
        scene_measure_with(s, PM_MEASURE_POSITION, g, PM_PART_ALONG, PM_MEASURE_VALUE, scene_value(s, turn));
    b.omega = spin_measure(s, PM_MEASURE_SPIN_OMEGA);
    b.energy = spin_measure(s, PM_MEASURE_TOTAL);
    b.momentum = spin_measure(s, PM_MEASURE_SPIN_MOMENTUM);
    return b;
}

/* It stays where cos theta = g / (R Omega^2), and swings about that with omega^2 = -Q'/m R^2 for a small start. */
static void bead_stays(void)
{
    const double omega = 8, theta = acos(G / (RADIUS * omega * omega));
    bead b = on_ring(theta, omega, 0, 1, PM_ROUTE_RK);
    const int x = scene_ask_measure(b.s, b.theta), rate = scene_ask_measure(b.s, b.omega);
    scene_until_time(b.s, 0.5);
    CHECK(scene_run(b.s, NULL) == PM_OK);
    NEAR(b.s->out[x], RADIUS * sin(theta), 1e-10);
    NEAR(b.s->out[rate], omega, 1e-10);
    scene_free(b.s);
}

/* d theta / dt and d theta' / dt, with the rate of the plane as a second coordinate's: (J Omega)' = 0. */
static void bead_rates(const double y[3], double dy[3])
{
    const double s = sin(y[0]), c = cos(y[0]), m = MASS * RADIUS * RADIUS;
    dy[0] = y[1];
    dy[1] = y[2] * y[2] * s * c - G / RADIUS * s;
    dy[2] = -2 * m * s * c * y[1] * y[2] / (RING + m * s * s);
}

/* A slender rod hinged at its end, on the axis, to a vertical shaft. */
#define LENGTH 0.7
#define ROD 1.1
#define SHAFT 0.05
static void rod_rates(const double y[3], double dy[3])
{
    const double s = sin(y[0]), c = cos(y[0]), about_end = ROD * LENGTH * LENGTH / 3;
    dy[0] = y[1];
    dy[1] = y[2] * y[2] * s * c - 1.5 * G / LENGTH * s;
    dy[2] = -2 * about_end * s * c * y[1] * y[2] / (SHAFT + about_end * s * s);
}

/* By the classical formula of order 4, with steps so small that their error is some 1e-11. */
static void integrate(void (*rates)(const double y[3], double dy[3]), double t, double y[3])
{
    const int n = 8000;
    const double h = t / n;
    for (int i = 0; i < n; i++) {
        double k[4][3], at[3];
        rates(y, k[0]);
        for (int stage = 1; stage < 4; stage++) {
            for (int j = 0; j < 3; j++) at[j] = y[j] + h * (stage < 3 ? 0.5 : 1) * k[stage - 1][j];
            rates(at, k[stage]);
        }
        for (int j = 0; j < 3; j++) y[j] += h / 6 * (k[0][j] + 2 * k[1][j] + 2 * k[2][j] + k[3][j]);
    }
}

static void bead_moves(double turn, double mirror, int route)
{
    double y[3] = {0.5, 0, 9};
    bead b = on_ring(y[0], y[2], turn, mirror, route);
    const int x = scene_ask_measure(b.s, b.theta), rate = scene_ask_measure(b.s, b.omega);
    const int energy = scene_ask_measure(b.s, b.energy), momentum = scene_ask_measure(b.s, b.momentum);
    const int at_start = scene_when(b.s, PM_TRIGGER_START, PM_NONE);
    const int first = scene_ask_event(b.s, scene_read(b.s, b.energy), at_start, 1, 0);
    scene_until_time(b.s, 0.8);
    CHECK(scene_run(b.s, NULL) == PM_OK);
    integrate(bead_rates, 0.8, y);
    const double bound = route == PM_ROUTE_IDA ? 1e-7 : 2e-9;
    NEAR(b.s->out[x], mirror * RADIUS * sin(y[0]), bound);
    NEAR(b.s->out[rate], y[2], 10 * bound);
    NEAR(b.s->out[energy], b.s->out[first], bound);
    NEAR(b.s->out[momentum], 9 * (RING + MASS * RADIUS * RADIUS * sin(0.5) * sin(0.5)), 1e-14);
    CHECK(b.s->audit[PM_AUDIT_ENERGY] < 1e-8 && b.s->audit[PM_AUDIT_MOMENTUM] < 1e-8);
    scene_free(b.s);
}

/* ---- a rod on a shaft, with and without a couple ---- */
static scene *rod_on_shaft(double theta, double omega, int route)
{
    scene *s = scene_create();
    gravity(s, 0, -G);
    spin(s, 0, 0, 0.5 * PI, SHAFT, omega);
    const double at = theta - 0.5 * PI;
    const int i =
        body(s, ROD, ROD * LENGTH * LENGTH / 12, 0, 0, 0.5 * LENGTH * cos(at), 0.5 * LENGTH * sin(at), at);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, i, -0.5 * LENGTH, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    return s;
}

static void rod_moves(int route)
{
    double y[3] = {0.3, 0, 7};
    scene *s = rod_on_shaft(y[0], y[2], route);
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, 0));
    const int rate = scene_ask_measure(s, spin_measure(s, PM_MEASURE_SPIN_OMEGA));
    scene_until_time(s, 0.9);
    CHECK(scene_run(s, NULL) == PM_OK);
    CHECK(s->count[PM_COUNT_ROUTE] == route);
    integrate(rod_rates, 0.9, y);
    const double bound = route == PM_ROUTE_IDA ? 1e-7 : 2e-9;
    NEAR(s->out[angle], y[0] - 0.5 * PI, bound);
    NEAR(s->out[rate], y[2], 10 * bound);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-8 && s->audit[PM_AUDIT_MOMENTUM] < 1e-8);
    scene_free(s);
}

/* A couple c - k Omega on parts that do not move in the plane: J Omega' = c - k Omega.  The angle is its integral. */
static void driven(int route)
{
    const double c = 0.8, k = 0.3, t = 1.7, inertia = 0.2 + MASS * RADIUS * RADIUS;
    scene *s = scene_create();
    gravity(s, 0, 0);
    spin(s, 0, 0, 0, 0.2, 0.5);
    const int i = body(s, MASS, 0, 0, 0, 0, RADIUS, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, i, 0, 0), scene_point(s, PM_GROUND, 0, RADIUS), 0);
    const int omega = spin_measure(s, PM_MEASURE_SPIN_OMEGA);
    spin_couple(s, SCENE_PROGRAM(s, scene_k(s, c), scene_k(s, k), scene_m(omega), scene_op(PM_OP_MUL),
                                 scene_op(PM_OP_SUB)));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int rate = scene_ask_measure(s, omega);
    const int angle = scene_ask_measure(s, spin_measure(s, PM_MEASURE_SPIN_ANGLE));
    scene_until_time(s, t);
    CHECK(scene_run(s, NULL) == PM_OK);
    const double last = c / k, decay = exp(-k * t / inertia), bound = route == PM_ROUTE_IDA ? 1e-7 : 1e-9;
    NEAR(s->out[rate], last + (0.5 - last) * decay, bound);
    NEAR(s->out[angle], last * t + (0.5 - last) * inertia / k * (1 - decay), bound);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-7 && s->audit[PM_AUDIT_MOMENTUM] < 1e-7);
    scene_free(s);
}

/* ---- one degree of freedom: work and energy along the path, out of an unstable rest ---- */
/* A rod pinned at its middle to the axis swings from the axis to where a stop holds it, at right angles: Omega falls with J,
 * and the stop takes what the swing had. */
static void stopped(double side)
{
    const double own = ROD * LENGTH * LENGTH / 12, plate = 0.02, omega = 12;
    scene *s = scene_create();
    gravity(s, 0, 0);
    spin(s, 0, 0, 0.5 * PI, plate, omega);
    const int i = body(s, ROD, own, 0, 0, 0, 0, -0.5 * PI); /* against the axis: rounding gives it a couple */
    scene_joint(s, PM_JOINT_PIN, scene_point(s, i, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    const int end = scene_circle(s, scene_point(s, i, -0.5 * LENGTH, 0), 0);
    const int stop = scene_contact(s, PM_CONTACT_LINE, end, scene_floor(s, 0), 0, 0, PM_FRICTION_SMOOTH, 0);
    const int swing = scene_measure(s, PM_MEASURE_OMEGA, i), rate = spin_measure(s, PM_MEASURE_SPIN_OMEGA);
    *scene_setting(s, PM_SETTING_NUDGE) =
        SCENE_PROGRAM(s, scene_m(swing), scene_k(s, side), scene_op(PM_OP_MUL));
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, stop);
    scene_until(s, strike, 1);
    const int before = scene_ask_event(s, scene_read(s, swing), strike, 1, 1);
    const int after = scene_ask_event(s, scene_read(s, swing), strike, 1, 0);
    const int spin_before = scene_ask_event(s, scene_read(s, rate), strike, 1, 1);
    const int spin_after = scene_ask_event(s, scene_read(s, rate), strike, 1, 0);
    const int lost = scene_ask_measure(s, spin_measure(s, PM_MEASURE_LOST));
    const int kinetic = scene_ask_measure(s, scene_measure(s, PM_MEASURE_KINETIC, PM_NONE));
    CHECK(scene_run(s, NULL) == PM_OK);
    CHECK(s->count[PM_COUNT_ROUTE] == PM_ROUTE_PATH);
    const double momentum = plate * omega, last = momentum / (plate + own);
    const double gone = 0.5 * momentum * (omega - last);
    NEAR(s->out[spin_before], last, 1e-12);
    NEAR(s->out[spin_after], last, 1e-12);
    NEAR(s->out[before], side * sqrt(2 * gone / own), 1e-11);
    NEAR(s->out[after], 0, 1e-12);
    NEAR(s->out[lost], gone, 1e-12);
    NEAR(s->out[kinetic], 0.5 * momentum * last, 1e-12);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-11 && s->audit[PM_AUDIT_MOMENTUM] < 1e-11);
    scene_free(s);
}

/* Constant accelerations are not taken for granted: the plane bends every path. */
static void not_uniform(void)
{
    scene *s = scene_create();
    gravity(s, 0, 0);
    spin(s, 0, 0, 0, 0.2, 2);
    const int i = body(s, MASS, 0, 0, 0, 0, 0.1, 0);
    const int g = scene_point(s, i, 0, 0);
    scene_start_velocity(s, g, 1, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_AUTO;
    const int y = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y));
    const int rate = scene_ask_measure(s, spin_measure(s, PM_MEASURE_SPIN_OMEGA));
    scene_until_time(s, 0.7);
    CHECK(scene_run(s, NULL) == PM_OK);
    CHECK(s->count[PM_COUNT_ROUTE] == PM_ROUTE_RK);
    CHECK(s->out[y] > 0.2);
    NEAR(s->out[rate] * (0.2 + MASS * s->out[y] * s->out[y]), 2 * (0.2 + MASS * 0.01), 1e-10);
    scene_free(s);
}

/* ---- what cannot be ---- */
static void refused(void)
{
    scene *s = scene_create();
    spin(s, 0, 0, 0.5 * PI + 1e-3, 1, 1); /* the gravity would turn about a slanting axis */
    body(s, 1, 0, 0, 0, 1, 0, 0);
    CHECK(scene_run(s, NULL) == PM_BAD_VALUE);
    CHECK(s->where[0] == PM_TABLE_SPIN && s->where[2] == PM_SPIN_ANGLE);
    scene_free(s);
    s = scene_create();
    spin(s, 0, 0, 0.5 * PI, 0, 1); /* nothing has any inertia */
    body(s, 1, 0, 0, 0, 0, 0, 0);
    CHECK(scene_run(s, NULL) == PM_BAD_VALUE);
    CHECK(s->where[0] == PM_TABLE_SPIN && s->where[2] == PM_SPIN_INERTIA);
    scene_free(s);
    s = scene_create();
    body(s, 1, 0, 0, 0, 0, 0, 0); /* second moments without a spin */
    CHECK(scene_run(s, NULL) == PM_BAD_TABLE);
    scene_free(s);
    s = scene_create();
    scene_ask_measure(s, spin_measure(s, PM_MEASURE_SPIN_OMEGA));
    CHECK(scene_run(s, NULL) == PM_BAD_TABLE);
    scene_free(s);
}

int main(void)
{
    forces();
    bead_stays();
    bead_moves(0, 1, PM_ROUTE_RK);
    bead_moves(0, 1, PM_ROUTE_IDA);
    bead_moves(1.3, 1, PM_ROUTE_RK);
    bead_moves(0, -1, PM_ROUTE_RK);
    rod_moves(PM_ROUTE_RK);
    rod_moves(PM_ROUTE_IDA);
    rod_moves(PM_ROUTE_PATH);
    driven(PM_ROUTE_RK);
    driven(PM_ROUTE_IDA);
    stopped(1);
    stopped(-1);
    not_uniform();
    refused();
    return check_failures();
}
