/* contact_problem.c - the modes of several contacts: all of them tried, or Lemke's method, or sweeps.
 *
 * The problem is scaled first: W to a unit diagonal, friction by the same lengths, b to a largest entry of one.  Modes are
 * solved as equations, and hold if all inequalities hold.  Where contacts depend on each other a mode may have no unique
 * loads: it is passed over, for the same motion has another mode whose loads are (a vertex of the loads that are possible).
 * The modes that are returned are those of the motion: closed where the normal rate is none, sticking where the slip is.  The
 * loads, where all modes are tried, are the mean of all that give the motion: no order and no mirror decides.  (Loads that obey
 * the laws with one motion are convex.) */
#include "impact/contact_problem.h"

#include <math.h>
#include <string.h>

#include "impact/contact_problem_parts.h"
#include "numerics/dense.h"
#include "numerics/lemke.h"
#include "numerics/tolerances_impact.h"
#include "planemotion.h"
#include "state/arena.h"
#include "state/state.h"

int pm_contact_problem_create(pm_contact_problem *x, pm_arena *arena, int most)
{
    const size_t n = most, two = 2 * n, m = 3 * n;
    const pm_array array[] = {
        PM_ARRAY(x->contact, n),
        PM_ARRAY(x->mode, n),
        PM_ARRAY(x->trial, n),
        PM_ARRAY(x->pivot, two),
        PM_ARRAY(x->basis, m),
        PM_ARRAY(x->response, two * two),
        PM_ARRAY(x->load, two),
        PM_ARRAY(x->rate, two),
        PM_ARRAY(x->scaled, two * two),
        PM_ARRAY(x->scale, two),
        PM_ARRAY(x->b, two),
        PM_ARRAY(x->p, two),
        PM_ARRAY(x->a, two),
        PM_ARRAY(x->best, two),
        PM_ARRAY(x->system, m * m),
        PM_ARRAY(x->right, 2 * m),
        PM_ARRAY(x->lemke, PM_LEMKE_SCRATCH(m)),
    };
    x->counted = PM_PROBLEM_COUNTED;
    x->tried = PM_PROBLEM_TRIED;
    x->tries = PM_PROBLEM_TRIES;
    x->sweeps = PM_PROBLEM_SWEEPS;
    return pm_arena_take(arena, PM_ARRAYS(array));
}

/* ---- scale ---- */
int pm_contact_problem_is_smooth(const pm_contact_problem_contact *c)
{
    return c->friction == PM_FRICTION_SMOOTH ||
           (c->friction == PM_FRICTION_COULOMB && c->hold == 0 && c->rub == 0);
}

double pm_contact_problem_friction(const pm_contact_problem *x, int i, double mu)
{
    return x->scale[2 * i + 1] > 0 ? mu * x->scale[2 * i] / x->scale[2 * i + 1] : 0;
}

/* What nothing moves has the scale 0: its load does nothing. */
static double scale_problem(pm_contact_problem *x)
{
    const int n = 2 * x->n;
    double largest = 0, most = 0, greatest = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(x->response[i * n + i]));
    for (int i = 0; i < n; i++) {
        const double own = fabs(x->response[i * n + i]),
                     peer = fmax(own, fabs(x->response[(i ^ 1) * n + (i ^ 1)]));
        x->scale[i] = own > PM_PROBLEM_IMMOBILE * peer ? 1 / sqrt(own) : 0;
    }
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) x->scaled[i * n + k] = x->response[i * n + k] * x->scale[i] * x->scale[k];
    for (int i = 0; i < n; i++) {
        const double unit = x->scale[i] > 0 ? x->scale[i] : most > 0 ? 1 / sqrt(most) : 1;
        x->b[i] = x->contact[i / 2].bias[i % 2] * unit;
        largest = fmax(largest, fabs(x->b[i]));
        greatest = fmax(greatest, x->scale[i]);
    }
    x->rounded = largest > 0 ? x->doubt * greatest / largest : 0;
    for (int i = 0; i < n && largest > 0; i++) x->b[i] /= largest;
    return largest;
}

