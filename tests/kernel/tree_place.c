/* Explicit coordinates: every placement against the rows that it solves, against differences of the positions, and there
 * and back; loop rows are met by Newton's method. */
#include "tree/tree.h"

#include "check.h"
#include "elements/constraint.h"
#include "equations/active_set.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree_node.h"

enum { MOST = 30 }; /* coordinates of a scene here */

static const double STEP = 1e-4; /* of the differences; they are of fourth order */

/* ---- scenes ---- */
static int rod(scene *s, double x, double y, double angle) { return scene_body(s, 1.3, 0.2, x, y, angle); }
static int ground(scene *s, double x, double y) { return scene_point(s, PM_GROUND, x, y); }

/* A pendulum of two rods and a particle at its end; the second joint names the child first, the third the parent. */
static scene *chain(void)
{
    scene *s = scene_create();
    const int a = rod(s, 0.5, 0, 0.3), b = rod(s, 1.2, -0.5, -0.9), p = scene_body(s, 0.4, 0, 1.5, -1.2, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -0.5, 0.1), ground(s, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.4, 0), scene_point(s, a, 0.5, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, 0.5, 0.2), scene_point(s, p, 0, 0), 0);
    return s;
}

/* Welded on from either side, on a body that is free. */
static scene *welded(void)
{
    scene *s = scene_create();
    const int a = rod(s, 0.3, 0.2, 0.4), b = rod(s, 1, 0.7, 1.1), c = rod(s, -0.6, 0, -0.2);
    scene_joint(s, PM_JOINT_WELD, scene_point(s, b, -0.4, 0.1), scene_point(s, a, 0.5, 0), 0.7);
    scene_joint(s, PM_JOINT_WELD, scene_point(s, a, -0.5, 0), scene_point(s, c, 0.4, -0.2), 0.6);
    return s;
}

/* Sliders that keep the direction, on ground and on each other: the point's body, then the line's, is the child. */
static scene *sliders(void)
{
    scene *s = scene_create();
    const int a = rod(s, 0.5, 0.6, 0.3), b = rod(s, 1.1, 0.2, 0.5), c = rod(s, 1, 1.4, 0.1);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -0.5, 0), ground(s, 0, 0), 0);
    scene_joint(s, PM_JOINT_SLIDER_FIXED, scene_point(s, b, 0.1, 0.2),
                scene_line(s, scene_point(s, a, 0.2, -0.1), 0.4), 0.2);
    scene_joint(s, PM_JOINT_SLIDER_FIXED, scene_point(s, a, 0.3, 0.2),
                scene_line(s, scene_point(s, c, -0.2, 0.1), -0.7), 0.5);
    return s;
}

/* A wheel rolls on the tilted edge of a rod that turns, and a bar rolls on the wheel. */
static scene *rolling_on_lines(void)
{
    scene *s = scene_create();
    const int a = rod(s, 0.5, 0, 0.2), wheel = scene_body(s, 2, 0.05, 0.4, 0.5, 0.7),
              bar = rod(s, 0.3, 0.9, 0.4);
    const int rim = scene_circle(s, scene_point(s, wheel, 0.03, -0.02), 0.3);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -0.5, 0), ground(s, 0, 0), 0);
    scene_joint(s, PM_JOINT_ROLLING_LINE, rim, scene_line(s, scene_point(s, a, 0.1, 0.05), 0.3), 0);
    scene_joint(s, PM_JOINT_ROLLING_LINE, rim, scene_line(s, scene_point(s, bar, 0, -0.05), 3.1), 0);
    return s;
}

/* Circles outside, a inside b and b inside a; the third has the parent as its first partner. */
static scene *rolling_on_circles(void)
{
    scene *s = scene_create();
    const int a = rod(s, 0.5, 0, 0.2), outside = scene_body(s, 2, 0.05, 1.3, 0.4, 0.7),
              inside = scene_body(s, 0.3, 0.01, 0.4, 0.3, -0.3), round = scene_body(s, 3, 2, 0.6, 0.1, 0);
    const int rim = scene_circle(s, scene_point(s, a, 0.1, 0), 0.5);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -0.5, 0), ground(s, 0, 0), 0);
    scene_joint(s, PM_JOINT_ROLLING_CIRCLE, scene_circle(s, scene_point(s, outside, 0.05, 0.02), 0.3), rim,
                1);
    scene_joint(s, PM_JOINT_ROLLING_CIRCLE, scene_circle(s, scene_point(s, inside, 0, 0.01), 0.2), rim, -1);
    scene_joint(s, PM_JOINT_ROLLING_CIRCLE, rim, scene_circle(s, scene_point(s, round, 0.04, 0), 0.8), -1);
    return s;
}

