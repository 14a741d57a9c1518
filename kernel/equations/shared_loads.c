/* shared_loads.c - the vectors z by the factors of S: for a redundant constraint with direction h
 *
 *   S a = -G M^-1 h^T,  z = (a, 1)
 *
 * and the slack of a group as a linear program: the greatest m with A s - m + b >= 0.  Where loads may grow without limit, as
 * between two walls, m is not bounded: more than the forces of the scene says nothing more. */
#include "equations/shared_loads.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "equations/case.h"
#include "equations/saddle.h"
#include "numerics/tolerances.h"
#include "planemotion.h"
#include "scene/prune.h"
#include "state/arena.h"
#include "state/frame.h"

static int least(int a, int b) { return a < b ? a : b; }

int pm_shared_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (PM_ARENA_NEW(&w->memory, w->active.shared)) return PM_NO_MEMORY;
    pm_shared *x = w->active.shared;
    x->most = least(m->nconstraint, PM_SHARED_MOST);
    x->most_rows = least(3 * m->nslot + 1, 3 * PM_SHARED_MOST);
    const size_t nc = m->nconstraint, k = (size_t)x->most + 1, n = x->most_rows;
    const pm_array array[] = {
        PM_ARRAY(w->active.redundant, nc),
        PM_ARRAY(w->active.share, nc),
        PM_ARRAY(w->active.doubtful, nc),
        PM_ARRAY(w->active.aside, nc),
        PM_ARRAY(w->impulses.shared, nc * (size_t)(m->njoint_constraint + 2 * m->nslot)),
        PM_ARRAY(x->pose, 5 * (m->nbody + 1)),
        PM_ARRAY(x->loads, nc),
        PM_ARRAY(x->z, nc * nc),
        PM_ARRAY(x->own, nc),
        PM_ARRAY(x->group, nc),
        PM_ARRAY(x->amount, nc),
        PM_ARRAY(x->slack, nc),
        PM_ARRAY(x->bounded, nc),
        PM_ARRAY(x->slot_group, m->nslot),
        PM_ARRAY(x->bound, m->nslot),
        PM_ARRAY(x->force, m->nq),
        PM_ARRAY(x->response, m->nq),
        PM_ARRAY(x->rhs, nc),
        PM_ARRAY(x->kept, nc + m->njoint_constraint + 2 * m->nslot),
        PM_ARRAY(x->matrix, n * k),
        PM_ARRAY(x->right, n),
        PM_ARRAY(x->cost, k),
        PM_ARRAY(x->found, k),
        PM_ARRAY(x->multiplier, n),
        PM_ARRAY(x->square, k * k),
        PM_ARRAY(x->member, k),
        PM_ARRAY(x->row_slot, n),
        PM_ARRAY(x->row_bound, n),
        PM_ARRAY(x->program.scratch, PM_QUADRATIC_SCRATCH(k, n)),
        PM_ARRAY(x->program.basis, PM_QUADRATIC_ORDER(k, n)),
    };
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

/* ---- the vectors ---- */
/* The direction of the force of a redundant constraint: a normal that slides carries its tangent. */
static pm_constraint direction_of(const pm_workspace *w, int k)
{
    pm_constraint c = w->active.redundant[k], normal, tangent;
    pm_constraint_kind(c.kind)->evaluate(&w->frame, &c);
    memcpy(c.h, c.j, sizeof c.h);
    if (c.slide == 0) return c;
    pm_contact_constraint_both(&w->frame, pm_contact_of_slot(w->model, c.slot), c.slot,
                               w->state.slot[c.slot].member, &normal, &tangent);
    pm_constraint_kind(tangent.kind)->evaluate(&w->frame, &tangent);
    for (int i = 0; i < 3 * pm_constraint_bodies(&c); i++) c.h[i] += c.slide * tangent.j[i];
    return c;
}

