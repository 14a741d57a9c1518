/* start.c - the start of a case: as it is drawn, assembled, set in motion, and looked at. */
#include "equations/start.h"

#include <string.h>

#include "elements/contact.h"
#include "elements/turning_plane.h"
#include "equations/active_set.h"
#include "equations/case.h"
#include "equations/start_parts.h"
#include "impact/action.h"
#include "state/frame.h"
#include "state/workspace.h"

static void draw(pm_workspace *w)
{
    const pm_model *m = w->model;
    memset(w->state.block, 0, w->state.bytes);
    w->state.t = 0;
    for (int i = 0; i < m->nbody; i++)
        for (int k = 0; k < 3; k++)
            w->state.q[3 * i + k] = w->numbers.value[PM_BODY_ROW(m, i)[PM_BODY_X + k]];
    for (int i = 0; i < m->nbody; i++)
        if (!PM_BODY_ROW(m, i)[PM_BODY_TURNS]) w->state.q[3 * i + 2] = 0;
    pm_action_begin(m, &w->state);
}

/* No contact may overlap at the start. */
static int check_overlap(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member;
        const double gap = pm_contact_gap(w, &w->state, i, &member);
        if (gap >= -pm_contact_length(&w->frame) || !pm_contact_touches(w, &w->state, i, &member)) continue;
        pm_fail(w, PM_PENETRATION, PM_TABLE_CONTACT, i, gap, -pm_contact_length(&w->frame));
        w->result.where.member = member;
        return PM_PENETRATION;
    }
    return PM_OK;
}

int pm_start(pm_workspace *w, pm_start_report *report)
{
    *report = (pm_start_report){0, 0};
    pm_active_set_clear(w);
    draw(w);
    int status = pm_start_assemble(w, report);
    if (!status) status = pm_start_check_couplings(w);
    if (status) return status;
    pm_active_set_anchor_start(w, &w->state);
    if ((status = pm_start_velocities(w)) || (status = check_overlap(w))) return status;
    pm_frame_look_state(&w->frame, &w->state);
    pm_case_speed(w, w->state.v);
    if ((status = pm_turning_plane_start(w))) return status;
    pm_state_copy(&w->start, &w->state);
    return PM_OK;
}
