/* contact_springs_parts.h - a blow that stiffnesses share, as the files share it that follow it. */
#ifndef PM_CONTACT_SPRINGS_PARTS_H
#define PM_CONTACT_SPRINGS_PARTS_H

#include "impact/contact_springs.h"

enum pm_contact_spring_phase { PM_CONTACT_SPRING_OPEN, PM_CONTACT_SPRING_LOADS, PM_CONTACT_SPRING_RELEASES };

/* k beside the greatest. */
double pm_contact_springs_stiffness(const pm_contact_springs *x, int i);
/* N and its rate dN/dt at y, by how much x and P have grown since the step began. */
double pm_contact_springs_force(const pm_contact_springs *x, int i, const double *y);
double pm_contact_springs_rate_of_force(const pm_contact_springs *x, int i, const double *y);

/* 1 if a contact is loaded and holds its slip by friction. */
int pm_contact_springs_holds(const pm_contact_springs *x, int i);
/* Which contacts slip from here on, by the loads just after; x->ratio, x->course. */
void pm_contact_springs_settle(pm_contact_springs *x);
/* What is left of the friction that holds: hold N - |T| on one side (+1, -1), and its slope. */
double pm_contact_springs_room(const pm_contact_springs *x, int i, int side, const double *y);
double pm_contact_springs_slope_of_room(const pm_contact_springs *x, int i, int side, const double *y);

/* Frictions that the motion does not tell apart are shared by what each contact could give, else the order of contacts in the
 * file would do it. */
void pm_contact_springs_share_friction(pm_contact_springs *x);

/* 1 if friction has wedged the bodies: the blow is over, and its impulses and velocities are found. */
int pm_contact_springs_end_wedged(pm_contact_springs *x);

#endif
