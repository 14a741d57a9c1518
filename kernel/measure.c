/* measure.c - table of measure kinds: what each needs, what its `a` points at, how it is read off the frame. */
#include "measure.h"

#include <math.h>
#include <string.h>

#include "body.h"
#include "capture.h"
#include "contact.h"
#include "event.h"
#include "force.h"
#include "grip.h"
#include "joint.h"
#include "row.h"
#include "saddle.h"
#include "segment.h"
#include "spin.h"
#include "trigger.h"

typedef struct pm_measure_args {
    pm_workspace *w;
    const int32_t *e;
    int a; /* partner; bodies: PM_NONE for all, nbody for the ground */
} pm_measure_args;

typedef double pm_scalar(const pm_measure_args *x);
typedef void pm_vector(const pm_measure_args *x, double out[2]);

/* ---- bodies ---- */
static const double *velocity(const pm_measure_args *x, int body)
{
    return x->w->frame.velocity + 3 * pm_body_index(x->w->model, body);
}
static const double *pose(const pm_measure_args *x, int body)
{
    return x->w->frame.pose + 5 * pm_body_index(x->w->model, body);
}

static int seen_from(const pm_measure_args *x)
{
    return x->e[PM_MEASURE_IN] == PM_NONE ? PM_GROUND : x->e[PM_MEASURE_IN];
}

static double measure_time(const pm_measure_args *x) { return x->w->frame.t; }
static double angle(const pm_measure_args *x) { return pose(x, x->a)[2] - pose(x, seen_from(x))[2]; }
static double turned(const pm_measure_args *x)
{
    return x->a < 0 || x->a == x->w->model->nbody ? 0 : pose(x, x->a)[2] - x->w->start.q[3 * x->a + 2];
}
static double omega(const pm_measure_args *x) { return velocity(x, x->a)[2] - velocity(x, seen_from(x))[2]; }
static double alpha(const pm_measure_args *x) { return x->a == PM_GROUND ? 0 : x->w->frame.a[3 * x->a + 2]; }

static double mass(const pm_measure_args *x)
{
    double sum = 0;
    for (int i = 0; i < x->w->model->nbody; i++)
        if (x->a == PM_NONE || x->a == i) sum += x->w->mass[i];
    return sum;
}
static double weight(const pm_measure_args *x) { return mass(x) * hypot(x->w->gravity[0], x->w->gravity[1]); }

static double inertia(const pm_measure_args *x)
{
    if (x->a == PM_GROUND) return 0;
    double sum = pm_body_inertia(x->w, x->a);
    if (x->e[PM_MEASURE_ABOUT] != PM_NONE) {
        const pm_point p = pm_point_of(x->w, x->e[PM_MEASURE_ABOUT]);
        const double *g = pose(x, x->a), dx = g[0] - p.p[0], dy = g[1] - p.p[1];
        sum += x->w->mass[x->a] * (dx * dx + dy * dy);
    }
    return sum;
}

static double kinetic(const pm_measure_args *x)
{
    return x->a == PM_GROUND ? 0 : pm_body_kinetic(x->w, x->a) + pm_spin_kinetic(x->w, x->a);
}

static void momentum(const pm_measure_args *x, double out[2])
{
    double m[3] = {0, 0, 0};
    if (x->a != PM_GROUND) pm_body_momentum(x->w, x->a, m);
    out[0] = m[0];
    out[1] = m[1];
}

/* About a point P: H_P = H_O - OP x L, (17.28) moved to P. */
static double angular_momentum(const pm_measure_args *x)
{
    double m[3] = {0, 0, 0}, about[2] = {0, 0};
    if (x->a == PM_GROUND) return 0;
    pm_body_momentum(x->w, x->a, m);
    if (x->e[PM_MEASURE_ABOUT] != PM_NONE) {
        const pm_point p = pm_point_of(x->w, x->e[PM_MEASURE_ABOUT]);
        about[0] = p.p[0];
        about[1] = p.p[1];
    } else if (x->a != PM_NONE) {
        return pm_body_inertia(x->w, x->a) * velocity(x, x->a)[2];
    }
    return m[2] - (about[0] * m[1] - about[1] * m[0]);
}

