/* slope.c - derivatives of numbers by positions and velocities, gathered by the chain rule.
 *
 * A point at r from the mass centre of its body: dp = dq + k x r dangle, and v = v_G + omega k x r, so that
 * dv = dv_G + k x r domega - omega r dangle. */
#include "elements/slope.h"

int pm_slope_create(pm_arena *arena, pm_slope *x, const pm_model *m)
{
    const size_t nq = (size_t)m->nq + 1, nbody = (size_t)m->nbody + 1;
    const pm_array array[] = {PM_ARRAY(x->q, nq), PM_ARRAY(x->v, nq), PM_ARRAY(x->body, nbody),
                              PM_ARRAY(x->listed, nbody)};
    x->n = 0;
    return pm_arena_take(arena, PM_ARRAYS(array));
}

void pm_slope_clear(pm_slope *x)
{
    for (int i = 0; i < x->n; i++) {
        const int body = x->body[i];
        for (int k = 3 * body; k < 3 * body + 3; k++) x->q[k] = x->v[k] = 0;
        x->listed[body] = 0;
    }
    x->n = 0;
}

/* Lists a body; 0: it is fixed. */
static int list(const pm_frame *frame, pm_slope *x, int body)
{
    if (frame->numbers->fixed[body]) return 0;
    if (!x->listed[body]) x->body[x->n++] = body;
    x->listed[body] = 1;
    return 1;
}

void pm_slope_add(pm_slope *to, const pm_slope *from, double weight)
{
    for (int i = 0; i < from->n; i++) {
        const int body = from->body[i];
        if (!to->listed[body]) to->body[to->n++] = body;
        to->listed[body] = 1;
        for (int k = 3 * body; k < 3 * body + 3; k++) {
            to->q[k] += weight * from->q[k];
            to->v[k] += weight * from->v[k];
        }
    }
}

void pm_slope_add_angle(const pm_frame *frame, pm_slope *to, int body, double weight)
{
    if (list(frame, to, body)) to->q[3 * body + 2] += weight;
}

void pm_slope_add_omega(const pm_frame *frame, pm_slope *to, int body, double weight)
{
    if (list(frame, to, body)) to->v[3 * body + 2] += weight;
}

void pm_slope_add_place(const pm_frame *frame, pm_slope *to, const pm_point *p, const double weight[2])
{
    if (!list(frame, to, p->body)) return;
    double *q = to->q + 3 * p->body;
    q[0] += weight[0];
    q[1] += weight[1];
    q[2] += weight[1] * p->r[0] - weight[0] * p->r[1];
}

void pm_slope_add_velocity(const pm_frame *frame, pm_slope *to, const pm_point *p, const double weight[2])
{
    if (!list(frame, to, p->body)) return;
    double *v = to->v + 3 * p->body;
    v[0] += weight[0];
    v[1] += weight[1];
    v[2] += weight[1] * p->r[0] - weight[0] * p->r[1];
    to->q[3 * p->body + 2] -= frame->velocity[3 * p->body + 2] * (weight[0] * p->r[0] + weight[1] * p->r[1]);
}

void pm_slope_add_bodies(const pm_frame *frame, pm_slope *to, int n, const int *body, const double *j,
                         double weight, int velocities)
{
    for (int p = 0; p < n; p++) {
        if (!list(frame, to, body[p])) continue;
        double *x = (velocities ? to->v : to->q) + 3 * body[p];
        for (int k = 0; k < 3; k++) x[k] += weight * j[3 * p + k];
    }
}

void pm_slope_spread(const pm_slope *x, double weight, int stride, double *by_place, double *by_velocity)
{
    for (int i = 0; i < x->n; i++)
        for (int k = 3 * x->body[i]; k < 3 * x->body[i] + 3; k++) {
            by_place[stride * k] += weight * x->q[k];
            by_velocity[stride * k] += weight * x->v[k];
        }
}
