/* switches.c - on which side of a switch, and on which piece of a table, a phase begins, by the derivatives of what is read; on
 * which piece of a curve, by a state a little ahead. */
#include "impact/switches.h"

#include <math.h>

#include "elements/constraint.h"
#include "elements/contact_curve.h"
#include "elements/curve_piece.h"
#include "elements/joint.h"
#include "elements/trigger.h"
#include "equations/case.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "expression/piecewise.h"
#include "impact/switch_course.h"
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

/* ---- switches and tables ---- */
/* The kind of the trigger that was found on its zero and is on it still, since nothing has made it jump; PM_NONE: none was. */
static int found_as(pm_workspace *w, int event, int located)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(w->model, i);
        if (e[PM_TRIGGER_EVENT] != event || w->firing.fired[i] != PM_FIRED_NOW) continue;
        if (located || pm_trigger_program(w, i) == w->firing.before[i]) return e[PM_TRIGGER_KIND];
    }
    return PM_NONE;
}

static int take_side(pm_workspace *w, int event, int side)
{
    w->firing.side[event] = side;
    return pm_saddle_accelerate(w);
}

/* The side to which the motion leads is kept if the force on it leads there, too.  A switch that was found on its zero is on it,
 * however time is rounded; one that tells no way is passed. */
static int settle(pm_workspace *w, int trigger, int event, int located)
{
    const pm_switch_course x =
        pm_switch_course_begin(w, PM_TRIGGER_ROW(w->model, trigger)[PM_TRIGGER_PROGRAM]);
    const int kind = found_as(w, event, located), side = w->firing.side[event] != 0;
    if (kind == PM_NONE && !(fabs(x.here) <= x.rounding)) return PM_OK;
    int way = pm_switch_course_way(w, &x);
    if (way == 0 && kind != PM_NONE) return take_side(w, event, kind == PM_TRIGGER_RISE);
    if (way == 0 || (way > 0) == side) return PM_OK;
    const int status = take_side(w, event, !side);
    if (status) return status;
    way = pm_switch_course_way(w, &x);
    if (way == 0 || (way > 0) != side) return PM_OK;
    return pm_fail(&w->result, PM_ALTERNATES, PM_TABLE_EVENT, event, 1, 1);
}

/* How far an argument is from the nearer end of a piece. */
static double from_end(const pm_piecewise *p, double piece, double x)
{
    return fmin(fabs(x - pm_piecewise_begin(p, piece)), fabs(x - pm_piecewise_begin(p, piece + 1)));
}

static int reaches(const pm_piecewise *p, double piece, double x, int way, double nothing)
{
    return way > 0 ? pm_piecewise_begin(p, piece + 1) - x <= nothing
                   : x - pm_piecewise_begin(p, piece) <= nothing;
}

/* The piece that goes on from x; those that are next to nothing are passed. */
static double piece_ahead(const pm_piecewise *p, double x, int way, double nothing, double present)
{
    double piece = pm_piecewise_number_ahead(p, x, way, nothing, present);
    int many = p->pieces;
    while (way != 0 && many-- > 0 && reaches(p, piece, x, way, nothing)) piece += way;
    return piece;
}

/* The piece of a table into which the motion leads: what tables give is continuous, or jumps at a place alone.  What was found at
 * the end of a piece is there, however time is rounded. */
static int settle_piece(pm_workspace *w, int reading, int located, int goes_on)
{
    const int32_t *e = PM_READING_ROW(w->model, reading);
    const pm_piecewise p = pm_piecewise_of(w->model, e[PM_READING_TABLE]);
    double *piece = &w->firing.side[e[PM_READING_EVENT]], before = *piece;
    const pm_switch_course x = pm_switch_course_begin(w, e[PM_READING_PROGRAM]);
    const int found = found_as(w, e[PM_READING_EVENT], located) != PM_NONE;
    const double end = found ? from_end(&p, before, x.here) : 0,
                 nothing = fmax(PM_PIECE_NOTHING * x.scale, end);
    const int at_end =
        piece_ahead(&p, x.here, 1, nothing, before) != piece_ahead(&p, x.here, -1, nothing, before);
    const int way = at_end ? pm_switch_course_way(w, &x) : 0;
    const double there = piece_ahead(&p, x.here, way, nothing, before);
    if (!goes_on && p.beyond == PM_BEYOND_NONE && (there < 0 || there >= p.pieces)) return PM_OK;
    *piece = there;
    return *piece == before ? PM_OK : pm_saddle_accelerate(w);
}

/* ---- pieces of curves ---- */
/* The piece of its curve into which the motion leads the foot of a constraint. */
static int settle_foot(pm_workspace *w, const pm_constraint *c)
{
    const double here = pm_constraint_curve_foot(&w->frame, c);
    pm_case_later(w, PM_FOOT_LOOK * w->numbers.size / w->numbers.speed, &w->probe);
    pm_frame_look_state(&w->frame, &w->probe);
    const double ahead = pm_constraint_curve_foot(&w->frame, c), way = isfinite(ahead) ? ahead - here : 0;
    pm_frame_look_state(&w->frame, &w->state);
    const double nothing = fmax(PM_FOOT_ON_END * fabs(way), PM_ON_ZERO * fabs(here));
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

static int settle_all(pm_workspace *w, int located, int goes_on)
{
    int status = PM_OK;
    for (int i = 0; !status && i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int event = switch_of(w->model, i);
        if (event != PM_NONE) status = settle(w, i, event, located);
    }
    for (int i = 0; !status && i < w->model->rows[PM_TABLE_READING]; i++)
        status = settle_piece(w, i, located, goes_on);
    return status || !pm_curve_any_pieces(w->model) ? status : settle_feet(w);
}

int pm_switches_reach(pm_workspace *w) { return settle_all(w, 1, 0); }

int pm_switches_settle(pm_workspace *w, int goes_on) { return settle_all(w, 0, goes_on); }
