/* path_rigid.c - places of a rigid group that one coordinate u moves: a body on a fixed pin, slider or track, and all that
 * is welded to it; or a particle on a link.
 *
 * Let P be the mark of that body on its joint, and R the rotation of the group by its angle: u, or a constant (slider, link).
 * With d, the way from P to a mass centre in the axes of the first body, and ' by u,
 *
 *   x = P + R d,   t = x' = P' + w k x R d,   c = x'' = P'' - w^2 R d,   w the rate of the angle: 1 or 0
 *
 * The joint says how P goes, from the mark P_0 of what is fixed:
 *
 *   pin      P = P_0
 *   line     P = P_0 +- (s t + r n),   s = u, or what has been rolled;  t, n turn along where they are the group's
 *   circles  P = P_0 +- L (cos phi, sin phi),   phi linear in u                                   (tree_place.c)
 *   link     the same, phi = u */
#include "routes/path/path.h"

#include <math.h>
#include <string.h>

#include "equations/fixed_bodies.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree.h"
#include "tree/tree_node.h"

/* v rotated by the angle with that cosine and sine. */
static inline pm_lanes rotated(pm_lanes rotation, pm_lanes v)
{
    return rotation[0] * v + rotation[1] * pm_lanes_left(v);
}

/* ---- once a phase ---- */
static void add(const pm_workspace *w, const pm_tree_node *x, const pm_rigid_body *on, pm_rigid_body *b)
{
    const pm_lanes gravity = pm_lanes_load(w->numbers.gravity);
    *b = (pm_rigid_body){.body = x->body,
                         .rotates = x->rotates,
                         .holds = x->placement != PIN,
                         .mass = w->numbers.mass[x->body],
                         .inertia = x->rotates ? pm_frame_inertia(&w->frame, x->body) : 0,
                         .rotation = {1, 0}};
    b->weight = b->mass * gravity;
    pm_lanes mark = {0, 0};
    if (on) {
        mark = on->d + rotated(on->rotation, pm_lanes_load(x->mark));
        b->angle = on->angle + x->angle;
        b->rotation = rotated(on->rotation, pm_lanes_load(x->rotation));
    }
    b->lever = rotated(b->rotation, pm_lanes_load(x->child));
    b->d = mark - b->lever;
}

static void begin_at(const pm_workspace *w, const pm_tree_node *x)
{
    pm_rigid *g = &w->path->rigid;
    const double *from = w->frame.pose + 5 * x->parent;
    const pm_lanes rotation = pm_lanes_load(from + 3), line = pm_lanes_load(x->line);
    g->from = pm_lanes_load(from) + rotated(rotation, pm_lanes_load(x->mark));
    g->line = x->child_is_a ? rotated(rotation, line) : line;
    g->first = x;
    g->rotates = !pm_tree_shifts(x);
    g->fixed = from[2];
    g->angle = x->placement == LINK ? 0 : from[2] + x->angle; /* a particle, a slider */
    g->rotation = x->placement == LINK ? (pm_lanes){1, 0} : rotated(rotation, pm_lanes_load(x->rotation));
    add(w, x, NULL, &g->body[g->n++]);
}

/* What carries body number `index`, and turns; or NULL. */
static const pm_rigid_body *carrier(const pm_rigid *g, int index)
{
    for (int i = 0; i < g->n; i++)
        if (g->body[i].body == index) return g->body[i].rotates ? &g->body[i] : NULL;
    return NULL;
}

/* The next node: the first one, or one that follows it rigidly. */
static int join(const pm_workspace *w, const pm_tree_node *x)
{
    pm_rigid *g = &w->path->rigid;
    if (x->ncoordinate == 1 && w->numbers.fixed[x->parent]) {
        begin_at(w, x);
        return 1;
    }
    const pm_rigid_body *on = carrier(g, x->parent);
    const int particle = x->placement == PIN && !x->rotates && x->child[0] == 0 && x->child[1] == 0;
    if (!on || !(x->placement == WELD || particle)) return 0;
    add(w, x, on, &g->body[g->n]);
    g->n++;
    return 1;
}

static double potential_of_fixed(const pm_workspace *w)
{
    double sum = 0;
    for (int i = 0; i < w->fixed->n; i++) {
        const int b = w->tree->node[i].body;
        const double *pose = w->frame.pose + 5 * b;
        sum -= w->numbers.mass[b] * (w->numbers.gravity[0] * pose[0] + w->numbers.gravity[1] * pose[1]);
    }
    return sum;
}

int pm_path_rigid_build(pm_workspace *w)
{
    pm_rigid *g = &w->path->rigid;
    int all = w->tree->nloop == 0;
    g->n = 0;
    for (int i = w->fixed->n; i < w->model->nbody && all; i++) all = join(w, &w->tree->node[i]);
    if (!all) g->n = 0;
    g->potential = potential_of_fixed(w);
    return g->n > 0;
}

/* ---- a place ---- */
/* How the mark goes. */
typedef struct pm_track {
    pm_lanes at, rate, bend; /* P, P', P'' */
    pm_lanes rho, t;         /* of the node (tree_node.h) */
} pm_track;

static inline void go_along_line(const pm_state *state, const pm_rigid *g, double u, pm_lanes rotation,
                                 pm_track *x)
{
    const pm_tree_node *node = g->first;
    const int slides = node->placement == SLIDER;
    const double r = node->radius, rate = slides ? 1 : node->roll_own;
    double s = u;
    if (!slides) s = state->memory[node->memory].anchor + rate * u + node->roll_parent * g->fixed;
    x->t = node->child_is_a ? g->line : rotated(rotation, g->line);
    const pm_lanes n = pm_lanes_left(x->t);
    x->rho = s * x->t + r * n;
    x->rate = rate * x->t;
    if (slides || node->child_is_a) return;
    x->rate += s * n - r * x->t; /* the line turns along */
    x->bend = 2 * rate * n - x->rho;
}

