/* saddle.c - [M H^T; G 0] [a; -l] = [f; c] by the Schur complement S = G M^-1 H^T: S l = c - G M^-1 f,
 * a = M^-1 (f + H^T l).  Cholesky where H = G, LU where a contact slides.
 *
 * Where M has zeros (a body without mass) it is M + D that is factored, D > 0 there, and
 *   (M + D) a_k+1 = f + D a_k + H^T l
 * is repeated: the error shrinks by D over the inertia that the constraints lend to the body.  If they lend none it stays.
 *
 * Where S has lost figures to a body that is light beside the others, the light coordinates stay unknowns (saddle_light.c). */
#include "equations/saddle.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/force.h"
#include "elements/joint_friction.h"
#include "equations/saddle_light.h"
#include "equations/solve_cache.h"
#include "equations/stand_ins.h"
#include "numerics/dense.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

void pm_saddle_evaluate(pm_active_set *active, const pm_frame *frame)
{
    const int n = active->n;
    for (int i = 0; i < n; i++) {
        pm_constraint *c = &active->constraint[i];
        pm_constraint_kind(c->kind)->evaluate(frame, c);
    }
    if (!active->asymmetric) return;
    for (int i = 0; i < n; i++)
        memcpy(active->constraint[i].h, active->constraint[i].j, sizeof active->constraint[i].h);
    for (int i = n; active->constraint[i].normal != PM_NONE;
         i++) { /* carried tangents; an entry without normal ends them */
        pm_constraint *tangent = &active->constraint[i], *normal = &active->constraint[tangent->normal];
        pm_constraint_kind(tangent->kind)->evaluate(frame, tangent);
        for (int k = 0; k < 3 * pm_constraint_bodies(normal); k++)
            normal->h[k] = normal->j[k] + normal->slide * tangent->j[k];
    }
}

/* Product of two constraints over the bodies that they share, in the metric of M^-1. */
static double coupled(const pm_saddle *s, const pm_constraint *a, const double *ja, const pm_constraint *b,
                      const double *jb)
{
    const int ground = s->model->nbody;
    double sum = 0;
    for (int p = 0; p < pm_constraint_bodies(a); p++) {
        const int body = a->body[p];
        if (body == ground) continue;
        const double *im = s->numbers->inverse_mass + 3 * body, *x = ja + 3 * p;
        for (int r = 0; r < pm_constraint_bodies(b); r++) {
            if (b->body[r] != body) continue;
            const double *y = jb + 3 * r;
            sum += x[0] * im[0] * y[0] + x[1] * im[1] * y[1] + x[2] * im[2] * y[2];
        }
    }
    return sum;
}

/* The first constraint that shares a body with each: before it the row of S is empty.  In w->pivot, which Cholesky leaves. */
static void find_envelope(pm_saddle *s)
{
    int *first = s->pivot, *first_of_body = s->first_constraint;
    for (int i = 0; i < s->model->nbody; i++) first_of_body[i] = PM_NONE;
    for (int i = 0; i < s->active->n; i++) {
        first[i] = i;
        for (int p = 0; p < pm_constraint_bodies(&s->active->constraint[i]); p++) {
            const int body = s->active->constraint[i].body[p];
            if (body == s->model->nbody) continue;
            if (first_of_body[body] == PM_NONE) first_of_body[body] = i;
            if (first_of_body[body] < first[i]) first[i] = first_of_body[body];
        }
    }
}

