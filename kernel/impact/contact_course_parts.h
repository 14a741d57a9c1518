/* contact_course_parts.h - one stretch of the course of a blow, as the files share it that follow it. */
#ifndef PM_CONTACT_COURSE_PARTS_H
#define PM_CONTACT_COURSE_PARTS_H

#include "impact/contact_course.h"

/* Directions: those of the contacts, and the slips of the joints. */
static inline int pm_contact_course_size(const pm_contact_course *x) { return 2 * x->n + x->m; }

/* Responses and slips of the contacts in x->of[], which x->stretch lists, and of all joints. */
void pm_contact_course_pose(pm_contact_course *x);
/* Solves what is posed: how many motions there are; x->differs. */
int pm_contact_course_solve(pm_contact_course *x);
/* Impulses and rates of the present stretch, in compression or in restitution; how many motions there are. */
int pm_contact_course_find_rates(pm_contact_course *x, int compresses);

#endif
