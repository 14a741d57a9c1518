/* contact_pair.c - two curves as partners of a contact; each may have two corners, as an edge has.
 *
 * A member tells where they touch: the nodes of both next to there, and which corner of which it is.  A corner is a point of one
 * body on the curve of the other (constraint_curve.c).  Along the edge the touching place goes to the corner; there the
 * edge has the direction of the curve, and as it turns further the corner stays, until it has that direction again. */
#include "elements/contact_pair.h"

#include <math.h>

#include "elements/contact.h"
#include "elements/curve_piece.h"
#include "elements/pair.h"

enum { NODES = PM_CURVE_NODES + 1 };

static int member_of(int corner, int first, int second) { return second + NODES * (first + NODES * corner); }
static int second_of(int member) { return member % NODES; }
static int first_of(int member) { return member / NODES % NODES; }
int pm_contact_pair_corner(int member) { return member / (NODES * NODES); }

int pm_contact_pair_is(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND] == PM_CONTACT_CURVES;
}

int pm_contact_pair_first(const pm_model *m, int contact) { return PM_CONTACT_ROW(m, contact)[PM_CONTACT_A]; }

static int second(const pm_model *m, int contact) { return PM_CONTACT_ROW(m, contact)[PM_CONTACT_B]; }

static int is_open(const pm_frame *frame, int curve) { return pm_curve_has_ends(frame->model, curve); }

static int curve_of(const pm_model *m, int contact, int corner)
{
    return pm_pair_is_second(corner) ? second(m, contact) : pm_contact_pair_first(m, contact);
}

static double end_of(const pm_frame *frame, int contact, int corner)
{
    return pm_curve_bound(frame, curve_of(frame->model, contact, corner),
                          pm_pair_end(corner) == PM_PAIR_FROM ? PM_CURVE_FROM : PM_CURVE_TO);
}

/* By how far the edge at a corner stands up from the other curve, over its length. */
static double rises(const pm_frame *frame, const pm_constraint *normal, int contact, int corner)
{
    const pm_constraint *whole = &frame->numbers->of_contact[contact];
    const pm_pair x = pm_pair_of(frame, whole);
    const pm_curve_place foot = pm_curve_at(frame, normal->curve, pm_constraint_curve_foot(frame, normal));
    return pm_pair_corner_rises(&x, corner, foot.n) *
           frame->numbers->course[curve_of(frame->model, contact, corner)].size;
}

/* ---- gaps ---- */
/* Which corners what touches at s has come over, of the first curve or of the second. */
static void take_passed(const pm_frame *frame, int contact, int corner, double s, int passed[])
{
    for (int i = corner; i <= corner + 1; i++) {
        const double beyond = s - end_of(frame, contact, i);
        if (pm_pair_end(i) == PM_PAIR_FROM ? beyond < 0 : beyond > 0) passed[i] = 1;
    }
}

/* What is closed with a member: its places on both curves, and the corners that it has come over. */
static void take_closed(const pm_frame *frame, const pm_constraint *normal, int contact, int member,
                        pm_pair_closed *closed)
{
    const int corner = pm_contact_pair_corner(member);
    double s[2] = {pm_constraint_curve_foot(frame, normal), NAN};
    if (!isfinite(s[0])) return;
    if (corner == PM_PAIR_WITHIN) {
        s[1] = pm_constraint_pair_places(frame, normal).a.s;
        if (is_open(frame, normal->other)) take_passed(frame, contact, PM_PAIR_FROM, s[1], closed->passed);
        if (is_open(frame, normal->curve))
            take_passed(frame, contact, PM_PAIR_SECOND_FROM, s[0], closed->passed);
    } else {
        s[1] = end_of(frame, contact, corner);
        closed->passed[corner] = rises(frame, normal, contact, corner) < 0;
    }
    const int is_second = pm_pair_is_second(corner);
    closed->feet.s[closed->feet.n++] = s[is_second];
    closed->first.s[closed->first.n++] = s[!is_second];
}

static pm_pair_closed closed_of(const pm_frame *frame, const pm_state *s, int contact)
{
    const int first = frame->model->contact_slot[contact];
    pm_pair_closed closed = {.feet = {.n = 0}, .first = {.n = 0}};
    for (int i = first; i < first + PM_PATTERN_SLOTS; i++) {
        pm_constraint normal;
        if (s->slot[i].mode == PM_OPEN) continue;
        pm_contact_constraint_normal(frame, contact, i, s->slot[i].member, &normal);
        take_closed(frame, &normal, contact, s->slot[i].member, &closed);
    }
    return closed;
}

static int nearest(const pm_frame *frame, const pm_state *s, int contact, pm_pair_near *near)
{
    const pm_pair_closed closed = closed_of(frame, s, contact);
    const pm_pair x = pm_pair_of(frame, &frame->numbers->of_contact[contact]);
    return pm_pair_nearest(&x, &closed, near);
}

static int member_at(const pm_frame *frame, int contact, const pm_pair_near *near)
{
    const pm_model *m = frame->model;
    return member_of(near->corner, pm_curve_feet_node(frame, pm_contact_pair_first(m, contact), near->at.a.s),
                     pm_curve_feet_node(frame, second(m, contact), near->at.b.s));
}

double pm_contact_pair_gap(const pm_frame *frame, const pm_state *s, int contact, int *member)
{
    pm_pair_near near;
    if (!nearest(frame, s, contact, &near)) return INFINITY;
    *member = member_at(frame, contact, &near);
    return near.at.height;
}

