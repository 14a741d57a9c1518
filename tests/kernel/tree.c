/* Tree coordinates: placing and reading are inverse, rates are derivatives of places, reduced dynamics is the whole
 * saddle-point system's, reactions too; many turns leave no residual. */
#include "tree/tree.h"

#include "check.h"
#include "elements/constraint.h"
#include "elements/force.h"
#include "equations/active_set.h"
#include "equations/projection.h"
#include "equations/saddle.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define MOST 64
#define STEP 1e-6 /* of differences */

static int nswift; /* scenes of which the small equations were compared */

/* ---- scenes ---- */
static int rod(scene *s, double x, double y, double angle, double length, double mass)
{
    const double c = cos(angle), d = sin(angle);
    return scene_body(s, mass, mass * length * length / 12, x + 0.5 * length * c, y + 0.5 * length * d,
                      angle);
}

static void pin(scene *s, int a, double ax, double ay, int b, double bx, double by)
{
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, ax, ay), scene_point(s, b, bx, by), 0);
}

/* Three rods; the second pin has its child as second partner. */
static scene *pinned(void)
{
    scene *s = scene_create();
    const int a = rod(s, 0, 0, 0.3, 1, 1), b = rod(s, cos(0.3), sin(0.3), -0.8, 0.7, 2);
    const int c = rod(s, cos(0.3) + 0.7 * cos(0.8), sin(0.3) - 0.7 * sin(0.8), 2, 0.5, 0.5);
    pin(s, a, -0.5, 0, PM_GROUND, 0, 0);
    pin(s, a, 0.5, 0, b, -0.35, 0);
    pin(s, c, -0.25, 0, b, 0.35, 0);
    const int bob = scene_body(s, 0.3, 0, 0.4, 0.6, 0); /* a particle on the second rod */
    pin(s, bob, 0, 0, b, 0.1, 0.2);
    return s;
}

/* A wheel on a tilted line of a swinging plate, and what is welded to it. */
static scene *on_plate(int line_first)
{
    scene *s = scene_create();
    const double tilt = 0.4;
    const int plate = scene_body(s, 3, 0.4, 0, 0, 0.1);
    const int wheel = scene_body(s, 1, 0.05, 0.2, 0.5, 0.7), fin = scene_body(s, 0.2, 0.01, 0.25, 0.6, 1);
    pin(s, plate, -0.6, 0.1, PM_GROUND, -0.6, 0.1);
    const int line = scene_line(s, scene_point(s, plate, 0.1, 0.05), tilt);
    const int circle = scene_circle(s, scene_point(s, wheel, 0.02, 0.01), 0.25);
    scene_joint(s, PM_JOINT_ROLLING_LINE, circle, line, 0);
    if (line_first)
        scene_joint(s, PM_JOINT_WELD, scene_point(s, fin, 0.1, 0), scene_point(s, wheel, 0, 0.2), 0.3);
    else
        scene_joint(s, PM_JOINT_WELD, scene_point(s, wheel, 0, 0.2), scene_point(s, fin, 0.1, 0), -0.3);
    return s;
}

/* A plank that rolls on a wheel, itself rolling on the ground: the line belongs to the child. */
static scene *plank(void)
{
    scene *s = scene_create();
    const int wheel = scene_body(s, 2, 0.08, 0, 0.3, 0), board = scene_body(s, 1, 0.5, 0.1, 0.65, 0.1);
    const int circle = scene_circle(s, scene_point(s, wheel, 0, 0), 0.3);
    scene_joint(s, PM_JOINT_ROLLING_LINE, circle, scene_floor(s, 0.05), 0);
    const double down = acos(-1.);
    scene_joint(s, PM_JOINT_ROLLING_LINE, circle, scene_line(s, scene_point(s, board, 0, -0.05), down), 0);
    return s;
}

