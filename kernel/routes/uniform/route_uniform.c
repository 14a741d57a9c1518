/* route_uniform.c - constant accelerations: q = q0 + v t + a t^2/2, exactly.
 *
 * That they are constant is proven by the rules of constant_motion.c; no step controls any error.  Contacts close where
 * uniform_gap.c finds it, sliding stops where the slip, linear in t, vanishes; normal forces and friction keep what they
 * were when the phase began.  What else is watched - triggers, extremes, grids - is sampled in steps: programs that are
 * polynomials of the time (program_degree.c) in long ones that end where a parabola, or the square of a speed, has its
 * extremum, so that each is monotonic in its step; others as densely as the motion itself is fast.  Where nothing is
 * watched one step is the phase. */
#include <math.h>
#include <string.h>

#include "elements/capture.h"
#include "elements/contact.h"
#include "elements/contact_curve.h"
#include "elements/joint_friction.h"
#include "equations/case.h"
#include "equations/ledger.h"
#include "equations/projection.h"
#include "events/ask.h"
#include "events/event.h"
#include "events/event_search.h"
#include "expression/program.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/uniform/uniform.h"
#include "scene/program_degree.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

/* ---- memory ---- */
static int create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (PM_ARENA_NEW(&w->memory, w->uniform)) return PM_NO_MEMORY;
    pm_uniform *u = w->uniform;
    const int nq = m->nq, nz = m->nz, ncontact = m->rows[PM_TABLE_CONTACT];
    const pm_array array[] = {
        PM_ARRAY(u->closing, ncontact),
        PM_ARRAY(u->q0, nq + 3),
        PM_ARRAY(u->v, nq + 3),
        PM_ARRAY(u->a, nq + 3),
        PM_ARRAY(u->lambda, m->nconstraint),
        PM_ARRAY(u->slip_end, m->nslot),
        PM_ARRAY(u->edge_end, m->nslot),
        PM_ARRAY(u->strand_end, 2 * (size_t)m->nslot),
        PM_ARRAY(u->joint_slip_end, m->nfriction),
        PM_ARRAY(u->rate, 3 * (size_t)nz),
        PM_ARRAY(u->z0, nz),
        PM_ARRAY(u->q_look, nq),
        PM_ARRAY(u->v_look, nq + 3),
        PM_ARRAY(u->series.before, nq),
        PM_ARRAY(u->series.change, nq),
        PM_ARRAY(u->series.spare, nq),
        PM_ARRAY(u->turns.along, nq),
        PM_ARRAY(u->turns.off, nq),
        PM_ARRAY(u->watched, m->rows[PM_TABLE_TRIGGER] + m->nask),
        PM_ARRAY(u->rotates, m->nbody + 1),
        PM_ARRAY(u->locked, m->nbody + 1),
    };
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

/* ---- a phase is made ready ---- */
/* A point on a body that goes round travels along no parabola. */
static int paths_are_parabolas(const pm_workspace *w)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->npath; i++)
        if (!pm_constant_motion_point(&w->frame, &w->uniform->curve,
                                      PM_MEASURE_ROW(m, m->path[i])[PM_MEASURE_A]))
            return 0;
    return 1;
}

/* A slip, positive while it lasts, of a slot or of the friction of a joint. */
typedef double pm_slip(pm_workspace *w, int which, double t);

static double joint_slip_at(pm_workspace *w, int friction, double t)
{
    pm_uniform_look(w, t);
    const double slip = pm_joint_friction_slip(&w->frame, friction);
    return w->state.friction[friction] == PM_SLIDE_FORWARD ? slip : -slip;
}

static double slip_at(pm_workspace *w, int slot, double t)
{
    pm_uniform_look(w, t);
    const double slip =
        pm_contact_member_slip(&w->frame, pm_contact_of_slot(w->model, slot), w->state.slot[slot].member);
    return w->state.slot[slot].mode == PM_SLIDE_FORWARD ? slip : -slip;
}

static double slip_rate(pm_workspace *w, pm_slip *at, int which)
{
    const double h = pm_case_time_scale(w->model, &w->numbers, w->uniform->v, w->uniform->a);
    return h < INFINITY ? (at(w, which, h) - at(w, which, 0)) / h : 0;
}

