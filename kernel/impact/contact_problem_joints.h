/* contact_problem_joints.h - the problem of contact_problem.h beside joints that rub by their load.
 *
 *   F = -c |R| sgn(s) where a joint slips,   |F| <= c |R| where s = 0,   R = R_0 + L (p, F)
 *
 * s = s_0 + W (p, F) is the slip of a joint, F its friction along it and R its reaction: one component of a slider or slot, two
 * of a bearing; p are the loads of the contacts.  A slider is pressed from either side.  In a given mode F is linear in p, with
 * the reaction taken along the direction that it has: what is left are contacts whose response is another one, no longer
 * symmetric.  Each mode of the joints poses such a problem, and holds if its slips and reactions are those it was posed for. */
#ifndef PM_CONTACT_PROBLEM_JOINTS_H
#define PM_CONTACT_PROBLEM_JOINTS_H

#include "impact/contact_problem.h"
#include "state/arena.h"

typedef struct pm_contact_problem_joint {
    double coefficient; /* c: a number, or m */
    int nload;          /* components of the reaction: 1 or 2 */
    int slips;          /* +1, -1: it slips that way already; 0: it may hold */
    double bias;        /* s_0 */
    double start[2];    /* R_0 */
    /* found */
    int mode;        /* enum pm_contact_mode: PM_STICK, or how it slides; PM_OPEN: without friction */
    double along[2]; /* direction of R, of a slider 1 or -1 */
    double friction, rate;
} pm_contact_problem_joint;

typedef struct pm_contact_problem_joints {
    pm_contact_problem *contacts; /* their number, friction and slip; response and bias are found here */
    int m;
    pm_contact_problem_joint *joint; /* [m] */
    double *bias;                    /* [2n] of the contacts */
    double *response;                /* [2n + m][2n + m] W: contacts, then slips of joints */
    double *reaction;                /* [2m][2n + m] L */
    /* found, and scratch */
    int differs;                    /* a contact that tells several motions apart */
    double *load, *rate, *given;    /* [2n], [2n], [m][2n + 1]: friction as p gives it */
    int *mode, *pivot;              /* [n], [m] */
    pm_contact_problem_joint *kept; /* [m] */
    double *system, *right;         /* [m][m], [m] */
} pm_contact_problem_joints;

/* Memory for `most` contacts and `joints` joints, which the arena owns; PM_NO_MEMORY. */
int pm_contact_problem_joints_create(pm_contact_problem_joints *x, pm_arena *arena,
                                     pm_contact_problem *contacts, int most, int joints);
/* Solves it: how many motions there are, 2 for several; the loads of the contacts and their modes are in x->contacts. */
int pm_contact_problem_joints_solve(pm_contact_problem_joints *x);

#endif
