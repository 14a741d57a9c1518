/* route_uniform.c - constant accelerations: q = q0 + v t + a t^2/2, exactly.
 *
 * That they are constant is proven by the rules of constant_motion.c; no step controls any error.  Contacts close where
 * uniform_gap.c finds it, sliding stops where the slip, linear in t, vanishes; normal forces and grip keep what they were
 * when the phase began.  What else is watched - triggers, extremes, grids - is sampled in steps: programs that are
 * polynomials of the time (program_degree.c) in long ones that end where a parabola turns, so that each is monotonic in its step;
 * (so is the size of a velocity, where its square turns);
 * others as densely as the motion itself is fast.  Where nothing is watched one step is the phase.
 *
 * Running integrals: rates of work and of impulse are linear, moments quadratic in t, so that Simpson's rule is exact; the
 * distance that a point travels is the integral of the root of a parabola. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/capture.h"
#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/force.h"
#include "elements/joint_friction.h"
#include "equations/case.h"
#include "equations/ledger.h"
#include "equations/projection.h"
#include "equations/saddle.h"
#include "events/ask.h"
#include "events/event.h"
#include "events/event_search.h"
#include "expression/program.h"
#include "routes/uniform/uniform.h"
#include "scene/program_degree.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

#define FIRST_STRIDE 4.0 /* of the motion's own time: first step where polynomials are watched */
#define LONGER 2.0       /* and by this the next one is longer */
#define TURN_APART 1e-9  /* of a step: a parabola that turns so near to its begin has turned there */
#define DEFINITE 100.0   /* times the rounding of accelerations */
#define SAME_TIME 1e-11  /* of a step: contacts that close so near to each other do so at once */

/* ---- memory ---- */
static int create(pm_workspace *w)
{
    const pm_model *m = w->model;
    struct pm_uniform *u = w->uniform = calloc(1, sizeof *u);
    if (!u) return PM_NO_MEMORY;
    const size_t nq = (size_t)m->nq, nz = (size_t)m->nz, nslot = (size_t)m->nslot, nrow = (size_t)m->nrow,
                 ncontact = (size_t)m->rows[PM_TABLE_CONTACT];
    const size_t ndouble = 3 * (nq + 3) + nrow + 2 * nslot + (size_t)m->nfriction + 4 * nz + 5 * nq,
                 nwatched = (size_t)m->rows[PM_TABLE_TRIGGER] + (size_t)m->nask;
    u->closing = u->block = calloc(1, ncontact * sizeof *u->closing + ndouble * sizeof(double) +
                                          nwatched * sizeof *u->watched + 2 * (size_t)m->nbody + 2);
    if (!u->block) return PM_NO_MEMORY;
    u->q0 = (double *)(void *)(u->closing + ncontact);
    u->v = u->q0 + nq + 3;
    u->a = u->v + nq + 3;
    u->lambda = u->a + nq + 3;
    u->slip_end = u->lambda + nrow;
    u->edge_end = u->slip_end + nslot;
    u->rub_end = u->edge_end + nslot;
    u->rate = u->rub_end + m->nfriction;
    u->z0 = u->rate + 3 * nz;
    u->q_look = u->z0 + nz;
    u->v_look = u->q_look + nq;
    u->series.before = u->v_look + nq;
    u->series.change = u->series.before + nq;
    u->series.spare = u->series.change + nq;
    u->watched = (pm_parabola *)(void *)(u->series.spare + nq);
    u->turns = (unsigned char *)(u->watched + nwatched);
    u->locked = u->turns + m->nbody + 1;
    return PM_OK;
}

static void destroy(pm_workspace *w)
{
    if (!w->uniform) return;
    free(w->uniform->block);
    free(w->uniform);
    w->uniform = NULL;
}

/* ---- places ---- */
static void place(const pm_workspace *w, double t, double *q, double *v)
{
    const pm_uniform *u = w->uniform;
    for (int i = 0; i < w->model->nq; i++) {
        q[i] = u->q0[i] + t * (u->v[i] + 0.5 * t * u->a[i]);
        v[i] = u->v[i] + t * u->a[i];
    }
}

static void know_forces(pm_workspace *w)
{
    const pm_uniform *u = w->uniform;
    memcpy(w->frame.a, u->a, (size_t)w->model->nq * sizeof(double));
    memcpy(w->frame.lambda, u->lambda, (size_t)w->model->nrow * sizeof(double));
    w->frame.level = PM_LEVEL_DYNAMIC;
}

