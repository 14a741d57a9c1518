/* contact_springs.h - a blow of several contacts that have stiffnesses: how they share it (Liu, Zhao, Brogliato).
 *
 *   dP_i : dP_k = N_i : N_k,   N = k x^n,   E = k x^(n+1) / (n+1)       each contact pushes by the energy E that it holds
 *   du = W dP,   dE = -u dP where it is compressed (u < 0),   dE = -(u / e^2) dP where it is released
 *
 *   dT_i = -mu sgn(s) dP_i where a contact slips with s; where it does not ds = 0, |dT_i| <= mu_s dP_i     (Coulomb)
 *
 * u are normal velocities, W the response of all velocities with all else held, T impulses along the contacts.  With e = 0
 * what is stored is lost where compression ends.  The blow is over when no contact holds energy and none approaches.  Only the ratios of the k count: other units of k change
 * the pace and nothing else.  One contact alone ends with the normal work -e^2 times that of its compression (Stronge).
 *
 * Followed in a time of its own the law is that of springs that are released faster than compressed,
 *   dP/dt = N,   dx/dt = -u, or -u / e^2,
 * which are smooth from the beginning: nothing has to be assumed of the ratios while all E are zero.  While no contact begins
 * or ends to slip the T go with the N by fixed ratios, dT = B dP (contact_springs_friction.c): friction changes the response
 * of normal velocities and nothing else.  N being known, friction always has a solution: no impact jams.  Bodies that friction
 * wedges between contacts end at rest there, and what these hold is lost (contact_springs_wedged.c).
 * [C. Liu, Z. Zhao, B. Brogliato, Proc. R. Soc. A 464 (2008) 3193 and 465 (2009) 1] */
#ifndef PM_CONTACT_SPRINGS_H
#define PM_CONTACT_SPRINGS_H

#include "state/arena.h"

typedef struct pm_contact_spring {
    double stiffness, restitution;
    double hold, rub;  /* static and kinetic coefficients; INFINITY: it never slips */
    double before;     /* normal velocity before the blow; found: after it */
    double slip;       /* likewise along the contact; 0: none */
    double impulse[2]; /* found, normal and along */
    /* while it is followed, in units of the blow */
    double start;   /* velocity where a step begins */
    double largest; /* x so far, or with which it would hold an energy of the blow */
    int phase;      /* enum pm_contact_spring_phase */
    int sense; /* the way it slips, +1 or -1, perhaps without speed yet; 0: it is held, or has no friction */
} pm_contact_spring;

typedef struct pm_contact_springs {
    int n;
    double exponent;           /* n of N = k x^n, >= 1 */
    double no_velocity;        /* of the greatest: rounding */
    double tolerance;          /* likewise: error of a step */
    pm_contact_spring *spring; /* [n] */
    double *response;          /* [2n][2n] W */
    /* scratch */
    double *now;           /* [n] x where a step begins */
    double *zero;          /* [2n] none: what x and P have grown there */
    double *next;          /* [2n] by how much x and P grow in the step */
    double *table;         /* the scheme of extrapolation */
    double *begun;         /* [2n] velocities before the blow */
    double *ratio;         /* [n][n] B */
    double *course;        /* [2n][n] how velocities go with P, friction with it */
    double *system, *load; /* [2n][2n], [n] */
    int *held, *pivot;     /* [2n] */
    double stiffest;
    int swings; /* contacts that were compressed again, or released, since one last began or ended to slip or to push */
    int event, kind; /* what is looked for inside a step: of which contact, which of its functions */
} pm_contact_springs;

/* Memory for `most` contacts, which the arena owns; PM_NO_MEMORY. */
int pm_contact_springs_create(pm_contact_springs *x, pm_arena *arena, int most);
/* Follows the blow to its end.  1: done; 0: it does not end within PM_SPRINGS_STEPS. */
int pm_contact_springs_follow(pm_contact_springs *x);

#endif
