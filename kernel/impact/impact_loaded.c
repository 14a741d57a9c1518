/* impact_loaded.c - blows that load joints whose friction goes with their load (contact_problem_joints.h).
 *
 * Where a law asks for the course of the blow, or one contact is struck alone, the slip of a joint is that of the moment, and its
 * friction reverses where that ends; else it is the slip after the blow, as at the contacts.  The reactions of a joint to unit
 * impulses at contacts, and along its own slip, are read from those of all that holds. */
#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "elements/joint_friction.h"
#include "equations/shared_loads.h"
#include "impact/impact_parts.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"
#include "state/workspace.h"

/* ---- which joints ---- */
static int fail_at(pm_workspace *w, int k, int status)
{
    return pm_fail(&w->result, status, PM_TABLE_FORCE, w->model->friction_force[k], NAN, NAN);
}

static int may_rub(const pm_workspace *w, int k)
{
    return pm_joint_friction_coefficient(&w->frame, k) > 0 &&
           !pm_state_is_absent(w->model, &w->state, PM_TABLE_JOINT, pm_joint_friction_joint(w->model, k));
}

static int any_may_rub(const pm_workspace *w)
{
    for (int k = 0; k < w->model->nfriction; k++)
        if (may_rub(w, k)) return 1;
    return 0;
}

static const pm_constraint *direction(const pm_contact_system *x, int i)
{
    return i % 2 == 0 ? &x->normal[i / 2] : &x->tangent[i / 2];
}

/* Listed are those that slip, and that the blow loads. */
static int is_loaded(pm_workspace *w, pm_blow *b, int k, pm_constraint *along)
{
    pm_contact_system *x = &b->system;
    double load[2];
    pm_joint_friction_constraint(&w->frame, k, along);
    pm_constraint_kind(along->kind)->evaluate(&w->frame, along);
    pm_contact_system_respond_along(w, x, along);
    const double moves = pm_constraint_times(&w->frame, along, x->response);
    if (moves <= PM_JOINTS_FREE * pm_constraint_square(&w->frame, along)) return 0;
    if (b->loaded.captures) return 1;
    for (int i = 0; i < 2 * x->problem.n; i++) {
        pm_contact_system_respond_along(w, x, direction(x, i));
        pm_joint_friction_loads(w, k, w->saddle.rhs, load);
        if (hypot(load[0], load[1]) > PM_JOINTS_FREE) return 1;
    }
    return 0;
}

/* Its reaction is not unique: redundant constraints share it. */
static int is_shared(pm_workspace *w, int k)
{
    int place[2];
    const int shared = w->active.nredundant > 0 ? pm_shared_look_vectors(w) : 0;
    const int n = pm_joint_friction_places(w, k, place);
    for (int i = 0; i < n; i++) {
        if (place[i] < 0) return 1;
        for (int r = 0; r < shared; r++)
            if (pm_shared_entry(w, r, place[i]) != 0) return 1;
    }
    return 0;
}

static int list_joints(pm_workspace *w, pm_blow *b)
{
    b->course.m = 0;
    b->loaded.captures = 0;
    for (int i = 0; i < w->model->nslot; i++)
        b->loaded.captures |= b->share[i] == PM_STRUCK && b->trial[i] == PM_CAPTURED;
    for (int k = 0; k < w->model->nfriction && w->active.n > 0; k++) {
        if (!may_rub(w, k) || !is_loaded(w, b, k, &b->loaded.along[b->course.m])) continue;
        if (w->numbers.massless) return fail_at(w, k, PM_UNSUPPORTED);
        if (is_shared(w, k)) return fail_at(w, k, PM_NOT_UNIQUE);
        b->loaded.friction[b->course.m++] = k;
    }
    return PM_OK;
}

/* ---- the problem ---- */
static const pm_constraint *direction_of_all(const pm_blow *b, int i)
{
    const int n = 2 * b->system.problem.n;
    return i < n ? direction(&b->system, i) : &b->loaded.along[i - n];
}

/* One column of response and reactions. */
static void pose_column(pm_workspace *w, pm_blow *b, int i)
{
    pm_contact_course *c = &b->course;
    const int all = 2 * c->n + c->m;
    pm_contact_system_respond_along(w, &b->system, direction_of_all(b, i));
    for (int r = 0; r < all; r++)
        c->response[r * all + i] = pm_constraint_times(&w->frame, direction_of_all(b, r), b->system.response);
    for (int k = 0; k < c->m; k++) {
        double load[2];
        pm_joint_friction_loads(w, b->loaded.friction[k], w->saddle.rhs, load);
        for (int j = 0; j < 2; j++) c->reaction[(2 * k + j) * all + i] = load[j];
    }
}

