/* Tree coordinates: placing and reading are inverse, rates are derivatives of places, reduced dynamics is the whole
 * saddle-point system's, reactions too; many turns leave no residual. */
#include "tree/tree.h"

#include "check.h"
#include "elements/constraint.h"
#include "elements/force.h"
#include "equations/active_set.h"
#include "equations/projection.h"
#include "equations/saddle.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree_scenes.h"

#define MOST 64
#define STEP 1e-6 /* of differences */

static int nswift; /* scenes of which the small equations were compared */

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
    scene_route(s, x->route, x->accuracy);
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
    look_at(four_bar(), 5, 2);
    look_at(linked(0), 7, 0);
    look_at(linked(1), 7, 0);
    look_at(bobs(), 4, 0);
    look_at(row_on_links(8), 8, 0);
    look_at(row_on_links(9), 18, 9); /* coordinates of their own would cost more */
    look_at(free_bodies(), 8, 0);
    look_at(loop_of_three(0), 3, 2);
    look_at(loop_of_three(1), 3, 2);
    look_at(frame(), 4, 3);
    EQUAL(nswift, 6);
    swings();
    return check_failures();
}