/* The slip is linear in t: a secant gives its root, a second one from there its last digits. */
static double slip_ends(pm_workspace *w, pm_slip *at, int which, double no_slip)
{
    const double now = at(w, which, 0), slope = slip_rate(w, at, which);
    if (now <= no_slip) { /* has just begun to slide */
        w->uniform->irregular |= slope < -PM_UNIFORM_DEFINITE * w->uniform->curve.acceleration;
        return INFINITY;
    }
    if (!(slope < 0)) return INFINITY;
    const double t = now / -slope;
    return t + at(w, which, t) / -slope;
}

static void begin_contacts(pm_workspace *w)
{
    pm_uniform *u = w->uniform;
    for (int i = 0; i < w->model->nslot; i++) {
        const int mode = w->state.slot[i].mode;
        const int slides = mode == PM_SLIDE_FORWARD || mode == PM_SLIDE_BACKWARD;
        u->slip_end[i] = slides ? slip_ends(w, slip_at, i, pm_contact_speed(&w->frame)) : INFINITY;
        u->edge_end[i] = INFINITY;
    }
    for (int i = 0; i < w->model->nfriction; i++)
        u->joint_slip_end[i] = w->state.friction[i] == PM_STICK || w->state.friction[i] == PM_OPEN
                                   ? INFINITY
                                   : slip_ends(w, joint_slip_at, i, pm_joint_friction_no_slip(&w->frame, i));
    pm_uniform_look(w, 0);
    pm_uniform_strand_begin(w);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) pm_uniform_gap_begin(w, i);
}

/* The frame is DYNAMIC at w->state before and after. */
static int prepare(pm_workspace *w)
{
    pm_uniform *u = w->uniform;
    const int nq = w->model->nq;
    pm_constant_motion_curve(w, u->v, u->a, u->rotates, u->locked, &u->curve);
    if (u->curve.levers && (pm_joint_friction_any(w->model) || w->model->nteeth > 0))
        return 0; /* reactions change, and friction with them */
    if (pm_contact_curve_any(w->model)) return 0;
    if (!pm_uniform_edge_hold(w) || !pm_constraint_all_steady(&w->frame, &w->active, &u->curve) ||
        !pm_force_all_steady(&w->frame, &w->state, &u->curve) || !paths_are_parabolas(w) ||
        pm_capture_awaits(&w->frame, &w->state))
        return 0;
    u->t0 = w->state.t;
    u->looked = NAN;
    u->rests = pm_ledger_rests(w);
    u->begin = u->end = 0;
    u->irregular = u->status = 0;
    memcpy(u->q0, w->state.q, (size_t)nq * sizeof(double));
    memcpy(u->lambda, w->frame.lambda, (size_t)w->model->nconstraint * sizeof(double));
    begin_contacts(w);
    pm_frame_look_state(&w->frame, &w->state);
    pm_uniform_know_forces(&w->frame, w->uniform);
    return !u->irregular;
}

/* ---- what is watched ---- */
static void watch(const pm_frame *frame, pm_uniform *u, int program)
{
    const int size = pm_program_degree_is_size(frame, &u->curve, program);
    const int degree = size ? PM_DEGREE_MOST : pm_program_degree_of(frame, &u->curve, program);
    if (degree > u->sampled) u->sampled = degree;
    if (degree == PM_DEGREE_MOST) u->watched[u->nwatched++] = (pm_parabola){program, size};
}

static int begin(pm_workspace *w)
{
    pm_uniform *u = w->uniform;
    u->sampled = -1;
    u->nwatched = 0;
    for (int i = 0; i < w->event->nfunction; i++)
        if (w->event->function[i].kind == FUNCTION_TRIGGER)
            watch(&w->frame, w->uniform,
                  PM_TRIGGER_ROW(w->model, w->event->function[i].index)[PM_TRIGGER_PROGRAM]);
    for (int i = 0; i < w->ask->nobserver; i++)
        watch(&w->frame, w->uniform, pm_ask_watched(w->model, w->ask, i));
    u->stride = PM_UNIFORM_FIRST_STRIDE * pm_case_time_scale(w->model, &w->numbers, u->v, u->a);
    pm_zeno_begin(w);
    return PM_OK;
}

