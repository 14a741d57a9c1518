/* route_rk.c - explicit 8th order (DOP853) on accelerations from the saddle-point system, projected after each step.
 *
 * y = (q, v, z), y' = (v, a(t, q, v), z').  Error in the norm of Hairer, Norsett, Wanner I, II.10, lengths against the
 * scene's size, angles against 1 rad (they grow with every turn), speeds against its speed.  The step control aims well
 * below the tolerance (safety 0.7): fewer rejections and errors several times smaller for the same work. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ask.h"
#include "audit.h"
#include "body.h"
#include "case.h"
#include "dop853.h"
#include "event.h"
#include "project.h"
#include "route.h"
#include "saddle.h"

#define MARGIN 0.1     /* of the accuracy asked: errors of steps add up, and grow with the motion */
#define TIGHTEST 5e-15 /* below it the error estimate is rounding */
#define SAFETY 0.7
#define SHRINK 0.2
#define GROW 4.0
#define DENSE 7          /* coefficients of the dense output */
#define LEAST_STEP 8e-16 /* of the time: below it a step changes nothing */
#define FIRST_RETRY 0.25

struct pm_rk {
    int n;          /* 2 nq + nz */
    double *y0, *y; /* [n] begin of the step; stage */
    double *k;      /* [ALL_STAGES][n] */
    double *side;   /* [STAGES][n] stages of `exact`, so that the dense output stays */
    double *dense;  /* [DENSE][n] */
    double *scale;  /* [n] reciprocal error weights, 0: not controlled */
    double t0, h;   /* the last step as integrated */
    double next;    /* step to try next, 0: none known */
    int dense_ready, k0_ready;
    void *block;
};

static int create(pm_workspace *w)
{
    struct pm_rk *r = w->rk = calloc(1, sizeof *r);
    if (!r) return PM_NO_MEMORY;
    const size_t n = (size_t)(r->n = 2 * w->model->nq + w->model->nz);
    double *p = r->block = calloc((3 + ALL_STAGES + STAGES + DENSE) * n + 1, sizeof *p);
    if (!p) return PM_NO_MEMORY;
    r->y0 = p;
    r->y = r->y0 + n;
    r->scale = r->y + n;
    r->k = r->scale + n;
    r->side = r->k + ALL_STAGES * n;
    r->dense = r->side + STAGES * n;
    return PM_OK;
}

static void destroy(pm_workspace *w)
{
    if (!w->rk) return;
    free(w->rk->block);
    free(w->rk);
    w->rk = NULL;
}

/* y' at (t, y). */
static int derivative(pm_workspace *w, double t, const double *y, double *k)
{
    const int nq = w->model->nq;
    pm_frame_look(w, t, y, y + nq, y + 2 * nq, w->state.memory);
    const int status = pm_saddle_accelerate(w);
    if (status) return status;
    memcpy(k, y + nq, (size_t)nq * sizeof *k);
    memcpy(k + nq, w->frame.a, (size_t)nq * sizeof *k);
    pm_audit_rates(w, k + 2 * nq);
    return PM_OK;
}

static void set_scale(pm_workspace *w)
{
    const pm_model *m = w->model;
    struct pm_rk *r = w->rk;
    const double tolerance = fmax(MARGIN * w->tolerance, TIGHTEST);
    double mass = 0;
    for (int i = 0; i < m->nq; i++) {
        const int angle = i % 3 == 2;
        r->scale[i] = 1 / (tolerance * (angle ? 1 : w->size));
        r->scale[m->nq + i] = 1 / (tolerance * (angle ? w->speed / w->size : w->speed));
    }
    for (int i = 0; i < m->nbody; i++) mass += w->mass[i];
    for (int i = 0; i < m->nz; i++) {
        const int work = i < m->rows[PM_TABLE_FORCE]; /* forces come first, then paths */
        const double size = work ? mass * w->speed * w->speed : w->size;
        r->scale[2 * m->nq + i] = i < m->nz_controlled ? 1 / (tolerance * size) : 0;
    }
}