/* ---- one mode ---- */
static int sense(int mode) { return (mode == PM_SLIDE_FORWARD) - (mode == PM_SLIDE_BACKWARD); }

/* T/N of a contact that slides so, and 0 of one that does not. */
static double ratio(const pm_contact_problem *x, int i, int mode)
{
    return sense(mode) ? -sense(mode) * pm_contact_problem_friction(x, i, x->contact[i].rub) : 0;
}

/* The equations of the trial: a_n = 0 where closed, a_t = 0 where it sticks; how many. */
static int assemble(pm_contact_problem *x, int *unknown)
{
    const int n = 2 * x->n;
    int m = 0;
    for (int i = 0; i < x->n; i++) {
        if (x->trial[i] == PM_OPEN) continue;
        unknown[m++] = 2 * i;
        if (x->trial[i] == PM_STICK && x->scale[2 * i + 1] > 0) unknown[m++] = 2 * i + 1;
    }
    for (int r = 0; r < m; r++) {
        const double *w = x->scaled + unknown[r] * n;
        x->right[r] = -x->b[unknown[r]];
        for (int k = 0; k < m; k++) {
            const int c = unknown[k];
            x->system[r * m + k] = w[c] + (c % 2 == 0 ? ratio(x, c / 2, x->trial[c / 2]) * w[c + 1] : 0);
        }
    }
    return m;
}

static void rates(pm_contact_problem *x)
{
    const int n = 2 * x->n;
    for (int i = 0; i < n; i++) {
        x->a[i] = x->b[i];
        for (int k = 0; k < n; k++) x->a[i] += x->scaled[i * n + k] * x->p[k];
    }
}

/* Loads of the trial; 0 if it has none, or more than one. */
static int solve_trial(pm_contact_problem *x)
{
    int *unknown = x->basis;
    const int m = assemble(x, unknown);
    memset(x->p, 0, 2 * (size_t)x->n * sizeof *x->p);
    x->equations = m;
    if (m > 0) {
        if (pm_dense_lu_factor(m, x->system, x->pivot)) return 0;
        pm_dense_lu_solve(m, x->system, x->pivot, x->right);
    }
    for (int k = 0; k < m; k++) {
        if (!(fabs(x->right[k]) < PM_PROBLEM_LARGEST)) return 0;
        x->p[unknown[k]] = x->right[k];
    }
    for (int i = 0; i < x->n; i++)
        if (sense(x->trial[i])) x->p[2 * i + 1] = ratio(x, i, x->trial[i]) * x->p[2 * i];
    return 1;
}

static double slack(const pm_contact_problem *x)
{
    double largest = 1;
    for (int i = 0; i < 2 * x->n; i++) largest = fmax(largest, fabs(x->p[i]));
    return PM_PROBLEM_TIE * largest;
}

/* By how much it misses what the laws ask of it in the mode that is tried. */
static double miss(const pm_contact_problem *x, int i)
{
    const pm_contact_problem_contact *c = &x->contact[i];
    const int slides = sense(x->trial[i]);
    const double load = x->p[2 * i], friction = x->p[2 * i + 1], *a = x->a + 2 * i;
    if (x->trial[i] == PM_OPEN) return -a[0];
    const double normal = fmax(fabs(a[0]), -load);
    if (slides) return c->slips ? normal : fmax(normal, -slides * a[1]);
    if (pm_contact_problem_is_smooth(c)) return normal;
    const double held = x->scale[2 * i + 1] > 0 ? fmax(normal, fabs(a[1])) : normal;
    if (c->friction == PM_FRICTION_ROUGH) return held;
    return fmax(held, fabs(friction) - pm_contact_problem_friction(x, i, c->hold) * load);
}

int pm_contact_problem_loads_hold(pm_contact_problem *x)
{
    rates(x);
    x->missed = 0;
    for (int i = 0; i < x->n; i++) x->missed = fmax(x->missed, miss(x, i));
    return x->missed <= slack(x);
}

/* 1 / |A^-1| of the equations of the trial, by their greatest row sum.  The least pivot may be many times as large in one order of the
 * contacts, and not in another. */
