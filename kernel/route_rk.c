/* route_rk.c - explicit 8th order (DOP853) in the explicit coordinates of the phase (tree.h), back on the loop rows after
 * each step.
 *
 * y = (coordinates, their rates, z), y' = (rates, accelerations(t, y), z').  Error in the norm of Hairer, Norsett,
 * Wanner I, II.10, lengths against the scene's size, angles against 1 rad (they grow with every turn), speeds against
 * its speed.  The step control aims well below the tolerance (safety 0.7): fewer rejections and errors several times
 * smaller for the same work.  The ledger feeds nothing back: it is integrated over the step by the stages that count.
 * Where energy is kept (energy.h) nothing but the impulses of the outer world is in it, and they are evidence alone: the
 * first step of LEDGER_STEPS is a sample of it, the others take what the momenta say. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ask.h"
#include "audit.h"
#include "body.h"
#include "case.h"
#include "clear.h"
#include "dop853.h"
#include "energy.h"
#include "error.h"
#include "event.h"
#include "greater.h"
#include "pair.h"
#include "route.h"
#include "saddle.h"
#include "tree.h"
#include "tree_swift.h"

#define MARGIN 0.1       /* of the accuracy asked: errors of steps add up, and grow with the motion */
#define LEVEL_MARGIN 0.3 /* where energy holds a single freedom on its path: only delays add up */
#define TIGHTEST 5e-15   /* below it the error estimate is rounding */
#define SAFETY 0.7
#define SHRINK 0.2
#define GROW 4.0
#define DENSE 7          /* coefficients of the dense output */
#define LEAST_STEP 8e-16 /* of the time: below it a step changes nothing */
#define FIRST_RETRY 0.25
#define SIDESTEP 1.2 /* a step a little longer, or shorter, has its stages elsewhere */
#define SIDESTEPS 12
#define NEAR_SINGULAR 0.2 /* of the step's most regular stage: rounding is amplified there */
#define OVER 0.3          /* of the motion's own time: a first step that passes a singular position */
#define LEDGER_STEPS 16   /* reactions in all stages that count are much more work than all else in a step */

struct pm_rk {
    int n;          /* coordinates of the phase */
    int all;        /* 2 n + nz */
    int controlled; /* 2 n + nz_controlled: what stages need */
    double *now;    /* [all] at w->state */
    double *y0, *y; /* [all] begin of the step; stage */
    double *k;      /* [ALL_STAGES][all] */
    double *side;   /* [STAGES][all] stages of `exact`, so that the dense output stays */
    double *dense;  /* [DENSE][all] */
    double *middle; /* [all] between the halves of a step */
    double *scale;  /* [controlled] reciprocal error weights */
    double own;     /* the motion's own time at the end of the last step */
    double turning; /* that of the bodies' turning alone */
    double meeting; /* that of open contacts (clear.c) */
    double t0, h;   /* the last step as integrated */
    double end;     /* where it ended */
    double next;    /* step to try next, 0: none known */
    int dense_ready, k0_ready;
    pm_energy_level level;                               /* of the energy, where it is kept */
    int ledger;                                          /* the last step integrates the ledger */
    int64_t first;                                       /* number of the phase's first step */
    int swift;                                           /* accelerations need no frame: tree_swift.h */
    double momentum[PM_LEDGER], momentum_now[PM_LEDGER]; /* at its begin; at w->state */
    void *block;
};

static int create(pm_workspace *w)
{
    struct pm_rk *r = w->rk = calloc(1, sizeof *r);
    if (!r) return PM_NO_MEMORY;
    const size_t n = 2 * (size_t)w->model->nq + (size_t)w->model->nz;
    double *p = r->block = calloc((5 + ALL_STAGES + STAGES + DENSE) * n + 1, sizeof *p);
    if (!p) return PM_NO_MEMORY;
    r->now = p;
    r->y0 = r->now + n;
    r->y = r->y0 + n;
    r->scale = r->y + n;
    r->k = r->scale + n;
    r->side = r->k + ALL_STAGES * n;
    r->dense = r->side + STAGES * n;
    r->middle = r->dense + DENSE * n;
    return PM_OK;
}

static void destroy(pm_workspace *w)
{
    if (!w->rk) return;
    free(w->rk->block);
    free(w->rk);
    w->rk = NULL;
}

