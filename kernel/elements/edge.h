/* edge.h - finite lines as partners of contacts: which part of one is next to a circle or a point. */
#ifndef PM_EDGE_H
#define PM_EDGE_H

#include "state/workspace.h"

/* Members of a contact with a segment: its face, and, for circles of some radius, the corners at its ends. */
enum pm_edge_member { PM_SEGMENT_FACE = 0, PM_SEGMENT_FROM = 1, PM_SEGMENT_TO = 2 };

/* A circle beside an edge at the frame: height of its centre over the line, how far it is beyond either end (negative
 * within), and the direction of the edge. */
typedef struct pm_edge_place {
    double height, radius;
    double from, to;
    double along[2];
} pm_edge_place;

int pm_edge_is(const pm_model *m, int contact);
pm_edge_place pm_edge_beside(const pm_frame *frame, int contact);
/* Some other edge that is there has one of its corners, and the same circle beside it. */
int pm_edge_meets_another(const pm_frame *frame, const pm_state *state, int contact);
/* Gap at the frame, and the member that is next.  Continuous where nothing overlaps; not below zero beyond the ends but for
 * circles that overlap a corner. */
double pm_edge_gap(const pm_frame *frame, int contact, int *member);
/* The rate of that gap, which may be another than the rate of the member that is next: beside an end, and on the back. */
double pm_edge_gap_rate(const pm_frame *frame, int contact);
/* The mark touches the face or, beyond it, a corner, or overlaps them: not from the back. */
int pm_edge_touches(const pm_frame *frame, int contact);
/* The mark is lower than where it would touch the face; what falls through zero while it is, where it touches a corner or
 * is no longer there. */
int pm_edge_is_below(const pm_frame *frame, int contact);
double pm_edge_gap_from_below(const pm_frame *frame, int contact);
/* The mark is a corner that goes over an end of the edge, and there is no gap left between them. */
int pm_edge_is_over_end(const pm_frame *frame, int contact);
/* What is watched then: it falls to zero where the corner has come so far in that it may touch the face, or where it goes over
 * the end no more. */
double pm_edge_gap_over_end(const pm_frame *frame, int contact);
/* What is next to an open contact is a corner that a closed one has, too: it is left to that one. */
int pm_edge_is_covered(const pm_frame *frame, const pm_state *s, int contact);
/* How far a mark that touches `member` is from leaving it for another, or for good; falls to 0 there, m. */
double pm_edge_room(const pm_frame *frame, const pm_state *state, int contact, int member);
/* The member that follows `member` where its room ends; PM_NONE: the contact ends, and the face of another
 * edge, the contact *heir, takes over (PM_NONE: none does). */
int pm_edge_next(const pm_frame *frame, const pm_state *state, int contact, int member, int *heir);
/* The end of a corner member, in the axes of the line's body. */
void pm_edge_corner(const pm_frame *frame, int contact, int member, double at[2]);

/* Which way the tangent of a member's constraints goes: 1 along the edge, -1 against it. */
int pm_edge_way(const pm_model *m, int contact, int member);
#endif
