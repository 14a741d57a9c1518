/* impact_course.c - the course of a blow at one contact with friction, by its normal impulse P (Routh).
 *
 *   du_n = a dP + b dP_t,   du_t = b dP + c dP_t          a, c >= 0, a c >= b^2: all joints held
 *
 * While the pair slips dP_t = -mu sgn(u_t) dP.  Where the slip has ended it holds if |b| <= mu c, with
 * dP_t = -(b/c) dP, and else goes on the way that b drives it: it reverses at most once.  A rough pair loses its slip at
 * once.  Compression ends where u_n = 0, with the impulse P_c and the work W_c = int u_n dP; the blow ends where
 *
 *   newton   u_n = -e u_n(before)      poisson   P = (1 + e) P_c      stronge   int u_n dP = -e^2 W_c  from there on
 *
 * The three agree without friction.
 *
 * Where a - mu |b| <= 0 friction draws a pair that slips together, and a blow begins with u_n = 0: an impact without collision
 * (Painleve).  The slip ends in it, for a c >= b^2, and compression soon after it. [F. Genot and B. Brogliato, Eur. J. Mech.
 * A/Solids 18 (1999) 653; E. J. Routh, Dynamics of a System of Rigid Bodies, Elementary Part, ch. IV; Y. Wang and M. T. Mason,
 * J. Appl. Mech. 59 (1992) 635; W. J. Stronge, Proc. R. Soc. A 431 (1990) 169] */
#include "impact/impact_course.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "equations/active_set.h"
#include "equations/saddle.h"
#include "impact/contact_modes.h"
#include "impact/impact_parts.h"
#include "numerics/tolerances_impact.h"
#include "state/workspace.h"

#define STRETCHES 8 /* of constant rates: two phases, with one end of slip and one reversal at most */
#define UNLIMITED INFINITY

/* Where the blow is. */
typedef struct pm_impact_place {
    double normal, slip;      /* m/s */
    double impulse, friction; /* N s, so far */
    double ratio;             /* dP_t/dP on this stretch */
    double rate_n, rate_t;    /* du/dP on it */
    double work;              /* normal, of the phase so far */
    int slips;
} pm_impact_place;

/* Rough: the slip is lost before any normal impulse. */
static void stick_at_once(const pm_impact_course *x, pm_impact_place *now)
{
    if (isfinite(x->mu_static) || x->c <= 0) return;
    now->friction = -now->slip / x->c;
    now->normal += x->b * now->friction;
    now->slip = 0;
}

static void set_rates(const pm_impact_course *x, pm_impact_place *now)
{
    const int held = fabs(x->b) <= x->mu_static * x->c || x->b == 0;
    now->slips = now->slip != 0 || !held;
    if (now->slips)
        now->ratio = -copysign(x->mu_kinetic, now->slip != 0 ? now->slip : x->b);
    else
        now->ratio = x->c > 0 ? -x->b / x->c : 0;
    now->rate_n = x->a + x->b * now->ratio;
    now->rate_t = now->slips ? x->b + x->c * now->ratio : 0;
    if (fabs(now->rate_n) <= PM_COURSE_LOCKED * x->a) now->rate_n = 0;
}

static double until_slip_ends(const pm_impact_place *now)
{
    return now->slip * now->rate_t < 0 ? -now->slip / now->rate_t : UNLIMITED;
}

static double until_speed(const pm_impact_place *now, double speed)
{
    return now->rate_n > 0 ? (speed - now->normal) / now->rate_n : UNLIMITED;
}

/* int (u + u' P) dP = work */
static double until_work(const pm_impact_place *now, double work)
{
    const double square = now->normal * now->normal + 2 * now->rate_n * work;
    if (work <= 0) return 0;
    return square > 0 ? 2 * work / (now->normal + sqrt(square)) : UNLIMITED;
}

static void go(pm_impact_place *now, double impulse)
{
    now->work += impulse * (now->normal + 0.5 * now->rate_n * impulse);
    now->normal += now->rate_n * impulse;
    now->slip += now->rate_t * impulse;
    now->friction += now->ratio * impulse;
    now->impulse += impulse;
}

/* Where a joint leaves the pair one way to go, slip and approach end together: which of them is first is rounding. */
static int ends_with_slip(const pm_impact_course *x, const pm_impact_place *now, double speed)
{
    return fabs(now->normal - speed) <= PM_COURSE_ROUNDING * fabs(x->normal);
}

static int slips_no_more(const pm_impact_course *x, const pm_impact_place *now)
{
    return fabs(now->slip) <= PM_COURSE_ROUNDING * fabs(x->slip);
}

