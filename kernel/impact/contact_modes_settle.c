/* contact_modes_settle.c - modes that stand: nothing pulls, holds by more than its friction, or was let go and would approach.
 *
 * They are tried from the state as it was when the search began: the projection on modes that do not stand is taken back. */
#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "equations/active_set.h"
#include "equations/case.h"
#include "equations/ledger.h"
#include "equations/projection.h"
#include "equations/saddle.h"
#include "equations/shared_loads.h"
#include "impact/contact_modes.h"
#include "impact/contact_modes_parts.h"
#include "impact/impact_parts.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "numerics/tolerances_impact.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

/* Never below the natural one: where nothing presses, reactions are rounding. */
static double force_size(const pm_frame *frame, const pm_active_set *active)
{
    double sum = 0;
    for (int i = 0; i < frame->model->nq; i++)
        if (i % 3 != 2) sum += fabs(frame->f[i]);
    for (int i = 0; i < active->n; i++) sum = pm_max(fabs(frame->lambda[i]), sum);
    return pm_max(pm_case_force(frame->model, frame->numbers), sum);
}

int pm_contact_modes_approach(const pm_workspace *w, int slot, double part)
{
    const pm_constraint normal = pm_contact_modes_normal(&w->frame, &w->state, slot);
    return pm_constraint_times(&w->frame, &normal, w->frame.a) - normal.gamma <
           -part * pm_case_acceleration(&w->numbers);
}

/* A contact let go by this search whose pair would now approach. */
static int approaches(const pm_workspace *w)
{
    for (int i = 0; i < w->model->nslot; i++)
        if (w->state.slot[i].mode == PM_OPEN && w->instant.slot_released[i] == PM_LET_GO &&
            pm_contact_modes_approach(w, i, PM_PULLS))
            return 1;
    return 0;
}

/* Contacts that share their loads can do so. */
static int shared_stand(pm_workspace *w, double size)
{
    int stand = 1;
    for (int i = 0; w->active.nredundant > 0 && i < w->model->nslot; i++) {
        double slack;
        if (!pm_shared_is_bounded(w, i, &slack)) continue;
        pm_evidence_sign(&w->evidence, PM_SITE_SHARES, i, slack, size);
        stand &= slack >= -PM_PULLS * size;
    }
    return stand;
}

/* A contact whose normal the others all but hold is open by rounding: to close it the projection has gone to another place, where it
 * would be closed, or there is none near.  Modes that stand there do not stand here. */
int pm_contact_modes_is_put_elsewhere(const pm_workspace *w)
{
    double most = 0;
    for (int i = 0; i < w->model->nq; i++)
        most = pm_max(fabs(w->state.q[i] - w->instant.place[i]) * (i % 3 == 2 ? w->numbers.size : 1), most);
    double open = 0;
    for (int i = 0; i < w->active.n; i++) open = pm_max(fabs(w->active.constraint[i].g), open);
    return most > PM_PUT_ELSEWHERE * w->numbers.size || open > PM_STAYS_OPEN * w->numbers.size;
}

/* Constraints of contacts that depend on each other here alone leave a singular system: with friction of what slides in it, rounding
 * may solve it, and makes the loads. */
static int is_solved_by_rounding(const pm_workspace *w)
{
    const pm_active_set *x = &w->active;
    if (x->clear || !x->asymmetric) return 0;
    for (int i = 0; i < x->n; i++)
        if (x->doubtful[i] && x->constraint[i].slot != PM_NONE) return 1;
    return 0;
}

int pm_contact_modes_are_in_doubt(const pm_workspace *w)
{
    return is_solved_by_rounding(w) || pm_contact_modes_is_put_elsewhere(w);
}

static uint32_t modes_of(const pm_workspace *w)
{
    uint32_t modes = 1;
    for (int i = 0; i < w->model->nslot; i++) modes = 31 * modes + (uint32_t)w->state.slot[i].mode;
    return modes;
}

