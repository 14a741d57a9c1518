/* contact_course.c - compression, restitution, and the events between which they are linear. */
#include "impact/contact_course.h"

#include <math.h>
#include <string.h>

#include "impact/contact_course_parts.h"
#include "numerics/dense.h"
#include "numerics/tolerances_impact.h"
#include "planemotion.h"
#include "state/state.h"

#define UNLIMITED INFINITY

int pm_contact_course_create(pm_contact_course *x, pm_arena *arena, int most, int joints)
{
    const size_t n = most, two = 2 * n, m = joints, all = two + m;
    const pm_array array[] = {
        PM_ARRAY(x->contact, n),
        PM_ARRAY(x->response, all * all),
        PM_ARRAY(x->velocity, all),
        PM_ARRAY(x->impulse, all),
        PM_ARRAY(x->of, two),
        PM_ARRAY(x->pivot, two),
        PM_ARRAY(x->start, all),
        PM_ARRAY(x->plastic, all),
        PM_ARRAY(x->system, two * two),
        PM_ARRAY(x->joint, m),
        PM_ARRAY(x->reaction, 2 * m * all),
    };
    int status = pm_arena_take(arena, PM_ARRAYS(array));
    if (!status) status = pm_contact_problem_create(&x->stretch, arena, most);
    if (!status) status = pm_contact_problem_joints_create(&x->joints, arena, &x->stretch, most, joints);
    x->stretch.counted = PM_COURSE_COUNTED;
    return status ? status : pm_contact_springs_create(&x->springs, arena, most);
}

static double times_row(const pm_contact_course *x, int row, const double *p)
{
    double sum = 0;
    for (int k = 0; k < pm_contact_course_size(x); k++)
        sum += x->response[row * pm_contact_course_size(x) + k] * p[k];
    return sum;
}

/* A velocity that rounding has left. */
static double clean(const pm_contact_course *x, double velocity)
{
    return fabs(velocity) <= PM_COURSE_ROUNDING * x->size ? 0 : velocity;
}

/* ---- at once ---- */
/* Directions whose velocities are taken away before the course: slip of rough contacts, bounces that are over. */
static int list_at_once(pm_contact_course *x)
{
    int m = 0;
    for (int i = 0; i < x->n; i++) {
        if (x->contact[i].is_spent && x->velocity[2 * i] > 0) x->of[m++] = 2 * i;
        if (x->contact[i].friction.friction == PM_FRICTION_ROUGH && x->velocity[2 * i + 1] != 0)
            x->of[m++] = 2 * i + 1;
    }
    return m;
}

/* W_dd q = -u_d.  One that depends on those before it goes with them. */
static void take_at_once(pm_contact_course *x)
{
    const int n = pm_contact_course_size(x);
    for (int m = list_at_once(x), dependent; m > 0; m--) {
        for (int r = 0; r < m; r++)
            for (int k = 0; k < m; k++) x->system[r * m + k] = x->response[x->of[r] * n + x->of[k]];
        dependent = pm_dense_lu_factor(m, x->system, x->pivot);
        if (dependent) {
            memmove(x->of + dependent - 1, x->of + dependent, (size_t)(m - dependent) * sizeof *x->of);
            continue;
        }
        for (int r = 0; r < m; r++) x->plastic[r] = -x->velocity[x->of[r]];
        pm_dense_lu_solve(m, x->system, x->pivot, x->plastic);
        for (int r = 0; r < m; r++) x->impulse[x->of[r]] = x->plastic[r];
        for (int i = 0; i < n; i++) x->velocity[i] = clean(x, x->velocity[i] + times_row(x, i, x->impulse));
        for (int r = 0; r < m; r++) x->velocity[x->of[r]] = 0;
        return;
    }
}

/* ---- events ---- */
static double until_none(double velocity, double rate)
{
    return velocity * rate < 0 ? -velocity / rate : UNLIMITED;
}

/* int (u + u' s) p ds = work */
static double until_work(double u, double rate, double p, double work)
{
    if (p <= 0 || !(work > 0)) return work > 0 ? UNLIMITED : 0;
    const double square = u * u + 2 * rate * work / p;
    return square > 0 ? 2 * work / p / (u + sqrt(square)) : UNLIMITED;
}

