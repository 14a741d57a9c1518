/* measure_joint.c - what joints do to their bodies.
 *
 * A constraint with reaction lambda does lambda n to the first body and -lambda n to the second, and its couples
 * (constraint.h); what acts at a joint is the sum over its constraints, and the dry friction in it (joint_friction.h).
 * A belt that carries T_0 in either strand at rest carries T_0 + F/2 and T_0 - F/2 where it drives with F. */
#include <string.h>

#include "elements/constraint.h"
#include "elements/drive.h"
#include "elements/joint.h"
#include "elements/joint_friction.h"
#include "elements/measure_kinds.h"
#include "state/workspace.h"

/* Which partner of a joint an address means: the first, or (`on` another body) the second; PM_NONE of a joint that is not
 * there: nothing acts. */
static int partner_of(const pm_measure_args *x)
{
    pm_constraint c[PM_JOINT_CONSTRAINTS];
    if (x->e[PM_MEASURE_ON] == PM_NONE) return 0;
    if (pm_state_is_absent(x->w->model, &x->w->state, PM_TABLE_JOINT, x->a)) return PM_NONE;
    pm_joint_constraints_of_any(&x->w->frame, x->a, c);
    return c[0].body[0] != pm_model_body_index(x->w->model, x->e[PM_MEASURE_ON]);
}

/* What the reaction of a constraint does to one of its two bodies. */
static void add_reaction(const pm_measure_args *x, const pm_constraint *c, double size, int on, double out[3])
{
    pm_line_of_action along; /* the constraints need not be evaluated where the frame looks */
    pm_constraint_kind(c->kind)->act(&x->w->frame, c, &along);
    for (int k = 0; k < 2; k++) out[k] += (on == 0 ? size : -size) * along.direction[k];
    out[2] += size * along.couple[on];
}

static const pm_constraint *constraint_at(const pm_workspace *w, int place)
{
    return place >= 0 ? &w->active.constraint[place] : &w->active.redundant[PM_REDUNDANT_PLACE(place)];
}

/* The same of its impulse in the last blow: teeth may have had the other flank loaded then. */
static void add_impulse(const pm_measure_args *x, pm_constraint c, double size, int on, double out[3])
{
    c.flank = x->w->impulses.flank[x->a];
    add_reaction(x, &c, size, on, out);
}

/* Sum over the constraints of a joint of its reaction, or impulse[], times what a unit of it does. */
static void joint_sum(const pm_measure_args *x, const double *impulse, double out[3])
{
    const pm_model *m = x->w->model;
    const int first = m->joint_constraint[x->a], last = x->a + 1 < m->rows[PM_TABLE_JOINT]
                                                            ? m->joint_constraint[x->a + 1]
                                                            : m->njoint_constraint;
    const int on = partner_of(x);
    out[0] = out[1] = out[2] = 0;
    for (int i = first; i < last && on != PM_NONE; i++) {
        const int place = x->w->active.of_joint[i];
        if (place == PM_NONE) continue;
        const pm_constraint *c = constraint_at(x->w, place);
        if (impulse)
            add_impulse(x, *c, impulse[i], on, out);
        else
            add_reaction(x, c, pm_reaction(x->w, place), on, out);
    }
    pm_constraint slip;
    const double friction = impulse ? pm_joint_friction_impulse(x->w, x->a, &slip)
                                    : pm_joint_friction_of_joint(x->w, x->a, &slip);
    if (friction != 0 && on != PM_NONE) add_reaction(x, &slip, friction, on, out);
}

void pm_measured_joint_force(const pm_measure_args *x, double out[2])
{
    double sum[3];
    joint_sum(x, NULL, sum);
    memcpy(out, sum, 2 * sizeof *out);
}
double pm_measured_joint_couple(const pm_measure_args *x)
{
    double sum[3];
    joint_sum(x, NULL, sum);
    return sum[2];
}
void pm_measured_joint_impulse(const pm_measure_args *x, double out[2])
{
    double sum[3];
    joint_sum(x, x->w->impulses.joint, sum);
    memcpy(out, sum, 2 * sizeof *out);
}
/* Of a driven joint: its constraints come with what they prescribe. */
double pm_measured_joint_power(const pm_measure_args *x)
{
    pm_constraint c[PM_JOINT_CONSTRAINTS];
    const int n = pm_joint_constraints(&x->w->frame, &x->w->state, x->a, c);
    const int *place = x->w->active.of_joint + x->w->model->joint_constraint[x->a];
    double sum = 0;
    for (int k = 0; k < n; k++)
        if (c[k].drive != PM_NONE && place[k] != PM_NONE)
            sum += pm_reaction(x->w, place[k]) * pm_drive_rate(&x->w->frame, &c[k]);
    return sum;
}
static double constraint_reaction(const pm_measure_args *x, int row)
{
    const int place = x->w->active.of_joint[x->w->model->joint_constraint[x->a] + row];
    return place == PM_NONE ? NAN : pm_reaction(x->w, place);
}
/* What strand 0 or 1 of a belt carries; nothing where the belt is not there. */
static double tension(const pm_measure_args *x, const pm_joint_ops *ops, int strand)
{
    pm_constraint c;
    if (pm_state_is_absent(x->w->model, &x->w->state, PM_TABLE_JOINT, x->a)) return 0;
    const double at_rest = x->w->numbers.value[PM_JOINT_ROW(x->w->model, x->a)[PM_JOINT_VALUE_2]];
    const double drives =
        ops->by_friction ? pm_joint_friction_of_joint(x->w, x->a, &c) : constraint_reaction(x, 0);
    return at_rest + (strand == 0 ? 0.5 : -0.5) * drives;
}
double pm_measured_joint_normal(const pm_measure_args *x)
{
    const pm_joint_ops *ops = pm_joint_of(x->w->model, x->a);
    return ops->strands ? tension(x, ops, 0) : constraint_reaction(x, 0);
}
double pm_measured_joint_friction(const pm_measure_args *x)
{
    pm_constraint c;
    const pm_joint_ops *ops = pm_joint_of(x->w->model, x->a);
    if (ops->strands) return tension(x, ops, 1);
    return ops->presses ? constraint_reaction(x, 1) : pm_joint_friction_of_joint(x->w, x->a, &c);
}
double pm_measured_joint_friction_needed(const pm_measure_args *x)
{
    return pm_measured_needed(pm_measured_joint_normal(x), pm_measured_joint_friction(x));
}
/* What holds does not slip, not by rounding either. */
double pm_measured_joint_slip(const pm_measure_args *x)
{
    pm_constraint c;
    if (pm_state_is_absent(x->w->model, &x->w->state, PM_TABLE_JOINT, x->a)) return NAN;
    const int k = pm_joint_friction_find(&x->w->frame, x->a, &c);
    if (k == PM_NONE) return NAN;
    return x->w->state.friction[k] == PM_STICK ? 0 : pm_constraint_slip(&x->w->frame, &c);
}
