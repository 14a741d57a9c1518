/* impact.c - restitution with all joints held.
 *
 *   M (v' - v) = H^T P,   G v' = -e (G v) at struck normals, w at joints and at tangents that hold     (17.19)
 *
 * (impact_trial.c).  Captured pairs are joints; one that is caught now is struck in all its constraints.
 *
 * A contact that is struck alone is followed through its blow (impact_course.c).  Where more are struck, or one that rests
 * would approach then, all of them are one problem (impact_together.c): each pushes or parts, sticks or slides; or it is
 * followed, too, where a law asks for that (impact_followed.c), and joints that rub by their load take part (impact_loaded.c).
 * Resting contacts that do not take part carry nothing, their tangents included.
 *
 * One by one (the settings may say so): the first in the order of the contacts that approaches is struck alone, then
 * again the first, a resting one as well; each is a jump of its own.  Where the settings do not choose, blows that this
 * would change are counted (impact_order.c). */
#include "impact/impact.h"

#include <math.h>
#include <string.h>

#include "elements/capture.h"
#include "elements/contact.h"
#include "elements/edge.h"
#include "elements/joint_friction.h"
#include "elements/teeth.h"
#include "elements/trigger.h"
#include "equations/ledger.h"
#include "events/bounce_series.h"
#include "events/event.h"
#include "events/integral_series.h"
#include "events/last_bounce.h"
#include "impact/contact_modes.h"
#include "impact/impact_parts.h"
#include "numerics/minmax.h"
#include "numerics/tolerances_impact.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

/* ---- memory ---- */
int pm_impact_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (PM_ARENA_NEW(&w->memory, w->blow)) return PM_NO_MEMORY;
    pm_blow *b = w->blow;
    b->shock = PM_NONE;
    const pm_array array[] = {
        PM_ARRAY(b->before, m->nq),
        PM_ARRAY(b->place, m->nq),
        PM_ARRAY(b->after, m->nq),
        PM_ARRAY(b->response, m->nq),
        PM_ARRAY(b->apart, m->rows[PM_TABLE_CONTACT]),
        PM_ARRAY(b->resting, m->nslot),
        PM_ARRAY(b->trial, m->nslot),
        PM_ARRAY(b->share, m->nslot),
        PM_ARRAY(b->held, m->nslot),
        PM_ARRAY(b->given, m->nslot),
        PM_ARRAY(b->loaded.friction, m->nfriction),
        PM_ARRAY(b->loaded.along, m->nfriction),
        PM_ARRAY(b->elastic.slot, 2 * m->nslot),
        PM_ARRAY(b->elastic.after, m->nq),
        PM_ARRAY(b->order.before, 2 * m->nslot),
        PM_ARRAY(b->order.after, 2 * m->nslot),
        PM_ARRAY(b->order.now, 2 * m->nslot),
    };
    int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    if (!status) status = pm_contact_system_create(&b->system, &w->memory, m);
    return status ? status : pm_contact_course_create(&b->course, &w->memory, m->nslot, m->nfriction);
}

/* ---- who is struck ---- */
/* An open member that touches: does it approach, is its bounce over, does it stay? */
typedef struct pm_touch {
    int member, approaches, rests, stays;
    double rate; /* m/s */
} pm_touch;

/* Where a series ends here a body rests: what of it is open by no more than the bounces that are left out would be high, and stays
 * so, rests there, too.  Else it would never close, and the body would be held by too few. */
static int rests_beside(const pm_workspace *w, int contact, pm_touch *x)
{
    if (!w->blow->series_ends) return 0;
    const double gap = pm_contact_gap(&w->frame, &w->state, contact, &x->member);
    if (!(gap > 0 && gap <= pm_last_bounce_height(w, contact)) || !pm_bounce_series_ends_beside(w, contact) ||
        (pm_edge_is(w->model, contact) && !(pm_edge_room(&w->frame, &w->state, contact, x->member) > 0)))
        return 0;
    pm_contact_member_gap(&w->frame, contact, x->member, &x->rate);
    return fabs(x->rate) <= pm_contact_speed(&w->frame) &&
           !pm_contact_modes_released(w->model, &w->instant, contact, x->member);
}

