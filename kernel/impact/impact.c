/* impact.c - restitution with all joints held.
 *
 *   M (v' - v) = H^T P,   G v' = -e (G v) at struck normals, w at joints and at tangents that hold     (17.19)
 *
 * w is what a drive prescribes, 0 elsewhere.  A tangent with a restitution of its own is left with -e_t times its slip
 * where it can be held; only while its normal rebounds: what stays in contact holds.  One contact alone with friction is
 * followed through its blow (impact_course.c).  Captured pairs are joints; one that is caught now is struck in all its rows.
 *
 * Which contacts take part: the struck ones alone first; a resting contact joins only if its pair would otherwise
 * approach; a contact whose impulse would pull drops out; repeat.  Friction in a blow: rough holds, Coulomb holds while
 * |P_t| <= mu P_n of the same blow and else slides against the slip before it.  Resting contacts that do not join carry
 * nothing, their tangents included.
 *
 * One by one (the settings may say so): the first in the order of the contacts that approaches is struck alone, then
 * again the first, a resting one as well; each is a jump of its own. */
#include "impact/impact.h"

#include <math.h>
#include <string.h>

#include "elements/capture.h"
#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/joint_friction.h"
#include "elements/trigger.h"
#include "equations/active_set.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "events/last_bounce.h"
#include "impact/contact_modes.h"
#include "impact/impact_course.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

#define PULLS 1e-11 /* of the impulses in the blow: a normal impulse this small does not pull */
#define BLOWS_AT_ONCE 64
#define GAINS 1e-10 /* of the energies that a blow turns over: rounding */
#define NOTHING \
    1e-14 /* of its impulses at the scene's speed: a blow that turns over no more is rounding itself */

enum pm_share { OUT = 0, STRUCK = 1, JOINED = 2, DROPPED = 3 };

/* An open member that touches: does it approach, is its bounce over, does it stay? */
typedef struct pm_touch {
    int member, approaches, rests, stays;
} pm_touch;

static int touches(pm_workspace *w, int contact, pm_touch *x)
{
    double rate;
    *x = (pm_touch){.stays = 1};
    if (pm_capture_is_meeting(w->model, contact))
        return pm_capture_meets(w, contact, pm_contact_gap(w, &w->state, contact, &x->member));
    if (!pm_contact_touches(w, &w->state, contact, &x->member)) return 0;
    pm_contact_member_gap(&w->frame, contact, x->member, &rate);
    if (!pm_last_bounce_is_near(w, contact, rate))
        pm_evidence_sign(w, PM_SITE_STRIKES, contact, rate, w->numbers.speed);
    x->approaches = rate < -pm_contact_speed(&w->frame);
    x->rests = pm_last_bounce_is_spent(w, contact, rate);
    x->stays = rate <= pm_contact_speed(&w->frame) &&
               (x->approaches || !pm_contact_modes_released(w, contact, x->member));
    return 1;
}

static int one_by_one(const pm_workspace *w)
{
    return PM_SETTING(w->model, PM_SETTING_SIMULTANEOUS) == PM_SIMULTANEOUS_ONE_BY_ONE;
}

/* What captures strikes with any velocity. */
static int is_blow(const pm_workspace *w, int contact, const pm_touch *x)
{
    return x->approaches || (x->stays && pm_capture_kind(w->model, contact) != PM_CAPTURE_NONE);
}

/* Closes the open members that touch and do not part: what approaches is struck (its slot is marked STRUCK; one by one
 * the first alone), and what is caught with any velocity; what is still rests, so that it can join the blow; at the start
 * nothing is closed yet. */
static int find_struck(pm_workspace *w, unsigned char *share, int *struck)
{
    const pm_model *m = w->model;
    pm_touch x;
    *struck = 0;
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++)
        for (int n = 0; n < pm_contact_slots(m, i) && touches(w, i, &x) && (x.rests || x.stays); n++) {
            int slot;
            if (is_blow(w, i, &x) && *struck > 0 && one_by_one(w)) break;
            const int status = pm_contact_modes_close(w, i, x.member, &slot);
            if (status) return status;
            if (w->state.slot[slot].mode == PM_CAPTURED)
                x.approaches = pm_capture_speed(w, slot) > pm_contact_speed(&w->frame);
            if (!x.approaches && !x.rests) continue;
            share[slot] = STRUCK;
            if (x.approaches) pm_trigger_mark(w, PM_TRIGGER_STRIKE, i);
            ++*struck;
        }
    return PM_OK;
}

