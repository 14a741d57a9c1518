/* contact_modes_ends.c - two contacts of the same pair of bodies that are one for an instant.
 *
 * Where corner meets corner and the edges from there lie on each other, either corner touches the other's edge at its end.  Both
 * normals are the same row now, and differ as soon as the bodies turn: held together they would pin the corners.  Which of the two
 * stays their slip decides: the corner that it takes over the end of its edge is off it at once. */
#include <math.h>

#include "elements/contact.h"
#include "elements/edge.h"
#include "equations/active_set.h"
#include "equations/saddle.h"
#include "impact/contact_modes.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

/* The normal of this slot depends on other constraints here alone. */
static int is_in_doubt(const pm_active_set *active, int slot)
{
    const int normal = active->slot_normal[slot];
    return normal >= 0 && active->doubtful[normal];
}

static int is_same_pair(const pm_constraint *a, const pm_constraint *b)
{
    return (a->body[0] == b->body[0] && a->body[1] == b->body[1]) ||
           (a->body[0] == b->body[1] && a->body[1] == b->body[0]);
}

/* Some contact of the same pair, this one or another, is in doubt. */
static int pair_is_in_doubt(const pm_workspace *w, int slot)
{
    const pm_active_set *x = &w->active;
    if (x->slot_normal[slot] < 0) return 0;
    for (int i = 0; i < w->model->nslot; i++)
        if (is_in_doubt(x, i) &&
            is_same_pair(&x->constraint[x->slot_normal[slot]], &x->constraint[x->slot_normal[i]]))
            return 1;
    return 0;
}

static int accelerate(pm_workspace *w)
{
    const int status = pm_active_set_build(w);
    return status ? status : pm_saddle_accelerate(w);
}

/* The acceleration of a slip without its contact, which does not rub: others hold the pair all the same. */
static double slip_without(pm_workspace *w, int slot)
{
    pm_slot *s = &w->state.slot[slot];
    const int32_t mode = s->mode;
    double rate = 0;
    s->mode = PM_OPEN;
    if (!accelerate(w)) {
        const pm_constraint tangent = pm_contact_modes_tangent(&w->frame, &w->state, slot);
        rate = pm_constraint_times(&w->frame, &tangent, w->frame.a) - tangent.gamma;
    }
    s->mode = mode;
    (void)accelerate(w); /* as before */
    return rate;
}

/* 1 or -1: the way along its tangent that it slips, or will. */
static int way_of_slip(pm_workspace *w, int slot)
{
    const pm_slot *s = &w->state.slot[slot];
    double slip = pm_contact_member_slip(&w->frame, pm_contact_of_slot(w->model, slot), s->member);
    if (fabs(slip) <= pm_contact_speed(&w->frame)) {
        if (s->mode == PM_STICK) return 0;
        if (s->mode != PM_SMOOTH) return s->mode == PM_SLIDE_FORWARD ? 1 : -1;
        slip = slip_without(w, slot);
    }
    return (slip > 0) - (slip < 0);
}

/* It is at an end of its edge, and its slip goes over that. */
static int goes_over_end(pm_workspace *w, int slot)
{
    const int contact = pm_contact_of_slot(w->model, slot);
    if (!pm_edge_is(w->model, contact) || w->state.slot[slot].member != PM_SEGMENT_FACE) return 0;
    const pm_edge_place x = pm_edge_beside(&w->frame, contact);
    const double near = PM_EDGE_HANDING_OVER * pm_contact_length(&w->frame);
    return -fmax(x.from, x.to) <= near && way_of_slip(w, slot) == (x.to > x.from ? 1 : -1);
}

int pm_contact_modes_leave_end(pm_workspace *w, int *left)
{
    *left = 0;
    for (int i = 0; i < w->model->nslot; i++) {
        if (!pair_is_in_doubt(w, i) || !goes_over_end(w, i)) continue;
        const int status = pm_contact_modes_pass_end(w, i);
        *left = !status;
        return status;
    }
    return PM_OK;
}