/* Circle on circle: side 1 outside, -1 inside; a third one on the second, with the child as b. */
static scene *circles(double side)
{
    scene *s = scene_create();
    const double big = 1, small = 0.3, third = 0.2, first = big + side * small;
    const int a = scene_body(s, 1, 0.03, first * cos(0.7), first * sin(0.7), 0.2);
    const int b =
        scene_body(s, 0.5, 0.01, first * cos(0.7) + 0.5 * cos(2.), first * sin(0.7) + 0.5 * sin(2.), 0);
    const int fixed = scene_circle(s, scene_point(s, PM_GROUND, 0, 0), big);
    const int moving = scene_circle(s, scene_point(s, a, 0, 0), small);
    scene_joint(s, PM_JOINT_ROLLING_CIRCLE, moving, fixed, side);
    scene_joint(s, PM_JOINT_ROLLING_CIRCLE, moving, scene_circle(s, scene_point(s, b, 0.02, 0), third), 1);
    return s;
}

/* A block that keeps its direction on a line of a moving rod, or carries the line of which a rod holds the point. */
static scene *sliders(int block_first)
{
    scene *s = scene_create();
    const int arm = rod(s, 0, 0, 0.5, 2, 1);
    const int block = scene_body(s, 2, 0.1, 1.1 * cos(0.5), 1.1 * sin(0.5), 0.8);
    pin(s, arm, -1, 0, PM_GROUND, 0, 0);
    if (block_first)
        scene_joint(s, PM_JOINT_SLIDER_FIXED, scene_point(s, block, 0.05, 0.02),
                    scene_line(s, scene_point(s, arm, 0, 0.1), 0.2), 0.3);
    else
        scene_joint(s, PM_JOINT_SLIDER_FIXED, scene_point(s, arm, 0.1, 0.05),
                    scene_line(s, scene_point(s, block, 0, 0.1), 0.2), -0.3);
    return s;
}

static scene *slider_crank(void)
{
    scene *s = scene_create();
    const double at = 0.7, swing = -asin(0.1 / 0.3 * sin(at));
    const int crank = rod(s, 0, 0, at, 0.1, 0.2),
              link = rod(s, 0.1 * cos(at), 0.1 * sin(at), swing, 0.3, 0.2);
    const int piston = scene_body(s, 0.4, 0, 0.1 * cos(at) + 0.3 * cos(swing), 0, 0);
    pin(s, crank, -0.05, 0, PM_GROUND, 0, 0);
    pin(s, crank, 0.05, 0, link, -0.15, 0);
    pin(s, link, 0.15, 0, piston, 0, 0);
    scene_joint(s, PM_JOINT_SLIDER, scene_point(s, piston, 0, 0), scene_floor(s, 0), 0);
    scene_start_omega(s, crank, 10);
    return s;
}

static scene *four_bar(void)
{
    scene *s = scene_create();
    const int a = rod(s, 0, 0, 1.2, 0.4, 1), c = rod(s, 1, 0, 1.9, 0.8, 1);
    const int b = rod(s, 0.4 * cos(1.2), 0.4 * sin(1.2), 0.4, 0.9, 2);
    pin(s, a, -0.2, 0, PM_GROUND, 0, 0);
    pin(s, c, -0.4, 0, PM_GROUND, 1, 0);
    pin(s, a, 0.2, 0, b, -0.45, 0);
    pin(s, b, 0.45, 0, c, 0.4, 0);
    scene_joint(s, PM_JOINT_LINK, scene_point(s, scene_body(s, 0.5, 0.02, 0.7, 1.6, 0), 0.1, 0),
                scene_point(s, b, 0, 0.3), 0.8);
    return s;
}

/* Three bodies in a loop of pins, or of a wheel, a rod and a block on the ground. */
static scene *loop_of_three(int wheel)
{
    scene *s = scene_create();
    const int first = scene_body(s, 1, 0.02, 0, wheel ? 0.2 : 0, 0.3);
    const int bar = rod(s, 0.2 * cos(0.3), (wheel ? 0.2 : 0) + 0.2 * sin(0.3), 0.1, 0.9, 2);
    const double x = 0.2 * cos(0.3) + 0.9 * cos(0.1), y = (wheel ? 0.2 : 0) + 0.2 * sin(0.3) + 0.9 * sin(0.1);
    const int last = scene_body(s, 0.5, 0.01, x, y, 0.4);
    if (wheel) {
        const int circle = scene_circle(s, scene_point(s, first, 0, 0), 0.2);
        scene_joint(s, PM_JOINT_ROLLING_LINE, circle, scene_floor(s, 0), 0);
        scene_joint(s, PM_JOINT_SLIDER_FIXED, scene_point(s, last, 0.05, 0),
                    scene_line(s, scene_point(s, PM_GROUND, x + 0.05 * cos(0.4), y + 0.05 * sin(0.4)), 0.5),
                    -0.1);
    } else {
        pin(s, first, -0.1, 0.05, PM_GROUND, -0.1 * cos(0.3) - 0.05 * sin(0.3),
            -0.1 * sin(0.3) + 0.05 * cos(0.3));
        pin(s, last, 0.3, -0.4, PM_GROUND, x + 0.3 * cos(0.4) + 0.4 * sin(0.4),
            y + 0.3 * sin(0.4) - 0.4 * cos(0.4));
    }
    pin(s, first, 0.2, 0, bar, -0.45, 0);
    pin(s, last, 0, 0, bar, 0.45, 0);
    return s;
}

