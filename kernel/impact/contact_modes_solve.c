/* contact_modes_solve.c - the modes of all closed contacts by their accelerations, as one problem (contact_problem.h). */
#include <math.h>

#include "elements/contact.h"
#include "elements/force.h"
#include "equations/active_set.h"
#include "equations/case.h"
#include "equations/saddle.h"
#include "impact/contact_modes.h"
#include "impact/contact_system.h"
#include "impact/impact_parts.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

static int is_listed(const pm_workspace *w, int slot)
{
    const int mode = w->state.slot[slot].mode;
    return mode == PM_OPEN ? w->instant.slot_released[slot] == PM_LET_GO : mode != PM_CAPTURED;
}

/* The mode that each has now is what it takes in a tie; one that slips goes on that way. */
static void list(pm_workspace *w, pm_contact_system *x, int32_t *before)
{
    x->problem.n = 0;
    for (int i = 0; i < w->model->nslot; i++) {
        before[i] = w->state.slot[i].mode;
        if (is_listed(w, i)) x->slot[x->problem.n++] = i;
    }
    pm_contact_system_friction(&w->frame, x);
    for (int i = 0; i < x->problem.n; i++) {
        pm_contact_problem_contact *c = &x->problem.contact[i];
        pm_slot *s = &w->state.slot[x->slot[i]];
        const double slip =
            pm_contact_member_slip(&w->frame, pm_contact_of_slot(w->model, x->slot[i]), s->member);
        c->prefers = s->mode;
        if (pm_contact_modes_slides(s->mode) && fabs(slip) > pm_contact_speed(&w->frame))
            c->slips = s->mode == PM_SLIDE_FORWARD ? 1 : -1;
        s->mode = PM_OPEN;
    }
}

/* Accelerations where no listed contact acts; joints rub as they were found to. */
static void accelerate_free(pm_workspace *w, pm_contact_system *x)
{
    pm_force_all(w);
    for (int i = 0; i < w->active.n; i++) w->saddle.wanted[i] = w->active.constraint[i].gamma;
    pm_saddle_respond_roughly(w, w->frame.f, x->free);
}

/* The acceleration along a constraint where no listed contact acts; what rounding has left is none: where all of them are that,
 * any of the motions that it allows would be found. */
static double free_acceleration(const pm_workspace *w, const pm_contact_system *x, const pm_constraint *c)
{
    const double a = pm_constraint_times(&w->frame, c, x->free) - c->gamma;
    return fabs(a) <= PM_PULLS * pm_case_acceleration(&w->numbers) ? 0 : a;
}

static void pose(const pm_workspace *w, pm_contact_system *x)
{
    for (int i = 0; i < x->problem.n; i++) {
        x->problem.contact[i].bias[0] = free_acceleration(w, x, &x->normal[i]);
        x->problem.contact[i].bias[1] = free_acceleration(w, x, &x->tangent[i]);
    }
}

static void take(pm_workspace *w, const pm_contact_system *x, const int32_t *before)
{
    for (int i = 0; i < x->problem.n; i++) {
        const int slot = x->slot[i], mode = x->problem.mode[i];
        w->state.slot[slot].mode = mode;
        if (mode == PM_OPEN) w->instant.slot_released[slot] = PM_LET_GO;
        if (mode == PM_STICK && before[slot] != PM_STICK) pm_active_set_anchor(&w->frame, &w->state, slot);
    }
}

static int fail(pm_workspace *w, const pm_contact_system *x, int n)
{
    int status = n > 1 ? PM_NOT_UNIQUE : PM_PAINLEVE, i = n > 1 ? x->problem.differs : 0;
    for (int k = 0; k < x->problem.n && n == 0; k++)
        if (x->problem.contact[k].friction == PM_FRICTION_ROUGH) {
            status = PM_ROUGH_IMPOSSIBLE;
            i = k;
        }
    return pm_fail(&w->result, status, PM_TABLE_CONTACT, pm_contact_of_slot(w->model, x->slot[i]),
                   x->problem.contact[i].rub, x->problem.n);
}

/* Poses the problem at the frame and solves it: *n motions.  The listed slots are open then. */
static int solve(pm_workspace *w, pm_contact_system *x, int32_t *before, int *n)
{
    list(w, x, before);
    const int status = pm_contact_system_respond(w, x);
    if (status) return status;
    accelerate_free(w, x);
    pose(w, x);
    *n = pm_contact_problem_solve(&x->problem);
    return PM_OK;
}

void pm_contact_modes_restore(pm_state *s, const pm_model *m, const int32_t *before)
{
    for (int i = 0; i < m->nslot; i++) s->slot[i].mode = before[i];
}

int pm_contact_modes_solve(pm_workspace *w, int *changed)
{
    pm_contact_system *x = &w->blow->system;
    int32_t *before = w->blow->resting;
    int n = 0, status = solve(w, x, before, &n);
    if (!status && n != 1) status = fail(w, x, n);
    *changed = 0;
    if (status)
        pm_contact_modes_restore(&w->state, w->model, before);
    else
        take(w, x, before);
    for (int i = 0; i < w->model->nslot; i++) *changed |= w->state.slot[i].mode != before[i];
    return status;
}

int pm_contact_modes_are_open_by_theory(const pm_workspace *w)
{
    for (int i = 0; i < w->model->nslot; i++) {
        const int contact = pm_contact_of_slot(w->model, i), mode = w->state.slot[i].mode;
        if ((mode == PM_STICK || pm_contact_modes_slides(mode)) &&
            pm_contact_friction(w->model, contact) == PM_FRICTION_COULOMB)
            return 1;
    }
    return 0;
}

int pm_contact_modes_check_one(pm_workspace *w)
{
    pm_contact_system *x = &w->blow->system;
    int n = 0;
    const int status = solve(w, x, w->blow->resting, &n);
    pm_contact_modes_restore(&w->state, w->model, w->blow->resting);
    return status ? status : n > 1 ? fail(w, x, n) : PM_OK;
}