/* x . y, three of each */
static double product(const double *x, const double *y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

/* S = G M^-1 G^T within its envelope. */
static void fill_symmetric(pm_saddle *s)
{
    const int n = s->active->n, ground = s->model->nbody;
    find_envelope(s);
    for (int i = 0; i < n; i++) {
        const pm_constraint *c = &s->active->constraint[i];
        const int a = c->body[0], b = c->body[1];
        double ja[3] = {0}, jb[3] = {0}, *to = s->schur + i * n; /* in the metric; nothing on the ground */
        for (int k = 0; k < 3 && a != ground; k++) ja[k] = c->j[k] * s->numbers->inverse_mass[3 * a + k];
        for (int k = 0; k < 3 && b != ground; k++) jb[k] = c->j[3 + k] * s->numbers->inverse_mass[3 * b + k];
        for (int k = s->pivot[i]; k <= i; k++) {
            const pm_constraint *other = &s->active->constraint[k];
            double sum = 0;
            if (c->over || other->over) {
                to[k] = coupled(s, c, c->j, other, other->j);
                continue;
            }
            if (a == other->body[0]) sum += product(ja, other->j);
            if (a == other->body[1]) sum += product(ja, other->j + 3);
            if (b == other->body[0]) sum += product(jb, other->j);
            if (b == other->body[1]) sum += product(jb, other->j + 3);
            to[k] = sum;
        }
    }
}

void pm_saddle_forget(pm_saddle *s) { s->nfactored = 0; }

int pm_saddle_is_factored(const pm_saddle *s)
{
    if (s->nfactored == 0 || s->nfactored != s->active->n) return 0;
    for (int i = 0; i < s->nfactored; i++) {
        const pm_hold *x = &s->factored[i];
        const pm_constraint *c = &s->active->constraint[i];
        if (x->over != c->over) return 0;
        for (int p = 0; p < pm_constraint_bodies(c); p++)
            if (x->body[p] != c->body[p]) return 0;
        for (int k = 0; k < 3 * pm_constraint_bodies(c); k++)
            if (x->j[k] != c->j[k]) return 0;
    }
    return 1;
}

static void note_factored(pm_saddle *s)
{
    s->nfactored = s->active->n;
    for (int i = 0; i < s->nfactored; i++) {
        s->factored[i].over = s->active->constraint[i].over;
        memcpy(s->factored[i].body, s->active->constraint[i].body, sizeof s->factored[i].body);
        memcpy(s->factored[i].j, s->active->constraint[i].j, sizeof s->factored[i].j);
    }
}

/* 0, or one more than the constraint that depends on those before it.  At one place the same constraints are asked for
 * several times. */
static int factor_symmetric(pm_saddle *s)
{
    if (pm_saddle_is_factored(s)) return 0;
    fill_symmetric(s);
    const int bad = pm_dense_skyline_factor(s->active->n, s->pivot, s->schur);
    if (bad)
        s->nfactored = 0;
    else
        note_factored(s);
    return bad;
}

static int factor_asymmetric(pm_saddle *s)
{
    const int n = s->active->n;
    s->nfactored = 0;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++)
            s->schur[i * n + k] = coupled(s, &s->active->constraint[i], s->active->constraint[i].j,
                                          &s->active->constraint[k], s->active->constraint[k].h);
    return pm_dense_lu_factor(n, s->schur, s->pivot);
}

/* The least part of a row that those before it leave, squared, in the metric of M^-1; S is factored. */
static double least_pivot(const pm_saddle *s)
{
    const int n = s->active->n;
    double least = 1;
    for (int i = 0; i < n; i++) { /* the factor holds the reciprocal of what is left of the row */
        const double all = coupled(s, &s->active->constraint[i], s->active->constraint[i].j,
                                   &s->active->constraint[i], s->active->constraint[i].j),
                     *left = s->schur + i * n + i;
        least = pm_min(1 / (all * *left * *left), least);
    }
    return least;
}

double pm_saddle_independence_by_mass(pm_saddle *s)
{
    s->light.is_used = 0;
    return factor_symmetric(s) ? 0 : sqrt(least_pivot(s));
}

double pm_saddle_independence(pm_saddle *s)
{
    const double by_mass = pm_saddle_independence_by_mass(s);
    if (!s->numbers->light_any || by_mass > PM_CLEARLY_INDEPENDENT) return by_mass;
    return fmax(by_mass, pm_saddle_light_independence(s));
}

double pm_saddle_independence_there(pm_workspace *w, const pm_state *s)
{
    pm_frame_look_state(&w->frame, s);
    pm_saddle_evaluate(&w->active, &w->frame);
    return pm_saddle_independence(&w->saddle);
}