static void pole(const pm_measure_args *x, double out[2])
{
    const double *v = velocity(x, x->a), *g = pose(x, x->a);
    out[0] = v[2] == 0 ? NAN : g[0] - v[1] / v[2];
    out[1] = v[2] == 0 ? NAN : g[1] + v[0] / v[2];
}

/* ---- points ---- */
static void into_axes(const double *axes, double v[2])
{
    const double x = axes[3] * v[0] + axes[4] * v[1], y = -axes[4] * v[0] + axes[3] * v[1];
    v[0] = x;
    v[1] = y;
}

static void position(const pm_measure_args *x, double out[2])
{
    const pm_point p = pm_point_of(x->w, x->a);
    const double *axes = pose(x, seen_from(x));
    out[0] = p.p[0] - axes[0];
    out[1] = p.p[1] - axes[1];
    into_axes(axes, out);
}

/* As the moving body's own observer sees it: the velocity of the body's point at P is taken off. */
static void point_velocity(const pm_measure_args *x, double out[2])
{
    const pm_point p = pm_point_of(x->w, x->a);
    const double *axes = pose(x, seen_from(x)), *v = velocity(x, seen_from(x));
    out[0] = p.v[0] - (v[0] - v[2] * (p.p[1] - axes[1]));
    out[1] = p.v[1] - (v[1] + v[2] * (p.p[0] - axes[0]));
    into_axes(axes, out);
}

static void point_acceleration(const pm_measure_args *x, double out[2])
{
    const pm_point p = pm_point_of(x->w, x->a);
    pm_point_acceleration(x->w, &p, out);
}

static void moved(const pm_measure_args *x, double out[2])
{
    const int32_t *e = PM_POINT_ROW(x->w->model, x->a);
    const pm_point now = pm_point_of(x->w, x->a);
    out[0] = out[1] = 0;
    if (e[PM_POINT_BODY] == PM_GROUND) return;
    const double *q = x->w->start.q + 3 * e[PM_POINT_BODY], px = x->w->value[e[PM_POINT_X]],
                 py = x->w->value[e[PM_POINT_Y]];
    out[0] = now.p[0] - (q[0] + cos(q[2]) * px - sin(q[2]) * py);
    out[1] = now.p[1] - (q[1] + sin(q[2]) * px + cos(q[2]) * py);
}

static double path(const pm_measure_args *x)
{
    const ptrdiff_t i = (x->e - x->w->model->table[PM_TABLE_MEASURE]) / PM_MEASURE_COLUMNS;
    return x->w->frame.z[x->w->model->path_z[i]];
}

/* ---- joints ---- */
/* Which partner of a joint an address means: the first, or (`on` another body) the second; PM_NONE of a joint that is not
 * there: nothing acts. */
static int partner_of(const pm_measure_args *x)
{
    pm_row row[PM_JOINT_ROWS];
    if (x->e[PM_MEASURE_ON] == PM_NONE) return 0;
    if (pm_row_of_joint(x->w, x->a, row) == 0) return PM_NONE;
    return row[0].body[0] != pm_body_index(x->w->model, x->e[PM_MEASURE_ON]);
}

/* What the reaction of a row does to one of its two bodies. */
static void add_reaction(const pm_measure_args *x, const pm_row *row, double size, int on, double out[3])
{
    pm_line_of_action along; /* the rows need not be evaluated where the frame looks */
    pm_row_kind(row->kind)->act(x->w, row, &along);
    for (int k = 0; k < 2; k++) out[k] += (on == 0 ? size : -size) * along.direction[k];
    out[2] += size * along.couple[on];
}

