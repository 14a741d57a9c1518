/* route_path.c - one degree of freedom, forces that depend on position only: the principle of work and energy along the
 * configuration path (17.1), (17.9) of the book.
 *
 *   T(u) = T1 + V1 - V(u) + work of forces without potential,   T = mass(u) (du/dt)^2 / 2
 *
 * u is the driver of path_place.c.  Every place on the path is met exactly, so that neither positions nor speeds carry any
 * error of integration; the time, where anybody asks for it, is the integral of sqrt(mass / 2T), with the root taken out
 * where the step begins or ends at rest.  The motion turns back where T vanishes. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "audit.h"
#include "body.h"
#include "case.h"
#include "contact.h"
#include "event.h"
#include "grip.h"
#include "nudge.h"
#include "path.h"
#include "path_bridge.h"
#include "path_clock.h"
#include "path_error.h"
#include "root.h"
#include "route.h"
#include "row.h"
#include "saddle.h"
#include "series.h"
#include "spin.h"
#include "tree.h"

#define TURN (2 * 3.14159265358979323846)
#define STEPS_PER_TURN 8
#define LENGTHS 0.5 /* of the scene's size: longest step of a coordinate that is a length */
#define FARTHER \
    4.0 /* steps where no loop must be closed and no contact is near, if the nodes resolve the motion */
#define FORM_TAIL 1e-8   /* highest coefficients of T in such steps, and in any that fewer nodes may do for */
#define LENGTHEN 2.0     /* a step that was resolved, at the most */
#define FASTER 2.0       /* other coordinates may go this much farther than the driver */
#define CLOCK_TAIL 1e-13 /* highest coefficients of the integrand of the time, at the least */
#define TAIL 30          /* times the tolerance, if that is more: the integral is some 1000 times better */
#define WORK_TAIL 1e-12  /* the same of the rates of work */
#define BEYOND 1.2       /* of the way to a contact that seems to come: the step shall see it */
#define PART 0.25        /* of a full step: a way to a turning point that a companion takes in two steps */
#define SHORTEST 1e-12   /* of a full step */
#define ROUNDING 1e-14
#define DOUBLE_ROUNDING 2.2e-16
#define ROUNDINGS 8    /* that a difference of potentials may hold */
#define STILL 1e-11    /* of the scene's speed: at rest */
#define BALANCED 1e-12 /* of the forces: in equilibrium */

/* ---- memory ---- */
static size_t doubles_of_place(const pm_model *m)
{
    return 4 * (size_t)m->nq + (size_t)m->nz_controlled + 5 * (size_t)m->nbody;
}

static double *carve(const pm_model *m, pm_place *x, double *p)
{
    x->y = p;
    x->slope = x->y + m->nq;
    x->q = x->slope + m->nq;
    x->tangent = x->q + m->nq;
    x->rate = x->tangent + m->nq;
    x->pose = x->rate + m->nz_controlled;
    return p + doubles_of_place(m);
}

static int create(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_path *p = w->path = calloc(1, sizeof *p);
    if (!p) return PM_NO_MEMORY;
    const size_t n = (size_t)m->nq, nz = (size_t)m->nz_controlled, places = PM_NODES_MOST + 1;
    double *block = p->block = calloc(
        places * doubles_of_place(m) + n * n + n + 2 * nz + (5 + PM_BRIDGE_PLACES) * n + 1, sizeof *block);
    if (!block) return PM_NO_MEMORY;
    for (int k = 0; k < PM_NODES_MOST; k++) block = carve(m, &p->node[k], block);
    block = carve(m, &p->spare, block);
    p->loop = block;
    p->work = p->loop + n * n;
    p->weight = p->work + nz;
    p->bridge.known_y = p->weight + nz;
    p->bridge.known_slope = p->bridge.known_y + n;
    p->bridge.y = p->bridge.known_slope + n;
    p->bridge.slope = p->bridge.y + n;
    p->bridge.bend = p->bridge.slope + n;
    p->bridge.c = p->bridge.bend + n;
    p->column = (int *)(void *)(p->bridge.c + PM_BRIDGE_PLACES * n);
    return PM_OK;
}

