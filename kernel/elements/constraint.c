/* constraint.c - what all kinds of constraints share: their two marks, their Jacobian, bounds of their motion. */
#include "elements/constraint.h"

#include "numerics/minmax.h"

/* Greatest size of omega^2 and alpha together while omega grows by alpha. */
static double hardest_rotation(double omega, double alpha, double h)
{
    if (omega == 0 && alpha == 0) return 0;
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

double pm_constraint_square(const pm_frame *frame, const pm_constraint *c)
{
    double sum = 0;
    for (int p = 0; p < pm_constraint_bodies(c); p++)
        for (int k = 0; k < 3 && c->body[p] != frame->model->nbody; k++)
            sum += c->j[3 * p + k] * c->j[3 * p + k] * frame->numbers->inverse_mass[3 * c->body[p] + k];
    return sum;
}

double pm_constraint_openings(const pm_constraint *c, int n, const int *which, double *off)
{
    double worst = 0;
    for (int i = 0; i < n; i++) {
        off[i] = -c[which ? which[i] : i].g;
        worst = pm_max(fabs(off[i]), worst);
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
        worst = pm_max(fabs(off[i]), worst);
    }
    return worst;
}