/* When the restitution of a contact is over. */
static double until_spent(const pm_contact_course_contact *c, double normal)
{
    switch ((enum pm_law)c->law) {
    case PM_LAW_NEWTON:
        return c->rate[0] > 0 ? fmax(0, (-c->restitution * c->before - normal) / c->rate[0]) : UNLIMITED;
    case PM_LAW_POISSON: return c->share[0] > 0 ? fmax(0, c->left[0] - c->load) / c->share[0] : UNLIMITED;
    case PM_LAW_STRONGE: return until_work(normal, c->rate[0], c->share[0], c->left[1] - c->work);
    case PM_LAWS: break;
    }
    return UNLIMITED;
}

static double until_slip_ends(const pm_contact_course_contact *c, double slip)
{
    return c->friction.friction == PM_FRICTION_COULOMB ? until_none(slip, c->rate[1]) : UNLIMITED;
}

static double until_met(const pm_contact_course_contact *c, double normal)
{
    return normal > 0 ? until_none(normal, c->rate[0]) : UNLIMITED;
}

/* How long velocities are linear: at the end of compression s = 1.  Where a blow stops bodies for good slips end there, too. */
static double length(const pm_contact_course *x, int compresses)
{
    double s = compresses ? 1 : UNLIMITED;
    for (int i = 0; i < x->n; i++) {
        const pm_contact_course_contact *c = &x->contact[i];
        const double *u = x->velocity + 2 * i;
        s = fmin(s, fmin(until_slip_ends(c, u[1]), until_met(c, u[0])));
        if (c->rebounds) s = fmin(s, until_spent(c, u[0]));
    }
    for (int k = 0; k < x->m; k++) s = fmin(s, until_none(x->velocity[2 * x->n + k], x->joint[k].rate));
    return compresses && s > 1 - PM_COURSE_SAME ? 1 : s;
}

/* Goes on by s; what ends there, but for rounding, is zero, exactly. */
static void go(pm_contact_course *x, double s)
{
    const double now = s * (1 + PM_COURSE_SAME);
    for (int i = 0; i < x->n; i++) {
        pm_contact_course_contact *c = &x->contact[i];
        double *u = x->velocity + 2 * i;
        const double p = c->share[0] * s;
        const int slip_ends = until_slip_ends(c, u[1]) <= now, meets = until_met(c, u[0]) <= now;
        if (c->rebounds && until_spent(c, u[0]) <= now) c->rebounds = 0;
        c->work += p * (u[0] + 0.5 * c->rate[0] * s);
        c->load += p;
        x->impulse[2 * i] += p;
        x->impulse[2 * i + 1] += c->share[1] * s;
        u[0] = meets ? 0 : clean(x, u[0] + c->rate[0] * s);
        u[1] = slip_ends ? 0 : u[1] + c->rate[1] * s;
    }
    for (int k = 0; k < x->m; k++) {
        double *u = x->velocity + 2 * x->n + k;
        x->impulse[2 * x->n + k] += x->joint[k].share * s;
        *u = until_none(*u, x->joint[k].rate) <= now ? 0 : *u + x->joint[k].rate * s;
    }
}

/* ---- phases ---- */
static int goes_on(const pm_contact_course *x, int compresses)
{
    for (int i = 0; i < x->n; i++)
        if (compresses ? x->velocity[2 * i] < 0 : x->contact[i].rebounds) return 1;
    return 0;
}

/* Slips of which next to nothing is left, as those that end at one place leave them: how many there were. */
static int end_slips(pm_contact_course *x)
{
    int n = 0;
    for (int i = 0; i < x->n; i++) {
        double *slip = &x->velocity[2 * i + 1];
        if (*slip == 0 || fabs(*slip) > PM_COURSE_ALMOST * x->size) continue;
        *slip = 0;
        n++;
    }
    return n;
}

static int follow_phase(pm_contact_course *x, int compresses)
{
    const int most = PM_COURSE_EVENTS * (x->n + x->m + 1);
    for (int i = 0; i < most; i++) {
        if (!goes_on(x, compresses)) return 1;
        int found = pm_contact_course_find_rates(x, compresses);
        if (found == 0 && i > 0 && end_slips(x)) found = pm_contact_course_find_rates(x, compresses);
        if (found != 1) return found;
        const double s = length(x, compresses);
        if (!isfinite(s)) return 0;
        go(x, s);
    }
    return 0;
}

