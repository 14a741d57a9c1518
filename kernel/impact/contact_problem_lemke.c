/* contact_problem_lemke.c - one motion of many contacts by Lemke's method. */
#include <math.h>
#include <string.h>

#include "impact/contact_problem.h"
#include "impact/contact_problem_parts.h"
#include "numerics/lemke.h"
#include "numerics/tolerances_impact.h"
#include "planemotion.h"
#include "state/state.h"

/* Of a contact that may stick: N, R = mu N + T and l, the slip backward, against a_n, r (the slip forward) and mu N - T:
 *
 *   T = R - mu N,   r = a_t + l,   mu N - T = 2 mu N - R
 *
 * Others have N alone.  Rough tangents take part as the trial says: they hold, or are out. */
static int terms(const pm_contact_problem *x, int i)
{
    const pm_contact_problem_contact *c = &x->contact[i];
    return c->friction == PM_FRICTION_COULOMB && !pm_contact_problem_is_smooth(c) && !c->slips &&
                   x->scale[2 * i + 1] > 0
               ? 3
               : 1;
}

/* W and b with the rough tangents that hold taken out: T = -W_tt^-1 (W_t p + b_t). */
static void take_out_rough(const pm_contact_problem *x, double *w, double *b)
{
    const int n = 2 * x->n;
    memcpy(w, x->scaled, (size_t)n * n * sizeof *w);
    memcpy(b, x->b, (size_t)n * sizeof *b);
    for (int t = 1; t < n; t += 2) {
        const double own = w[t * n + t];
        if (x->contact[t / 2].friction != PM_FRICTION_ROUGH) continue;
        if (x->trial[t / 2] != PM_OPEN) x->trial[t / 2] = own > PM_PROBLEM_DEPENDS ? PM_STICK : PM_SMOOTH;
        for (int r = 0; r < n && x->trial[t / 2] == PM_STICK; r++) {
            const double factor = w[r * n + t] / own;
            for (int k = 0; k < n && r != t; k++) w[r * n + k] -= factor * w[t * n + k];
            if (r != t) b[r] -= factor * b[t];
        }
        for (int k = 0; k < n; k++) w[t * n + k] = w[k * n + t] = 0;
    }
}

/* Rates and friction that contact i adds to the constraints of the complementarity problem; `at` is its first unknown. */
static void pose_contact(const pm_contact_problem *x, const double *w, const double *b, int m,
                         const int *first, int i)
{
    const int n = 2 * x->n, at = first[i];
    double *matrix = x->system, *q = x->right;
    for (int r = 0; r < terms(x, i); r++) {
        const double *row = w + (2 * i + (r > 0)) * n;
        if (r == 2) break;
        q[at + r] = b[2 * i + (r > 0)];
        for (int k = 0; k < x->n; k++) {
            const double mu = terms(x, k) == 3 ? pm_contact_problem_friction(x, k, x->contact[k].rub)
                              : x->contact[k].slips
                                  ? x->contact[k].slips * pm_contact_problem_friction(x, k, x->contact[k].rub)
                                  : 0;
            matrix[(at + r) * m + first[k]] = row[2 * k] - mu * row[2 * k + 1];
            if (terms(x, k) == 3) matrix[(at + r) * m + first[k] + 1] = row[2 * k + 1];
        }
    }
    if (terms(x, i) < 3) return;
    matrix[(at + 1) * m + at + 2] = 1;
    matrix[(at + 2) * m + at] = 2 * pm_contact_problem_friction(x, i, x->contact[i].rub);
    matrix[(at + 2) * m + at + 1] = -1;
    q[at + 2] = 0;
}

/* The mode that the loads N and T of contact i tell. */
static int mode_of_loads(const pm_contact_problem *x, int i, double load, double friction, double tie)
{
    const pm_contact_problem_contact *c = &x->contact[i];
    const double room = pm_contact_problem_friction(x, i, c->rub) * load - fabs(friction);
    if (load <= tie) return PM_OPEN;
    if (pm_contact_problem_is_smooth(c)) return PM_SMOOTH;
    if (c->slips) return c->slips > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
    if (c->friction == PM_FRICTION_ROUGH) return x->trial[i];
    if (room > tie || x->scale[2 * i + 1] == 0) return PM_STICK;
    return friction < 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
}

static double largest_of(int n, const double *x)
{
    double largest = 1;
    for (int i = 0; i < n; i++) largest = fmax(largest, fabs(x[i]));
    return largest;
}

/* One solution by Lemke's method, in the trial; 0 if it finds none. */
static int lemke(pm_contact_problem *x, int try)
{
    int m = 0, *first = x->pivot;
    double *w = x->lemke, *b = w + 4 * (size_t)x->n * x->n;
    for (int i = 0; i < x->n; i++) {
        first[i] = m;
        m += terms(x, i);
    }
    memset(x->system, 0, (size_t)m * m * sizeof *x->system);
    take_out_rough(x, w, b);
    for (int i = 0; i < x->n; i++) pose_contact(x, w, b, m, first, i);
    double *z = x->right + m;
    if (!pm_lemke_solve(m, x->system, x->right, try, x->lemke, x->basis, z)) return 0;
    const double tie = PM_PROBLEM_LEMKE_TIE * largest_of(m, z);
    for (int i = 0; i < x->n; i++) {
        const double load = z[first[i]],
                     friction =
                         terms(x, i) == 3
                             ? z[first[i] + 1] - pm_contact_problem_friction(x, i, x->contact[i].rub) * load
                             : 0;
        x->trial[i] = mode_of_loads(x, i, load, friction, tie);
    }
    return 1;
}

/* Rough contacts that would pull are let go, one round after the other. */
static int lemke_rounds(pm_contact_problem *x, int try)
{
    for (int i = 0; i < x->n; i++) x->trial[i] = PM_STICK;
    for (int round = 0; round <= x->n; round++) {
        if (!lemke(x, try)) return 0;
        if (pm_contact_problem_trial_holds(x)) return 1;
    }
    return 0;
}

int pm_contact_problem_lemke(pm_contact_problem *x)
{
    for (int try = 0; try < x->tries; try++)
        if (lemke_rounds(x, try)) return 1;
    return 0;
}