static void destroy(pm_workspace *w)
{
    if (!w->path) return;
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
    to->potential = from->potential;
    to->force = from->force;
    to->kinetic = from->kinetic;
}

static double work_so_far(const pm_workspace *w, const double *z)
{
    double sum = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_FORCE]; i++)
        if (w->model->force_z[i] != PM_NONE) sum += z[w->model->force_z[i]];
    return sum;
}

static double total_mass(const pm_workspace *w)
{
    double sum = 0;
    for (int i = 0; i < w->model->nbody; i++) sum += w->mass[i];
    return sum;
}

/* Rate of the driver from given velocities: their part along the path. */
static double rate_of(const pm_workspace *w, const pm_place *x, const double *v)
{
    double sum = 0;
    for (int i = 0; i < w->model->nbody; i++)
        sum += w->mass[i] * (v[3 * i] * x->tangent[3 * i] + v[3 * i + 1] * x->tangent[3 * i + 1]) +
               pm_body_inertia(w, i) * v[3 * i + 2] * x->tangent[3 * i + 2];
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
    return size + pm_spin_force_size(w, x->tangent);
}

/* At rest the forces tell which way it goes; out of an equilibrium the nudge does; 0: it stays. */
static int leave_rest(pm_workspace *w, const pm_place *x)
{
    pm_path *p = w->path;
    const double size = force_size(w, x);
    p->balanced = !(fabs(x->force) > BALANCED * size);
    p->sense = !p->balanced ? (x->force > 0 ? 1 : -1) : pm_nudge_waits(w) ? pm_nudge_side(w, x->tangent) : 0;
    return p->sense != 0;
}

/* A prescribed rate makes the motion one in time. */
static int is_driven(const pm_workspace *w)
{
    for (int i = 0; i < w->nactive; i++)
        if (w->row[i].drive != PM_NONE) return 1;
    return 0;
}

static int applies(pm_workspace *w)
{
    pm_path *p = w->path;
    pm_place *x = &p->node[PM_NODES_MOST - 1];
    if (!w->model->forces_by_place || w->asymmetric || w->massless || w->path_left || is_driven(w)) return 0;
    pm_tree_build(w);
    if (w->tree->n - w->tree->nloop != 1) return 0;
    p->n = w->tree->n;
    p->driver = PM_NONE;
    pm_bridge_forget(p);
    p->sense = 1;
    pm_frame_look_state(w, &w->state);
    pm_tree_read(w, x->y);
    if (pm_path_look(w, x) || pm_path_drive(w, x)) return 0;
    const double rate = rate_of(w, x, w->state.v);
    x->kinetic = 0.5 * x->mass * rate * rate;
    p->sense = rate > 0 ? 1 : -1;
    p->balanced = 0;
    p->at_rest = !(2 * x->kinetic > STILL * STILL * total_mass(w) * w->speed * w->speed);
    /* the contacts are met anew, to rounding: what the forces do on that way is not lost */
    for (int i = 0; i < w->model->nq; i++) x->kinetic += w->frame.f[i] * (x->q[i] - w->state.q[i]);
    if (p->at_rest) x->kinetic = 0;
    return !p->at_rest || leave_rest(w, x);
}

static int begin(pm_workspace *w)
{
    pm_path *p = w->path;
    const pm_place *x = &p->node[PM_NODES_MOST - 1];
    const double *ledger = w->state.z + pm_audit_ledger(w->model);
    double momentum[PM_LEDGER];
    p->fresh = 1;
    p->most = INFINITY;
    pm_path_error_begin(w, x->kinetic);
    p->way = 0;
    p->lowest = x->kinetic;
    p->energy = x->kinetic + x->potential - work_so_far(w, w->state.z);
    pm_frame_look_state(w, &w->state);
    pm_body_momentum(w, PM_NONE, momentum);
    for (int i = 0; i < PM_LEDGER; i++) p->impulse[i] = ledger[i] - momentum[i];
    return PM_OK;
}

