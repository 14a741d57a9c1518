/* contact.c - gaps of potential contacts.  A pattern has members k = .. -1, 0, 1 ..: the gap of a circle to a member
 * grows with |k - k0|, k0 its place along the pattern, so the nearest open member is the first open one below or above k0. */
#include "elements/contact.h"

#include <math.h>

#include "elements/capture.h"
#include "elements/constraint.h"
#include "elements/contact_curve.h"
#include "elements/edge.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

double pm_contact_length(const pm_frame *frame)
{
    return PM_TOUCHING * frame->numbers->coarse * frame->numbers->size;
}
double pm_contact_speed(const pm_frame *frame)
{
    return PM_NO_SPEED * frame->numbers->coarse * frame->numbers->speed;
}

double pm_contact_reach(const pm_workspace *w)
{
    double reach = w->numbers.size;
    for (int i = 0; i < w->model->nq; i++)
        if (i % 3 != 2) reach = pm_max(fabs(w->state.q[i]), reach);
    return reach;
}

int pm_contact_is_pattern(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND] == PM_CONTACT_PATTERN;
}

int pm_contact_free_slot(const pm_frame *frame, const pm_state *s, int contact)
{
    const int first = frame->model->contact_slot[contact];
    for (int i = first; i < first + pm_contact_slots(frame->model, contact); i++)
        if (s->slot[i].mode == PM_OPEN) return i;
    return PM_NONE;
}

/* Of a segment one member at a time is closed: it stands for all. */
static int is_closed(const pm_frame *frame, const pm_state *s, int contact, int member)
{
    const int first = frame->model->contact_slot[contact];
    for (int i = first; i < first + pm_contact_slots(frame->model, contact); i++)
        if (s->slot[i].mode != PM_OPEN && (s->slot[i].member == member || pm_edge_is(frame->model, contact)))
            return 1;
    return 0;
}

static inline double plain_gap(const pm_frame *frame, int contact, double *rate)
{
    const pm_constraint *c = &frame->numbers->of_contact[contact];
    return pm_constraint_kind(c->kind)->gap(frame, c, rate);
}

double pm_contact_restitution(const pm_frame *frame, int contact)
{
    return frame->numbers->value[PM_CONTACT_ROW(frame->model, contact)[PM_CONTACT_RESTITUTION]];
}

double pm_contact_tangential(const pm_frame *frame, int contact)
{
    const int index = PM_CONTACT_ROW(frame->model, contact)[PM_CONTACT_TANGENTIAL];
    return index == PM_NONE ? 0 : frame->numbers->value[index];
}

double pm_contact_stiffness(const pm_frame *frame, int contact)
{
    const int index = PM_CONTACT_ROW(frame->model, contact)[PM_CONTACT_STIFFNESS];
    return index == PM_NONE ? 0 : frame->numbers->value[index];
}

int pm_contact_law(const pm_model *m, int contact) { return PM_CONTACT_ROW(m, contact)[PM_CONTACT_LAW]; }

int pm_contact_friction(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_FRICTION];
}

int pm_contact_is_cord(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND] == PM_CONTACT_CORD;
}

int pm_contact_has_rim(const pm_model *m, int contact)
{
    return pm_contact_is_cord(m, contact) && PM_CONTACT_ROW(m, contact)[PM_CONTACT_RIM] != PM_NONE;
}

int pm_contact_has_flank(const pm_model *m, int contact)
{
    const int kind = PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND];
    return kind == PM_CONTACT_TEETH || kind == PM_CONTACT_RACK;
}

int pm_contact_measures_itself(const pm_model *m, int contact)
{
    return pm_contact_is_cord(m, contact) || pm_contact_has_flank(m, contact);
}

/* Of a rim as the tensions of its cord have it. */
static double coefficient(const pm_frame *frame, int contact, int column)
{
    const int32_t *e = PM_CONTACT_ROW(frame->model, contact);
    const int lever = e[PM_CONTACT_LEVER];
    if (e[PM_CONTACT_FRICTION] != PM_FRICTION_COULOMB) return 0;
    if (lever != PM_NONE && frame->numbers->value[lever] == 0) return 0;
    const double given = frame->numbers->value[e[column]];
    if (!pm_contact_has_rim(frame->model, contact)) return given;
    pm_constraint c;
    pm_contact_constraint_normal(frame, contact, frame->model->contact_slot[contact], 0, &c);
    return pm_constraint_cord_grip(given, pm_constraint_cord_wrap(frame, &c));
}

