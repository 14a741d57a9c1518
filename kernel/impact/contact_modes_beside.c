/* contact_modes_beside.c - where the laws allow several motions: what stands open by a hair, and stays so, is closed as well.
 *
 * A body comes to rest on some of its feet while another is still in the air, from a bounce of the last ones, lower than shows.  On
 * those alone it may be held by their friction, or turn until that one is down: the two motions end within the hair.  With it there
 * is often one.  Where there is none, or there are several with it, too, nothing is changed. */
#include <math.h>
#include <string.h>

#include "elements/capture.h"
#include "elements/contact.h"
#include "elements/edge.h"
#include "impact/contact_modes.h"
#include "impact/impact_parts.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"

/* An open member, out of touch by a hair, that neither parts nor approaches. */
static int stays_near(const pm_workspace *w, int contact, int *member)
{
    const pm_model *m = w->model;
    double rate;
    if (pm_capture_kind(m, contact) != PM_CAPTURE_NONE) return 0;
    const double gap = pm_contact_gap(&w->frame, &w->state, contact, member);
    if (!(gap > 0 && gap <= PM_NEAR_BESIDE * w->numbers.size) ||
        (pm_edge_is(m, contact) && !(pm_edge_room(&w->frame, &w->state, contact, *member) > 0)))
        return 0;
    pm_contact_member_gap(&w->frame, contact, *member, &rate);
    return fabs(rate) <= pm_contact_speed(&w->frame) &&
           !pm_contact_modes_released(m, &w->instant, contact, *member);
}

/* What stays near is closed, and marked PM_JOINED; 1 if there is any. */
static int close_near(pm_workspace *w, unsigned char *share, int *status)
{
    int any = 0;
    memset(share, PM_OUT, (size_t)w->model->nslot);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member, slot;
        for (int n = 0; n < pm_contact_slots(w->model, i) && stays_near(w, i, &member); n++) {
            if ((*status = pm_contact_modes_close(w, i, member, &slot))) return 0;
            share[slot] = PM_JOINED;
            any = 1;
        }
    }
    return any;
}

int pm_contact_modes_settle_beside(pm_workspace *w)
{
    const pm_where none = w->result.where;
    unsigned char *share = w->blow->share;
    int32_t *before = w->blow->trial;
    for (int i = 0; i < w->model->nslot; i++) before[i] = w->state.slot[i].mode;
    int status = pm_contact_modes_settle(w);
    if (status != PM_NOT_UNIQUE) return status;
    const pm_where where = w->result.where;
    pm_contact_modes_restore(&w->state, w->model, before);
    pm_frame_look_state(&w->frame, &w->state);
    int with = PM_OK;
    if (close_near(w, share, &with)) {
        w->result.where = none;
        if (!(with = pm_contact_modes_settle(w))) return PM_OK;
        for (int i = 0; i < w->model->nslot; i++)
            if (share[i] == PM_JOINED) w->state.slot[i].mode = PM_OPEN;
    }
    w->result.where = where;
    return status;
}
