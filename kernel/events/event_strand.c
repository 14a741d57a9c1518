/* event_strand.c - taut cords: how much of a strand is left between its circles, and the stop where nothing is. */
#include <math.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "events/event.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

static double strand_left(const pm_frame *frame, int slot, double *approach, double *nothing)
{
    pm_constraint c;
    pm_contact_constraint_normal(frame, pm_contact_of_slot(frame->model, slot), slot, 0, &c);
    *nothing = PM_STRAND_LEAST * (fabs(c.radius_a) + fabs(c.radius_b));
    return pm_constraint_strand_left(frame, &c, approach);
}

double pm_event_strand_left(const pm_workspace *w, int slot, double *nothing)
{
    double approach;
    return strand_left(&w->frame, slot, &approach, nothing);
}

double pm_event_strand_approach(const pm_frame *frame, int slot)
{
    double approach, nothing;
    strand_left(frame, slot, &approach, &nothing);
    return approach;
}

static int strand_ends(pm_workspace *w, int slot)
{
    return pm_fail(&w->result, PM_STRAND_ENDS, PM_TABLE_CONTACT, pm_contact_of_slot(w->model, slot),
                   w->state.t, 0);
}

/* So short, or nothing is left of it after a few steps like the last. */
static int is_about_to_end(const pm_workspace *w, int slot)
{
    double approach, nothing;
    const double left = strand_left(&w->frame, slot, &approach, &nothing);
    const double soon = PM_STRAND_SOON * (w->step.whole_end - w->step.whole_begin);
    return left < PM_STRAND_NEAR * nothing || (w->phase.route->in_time && left * left < -approach * soon);
}

int pm_event_explain_strand(pm_workspace *w, int status)
{
    if (status != PM_STEP_TOO_SMALL && status != PM_SOLVER && status != PM_SINGULAR && status != PM_AUDIT)
        return status;
    pm_frame_look_state(&w->frame, &w->state);
    for (int i = 0; i < w->model->nslot; i++) {
        if (w->state.slot[i].mode == PM_OPEN ||
            !pm_contact_is_cord(w->model, pm_contact_of_slot(w->model, i)))
            continue;
        if (is_about_to_end(w, i)) return strand_ends(w, i);
    }
    return status;
}

int pm_event_check_strands(pm_workspace *w)
{
    for (int i = 0; i < w->event->nfunction; i++) {
        const pm_event_function *f = &w->event->function[i];
        if (w->event->hit[i] && f->kind == FUNCTION_STRAND) return strand_ends(w, f->index);
    }
    return PM_OK;
}
