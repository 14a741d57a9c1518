/* action.c - actions of events, carried out in order at an instant.
 *
 *   M (v' - v) = P + G^T L,   G v' = w    P applied impulses, L impulses of all that holds        (17.14, 17.17)
 *   J (omega + omega') / 2 = W            an angular impulse J on a body and the work that it does
 *
 * What an impulse does is seen after the constraints have answered it: impulses that follow each other act at once, and a joint
 * that is added meets velocities that clash with it in a plastic blow. */
#include "impact/action.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/force.h"
#include "elements/joint_friction.h"
#include "elements/trigger.h"
#include "equations/active_set.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "expression/program.h"
#include "impact/impact.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"
#include "state/workspace.h"

int pm_action_of(const pm_model *m, int event)
{
    for (int i = 0; i < m->rows[PM_TABLE_ACTION]; i++)
        if (PM_ACTION_ROW(m, i)[PM_ACTION_EVENT] == event) return 1;
    return 0;
}

void pm_action_instant(const pm_model *model, struct pm_event_set *event)
{
    memset(event->acted, 0, (size_t)model->rows[PM_TABLE_EVENT]);
}

/* ---- impulses ---- */
static double number(pm_workspace *w, int program) { return pm_program_run(w, program); }

static void add_impulse(pm_workspace *w, int body, const double at[2], const double force[2], double couple)
{
    if (body == w->model->nbody) return;
    const double *pose = w->frame.pose + 5 * body;
    const double arm[2] = {at[0] - pose[0], at[1] - pose[1]};
    double *p = w->impulses.applied + 3 * body;
    p[0] += force[0];
    p[1] += force[1];
    p[2] += couple + pm_cross(arm, force);
    pm_ledger_impulse(w->model, &w->state, at, force, couple);
}

static void collect(pm_workspace *w, const int32_t *e)
{
    static const double nothing[2] = {0, 0};
    const double x = number(w, e[PM_ACTION_PROGRAM_X]);
    if (e[PM_ACTION_KIND] == PM_ACTION_ANGULAR) {
        add_impulse(w, e[PM_ACTION_A], nothing, nothing, x);
        return;
    }
    const pm_point at = pm_frame_point_of(&w->frame, e[PM_ACTION_A]);
    const double force[2] = {x, number(w, e[PM_ACTION_PROGRAM_Y])};
    add_impulse(w, at.body, at.p, force, 0);
}

/* Work of the impulses at the present velocities. */
static double work_now(const pm_workspace *w)
{
    double sum = 0;
    for (int i = 0; i < w->model->nq; i++) sum += w->impulses.applied[i] * w->state.v[i];
    return sum;
}

/* An impulse on what has no mass is not computed: the first body that it is on, else PM_NONE. */
static int struck_without_mass(const pm_workspace *w)
{
    for (int i = 0; i < w->model->nq; i++)
        if (w->numbers.stand_in[i] > 0 && w->impulses.applied[i] != 0) return i / 3;
    return PM_NONE;
}

/* The collected impulses act and all that holds answers.  The ledger takes both one after the other; lost is what the
 * velocities before and after leave over. */
static int strike(pm_workspace *w)
{
    const double kinetic = pm_frame_kinetic(&w->frame, PM_NONE), before = work_now(w);
    const int light = struck_without_mass(w);
    if (light != PM_NONE) return pm_fail(&w->result, PM_UNSUPPORTED, PM_TABLE_BODY, light, NAN, NAN);
    for (int i = 0; i < w->model->nq; i++)
        w->state.v[i] += w->numbers.inverse_mass[i] * w->impulses.applied[i];
    w->ledger.energy_lost -= 0.5 * (before + work_now(w));
    w->impulses.energy_lost = 0;
    const int status = pm_impact_hold(w);
    w->impulses.energy_lost = kinetic + 0.5 * (before + work_now(w)) - pm_frame_kinetic(&w->frame, PM_NONE);
    return status;
}

static void no_impulse(const pm_model *model, pm_impulses *impulses)
{
    memset(impulses->applied, 0, (size_t)model->nq * sizeof(double));
}

static int strike_together(pm_workspace *w, int first, int last)
{
    no_impulse(w->model, &w->impulses);
    for (int i = first; i < last; i++) collect(w, PM_ACTION_ROW(w->model, i));
    return strike(w);
}

/* ---- work ---- */
/* The impulse whose mean spin does the work W where the spin changes by c per impulse; not a number if there is none that
 * keeps the sense of rotation. */
static double impulse_for(double work, double spin, double c)
{
    return 2 * work / (spin + copysign(sqrt(spin * spin + 2 * c * work), spin));
}

