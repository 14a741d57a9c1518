/* route_path.c - one degree of freedom, forces that depend on position only: the principle of work and energy along the
 * configuration path (17.1), (17.9) of the book.
 *
 *   T(u) = T1 + V1 - V(u) + work of forces without potential,   T = mass(u) (du/dt)^2 / 2
 *
 * u is the driver of path_place.c.  Every place on the path is met exactly, so that neither positions nor speeds carry any
 * error of integration; the time, where anybody asks for it, is the integral of sqrt(mass / 2T), with the root taken out
 * where the step begins or ends at rest.  The motion reverses where T vanishes. */
#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "elements/contact_pattern.h"
#include "elements/edge.h"
#include "elements/joint_friction.h"
#include "equations/case.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "numerics/bracket.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"
#include "tree/tree.h"

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
    if (PM_ARENA_NEW(&w->memory, w->path)) return PM_NO_MEMORY;
    pm_path *p = w->path;
    const size_t n = (size_t)m->nq, nz = (size_t)m->nz_controlled;
    pm_bridge *b = &p->bridge;
    double *place;
    const pm_array array[] = {
        PM_ARRAY(place, (PM_NODES_MOST + 2) * doubles_of_place(m)),
        PM_ARRAY(p->loop.entry, n * n),
        PM_ARRAY(p->work, nz),
        PM_ARRAY(p->weight, nz),
        PM_ARRAY(b->known_y, n),
        PM_ARRAY(b->known_slope, n),
        PM_ARRAY(b->y, n),
        PM_ARRAY(b->slope, n),
        PM_ARRAY(b->bend, n),
        PM_ARRAY(b->c, PM_BRIDGE_PLACES * n),
        PM_ARRAY(p->inertia, m->nbody),
        PM_ARRAY(p->column, n),
        PM_ARRAY(p->loop.low, n),
        PM_ARRAY(p->loop.high, n),
        PM_ARRAY(p->rigid.body, m->nbody + 1),
    };
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    if (status) return status;
    for (int k = 0; k < PM_NODES_MOST; k++) place = carve(m, &p->node[k], place);
    carve(m, &p->begin, carve(m, &p->spare, place));
    pm_path_clock_fill_table(&p->clock.table);
    return pm_path_aside_create(w);
}

/* ---- a phase ---- */
static void copy_place(const pm_model *model, pm_place *to, const pm_place *from)
{
    memcpy(to->y, from->y, doubles_of_place(model) * sizeof(double)); /* its arrays lie together */
    to->determined = from->determined;
    to->mass = from->mass;
    to->change = from->change;
    to->potential = from->potential;
    to->force = from->force;
    to->kinetic = from->kinetic;
}

/* ---- one step ---- */
/* How far the driver may go so that no coordinate outruns the sampling. */
static double full_step(const pm_workspace *w, const pm_place *x)
{
    double h = INFINITY;
    for (int i = 0; i < w->path->n; i++) {
        const double most = pm_tree_is_angle(w->tree, i) ? 2 * M_PI / PM_PATH_STEPS_PER_TURN
                                                         : PM_PATH_LENGTH * w->numbers.size;
        const double factor = i == w->path->driver ? 1 : PM_PATH_FASTER;
        if (x->slope[i] != 0) h = pm_min(factor * most / fabs(x->slope[i]), h);
    }
    return h;
}

/* Newton's method stays on the branch of a loop, and contacts are seen, in safe steps only; the one out of an equilibrium
 * may be the only one on the path. */
static double step_factor(const pm_workspace *w)
{
    const int open = w->tree->nloop == 0 && w->model->rows[PM_TABLE_CONTACT] == w->reach.ncontact;
    return open && !w->path->balanced ? PM_PATH_FARTHER : 1;
}

/* The way to where the gap to a member would close if it went on closing at its present rate; INFINITY if it opens. */
static double way_to(const pm_frame *frame, const pm_path *path, int contact, int member, double gap)
{
    double rate;
    const double own = pm_contact_member_gap(frame, contact, member, &rate);
    if (pm_edge_is(frame->model, contact) && fabs(gap - own) > pm_contact_length(frame))
        rate = pm_edge_gap_rate(frame, contact); /* beside its end, or behind it */
    rate *= path->sense;
    return gap > pm_contact_length(frame) && rate < 0 ? -gap / rate : INFINITY;
}

