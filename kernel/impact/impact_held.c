/* impact_held.c - several contacts held in a blow too slow for anything to be seen of how they part.
 *
 *   G v' = w at all normals that are closed, N their impulses, of either sign: what pulls here falls back before it is seen
 *
 * Friction goes with what pushes.  What slipped faster than the blow is, slips on:
 *
 *   N >= 0: |P_t| <= mu_s N without slip after the blow, P_t = -mu_k N sgn(u_t') with slip             N < 0: P_t = 0
 *
 * A slip may do neither: with its friction the contact is pulled, without friction it pushes.  The friction that would grow with
 * the load draws the pair together, faster than the load moves it apart; on the way there the load is without bound, so that the slip
 * has ended before. */
#include <math.h>

#include "elements/contact.h"
#include "events/last_bounce.h"
#include "impact/contact_modes.h"
#include "impact/impact_parts.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"
#include "state/workspace.h"

/* ---- who is held ---- */
static int is_closed_in(const pm_blow *b, int slot)
{
    return (b->share[slot] != PM_OUT || b->resting[slot] != PM_OPEN) && b->trial[slot] != PM_CAPTURED;
}

static int closed_in(const pm_workspace *w, const pm_blow *b)
{
    int n = 0;
    for (int i = 0; i < w->model->nslot; i++) n += is_closed_in(b, i);
    return n;
}

/* A body rocks on two contacts or more; one alone bounces (events/last_bounce.h). */
static int one_rocks(const pm_workspace *w, const pm_blow *b)
{
    int parts = 0;
    for (int i = 0; i < w->model->nslot; i++) {
        if (!is_closed_in(b, i)) continue;
        const pm_constraint normal = pm_contact_modes_normal(&w->frame, &w->state, i);
        const double rate = pm_constraint_times(&w->frame, &normal, b->after) - normal.rate;
        parts |= pm_last_bounce_is_held(w, pm_contact_of_slot(w->model, i), rate);
    }
    return parts;
}

int pm_impact_is_slow(const pm_workspace *w, const pm_blow *b)
{
    for (int i = 0; i < w->model->nslot; i++)
        if (b->share[i] == PM_STRUCK || b->share[i] == PM_DROPPED)
            if (pm_last_bounce_is_slow(w, pm_contact_of_slot(w->model, i), b->approach)) return 1;
    return 0;
}

static double slip_left(const pm_workspace *w, const pm_blow *b, int slot)
{
    const pm_constraint tangent = pm_contact_modes_tangent(&w->frame, &w->state, slot);
    return pm_constraint_times(&w->frame, &tangent, b->after) - tangent.rate;
}

/* The mode in which a contact is held: what slips faster than the blow is, and slips after it, goes on slipping. */
static int held_mode(const pm_workspace *w, const pm_blow *b, int slot)
{
    const int contact = pm_contact_of_slot(w->model, slot);
    const double slip = pm_contact_member_slip(&w->frame, contact, w->state.slot[slot].member);
    const int mode = pm_impact_trial_mode(&w->frame, slot);
    if (mode != PM_STICK || pm_contact_friction(w->model, contact) == PM_FRICTION_ROUGH) return mode;
    const double left = slip_left(w, b, slot);
    if (fabs(slip) <= b->approach || fabs(left) <= pm_contact_speed(&w->frame)) return PM_STICK;
    return left > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
}

/* ---- friction ---- */
static int slides_back(const pm_workspace *w, const pm_blow *b, int slot)
{
    const double slip = slip_left(w, b, slot);
    return (b->trial[slot] == PM_SLIDE_FORWARD ? slip : -slip) < -pm_contact_speed(&w->frame);
}

/* Where a contact is held against its parting it has no friction; and that ends a slip, which it does not turn back.  1 if any is
 * mended so. */
static int mend_held(const pm_workspace *w, pm_blow *b)
{
    int mended = 0;
    for (int i = 0; i < w->model->nslot; i++) {
        const int at = w->active.slot_normal[i];
        if (!b->held[i] || !pm_contact_modes_slides(b->trial[i])) continue;
        if (at >= 0 && w->saddle.rhs[at] < 0)
            b->trial[i] = PM_SMOOTH;
        else if (slides_back(w, b, i))
            b->trial[i] = PM_STICK;
        mended |= !pm_contact_modes_slides(b->trial[i]);
    }
    return mended;
}

/* Each is mended once. */
static int solve_mended(pm_workspace *w, pm_blow *b)
{
    int status;
    do status = pm_impact_trial_solve(w, b);
    while (!status && mend_held(w, b));
    return status;
}