/* ---- one step ---- */
/* Where in the step the first of the watched parabolas has its extremum, or its end. */
static double first_reversal(pm_workspace *w, double from, double to)
{
    const double h = to - from;
    for (int i = 0; i < w->uniform->nwatched; i++) {
        const pm_parabola x = w->uniform->watched[i];
        double p[3];
        for (int k = 0; k < 3; k++) {
            pm_uniform_look_at_forces(w, from + 0.5 * k * h);
            p[k] = pm_program_run(w, x.program);
            if (x.squared) p[k] *= p[k];
        }
        const double slope = 4 * p[1] - 3 * p[0] - p[2], bend = 2 * (p[0] - 2 * p[1] + p[2]);
        const double reversal = bend != 0 ? -0.5 * slope / bend : INFINITY; /* of h */
        const double rounding = PM_UNIFORM_REVERSAL_ROUNDING * fmax(fabs(p[0]), fabs(p[2])) / fabs(bend);
        if (reversal > fmax(PM_UNIFORM_TURNED, rounding) && reversal < 1)
            to = pm_min(from + reversal * h, to);
    }
    return to;
}

/* Time of the first contact that closes or stops sliding, or strand that ends, not after `end`. */
static double first_contact(pm_workspace *w, double end)
{
    pm_uniform *u = w->uniform;
    end = pm_uniform_strand_first(w, end);
    for (int i = 0; i < w->model->nslot; i++) end = pm_min(fmin(u->slip_end[i], u->edge_end[i]), end);
    for (int i = 0; i < w->model->nfriction; i++) end = pm_min(u->joint_slip_end[i], end);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        const pm_closing *x = &u->closing[i];
        pm_uniform_gap(w, i, end);
        end = pm_min(x->root < INFINITY ? x->root : x->safe, end);
    }
    return end;
}

/* How far the step may go where things are sampled. */
static double sampled_end(pm_workspace *w, double limit)
{
    pm_uniform *u = w->uniform;
    if (u->sampled < 0) return limit;
    if (u->sampled > PM_DEGREE_MOST) {
        pm_uniform_look(w, u->begin);
        return fmin(limit, u->begin + pm_case_time_scale(w->model, &w->numbers, w->frame.v, u->a));
    }
    const double end = fmin(limit, u->begin + u->stride);
    u->stride *= PM_UNIFORM_LONGER;
    return end;
}

/* Marks what happens to contacts at the end of the step; the contact that is struck, if it is one alone. */
static int mark_roots(struct pm_event_set *event, const pm_uniform *u)
{
    const double end = u->end + PM_UNIFORM_SAME_TIME * (u->end - u->begin);
    int struck = PM_NONE, others = 0;
    for (int i = 0; i < event->nfunction; i++) {
        const pm_event_function *f = &event->function[i];
        const int gap = f->kind == FUNCTION_GAP;
        event->root[i] = (gap && u->closing[f->index].root <= end) ||
                         (f->kind == FUNCTION_END && u->edge_end[f->index] <= end) ||
                         (f->kind == FUNCTION_STRAND && u->strand_end[f->index] <= end) ||
                         (f->kind == FUNCTION_SLIP && u->slip_end[f->index] <= end) ||
                         (f->kind == FUNCTION_JOINT_SLIP && u->joint_slip_end[f->index] <= end);
        if (!event->root[i]) continue;
        others += !gap || struck != PM_NONE;
        struck = f->index;
    }
    return others ? PM_NONE : struck;
}

