/* audit.h - evidence from principles that the routes do not use: work and energy, impulse and momentum. */
#ifndef PM_AUDIT_H
#define PM_AUDIT_H

#include "model.h"

/* Rates of all running integrals at the DYNAMIC frame: work of forces, paths, work of sliding friction, and the
 * impulses that the outer world gives (x, y, moment about the origin), taken from points and directions of the forces
 * without the Jacobian. */
void pm_audit_rates(pm_workspace *w, double *zdot);
/* Of these the first, which any route integrates: works, paths, what spins; accelerations are not needed. */
void pm_audit_controlled_rates(pm_workspace *w, double *zdot);
/* Natural size of one of these. */
double pm_audit_controlled_scale(const pm_workspace *w, int z);
/* Where the impulses of the outer world begin among the running integrals. */
int pm_audit_ledger(const pm_model *m);
/* Opens the ledger at the start of the run (after the assembly). */
void pm_audit_begin(pm_workspace *w);
/* After an accepted step, at the KINEMATIC frame of w->state. */
void pm_audit_step(pm_workspace *w);
/* A jump from velocities `before` to those of the frame, with w->rhs the impulses of the active rows. */
void pm_audit_jump(pm_workspace *w, const double *before);
/* An impulse that the outer world applies. */
void pm_audit_impulse(pm_workspace *w, const double at[2], const double force[2], double couple);
/* Blows like the last one, `factor` times its impulses in all, at the mean of their places and velocities by impulse,
 * where the frame looks: they count as the last jump from now on. */
void pm_audit_series(pm_workspace *w, double factor);
/* Closes the ledger: w->audit; PM_AUDIT if it does not close within its bound. */
int pm_audit_close(pm_workspace *w);
/* What is answered so far is sound if the ledger closes at w->state. */
void pm_audit_seal(pm_workspace *w);

#endif