/* What all contacts have taken in compression, J. */
static double work_of_all(const pm_contact_course *x)
{
    double sum = 0;
    for (int i = 0; i < x->n; i++) sum += fabs(x->contact[i].work);
    return sum;
}

/* A contact that was pushed without being compressed has no work to give back, by the law of Stronge. */
static void begin_restitution(pm_contact_course *x)
{
    const double no_work = PM_COURSE_ROUNDING * work_of_all(x);
    memcpy(x->plastic, x->impulse, (size_t)pm_contact_course_size(x) * sizeof *x->impulse);
    for (int i = 0; i < x->n; i++) {
        pm_contact_course_contact *c = &x->contact[i];
        const double e = c->restitution;
        c->left[0] = e * c->load;
        c->left[1] = -e * e * c->work;
        c->rebounds = c->before < 0 && c->left[0] > 0 && (c->law != PM_LAW_STRONGE || -c->work > no_work);
        c->load = c->work = 0;
    }
}

/* ---- with stiffnesses ---- */
static double coefficient(const pm_contact_problem_contact *c, double mu)
{
    return c->friction == PM_FRICTION_ROUGH ? INFINITY : c->friction == PM_FRICTION_COULOMB ? mu : 0;
}

static int follow_springs(pm_contact_course *x)
{
    pm_contact_springs *s = &x->springs;
    const int n = x->n;
    s->n = n;
    s->exponent = x->exponent;
    memcpy(s->response, x->response, 4 * (size_t)n * n * sizeof *s->response);
    for (int i = 0; i < n; i++) {
        const pm_contact_course_contact *c = &x->contact[i];
        s->spring[i] = (pm_contact_spring){.stiffness = c->stiffness,
                                           .restitution = c->restitution,
                                           .hold = coefficient(&c->friction, c->friction.hold),
                                           .rub = coefficient(&c->friction, c->friction.rub),
                                           .before = x->velocity[2 * i],
                                           .slip = x->velocity[2 * i + 1]};
    }
    if (!pm_contact_springs_follow(s)) return 0;
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < 2; k++) x->impulse[2 * i + k] += s->spring[i].impulse[k];
        x->velocity[2 * i] = s->spring[i].before;
        x->velocity[2 * i + 1] = s->spring[i].slip;
    }
    return 1;
}

/* ---- energy ---- */
/* What impulses p give, p u + p W p/2, u before; beyond rounding. */
static double given(const pm_contact_course *x, const double *p)
{
    double sum = 0, size = 0;
    for (int i = 0; i < pm_contact_course_size(x); i++) {
        const double change = times_row(x, i, p);
        sum += p[i] * (x->start[i] + 0.5 * change);
        size += fabs(p[i]) * (fabs(x->start[i]) + fabs(change));
    }
    return fabs(sum) <= PM_BLOW_ROUNDING * size ? 0 : sum;
}

/* The largest k <= 1 for which plastic + k (impulse - plastic) gives nothing: c + b k + a k^2. */
static double share_of(const pm_contact_course *x)
{
    double a = 0, b = 0;
    for (int i = 0; i < pm_contact_course_size(x); i++) {
        const double more = x->impulse[i] - x->plastic[i];
        b += more * (x->start[i] + times_row(x, i, x->plastic));
        a += 0.5 * more * (times_row(x, i, x->impulse) - times_row(x, i, x->plastic));
    }
    const double none = given(x, x->plastic), root = sqrt(fmax(0, b * b - 4 * a * none));
    if (!(none < 0)) return 0;
    return fmin(1, b > 0 ? -2 * none / (b + root) : (root - b) / (2 * a));
}

static void limit(pm_contact_course *x)
{
    x->limited = given(x, x->impulse) > 0;
    if (!x->limited) return;
    const double k = share_of(x);
    for (int i = 0; i < pm_contact_course_size(x); i++)
        x->impulse[i] = k * x->impulse[i] + (1 - k) * x->plastic[i];
    for (int i = 0; i < pm_contact_course_size(x); i++)
        x->velocity[i] = clean(x, x->start[i] + times_row(x, i, x->impulse));
}

