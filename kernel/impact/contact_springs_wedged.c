/* contact_springs_wedged.c - a blow that stiffnesses share and friction ends: bodies are wedged, and contacts keep what they hold.
 *
 *   z = (N, T) of the loaded contacts,   W z = 0,   |T| <= mu_s N:     they press against each other, and nothing lets them go
 *
 * What friction has not stopped goes to and fro about that place, with e < 1 less and less: the bodies come to rest there, and
 * for e = 1 it is the limit that is told.  Velocities of these contacts are then zero, and what they hold is lost to the motion.
 * Impulses that do it are those that need least of all, and so much of z as keeps them in their cones: more of it moves
 * nothing, so that no course can tell how much there is. */
#include <math.h>
#include <string.h>

#include "impact/contact_springs_parts.h"
#include "numerics/dense.h"
#include "numerics/tolerances_impact.h"

static double load_of(const pm_contact_springs *x, int i) { return pm_contact_springs_force(x, i, x->zero); }

static double friction_of(const pm_contact_springs *x, int i)
{
    double sum = 0;
    for (int k = 0; k < x->n; k++) sum += x->ratio[i * x->n + k] * load_of(x, k);
    return sum;
}

static double greatest_load(const pm_contact_springs *x)
{
    double most = 0;
    for (int i = 0; i < x->n; i++) most = fmax(most, load_of(x, i));
    return most;
}

/* ---- may it be? ---- */
/* Directions of the loaded contacts; 0 if one of them slips, or none is held by friction. */
static int list(pm_contact_springs *x)
{
    const double least = PM_SPRINGS_BALANCED * greatest_load(x);
    int m = 0, held = 0;
    for (int i = 0; i < x->n; i++) {
        const pm_contact_spring *c = &x->spring[i];
        if (!(load_of(x, i) > least)) continue;
        x->held[m++] = 2 * i;
        if (!(c->hold > 0)) continue;
        if (fabs(c->slip) > PM_SPRINGS_STILL) return 0;
        held |= c->sense == 0;
        x->held[m++] = 2 * i + 1;
    }
    return held ? m : 0;
}

static double rate_of(const pm_contact_springs *x, int r)
{
    double rate = 0;
    for (int k = 0; k < x->n; k++) rate += x->course[r * x->n + k] * load_of(x, k);
    return fabs(rate);
}

/* Nothing moves any more in the listed directions, nor is about to. */
static int is_still(const pm_contact_springs *x, int m)
{
    const double balanced = fmin(PM_SPRINGS_STILL, PM_SPRINGS_BALANCED * greatest_load(x));
    for (int r = 0; r < m; r++)
        if (fabs(x->spring[x->held[r] / 2].start) > PM_SPRINGS_STILL || rate_of(x, x->held[r]) > balanced)
            return 0;
    return 1;
}

/* By how much loads change while what still moves comes to rest: what it is about to give, dN/dx |u| / omega, and what is not
 * balanced. */
static double unrest(const pm_contact_springs *x, int m)
{
    double most = 0;
    for (int r = 0; r < m; r++) {
        const int i = x->held[r] / 2;
        const double own = x->response[2 * i * (2 * x->n + 1)],
                     slope = x->exponent * load_of(x, i) / x->now[i];
        most = fmax(most, sqrt(slope / own) * fabs(x->spring[i].start) + rate_of(x, x->held[r]) / own);
    }
    return most;
}

/* What still moves is too little to open a contact, or to let one slip. */
static int is_caught(const pm_contact_springs *x, int m)
{
    const double most = unrest(x, m) / PM_SPRINGS_CAUGHT;
    for (int r = 0; r < m; r++) {
        const int i = x->held[r] / 2;
        const double room =
            fmin(pm_contact_springs_room(x, i, 1, x->zero), pm_contact_springs_room(x, i, -1, x->zero));
        const int holds = pm_contact_springs_holds(x, i);
        if (load_of(x, i) < most || (x->spring[i].hold > 0 && !holds) ||
            (holds && isfinite(x->spring[i].hold) && room < most))
            return 0;
    }
    return 1;
}

/* ---- impulses ---- */
static int factor(pm_contact_springs *x, int m)
{
    for (int r = 0; r < m; r++) {
        for (int k = 0; k < m; k++) x->system[r * m + k] = x->response[x->held[r] * 2 * x->n + x->held[k]];
        x->system[r * (m + 1)] += PM_SPRINGS_SOFT;
    }
    return pm_dense_lu_factor(m, x->system, x->pivot) == 0;
}

