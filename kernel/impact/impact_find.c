/* impact_find.c - by which of the ways the blow of what is listed is found. */
#include <string.h>

#include "elements/contact.h"
#include "elements/joint_friction.h"
#include "elements/teeth.h"
#include "impact/impact_parts.h"
#include "numerics/tolerances_impact.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

/* One contact alone is followed, or solved; where it is not the whole blow all that may take part is found at once.  A blow
 * that would gain energy is limited. */
static int find_of_contacts(pm_workspace *w, pm_blow *b)
{
    int status = PM_OK;
    if (pm_impact_trial_contacts(w->model, b) <= 1) {
        if ((status = pm_impact_trial_solve(w, b))) return status;
        if (pm_impact_trial_is_whole(w, b)) {
            pm_impact_end_record(w);
            return PM_OK;
        }
    }
    return pm_impact_together(w, b);
}

static int find_blow(pm_workspace *w, pm_blow *b)
{
    int loaded, holds = 0;
    memset(b->held, 0, (size_t)w->model->nslot * sizeof *b->held);
    b->plastic = b->equations = b->followed = b->several = 0;
    int status = pm_impact_loaded(w, b, &loaded);
    if (!status && !loaded) status = find_of_contacts(w, b);
    if (!status) status = pm_impact_hold_rocking(w, b, &holds);
    const int exact = !b->ends_bounce && !holds && !loaded;
    return !status && exact && pm_impact_end_gains(w, b) > 0 ? pm_impact_limit(w, b) : status;
}

/* Teeth that would pull meet with their other flanks. */
static int find_with_teeth(pm_workspace *w, pm_blow *b)
{
    for (int i = 0;; i++) {
        const int status = b->shock == PM_NONE ? find_blow(w, b) : pm_impact_follow_shock(w, b);
        if (status || i > w->model->nteeth || !pm_teeth_turn_struck(w)) return status;
    }
}

/* The blow of what strikes, or of a shock. */
static int find_any(pm_workspace *w, pm_blow *b)
{
    const int status = find_with_teeth(w, b);
    return !status && b->shock != PM_NONE ? pm_joint_friction_check_blow(w) : status;
}

/* One contact alone is struck, whose direction is that between two places: of circles, points, curves. */
static int turns_with_places(const pm_model *m, const pm_blow *b)
{
    if (pm_impact_trial_contacts(m, b) != 1) return 0;
    for (int i = 0; i < m->nslot; i++) {
        const int kind = PM_CONTACT_ROW(m, pm_contact_of_slot(m, i))[PM_CONTACT_KIND];
        if (pm_blow_has(b, i) && kind != PM_CONTACT_LINE && kind != PM_CONTACT_SEGMENT) return 1;
    }
    return 0;
}

/* Far away from where places are counted they are rounded by much of a small radius: in a coarse run such a contact is struck at places
 * that are off by so much. */
int pm_impact_find(pm_workspace *w, pm_blow *b)
{
    if (!pm_evidence_is_coarse(&w->evidence) || !turns_with_places(w->model, b)) return find_any(w, b);
    memcpy(b->place, w->state.q, (size_t)w->model->nq * sizeof *b->place);
    for (int i = 0; i < w->model->nq; i++)
        w->state.q[i] *= 1 + PM_DISTURBED_BLOW * pm_evidence_noise(&w->evidence, i);
    pm_frame_look_state(&w->frame, &w->state);
    const int status = find_any(w, b);
    memcpy(w->state.q, b->place, (size_t)w->model->nq * sizeof *b->place);
    return status;
}
