/* measure_slope.c - derivatives of what is read off a state, by positions and velocities.
 *
 * Each is the differential of its formula in measure_body.c, measure_contact.c and measure_scene.c.  Running integrals and what
 * changes at instants only have none.  Measures of reactions and accelerations have none in closed form. */
#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/edge.h"
#include "elements/force_slope.h"
#include "elements/joint_friction.h"
#include "elements/measure_kinds.h"
#include "elements/turning_plane.h"
#include "numerics/tolerances.h"

static int body_of(const pm_measure_args *x, int body) { return pm_model_body_index(x->w->model, body); }
static int seen_from(const pm_measure_args *x)
{
    return x->e[PM_MEASURE_IN] == PM_NONE ? x->w->model->nbody : body_of(x, x->e[PM_MEASURE_IN]);
}
static pm_point centre(const pm_measure_args *x, int body)
{
    return pm_frame_point(&x->w->frame, body, 0, 0);
}

int pm_measure_slope_nothing(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    (void)x;
    (void)weight;
    (void)to;
    return 1;
}

/* ---- bodies ---- */
int pm_measure_slope_angle(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    pm_slope_add_angle(&x->w->frame, to, body_of(x, x->a), weight[0]);
    pm_slope_add_angle(&x->w->frame, to, seen_from(x), -weight[0]);
    return 1;
}

int pm_measure_slope_turned(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    if (x->a >= 0) pm_slope_add_angle(&x->w->frame, to, x->a, weight[0]);
    return 1;
}

int pm_measure_slope_omega(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    pm_slope_add_omega(&x->w->frame, to, body_of(x, x->a), weight[0]);
    pm_slope_add_omega(&x->w->frame, to, seen_from(x), -weight[0]);
    return 1;
}

/* weight . (place of a less that of b) */
static void add_way(const pm_frame *frame, const pm_point *a, const pm_point *b, const double weight[2],
                    pm_slope *to)
{
    pm_slope_add_place(frame, to, a, weight);
    pm_slope_add_place(frame, to, b, (double[]){-weight[0], -weight[1]});
}

int pm_measure_slope_inertia(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    if (x->a == PM_GROUND || x->e[PM_MEASURE_ABOUT] == PM_NONE) return 1;
    const pm_point g = centre(x, x->a), p = pm_frame_point_of(&x->w->frame, x->e[PM_MEASURE_ABOUT]);
    const double arm = 2 * weight[0] * x->w->numbers.mass[x->a];
    add_way(&x->w->frame, &g, &p, (double[]){arm * (g.p[0] - p.p[0]), arm * (g.p[1] - p.p[1])}, to);
    return 1;
}

/* A body, or all of them; fixed ones have no part in sums. */
static int is_meant(const pm_measure_args *x, int body)
{
    return x->a == body || (x->a == PM_NONE && !x->w->numbers.fixed[body]);
}

int pm_measure_slope_kinetic(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    const pm_frame *frame = &x->w->frame;
    if (x->a == PM_GROUND) return 1;
    for (int i = 0; i < x->w->model->nbody; i++) {
        if (!is_meant(x, i)) continue;
        const pm_point g = centre(x, i);
        const double m = weight[0] * x->w->numbers.mass[i];
        pm_slope_add_velocity(frame, to, &g, (double[]){m * g.v[0], m * g.v[1]});
        pm_slope_add_omega(frame, to, i, weight[0] * pm_frame_inertia(frame, i) * frame->velocity[3 * i + 2]);
    }
    pm_turning_plane_add_kinetic(frame, to, x->a, weight[0]);
    return 1;
}

int pm_measure_slope_momentum(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    for (int i = 0; i < x->w->model->nbody && x->a != PM_GROUND; i++) {
        if (!is_meant(x, i)) continue;
        const pm_point g = centre(x, i);
        const double m = x->w->numbers.mass[i];
        pm_slope_add_velocity(&x->w->frame, to, &g, (double[]){m * weight[0], m * weight[1]});
    }
    return 1;
}

/* d(p x m v) of one body about a point of the scene, whose place is p's. */
static void add_moment(const pm_measure_args *x, int i, const pm_point *about, double weight, pm_slope *to)
{
    const pm_frame *frame = &x->w->frame;
    const pm_point g = centre(x, i);
    const double m = weight * x->w->numbers.mass[i];
    const double d[2] = {g.p[0] - (about ? about->p[0] : 0), g.p[1] - (about ? about->p[1] : 0)};
    const double arm[2] = {m * g.v[1], -m * g.v[0]};
    pm_slope_add_velocity(frame, to, &g, (double[]){-m * d[1], m * d[0]});
    pm_slope_add_place(frame, to, &g, arm);
    if (about) pm_slope_add_place(frame, to, about, (double[]){-arm[0], -arm[1]});
}

