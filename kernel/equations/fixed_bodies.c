/* fixed_bodies.c - bodies that joints fix for good.
 *
 * Let S be bodies, and G the constraints of joints between them, the ground and bodies that are fixed already.  Where
 *     G v = 0   has no other solution than   v = 0,
 * the bodies of S never move, whatever acts on them and whatever moves beside them: G does not depend on the time.  They
 * are ground then: their constraints say nothing of what moves, and forces on them do no work.  These sets are tried, again
 * and again from what is fixed already:
 *   - a body alone: welded, or held by three constraints,
 *   - two that are joined: a triangle on the ground, and whatever is built up of such,
 *   - all that hang together, if they are few.
 * Where even as many independent constraints as there are would not hold a body (counted once a scene) no case is searched.
 *
 * Left to the equations of motion are sets that are nearly not held, joints that are driven, added or removed, bodies that
 * an impulse acts on, and the pairs of a contact and of a joint that has friction or whose reaction is asked. */
#include "equations/fixed_bodies.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/joint.h"
#include "elements/joint_friction.h"
#include "elements/measure.h"
#include "equations/active_set.h"
#include "equations/orthonormal_rows.h"
#include "equations/saddle.h"
#include "equations/solve_cache.h"
#include "expression/operation.h"
#include "numerics/tolerances.h"
#include "scene/reference.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/workspace.h"

enum { WIDE = 3 * PM_FIXED_SET };

/* ---- what must move, and what is asked ---- */
/* All bodies that a row of a table refers to move. */
static void let_move(const pm_model *m, pm_fixed_bodies *fixed, int table, int row)
{
    int body[PM_REFERENCES];
    const int n = pm_reference_bodies(m, table, row, body);
    for (int k = 0; k < n; k++)
        if (body[k] >= 0) fixed->moves[body[k]] = 1;
}

/* The joints of which a program reads a reaction. */
static void ask_read(const pm_model *m, pm_fixed_bodies *fixed, int program)
{
    for (pm_program_walk x = pm_program_walk_begin(m, program); pm_program_walk_next(&x);) {
        if (x.op != PM_OP_MEASURE) continue;
        const int32_t *e = PM_MEASURE_ROW(m, x.arg);
        if (pm_measure_kind(e[PM_MEASURE_KIND])->of == PM_TABLE_JOINT) fixed->is_asked[e[PM_MEASURE_A]] = 1;
    }
}

/* What is asked or watched, or acts; the columns of a history, which no table refers to, do not count. */
static void note_asked(const pm_model *m, pm_fixed_bodies *fixed)
{
    for (int table = PM_TABLE_BODY; table < PM_TABLES; table++)
        for (int i = 0; i < m->rows[table]; i++) {
            pm_reference ref[PM_REFERENCES];
            const int n = pm_reference_of(m, table, i, ref);
            for (int k = 0; k < n; k++)
                if (ref[k].of == PM_TABLE_PROGRAM) ask_read(m, fixed, ref[k].index);
        }
}

static void note_others(const pm_model *m, pm_fixed_bodies *fixed)
{
    for (int i = 0; i < m->rows[PM_TABLE_ACTION]; i++)
        if (PM_ACTION_ROW(m, i)[PM_ACTION_KIND] > PM_ACTION_REMOVE) let_move(m, fixed, PM_TABLE_ACTION, i);
    for (int k = 0; k < m->nfriction; k++) fixed->is_asked[pm_joint_friction_joint(m, k)] = 1;
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++)
        if (pm_joint_of(m, i)->programs > 0) fixed->is_asked[i] = 1;
}

void pm_fixed_bodies_begin(pm_workspace *w)
{
    w->fixed->n = 0;
    memset(w->numbers.fixed, 0, (size_t)w->model->nbody);
    w->numbers.fixed[w->model->nbody] = 1;
}