/* A frame of four rods, closed last by a weld, that swings as one body. */
static scene *frame(void)
{
    scene *s = scene_create();
    const double x[] = {0, 1, 1.2, 0, 0}, y[] = {0, 0.2, 0.9, 0, 0.8};
    const int end[] = {1, 2, 4, 4};
    int body[4];
    double angle[4], length[4];
    for (int i = 0; i < 4; i++) {
        angle[i] = atan2(y[end[i]] - y[i], x[end[i]] - x[i]);
        length[i] = hypot(y[end[i]] - y[i], x[end[i]] - x[i]);
        body[i] = rod(s, x[i], y[i], angle[i], length[i], 1 + 0.3 * i);
    }
    pin(s, body[0], -length[0] / 2, 0, PM_GROUND, 0, 0);
    for (int i = 0; i < 2; i++) pin(s, body[i], length[i] / 2, 0, body[i + 1], -length[i + 1] / 2, 0);
    pin(s, body[3], -length[3] / 2, 0, body[0], -length[0] / 2, 0);
    scene_joint(s, PM_JOINT_WELD, scene_point(s, body[2], length[2] / 2, 0),
                scene_point(s, body[3], length[3] / 2, 0), angle[2] - angle[3]);
    return s;
}

static scene *free_bodies(void)
{
    scene *s = scene_create();
    scene_body(s, 1, 0.1, 0, 0, 0.3);
    scene_body(s, 2, 0, 1, 0, 0);
    scene_body(s, 1, 0.2, 3, 1, 0);
    return s;
}

/* ---- checks ---- */
static double force_scale(const pm_workspace *w)
{
    double sum = 1;
    for (int i = 0; i < w->active.n; i++) sum = fmax(sum, fabs(w->frame.lambda[i]));
    return sum;
}

/* Random velocities that keep the rows, and a spring so that there is more than weight. */
static void shake(pm_workspace *w)
{
    for (int i = 0; i < w->model->nq; i++)
        w->state.v[i] = w->numbers.inverse_mass[i] > 0 ? check_random(-2, 2) : 0;
    w->numbers.speed = 2;
    pm_frame_look_state(&w->frame, &w->state);
    pm_saddle_evaluate(&w->active, &w->frame);
    EQUAL(pm_projection_velocity(w, &w->state), PM_OK);
    pm_frame_look_state(&w->frame, &w->state);
}

static void places(pm_workspace *w, double *y)
{
    double q[MOST], back[MOST];
    pm_frame_look_state(&w->frame, &w->state);
    pm_tree_read(w->tree, &w->frame, y);
    pm_tree_place(w->tree, &w->frame, w->state.memory, y, q);
    for (int i = 0; i < w->model->nq; i++) NEAR(q[i], w->state.q[i], 1e-13);
    pm_frame_look(&w->frame, 0, q, w->state.v, w->state.z, w->state.memory);
    pm_tree_read(w->tree, &w->frame, back);
    for (int i = 0; i < w->tree->n; i++) NEAR(back[i], y[i], 1e-13);
}