/* The rest of y' once its accelerations are there; the ledger's part needs the frame to look at y. */
static void complete(pm_workspace *w, const double *y, int with_ledger, double *k)
{
    const struct pm_rk *r = w->rk;
    for (int i = 0; i < r->n; i++) k[i] = y[r->n + i];
    if (with_ledger) {
        pm_tree_tell(w, k + r->n);
        pm_audit_rates(w, k + 2 * r->n);
    } else if (r->controlled > 2 * r->n) {
        pm_audit_controlled_rates(w, k + 2 * r->n);
    }
}

/* y' at the frame, which looks at y. */
static int derivative_here(pm_workspace *w, const double *y, int with_ledger, double *k)
{
    const int status = pm_tree_accelerate(w, k + w->rk->n);
    if (status) return status;
    complete(w, y, with_ledger, k);
    /* all stages by one formula: two that differ by rounding would make a body at rest sway */
    return w->rk->swift ? pm_swift_derivative(w, y, k) : PM_OK;
}

/* y' at (t, y). */
static int derivative(pm_workspace *w, double t, double *y, int with_ledger, double *k)
{
    const int n = w->rk->n;
    int status = PM_OK;
    if (!with_ledger && w->rk->swift) return pm_swift_derivative(w, y, k);
    if (w->tree->few) {
        status = pm_tree_settle(w, t, y, y + n, y + 2 * n);
    } else if (!with_ledger && w->rk->controlled == 2 * n) {
        status = pm_tree_accelerate_at(w, t, y, y + n, y + 2 * n, k + n);
        if (!status) complete(w, y, 0, k);
        return status;
    } else {
        pm_tree_look(w, t, y, y + n, y + 2 * n);
    }
    return status ? status : derivative_here(w, y, with_ledger, k);
}

static void set_scale(pm_workspace *w)
{
    const pm_model *m = w->model;
    struct pm_rk *r = w->rk;
    /* in independent coordinates the others are found by closing loops: there errors of the place count, too */
    const int on_level = r->level.kept && w->tree->n - w->tree->nloop == 1 && !w->tree->few;
    const double tolerance = fmax((on_level ? LEVEL_MARGIN : MARGIN) * w->tolerance, TIGHTEST);
    for (int i = 0; i < r->n; i++) {
        const int angle = pm_tree_is_angle(w, i);
        r->scale[i] = 1 / (tolerance * (angle ? 1 : w->size));
        r->scale[r->n + i] = 1 / (tolerance * (angle ? w->speed / w->size : w->speed));
    }
    for (int i = 0; i < m->nz_controlled; i++)
        r->scale[2 * r->n + i] = 1 / (tolerance * pm_audit_controlled_scale(w, i));
}

/* y = y0 + h sum_k weight[k] stage[k] for the first n of `stride` entries; k is 0 and from .. to - 1. */
static inline void combine(int n, int stride, const double *y0, double h, const double *weight, int from,
                           int to, const double *stage, double *y)
{
    int i = 0;
    for (; i + 4 <= n; i += 4) {
        const double *x = stage + i;
        pm_pair first = weight[0] * pm_pair_load(x), second = weight[0] * pm_pair_load(x + 2);
        x += from * stride;
        for (int k = from; k < to; k++, x += stride) {
            first += weight[k] * pm_pair_load(x);
            second += weight[k] * pm_pair_load(x + 2);
        }
        pm_pair_store(y + i, pm_pair_load(y0 + i) + h * first);
        pm_pair_store(y + i + 2, pm_pair_load(y0 + i + 2) + h * second);
    }
    for (; i < n; i++) {
        double sum = weight[0] * stage[i];
        for (int k = from; k < to; k++) sum += weight[k] * stage[k * stride + i];
        y[i] = y0[i] + h * sum;
    }
}

