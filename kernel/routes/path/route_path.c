/* route_path.c - one degree of freedom, forces that depend on position only: the principle of work and energy along the
 * configuration path (17.1), (17.9) of the book.
 *
 *   T(u) = T1 + V1 - V(u) + work of forces without potential,   T = mass(u) (du/dt)^2 / 2
 *
 * u is the driver of path_place.c.  Every place on the path is met exactly, so that neither positions nor speeds carry any
 * error of integration; the time, where anybody asks for it, is the integral of sqrt(mass / 2T), with the root taken out
 * where the step begins or ends at rest.  The motion turns back where T vanishes. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/joint_friction.h"
#include "elements/turning_plane.h"
#include "equations/case.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "expression/program.h"
#include "numerics/bracket.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "routes/path/path.h"
#include "routes/path/path_bridge.h"
#include "routes/path/path_clock.h"
#include "routes/path/path_error.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"
#include "tree/tree.h"

#define TURN (2 * 3.14159265358979323846)
#define STEPS_PER_TURN 8
#define LENGTHS 0.5 /* of the scene's size: longest step of a coordinate that is a length */
#define FARTHER \
    4.0 /* steps where no loop must be closed and no contact is near, if the nodes resolve the motion */
#define FASTER 2.0 /* other coordinates may go this much farther than the driver */
#define BEYOND 1.2 /* of the way to a contact that seems to come: the step shall see it */
#define ROUNDING 1e-14
#define ROUNDINGS 8    /* that a difference of potentials may hold */
#define SAME 1e-9      /* of a step's length */
#define STILL 1e-11    /* of the scene's speed: at rest */
#define BALANCED 1e-12 /* of the forces: in equilibrium */

/* ---- memory ---- */
static size_t doubles_of_place(const pm_model *m)
{
    return 5 * (size_t)m->nq + (size_t)m->nz_controlled + (5 + PM_TREE_ARM) * (size_t)m->nbody;
}

static double *carve(const pm_model *m, pm_place *x, double *p)
{
    x->y = p;
    x->slope = x->y + m->nq;
    x->q = x->slope + m->nq;
    x->tangent = x->q + m->nq;
    x->rate = x->tangent + m->nq;
    x->pose = x->rate + m->nz_controlled;
    x->bend = x->pose + 5 * m->nbody;
    x->arm = x->bend + m->nq;
    return p + doubles_of_place(m);
}

static int create(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_path *p = w->path = calloc(1, sizeof *p);
    if (!p) return PM_NO_MEMORY;
    const size_t n = (size_t)m->nq, nz = (size_t)m->nz_controlled, places = PM_NODES_MOST + 2;
    double *block = p->block = calloc(places * doubles_of_place(m) + n * n + n + 2 * nz +
                                          (6 + PM_BRIDGE_PLACES) * n + (size_t)m->nbody + 1,
                                      sizeof *block);
    p->rigid.body = calloc((size_t)m->nbody + 1, sizeof *p->rigid.body);
    if (!block || !p->rigid.body) return PM_NO_MEMORY;
    for (int k = 0; k < PM_NODES_MOST; k++) block = carve(m, &p->node[k], block);
    block = carve(m, &p->spare, block);
    block = carve(m, &p->begin, block);
    pm_path_clock_fill_table(&p->clock.table);
    p->loop.entry = block;
    p->work = p->loop.entry + n * n;
    p->weight = p->work + nz;
    p->bridge.known_y = p->weight + nz;
    p->bridge.known_slope = p->bridge.known_y + n;
    p->bridge.y = p->bridge.known_slope + n;
    p->bridge.slope = p->bridge.y + n;
    p->bridge.bend = p->bridge.slope + n;
    p->bridge.c = p->bridge.bend + n;
    p->inertia = p->bridge.c + PM_BRIDGE_PLACES * n;
    p->column = (int *)(void *)(p->inertia + m->nbody);
    p->loop.low = p->column + n;
    p->loop.high = p->loop.low + n;
    return PM_OK;
}

static void destroy(pm_workspace *w)
{
    if (!w->path) return;
    free(w->path->rigid.body);
    free(w->path->block);
    free(w->path);
    w->path = NULL;
}

/* ---- a phase ---- */
static void copy_place(const pm_workspace *w, pm_place *to, const pm_place *from)
{
    memcpy(to->y, from->y, doubles_of_place(w->model) * sizeof(double)); /* its arrays lie together */
    to->determined = from->determined;
    to->mass = from->mass;
    to->change = from->change;
    to->potential = from->potential;
    to->force = from->force;
    to->kinetic = from->kinetic;
}