double pm_contact_static(const pm_frame *frame, int contact)
{
    return coefficient(frame, contact, PM_CONTACT_STATIC);
}
double pm_contact_kinetic(const pm_frame *frame, int contact)
{
    return coefficient(frame, contact, PM_CONTACT_KINETIC);
}
int pm_contact_friction_jumps(const pm_frame *frame, int contact)
{
    return pm_contact_friction(frame->model, contact) == PM_FRICTION_COULOMB &&
           pm_contact_static(frame, contact) > pm_contact_kinetic(frame, contact);
}

/* Two points that are at one place have no direction: nothing is known of the rate. */
static double meeting_gap(const pm_frame *frame, int contact, double *rate)
{
    const double distance = pm_capture_distance(frame, contact);
    if (rate) *rate = distance > 0 ? pm_capture_approach(frame, contact) / distance : 0;
    return distance;
}

/* Of a circle and a point of a pattern, as constraint_distance.c has it. */
static double point_gap(const pm_frame *frame, int contact, int member, double *rate)
{
    const pm_constraint *c = &frame->numbers->of_contact[contact]; /* with member 0 */
    const int32_t *pattern =
        PM_PATTERN_ROW(frame->model, PM_CONTACT_ROW(frame->model, contact)[PM_CONTACT_B]);
    const pm_point a = pm_frame_point(frame, c->body[0], c->a[0], c->a[1]);
    const pm_point b = pm_frame_point(frame, c->body[1],
                                      c->b[0] + member * frame->numbers->value[pattern[PM_PATTERN_STEP_X]],
                                      c->b[1] + member * frame->numbers->value[pattern[PM_PATTERN_STEP_Y]]);
    const double d[2] = {a.p[0] - b.p[0], a.p[1] - b.p[1]}, u[2] = {a.v[0] - b.v[0], a.v[1] - b.v[1]};
    const double distance = pm_length(d);
    if (rate) *rate = pm_dot(u, d) / distance;
    return distance - c->radius_a;
}

/* By the constraint with the numbers of the case, if its kind and that member need no other. */
static const pm_constraint_ops *ops_of_gap(const pm_model *m, const pm_constraint *c, int contact, int member)
{
    const pm_constraint_ops *ops = pm_constraint_kind(c->kind);
    return ops->gap && (member == PM_SEGMENT_FACE || !pm_edge_is(m, contact)) ? ops : NULL;
}

double pm_contact_member_gap(const pm_frame *frame, int contact, int member, double *rate)
{
    const pm_constraint *own = &frame->numbers->of_contact[contact];
    if (pm_contact_is_plain(frame->model, contact)) return plain_gap(frame, contact, rate);
    if (pm_capture_is_meeting(frame->model, contact)) return meeting_gap(frame, contact, rate);
    if (pm_contact_is_pattern(frame->model, contact)) return point_gap(frame, contact, member, rate);
    const pm_constraint_ops *ops = ops_of_gap(frame->model, own, contact, member);
    if (ops) return ops->gap(frame, own, rate);
    pm_constraint normal;
    pm_contact_constraint_normal(frame, contact, frame->model->contact_slot[contact], member, &normal);
    pm_constraint_kind(normal.kind)->evaluate(frame, &normal);
    if (rate) *rate = pm_constraint_times(frame, &normal, frame->v);
    return normal.g;
}

double pm_contact_member_slip(const pm_frame *frame, int contact, int member)
{
    pm_constraint normal, tangent;
    pm_contact_constraint_both(frame, contact, frame->model->contact_slot[contact], member, &normal,
                               &tangent);
    return pm_constraint_slip(frame, &tangent);
}

/* Where a mark of a body is. */
static inline void place_of(const double *pose, const double mark[2], double p[2])
{
    p[0] = pose[0] + (pose[3] * mark[0] - pose[4] * mark[1]);
    p[1] = pose[1] + (pose[4] * mark[0] + pose[3] * mark[1]);
}

