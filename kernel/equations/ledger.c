/* ledger.c - two ledgers that the routes do not use.
 *
 * Work and energy:      T1 + V1 + (work of forces without potential, friction, drives) - (losses of blows) = T2 + V2
 *                                                                                                             (17.11)
 * Impulse and momentum: momenta1 + impulses of the outer world = momenta2, about the origin                   (17.14)
 * Outer impulses are taken from points and directions of the forces (pm_constraint_ops.act), never from the Jacobian; the
 * energy of a blow from sum P (u + u')/2 with the touching points' own velocities.  A wrong sign in a Jacobian opens a
 * ledger. */
#include "equations/ledger.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/force.h"
#include "elements/joint_friction.h"
#include "elements/turning_plane.h"
#include "equations/case.h"
#include "equations/fixed_bodies.h"
#include "equations/projection.h"
#include "equations/saddle.h"
#include "equations/solve_cache.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

int pm_ledger_power(const pm_model *m) { return m->nz_controlled; }
int pm_ledger_ledger(const pm_model *m) { return m->nz_controlled + 1; }

static void add_outer(double *impulse, const double at[2], const double force[2], double couple, double sign)
{
    impulse[0] += sign * force[0];
    impulse[1] += sign * force[1];
    impulse[2] += sign * (couple + at[0] * force[1] - at[1] * force[0]);
}

static void add_constraint(const pm_frame *frame, const pm_constraint *c, double size, double *impulse);

/* By its strands. */
static void add_cord(const pm_frame *frame, const pm_constraint *c, double size, double *impulse)
{
    pm_constraint strand[2];
    double tension[2];
    pm_constraint_cord_strands(c, strand);
    pm_constraint_cord_tensions(c, tension);
    for (int k = 0; k < 2; k++) add_constraint(frame, &strand[k], tension[k] * size, impulse);
}

/* What a constraint gives the scene from outside by a reaction (or an impulse) of that size. */
static void add_constraint(const pm_frame *frame, const pm_constraint *c, double size, double *impulse)
{
    if (pm_constraint_is_inner(frame->numbers, c)) return;
    if (c->over) {
        add_cord(frame, c, size, impulse);
        return;
    }
    const int on_a = !frame->numbers->fixed[c->body[0]], on_b = !frame->numbers->fixed[c->body[1]];
    pm_line_of_action x;
    pm_constraint_kind(c->kind)->act(frame, c, &x);
    const double sign = size * (on_a - on_b);
    const double force[2] = {sign * x.direction[0], sign * x.direction[1]};
    add_outer(impulse, x.at, force, size * (on_a * x.couple[0] + on_b * x.couple[1]), 1);
}

/* Forces (or impulses) of the constraints on the scene from outside. */
static void add_constraints(const pm_frame *frame, const pm_active_set *active, const double *size,
                            double *impulse)
{
    for (int i = 0; i < active->n; i++) add_constraint(frame, &active->constraint[i], size[i], impulse);
    if (!active->asymmetric) return;
    for (int i = active->n; active->constraint[i].normal != PM_NONE; i++) { /* sliding friction */
        const int normal = active->constraint[i].normal;
        add_constraint(frame, &active->constraint[i], active->constraint[normal].slide * size[normal],
                       impulse);
    }
}

/* What drives put in through their constraints, by the rates that they prescribe. */
static double drive_power(const pm_active_set *active, const double *size)
{
    double sum = 0;
    for (int i = 0; i < active->n; i++) sum += size[i] * active->constraint[i].rate;
    return sum;
}

static double friction_power(const pm_frame *frame, const pm_active_set *active, const double *size)
{
    double sum = 0;
    if (!active->asymmetric) return 0;
    for (int i = active->n; active->constraint[i].normal != PM_NONE; i++) {
        const pm_constraint *normal = &active->constraint[active->constraint[i].normal];
        sum += normal->slide * size[active->constraint[i].normal] *
               pm_constraint_rate(frame, &active->constraint[i]);
    }
    return sum;
}

void pm_ledger_controlled_rates(pm_workspace *w, double *zdot)
{
    const pm_model *m = w->model;
    if (m->nz_controlled == 0) return;
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        if (m->force_z[i] != PM_NONE) zdot[m->force_z[i]] = w->frame.power[i];
    for (int i = 0; i < m->npath; i++) {
        const pm_point p = pm_frame_point_of(&w->frame, PM_MEASURE_ROW(m, m->path[i])[PM_MEASURE_A]);
        zdot[m->nz_work + i] = hypot(p.v[0], p.v[1]);
    }
    pm_turning_plane_rates(w, zdot);
}

