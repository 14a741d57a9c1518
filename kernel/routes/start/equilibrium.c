/* equilibrium.c - an equilibrium near the positions given: F(s, 0) = 0, F the accelerations of free coordinates s (free_motion.h).
 *
 * Newton's method, s = -K^-1 F with K = dF/ds, whose steps must lower |F|; directions in which nothing acts stay as they are
 * (the pseudoinverse of K).  Where it leads nowhere the scene sinks, as in a thick fluid, s' = F, by steps
 * s = (I/d - K)^-1 F that get longer as |F| falls, and Newton's method ends that.
 *
 * A contact that touches where it is drawn carries; one that would pull is opened, and a smooth one that bodies sink through
 * is closed.  What does not slip there sticks.  That contacts and frictions can do so is seen at the end, and by the laws of
 * contacts as the run begins. */
#include "routes/start/equilibrium.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "elements/joint_friction.h"
#include "elements/trigger.h"
#include "elements/turning_plane.h"
#include "equations/active_set.h"
#include "equations/projection.h"
#include "impact/contact_modes.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/modes.h"
#include "tree/free_motion.h"

typedef struct pm_equilibrium {
    pm_free_motion free;
    double *force;                        /* [nq] F at the state */
    double *slope;                        /* [nfree][nfree] K */
    double *left, *right, *value, *spare; /* its singular values and vectors */
    double *step, *part;                  /* [nq] of the state along s; what of it is tried */
    int *pivot;                           /* [nq] */
    double norm;                          /* |F| */
    double unanswered;                    /* of F where no displacement changes it */
    pm_state drawn, before;
} pm_equilibrium;

/* ---- forces and their derivative ---- */
static double length_of(const double *x, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += x[i] * x[i];
    return sqrt(sum);
}

static double longest_of(const double *x, int n)
{
    double longest = 0;
    for (int i = 0; i < n; i++) longest = fmax(longest, fabs(x[i]));
    return longest;
}

/* F at w->state; 1 where there is none. */
static int evaluate(pm_workspace *w, pm_equilibrium *x)
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
    const double longest = longest_of(step, n);
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
    const double norm = x->norm, size = longest_of(x->step, n);
    double part = 1;
    pm_state_copy(&x->before, &w->state);
    for (int i = 0; i < PM_SETTLE_HALVINGS; i++, part /= 2) {
        for (int k = 0; k < n; k++) x->part[k] = part * x->step[k];
        const int lost = pm_free_motion_move(w, &x->free, x->part) || evaluate(w, x);
        if (!lost && (size <= PM_SETTLE_NEAR || x->norm <= (1 - PM_SETTLE_FALL * part) * norm)) return 0;
        pm_state_copy(&w->state, &x->before);
        if (evaluate(w, x)) return 1;
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
    if (evaluate(w, x)) return 1;
    for (int sweep = 0; sweep < PM_SETTLE_SWEEPS && x->free.nfree > 0; sweep++) {
        if (find_slope(w, x) || newton_step(x)) return 1;
        const double size = longest_of(x->step, x->free.nfree);
        const int ends = size == 0 || (size <= PM_SETTLE_NEAR && size > PM_GAIN * before);
        if (ends) return x->unanswered > PM_SETTLE_MET * scale_of(&w->numbers);
        before = size;
        if (descend(w, x)) return 1;
    }
    return x->free.nfree > 0;
}

/* ---- sinking ---- */
static int is_held(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_CAPTURE] == PM_CAPTURE_NONE;
}

/* Whether bodies overlap at a contact that is open, and may carry; *member tells where. */
static int overlaps(const pm_frame *frame, const pm_state *state, int contact, int *member)
{
    return is_held(frame->model, contact) &&
           pm_contact_gap(frame, state, contact, member) < -pm_contact_length(frame) &&
           pm_contact_touches(frame, state, contact, member);
}

static int any_overlaps(const pm_frame *frame, const pm_state *state)
{
    int member, any = 0;
    for (int i = 0; i < frame->model->rows[PM_TABLE_CONTACT] && !any; i++)
        any = overlaps(frame, state, i, &member);
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
    if (evaluate(w, x)) return 1;
    for (int sweep = 0; sweep < PM_SETTLE_SINKS && x->free.nfree > 0; sweep++) {
        if (find_slope(w, x) || sink_step(x)) return 1;
        if (longest_of(x->step, x->free.nfree) <= PM_SETTLE_SUNK) return 0;
        if (pm_free_motion_move(w, &x->free, x->step) || evaluate(w, x)) return 1;
        *met = any_overlaps(&w->frame, &w->state);
        if (*met) return 0;
    }
    return x->free.nfree > 0;
}

