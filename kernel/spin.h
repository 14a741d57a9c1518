/* spin.h - the plane of the scene turns freely about an axis that lies in it. */
#ifndef PM_SPIN_H
#define PM_SPIN_H

#include "model.h"

/* model.c: the table; what it needs among the running integrals. */
int pm_spin_validate(const pm_model *m, pm_where *where);
void pm_spin_lay_out(pm_model *m);
/* case.c: the axis and the numbers of a case; start.c: the momentum of the start, where the frame looks. */
int pm_spin_case(pm_workspace *w);
int pm_spin_start(pm_workspace *w);

static inline int pm_spin_turns(const pm_model *m) { return m->rows[PM_TABLE_SPIN] > 0; }

/* All of these at the frame; 0 where the plane does not turn. */
double pm_spin_inertia(const pm_workspace *w);  /* about the axis, of all that turns along */
double pm_spin_momentum(const pm_workspace *w); /* about the axis */
double pm_spin_omega(const pm_workspace *w);
double pm_spin_angle(const pm_workspace *w);
/* Kinetic energy of the turning of body i, or of all with PM_NONE. */
double pm_spin_kinetic(const pm_workspace *w, int i);
/* Adds the centrifugal forces and couples to frame.f. */
void pm_spin_forces(pm_workspace *w);
/* Their size if they were along the motion t, at any place of the scene. */
double pm_spin_force_size(const pm_workspace *w, const double *t);
/* Resultant of the centrifugal forces, and their moment about the origin. */
void pm_spin_outer(const pm_workspace *w, double outer[PM_LEDGER]);
/* Rates of the running integrals that are the plane's; power of the couple. */
void pm_spin_rates(pm_workspace *w, double *zdot);
double pm_spin_power(pm_workspace *w);
/* Natural size of such an integral; 0: it is not one of them. */
double pm_spin_scale(const pm_workspace *w, int z);

#endif