/* Nothing pulls, holds by more than its friction, or was let go and would approach.  Loads in doubt are no evidence of it: which modes
 * stand in the end does not hang on their signs. */
static int stands(pm_workspace *w, double size)
{
    const int active = w->evidence.active;
    w->evidence.active = active && !pm_contact_modes_are_in_doubt(w);
    pm_evidence_try(&w->evidence, modes_of(w));
    const int stand = shared_stand(w, size) &&
                      pm_contact_modes_pulling(w, w->frame.lambda, PM_SITE_PULLS, size) == PM_NONE &&
                      pm_contact_modes_overcome(w, w->frame.lambda, PM_SITE_SLIDES, size) == PM_NONE &&
                      !approaches(w);
    pm_evidence_try(&w->evidence, 0);
    w->evidence.active = active;
    return stand;
}

int pm_contact_modes_accelerate(pm_workspace *w)
{
    int status;
    pm_frame_look_state(&w->frame, &w->state);
    if ((status = pm_active_set_build(w)) || (status = pm_projection_built(w, &w->state))) return status;
    return w->phase.kinematic ? PM_OK : pm_saddle_accelerate_projected(w);
}

/* The projection on modes that were tried and do not stand is taken back: where their constraints nearly depend on each other
 * it moves bodies that these do not hold. */
static void keep(pm_workspace *w)
{
    memcpy(w->instant.place, w->state.q, (size_t)w->model->nq * sizeof(double));
    memcpy(w->instant.velocity, w->state.v, (size_t)w->model->nq * sizeof(double));
}

void pm_contact_modes_take_back(pm_workspace *w)
{
    memcpy(w->state.q, w->instant.place, (size_t)w->model->nq * sizeof(double));
    memcpy(w->state.v, w->instant.velocity, (size_t)w->model->nq * sizeof(double));
}

static int reverse_contact(pm_workspace *w, int slot)
{
    pm_slot *s = &w->state.slot[slot];
    if (s->mode != PM_STICK ||
        pm_contact_friction(w->model, pm_contact_of_slot(w->model, slot)) != PM_FRICTION_COULOMB)
        return 0;
    s->mode = PM_SLIDE_FORWARD;
    if (pm_contact_modes_accelerate(w)) {
        s->mode = PM_STICK;
        return 0;
    }
    pm_constraint slip = pm_contact_modes_tangent(&w->frame, &w->state, slot);
    s->mode = pm_contact_modes_way_of(&w->frame, &slip);
    return 1;
}

/* Where joints and drives give a slip, what would stick depends on them and holds nothing: a slip that turns back goes on the
 * other way.  How many do. */
static int let_driven_go(pm_workspace *w)
{
    int n = 0;
    for (int i = 0; w->active.nredundant > 0 && i < w->model->nslot; i++) {
        pm_slot *s = &w->state.slot[i];
        const int contact = pm_contact_of_slot(w->model, i);
        if (s->mode != PM_STICK || w->active.slot_tangent[i] >= PM_NONE ||
            pm_contact_friction(w->model, contact) != PM_FRICTION_COULOMB)
            continue;
        pm_constraint slip = pm_contact_modes_tangent(&w->frame, &w->state, i);
        pm_constraint_kind(slip.kind)->evaluate(&w->frame, &slip);
        const double rate = pm_constraint_times(&w->frame, &slip, w->frame.a) - slip.gamma;
        if (!(fabs(rate) > PM_PULLS * pm_case_acceleration(&w->numbers))) continue;
        s->mode = rate > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
        n++;
    }
    return n;
}

/* Loads that no rounding makes of loads which contacts could give. */
static int are_absurd(const pm_workspace *w, double size)
{
    for (int i = 0; i < w->model->nslot; i++) {
        const int normal = w->active.slot_normal[i], tangent = w->active.slot_tangent[i];
        const int contact = pm_contact_of_slot(w->model, i);
        const double load = normal < 0 ? 0 : w->frame.lambda[normal];
        if (load < -size) return 1;
        if (tangent < 0 || normal < 0 || pm_contact_friction(w->model, contact) != PM_FRICTION_COULOMB)
            continue;
        if (fabs(w->frame.lambda[tangent]) - pm_contact_static(&w->frame, contact) * load > size) return 1;
    }
    return 0;
}

