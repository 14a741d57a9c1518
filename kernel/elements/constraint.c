/* constraint.c - what all kinds of constraints share: their two marks, their Jacobian, bounds of their motion. */
#include "elements/constraint.h"

pm_marks pm_constraint_marks(const pm_frame *frame, const pm_constraint *c)
{
    pm_marks x = {.a = pm_frame_point(frame, c->body[0], c->a[0], c->a[1]),
                  .b = pm_frame_point(frame, c->body[1], c->b[0], c->b[1])};
    x.omega_a = frame->velocity[3 * c->body[0] + 2];
    x.omega_b = frame->velocity[3 * c->body[1] + 2];
    for (int k = 0; k < 2; k++) {
        x.d[k] = x.a.p[k] - x.b.p[k];
        x.u[k] = x.a.v[k] - x.b.v[k];
        x.quad[k] = -x.omega_a * x.omega_a * x.a.r[k] + x.omega_b * x.omega_b * x.b.r[k];
    }
    return x;
}

/* Greatest size of omega^2 and alpha together while omega grows by alpha. */
static double hardest_rotation(double omega, double alpha, double h)
{
    const double fastest = fabs(omega) + fabs(alpha) * h;
    return hypot(fastest * fastest, alpha);
}

pm_constraint_reach pm_constraint_reach_of(const pm_constraint *c, const pm_marks *x, const double *a,
                                           double h)
{
    const double *aa = a + 3 * c->body[0], *ab = a + 3 * c->body[1];
    pm_constraint_reach r = {.apart = {aa[0] - ab[0], aa[1] - ab[1]}};
    r.omega = fabs(x->omega_b) + fabs(ab[2]) * h;
    r.spin = hardest_rotation(x->omega_b, ab[2], h);
    r.swing = pm_length(x->a.r) * hardest_rotation(x->omega_a, aa[2], h) + pm_length(x->b.r) * r.spin;
    const double speed = pm_length(x->u);
    r.rate = speed + (pm_length(r.apart) + r.swing) * h;
    r.distance = pm_length(x->d) + r.rate * h;
    return r;
}

void pm_constraint_along(pm_constraint *c, const pm_marks *x, const double n[2], double factor)
{
    c->j[0] = factor * n[0];
    c->j[1] = factor * n[1];
    c->j[2] = factor * pm_cross(x->a.r, n);
    c->j[3] = -factor * n[0];
    c->j[4] = -factor * n[1];
    c->j[5] = -factor * pm_cross(x->b.r, n);
}

double pm_constraint_times(const pm_frame *frame, const pm_constraint *c, const double *x)
{
    const int ground = frame->model->nbody;
    double sum = 0;
    for (int p = 0; p < 2; p++) {
        if (c->body[p] == ground) continue;
        const double *y = x + 3 * c->body[p], *j = c->j + 3 * p;
        sum += j[0] * y[0] + j[1] * y[1] + j[2] * y[2];
    }
    return sum;
}

double pm_constraint_square(const pm_frame *frame, const pm_constraint *c)
{
    double sum = 0;
    for (int p = 0; p < 2; p++)
        for (int k = 0; k < 3 && c->body[p] != frame->model->nbody; k++)
            sum += c->j[3 * p + k] * c->j[3 * p + k] * frame->numbers->inverse_mass[3 * c->body[p] + k];
    return sum;
}

double pm_constraint_openings(const pm_constraint *c, int n, const int *which, double *off)
{
    double worst = 0;
    for (int i = 0; i < n; i++) {
        off[i] = -c[which ? which[i] : i].g;
        worst = fmax(worst, fabs(off[i]));
    }
    return worst;
}

double pm_constraint_slips(const pm_frame *frame, const pm_constraint *c, int n, const int *which,
                           const double *v, double *off)
{
    double worst = 0;
    for (int i = 0; i < n; i++) {
        const pm_constraint *x = &c[which ? which[i] : i];
        off[i] = x->rate - pm_constraint_times(frame, x, v);
        worst = fmax(worst, fabs(off[i]));
    }
    return worst;
}
