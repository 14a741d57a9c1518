/* active_set.c - the active set of a phase.
 *
 * What depends on others for good (dependence.h) is *redundant*: the motion is right without it. */
#include "equations/active_set.h"

#include <math.h>
#include <string.h>

#include "elements/capture.h"
#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/joint.h"
#include "elements/joint_friction.h"
#include "equations/dependence.h"
#include "equations/orthonormal_rows.h"
#include "equations/saddle.h"
#include "equations/solve_cache.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

void pm_active_set_clear(pm_active_set *x, const pm_model *m)
{
    x->version++;
    x->n = x->njoint = x->nredundant = x->asymmetric = 0;
    for (int i = 0; i < m->njoint_constraint; i++) x->of_joint[i] = PM_NONE;
    for (int i = 0; i < m->nslot; i++) x->slot_normal[i] = x->slot_tangent[i] = PM_NONE;
    for (int i = 0; i < PM_JOINT_CONSTRAINTS * m->nslot; i++) x->slot_held[i] = PM_NONE;
    for (int i = 0; i < m->nfriction; i++) x->friction_constraint[i] = PM_NONE;
}

/* Adds to the redundant ones; its place. */
static int leave_out(pm_active_set *x, const pm_constraint *c)
{
    x->redundant[x->nredundant] = *c;
    x->share[x->nredundant] = 0;
    return PM_REDUNDANT_PLACE(x->nredundant++);
}

/* The constraints appended so far, orthonormal.  They come in rounds, in the first ones those alone that clearly add to the others:
 * what little is left of the rest would stand in their place, and leave a system that is all but singular. */
typedef struct pm_basis {
    int n;
    double clearly; /* part of a constraint that the others must leave in this round; 0 in the last one */
} pm_basis;

/* Appends the constraint to the active ones, or to the redundant ones; *index: its place.  Without a basis it is not tested. */
static int append(pm_workspace *w, const pm_constraint *c, pm_basis *basis, int *index)
{
    if (*index != PM_NONE) return PM_OK; /* in the first round */
    pm_constraint *place = &w->active.constraint[w->active.n];
    if (!basis) {
        if (c != place) *place = *c;
        *index = w->active.n++;
        return PM_OK;
    }
    pm_orthonormal_rest rest;
    int depends = PM_DEPENDENCE_NONE;
    *place = *c;
    pm_constraint_kind(place->kind)->evaluate(&w->frame, place);
    const int n = pm_orthonormal_rows_add_constraint(&w->saddle, basis->n, place, &rest);
    const int grows = n > basis->n;
    if (basis->clearly > 0 && rest.left <= basis->clearly) return PM_OK;
    if (!grows) {
        const int status = pm_dependence_nearby(w, c, &depends);
        if (status) return status;
        *place = *c;
    }
    basis->n = n;
    if (depends == PM_DEPENDENCE_FOR_GOOD) {
        *index = leave_out(&w->active, c);
    } else {
        w->active.doubtful[w->active.n] = !grows;
        *index = w->active.n++;
    }
    return PM_OK;
}

static int append_joints_once(pm_workspace *w, pm_basis *basis)
{
    const pm_model *m = w->model;
    for (int j = 0; j < m->rows[PM_TABLE_JOINT]; j++) {
        pm_constraint c[PM_JOINT_CONSTRAINTS];
        const int i = w->active.joint_order[j], n = pm_joint_constraints(&w->frame, &w->state, i, c);
        for (int k = 0; k < n; k++) {
            if (pm_active_set_is_idle(&w->numbers, &c[k])) continue;
            const int status = append(w, &c[k], basis, &w->active.of_joint[m->joint_constraint[i] + k]);
            if (status) return status;
        }
    }
    w->active.njoint = w->active.n;
    return PM_OK;
}

/* With a basis those first that add most: no order of the joints decides which are kept. */
static int append_joints(pm_workspace *w, pm_basis *basis)
{
    int status = PM_OK;
    for (double least = PM_MOSTLY_INDEPENDENT; basis && least > PM_CLEARLY_INDEPENDENT && !status;
         least *= PM_WORN) {
        basis->clearly = least;
        status = append_joints_once(w, basis);
    }
    if (basis) basis->clearly = 0;
    return status ? status : append_joints_once(w, basis);
}

