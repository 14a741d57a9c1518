/* contact_problem_sweeps.c - block Gauss-Seidel: one contact after the other is solved exactly for its own two loads while the
 * others keep theirs, until the modes of all hold as equations.
 *
 * It converges slowly, and goes on where Lemke's method ends on a ray, for any number of contacts.
 * [M. Jean, Comput. Methods Appl. Mech. Eng. 177 (1999) 235] */
#include <math.h>
#include <string.h>

#include "impact/contact_problem_parts.h"
#include "numerics/tolerances_impact.h"
#include "planemotion.h"
#include "state/state.h"

/* One contact: rates q without its own loads, and its own response. */
typedef struct own {
    double q[2], nn, nt, tt, mu;
} own;

static own look_at(const pm_contact_problem *x, int i)
{
    const int n = 2 * x->n, a = 2 * i, b = a + 1;
    const double *w = x->scaled;
    own o = {{x->b[a], x->b[b]},
             w[a * n + a],
             w[a * n + b],
             w[b * n + b],
             pm_contact_problem_friction(x, i, x->contact[i].rub)};
    for (int k = 0; k < n; k++) {
        if (k == a || k == b) continue;
        o.q[0] += w[a * n + k] * x->p[k];
        o.q[1] += w[b * n + k] * x->p[k];
    }
    return o;
}

/* N of a contact that slides with T = ratio N; what is not a number does not push. */
static double load_sliding(const own *o, double ratio)
{
    const double response = o->nn + ratio * o->nt;
    return response > 0 ? fmax(0, -o->q[0] / response) : 0;
}

static int slides(const own *o, double ratio, double p[2])
{
    p[0] = load_sliding(o, ratio);
    p[1] = ratio * p[0];
    return (o->q[1] + o->nt * p[0] + o->tt * p[1]) * ratio <= 0;
}

static int sticks(const own *o, int bounded, double p[2])
{
    const double d = o->nn * o->tt - o->nt * o->nt;
    if (!(d > PM_PROBLEM_DEPENDS)) return 0;
    p[0] = (-o->q[0] * o->tt + o->q[1] * o->nt) / d;
    p[1] = (-o->q[1] * o->nn + o->q[0] * o->nt) / d;
    return p[0] >= 0 && (!bounded || fabs(p[1]) <= o->mu * p[0]);
}

/* The mode in which it has the loads p. */
static int solve_one(const pm_contact_problem *x, int i, double p[2])
{
    const pm_contact_problem_contact *c = &x->contact[i];
    const own o = look_at(x, i);
    const int rough = c->friction == PM_FRICTION_ROUGH;
    p[0] = p[1] = 0;
    if (o.q[0] >= 0) return PM_OPEN;
    if (pm_contact_problem_is_smooth(c) || x->scale[2 * i + 1] == 0) {
        p[0] = load_sliding(&o, 0);
        return pm_contact_problem_is_smooth(c) ? PM_SMOOTH : PM_STICK;
    }
    if (!c->slips && sticks(&o, !rough, p)) return PM_STICK;
    if (rough) return p[0] = p[1] = 0, PM_OPEN;
    if (c->slips >= 0 && (slides(&o, -o.mu, p) || c->slips)) return PM_SLIDE_FORWARD;
    slides(&o, o.mu, p);
    return PM_SLIDE_BACKWARD;
}

/* All contacts once; the greatest change of a load. */
static double sweep(pm_contact_problem *x)
{
    double change = 0;
    for (int i = 0; i < x->n; i++) {
        double p[2];
        x->trial[i] = solve_one(x, i, p);
        for (int k = 0; k < 2; k++) {
            change = fmax(change, fabs(p[k] - x->p[2 * i + k]));
            x->p[2 * i + k] = p[k];
        }
    }
    return change;
}

/* The modes as equations; their loads spoil those of the sweeps, which are kept aside in x->best. */
static int holds(pm_contact_problem *x)
{
    const size_t bytes = 2 * (size_t)x->n * sizeof *x->p;
    memcpy(x->best, x->p, bytes);
    if (pm_contact_problem_trial_holds(x)) return 1;
    memcpy(x->p, x->best, bytes);
    x->distance = 1;
    return pm_contact_problem_loads_hold(x); /* loads that are not unique solve no equations */
}

int pm_contact_problem_sweeps(pm_contact_problem *x)
{
    memset(x->p, 0, 2 * (size_t)x->n * sizeof *x->p);
    for (int i = 1; i <= x->sweeps; i++) {
        const double change = sweep(x);
        const int due = i % PM_PROBLEM_SWEEPS_LOOK == 0 || change == 0;
        if (due && holds(x)) return 1;
        if (change == 0) return 0;
    }
    return 0;
}