/* Couples that hold locked bodies may change: then reactions are solved for. */
static int react(pm_workspace *w)
{
    if (w->uniform->curve.levers) return pm_saddle_accelerate(w);
    know_forces(w);
    return PM_OK;
}

static void look(pm_workspace *w, double t)
{
    const pm_uniform *u = w->uniform;
    pm_frame_look(&w->frame, u->t0 + t, u->q_look, u->v_look, w->state.z, w->state.memory);
}

static void look_at_forces(pm_workspace *w, double t)
{
    look(w, t);
    const int status = react(w);
    if (status) w->uniform->status = status;
}

void pm_uniform_look(pm_workspace *w, double t)
{
    place(w, t, w->uniform->q_look, w->uniform->v_look);
    look(w, t);
}

void pm_uniform_look_at_forces(pm_workspace *w, double t)
{
    place(w, t, w->uniform->q_look, w->uniform->v_look);
    look_at_forces(w, t);
}

/* ---- running integrals ---- */
void pm_uniform_rates(pm_workspace *w, double *rate)
{
    look_at_forces(w, 0); /* no rate depends on the time itself */
    pm_force_all(w);      /* powers */
    pm_ledger_rates(w, rate);
}

static void rates(pm_workspace *w, double t, double *rate)
{
    place(w, t, w->uniform->q_look, w->uniform->v_look);
    pm_uniform_rates(w, rate);
}

/* Gauss-Legendre, 8 points on [-1, 1]: the positive ones. */
static const double gauss_at[4] = {0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                   0.96028985649753623168};
static const double gauss_weight[4] = {0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                       0.10122853629037625915};
#define SLOW_CHANGE \
    0.1 /* of the speed in the interval: there the closed form would cancel, and Gauss is exact */

/* Integral of |u + a t| from 0 to h.  With s = t + u.a/a^2 and p = |u x a| / |a|: of sqrt(a^2 s^2 + p^2). */
static double distance_along(const double u[2], const double a[2], double h)
{
    const double speed = pm_length(u), size = pm_length(a);
    if (size * h <= SLOW_CHANGE * speed) {
        double sum = 0;
        for (int i = 0; i < 8; i++) {
            const double t = 0.5 * h * (1 + (i < 4 ? gauss_at[i] : -gauss_at[i - 4]));
            sum += gauss_weight[i % 4] * hypot(u[0] + a[0] * t, u[1] + a[1] * t);
        }
        return 0.5 * h * sum;
    }
    const double p = fabs(pm_cross(u, a)) / size, from = pm_dot(u, a) / size, to = from + size * h;
    double sum = to * hypot(to, p) - from * hypot(from, p); /* of size s = from .. to */
    if (p > 0) sum += p * p * (asinh(to / p) - asinh(from / p));
    return 0.5 * sum / size;
}

static void integrate_paths(pm_workspace *w, double t, double h, double *z)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->npath; i++) {
        pm_uniform_look(w, t);
        know_forces(w);
        const pm_point p = pm_frame_point_of(&w->frame, PM_MEASURE_ROW(m, m->path[i])[PM_MEASURE_A]);
        double a[2];
        pm_frame_acceleration(&w->frame, &p, a);
        z[m->nz_work + i] = w->uniform->z0[m->nz_work + i] + distance_along(p.v, a, h);
    }
}

/* z at t, from the begin of the step; rate[0] is known. */
static void integrate(pm_workspace *w, double t, double *z)
{
    pm_uniform *u = w->uniform;
    const int nz = w->model->nz;
    const double h = t - u->begin;
    rates(w, u->begin + 0.5 * h, u->rate + nz);
    rates(w, t, u->rate + 2 * nz);
    for (int i = 0; i < nz; i++)
        z[i] = u->z0[i] + h / 6 * (u->rate[i] + 4 * u->rate[nz + i] + u->rate[2 * nz + i]);
    integrate_paths(w, u->begin, h, z);
}

