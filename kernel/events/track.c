/* track.c - joints on curves that are open or have pieces: the way to the nearer end, and the stop where it comes to 0 at an
 * end of the curve. */
#include "events/track.h"

#include "elements/constraint.h"
#include "elements/curve_piece.h"
#include "elements/joint.h"
#include "events/event.h"

/* The constraint of a joint on a curve. */
static pm_constraint on_track(const pm_frame *frame, int joint)
{
    pm_constraint c[PM_JOINT_CONSTRAINTS];
    pm_joint_constraints_of_any(frame, joint, c);
    return c[0];
}

int pm_track_ends(const pm_workspace *w, int joint)
{
    if (!pm_joint_of(w->model, joint)->feet || pm_state_is_absent(w->model, &w->state, PM_TABLE_JOINT, joint))
        return 0;
    const int curve = on_track(&w->frame, joint).curve;
    return pm_curve_has_ends(w->model, curve) || pm_curve_has_pieces(w->model, curve);
}

double pm_track_left(const pm_frame *frame, int joint)
{
    const pm_constraint c = on_track(frame, joint);
    return pm_constraint_curve_room(frame, &c);
}

int pm_track_is_at_end(const pm_frame *frame, int joint)
{
    const pm_constraint c = on_track(frame, joint);
    return pm_curve_piece_is_last(frame, c.curve, pm_constraint_curve_foot(frame, &c));
}

int pm_track_check(pm_workspace *w)
{
    for (int i = 0; i < w->event->nfunction; i++) {
        const pm_event_function *f = &w->event->function[i];
        if (w->event->hit[i] && f->kind == FUNCTION_TRACK && pm_track_is_at_end(&w->frame, f->index))
            return pm_fail(&w->result, PM_CURVE_ENDS, PM_TABLE_JOINT, f->index, w->state.t, 0);
    }
    return PM_OK;
}