/* ---- one step ---- */
/* How far the driver may go so that no coordinate outruns the sampling. */
static double full_step(const pm_workspace *w, const pm_place *x)
{
    double h = INFINITY;
    for (int i = 0; i < w->path->n; i++) {
        const double most = pm_tree_is_angle(w, i) ? TURN / STEPS_PER_TURN : LENGTHS * w->size;
        const double factor = i == w->path->driver ? 1 : FASTER;
        if (x->slope[i] != 0) h = fmin(h, factor * most / fabs(x->slope[i]));
    }
    return h;
}

/* Newton's method stays on the branch of a loop, and contacts are seen, in safe steps only; the one out of an equilibrium
 * may be the only one on the path. */
static double step_factor(const pm_workspace *w)
{
    const int open = w->tree->nloop == 0 && w->model->rows[PM_TABLE_CONTACT] == w->unreached;
    return open && !w->path->balanced ? FARTHER : 1;
}

/* The step may end soon: where the nearest gap would close if it went on closing at its present rate. */
static double next_contact(pm_workspace *w, const pm_place *x)
{
    double h = INFINITY;
    if (w->model->rows[PM_TABLE_CONTACT] == 0) return h;
    pm_frame_look(w, w->state.t, x->q, x->tangent, w->state.z, w->state.memory);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member;
        double rate;
        const double gap = pm_contact_gap(w, &w->state, i, &member);
        if (!(gap > pm_contact_length(w)) || isinf(gap)) continue;
        pm_contact_member_gap(w, i, member, &rate);
        rate *= w->path->sense;
        if (rate < 0) h = fmin(h, -gap / rate);
    }
    return BEYOND * h;
}

static pm_place *node_of(pm_path *p, int k) { return &p->node[k * p->every]; }

/* From one node to the next, in the arrays of places. */
static int stride_of(const pm_path *p, const double *first, const double *second)
{
    return p->every * (int)(second - first);
}

/* A guess of the coordinates at node k: the cubic through the two nodes before it and their slopes, or the tangent. */
static void guess_node(pm_path *p, int k, double *y)
{
    const double *at = p->nodes->at;
    const pm_place *b = node_of(p, k - 1);
    const double step = p->sense * p->h * (at[k] - at[k - 1]);
    if (k == 1) {
        for (int i = 0; i < p->n; i++) y[i] = b->y[i] + step * b->slope[i];
        return;
    }
    const pm_place *a = node_of(p, k - 2);
    const double width = p->sense * p->h * (at[k - 1] - at[k - 2]), x = step / width;
    for (int i = 0; i < p->n; i++) {
        const double rise = (b->y[i] - a->y[i]) / width, da = a->slope[i] - rise, db = b->slope[i] - rise;
        y[i] = b->y[i] + step * (b->slope[i] + x * (da + 2 * db + x * (da + db)));
    }
}

/* The running integrals at the fraction s of the step: works go by the way of the driver, distances by its length. */
static void integrals_at(const pm_workspace *w, double s, double *z)
{
    const pm_path *p = w->path;
    const int stride = stride_of(p, p->node[0].rate, p->node[1].rate);
    for (int i = 0; i < w->model->nz_controlled; i++) {
        const double way = i < w->model->nz_work ? p->sense * p->h : p->h;
        z[i] = p->weight[i] + way * pm_series_integral(p->nodes, p->node[0].rate + i, stride, s);
    }
}

static int rates_resolved(const pm_workspace *w)
{
    const pm_path *p = w->path;
    double value[PM_NODES_MOST];
    for (int i = 0; i < w->model->nz_controlled; i++) {
        for (int k = 0; k < p->nodes->n; k++) value[k] = p->node[k * p->every].rate[i];
        if (pm_series_tail(p->nodes, value) > WORK_TAIL) return 0;
    }
    return 1;
}

/* Where T is least between the nodes is found by a polynomial.  The mass is computed at each place; only the clock takes it
 * from a polynomial, and looks to that itself. */
