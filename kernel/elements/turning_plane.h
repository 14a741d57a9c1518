/* turning_plane.h - the plane of the scene turns freely about an axis that lies in it. */
#ifndef PM_TURNING_PLANE_H
#define PM_TURNING_PLANE_H

#include "elements/slope.h"
#include "state/workspace.h"

/* What it needs among the running integrals. */
void pm_turning_plane_lay_out(pm_model *m);
/* case.c: the axis and the numbers of a case; start.c: the momentum of the start, where the frame looks. */
int pm_turning_plane_case(pm_workspace *w);
int pm_turning_plane_start(pm_workspace *w);

static inline int pm_turning_plane_turns(const pm_model *m) { return m->rows[PM_TABLE_SPIN] > 0; }

/* The program of the couple about the axis; PM_NONE: there is none. */
int pm_turning_plane_program(const pm_model *m);

/* All of these at the frame; 0 where the plane does not turn. */
double pm_turning_plane_inertia(const pm_frame *frame);  /* about the axis, of all that turns along */
double pm_turning_plane_momentum(const pm_frame *frame); /* about the axis */
double pm_turning_plane_omega(const pm_frame *frame);
double pm_turning_plane_angle(const pm_frame *frame);
/* Kinetic energy of the turning of body i, or of all with PM_NONE. */
double pm_turning_plane_kinetic(const pm_frame *frame, int i);
/* Adds the centrifugal forces and couples to frame.f. */
void pm_turning_plane_forces(pm_frame *frame);
/* Their derivatives by positions, added to slope[nq][nq]: J'' Omega^2 / 2 - Omega^2 J' J' / J, H as it is. */
void pm_turning_plane_add_forces(const pm_frame *frame, double *slope);
/* Derivatives by positions: of J (of body i, or of all with PM_NONE), of Omega, of the kinetic energy of the turning. */
void pm_turning_plane_add_inertia(const pm_frame *frame, pm_slope *to, int i, double weight);
void pm_turning_plane_add_omega(const pm_frame *frame, pm_slope *to, double weight);
void pm_turning_plane_add_kinetic(const pm_frame *frame, pm_slope *to, int i, double weight);
/* Their size if they were along the motion t, at any place of the scene. */
double pm_turning_plane_force_size(const pm_frame *frame, const double *t);
/* Resultant of the centrifugal forces, and their moment about the origin. */
void pm_turning_plane_outer(const pm_frame *frame, double outer[PM_LEDGER]);
/* Rates of the running integrals that are the plane's; power of the couple. */
void pm_turning_plane_rates(pm_workspace *w, double *zdot);
double pm_turning_plane_power(pm_workspace *w);
/* Natural size of such an integral; 0: it is not one of them. */
double pm_turning_plane_scale(const pm_frame *frame, int z);

#endif