/* Velocity of direction r by all impulses p. */
static double velocity_by(const pm_contact_springs *x, int r, const double *p)
{
    double u = x->begun[r];
    for (int k = 0; k < 2 * x->n; k++) u += x->response[r * 2 * x->n + k] * p[k];
    return u;
}

/* Changes p of the listed directions as little as it can so that their velocities, `from` times those before the blow with what
 * p gives, are zero: as if each had a little compliance, until that does not count. */
static void take_away(pm_contact_springs *x, int m, double from, double *p)
{
    double *right = x->table;
    for (int k = 0; k < PM_SPRINGS_REFINED; k++) {
        for (int r = 0; r < m; r++)
            right[r] = (1 - from) * x->begun[x->held[r]] - velocity_by(x, x->held[r], p);
        pm_dense_lu_solve(m, x->system, x->pivot, right);
        for (int r = 0; r < m; r++) p[x->held[r]] += right[r];
    }
}

/* p of the listed directions, beside those of the others, that leave them at rest. */
static void stop(pm_contact_springs *x, int m, double *p)
{
    for (int i = 0; i < 2 * x->n; i++) p[i] = x->spring[i / 2].impulse[i % 2];
    for (int r = 0; r < m; r++) p[x->held[r]] = 0;
    take_away(x, m, 1, p);
}

/* z: the present loads, without what they do to the listed directions. */
static void balance(pm_contact_springs *x, int m, double *z)
{
    memset(z, 0, 2 * (size_t)x->n * sizeof *z);
    for (int r = 0; r < m; r++) {
        const int i = x->held[r] / 2;
        z[x->held[r]] = x->held[r] % 2 ? friction_of(x, i) : load_of(x, i);
    }
    take_away(x, m, 0, z);
}

/* What is left in p until contact i no longer pushes (side 0), or slips to one side. */
static double left_in(const pm_contact_springs *x, int i, int side, const double *p)
{
    const double hold = x->spring[i].hold;
    if (side == 0 || !isfinite(hold)) return p[2 * i];
    return hold * p[2 * i] - side * p[2 * i + 1];
}

/* So much of z that p + share z is in the cones of all that are listed; NAN: z is not inside them, or no more than what is left
 * of loads that move the bodies. */
static double share_of(const pm_contact_springs *x, int m, const double *p, const double *z)
{
    double share = 0;
    for (int r = 0; r < m; r++)
        for (int side = -(x->held[r] % 2); side <= x->held[r] % 2; side++) {
            const int i = x->held[r] / 2;
            const double has = left_in(x, i, side, p), more = left_in(x, i, side, z);
            if (!(z[2 * i] > PM_SPRINGS_KEPT * load_of(x, i) && more > -PM_SPRINGS_BALANCED * load_of(x, i)))
                return NAN;
            if (has < 0 && more > PM_SPRINGS_BALANCED * load_of(x, i)) share = fmax(share, -has / more);
        }
    return share;
}

/* ---- what it leaves ---- */
/* 1 unless contacts that are not held would approach. */
static int others_part(const pm_contact_springs *x, int m, const double *p)
{
    for (int i = 0; i < x->n; i++) {
        int is_held = 0;
        for (int r = 0; r < m; r++) is_held |= x->held[r] == 2 * i;
        if (!is_held && velocity_by(x, 2 * i, p) < -PM_SPRINGS_STILL) return 0;
    }
    return 1;
}

static void leave(pm_contact_springs *x, int m, const double *p)
{
    for (int i = 0; i < x->n; i++) {
        pm_contact_spring *c = &x->spring[i];
        memcpy(c->impulse, p + 2 * i, sizeof c->impulse);
        c->start = velocity_by(x, 2 * i, p);
        c->slip = velocity_by(x, 2 * i + 1, p);
    }
    for (int r = 0; r < m; r++)
        *(x->held[r] % 2 ? &x->spring[x->held[r] / 2].slip : &x->spring[x->held[r] / 2].start) = 0;
}

int pm_contact_springs_end_wedged(pm_contact_springs *x)
{
    double *p = x->table + 2 * x->n, *z = x->table + 4 * x->n;
    const int m = list(x);
    if (m == 0 || !(x->swings >= PM_SPRINGS_SWINGS * x->n || is_still(x, m) || is_caught(x, m))) return 0;
    x->swings = 0;
    if (!factor(x, m)) return 0;
    stop(x, m, p);
    balance(x, m, z);
    const double share = share_of(x, m, p, z);
    if (!isfinite(share)) return 0;
    for (int k = 0; k < 2 * x->n; k++) p[k] += share * z[k];
    if (!others_part(x, m, p)) return 0;
    leave(x, m, p);
    return 1;
}