/* Captured pairs are joints. */
static int append_captured(pm_workspace *w, pm_basis *basis)
{
    for (int i = 0; i < w->model->nslot; i++) {
        pm_constraint c[PM_JOINT_CONSTRAINTS];
        if (w->state.slot[i].mode != PM_CAPTURED) continue;
        const int n = pm_capture_constraints(&w->frame, &w->state, i, c);
        for (int k = 0; k < n; k++) {
            const int status = append(w, &c[k], basis, &w->active.slot_held[PM_JOINT_CONSTRAINTS * i + k]);
            if (status) return status;
        }
    }
    return PM_OK;
}

static int slides(int mode) { return mode == PM_SLIDE_FORWARD || mode == PM_SLIDE_BACKWARD; }

static double slide_factor(const pm_frame *frame, int contact, int mode)
{
    const double mu = pm_contact_kinetic(frame, contact);
    return mode == PM_SLIDE_FORWARD ? -mu : mu; /* friction opposes the slip */
}

/* In a phase the foot on a curve is followed, by the memory of the slot. */
static void follow_foot(const pm_model *m, int slot, pm_constraint *c)
{
    if (c->curve != PM_NONE) c->foot = m->nmemory - m->nslot + slot;
}

static int append_normals(pm_workspace *w, pm_basis *basis)
{
    const pm_slot *slot = w->state.slot;
    for (int i = 0; i < w->model->nslot; i++) {
        pm_constraint own, *normal = basis ? &own : &w->active.constraint[w->active.n]; /* in its place */
        if (slot[i].mode == PM_OPEN || slot[i].mode == PM_CAPTURED) continue;
        const int contact = pm_contact_of_slot(w->model, i);
        pm_contact_constraint_normal(&w->frame, contact, i, slot[i].member, normal);
        follow_foot(w->model, i, normal);
        if (slides(slot[i].mode)) normal->slide = slide_factor(&w->frame, contact, slot[i].mode);
        w->active.asymmetric |= normal->slide != 0;
        const int status = append(w, normal, basis, &w->active.slot_normal[i]);
        if (status) return status;
    }
    return PM_OK;
}

/* After all normals, of contacts that do not slip. */
static int append_tangents(pm_workspace *w, pm_basis *basis)
{
    const pm_slot *slot = w->state.slot;
    for (int i = 0; i < w->model->nslot; i++) {
        pm_constraint normal, tangent;
        if (slot[i].mode != PM_STICK) continue;
        const int contact = pm_contact_of_slot(w->model, i), active = w->active.slot_normal[i];
        if (active < 0)
            pm_contact_constraint_both(&w->frame, contact, i, slot[i].member, &normal, &tangent);
        else
            pm_contact_constraint_tangent(&w->frame, contact, &w->active.constraint[active], &tangent);
        follow_foot(w->model, i, &tangent);
        const int status = append(w, &tangent, basis, &w->active.slot_tangent[i]);
        if (status) return status;
    }
    return PM_OK;
}

/* Frictions of joints that hold. */
static int append_friction(pm_workspace *w, pm_basis *basis)
{
    for (int i = 0; i < w->model->nfriction; i++) {
        pm_constraint c;
        if (w->state.friction[i] != PM_STICK) continue;
        pm_joint_friction_constraint(&w->frame, i, &c);
        const int status = append(w, &c, basis, &w->active.friction_constraint[i]);
        if (status) return status;
    }
    return PM_OK;
}

/* Tangents that sliding normals carry stand behind the active constraints; an entry without a normal ends them. */
static void append_carried(pm_workspace *w)
{
    const pm_model *m = w->model;
    int n = w->active.n;
    for (int i = 0; i < m->nslot && w->active.asymmetric; i++) {
        const int mode = w->state.slot[i].mode;
        if (!slides(mode) || w->active.slot_normal[i] < 0) continue;
        pm_constraint normal, tangent;
        pm_contact_constraint_both(&w->frame, pm_contact_of_slot(m, i), i, w->state.slot[i].member, &normal,
                                   &tangent);
        follow_foot(m, i, &tangent);
        tangent.normal = w->active.slot_normal[i];
        w->active.constraint[n++] = tangent;
    }
    w->active.constraint[n].normal = PM_NONE;
}