/* ---- which bodies ---- */
/* The constraints of the joints that stay, in w->active, evaluated unless they are only counted, and those of each body. */
static int list_constraints(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_fixed_bodies *x = w->fixed;
    int n = 0;
    for (int i = 0; i < m->nbody; i++) x->first[i] = PM_NONE;
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++) {
        pm_constraint c[PM_JOINT_CONSTRAINTS];
        if (pm_model_is_changed(m, PM_TABLE_JOINT, i) || pm_joint_of(m, i)->programs > 0) continue;
        const int of_joint = pm_joint_constraints(&w->frame, &w->state, i, c);
        for (int k = 0; k < of_joint; k++, n++) {
            w->active.constraint[n] = c[k];
            if (!x->counts) pm_constraint_kind(c[k].kind)->evaluate(&w->frame, &w->active.constraint[n]);
            for (int side = 0; side < 2; side++) {
                const int body = c[k].body[side];
                if (body == m->nbody) continue;
                x->next[2 * n + side] = x->first[body];
                x->first[body] = 2 * n + side;
            }
        }
    }
    return n;
}

/* Bodies that are tried together, and the constraints that hold them so far. */
typedef struct pm_group {
    int body[PM_FIXED_SET], n;
    int freedom, rank;
    double basis[WIDE][WIDE];
    int range[WIDE][2];
} pm_group;

static int place_in(const pm_group *g, int body)
{
    for (int i = 0; i < g->n; i++)
        if (g->body[i] == body) return i;
    return PM_NONE;
}

static void join(const pm_model *model, pm_group *g, int body)
{
    g->body[g->n++] = body;
    g->freedom += PM_BODY_ROW(model, body)[PM_BODY_ROTATES] ? 3 : 2;
}

/* Counts a constraint if it is clearly independent of those before it. */
static void add_constraint(const pm_numbers *numbers, pm_group *g, const pm_constraint *constraint)
{
    const pm_orthonormal basis = {&g->basis[0][0], &g->range[0][0], WIDE, PM_CLEARLY_INDEPENDENT};
    pm_orthonormal_rest rest;
    double *x = g->basis[g->rank];
    g->range[g->rank][0] = 0;
    g->range[g->rank][1] = 3 * g->n;
    for (int c = 0; c < 3 * g->n; c++) x[c] = 0;
    for (int side = 0; side < 2; side++) {
        const int at = place_in(g, constraint->body[side]);
        for (int k = 0; k < 3 && at != PM_NONE; k++)
            x[3 * at + k] +=
                constraint->j[3 * side + k] * numbers->inverse_root[3 * constraint->body[side] + k];
    }
    g->rank = pm_orthonormal_rows_add(&basis, g->rank, &rest);
}

/* Whether constraints between these bodies, and to what is fixed, hold them; then they are fixed, too. */
static int holds(pm_workspace *w, pm_group *g)
{
    pm_fixed_bodies *x = w->fixed;
    for (int i = 0; i < g->n; i++)
        for (int at = x->first[g->body[i]]; at != PM_NONE && g->rank < g->freedom; at = x->next[at]) {
            const pm_constraint *c = &w->active.constraint[at / 2];
            const int other = c->body[1 - at % 2], place = place_in(g, other);
            if (!w->numbers.fixed[other] && place <= i) continue;
            if (x->counts)
                g->rank++;
            else
                add_constraint(&w->numbers, g, c);
        }
    if (g->rank < g->freedom) return 0;
    for (int i = 0; i < g->n; i++) w->numbers.fixed[g->body[i]] = 1;
    x->n += g->n;
    return 1;
}

static int must_move(const pm_fixed_bodies *x, int body) { return x->moves[body] || x->is_left[body]; }

static int may_be_fixed(const pm_numbers *numbers, const pm_fixed_bodies *fixed, int body)
{
    return !numbers->fixed[body] && !must_move(fixed, body);
}

/* A body alone. */
static int try_one(pm_workspace *w, int body)
{
    pm_group g = {.n = 0};
    if (!may_be_fixed(&w->numbers, w->fixed, body)) return 0;
    join(w->model, &g, body);
    return holds(w, &g);
}

/* The two bodies of a constraint. */
static int try_two(pm_workspace *w, const pm_constraint *c)
{
    pm_group g = {.n = 0};
    for (int side = 0; side < 2; side++) {
        if (!may_be_fixed(&w->numbers, w->fixed, c->body[side])) return 0;
        join(w->model, &g, c->body[side]);
    }
    return holds(w, &g);
}

/* All that hang together with a body, if they are few. */
static int try_all(pm_workspace *w, int body)
{
    pm_fixed_bodies *x = w->fixed;
    pm_group g = {.n = 0};
    if (!may_be_fixed(&w->numbers, w->fixed, body)) return 0;
    join(w->model, &g, body);
    for (int i = 0; i < g.n; i++)
        for (int at = x->first[g.body[i]]; at != PM_NONE; at = x->next[at]) {
            const int other = w->active.constraint[at / 2].body[1 - at % 2];
            if (w->numbers.fixed[other] || place_in(&g, other) != PM_NONE) continue;
            if (must_move(x, other) || g.n == PM_FIXED_SET) return 0;
            join(w->model, &g, other);
        }
    return holds(w, &g);
}