static pm_lanes rotation_by(const pm_frame *frame, double angle)
{
    const pm_rotation *x = pm_frame_rotation(frame, angle);
    return (pm_lanes){x->cosine, x->sine};
}

static void go_round_circle(const pm_frame *frame, const pm_state *state, const pm_rigid *g, double u,
                            pm_lanes rotation, pm_track *x)
{
    const pm_tree_node *node = g->first;
    const double rate = node->placement == LINK ? 1 : node->roll_own;
    if (node->placement == LINK) {
        const pm_lanes direction = rotation_by(frame, u);
        x->rho = node->length * direction;
    } else if (rate == 1 && node->roll_parent == 0) { /* on a point */
        x->rho = rotated(rotation, pm_lanes_load(node->touch));
    } else {
        const double begin = state->memory[node->memory].anchor / node->length,
                     phi = begin + rate * u + node->roll_parent * g->fixed;
        x->rho = node->length * pm_lanes_direction(phi);
    }
    x->t = pm_lanes_left(x->rho) / node->length;
    x->rate = rate * node->length * x->t;
    x->bend = -rate * rate * x->rho;
}

static inline void go(const pm_frame *frame, const pm_state *state, const pm_rigid *g, double u,
                      pm_lanes rotation, pm_track *x)
{
    const pm_tree_node *node = g->first;
    const double sign = node->child_is_a ? 1 : -1;
    x->rate = x->bend = x->rho = x->t = (pm_lanes){0, 0};
    if (node->placement == ROLL_CIRCLE || node->placement == LINK)
        go_round_circle(frame, state, g, u, rotation, x);
    else if (node->placement != PIN)
        go_along_line(state, g, u, rotation, x);
    x->at = g->from + sign * x->rho;
    x->rate *= sign;
    x->bend *= sign;
}

/* The levers of its reactions. */
static inline void set_arm(const pm_rigid_body *b, pm_lanes rotation, const pm_track *x,
                           const pm_place *place)
{
    double *arm = place->arm + PM_TREE_ARM * b->body;
    pm_lanes_store(arm, rotated(rotation, b->lever));
    pm_lanes_store(arm + 2, x->rho);
    pm_lanes_store(arm + 4, x->t);
}

static inline void rotate_body(const pm_rigid_body *b, double angle, pm_lanes rotation, const pm_place *place)
{
    double *pose = place->pose + 5 * b->body;
    pose[2] = place->q[3 * b->body + 2] = angle + b->angle;
    pm_lanes_store(pose + 3, rotated(rotation, b->rotation));
}

/* What the bodies make of a place, in both directions. */
typedef struct pm_sums {
    pm_lanes mass, change, force, potential;
    double inertia;
} pm_sums;

static inline pm_sums place_body(const pm_rigid_body *b, double angle, pm_lanes rotation, double spin,
                                 const pm_track *x, const pm_place *place, pm_sums sum)
{
    const pm_lanes r = rotated(rotation, b->d), at = x->at + r, c = x->bend - spin * r,
                   t = x->rate + spin * pm_lanes_left(r);
    double *pose = place->pose + 5 * b->body;
    sum.mass += b->mass * t * t;
    sum.change += b->mass * t * c;
    sum.force += b->weight * t;
    sum.potential += b->weight * at;
    sum.inertia += b->inertia;
    pm_lanes_store_three(place->q + 3 * b->body, at, 0);
    pm_lanes_store_three(place->tangent + 3 * b->body, t, b->rotates ? spin : 0);
    pm_lanes_store_three(place->bend + 3 * b->body, c, 0);
    pm_lanes_store_three(pose, at, 0);
    pm_lanes_store(pose + 3, (pm_lanes){1, 0});
    if (b->rotates) rotate_body(b, angle, rotation, place);
    if (b->holds) set_arm(b, rotation, x, place);
    return sum;
}

static void leave_fixed(const pm_workspace *w, const pm_place *place)
{
    for (int i = 0; i < w->fixed->n; i++) {
        const int b = w->tree->node[i].body;
        const double *pose = w->frame.pose + 5 * b;
        memcpy(place->pose + 5 * b, pose, 5 * sizeof *pose);
        memcpy(place->q + 3 * b, pose, 3 * sizeof *pose);
        for (int k = 0; k < 3; k++) place->tangent[3 * b + k] = place->bend[3 * b + k] = 0;
    }
}

void pm_path_rigid_place(const pm_workspace *w, double u, pm_place *place)
{
    const pm_rigid *g = &w->path->rigid;
    const double angle = g->rotates ? u : g->angle, spin = g->rotates;
    const pm_lanes rotation = g->rotates ? rotation_by(&w->frame, u) : g->rotation;
    pm_track track;
    pm_sums sum = {.inertia = 0};
    go(&w->frame, &w->state, g, u, rotation, &track);
    for (int i = 0; i < g->n; i++) sum = place_body(&g->body[i], angle, rotation, spin, &track, place, sum);
    place->mass = pm_lanes_sum(sum.mass) + spin * sum.inertia;
    place->change = pm_lanes_sum(sum.change);
    place->force = pm_lanes_sum(sum.force);
    place->potential = g->potential - pm_lanes_sum(sum.potential);
    if (w->fixed->n > 0) leave_fixed(w, place);
}