pm_beside pm_contact_beside(const pm_frame *frame, int contact)
{
    const pm_constraint *of = &frame->numbers->of_contact[contact]; /* with member 0 */
    const int32_t *pattern =
        PM_PATTERN_ROW(frame->model, PM_CONTACT_ROW(frame->model, contact)[PM_CONTACT_B]);
    const double *axes = frame->pose + 5 * of->body[1];
    double c[2], first[2];
    place_of(frame->pose + 5 * of->body[0], of->a, c);
    place_of(axes, of->b, first);
    const double sx = frame->numbers->value[pattern[PM_PATTERN_STEP_X]],
                 sy = frame->numbers->value[pattern[PM_PATTERN_STEP_Y]];
    return (pm_beside){.d = {c[0] - first[0], c[1] - first[1]},
                       .step = {axes[3] * sx - axes[4] * sy, axes[4] * sx + axes[3] * sy},
                       .radius = of->radius_a};
}

/* As constraint_distance.c has it. */
double pm_contact_gap_beside(const pm_beside *x, int member)
{
    const double d[2] = {x->d[0] - member * x->step[0], x->d[1] - member * x->step[1]};
    return pm_length(d) - x->radius;
}

/* The members of a pattern that are closed. */
typedef struct pm_closed {
    int n;
    int32_t member[PM_PATTERN_SLOTS];
} pm_closed;

static inline pm_closed closed_of(const pm_frame *frame, const pm_state *s, int contact)
{
    const pm_slot *slot = s->slot + frame->model->contact_slot[contact];
    pm_closed x = {.n = 0};
    for (int i = 0; i < PM_PATTERN_SLOTS; i++)
        if (slot[i].mode != PM_OPEN) x.member[x.n++] = slot[i].member;
    return x;
}

static inline int is_among(const pm_closed *x, int member)
{
    for (int i = 0; i < x->n; i++)
        if (x->member[i] == member) return 1;
    return 0;
}

/* Goes from member k on, step by step, past those that are closed. */
static inline int next_open(const pm_closed *x, int k, int step, int first, int last)
{
    while (k >= first && k <= last && is_among(x, k)) k += step;
    return k;
}

/* The whole number below, where there is an int for it. */
static int below_of(double place)
{
    const int k = (int)place;
    return k > place ? k - 1 : k;
}

/* Place along the pattern, in steps from its first member. */
static double place_beside(const pm_beside *x) { return pm_dot(x->d, x->step) / pm_dot(x->step, x->step); }

/* The last of the members that are not above a place, of those that there are; one less than the first where there is none. */
static inline int below_of_place(const pm_frame *frame, int contact, const pm_beside *x, int *first,
                                 int *last)
{
    const int32_t *pattern =
        PM_PATTERN_ROW(frame->model, PM_CONTACT_ROW(frame->model, contact)[PM_CONTACT_B]);
    const double count = frame->numbers->value[pattern[PM_PATTERN_COUNT]];
    const double place = place_beside(x);
    const int most_members = (int)PM_MOST_MEMBERS;
    *last = count < 0 ? most_members : (int)count - 1;
    *first = count < 0 ? -most_members : 0;
    return !(place >= *first) ? *first - 1 : place > *last ? *last : below_of(place);
}

/* Open members from `below` down and from there up, in turn. */
static inline int members_about(const pm_closed *closed, int below, int first, int last, int most,
                                int *member)
{
    int down = below, up = below + 1, n = 0;
    while (n + 1 < most) {
        down = next_open(closed, down, -1, first, last);
        up = next_open(closed, up, 1, first, last);
        if (down < first && up > last) break;
        if (down >= first) member[n++] = down--;
        if (up <= last) member[n++] = up++;
    }
    return n;
}

static int members_of_pattern(const pm_frame *frame, const pm_state *s, int contact, const pm_beside *x,
                              int most, int *member)
{
    int first, last;
    const int below = below_of_place(frame, contact, x, &first, &last);
    const pm_closed closed = closed_of(frame, s, contact);
    return members_about(&closed, below, first, last, most, member);
}

/* It is there, with a pattern that has no end. */
static int is_endless(const pm_workspace *w, int contact)
{
    if (!pm_contact_is_pattern(w->model, contact)) return 0;
    const int32_t *pattern = PM_PATTERN_ROW(w->model, PM_CONTACT_ROW(w->model, contact)[PM_CONTACT_B]);
    return w->numbers.value[pattern[PM_PATTERN_COUNT]] < 0 &&
           !pm_state_is_absent(w->model, &w->state, PM_TABLE_CONTACT, contact);
}