/* ---- a phase is made ready ---- */
/* A point on a body that goes round travels along no parabola. */
static int paths_are_parabolas(const pm_workspace *w)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->npath; i++) {
        const int32_t *p = PM_POINT_ROW(m, PM_MEASURE_ROW(m, m->path[i])[PM_MEASURE_A]);
        const double at[2] = {w->numbers.value[p[PM_POINT_X]], w->numbers.value[p[PM_POINT_Y]]};
        if (!pm_constant_motion_mark(&w->frame, &w->uniform->curve, pm_body_index(m, p[PM_POINT_BODY]), at))
            return 0;
    }
    return 1;
}

/* A slip, positive while it lasts, of a slot or of a grip. */
typedef double pm_slip(pm_workspace *w, int which, double t);

static double rub_at(pm_workspace *w, int grip, double t)
{
    pm_uniform_look(w, t);
    const double slip = pm_joint_friction_slip(&w->frame, grip);
    return w->state.friction[grip] == PM_SLIDE_FORWARD ? slip : -slip;
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
    const double h = pm_case_time_scale(w, w->uniform->v, w->uniform->a);
    return h < INFINITY ? (at(w, which, h) - at(w, which, 0)) / h : 0;
}

/* The slip is linear in t: a secant gives its root, a second one from there its last digits. */
static double slip_ends(pm_workspace *w, pm_slip *at, int which, double still)
{
    const double now = at(w, which, 0), slope = slip_rate(w, at, which);
    if (now <= still) { /* has just begun to slide */
        w->uniform->irregular |= slope < -DEFINITE * w->uniform->curve.acceleration;
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
        u->rub_end[i] = w->state.friction[i] == PM_STICK || w->state.friction[i] == PM_OPEN
                            ? INFINITY
                            : slip_ends(w, rub_at, i, pm_joint_friction_still(&w->frame, i));
    pm_uniform_look(w, 0);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) pm_uniform_gap_begin(w, i);
}

/* The frame is DYNAMIC at w->state before and after. */
static int prepare(pm_workspace *w)
{
    pm_uniform *u = w->uniform;
    const int nq = w->model->nq;
    if (w->result.count[PM_COUNT_PHASES] == 0) pm_zeno_reset(w);
    pm_constant_motion_curve(w, u->v, u->a, u->turns, u->locked, &u->curve);
    if (u->curve.levers && pm_joint_friction_any(w->model))
        return 0; /* reactions change, and friction with them */
    if (!pm_uniform_edge_hold(w) || !pm_constant_motion_holds(w, &u->curve) || !paths_are_parabolas(w) ||
        pm_capture_awaits(w))
        return 0;
    u->t0 = w->state.t;
    u->begin = u->end = 0;
    u->irregular = u->status = 0;
    memcpy(u->q0, w->state.q, (size_t)nq * sizeof(double));
    memcpy(u->lambda, w->frame.lambda, (size_t)w->model->nrow * sizeof(double));
    begin_contacts(w);
    pm_frame_look_state(&w->frame, &w->state);
    know_forces(w);
    return !u->irregular;
}

/* ---- what is watched ---- */
static void watch(pm_workspace *w, int program)
{
    pm_uniform *u = w->uniform;
    const int size = pm_program_degree_is_size(&w->frame, &u->curve, program);
    const int degree = size ? PM_DEGREE_MOST : pm_program_degree_of(&w->frame, &u->curve, program);
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
            watch(w, PM_TRIGGER_ROW(w->model, w->event->function[i].index)[PM_TRIGGER_PROGRAM]);
    for (int i = 0; i < w->ask->nobserver; i++) watch(w, pm_ask_watched(w, i));
    u->stride = FIRST_STRIDE * pm_case_time_scale(w, u->v, u->a);
    pm_zeno_begin(w);
    return PM_OK;
}

/* ---- one step ---- */
/* Where in the step the first of the watched parabolas turns, or its end. */
static double first_turn(pm_workspace *w, double from, double to)
{
    const double h = to - from;
    for (int i = 0; i < w->uniform->nwatched; i++) {
        const pm_parabola x = w->uniform->watched[i];
        double p[3];
        for (int k = 0; k < 3; k++) {
            pm_uniform_look_at_forces(w, from + 0.5 * k * h);
            p[k] = pm_program_run(w->model, x.program, w->numbers.param, w->numbers.value, w);
            if (x.squared) p[k] *= p[k];
        }
        const double slope = 4 * p[1] - 3 * p[0] - p[2], bend = 2 * (p[0] - 2 * p[1] + p[2]);
        const double turn = bend != 0 ? -0.5 * slope / bend : INFINITY; /* of h */
        if (turn > TURN_APART && turn < 1) to = fmin(to, from + turn * h);
    }
    return to;
}