/* Rows of this trial: modes of the contacts that take part; the others are open for the blow. */
static int build(pm_workspace *w, const unsigned char *share, const int32_t *trial)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->nslot; i++)
        w->state.slot[i].mode = share[i] == STRUCK || share[i] == JOINED ? trial[i] : PM_OPEN;
    pm_frame_look_state(&w->frame, &w->state);
    const int status = pm_active_set_build(w);
    if (!status && !w->active.evaluated) pm_saddle_rows(w);
    return status;
}

static double rate_before(const pm_workspace *w, int i)
{
    return pm_saddle_times(&w->frame, &w->active.row[i], w->state.v) - w->active.row[i].rate;
}

static int is_normal(const pm_workspace *w, int i)
{
    return w->active.row[i].slot != PM_NONE && w->active.slot_normal[w->active.row[i].slot] == i;
}

/* How much the rate of active row i is to change. */
static double change_wanted(const pm_workspace *w, const unsigned char *share, int i)
{
    const int slot = w->active.row[i].slot;
    const double u = rate_before(w, i);
    if (slot == PM_NONE || share[slot] != STRUCK || w->active.slot_normal[slot] == PM_NONE) return -u;
    const double e = pm_last_bounce_restitution(w, pm_contact_of_slot(w->model, slot),
                                                rate_before(w, w->active.slot_normal[slot]));
    if (is_normal(w, i)) return -(1 + e) * u;
    return e > 0 ? -(1 + pm_contact_tangential(&w->frame, pm_contact_of_slot(w->model, slot))) * u : -u;
}

/* Impulses (w->rhs) and the velocities after the blow; `alone`: the end of a blow that was followed, or NULL. */
static int solve(pm_workspace *w, const unsigned char *share, const pm_impact_course_end *alone,
                 double *after)
{
    const int nq = w->model->nq;
    memcpy(after, w->state.v, (size_t)nq * sizeof *after);
    if (w->active.n == 0) return PM_OK;
    for (int i = 0; i < w->active.n; i++)
        w->saddle.wanted[i] =
            alone && is_normal(w, i) ? alone->normal - rate_before(w, i) : change_wanted(w, share, i);
    int status = pm_saddle_factor(w);
    if (status || (status = pm_saddle_respond(w, NULL, after))) return status;
    for (int i = 0; i < nq; i++) after[i] += w->state.v[i];
    return PM_OK;
}

/* The slot that takes part alone and whose blow is to be followed, else PM_NONE; a law for one contact is refused where
 * several take part.  Pairs that were captured before are joints. */
static int find_alone(pm_workspace *w, const unsigned char *share, const int32_t *trial, int *alone)
{
    int n = 0, single = PM_NONE;
    *alone = PM_NONE;
    for (int i = 0; i < w->model->nslot; i++) {
        if (share[i] != STRUCK && (share[i] != JOINED || trial[i] == PM_CAPTURED)) continue;
        const int contact = pm_contact_of_slot(w->model, i);
        if (pm_contact_law(w->model, contact) != PM_LAW_NEWTON) single = contact;
        if (pm_impact_course_applies(w, i)) *alone = i;
        n++;
    }
    if (n == 1) return PM_OK;
    *alone = PM_NONE;
    return single == PM_NONE ? PM_OK : pm_fail(w, PM_BLOW_SEVERAL, PM_TABLE_CONTACT, single, n, 1);
}

