/* joint_friction.c - friction of joints (dry, Coulomb): a couple in a bearing, a force along a slider or a slot, what a belt
 * drives with.
 *
 *   |F| <= F0 + c |R|  where it holds,   F = -(F0 + c |R|) sgn(slip)  where it slides
 *
 * F0 is given; c is mu of a slider or slot, mu r of a bearing of radius r; R is the reaction of the joint.  A friction that
 * holds is a constraint more; one that slides is a force, whose size is found with the reactions by iteration where c > 0
 * (pm_saddle_accelerate).  In a blow a friction of given size has no impulse; one by the load has (impact/impact_loaded.c). */
#include "elements/joint_friction.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/joint.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

int pm_joint_friction_joint(const pm_model *m, int k)
{
    return PM_FORCE_ROW(m, m->friction_force[k])[PM_FORCE_A];
}

static const int32_t *force_of(const pm_frame *frame, int k)
{
    return PM_FORCE_ROW(frame->model, frame->model->friction_force[k]);
}

static int joint_of(const pm_frame *frame, int k) { return pm_joint_friction_joint(frame->model, k); }
static double own(const pm_frame *frame, int k)
{
    return frame->numbers->value[force_of(frame, k)[PM_FORCE_VALUE_1]];
}
static double by_load(const pm_frame *frame, int k)
{
    return frame->numbers->value[force_of(frame, k)[PM_FORCE_VALUE_2]];
}
static int slides(int mode) { return mode == PM_SLIDE_FORWARD || mode == PM_SLIDE_BACKWARD; }

int pm_joint_friction_any(const pm_model *m) { return m->nfriction > 0; }

int pm_joint_friction_by_load(const pm_frame *frame, const pm_state *state)
{
    for (int k = 0; k < frame->model->nfriction; k++)
        if (slides(state->friction[k]) && by_load(frame, k) > 0) return 1;
    return 0;
}

void pm_joint_friction_constraint(const pm_frame *frame, int k, pm_constraint *c)
{
    const int joint = joint_of(frame, k);
    pm_constraint constraint[PM_JOINT_CONSTRAINTS];
    pm_joint_constraints_of_any(frame, joint, constraint);
    *c = constraint[0];
    c->memory = frame->model->friction_memory + k;
    c->kind = pm_joint_of(frame->model, joint)->slip;
    if (c->kind == PM_CONSTRAINT_CIRCLE_TANGENT) { /* the slot's circle round a point */
        c->radius_b = c->value;
        c->sign = -1;
    }
}

double pm_joint_friction_slip(const pm_frame *frame, int k)
{
    pm_constraint c;
    pm_joint_friction_constraint(frame, k, &c);
    return pm_constraint_slip(frame, &c);
}

double pm_joint_friction_no_slip(const pm_frame *frame, int k)
{
    const int rotates = pm_joint_of(frame->model, joint_of(frame, k))->slip == PM_CONSTRAINT_RATIO;
    return pm_contact_speed(frame) / (rotates ? frame->numbers->size : 1);
}

double pm_joint_friction_coefficient(const pm_frame *frame, int k) { return by_load(frame, k); }

/* The couple that keeps a slider's direction is none of them. */
int pm_joint_friction_places(const pm_workspace *w, int k, int place[2])
{
    const int joint = joint_of(&w->frame, k);
    const pm_joint_ops *ops = pm_joint_of(w->model, joint);
    const int n = ops->slip == PM_CONSTRAINT_RATIO && ops->nconstraint > 1 ? 2 : 1;
    for (int i = 0; i < n; i++) place[i] = w->active.of_joint[w->model->joint_constraint[joint] + i];
    return n;
}

int pm_joint_friction_loads(const pm_workspace *w, int k, const double *x, double load[2])
{
    int place[2];
    const int n = pm_joint_friction_places(w, k, place);
    for (int i = 0; i < 2; i++) load[i] = i < n && place[i] >= 0 ? x[place[i]] : 0;
    return n;
}

static double load(const pm_workspace *w, int k, const double *x)
{
    double r[2];
    pm_joint_friction_loads(w, k, x, r);
    return hypot(r[0], r[1]);
}

double pm_joint_friction_limit(const pm_workspace *w, int k)
{
    const double c = by_load(&w->frame, k);
    return own(&w->frame, k) + (c > 0 ? c * load(w, k, w->frame.lambda) : 0);
}

double pm_joint_friction_sliding(const pm_workspace *w, int k)
{
    const double size = own(&w->frame, k) + w->active.friction_load[k];
    return w->state.friction[k] == PM_SLIDE_FORWARD    ? -size
           : w->state.friction[k] == PM_SLIDE_BACKWARD ? size
                                                       : 0;
}

int pm_joint_friction_find(const pm_frame *frame, int joint, pm_constraint *c)
{
    for (int k = 0; k < frame->model->nfriction; k++) {
        if (joint_of(frame, k) != joint) continue;
        pm_joint_friction_constraint(frame, k, c);
        return k;
    }
    return PM_NONE;
}

