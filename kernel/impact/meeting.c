/* meeting.c - a contact is struck where its gap is zero.
 *
 * Late in a run times have fewer digits than places: at the nearest number to the time of a blow the gap g is not zero, each
 * rebound begins a little too high or too deep, and blow by blow that adds up.  So the motion is followed over what the time
 * cannot tell:
 *
 *   q += v dt,    v += a dt      dt = -g / g' */
#include "impact/meeting.h"

#include <math.h>

#include "elements/contact.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "numerics/tolerances.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

/* The contact whose gap closes here; PM_NONE if several do: no one time is that of all. */
static int closing_contact(const pm_event_set *event)
{
    int contact = PM_NONE;
    for (int i = event->ntrigger; i < event->nfunction; i++) {
        const pm_event_function *f = &event->function[i];
        if (!event->hit[i] || f->kind != FUNCTION_GAP || f->below) continue;
        if (contact != PM_NONE) return PM_NONE;
        contact = f->index;
    }
    return contact;
}

/* s, from the time of the state to that of the blow; 0 if it is no rounding of it. */
static double time_left(const pm_workspace *w, int contact)
{
    int member = 0;
    double rate;
    if (!pm_contact_is_single(w->model, contact)) pm_contact_gap(&w->frame, &w->state, contact, &member);
    const double gap = pm_contact_member_gap(&w->frame, contact, member, &rate);
    if (!(rate < -pm_contact_speed(&w->frame))) return 0;
    const double most = PM_MEETING_ROUNDINGS * PM_EPSILON * fabs(w->state.t), left = -gap / rate;
    return fabs(left) <= most ? left : 0;
}

int pm_meeting_reach(pm_workspace *w)
{
    const int contact = w->phase.route->in_time ? closing_contact(w->event) : PM_NONE;
    const double left = contact == PM_NONE ? 0 : time_left(w, contact);
    if (left == 0) return PM_OK;
    for (int i = 0; i < w->model->nq; i++) {
        w->state.q[i] += w->state.v[i] * left;
        w->state.v[i] += w->frame.a[i] * left;
    }
    pm_frame_look_state(&w->frame, &w->state);
    return pm_saddle_accelerate(w);
}
