/* contact_pattern.h - contacts of a circle with the members of a pattern of points. */
#ifndef PM_CONTACT_PATTERN_H
#define PM_CONTACT_PATTERN_H

#include "state/workspace.h"

/* A circle beside a pattern: its centre from the pattern's first member, and the pattern's step, in the scene. */
typedef struct pm_beside {
    double d[2], step[2], radius;
} pm_beside;

/* The open members next to a place beside a pattern; n -1: not known yet.  They are the same at all places between the same two
 * members, as long as none closes or opens. */
typedef struct pm_near {
    int n, below, member[2];
} pm_near;

/* That of a contact with a pattern, at the frame. */
pm_beside pm_contact_pattern_beside(const pm_frame *frame, int contact);
/* From there the gap to a member, and the smallest one as pm_contact_gap has it. */
double pm_contact_pattern_gap_beside(const pm_beside *x, int member);
double pm_contact_pattern_nearest(const pm_frame *frame, const pm_state *s, int contact, const pm_beside *x,
                                  int *member);
/* The same; `near` is of a place before, or not known, and is kept. */
double pm_contact_pattern_nearest_of(const pm_frame *frame, const pm_state *s, int contact,
                                     const pm_beside *x, pm_near *near, int *member);
/* At the frame, as pm_contact_near and pm_contact_gap have it. */
int pm_contact_pattern_near(const pm_frame *frame, const pm_state *s, int contact, int most, int *member);
double pm_contact_pattern_gap(const pm_frame *frame, const pm_state *s, int contact, int *member);
/* Gap to a member, closed or not; with its rate, or NULL. */
double pm_contact_pattern_gap_to(const pm_frame *frame, int contact, int member);
double pm_contact_pattern_member_gap(const pm_frame *frame, int contact, int member, double *rate);
/* Members of a pattern without end are numbered by int32: PM_BAD_VALUE where the circle of a contact is, at the frame,
 * beyond those that have a number (a contact, its place in steps of the pattern, the bound). */
int pm_contact_pattern_check(pm_workspace *w);

#endif
