/* contact_course.h - the course of a blow at several contacts: which impulses follow from their laws of restitution.
 *
 *   du_n = W p ds at one pace:   in compression  du_n/ds >= -u_n,  in restitution  du_n/ds >= e |u_n before|
 *                                p_n >= 0, and one of the two is equal;  0 in place of the pace where u_n = 0 is held
 *   |p_t| <= mu_s p_n where the contact does not slip,  p_t = -mu_k p_n sgn(u_t) where it does        (Coulomb, Routh)
 *
 * u are the velocities at the contacts, W their response with all else held, s a parameter that has no other meaning.  A
 * contact that parts is out until it meets again.  Restitution ends at each contact by its own law:
 *
 *   newton   u_n = -e u_n before      poisson   P_n = (1 + e) P_n of compression      stronge   work = -e^2 of compression
 *
 * Joints that rub by their load (contact_problem_joints.h) slip and hold likewise.
 *
 * While no slip ends and nothing meets again all velocities are linear in s: the course goes from one such event to the next,
 * exactly.  One contact alone is followed like this by impact_course.c.  Where all contacts have stiffnesses, these and no
 * pace tell how they share (contact_springs.h).
 * [E. J. Routh, Dynamics of a System of Rigid Bodies, Elementary Part, ch. IV; W. J. Stronge, Impact Mechanics, 2nd ed.] */
#ifndef PM_CONTACT_COURSE_H
#define PM_CONTACT_COURSE_H

#include "impact/contact_problem.h"
#include "impact/contact_problem_joints.h"
#include "impact/contact_springs.h"
#include "state/arena.h"

typedef struct pm_contact_course_contact {
    pm_contact_problem_contact friction; /* its bias is read where all is found at once */
    int law;                             /* enum pm_law */
    double restitution;
    double stiffness; /* beside the others; read where all have one (exponent > 0) */
    int is_spent;     /* its bounce is over: a velocity with which it parts is taken away first */
    /* while it is followed */
    double before;   /* m/s, normal, where compression begins */
    double load;     /* N s, normal, of the phase so far; */
    double work;     /* J, likewise */
    double left[2];  /* N s and J that restitution may give, as compression left them */
    int rebounds;    /* its restitution is not over */
    double pace;     /* m/s, of the present stretch */
    double share[2]; /* p_n, p_t of it */
    double rate[2];  /* du_n, du_t of it */
} pm_contact_course_contact;

typedef struct pm_contact_course_joint {
    double coefficient, no_slip; /* of friction; rad/s or m/s */
    int nload;                   /* components of the reaction */
    double start[2];    /* reaction without contacts, where all is found at once; in a course it has none */
    double share, rate; /* friction and change of the slip of the present stretch */
} pm_contact_course_joint;

typedef struct pm_contact_course {
    int n, m;
    pm_contact_course_contact *contact; /* [n] */
    pm_contact_course_joint *joint;     /* [m] that rub by their load; none where there are stiffnesses */
    double *response;                   /* [2n + m][2n + m] W: contacts, then slips of joints */
    double *reaction;                   /* [2m][2n + m] of the joints */
    double *velocity;                   /* [2n + m] before; what was found: after */
    double no_slip;                     /* m/s: slower than this, or than rounding of the blow, is no slip */
    double exponent; /* of all contacts with stiffnesses (contact_springs.h); 0: all go at one pace */
    /* what was found */
    double *impulse; /* [2n + m] */
    int limited;     /* it would have gained energy: mixed with the blow without restitution */
    int differs;     /* a contact that tells several motions apart */
    /* scratch */
    pm_contact_problem stretch;       /* of the contacts of[] */
    pm_contact_problem_joints joints; /* the same with joints */
    pm_contact_springs springs;
    int *of, *pivot;
    double *start, *plastic, *system;
    double size; /* m/s, greatest velocity */
} pm_contact_course;

/* Memory for `most` contacts and `joints` joints, which the arena owns; PM_NO_MEMORY. */
int pm_contact_course_create(pm_contact_course *x, pm_arena *arena, int most, int joints);
/* Follows the blow to its end.  1: done; 0: the laws have no such blow; 2: they have several. */
int pm_contact_course_follow(pm_contact_course *x);
/* The same at once: the problem of friction.bias, with the slip after the blow (Moreau). */
int pm_contact_course_at_once(pm_contact_course *x);
/* 1 if two contacts or more push that feel each other: how they share the blow is what the pace says. */
int pm_contact_course_is_shared(const pm_contact_course *x);

#endif