double pm_path_work(const pm_workspace *w, const double *z)
{
    double sum = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_FORCE]; i++)
        if (w->model->force_z[i] != PM_NONE) sum += z[w->model->force_z[i]];
    return sum;
}

static double total_mass(const pm_workspace *w)
{
    double sum = 0;
    for (int i = 0; i < w->model->nbody; i++) sum += w->numbers.mass[i];
    return sum;
}

/* Rate of the driver from given velocities: their part along the path. */
static double rate_of(const pm_workspace *w, const pm_place *x, const double *v)
{
    double sum = 0;
    for (int i = 0; i < w->model->nbody; i++)
        sum += w->numbers.mass[i] * (v[3 * i] * x->tangent[3 * i] + v[3 * i + 1] * x->tangent[3 * i + 1]) +
               pm_body_inertia(&w->frame, i) * v[3 * i + 2] * x->tangent[3 * i + 2];
    return sum / x->mass;
}

/* What the generalised force would be if the forces were along the motion. */
static double force_size(const pm_workspace *w, const pm_place *x)
{
    double size = 0;
    for (int i = 0; i < w->model->nbody; i++) {
        const double *f = w->frame.f + 3 * i, *t = x->tangent + 3 * i;
        size += hypot(f[0], f[1]) * hypot(t[0], t[1]) + fabs(f[2] * t[2]);
    }
    return size + pm_turning_plane_force_size(&w->frame, x->tangent);
}

double pm_path_requested(pm_workspace *w, const double *velocity)
{
    memcpy(w->frame.velocity, velocity, (size_t)w->model->nq * sizeof *velocity);
    return pm_program_run(w->model, w->request.program, w->numbers.param, w->numbers.value, w);
}

/* Out of an equilibrium: the side that is asked for, or 0. */
static double requested_side(pm_workspace *w, const pm_place *x)
{
    const double side = w->request.program == PM_NONE ? 0 : pm_path_requested(w, x->tangent);
    return side > 0 ? 1 : side < 0 ? -1 : 0;
}

/* At rest the forces tell which way it goes; 0: it stays. */
static int leave_rest(pm_workspace *w, const pm_place *x)
{
    pm_path *p = w->path;
    const double size = force_size(w, x);
    p->balanced = !(fabs(x->force) > BALANCED * size);
    p->sense = p->balanced ? requested_side(w, x) : (x->force > 0 ? 1 : -1);
    return p->sense != 0;
}

/* A prescribed rate makes the motion one in time. */
static int is_driven(const pm_workspace *w)
{
    for (int i = 0; i < w->active.n; i++)
        if (w->active.row[i].drive != PM_NONE) return 1;
    return 0;
}

static int applies(const pm_workspace *w)
{
    return w->model->programs.forces_by_place && !w->active.asymmetric && !w->numbers.massless &&
           !w->phase.path_left && !is_driven(w);
}

/* The tree of the phase and its first place; 0: more than one freedom, no direction there, or it stays at rest. */
static int prepare(pm_workspace *w)
{
    pm_path *p = w->path;
    pm_place *x = &p->begin;
    pm_tree_build(w);
    if (w->tree->n - w->tree->nloop != 1) return 0;
    p->n = w->tree->n;
    pm_tree_loops_unknown(w->tree, &p->loop);
    p->driver = PM_NONE;
    pm_path_bridge_forget(p);
    p->sense = 1;
    pm_frame_look_state(&w->frame, &w->state);
    pm_tree_read(w, x->y);
    pm_path_open_begin(w);
    if (pm_path_look(w, x) || pm_path_drive(w, x)) return 0;
    const double rate = rate_of(w, x, w->state.v);
    x->kinetic = 0.5 * x->mass * rate * rate;
    p->sense = rate > 0 ? 1 : -1;
    p->balanced = 0;
    p->at_rest = !(2 * x->kinetic > STILL * STILL * total_mass(w) * w->numbers.speed * w->numbers.speed);
    /* the contacts are met anew, to rounding: what the forces do on that way is not lost */
    for (int i = 0; i < w->model->nq; i++) x->kinetic += w->frame.f[i] * (x->q[i] - w->state.q[i]);
    if (p->at_rest) x->kinetic = 0;
    return !p->at_rest || leave_rest(w, x);
}

