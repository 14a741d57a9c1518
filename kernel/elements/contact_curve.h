/* contact_curve.h - contacts with curves, of circles and of other curves (contact_pair.h): their gaps, and what happens at the
 * ends of open curves. */
#ifndef PM_CONTACT_CURVE_H
#define PM_CONTACT_CURVE_H

#include "elements/constraint.h"
#include "elements/curve_feet.h"
#include "state/workspace.h"

/* Members: the foot next to a node of the curve (curve_feet.h), 0 .. PM_CURVE_NODES; and, for circles of some radius, the
 * ends of an open curve. */
enum pm_contact_curve_member { PM_CURVE_FROM_END = PM_CURVE_NODES + 1, PM_CURVE_TO_END = PM_CURVE_NODES + 2 };

int pm_contact_curve_is(const pm_model *m, int contact);
int pm_contact_curve_any(const pm_model *m);
/* Contacts touch some curve, or one rolls on another: their places are looked for. */
int pm_contact_curve_looked_at(const pm_model *m);
/* Some foot is closed. */
int pm_contact_curve_is_closed(const pm_model *m, const pm_state *s, int contact);
/* case.c: looks at those curves: PM_OK, or PM_BAD_VALUE. */
int pm_contact_curve_begin(pm_workspace *w);
/* Gap to the nearest foot, or end, that no slot has closed, and the member; INFINITY: there is none.  Behind an open curve it is
 * as behind an edge (edge.h). */
double pm_contact_curve_gap(const pm_frame *frame, const pm_state *s, int contact, int *member);
/* What is nearest touches, or overlaps, from the free side. */
int pm_contact_curve_touches(const pm_frame *frame, const pm_state *s, int contact, int *member);
/* Behind an open curve, and what falls through zero while it is, as pm_edge_gap_from_below. */
int pm_contact_curve_is_below(const pm_frame *frame, const pm_state *s, int contact);
double pm_contact_curve_gap_from_below(const pm_frame *frame, const pm_state *s, int contact);
/* The normal constraint of a member, from that of the whole contact. */
void pm_contact_curve_constraint(const pm_frame *frame, int contact, int member, pm_constraint *normal);
/* Two members may be one foot that has gone on, or gone over the end. */
int pm_contact_curve_is_same(const pm_model *m, int contact, int a, int b);
/* The curve is open: what touches it comes to an end. */
int pm_contact_curve_ends(const pm_model *m, int contact);
/* It ends, or its pieces do. */
int pm_contact_curve_parts(const pm_model *m, int contact);
/* A closed slot is on a curve, and the end of its piece that is nearer is a knot, no end of the curve. */
int pm_contact_curve_is_at_knot(const pm_frame *frame, int slot, int member);
/* The normal constraint of a closed slot, whose foot is followed; 0: it is on no curve, or at an end of one. */
int pm_contact_curve_on(const pm_frame *frame, int slot, int member, pm_constraint *normal);
/* How far a circle that touches `member` in a slot is from leaving it, or its piece, m; the member that follows there, or
 * PM_NONE. */
double pm_contact_curve_room(const pm_frame *frame, int slot, int member);
int pm_contact_curve_next(const pm_frame *frame, int slot, int member);
/* Which way the tangent of a member's constraints goes: 1 along the curve, -1 against it. */
int pm_contact_curve_way(const pm_model *m, int contact, int member);
/* The member as the foot of a closed contact goes on. */
int pm_contact_curve_follow(const pm_frame *frame, int contact, int member, const pm_memory *memory);
/* What of a member is an outcome of a run: not next to which node a foot is, but at which end. */
int pm_contact_curve_outcome(const pm_model *m, int contact, int member);

#endif
