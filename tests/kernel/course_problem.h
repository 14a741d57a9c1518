/* Blows at several contacts of bodies, as the course of a blow takes them. */
#ifndef COURSE_PROBLEM_H
#define COURSE_PROBLEM_H

#include <string.h>

#include "check.h"
#include "impact/contact_course.h"
#include "planemotion.h"
#include "state/arena.h"

#define MOST 4

typedef struct problem {
    int n, law[MOST];
    double jacobian[2 * MOST][6], inverse[6], velocity[6], mu[MOST], e[MOST];
} problem;

static pm_arena memory;

static pm_contact_course course;

static inline void add_contact(problem *x, double px, double py, double angle, int law)
{
    double *normal = x->jacobian[2 * x->n], *tangent = x->jacobian[2 * x->n + 1];
    memset(normal, 0, 2 * sizeof x->jacobian[0]);
    normal[0] = -sin(angle), normal[1] = cos(angle), normal[2] = px * cos(angle) + py * sin(angle);
    tangent[0] = cos(angle), tangent[1] = sin(angle), tangent[2] = px * sin(angle) - py * cos(angle);
    x->law[x->n] = law < 0 ? (int)check_random(0, PM_LAWS) : law;
    x->mu[x->n] = check_random(0, 1) < 0.2 ? 0 : check_random(0, 0.8);
    x->e[x->n++] = check_random(0, 1) < 0.2 ? 0 : check_random(0, 1);
}

static inline void pose(const problem *x)
{
    const int n = 2 * x->n;
    course.n = x->n;
    course.no_slip = 1e-12;
    for (int i = 0; i < n; i++) {
        course.velocity[i] = 0;
        for (int q = 0; q < 6; q++) course.velocity[i] += x->jacobian[i][q] * x->velocity[q];
        for (int k = 0; k < n; k++) {
            double *w = &course.response[i * n + k];
            *w = 0;
            for (int q = 0; q < 6; q++) *w += x->jacobian[i][q] * x->inverse[q] * x->jacobian[k][q];
        }
    }
    for (int i = 0; i < x->n; i++)
        course.contact[i] = (pm_contact_course_contact){
            .friction = {.friction = PM_FRICTION_COULOMB,
                         .hold = x->mu[i],
                         .rub = x->mu[i],
                         .prefers = PM_NONE},
            .law = x->law[i],
            .restitution = x->e[i],
        };
}

/* Velocities of the bodies after the blow. */
static inline int follow(const problem *x, double after[6])
{
    pose(x);
    const int found = pm_contact_course_follow(&course);
    memcpy(after, x->velocity, 6 * sizeof *after);
    for (int i = 0; i < 2 * x->n && found == 1; i++)
        for (int q = 0; q < 6; q++) after[q] += x->inverse[q] * x->jacobian[i][q] * course.impulse[i];
    return found;
}

#endif