/* At a time of the scene, to which the route has found no contact that closes: one that has risen so little since its last blow that
 * it has never ceased to touch flies all the same. */
static int is_in_flight(const pm_workspace *w, int contact)
{
    const pm_bounce_series *x = &w->event->series[contact];
    const double leaves = pm_contact_restitution(&w->frame, contact) * x->approach[0];
    return w->event->at_due && !w->event->at_root && !w->model->acts && x->known > 0 &&
           x->struck[0] < w->state.t &&
           leaves * (w->state.t - x->struck[0]) <= pm_contact_length(&w->frame) &&
           pm_contact_is_open(w->model, &w->state, contact) && w->phase.route->locates_contacts;
}

/* Nothing moves in a blow: what is open and does not touch before it does not touch after it. */
static int touches(pm_workspace *w, int contact, pm_touch *x)
{
    *x = (pm_touch){.stays = 1};
    if (w->blow->apart[contact] == PM_PARTED && !w->event->spent[contact]) return 0;
    if (w->blow->apart[contact] == PM_APART) return rests_beside(w, contact, x);
    if (pm_capture_is_meeting(w->model, contact))
        return pm_capture_meets(&w->numbers, &w->evidence, contact,
                                pm_contact_gap(&w->frame, &w->state, contact, &x->member));
    if (is_in_flight(w, contact)) return 0;
    if (!pm_contact_touches(&w->frame, &w->state, contact, &x->member)) {
        w->blow->apart[contact] = pm_contact_is_open(w->model, &w->state, contact) ? PM_APART : PM_NOT_APART;
        return rests_beside(w, contact, x);
    }
    pm_contact_member_gap(&w->frame, contact, x->member, &x->rate);
    if (!w->blow->series_ends && !pm_last_bounce_is_near(w, contact, x->rate)) {
        /* speeds below it neither strike nor part; that of the main pass in a coarse run, too */
        const double none = pm_contact_speed(&w->frame) / w->numbers.coarse;
        pm_evidence_sign(&w->evidence, PM_SITE_STRIKES, contact, x->rate + none, w->numbers.speed);
        pm_evidence_sign(&w->evidence, PM_SITE_PARTS, contact, x->rate - none, w->numbers.speed);
    }
    x->approaches = x->rate < -pm_contact_speed(&w->frame);
    x->rests = pm_last_bounce_is_spent(w, contact, x->rate);
    x->stays = x->rate <= pm_contact_speed(&w->frame) &&
               (x->approaches || !pm_contact_modes_released(w->model, &w->instant, contact, x->member));
    return 1;
}

/* What captures strikes with any velocity. */
static int is_blow(const pm_model *model, int contact, const pm_touch *x)
{
    return x->approaches || (x->stays && pm_capture_kind(model, contact) != PM_CAPTURE_NONE);
}

/* Closes the open members that touch and do not part: what approaches is struck (its slot is marked PM_STRUCK; one by one
 * the first alone), and what is caught with any velocity; what has no velocity rests, so that it can join the blow; at the start
 * nothing is closed yet. */
static int find_touching(pm_workspace *w, pm_blow *b, int *struck)
{
    const pm_model *m = w->model;
    pm_touch x;
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++)
        for (int n = 0; n < pm_contact_slots(m, i) && touches(w, i, &x) && (x.rests || x.stays); n++) {
            int slot;
            if (is_blow(w->model, i, &x) && *struck > 0 && pm_impact_one_by_one(w->model)) break;
            const int status = pm_contact_modes_close(w, i, x.member, &slot);
            if (status) return status;
            if (w->state.slot[slot].mode == PM_CAPTURED)
                x.approaches = pm_capture_speed(&w->frame, &w->state, slot) > pm_contact_speed(&w->frame);
            if (!x.approaches && !x.rests) continue;
            b->share[slot] = PM_STRUCK;
            b->approach = pm_max(fabs(x.rate), b->approach);
            b->ends_bounce |= x.rests;
            if (x.approaches) {
                pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_STRIKE, i);
                pm_bounce_series_strike(w, i, fabs(x.rate));
                pm_integral_series_mark(w, i);
            }
            ++*struck;
        }
    return PM_OK;
}