int pm_measure_slope_angular_momentum(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    const int own = x->e[PM_MEASURE_ABOUT] == PM_NONE && x->a != PM_NONE;
    pm_point about;
    if (x->e[PM_MEASURE_ABOUT] != PM_NONE) about = pm_frame_point_of(&x->w->frame, x->e[PM_MEASURE_ABOUT]);
    for (int i = 0; i < x->w->model->nbody && x->a != PM_GROUND; i++) {
        if (!is_meant(x, i)) continue;
        pm_slope_add_omega(&x->w->frame, to, i, weight[0] * pm_frame_inertia(&x->w->frame, i));
        if (!own) add_moment(x, i, x->e[PM_MEASURE_ABOUT] == PM_NONE ? NULL : &about, weight[0], to);
    }
    return 1;
}

int pm_measure_slope_pole(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    const int body = body_of(x, x->a);
    const pm_point g = centre(x, body);
    const double omega = x->w->frame.velocity[3 * body + 2];
    if (omega == 0) return 1;
    pm_slope_add_place(&x->w->frame, to, &g, weight);
    pm_slope_add_velocity(&x->w->frame, to, &g, (double[]){weight[1] / omega, -weight[0] / omega});
    pm_slope_add_omega(&x->w->frame, to, body, (weight[0] * g.v[1] - weight[1] * g.v[0]) / (omega * omega));
    return 1;
}

/* ---- points ---- */
static void into_scene(const double *axes, const double a[2], double out[2])
{
    out[0] = axes[3] * a[0] - axes[4] * a[1];
    out[1] = axes[4] * a[0] + axes[3] * a[1];
}

int pm_measure_slope_position(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    const int in = seen_from(x);
    const pm_point p = pm_frame_point_of(&x->w->frame, x->a), o = centre(x, in);
    double turned[2], seen[2];
    into_scene(x->w->frame.pose + 5 * in, weight, turned);
    add_way(&x->w->frame, &p, &o, turned, to);
    pm_measured_position(x, seen);
    pm_slope_add_angle(&x->w->frame, to, in, weight[0] * seen[1] - weight[1] * seen[0]);
    return 1;
}

int pm_measure_slope_moved(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    const pm_point p = pm_frame_point_of(&x->w->frame, x->a);
    pm_slope_add_place(&x->w->frame, to, &p, weight);
    return 1;
}

/* u = v - v_O - omega k x d, d from the mass centre O of the observer's body, in its axes. */
int pm_measure_slope_velocity(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    const int in = seen_from(x);
    const pm_frame *frame = &x->w->frame;
    const pm_point p = pm_frame_point_of(frame, x->a), o = centre(x, in);
    const double d[2] = {p.p[0] - o.p[0], p.p[1] - o.p[1]}, omega = frame->velocity[3 * in + 2];
    double turned[2], seen[2];
    into_scene(frame->pose + 5 * in, weight, turned);
    pm_slope_add_velocity(frame, to, &p, turned);
    pm_slope_add_velocity(frame, to, &o, (double[]){-turned[0], -turned[1]});
    pm_slope_add_omega(frame, to, in, turned[0] * d[1] - turned[1] * d[0]);
    add_way(frame, &p, &o, (double[]){-omega * turned[1], omega * turned[0]}, to);
    pm_measured_velocity(x, seen);
    pm_slope_add_angle(frame, to, in, weight[0] * seen[1] - weight[1] * seen[0]);
    return 1;
}

/* ---- contacts ---- */
/* The member of the contact that its gap is of, and the slot where it is closed. */
static int member_of(const pm_measure_args *x, int *slot)
{
    const int first = x->w->model->contact_slot[x->a], meant = x->e[PM_MEASURE_MEMBER];
    int member = meant;
    *slot = first;
    for (int i = first; i < first + pm_contact_slots(x->w->model, x->a); i++) {
        const pm_slot *s = &x->w->state.slot[i];
        if (s->mode == PM_OPEN || (meant != PM_NONE && s->member != meant)) continue;
        *slot = i;
        return s->member;
    }
    if (meant == PM_NONE) pm_contact_gap(&x->w->frame, &x->w->state, x->a, &member);
    return member;
}

/* The gradient of its constraint, if that is what is read (not where a capture waits). */
int pm_measure_slope_gap(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    int slot;
    const int member = member_of(x, &slot);
    const double gap = pm_measured_contact_gap(x);
    pm_constraint c;
    if (!isfinite(gap)) return 1;
    pm_contact_constraint_normal(&x->w->frame, x->a, slot, member, &c);
    pm_constraint_kind(c.kind)->evaluate(&x->w->frame, &c);
    if (!(fabs(c.g - gap) <= PM_SLOPE_SAME * x->w->numbers.size)) return 0;
    pm_slope_add_bodies(&x->w->frame, to, pm_constraint_bodies(&c), c.body, c.j, weight[0], 0);
    return 1;
}