static int motion_resolved(const pm_path *p)
{
    double kinetic[PM_NODES_MOST];
    for (int k = 0; k < p->nodes->n; k++) kinetic[k] = p->node[k * p->every].kinetic;
    return pm_series_tail(p->nodes, kinetic) <= FORM_TAIL;
}

/* By the energy. */
static double kinetic_at(const pm_workspace *w, const pm_place *x, double s)
{
    const pm_path *p = w->path;
    if (w->model->nz_work == 0) return p->energy - x->potential;
    integrals_at(w, s, w->path->work);
    return p->energy - x->potential + work_so_far(w, p->work);
}

/* Small differences of large potentials are lost in their rounding; the work over a short way is not, where the nodes
 * resolve the forces. */
static int work_is_better(const pm_path *p)
{
    double greatest = 0;
    for (int k = 0; k < p->nodes->n; k++) greatest = fmax(greatest, fabs(p->force[k]));
    return pm_series_tail(p->nodes, p->force) * greatest * p->h <=
           DOUBLE_ROUNDING * fmax(fabs(p->energy), fabs(p->node[0].potential));
}

/* Forces and T at the nodes, whose places are known. */
static void set_kinetics(pm_workspace *w)
{
    pm_path *p = w->path;
    const int n = p->nodes->n;
    double work[PM_NODES_MOST];
    for (int k = 0; k < n; k++) p->force[k] = p->sense * node_of(p, k)->force;
    p->by_work = work_is_better(p);
    if (p->by_work) pm_series_integrals(p->nodes, p->force, work);
    for (int k = 1; k < n; k++) {
        pm_place *x = node_of(p, k);
        x->kinetic = p->by_work ? p->node[0].kinetic + p->h * work[k] : kinetic_at(w, x, p->nodes->at[k]);
    }
}

/* The nodes of a step of length h from node 0: every second one. */
static int fill(pm_workspace *w, double h)
{
    pm_path *p = w->path;
    p->h = h;
    p->nodes = &pm_nodes_9;
    p->every = 2;
    for (int k = 1; k < p->nodes->n; k++) {
        pm_place *x = node_of(p, k);
        guess_node(p, k, x->y);
        const int status = pm_path_place(w, p->u0 + p->sense * (h * p->nodes->at[k]), x);
        if (status) return status;
    }
    set_kinetics(w);
    return PM_OK;
}

/* The others. */
static int fill_between(pm_workspace *w)
{
    pm_path *p = w->path;
    const double *at = pm_nodes_17.at;
    const int stride = stride_of(p, p->node[0].y, p->node[1].y);
    for (int k = 1; k < pm_nodes_17.n; k += 2) {
        pm_place *x = &p->node[k];
        for (int i = 0; i < p->n; i++) x->y[i] = pm_series_value(p->nodes, p->node[0].y + i, stride, at[k]);
        const int status = pm_path_place(w, p->u0 + p->sense * (p->h * at[k]), x);
        if (status) return status;
    }
    p->nodes = &pm_nodes_17;
    p->every = 1;
    set_kinetics(w);
    return PM_OK;
}

/* The place at the fraction s of the filled step, in p->spare. */
static int place_inside(pm_workspace *w, double s)
{
    pm_path *p = w->path;
    const int stride = stride_of(p, p->node[0].y, p->node[1].y);
    for (int k = 0; k < p->n; k++) p->spare.y[k] = pm_series_value(p->nodes, p->node[0].y + k, stride, s);
    const int status = pm_path_place(w, p->u0 + p->sense * p->h * s, &p->spare);
    if (status) return status;
    if (p->by_work) {
        double kinetic[PM_NODES_MOST];
        for (int k = 0; k < p->nodes->n; k++) kinetic[k] = node_of(p, k)->kinetic;
        p->spare.kinetic = pm_series_value(p->nodes, kinetic, 1, s);
    } else {
        p->spare.kinetic = kinetic_at(w, &p->spare, s);
    }
    return PM_OK;
}

/* T on the exact place at the fraction s of the filled step. */
static double exact_kinetic(pm_workspace *w, double s, void *context)
{
    (void)context;
    return place_inside(w, s) ? NAN : w->path->spare.kinetic;
}