/* Sum over the rows of a joint of size[row] times what a unit of it does. */
static void joint_sum(const pm_measure_args *x, const double *reaction, int by_active, double out[3])
{
    const pm_model *m = x->w->model;
    const int first = m->joint_row[x->a],
              last = x->a + 1 < m->rows[PM_TABLE_JOINT] ? m->joint_row[x->a + 1] : m->njoint_row;
    const int on = partner_of(x);
    out[0] = out[1] = out[2] = 0;
    for (int i = first; i < last && on != PM_NONE; i++) {
        const int active = x->w->joint_active[i];
        if (active == PM_NONE) continue;
        add_reaction(x, &x->w->row[active], reaction[by_active ? active : i], on, out);
    }
    pm_row rubbing;
    const double friction = by_active ? pm_grip_of_joint(x->w, x->a, &rubbing) : 0;
    if (friction != 0 && on != PM_NONE) add_reaction(x, &rubbing, friction, on, out);
}

static void joint_force(const pm_measure_args *x, double out[2])
{
    double sum[3];
    joint_sum(x, x->w->frame.lambda, 1, sum);
    memcpy(out, sum, 2 * sizeof *out);
}
static double joint_couple(const pm_measure_args *x)
{
    double sum[3];
    joint_sum(x, x->w->frame.lambda, 1, sum);
    return sum[2];
}
static void joint_impulse(const pm_measure_args *x, double out[2])
{
    double sum[3];
    joint_sum(x, x->w->joint_impulse, 0, sum);
    memcpy(out, sum, 2 * sizeof *out);
}
/* Not unique where a row is redundant; the two strands of a belt depend on each other. */
static double joint_row_reaction(const pm_measure_args *x, int row)
{
    const int *active = x->w->joint_active + x->w->model->joint_row[x->a];
    const int belt = PM_JOINT_ROW(x->w->model, x->a)[PM_JOINT_KIND] == PM_JOINT_BELT;
    if (active[row] == PM_NONE || (belt && active[1 - row] == PM_NONE)) return NAN;
    return x->w->frame.lambda[active[row]];
}
static double joint_normal(const pm_measure_args *x) { return joint_row_reaction(x, 0); }
static double joint_friction(const pm_measure_args *x)
{
    pm_row row;
    const int presses = pm_joint_of(x->w->model, x->a)->presses;
    return presses ? joint_row_reaction(x, 1) : pm_grip_of_joint(x->w, x->a, &row);
}
static double needed(double normal, double friction) { return normal > 0 ? fabs(friction) / normal : NAN; }
static double joint_friction_needed(const pm_measure_args *x)
{
    return needed(joint_normal(x), joint_friction(x));
}

/* ---- contacts ---- */
static void slots_of(const pm_measure_args *x, int *first, int *last)
{
    *first = x->w->model->contact_slot[x->a];
    *last = *first + pm_contact_slots(x->w->model, x->a);
}

static int counts(const pm_measure_args *x, int slot)
{
    const pm_slot *s = &x->w->state.slot[slot];
    const int member = x->e[PM_MEASURE_MEMBER];
    return s->mode != PM_OPEN && (member == PM_NONE || s->member == member);
}

static double gap(const pm_measure_args *x)
{
    int member = x->e[PM_MEASURE_MEMBER], first, last;
    if (member != PM_NONE) return pm_contact_member_gap(x->w, x->a, member, 0);
    slots_of(x, &first, &last);
    for (int i = first; i < last; i++)
        if (counts(x, i)) return pm_contact_member_gap(x->w, x->a, x->w->state.slot[i].member, 0);
    if (pm_segment_is(x->w->model, x->a)) return pm_segment_gap(x->w, x->a, &member);
    return pm_contact_apart(x->w, &x->w->state, x->a, &member);
}