/* B ydot is the derivative of place, and B yddot + c that of B ydot, along y + t ydot + t^2 yddot / 2. */
static void rates(pm_workspace *w, const double *y)
{
    const int n = w->tree->n, nq = w->model->nq;
    double ydot[MOST], yddot[MOST], at[MOST], rate[MOST], q[2][MOST], v[2][MOST], velocity[MOST], a[MOST],
        column[MOST];
    static double basis[MOST * MOST];
    for (int i = 0; i < n; i++) {
        ydot[i] = check_random(-2, 2);
        yddot[i] = check_random(-2, 2);
    }
    for (int side = 0; side < 2; side++) {
        const double t = side ? STEP : -STEP;
        for (int i = 0; i < n; i++) {
            at[i] = y[i] + t * ydot[i] + 0.5 * t * t * yddot[i];
            rate[i] = ydot[i] + t * yddot[i];
        }
        pm_tree_look(w, 0, at, rate, w->state.z);
        memcpy(q[side], w->tree->q, (size_t)nq * sizeof(double));
        memcpy(v[side], w->tree->v, (size_t)nq * sizeof(double));
    }
    pm_tree_look(w, 0, y, ydot, w->state.z);
    memcpy(velocity, w->tree->v, sizeof velocity);
    pm_tree_bias(w->tree, &w->frame, a);
    for (int k = 0; k < n; k++) {
        for (int i = 0; i < n; i++) rate[i] = i == k;
        pm_tree_spread(w->tree, rate, column);
        for (int i = 0; i < nq; i++) basis[i * n + k] = column[i];
    }
    pm_tree_read_rates(w->tree, velocity, rate);
    for (int i = 0; i < n; i++) NEAR(rate[i], ydot[i], 1e-12);
    for (int i = 0; i < nq; i++) {
        double sum = 0;
        for (int k = 0; k < n; k++) {
            sum += basis[i * n + k] * ydot[k];
            a[i] += basis[i * n + k] * yddot[k];
        }
        NEAR(sum, velocity[i], 1e-12);
        NEAR((q[1][i] - q[0][i]) / (2 * STEP), velocity[i], 1e-8);
        NEAR((v[1][i] - v[0][i]) / (2 * STEP), a[i], 1e-7);
    }
    pm_tree_spread(w->tree, ydot, rate);
    for (int i = 0; i < nq; i++) NEAR(rate[i], velocity[i], 1e-13);
    for (int k = 0; k < w->active.n; k++) { /* the solved rows hold whatever the rates */
        if (!w->tree->used[k]) continue;
        pm_constraint_kind(w->active.constraint[k].kind)->evaluate(&w->frame, &w->active.constraint[k]);
        NEAR(pm_constraint_times(&w->frame, &w->active.constraint[k], velocity), 0, 1e-12);
        NEAR(w->active.constraint[k].g, 0, 1e-12);
    }
}

static void dynamics(pm_workspace *w, const double *y)
{
    double ydot[MOST], yddot[MOST], back[MOST], a[MOST], lambda[MOST];
    shake(w);
    pm_tree_read_rates(w->tree, w->state.v, ydot);
    EQUAL(pm_saddle_accelerate(w), PM_OK);
    memcpy(a, w->frame.a, sizeof a);
    memcpy(lambda, w->frame.lambda, (size_t)w->active.n * sizeof(double));
    pm_tree_look(w, 0, y, ydot, w->state.z);
    EQUAL(pm_tree_accelerate(w, yddot), PM_OK);
    pm_tree_tell(w, yddot);
    EQUAL(w->frame.level, PM_LEVEL_DYNAMIC);
    const double size = force_scale(w);
    for (int i = 0; i < w->model->nq; i++) NEAR(w->frame.a[i], a[i], 1e-12 * size / 0.01);
    for (int i = 0; i < w->active.n; i++) NEAR(w->frame.lambda[i], lambda[i], 1e-12 * size);
    pm_tree_read_accelerations(w->tree, &w->frame, a, back);
    for (int i = 0; i < w->tree->n; i++) NEAR(back[i], yddot[i], 1e-10 * size);
}

/* From a place a little off the loop rows back onto them. */
static void projects(pm_workspace *w, const double *y)
{
    double off[MOST], ydot[MOST];
    for (int i = 0; i < w->tree->n; i++) {
        off[i] = y[i] + 1e-4 * check_random(-1, 1);
        ydot[i] = check_random(-1, 1);
    }
    EQUAL(pm_tree_project(w, 0, off, ydot, w->state.z), PM_OK);
    for (int i = 0; i < w->active.n; i++) {
        pm_constraint_kind(w->active.constraint[i].kind)->evaluate(&w->frame, &w->active.constraint[i]);
        NEAR(w->active.constraint[i].g, 0, 1e-14);
        NEAR(pm_constraint_times(&w->frame, &w->active.constraint[i], w->tree->v), 0, 1e-14);
    }
}