int pm_contact_modes_stand(pm_workspace *w)
{
    pm_contact_modes_take_back(w);
    return !pm_contact_modes_accelerate(w) && stands(w, force_size(&w->frame, &w->active));
}

/* Next to such a position what sticks is held so nearly by the joints that their reactions are none which contacts could give,
 * though the accelerations of free bodies ask for these modes.  Up to so many slips, from this slot on, go on the other way:
 * 1 where all stand then. */
static int reverse_nearly(pm_workspace *w, int from, int most)
{
    for (int i = from; i < w->model->nslot && most > 0; i++) {
        pm_contact_modes_take_back(w);
        if (!reverse_contact(w, i)) continue;
        if (pm_contact_modes_stand(w) || reverse_nearly(w, i + 1, most - 1)) return 1;
        w->state.slot[i].mode = PM_STICK;
    }
    return 0;
}

/* Fewest first; where none stand the modes are as before. */
static void reverse_few(pm_workspace *w)
{
    for (int most = 1; most <= PM_REVERSED; most++)
        if (reverse_nearly(w, 0, most)) return;
    pm_contact_modes_take_back(w);
    (void)pm_contact_modes_accelerate(w);
}

/* Modes that stand may not be the only ones. */
static int check_one(pm_workspace *w)
{
    if (!pm_contact_modes_are_open_by_theory(w)) return PM_OK;
    const int status = pm_contact_modes_check_one(w);
    return status ? status : pm_contact_modes_accelerate(w);
}

/* A blow, or the end of a slip, may leave a little of the slip of what sticks.  Where its mode is to slide the other way that is
 * left over: it would come to its end at once, again and again. */
static int slips_against(const pm_workspace *w, int slot)
{
    const pm_slot *s = &w->state.slot[slot];
    if (!pm_contact_modes_slides(s->mode)) return 0;
    const double slip = pm_contact_member_slip(&w->frame, pm_contact_of_slot(w->model, slot), s->member);
    return s->mode == PM_SLIDE_FORWARD ? slip < 0 : slip > 0;
}

/* What slips so sticks, until modes are as in `before`; how many do. */
static int stop(pm_workspace *w, int32_t *before)
{
    int n = 0;
    for (int i = 0; i < w->model->nslot; i++) {
        before[i] = w->state.slot[i].mode;
        n += slips_against(w, i);
    }
    for (int i = 0; i < w->model->nslot && n > 0; i++)
        if (slips_against(w, i)) w->state.slot[i].mode = PM_STICK;
    return n;
}

/* The velocities that modes leave of those before them, in the ledger. */
static int account_for(pm_workspace *w)
{
    const double lost = w->impulses.energy_lost;
    memcpy(w->state.v, w->instant.velocity, (size_t)w->model->nq * sizeof(double));
    pm_frame_look_state(&w->frame, &w->state);
    int status = pm_active_set_build(w);
    if (status) return status;
    pm_saddle_evaluate(&w->active, &w->frame);
    if ((status = pm_projection_velocity(w, &w->state))) return status;
    const int asymmetric = w->active.asymmetric;
    w->active.asymmetric = 0; /* the projection is along the constraints: no friction rides on it */
    if (memcmp(w->state.v, w->instant.velocity, (size_t)w->model->nq * sizeof(double)) != 0)
        pm_ledger_jump(w, w->instant.velocity);
    w->active.asymmetric = asymmetric;
    w->impulses.energy_lost = lost;
    return PM_OK;
}

/* What slips by less than counts as slip is stopped by the modes that stand: these impulses belong into the ledger.  Next to a
 * position where their constraints depend on each other they may be many times the slip. */