int pm_contact_pair_touches(const pm_frame *frame, const pm_state *s, int contact, int *member)
{
    pm_pair_near near;
    if (!nearest(frame, s, contact, &near)) return 0;
    *member = member_at(frame, contact, &near);
    return near.at.height <= pm_contact_length(frame);
}

/* ---- members ---- */
/* The first body becomes the one of the curve, the second that of the corner. */
static void swap(pm_constraint *normal)
{
    const pm_constraint as = *normal;
    normal->curve = as.other;
    normal->near[0] = as.near[1];
    for (int k = 0; k < 2; k++) {
        normal->body[k] = as.body[1 - k];
        normal->a[k] = as.b[k];
        normal->b[k] = as.a[k];
    }
}

void pm_contact_pair_constraint(const pm_frame *frame, int contact, int member, pm_constraint *normal)
{
    const pm_model *m = frame->model;
    const int first = pm_contact_pair_first(m, contact), corner = pm_contact_pair_corner(member);
    normal->near[0] = pm_curve_feet_place(frame, second(m, contact), second_of(member));
    normal->near[1] = pm_curve_feet_place(frame, first, first_of(member));
    if (corner == PM_PAIR_WITHIN) return;
    const pm_curve_place end =
        pm_curve_at(frame, curve_of(m, contact, corner), end_of(frame, contact, corner));
    if (pm_pair_is_second(corner)) swap(normal);
    normal->kind = PM_CONSTRAINT_CURVE_NORMAL;
    normal->other = PM_NONE;
    for (int k = 0; k < 2; k++) normal->a[k] += end.p[k];
}

static int are_next(const pm_model *m, int curve, int a, int b)
{
    const int off = a < b ? b - a : a - b;
    return off <= 1 || (pm_curve_is_round(m, curve) && off >= PM_CURVE_NODES - 1);
}

int pm_contact_pair_is_same(const pm_model *m, int contact, int a, int b)
{
    return are_next(m, second(m, contact), second_of(a), second_of(b));
}

int pm_contact_pair_follow(const pm_frame *frame, int contact, int member, const pm_memory *memory)
{
    const pm_model *m = frame->model;
    const int corner = pm_contact_pair_corner(member), first = pm_contact_pair_first(m, contact);
    if (pm_pair_is_second(corner))
        return member_of(corner, pm_curve_feet_node(frame, first, memory->foot), second_of(member));
    const int node =
        corner == PM_PAIR_WITHIN ? pm_curve_feet_node(frame, first, memory->other[0]) : first_of(member);
    return member_of(corner, node, pm_curve_feet_node(frame, second(m, contact), memory->foot));
}

/* ---- ends ---- */
/* Of the places within both, on the first. */
static double room_on_first(const pm_frame *frame, const pm_constraint *normal)
{
    if (!is_open(frame, normal->other)) return INFINITY;
    const pm_curve_place own =
        pm_curve_at(frame, normal->other, pm_constraint_pair_places(frame, normal).a.s);
    return pm_curve_room(frame, normal->other, &own);
}

static double room_of_member(const pm_frame *frame, const pm_constraint *normal, int contact, int member)
{
    const int corner = pm_contact_pair_corner(member);
    return corner == PM_PAIR_WITHIN ? room_on_first(frame, normal) : rises(frame, normal, contact, corner);
}

/* On the curve of the foot: the second, or of a corner of that the first. */
static double room_of_foot(const pm_frame *frame, const pm_constraint *normal)
{
    return is_open(frame, normal->curve) || pm_curve_has_pieces(frame->model, normal->curve)
               ? pm_constraint_curve_room(frame, normal)
               : INFINITY;
}

double pm_contact_pair_room(const pm_frame *frame, const pm_constraint *normal, int contact, int member)
{
    return fmin(room_of_member(frame, normal, contact, member), room_of_foot(frame, normal)) +
           pm_contact_length(frame);
}

int pm_contact_pair_is_at_foot(const pm_frame *frame, const pm_constraint *normal, int contact, int member)
{
    return room_of_foot(frame, normal) < room_of_member(frame, normal, contact, member);
}

/* The curve of the foot comes to its end, not only to a knot. */
static int is_last(const pm_frame *frame, const pm_constraint *normal)
{
    return !pm_curve_has_pieces(frame->model, normal->curve) ||
           pm_curve_piece_is_last(frame, normal->curve, pm_constraint_curve_foot(frame, normal));
}

/* The corner of the second to which what is within comes. */
static int next_on_second(const pm_frame *frame, const pm_constraint *normal, int member)
{
    if (!is_last(frame, normal)) return PM_NONE;
    const int to = second_of(member) >= PM_CURVE_NODES / 2;
    return member_of(to ? PM_PAIR_SECOND_TO : PM_PAIR_SECOND_FROM, first_of(member), to ? PM_CURVE_NODES : 0);
}

int pm_contact_pair_next(const pm_frame *frame, const pm_constraint *normal, int contact, int member)
{
    const int is_within = pm_contact_pair_corner(member) == PM_PAIR_WITHIN;
    if (pm_contact_pair_is_at_foot(frame, normal, contact, member))
        return is_within ? next_on_second(frame, normal, member) : PM_NONE;
    if (!is_within) return member_of(PM_PAIR_WITHIN, first_of(member), second_of(member));
    const int to = first_of(member) >= PM_CURVE_NODES / 2;
    return member_of(to ? PM_PAIR_TO : PM_PAIR_FROM, to ? PM_CURVE_NODES : 0, second_of(member));
}