/* Goes on to the end of the phase, which `until` measures; 0 if it has none. */
static int follow_phase(const pm_impact_course *x, pm_impact_place *now,
                        double (*until)(const pm_impact_place *, double), double bound)
{
    now->work = 0;
    for (int i = 0; i < STRETCHES; i++) {
        set_rates(x, now);
        const double left = until == until_work ? bound - now->work : bound;
        const double end = until(now, left), stop = until_slip_ends(now);
        if (!isfinite(fmin(end, stop))) return 0;
        go(now, fmin(end, stop));
        if (end > stop || slips_no_more(x, now)) now->slip = 0;
        if (end <= stop || (until == until_speed && ends_with_slip(x, now, bound))) return 1;
    }
    return 0;
}

static double until_impulse(const pm_impact_place *now, double impulse) { return impulse - now->impulse; }

static double slip_of(const pm_impact_course *x) { return fabs(x->slip) > x->no_slip ? x->slip : 0; }

int pm_impact_course_draws(const pm_impact_course *x)
{
    pm_impact_place now = {.slip = slip_of(x)};
    set_rates(x, &now);
    return now.slip != 0 && now.rate_n <= 0;
}

int pm_impact_course_follow(const pm_impact_course *x, pm_impact_course_end *end)
{
    pm_impact_place now = {.normal = x->normal, .slip = slip_of(x)};
    const double e = x->restitution;
    int ends = 1;
    stick_at_once(x, &now);
    if (!(now.normal < 0 || (now.normal == 0 && pm_impact_course_draws(x))) ||
        !follow_phase(x, &now, until_speed, 0))
        return 0;
    now.normal = 0;
    if (e > 0) switch ((enum pm_law)x->law) {
        case PM_LAW_NEWTON: ends = follow_phase(x, &now, until_speed, -e * x->normal); break;
        case PM_LAW_POISSON: ends = follow_phase(x, &now, until_impulse, (1 + e) * now.impulse); break;
        case PM_LAW_STRONGE: ends = follow_phase(x, &now, until_work, -e * e * now.work); break;
        case PM_LAWS: break;
        }
    *end = (pm_impact_course_end){now.normal, now.slip, now.impulse, now.friction / now.impulse};
    return ends;
}

int pm_impact_course_applies(const pm_model *model, int slot)
{
    const int contact = pm_contact_of_slot(model, slot), friction = pm_contact_friction(model, contact);
    const int newton = pm_contact_law(model, contact) == PM_LAW_NEWTON;
    if (PM_CONTACT_ROW(model, contact)[PM_CONTACT_TANGENTIAL] != PM_NONE) return 0;
    return friction == PM_FRICTION_COULOMB || (friction == PM_FRICTION_ROUGH && !newton);
}

/* Velocities that a unit impulse along the constraint gives, with the joints held. */
static void respond(pm_workspace *w, const pm_constraint *c, double *x)
{
    double *force = w->blow->system.force;
    memset(force, 0, (size_t)w->model->nq * sizeof *force);
    for (int p = 0; p < pm_constraint_bodies(c); p++)
        for (int k = 0; k < 3 && c->body[p] != w->model->nbody; k++)
            force[3 * c->body[p] + k] += c->j[3 * p + k];
    for (int i = 0; i < w->active.n; i++) w->saddle.wanted[i] = 0;
    pm_saddle_respond_roughly(w, force, x);
}

int pm_impact_course_read(pm_workspace *w, int slot, double *response, pm_impact_course *x)
{
    const int contact = pm_contact_of_slot(w->model, slot);
    const int rough = pm_contact_friction(w->model, contact) == PM_FRICTION_ROUGH;
    const int status = w->active.n > 0 ? pm_saddle_factor(w) : PM_OK;
    if (w->numbers.massless) return pm_fail(&w->result, PM_UNSUPPORTED, PM_TABLE_CONTACT, contact, NAN, NAN);
    if (status) return status;
    const pm_constraint normal = pm_contact_modes_normal(&w->frame, &w->state, slot),
                        tangent = pm_contact_modes_tangent(&w->frame, &w->state, slot);
    x->normal = pm_constraint_times(&w->frame, &normal, w->state.v);
    x->slip = pm_constraint_times(&w->frame, &tangent, w->state.v) - tangent.rate;
    x->mu_static = rough ? INFINITY : pm_contact_static(&w->frame, contact);
    x->mu_kinetic = rough ? INFINITY : pm_contact_kinetic(&w->frame, contact);
    x->no_slip = pm_contact_speed(&w->frame);
    x->law = pm_contact_law(w->model, contact);
    respond(w, &normal, response);
    x->a = pm_constraint_times(&w->frame, &normal, response);
    respond(w, &tangent, response);
    x->b = pm_constraint_times(&w->frame, &normal, response);
    x->c = pm_constraint_times(&w->frame, &tangent, response);
    if (x->c <= PM_COURSE_IMMOBILE * x->a) x->b = x->c = 0;
    return PM_OK;
}