/* The greatest acceleration is left there. */
static int tell_none(pm_workspace *w)
{
    int worst = 0;
    double most = 0;
    for (int i = 0; i < w->model->nq; i++) {
        const double size = fabs(w->frame.a[i]) * (i % 3 == 2 ? w->numbers.size : 1);
        if (size > most) worst = i, most = size;
    }
    return pm_fail(&w->result, PM_NO_EQUILIBRIUM, PM_TABLE_BODY, worst / 3, most, 0);
}

static int solve(pm_workspace *w, pm_equilibrium *x)
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
    return tell_none(w);
}

/* ---- contacts ---- */
/* What touches where it is drawn carries. */
static int close_touching(pm_workspace *w)
{
    int member, slot, status = PM_OK;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT] && !status; i++)
        while (!status && is_held(w->model, i) && pm_contact_touches(&w->frame, &w->state, i, &member))
            status = pm_contact_modes_close(w, i, member, &slot);
    return status;
}

/* Bodies have sunk through it: where a contact with friction comes to stick nothing tells. */
static int close_overlapping(pm_workspace *w, int *changed)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member, slot;
        if (!overlaps(&w->frame, &w->state, i, &member)) continue;
        const int status = pm_contact_modes_close(w, i, member, &slot);
        if (status) return status;
        if (w->state.slot[slot].mode != PM_SMOOTH)
            return pm_fail(&w->result, PM_EQUILIBRIUM_OPEN, PM_TABLE_CONTACT, i, NAN, NAN);
        *changed = 1;
    }
    return PM_OK;
}

/* Of normal forces that pull the greatest, by which its contact opens. */
static int open_pulling(pm_workspace *w)
{
    int worst = PM_NONE;
    double most = PM_SETTLE_MET * longest_of(w->frame.lambda, w->active.n);
    for (int i = 0; i < w->model->nslot; i++) {
        const int place = w->active.slot_normal[i];
        if (w->state.slot[i].mode == PM_OPEN || place < 0 || !(-w->frame.lambda[place] > most)) continue;
        most = -w->frame.lambda[place];
        worst = i;
    }
    if (worst == PM_NONE) return 0;
    w->state.slot[worst].mode = PM_OPEN;
    return 1;
}

/* What sticks where it is drawn must be able to.  Where several share what holds that is left to the laws of contacts. */
static int check_friction(pm_workspace *w)
{
    if (w->active.nredundant > 0) return PM_OK;
    for (int i = 0; i < w->model->nslot; i++) {
        const int normal = w->active.slot_normal[i], tangent = w->active.slot_tangent[i];
        const int contact = pm_contact_of_slot(w->model, i);
        if (w->state.slot[i].mode != PM_STICK || normal < 0 || tangent < 0 ||
            pm_contact_friction(w->model, contact) != PM_FRICTION_COULOMB)
            continue;
        const double mu = pm_contact_static(&w->frame, contact),
                     needed = fabs(w->frame.lambda[tangent]) / w->frame.lambda[normal];
        if (!(needed <= (1 + PM_SETTLE_MET) * mu))
            return pm_fail(&w->result, PM_EQUILIBRIUM_OPEN, PM_TABLE_CONTACT, contact, needed, mu);
    }
    for (int k = 0; k < w->model->nfriction; k++) {
        const int place = w->active.friction_constraint[k];
        if (place < 0) continue;
        const double most = pm_joint_friction_limit(w, k), needed = fabs(w->frame.lambda[place]);
        if (!(needed <= (1 + PM_SETTLE_MET) * most))
            return pm_fail(&w->result, PM_EQUILIBRIUM_OPEN, PM_TABLE_FORCE, w->model->friction_force[k],
                           needed, most);
    }
    return PM_OK;
}

static int find_with_contacts(pm_workspace *w, pm_equilibrium *x)
{
    int changed = 1, status = close_touching(w);
    pm_joint_friction_close(&w->frame, &w->state);
    for (int round = 0; changed && !status; round++) {
        changed = 0;
        status = round > PM_SETTLE_ROUNDS + 2 * w->model->nslot ? tell_none(w) : solve(w, x);
        if (!status && evaluate(w, x)) status = tell_none(w);
        if (!status) status = close_overlapping(w, &changed);
        if (!status && !changed) changed = open_pulling(w);
    }
    return status ? status : check_friction(w);
}