static double closed(const pm_measure_args *x)
{
    int first, last, n = 0;
    slots_of(x, &first, &last);
    for (int i = first; i < last; i++) n += counts(x, i);
    return n;
}

/* What goes along a segment goes on so round its corners. */
static double way(const pm_measure_args *x, int slot)
{
    return pm_segment_way(x->w->model, x->a, x->w->state.slot[slot].member);
}

static double slip(const pm_measure_args *x)
{
    int first, last;
    slots_of(x, &first, &last);
    for (int i = first; i < last; i++)
        if (counts(x, i)) return way(x, i) * pm_contact_member_slip(x->w, x->a, x->w->state.slot[i].member);
    return NAN;
}

/* What acts on a captured pair has no normal and no friction. */
static double slot_normal(const pm_workspace *w, int slot)
{
    if (w->state.slot[slot].mode == PM_CAPTURED) return NAN;
    const int active = w->slot_normal[slot];
    return active == PM_NONE ? 0 : w->frame.lambda[active];
}

static double slot_friction(const pm_workspace *w, int slot)
{
    const int active = w->slot_tangent[slot];
    if (w->state.slot[slot].mode == PM_CAPTURED) return NAN;
    if (active != PM_NONE) return w->frame.lambda[active];
    return w->slot_normal[slot] == PM_NONE ? 0 : w->row[w->slot_normal[slot]].slide * slot_normal(w, slot);
}

static double contact_normal(const pm_measure_args *x)
{
    int first, last;
    double sum = 0;
    slots_of(x, &first, &last);
    for (int i = first; i < last; i++)
        if (counts(x, i)) sum += slot_normal(x->w, i);
    return sum;
}

static double contact_friction(const pm_measure_args *x)
{
    int first, last;
    double sum = 0;
    slots_of(x, &first, &last);
    for (int i = first; i < last; i++)
        if (counts(x, i)) sum += way(x, i) * slot_friction(x->w, i);
    return sum;
}

static double contact_friction_needed(const pm_measure_args *x)
{
    int first, last;
    double worst = 0;
    slots_of(x, &first, &last);
    for (int i = first; i < last; i++) {
        if (!counts(x, i)) continue;
        const double one = needed(slot_normal(x->w, i), slot_friction(x->w, i));
        if (isnan(one)) return NAN;
        worst = fmax(worst, one);
    }
    return worst;
}

/* Sign of `on`: forces are those on the first partner. */
static double side_of(const pm_measure_args *x)
{
    if (x->e[PM_MEASURE_ON] == PM_NONE) return 1;
    pm_row normal, tangent;
    pm_row_of_contact(x->w, x->a, x->w->model->contact_slot[x->a], 0, &normal, &tangent);
    return normal.body[0] == pm_body_index(x->w->model, x->e[PM_MEASURE_ON]) ? 1 : -1;
}

static double held_force(const pm_workspace *w, int slot, int axis)
{
    const int active = w->slot_held[PM_JOINT_ROWS * slot + axis];
    return active == PM_NONE ? 0 : w->frame.lambda[active];
}

static void contact_force(const pm_measure_args *x, double out[2])
{
    int first, last;
    slots_of(x, &first, &last);
    out[0] = out[1] = 0;
    for (int i = first; i < last; i++) {
        if (!counts(x, i)) continue;
        if (x->w->state.slot[i].mode == PM_CAPTURED) {
            for (int k = 0; k < 2; k++) out[k] += side_of(x) * held_force(x->w, i, k);
            continue;
        }
        pm_row normal, tangent;
        pm_line_of_action along;
        pm_row_of_contact(x->w, x->a, i, x->w->state.slot[i].member, &normal, &tangent);
        pm_row_kind(normal.kind)->act(x->w, &normal, &along);
        for (int k = 0; k < 2; k++) out[k] += side_of(x) * slot_normal(x->w, i) * along.direction[k];
        pm_row_kind(tangent.kind)->act(x->w, &tangent, &along);
        for (int k = 0; k < 2; k++) out[k] += side_of(x) * slot_friction(x->w, i) * along.direction[k];
    }
}

