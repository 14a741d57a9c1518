/* ida_jacobian.c - derivatives of the system of ida_system.c.
 *
 * Constraints give G, H and dz'/dlambda as they are, and by their second derivatives what positions make of G v and of the
 * directions of reactions; forces M^-1 df/dq and M^-1 df/dv (ida_slopes.c).  Nothing is a difference but what a force reads of a
 * measure that has no derivative in closed form.  Left out, because Newton's iteration does not need them: d(M^-1 G^T Mu')/dq,
 * where Mu' is small, d/dz of forces that read an integral, and dz'/dq, dz'/dv where no force depends on them. */
#include "routes/ida/ida.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/force.h"
#include "elements/force_action_slope.h"
#include "elements/joint_friction.h"
#include "elements/turning_plane.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/workspace.h"

static size_t work_size(const pm_model *m) /* as much as ida_linear.c needs */
{
    return 5 * (size_t)m->nq + 3 * (size_t)m->nz + 3 * (size_t)m->nconstraint;
}

static int has_damping(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        if (!pm_force_of(m, i)->stores) return 1;
    return 0;
}

int pm_ida_jacobian_create(pm_arena *arena, pm_ida_jacobian *x, const pm_model *m)
{
    const size_t nq = (size_t)m->nq, most = (size_t)m->nconstraint, nz = (size_t)m->nz, both = nq + most;
    const pm_array array[] = {
        PM_ARRAY(x->g, most * nq),
        PM_ARRAY(x->h, most * nq),
        PM_ARRAY(x->gv_slope, most * nq),
        PM_ARRAY(x->spread, nq * most),
        PM_ARRAY(x->share, nq * most),
        PM_ARRAY(x->project, nq * nq),
        PM_ARRAY(x->stiffness, nq * nq),
        PM_ARRAY(x->damping, nq * nq),
        PM_ARRAY(x->ledger, nz * (most + 2 * nq)),
        PM_ARRAY(x->schur, most * most),
        PM_ARRAY(x->inverse_schur, most * most),
        PM_ARRAY(x->bend, nq * both),
        PM_ARRAY(x->system, both * both),
        PM_ARRAY(x->scale, both),
        PM_ARRAY(x->work, work_size(m)),
        PM_ARRAY(x->force, nq),
        PM_ARRAY(x->pivot, both),
        PM_ARRAY(x->bending, nq),
    };
    x->has_forces = m->rows[PM_TABLE_FORCE] > 0 || pm_turning_plane_turns(m);
    x->has_damping = has_damping(m);
    if (pm_arena_take(arena, PM_ARRAYS(array)) || PM_ARENA_NEW(arena, x->slope)) return PM_NO_MEMORY;
    return pm_action_slope_create(arena, x->slope, m);
}

/* Three numbers of a constraint for each of its bodies on all coordinates. */
static void spread_out(const pm_model *model, const pm_constraint *c, const double *of, double *dense)
{
    memset(dense, 0, (size_t)model->nq * sizeof *dense);
    for (int p = 0; p < pm_constraint_bodies(c); p++)
        for (int k = 0; k < 3 && c->body[p] != model->nbody; k++) dense[3 * c->body[p] + k] += of[3 * p + k];
}

static void constraints(const pm_model *model, pm_active_set *active, pm_ida_jacobian *x)
{
    const int nq = model->nq;
    for (int i = 0; i < active->n; i++) {
        spread_out(model, &active->constraint[i], active->constraint[i].j, x->g + i * nq);
        spread_out(model, &active->constraint[i],
                   active->asymmetric ? active->constraint[i].h : active->constraint[i].j, x->h + i * nq);
    }
}

/* d(j^T reaction)/dq of one constraint, in stiffness. */
static void add_bend(const pm_model *m, pm_ida_jacobian *x, const pm_constraint *c,
                     double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES], double reaction)
{
    const int n = 3 * pm_constraint_bodies(c);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            const int row = c->body[i / 3], column = c->body[k / 3];
            if (row == m->nbody || column == m->nbody) continue;
            x->stiffness[(3 * row + i % 3) * m->nq + 3 * column + k % 3] += reaction * bend[i][k];
        }
}

/* Reactions turn with their constraints, and so do the rates G v: those of constraints between two bodies of the scene (inner)
 * or those of the others. */
static void bends(pm_workspace *w, pm_ida_jacobian *x, const double *v, int inner)
{
    const pm_model *m = w->model;
    double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES], turn[PM_CONSTRAINT_COORDINATES];
    for (int i = 0; i < w->active.n; i++) {
        const pm_constraint *c = &w->active.constraint[i];
        if (pm_constraint_is_inner(&w->numbers, c) != inner) continue;
        pm_constraint_bend(&w->frame, c, bend);
        pm_constraint_bend_along(&w->frame, c, bend, v, turn);
        spread_out(m, c, turn, x->gv_slope + i * m->nq);
        add_bend(m, x, c, bend, w->frame.lambda[i]);
    }
    if (!w->active.asymmetric) return;
    for (int i = w->active.n; w->active.constraint[i].normal != PM_NONE;
         i++) { /* carried by sliding normals */
        const pm_constraint *c = &w->active.constraint[i], *normal = &w->active.constraint[c->normal];
        if (pm_constraint_is_inner(&w->numbers, c) != inner) continue;
        pm_constraint_bend(&w->frame, c, bend);
        pm_constraint_bend_along(&w->frame, c, bend, v, turn);
        add_bend(m, x, c, bend, normal->slide * w->frame.lambda[c->normal]);
        pm_ida_slopes_rub(w, pm_ledger_power(m), c, turn, normal->slide * w->frame.lambda[c->normal]);
    }
}

