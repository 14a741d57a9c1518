/* contact_pair.h - contacts of two curves: their gaps, and the corners of an edge; what contact_curve.h asks of them. */
#ifndef PM_CONTACT_PAIR_H
#define PM_CONTACT_PAIR_H

#include "elements/constraint.h"

int pm_contact_pair_is(const pm_model *m, int contact);
/* The first of the curves. */
int pm_contact_pair_first(const pm_model *m, int contact);
/* As pm_contact_curve_gap, pm_contact_curve_touches, pm_contact_curve_constraint. */
double pm_contact_pair_gap(const pm_frame *frame, const pm_state *s, int contact, int *member);
int pm_contact_pair_touches(const pm_frame *frame, const pm_state *s, int contact, int *member);
void pm_contact_pair_constraint(const pm_frame *frame, int contact, int member, pm_constraint *normal);
/* Two members may be one place that has gone on, or over a corner. */
int pm_contact_pair_is_same(const pm_model *m, int contact, int a, int b);
/* Which corner touches; PM_PAIR_WITHIN: none. */
int pm_contact_pair_corner(int member);
/* How far the places of a closed contact are from where its member ends, m; then the member that follows, or PM_NONE. */
double pm_contact_pair_room(const pm_frame *frame, const pm_constraint *normal, int contact, int member);
int pm_contact_pair_next(const pm_frame *frame, const pm_constraint *normal, int contact, int member);
/* The curve of the foot ends sooner, or its piece does. */
int pm_contact_pair_is_at_foot(const pm_frame *frame, const pm_constraint *normal, int contact, int member);
/* The member as its places go on. */
int pm_contact_pair_follow(const pm_frame *frame, int contact, int member, const pm_memory *memory);

#endif