/* Follows the blow of one contact and leaves its rows as build does. */
static int follow_alone(pm_workspace *w, unsigned char *share, const int32_t *trial, int slot,
                        double *scratch, pm_impact_course_end *end)
{
    const int contact = pm_contact_of_slot(w->model, slot);
    const unsigned char part = share[slot];
    pm_impact_course x;
    share[slot] = OUT;
    int status = build(w, share, trial);
    if (!status) status = pm_impact_course_read(w, slot, scratch, &x);
    share[slot] = part;
    if (status) return status;
    x.restitution =
        part == STRUCK ? pm_last_bounce_restitution(w, contact, x.normal) : 0; /* what rests is pressed on */
    const int ends = pm_impact_course_follow(&x, end);
    pm_evidence_sign(w, PM_SITE_SLIP_LEFT, slot, end->slip, w->numbers.speed);
    if (!ends) return pm_fail(w, PM_BLOW_UNDECIDED, PM_TABLE_CONTACT, contact, x.normal, 0);
    w->state.slot[slot].mode = PM_SLIDE_FORWARD;
    if ((status = pm_active_set_build(w))) return status;
    if (w->active.slot_normal[slot] == PM_NONE)
        return pm_fail(w, PM_SINGULAR, PM_TABLE_CONTACT, contact, 0, 0);
    pm_active_set_carry(w, slot, end->ratio);
    pm_saddle_rows(w);
    return PM_OK;
}

static double impulse_size(const pm_workspace *w)
{
    double size = 0;
    for (int i = 0; i < w->active.n; i++) size = fmax(size, fabs(w->saddle.rhs[i]));
    return size;
}

static int drop_pulling(pm_workspace *w, unsigned char *share)
{
    int worst = PM_NONE;
    const double size = impulse_size(w);
    double least = -PULLS * size;
    for (int i = 0; i < w->model->nslot; i++) {
        if (w->active.slot_normal[i] == PM_NONE) continue;
        pm_evidence_sign(w, PM_SITE_PULLS_IN_BLOW, i, w->saddle.rhs[w->active.slot_normal[i]], size);
        if (w->saddle.rhs[w->active.slot_normal[i]] >= least) continue;
        if (w->event->spent[pm_contact_of_slot(w->model, i)]) continue;
        least = w->saddle.rhs[w->active.slot_normal[i]];
        worst = i;
    }
    if (worst != PM_NONE) share[worst] = DROPPED;
    return worst != PM_NONE;
}

static int slide_where_it_must(pm_workspace *w, int32_t *trial)
{
    for (int i = 0; i < w->model->nslot; i++) {
        const int contact = pm_contact_of_slot(w->model, i);
        if (w->active.slot_tangent[i] == PM_NONE || w->active.slot_normal[i] == PM_NONE) continue;
        if (pm_contact_friction(w->model, contact) != PM_FRICTION_COULOMB) continue;
        const double friction = w->saddle.rhs[w->active.slot_tangent[i]], size = impulse_size(w);
        const double room =
            pm_contact_static(&w->frame, contact) * w->saddle.rhs[w->active.slot_normal[i]] - fabs(friction);
        pm_evidence_sign(w, PM_SITE_SLIDES_IN_BLOW, i, room, size);
        if (room >= -PULLS * size) continue;
        const double slip = pm_contact_member_slip(&w->frame, contact, w->state.slot[i].member);
        const int forward = fabs(slip) > pm_contact_speed(&w->frame) ? slip > 0 : friction < 0;
        trial[i] = forward ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
        return 1;
    }
    return 0;
}

static int32_t mode_in_blow(const pm_workspace *w, int slot)
{
    const int smooth =
        pm_contact_friction(w->model, pm_contact_of_slot(w->model, slot)) == PM_FRICTION_SMOOTH;
    return smooth ? PM_SMOOTH : PM_STICK;
}