static void contact_impulse(const pm_measure_args *x, double out[2])
{
    int first, last;
    slots_of(x, &first, &last);
    out[0] = out[1] = 0;
    for (int i = first; i < last; i++)
        for (int k = 0; k < 2; k++)
            out[k] += side_of(x) * (x->w->slot_impulse[2 * i] * x->w->slot_direction[4 * i + k] +
                                    x->w->slot_impulse[2 * i + 1] * x->w->slot_direction[4 * i + 2 + k]);
}

/* ---- forces, events, energies ---- */
static void force_force(const pm_measure_args *x, double out[2])
{
    const pm_action f = pm_force_action(x->w, x->a);
    const int other =
        x->e[PM_MEASURE_ON] != PM_NONE && pm_body_index(x->w->model, x->e[PM_MEASURE_ON]) != f.body_a;
    for (int k = 0; k < 2; k++) out[k] = other ? -f.force[k] : f.force[k];
}
static double force_couple(const pm_measure_args *x) { return pm_force_action(x->w, x->a).couple; }
static double force_work(const pm_measure_args *x)
{
    const int z = x->w->model->force_z[x->a];
    if (z != PM_NONE) return x->w->frame.z[z];
    return x->w->force_energy_start[x->a] - pm_force_action(x->w, x->a).energy;
}
static double force_power(const pm_measure_args *x) { return pm_force_action(x->w, x->a).power; }
static double force_stretch(const pm_measure_args *x) { return pm_force_action(x->w, x->a).stretch; }
static double force_energy(const pm_measure_args *x) { return pm_force_action(x->w, x->a).energy; }
static double event_count(const pm_measure_args *x) { return pm_trigger_count(x->w, x->a); }
static double event_time(const pm_measure_args *x) { return pm_trigger_time(x->w, x->a); }
static double potential(const pm_measure_args *x)
{
    return pm_body_weight_energy(x->w) + pm_force_potential(x->w);
}
static double total(const pm_measure_args *x)
{
    return pm_body_kinetic(x->w, PM_NONE) + pm_spin_kinetic(x->w, PM_NONE) + potential(x);
}
static double lost(const pm_measure_args *x) { return x->w->lost; }

/* ---- the turning plane ---- */
static double spin_omega(const pm_measure_args *x) { return pm_spin_omega(x->w); }
static double spin_angle(const pm_measure_args *x) { return pm_spin_angle(x->w); }
static double spin_momentum(const pm_measure_args *x) { return pm_spin_momentum(x->w); }
static double spin_inertia(const pm_measure_args *x) { return pm_spin_inertia(x->w); }

/* ---- the table ---- */
enum { ALL_ALLOWED = 1, CAN_START_POSITION = 2, CAN_START_VELOCITY = 4 };

typedef struct pm_measure_ops {
    int level;
    int of; /* table that `a` points into; -1: none */
    pm_scalar *scalar;
    pm_vector *vector;
    int flags;
} pm_measure_ops;

