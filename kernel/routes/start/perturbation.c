/* perturbation.c - leaves an unstable steady motion to the side that is asked for.
 *
 * The state is set out by a small part of the deviation that grows fastest: what is then left of the limit of a vanishing
 * nudge is of second order in it, the energy and the momenta are kept to rounding.  How long it takes, and how far the
 * steady motion goes on until then, depends on the size: a coarse run (accuracy.c), whose tolerance is another, shows it. */
#include "routes/start/perturbation.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/force.h"
#include "equations/ledger.h"
#include "equations/projection.h"
#include "equations/saddle.h"
#include "expression/program.h"
#include "expression/program_class.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "routes/start/fastest_growth.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

struct pm_perturbation {
    double *gradient;       /* [nq] of the program by velocities */
    unsigned char *touched; /* [nbody + 1] bodies whose motion hangs together with what the program reads */
    pm_fastest_growth escape;
};

int pm_perturbation_any(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_ACTION]; i++)
        if (PM_ACTION_ROW(m, i)[PM_ACTION_KIND] == PM_ACTION_NUDGE) return 1;
    return PM_SETTING(m, PM_SETTING_NUDGE) >= 0;
}

int pm_perturbation_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (!pm_perturbation_any(m)) return PM_OK;
    if (PM_ARENA_NEW(&w->memory, w->perturbation)) return PM_NO_MEMORY;
    struct pm_perturbation *x = w->perturbation;
    const pm_array array[] = {PM_ARRAY(x->gradient, m->nq), PM_ARRAY(x->touched, m->nbody + 1)};
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    return status ? status : pm_fastest_growth_create(&w->memory, m, &x->escape);
}

/* ---- what waits ---- */
void pm_perturbation_begin(const pm_model *model, pm_request *request)
{
    const int program = PM_SETTING(model, PM_SETTING_NUDGE);
    *request = (pm_request){program >= 0 ? program : PM_NONE, PM_TABLE_SETTING, PM_SETTING_NUDGE};
}

void pm_perturbation_end(pm_request *request) { request->program = PM_NONE; }

static int fail(const pm_request *request, pm_result *result, int status, double value)
{
    return pm_fail(result, status, request->table, request->row, value, NAN);
}

/* ---- one degree of freedom at rest ---- */
/* Out of an equilibrium: a little aside the forces must drive it on. */
static int is_driven_on(pm_workspace *w, int *status)
{
    pm_path *p = w->path;
    const pm_place *x = &p->begin;
    double most = 0, size = 0;
    for (int i = 0; i < w->model->nq; i++) {
        const double length = i % 3 == 2 ? w->numbers.size : 1;
        most = fmax(most, fabs(x->tangent[i]) * length);
        size += fabs(w->frame.f[i] * x->tangent[i]);
    }
    const double way = p->sense * PM_PERTURBATION_ASIDE * w->numbers.size / most;
    for (int i = 0; i < p->n; i++) p->spare.y[i] = x->y[i] + way * x->slope[i];
    *status = pm_path_place(w, x->y[p->driver] + way, &p->spare);
    for (int i = 0; i < w->model->nq; i++) size += fabs(w->frame.f[i] * p->spare.tangent[i]);
    return p->spare.force * p->sense > PM_PERTURBATION_NOTHING * size;
}

static int leave_along_path(pm_workspace *w)
{
    const pm_path *p = w->path;
    int status = PM_OK;
    if (!p->at_rest) return fail(&w->request, &w->result, PM_NUDGE_UNSTEADY, NAN);
    pm_frame_look_state(&w->frame, &w->state);
    const double side = p->sense * pm_path_requested(w, p->begin.tangent);
    if (!p->balanced) return side > 0 ? PM_OK : fail(&w->request, &w->result, PM_NUDGE_UNSTEADY, NAN);
    pm_frame_look_state(&w->frame, &w->state);
    pm_force_all(w);
    const int goes = is_driven_on(w, &status);
    pm_frame_look_state(&w->frame, &w->state);
    return status || goes ? status : fail(&w->request, &w->result, PM_NUDGE_STABLE, 0);
}

/* ---- what hangs together ---- */
static int read_gradient(pm_workspace *w)
{
    struct pm_perturbation *x = w->perturbation;
    double *unit = x->escape.v;
    int any = 0;
    pm_frame_look_state(&w->frame, &w->state);
    memset(unit, 0, (size_t)w->model->nq * sizeof *unit);
    memset(x->touched, 0, (size_t)w->model->nbody + 1);
    for (int i = 0; i < w->model->nq; i++) {
        unit[i] = 1;
        x->gradient[i] = w->numbers.inverse_mass[i] > 0 ? pm_path_requested(w, unit) : 0;
        unit[i] = 0;
        if (x->gradient[i] != 0) any = x->touched[i / 3] = 1;
    }
    pm_frame_look_state(&w->frame, &w->state);
    return any;
}

static int join(const pm_model *model, struct pm_perturbation *perturbation, int a, int b)
{
    unsigned char *touched = perturbation->touched;
    const int ground = model->nbody;
    if (a == ground || b == ground || touched[a] == touched[b]) return 0;
    return touched[a] = touched[b] = 1;
}

/* What a program gives may hang on any body. */
static int is_free_of_bodies(const pm_model *m, int program)
{
    return program < 0 || m->programs.class[program] == PM_CLASS_CONSTANT;
}