static int account(pm_workspace *w)
{
    const size_t velocities = (size_t)w->model->nq * sizeof(double);
    int32_t *before = w->blow->resting;
    if (w->phase.kinematic) return PM_OK;
    const int stopped = stop(w, before);
    if (!stopped && memcmp(w->state.v, w->instant.velocity, velocities) == 0) return PM_OK;
    int status = account_for(w);
    pm_contact_modes_restore(&w->state, w->model, before);
    if (status == PM_SINGULAR && stopped) status = account_for(w);
    return status ? status : pm_contact_modes_accelerate(w);
}

static int settled(pm_workspace *w, int solved)
{
    const int status = solved ? PM_OK : check_one(w);
    return status ? status : account(w);
}

/* They stand, or stay because solving for them has changed none; of these, some with absurd loads are reversed. */
static int stay(pm_workspace *w, double size, int changed)
{
    if (stands(w, size)) return 1;
    if (!changed && are_absurd(w, PM_ABSURD * size)) reverse_few(w);
    return !changed;
}

/* Others instead of them; PM_SINGULAR where they are so and there are no others. */
static int solve(pm_workspace *w, int singular, int *changed)
{
    if (singular) pm_contact_modes_take_back(w);
    const int status = pm_contact_modes_solve(w, changed);
    return singular && (status || !*changed) ? PM_SINGULAR : status;
}

/* Where constraints depend on each other for an instant contacts give way that the others hold to the first order alone. */
static int some_give_way(pm_workspace *w)
{
    return pm_contact_modes_let_few_go(w) || pm_contact_modes_let_few_slip(w);
}

/* Whether a contact goes over the end of its edge while others hold its pair for this instant. */
static int leaves_end(pm_workspace *w, int *status)
{
    int left;
    if (w->phase.kinematic || w->active.clear || (*status && *status != PM_SINGULAR)) return 0;
    const int passed = pm_contact_modes_leave_end(w, &left);
    if (passed) *status = passed;
    return left;
}

/* Nothing is closed, and nothing was let go that might approach. */
static int all_are_free(const pm_workspace *w)
{
    const pm_model *m = w->model;
    if (w->active.n > 0 || w->active.nredundant > 0 || m->nfriction > 0 || m->nteeth > 0) return 0;
    for (int i = 0; i < m->nslot; i++)
        if (w->state.slot[i].mode != PM_OPEN || w->instant.slot_released[i]) return 0;
    return 1;
}

int pm_contact_modes_settle(pm_workspace *w)
{
    const int most = 2 * (w->model->nfriction + w->model->nteeth) + PM_MODES_ROUNDS;
    int solved = 0;
    keep(w);
    for (int i = 0, changed = 1; i < most; i++) {
        pm_contact_modes_take_back(w);
        int status = pm_contact_modes_accelerate(w);
        if (!status && i == 0 && all_are_free(w)) return PM_OK;
        if (leaves_end(w, &status)) continue;
        const int in_doubt = !status && !w->phase.kinematic && pm_contact_modes_are_in_doubt(w);
        if ((status == PM_SINGULAR || in_doubt) && some_give_way(w)) return settled(w, 1);
        if (in_doubt) status = pm_contact_modes_accelerate(w);
        if (status == PM_SINGULAR && pm_contact_modes_reverse_joint(w))
            status = pm_contact_modes_accelerate(w);
        const int singular = status == PM_SINGULAR && changed && !w->phase.kinematic;
        if (!singular) {
            if (status || w->phase.kinematic) return status;
            if (let_driven_go(w) && (status = pm_contact_modes_accelerate(w))) return status;
            const double size = force_size(&w->frame, &w->active);
            if (stay(w, size, changed)) {
                if (!pm_contact_modes_joints_change(w, PM_PULLS * size)) return settled(w, solved);
                changed = 1;
                continue;
            }
        }
        if ((status = solve(w, singular, &changed))) return status;
        solved = 1;
    }
    return pm_fail(&w->result, PM_BLOW_UNDECIDED, PM_NONE, PM_NONE, most, 0);
}