/* y = y0 + h sum_k weight[k] stage[k]; weights end with the last non-zero one. */
static void combine(int n, const double *y0, double h, const double *weight, int nweight, const double *stage,
                    double *y)
{
    for (int i = 0; i < n; i++) y[i] = 0;
    for (int s = 0; s < nweight; s++) {
        const double c = weight[s], *k = stage + s * n;
        if (c == 0) continue;
        for (int i = 0; i < n; i++) y[i] += c * k[i];
    }
    for (int i = 0; i < n; i++) y[i] = y0[i] + h * y[i];
}

/* Stages 1..11 from stage 0, and the end of the step in y. */
static int stages(pm_workspace *w, double h, double *k, double *y)
{
    struct pm_rk *r = w->rk;
    for (int s = 1; s < STAGES; s++) {
        combine(r->n, r->y0, h, stage_weight[s], s, k, y);
        const int status = derivative(w, r->t0 + stage_time[s] * h, y, k + s * r->n);
        if (status) return status;
    }
    combine(r->n, r->y0, h, step_weight, STAGES, k, y);
    return PM_OK;
}

static double error_norm(const pm_workspace *w, double h)
{
    const struct pm_rk *r = w->rk;
    double sum3 = 0, sum5 = 0;
    int n = 0;
    for (int i = 0; i < r->n; i++) {
        if (r->scale[i] == 0) continue;
        double e3 = 0, e5 = 0;
        for (int s = 0; s < STAGES; s++) {
            e3 += error_weight_3[s] * r->k[s * r->n + i];
            e5 += error_weight_5[s] * r->k[s * r->n + i];
        }
        e3 *= r->scale[i];
        e5 *= r->scale[i];
        sum3 += e3 * e3;
        sum5 += e5 * e5;
        n++;
    }
    return sum5 == 0 ? 0 : fabs(h) * sum5 / sqrt((sum5 + 0.01 * sum3) * n);
}

static int begin(pm_workspace *w)
{
    struct pm_rk *r = w->rk;
    r->k0_ready = r->dense_ready = 0;
    if (w->count[PM_COUNT_STEPS] == 0) r->next = 0; /* a new case owes nothing to the last one */
    set_scale(w);
    return PM_OK;
}

/* A step that is sampled for events or extremes may not outrun the motion, even where the formula would be exact. */
static double longest_step(const pm_workspace *w)
{
    return w->event->nfunction > 0 || w->ask->nobserver > 0 ? pm_case_time_scale(w, w->frame.v, w->frame.a)
                                                            : INFINITY;
}

static int accept(pm_workspace *w, double t, const double *y)
{
    struct pm_rk *r = w->rk;
    memcpy(w->state.q, y, (size_t)r->n * sizeof *y); /* q, v, z lie together */
    w->state.t = t;
    int status = pm_project(w, &w->state);
    if (!status) status = derivative(w, t, w->state.q, r->k + STAGES * r->n);
    r->dense_ready = 0;
    w->step_begin = r->t0;
    w->step_end = t;
    w->count[PM_COUNT_STEPS]++;
    if (!status && pm_case_speed(w, w->state.v)) set_scale(w);
    return status;
}