static int begin(pm_workspace *w)
{
    pm_path *p = w->path;
    const pm_place *x = &p->begin;
    const double *ledger = w->state.z + pm_ledger_ledger(w->model);
    double momentum[PM_LEDGER];
    p->fresh = 1;
    p->most = INFINITY;
    pm_path_error_begin(w, x->kinetic);
    p->way = 0;
    p->lowest = x->kinetic;
    p->energy = x->kinetic + x->potential - pm_path_work(w, w->state.z);
    pm_frame_look_state(&w->frame, &w->state);
    pm_body_momentum(&w->frame, PM_NONE, momentum);
    for (int i = 0; i < PM_LEDGER; i++) p->impulse[i] = ledger[i] - momentum[i];
    return PM_OK;
}

/* ---- one step ---- */
/* How far the driver may go so that no coordinate outruns the sampling. */
static double full_step(const pm_workspace *w, const pm_place *x)
{
    double h = INFINITY;
    for (int i = 0; i < w->path->n; i++) {
        const double most = pm_tree_is_angle(w, i) ? TURN / STEPS_PER_TURN : LENGTHS * w->numbers.size;
        const double factor = i == w->path->driver ? 1 : FASTER;
        if (x->slope[i] != 0) h = fmin(h, factor * most / fabs(x->slope[i]));
    }
    return h;
}

/* Newton's method stays on the branch of a loop, and contacts are seen, in safe steps only; the one out of an equilibrium
 * may be the only one on the path. */
static double step_factor(const pm_workspace *w)
{
    const int open = w->tree->nloop == 0 && w->model->rows[PM_TABLE_CONTACT] == w->nunreached;
    return open && !w->path->balanced ? FARTHER : 1;
}

/* The way to where the gap to a member would close if it went on closing at its present rate; INFINITY if it opens. */
static double way_to(pm_workspace *w, int contact, int member, double gap)
{
    double rate;
    pm_contact_member_gap(&w->frame, contact, member, &rate);
    rate *= w->path->sense;
    return gap > pm_contact_length(&w->frame) && rate < 0 ? -gap / rate : INFINITY;
}

/* The step may end soon: at the nearest contacts that seem to come, of a row on either side. */
static double next_contact(pm_workspace *w, const pm_place *x)
{
    double h = INFINITY;
    if (w->model->rows[PM_TABLE_CONTACT] == 0) return h;
    pm_frame_look(&w->frame, w->state.t, x->q, x->tangent, w->state.z, w->state.memory);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member[2];
        if (pm_contact_is_row(w->model, i)) {
            const int n = pm_contact_near(&w->frame, &w->state, i, 2, member);
            for (int k = 0; k < n; k++)
                h = fmin(h, way_to(w, i, member[k], pm_contact_gap_to(&w->frame, i, member[k])));
        } else {
            const double gap = pm_contact_gap(w, &w->state, i, member);
            if (!isinf(gap)) h = fmin(h, way_to(w, i, *member, gap));
        }
    }
    return BEYOND * h;
}

static void state_of(pm_workspace *w, const pm_place *x, double s, double t, pm_state *state)
{
    const pm_path *p = w->path;
    const double rate = p->sense * sqrt(2 * (x->kinetic > 0 ? x->kinetic : 0) / x->mass);
    memcpy(state->q, x->q, (size_t)w->model->nq * sizeof *x->q);
    for (int i = 0; i < w->model->nq; i++) state->v[i] = rate * x->tangent[i];
    if (w->model->nz_controlled > 0) pm_path_integrals(w, s, state->z);
    state->t = t;
}

/* How fast the bodies would move at the scene's speed where the motion turns back. */
static void set_turn(pm_workspace *w)
{
    const pm_place *x = &w->path->node[PM_NODES_MOST - 1];
    const double rate = w->path->sense * w->numbers.speed * sqrt(total_mass(w) / x->mass);
    for (int i = 0; i < w->model->nq; i++) w->step.reversed[i] = rate * x->tangent[i];
}

/* The node at x, or p->spare.  Nodes are mostly looked at in their order. */
static int place_at(pm_workspace *w, double x, const pm_place **place)
{
    pm_path *p = w->path;
    const int n = p->nodes->n;
    for (int i = 0, k = p->looked_at; i < n; i++) {
        k = k + 1 < n ? k + 1 : 0;
        if (x != p->h * p->nodes->at[k]) continue;
        p->looked_at = k;
        *place = pm_path_node(p, k);
        return PM_OK;
    }
    *place = &p->spare;
    return pm_path_inside(w, x / p->h);
}