/* Contacts that stick are placed like rolling joints; a smooth one is left as a loop row. */
static scene *sticking(void)
{
    scene *s = scene_create();
    const int wheel = scene_body(s, 2, 0.05, 0, 0.3, 0), top = scene_body(s, 1, 0.02, 0, 0.8, 0);
    const int rim = scene_circle(s, scene_point(s, wheel, 0, 0), 0.3);
    scene_contact(s, PM_CONTACT_LINE, rim, scene_floor(s, 0), 0, 0, PM_FRICTION_ROUGH, 0);
    scene_contact(s, PM_CONTACT_CIRCLE, scene_circle(s, scene_point(s, top, 0, 0), 0.2), rim, 1, 0,
                  PM_FRICTION_ROUGH, 0);
    return s;
}

static scene *slider_crank(void)
{
    scene *s = scene_create();
    const int crank = rod(s, 0.1, 0.1, 0.8), rod2 = rod(s, 0.6, 0.1, -0.2), piston = rod(s, 1, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, crank, -0.15, 0), ground(s, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod2, -0.5, 0), scene_point(s, crank, 0.15, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod2, 0.5, 0), scene_point(s, piston, 0, 0), 0);
    scene_joint(s, PM_JOINT_SLIDER_FIXED, scene_point(s, piston, 0, 0), scene_floor(s, 0.1), -0.1);
    return s;
}

static scene *four_bar(void)
{
    scene *s = scene_create();
    const int a = rod(s, 0.1, 0.2, 1.2), b = rod(s, 0.6, 0.6, 0.3), c = rod(s, 1.1, 0.4, 1.5);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -0.2, 0), ground(s, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), scene_point(s, a, 0.2, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, c, -0.4, 0), ground(s, 1, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, c, 0.4, 0), scene_point(s, b, 0.5, 0), 0);
    return s;
}

/* A free slider is a loop row; the link leaves its own direction. */
static scene *ladder(void)
{
    scene *s = scene_create();
    const int a = rod(s, 0.3, 0.4, 2.2), p = scene_body(s, 0.5, 0, 0.9, 0.6, 0);
    scene_joint(s, PM_JOINT_SLIDER, scene_point(s, a, 0.5, 0), scene_line(s, ground(s, 0, 0), 2 * acos(0.)),
                0);
    scene_joint(s, PM_JOINT_SLIDER, scene_point(s, a, -0.5, 0), scene_floor(s, 0), 0);
    scene_joint(s, PM_JOINT_LINK, scene_point(s, p, 0, 0), scene_point(s, a, 0, 0.1), 0.6);
    return s;
}

/* Bodies that rotate and a particle, each the first or the second partner of its link. */
static scene *on_links(void)
{
    scene *s = scene_create();
    const int a = rod(s, 0.9, -0.5, 0.3), b = rod(s, 2.1, -0.8, -0.4),
              p = scene_body(s, 0.4, 0, 2.6, -1.7, 0);
    scene_joint(s, PM_JOINT_LINK, scene_point(s, a, -0.4, 0.1), ground(s, 0, 0), 0.7);
    scene_joint(s, PM_JOINT_LINK, scene_point(s, a, 0.5, 0), scene_point(s, b, -0.3, 0.2), 0.5);
    scene_joint(s, PM_JOINT_LINK, scene_point(s, p, 0, 0), scene_point(s, b, 0.4, 0), 0.8);
    return s;
}

static scene *free_bodies(void)
{
    scene *s = scene_create();
    rod(s, 1, 2, 0.4);
    scene_body(s, 1, 0, -1, 0.5, 0);
    return s;
}

typedef struct sample {
    const char *name;
    scene *(*make)(void);
    int n, nloop;
    int placement[4]; /* of the bodies, in order of their index */
} sample;

