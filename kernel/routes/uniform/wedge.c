/* wedge.c - what flies straight on between smooth blows without a loss at contacts A and B whose Jacobians stay the same moves in a
 * wedge.
 *
 * A blow mirrors the velocities, v' = v - 2 <n,v> n, with n = d/|d|, d = M^-1 J^T and the product <a,b> = a^T M b; both gaps depend
 * on the components along n_A and n_B alone; and the sides of the wedge meet at phi, cos phi = -<n_A,n_B>.  Mirrored at each blow
 * the way is one straight line.  Right after a blow at A, x from the apex along its side, with the velocity (a, b) along and off
 * it, the way has turned by n phi when n blows more are met: an even n at A, an odd one at B.  That blow is
 *
 *   x b/b_n from the apex,  after x S/b_n,  velocity (a_n, -b_n),   a_n = a C + b S,  b_n = b C - a S,  C, S = cos, sin of n phi
 *
 * along and off its side.  The next blow at B tells x.  All else goes straight on.
 *
 * Where the sides are nearly parallel x is far and phi small.  Nothing of both is left to cancel with h = x sin phi, how far it
 * is to side B, R_n = sin(n phi)/sin phi (n between parallel sides), and
 *   cos(m phi) - cos(n phi) = 2 sin((n + m) phi/2) sin((n - m) phi/2).
 *
 * The impulses of blows at A are 2 b_n/|d_A|.  By their sizes the mean place and time of N of them follow from
 * sum b_n x_n = N x b, sum b_n t_n = h sum R_n and sum R_n = R_N R_(N + 1), n = 2, 4 .. 2 N; at B, n = 1, 3 .., it is R_N R_N. */
#include "routes/uniform/wedge.h"

#include <math.h>
#include <string.h>

#include "impact/contact_modes.h"
#include "numerics/tolerances.h"
#include "routes/uniform/uniform.h"
#include "state/frame.h"

/* ---- its sides ---- */
void pm_wedge_respond(const pm_numbers *numbers, const pm_constraint *c, double factor, double *out)
{
    for (int p = 0; p < pm_constraint_bodies(c); p++)
        for (int k = 0; k < 3 && !numbers->fixed[c->body[p]]; k++)
            out[3 * c->body[p] + k] += factor * numbers->inverse_mass[3 * c->body[p] + k] * c->j[3 * p + k];
}

/* A slim wedge would make much of rounding, and curved sides more at every blow. */
pm_constraint pm_wedge_side(const pm_workspace *w, int contact)
{
    pm_constraint c = pm_contact_modes_normal(&w->frame, &w->state, w->model->contact_slot[contact]);
    for (int i = 0; i < 3 * pm_constraint_bodies(&c); i++)
        if (fabs(c.j[i]) <= PM_STEADY_ROUNDING) c.j[i] = 0;
    return c;
}

static double times(const pm_workspace *w, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < w->model->nq; i++)
        if (w->numbers.inverse_mass[i] > 0) sum += a[i] * b[i] / w->numbers.inverse_mass[i];
    return sum;
}

/* Takes from x[nq] what it has along the unit vector; returns how much that was. */
static double straighten(const pm_workspace *w, double *x, const double *unit)
{
    const double part = times(w, x, unit);
    for (int i = 0; i < w->model->nq; i++) x[i] -= part * unit[i];
    return part;
}

