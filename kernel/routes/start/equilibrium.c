/* equilibrium.c - a start in an equilibrium near the positions given (equilibrium_search.c).
 *
 * A contact that touches where it is drawn carries; one that would pull is opened, and a smooth one that bodies sink through
 * is closed.  What does not slip there sticks.  That contacts and frictions can do so is seen at the end, and by the laws of
 * contacts as the run begins. */
#include "routes/start/equilibrium.h"

#include <math.h>

#include "elements/contact.h"
#include "elements/joint_friction.h"
#include "equations/active_set.h"
#include "impact/contact_modes.h"
#include "numerics/tolerances.h"
#include "routes/start/equilibrium_search.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/modes.h"

/* ---- contacts ---- */
/* What touches where it is drawn carries. */
static int close_touching(pm_workspace *w)
{
    int member, slot, status = PM_OK;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT] && !status; i++)
        while (!status && pm_equilibrium_search_holds(w->model, i) &&
               pm_contact_touches(&w->frame, &w->state, i, &member))
            status = pm_contact_modes_close(w, i, member, &slot);
    return status;
}

/* Bodies have sunk through it: where a contact with friction comes to stick nothing tells. */
static int close_overlapping(pm_workspace *w, int *changed)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member, slot;
        if (!pm_equilibrium_search_overlaps(&w->frame, &w->state, i, &member)) continue;
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
    double most = PM_SETTLE_MET * pm_equilibrium_search_longest(w->frame.lambda, w->active.n);
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
        status = round > PM_SETTLE_ROUNDS + 2 * w->model->nslot ? pm_equilibrium_search_fails(w)
                                                                : pm_equilibrium_search_solve(w, x);
        if (!status && pm_equilibrium_search_evaluate(w, x)) status = pm_equilibrium_search_fails(w);
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
    return pm_equilibrium_search_fails(w);
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