static void find(pm_workspace *w)
{
    const int nbody = w->model->nbody, nconstraint = list_constraints(w);
    for (int more = 1; more;) {
        more = 0;
        for (int i = 0; i < nbody; i++) more |= try_one(w, i);
        for (int i = 0; i < nconstraint; i++) more |= try_two(w, &w->active.constraint[i]);
        for (int i = 0; i < nbody; i++) more |= try_all(w, i);
    }
}

/* ---- once a scene ---- */
/* What is fixed if every constraint holds something of its own: no case fixes more. */
static void find_possible(pm_workspace *w)
{
    pm_fixed_bodies *x = w->fixed;
    pm_fixed_bodies_begin(w);
    x->counts = 1;
    find(w);
    x->counts = 0;
    x->possible = x->n > 0;
}

int pm_fixed_bodies_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (PM_ARENA_NEW(&w->memory, w->fixed)) return PM_NO_MEMORY;
    pm_fixed_bodies *x = w->fixed;
    const pm_array array[] = {
        PM_ARRAY(x->first, m->nbody),
        PM_ARRAY(x->next, 2 * m->njoint_constraint),
        PM_ARRAY(x->moves, m->nbody),
        PM_ARRAY(x->is_left, m->nbody),
        PM_ARRAY(x->is_asked, m->rows[PM_TABLE_JOINT]),
    };
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    if (status) return status;
    note_asked(w->model, w->fixed);
    note_others(w->model, w->fixed);
    find_possible(w);
    pm_fixed_bodies_begin(w);
    return PM_OK;
}

/* ---- once a case ---- */
/* The bodies of a constraint that are all fixed are left to the equations of motion. */
static int let_go(pm_workspace *w, const pm_constraint *c)
{
    int any = 0;
    if (!pm_active_set_is_idle(&w->numbers, c)) return 0;
    for (int side = 0; side < pm_constraint_bodies(c); side++) {
        const int body = c->body[side];
        if (body == w->model->nbody || must_move(w->fixed, body)) continue;
        w->fixed->is_left[body] = 1;
        any = 1;
    }
    return any;
}

/* Of contacts, and of joints of which something is asked, the equations must know. */
static int let_asked_move(pm_workspace *w)
{
    const pm_model *m = w->model;
    int any = 0;
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) {
        pm_constraint normal, tangent;
        pm_contact_constraint_both(&w->frame, i, m->contact_slot[i], 0, &normal, &tangent);
        any |= let_go(w, &normal);
    }
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++) {
        pm_constraint c[PM_JOINT_CONSTRAINTS];
        if (w->fixed->is_asked[i] && pm_joint_constraints_of_any(&w->frame, i, c) > 0)
            any |= let_go(w, &c[0]);
    }
    return any;
}

static void stop(pm_workspace *w)
{
    w->numbers.massless = 0;
    pm_saddle_forget(&w->saddle); /* they are of other masses */
    for (int i = 0; i < w->model->nq; i++) {
        if (w->numbers.fixed[i / 3]) {
            w->numbers.inverse_mass[i] = w->numbers.inverse_root[i] = w->numbers.stand_in[i] = 0;
            w->numbers.light[i] = 0;
            w->state.v[i] = w->start.v[i] = w->frame.a[i] = w->frame.velocity[i] = 0;
        }
        w->numbers.massless |= w->numbers.stand_in[i] > 0;
    }
}

void pm_fixed_bodies_find(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (!w->fixed->wanted || !w->fixed->possible || w->record.history || m->rows[PM_TABLE_SPIN] > 0) return;
    memset(w->fixed->is_left, 0, (size_t)m->nbody);
    pm_frame_look_state(&w->frame, &w->state);
    do {
        pm_fixed_bodies_begin(w);
        find(w);
    } while (w->fixed->n > 0 && let_asked_move(w));
    pm_active_set_clear(&w->active, w->model);
    if (w->fixed->n > 0) stop(w);
    pm_frame_look_state(&w->frame, &w->state);
}
