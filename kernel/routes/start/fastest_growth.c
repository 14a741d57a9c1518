/* fastest_growth.c - the deviation from a steady motion that grows fastest.
 *
 * Seen in axes that rotate at the rate W of the steady motion, small deviations x = (dq, dv) that go with the constraints
 * obey
 *
 *   dq' = dv - W x dq,   dv' = (da/dq) dq + (da/dv) dv - W x dv,   x' = L x
 *
 * with a constant L: W = 0 out of rest.  L is read off the equations of motion by differences of fourth order, on states
 * that are projected on the constraints.  exp(L h), by the polynomial of the classical Runge-Kutta formula, is squared
 * until one direction is left of it:  exp(L T) / |exp(L T)| -> u w^T,  L u = r u,  r the greatest real part of an
 * eigenvalue.  What a blow dv excites is then u (w^T dv): a swinging or decaying part of it has no share in the end,
 * however small the blow is.  Along u the energy and every momentum of the steady motion are kept, to first and to second
 * order.
 *
 * The part of the blow would also follow from a full set of eigenvectors; but where a coordinate is cyclic L has none: its
 * eigenvalue 0 is double and has one eigenvector.  Squaring needs no eigenvectors, and takes equal rates together. */
#include "routes/start/fastest_growth.h"

#include <math.h>
#include <string.h>

#include "equations/projection.h"
#include "equations/saddle.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/workspace.h"

int pm_fastest_growth_create(pm_arena *arena, const pm_model *m, pm_fastest_growth *e)
{
    const size_t nq = (size_t)m->nq, square = 4 * nq * nq;
    const pm_array array[] = {
        PM_ARRAY(e->push, nq),      PM_ARRAY(e->q, nq),         PM_ARRAY(e->v, nq),
        PM_ARRAY(e->dq, nq),        PM_ARRAY(e->dv, nq),        PM_ARRAY(e->da, nq),
        PM_ARRAY(e->x, 2 * nq),     PM_ARRAY(e->y, 2 * nq),     PM_ARRAY(e->matrix, square),
        PM_ARRAY(e->power, square), PM_ARRAY(e->spare, square), PM_ARRAY(e->at, nq),
        PM_ARRAY(e->free, nq),
    };
    return pm_arena_take(arena, PM_ARRAYS(array));
}

static void clear(double *x, int n) { memset(x, 0, (size_t)n * sizeof *x); }

/* Axes that are not rotated. */
static const double ahead[2] = {1, 0};

static double unit_of_time(const pm_numbers *numbers) { return numbers->size / numbers->speed; }

/* Part i of spin x d: d rotated left; angles do not rotate. */
static double rotated(double spin, const double *d, int i)
{
    return i % 3 == 2 ? 0 : i % 3 == 0 ? -spin * d[i + 1] : spin * d[i - 1];
}

/* ---- the steady motion ---- */
/* The free coordinates of w->state as they will be a time t later if the motion is steady, in s. */
static void move_on(const pm_model *model, const pm_state *state, const pm_fastest_growth *e, double t,
                    pm_state *s)
{
    const double c = cos(e->spin * t), si = sin(e->spin * t);
    const double along = e->spin != 0 ? si / e->spin : t, across = e->spin != 0 ? (1 - c) / e->spin : 0;
    pm_state_copy(s, state);
    s->t = state->t + t;
    for (int i = 0; i < model->nq; i++) {
        if (!e->free[i]) continue;
        const double *v = state->v;
        s->q[i] += i % 3 == 2 ? v[i] * t : along * v[i] + across * rotated(1, v, i);
        if (i % 3 != 2) s->v[i] = c * v[i] + si * rotated(1, v, i);
    }
}

static int accelerate(pm_workspace *w, pm_state *s)
{
    const int status = pm_projection_apply(w, s);
    return status ? status : pm_saddle_accelerate(w);
}

/* The accelerations at s are those of a rotation as a whole. */
static int rotates_as_a_whole(pm_workspace *w, const pm_fastest_growth *e, pm_state *s, int *status)
{
    double scale = w->numbers.speed * w->numbers.speed / w->numbers.size, worst = 0;
    if ((*status = accelerate(w, s))) return 0;
    for (int i = 0; i < w->model->nq; i++) {
        if (!e->free[i]) continue;
        const double length = i % 3 == 2 ? w->numbers.size : 1;
        const double applied = w->numbers.stand_in[i] > 0 ? 0 : w->numbers.inverse_mass[i] * w->frame.f[i];
        worst = fmax(worst, fabs(w->frame.a[i] - rotated(e->spin, s->v, i)) * length);
        scale = fmax(scale, fabs(applied) * length);
    }
    return worst <= PM_GROWTH_STEADY * scale;
}

/* ---- how deviations change ---- */
static void list_free(const pm_model *model, const pm_numbers *numbers, pm_fastest_growth *e)
{
    e->n = 0;
    for (int i = 0; i < model->nq; i++)
        if (e->free[i] && numbers->inverse_mass[i] > 0) e->at[e->n++] = i;
}