static int step(pm_workspace *w, double t_limit)
{
    struct pm_rk *r = w->rk;
    r->t0 = w->state.t;
    memcpy(r->y0, w->state.q, (size_t)r->n * sizeof(double));
    if (r->k0_ready)
        memcpy(r->k, r->k + STAGES * r->n, (size_t)r->n * sizeof(double));
    else {
        const int status = derivative(w, r->t0, r->y0, r->k);
        if (status) return status;
        r->k0_ready = 1;
        if (r->next == 0)
            r->next = fmin(pm_case_time_scale(w, w->frame.v, w->frame.a), 1e3) * pow(w->tolerance, 1.0 / 8);
    }
    pm_frame_look(w, r->t0, r->y0, r->y0 + w->model->nq, r->y0 + 2 * w->model->nq, w->state.memory);
    memcpy(w->frame.a, r->k + w->model->nq, (size_t)w->model->nq * sizeof(double));
    const double cap = longest_step(w);
    double h = fmin(r->next, cap);
    for (int rejected = 0;;) {
        const int last = r->t0 + h >= t_limit;
        if (last) h = t_limit - r->t0;
        if (!(h > LEAST_STEP * fabs(r->t0)))
            return pm_fail(w, PM_STEP_TOO_SMALL, PM_NONE, PM_NONE, h, LEAST_STEP * fabs(r->t0));
        const int status = stages(w, h, r->k, r->y);
        const double error = status ? INFINITY : error_norm(w, h);
        if (status && status != PM_SINGULAR) return status;
        if (error <= 1) {
            const double factor = error > 0 ? SAFETY * pow(error, -1.0 / 8) : GROW;
            const double proposed = h * fmin(rejected ? 1 : GROW, fmax(SHRINK, factor));
            r->h = h;
            r->next = last && proposed < r->next ? r->next : proposed;
            return accept(w, last ? t_limit : r->t0 + h, r->y);
        }
        rejected = 1;
        h *= isfinite(error) ? fmax(SHRINK, SAFETY * pow(error, -1.0 / 8)) : FIRST_RETRY;
    }
}

static int prepare_dense(pm_workspace *w)
{
    struct pm_rk *r = w->rk;
    const int n = r->n;
    for (int s = STAGES + 1; s < ALL_STAGES; s++) {
        combine(n, r->y0, r->h, stage_weight[s], s, r->k, r->y);
        const int status = derivative(w, r->t0 + stage_time[s] * r->h, r->y, r->k + s * n);
        if (status) return status;
    }
    const double *end = w->state.q;
    for (int i = 0; i < n; i++) {
        const double change = end[i] - r->y0[i], f0 = r->h * r->k[i], f1 = r->h * r->k[STAGES * n + i];
        r->dense[i] = change;
        r->dense[n + i] = f0 - change;
        r->dense[2 * n + i] = 2 * change - (f0 + f1);
        for (int d = 3; d < DENSE; d++) {
            double sum = 0;
            for (int s = 0; s < ALL_STAGES; s++) sum += dense_weight[d - 3][s] * r->k[s * n + i];
            r->dense[d * n + i] = r->h * sum;
        }
    }
    r->dense_ready = 1;
    return PM_OK;
}

static int at(pm_workspace *w, double t, pm_state *s)
{
    struct pm_rk *r = w->rk;
    const int n = r->n;
    if (!r->dense_ready) {
        const int status = prepare_dense(w);
        if (status) return status;
    }
    const double x = (t - r->t0) / r->h;
    double *y = s->q;
    for (int i = 0; i < n; i++) {
        double sum = 0;
        for (int d = DENSE - 1; d >= 0; d--) sum = (sum + r->dense[d * n + i]) * (d % 2 == 0 ? x : 1 - x);
        y[i] = r->y0[i] + sum;
    }
    s->t = t;
    return PM_OK;
}

static int exact(pm_workspace *w, double t, pm_state *s)
{
    struct pm_rk *r = w->rk;
    int status = PM_OK;
    if (s != &w->state) pm_state_copy(s, &w->state);
    if (t == r->t0) {
        memcpy(s->q, r->y0, (size_t)r->n * sizeof(double));
    } else {
        memcpy(r->side, r->k, (size_t)r->n * sizeof(double));
        status = stages(w, t - r->t0, r->side, r->y);
        memcpy(s->q, r->y, (size_t)r->n * sizeof(double));
    }
    s->t = t;
    return status ? status : pm_project(w, s);
}

const pm_route_ops pm_route_rk = {
    .route = PM_ROUTE_RK,
    .create = create,
    .free = destroy,
    .begin = begin,
    .step = step,
    .at = at,
    .exact = exact,
    .finest = TIGHTEST / MARGIN,
    .spread = 30,
    .finds_roots = 0,
    .in_time = 1,
    .price = 3,
    .nodes = &pm_nodes_equal,
};