/* ---- what it is ---- */
/* Of small motion that keeps the contacts: what sticks sticks. */
static int kind_of(pm_workspace *w, const pm_equilibrium *x)
{
    pm_modes *m = w->frame.modes;
    if (x->free.nfree == 0) return PM_EQUILIBRIUM_STABLE;
    m->find(w);
    if (m->n == 0) return PM_EQUILIBRIUM_NOT_TOLD;
    return m->growth > 0     ? PM_EQUILIBRIUM_UNSTABLE
           : m->omega[0] > 0 ? PM_EQUILIBRIUM_STABLE
                             : PM_EQUILIBRIUM_NEUTRAL;
}

static int check_moves(pm_workspace *w)
{
    for (int i = 0; i < w->model->nq; i++)
        if (w->state.v[i] != 0)
            return pm_fail_member(&w->result, PM_EQUILIBRIUM_MOVES, PM_TABLE_BODY, i / 3, i % 3,
                                  w->state.v[i], 0);
    return PM_OK;
}

/* As a start leaves it: which contacts carry is found anew. */
static double leave(pm_workspace *w)
{
    for (int i = 0; i < w->model->nslot; i++) w->state.slot[i].mode = PM_OPEN;
    pm_joint_friction_release(w);
    pm_active_set_clear(&w->active, w->model);
    double settled = 0;
    for (int i = 0; i < w->model->nq; i++)
        settled = fmax(settled, fabs(w->state.q[i] - w->start.q[i]) * (i % 3 == 2 ? w->numbers.size : 1));
    pm_frame_look_state(&w->frame, &w->state);
    pm_state_copy(&w->start, &w->state);
    return settled;
}

int pm_equilibrium_find(pm_workspace *w, pm_start_report *report)
{
    pm_equilibrium *x = w->frame.modes->equilibrium;
    pm_tree *of_phase = w->tree;
    int status = check_moves(w);
    if (!status) status = find_with_contacts(w, x);
    if (!status) report->equilibrium = kind_of(w, x);
    w->tree = of_phase;
    w->frame.modes->known = 0;
    if (!status) report->settled = leave(w);
    w->result.count[PM_COUNT_UNSTABLE_STARTS] = report->equilibrium == PM_EQUILIBRIUM_UNSTABLE;
    return status;
}

/* A contact whose friction does not hold what rests. */
static int tell_moving(pm_workspace *w)
{
    for (int i = 0; i < w->model->nslot; i++) {
        const int contact = pm_contact_of_slot(w->model, i), member = w->state.slot[i].member;
        if (!pm_contact_modes_slides(w->state.slot[i].mode) ||
            fabs(pm_contact_member_slip(&w->frame, contact, member)) > pm_contact_speed(&w->frame))
            continue;
        return pm_fail(&w->result, PM_EQUILIBRIUM_OPEN, PM_TABLE_CONTACT, contact, INFINITY,
                       pm_contact_static(&w->frame, contact));
    }
    return tell_none(w);
}

int pm_equilibrium_check(pm_workspace *w)
{
    const double most = PM_SETTLE_RESTS * w->numbers.speed * w->numbers.speed / w->numbers.size;
    for (int i = 0; i < w->model->nq; i++) {
        const double length = i % 3 == 2 ? w->numbers.size : 1;
        if (fabs(w->frame.a[i]) * length > most || w->frame.v[i] != 0) return tell_moving(w);
    }
    return PM_OK;
}

/* ---- memory ---- */
int pm_equilibrium_create(pm_workspace *w)
{
    if (!pm_equilibrium_wanted(w->model)) return PM_OK;
    const size_t n = (size_t)w->model->nq;
    pm_equilibrium *x;
    if (PM_ARENA_NEW(&w->memory, x)) return PM_NO_MEMORY;
    const pm_array array[] = {
        PM_ARRAY(x->force, n),    PM_ARRAY(x->slope, n * n),
        PM_ARRAY(x->left, n * n), PM_ARRAY(x->right, n * n + 2 * n),
        PM_ARRAY(x->value, n),    PM_ARRAY(x->spare, n),
        PM_ARRAY(x->step, n),     PM_ARRAY(x->part, n),
        PM_ARRAY(x->pivot, n),
    };
    int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    if (!status) status = pm_state_create(&w->memory, w->model, &x->drawn);
    if (!status) status = pm_state_create(&w->memory, w->model, &x->before);
    if (!status) status = pm_free_motion_create(w, &x->free);
    w->frame.modes->equilibrium = x;
    return status;
}