/* Time of the first contact that closes or stops sliding, not after `end`. */
static double first_contact(pm_workspace *w, double end)
{
    pm_uniform *u = w->uniform;
    for (int i = 0; i < w->model->nslot; i++) end = fmin(end, fmin(u->slip_end[i], u->edge_end[i]));
    for (int i = 0; i < w->model->nfriction; i++) end = fmin(end, u->rub_end[i]);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        const pm_closing *x = &u->closing[i];
        pm_uniform_gap(w, i, end);
        end = fmin(end, x->root < INFINITY ? x->root : x->safe);
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
        return fmin(limit, u->begin + pm_case_time_scale(w, w->frame.v, u->a));
    }
    const double end = fmin(limit, u->begin + u->stride);
    u->stride *= LONGER;
    return end;
}

/* Marks what happens to contacts at the end of the step; the contact that is struck, if it is one alone. */
static int mark_roots(pm_workspace *w)
{
    const pm_uniform *u = w->uniform;
    const double end = u->end + SAME_TIME * (u->end - u->begin);
    int struck = PM_NONE, others = 0;
    for (int i = 0; i < w->event->nfunction; i++) {
        const pm_event_function *f = &w->event->function[i];
        const int gap = f->kind == FUNCTION_GAP;
        w->event->root[i] = (gap && u->closing[f->index].root <= end) ||
                            (f->kind == FUNCTION_END && u->edge_end[f->index] <= end) ||
                            (f->kind == FUNCTION_SLIP && u->slip_end[f->index] <= end) ||
                            (f->kind == FUNCTION_RUB && u->rub_end[f->index] <= end);
        if (!w->event->root[i]) continue;
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
        if (f->kind == FUNCTION_SLIP && w->event->root[i])
            pm_event_evidence_rate(w, i, slip_rate(w, slip_at, f->index));
        if (f->kind == FUNCTION_RUB && w->event->root[i])
            pm_event_evidence_rate(w, i, slip_rate(w, rub_at, f->index));
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
    rates(w, u->begin, u->rate);
    integrate(w, u->end, w->state.z);
    place(w, u->end, w->state.q, w->state.v);
    w->step.begin = w->state.t;
    w->step.end = w->state.t = u->end == limit ? t_limit : u->t0 + u->end;
    pm_case_speed(w, w->state.v);
    return u->status ? u->status : pm_projection_apply(w, &w->state);
}

static int step(pm_workspace *w, double t_limit)
{
    pm_uniform *u = w->uniform;
    const double limit = t_limit - u->t0;
    int leapt;
    w->result.count[PM_COUNT_STEPS]++;
    u->begin = u->end;
    memcpy(u->z0, w->state.z, (size_t)w->model->nz * sizeof(double));
    u->end = first_contact(w, sampled_end(w, limit));
    int status = pm_zeno_leap(w, mark_roots(w), u->end, t_limit, &leapt);
    if (status || leapt) return status;
    if (u->nwatched > 0) u->end = first_turn(w, u->begin, u->end);
    const int struck = mark_roots(w);
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
        integrate(w, after, s->z);
    else
        memcpy(s->z, w->uniform->z0,
               (size_t)m->nz * sizeof(double)); /* nobody reads the ledger inside a step */
    place(w, after, s->q, s->v);
    s->t = t;
    return PM_OK;
}

static int exact(pm_workspace *w, double t, pm_state *s)
{
    const double after = t - w->uniform->t0;
    if (s != &w->state) pm_state_copy(s, &w->state);
    integrate(w, after, s->z);
    place(w, after, s->q, s->v);
    s->t = t;
    return pm_projection_apply(w, s);
}

const pm_route_ops pm_route_uniform = {
    .route = PM_ROUTE_UNIFORM,
    .create = create,
    .free = destroy,
    .prepare = prepare,
    .begin = begin,
    .step = step,
    .at = at,
    .exact = exact,
    .react = react,
    .resolves = pm_uniform_resolves,
    .locates_contacts = 1,
    .in_time = 1,
    .price = 1,
    .finest = 5e-14, /* no tolerance enters; as of routes that may take other phases of the run */
    .spread = 30,
    .nodes = &pm_chebyshev_nodes_equal,
};