static const sample samples[] = {
    {"chain", chain, 2, 0, {PIN, PIN, PIN}},
    {"welded", welded, 3, 0, {FREE, WELD, WELD}},
    {"sliders", sliders, 3, 0, {PIN, SLIDER, SLIDER}},
    {"rolling on lines", rolling_on_lines, 3, 0, {PIN, ROLL_LINE, ROLL_LINE}},
    {"rolling on circles", rolling_on_circles, 4, 0, {PIN, ROLL_CIRCLE, ROLL_CIRCLE, ROLL_CIRCLE}},
    {"sticking", sticking, 2, 0, {ROLL_LINE, ROLL_CIRCLE}},
    {"slider-crank", slider_crank, 3, 2, {PIN, PIN, PIN}},
    {"four-bar", four_bar, 3, 2, {PIN, PIN, PIN}},
    {"ladder", ladder, 4, 2, {FREE, LINK}},
    {"on links", on_links, 5, 0, {LINK, LINK, LINK}},
    {"free", free_bodies, 5, 0, {FREE, FREE}},
};

/* ---- looks ---- */
static void place(pm_workspace *w, const double *y, double *q)
{
    pm_tree_place(w->tree, &w->frame, w->state.memory, y, q);
}

static void look(pm_workspace *w, const double *q, const double *v)
{
    pm_frame_look(&w->frame, 0, q, v, w->state.z, w->state.memory);
}

/* Derivatives of q along y + x ydot at x = 0: first and second, by differences of fourth order. */
static void differences(pm_workspace *w, const double *y, const double *ydot, double *first, double *second)
{
    const int nq = w->model->nq, n = w->tree->n;
    double q[5][MOST], there[MOST];
    for (int k = 0; k < 5; k++) {
        for (int i = 0; i < n; i++) there[i] = y[i] + (k - 2) * STEP * 10 * ydot[i];
        place(w, there, q[k]);
    }
    const double h = 10 * STEP;
    for (int i = 0; i < nq; i++) {
        first[i] = (8 * (q[3][i] - q[1][i]) - (q[4][i] - q[0][i])) / (12 * h);
        second[i] = (16 * (q[3][i] + q[1][i]) - 30 * q[2][i] - (q[4][i] + q[0][i])) / (12 * h * h);
    }
}

/* ---- checks ---- */
static void there_and_back(pm_workspace *w)
{
    double y[MOST], q[MOST], again[MOST];
    look(w, w->state.q, w->state.v);
    pm_tree_read(w->tree, &w->frame, y);
    place(w, y, q);
    for (int i = 0; i < w->model->nq; i++) NEAR(q[i], w->state.q[i], 1e-11);
    for (int i = 0; i < w->tree->n; i++) y[i] += check_random(-0.4, 0.4);
    place(w, y, q);
    look(w, q, w->state.v);
    pm_tree_read(w->tree, &w->frame, again);
    for (int i = 0; i < w->tree->n; i++) NEAR(again[i], y[i], 1e-13);
}

/* Wherever the coordinates are, the rows that the tree solves hold. */
static void meets_rows(pm_workspace *w, const double *q)
{
    look(w, q, w->state.v);
    for (int i = 0; i < w->active.n; i++) {
        if (!w->tree->used[i]) continue;
        pm_constraint_kind(w->active.constraint[i].kind)->evaluate(&w->frame, &w->active.constraint[i]);
        NEAR(w->active.constraint[i].g, 0, 1e-13);
    }
}

/* Velocities of all bodies at a unit rate of each coordinate, [nq][n]. */
static void columns(pm_workspace *w, double *basis)
{
    const pm_tree *t = w->tree;
    memset(basis, 0, (size_t)(w->model->nq * t->n) * sizeof *basis);
    pm_tree_influence(w->tree);
    for (int i = 0; i < w->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        for (int k = x->list; k < x->list + x->nlist; k++)
            for (int c = 0; c < 3; c++)
                basis[(3 * x->body + c) * t->n + t->moved_by[k]] = t->influence[3 * k + c];
    }
}

