/* contact_system.h - the problem of contact_problem.h that a state poses: response and rates of the contacts that may push,
 * with all joints and captured pairs held. */
#ifndef PM_CONTACT_SYSTEM_H
#define PM_CONTACT_SYSTEM_H

#include "elements/constraint.h"
#include "impact/contact_problem.h"
#include "state/workspace.h"

typedef struct pm_contact_system {
    pm_contact_problem problem;
    int *slot;                       /* [problem.n] whose contacts they are */
    pm_constraint *normal, *tangent; /* [problem.n] evaluated at the frame */
    double *free;                    /* [nq] velocities, or accelerations, where no contact acts */
    double *force, *response;        /* [nq] scratch */
} pm_contact_system;

int pm_contact_system_create(pm_contact_system *x, pm_arena *arena, const pm_model *m);
/* The contacts' constraints and the response W to unit impulses, or forces, of the listed slots, which are open in w->state;
 * the active set is that of what else holds, factored. */
int pm_contact_system_respond(pm_workspace *w, pm_contact_system *x);
/* x->response: what a unit load along an evaluated constraint does; the reactions to it are in w->saddle.rhs. */
void pm_contact_system_respond_along(pm_workspace *w, pm_contact_system *x, const pm_constraint *along);
/* Rounding in the response [size][size], whose first rows are the contacts', becomes zero along directions that others hold:
 * driven ends, pins, what is captured. */
void pm_contact_system_still_held(const pm_frame *frame, const pm_contact_system *x, double *response,
                                  int size);
/* Friction of the listed slots, as the case has it; no slip, no preference. */
void pm_contact_system_friction(const pm_frame *frame, pm_contact_system *x);

#endif
