/* measure_contact.c - what is read off contacts: where they are, and what acts there.
 *
 * Of all slots of a contact those count that are closed, with the member that is meant, if any is.  Forces are those on
 * the first partner: N n + F t, n and t the directions of the normal and the tangential constraint (constraint.h); of a
 * captured pair those of the constraints that hold it. */
#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/contact_curve.h"
#include "elements/edge.h"
#include "elements/measure_kinds.h"
#include "state/workspace.h"

/* ---- slots ---- */
static int counts(const pm_measure_args *x, int slot)
{
    const pm_slot *s = &x->w->state.slot[slot];
    const int member = x->e[PM_MEASURE_MEMBER];
    return s->mode != PM_OPEN && (member == PM_NONE || s->member == member);
}

/* The first slot that counts, from `slot` on; PM_NONE if there is none. */
static int slot_from(const pm_measure_args *x, int slot)
{
    const int end = x->w->model->contact_slot[x->a + 1];
    while (slot < end && !counts(x, slot)) slot++;
    return slot < end ? slot : PM_NONE;
}
static int first_slot(const pm_measure_args *x) { return slot_from(x, x->w->model->contact_slot[x->a]); }
static int next_slot(const pm_measure_args *x, int slot) { return slot_from(x, slot + 1); }

static int member_of(const pm_measure_args *x, int slot) { return x->w->state.slot[slot].member; }

/* What goes along a segment or a curve goes on so round its corners. */
static double way(const pm_measure_args *x, int slot)
{
    const int member = member_of(x, slot);
    return pm_edge_way(x->w->model, x->a, member) * pm_contact_curve_way(x->w->model, x->a, member);
}

/* ---- where they are ---- */
double pm_measured_contact_gap(const pm_measure_args *x)
{
    int member = x->e[PM_MEASURE_MEMBER];
    if (member != PM_NONE) return pm_contact_member_gap(&x->w->frame, x->a, member, 0);
    const int slot = first_slot(x);
    if (slot != PM_NONE) return pm_contact_member_gap(&x->w->frame, x->a, member_of(x, slot), 0);
    if (pm_edge_is(x->w->model, x->a)) return pm_edge_gap(&x->w->frame, x->a, &member);
    return pm_contact_apart(&x->w->frame, &x->w->state, x->a, &member);
}

double pm_measured_contact_closed(const pm_measure_args *x)
{
    int n = 0;
    for (int i = first_slot(x); i != PM_NONE; i = next_slot(x, i)) n++;
    return n;
}

double pm_measured_contact_slip(const pm_measure_args *x)
{
    const int slot = first_slot(x);
    return slot == PM_NONE ? NAN
                           : way(x, slot) * pm_contact_member_slip(&x->w->frame, x->a, member_of(x, slot));
}

/* ---- what acts there ---- */
/* What acts on a captured pair has no normal and no friction. */
static double slot_normal(const pm_workspace *w, int slot)
{
    if (w->state.slot[slot].mode == PM_CAPTURED) return NAN;
    return pm_reaction(w, w->active.slot_normal[slot]);
}

static double slot_friction(const pm_workspace *w, int slot)
{
    const int tangent = w->active.slot_tangent[slot], normal = w->active.slot_normal[slot];
    if (w->state.slot[slot].mode == PM_CAPTURED) return NAN;
    if (tangent != PM_NONE) return pm_reaction(w, tangent);
    if (normal == PM_NONE) return 0;
    const double slide = normal >= 0 ? w->active.constraint[normal].slide
                                     : w->active.redundant[PM_REDUNDANT_PLACE(normal)].slide;
    return slide * slot_normal(w, slot);
}

double pm_measured_contact_normal(const pm_measure_args *x)
{
    double sum = 0;
    for (int i = first_slot(x); i != PM_NONE; i = next_slot(x, i)) sum += slot_normal(x->w, i);
    return sum;
}

double pm_measured_contact_friction(const pm_measure_args *x)
{
    double sum = 0;
    for (int i = first_slot(x); i != PM_NONE; i = next_slot(x, i)) sum += way(x, i) * slot_friction(x->w, i);
    return sum;
}

double pm_measured_contact_friction_needed(const pm_measure_args *x)
{
    double worst = 0;
    for (int i = first_slot(x); i != PM_NONE; i = next_slot(x, i)) {
        const double one = pm_measured_needed(slot_normal(x->w, i), slot_friction(x->w, i));
        if (isnan(one)) return NAN;
        if (fabs(one) > fabs(worst)) worst = one;
    }
    return worst;
}

/* Sign of `on`: forces are those on the first partner. */
static double side_of(const pm_measure_args *x)
{
    if (x->e[PM_MEASURE_ON] == PM_NONE) return 1;
    pm_constraint normal, tangent;
    pm_contact_constraint_both(&x->w->frame, x->a, x->w->model->contact_slot[x->a], 0, &normal, &tangent);
    return normal.body[0] == pm_model_body_index(x->w->model, x->e[PM_MEASURE_ON]) ? 1 : -1;
}

static double held_force(const pm_workspace *w, int slot, int axis)
{
    return pm_reaction(w, w->active.slot_held[PM_JOINT_CONSTRAINTS * slot + axis]);
}