/* By what was summed up; and without a frame, at places and rates near the one where that was and far from it, and back
 * onto the rows. */
static void swift(pm_workspace *w, const double *y)
{
    const int n = w->tree->n;
    double at[2 * MOST], *const near = at, *const rate = at + n, yddot[MOST], same[2 * MOST];
    for (int i = 0; i < n; i++) rate[i] = 0;
    pm_tree_look(w, 0, y, rate, w->state.z);
    pm_tree_sum_up(w);
    pm_tree_small_sum_up(w);
    if (w->tree->augmented.on) dynamics(w, y);
    if (!pm_tree_small_applies(w)) return;
    for (int trial = 0; trial < 20; trial++) {
        for (int i = 0; i < n; i++) {
            near[i] = y[i] + check_random(-1, 1) * (trial < 10 ? 0.2 : 5);
            rate[i] = check_random(-3, 3);
        }
        pm_tree_look(w, 0, near, rate, w->state.z);
        w->tree->part.independence = 1;
        EQUAL(pm_tree_accelerate(w, yddot), PM_OK);
        const double independence = w->tree->part.independence;
        w->tree->part.independence = 1;
        EQUAL(pm_tree_small_derivative(w, at, same), PM_OK);
        for (int i = 0; i < n; i++) {
            EQUAL(same[i], rate[i]);
            NEAR(same[n + i], yddot[i], 1e-11 / independence * (1 + fabs(yddot[i])));
        }
        NEAR(w->tree->part.independence, independence, 1e-12);
    }
    projects(w, y);
    nswift++;
}

/* The weight of a pendulum goes with the cosine of its angle: to the last figure near where it was computed, too. */
static void swings(void)
{
    scene *s = scene_create();
    double start, level[2], down[2];
    pin(s, rod(s, 0, 0, 0, 1, 1), -0.5, 0, PM_GROUND, 0, 0);
    if (CHECK(scene_begin(s) == PM_OK)) {
        pm_tree_build(s->w);
        pm_frame_look_state(&s->w->frame, &s->w->state);
        pm_tree_read(s->w->tree, &s->w->frame, &start);
        pm_tree_sum_up(s->w);
        pm_tree_small_sum_up(s->w);
        for (int i = -50; i <= 50; i++) {
            const double still[2] = {0, 0}, y[2] = {0.01 * i, 0};
            EQUAL(pm_tree_small_derivative(s->w, still, level), PM_OK);
            EQUAL(pm_tree_small_derivative(s->w, y, down), PM_OK);
            NEAR(down[1] / level[1], cos(y[0]), 3e-16);
        }
    }
    scene_free(s);
}

static void turns_on(pm_workspace *w, const double *y)
{
    double far[MOST], still[MOST];
    for (int i = 0; i < w->tree->n; i++) {
        far[i] = pm_tree_is_angle(w->tree, i) ? y[i] + 6283.18 : y[i];
        still[i] = 0;
    }
    pm_tree_look(w, 0, far, still, w->state.z);
    for (int i = 0; i < w->active.n; i++) {
        pm_constraint *row = &w->active.constraint[i];
        if (!w->tree->used[i] || row->kind == PM_CONSTRAINT_CIRCLE_TANGENT)
            continue; /* followed step by step */
        pm_constraint_kind(row->kind)->evaluate(&w->frame, row);
        NEAR(row->g, 0, 1e-11);
    }
}

static void look_at(scene *s, int n, int nloop)
{
    double y[MOST];
    scene_set(s, PM_SETTING_GRAVITY_X, 1.7); /* weights have both parts */
    if (CHECK(scene_begin(s) == PM_OK)) {
        pm_workspace *w = s->w;
        pm_tree_build(w);
        EQUAL(w->tree->n, n);
        EQUAL(w->tree->nloop, nloop);
        places(w, y);
        rates(w, y);
        dynamics(w, y);
        projects(w, y);
        swift(w, y);
        pm_frame_look_state(&w->frame, &w->state);
        pm_tree_read(w->tree, &w->frame, y);
        pm_tree_partition(&w->frame, w->tree); /* the same by dependent and independent coordinates */
        EQUAL(w->tree->part.few, nloop > 0 && n - nloop <= PM_TREE_FEW);
        dynamics(w, y);
        projects(w, y);
        w->tree->part.few = 0;
        turns_on(w, y);
    }
    scene_free(s);
}

