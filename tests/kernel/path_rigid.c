/* Places of a rigid group against those that the tree makes: each kind of joint, from either side, on ground and on what
 * stands still on it. */
#include "routes/path/path.h"

#include "check.h"
#include "equations/fixed_bodies.h"
#include "scene.h"
#include "state/route.h"
#include "state/workspace.h"

enum { BODIES = 5, KINDS = 10 };

static int ground(scene *s, double x, double y) { return scene_point(s, PM_GROUND, x, y); }
static int rod(scene *s) { return scene_body(s, 1.3, 0.2, 0.4, 0.6, 0.3); }

/* The one joint that lets a body move. */
static void joint(scene *s, int kind, int body, int post)
{
    const int mark = scene_point(s, body, 0.1, -0.2), fixed = scene_point(s, post, 0.2, 0.1),
              edge = scene_line(s, fixed, 0.4), own = scene_line(s, mark, -0.3),
              rim = scene_circle(s, mark, 0.3);
    switch (kind) {
    case 0: scene_joint(s, PM_JOINT_PIN, mark, fixed, 0); break;
    case 1: scene_joint(s, PM_JOINT_PIN, fixed, mark, 0); break;
    case 2: scene_joint(s, PM_JOINT_SLIDER_FIXED, mark, edge, 0.2); break;
    case 3: scene_joint(s, PM_JOINT_SLIDER_FIXED, fixed, own, 0.2); break;
    case 4: scene_joint(s, PM_JOINT_ROLLING_LINE, rim, edge, 0); break;
    case 5: scene_joint(s, PM_JOINT_ROLLING_LINE, scene_circle(s, fixed, 0.25), own, 0); break;
    case 6: scene_joint(s, PM_JOINT_ROLLING_CIRCLE, rim, scene_circle(s, fixed, 0.5), 1); break;
    case 7: scene_joint(s, PM_JOINT_ROLLING_CIRCLE, rim, scene_circle(s, fixed, 0.8), -1); break;
    case 8: scene_joint(s, PM_JOINT_ROLLING_CIRCLE, scene_circle(s, fixed, 0.2), rim, -1); break;
    default: scene_joint(s, PM_JOINT_ROLLING_CIRCLE, rim, scene_circle(s, fixed, 0), 1);
    }
}

/* On a post that stands still: a body, one welded on it, one welded on that, and a particle. */
static scene *group(int kind, int on_post, int springs)
{
    scene *s = scene_create();
    const int post = scene_body(s, 2, 0.1, 0.3, -0.1, 0.2), body = rod(s), next = rod(s), last = rod(s),
              bob = scene_body(s, 0.5, 0, 0, 0, 0);
    scene_joint(s, PM_JOINT_WELD, scene_point(s, post, 0.1, 0), ground(s, 0.4, -0.1), 0.2);
    joint(s, kind, body, on_post ? post : PM_GROUND);
    scene_joint(s, PM_JOINT_WELD, scene_point(s, body, 0.3, 0.1), scene_point(s, next, -0.2, 0.1), 0.7);
    scene_joint(s, PM_JOINT_WELD, scene_point(s, last, 0, 0.4), scene_point(s, next, 0.1, 0.1), -0.4);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, last, 0.2, 0.2), scene_point(s, bob, 0, 0), 0);
    if (springs) scene_force(s, PM_FORCE_SPRING, scene_point(s, last, 0, 0), ground(s, 1, 2), 30, 0.2);
    if (kind != 2 && kind != 3) scene_start(s, 0, scene_measure(s, PM_MEASURE_ANGLE, body), 0.3);
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, scene_time(s), 1)), 1);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, body));
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    return s;
}

static int begin(scene *s)
{
    static const double none = 0;
    pm_start_report report;
    const int status = scene_open(s);
    if (status) return status;
    s->w->fixed->wanted = 1;
    return pm_run_start(s->w, &none, &report);
}

typedef struct numbers {
    double q[3 * BODIES], tangent[3 * BODIES], bend[3 * BODIES], pose[5 * BODIES], whole[4];
} numbers;

static numbers place_at(pm_workspace *w, double u)
{
    pm_place *x = &w->path->spare;
    numbers out = {.q = {0}};
    EQUAL(pm_path_place(w, u, x), PM_OK);
    EQUAL(x->slope[0], 1);
    CHECK(x->determined);
    memcpy(out.q, x->q, sizeof out.q);
    memcpy(out.tangent, x->tangent, sizeof out.tangent);
    memcpy(out.bend, x->bend, sizeof out.bend);
    memcpy(out.pose, x->pose, sizeof out.pose);
    const double whole[] = {x->mass, x->change, x->force, x->potential};
    memcpy(out.whole, whole, sizeof whole);
    return out;
}

