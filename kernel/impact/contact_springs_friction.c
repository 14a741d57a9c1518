/* contact_springs_friction.c - which contacts of a blow that stiffnesses share are held by their friction, and how it goes with
 * their loads.
 *
 * Where some slip and the others are held, T = B N:   B_ii = -mu sense_i of one that slips;   W_tt B = -W_tn of those held.
 * Those whose slips depend on each other share by mu N: a little compliance of 1/(mu N) makes them.  Loads N are known, so that
 * it is a complementarity problem with a positive matrix: the first that does not obey its law is turned until all do.
 * [K. G. Murty, Linear Complementarity, Linear and Nonlinear Programming, 1988, ch. 4.3] */
#include <math.h>
#include <string.h>

#include "impact/contact_springs_parts.h"
#include "numerics/dense.h"
#include "numerics/tolerances_impact.h"

static int rubs(const pm_contact_springs *x, int i)
{
    return x->spring[i].phase != PM_CONTACT_SPRING_OPEN && x->spring[i].hold > 0;
}

int pm_contact_springs_holds(const pm_contact_springs *x, int i)
{
    return rubs(x, i) && x->spring[i].sense == 0;
}

static double times(const double *row, const double *load, int n)
{
    double sum = 0;
    for (int k = 0; k < n; k++) sum += row[k] * load[k];
    return sum;
}

double pm_contact_springs_room(const pm_contact_springs *x, int i, int side, const double *y)
{
    const double hold = x->spring[i].hold;
    double drag = 0;
    if (!pm_contact_springs_holds(x, i) || !isfinite(hold)) return 1;
    for (int k = 0; k < x->n; k++) drag += x->ratio[i * x->n + k] * pm_contact_springs_force(x, k, y);
    return hold * pm_contact_springs_force(x, i, y) - side * drag;
}

double pm_contact_springs_slope_of_room(const pm_contact_springs *x, int i, int side, const double *y)
{
    const double hold = x->spring[i].hold;
    double drag = 0;
    if (!pm_contact_springs_holds(x, i) || !isfinite(hold)) return 0;
    for (int k = 0; k < x->n; k++) drag += x->ratio[i * x->n + k] * pm_contact_springs_rate_of_force(x, k, y);
    return hold * pm_contact_springs_rate_of_force(x, i, y) - side * drag;
}

/* Loads a moment later: while all of them are none their ratios count. */
static void look_at_loads(pm_contact_springs *x)
{
    for (int i = 0; i < x->n; i++) {
        const pm_contact_spring *c = &x->spring[i];
        double further = -c->start * PM_SPRINGS_AHEAD;
        if (c->phase == PM_CONTACT_SPRING_RELEASES) further /= c->restitution * c->restitution;
        const double place = fmax(0, x->now[i] + further);
        const int none = c->phase == PM_CONTACT_SPRING_OPEN;
        x->load[i] = none ? 0 : pm_contact_springs_stiffness(x, i) * pow(place, x->exponent);
    }
}

/* Compliance of a held contact beside the others. */
static double compliance(const pm_contact_springs *x, int i, double most)
{
    const double bound = fmin(x->spring[i].hold, 1 / PM_SPRINGS_COMPLIANCE) * x->load[i];
    return PM_SPRINGS_COMPLIANCE * most / fmax(bound, PM_SPRINGS_LEAST * most);
}

/* B of those held, one column of N after the other. */
static void hold(pm_contact_springs *x, int m)
{
    const int n = x->n, two = 2 * n;
    double most = 0;
    for (int r = 0; r < m; r++)
        most = fmax(most, fmin(x->spring[x->held[r]].hold, 1 / PM_SPRINGS_COMPLIANCE) * x->load[x->held[r]]);
    for (int r = 0; r < m; r++) {
        const double *row = x->response + (2 * x->held[r] + 1) * two;
        for (int k = 0; k < m; k++) x->system[r * m + k] = row[2 * x->held[k] + 1];
        if (most > 0) x->system[r * (m + 1)] += compliance(x, x->held[r], most);
    }
    if (m == 0 || pm_dense_lu_factor(m, x->system, x->pivot)) return;
    for (int k = 0; k < n; k++) {
        double *right = x->table;
        for (int r = 0; r < m; r++) {
            const double *row = x->response + (2 * x->held[r] + 1) * two;
            right[r] = -row[2 * k];
            for (int j = 0; j < n; j++) right[r] -= row[2 * j + 1] * x->ratio[j * n + k];
        }
        pm_dense_lu_solve(m, x->system, x->pivot, right);
        for (int r = 0; r < m; r++) x->ratio[x->held[r] * n + k] = right[r];
    }
}

