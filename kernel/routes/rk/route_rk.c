/* route_rk.c - explicit 8th order (DOP853) in the explicit coordinates of the phase (tree.h), back on the
 * loop constraints after each step: begin, how long steps are.
 *
 * The step control aims well below the tolerance (safety 0.7): fewer rejections and errors several times smaller for the
 * same work.  The ledger feeds nothing back: it is integrated over the step by the stages that count.  Where energy is kept (energy_level.h) nothing but the impulses of the outer
 * world is in it, and they are evidence alone: the first step of PM_RK_LEDGER_STEPS is a sample of it, the others
 * take what the momenta say. */
#include <math.h>
#include <string.h>

#include "equations/case.h"
#include "equations/ledger.h"
#include "events/ask.h"
#include "events/event.h"
#include "events/gap_passage.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/rk/dop853.h"
#include "routes/rk/rk.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"
#include "tree/tree.h"

static int create(pm_workspace *w)
{
    if (PM_ARENA_NEW(&w->memory, w->rk)) return PM_NO_MEMORY;
    struct pm_rk *r = w->rk;
    const size_t n = 2 * (size_t)w->model->nq + (size_t)w->model->nz;
    const pm_array array[] = {
        PM_ARRAY(r->now, n),
        PM_ARRAY(r->y0, n),
        PM_ARRAY(r->y, n),
        PM_ARRAY(r->scale, n + 1),
        PM_ARRAY(r->k, ALL_STAGES * n + 1),
        PM_ARRAY(r->side, STAGES * n),
        PM_ARRAY(r->dense, PM_RK_DENSE * n),
        PM_ARRAY(r->middle, n),
        PM_ARRAY(r->timed, 2 * w->model->rows[PM_TABLE_FORCE] + w->model->nconstraint),
    };
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

/* x^(-1/8) */
static double eighth_root_of_inverse(double x) { return 1 / sqrt(sqrt(sqrt(x))); }

static int begin(pm_workspace *w)
{
    struct pm_rk *r = w->rk;
    pm_event_hold_on_zero(w);
    pm_tree_build(w);
    pm_frame_look_state(&w->frame, &w->state);
    r->n = w->tree->n;
    r->all = 2 * r->n + w->model->nz;
    r->controlled = 2 * r->n + w->model->nz_controlled;
    pm_tree_read(w->tree, &w->frame, r->now);
    pm_tree_read_rates(w->tree, w->state.v, r->now + r->n);
    pm_tree_sum_up(w);
    pm_tree_small_sum_up(w);
    w->tree->part.independence = 1;
    if (w->phase.singular)
        pm_tree_partition(&w->frame, w->tree);
    else
        pm_rk_choose_coordinates(w);
    memcpy(r->now + 2 * r->n, w->state.z, (size_t)w->model->nz * sizeof(double));
    r->k0_ready = r->dense_ready = 0;
    r->suspect = r->clear = 0;
    r->first = w->result.count[PM_COUNT_STEPS];
    r->next_ledger = 1;
    pm_frame_momentum(&w->frame, PM_NONE, r->momentum_now);
    if (w->state.t > r->end) r->next = 0; /* another route was here in between */
    pm_energy_level_begin(w, &r->level);
    pm_rk_set_scale(w);
    pm_rk_time_begin(w);
    return PM_OK;
}

/* In which a body rotates by about 1: of rates and accelerations k[2 n] of the coordinates, or of the bodies
 * in the frame. */
static double rotation_time(const pm_workspace *w, const double *k)
{
    const int n = w->rk->n;
    double square = 0;
    for (int i = 0; w->rk->swift && i < n; i++)
        if (pm_tree_is_angle(w->tree, i)) square = pm_max(square, pm_max(k[i] * k[i], fabs(k[n + i])));
    for (int i = 2; !w->rk->swift && i < w->model->nq; i += 3)
        square = pm_max(square, pm_max(w->state.v[i] * w->state.v[i], fabs(w->frame.a[i])));
    return w->numbers.coarse / sqrt(square);
}

/* Where the derivative is k; where steps are sampled the frame knows the accelerations. */
static void set_times(pm_workspace *w, const double *k)
{
    struct pm_rk *r = w->rk;
    r->rotation_time = rotation_time(w, k);
    if (!pm_rk_is_sampled(w)) return;
    r->own = pm_case_time_scale(w->model, &w->numbers, w->state.v, w->frame.a);
    r->meeting = w->event->nfunction > 0 ? pm_gap_passage_time(w, w->frame.velocity, w->frame.a) : INFINITY;
}

/* A step that is sampled for events or extremes may not outrun the motion, even where the formula would be
 * exact, and not carry circles through each other between two samples.  Nor may one in which reactions turn
 * with the bodies: the ledger of impulses, which does not choose the steps, is their integral. */
static double longest_step(const pm_workspace *w)
{
    if (pm_rk_is_sampled(w)) return fmin(w->rk->own, w->rk->meeting);
    return w->active.n > 0 ? w->rk->rotation_time : INFINITY;
}

/* Whether the next step integrates the ledger, and needs reactions for it.  (Windows of a step are counted as steps, too: what
 * is said of the next one is kept until then.) */
static int samples_ledger(const pm_result *result, const struct pm_rk *r)
{
    return !r->level.kept || (result->count[PM_COUNT_STEPS] - r->first) % PM_RK_LEDGER_STEPS == 0;
}

/* The derivative at the end of a step, for the next one; what accelerations of the bodies are wanted in the
 * frame, which looks there. */
static int last_stage(pm_workspace *w)
{
    struct pm_rk *r = w->rk;
    double *k = r->k + STAGES * r->all;
    r->next_ledger = samples_ledger(&w->result, w->rk);
    if (r->next_ledger) return pm_rk_derivative_here(w, r->now, 1, k);
    const int status =
        r->swift ? pm_rk_derivative(w, w->state.t, r->now, 0, k) : pm_rk_derivative_here(w, r->now, 0, k);
    const int wanted = !r->swift || pm_rk_is_sampled(w); /* by set_times */
    if (!status && wanted && !w->tree->part.few)
        pm_tree_spread_accelerations(w->tree, &w->frame, k + r->n, w->frame.a);
    return status;
}

/* Each step is rounded: what becomes of that in a long run, a coarse one shows (study/accuracy.c).  What does not move is not
 * rounded anew. */
static void disturb(pm_evidence *evidence, struct pm_rk *r)
{
    if (!pm_evidence_is_coarse(evidence) || evidence->calm) return;
    for (int i = 0; i < 2 * r->n; i++)
        if (fabs(r->now[i] - r->y0[i]) > PM_EVIDENCE_MOVES * fabs(r->now[i]))
            r->now[i] *= 1 + PM_EVIDENCE_STEP * pm_evidence_noise(evidence, i);
}

static void note_end(struct pm_rk *r, double t)
{
    if (r->nended < PM_RK_NOTED) r->ended[r->nended++] = t;
}

/* A step from t0 to t: the one before may have been cut, or another route was here in between. */
static void note_step(struct pm_rk *r, double t)
{
    while (r->nended > 0 && r->ended[r->nended - 1] > r->t0) r->nended--;
    if (r->nended == 0 || r->ended[r->nended - 1] < r->t0) note_end(r, r->t0);
    note_end(r, t);
}

static int accept(pm_workspace *w, double t)
{
    struct pm_rk *r = w->rk;
    memcpy(r->now, r->y, (size_t)r->all * sizeof(double));
    disturb(&w->evidence, w->rk);
    pm_rk_choose_coordinates(w);
    double gained;
    int status = pm_rk_settle(w, t, r->now, &w->state, &gained);
    if (status) return status;
    pm_energy_level_note(&w->frame, &w->ledger, &r->level, gained);
    pm_frame_momentum(&w->frame, PM_NONE, r->momentum_now);
    if (!pm_evidence_is_coarse(&w->evidence)) note_step(r, t);
    w->result.count[PM_COUNT_STEPS]++;
    if ((status = last_stage(w))) return status;
    set_times(w, r->k + STAGES * r->all);
    pm_rk_look_for_stiffness(w);
    r->dense_ready = 0;
    pm_step_set(&w->step, r->t0, r->end = t);
    if (pm_case_speed(w->model, &w->numbers, w->state.v)) pm_rk_set_scale(w);
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
    const int status = pm_rk_derivative(w, r->t0, r->y0, 1, r->k);
    if (status) return status;
    r->k0_ready = 1;
    set_times(w, r->k);
    if (r->next == 0)
        r->next = fmin(pm_case_time_scale(w->model, &w->numbers, w->state.v, w->frame.a), 1e3) *
                  (w->phase.singular ? PM_RK_OVER : eighth_root_of_inverse(1 / w->numbers.tolerance));
    return PM_OK;
}

/* A stage was near a singular position: how long the step is makes no difference to its error, but where
 * its stages are does. */
static int met_singular(const pm_tree *t)
{
    return t->part.few && t->part.least_regular < PM_RK_NEAR_SINGULAR * t->part.most_regular;
}

/* The length to try after n others: alternately longer, as far as that goes, and shorter than the first. */
static double sidestep(double first, double longest, int n)
{
    const double factor = pow(PM_RK_SIDESTEP, (n + 1) / 2);
    return n % 2 && first * factor <= longest ? first * factor : first / factor;
}

/* Coordinates for a step that was singular somewhere: chosen at that place, they may not determine the others where the step
 * begins, and then are chosen there. */
static int choose_again(pm_workspace *w)
{
    struct pm_rk *r = w->rk;
    if (!pm_rk_choose_coordinates(w)) return PM_OK;
    const int status = pm_rk_derivative(w, r->t0, r->y0, 1, r->k);
    if (status != PM_SINGULAR) return status;
    pm_tree_partition(&w->frame, w->tree);
    return pm_rk_derivative(w, r->t0, r->y0, 1, r->k);
}

/* What is left of the half in which t lies of a step of the main run; INFINITY after the last of them.  It goes on a little beyond the
 * end: a main step may end where something switches, or is greatest, and there this run must find its own place. */
static double rest_of_half(const struct pm_rk *r, double t)
{
    double begin = 0;
    for (int i = 0; i < r->nended; begin = r->ended[i++]) {
        const double half = 0.5 * (r->ended[i] - begin), least = PM_RK_REST_OF_HALF * half;
        if (r->ended[i] - half - t > least) return r->ended[i] - half - t;
        if (r->ended[i] - t > least) return r->ended[i] + PM_RK_BEYOND_END * half - t;
    }
    return INFINITY;
}

/* A coarse run that took the steps of the main one would have its error, and one that takes a few others might have it by chance: it
 * takes in halves what the main one covers in a single step, or in few. */
static double coarse_step(const pm_workspace *w, double h, int begins, double whole)
{
    if (pm_evidence_is_fine(&w->evidence)) h = fmin(rest_of_half(w->rk, w->rk->t0), h);
    return begins && h >= w->numbers.coarse * whole ? 0.5 * whole : h;
}

static int step(pm_workspace *w, double t_limit)
{
    struct pm_rk *r = w->rk;
    r->t0 = w->state.t;
    r->ledger = r->next_ledger;
    memcpy(r->momentum, r->momentum_now, sizeof r->momentum);
    memcpy(r->y0, r->now, (size_t)r->all * sizeof(double));
    if (r->swift) pm_tree_small_refer(&w->frame, w->tree, r->y0);
    const int begins = !r->k0_ready;
    int status = first_stage(w);
    if (status) return status;
    /* the end of the phase before may have been so near to a singular place that its steps had no length */
    double h = fmin(fmax(r->next, 2 * PM_RK_LEAST_STEP * fabs(r->t0)), longest_step(w));
    if (w->numbers.coarse > 1) h = coarse_step(w, h, begins, t_limit - r->t0);
    double first = h;
    for (int rejected = 0, sidesteps = 0;;) {
        /* what would be left may be too short for a step of its own */
        const int last = r->t0 + h >= t_limit - 2 * PM_RK_LEAST_STEP * fabs(t_limit);
        h = last ? t_limit - r->t0
                 : r->t0 + h - r->t0; /* exactly what the time goes on by, however late it is */
        if (!(h > PM_RK_LEAST_STEP * fabs(r->t0)))
            return pm_fail(&w->result, PM_STEP_TOO_SMALL, PM_NONE, PM_NONE, h,
                           PM_RK_LEAST_STEP * fabs(r->t0));
        pm_tree_forget_regular(w->tree);
        status = pm_rk_stages(w, h, r->k, r->y);
        const double error = status ? INFINITY : pm_rk_step_error(w, h);
        if (status && status != PM_SINGULAR) return status;
        if (error <= 1) {
            const double factor = error > 0 ? PM_RK_SAFETY * eighth_root_of_inverse(error) : PM_RK_GROW;
            const double proposed = h * fmin(rejected ? 1 : PM_RK_GROW, fmax(PM_RK_SHRINK, factor));
            r->h = h;
            r->next = last && proposed < r->next ? r->next : proposed;
            return accept(w, last ? t_limit : r->t0 + h);
        }
        rejected++;
        /* singular somewhere in the step */
        const int few = w->tree->part.few;
        if ((status = choose_again(w))) return status;
        if (sidesteps < PM_RK_SIDESTEPS && met_singular(w->tree))
            h = sidestep(first, longest_step(w), ++sidesteps);
        else if (few == w->tree->part.few)
            first = h *= isfinite(error) ? fmax(PM_RK_SHRINK, PM_RK_SAFETY * eighth_root_of_inverse(error))
                                         : PM_RK_FIRST_RETRY;
    }
}

static void forget(pm_workspace *w)
{
    w->rk->next = 0;
    w->rk->level.returned = 0;
    if (!pm_evidence_is_coarse(&w->evidence)) w->rk->nended = 0;
}

const pm_route_ops pm_route_rk = {
    .route = PM_ROUTE_RK,
    .create = create,
    .forget = forget,
    .begin = begin,
    .step = step,
    .at = pm_rk_at,
    .exact = pm_rk_exact,
    .look = pm_rk_look,
    .finest = PM_RK_TIGHTEST / PM_RK_MARGIN,
    .spread = 36,
    .steps_by_tolerance = 0.125, /* order 8 */
    .in_time = 1,
    .on_tree = 1,
    .price = 3,
    .nodes = &pm_chebyshev_nodes_equal,
};