static int at(pm_workspace *w, double x, pm_state *state)
{
    const pm_place *place;
    const double s = x / w->path->h;
    const int status = place_at(w, x, &place);
    if (!status) state_of(w, place, s, pm_path_clock_at(w->path, s), state);
    return status;
}

/* Poses are known, and at a place that the rows determine nothing is factored to have accelerations and reactions.  The
 * time is told where something that is sampled reads it. */
static int look(pm_workspace *w, double x, int level)
{
    const pm_place *place;
    const double s = x / w->path->h;
    const int status = place_at(w, x, &place);
    if (status) return status;
    state_of(w, place, s, w->model->programs.sample_time ? pm_path_clock_at(w->path, s) : w->path->clock.t0,
             &w->probe);
    memcpy(w->frame.pose, place->pose, 5 * (size_t)w->model->nbody * sizeof *place->pose);
    pm_frame_look_placed(&w->frame, &w->state, w->probe.q, w->probe.v);
    w->frame.t = w->probe.t;
    w->frame.z = w->probe.z;
    if (level < PM_LEVEL_DYNAMIC) return PM_OK;
    if (!place->determined || pm_joint_friction_by_load(w)) return pm_saddle_accelerate(w);
    if (w->tree->nloop > 0) return pm_path_accelerate(w, place->tangent);
    pm_path_open_accelerate(w, place);
    return PM_OK;
}

/* The impulse of the outer world is read off the momentum: this route does not know the forces over time.  The frame looks at
 * the state. */
static void close_momentum(pm_workspace *w, pm_state *state)
{
    double *ledger = state->z + pm_ledger_ledger(w->model), momentum[PM_LEDGER];
    pm_body_momentum(&w->frame, PM_NONE, momentum);
    for (int i = 0; i < PM_LEDGER; i++) ledger[i] = w->path->impulse[i] + momentum[i];
}

static int exact(pm_workspace *w, double x, pm_state *state)
{
    pm_state_copy(state, &w->state);
    const int status = at(w, x, state);
    pm_frame_look_state(&w->frame, state);
    if (!status) close_momentum(w, state);
    return status;
}

/* ---- evidence that the route itself does not use ---- */
/* The work of all forces against the energy. */
static double open_work(const pm_workspace *w)
{
    const pm_path *p = w->path;
    const double first = p->node[0].potential, last = p->node[PM_NODES_MOST - 1].potential;
    double scale = w->ledger.energy_scale, z = 0; /* the step may begin and end at rest */
    for (int k = 0; k < p->nodes->n; k++) scale = pm_max(p->node[k * p->every].kinetic, scale);
    if (!(scale > 0) || pm_chebyshev_tail(p->nodes, p->force) >= PM_WORK_TAIL) return 0;
    const double work = p->h * pm_chebyshev_whole(p->nodes, p->force);
    if (w->model->nz_work > 0) z = pm_path_work(w, w->state.z) - pm_path_work(w, p->weight);
    const double rounding = ROUNDINGS * DBL_EPSILON * fmax(fabs(first), fabs(last));
    return fmax(fabs(first - last + z - work) - rounding, 0) / scale;
}

/* The direction of the motion at the end against the rows, which were evaluated there and which the tree knows nothing of:
 * the greatest part of it that breaks one. */
static double broken_row(const pm_workspace *w)
{
    const double *t = w->path->node[PM_NODES_MOST - 1].tangent;
    double fastest = 0, worst = 0;
    for (int i = 0; i < w->model->nq; i++)
        fastest = pm_max(fabs(t[i]) * (i % 3 == 2 ? w->numbers.size : 1), fastest);
    for (int i = 0; i < w->active.n; i++) {
        const double *j = w->active.row[i].j, off = fabs(pm_saddle_times(&w->frame, &w->active.row[i], t));
        double size = 0;
        for (int k = 0; k < 6; k++) size += fabs(j[k]) / (k % 3 == 2 ? w->numbers.size : 1);
        worst = pm_max(off / (size * fastest), worst);
    }
    return worst;
}

/* What the forces of the frame do along it, against dT/du. */
static double missed_force(const pm_workspace *w)
{
    const pm_place *last = &w->path->node[PM_NODES_MOST - 1];
    const double size = force_size(w, last);
    double force = 0;
    for (int i = 0; i < w->model->nq; i++) force += w->frame.f[i] * last->tangent[i];
    return size > 0 ? fabs(force - last->force) / size : 0;
}

static void look_for_evidence(pm_workspace *w)
{
    pm_force_all(w);
    pm_saddle_evaluate(&w->active, &w->frame);
    w->ledger.evidence = pm_max(open_work(w), w->ledger.evidence);
    w->ledger.evidence = pm_max(broken_row(w), w->ledger.evidence);
    w->ledger.evidence = pm_max(missed_force(w), w->ledger.evidence);
}

