/* segment.h - finite lines as partners of contacts: which part of one is next to a circle or a point. */
#ifndef PM_SEGMENT_H
#define PM_SEGMENT_H

#include "model.h"

/* Members of a contact with a segment: its face, and, for circles of some radius, the corners at its ends. */
enum pm_segment_member { PM_SEGMENT_FACE = 0, PM_SEGMENT_FROM = 1, PM_SEGMENT_TO = 2 };

int pm_segment_is(const pm_model *m, int contact);
/* Gap at the frame, and the member that is next.  Continuous where nothing overlaps; not below zero beyond the ends but for
 * circles that overlap a corner. */
double pm_segment_gap(const pm_workspace *w, int contact, int *member);
/* The mark is on the back of the segment: it does not touch. */
int pm_segment_behind(const pm_workspace *w, int contact);
/* How far a mark that touches `member` is from leaving it for another, or for good; falls to 0 there, m. */
double pm_segment_room(const pm_workspace *w, int contact, int member);
/* The member that follows `member` where its room ends; PM_NONE: the contact ends. */
int pm_segment_next(const pm_workspace *w, int contact, int member);
/* The end of a corner member, in the axes of the line's body. */
void pm_segment_corner(const pm_workspace *w, int contact, int member, double at[2]);

/* Which way the tangent of a member's rows goes: 1 along the edge, -1 against it. */
int pm_segment_way(const pm_model *m, int contact, int member);
/* Some contact has a segment. */
int pm_segment_any(const pm_model *m);

#endif