/* The way to the first place of the step where T vanishes; INFINITY if there is none. */
static int find_turning(pm_workspace *w, double *way)
{
    pm_path *p = w->path;
    const pm_nodes *nodes = p->nodes;
    double s;
    p->least = *way = INFINITY;
    for (int k = 1; k < nodes->n; k++) {
        const double before = node_of(p, k - 1)->kinetic, after = node_of(p, k)->kinetic;
        double low = nodes->at[k], lowest = after;
        if (after > 0 && p->force[k - 1] < 0 && p->force[k] > 0) { /* a dip between the nodes */
            const int status = pm_series_root(w, nodes, p->force, nodes->at[k - 1], p->force[k - 1],
                                              nodes->at[k], p->force[k], &low);
            if (status || (lowest = exact_kinetic(w, low, NULL), isnan(lowest))) return status;
            pm_path_error_barrier(w, lowest);
        }
        p->least = fmin(p->least, lowest);
        if (lowest > 0) continue;
        const int status = before > 0 ? pm_root_find(w, w->event->solver, exact_kinetic, NULL,
                                                     nodes->at[k - 1], before, low, lowest, &s)
                                      : PM_OK;
        *way = before > 0 ? s * p->h : 0;
        return status;
    }
    return PM_OK;
}

/* T vanishes at the end; where the work of the forces tells it, that is counted from there. */
static void end_at_rest(pm_path *p)
{
    const double left = p->node[PM_NODES_MOST - 1].kinetic;
    for (int k = 0; k < p->nodes->n && p->by_work; k++) node_of(p, k)->kinetic -= left;
    p->node[PM_NODES_MOST - 1].kinetic = 0;
}

/* Is the filled step one that can be taken?  *next is a shorter one to try instead, or 0. */
static int judge(pm_workspace *w, int turning, double *next)
{
    pm_path *p = w->path;
    const int half = p->every > 1 || p->h > p->safe; /* else what is not smooth is sampled as it is */
    *next = 0;
    if ((w->model->nz_controlled > 0 && !rates_resolved(w)) || (half && !motion_resolved(p)))
        *next = 0.5 * p->h;
    if (turning) {
        end_at_rest(p);
    } else if (*next == 0) {
        double way;
        const int status = find_turning(w, &way);
        if (status) return status;
        if (way < INFINITY) *next = p->at_rest ? 0.5 * way : way; /* each root needs a step of its own */
    }
    if (*next > 0) return PM_OK;
    const int watched = w->model->reads_time || w->trace;
    const int clock = !watched || p->balanced ? PM_CLOCK_NONE
                      : p->at_rest            ? PM_CLOCK_LEAVES
                      : turning               ? PM_CLOCK_RESTS
                                              : PM_CLOCK_PLAIN;
    if (!pm_clock_set(p, clock, fmax(TAIL * w->tolerance, CLOCK_TAIL))) *next = 0.5 * p->h;
    return PM_OK;
}

/* Tries a step of length h, with more nodes if few do not resolve it; *next as above. */
static int try_step(pm_workspace *w, double h, int turning, double *next)
{
    pm_path *p = w->path;
    int status = fill(w, h);
    if (!status) status = judge(w, turning, next);
    if (!status && *next == 0.5 * h && p->every > 1) {
        status = fill_between(w);
        if (!status) status = judge(w, turning, next);
    }
    if (status != PM_SINGULAR && status != PM_ASSEMBLY) return status;
    *next = 0.5 * h;
    return PM_OK;
}