/* The first try shows how the spin answers. */
static int do_work(pm_workspace *w, int i)
{
    static const double nothing[2] = {0, 0};
    const int32_t *e = PM_ACTION_ROW(w->model, i);
    const int body = e[PM_ACTION_A], angle = 3 * body + 2;
    const double work = number(w, e[PM_ACTION_PROGRAM_X]), spin = w->state.v[angle],
                 lost = w->ledger.energy_lost;
    const int64_t jumps = w->result.count[PM_COUNT_JUMPS];
    double couple = work / spin, done = 0;
    if (work == 0) return PM_OK;
    if (fabs(spin) * w->numbers.size <= pm_contact_speed(&w->frame))
        return pm_fail(&w->result, PM_NO_IMPULSE, PM_TABLE_ACTION, i, work, 0);
    pm_state_copy(&w->ahead, &w->state);
    for (int k = 0; k < PM_ACTION_FITS; k++) {
        no_impulse(w->model, &w->impulses);
        add_impulse(w, body, nothing, nothing, couple);
        const int status = strike(w);
        done = 0.5 * couple * (spin + w->state.v[angle]);
        if (status || fabs(done - work) <= PM_ACTION_FITTED * fabs(work)) return status;
        const double c = (w->state.v[angle] - spin) / couple;
        couple = impulse_for(work, spin, c);
        if (!isfinite(couple))
            return pm_fail(&w->result, PM_NO_IMPULSE, PM_TABLE_ACTION, i, work, -0.5 * spin * spin / c);
        pm_state_copy(&w->state, &w->ahead);
        pm_frame_look_state(&w->frame, &w->state);
        w->ledger.energy_lost = lost;
        w->result.count[PM_COUNT_JUMPS] = jumps;
    }
    return pm_fail(&w->result, PM_NO_IMPULSE, PM_TABLE_ACTION, i, work, done);
}

/* ---- what comes and goes ---- */
static void count_energy(pm_workspace *w, int force, double sign)
{
    const double energy = sign * pm_force_action(w, force).energy;
    w->ledger.energy_lost -= energy;
    w->ledger.force_energy_start[force] += energy;
}

static void let_slots_go(const pm_model *model, pm_state *state, int contact)
{
    const int first = model->contact_slot[contact];
    for (int i = first; i < first + pm_contact_slots(model, contact); i++) state->slot[i].mode = PM_OPEN;
}

/* A joint holds from here on: it must be closed here. */
static int fits(pm_workspace *w, int i, int joint)
{
    pm_constraint c[PM_JOINT_CONSTRAINTS];
    pm_active_set_anchor_joint(&w->frame, &w->state, &w->state, joint);
    const int n = pm_joint_constraints(&w->frame, &w->state, joint, c);
    const double allowed = PM_ACTION_OPENING * w->numbers.size;
    for (int k = 0; k < n; k++) {
        pm_constraint_kind(c[k].kind)->evaluate(&w->frame, &c[k]);
        const double open = fabs(c[k].g) * (pm_constraint_is_angle(&c[k]) ? w->numbers.size : 1);
        if (!(open <= allowed)) return pm_fail(&w->result, PM_ASSEMBLY, PM_TABLE_ACTION, i, open, allowed);
    }
    return PM_OK;
}

static int add(pm_workspace *w, int i)
{
    const int32_t *e = PM_ACTION_ROW(w->model, i);
    const int table = e[PM_ACTION_TABLE], a = e[PM_ACTION_A];
    unsigned char *absent = &w->state.absent[pm_model_element(w->model, table, a)];
    if (!*absent) return PM_OK;
    *absent = 0;
    if (table == PM_TABLE_FORCE) count_energy(w, a, 1);
    if (table == PM_TABLE_JOINT) return fits(w, i, a);
    if (table != PM_TABLE_CONTACT) return PM_OK;
    int member;
    const double gap = pm_contact_gap(&w->frame, &w->state, a, &member),
                 least = -PM_ACTION_OPENING * w->numbers.size;
    return gap < least ? pm_fail(&w->result, PM_PENETRATION, PM_TABLE_ACTION, i, gap, least) : PM_OK;
}

static int take_away(pm_workspace *w, int i)
{
    const int32_t *e = PM_ACTION_ROW(w->model, i);
    const int table = e[PM_ACTION_TABLE], a = e[PM_ACTION_A];
    unsigned char *absent = &w->state.absent[pm_model_element(w->model, table, a)];
    if (*absent) return PM_OK;
    if (table == PM_TABLE_FORCE) count_energy(w, a, -1);
    if (table == PM_TABLE_CONTACT) let_slots_go(w->model, &w->state, a);
    *absent = 1;
    return PM_OK;
}