static const pm_measure_ops kinds[PM_MEASURE_KINDS] = {
    [PM_MEASURE_TIME] = {PM_LEVEL_KINEMATIC, -1, measure_time, 0, 0},
    [PM_MEASURE_ANGLE] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, angle, 0, CAN_START_POSITION},
    [PM_MEASURE_TURNED] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, turned, 0, 0},
    [PM_MEASURE_OMEGA] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, omega, 0, CAN_START_VELOCITY},
    [PM_MEASURE_ALPHA] = {PM_LEVEL_DYNAMIC, PM_TABLE_BODY, alpha, 0, 0},
    [PM_MEASURE_MASS] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, mass, 0, ALL_ALLOWED},
    [PM_MEASURE_WEIGHT] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, weight, 0, ALL_ALLOWED},
    [PM_MEASURE_INERTIA] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, inertia, 0, 0},
    [PM_MEASURE_KINETIC] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, kinetic, 0, ALL_ALLOWED},
    [PM_MEASURE_MOMENTUM] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, 0, momentum, ALL_ALLOWED},
    [PM_MEASURE_ANGULAR_MOMENTUM] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, angular_momentum, 0, ALL_ALLOWED},
    [PM_MEASURE_POLE] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, 0, pole, 0},
    [PM_MEASURE_POSITION] = {PM_LEVEL_KINEMATIC, PM_TABLE_POINT, 0, position, CAN_START_POSITION},
    [PM_MEASURE_MOVED] = {PM_LEVEL_KINEMATIC, PM_TABLE_POINT, 0, moved, 0},
    [PM_MEASURE_PATH] = {PM_LEVEL_KINEMATIC, PM_TABLE_POINT, path, 0, 0},
    [PM_MEASURE_VELOCITY] = {PM_LEVEL_KINEMATIC, PM_TABLE_POINT, 0, point_velocity, CAN_START_VELOCITY},
    [PM_MEASURE_ACCELERATION] = {PM_LEVEL_DYNAMIC, PM_TABLE_POINT, 0, point_acceleration, 0},
    [PM_MEASURE_JOINT_FORCE] = {PM_LEVEL_DYNAMIC, PM_TABLE_JOINT, 0, joint_force, 0},
    [PM_MEASURE_JOINT_COUPLE] = {PM_LEVEL_DYNAMIC, PM_TABLE_JOINT, joint_couple, 0, 0},
    [PM_MEASURE_JOINT_IMPULSE] = {PM_LEVEL_DYNAMIC, PM_TABLE_JOINT, 0, joint_impulse, 0},
    [PM_MEASURE_JOINT_NORMAL] = {PM_LEVEL_DYNAMIC, PM_TABLE_JOINT, joint_normal, 0, 0},
    [PM_MEASURE_JOINT_FRICTION] = {PM_LEVEL_DYNAMIC, PM_TABLE_JOINT, joint_friction, 0, 0},
    [PM_MEASURE_JOINT_FRICTION_NEEDED] = {PM_LEVEL_DYNAMIC, PM_TABLE_JOINT, joint_friction_needed, 0, 0},
    [PM_MEASURE_CONTACT_GAP] = {PM_LEVEL_KINEMATIC, PM_TABLE_CONTACT, gap, 0, 0},
    [PM_MEASURE_CONTACT_CLOSED] = {PM_LEVEL_KINEMATIC, PM_TABLE_CONTACT, closed, 0, 0},
    [PM_MEASURE_CONTACT_SLIP] = {PM_LEVEL_KINEMATIC, PM_TABLE_CONTACT, slip, 0, 0},
    [PM_MEASURE_CONTACT_NORMAL] = {PM_LEVEL_DYNAMIC, PM_TABLE_CONTACT, contact_normal, 0, 0},
    [PM_MEASURE_CONTACT_FRICTION] = {PM_LEVEL_DYNAMIC, PM_TABLE_CONTACT, contact_friction, 0, 0},
    [PM_MEASURE_CONTACT_FRICTION_NEEDED] = {PM_LEVEL_DYNAMIC, PM_TABLE_CONTACT, contact_friction_needed, 0,
                                            0},
    [PM_MEASURE_CONTACT_FORCE] = {PM_LEVEL_DYNAMIC, PM_TABLE_CONTACT, 0, contact_force, 0},
    [PM_MEASURE_CONTACT_IMPULSE] = {PM_LEVEL_KINEMATIC, PM_TABLE_CONTACT, 0, contact_impulse, 0},
    [PM_MEASURE_FORCE_FORCE] = {PM_LEVEL_KINEMATIC, PM_TABLE_FORCE, 0, force_force, 0},
    [PM_MEASURE_FORCE_COUPLE] = {PM_LEVEL_KINEMATIC, PM_TABLE_FORCE, force_couple, 0, 0},
    [PM_MEASURE_FORCE_WORK] = {PM_LEVEL_KINEMATIC, PM_TABLE_FORCE, force_work, 0, 0},
    [PM_MEASURE_FORCE_POWER] = {PM_LEVEL_KINEMATIC, PM_TABLE_FORCE, force_power, 0, 0},
    [PM_MEASURE_FORCE_STRETCH] = {PM_LEVEL_KINEMATIC, PM_TABLE_FORCE, force_stretch, 0, 0},
    [PM_MEASURE_FORCE_ENERGY] = {PM_LEVEL_KINEMATIC, PM_TABLE_FORCE, force_energy, 0, 0},
    [PM_MEASURE_EVENT_COUNT] = {PM_LEVEL_KINEMATIC, PM_TABLE_EVENT, event_count, 0, 0},
    [PM_MEASURE_EVENT_TIME] = {PM_LEVEL_KINEMATIC, PM_TABLE_EVENT, event_time, 0, 0},
    [PM_MEASURE_POTENTIAL] = {PM_LEVEL_KINEMATIC, -1, potential, 0, 0},
    [PM_MEASURE_TOTAL] = {PM_LEVEL_KINEMATIC, -1, total, 0, 0},
    [PM_MEASURE_LOST] = {PM_LEVEL_KINEMATIC, -1, lost, 0, 0},
    [PM_MEASURE_SPIN_OMEGA] = {PM_LEVEL_KINEMATIC, -1, spin_omega, 0, 0},
    [PM_MEASURE_SPIN_ANGLE] = {PM_LEVEL_KINEMATIC, -1, spin_angle, 0, 0},
    [PM_MEASURE_SPIN_MOMENTUM] = {PM_LEVEL_KINEMATIC, -1, spin_momentum, 0, 0},
    [PM_MEASURE_SPIN_INERTIA] = {PM_LEVEL_KINEMATIC, -1, spin_inertia, 0, 0},
};

