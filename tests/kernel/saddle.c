/* The saddle-point system: G a = gamma and M a = f + H^T l recomputed, rows inside the scene give no momentum, forces
 * are the gradients of their energies, redundant and singular rows are told apart. */
#include "equations/saddle.h"

#include "check.h"
#include "elements/constraint.h"
#include "elements/force.h"
#include "equations/active_set.h"
#include "equations/projection.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

/* A chain of rods pinned to each other, with a spring; `fixed`: the first one to the ground too.  Every third rod has `light`
 * times its mass, every other one `thin` times its inertia. */
static scene *chain_of(int n, int fixed, double light, double thin)
{
    scene *s = scene_create();
    double x = 0, y = 0;
    int end = scene_point(s, PM_GROUND, 0, 0);
    for (int i = 0; i < n; i++) {
        const double length = 0.5 + 0.1 * i, angle = -0.4 - 0.3 * i, c = cos(angle), d = sin(angle);
        const int b = scene_body(s, (1 + 0.5 * i) * (i % 3 == 1 ? light : 1),
                                 (0.02 + 0.01 * i) * (i % 2 == 1 ? thin : 1), x + 0.5 * length * c,
                                 y + 0.5 * length * d, angle);
        const int a = scene_point(s, b, -0.5 * length, 0);
        if (fixed || i > 0) scene_joint(s, PM_JOINT_PIN, a, end, 0);
        end = scene_point(s, b, 0.5 * length, 0);
        x += length * c;
        y += length * d;
    }
    scene_force(s, PM_FORCE_SPRING, scene_point(s, 0, 0, 0.2), end, 30, 0.4);
    scene_force(s, PM_FORCE_TORSION, 0, n - 1, 3, 0.2);
    return s;
}

static scene *chain(int n, int fixed) { return chain_of(n, fixed, 1, 1); }

/* Random velocities that keep the rows. */
static void shake(pm_workspace *w)
{
    for (int i = 0; i < w->model->nq; i++) w->state.v[i] = check_random(-2, 2);
    w->numbers.speed = 2;
    pm_frame_look_state(&w->frame, &w->state);
    pm_saddle_evaluate(&w->active, &w->frame);
    EQUAL(pm_projection_velocity(w, &w->state), PM_OK);
    pm_frame_look_state(&w->frame, &w->state);
}

static void recompute(pm_workspace *w)
{
    const int nq = w->model->nq;
    double sum[64];
    EQUAL(pm_saddle_accelerate(w), PM_OK);
    for (int i = 0; i < nq; i++) sum[i] = w->frame.f[i];
    double most = 100; /* m/s^2: what a spring does to a light end is rounded accordingly */
    for (int i = 0; i < nq; i++) most = fmax(most, fabs(w->frame.a[i]));
    for (int i = 0; i < w->active.n; i++) {
        const pm_constraint *row = &w->active.constraint[i];
        const double *h = w->active.asymmetric ? row->h : row->j;
        NEAR(pm_constraint_times(&w->frame, row, w->frame.a), row->gamma, 1e-12 * most);
        for (int p = 0; p < 2; p++)
            for (int k = 0; k < 3 && row->body[p] < w->model->nbody; k++)
                sum[3 * row->body[p] + k] += h[3 * p + k] * w->frame.lambda[i];
    }
    for (int i = 0; i < nq; i++)
        if (w->numbers.inverse_mass[i] > 0) NEAR(sum[i], w->frame.a[i] / w->numbers.inverse_mass[i], 1e-10);
}

/* Momentum about the origin that the rows give: none where all are inside the scene. */
static void momentum_of_rows(pm_workspace *w)
{
    double rate[3] = {0, 0, 0};
    for (int i = 0; i < w->model->nbody; i++) {
        const double *pose = w->frame.pose + 5 * i, *a = w->frame.a + 3 * i;
        const double fx = w->numbers.mass[i] * (a[0] - w->numbers.gravity[0]),
                     fy = w->numbers.mass[i] * (a[1] - w->numbers.gravity[1]);
        rate[0] += fx;
        rate[1] += fy;
        rate[2] += a[2] / w->numbers.inverse_mass[3 * i + 2] + pose[0] * fy - pose[1] * fx;
    }
    for (int k = 0; k < 3; k++) NEAR(rate[k], 0, 1e-11);
}

static void chains(void)
{
    for (int n = 2; n <= 9; n++)
        for (int fixed = 0; fixed < 2; fixed++) {
            scene *s = chain(n, fixed);
            if (CHECK(scene_begin(s) == PM_OK)) {
                EQUAL(s->w->active.n, 2 * (n - 1 + fixed));
                shake(s->w);
                recompute(s->w);
                if (!fixed) momentum_of_rows(s->w);
            }
            scene_free(s);
        }
}