double pm_ledger_controlled_scale(const pm_frame *frame, int z)
{
    const double spin = pm_turning_plane_scale(frame, z);
    if (spin > 0) return spin;
    if (z >= frame->model->nz_work) return frame->numbers->size;
    return pm_frame_total_mass(frame) * frame->numbers->speed * frame->numbers->speed;
}

void pm_ledger_rates(pm_workspace *w, double *zdot)
{
    const pm_model *m = w->model;
    pm_ledger_controlled_rates(w, zdot);
    zdot[pm_ledger_power(m)] = friction_power(&w->frame, &w->active, w->frame.lambda) +
                               drive_power(&w->active, w->frame.lambda) + pm_turning_plane_power(w);
    double *outer = zdot + pm_ledger_ledger(m);
    pm_turning_plane_outer(&w->frame, outer);
    for (int i = 0; i < m->nbody; i++) {
        if (w->numbers.fixed[i]) continue;
        const double force[2] = {w->numbers.mass[i] * w->numbers.gravity[0],
                                 w->numbers.mass[i] * w->numbers.gravity[1]};
        add_outer(outer, w->frame.pose + 5 * i, force, 0, 1);
    }
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++) {
        const pm_action x = pm_force_action(w, i);
        if (!w->numbers.fixed[x.body_a]) add_outer(outer, x.at_a, x.force, x.couple, 1);
        if (!w->numbers.fixed[x.body_b]) add_outer(outer, x.at_b, x.force, x.couple, -1);
    }
    add_constraints(&w->frame, &w->active, w->frame.lambda, outer);
}

int pm_ledger_rests(const pm_workspace *w)
{
    const pm_model *m = w->model;
    const double *g = w->numbers.gravity;
    return m->nz_controlled == 0 && m->rows[PM_TABLE_FORCE] == 0 && !pm_turning_plane_turns(m) &&
           w->active.n == 0 && g[0] == 0 && g[1] == 0;
}

static double energy(pm_workspace *w)
{
    return pm_frame_kinetic(&w->frame, PM_NONE) + pm_turning_plane_kinetic(&w->frame, PM_NONE) +
           pm_frame_weight_energy(&w->frame) + pm_force_potential(w);
}

void pm_ledger_begin(pm_workspace *w)
{
    pm_frame_look_state(&w->frame, &w->state);
    w->ledger.energy_start = energy(w);
    w->ledger.energy_lost = 0;
    w->ledger.energy_scale = pm_frame_kinetic(&w->frame, PM_NONE);
    w->ledger.momentum_scale = 0;
    w->ledger.constraint_worst = w->ledger.evidence = 0;
    pm_frame_momentum(&w->frame, PM_NONE, w->ledger.momentum_start);
}

static double work_of_forces(const pm_model *m, const pm_state *state)
{
    double sum = state->z[pm_ledger_power(m)];
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        if (m->force_z[i] != PM_NONE) sum += state->z[m->force_z[i]];
    return sum;
}

/* Linear momentum counts as m v, angular as m v times the scene's size: one scale for all three. */
static double momentum_size(const pm_numbers *numbers, const double p[PM_LEDGER])
{
    return pm_max(fabs(p[2]) / numbers->size, pm_max(fabs(p[1]), fabs(p[0])));
}

static void update_scales(pm_workspace *w, double kinetic)
{
    double p[PM_LEDGER];
    pm_frame_momentum(&w->frame, PM_NONE, p);
    double *energy = &w->ledger.energy_scale, *momentum = &w->ledger.momentum_scale;
    *energy = pm_max(fabs(work_of_forces(w->model, &w->state)), pm_max(kinetic, *energy));
    *momentum = pm_max(momentum_size(&w->numbers, p), *momentum);
    *momentum = pm_max(momentum_size(&w->numbers, w->state.z + pm_ledger_ledger(w->model)), *momentum);
}

void pm_ledger_follow(const pm_frame *frame, const double before[PM_LEDGER], double *z)
{
    double *ledger = z + pm_ledger_ledger(frame->model), momentum[PM_LEDGER];
    pm_frame_momentum(frame, PM_NONE, momentum);
    for (int i = 0; i < PM_LEDGER; i++) ledger[i] += momentum[i] - before[i];
}