static void find_vector(pm_workspace *w, int k)
{
    pm_shared *x = w->active.shared;
    const pm_constraint c = direction_of(w, k);
    double *z = x->z + (size_t)k * w->model->nconstraint, largest = 1;
    memset(x->force, 0, (size_t)w->model->nq * sizeof *x->force);
    for (int i = 0; i < 3 * pm_constraint_bodies(&c); i++)
        if (c.body[i / 3] != w->model->nbody) x->force[3 * c.body[i / 3] + i % 3] += c.h[i];
    for (int i = 0; i < w->active.n; i++) w->saddle.wanted[i] = 0;
    if (w->active.n > 0) pm_saddle_respond_roughly(w, x->force, x->response);
    for (int i = 0; i < w->active.n; i++) largest = fmax(largest, fabs(w->saddle.rhs[i]));
    x->own[k] = 1 / largest;
    for (int i = 0; i < w->active.n; i++) {
        z[i] = w->saddle.rhs[i] / largest;
        if (fabs(z[i]) < PM_SHARED_NOTHING) z[i] = 0;
    }
}

double pm_shared_entry(const pm_workspace *w, int i, int place)
{
    const pm_shared *x = w->active.shared;
    if (place == PM_NONE) return 0;
    if (place >= 0) return x->z[(size_t)i * w->model->nconstraint + place];
    return PM_REDUNDANT_PLACE(place) == i ? x->own[i] : 0;
}

static int sticks_by_friction(const pm_workspace *w, int slot)
{
    return w->active.slot_tangent[slot] != PM_NONE &&
           pm_contact_friction(w->model, pm_contact_of_slot(w->model, slot)) == PM_FRICTION_COULOMB;
}

/* The first of a group is its least. */
static void join(pm_shared *x, int a, int b)
{
    const int from = x->group[a] > x->group[b] ? x->group[a] : x->group[b],
              to = least(x->group[a], x->group[b]);
    for (int i = 0; i < x->n; i++)
        if (x->group[i] == from) x->group[i] = to;
}

/* Joins all vectors that change one of two loads. */
static void join_at(pm_workspace *w, int place, int other)
{
    int first = PM_NONE;
    for (int i = 0; i < w->active.shared->n; i++) {
        if (pm_shared_entry(w, i, place) == 0 && pm_shared_entry(w, i, other) == 0) continue;
        if (first != PM_NONE) join(w->active.shared, first, i);
        first = i;
    }
}

/* Where friction holds, normal and tangential load of a contact bound each other. */
static void find_groups(pm_workspace *w)
{
    for (int i = 0; i < w->active.shared->n; i++) w->active.shared->group[i] = i;
    for (int c = 0; c < w->active.n; c++) join_at(w, c, c);
    for (int i = 0; i < w->model->nslot; i++)
        if (sticks_by_friction(w, i)) join_at(w, w->active.slot_normal[i], w->active.slot_tangent[i]);
}

/* The reactions at the frame, and the right-hand side, stay what they are. */
int pm_shared_look_vectors(pm_workspace *w)
{
    pm_shared *x = w->active.shared;
    const pm_where where = w->result.where;
    x->n = 0;
    if (w->active.nredundant == 0) return 0;
    memcpy(x->rhs, w->saddle.rhs, (size_t)w->model->nconstraint * sizeof *x->rhs);
    pm_saddle_evaluate(&w->active, &w->frame);
    w->active.evaluated = 0;
    if (w->active.n == 0 || pm_saddle_factor(w) == PM_OK) {
        x->n = w->active.nredundant;
        for (int k = 0; k < x->n; k++) find_vector(w, k);
        find_groups(w);
    }
    w->result.where = where;
    memcpy(w->saddle.rhs, x->rhs, (size_t)w->model->nconstraint * sizeof *x->rhs);
    return x->n;
}

/* ---- the slack of a group ---- */
static int in_group(const pm_workspace *w, int first, int place)
{
    for (int i = 0; i < w->active.shared->n; i++)
        if (w->active.shared->group[i] == first && pm_shared_entry(w, i, place) != 0) return 1;
    return 0;
}