double pm_joint_friction_of_joint(const pm_workspace *w, int joint, pm_constraint *c)
{
    const int k = pm_joint_friction_find(&w->frame, joint, c);
    if (k == PM_NONE) return 0;
    const int place = w->active.friction_constraint[k];
    return place == PM_NONE ? pm_joint_friction_sliding(w, k) : pm_reaction(w, place);
}

double pm_joint_friction_impulse(const pm_workspace *w, int joint, pm_constraint *c)
{
    const int k = pm_joint_friction_find(&w->frame, joint, c);
    return k == PM_NONE ? 0 : w->impulses.friction[k];
}

static int of_force(const pm_frame *frame, int force)
{
    int k = 0;
    while (frame->model->friction_force[k] != force) k++;
    return k;
}

void pm_joint_friction_action(const pm_workspace *w, int force, pm_action *x)
{
    const int k = of_force(&w->frame, force);
    pm_constraint c;
    pm_line_of_action along;
    pm_joint_friction_constraint(&w->frame, k, &c);
    pm_constraint_kind(c.kind)->act(&w->frame, &c, &along);
    const double size = pm_joint_friction_sliding(w, k);
    x->body_a = c.body[0];
    x->body_b = c.body[1];
    for (int i = 0; i < 2; i++) {
        x->at_a[i] = x->at_b[i] = along.at[i];
        x->force[i] = size * along.direction[i];
    }
    x->couple = size * along.couple[0]; /* the opposite acts on b */
    x->rate = pm_constraint_slip(&w->frame, &c);
    x->power = size * x->rate;
}

int pm_joint_friction_steady(const pm_frame *frame, int force, const pm_constant_motion *x)
{
    pm_constraint c;
    pm_joint_friction_constraint(frame, of_force(frame, force), &c);
    const pm_constraint_ops *ops = pm_constraint_kind(c.kind);
    return ops->steady && ops->steady(frame, &c, x);
}

double pm_joint_friction_update(pm_workspace *w)
{
    double most = 0, changed = 0;
    for (int i = 0; i < w->active.n; i++) most = fmax(most, fabs(w->frame.lambda[i]));
    for (int k = 0; k < w->model->nfriction; k++) {
        const double c = by_load(&w->frame, k);
        if (!slides(w->state.friction[k]) || !(c > 0)) continue;
        const double next = c * load(w, k, w->frame.lambda);
        changed = fmax(changed, fabs(next - w->active.friction_load[k]) / c);
        w->active.friction_load[k] = next;
    }
    return changed > 0 ? changed / fmax(most, changed) : 0;
}

/* ---- modes ---- */
void pm_joint_friction_release(pm_workspace *w)
{
    for (int k = 0; k < w->model->nfriction; k++) {
        w->state.friction[k] = PM_OPEN;
        w->active.friction_load[k] = 0;
    }
}

static void hold(const pm_frame *frame, pm_state *state, int k)
{
    pm_constraint c;
    state->friction[k] = PM_STICK;
    pm_joint_friction_constraint(frame, k, &c);
    pm_constraint_kind(c.kind)->remember(frame, &c, &state->memory[c.memory], 1);
}

void pm_joint_friction_close(const pm_frame *frame, pm_state *state)
{
    for (int k = 0; k < frame->model->nfriction; k++) {
        const double slip = pm_joint_friction_slip(frame, k);
        if (pm_state_is_absent(frame->model, state, PM_TABLE_JOINT, joint_of(frame, k)))
            state->friction[k] = PM_OPEN;
        else if (fabs(slip) <= pm_joint_friction_no_slip(frame, k))
            hold(frame, state, k);
        else
            state->friction[k] = slip > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
    }
}

/* Against the friction that would have held it. */
void pm_joint_friction_slides(pm_workspace *w, int k)
{
    const double friction = w->frame.lambda[w->active.friction_constraint[k]];
    w->state.friction[k] = friction > 0 ? PM_SLIDE_BACKWARD : PM_SLIDE_FORWARD;
}

void pm_joint_friction_stops(const pm_frame *frame, pm_state *state, int k) { hold(frame, state, k); }

int pm_joint_friction_overcome(pm_workspace *w, double slack)
{
    for (int k = 0; k < w->model->nfriction; k++) {
        if (w->state.friction[k] != PM_STICK || w->active.friction_constraint[k] < 0) continue;
        const int rotates = pm_joint_of(w->model, joint_of(&w->frame, k))->slip == PM_CONSTRAINT_RATIO;
        const double needed = fabs(w->frame.lambda[w->active.friction_constraint[k]]),
                     limit = pm_joint_friction_limit(w, k);
        if (needed <= limit + slack * (rotates ? w->numbers.size : 1)) continue;
        pm_joint_friction_slides(w, k);
        return k;
    }
    return PM_NONE;
}

int pm_joint_friction_check_blow(pm_workspace *w)
{
    for (int k = 0; k < w->model->nfriction; k++)
        if (by_load(&w->frame, k) > 0 && load(w, k, w->saddle.rhs) > 0)
            return pm_fail(&w->result, PM_UNSUPPORTED, PM_TABLE_FORCE, w->model->friction_force[k], NAN, NAN);
    return PM_OK;
}