static int take_step(pm_workspace *w, double full)
{
    pm_path *p = w->path;
    double h = full, next;
    int turning = 0, halved = 0;
    p->tail = INFINITY;
    for (;;) {
        const int status = try_step(w, h, turning, &next);
        if (status) return status;
        if (next == 0) break;
        turning = next != 0.5 * h && !p->at_rest;             /* not a halving: the way to a turning point */
        if (turning && w->coarse > 1 && next > PART * full) { /* other steps in a companion */
            next *= 0.5;
            turning = 0;
        }
        halved |= next == 0.5 * h;
        h = next;
        if (!(h > SHORTEST * full))
            return pm_fail(w, PM_STEP_TOO_SMALL, PM_NONE, PM_NONE, h, SHORTEST * full);
    }
    if (halved)
        p->most = h;
    else if (p->every > 1)
        p->most *= LENGTHEN;
    w->turns = turning;
    p->lowest = fmin(p->lowest, turning ? 0 : p->least);
    if (turning) {
        const pm_place *x = &p->node[PM_NODES_MOST - 1];
        const double rate = p->sense * w->speed * sqrt(total_mass(w) / x->mass);
        for (int i = 0; i < w->model->nq; i++) w->turn[i] = rate * x->tangent[i];
    }
    return PM_OK;
}

static void state_of(pm_workspace *w, const pm_place *x, double s, double t, pm_state *state)
{
    const pm_path *p = w->path;
    const double rate = p->sense * sqrt(2 * fmax(x->kinetic, 0) / x->mass);
    memcpy(state->q, x->q, (size_t)w->model->nq * sizeof *x->q);
    for (int i = 0; i < w->model->nq; i++) state->v[i] = rate * x->tangent[i];
    if (w->model->nz_controlled > 0) integrals_at(w, s, state->z);
    state->t = t;
}

/* The node at x, or p->spare. */
static int place_at(pm_workspace *w, double x, const pm_place **place)
{
    pm_path *p = w->path;
    for (int k = 0; k < p->nodes->n; k++)
        if (x == p->h * p->nodes->at[k]) {
            *place = node_of(p, k);
            return PM_OK;
        }
    *place = &p->spare;
    return place_inside(w, x / p->h);
}

static int at(pm_workspace *w, double x, pm_state *state)
{
    const pm_place *place;
    const double s = x / w->path->h;
    const int status = place_at(w, x, &place);
    if (!status) state_of(w, place, s, pm_clock_at(w->path, s), state);
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
    state_of(w, place, s, w->model->samples_time ? pm_clock_at(w->path, s) : w->path->t0, &w->probe);
    memcpy(w->frame.pose, place->pose, 5 * (size_t)w->model->nbody * sizeof *place->pose);
    pm_frame_look_placed(w, w->probe.q, w->probe.v);
    w->frame.t = w->probe.t;
    w->frame.z = w->probe.z;
    if (level < PM_LEVEL_DYNAMIC) return PM_OK;
    return place->determined && !pm_grip_by_load(w) ? pm_path_accelerate(w, place->tangent)
                                                    : pm_saddle_accelerate(w);
}

/* The impulse of the outer world is read off the momentum: this route does not know the forces over time. */
static void close_momentum(pm_workspace *w, pm_state *state)
{
    double *ledger = state->z + pm_audit_ledger(w->model), momentum[PM_LEDGER];
    pm_frame_look_state(w, state);
    pm_body_momentum(w, PM_NONE, momentum);
    for (int i = 0; i < PM_LEDGER; i++) ledger[i] = w->path->impulse[i] + momentum[i];
}

static int exact(pm_workspace *w, double x, pm_state *state)
{
    pm_state_copy(state, &w->state);
    const int status = at(w, x, state);
    if (!status) close_momentum(w, state);
    return status;
}

/* Evidence that the route itself does not use: the work of all forces against the energy, and the acceleration that the
 * saddle-point system gives against dT/du. */