static void pose(pm_workspace *w, pm_blow *b)
{
    pm_contact_system *x = &b->system;
    pm_contact_course *c = &b->course;
    const int n = 2 * x->problem.n;
    pm_impact_pose_course(w, b);
    pm_impact_pose(w, b);
    c->exponent = 0;
    for (int i = 0; i < x->problem.n; i++) c->contact[i].friction = x->problem.contact[i];
    for (int i = 0; i < n + c->m; i++) pose_column(w, b, i);
    pm_contact_system_still_held(&w->frame, x, c->response, n + c->m);
    pm_impact_respond_free(w, x);
    for (int k = 0; k < c->m; k++) {
        const int of = b->loaded.friction[k];
        const pm_constraint *along = &b->loaded.along[k];
        c->joint[k] = (pm_contact_course_joint){.coefficient = pm_joint_friction_coefficient(&w->frame, of),
                                                .no_slip = pm_joint_friction_no_slip(&w->frame, of)};
        c->joint[k].nload = pm_joint_friction_loads(w, of, w->saddle.rhs, c->joint[k].start);
        c->velocity[n + k] = pm_constraint_times(&w->frame, along, x->free) - along->rate;
    }
}

/* ---- how it is solved ---- */
/* What a blow that is followed cannot have beside such joints. */
static int check(pm_workspace *w, const pm_blow *b)
{
    const pm_contact_system *x = &b->system;
    const int status = pm_impact_check_followed(w, x);
    for (int i = 0; i < x->problem.n && !status; i++) {
        const int contact = pm_contact_of_slot(w->model, x->slot[i]);
        if (x->problem.contact[i].friction == PM_FRICTION_ROUGH || b->loaded.captures ||
            pm_contact_stiffness(&w->frame, contact) > 0)
            return fail_at(w, b->loaded.friction[0], PM_UNSUPPORTED);
    }
    return status;
}

/* The listed contact that pushes alone, if its blow can be followed; or PM_NONE. */
static int find_alone(const pm_workspace *w, const pm_blow *b)
{
    const pm_contact_system *x = &b->system;
    int alone = PM_NONE;
    for (int i = 0; i < x->problem.n; i++) {
        if (!(b->course.impulse[2 * i] > 0)) continue;
        if (alone != PM_NONE || b->loaded.captures ||
            PM_CONTACT_ROW(w->model, pm_contact_of_slot(w->model, x->slot[i]))[PM_CONTACT_TANGENTIAL] !=
                PM_NONE ||
            x->problem.contact[i].friction == PM_FRICTION_ROUGH)
            return PM_NONE;
        alone = i;
    }
    return alone;
}

/* The course of listed contact i as if no other were there, whose impulses are none. */
static int follow_alone(pm_contact_course *c, int i)
{
    const int n = c->n, m = c->m, all = 2 * n + m, few = 2 + m;
    for (int r = 0; r < few; r++)
        for (int k = 0; k < few; k++) {
            const int row = r < 2 ? 2 * i + r : 2 * n + r - 2, column = k < 2 ? 2 * i + k : 2 * n + k - 2;
            c->response[r * few + k] = c->response[row * all + column];
        }
    for (int r = 0; r < 2 * m; r++)
        for (int k = 0; k < few; k++)
            c->reaction[r * few + k] = c->reaction[r * all + (k < 2 ? 2 * i + k : 2 * n + k - 2)];
    for (int k = 0; k < few; k++) c->velocity[k] = c->velocity[k < 2 ? 2 * i + k : 2 * n + k - 2];
    c->contact[0] = c->contact[i];
    c->n = 1;
    const int found = pm_contact_course_follow(c);
    c->n = n;
    double *p = c->impulse;
    const double own[2] = {p[0], p[1]};
    memmove(p + 2 * n, p + 2, (size_t)m * sizeof *p);
    memset(p, 0, 2 * (size_t)n * sizeof *p);
    memcpy(p + 2 * i, own, sizeof own);
    return found;
}

static int finish(pm_workspace *w, pm_blow *b, int found)
{
    const int differs = b->course.differs;
    if (found != 1) return pm_impact_fail(w, &b->system, found, differs == PM_NONE ? 0 : differs);
    return pm_impact_apply(w, b);
}

/* By the slip after the blow; or, where one contact carries all of it and nothing else approaches then, as its course. */
static int solve_at_once(pm_workspace *w, pm_blow *b)
{
    int status = finish(w, b, pm_contact_course_at_once(&b->course));
    const int alone = status ? PM_NONE : find_alone(w, b);
    if (alone == PM_NONE) return status;
    pose(w, b);
    const int found = follow_alone(&b->course, alone);
    if (found == 1 && (status = pm_impact_apply(w, b))) return status;
    if (found == 1 && pm_impact_others_part(w, b, b->system.slot[alone])) return PM_OK;
    pose(w, b);
    return finish(w, b, pm_contact_course_at_once(&b->course));
}

int pm_impact_loaded(pm_workspace *w, pm_blow *b, int *loaded)
{
    *loaded = 0;
    if (!any_may_rub(w)) return PM_OK;
    int status = pm_impact_list(w, b);
    if (!status) status = list_joints(w, b);
    if (status || b->course.m == 0) return status;
    *loaded = 1;
    memset(b->given, 0, (size_t)w->model->nslot * sizeof *b->given);
    b->plastic = 0;
    const int followed = pm_impact_is_followed(w->model, &b->system);
    if (followed && (status = check(w, b))) return status;
    if (b->system.problem.n == 0 && !b->loaded.captures) return PM_OK;
    pose(w, b);
    status = followed ? finish(w, b, pm_contact_course_follow(&b->course)) : solve_at_once(w, b);
    if (!status) pm_impact_record_followed(w, b);
    return status;
}