/* A resting contact whose pair would approach joins. */
static int join_approaching(pm_workspace *w, unsigned char *share, const int32_t *resting, int32_t *trial,
                            const double *after)
{
    for (int i = 0; i < w->model->nslot; i++) {
        if (share[i] != OUT || resting[i] == PM_OPEN) continue;
        pm_constraint normal, tangent;
        const int contact = pm_contact_of_slot(w->model, i);
        pm_contact_constraint_both(&w->frame, contact, i, w->state.slot[i].member, &normal, &tangent);
        pm_constraint_kind(normal.kind)->evaluate(&w->frame, &normal);
        const double rate = pm_saddle_times(&w->frame, &normal, after);
        pm_evidence_sign(w, PM_SITE_JOINS, i, rate, w->numbers.speed);
        if (rate >= -pm_contact_speed(&w->frame)) continue;
        share[i] = JOINED;
        trial[i] = mode_in_blow(w, i);
        return 1;
    }
    return 0;
}

/* Of a captured pair, along the axes of the scene. */
static void record_captured(pm_workspace *w, int slot)
{
    static const double axes[4] = {1, 0, 0, 1};
    memcpy(w->impulses.slot_direction + 4 * slot, axes, sizeof axes);
    for (int k = 0; k < 2; k++) {
        const int active = w->active.slot_held[PM_JOINT_CONSTRAINTS * slot + k];
        if (active != PM_NONE) w->impulses.slot[2 * slot + k] = w->saddle.rhs[active];
    }
}

/* The tangential row of a slot: the active one, which is evaluated here, or else *spare, which is not. */
static const pm_constraint *tangent_of(const pm_workspace *w, int slot, pm_constraint *spare)
{
    pm_constraint normal;
    if (w->active.slot_tangent[slot] != PM_NONE) return &w->active.row[w->active.slot_tangent[slot]];
    pm_contact_constraint_both(&w->frame, pm_contact_of_slot(w->model, slot), slot,
                               w->state.slot[slot].member, &normal, spare);
    return spare;
}

static void record(pm_workspace *w)
{
    const pm_model *m = w->model;
    memset(w->impulses.joint, 0, (size_t)m->njoint_row * sizeof(double));
    memset(w->impulses.slot, 0, 2 * (size_t)m->nslot * sizeof(double));
    for (int i = 0; i < m->njoint_row; i++)
        if (w->active.of_joint[i] != PM_NONE) w->impulses.joint[i] = w->saddle.rhs[w->active.of_joint[i]];
    for (int i = 0; i < m->nslot; i++) {
        if (w->state.slot[i].mode == PM_CAPTURED) record_captured(w, i);
        if (w->active.slot_normal[i] == PM_NONE) continue;
        pm_constraint spare;
        pm_line_of_action along;
        const pm_constraint *normal = &w->active.row[w->active.slot_normal[i]],
                            *tangent = tangent_of(w, i, &spare);
        const double p = w->saddle.rhs[w->active.slot_normal[i]];
        w->impulses.slot[2 * i] = p;
        w->impulses.slot[2 * i + 1] = w->active.slot_tangent[i] != PM_NONE
                                          ? w->saddle.rhs[w->active.slot_tangent[i]]
                                          : normal->slide * p;
        pm_constraint_kind(normal->kind)->act(&w->frame, normal, &along);
        memcpy(w->impulses.slot_direction + 4 * i, along.direction, sizeof along.direction);
        pm_constraint_kind(tangent->kind)->act(&w->frame, tangent, &along);
        memcpy(w->impulses.slot_direction + 4 * i + 2, along.direction, sizeof along.direction);
    }
}

static int slid(const pm_workspace *w, int slot, const double *v)
{
    pm_constraint spare;
    const pm_constraint *tangent = tangent_of(w, slot, &spare);
    if (tangent == &spare) pm_constraint_kind(spare.kind)->evaluate(&w->frame, &spare);
    return fabs(pm_saddle_times(&w->frame, tangent, v) - tangent->rate) > pm_contact_speed(&w->frame);
}

/* Modes after the blow: what parts is open; what stays is closed with the friction its slip asks for.  A struck contact
 * that slid and stays without slip sticks from the blow on. */
