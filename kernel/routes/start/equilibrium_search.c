/* equilibrium_search.c - an equilibrium near a state: F(s, 0) = 0, F the accelerations of free coordinates s (free_motion.h).
 *
 * Newton's method, s = -K^-1 F with K = dF/ds, whose steps must lower |F|; directions in which nothing acts stay as they are
 * (the pseudoinverse of K).  Where it leads nowhere the scene sinks, as in a thick fluid, s' = F, by steps
 * s = (I/d - K)^-1 F that get longer as |F| falls, and Newton's method ends that. */
#include "routes/start/equilibrium_search.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "elements/trigger.h"
#include "elements/turning_plane.h"
#include "equations/active_set.h"
#include "equations/projection.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"
#include "state/frame.h"

/* ---- forces and their derivative ---- */
static double length_of(const double *x, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += x[i] * x[i];
    return sqrt(sum);
}

double pm_equilibrium_search_longest(const double *x, int n)
{
    double longest = 0;
    for (int i = 0; i < n; i++) longest = fmax(longest, fabs(x[i]));
    return longest;
}

/* F at w->state; 1 where there is none. */
int pm_equilibrium_search_evaluate(pm_workspace *w, pm_equilibrium *x)
{
    pm_frame_look_state(&w->frame, &w->state);
    if (pm_turning_plane_start(w)) return 1; /* the rate of the plane is given, not its momentum */
    pm_frame_look_state(&w->frame, &w->state);
    pm_trigger_take_sides(w);
    (void)pm_free_motion_begin(w, &x->free);
    memset(x->free.shift, 0, 2 * (size_t)x->free.nfree * sizeof(double));
    if (pm_free_motion_respond(w, &x->free)) return 1;
    memcpy(x->force, x->free.response, (size_t)x->free.nfree * sizeof(double));
    x->norm = length_of(x->force, x->free.nfree);
    return !isfinite(x->norm);
}

static int find_slope(pm_workspace *w, pm_equilibrium *x)
{
    const int n = x->free.nfree;
    const double h = (pm_evidence_is_coarse(&w->evidence) ? 0.7 : 1) * PM_SETTLE_DIFFERENCE;
    for (int by = 0; by < n; by++) {
        if (pm_free_motion_differ(w, &x->free, by, h)) return 1;
        for (int k = 0; k < n; k++) x->slope[k * n + by] = x->free.change[k];
    }
    return 0;
}

static void limit(double *step, int n)
{
    const double longest = pm_equilibrium_search_longest(step, n);
    for (int i = 0; i < n && longest > PM_SETTLE_LONGEST; i++) step[i] *= PM_SETTLE_LONGEST / longest;
}

/* ---- Newton's method ---- */
static int newton_step(pm_equilibrium *x)
{
    const size_t n = (size_t)x->free.nfree;
    memcpy(x->left, x->slope, n * n * sizeof(double));
    gsl_matrix_view u = gsl_matrix_view_array(x->left, n, n), v = gsl_matrix_view_array(x->right, n, n);
    gsl_vector_view s = gsl_vector_view_array(x->value, n), spare = gsl_vector_view_array(x->spare, n);
    if (gsl_linalg_SV_decomp(&u.matrix, &v.matrix, &s.vector, &spare.vector)) return 1;
    x->unanswered = 0;
    memset(x->step, 0, n * sizeof(double));
    for (size_t i = 0; i < n; i++) {
        double along = 0;
        for (size_t k = 0; k < n; k++) along += x->left[k * n + i] * x->force[k];
        if (!(x->value[i] > PM_SETTLE_NEUTRAL * x->value[0])) {
            x->unanswered = hypot(x->unanswered, along);
            continue;
        }
        for (size_t k = 0; k < n; k++) x->step[k] -= along / x->value[i] * x->right[k * n + i];
    }
    limit(x->step, (int)n);
    return 0;
}

/* Goes along x->step as far as |F| falls. */
static int descend(pm_workspace *w, pm_equilibrium *x)
{
    const int n = x->free.nfree;
    const double norm = x->norm, size = pm_equilibrium_search_longest(x->step, n);
    double part = 1;
    pm_state_copy(&x->before, &w->state);
    for (int i = 0; i < PM_SETTLE_HALVINGS; i++, part /= 2) {
        for (int k = 0; k < n; k++) x->part[k] = part * x->step[k];
        const int lost = pm_free_motion_move(w, &x->free, x->part) || pm_equilibrium_search_evaluate(w, x);
        if (!lost && (size <= PM_SETTLE_NEAR || x->norm <= (1 - PM_SETTLE_FALL * part) * norm)) return 0;
        pm_state_copy(&w->state, &x->before);
        if (pm_equilibrium_search_evaluate(w, x)) return 1;
    }
    return 1;
}

static double scale_of(const pm_numbers *numbers)
{
    return numbers->speed * numbers->speed / (numbers->size * numbers->size);
}