/* An impulse that is none. */
static double nothing(const pm_workspace *w)
{
    double most = 0;
    for (int i = 0; i < w->active.n; i++) most = fmax(fabs(w->saddle.rhs[i]), most);
    return PM_BLOW_ROUNDING * most;
}

/* Held first as one that slips on. */
static int slips_on(const pm_blow *b, int slot) { return pm_contact_modes_slides(b->held[slot]); }

/* The slot of a contact that would slip on, is held without friction, and pushes; or PM_NONE. */
static int pushes_without_friction(const pm_workspace *w, const pm_blow *b)
{
    const double none = nothing(w);
    for (int i = 0; i < w->model->nslot; i++) {
        const int at = w->active.slot_normal[i];
        if (slips_on(b, i) && b->trial[i] == PM_SMOOTH && at >= 0 && w->saddle.rhs[at] > none) return i;
    }
    return PM_NONE;
}

static int obeys(const pm_workspace *w, const pm_blow *b, int slot)
{
    const double none = nothing(w);
    const int at = w->active.slot_normal[slot], along = w->active.slot_tangent[slot];
    const double n = at >= 0 ? w->saddle.rhs[at] : 0;
    if (b->trial[slot] == PM_SMOOTH) return n <= none;
    if (b->trial[slot] != PM_STICK) return n >= -none && !slides_back(w, b, slot);
    return at < 0 || along < 0 ||
           fabs(w->saddle.rhs[along]) <=
               pm_contact_static(&w->frame, pm_contact_of_slot(w->model, slot)) * n + none;
}

static int all_obey(const pm_workspace *w, const pm_blow *b)
{
    for (int i = 0; i < w->model->nslot; i++)
        if (slips_on(b, i) && !obeys(w, b, i)) return 0;
    return 1;
}

/* Of what slipped, in the order of the slots: slips on, without friction, sticks - the digits of `code`.  How many stick. */
static int try_modes(const pm_workspace *w, pm_blow *b, int code)
{
    int stick = 0;
    for (int i = 0; i < w->model->nslot; i++) {
        if (!slips_on(b, i)) continue;
        const int32_t mode[] = {b->held[i], PM_SMOOTH, PM_STICK};
        b->trial[i] = mode[code % 3];
        stick += b->trial[i] == PM_STICK;
        code /= 3;
    }
    return stick;
}

/* The modes that obey friction where fewest stick.  1: there are such. */
static int solve_counted(pm_workspace *w, pm_blow *b)
{
    const pm_where where = w->result.where;
    int n = 0, codes = 1;
    for (int i = 0; i < w->model->nslot; i++) n += slips_on(b, i);
    if (n > PM_PROBLEM_COUNTED) return 0;
    for (int i = 0; i < n; i++) codes *= 3;
    for (int sticks = 0; sticks <= n; sticks++)
        for (int code = 0; code < codes; code++) {
            if (try_modes(w, b, code) != sticks) continue;
            if (!pm_impact_trial_solve(w, b) && all_obey(w, b)) return 1;
            w->result.where = where;
        }
    return 0;
}

/* What pushes without friction slips on, as others have changed since; where that would still pull it, it sticks. */
static int solve_one_by_one(pm_workspace *w, pm_blow *b)
{
    (void)try_modes(w, b, 0);
    int status = solve_mended(w, b);
    for (int round = 0; !status && round < 2 * w->model->nslot; round++) {
        const int i = pushes_without_friction(w, b);
        if (i == PM_NONE) break;
        b->trial[i] = b->held[i];
        if ((status = pm_impact_trial_solve(w, b))) break;
        const int at = w->active.slot_normal[i];
        if (at >= 0 && w->saddle.rhs[at] < 0) b->trial[i] = PM_STICK;
        status = solve_mended(w, b);
    }
    return status;
}

static int solve_held(pm_workspace *w, pm_blow *b)
{
    const int status = solve_mended(w, b);
    if (status || all_obey(w, b) || solve_counted(w, b)) return status;
    return solve_one_by_one(w, b);
}

int pm_impact_hold_rocking(pm_workspace *w, pm_blow *b, int *holds)
{
    *holds = closed_in(w, b) > 1 && pm_impact_is_slow(w, b) && one_rocks(w, b);
    if (!*holds) return PM_OK;
    for (int i = 0; i < w->model->nslot; i++) {
        if (!is_closed_in(b, i)) continue;
        b->trial[i] = held_mode(w, b, i);
        b->held[i] = (unsigned char)b->trial[i];
        if (b->share[i] != PM_STRUCK) b->share[i] = b->share[i] == PM_DROPPED ? PM_STRUCK : PM_JOINED;
    }
    b->equations = 1;
    b->followed = b->several = 0;
    const int status = solve_held(w, b);
    if (!status) pm_impact_end_record(w);
    return status;
}
