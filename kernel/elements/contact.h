/* contact.h - potential contacts: their gaps, and the slots of closed ones. */
#ifndef PM_CONTACT_H
#define PM_CONTACT_H

#include "state/workspace.h"

/* Smallest gap over the members that are not closed, at the frame; *member tells which.  INFINITY if all are closed, left
 * to another contact, or the contact is not there. */
double pm_contact_gap(const pm_frame *frame, const pm_state *s, int contact, int *member);
/* The nearest open member touches, or overlaps. */
int pm_contact_touches(const pm_frame *frame, const pm_state *s, int contact, int *member);
/* The same, whether the contact is there or removed. */
double pm_contact_apart(const pm_frame *frame, const pm_state *s, int contact, int *member);
/* The nearest members that are not closed, at the frame, at most `most` (an even number) of a pattern: in pairs, one
 * on either side, as far as there are; returns how many. */
int pm_contact_near(const pm_frame *frame, const pm_state *s, int contact, int most, int *member);
/* Gap, and its rate, of one member at the frame. */
double pm_contact_member_gap(const pm_frame *frame, int contact, int member, double *rate);
/* Rate of slip of one member at the frame. */
double pm_contact_member_slip(const pm_frame *frame, int contact, int member);

static inline int pm_contact_slots(const pm_model *m, int contact)
{
    return m->contact_slot[contact + 1] - m->contact_slot[contact];
}
/* No member of it is closed. */
static inline int pm_contact_is_open(const pm_model *m, const pm_state *s, int contact)
{
    const int first = m->contact_slot[contact];
    for (int i = first; i < first + pm_contact_slots(m, contact); i++)
        if (s->slot[i].mode != PM_OPEN) return 0;
    return 1;
}
/* The contact that a slot belongs to. */
static inline int pm_contact_of_slot(const pm_model *m, int slot) { return m->contact_of_slot[slot]; }
/* It has one member, 0, that closes and opens as a whole: no pattern, edge or curve. */
static inline int pm_contact_is_single(const pm_model *m, int contact)
{
    const int kind = PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND];
    return kind != PM_CONTACT_PATTERN && kind != PM_CONTACT_SEGMENT && kind != PM_CONTACT_CURVE &&
           kind != PM_CONTACT_CURVES;
}
/* A circle and a line, or two circles. */
static inline int pm_contact_is_plain(const pm_model *m, int contact)
{
    const int kind = PM_CONTACT_ROW(m, contact)[PM_CONTACT_KIND];
    return kind == PM_CONTACT_LINE || kind == PM_CONTACT_CIRCLE;
}
static inline int pm_contact_plain_is_closed(const pm_model *m, const pm_state *s, int contact)
{
    return s->slot[m->contact_slot[contact]].mode != PM_OPEN;
}
/* A free slot, or PM_NONE. */
int pm_contact_free_slot(const pm_frame *frame, const pm_state *s, int contact);

double pm_contact_restitution(const pm_frame *frame, int contact);
/* Of the slip; 0 where none is given. */
double pm_contact_tangential(const pm_frame *frame, int contact);
/* Beside others; 0 where none is given. */
double pm_contact_stiffness(const pm_frame *frame, int contact);
int pm_contact_law(const pm_model *m, int contact); /* enum pm_law */
int pm_contact_friction(const pm_model *m, int contact);
int pm_contact_is_pattern(const pm_model *m, int contact);
int pm_contact_is_cord(const pm_model *m, int contact);
/* A cord over a rim that it may slip on.  Its coefficients are those of the cord: friction over mean tension. */
int pm_contact_has_rim(const pm_model *m, int contact);
/* A flank with friction: its slip is that of its teeth. */
static inline int pm_contact_rubs(const pm_model *m, int contact)
{
    return PM_CONTACT_ROW(m, contact)[PM_CONTACT_LEVER] != PM_NONE;
}
int pm_contact_has_flank(const pm_model *m, int contact);
/* Its gap counts from the start: a cord, a flank. */
int pm_contact_measures_itself(const pm_model *m, int contact);
double pm_contact_static(const pm_frame *frame, int contact);
double pm_contact_kinetic(const pm_frame *frame, int contact);
/* What slips has less friction than what sticks: only then a motion that slips a little less is another motion. */
int pm_contact_friction_jumps(const pm_frame *frame, int contact);

/* Gaps below this count as touching, m; normal and tangential speeds below this count as none, m/s. */
double pm_contact_length(const pm_frame *frame);
double pm_contact_speed(const pm_frame *frame);
/* How far beyond an end of an edge or a curve a mark that is at[2] counts as at that end, m: what rounding makes of it. */
double pm_contact_end(const pm_frame *frame, const double at[2]);
/* How far bodies are from the origin, at least the scene's size: what the rounding of positions goes by, m. */
double pm_contact_reach(const pm_workspace *w);

#endif
