/* contact_problem.h - which of several contacts push, stick and slide: one problem for blows and for accelerations.
 *
 *   a_n = b_n + W p >= 0,  N >= 0,  a_n N = 0                 each contact pushes, or parts
 *   |T| <= mu_s N where a_t = 0,  T = -mu_k N sgn(a_t) else   each sticks, or slides against its friction
 *
 * p = (N_0, T_0, N_1, ...) are impulses, and a the velocities after a blow (with e u_n before it added to the normal one,
 * Moreau); or p are forces and a accelerations.  W is the response of the contacts to p with all joints held: symmetric,
 * not negative.  A contact that slips already slides that way or parts; a rough one never slips; a smooth one has no T.
 *
 * Few contacts: all modes are tried, so that the motions are counted.  More: Lemke's method finds one solution; where it
 * ends on a ray sweeps over the contacts do.
 * [D. E. Stewart, SIAM Review 42 (2000) 3; C. Glocker and F. Pfeiffer, Multibody Dynamics with Unilateral Contacts, 1996] */
#ifndef PM_CONTACT_PROBLEM_H
#define PM_CONTACT_PROBLEM_H

#include "state/arena.h"

/* One contact as the problem is given. */
typedef struct pm_contact_problem_contact {
    int friction;     /* enum pm_friction; Coulomb with both coefficients 0 counts as smooth */
    double hold, rub; /* static and kinetic coefficients */
    int slips;        /* +1, -1: it slips that way already; 0: it may stick */
    int prefers;      /* enum pm_contact_mode that it takes in a tie; PM_NONE: closed, sticking */
    double bias[2];   /* b_n, b_t */
} pm_contact_problem_contact;

typedef struct pm_contact_problem {
    int n;             /* contacts */
    int counted;       /* up to so many all modes are tried */
    int tried;         /* up to so many where Lemke's method finds nothing, too */
    int tries, sweeps; /* beginnings of Lemke's method; sweeps over the contacts where all else fails */
    pm_contact_problem_contact *contact; /* [n] */
    double *response;                    /* [2n][2n] W */
    double doubt;                        /* of each b: rounding of what it was made of; 0: that of b itself */
    /* what was found */
    int *mode;    /* [n] enum pm_contact_mode */
    double *load; /* [2n] p */
    double *rate; /* [2n] a */
    int nmotion;  /* different motions: 0 none, 1, 2 several; not counted for many contacts: 1 */
    int differs;  /* a contact that moves otherwise in another motion, or PM_NONE */
    /* scratch, in units of the problem's own */
    double *scaled, *scale, *b, *p, *a, *best, *system, *right, *lemke;
    int *trial, *pivot, *basis;
    int equations;   /* of the trial */
    double rounded;  /* the doubt, in these units */
    double distance; /* of the equations of the trial from singular ones, at most 1 */
    double missed;   /* by how much its loads miss what the laws ask for */
} pm_contact_problem;

/* Memory for `most` contacts, which the arena owns; PM_NO_MEMORY. */
int pm_contact_problem_create(pm_contact_problem *x, pm_arena *arena, int most);
/* Solves the problem that contact[] and response[] pose; returns nmotion. */
int pm_contact_problem_solve(pm_contact_problem *x);

#endif
