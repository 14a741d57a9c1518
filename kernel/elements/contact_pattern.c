/* contact_pattern.c - a circle beside a pattern of points, which has members k = .. -1, 0, 1 ..: the gap to a member grows with
 * |k - k0|, k0 the circle's place along the pattern, so that the nearest open member is the first open one below or above k0. */
#include "elements/contact_pattern.h"

#include <math.h>

#include "elements/constraint.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

/* Where a mark of a body is. */
static inline void place_of(const double *pose, const double mark[2], double p[2])
{
    p[0] = pose[0] + (pose[3] * mark[0] - pose[4] * mark[1]);
    p[1] = pose[1] + (pose[4] * mark[0] + pose[3] * mark[1]);
}

pm_beside pm_contact_pattern_beside(const pm_frame *frame, int contact)
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

/* Of the distance of the centre from a member, as constraint_distance.c has it. */
static inline double square_beside(const pm_beside *x, int member)
{
    const double d[2] = {x->d[0] - member * x->step[0], x->d[1] - member * x->step[1]};
    return pm_dot(d, d);
}

double pm_contact_pattern_gap_beside(const pm_beside *x, int member)
{
    return sqrt(square_beside(x, member)) - x->radius;
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

int pm_contact_pattern_near(const pm_frame *frame, const pm_state *s, int contact, int most, int *member)
{
    const pm_beside x = pm_contact_pattern_beside(frame, contact);
    int first, last;
    const int below = below_of_place(frame, contact, &x, &first, &last);
    const pm_closed closed = closed_of(frame, s, contact);
    return members_about(&closed, below, first, last, most, member);
}

/* It is there, with a pattern that has no end. */
static int is_endless(const pm_workspace *w, int contact)
{
    const int32_t *e = PM_CONTACT_ROW(w->model, contact);
    if (e[PM_CONTACT_KIND] != PM_CONTACT_PATTERN) return 0;
    const int32_t *pattern = PM_PATTERN_ROW(w->model, e[PM_CONTACT_B]);
    return w->numbers.value[pattern[PM_PATTERN_COUNT]] < 0 &&
           !pm_state_is_absent(w->model, &w->state, PM_TABLE_CONTACT, contact);
}

int pm_contact_pattern_check(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        if (!is_endless(w, i)) continue;
        const pm_beside x = pm_contact_pattern_beside(&w->frame, i);
        const double place = place_beside(&x);
        if (!(fabs(place) <= PM_MOST_MEMBERS))
            return pm_fail(&w->result, PM_BAD_VALUE, PM_TABLE_CONTACT, i, place, PM_MOST_MEMBERS);
    }
    return PM_OK;
}

/* Between that member, or where it would be, and the next. */
static inline int is_next_above(const pm_beside *x, int member)
{
    const double step = pm_dot(x->step, x->step), beyond = pm_dot(x->d, x->step) - member * step;
    return beyond >= 0 && beyond < step;
}

double pm_contact_pattern_nearest_of(const pm_frame *frame, const pm_state *s, int contact,
                                     const pm_beside *x, pm_near *near, int *member)
{
    if (near->n < 0 || !is_next_above(x, near->below)) {
        int first, last;
        const pm_closed closed = closed_of(frame, s, contact);
        near->below = below_of_place(frame, contact, x, &first, &last);
        near->n = members_about(&closed, near->below, first, last, 2, near->member);
    }
    double least = INFINITY; /* squared: the root of one is enough */
    *member = 0;
    for (int i = 0; i < near->n; i++) {
        const double square = square_beside(x, near->member[i]);
        if (!(square <= least)) continue;
        least = square;
        *member = near->member[i];
    }
    return sqrt(least) - x->radius;
}

double pm_contact_pattern_nearest(const pm_frame *frame, const pm_state *s, int contact, const pm_beside *x,
                                  int *member)
{
    pm_near near = {.n = -1};
    return pm_contact_pattern_nearest_of(frame, s, contact, x, &near, member);
}

double pm_contact_pattern_gap(const pm_frame *frame, const pm_state *s, int contact, int *member)
{
    const pm_beside x = pm_contact_pattern_beside(frame, contact);
    return pm_contact_pattern_nearest(frame, s, contact, &x, member);
}

double pm_contact_pattern_gap_to(const pm_frame *frame, int contact, int member)
{
    const pm_beside x = pm_contact_pattern_beside(frame, contact);
    return pm_contact_pattern_gap_beside(&x, member);
}

/* Of a circle and a point of a pattern, as constraint_distance.c has it. */
double pm_contact_pattern_member_gap(const pm_frame *frame, int contact, int member, double *rate)
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