static double part_of(const pm_workspace *w, const int32_t *e, const double v[2])
{
    switch (e[PM_MEASURE_PART]) {
    case PM_PART_X: return v[0];
    case PM_PART_Y: return v[1];
    case PM_PART_NORM: return hypot(v[0], v[1]);
    case PM_PART_ANGLE: return atan2(v[1], v[0]);
    default: {
        const double direction = w->value[e[PM_MEASURE_VALUE]];
        return v[0] * cos(direction) + v[1] * sin(direction);
    }
    }
}

double pm_measure(pm_workspace *w, int i)
{
    const pm_measure_args x = {w, PM_MEASURE_ROW(w->model, i), PM_MEASURE_ROW(w->model, i)[PM_MEASURE_A]};
    const pm_measure_ops *ops = &kinds[x.e[PM_MEASURE_KIND]];
    if (ops->scalar) return ops->scalar(&x);
    double v[2];
    ops->vector(&x, v);
    return part_of(w, x.e, v);
}

int pm_measure_of(int kind) { return kinds[kind].of; }

int pm_measure_level(const pm_model *m, int i) { return kinds[PM_MEASURE_ROW(m, i)[PM_MEASURE_KIND]].level; }

int pm_measure_can_start(const pm_model *m, int i, int level)
{
    const int32_t *e = PM_MEASURE_ROW(m, i);
    const int linear = e[PM_MEASURE_PART] != PM_PART_NORM && e[PM_MEASURE_PART] != PM_PART_ANGLE;
    return linear && (kinds[e[PM_MEASURE_KIND]].flags &
                      (level == PM_START_POSITION ? CAN_START_POSITION : CAN_START_VELOCITY));
}

static int bad(pm_where *where, int row, double value, double bound)
{
    *where = (pm_where){PM_TABLE_MEASURE, row, PM_NONE, value, bound};
    return PM_BAD_TABLE;
}