/* Stages 1..11 from stage 0, and the end of the step in y. */
static int stages(pm_workspace *w, double h, double *k, double *y)
{
    struct pm_rk *r = w->rk;
    const int swift = r->swift;
    for (int s = 1; s < STAGES; s++) {
        combine(r->controlled, r->all, r->y0, h, stage_weight[s], stage_from[s], s, k, y);
        const int with_ledger = r->ledger && step_weight[s] != 0;
        const int status = swift && !with_ledger
                               ? pm_swift_derivative(w, y, k + s * r->all)
                               : derivative(w, r->t0 + stage_time[s] * h, y, with_ledger, k + s * r->all);
        if (status) return status;
    }
    const int n = r->ledger ? r->all : r->controlled;
    combine(n, r->all, r->y0, h, step_weight, STEP_FROM, STAGES, k, y);
    memcpy(y + n, r->y0 + n, (size_t)(r->all - n) * sizeof *y);
    return PM_OK;
}

/* Sum of the squares of scale times sum_k weight[k] stage[k]; k is 0 and STEP_FROM .. STAGES - 1. */
static double error_square(const struct pm_rk *r, const double *weight)
{
    const int n = r->controlled;
    pm_pair sum = {0, 0};
    for (int i = 0; i < n; i += 2) {
        const double *k =
            r->k + STEP_FROM * r->all + i; /* one number more than there are is read, not used */
        pm_pair e = weight[0] * pm_pair_load(r->k + i);
        for (int s = STEP_FROM; s < STAGES; s++, k += r->all) e += weight[s] * pm_pair_load(k);
        e *= pm_pair_load(r->scale + i);
        if (i + 1 == n) e[1] = 0;
        sum += e * e;
    }
    return sum[0] + sum[1];
}

static double error_norm(const pm_workspace *w, double h)
{
    const struct pm_rk *r = w->rk;
    const double sum5 = error_square(r, error_weight_5);
    return sum5 == 0 ? 0
                     : fabs(h) * sum5 / sqrt((sum5 + 0.01 * error_square(r, error_weight_3)) * r->controlled);
}

/* x^(-1/8) */
static double eighth_root_of_inverse(double x) { return 1 / sqrt(sqrt(sqrt(x))); }

/* Where the last stages were, or nearly. */
static int choose_coordinates(pm_workspace *w)
{
    const int bad = !w->asymmetric && (pm_tree_is_steep(w) || pm_tree_is_flat(w));
    if (bad) pm_tree_partition(w);
    w->tree->independence = 1;
    w->rk->swift = w->rk->controlled == 2 * w->rk->n && pm_swift_applies(w);
    return bad && w->tree->few;
}

static int begin(pm_workspace *w)
{
    struct pm_rk *r = w->rk;
    pm_tree_build(w);
    pm_frame_look_state(w, &w->state);
    r->n = w->tree->n;
    r->all = 2 * r->n + w->model->nz;
    r->controlled = 2 * r->n + w->model->nz_controlled;
    pm_tree_read(w, r->now);
    pm_tree_read_rates(w, w->state.v, r->now + r->n);
    pm_tree_sum_up(w);
    pm_swift_sum_up(w);
    w->tree->independence = 1;
    if (w->singular)
        pm_tree_partition(w);
    else
        choose_coordinates(w);
    memcpy(r->now + 2 * r->n, w->state.z, (size_t)w->model->nz * sizeof(double));
    r->k0_ready = r->dense_ready = 0;
    r->first = w->count[PM_COUNT_STEPS];
    pm_body_momentum(w, PM_NONE, r->momentum_now);
    /* a new case owes nothing to the last one, nor a phase to what another route has left behind */
    if (w->count[PM_COUNT_STEPS] == 0 || w->state.t > r->end) r->next = 0;
    pm_energy_begin(w, &r->level);
    set_scale(w);
    return PM_OK;
}

/* In which a body turns by about 1: of rates and accelerations k[2 n] of the coordinates, or of the bodies in the frame. */
static double turning_time(const pm_workspace *w, const double *k)
{
    const int n = w->rk->n;
    double square = 0;
    for (int i = 0; w->rk->swift && i < n; i++)
        if (pm_tree_is_angle(w, i)) square = pm_greater(square, pm_greater(k[i] * k[i], fabs(k[n + i])));
    for (int i = 2; !w->rk->swift && i < w->model->nq; i += 3)
        square = pm_greater(square, pm_greater(w->state.v[i] * w->state.v[i], fabs(w->frame.a[i])));
    return w->coarse / sqrt(square);
}

static int is_sampled(const pm_workspace *w) { return w->event->nfunction > 0 || w->ask->nobserver > 0; }