int pm_wedge_find(pm_workspace *w, pm_wedge *x)
{
    const size_t size = (size_t)w->model->nq * sizeof *x->off;
    double *side[] = {x->off, x->along};
    for (int k = 0; k < 2; k++) {
        memset(side[k], 0, size);
        pm_wedge_respond(&w->numbers, &x->normal[k], 1, side[k]);
        x->size[k] = sqrt(times(w, side[k], side[k]));
        if (!(x->size[k] > 0)) return 0;
        for (int i = 0; i < w->model->nq; i++) side[k][i] /= x->size[k];
    }
    const double toward = times(w, x->along, w->uniform->v);
    x->b = times(w, x->off, w->uniform->v);
    x->cosine = -straighten(w, x->along, x->off);
    (void)straighten(w, x->along, x->off); /* of what rounding has left */
    x->sine = sqrt(times(w, x->along, x->along));
    if (x->sine <= PM_TURNS_PARALLEL) x->sine = 0;
    x->angle = atan2(x->sine, x->cosine);
    for (int i = 0; i < w->model->nq; i++) x->along[i] = x->sine > 0 ? x->along[i] / x->sine : 0;
    x->a = times(w, x->along, w->uniform->v);
    x->far = -x->flight * toward;
    return x->b > 0 && x->far > 0 && (x->sine > 0 || x->cosine > 0);
}

/* ---- where the blows are met ---- */
/* sin(n phi)/sin phi */
static double ratio(const pm_wedge *x, double n) { return x->angle > 0 ? sin(n * x->angle) / x->sine : n; }

/* (cos(m phi) - cos(n phi))/sin phi */
static double difference(const pm_wedge *x, double m, double n)
{
    return 2 * sin(0.5 * (n - m) * x->angle) * ratio(x, 0.5 * (n + m));
}

/* (n - R_n)/sin phi, which is small where n phi is. */
static double short_of(const pm_wedge *x, double n)
{
    const double square = x->angle * x->angle;
    if (x->angle == 0) return 0;
    if (n * x->angle > PM_TURNS_SERIES) return (n - ratio(x, n)) / x->sine;
    return n * square * ((n * n - 1) / 6 - square * (3 * n * n * n * n - 10 * n * n + 7) / 360) / x->sine;
}

pm_met pm_wedge_met(const pm_wedge *x, int side, double n)
{
    const double c = cos(n * x->angle), s = sin(n * x->angle);
    const double a = x->a * c + x->b * s, b = x->b * c - x->a * s;
    return (pm_met){.time = x->far * ratio(x, n) / b,
                    .along = x->far * (x->b * difference(x, side, n) + x->a * ratio(x, n)) / b,
                    .off = side ? x->far * x->b / b : 0,
                    .a = a,
                    .b = b};
}

pm_met pm_wedge_mean(const pm_wedge *x, int side, double n, double *sum)
{
    const double last = n + 1 - side, many = ratio(x, n), turned = ratio(x, last),
                 b = x->b * cos(last * x->angle) - x->a * sin(last * x->angle);
    const double away = x->b * difference(x, side, last) + x->a * turned;
    *sum = many * b;
    return (pm_met){.time = x->far * turned / b,
                    .along = x->far * (x->b * (side ? x->cosine : 1) * short_of(x, n) / many + away) / b,
                    .off = side ? n * x->far * x->b / *sum : 0};
}

/* The way turns by less than its direction. */
double pm_wedge_pairs_left(const pm_wedge *x)
{
    return x->angle > 0 ? 0.5 * atan2(x->b, x->a) / x->angle : INFINITY;
}

void pm_wedge_place(const pm_workspace *w, const pm_wedge *x, const pm_met *at, double *q)
{
    for (int i = 0; i < w->model->nq; i++) {
        const double rest = w->uniform->v[i] - x->a * x->along[i] - x->b * x->off[i];
        q[i] = w->uniform->q0[i] + at->time * rest + at->along * x->along[i] + at->off * x->off[i];
    }
}

void pm_wedge_velocity(const pm_workspace *w, const pm_wedge *x, double a, double b, double *v)
{
    for (int i = 0; i < w->model->nq; i++)
        v[i] = w->uniform->v[i] + (a - x->a) * x->along[i] + (b - x->b) * x->off[i];
}

void pm_wedge_look(pm_workspace *w, const pm_wedge *x, const pm_met *at)
{
    pm_uniform *u = w->uniform;
    u->looked = NAN;
    pm_wedge_place(w, x, at, u->q_look);
    pm_frame_look(&w->frame, u->t0 + at->time, u->q_look, u->v_look, w->state.z, w->state.memory);
}