/* 0, or one more than the constraint that is not determined. */
static int factor(pm_saddle *s)
{
    const int asymmetric = s->active->asymmetric;
    const int bad = asymmetric ? factor_asymmetric(s) : factor_symmetric(s);
    s->light.is_used = s->numbers->light_any && (asymmetric || bad || least_pivot(s) < PM_LIGHT_LEAST_PIVOT);
    return s->light.is_used ? pm_saddle_light_factor(s) : bad;
}

int pm_saddle_factor(pm_workspace *w)
{
    const int bad = factor(&w->saddle);
    w->result.count[PM_COUNT_SOLVES]++;
    if (!bad) return PM_OK;
    const pm_constraint *c = &w->active.constraint[bad - 1];
    return c->joint != PM_NONE ? pm_fail(&w->result, PM_SINGULAR, PM_TABLE_JOINT, c->joint, 0, 0)
                               : pm_fail(&w->result, PM_SINGULAR, PM_TABLE_CONTACT, PM_NONE, 0, 0);
}

static int keeps_light(const pm_saddle *s) { return s->light.is_used && s->active->n > 0; }

/* S l = rhs, with what else acts on the light coordinates. */
static void solve(pm_saddle *s, const double *force)
{
    if (keeps_light(s)) {
        pm_saddle_light_solve(s, force);
    } else if (s->active->asymmetric) {
        pm_dense_lu_solve(s->active->n, s->schur, s->pivot, s->rhs);
    } else {
        pm_dense_skyline_lower(s->active->n, s->pivot, s->schur, s->rhs);
        pm_dense_skyline_upper(s->active->n, s->pivot, s->schur, s->rhs);
    }
}

void pm_saddle_solve(pm_saddle *s) { solve(s, NULL); }

void pm_saddle_spread(const pm_saddle *s, int use_h, double *x)
{
    const int ground = s->model->nbody;
    for (int i = 0; i < s->active->n; i++) {
        const pm_constraint *c = &s->active->constraint[i];
        const double *d = use_h ? pm_saddle_direction(s, c) : c->j, l = s->rhs[i];
        for (int p = 0; p < pm_constraint_bodies(c); p++) {
            const int body = c->body[p];
            if (body == ground) continue;
            for (int k = 0; k < 3; k++)
                x[3 * body + k] += s->numbers->inverse_mass[3 * body + k] * d[3 * p + k] * l;
        }
    }
}

/* What was solved for, in its places: x += M^-1 H^T l. */
static void spread_solved(const pm_saddle *s, int use_h, double *x)
{
    const int n = keeps_light(s) ? s->light.n : 0;
    for (int k = 0; k < n; k++) s->light.response[s->light.at[k]] += x[s->light.at[k]];
    pm_saddle_spread(s, use_h, x);
    for (int k = 0; k < n; k++) x[s->light.at[k]] = s->light.response[s->light.at[k]];
}

void pm_saddle_move(pm_saddle *s, double *x)
{
    solve(s, NULL);
    spread_solved(s, 0, x);
}

/* In a singular position a route that follows the motion by other means may know the accelerations. */
static int from_route(pm_workspace *w)
{
    if (!w->phase.route || !w->phase.route->accelerate || !w->phase.route->accelerate(w)) return 0;
    w->result.where = (pm_where){PM_NONE, PM_NONE, PM_NONE, NAN, NAN};
    return 1;
}

/* The same with stand-ins for what has no mass, whose inertia is taken off by the response before. */
static void respond_once(pm_workspace *w, const double *force, const double *before, double *x)
{
    pm_saddle_light *light = &w->saddle.light;
    for (int i = 0; i < w->model->nq; i++) {
        const double f = (force ? force[i] : 0) + w->numbers.stand_in[i] * before[i];
        x[i] = w->numbers.inverse_mass[i] * f;
        light->force[i] = f;
    }
    for (int k = 0; keeps_light(&w->saddle) && k < light->n; k++) x[light->at[k]] = 0;
    for (int i = 0; i < w->active.n; i++)
        w->saddle.rhs[i] = w->saddle.wanted[i] - pm_constraint_times(&w->frame, &w->active.constraint[i], x);
    solve(&w->saddle, light->force);
    spread_solved(&w->saddle, 1, x);
}