static double distance_from_singular(pm_contact_problem *x)
{
    const int m = x->equations;
    double *column = x->right, *sum = x->right + m, most = 1;
    memset(sum, 0, (size_t)m * sizeof *sum);
    for (int c = 0; c < m; c++) {
        for (int k = 0; k < m; k++) column[k] = k == c;
        pm_dense_lu_solve(m, x->system, x->pivot, column);
        for (int k = 0; k < m; k++) sum[k] += fabs(column[k]);
    }
    for (int k = 0; k < m; k++) most = fmax(most, sum[k]);
    return 1 / most;
}

int pm_contact_problem_trial_holds(pm_contact_problem *x)
{
    if (!solve_trial(x) || !pm_contact_problem_loads_hold(x)) return 0;
    x->distance = distance_from_singular(x);
    return 1;
}

/* ---- what was found ---- */
/* The equations of the trial are far from singular. */
static int is_sound(const pm_contact_problem *x) { return x->distance > PM_PROBLEM_SOUND; }

/* What rounding makes of rates and loads, the more the nearer its equations are to singular; others may be as large as the tie
 * where contacts nearly lock. */
static double rounding(const pm_contact_problem *x)
{
    const double tie = slack(x), solved = fmax(PM_PROBLEM_EXACT, PM_PROBLEM_SOLVED / x->distance);
    return fmin(tie, fmax(solved / PM_PROBLEM_TIE * tie, x->rounded));
}

static int is_exact(const pm_contact_problem *x) { return x->missed <= rounding(x); }

/* The mode of the motion; in a tie what the contact prefers.  What slides by more than rounding does not stick: there it might
 * depend on others that do. */
static int mode_of_motion(const pm_contact_problem *x, int i, double tie)
{
    const pm_contact_problem_contact *c = &x->contact[i];
    const double *a = x->a + 2 * i;
    if (a[0] > tie || (c->prefers == PM_OPEN && x->p[2 * i] <= tie)) return PM_OPEN;
    if (pm_contact_problem_is_smooth(c)) return PM_SMOOTH;
    if (c->slips) return c->slips > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
    const double none = sense(x->trial[i]) && is_exact(x) ? rounding(x) : tie;
    if (fabs(a[1]) > none) return a[1] > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
    return sense(c->prefers) && sense(x->trial[i]) == sense(c->prefers) ? c->prefers : PM_STICK;
}

static void keep(pm_contact_problem *x, double unit)
{
    const double tie = slack(x);
    for (int i = 0; i < x->n; i++) x->mode[i] = mode_of_motion(x, i, tie);
    for (int i = 0; i < 2 * x->n; i++) {
        x->load[i] = x->p[i] * x->scale[i] * unit;
        x->rate[i] = x->scale[i] > 0 ? x->a[i] / x->scale[i] * unit : x->contact[i / 2].bias[i % 2];
    }
    memcpy(x->best, x->a, 2 * (size_t)x->n * sizeof *x->a);
}

/* A contact that moves otherwise, by more than `same`, than in the motion that is kept, or PM_NONE. */
static int difference(const pm_contact_problem *x, double same)
{
    for (int i = 0; i < 2 * x->n; i++)
        if (fabs(x->a[i] - x->best[i]) > same) return i / 2;
    return PM_NONE;
}

/* Where friction that holds is the greater one, what may stick does: then it goes before sliding. */
static int sticks_by_law(const pm_contact_problem *x)
{
    for (int i = 0; i < x->n; i++)
        if (x->contact[i].hold > x->contact[i].rub && x->trial[i] == PM_STICK) return 1;
    return 0;
}

/* ---- all modes ---- */
/* The next mode of a contact after `mode`; PM_NONE after the last.  What may stick begins with it: it goes before.  A rough
 * one that others keep from slipping may have no friction of its own. */