/* The step may end soon: at the nearest contacts that seem to come, of a pattern on either side. */
static double next_contact(pm_workspace *w, const pm_place *x)
{
    double h = INFINITY;
    if (w->model->rows[PM_TABLE_CONTACT] == 0) return h;
    pm_frame_look(&w->frame, w->state.t, x->q, x->tangent, w->state.z, w->state.memory);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member[2];
        if (pm_contact_is_pattern(w->model, i)) {
            const int n = pm_contact_near(&w->frame, &w->state, i, 2, member);
            for (int k = 0; k < n; k++)
                h = pm_min(way_to(&w->frame, w->path, i, member[k],
                                  pm_contact_pattern_gap_to(&w->frame, i, member[k])),
                           h);
        } else {
            const double gap = pm_contact_gap(&w->frame, &w->state, i, member);
            if (!isinf(gap)) h = pm_min(way_to(&w->frame, w->path, i, *member, gap), h);
        }
    }
    return PM_PATH_BEYOND * h;
}

/* How fast the driver moves at a place. */
static double rate_at(const pm_path *p, const pm_place *x)
{
    return p->sense * sqrt(2 * (x->kinetic > 0 ? x->kinetic : 0) / x->mass);
}

static void state_of(const pm_model *model, const pm_path *p, const pm_place *x, double s, double t,
                     pm_state *state)
{
    const double rate = rate_at(p, x);
    pm_lanes_copy_threes(state->q, x->q, model->nbody);
    for (int i = 0; i < model->nq; i += 3)
        pm_lanes_store_three(state->v + i, rate * pm_lanes_load(x->tangent + i), rate * x->tangent[i + 2]);
    if (model->nz_controlled > 0) pm_path_integrals(model, p, s, state->z);
    state->t = t;
}

/* How fast the bodies would move at the scene's speed where the motion reverses. */
static void set_reversal(pm_workspace *w)
{
    const pm_place *x = &w->path->node[PM_NODES_MOST - 1];
    const double rate = w->path->sense * w->numbers.speed * sqrt(pm_frame_total_mass(&w->frame) / x->mass);
    for (int i = 0; i < w->model->nq; i++) w->step.reversed[i] = rate * x->tangent[i];
}

/* The last node not after x.  Nodes are mostly looked at in their order. */
static int node_before(const pm_path *p, double x)
{
    const double *at = p->nodes->at;
    const int next = p->looked_at + 1;
    if (next < p->nodes->n && x == p->h * at[next]) return next;
    int low = 0, high = p->nodes->n;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        *(x < p->h * at[middle] ? &high : &low) = middle;
    }
    return low;
}

/* The node at x, or p->spare. */
static int place_at(pm_workspace *w, double x, const pm_place **place)
{
    pm_path *p = w->path;
    const int k = node_before(p, x);
    const int is_node = x == p->h * p->nodes->at[k];
    if (is_node) p->looked_at = k;
    *place = is_node ? pm_path_node(p, k) : &p->spare;
    return is_node ? PM_OK : pm_path_inside(w, x / p->h);
}

static int at(pm_workspace *w, double x, pm_state *state)
{
    const pm_place *place;
    const double s = x / w->path->h;
    const int status = place_at(w, x, &place);
    if (!status) state_of(w->model, w->path, place, s, pm_path_clock_at(w->path, s), state);
    return status;
}

/* Poses are known, and at a place that the constraints determine nothing is factored to have accelerations and reactions.
 * The time is known where something that is sampled reads it. */
static int look(pm_workspace *w, double x, int level)
{
    const pm_place *place;
    const double s = x / w->path->h;
    const int status = place_at(w, x, &place);
    if (status) return status;
    if (w->model->nz_controlled > 0) pm_path_integrals(w->model, w->path, s, w->probe.z);
    w->probe.t = w->model->programs.sample_time ? pm_path_clock_at(w->path, s) : w->path->clock.t0;
    pm_frame_look_along(&w->frame, &w->probe, w->state.memory, place->pose, rate_at(w->path, place),
                        place->tangent);
    if (level < PM_LEVEL_DYNAMIC) return PM_OK;
    if (!place->determined || pm_joint_friction_by_load(&w->frame, &w->state)) return pm_saddle_accelerate(w);
    if (w->tree->nloop > 0) return pm_path_accelerate(w, place->tangent);
    pm_path_open_accelerate(w, place);
    return PM_OK;
}

/* The impulse of the outer world is read off the momentum: this route does not know the forces over time.  The frame looks at
 * the state. */
static void close_momentum(const pm_frame *frame, const pm_path *path, pm_state *state)
{
    double *ledger = state->z + pm_ledger_ledger(frame->model), momentum[PM_LEDGER];
    pm_frame_momentum(frame, PM_NONE, momentum);
    for (int i = 0; i < PM_LEDGER; i++) ledger[i] = path->impulse[i] + momentum[i];
}

/* Where a coarse run looks for x.  Places are rounded, and with them what they leave of T: little, but next to where the motion
 * rests it is much of what is left. */