/* The rate of a constraint. */
static void add_rate(const pm_measure_args *x, pm_constraint *c, double weight, pm_slope *to)
{
    double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES], turn[PM_CONSTRAINT_COORDINATES];
    pm_constraint_kind(c->kind)->evaluate(&x->w->frame, c);
    pm_constraint_bend(&x->w->frame, c, bend);
    pm_constraint_bend_along(&x->w->frame, c, bend, x->w->frame.v, turn);
    pm_slope_add_bodies(&x->w->frame, to, pm_constraint_bodies(c), c->body, c->j, weight, 1);
    pm_slope_add_bodies(&x->w->frame, to, pm_constraint_bodies(c), c->body, turn, weight, 0);
}

/* Where the contact is closed its slip is the rate of the tangential constraint. */
int pm_measure_slope_slip(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    int slot;
    const int member = member_of(x, &slot);
    pm_constraint normal, tangent;
    if (isnan(pm_measured_contact_slip(x))) return 1;
    const double along = weight[0] * pm_edge_way(x->w->model, x->a, member);
    pm_contact_constraint_both(&x->w->frame, x->a, slot, member, &normal, &tangent);
    add_rate(x, &tangent, along, to);
    return 1;
}

/* ---- joints ---- */
int pm_measure_slope_joint_slip(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    pm_constraint c;
    const int k = pm_joint_friction_find(&x->w->frame, x->a, &c);
    if (k == PM_NONE || x->w->state.friction[k] == PM_STICK || isnan(pm_measured_joint_slip(x))) return 1;
    add_rate(x, &c, weight[0], to);
    return 1;
}

/* ---- forces ---- */
/* Those that are known before any reaction, and whose own programs are not read. */
static int is_plain(const pm_measure_args *x)
{
    return PM_FORCE_ROW(x->w->model, x->a)[PM_FORCE_KIND] < PM_FORCE_APPLIED;
}

static int is_absent(const pm_measure_args *x)
{
    return pm_state_is_absent(x->w->model, &x->w->state, PM_TABLE_FORCE, x->a);
}

int pm_measure_slope_force(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    const int first = pm_force_place(&x->w->frame, x->a).body_a;
    const int other = x->e[PM_MEASURE_ON] != PM_NONE && body_of(x, x->e[PM_MEASURE_ON]) != first;
    if (!is_plain(x)) return 0;
    if (!is_absent(x))
        pm_force_add_force(x->w, x->a,
                           (double[]){other ? -weight[0] : weight[0], other ? -weight[1] : weight[1]}, to);
    return 1;
}

int pm_measure_slope_couple(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    if (is_plain(x) && !is_absent(x)) pm_force_add_couple(x->w, x->a, weight[0], to);
    return is_plain(x);
}

int pm_measure_slope_power(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    if (is_plain(x) && !is_absent(x)) pm_force_add_power(x->w, x->a, weight[0], to);
    return is_plain(x);
}

int pm_measure_slope_stretch(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    pm_force_add_stretch(&x->w->frame, x->a, weight[0], to);
    return 1;
}

int pm_measure_slope_rate(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    pm_force_add_rate(&x->w->frame, x->a, weight[0], to);
    return 1;
}

int pm_measure_slope_energy(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    pm_force_add_energy(x->w, x->a, weight[0], to);
    return 1;
}

/* Of a potential; that of others is a running integral. */
int pm_measure_slope_work(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    if (x->w->model->force_z[x->a] == PM_NONE) pm_force_add_energy(x->w, x->a, -weight[0], to);
    return 1;
}

/* ---- the scene and its turning plane ---- */
int pm_measure_slope_potential(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    const pm_model *m = x->w->model;
    for (int i = 0; i < m->nbody; i++) {
        const pm_point g = centre(x, i);
        const double down = -weight[0] * x->w->numbers.mass[i], *gravity = x->w->numbers.gravity;
        pm_slope_add_place(&x->w->frame, to, &g, (double[]){down * gravity[0], down * gravity[1]});
    }
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        if (m->force_z[i] == PM_NONE) pm_force_add_energy(x->w, i, weight[0], to);
    return 1;
}

int pm_measure_slope_total(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    const pm_measure_args all = {x->w, x->e, PM_NONE};
    return pm_measure_slope_kinetic(&all, weight, to) && pm_measure_slope_potential(x, weight, to);
}

int pm_measure_slope_spin_omega(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    pm_turning_plane_add_omega(&x->w->frame, to, weight[0]);
    return 1;
}

int pm_measure_slope_spin_inertia(const pm_measure_args *x, const double weight[2], pm_slope *to)
{
    pm_turning_plane_add_inertia(&x->w->frame, to, PM_NONE, weight[0]);
    return 1;
}