/* ---- cords over a rim ---- */
/* The tension of a strand, 0 or 1, by what acts along the cord and by the friction of the rim. */
static double tension_of(const pm_measure_args *x, int strand, double normal, double friction)
{
    pm_constraint of[2];
    double by_normal[2], by_friction[2];
    pm_contact_constraint_both(&x->w->frame, x->a, x->w->model->contact_slot[x->a], 0, &of[0], &of[1]);
    pm_constraint_cord_tensions(&of[0], by_normal);
    pm_constraint_cord_tensions(&of[1], by_friction);
    return by_normal[strand] * normal + by_friction[strand] * friction;
}

static double tension(const pm_measure_args *x, int strand)
{
    const int slot = x->w->model->contact_slot[x->a];
    if (x->w->state.slot[slot].mode == PM_OPEN) return 0;
    return tension_of(x, strand, slot_normal(x->w, slot), slot_friction(x->w, slot));
}

double pm_measured_contact_tension(const pm_measure_args *x)
{
    return tension(x, x->e[PM_MEASURE_MEMBER] == 1);
}

double pm_measured_contact_tension_impulse(const pm_measure_args *x)
{
    const double *impulse = x->w->impulses.slot + 2 * x->w->model->contact_slot[x->a];
    return tension_of(x, x->e[PM_MEASURE_MEMBER] == 1, impulse[0], impulse[1]);
}

/* By both strands, where they end at the body that is meant. */
static void force_of_cord(const pm_measure_args *x, double out[2])
{
    pm_constraint normal, strand[2];
    pm_contact_constraint_normal(&x->w->frame, x->a, x->w->model->contact_slot[x->a], 0, &normal);
    pm_constraint_cord_strands(&normal, strand);
    const int on = x->e[PM_MEASURE_ON] == PM_NONE ? normal.body[0]
                                                  : pm_model_body_index(x->w->model, x->e[PM_MEASURE_ON]);
    for (int k = 0; k < 2; k++) {
        pm_line_of_action along;
        pm_constraint_kind(strand[k].kind)->act(&x->w->frame, &strand[k], &along);
        const double sign = (strand[k].body[0] == on) - (strand[k].body[1] == on);
        for (int i = 0; i < 2; i++) out[i] += sign * tension(x, k) * along.direction[i];
    }
}

static void add_constraint(const pm_measure_args *x, const pm_constraint *c, double force, double out[2])
{
    pm_line_of_action along;
    pm_constraint_kind(c->kind)->act(&x->w->frame, c, &along);
    for (int k = 0; k < 2; k++) out[k] += force * along.direction[k];
}

void pm_measured_contact_force(const pm_measure_args *x, double out[2])
{
    const double side = side_of(x);
    out[0] = out[1] = 0;
    if (pm_contact_has_rim(x->w->model, x->a)) {
        force_of_cord(x, out);
        return;
    }
    for (int i = first_slot(x); i != PM_NONE; i = next_slot(x, i)) {
        if (x->w->state.slot[i].mode == PM_CAPTURED) {
            for (int k = 0; k < 2; k++) out[k] += side * held_force(x->w, i, k);
            continue;
        }
        pm_constraint normal, tangent;
        pm_contact_constraint_both(&x->w->frame, x->a, i, member_of(x, i), &normal, &tangent);
        const double sign = side * pm_contact_constraint_side(&x->w->frame, x->a, &normal);
        add_constraint(x, &normal, sign * slot_normal(x->w, i), out);
        add_constraint(x, &tangent, sign * slot_friction(x->w, i), out);
    }
}

/* Of a flank with friction. */
static double couple_of_teeth(const pm_measure_args *x, int slot)
{
    pm_constraint normal, tangent;
    pm_contact_constraint_both(&x->w->frame, x->a, slot, 0, &normal, &tangent);
    return tangent.value * slot_friction(x->w, slot);
}

/* At the place where it is held; the angle is its last constraint. */
double pm_measured_contact_couple(const pm_measure_args *x)
{
    double sum = 0;
    for (int i = first_slot(x); i != PM_NONE; i = next_slot(x, i))
        if (x->w->state.slot[i].mode == PM_CAPTURED)
            sum += held_force(x->w, i, PM_JOINT_CONSTRAINTS - 1);
        else if (pm_contact_rubs(x->w->model, x->a))
            sum += couple_of_teeth(x, i);
    return side_of(x) * sum;
}

/* Of the last blow, in whatever slots it was. */
void pm_measured_contact_impulse(const pm_measure_args *x, double out[2])
{
    const pm_workspace *w = x->w;
    const int first = w->model->contact_slot[x->a], last = first + pm_contact_slots(w->model, x->a);
    const double side = side_of(x);
    out[0] = out[1] = 0;
    for (int i = first; i < last; i++) {
        const double *impulse = w->impulses.slot + 2 * i, *direction = w->impulses.slot_direction + 4 * i;
        for (int k = 0; k < 2; k++)
            out[k] += side * (impulse[0] * direction[k] + impulse[1] * direction[2 + k]);
    }
}