/* 1: it leads nowhere. */
static int newton(pm_workspace *w, pm_equilibrium *x)
{
    double before = INFINITY;
    if (pm_equilibrium_search_evaluate(w, x)) return 1;
    for (int sweep = 0; sweep < PM_SETTLE_SWEEPS && x->free.nfree > 0; sweep++) {
        if (find_slope(w, x) || newton_step(x)) return 1;
        const double size = pm_equilibrium_search_longest(x->step, x->free.nfree);
        const int ends = size == 0 || (size <= PM_SETTLE_NEAR && size > PM_GAIN * before);
        if (ends) return x->unanswered > PM_SETTLE_MET * scale_of(&w->numbers);
        before = size;
        if (descend(w, x)) return 1;
    }
    return x->free.nfree > 0;
}

/* ---- sinking ---- */
int pm_equilibrium_search_holds(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_CAPTURE] == PM_CAPTURE_NONE;
}

/* Whether bodies overlap at a contact that is open, and may carry; *member tells where. */
int pm_equilibrium_search_overlaps(const pm_frame *frame, const pm_state *state, int contact, int *member)
{
    return pm_equilibrium_search_holds(frame->model, contact) &&
           pm_contact_gap(frame, state, contact, member) < -pm_contact_length(frame) &&
           pm_contact_touches(frame, state, contact, member);
}

static int any_overlaps(const pm_frame *frame, const pm_state *state)
{
    int member, any = 0;
    for (int i = 0; i < frame->model->rows[PM_TABLE_CONTACT] && !any; i++)
        any = pm_equilibrium_search_overlaps(frame, state, i, &member);
    return any;
}

/* The greatest real part of an eigenvalue of K, at least 0: what moves away by itself. */
static int fastest_away(pm_equilibrium *x, double *fastest)
{
    const size_t n = (size_t)x->free.nfree;
    gsl_eigen_nonsymm_workspace *space = gsl_eigen_nonsymm_alloc(n);
    if (!space) return 1;
    memcpy(x->left, x->slope, n * n * sizeof(double));
    gsl_matrix_view a = gsl_matrix_view_array(x->left, n, n);
    gsl_vector_complex_view root = gsl_vector_complex_view_array(x->right, n);
    const int failed = gsl_eigen_nonsymm(&a.matrix, &root.vector, space);
    gsl_eigen_nonsymm_free(space);
    *fastest = 0;
    for (size_t i = 0; i < n && !failed; i++) *fastest = fmax(*fastest, x->right[2 * i]);
    return failed;
}

static int sink_step(pm_equilibrium *x)
{
    const int n = x->free.nfree;
    double away;
    if (fastest_away(x, &away)) return 1;
    const double inverse = x->norm / PM_SETTLE_LONGEST + 2 * away;
    for (int i = 0; i < n * n; i++) x->left[i] = (i % (n + 1) == 0 ? inverse : 0) - x->slope[i];
    memcpy(x->step, x->force, (size_t)n * sizeof(double));
    if (pm_dense_lu_factor(n, x->left, x->pivot)) return 1;
    pm_dense_lu_solve(n, x->left, x->pivot, x->step);
    limit(x->step, n);
    return 0;
}

/* Up to where Newton's method can end it, or to where bodies sink through a contact: *met. */
static int sink(pm_workspace *w, pm_equilibrium *x, int *met)
{
    *met = 0;
    if (pm_equilibrium_search_evaluate(w, x)) return 1;
    for (int sweep = 0; sweep < PM_SETTLE_SINKS && x->free.nfree > 0; sweep++) {
        if (find_slope(w, x) || sink_step(x)) return 1;
        if (pm_equilibrium_search_longest(x->step, x->free.nfree) <= PM_SETTLE_SUNK) return 0;
        if (pm_free_motion_move(w, &x->free, x->step) || pm_equilibrium_search_evaluate(w, x)) return 1;
        *met = any_overlaps(&w->frame, &w->state);
        if (*met) return 0;
    }
    return x->free.nfree > 0;
}

/* The greatest acceleration is left there. */
int pm_equilibrium_search_fails(pm_workspace *w)
{
    int worst = 0;
    double most = 0;
    for (int i = 0; i < w->model->nq; i++) {
        const double size = fabs(w->frame.a[i]) * (i % 3 == 2 ? w->numbers.size : 1);
        if (size > most) worst = i, most = size;
    }
    return pm_fail(&w->result, PM_NO_EQUILIBRIUM, PM_TABLE_BODY, worst / 3, most, 0);
}

int pm_equilibrium_search_solve(pm_workspace *w, pm_equilibrium *x)
{
    pm_frame_look_state(&w->frame, &w->state);
    int status = pm_active_set_build(w);
    if (!status) status = pm_projection_apply(w, &w->state); /* contacts that overlap */
    if (status) return status;
    pm_state_copy(&x->drawn, &w->state);
    if (!newton(w, x)) return PM_OK;
    pm_state_copy(&w->state, &x->drawn);
    int met;
    if (!sink(w, x, &met) && (met || !newton(w, x))) return PM_OK;
    return pm_equilibrium_search_fails(w);
}
