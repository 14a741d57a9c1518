/* contact_system.c - W = D A D^T of the contacts' directions D, where A = M^-1 with all that holds otherwise held. */
#include "impact/contact_system.h"

#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "equations/active_set.h"
#include "equations/saddle.h"
#include "impact/contact_modes.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"

int pm_contact_system_create(pm_contact_system *x, pm_arena *arena, const pm_model *m)
{
    const pm_array array[] = {
        PM_ARRAY(x->slot, m->nslot), PM_ARRAY(x->normal, m->nslot), PM_ARRAY(x->tangent, m->nslot),
        PM_ARRAY(x->free, m->nq),    PM_ARRAY(x->force, m->nq),     PM_ARRAY(x->response, m->nq),
    };
    const int status = pm_arena_take(arena, PM_ARRAYS(array));
    return status ? status : pm_contact_problem_create(&x->problem, arena, m->nslot);
}

/* The active set of what else holds, evaluated and factored. */
static int hold_others(pm_workspace *w)
{
    pm_frame_look_state(&w->frame, &w->state);
    const int status = pm_active_set_build(w);
    if (status) return status;
    if (!w->active.evaluated) pm_saddle_evaluate(&w->active, &w->frame);
    return w->active.n > 0 ? pm_saddle_factor(w) : PM_OK;
}

void pm_contact_system_respond_along(pm_workspace *w, pm_contact_system *x, const pm_constraint *along)
{
    memset(x->force, 0, (size_t)w->model->nq * sizeof *x->force);
    for (int p = 0; p < pm_constraint_bodies(along); p++)
        for (int k = 0; k < 3 && along->body[p] != w->model->nbody; k++)
            x->force[3 * along->body[p] + k] += along->j[3 * p + k];
    for (int i = 0; i < w->active.n; i++) w->saddle.wanted[i] = 0;
    pm_saddle_respond_roughly(w, x->force, x->response);
}

static const pm_constraint *direction(const pm_contact_system *x, int i)
{
    return i % 2 == 0 ? &x->normal[i / 2] : &x->tangent[i / 2];
}

void pm_contact_system_still_held(const pm_frame *frame, const pm_contact_system *x, double *response,
                                  int size)
{
    const int n = 2 * x->problem.n;
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(response[i * (size + 1)]));
    for (int i = 0; i < n; i++) {
        const double alone = pm_constraint_square(frame, direction(x, i));
        if (fabs(response[i * (size + 1)]) > PM_SYSTEM_HELD * fmin(most, alone)) continue;
        for (int k = 0; k < size; k++) response[i * size + k] = response[k * size + i] = 0;
    }
}

int pm_contact_system_respond(pm_workspace *w, pm_contact_system *x)
{
    const int n = 2 * x->problem.n;
    int status = hold_others(w);
    for (int i = 0; i < x->problem.n; i++) {
        x->normal[i] = pm_contact_modes_normal(&w->frame, &w->state, x->slot[i]);
        x->tangent[i] = pm_contact_modes_tangent(&w->frame, &w->state, x->slot[i]);
    }
    for (int i = 0; i < n && !status; i++) {
        pm_contact_system_respond_along(w, x, direction(x, i));
        for (int k = 0; k < n; k++)
            x->problem.response[k * n + i] = pm_constraint_times(&w->frame, direction(x, k), x->response);
    }
    pm_contact_system_still_held(&w->frame, x, x->problem.response, n);
    return status;
}

void pm_contact_system_friction(const pm_frame *frame, pm_contact_system *x)
{
    for (int i = 0; i < x->problem.n; i++) {
        const int contact = pm_contact_of_slot(frame->model, x->slot[i]);
        x->problem.contact[i] = (pm_contact_problem_contact){
            .friction = pm_contact_friction(frame->model, contact),
            .hold = pm_contact_static(frame, contact),
            .rub = pm_contact_kinetic(frame, contact),
            .prefers = PM_NONE,
        };
    }
}