static double rounded_place(const pm_workspace *w, double x)
{
    const pm_path *p = w->path;
    const double by = PM_PATH_ROUNDED * pm_evidence_is_coarse(&w->evidence) * (fabs(p->u0) + fabs(x));
    return x + by <= p->h ? x + by : x - by;
}

static int exact(pm_workspace *w, double x, pm_state *state)
{
    pm_state_copy(state, &w->state);
    const int status = at(w, rounded_place(w, x), state);
    if (w->path->clock.kind != PM_CLOCK_NONE) state->t = pm_path_clock_at(w->path, x / w->path->h);
    pm_frame_look_state(&w->frame, state);
    if (!status) close_momentum(&w->frame, w->path, state);
    return status;
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
    int status =
        pm_fail_search(&w->result, pm_bracket_find(w->event->solver, after_limit, w, &t_limit, 0,
                                                   p->clock.t0 - t_limit, 1, w->state.t - t_limit, &s));
    if (!status) status = at(w, s * p->h, &w->state);
    w->state.t = t_limit;
    pm_step_set(&w->step, 0, s * p->h);
    w->step.reverses = 0;
    return status;
}

/* The places of the last step serve again if the step is as long as that was. */
static double repeat(pm_path *p, double full)
{
    p->filled = p->repeats && fabs(full - p->h) <= PM_PATH_SAME_STEP * full;
    p->repeats = 0;
    if (!p->filled) return full;
    return p->h;
}

static int step(pm_workspace *w, double t_limit)
{
    pm_path *p = w->path;
    p->repeats = p->repeats && p->fresh && !p->at_rest && pm_path_cycle(w);
    if (p->repeats) pm_path_cycle_of(w->model, w->path, p->begin.kinetic);
    copy_place(w->model, &p->node[0], p->fresh ? &p->begin : &p->node[PM_NODES_MOST - 1]);
    if (!p->fresh) p->at_rest = p->balanced = 0;
    p->fresh = 0;
    int status = pm_path_drive(w, &p->node[0]);
    p->node_driver = p->driver;
    p->node_sense = p->sense;
    p->u0 = p->node[0].y[p->driver];
    p->clock.rate = 1 + w->evidence.late + PM_CLOCK_ROUNDING * pm_evidence_is_coarse(&w->evidence);
    pm_path_clock_begin(p, w->state.t, w->step.end / p->h);
    memcpy(p->weight, w->state.z, (size_t)w->model->nz_controlled * sizeof(double));
    const int may_close = pm_tree_is_angle(w->tree, p->driver);
    p->safe = w->numbers.coarse * full_step(w, &p->node[0]);
    const double full =
        pm_min(w->numbers.coarse * next_contact(w, &p->node[0]), pm_min(step_factor(w) * p->safe, p->most));
    if (!status)
        status = pm_path_take_step(w, repeat(w->path, may_close ? pm_min(2 * M_PI - p->way, full) : full));
    if (status) return status;
    if (w->step.reverses) set_reversal(w);
    pm_step_set(&w->step, 0, p->h);
    p->way += p->h;
    const int hands_over = p->balanced && PM_SETTING(w->model, PM_SETTING_ROUTE) != PM_ROUTE_AUTO &&
                           PM_SETTING(w->model, PM_SETTING_ROUTE) != PM_ROUTE_PATH;
    w->phase.lap = hands_over || (may_close && p->way > 2 * M_PI * (1 - PM_PATH_LAP));
    state_of(w->model, w->path, &p->node[PM_NODES_MOST - 1], 1, pm_path_clock_at(p, 1), &w->state);
    w->step.nodes = p->nodes;
    pm_frame_look_state(&w->frame, &w->state);
    pm_path_check(w);
    if ((status = end_at_limit(w, t_limit))) return status;
    if (w->step.end != p->h) pm_frame_look_state(&w->frame, &w->state);
    close_momentum(&w->frame, w->path, &w->state);
    pm_path_error_step(w, p->node[PM_NODES_MOST - 1].kinetic);
    w->result.count[PM_COUNT_STEPS]++;
    pm_case_speed(w->model, &w->numbers, w->state.v);
    return PM_OK;
}

const pm_route_ops pm_route_path = {
    .route = PM_ROUTE_PATH,
    .create = create,
    .applies = pm_path_applies,
    .prepare = pm_path_prepare,
    .begin = pm_path_begin,
    .step = step,
    .at = at,
    .exact = exact,
    .look = look,
    .react = pm_path_react,
    .sampled = pm_path_error_sampled,
    .error_of = pm_path_error_answer,
    .beside = pm_path_aside_look,
    .back = pm_path_aside_back,
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