static void moves(pm_workspace *w)
{
    const int n = w->tree->n, nq = w->model->nq;
    double y[MOST], q[MOST], rate[MOST], v[MOST], a[MOST], basis[MOST * MOST], first[MOST], second[MOST];
    look(w, w->state.q, w->state.v);
    pm_tree_read(w->tree, &w->frame, y);
    for (int i = 0; i < n; i++) {
        y[i] += check_random(-0.3, 0.3);
        rate[i] = check_random(-1, 1);
    }
    differences(w, y, rate, first, second);
    place(w, y, q);
    meets_rows(w, q);
    pm_tree_spread(w->tree, rate, v);
    columns(w, basis);
    for (int i = 0; i < nq; i++) {
        double sum = 0;
        for (int k = 0; k < n; k++) sum += basis[i * n + k] * rate[k];
        NEAR(v[i], first[i], 1e-10);
        NEAR(sum, v[i], 1e-13);
    }
    look(w, q, v);
    pm_tree_bias(w->tree, &w->frame, a);
    for (int i = 0; i < nq; i++) NEAR(a[i], second[i], 1e-7);
}

/* The loop rows' Jacobian against differences of their residuals; Newton's method meets them with one kept. */
static void closes(pm_workspace *w)
{
    const int n = w->tree->n, nloop = w->tree->nloop;
    double y[MOST], q[MOST], basis[MOST * MOST], jacobian[MOST * MOST], g[2][MOST];
    int low[MOST], high[MOST];
    const pm_loops loops = {jacobian, low, high};
    if (nloop == 0) return;
    pm_tree_loops_unknown(w->tree, &loops);
    for (int k = 0; k < n; k++) {
        for (int side = 0; side < 2; side++) {
            look(w, w->state.q, w->state.v);
            pm_tree_read(w->tree, &w->frame, y);
            y[k] += (side ? 1 : -1) * STEP;
            place(w, y, q);
            look(w, q, w->state.v);
            columns(w, basis);
            pm_tree_loops(w->tree, &w->frame, &loops);
            for (int i = 0; i < nloop; i++) g[side][i] = w->active.constraint[w->tree->loop[i]].g;
        }
        look(w, w->state.q, w->state.v);
        pm_tree_read(w->tree, &w->frame, y);
        columns(w, basis);
        pm_tree_loops(w->tree, &w->frame, &loops);
        for (int i = 0; i < nloop; i++) NEAR(jacobian[i * n + k], (g[1][i] - g[0][i]) / (2 * STEP), 1e-6);
    }
    if (n != nloop + 1) return;
    look(w, w->state.q, w->state.v);
    pm_tree_read(w->tree, &w->frame, y);
    y[n - 1] += 0.02;
    const double kept = y[n - 1];
    pm_tree_hold(w->tree, n - 1);
    EQUAL(pm_tree_close(w, y, q, &loops), PM_OK);
    EQUAL(y[n - 1], kept);
    place(w, y, q);
    look(w, q, w->state.v);
    for (int i = 0; i < w->active.n; i++) {
        pm_constraint_kind(w->active.constraint[i].kind)->evaluate(&w->frame, &w->active.constraint[i]);
        NEAR(w->active.constraint[i].g, 0, 1e-13);
    }
    y[n - 1] += 50; /* out of reach for lengths, another turn for angles: it converges or says so */
    const int status = pm_tree_close(w, y, q, &loops);
    CHECK(status == PM_OK || status == PM_SINGULAR || status == PM_ASSEMBLY);
}

static void check_sample(const sample *x)
{
    const int before = check_count;
    scene *s = x->make();
    if (CHECK(scene_begin(s) == PM_OK)) {
        pm_workspace *w = s->w;
        pm_tree_build(w);
        EQUAL(w->tree->n, x->n);
        EQUAL(w->tree->nloop, x->nloop);
        for (int i = 0; i < w->model->nbody; i++)
            EQUAL(w->tree->node[i].placement, x->placement[w->tree->node[i].body]);
        there_and_back(w);
        for (int i = 0; i < 5; i++) moves(w);
        closes(w);
    }
    scene_free(s);
    if (check_count > before) fprintf(stderr, "in %s\n", x->name);
}

int main(void)
{
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) check_sample(&samples[i]);
    return check_failures();
}