/* Where the distribution begins redundant constraints carry nothing. */
static double load_at(const double *load, int place) { return place >= 0 ? load[place] : 0; }

/* One condition: normal x N + tangent x T >= 0. */
static void add_condition(pm_workspace *w, const double *load, int row, int nmember, int slot, double normal,
                          double tangent, double size, int bound)
{
    pm_shared *x = w->active.shared;
    const int of_normal = w->active.slot_normal[slot], of_tangent = w->active.slot_tangent[slot];
    for (int i = 0; i < nmember; i++) {
        double sum = normal * pm_shared_entry(w, x->member[i], of_normal);
        if (tangent != 0) sum += tangent * pm_shared_entry(w, x->member[i], of_tangent);
        x->matrix[row * nmember + i] = sum;
    }
    x->right[row] = normal * load_at(load, of_normal);
    if (tangent != 0) x->right[row] += tangent * load_at(load, of_tangent);
    x->right[row] /= size;
    x->row_slot[row] = slot;
    x->row_bound[row] = bound;
}

int pm_shared_conditions(pm_workspace *w, const double *load, int first, double size, int *nmember)
{
    pm_shared *x = w->active.shared;
    int n = 0;
    *nmember = 0;
    for (int i = 0; i < x->n; i++) {
        if (x->group[i] != first) continue;
        if (*nmember == x->most) return -1;
        x->member[(*nmember)++] = i;
    }
    for (int i = 0; i < w->model->nslot; i++) {
        const int normal = w->active.slot_normal[i];
        if (normal == PM_NONE ||
            !(in_group(w, first, normal) || in_group(w, first, w->active.slot_tangent[i])))
            continue;
        if (n + 3 >= x->most_rows + 1) return -1;
        add_condition(w, load, n++, *nmember, i, 1, 0, size, PM_BOUND_NORMAL);
        if (!sticks_by_friction(w, i)) continue;
        const double mu = pm_contact_static(&w->frame, pm_contact_of_slot(w->model, i));
        add_condition(w, load, n++, *nmember, i, mu, -1, size, PM_BOUND_FORWARD);
        add_condition(w, load, n++, *nmember, i, mu, 1, size, PM_BOUND_BACKWARD);
    }
    return n;
}

/* The conditions get m as a last unknown, and m <= most as a last condition. */
static void add_slack(pm_shared *x, int n, int nmember, double most)
{
    const int k = nmember + 1;
    for (int r = n - 1; r >= 0; r--) {
        memmove(x->matrix + r * k, x->matrix + r * nmember, (size_t)nmember * sizeof *x->matrix);
        x->matrix[r * k + nmember] = -1;
    }
    memset(x->matrix + n * k, 0, (size_t)k * sizeof *x->matrix);
    x->matrix[n * k + nmember] = -1;
    x->right[n] = most;
    memset(x->cost, 0, (size_t)k * sizeof *x->cost);
    x->cost[nmember] = -1;
}

/* The program's value by its multipliers: sum l b, which rounding of s does not enter. */
static double value_of(const pm_shared *x, int n)
{
    double value = 0, all = 0;
    for (int r = 0; r <= n; r++) {
        value += x->multiplier[r] * x->right[r];
        all += x->multiplier[r];
    }
    return value / all;
}

int pm_shared_solve(pm_shared *x, int k, int n, const double *square)
{
    pm_quadratic_program p = x->program;
    p.k = k;
    p.n = n;
    p.K = square;
    p.c = x->cost;
    p.A = x->matrix;
    p.b = x->right;
    p.s = x->found;
    p.bound = x->multiplier;
    return pm_quadratic_program_solve(&p);
}