/* Places from `first` on move by `way`; what was at `from` is at `to`. */
static void move_places(const pm_model *m, pm_active_set *x, int from, int to, int first, int way)
{
    const struct {
        int *place, n;
    } of[] = {{x->of_joint, m->njoint_constraint},
              {x->slot_normal, m->nslot},
              {x->slot_tangent, m->nslot},
              {x->slot_held, PM_JOINT_CONSTRAINTS * m->nslot},
              {x->friction_constraint, m->nfriction}};
    for (size_t k = 0; k < sizeof of / sizeof *of; k++)
        for (int i = 0; i < of[k].n; i++) {
            int *place = &of[k].place[i];
            *place = *place == from ? to : *place >= first ? *place + way : *place;
        }
}

/* An active constraint becomes the last redundant one; those behind it move up. */
static void move_out(const pm_model *m, pm_active_set *x, int one)
{
    const int to = leave_out(x, &x->constraint[one]), behind = --x->n - one;
    memmove(x->constraint + one, x->constraint + one + 1, (size_t)behind * sizeof *x->constraint);
    memmove(x->doubtful + one, x->doubtful + one + 1, (size_t)behind);
    move_places(m, x, one, to, one + 1, -1);
    x->njoint -= one < x->njoint;
}

/* The last redundant constraint becomes active again, where it was. */
static void move_back(const pm_model *m, pm_active_set *x, int one, int joint)
{
    const int from = PM_REDUNDANT_PLACE(--x->nredundant), behind = x->n++ - one;
    memmove(x->constraint + one + 1, x->constraint + one, (size_t)behind * sizeof *x->constraint);
    memmove(x->doubtful + one + 1, x->doubtful + one, (size_t)behind);
    x->constraint[one] = x->redundant[x->nredundant];
    x->doubtful[one] = 1;
    move_places(m, x, from, one, one, 1);
    x->njoint += joint;
}

/* Of several that are in doubt each may keep the neighbours of the others from being reached: this one beside those alone that are
 * in no doubt. */
static int depends_on_sure_ones(pm_workspace *w, const pm_constraint *c, int *depends)
{
    pm_active_set *x = &w->active;
    const int njoint = x->njoint, outside = x->nredundant;
    for (int i = x->n - 1; i >= 0; i--) {
        if (!x->doubtful[i]) continue;
        x->aside[x->nredundant - outside] = i;
        move_out(w->model, x, i);
    }
    const int status = pm_dependence_on_all(w, c, depends);
    while (x->nredundant > outside) {
        const int place = x->aside[x->nredundant - 1 - outside];
        move_back(w->model, x, place, place <= x->njoint && x->njoint < njoint);
    }
    return status;
}

/* What was kept since it depended here alone on those appended before it is left out if it depends for good on all the others:
 * no order of the constraints decides. */
static int leave_out_doubtful(pm_workspace *w)
{
    int status = PM_OK;
    for (int i = w->active.n - 1; i >= 0 && !status; i--) {
        const int joint = i < w->active.njoint;
        int depends;
        if (!w->active.doubtful[i]) continue;
        move_out(w->model, &w->active, i);
        const pm_constraint c = w->active.redundant[w->active.nredundant - 1];
        status = pm_dependence_on_all(w, &c, &depends);
        if (!status && depends == PM_DEPENDENCE_UNKNOWN) status = depends_on_sure_ones(w, &c, &depends);
        if (depends != PM_DEPENDENCE_FOR_GOOD) move_back(w->model, &w->active, i, joint);
    }
    return status;
}

static int any_is_closed(const pm_model *m, const pm_slot *slot)
{
    for (int i = 0; i < m->nslot; i++)
        if (slot[i].mode != PM_OPEN) return 1;
    return 0;
}

static int append_all(pm_workspace *w, pm_basis *basis)
{
    const int closed = any_is_closed(w->model, w->state.slot);
    pm_active_set_clear(&w->active, w->model);
    int status = append_joints(w, basis);
    if (!status && closed) status = append_captured(w, basis);
    for (int round = basis ? 0 : 1; round < 2 && !status; round++) {
        if (basis) basis->clearly = round == 0 ? PM_CLEARLY_INDEPENDENT : 0;
        if (closed) status = append_normals(w, basis);
        if (!status && closed) status = append_tangents(w, basis);
        if (!status) status = append_friction(w, basis);
    }
    return status;
}