static void find_ratios(pm_contact_springs *x)
{
    const int n = x->n;
    int m = 0;
    memset(x->ratio, 0, (size_t)n * n * sizeof *x->ratio);
    for (int i = 0; i < n; i++) {
        if (pm_contact_springs_holds(x, i))
            x->held[m++] = i;
        else if (rubs(x, i))
            x->ratio[i * (n + 1)] = -x->spring[i].rub * x->spring[i].sense;
    }
    hold(x, m);
    for (int r = 0; r < 2 * n; r++)
        for (int k = 0; k < n; k++) {
            double sum = x->response[r * 2 * n + 2 * k];
            for (int j = 0; j < n; j++) sum += x->response[r * 2 * n + 2 * j + 1] * x->ratio[j * n + k];
            x->course[r * n + k] = r % 2 && pm_contact_springs_holds(x, r / 2) ? 0 : sum;
        }
}

/* Held by more than its friction: it slips; about to slip against its friction: it is held.  1 if it turns. */
static int turns(pm_contact_springs *x, int i, double size)
{
    pm_contact_spring *c = &x->spring[i];
    if (!rubs(x, i) || c->slip != 0) return 0;
    if (c->sense == 0) {
        const double drag = times(x->ratio + i * x->n, x->load, x->n);
        if (!(fabs(drag) > c->hold * x->load[i] + PM_COURSE_ROUNDING * size)) return 0;
        c->sense = drag > 0 ? -1 : 1;
        return 1;
    }
    const double rate = times(x->course + (2 * i + 1) * x->n, x->load, x->n);
    if (rate * c->sense >= -PM_COURSE_ROUNDING * size) return 0;
    c->sense = 0;
    return 1;
}

void pm_contact_springs_settle(pm_contact_springs *x)
{
    const int most = PM_SPRINGS_TURNS * x->n;
    double size = 0;
    look_at_loads(x);
    for (int i = 0; i < x->n; i++) {
        pm_contact_spring *c = &x->spring[i];
        size = fmax(size, x->load[i]);
        if (c->slip != 0) c->sense = c->slip > 0 ? 1 : -1;
    }
    for (int k = 0, turned = 1; turned && k < most; k++) {
        find_ratios(x);
        turned = 0;
        for (int i = 0; i < x->n && !turned; i++) turned = turns(x, i, size);
    }
}

/* ---- impulses that the motion does not tell apart ---- */
/* The friction that contact i can give at most; a rough one as much as one of great friction. */
static double bound_of(const pm_contact_springs *x, int i)
{
    return fmin(x->spring[i].hold, PM_SPRINGS_ROUGH) * x->spring[i].impulse[0];
}

static int list_pushed(pm_contact_springs *x)
{
    int m = 0;
    for (int i = 0; i < x->n; i++)
        if (bound_of(x, i) > 0) x->held[m++] = i;
    return m;
}

static double tangential(const pm_contact_springs *x, int r, int k)
{
    return x->response[(2 * x->held[r] + 1) * 2 * x->n + 2 * x->held[k] + 1];
}

/* right: what friction gives of slip beside what p gives of it; the greatest. */
static double missing(const pm_contact_springs *x, int m, const double *p, double *right)
{
    double most = 0;
    for (int r = 0; r < m; r++) {
        right[r] = 0;
        for (int k = 0; k < m; k++)
            right[r] += tangential(x, r, k) * (x->spring[x->held[k]].impulse[1] - p[k]);
        most = fmax(most, fabs(right[r]));
    }
    return most;
}

/* p: the least friction, in the measure of what each could give, that gives the same slips; 1 if all could give it. */
static int find_least(pm_contact_springs *x, int m, double *p, double *right)
{
    for (int r = 0; r < m; r++) {
        for (int k = 0; k < m; k++) x->system[r * m + k] = tangential(x, r, k);
        x->system[r * (m + 1)] += PM_SPRINGS_SOFT / fmax(bound_of(x, x->held[r]), PM_SPRINGS_SOFT);
        p[r] = 0;
    }
    if (pm_dense_lu_factor(m, x->system, x->pivot)) return 0;
    for (int k = 0; k < PM_SPRINGS_REFINED && missing(x, m, p, right) > 0; k++) {
        pm_dense_lu_solve(m, x->system, x->pivot, right);
        for (int r = 0; r < m; r++) p[r] += right[r];
    }
    int given = missing(x, m, p, right) <= x->no_velocity;
    for (int r = 0; r < m; r++)
        given &= fabs(p[r]) <= x->spring[x->held[r]].hold * x->spring[x->held[r]].impulse[0] + x->no_velocity;
    return given;
}

void pm_contact_springs_share_friction(pm_contact_springs *x)
{
    double *p = x->table, *right = x->table + x->n;
    const int m = list_pushed(x);
    if (m < 2 || !find_least(x, m, p, right)) return;
    for (int r = 0; r < m; r++) x->spring[x->held[r]].impulse[1] = p[r];
}