/* d[nq] of bodies, in the axes rotated by the angle whose cosine and sine are rotation[2], from e->at's coordinates in
 * units. */
static void spread(const pm_model *model, const pm_numbers *numbers, const pm_fastest_growth *e,
                   const double *x, const double rotation[2], double *d)
{
    clear(d, model->nq);
    for (int i = 0; i < e->n; i++) {
        const int c = e->at[i];
        const double value = x[i] * pm_numbers_length(numbers, c);
        if (c % 3 == 2) {
            d[c] += value;
        } else {
            d[c] += rotation[0] * value;
            d[c % 3 == 0 ? c + 1 : c - 1] += (c % 3 == 0 ? rotation[1] : -rotation[1]) * value;
        }
    }
}

/* Back. */
static void gather(const pm_numbers *numbers, const pm_fastest_growth *e, const double *d,
                   const double rotation[2], double *x)
{
    for (int i = 0; i < e->n; i++) {
        const int c = e->at[i];
        const double value = c % 3 == 2 ? d[c] : rotation[0] * d[c] - rotated(rotation[1], d, c);
        x[i] = value / pm_numbers_length(numbers, c);
    }
}

/* y = L x at the state `base`, in units of the scene's size and time and in axes rotated by rotation[2]; x is projected
 * on the constraints first. */
static int change_of(pm_workspace *w, pm_fastest_growth *e, const pm_state *base, const double rotation[2],
                     const double *x, double *y)
{
    static const double weight[] = {8 / 12.0, -8 / 12.0, -1 / 12.0, 1 / 12.0}, place[] = {1, -1, 2, -2};
    const int nq = w->model->nq, n = e->n;
    const double time = unit_of_time(&w->numbers);
    spread(w->model, &w->numbers, e, x, rotation, e->q);
    spread(w->model, &w->numbers, e, x + n, rotation, e->v);
    clear(e->dq, nq);
    clear(e->dv, nq);
    clear(e->da, nq);
    for (int k = 0; k < 4; k++) {
        pm_state *s = &w->probe;
        pm_state_copy(s, base);
        for (int i = 0; i < nq; i++) {
            s->q[i] += PM_GROWTH_STEP * place[k] * e->q[i];
            s->v[i] += PM_GROWTH_STEP * place[k] * e->v[i] / time;
        }
        const int status = accelerate(w, s);
        if (status) return status;
        for (int i = 0; i < nq; i++) {
            e->dq[i] += weight[k] / PM_GROWTH_STEP * (s->q[i] - base->q[i]);
            e->dv[i] += weight[k] / PM_GROWTH_STEP * (s->v[i] - base->v[i]);
            e->da[i] += weight[k] / PM_GROWTH_STEP * w->frame.a[i];
        }
    }
    for (int i = 0; i < nq; i++) {
        e->q[i] = (e->dv[i] - rotated(e->spin, e->dq, i)) * time;
        e->v[i] = (e->da[i] - rotated(e->spin, e->dv, i)) * time * time;
    }
    gather(&w->numbers, e, e->q, rotation, y);
    gather(&w->numbers, e, e->v, rotation, y + n);
    return PM_OK;
}

/* ---- is it steady? ---- */
/* What some deviation changes by does not depend on when it happens. */
static int changes_alike(pm_workspace *w, pm_fastest_growth *e, const double rotation[2], int *status)
{
    const int n = 2 * e->n;
    double off = 0, most = 0;
    for (int i = 0; i < n; i++) e->x[i] = sin(1 + i); /* any deviation that is not special */
    if ((*status = change_of(w, e, &w->ahead, rotation, e->x, e->y))) return 0;
    memcpy(e->spare, e->y, (size_t)n * sizeof *e->y);
    if ((*status = change_of(w, e, &w->state, ahead, e->x, e->y))) return 0;
    for (int i = 0; i < n; i++) {
        off = fmax(off, fabs(e->spare[i] - e->y[i]));
        most = fmax(most, fabs(e->y[i]));
    }
    return off <= PM_GROWTH_ALIKE * most;
}

/* Now, and a radian or so before and after it. */
static int is_steady_at(pm_workspace *w, pm_fastest_growth *e, double spin, int *status)
{
    static const double when[] = {0, 1.1, -0.7};
    const double unit = spin != 0 ? 1 / fabs(spin) : unit_of_time(&w->numbers);
    e->spin = spin;
    for (int i = 0; i < 3; i++) {
        const double t = when[i] * unit, rotation[] = {cos(spin * t), sin(spin * t)};
        move_on(w->model, &w->state, e, t, &w->ahead);
        if (!rotates_as_a_whole(w, e, &w->ahead, status)) return 0;
        if (i > 0 && !changes_alike(w, e, rotation, status)) return 0;
    }
    return 1;
}

int pm_fastest_growth_is_steady(pm_workspace *w, pm_fastest_growth *e, int *status)
{
    double before = 0;
    *status = PM_OK;
    list_free(w->model, &w->numbers, e);
    if (is_steady_at(w, e, 0, status)) return 1;
    for (int i = 2; i < w->model->nq && !*status; i += 3) {
        const double spin = w->state.v[i];
        if (!e->free[i] || spin == 0 || spin == before) continue;
        if (is_steady_at(w, e, spin, status)) return 1;
        before = spin;
    }
    return 0;
}