/* Rods with next to no inertia are held by the others, as are rods with next to no mass between two others. */
static void light_chains(void)
{
    static const double part[] = {1e-3, 1e-6, 1e-9, 1e-12, 1e-16, 1e-30};
    for (int k = 0; k < 36; k++)
        for (int n = 3; n <= 9; n += 2) {
            scene *s = chain_of(n, k % 2, part[k % 6], part[k / 6]);
            if (CHECK(scene_begin(s) == PM_OK)) {
                EQUAL(s->w->active.n, 2 * (n - 1 + k % 2));
                EQUAL(s->w->active.nredundant, 0);
                shake(s->w);
                recompute(s->w);
            }
            scene_free(s);
        }
}

/* A block that slides: the friction rides on the normal force. */
static void sliding(void)
{
    scene *s = scene_create();
    const double mu = 0.3, angle = 0.2;
    const int b = scene_body(s, 2, 0.1, -0.5 * sin(angle), 0.5 * cos(angle), angle);
    const int line = scene_floor(s, angle);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, -0.4, -0.5), 0), line, 0, 0,
                  PM_FRICTION_COULOMB, mu);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, 0.4, -0.5), 0), line, 0, 0,
                  PM_FRICTION_COULOMB, mu);
    scene_start_velocity(s, scene_point(s, b, 0, 0), 3 * cos(angle), 3 * sin(angle));
    scene_start_omega(s, b, 0);
    if (CHECK(scene_begin(s) == PM_OK)) {
        CHECK(s->w->active.asymmetric);
        EQUAL(s->w->active.n, 2);
        recompute(s->w);
        const double along = s->w->frame.a[0] * cos(angle) + s->w->frame.a[1] * sin(angle);
        NEAR(along, -9.81 * (sin(angle) + mu * cos(angle)), 1e-11);
        NEAR(s->w->frame.lambda[0] + s->w->frame.lambda[1], 2 * 9.81 * cos(angle), 1e-11);
        NEAR(s->w->frame.a[2], 0, 1e-11);
    }
    scene_free(s);
}

/* f = -dV/dq of springs, and power = f v of dampers and applied forces. */
static void forces(void)
{
    scene *s = chain(3, 0);
    scene_force(s, PM_FORCE_DAMPER, scene_point(s, 0, 0.1, 0.3), scene_point(s, 2, 0, -0.2), 4, 0);
    scene_force(s, PM_FORCE_ROTARY_DAMPER, 1, PM_GROUND, 0.7, 0);
    const int constant = SCENE_PROGRAM(s, scene_k(s, 2.5)),
              angle = scene_read(s, scene_measure(s, PM_MEASURE_ANGLE, 1));
    scene_applied(s, scene_point(s, 1, 0.3, 0.1), 0, constant, angle);
    scene_couple(s, 0, 2, angle);
    scene_set(s, PM_SETTING_GRAVITY_X, 1.7);
    if (CHECK(scene_begin(s) == PM_OK)) {
        pm_workspace *w = s->w;
        const int nq = w->model->nq;
        double work = 0, power = 0, gradient = 0;
        shake(w);
        pm_force_all(w);
        for (int i = 0; i < nq; i++) power += w->frame.f[i] * w->state.v[i];
        for (int i = 2; i < s->rows[PM_TABLE_FORCE]; i++) work += w->frame.power[i];
        for (int side = -1; side <= 1; side += 2) {
            pm_state_copy(&w->probe, &w->state);
            for (int i = 0; i < nq; i++) w->probe.q[i] += side * 1e-6 * w->state.v[i];
            pm_frame_look_state(&w->frame, &w->probe);
            gradient += side * (pm_frame_weight_energy(&w->frame) + pm_force_potential(w)) / 2e-6;
        }
        NEAR(power, work - gradient, 1e-7);
    }
    scene_free(s);
}

/* Three links of a parallelogram: one row too many, everywhere; the motion is that of two. */
static double parallelogram(int legs, int *redundant)
{
    scene *s = scene_create();
    const int bar = scene_body(s, 1, 1 / 12., 0.5, -1, 0);
    for (int i = 0; i < legs; i++) {
        const double x = i / (legs - 1.);
        const int leg = scene_body(s, 0.6 / legs, 0.05 / legs, x, -0.5, -acos(0.));
        scene_joint(s, PM_JOINT_PIN, scene_point(s, leg, -0.5, 0), scene_point(s, PM_GROUND, x, 0), 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, leg, 0.5, 0), scene_point(s, bar, x - 0.5, 0), 0);
    }
    scene_start_omega(s, 1, 2);
    scene_until_time(s, 1);
    const int out = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, 1));
    CHECK(scene_begin(s) == PM_OK);
    *redundant = s->w->active.nredundant;
    EQUAL(scene_run(s, NULL), PM_OK);
    const double angle = s->out[out];
    scene_free(s);
    return angle;
}

static void redundant_rows(void)
{
    int redundant;
    const double two = parallelogram(2, &redundant);
    EQUAL(redundant, 0);
    NEAR(parallelogram(3, &redundant), two, 1e-9);
    EQUAL(redundant, 1);
    NEAR(parallelogram(4, &redundant), two, 1e-9);
    EQUAL(redundant, 2);
}

int main(void)
{
    chains();
    light_chains();
    sliding();
    forces();
    redundant_rows();
    return check_failures();
}