static int next_mode(const pm_contact_problem *x, int i, int mode)
{
    const pm_contact_problem_contact *c = &x->contact[i];
    const int slides = c->friction == PM_FRICTION_COULOMB && x->scale[2 * i + 1] > 0;
    switch (mode) {
    case PM_NONE:
        if (pm_contact_problem_is_smooth(c)) return PM_SMOOTH;
        return c->slips > 0 ? PM_SLIDE_FORWARD : c->slips < 0 ? PM_SLIDE_BACKWARD : PM_STICK;
    case PM_STICK: return slides ? PM_SLIDE_FORWARD : c->friction == PM_FRICTION_ROUGH ? PM_SMOOTH : PM_OPEN;
    case PM_SLIDE_FORWARD: return c->slips ? PM_OPEN : PM_SLIDE_BACKWARD;
    case PM_OPEN: return PM_NONE;
    default: return PM_OPEN;
    }
}

static int next_trial(pm_contact_problem *x)
{
    for (int i = 0; i < x->n; i++) {
        x->trial[i] = next_mode(x, i, x->trial[i]);
        if (x->trial[i] != PM_NONE) return 1;
        x->trial[i] = next_mode(x, i, PM_NONE);
    }
    return 0;
}

/* Of several motions the one that leaves the contacts slowest is kept: no order and no mirror decides. */
static double speed_left(const pm_contact_problem *x)
{
    double sum = 0;
    for (int i = 0; i < 2 * x->n; i++) sum += x->a[i] * x->a[i];
    return sum;
}

/* Other loads of the motion that is kept, where `count` have been found; those that rounding may have made do not count. */
static void add_loads(pm_contact_problem *x, double unit, int *count)
{
    if (!is_sound(x) || difference(x, slack(x)) != PM_NONE) return;
    for (int i = 0; i < 2 * x->n; i++)
        x->load[i] = (*count > 0 ? x->load[i] : 0) + x->p[i] * x->scale[i] * unit;
    ++*count;
}

/* Of motions that differ those with the highest rank count: what sticks by law, then what obeys the laws to rounding.  Next to
 * a place where contacts lock others obey them within the tie, too, but for what the distance from there tells.  Beside a motion
 * of sound equations one of nearly singular equations is none: that they have loads, and of which sign, is a matter of rounding,
 * or of the hair by which bodies lie on each other. */
static int rank(const pm_contact_problem *x)
{
    return 3 * sticks_by_law(x) + is_exact(x) + (is_exact(x) && is_sound(x));
}

/* Motions that all are known to the tie alone may be one; those of many contacts are not counted, lest Lemke's method, which finds
 * one, tells otherwise. */
static void count_motion(pm_contact_problem *x, int is_first, int other)
{
    x->nmotion = is_first || !is_exact(x) || x->n > x->counted ? 1 : 2;
    x->differs = x->nmotion == 1 ? PM_NONE : other;
}

static void enumerate(pm_contact_problem *x, double unit)
{
    int best = PM_NONE, found = 0;
    double slowest = 0;
    x->nmotion = 0;
    for (int i = 0; i < x->n; i++) x->trial[i] = next_mode(x, i, PM_NONE);
    do {
        if (!pm_contact_problem_trial_holds(x)) continue;
        const double same = PM_PROBLEM_SAME / PM_PROBLEM_TIE * slack(x);
        const int now = rank(x), is_first = now > best,
                  other = x->nmotion > 0 ? difference(x, same) : PM_NONE,
                  is_same = x->nmotion > 0 && other == PM_NONE;
        if (is_same) add_loads(x, unit, &found);
        if (is_same ? !is_first : now < best) continue;
        count_motion(x, is_first, other);
        best = now;
        if (is_same || (!is_first && speed_left(x) >= slowest)) continue;
        slowest = speed_left(x);
        found = is_sound(x);
        keep(x, unit);
    } while (next_trial(x));
    for (int i = 0; i < 2 * x->n && found > 1; i++) x->load[i] /= found;
}

int pm_contact_problem_solve(pm_contact_problem *x)
{
    const double unit = scale_problem(x);
    x->nmotion = 0;
    x->differs = PM_NONE;
    if (x->n > x->counted && pm_contact_problem_lemke(x) && (x->n > x->tried || is_exact(x))) {
        x->nmotion = 1;
        keep(x, unit);
    } else if (x->n <= x->tried) {
        enumerate(x, unit);
    } else if (pm_contact_problem_sweeps(x)) {
        x->nmotion = 1;
        keep(x, unit);
    }
    return x->nmotion;
}