/* The last blow of an order that is known: what shares the order is over, too.  1 if there is any. */
static int end_order(const pm_workspace *w, const pm_blow *b)
{
    int any = 0;
    for (int i = 0; i < w->model->nslot && !pm_impact_one_by_one(w->model); i++) {
        const int contact = pm_contact_of_slot(w->model, i);
        if (b->share[i] != PM_STRUCK || !pm_last_bounce_ends_others(w, contact, b->approach)) continue;
        for (int other = 0; other < w->model->rows[PM_TABLE_CONTACT]; other++)
            if (pm_bounce_series_share(w, contact, other)) any = w->event->spent[other] = 1;
    }
    return any;
}

static int find_struck(pm_workspace *w, pm_blow *b, int *struck)
{
    *struck = 0;
    b->approach = b->ends_bounce = 0;
    const int status = find_touching(w, b, struck);
    return status || !end_order(w, b) ? status : find_touching(w, b, struck);
}

/* ---- blows ---- */
/* The last of a series of ever smaller blows, by how slow it is: in another pass it may have been followed by more. */
static int ends_series(const pm_workspace *w, const pm_blow *b)
{
    if (pm_impact_is_slow(w, b)) return 1;
    for (int i = 0; i < w->model->nslot; i++) {
        const int contact = pm_contact_of_slot(w->model, i);
        if (b->share[i] == PM_STRUCK && pm_contact_restitution(&w->frame, contact) > 0 &&
            pm_last_bounce_restitution(w, contact, -b->approach) == 0)
            return 1;
    }
    return 0;
}

static int one_blow(pm_workspace *w, pm_blow *b)
{
    const pm_model *m = w->model;
    int status = PM_OK;
    pm_joint_friction_release(w);
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++)
        if (b->apart[i] == PM_PARTED) b->apart[i] = PM_NOT_APART;
    for (int i = 0; i < m->nslot; i++) {
        const int captured = w->state.slot[i].mode == PM_CAPTURED;
        b->resting[i] = b->share[i] == PM_STRUCK ? PM_OPEN : w->state.slot[i].mode;
        b->trial[i] = captured ? PM_CAPTURED : pm_impact_trial_mode(&w->frame, i);
        if (captured && b->share[i] == PM_OUT) b->share[i] = PM_JOINED; /* joints take part in every blow */
    }
    if ((status = pm_impact_find(w, b))) return status;
    memcpy(b->before, w->state.v, (size_t)m->nq * sizeof *b->before);
    memcpy(w->state.v, b->after, (size_t)m->nq * sizeof *b->after);
    pm_frame_look_state(&w->frame, &w->state);
    pm_ledger_jump(w, b->before);
    pm_impact_followed_close(w, b);
    if (b->several && PM_SETTING(m, PM_SETTING_SIMULTANEOUS) == PM_SIMULTANEOUS_OPEN)
        pm_impact_order_look(w, b);
    if (w->evidence.active)
        pm_evidence_blow(&w->evidence, ends_series(w, b) ? PM_EVIDENCE_LAST_BLOW : b->approach);
    pm_impact_end_modes(w, b);
    pm_joint_friction_close(&w->frame, &w->state);
    w->result.count[PM_COUNT_JUMPS]++;
    return PM_OK;
}

/* What touches, and parts.  How many there are: they are closed, as if they rested. */
static int join_parting(pm_workspace *w, int *joined)
{
    const pm_model *m = w->model;
    pm_touch x;
    *joined = 0;
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) {
        int slot;
        if (pm_capture_kind(m, i) != PM_CAPTURE_NONE || !touches(w, i, &x) || x.stays ||
            pm_contact_modes_released(m, &w->instant, i, x.member))
            continue;
        const int status = pm_contact_modes_close(w, i, x.member, &slot);
        if (status) return status;
        ++*joined;
    }
    return PM_OK;
}

/* A blow that has failed leaves modes and shares as they were before it. */
static void take_back(pm_workspace *w, pm_blow *b)
{
    for (int i = 0; i < w->model->nslot; i++) {
        pm_slot *s = &w->state.slot[i];
        const int contact = pm_contact_of_slot(w->model, i),
                  struck = b->share[i] == PM_STRUCK || b->share[i] == PM_DROPPED;
        b->share[i] = struck ? PM_STRUCK : PM_OUT;
        s->mode = struck ? pm_contact_modes_of_slip(&w->frame, contact, s->member) : b->resting[i];
    }
    pm_frame_look_state(&w->frame, &w->state);
}