/* How far the kept constraints are from depending on each other, where joints share loads; else 0. */
static double independence_of_kept(pm_workspace *w)
{
    int shared = 0;
    for (int k = 0; k < w->active.nredundant; k++) shared |= w->active.redundant[k].slot == PM_NONE;
    if (!shared || w->active.n == 0) return 0;
    pm_saddle_evaluate(&w->active, &w->frame);
    w->active.evaluated = 0;
    return pm_saddle_independence(&w->saddle);
}

/* A basis is dear: it is made only where constraints that depend on each other are in sight. */
int pm_active_set_build(pm_workspace *w)
{
    pm_basis basis = {0, 0};
    w->active.evaluated = 0;
    if (pm_solve_cache_is_built(w)) return PM_OK;
    int status = append_all(w, NULL);
    for (int i = 0; i < w->active.n && !status; i++)
        pm_constraint_kind(w->active.constraint[i].kind)->evaluate(&w->frame, &w->active.constraint[i]);
    const int independent =
        !status && (w->active.n == 0 || pm_saddle_independence(&w->saddle) > PM_CLEARLY_INDEPENDENT);
    if (!status && !independent) status = append_all(w, &basis);
    if (!status && !independent) status = leave_out_doubtful(w);
    if (!status) append_carried(w);
    w->active.clear = independent;
    w->active.evaluated = independent && !w->active.asymmetric;
    if (!status) w->active.independence = independence_of_kept(w);
    if (!status) pm_solve_cache_built(w);
    return status;
}

int pm_active_set_renew(pm_workspace *w, int *renewed)
{
    const double now = independence_of_kept(w);
    *renewed = now < PM_WORN * w->active.independence;
    w->active.independence = fmax(now, w->active.independence);
    if (!*renewed) return PM_OK;
    pm_solve_cache_forget(w->cache);
    return pm_active_set_build(w);
}

/* ---- what depends on others here ---- */
static int is_of_contact(const pm_active_set *x, int i)
{
    const int slot = x->constraint[i].slot;
    return slot != PM_NONE && (x->slot_normal[slot] == i || x->slot_tangent[slot] == i);
}

/* Of the constraints in doubt the one that adds most to a basis of n, or PM_NONE where all add next to nothing. */
static int clearest(pm_workspace *w, int n)
{
    pm_orthonormal_rest rest;
    double most = PM_LOOSE;
    int best = PM_NONE;
    for (int i = 0; i < w->active.n; i++) {
        if (!w->active.doubtful[i]) continue;
        (void)pm_orthonormal_rows_add_constraint(&w->saddle, n, &w->active.constraint[i], &rest);
        if (!(rest.left > most)) continue;
        most = rest.left;
        best = i;
    }
    return best;
}

int pm_active_set_let_loose(pm_workspace *w)
{
    pm_active_set *x = &w->active;
    const int outside = x->nredundant;
    pm_orthonormal_rest rest;
    int n = 0;
    for (int i = 0; i < x->n; i++) {
        x->doubtful[i] = is_of_contact(x, i);
        if (!x->doubtful[i]) n = pm_orthonormal_rows_add_constraint(&w->saddle, n, &x->constraint[i], &rest);
    }
    for (int i = clearest(w, n); i != PM_NONE; i = clearest(w, n)) {
        n = pm_orthonormal_rows_add_constraint(&w->saddle, n, &x->constraint[i], &rest);
        x->doubtful[i] = 0;
    }
    for (int i = x->n - 1; i >= 0; i--)
        if (x->doubtful[i]) move_out(w->model, x, i);
    if (x->nredundant == outside) return 0;
    x->version++;
    append_carried(w);
    return x->nredundant - outside;
}

void pm_active_set_carry(pm_workspace *w, int slot, double ratio)
{
    w->active.version++;
    w->active.constraint[w->active.slot_normal[slot]].slide = ratio;
    w->active.asymmetric = 1;
    append_carried(w);
}
