/* saddle.h - the one linear system of the kernel, [M H^T; G 0], on the active constraints.
 *
 * Whoever fills saddle.rhs or saddle.wanted calls what works on it next: neither outlives that.  Statuses: PM_OK, or
 * PM_SINGULAR with the constraint or body that the system does not determine. */
#ifndef PM_SADDLE_H
#define PM_SADDLE_H

#include "elements/constraint.h"
#include "state/workspace.h"

/* Where a constraint takes hold. */
typedef struct pm_hold {
    int body[PM_CONSTRAINT_BODIES], over;
    double j[PM_CONSTRAINT_COORDINATES];
} pm_hold;

/* How the reaction of a constraint acts: H, which is G where no contact slides. */
static inline const double *pm_saddle_direction(const pm_saddle *s, const pm_constraint *c)
{
    return s->active->asymmetric ? c->h : c->j;
}

/* Evaluates the active constraints at the frame, and the tangents that sliding contacts carry. */
void pm_saddle_evaluate(pm_active_set *active, const pm_frame *frame);
/* Factors S = G M^-1 H^T of the evaluated constraints; counts as a solve. */
int pm_saddle_factor(pm_workspace *w);
/* The factors are of other masses from now on. */
void pm_saddle_forget(pm_saddle *s);
/* Whether S holds the factors of the active constraints as they are evaluated now, with H = G. */
int pm_saddle_is_factored(const pm_saddle *s);
/* How far the evaluated constraints are from depending on each other: the least part of a row of G that those before it do
 * not span, relative to it (its square is known to rounding). */
double pm_saddle_independence(pm_saddle *s);
/* The same by the masses alone, which for light bodies may say less; S is factored then, if it is more than 0. */
double pm_saddle_independence_by_mass(pm_saddle *s);
/* The same at a state, where the frame then looks. */
double pm_saddle_independence_there(pm_workspace *w, const pm_state *s);
/* S x = rhs in place. */
void pm_saddle_solve(pm_saddle *s);
/* x[nq] += M^-1 H^T l (use_h) or M^-1 G^T l, with l = rhs. */
void pm_saddle_spread(const pm_saddle *s, int use_h, double *x);
/* S l = rhs in place, and x[nq] += M^-1 G^T l; H = G where the constraints are factored. */
void pm_saddle_move(pm_saddle *s, double *x);
/* The constraints are factored: x[nq] with M x = force + H^T l (force[nq] or NULL: none), G x = wanted; l is in rhs. */
int pm_saddle_respond(pm_workspace *w, const double *force, double *x);
/* The same with the inertia of what stands in for bodies without mass: near enough to tell which contacts push. */
void pm_saddle_respond_roughly(pm_workspace *w, const double *force, double *x);
/* Corrects the response x, and with it its impulses, by what is left of the equations: rounding counts by the square of how much
 * smaller a moment of inertia is than that of the mass at the places where a body is held. */
void pm_saddle_correct(pm_workspace *w, double *x);
/* Accelerations and reactions at the frame, which is DYNAMIC then. */
int pm_saddle_accelerate(pm_workspace *w);
/* The same right after pm_projection_apply, which may have evaluated the constraints. */
int pm_saddle_accelerate_projected(pm_workspace *w);

#endif