/* Friction of a joint that goes with the load leans the direction of the reactions: |F| = F0 + c |R| has the derivative
 * c R / |R| by their components. */
static void lean(pm_workspace *w, pm_ida_jacobian *x, int k, const pm_constraint *c, double size)
{
    const int z = w->model->force_z[w->model->friction_force[k]];
    double load[2];
    int place[2];
    const int n = pm_joint_friction_places(w, k, place);
    pm_joint_friction_loads(w, k, w->frame.lambda, load);
    const double all = hypot(load[0], load[1]), by_load = pm_joint_friction_coefficient(&w->frame, k);
    for (int i = 0; i < n && all > 0; i++) {
        const double share = (size > 0 ? by_load : -by_load) * load[i] / all;
        if (place[i] < 0) continue; /* a reaction that is shared */
        if (z != PM_NONE) x->ledger[place[i] * w->model->nz + z] += share * pm_constraint_slip(&w->frame, c);
        for (int p = 0; p < 6; p++)
            if (c->body[p / 3] != w->model->nbody)
                x->h[place[i] * w->model->nq + 3 * c->body[p / 3] + p % 3] += share * c->j[p];
    }
}

/* While it slides it acts along a constraint. */
static void joint_friction(pm_workspace *w, pm_ida_jacobian *x, const double *v)
{
    const pm_model *m = w->model;
    double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES], turn[PM_CONSTRAINT_COORDINATES];
    for (int k = 0; k < m->nfriction; k++) {
        pm_constraint c;
        const int force = m->friction_force[k],
                  absent = pm_state_is_absent(m, &w->state, PM_TABLE_FORCE, force);
        const double size = absent ? 0 : pm_joint_friction_sliding(w, k);
        if (size == 0) continue;
        pm_joint_friction_constraint(&w->frame, k, &c);
        pm_constraint_kind(c.kind)->evaluate(&w->frame, &c);
        pm_constraint_bend(&w->frame, &c, bend);
        pm_constraint_bend_along(&w->frame, &c, bend, v, turn);
        add_bend(m, x, &c, bend, size);
        lean(w, x, k, &c, size);
        if (m->force_z[force] != PM_NONE) pm_ida_slopes_rub(w, m->force_z[force], &c, turn, size);
    }
}

/* f + H^T lambda but for reactions between two bodies of the scene. */
static void outer_forces(const pm_workspace *w, pm_ida_jacobian *x)
{
    const int nq = w->model->nq;
    memcpy(x->force, w->frame.f, (size_t)nq * sizeof *x->force);
    for (int i = 0; i < w->active.n; i++) {
        const pm_constraint *c = &w->active.constraint[i];
        const double *h = w->active.asymmetric ? c->h : c->j;
        if (pm_constraint_is_inner(&w->numbers, c)) continue;
        for (int k = 0; k < 3 * pm_constraint_bodies(c); k++)
            if (c->body[k / 3] != w->model->nbody)
                x->force[3 * c->body[k / 3] + k % 3] += w->frame.lambda[i] * h[k];
    }
}

static void by_mass(const pm_workspace *w, double *slope)
{
    const int nq = w->model->nq;
    for (int i = 0; i < nq; i++)
        for (int k = 0; k < nq; k++) slope[i * nq + k] *= w->numbers.inverse_mass[i];
}

static void clear(const pm_model *m, pm_ida_jacobian *x)
{
    const size_t nq = (size_t)m->nq, nz = (size_t)m->nz;
    memset(x->stiffness, 0, nq * nq * sizeof(double));
    memset(x->damping, 0, nq * nq * sizeof(double));
    memset(x->ledger, 0, nz * ((size_t)m->nconstraint + 2 * nq) * sizeof(double));
}

void pm_ida_jacobian_evaluate(pm_workspace *w, double t, double cj, const double *y, const double *yp)
{
    const pm_model *m = w->model;
    pm_ida_jacobian *x = &w->ida->jacobian;
    x->nactive = w->active.n;
    x->cj = cj;
    pm_ida_system_look(w, t, y, yp);
    if (x->sparse) x->independence = pm_saddle_independence(&w->saddle);
    clear(m, x);
    constraints(m, &w->active, x);
    bends(w, x, y + m->nq, 0);
    joint_friction(w, x, y + m->nq);
    pm_ida_slopes_forces(w);
    pm_ida_slopes_power(w);
    outer_forces(w, x);
    pm_ida_slopes_momentum(w);
    bends(w, x, y + m->nq, 1); /* they leave the momentum of the scene as it is */
    by_mass(w, x->stiffness);
    if (x->has_damping) by_mass(w, x->damping);
    pm_ida_rounding_find(w, y, x->gv_slope);
}
