/* What is known of a state is taken for that state alone: the same to the last bit, on the same rows. */
#include "equations/solve_cache.h"

#include "check.h"
#include "elements/constraint.h"
#include "equations/active_set.h"
#include "equations/saddle.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

/* Two rods on a pin, the lower one with a rim above a row of points that is far below. */
static scene *rods(int force)
{
    scene *s = scene_create();
    const int a = scene_body(s, 2, 0.1, 0.5, 0, 0), b = scene_body(s, 1, 0.05, 1, -0.5, 1);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, 0, 0.5), scene_point(s, a, 0.5, 0), 0);
    scene_force(s, PM_FORCE_TORSION, a, b, 3, 0.2);
    if (force) scene_couple(s, a, PM_GROUND, scene_read(s, scene_time(s)));
    scene_start_omega(s, a, 1.5);
    scene_start_omega(s, b, -0.7);
    return s;
}

/* Accelerations and reactions as they are without any memory. */
static void recompute(pm_workspace *w, double *a, double *lambda)
{
    pm_solve_cache_forget(w->cache);
    pm_frame_look_state(&w->frame, &w->state);
    EQUAL(pm_saddle_accelerate(w), PM_OK);
    memcpy(a, w->frame.a, (size_t)w->model->nq * sizeof *a);
    memcpy(lambda, w->frame.lambda, (size_t)w->active.n * sizeof *lambda);
}

static void as_if_solved(pm_workspace *w)
{
    double a[6], lambda[4], other[6] = {0.3, 0.1, -2, 1, 0, 3};
    recompute(w, a, lambda);
    const int64_t solves = w->result.count[PM_COUNT_SOLVES];
    memcpy(w->frame.a, other, sizeof other);
    memset(w->frame.lambda, 0, sizeof lambda);
    memset(w->frame.f, 0, sizeof other);
    for (int i = 0; i < w->active.n; i++) w->active.constraint[i].gamma = NAN;
    pm_frame_look_state(&w->frame, &w->state);
    EQUAL(pm_saddle_accelerate(w), PM_OK);
    EQUAL(w->result.count[PM_COUNT_SOLVES], solves);
    EQUAL(w->frame.level, PM_LEVEL_DYNAMIC);
    for (int i = 0; i < 6; i++) EQUAL(w->frame.a[i], a[i]);
    for (int i = 0; i < 4; i++) EQUAL(w->frame.lambda[i], lambda[i]);
    for (int i = 0; i < 4; i++) CHECK(!isnan(w->active.constraint[i].gamma));
    double left = 0;
    for (int i = 0; i < 6; i++) left = fmax(left, fabs(w->frame.f[i]));
    CHECK(left > 0);
}

/* The least change of any coordinate, of any velocity, of the rows: it is solved anew. */
static void not_for_another(pm_workspace *w)
{
    double a[6], lambda[4];
    for (int i = 0; i < 12; i++) {
        recompute(w, a, lambda);
        double *x = i < 6 ? &w->state.q[i] : &w->state.v[i - 6];
        const double before = *x;
        *x = nextafter(before, INFINITY);
        pm_frame_look_state(&w->frame, &w->state);
        EQUAL(pm_solve_cache_take(w), 0);
        *x = before;
        pm_frame_look_state(&w->frame, &w->state);
        EQUAL(pm_solve_cache_take(w), 1);
    }
    w->active.version++;
    EQUAL(pm_solve_cache_take(w), 0);
    EQUAL(pm_active_set_build(w), PM_OK);
    EQUAL(pm_solve_cache_take(w), 0);
}

/* A set of rows is not built once more where nothing has changed, and else it is. */
static void sets_of_rows(pm_workspace *w)
{
    pm_solve_cache_forget(w->cache);
    EQUAL(pm_solve_cache_is_built(w), 0);
    EQUAL(pm_active_set_build(w), PM_OK);
    EQUAL(pm_solve_cache_is_built(w), 1);
    const int64_t set = w->active.version;
    EQUAL(pm_active_set_build(w), PM_OK);
    EQUAL(w->active.version, set);
    w->state.q[4] = nextafter(w->state.q[4], 1);
    EQUAL(pm_solve_cache_is_built(w), 0);
    EQUAL(pm_active_set_build(w), PM_OK);
    CHECK(w->active.version > set);
    pm_active_set_clear(&w->active, w->model);
    EQUAL(pm_solve_cache_is_built(w), 0);
}

/* Factors hold for rows that take hold alike, whatever else has changed, and for no others. */
static void factors_of_rows(pm_workspace *w)
{
    pm_saddle_forget(&w->saddle);
    EQUAL(pm_saddle_is_factored(&w->saddle), 0);
    pm_saddle_evaluate(&w->active, &w->frame);
    EQUAL(pm_saddle_factor(w), PM_OK);
    for (int i = 0; i < w->active.n; i++)
        for (int k = 0; k < 6; k++) {
            double *j = &w->active.constraint[i].j[k];
            const double before = *j;
            EQUAL(pm_saddle_is_factored(&w->saddle), 1);
            *j = before + 1e-15;
            EQUAL(pm_saddle_is_factored(&w->saddle), 0);
            *j = before;
        }
    w->active.constraint[0].gamma += 1;
    EQUAL(pm_saddle_is_factored(&w->saddle), 1);
    w->active.constraint[0].body[1] = !w->active.constraint[0].body[1];
    EQUAL(pm_saddle_is_factored(&w->saddle), 0);
    w->active.constraint[0].body[1] = !w->active.constraint[0].body[1];
    w->active.n--;
    EQUAL(pm_saddle_is_factored(&w->saddle), 0);
    w->active.n++;
}

/* Of more angles than are kept, each twice; zeros of both signs in turn. */
static void rotations(const pm_frame *frame)
{
    for (int i = 0; i < 2000; i++) {
        const double angle = i % 2 ? 0.01 * (i % 1000) - 5 : i % 4 ? -0.0 : 0.0;
        const pm_rotation *x = pm_frame_rotation(frame, angle);
        EQUAL(x->cosine, cos(angle));
        EQUAL(x->sine, sin(angle));
        EQUAL(signbit(x->sine), signbit(sin(angle)));
    }
}

int main(void)
{
    scene *s = rods(0);
    if (CHECK(scene_begin(s) == PM_OK)) {
        rotations(&s->w->frame);
        as_if_solved(s->w);
        not_for_another(s->w);
        sets_of_rows(s->w);
    }
    scene_free(s);
    s = rods(0);
    if (CHECK(scene_begin(s) == PM_OK)) {
        EQUAL(pm_active_set_build(s->w), PM_OK);
        factors_of_rows(s->w);
    }
    scene_free(s);
    s = rods(1); /* a force that the time tells */
    if (CHECK(scene_begin(s) == PM_OK)) {
        double a[6], lambda[4];
        recompute(s->w, a, lambda);
        EQUAL(pm_solve_cache_take(s->w), 0);
    }
    scene_free(s);
    return check_failures();
}