static int look_for_evidence(pm_workspace *w)
{
    pm_path *p = w->path;
    double scale = 0, acceleration = 0, z = 0;
    const pm_place *first = &p->node[0], *last = &p->node[PM_NODES_MOST - 1];
    const double work = p->h * pm_series_integral(p->nodes, p->force, 1, 1);
    scale = w->energy_scale; /* the step may begin and end at rest */
    for (int k = 0; k < p->nodes->n; k++) scale = fmax(scale, node_of(p, k)->kinetic);
    if (w->model->nz_work > 0) z = work_so_far(w, w->state.z) - work_so_far(w, p->weight);
    const double rounding = ROUNDINGS * DOUBLE_ROUNDING * fmax(fabs(first->potential), fabs(last->potential));
    const double open = fabs(first->potential - last->potential + z - work) - rounding;
    if (scale > 0 && pm_series_tail(p->nodes, p->force) < WORK_TAIL)
        w->evidence = fmax(w->evidence, fmax(open, 0) / scale);
    pm_frame_look_state(w, &w->state);
    const int status = pm_saddle_accelerate(w);
    if (status) return status == PM_SINGULAR ? PM_OK : status;
    double size = force_size(w, last);
    for (int i = 0; i < w->model->nq; i++) {
        if (w->inverse_mass[i] == 0) continue;
        const double part = last->tangent[i] * w->frame.a[i] / w->inverse_mass[i];
        acceleration += part;
        size += fabs(part);
    }
    if (size > 0) w->evidence = fmax(w->evidence, fabs(acceleration - last->force) / size);
    return PM_OK;
}

static double after_limit(pm_workspace *w, double s, void *t_limit)
{
    return pm_clock_at(w->path, s) - *(double *)t_limit;
}

/* Shortens the step to where the time is t_limit. */
static int end_at_limit(pm_workspace *w, double t_limit)
{
    pm_path *p = w->path;
    if (p->clock == PM_CLOCK_NONE || !(w->state.t > t_limit)) return PM_OK;
    double s;
    int status = pm_root_find(w, w->event->solver, after_limit, &t_limit, 0, p->t0 - t_limit, 1,
                              w->state.t - t_limit, &s);
    if (!status) status = at(w, s * p->h, &w->state);
    w->state.t = t_limit;
    w->step_end = s * p->h;
    w->turns = 0;
    return status;
}

static int step(pm_workspace *w, double t_limit)
{
    pm_path *p = w->path;
    copy_place(w, &p->node[0], &p->node[PM_NODES_MOST - 1]);
    if (!p->fresh) p->at_rest = p->balanced = 0;
    p->fresh = 0;
    int status = pm_path_drive(w, &p->node[0]);
    p->u0 = p->node[0].y[p->driver];
    p->t0 = w->state.t;
    memcpy(p->weight, w->state.z, (size_t)w->model->nz_controlled * sizeof(double));
    const int may_close = pm_tree_is_angle(w, p->driver);
    p->safe = w->coarse * full_step(w, &p->node[0]);
    const double full =
        fmin(fmin(p->most, step_factor(w) * p->safe), w->coarse * next_contact(w, &p->node[0]));
    if (!status) status = take_step(w, may_close ? fmin(full, TURN - p->way) : full);
    if (status) return status;
    w->step_begin = 0;
    w->step_end = p->h;
    p->way += p->h;
    const int hands_over = p->balanced && PM_SETTING(w->model, PM_SETTING_ROUTE) != PM_ROUTE_AUTO &&
                           PM_SETTING(w->model, PM_SETTING_ROUTE) != PM_ROUTE_PATH;
    w->lap = hands_over || (may_close && p->way > TURN * (1 - ROUNDING));
    state_of(w, &p->node[PM_NODES_MOST - 1], 1, pm_clock_at(p, 1), &w->state);
    w->nodes = p->nodes;
    if ((status = look_for_evidence(w)) || (status = end_at_limit(w, t_limit))) return status;
    close_momentum(w, &w->state);
    pm_path_error_step(w, p->node[PM_NODES_MOST - 1].kinetic);
    w->count[PM_COUNT_STEPS]++;
    pm_case_speed(w, w->state.v);
    return PM_OK;
}

const pm_route_ops pm_route_path = {
    .route = PM_ROUTE_PATH,
    .create = create,
    .free = destroy,
    .applies = applies,
    .begin = begin,
    .step = step,
    .at = at,
    .exact = exact,
    .look = look,
    .accelerate = pm_bridge_accelerate,
    .finds_roots = PM_ROOTS_NONE,
    .in_time = 0,
    .price = 2,
    .finest = CLOCK_TAIL,
    .spread = 45,
    .nodes = &pm_nodes_9,
};