static void find_slack(pm_workspace *w, int first, double size)
{
    pm_shared *x = w->active.shared;
    int nmember;
    const int n = pm_shared_conditions(w, w->frame.lambda, first, size, &nmember);
    x->slack[first] = INFINITY;
    if (n <= 0) return;
    const double most = pm_case_force(w->model, &w->numbers);
    add_slack(x, n, nmember, most / size);
    if (!pm_shared_solve(x, nmember + 1, n + 1, NULL)) return;
    x->slack[first] = value_of(x, n) * size;
    x->bounded[first] = !(x->multiplier[n] > PM_SHARED_BOUNDS);
    for (int r = 0; r < n; r++) {
        x->slot_group[x->row_slot[r]] = first;
        if (x->multiplier[r] > PM_SHARED_BOUNDS) x->bound[x->row_slot[r]] |= x->row_bound[r];
    }
}

/* ---- at a frame ---- */
int pm_shared_is_known(const pm_workspace *w)
{
    const pm_shared *x = w->active.shared;
    return x->known && x->version == w->active.version &&
           memcmp(x->pose, w->frame.pose, 5 * (size_t)w->model->nbody * sizeof *x->pose) == 0 &&
           memcmp(x->loads, w->frame.lambda, (size_t)w->active.n * sizeof *x->loads) == 0;
}

static double force_size(const pm_workspace *w)
{
    double sum = pm_case_force(w->model, &w->numbers);
    for (int i = 0; i < w->active.n; i++) sum = fmax(sum, fabs(w->frame.lambda[i]));
    return sum;
}

int pm_shared_look(pm_workspace *w)
{
    pm_shared *x = w->active.shared;
    if (w->active.nredundant == 0) return 0;
    if (pm_shared_is_known(w)) return x->n;
    for (int i = 0; i < w->model->nslot; i++) {
        x->slot_group[i] = PM_NONE;
        x->bound[i] = 0;
    }
    memset(w->active.share, 0, (size_t)w->active.nredundant * sizeof *w->active.share);
    pm_shared_look_vectors(w);
    const double size = force_size(w);
    for (int i = 0; i < x->n; i++)
        if (x->group[i] == i) find_slack(w, i, size);
    x->known = 1;
    x->is_least = 0;
    x->version = w->active.version;
    memcpy(x->pose, w->frame.pose, 5 * (size_t)w->model->nbody * sizeof *x->pose);
    memcpy(x->loads, w->frame.lambda, (size_t)w->active.n * sizeof *x->loads);
    return x->n;
}

int pm_shared_slack(pm_workspace *w, int slot, double *slack)
{
    if (!pm_shared_look(w) || w->active.shared->slot_group[slot] == PM_NONE) return 0;
    *slack = w->active.shared->slack[w->active.shared->slot_group[slot]];
    return 1;
}

int pm_shared_is_bounded(pm_workspace *w, int slot, double *slack)
{
    return pm_shared_slack(w, slot, slack) && w->active.shared->bounded[w->active.shared->slot_group[slot]];
}

int pm_shared_bound_of(pm_workspace *w, int slot)
{
    double slack;
    return pm_shared_slack(w, slot, &slack) ? w->active.shared->bound[slot] : 0;
}

/* ---- for people ---- */
static void mark(pm_workspace *w, int first, const pm_constraint *c, int place, int32_t *joint,
                 int32_t *contact)
{
    const int32_t number = first + 1;
    if (!in_group(w, first, place)) return;
    if (c->joint != PM_NONE) joint[pm_prune_original(w->model, PM_TABLE_JOINT, c->joint)] = number;
    if (c->slot != PM_NONE)
        contact[pm_prune_original(w->model, PM_TABLE_CONTACT, pm_contact_of_slot(w->model, c->slot))] =
            number;
}

void pm_shared_elements(pm_workspace *w, int32_t *joint, int32_t *contact)
{
    const pm_shared *x = w->active.shared;
    w->active.shared->known = 0;
    pm_shared_look_vectors(w);
    for (int g = 0; g < x->n; g++) {
        for (int i = 0; i < w->active.n; i++) mark(w, g, &w->active.constraint[i], i, joint, contact);
        for (int k = 0; k < x->n; k++)
            mark(w, g, &w->active.redundant[k], PM_REDUNDANT_PLACE(k), joint, contact);
    }
}