/* Cranks of length 1 turn together, again and again through the place where all bars are in line. */
enum { MOST_CRANKS = 161 };
typedef struct in_line {
    int route, cranks;
    double accuracy, end;
    double angle, energy; /* what comes out: at the end; the audit of the energy */
    int64_t steps;
} in_line;

static void run_in_line(in_line *x)
{
    scene *s = scene_create();
    int crank[MOST_CRANKS];
    for (int i = 0; i < x->cranks; i++) {
        crank[i] = rod(s, i, 0, 0.5 * acos(-1.), 1, 1);
        pin(s, crank[i], -0.5, 0, PM_GROUND, i, 0);
    }
    for (int i = 0; i + 1 < x->cranks; i++) {
        const int bar = rod(s, i, 1, 0, 1, 1);
        pin(s, bar, -0.5, 0, crank[i], 0.5, 0);
        pin(s, bar, 0.5, 0, crank[i + 1], 0.5, 0);
    }
    scene_start(s, PM_START_VELOCITY, scene_measure(s, PM_MEASURE_OMEGA, crank[0]), -1);
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, scene_time(s), x->end)), 1);
    const int angle = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, crank[0]));
    *scene_setting(s, PM_SETTING_ROUTE) = x->route;
    scene_set(s, PM_SETTING_ACCURACY, x->accuracy);
    EQUAL(scene_run(s, NULL), PM_OK);
    x->angle = s->out[angle];
    x->energy = s->audit[PM_AUDIT_ENERGY];
    x->steps = s->count[PM_COUNT_STEPS];
    scene_free(s);
}

/* rk goes on as they came, and agrees with the path, which has energy for it. */
static void passes_in_line(void)
{
    in_line path = {.route = PM_ROUTE_PATH, .cranks = 3, .accuracy = 1e-8, .end = 1.5}, rk = path;
    rk.route = PM_ROUTE_RK;
    run_in_line(&path);
    run_in_line(&rk);
    CHECK(path.angle < -4); /* past both */
    NEAR(rk.angle, path.angle, 1e-6);
    CHECK(rk.energy < 1e-6);
}

/* However many there are: steps go over the place where rounding is amplified, and what the energy returns is in all that
 * depends on the rates, so that no step is refused for the noise. */
static void long_chains_pass_in_line(void)
{
    static const double accuracies[] = {1e-8, 1e-9, 1e-10};
    in_line path = {.route = PM_ROUTE_PATH, .cranks = MOST_CRANKS, .accuracy = 1e-10, .end = 5};
    run_in_line(&path);
    CHECK(path.angle < -14);
    for (int i = 0; i < 3; i++) {
        in_line rk = path, few = path;
        rk.route = few.route = PM_ROUTE_RK;
        rk.accuracy = few.accuracy = accuracies[i];
        few.cranks = 12;
        run_in_line(&rk);
        run_in_line(&few);
        NEAR(rk.angle, path.angle, 10 * accuracies[i] * fabs(path.angle));
        CHECK(rk.steps <= few.steps + few.steps / 10);
    }
}

int main(void)
{
    passes_in_line();
    long_chains_pass_in_line();
    look_at(pinned(), 3, 0);
    look_at(on_plate(1), 2, 0);
    look_at(on_plate(0), 2, 0);
    look_at(plank(), 2, 0);
    look_at(circles(1), 2, 0);
    look_at(circles(-1), 2, 0);
    look_at(sliders(1), 2, 0);
    look_at(sliders(0), 2, 0);
    look_at(slider_crank(), 2, 1);
    look_at(four_bar(), 6, 3);
    look_at(free_bodies(), 8, 0);
    look_at(loop_of_three(0), 3, 2);
    look_at(loop_of_three(1), 3, 2);
    look_at(frame(), 4, 3);
    EQUAL(nswift, 5);
    swings();
    return check_failures();
}