/* Reactions and accelerations, at some T: they go by the levers. */
static void react(pm_workspace *w, double *a, double *lambda)
{
    pm_place *x = &w->path->spare;
    x->kinetic = 3;
    memcpy(w->frame.pose, x->pose, 5 * (size_t)w->model->nbody * sizeof *x->pose);
    pm_path_open_accelerate(w, x);
    memcpy(a, w->frame.a, (size_t)w->model->nq * sizeof *a);
    memcpy(lambda, w->frame.lambda, (size_t)w->active.n * sizeof *lambda);
}

static void near_all(const double *a, const double *b, int n)
{
    for (int i = 0; i < n; i++) NEAR(a[i], b[i], 1e-12 * fmax(1, fabs(b[i])));
}

static void compare(pm_workspace *w, double u)
{
    double a[2][3 * BODIES], lambda[2][3 * BODIES];
    const int group = w->path->rigid.n;
    const numbers one = place_at(w, u);
    react(w, a[0], lambda[0]);
    w->path->rigid.n = 0;
    const numbers other = place_at(w, u);
    react(w, a[1], lambda[1]);
    w->path->rigid.n = group;
    near_all((const double *)&one, (const double *)&other, (int)(sizeof one / sizeof(double)));
    near_all(a[0], a[1], w->model->nq);
    near_all(lambda[0], lambda[1], w->active.n);
}

static void check_group(int kind, int on_post, int springs)
{
    const int before = check_count;
    scene *s = group(kind, on_post, springs);
    if (CHECK(begin(s) == PM_OK)) {
        pm_workspace *w = s->w;
        w->state.v[3] = w->state.v[5] = 1; /* it is not to wait for a nudge */
        if (CHECK(pm_route_prepare(w, &pm_route_path))) {
            EQUAL(w->path->rigid.n, 4);
            for (int i = 0; i < 6; i++) compare(w, check_random(-2, 2));
        }
    }
    scene_free(s);
    if (check_count > before) fprintf(stderr, "joint %d, on post %d, springs %d\n", kind, on_post, springs);
}

/* A particle on a link, on ground or on the post; all else stands still. */
static void check_bead(int on_post, int turned, int springs)
{
    const int before = check_count;
    scene *s = scene_create();
    const int post = scene_body(s, 2, 0.1, 0.3, -0.1, 0.2), bead = scene_body(s, 0.5, 0, 0.8, -0.4, 0);
    const int mark = scene_point(s, bead, 0, 0), fixed = scene_point(s, on_post ? post : PM_GROUND, 0.2, 0.1);
    for (int i = 0; i < BODIES - 2; i++) rod(s);
    for (int i = 0; i < BODIES; i++)
        if (i != bead)
            scene_joint(s, PM_JOINT_WELD, scene_point(s, i, 0.1, 0), ground(s, 0.4, -0.1 * i), 0.2);
    scene_joint(s, PM_JOINT_LINK, turned ? fixed : mark, turned ? mark : fixed, 0.6);
    if (springs) scene_force(s, PM_FORCE_SPRING, mark, ground(s, 1, 2), 30, 0.2);
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_minus(s, scene_time(s), 1)), 1);
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    if (CHECK(begin(s) == PM_OK) && CHECK(pm_route_prepare(s->w, &pm_route_path))) {
        EQUAL(s->w->path->rigid.n, 1);
        for (int i = 0; i < 6; i++) compare(s->w, check_random(-2, 2));
    }
    scene_free(s);
    if (check_count > before)
        fprintf(stderr, "bead on post %d, turned %d, springs %d\n", on_post, turned, springs);
}

/* Something rolls beside it, on a link: the tree makes the places. */
static void none(void)
{
    scene *s = group(0, 0, 0);
    const int more = scene_body(s, 0.4, 0.1, 1, 1, 0);
    scene_joint(s, PM_JOINT_ROLLING_LINE, scene_circle(s, scene_point(s, more, 0, 0), 0.1), scene_floor(s, 0),
                0);
    scene_joint(s, PM_JOINT_LINK, scene_point(s, more, 0, 0), scene_point(s, 1, 0, 0), 0.9);
    if (CHECK(begin(s) == PM_OK)) {
        s->w->state.v[5] = 1;
        pm_route_path.applies(s->w);
        EQUAL(s->w->path->rigid.n, 0);
    }
    scene_free(s);
}

int main(void)
{
    for (int kind = 0; kind < KINDS; kind++)
        for (int k = 0; k < 4; k++) check_group(kind, k & 1, k >> 1);
    for (int k = 0; k < 8; k++) check_bead(k & 1, k >> 1 & 1, k >> 2);
    none();
    return check_failures();
}