/* Where the derivative is k; where steps are sampled the frame knows the accelerations. */
static void set_times(pm_workspace *w, const double *k)
{
    struct pm_rk *r = w->rk;
    r->turning = turning_time(w, k);
    if (!is_sampled(w)) return;
    r->own = pm_case_time_scale(w, w->state.v, w->frame.a);
    r->meeting = w->event->nfunction > 0 ? pm_clear_time(w) : INFINITY;
}

/* A step that is sampled for events or extremes may not outrun the motion, even where the formula would be exact, and not
 * carry circles through each other between two samples.  Nor may one in which reactions turn with the bodies: the ledger
 * of impulses, which does not choose the steps, is their integral. */
static double longest_step(const pm_workspace *w)
{
    if (is_sampled(w)) return fmin(w->rk->own, w->rk->meeting);
    return w->nactive > 0 ? w->rk->turning : INFINITY;
}

/* Coordinates y, where the frame looks, as a state. */
static void tell(const pm_workspace *w, double t, const double *y, pm_state *s)
{
    memcpy(s->q, w->tree->q, (size_t)w->model->nq * sizeof *y);
    memcpy(s->v, w->tree->v, (size_t)w->model->nq * sizeof *y);
    memcpy(s->z, y + 2 * w->rk->n, (size_t)w->model->nz * sizeof *y);
    s->t = t;
}

/* Rates, where the frame looks, to the energy of the phase; the energy that they gain. */
static double restore_energy(pm_workspace *w, double *rates)
{
    double gained;
    const double factor = pm_energy_factor(w, &w->rk->level, &gained);
    for (int i = 0; i < w->rk->n && factor != 1; i++) rates[i] *= factor;
    for (int i = 0; i < w->model->nq && factor != 1; i++) w->frame.velocity[i] = w->tree->v[i] *= factor;
    /* evaluated loop rows; nothing drives them, so that this is quadratic in the rates */
    for (int i = 0; i < w->tree->nloop && factor != 1; i++) w->row[w->tree->loop[i]].gamma *= factor * factor;
    return gained;
}

/* Impulses of the outer world since the begin of the step, where the frame looks. */
static void follow_momenta(pm_workspace *w, double *impulse)
{
    double momentum[PM_LEDGER];
    pm_body_momentum(w, PM_NONE, momentum);
    for (int i = 0; i < PM_LEDGER; i++) impulse[i] += momentum[i] - w->rk->momentum[i];
}

/* y back on the rows and on the energy level, and the state there. */
static int settle(pm_workspace *w, double t, double *y, pm_state *s, double *gained)
{
    const int n = w->rk->n, status = pm_tree_project(w, t, y, y + n, y + 2 * n);
    if (status) return status;
    *gained = restore_energy(w, y + n);
    if (!w->rk->ledger) follow_momenta(w, y + 2 * n + pm_audit_ledger(w->model));
    tell(w, t, y, s);
    return PM_OK;
}

/* Whether the next step integrates the ledger, and needs reactions for it. */
static int samples_ledger(const pm_workspace *w)
{
    const struct pm_rk *r = w->rk;
    return !r->level.kept || (w->count[PM_COUNT_STEPS] - r->first) % LEDGER_STEPS == 0;
}

/* The derivative at the end of a step, for the next one; what accelerations of the bodies are wanted in the frame, which
 * looks there. */
static int last_stage(pm_workspace *w)
{
    struct pm_rk *r = w->rk;
    double *k = r->k + STAGES * r->all;
    if (samples_ledger(w)) return derivative_here(w, r->now, 1, k);
    const int status = r->swift ? derivative(w, w->state.t, r->now, 0, k) : derivative_here(w, r->now, 0, k);
    const int wanted = !r->swift || is_sampled(w); /* by set_times */
    if (!status && wanted && !w->tree->few) pm_tree_spread_accelerations(w, k + r->n, w->frame.a);
    return status;
}