/* Where what approaches or rests allows several blows, or none, what touches and parts takes part as well: most of these blows
 * would drive it together. */
static int blow_of_all(pm_workspace *w, pm_blow *b)
{
    const pm_where none = w->result.where;
    const int failed = one_blow(w, b);
    if ((failed != PM_NOT_UNIQUE && failed != PM_BLOW_UNDECIDED) || pm_impact_one_by_one(w->model))
        return failed;
    const pm_where where = w->result.where;
    int joined;
    take_back(w, b);
    int status = join_parting(w, &joined);
    if (!status && joined > 0) {
        w->result.where = none;
        status = one_blow(w, b);
        if (!status) return status;
    }
    w->result.where = where;
    return failed;
}

/* Rough contacts that rest hold their slip, too; the other contacts join where they must. */
int pm_impact_hold(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_blow *b = w->blow;
    memset(b->share, PM_OUT, (size_t)m->nslot);
    for (int i = 0; i < m->nslot; i++)
        if (w->state.slot[i].mode != PM_OPEN &&
            pm_contact_friction(m, pm_contact_of_slot(m, i)) == PM_FRICTION_ROUGH)
            b->share[i] = PM_JOINED;
    pm_frame_look_state(&w->frame, &w->state);
    return one_blow(w, b);
}

static int shock(pm_workspace *w, pm_blow *b, int slot)
{
    memset(b->share, PM_OUT, (size_t)w->model->nslot);
    b->share[slot] = PM_JOINED;
    b->approach = b->ends_bounce = 0;
    b->shock = slot;
    pm_frame_look_state(&w->frame, &w->state);
    const int status = one_blow(w, b);
    b->shock = PM_NONE;
    for (int i = 0; i < w->model->nslot && status; i++) w->state.slot[i].mode = b->resting[i];
    return status;
}

int pm_impact_without_collision(pm_workspace *w, int jumped)
{
    const pm_model *m = w->model;
    const pm_where where = w->result.where;
    if (!jumped) w->impulses.energy_lost = 0;
    for (int i = 0; i < m->nslot; i++) {
        const int contact = pm_contact_of_slot(m, i);
        if (!pm_contact_modes_slides(w->state.slot[i].mode)) continue;
        if (PM_CONTACT_ROW(m, contact)[PM_CONTACT_PAINLEVE] != PM_PAINLEVE_STRIKES) continue;
        const int status = shock(w, w->blow, i);
        if (status != PM_PAINLEVE) return status;
    }
    w->result.where = where;
    return PM_PAINLEVE;
}

int pm_impact(pm_workspace *w, int *jumped)
{
    const pm_model *m = w->model;
    *jumped = 0;
    if (m->nslot == 0) return PM_OK;
    pm_blow *b = w->blow;
    b->series_ends = 0;
    memset(b->apart, 0, (size_t)m->rows[PM_TABLE_CONTACT]);
    for (int i = 0;; i++) {
        int struck;
        memset(b->share, PM_OUT, (size_t)m->nslot);
        if (i == 0) pm_frame_look_state(&w->frame, &w->state); /* else it does since the blow */
        int status = find_struck(w, b, &struck);
        if (status || struck == 0) return status;
        if (i == PM_BLOWS_AT_ONCE)
            return pm_fail(&w->result, PM_BLOWS_ENDLESS, PM_TABLE_CONTACT, PM_NONE, i, PM_BLOWS_AT_ONCE);
        if (*jumped == 0) w->impulses.energy_lost = 0;
        status = blow_of_all(w, b);
        if (status) return status;
        ++*jumped;
        if (pm_impact_one_by_one(w->model)) return PM_OK;
    }
}

int pm_impact_goes_on(pm_workspace *w)
{
    pm_touch x;
    if (!pm_impact_one_by_one(w->model)) return 0;
    memset(w->blow->apart, 0, (size_t)w->model->rows[PM_TABLE_CONTACT]);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++)
        if (touches(w, i, &x) && is_blow(w->model, i, &x)) return 1;
    return 0;
}
