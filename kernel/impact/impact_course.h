/* impact_course.h - one contact struck alone, with friction: the course of its blow. */
#ifndef PM_IMPACT_COURSE_H
#define PM_IMPACT_COURSE_H

#include "state/workspace.h"

/* Response of the contact with all joints held, du = [a b; b c] dP (normal, tangent); velocities before, relative to
 * what drives prescribe; its law. */
typedef struct pm_impact_course {
    double a, b, c;
    double normal, slip;          /* m/s, normal < 0; or 0, where it draws */
    double mu_static, mu_kinetic; /* static and kinetic coefficients; infinite: rough */
    double restitution;
    double no_slip; /* m/s: slower than this is no slip */
    int law;        /* enum pm_law */
} pm_impact_course;

typedef struct pm_impact_course_end {
    double normal, slip;   /* m/s, after the blow */
    double impulse, ratio; /* normal impulse; tangential impulse over it */
} pm_impact_course_end;

/* 1 if its friction draws the pair together while it slips: with no velocity of approach it is a blow nevertheless, an impact
 * without collision. */
int pm_impact_course_draws(const pm_impact_course *x);
/* Follows the blow to its end; 0 if the law has none: friction holds the pair so that it cannot part. */
int pm_impact_course_follow(const pm_impact_course *x, pm_impact_course_end *end);
/* Reads all of it but the restitution, of the contact in `slot` at the frame; the active constraints are those of the
 * joints alone, evaluated.  response[nq] is scratch. */
int pm_impact_course_read(pm_workspace *w, int slot, double *response, pm_impact_course *x);
/* 1 if the blow of the contact in `slot` is to be followed: its law differs from Newton's, or its slip may change. */
int pm_impact_course_applies(const pm_model *model, int slot);

#endif