void pm_saddle_respond_roughly(pm_workspace *w, const double *force, double *x)
{
    memset(w->saddle.previous, 0, (size_t)w->model->nq * sizeof *x);
    respond_once(w, force, w->saddle.previous, x);
}

int pm_saddle_respond(pm_workspace *w, const double *force, double *x)
{
    int worst = 0;
    memset(w->saddle.previous, 0, (size_t)w->model->nq * sizeof *x);
    for (int i = 0; i < PM_STAND_IN_ROUNDS; i++) {
        respond_once(w, force, w->saddle.previous, x);
        if (!w->numbers.massless || pm_stand_ins_change(&w->saddle, force, x, &worst) <= PM_MET) return PM_OK;
        memcpy(w->saddle.previous, x, (size_t)w->model->nq * sizeof *x);
    }
    return pm_fail(&w->result, PM_SINGULAR, PM_TABLE_BODY, worst / 3, NAN, NAN);
}

void pm_saddle_correct(pm_workspace *w, double *x)
{
    pm_saddle *s = &w->saddle;
    for (int i = 0; i < w->active.n; i++) {
        const double left = s->wanted[i] - pm_constraint_times(&w->frame, &w->active.constraint[i], x);
        s->wanted[i] = s->rhs[i];
        s->rhs[i] = left;
    }
    solve(s, NULL);
    spread_solved(s, 1, x);
    for (int i = 0; i < w->active.n; i++) s->rhs[i] += s->wanted[i];
}

/* With the friction of joints as it was found last. */
static int accelerate(pm_workspace *w, int evaluated)
{
    pm_frame *f = &w->frame;
    pm_force_all(w);
    for (int i = 0; i < w->model->nq; i++) f->a[i] = w->numbers.inverse_mass[i] * f->f[i];
    if (w->active.n > 0 || w->numbers.massless) {
        if (!evaluated) pm_saddle_evaluate(&w->active, &w->frame);
        int status = pm_saddle_factor(w);
        if (status) return from_route(w) ? PM_OK : status;
        for (int i = 0; i < w->active.n; i++) w->saddle.wanted[i] = w->active.constraint[i].gamma;
        if ((status = pm_saddle_respond(w, f->f, f->a))) return status;
        /* where constraints depend on each other those that are left may nearly do so, too */
        if (w->active.nredundant > 0 && !w->saddle.light.is_used) pm_saddle_correct(w, f->a);
        memcpy(f->lambda, w->saddle.rhs, (size_t)w->active.n * sizeof(double));
    }
    f->level = PM_LEVEL_DYNAMIC;
    return PM_OK;
}

/* Takes up the friction that goes with the reactions just found; whether these are those of the round before. */
static int friction_is_found(pm_workspace *w, double *change)
{
    const double before = *change;
    if (!pm_joint_friction_by_load(&w->frame, &w->state)) return 1;
    *change = pm_joint_friction_update(w);
    return *change <= PM_FRICTION_SAME || (*change <= PM_FRICTION_ROUNDING && *change > PM_GAIN * before);
}

static int accelerate_from(pm_workspace *w, int evaluated)
{
    double change = INFINITY;
    if (pm_solve_cache_take(w)) return PM_OK;
    for (int i = 0; i < PM_FRICTION_ROUNDS; i++) {
        const int status = accelerate(w, evaluated && i == 0);
        if (status || friction_is_found(w, &change)) {
            if (!status) pm_solve_cache_keep(w);
            return status;
        }
    }
    return pm_fail(&w->result, PM_SINGULAR, PM_TABLE_FORCE, w->model->friction_force[0], NAN, NAN);
}

int pm_saddle_accelerate(pm_workspace *w) { return accelerate_from(w, 0); }

int pm_saddle_accelerate_projected(pm_workspace *w)
{
    return accelerate_from(w, w->active.n > 0 && w->active.evaluated);
}