static void set_modes(pm_workspace *w, const unsigned char *share, const int32_t *resting,
                      const double *before)
{
    for (int i = 0; i < w->model->nslot; i++) {
        const int contact = pm_contact_of_slot(w->model, i), member = w->state.slot[i].member;
        double rate;
        if (w->state.slot[i].mode == PM_CAPTURED) continue;
        w->state.slot[i].mode = PM_OPEN;
        if (share[i] == OUT && resting[i] == PM_OPEN) continue;
        pm_contact_member_gap(&w->frame, contact, member, &rate);
        if (fabs(rate) > pm_contact_speed(&w->frame))
            continue; /* parts, or is struck again by the next blow */
        w->state.slot[i].mode = pm_contact_modes_of_slip(w, contact, member);
        const int closed_here =
            share[i] == STRUCK && w->state.slot[i].mode != PM_CAPTURED; /* anchored then */
        if (!closed_here && (share[i] != OUT || w->state.slot[i].mode != resting[i]))
            pm_active_set_anchor(w, &w->state, i);
        if (share[i] == STRUCK && pm_contact_restitution(&w->frame, contact) > 0) {
            pm_trigger_countless(w, contact);
            pm_evidence_part(w, contact);
            pm_evidence_cut(w);
        }
        if (share[i] == STRUCK && w->state.slot[i].mode == PM_STICK && slid(w, i, before))
            pm_trigger_mark(w, PM_TRIGGER_STICK, contact);
    }
}

/* Friction and restitution together may ask for more than the approach has: that is no blow.  The energy that contacts
 * give, sum P (u + u')/2 relative to what drives prescribe. */
static int gains(pm_workspace *w, const double *after)
{
    double given = 0, size = 0, nothing = 0;
    int contact = PM_NONE;
    for (int i = 0; i < w->active.n || w->active.row[i].normal != PM_NONE; i++) {
        const pm_constraint *row = &w->active.row[i];
        if (row->slot == PM_NONE || w->active.slot_normal[row->slot] == PM_NONE)
            continue; /* captured: a joint */
        const double p = i < w->active.n ? w->saddle.rhs[i]
                                         : w->active.row[row->normal].slide * w->saddle.rhs[row->normal];
        const double before = rate_before(w, i), now = pm_saddle_times(&w->frame, row, after) - row->rate;
        given += 0.5 * p * (before + now);
        size += fabs(p * before) + fabs(p * now);
        nothing += NOTHING * fabs(p) * w->numbers.speed;
        contact = pm_contact_of_slot(w->model, row->slot);
    }
    return given <= GAINS * size + nothing ? PM_OK
                                           : pm_fail(w, PM_BLOW_GAINS, PM_TABLE_CONTACT, contact, given, 0);
}

/* Several contacts that slide in one blow slide as they did before it: for a slip that would turn on the way there is no
 * law of all together. */
static int turns(pm_workspace *w, const unsigned char *share, const int32_t *trial, const double *after)
{
    for (int i = 0; i < w->model->nslot; i++) {
        const int takes_part = share[i] == STRUCK || share[i] == JOINED;
        if (!takes_part || (trial[i] != PM_SLIDE_FORWARD && trial[i] != PM_SLIDE_BACKWARD)) continue;
        pm_constraint normal, tangent;
        const int contact = pm_contact_of_slot(w->model, i);
        pm_contact_constraint_both(&w->frame, contact, i, w->state.slot[i].member, &normal, &tangent);
        pm_constraint_kind(tangent.kind)->evaluate(&w->frame, &tangent);
        const double way = trial[i] == PM_SLIDE_FORWARD ? 1 : -1;
        const double slip = way * (pm_saddle_times(&w->frame, &tangent, after) - tangent.rate);
        pm_evidence_sign(w, PM_SITE_SLIP_LEFT, i, slip, w->numbers.speed);
        if (slip < -pm_contact_speed(&w->frame))
            return pm_fail(w, PM_BLOW_TURNS, PM_TABLE_CONTACT, contact, -slip, 0);
    }
    return PM_OK;
}

