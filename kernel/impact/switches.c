/* switches.c - on which side of a switch, and on which piece of a table or of a curve, a phase begins, by a state a little
 * ahead. */
#include "impact/switches.h"

#include <math.h>

#include "elements/constraint.h"
#include "elements/contact_curve.h"
#include "elements/curve_piece.h"
#include "elements/joint.h"
#include "elements/trigger.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "expression/piecewise.h"
#include "expression/program.h"
#include "numerics/tolerances.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"

/* The event of a trigger that tells where a switch becomes positive; PM_NONE: it is another one. */
static int switch_of(const pm_model *m, int trigger)
{
    const int32_t *e = PM_TRIGGER_ROW(m, trigger);
    return e[PM_TRIGGER_KIND] == PM_TRIGGER_RISE && pm_trigger_of_switch(m, trigger) ? e[PM_TRIGGER_EVENT]
                                                                                     : PM_NONE;
}

/* The frame looks a little later, by its accelerations. */
static void go_ahead(pm_workspace *w)
{
    const double after = PM_SWITCH_LOOK * w->numbers.size / w->numbers.speed;
    pm_state_copy(&w->probe, &w->state);
    w->probe.t += after;
    for (int i = 0; i < w->model->nq; i++) {
        w->probe.q[i] += after * (w->state.v[i] + 0.5 * after * w->frame.a[i]);
        w->probe.v[i] += after * w->frame.a[i];
    }
    pm_frame_look_state(&w->frame, &w->probe);
}

static int come_back(pm_workspace *w)
{
    pm_frame_look_state(&w->frame, &w->state);
    return pm_saddle_accelerate(w);
}

/* The value of a program there. */
static int look_ahead(pm_workspace *w, int program, double *value)
{
    go_ahead(w);
    *value = pm_program_run(w, program);
    return come_back(w);
}

static int side_of(double x) { return x > 0; }

/* The side to which the motion leads is kept if the force on it leads there, too. */
static int settle(pm_workspace *w, int trigger, int event)
{
    const int program = PM_TRIGGER_ROW(w->model, trigger)[PM_TRIGGER_PROGRAM];
    const double here = pm_trigger_program(w, trigger);
    double ahead, otherwise;
    int status = look_ahead(w, program, &ahead);
    if (status || fabs(here) > PM_SWITCH_ON_ZERO * fabs(ahead - here) || ahead == here) return status;
    if (side_of(ahead) == w->firing.side[event]) return PM_OK;
    w->firing.side[event] = !w->firing.side[event];
    if ((status = pm_saddle_accelerate(w)) || (status = look_ahead(w, program, &otherwise))) return status;
    if (side_of(otherwise) == w->firing.side[event] || otherwise == here) return PM_OK;
    return pm_fail(&w->result, PM_ALTERNATES, PM_TABLE_EVENT, event, 1, 1);
}

/* The piece of a table into which the motion leads: what tables give is continuous, or jumps at a place alone. */
static int settle_piece(pm_workspace *w, int reading, int goes_on)
{
    const int32_t *e = PM_READING_ROW(w->model, reading);
    const pm_piecewise p = pm_piecewise_of(w->model, e[PM_READING_TABLE]);
    double *piece = &w->firing.side[e[PM_READING_EVENT]], ahead;
    const double here = pm_trigger_argument(w, reading), before = *piece;
    int status = look_ahead(w, e[PM_READING_PROGRAM], &ahead);
    if (status) return status;
    const double nothing = fmax(PM_SWITCH_ON_ZERO * fabs(ahead - here), PM_ON_ZERO * fabs(here));
    const double there = pm_piecewise_number_ahead(&p, here, ahead - here, nothing, before);
    if (!goes_on && p.beyond == PM_BEYOND_NONE && (there < 0 || there >= p.pieces)) return PM_OK;
    *piece = there;
    return *piece == before ? PM_OK : pm_saddle_accelerate(w);
}

/* ---- pieces of curves ---- */
/* The piece of its curve into which the motion leads the foot of a constraint. */
static int settle_foot(pm_workspace *w, const pm_constraint *c)
{
    const double here = pm_constraint_curve_foot(&w->frame, c);
    go_ahead(w);
    const double ahead = pm_constraint_curve_foot(&w->frame, c), way = isfinite(ahead) ? ahead - here : 0;
    pm_frame_look_state(&w->frame, &w->state);
    const double nothing = fmax(PM_SWITCH_ON_ZERO * fabs(way), PM_ON_ZERO * fabs(here));
    pm_constraint_curve_go_on(&w->frame, c, way, nothing, &w->state.memory[c->foot]);
    return pm_saddle_accelerate(w);
}

static int settle_joint(pm_workspace *w, int joint)
{
    pm_constraint c[PM_JOINT_CONSTRAINTS];
    if (!pm_joint_of(w->model, joint)->feet || pm_state_is_absent(w->model, &w->state, PM_TABLE_JOINT, joint))
        return PM_OK;
    pm_joint_constraints_of_any(&w->frame, joint, c);
    return pm_curve_has_pieces(w->model, c[0].curve) ? settle_foot(w, &c[0]) : PM_OK;
}

static int settle_slot(pm_workspace *w, int slot)
{
    pm_constraint c;
    const pm_slot *s = &w->state.slot[slot];
    if (s->mode == PM_OPEN || s->mode == PM_CAPTURED || !pm_contact_curve_on(&w->frame, slot, s->member, &c))
        return PM_OK;
    return pm_curve_has_pieces(w->model, c.curve) ? settle_foot(w, &c) : PM_OK;
}

static int settle_feet(pm_workspace *w)
{
    int status = PM_OK;
    for (int i = 0; !status && i < w->model->rows[PM_TABLE_JOINT]; i++) status = settle_joint(w, i);
    for (int i = 0; !status && i < w->model->nslot; i++) status = settle_slot(w, i);
    return status;
}

static int has_switched(const pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++)
        if (w->firing.fired[i] && pm_trigger_of_switch(w->model, i))
            return PM_TRIGGER_ROW(w->model, i)[PM_TRIGGER_EVENT];
    return PM_NONE;
}

int pm_switches_check(pm_workspace *w)
{
    const int event = has_switched(w);
    if (event == PM_NONE) return PM_OK;
    pm_instant *x = &w->instant;
    const double again = PM_SWITCH_AGAIN * w->numbers.size / w->numbers.speed;
    x->to_and_fro = fabs(w->state.t - x->switched) < again ? x->to_and_fro + 1 : 0;
    x->switched = w->state.t;
    if (x->to_and_fro < PM_SWITCHES_AT_ONCE) return PM_OK;
    const double many = (double)x->to_and_fro;
    return pm_fail(&w->result, PM_ALTERNATES, PM_TABLE_EVENT, event, many, many);
}

void pm_switches_begin(pm_workspace *w)
{
    w->instant.switched = -1;
    w->instant.to_and_fro = 0;
}

int pm_switches_settle(pm_workspace *w, int goes_on)
{
    int status = PM_OK;
    for (int i = 0; !status && i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int event = switch_of(w->model, i);
        if (event != PM_NONE) status = settle(w, i, event);
    }
    for (int i = 0; !status && i < w->model->rows[PM_TABLE_READING]; i++)
        status = settle_piece(w, i, goes_on);
    return status || !pm_curve_any_pieces(w->model) ? status : settle_feet(w);
}