void pm_ledger_step(pm_workspace *w)
{
    update_scales(w, pm_frame_kinetic(&w->frame, PM_NONE));
    if (w->active.n == 0) return;
    if (!pm_solve_cache_take_constraints(w)) pm_saddle_evaluate(&w->active, &w->frame);
    w->ledger.constraint_worst =
        pm_max(pm_projection_residual(&w->frame, &w->active), w->ledger.constraint_worst);
}

void pm_ledger_jump(pm_workspace *w, const double *before)
{
    const pm_model *m = w->model;
    const double *lambda = w->saddle.rhs;
    double *velocity = w->frame.velocity, loss = 0;
    add_constraints(&w->frame, &w->active, lambda, w->state.z + pm_ledger_ledger(m));
    for (int side = 0; side < 2; side++) { /* mean of the rates before and after */
        if (side == 1) memcpy(velocity, before, (size_t)m->nq * sizeof *velocity);
        for (int i = 0; i < w->active.n; i++)
            loss -= 0.5 * lambda[i] * pm_constraint_rate(&w->frame, &w->active.constraint[i]);
        loss -= 0.5 * friction_power(&w->frame, &w->active, lambda);
    }
    const double kinetic_before = pm_frame_kinetic(&w->frame, PM_NONE);
    memcpy(velocity, w->state.v, (size_t)m->nq * sizeof *velocity);
    const double kinetic = pm_frame_kinetic(&w->frame, PM_NONE);
    w->impulses.energy_lost += kinetic_before - kinetic;
    w->ledger.energy_lost += loss;
    update_scales(w, kinetic);
}

void pm_ledger_contact(pm_workspace *w, const pm_constraint *along, double impulse, const double *before)
{
    add_constraint(&w->frame, along, impulse, w->state.z + pm_ledger_ledger(w->model));
    w->ledger.energy_lost -=
        0.5 * impulse *
        (pm_constraint_times(&w->frame, along, before) + pm_constraint_times(&w->frame, along, w->state.v));
}

void pm_ledger_impulse(const pm_model *model, pm_state *state, const double at[2], const double force[2],
                       double couple)
{
    add_outer(state->z + pm_ledger_ledger(model), at, force, couple, 1);
}

/* One constraint's share of a series of blows: what the outer world gives; the energy that it takes. */
static double add_of_series(const pm_frame *frame, pm_state *state, const pm_constraint *c, double impulse)
{
    add_constraint(frame, c, impulse, state->z + pm_ledger_ledger(frame->model));
    return -impulse * pm_constraint_rate(frame, c);
}

void pm_ledger_series(pm_workspace *w, double factor)
{
    const pm_model *m = w->model;
    double loss = 0;
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++) {
        pm_constraint c[PM_JOINT_CONSTRAINTS];
        const int n = pm_joint_constraints(&w->frame, &w->state, i, c);
        for (int k = 0; k < n; k++)
            loss += add_of_series(&w->frame, &w->state, &c[k],
                                  w->impulses.joint[m->joint_constraint[i] + k] *= factor);
    }
    for (int k = 0; k < m->nfriction; k++) {
        pm_constraint slip;
        if (w->impulses.friction[k] == 0) continue;
        pm_joint_friction_constraint(&w->frame, k, &slip);
        loss += add_of_series(&w->frame, &w->state, &slip, w->impulses.friction[k] *= factor);
    }
    for (int i = 0; i < m->nslot; i++) {
        pm_constraint normal, tangent;
        double *impulse = w->impulses.slot + 2 * i;
        if (impulse[0] == 0 && impulse[1] == 0) continue;
        pm_contact_constraint_both(&w->frame, pm_contact_of_slot(m, i), i, w->state.slot[i].member, &normal,
                                   &tangent);
        loss += add_of_series(&w->frame, &w->state, &normal, impulse[0] *= factor);
        loss += add_of_series(&w->frame, &w->state, &tangent, impulse[1] *= factor);
    }
    w->ledger.energy_lost += loss;
    w->impulses.energy_lost = loss;
}

/* Far from the origin positions, and with them heights, are rounded: relative to the energy scale, once per event. */
static double energy_rounding(const pm_workspace *w, double mass)
{
    const double rounding =
        PM_LEDGER_PLACE * pm_contact_reach(w) * (double)(1 + w->result.count[PM_COUNT_EVENTS]);
    const double spin = PM_LEDGER_SPIN * pm_turning_plane_kinetic(&w->frame, PM_NONE);
    return w->ledger.energy_scale > 0
               ? (mass * pm_case_acceleration(&w->numbers) * rounding + spin) / w->ledger.energy_scale
               : 0;
}