static int one_blow(pm_workspace *w, unsigned char *share, double *scratch)
{
    const pm_model *m = w->model;
    double *after = scratch;
    pm_joint_friction_release(w);
    int32_t *resting = (int32_t *)(void *)(scratch + m->nq), *trial = resting + m->nslot;
    int status = PM_OK, again = 1, alone = PM_NONE;
    for (int i = 0; i < m->nslot; i++) {
        const int captured = w->state.slot[i].mode == PM_CAPTURED;
        resting[i] = share[i] == STRUCK ? PM_OPEN : w->state.slot[i].mode;
        trial[i] = captured ? PM_CAPTURED : mode_in_blow(w, i);
        if (captured && share[i] == OUT) share[i] = JOINED; /* joints take part in every blow */
    }
    const int most = 4 * m->nslot + 4;
    for (int i = 0; again; i++) {
        if (i == most) return pm_fail(w, PM_BLOW_UNDECIDED, PM_TABLE_CONTACT, PM_NONE, most, most);
        pm_impact_course_end end;
        if ((status = find_alone(w, share, trial, &alone))) return status;
        if (alone != PM_NONE)
            status = follow_alone(w, share, trial, alone, scratch + 3 * (m->nq + m->nslot), &end);
        else
            status = build(w, share, trial);
        if (status || (status = solve(w, share, alone != PM_NONE ? &end : NULL, after))) return status;
        again = drop_pulling(w, share) || slide_where_it_must(w, trial) ||
                (!one_by_one(w) && join_approaching(w, share, resting, trial, after));
    }
    if (alone == PM_NONE && (status = turns(w, share, trial, after))) return status;
    if ((status = gains(w, after)) || (status = pm_joint_friction_check_blow(w))) return status;
    record(w);
    double *before = after + m->nq + m->nslot; /* behind resting and trial */
    memcpy(before, w->state.v, (size_t)m->nq * sizeof *before);
    memcpy(w->state.v, after, (size_t)m->nq * sizeof *after);
    pm_frame_look_state(&w->frame, &w->state);
    pm_ledger_jump(w, before);
    set_modes(w, share, resting, before);
    pm_joint_friction_close(w);
    w->result.count[PM_COUNT_JUMPS]++;
    return PM_OK;
}

/* Rough contacts that rest hold their slip, too; the other contacts join where they must. */
int pm_impact_hold(pm_workspace *w)
{
    const pm_model *m = w->model;
    unsigned char *share = (unsigned char *)(void *)(w->scratch + 2 * m->nq + 2 * m->nslot);
    memset(share, OUT, (size_t)m->nslot);
    for (int i = 0; i < m->nslot; i++)
        if (w->state.slot[i].mode != PM_OPEN &&
            pm_contact_friction(m, pm_contact_of_slot(m, i)) == PM_FRICTION_ROUGH)
            share[i] = JOINED;
    pm_frame_look_state(&w->frame, &w->state);
    return one_blow(w, share, w->scratch);
}

int pm_impact(pm_workspace *w, int *jumped)
{
    const pm_model *m = w->model;
    *jumped = 0;
    if (m->nslot == 0) return PM_OK;
    double *scratch = w->scratch;
    unsigned char *share = (unsigned char *)(void *)(scratch + 2 * m->nq + 2 * m->nslot);
    for (int i = 0;; i++) {
        int struck;
        memset(share, OUT, (size_t)m->nslot);
        pm_frame_look_state(&w->frame, &w->state);
        int status = find_struck(w, share, &struck);
        if (status || struck == 0) return status;
        if (i == BLOWS_AT_ONCE)
            return pm_fail(w, PM_BLOW_UNDECIDED, PM_TABLE_CONTACT, PM_NONE, i, BLOWS_AT_ONCE);
        if (*jumped == 0) w->impulses.energy_lost = 0;
        status = one_blow(w, share, scratch);
        if (status) return status;
        ++*jumped;
        if (one_by_one(w)) return PM_OK;
    }
}

int pm_impact_goes_on(pm_workspace *w)
{
    pm_touch x;
    for (int i = 0; one_by_one(w) && i < w->model->rows[PM_TABLE_CONTACT]; i++)
        if (touches(w, i, &x) && is_blow(w, i, &x)) return 1;
    return 0;
}
