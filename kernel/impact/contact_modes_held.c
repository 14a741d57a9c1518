/* contact_modes_held.c - contacts that others hold for an instant.
 *
 * Where constraints depend on each other at this place alone, the others hold a contact to the first order, and move it to the
 * second.  What they move apart is let go.
 *
 * What sticks they may make slip: the corner of a box on a wall, across from another corner that slides along its wall.  How they
 * share their loads no equation of the first order tells, and the friction of what slides goes with that.  The slip tells it, however
 * slow: to the second order it goes one way, and friction is against it. */
#include <math.h>

#include "elements/contact.h"
#include "equations/case.h"
#include "equations/projection.h"
#include "impact/contact_modes.h"
#include "impact/contact_modes_parts.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"
#include "state/state.h"

/* Contacts that give way at once. */
typedef struct pm_few {
    int slot[PM_LET_GO_FEW], n;
    int slip; /* they are not let go */
} pm_few;

/* ---- let go ---- */
static int few_approach(const pm_workspace *w, const pm_few *few)
{
    for (int i = 0; i < few->n; i++)
        if (pm_contact_modes_approach(w, few->slot[i], PM_APART_IN_TIME)) return 1;
    return 0;
}

static int let_go(pm_workspace *w, const pm_few *few)
{
    for (int i = 0; i < few->n; i++) {
        w->state.slot[few->slot[i]].mode = PM_OPEN;
        w->instant.slot_released[few->slot[i]] = 0;
    }
    if (!pm_contact_modes_stand(w) || pm_contact_modes_is_put_elsewhere(w) || few_approach(w, few)) return 0;
    for (int i = 0; i < few->n; i++) w->instant.slot_released[few->slot[i]] = PM_LET_GO;
    return 1;
}

/* ---- slip ---- */
/* Along the motion or, at rest, the way that it begins; its greatest speed. */
static const double *motion(const pm_workspace *w, double *most)
{
    const double *along[2] = {w->state.v, w->frame.a};
    for (int k = 0; k < 2; k++) {
        *most = 0;
        for (int i = 0; i < w->model->nq; i++)
            *most = pm_max(fabs(along[k][i]) * (i % 3 == 2 ? w->numbers.size : 1), *most);
        if (k == 0 && *most > pm_contact_speed(&w->frame)) return along[0];
    }
    return along[1];
}

/* How fast a contact slips, of the greatest speed, so far along the motion, while the active constraints hold. */
static double slip_ahead(pm_workspace *w, int slot, double far)
{
    pm_state *s = &w->probe;
    double most, rate = 0;
    const double *along = motion(w, &most);
    if (!(most > 0)) return 0;
    pm_state_copy(s, &w->state);
    for (int i = 0; i < w->model->nq; i++) {
        s->v[i] = along[i] / most * w->numbers.speed;
        s->q[i] += far * w->numbers.size * along[i] / most;
    }
    if (!pm_projection_apply(w, s)) {
        const pm_constraint slip = pm_contact_modes_tangent(&w->frame, s, slot);
        rate = pm_constraint_times(&w->frame, &slip, s->v) / w->numbers.speed;
    }
    pm_frame_look_state(&w->frame, &w->state);
    return rate;
}

/* Which way a contact slips to the second order if its friction is against that one: as it slips now or, where that is rounding, a
 * little further on.  PM_STICK: others do not hold it, or nothing is known. */
static int way_if(pm_workspace *w, int slot, int mode)
{
    w->state.slot[slot].mode = mode;
    pm_contact_modes_take_back(w);
    if (pm_contact_modes_accelerate(w) || pm_contact_modes_are_in_doubt(w)) return PM_STICK;
    const pm_constraint tangent = pm_contact_modes_tangent(&w->frame, &w->state, slot);
    const double rate = pm_constraint_times(&w->frame, &tangent, w->frame.a) - tangent.gamma;
    if (fabs(rate) > PM_APART_IN_TIME * pm_case_acceleration(&w->numbers)) return PM_STICK;
    double slip = slip_ahead(w, slot, 0);
    if (fabs(slip) <= PM_SLIP_HELD) slip = slip_ahead(w, slot, PM_NEIGHBOUR);
    if (fabs(slip) <= PM_SLIP_HELD) return PM_STICK;
    return slip > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
}

/* PM_STICK: none. */
static int way_of_second_order(pm_workspace *w, int slot)
{
    const int forward = way_if(w, slot, PM_SLIDE_FORWARD) == PM_SLIDE_FORWARD,
              backward = way_if(w, slot, PM_SLIDE_BACKWARD) == PM_SLIDE_BACKWARD;
    if (forward == backward) return PM_STICK;
    return forward ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
}

static int let_slip(pm_workspace *w, const pm_few *few)
{
    for (int i = 0; i < few->n; i++) w->state.slot[few->slot[i]].mode = PM_SLIDE_FORWARD;
    for (int i = 0; i < few->n; i++) {
        const int way = way_of_second_order(w, few->slot[i]);
        if (way == PM_STICK) return 0;
        w->state.slot[few->slot[i]].mode = way;
    }
    return pm_contact_modes_stand(w) && !pm_contact_modes_are_in_doubt(w);
}

/* ---- which ---- */
static int may_give_way(const pm_workspace *w, int slot, int slip)
{
    const int mode = w->state.slot[slot].mode;
    if (!slip) return mode != PM_OPEN && mode != PM_CAPTURED;
    return mode == PM_STICK &&
           pm_contact_friction(w->model, pm_contact_of_slot(w->model, slot)) == PM_FRICTION_COULOMB;
}

/* 1 where all stand with these; else modes are as before. */
static int give_way(pm_workspace *w, const pm_few *few)
{
    int32_t mode[PM_LET_GO_FEW];
    unsigned char released[PM_LET_GO_FEW];
    for (int i = 0; i < few->n; i++) {
        mode[i] = w->state.slot[few->slot[i]].mode;
        released[i] = w->instant.slot_released[few->slot[i]];
    }
    if (few->slip ? let_slip(w, few) : let_go(w, few)) return 1;
    for (int i = 0; i < few->n; i++) {
        w->state.slot[few->slot[i]].mode = mode[i];
        w->instant.slot_released[few->slot[i]] = released[i];
    }
    return 0;
}

/* So many more, from this slot on. */
static int give_way_from(pm_workspace *w, int from, int most, pm_few *few)
{
    if (most == 0) return give_way(w, few);
    for (int i = from; i < w->model->nslot; i++) {
        if (!may_give_way(w, i, few->slip)) continue;
        few->slot[few->n++] = i;
        if (give_way_from(w, i + 1, most - 1, few)) return 1;
        few->n--;
    }
    return 0;
}

static int few_give_way(pm_workspace *w, int slip)
{
    for (int most = 1; most <= PM_LET_GO_FEW; most++) {
        pm_few few = {.n = 0, .slip = slip};
        if (give_way_from(w, 0, most, &few)) return 1;
    }
    pm_contact_modes_take_back(w);
    return 0;
}

int pm_contact_modes_let_few_go(pm_workspace *w) { return few_give_way(w, 0); }

int pm_contact_modes_let_few_slip(pm_workspace *w) { return few_give_way(w, 1); }