/* The same of moments about the origin: forces of the size of the weight, with arms that are rounded, all the time. */
static double momentum_rounding(const pm_workspace *w, double mass)
{
    const double impulse = mass * hypot(w->numbers.gravity[0], w->numbers.gravity[1]) * w->state.t,
                 arm = PM_LEDGER_PLACE * pm_contact_reach(w) / w->numbers.size;
    return w->ledger.momentum_scale > 0 ? impulse * arm / w->ledger.momentum_scale : 0;
}

/* What the errors of integration may leave of a ledger, relative: it goes with the tolerance, but a run whose energy is wrong
 * by a greater part of the whole is no answer at any accuracy.  A coarse run may be as much worse as its tolerance is. */
static double bound_of_errors(const pm_numbers *numbers, const pm_evidence *evidence)
{
    const double most = PM_LEDGER_MOST * (pm_evidence_is_coarse(evidence) ? PM_COARSER : 1);
    return fmax(PM_LEDGER_ROUNDING, fmin(PM_LEDGER_ERRORS * numbers->tolerance, most));
}

/* Residuals and what they may be. */
static void weigh(pm_workspace *w, double *audit, double *bound)
{
    const pm_model *m = w->model;
    double p[PM_LEDGER], open[PM_LEDGER];
    pm_frame_look_state(&w->frame, &w->state);
    pm_frame_momentum(&w->frame, PM_NONE, p);
    for (int i = 0; i < PM_LEDGER; i++)
        open[i] = p[i] - w->ledger.momentum_start[i] - w->state.z[pm_ledger_ledger(m) + i];
    const double energy_open =
        energy(w) - w->ledger.energy_start - work_of_forces(w->model, &w->state) + w->ledger.energy_lost;
    const double mass = pm_frame_total_mass(&w->frame);
    w->ledger.momentum_scale = pm_max(PM_LEDGER_SLOWEST * mass * w->numbers.speed, w->ledger.momentum_scale);
    w->ledger.energy_scale =
        pm_max(PM_LEDGER_SLOWEST * PM_LEDGER_SLOWEST * mass * w->numbers.speed * w->numbers.speed,
               w->ledger.energy_scale);
    audit[PM_AUDIT_ENERGY] = w->ledger.energy_scale > 0 ? fabs(energy_open) / w->ledger.energy_scale : 0;
    if (w->ledger.evidence > audit[PM_AUDIT_ENERGY])
        audit[PM_AUDIT_ENERGY] = w->ledger.evidence; /* a NaN stays */
    audit[PM_AUDIT_MOMENTUM] =
        w->ledger.momentum_scale > 0 ? momentum_size(&w->numbers, open) / w->ledger.momentum_scale : 0;
    audit[PM_AUDIT_CONSTRAINT] = w->ledger.constraint_worst;
    for (int i = 0; i < PM_AUDITS; i++) bound[i] = bound_of_errors(&w->numbers, &w->evidence);
    bound[PM_AUDIT_CONSTRAINT] = PM_LEDGER_ROUNDING;
    /* where rounding is as great as what is balanced the ledger says nothing, and the run is not confirmed */
    bound[PM_AUDIT_ENERGY] += fmin(energy_rounding(w, mass), PM_LEDGER_BLIND);
    bound[PM_AUDIT_MOMENTUM] += fmin(momentum_rounding(w, mass), PM_LEDGER_BLIND);
}

/* The first residual above its bound, or PM_NONE. */
static int first_open(const double *audit, const double *bound)
{
    for (int i = 0; i < PM_AUDITS; i++)
        if (!(audit[i] <= bound[i])) return i;
    return PM_NONE;
}

int pm_ledger_close(pm_workspace *w)
{
    double bound[PM_AUDITS];
    weigh(w, w->result.audit, bound);
    const int open = first_open(w->result.audit, bound);
    if (open == PM_NONE) return PM_OK;
    return pm_fail(&w->result, PM_AUDIT, PM_NONE, open, w->result.audit[open], bound[open]);
}

int pm_ledger_closes(pm_workspace *w)
{
    double audit[PM_AUDITS], bound[PM_AUDITS];
    weigh(w, audit, bound);
    return first_open(audit, bound) == PM_NONE;
}
