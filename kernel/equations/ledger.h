/* ledger.h - evidence from principles that the routes do not use: work and energy, impulse and momentum. */
#ifndef PM_LEDGER_H
#define PM_LEDGER_H

#include "state/workspace.h"

/* Rates of all running integrals at the DYNAMIC frame: work of forces, paths, work of sliding friction, and the
 * impulses that the outer world gives (x, y, moment about the origin), taken from points and directions of the forces
 * without the Jacobian. */
void pm_ledger_rates(pm_workspace *w, double *zdot);
/* Of these the first, which any route integrates: works, paths, what spins; accelerations are not needed. */
void pm_ledger_controlled_rates(pm_workspace *w, double *zdot);
/* Natural size of one of these. */
double pm_ledger_controlled_scale(const pm_frame *frame, int z);
/* Which of them is the work of sliding contacts, drives and the couple of a turning plane. */
int pm_ledger_power(const pm_model *m);
/* Where the impulses of the outer world begin among the running integrals. */
int pm_ledger_ledger(const pm_model *m);
/* No rate of the running integrals is anything but zero in the phase that begins: nothing acts. */
int pm_ledger_rests(const pm_workspace *w);
/* Opens the ledger at the start of the run (after the assembly). */
void pm_ledger_begin(pm_workspace *w);
/* The impulses of the outer world in z[nz] grow by the momenta of the frame beyond those before. */
void pm_ledger_follow(const pm_frame *frame, const double before[PM_LEDGER], double *z);
/* After an accepted step, at the KINEMATIC frame of w->state. */
void pm_ledger_step(pm_workspace *w);
/* A jump from velocities `before` to those of the frame, with w->rhs the impulses of the active constraints. */
void pm_ledger_jump(pm_workspace *w, const double *before);
/* The impulse along the constraint of a contact that is not among the active ones, in the same jump. */
void pm_ledger_contact(pm_workspace *w, const pm_constraint *along, double impulse, const double *before);
/* An impulse that the outer world applies. */
void pm_ledger_impulse(const pm_model *model, pm_state *state, const double at[2], const double force[2],
                       double couple);
/* Blows like the last one, `factor` times its impulses in all, at the mean of their places and velocities by impulse,
 * where the frame looks: they count as the last jump from now on. */
void pm_ledger_series(pm_workspace *w, double factor);
/* Closes the ledger: w->audit; PM_AUDIT if it does not close within its bound. */
int pm_ledger_close(pm_workspace *w);
/* Whether it closes at w->state within its bound; then what has been answered so far is sound. */
int pm_ledger_closes(pm_workspace *w);

#endif
