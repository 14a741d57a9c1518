/* rk.h - what the files of the rk route share.
 *
 *   route_rk.c       the route: begin, step control
 *   rk_error.c       which error of a step is allowed, and how much of it a step has
 *   rk_derivative.c  y'
 *   rk_formula.c     stages and end of a step, its error, y inside it
 *   rk_time.c        how far a step is off by what time does to forces and drives
 *   rk_stiff.c       whether stability makes the steps short
 *   rk_state.c       y as a state; states inside the last step: at, exact, look
 *
 * y = (coordinates, their rates, z), in z the ledger last.  Numbers of stages are those of dop853.h. */
#ifndef PM_RK_H
#define PM_RK_H

#include "equations/energy_level.h"
#include "events/ask.h"
#include "events/event.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

#define PM_RK_DENSE 7 /* coefficients of the dense output */

/* A program of the time that acts on the motion. */
typedef struct pm_rk_timed {
    int program, derivative; /* that derivative of it by the time acts on velocities */
    double gain;             /* what a unit of that makes of a velocity in a unit of time */
} pm_rk_timed;

struct pm_rk {
    int n;              /* coordinates of the phase */
    int all;            /* 2 n + nz */
    int controlled;     /* 2 n + nz_controlled: what stages need */
    double *now;        /* [all] at w->state */
    double *y0, *y;     /* [all] begin of the step; stage */
    double *k;          /* [ALL_STAGES][all] */
    double *side;       /* [STAGES][all] stages of pm_rk_exact, so that the dense output stays */
    double *dense;      /* [PM_RK_DENSE][controlled] */
    double *middle;     /* [all] between the halves of a step */
    double *scale;      /* [controlled] reciprocal error weights */
    double tolerance;   /* in these: relative */
    pm_rk_timed *timed; /* [ntimed] */
    int ntimed;
    double own;           /* the motion's own time at the end of the last step */
    double rotation_time; /* that of the bodies' turning alone */
    double meeting;       /* that of open contacts (gap_passage.c) */
    double t0, h;         /* the last step as integrated */
    double end;           /* where it ended */
    double next;          /* step to try next, 0: none known */
    /* where the first steps of the main run began and ended, and where exact states were wanted in between */
    double ended[PM_RK_NOTED];
    int nended;
    int dense_ready, k0_ready;
    pm_energy_level_level level; /* of the energy, where it is kept */
    int ledger, next_ledger;     /* the last step integrates the ledger; the next one does */
    int64_t first;               /* number of the phase's first step */
    int suspect, clear;          /* looks in a row, or nearly, that found it stiff; since the last of them */
    int swift;                   /* accelerations need no frame: tree_small.c */
    double momentum[PM_LEDGER], momentum_now[PM_LEDGER]; /* at its begin; at w->state */
};

/* rk_derivative.c: k = y' at (t, y); the rates of the ledger only if asked for. */
int pm_rk_derivative(pm_workspace *w, double t, double *y, int with_ledger, double *k);
/* The same where the frame looks at y. */
int pm_rk_derivative_here(pm_workspace *w, const double *y, int with_ledger, double *k);
/* Where the last stages were, or nearly: which coordinates are independent, and whether tree_small.c
 * applies.  1: partitioned anew. */
int pm_rk_choose_coordinates(pm_workspace *w);

/* rk_formula.c: stages 1..11 of a step h from r->t0, r->y0 with stage 0 in k; the end of the step in y. */
int pm_rk_stages(pm_workspace *w, double h, double *k, double *y);
/* The error of the step in r->k over the allowed one, less what rounding makes of it (over the allowed one, too). */
double pm_rk_error(const struct pm_rk *r, double h, double rounding);
/* r->y at t inside the last step; the ledger is not asked for there and stays as at its begin. */
int pm_rk_dense(pm_workspace *w, double t);

/* Y of the last stage, which is at the end of the step as y is. */
void pm_rk_last_stage(const struct pm_rk *r, double *y);

/* Whether steps are sampled for events or extremes. */
static inline int pm_rk_is_sampled(const pm_workspace *w)
{
    return w->event->nfunction > 0 || w->ask->nobserver > 0;
}

/* rk_error.c: the scale of errors, by the size and the speed of the scene as they are now. */
void pm_rk_set_scale(pm_workspace *w);
/* The error of the step h in r->k, from r->y0 to r->y, over the allowed one; not a number where it has no value. */
double pm_rk_step_error(pm_workspace *w, double h);

/* rk_time.c: a phase begins; the error of the step h from r->t0 over the allowed one. */
void pm_rk_time_begin(pm_workspace *w);
double pm_rk_time_error(const pm_workspace *w, double h);
/* What rounding of the time makes of a velocity in that step, over the allowed error. */
double pm_rk_time_rounding(const pm_workspace *w, double h);

/* rk_stiff.c: after a step, its derivative at the end in k. */
void pm_rk_look_for_stiffness(pm_workspace *w);

/* rk_state.c: y back on the constraints and on the energy level, and the state there; *gained: the energy that comes with
 * it. */
int pm_rk_settle(pm_workspace *w, double t, double *y, pm_state *s, double *gained);

/* rk_state.c, of the last step: see route.h. */
int pm_rk_at(pm_workspace *w, double t, pm_state *s);
int pm_rk_exact(pm_workspace *w, double t, pm_state *s);
int pm_rk_look(pm_workspace *w, double t, int level);

#endif