/* ---- the matrix ---- */
static int read_matrix(pm_workspace *w, pm_fastest_growth *e)
{
    const int n = 2 * e->n;
    int status = PM_OK;
    for (int k = 0; !status && k < n; k++) {
        clear(e->x, n);
        e->x[k] = 1;
        status = change_of(w, e, &w->state, ahead, e->x, e->y);
        for (int i = 0; i < n; i++) e->matrix[i * n + k] = e->y[i];
    }
    return status;
}

/* ---- what is left of them ---- */
static void multiply(int n, const double *a, const double *b, double *c)
{
    clear(c, n * n);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++)
            for (int j = 0; j < n; j++) c[i * n + j] += a[i * n + k] * b[k * n + j];
}

/* The greatest sum of a row: no change is faster. */
static double norm(int n, const double *a)
{
    double most = 0;
    for (int i = 0; i < n; i++) {
        double sum = 0;
        for (int k = 0; k < n; k++) sum += fabs(a[i * n + k]);
        most = fmax(most, sum);
    }
    return most;
}

static double greatest(int n, const double *a)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(a[i]));
    return most;
}

/* e->power = 1 + A (1 + A/2 (1 + A/3 (1 + A/4))),  A = L h */
static void short_time(pm_fastest_growth *e, int n, double h)
{
    for (int i = 0; i < n * n; i++) e->power[i] = 0;
    for (int i = 0; i < n; i++) e->power[i * n + i] = 1;
    for (int k = 4; k > 0; k--) {
        multiply(n, e->matrix, e->power, e->spare);
        for (int i = 0; i < n * n; i++) e->power[i] = h / k * e->spare[i];
        for (int i = 0; i < n; i++) e->power[i * n + i] += 1;
    }
}

/* Squares it until one direction is left; where it does not come to that, nothing will be found to grow. */
static void long_time(pm_fastest_growth *e, int n)
{
    double change = 1;
    for (int k = 0; k < PM_GROWTH_SQUARINGS && change > PM_GROWTH_ALONE; k++) {
        multiply(n, e->power, e->power, e->spare);
        const double most = greatest(n * n, e->spare);
        change = 0;
        for (int i = 0; i < n * n; i++) {
            const double now = e->spare[i] / most;
            change = fmax(change, fabs(now - e->power[i]));
            e->power[i] = now;
        }
    }
}

/* e->x: what the blow becomes; 0 if nothing. */
static int excite(const pm_numbers *numbers, pm_fastest_growth *e, int n)
{
    double size = 0;
    for (int i = 0; i < e->n; i++) {
        e->y[i] = 0;
        e->y[e->n + i] = e->push[e->at[i]] / pm_numbers_length(numbers, e->at[i]);
    }
    const double blow = greatest(n, e->y);
    for (int i = 0; i < n; i++) {
        e->x[i] = 0;
        for (int k = 0; k < n; k++) e->x[i] += e->power[i * n + k] * e->y[k];
        size = fmax(size, fabs(e->x[i]));
    }
    for (int i = 0; i < n && size > 0; i++) e->x[i] /= size;
    return size > PM_GROWTH_EXCITED * blow;
}

/* The rate at which e->x grows, in e->y what is left of L x - r x; 0 if it is not one that does. */
static double rate_of(const pm_fastest_growth *e, int n, double fastest)
{
    double along = 0, square = 0, off = 0;
    for (int i = 0; i < n; i++) {
        double sum = 0;
        for (int k = 0; k < n; k++) sum += e->matrix[i * n + k] * e->x[k];
        e->y[i] = sum;
        along += sum * e->x[i];
        square += e->x[i] * e->x[i];
    }
    const double rate = along / square;
    for (int i = 0; i < n; i++) off = fmax(off, fabs(e->y[i] - rate * e->x[i]));
    return rate > PM_GROWTH_GROWS * fastest && off <= PM_GROWTH_FOLLOWS * fastest ? rate : 0;
}

int pm_fastest_growth_find(pm_workspace *w, pm_fastest_growth *e)
{
    const int n = 2 * e->n, status = read_matrix(w, e);
    const double fastest = norm(n, e->matrix), time = unit_of_time(&w->numbers);
    e->rate = 0;
    if (status || !(fastest > 0)) return status;
    short_time(e, n, PM_GROWTH_SHORT / fastest);
    long_time(e, n);
    if (!excite(&w->numbers, e, n)) return PM_OK;
    e->rate = rate_of(e, n, fastest) / time;
    clear(e->q, w->model->nq);
    clear(e->v, w->model->nq);
    for (int i = 0; i < e->n; i++) {
        const int c = e->at[i];
        e->q[c] = pm_numbers_length(&w->numbers, c) * e->x[i];
        e->v[c] = pm_numbers_length(&w->numbers, c) / time * e->x[e->n + i];
    }
    return PM_OK;
}