static void begin(pm_contact_course *x)
{
    const int n = 2 * x->n;
    x->limited = 0;
    x->differs = PM_NONE;
    x->size = 0;
    memset(x->impulse, 0, (size_t)pm_contact_course_size(x) * sizeof *x->impulse);
    for (int i = 0; i < n; i++) x->size = fmax(x->size, fabs(x->velocity[i]));
    x->no_slip = fmax(x->no_slip, PM_COURSE_ROUNDING * x->size);
    x->stretch.doubt = PM_COURSE_DOUBT * x->size;
    for (int i = 1; i < n; i += 2)
        if (fabs(x->velocity[i]) <= x->no_slip) x->velocity[i] = 0;
    for (int k = 0; k < x->m; k++)
        if (fabs(x->velocity[n + k]) <= x->joint[k].no_slip) x->velocity[n + k] = 0;
    memcpy(x->start, x->velocity, (size_t)pm_contact_course_size(x) * sizeof *x->start);
}

int pm_contact_course_follow(pm_contact_course *x)
{
    begin(x);
    take_at_once(x);
    if (x->exponent > 0) return follow_springs(x);
    for (int i = 0; i < x->n; i++) {
        pm_contact_course_contact *c = &x->contact[i];
        c->before = x->start[2 * i];
        c->load = c->work = 0;
        c->rebounds = 0;
    }
    int found = follow_phase(x, 1);
    if (found != 1) return found;
    begin_restitution(x);
    if ((found = follow_phase(x, 0)) == 1) limit(x);
    return found;
}

/* ---- all at once ---- */
/* One problem of all contacts and joints, with restitution or without. */
static int solve_at_once(pm_contact_course *x, int plastic)
{
    x->stretch.n = x->n;
    for (int i = 0; i < x->n; i++) {
        pm_contact_problem_contact *c = &x->stretch.contact[i];
        const double *u = x->start + 2 * i;
        *c = x->contact[i].friction;
        if (plastic) {
            c->bias[0] = x->contact[i].is_spent ? -fabs(u[0]) : u[0];
            c->bias[1] = u[1];
        }
        x->of[i] = i;
    }
    pm_contact_course_pose(x);
    for (int k = 0; k < x->m; k++) {
        x->joints.joint[k].slips = 0;
        x->joints.joint[k].bias = x->start[2 * x->n + k];
        memcpy(x->joints.joint[k].start, x->joint[k].start, sizeof x->joint[k].start);
    }
    return pm_contact_course_solve(x);
}

static void take_impulses(const pm_contact_course *x, double *impulse)
{
    memcpy(impulse, x->stretch.load, 2 * (size_t)x->n * sizeof *impulse);
    for (int k = 0; k < x->m; k++) impulse[2 * x->n + k] = x->joints.joint[k].friction;
}

int pm_contact_course_at_once(pm_contact_course *x)
{
    begin(x);
    int found = solve_at_once(x, 0);
    if (found != 1) return found;
    take_impulses(x, x->impulse);
    for (int i = 0; i < pm_contact_course_size(x); i++)
        x->velocity[i] = clean(x, x->start[i] + times_row(x, i, x->impulse));
    if (!(given(x, x->impulse) > 0)) return 1;
    if ((found = solve_at_once(x, 1)) != 1) return found;
    take_impulses(x, x->plastic);
    limit(x);
    return 1;
}

int pm_contact_course_is_shared(const pm_contact_course *x)
{
    const int n = pm_contact_course_size(x);
    if (x->exponent > 0) return 0;
    for (int i = 0; i < x->n; i++)
        for (int k = 0; k < i; k++) {
            const double both = x->response[2 * i * n + 2 * k];
            const double own = x->response[2 * i * (n + 1)] * x->response[2 * k * (n + 1)];
            if (x->impulse[2 * i] > 0 && x->impulse[2 * k] > 0 &&
                both * both > PM_COURSE_ROUNDING * PM_COURSE_ROUNDING * own)
                return 1;
        }
    return 0;
}