static int accept(pm_workspace *w, double t)
{
    struct pm_rk *r = w->rk;
    memcpy(r->now, r->y, (size_t)r->all * sizeof(double));
    choose_coordinates(w);
    double gained;
    int status = settle(w, t, r->now, &w->state, &gained);
    if (status) return status;
    pm_energy_note(w, &r->level, gained);
    pm_body_momentum(w, PM_NONE, r->momentum_now);
    w->count[PM_COUNT_STEPS]++;
    if ((status = last_stage(w))) return status;
    set_times(w, r->k + STAGES * r->all);
    r->dense_ready = 0;
    w->step_begin = r->t0;
    w->step_end = r->end = t;
    if (pm_case_speed(w, w->state.v)) set_scale(w);
    return PM_OK;
}

/* The derivative at the begin of a step: that at the end of the last one, but for the first. */
static int first_stage(pm_workspace *w)
{
    struct pm_rk *r = w->rk;
    if (r->k0_ready) {
        memcpy(r->k, r->k + STAGES * r->all, (size_t)r->all * sizeof(double));
        return PM_OK;
    }
    const int status = derivative(w, r->t0, r->y0, 1, r->k);
    if (status) return status;
    r->k0_ready = 1;
    set_times(w, r->k);
    if (r->next == 0)
        r->next = fmin(pm_case_time_scale(w, w->state.v, w->frame.a), 1e3) *
                  (w->singular ? OVER : eighth_root_of_inverse(1 / w->tolerance));
    return PM_OK;
}

/* A stage was near a singular position: how long the step is makes no difference to its error, but where its stages are
 * does. */
static int met_singular(const pm_workspace *w)
{
    const pm_tree *t = w->tree;
    return t->few && t->least_regular < NEAR_SINGULAR * t->most_regular;
}

/* The length to try after n others: by turns longer, as far as that goes, and shorter than the first. */
static double sidestep(double first, double longest, int n)
{
    const double factor = pow(SIDESTEP, (n + 1) / 2);
    return n % 2 && first * factor <= longest ? first * factor : first / factor;
}

static int step(pm_workspace *w, double t_limit)
{
    struct pm_rk *r = w->rk;
    r->t0 = w->state.t;
    r->ledger = samples_ledger(w);
    memcpy(r->momentum, r->momentum_now, sizeof r->momentum);
    memcpy(r->y0, r->now, (size_t)r->all * sizeof(double));
    if (r->swift) pm_swift_refer(w, r->y0);
    int status = first_stage(w);
    if (status) return status;
    double h = fmin(r->next, longest_step(w)), first = h;
    for (int rejected = 0, sidesteps = 0;;) {
        const int last = r->t0 + h >= t_limit;
        if (last) h = t_limit - r->t0;
        if (!(h > LEAST_STEP * fabs(r->t0)))
            return pm_fail(w, PM_STEP_TOO_SMALL, PM_NONE, PM_NONE, h, LEAST_STEP * fabs(r->t0));
        pm_tree_forget_regular(w->tree);
        status = stages(w, h, r->k, r->y);
        const double error = status ? INFINITY : error_norm(w, h);
        if (status && status != PM_SINGULAR) return status;
        if (error <= 1) {
            const double factor = error > 0 ? SAFETY * eighth_root_of_inverse(error) : GROW;
            const double proposed = h * fmin(rejected ? 1 : GROW, fmax(SHRINK, factor));
            r->h = h;
            r->next = last && proposed < r->next ? r->next : proposed;
            return accept(w, last ? t_limit : r->t0 + h);
        }
        rejected++;
        /* singular somewhere in the step */
        const int few = w->tree->few;
        if (choose_coordinates(w) && (status = derivative(w, r->t0, r->y0, 1, r->k))) return status;
        if (sidesteps < SIDESTEPS && met_singular(w))
            h = sidestep(first, longest_step(w), ++sidesteps);
        else if (few == w->tree->few)
            first = h *= isfinite(error) ? fmax(SHRINK, SAFETY * eighth_root_of_inverse(error)) : FIRST_RETRY;
    }
}

