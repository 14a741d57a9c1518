/* event_strand.c - taut cords: how much of a strand is left between its circles, of the wrap on a rim that it may slip on, and the stop where
 * nothing is. */
#include <math.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "events/event.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

int pm_event_strands(const pm_model *m, int slot)
{
    const int contact = pm_contact_of_slot(m, slot);
    return pm_contact_is_cord(m, contact) ? 1 + pm_contact_has_rim(m, contact) : 0;
}

double pm_event_strand_constraint(const pm_frame *frame, int strand, pm_constraint *c)
{
    const int slot = strand / 2;
    pm_constraint of[2];
    pm_contact_constraint_normal(frame, pm_contact_of_slot(frame->model, slot), slot, 0, c);
    if (c->over) {
        pm_constraint_cord_strands(c, of);
        *c = of[strand % 2];
    }
    return PM_STRAND_LEAST * (fabs(c->radius_a) + fabs(c->radius_b));
}

static double strand_left(const pm_frame *frame, int strand, double *approach, double *nothing)
{
    pm_constraint c;
    *nothing = pm_event_strand_constraint(frame, strand, &c);
    return pm_constraint_strand_left(frame, &c, approach);
}

double pm_event_strand_left(const pm_workspace *w, int strand, double *nothing)
{
    double approach;
    return strand_left(&w->frame, strand, &approach, nothing);
}

double pm_event_strand_approach(const pm_frame *frame, int strand)
{
    double approach, nothing;
    strand_left(frame, strand, &approach, &nothing);
    return approach;
}

int pm_event_wraps(const pm_frame *frame, int slot)
{
    const pm_constraint *c = &frame->numbers->of_contact[pm_contact_of_slot(frame->model, slot)];
    return c->over && c->radius_rim != 0;
}

double pm_event_wrap(const pm_frame *frame, int slot)
{
    pm_constraint c;
    pm_contact_constraint_normal(frame, pm_contact_of_slot(frame->model, slot), slot, 0, &c);
    return pm_constraint_cord_wrap(frame, &c);
}

static int ends(pm_workspace *w, int slot, int leaves_rim)
{
    return pm_fail(&w->result, PM_STRAND_ENDS, PM_TABLE_CONTACT, pm_contact_of_slot(w->model, slot),
                   w->state.t, leaves_rim);
}

/* So short, or nothing is left of it a few steps like the last from here, ahead or behind. */
static int is_about_to_end(const pm_workspace *w, int strand)
{
    double approach, nothing;
    const double left = strand_left(&w->frame, strand, &approach, &nothing);
    const double soon = PM_STRAND_SOON * (w->step.whole_end - w->step.whole_begin);
    return left < PM_STRAND_NEAR * nothing ||
           (w->phase.route->in_time && left * left < fabs(approach) * soon);
}

int pm_event_explain_strand(pm_workspace *w, int status)
{
    if (status != PM_STEP_TOO_SMALL && status != PM_SOLVER && status != PM_SINGULAR && status != PM_AUDIT)
        return status;
    pm_frame_look_state(&w->frame, &w->state);
    for (int i = 0; i < w->model->nslot; i++) {
        if (w->state.slot[i].mode == PM_OPEN) continue;
        for (int k = 0; k < pm_event_strands(w->model, i); k++)
            if (is_about_to_end(w, 2 * i + k)) return ends(w, i, 0);
    }
    return status;
}

int pm_event_check_strands(pm_workspace *w)
{
    for (int i = 0; i < w->event->nfunction; i++) {
        const pm_event_function *f = &w->event->function[i];
        if (!w->event->hit[i]) continue;
        if (f->kind == FUNCTION_STRAND) return ends(w, f->index / 2, 0);
        if (f->kind == FUNCTION_WRAP) return ends(w, f->index, 1);
    }
    return PM_OK;
}