static void find_island(pm_workspace *w)
{
    const pm_model *m = w->model;
    struct pm_perturbation *x = w->perturbation;
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++) {
        const int32_t *e = PM_FORCE_ROW(m, i);
        if (!is_free_of_bodies(m, e[PM_FORCE_PROGRAM_X]) || !is_free_of_bodies(m, e[PM_FORCE_PROGRAM_Y]))
            memset(x->touched, 1, (size_t)m->nbody);
    }
    for (int more = 1; more;) {
        more = 0;
        for (int i = 0; i < w->active.n; i++)
            for (int p = 1; p < pm_constraint_bodies(&w->active.constraint[i]); p++)
                more |= join(w->model, w->perturbation, w->active.constraint[i].body[p - 1],
                             w->active.constraint[i].body[p]);
        for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++) {
            const pm_action f = pm_force_action(w, i);
            more |= join(w->model, w->perturbation, f.body_a, f.body_b);
        }
    }
    for (int i = 0; i < m->nq; i++) x->escape.free[i] = x->touched[i / 3];
}

/* ---- the deviation ---- */
static int is_at_rest(const pm_workspace *w)
{
    for (int i = 0; i < w->model->nq; i++) {
        const double length = i % 3 == 2 ? w->numbers.size : 1;
        if (w->perturbation->escape.free[i] &&
            fabs(w->state.v[i]) * length > PM_PERTURBATION_STILL * w->numbers.speed)
            return 0;
    }
    return 1;
}

/* At rest forces may take it to the side that is asked for. */
static int goes_by_itself(pm_workspace *w, int *status)
{
    if (!is_at_rest(w)) return 0;
    pm_frame_look_state(&w->frame, &w->state);
    if ((*status = pm_saddle_accelerate(w))) return 0;
    return pm_path_requested(w, w->frame.a) > 0;
}

/* The blow that the program speaks of: M d = gradient + G^T l, G d = 0. */
static int read_push(pm_workspace *w)
{
    pm_fastest_growth *e = &w->perturbation->escape;
    pm_frame_look_state(&w->frame, &w->state);
    pm_saddle_evaluate(&w->active, &w->frame);
    int status = pm_saddle_factor(w);
    memset(w->saddle.wanted, 0, (size_t)w->active.n * sizeof *w->saddle.wanted);
    return status ? status : pm_saddle_respond(w, w->perturbation->gradient, e->push);
}

/* w->probe: the state set out by `part` of the deviation; what the program reads there. */
static int set_out(pm_workspace *w, double part, double *shows)
{
    const pm_fastest_growth *e = &w->perturbation->escape;
    pm_state *s = &w->probe;
    pm_state_copy(s, &w->state);
    for (int i = 0; i < w->model->nq; i++) {
        s->q[i] += part * e->q[i];
        s->v[i] += part * e->v[i];
    }
    const int status = pm_projection_apply(w, s);
    if (status) return status;
    pm_frame_look_state(&w->frame, s);
    *shows = pm_program_run(w, w->request.program);
    return PM_OK;
}

/* What the outer world has given until the deviation was that large is read off it: the ledger of w->probe. */
static void give_momentum(pm_workspace *w)
{
    double before[PM_LEDGER];
    pm_frame_look_state(&w->frame, &w->state);
    pm_frame_momentum(&w->frame, PM_NONE, before);
    pm_frame_look_state(&w->frame, &w->probe);
    pm_ledger_follow(&w->frame, before, w->probe.z);
}

static int overlaps(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member;
        const double gap = pm_contact_gap(&w->frame, &w->state, i, &member),
                     least = -pm_contact_length(&w->frame);
        if (gap < least) return pm_fail(&w->result, PM_PENETRATION, PM_TABLE_CONTACT, i, gap, least);
    }
    return PM_OK;
}

/* To the side on which the program is positive, if it distinguishes the sides. */
static int take_side(pm_workspace *w)
{
    const pm_fastest_growth *e = &w->perturbation->escape;
    const double part = PM_PERTURBATION_SIZE * sqrt(w->numbers.tolerance),
                 least = PM_PERTURBATION_SHOWS * part * e->rate * fmin(w->numbers.size, 1);
    double there, back;
    int status = set_out(w, -part, &back);
    if (!status) status = set_out(w, part, &there);
    if (status) return status;
    if (!(there * back < 0 && fmin(fabs(there), fabs(back)) > least))
        return fail(&w->request, &w->result, PM_NUDGE_STABLE, e->rate);
    if (there < 0 && (status = set_out(w, -part, &back))) return status;
    give_momentum(w);
    pm_state_copy(&w->state, &w->probe);
    return overlaps(w);
}

static int leave_by_deviation(pm_workspace *w)
{
    pm_fastest_growth *e = &w->perturbation->escape;
    int status;
    if (!read_gradient(w)) return fail(&w->request, &w->result, PM_NUDGE_STABLE, 0);
    find_island(w);
    if (!pm_fastest_growth_is_steady(w, e, &status)) {
        if (status) return status;
        const int goes = goes_by_itself(w, &status);
        return status || goes ? status : fail(&w->request, &w->result, PM_NUDGE_UNSTEADY, NAN);
    }
    if ((status = read_push(w)) || (status = pm_fastest_growth_find(w, e))) return status;
    return e->rate > 0 ? take_side(w) : fail(&w->request, &w->result, PM_NUDGE_STABLE, 0);
}

int pm_perturbation_leave(pm_workspace *w)
{
    if (w->request.program == PM_NONE) return PM_OK;
    if (pm_route_prepare(w, &pm_route_path)) return leave_along_path(w);
    const int status = leave_by_deviation(w);
    pm_frame_look_state(&w->frame, &w->state);
    if (!status) pm_perturbation_end(&w->request);
    return status;
}