/* The ledger is not asked for inside a step. */
static int prepare_dense(pm_workspace *w)
{
    struct pm_rk *r = w->rk;
    const int n = r->controlled, all = r->all;
    for (int s = STAGES + 1; s < ALL_STAGES; s++) {
        combine(n, all, r->y0, r->h, stage_weight[s], stage_from[s], s, r->k, r->y);
        const int status = derivative(w, r->t0 + stage_time[s] * r->h, r->y, 0, r->k + s * all);
        if (status) return status;
    }
    for (int i = 0; i < n; i++) {
        const double change = r->now[i] - r->y0[i], f0 = r->h * r->k[i], f1 = r->h * r->k[STAGES * all + i];
        r->dense[i] = change;
        r->dense[n + i] = f0 - change;
        r->dense[2 * n + i] = 2 * change - (f0 + f1);
        for (int d = 3; d < DENSE; d++) {
            double sum = 0;
            for (int s = 0; s < ALL_STAGES; s++) sum += dense_weight[d - 3][s] * r->k[s * all + i];
            r->dense[d * n + i] = r->h * sum;
        }
    }
    r->dense_ready = 1;
    return PM_OK;
}

static int at(pm_workspace *w, double t, pm_state *s)
{
    struct pm_rk *r = w->rk;
    const int n = r->controlled;
    if (!r->dense_ready) {
        const int status = prepare_dense(w);
        if (status) return status;
    }
    const double x = (t - r->t0) / r->h;
    for (int i = 0; i < n; i++) {
        double sum = 0;
        for (int d = DENSE - 1; d >= 0; d--) sum = (sum + r->dense[d * n + i]) * (d % 2 == 0 ? x : 1 - x);
        r->y[i] = r->y0[i] + sum;
    }
    memcpy(r->y + n, r->y0 + n, (size_t)(r->all - n) * sizeof *r->y);
    pm_tree_look(w, t, r->y, r->y + r->n, r->y + 2 * r->n);
    tell(w, t, r->y, s);
    return PM_OK;
}

/* Accelerations and reactions for whoever watches, in the coordinates of the phase; where these are partitioned the loop
 * rows are not met to rounding inside a step.  The choice of coordinates does not depend on being watched. */
static int accelerate_watched(pm_workspace *w)
{
    pm_tree *t = w->tree;
    const double independence = t->independence;
    if (t->few) return pm_saddle_accelerate(w);
    const int status = pm_tree_accelerate(w, w->rk->side);
    if (!status) pm_tree_tell(w, w->rk->side);
    t->independence = independence;
    return status;
}

static int look(pm_workspace *w, double t, int level)
{
    if (t == w->step_end) {
        pm_frame_look_state(w, &w->state);
        return level == PM_LEVEL_DYNAMIC ? pm_saddle_accelerate(w) : PM_OK;
    }
    const int status = at(w, t, &w->probe);
    return !status && level == PM_LEVEL_DYNAMIC ? accelerate_watched(w) : status;
}

/* From the begin of the step to t in two halves: a phase that one step covers would have the same error in a companion
 * (error.c).  Stage 0 is in r->side. */
static int in_halves(pm_workspace *w, double t)
{
    struct pm_rk *r = w->rk;
    double *const y0 = r->y0;
    const double t0 = r->t0, h = 0.5 * (t - t0);
    int status = stages(w, h, r->side, r->y);
    memcpy(r->middle, r->y, (size_t)r->all * sizeof(double));
    r->y0 = r->middle;
    r->t0 = t0 + h;
    if (!status) status = derivative(w, r->t0, r->y0, 1, r->side);
    if (!status) status = stages(w, h, r->side, r->y);
    r->y0 = y0;
    r->t0 = t0;
    return status;
}

static int exact(pm_workspace *w, double t, pm_state *s)
{
    struct pm_rk *r = w->rk;
    const size_t bytes = (size_t)r->all * sizeof(double);
    double gained;
    int status = PM_OK;
    if (s != &w->state) pm_state_copy(s, &w->state);
    if (t == r->t0) {
        memcpy(r->y, r->y0, bytes);
    } else {
        memcpy(r->side, r->k, bytes);
        status = pm_error_in_halves(w) ? in_halves(w, t) : stages(w, t - r->t0, r->side, r->y);
    }
    return status ? status : settle(w, t, r->y, s, &gained);
}

const pm_route_ops pm_route_rk = {
    .route = PM_ROUTE_RK,
    .create = create,
    .free = destroy,
    .begin = begin,
    .step = step,
    .at = at,
    .exact = exact,
    .look = look,
    .finest = TIGHTEST / MARGIN,
    .spread = 45,
    .finds_roots = PM_ROOTS_NONE,
    .in_time = 1,
    .price = 3,
    .nodes = &pm_nodes_equal,
};