/* Whether some constraint of what holds now contradicts the velocities. */
static int clash(pm_workspace *w, int *clashes)
{
    const int status = pm_active_set_build(w);
    *clashes = 0;
    pm_saddle_evaluate(&w->active, &w->frame);
    for (int i = 0; !status && i < w->active.n; i++) {
        const pm_constraint *c = &w->active.constraint[i];
        const double length = pm_constraint_is_angle(c) ? w->numbers.size : 1;
        const double rate = pm_constraint_times(&w->frame, c, w->state.v) - c->rate;
        *clashes |= fabs(rate) * length > pm_contact_speed(&w->frame);
    }
    return status;
}

static int add_elements(pm_workspace *w, int first, int last)
{
    int clashes = 0, status = PM_OK;
    for (int i = first; !status && i < last; i++) status = add(w, i);
    if (!status) status = clash(w, &clashes);
    pm_joint_friction_close(&w->frame, &w->state);
    no_impulse(w->model, &w->impulses);
    return status || !clashes ? status : strike(w);
}

/* ---- perturbations ---- */
/* It waits for the next phase; PM_UNSUPPORTED if another one does. */
static int request_perturbation(pm_workspace *w, int i)
{
    if (w->request.program != PM_NONE)
        return pm_fail(&w->result, PM_UNSUPPORTED, PM_TABLE_ACTION, i, NAN, NAN);
    w->request = (pm_request){PM_ACTION_ROW(w->model, i)[PM_ACTION_PROGRAM_X], PM_TABLE_ACTION, i};
    return PM_OK;
}

/* ---- in order ---- */
static int is_impulse(int kind) { return kind == PM_ACTION_IMPULSE || kind == PM_ACTION_ANGULAR; }

/* Each work is fitted by itself, each perturbation is one of its own. */
static int acts_with_others(int kind) { return kind != PM_ACTION_WORK && kind != PM_ACTION_NUDGE; }

/* Where the actions end that go together with the first one. */
static int end_of_group(const pm_model *m, int first)
{
    const int32_t *e = PM_ACTION_ROW(m, first);
    const int kind = e[PM_ACTION_KIND];
    int i = first + 1;
    for (; i < m->rows[PM_TABLE_ACTION] && acts_with_others(kind); i++) {
        const int32_t *next = PM_ACTION_ROW(m, i);
        const int alike =
            next[PM_ACTION_KIND] == kind || (is_impulse(kind) && is_impulse(next[PM_ACTION_KIND]));
        if (!alike || next[PM_ACTION_EVENT] != e[PM_ACTION_EVENT]) break;
    }
    return i;
}

static int carry_out_group(pm_workspace *w, int first, int last)
{
    int status = PM_OK;
    pm_frame_look_state(&w->frame, &w->state);
    switch ((enum pm_action_kind)PM_ACTION_ROW(w->model, first)[PM_ACTION_KIND]) {
    case PM_ACTION_ADD: return add_elements(w, first, last);
    case PM_ACTION_REMOVE:
        for (int i = first; !status && i < last; i++) status = take_away(w, i);
        pm_joint_friction_close(&w->frame, &w->state);
        return status;
    case PM_ACTION_IMPULSE:
    case PM_ACTION_ANGULAR: return strike_together(w, first, last);
    case PM_ACTION_WORK: return do_work(w, first);
    case PM_ACTION_NUDGE: return request_perturbation(w, first);
    case PM_ACTION_KINDS: break;
    }
    return status;
}

static int act(pm_workspace *w, int event)
{
    const pm_model *m = w->model;
    int status = PM_OK;
    for (int i = 0, last; !status && i < m->rows[PM_TABLE_ACTION]; i = last) {
        last = end_of_group(m, i);
        if (PM_ACTION_ROW(m, i)[PM_ACTION_EVENT] == event) status = carry_out_group(w, i, last);
    }
    return status;
}

int pm_action_carry_out(pm_workspace *w, int *acted)
{
    const pm_model *m = w->model;
    int status = PM_OK;
    *acted = 0;
    for (int event = 0; !status && event < m->rows[PM_TABLE_EVENT]; event++) {
        if (w->event->acted[event] || !pm_action_of(m, event) ||
            !pm_trigger_fires(w->model, &w->firing, event))
            continue;
        w->event->acted[event] = 1;
        *acted = 1;
        status = act(w, event);
    }
    return status;
}