static double after_limit(void *of, double s, void *t_limit)
{
    const pm_workspace *w = of;
    return pm_path_clock_at(w->path, s) - *(double *)t_limit;
}

/* Shortens the step to where the time is t_limit. */
static int end_at_limit(pm_workspace *w, double t_limit)
{
    pm_path *p = w->path;
    if (p->clock.kind == PM_CLOCK_NONE || !(w->state.t > t_limit)) return PM_OK;
    double s;
    int status = pm_fail_search(w, pm_bracket_find(w->event->solver, after_limit, w, &t_limit, 0,
                                                   p->clock.t0 - t_limit, 1, w->state.t - t_limit, &s));
    if (!status) status = at(w, s * p->h, &w->state);
    w->state.t = t_limit;
    w->step.end = s * p->h;
    w->step.reverses = 0;
    return status;
}

/* The places of the last step serve again if the step is as long as that was. */
static double repeat(pm_workspace *w, double full)
{
    pm_path *p = w->path;
    p->filled = p->repeats && fabs(full - p->h) <= SAME * full;
    p->repeats = 0;
    if (!p->filled) return full;
    return p->h;
}

static int step(pm_workspace *w, double t_limit)
{
    pm_path *p = w->path;
    p->repeats = p->repeats && p->fresh && !p->at_rest && pm_path_cycle(w);
    if (p->repeats) pm_path_cycle_of(w, p->begin.kinetic);
    copy_place(w, &p->node[0], p->fresh ? &p->begin : &p->node[PM_NODES_MOST - 1]);
    if (!p->fresh) p->at_rest = p->balanced = 0;
    p->fresh = 0;
    int status = pm_path_drive(w, &p->node[0]);
    p->told_by = p->driver;
    p->told_sense = p->sense;
    p->u0 = p->node[0].y[p->driver];
    p->clock.t0 = w->state.t;
    memcpy(p->weight, w->state.z, (size_t)w->model->nz_controlled * sizeof(double));
    const int may_close = pm_tree_is_angle(w, p->driver);
    p->safe = w->numbers.coarse * full_step(w, &p->node[0]);
    const double full =
        fmin(fmin(p->most, step_factor(w) * p->safe), w->numbers.coarse * next_contact(w, &p->node[0]));
    if (!status) status = pm_path_take_step(w, repeat(w, may_close ? fmin(full, TURN - p->way) : full));
    if (status) return status;
    if (w->step.reverses) set_turn(w);
    w->step.begin = 0;
    w->step.end = p->h;
    p->way += p->h;
    const int hands_over = p->balanced && PM_SETTING(w->model, PM_SETTING_ROUTE) != PM_ROUTE_AUTO &&
                           PM_SETTING(w->model, PM_SETTING_ROUTE) != PM_ROUTE_PATH;
    w->phase.lap = hands_over || (may_close && p->way > TURN * (1 - ROUNDING));
    state_of(w, &p->node[PM_NODES_MOST - 1], 1, pm_path_clock_at(p, 1), &w->state);
    w->step.nodes = p->nodes;
    pm_frame_look_state(&w->frame, &w->state);
    look_for_evidence(w);
    if ((status = end_at_limit(w, t_limit))) return status;
    if (w->step.end != p->h) pm_frame_look_state(&w->frame, &w->state);
    close_momentum(w, &w->state);
    pm_path_error_step(w, p->node[PM_NODES_MOST - 1].kinetic);
    w->result.count[PM_COUNT_STEPS]++;
    pm_case_speed(w, w->state.v);
    return PM_OK;
}

const pm_route_ops pm_route_path = {
    .route = PM_ROUTE_PATH,
    .create = create,
    .free = destroy,
    .applies = applies,
    .prepare = prepare,
    .begin = begin,
    .step = step,
    .at = at,
    .exact = exact,
    .look = look,
    .react = pm_path_react,
    .sampled = pm_path_error_sampled,
    .error_of = pm_path_error_answer,
    .accelerate = pm_path_bridge_accelerate,
    .in_time = 0,
    .meets_places = 1,
    .on_tree = 1,
    .reuses_segments = 1,
    .when_lost = PM_LOST_TO_NEXT_RULE,
    .price = 2,
    .finest = PM_CLOCK_TAIL,
    .spread = 45,
    .nodes = &pm_chebyshev_nodes_9,
};