int pm_contact_check_places(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        if (!is_endless(w, i)) continue;
        const pm_beside x = pm_contact_beside(&w->frame, i);
        const double place = place_beside(&x);
        if (!(fabs(place) <= PM_MOST_MEMBERS))
            return pm_fail(&w->result, PM_BAD_VALUE, PM_TABLE_CONTACT, i, place, PM_MOST_MEMBERS);
    }
    return PM_OK;
}

int pm_contact_near(const pm_frame *frame, const pm_state *s, int contact, int most, int *member)
{
    const int32_t *e = PM_CONTACT_ROW(frame->model, contact);
    if (pm_state_is_absent(frame->model, s, PM_TABLE_CONTACT, contact)) return 0;
    member[0] = 0;
    if (pm_contact_is_plain(frame->model, contact))
        return !pm_contact_plain_is_closed(frame->model, s, contact);
    if (e[PM_CONTACT_KIND] == PM_CONTACT_PATTERN) {
        const pm_beside x = pm_contact_beside(frame, contact);
        return members_of_pattern(frame, s, contact, &x, most, member);
    }
    return !is_closed(frame, s, contact, 0);
}

double pm_contact_nearest_of(const pm_frame *frame, const pm_state *s, int contact, const pm_beside *x,
                             pm_near *near, int *member)
{
    int first, last;
    const int below = below_of_place(frame, contact, x, &first, &last);
    if (near->n < 0 || near->below != below) {
        const pm_closed closed = closed_of(frame, s, contact);
        near->n = members_about(&closed, below, first, last, 2, near->member);
        near->below = below;
    }
    double least = INFINITY;
    *member = 0;
    for (int i = 0; i < near->n; i++) {
        const double gap = pm_contact_gap_beside(x, near->member[i]);
        if (!(gap <= least)) continue;
        least = gap;
        *member = near->member[i];
    }
    return least;
}

double pm_contact_nearest_beside(const pm_frame *frame, const pm_state *s, int contact, const pm_beside *x,
                                 int *member)
{
    pm_near near = {.n = -1};
    return pm_contact_nearest_of(frame, s, contact, x, &near, member);
}

static double pattern_gap(const pm_frame *frame, const pm_state *s, int contact, int *member)
{
    const pm_beside x = pm_contact_beside(frame, contact);
    return pm_contact_nearest_beside(frame, s, contact, &x, member);
}

double pm_contact_gap_to(const pm_frame *frame, int contact, int member)
{
    const pm_beside x = pm_contact_beside(frame, contact);
    return pm_contact_gap_beside(&x, member);
}

double pm_contact_gap(const pm_frame *frame, const pm_state *s, int contact, int *member)
{
    *member = 0;
    return pm_state_is_absent(frame->model, s, PM_TABLE_CONTACT, contact)
               ? INFINITY
               : pm_contact_apart(frame, s, contact, member);
}

double pm_contact_apart(const pm_frame *frame, const pm_state *s, int contact, int *member)
{
    const int32_t *e = PM_CONTACT_ROW(frame->model, contact);
    *member = 0;
    if (pm_contact_is_plain(frame->model, contact))
        return pm_contact_plain_is_closed(frame->model, s, contact) ? INFINITY
                                                                    : plain_gap(frame, contact, NULL);
    if (e[PM_CONTACT_KIND] == PM_CONTACT_PATTERN) return pattern_gap(frame, s, contact, member);
    if (pm_contact_curve_is(frame->model, contact)) return pm_contact_curve_gap(frame, s, contact, member);
    if (is_closed(frame, s, contact, 0)) return INFINITY;
    if (!pm_edge_is(frame->model, contact)) return pm_contact_member_gap(frame, contact, 0, 0);
    return pm_edge_is_covered(frame, s, contact) ? INFINITY : pm_edge_gap(frame, contact, member);
}

int pm_contact_touches(const pm_frame *frame, const pm_state *s, int contact, int *member)
{
    if (pm_contact_gap(frame, s, contact, member) > pm_contact_length(frame)) return 0;
    if (pm_contact_is_plain(frame->model, contact)) return 1;
    if (pm_contact_curve_is(frame->model, contact))
        return pm_contact_curve_touches(frame, s, contact, member);
    return !pm_edge_is(frame->model, contact) || pm_edge_touches(frame, contact);
}