int pm_measure_validate(const pm_model *m, pm_where *where)
{
    for (int i = 0; i < m->rows[PM_TABLE_MEASURE]; i++) {
        const int32_t *e = PM_MEASURE_ROW(m, i);
        const int kind = e[PM_MEASURE_KIND], a = e[PM_MEASURE_A], part = e[PM_MEASURE_PART];
        if (kind < 0 || kind >= PM_MEASURE_KINDS) return bad(where, i, kind, PM_MEASURE_KINDS);
        const pm_measure_ops *ops = &kinds[kind];
        const int low = ops->of == PM_TABLE_BODY && kind != PM_MEASURE_POLE ? PM_GROUND : 0;
        const int all = (ops->flags & ALL_ALLOWED) && a == PM_NONE;
        if (ops->of >= 0 && !all && (a < low || a >= m->rows[ops->of]))
            return bad(where, i, a, m->rows[ops->of]);
        if (ops->vector && (part <= PM_PART_NONE || part >= PM_PARTS)) return bad(where, i, part, PM_PARTS);
        if (part == PM_PART_ALONG && e[PM_MEASURE_VALUE] < 0) return bad(where, i, e[PM_MEASURE_VALUE], 0);
        if (kind == PM_MEASURE_JOINT_NORMAL || kind == PM_MEASURE_JOINT_FRICTION ||
            kind == PM_MEASURE_JOINT_FRICTION_NEEDED) {
            const pm_joint_ops *joint = pm_joint_of(m, a);
            const int slides = joint->rubs != PM_NONE && joint->rubs != PM_ROW_TURN;
            if (kind == PM_MEASURE_JOINT_FRICTION && slides) continue;
            if (!joint->presses) return bad(where, i, PM_JOINT_ROW(m, a)[PM_JOINT_KIND], PM_JOINT_KINDS);
        }
    }
    for (int i = 0; i < m->rows[PM_TABLE_START]; i++) {
        const int32_t *e = PM_START_ROW(m, i);
        const int level = e[PM_START_LEVEL];
        if (level < PM_START_POSITION || level > PM_START_VELOCITY ||
            !pm_measure_can_start(m, e[PM_START_MEASURE], level)) {
            *where = (pm_where){PM_TABLE_START, i, PM_NONE, e[PM_START_MEASURE], e[PM_START_LEVEL]};
            return PM_BAD_TABLE;
        }
    }
    return PM_OK;
}

/* The measure's rate is linear in v: reading it with unit velocities gives the coefficients exactly. */
void pm_measure_start_row(pm_workspace *w, int i, int level, double *coefficient)
{
    const int32_t *e = PM_MEASURE_ROW(w->model, i);
    int32_t rate[PM_MEASURE_COLUMNS];
    memcpy(rate, e, sizeof rate);
    if (level == PM_START_POSITION)
        rate[PM_MEASURE_KIND] =
            e[PM_MEASURE_KIND] == PM_MEASURE_ANGLE ? PM_MEASURE_OMEGA : PM_MEASURE_VELOCITY;
    const pm_measure_args x = {w, rate, rate[PM_MEASURE_A]};
    const pm_measure_ops *ops = &kinds[rate[PM_MEASURE_KIND]];
    double *velocity_of = w->frame.velocity;
    for (int k = 0; k < w->model->nq; k++) velocity_of[k] = 0;
    for (int k = 0; k < w->model->nq; k++) {
        double v[2];
        velocity_of[k] = 1;
        if (ops->scalar) {
            coefficient[k] = ops->scalar(&x);
        } else {
            ops->vector(&x, v);
            coefficient[k] = part_of(w, rate, v);
        }
        velocity_of[k] = 0;
    }
    for (int k = 0; k < w->model->nq; k++) velocity_of[k] = w->frame.v[k];
}