/* What was decided in the step: contacts that closed, or came near to it; slip that ended. */
static void note_decisions(pm_workspace *w)
{
    const pm_uniform *u = w->uniform;
    for (int i = 0; i < w->event->nfunction; i++) {
        pm_event_function *f = &w->event->function[i];
        const int slides = f->kind == FUNCTION_SLIP || f->kind == FUNCTION_JOINT_SLIP;
        if (slides && w->event->root[i])
            pm_event_evidence_rate(
                w, i, slip_rate(w, f->kind == FUNCTION_SLIP ? slip_at : joint_slip_at, f->index));
        if (f->kind == FUNCTION_STRAND) pm_uniform_strand_note(w, i);
        if (f->kind != FUNCTION_GAP && f->kind != FUNCTION_END) continue;
        const int contact = f->kind == FUNCTION_END ? pm_contact_of_slot(w->model, f->index) : f->index;
        pm_uniform_gap_note(w, contact);
        const pm_closing *x = &u->closing[contact];
        if (w->event->root[i]) pm_event_evidence_rate(w, i, x->rate);
        f->near = x->near;
        f->near_reach = x->near_reach;
    }
}

static int go_to_end(pm_workspace *w, double limit, double t_limit)
{
    pm_uniform *u = w->uniform;
    if (!u->rests) pm_uniform_rates_after(w, u->begin, u->rate);
    pm_uniform_integrate(w, u->end, w->state.z);
    pm_uniform_place(w->model, w->uniform, u->end, w->state.q, w->state.v);
    const double begin = w->state.t;
    w->state.t = u->end == limit ? t_limit : u->t0 + u->end;
    pm_step_set(&w->step, begin, w->state.t);
    pm_case_speed(w->model, &w->numbers, w->state.v);
    return u->status ? u->status : pm_projection_near(w, &w->state);
}

static int step(pm_workspace *w, double t_limit)
{
    pm_uniform *u = w->uniform;
    const double limit = t_limit - u->t0;
    int leapt;
    w->result.count[PM_COUNT_STEPS]++;
    u->begin = u->end;
    memcpy(u->z0, w->state.z, (size_t)w->model->nz * sizeof(double));
    u->end = first_contact(w, pm_zeno_may_leap(u) ? limit : sampled_end(w, limit));
    const int next = mark_roots(w->event, w->uniform);
    int status = pm_zeno_leap(w, next, u->end, t_limit, &leapt);
    if (!status && !leapt) status = pm_turns_leap(w, next, u->end, t_limit, &leapt);
    if (status || leapt) return status;
    if (pm_zeno_may_leap(u)) u->end = first_contact(w, sampled_end(w, limit));
    if (u->nwatched > 0) u->end = first_reversal(w, u->begin, u->end);
    const int struck = mark_roots(w->event, w->uniform);
    if (w->evidence.active) note_decisions(w);
    status = go_to_end(w, limit, t_limit);
    pm_zeno_end(w, struck);
    return status;
}

static int at(pm_workspace *w, double t, pm_state *s)
{
    const pm_model *m = w->model;
    const double after = t - w->uniform->t0;
    if (m->nz_controlled > 0)
        pm_uniform_integrate(w, after, s->z);
    else
        memcpy(s->z, w->uniform->z0,
               (size_t)m->nz * sizeof(double)); /* nobody reads the ledger inside a step */
    pm_uniform_place(w->model, w->uniform, after, s->q, s->v);
    s->t = t;
    return PM_OK;
}

static int exact(pm_workspace *w, double t, pm_state *s)
{
    const double after = t - w->uniform->t0;
    if (s != &w->state) pm_state_copy(s, &w->state);
    pm_uniform_integrate(w, after, s->z);
    pm_uniform_place(w->model, w->uniform, after, s->q, s->v);
    s->t = t;
    return pm_projection_near(w, s);
}

static void forget(pm_workspace *w)
{
    pm_zeno_reset(w->uniform);
    pm_turns_reset(w->uniform);
}

const pm_route_ops pm_route_uniform = {
    .route = PM_ROUTE_UNIFORM,
    .create = create,
    .forget = forget,
    .prepare = prepare,
    .begin = begin,
    .step = step,
    .at = at,
    .exact = exact,
    .react = pm_uniform_react,
    .resolves = pm_uniform_resolves,
    .locates_contacts = 1,
    .in_time = 1,
    .price = 1,
    .finest = PM_UNIFORM_FINEST, /* no tolerance enters; as of routes that may take other phases of the run */
    .spread = 24,
    .nodes = &pm_chebyshev_nodes_equal,
};
