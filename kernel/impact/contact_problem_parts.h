/* contact_problem_parts.h - the scaled problem, as its methods share it. */
#ifndef PM_CONTACT_PROBLEM_PARTS_H
#define PM_CONTACT_PROBLEM_PARTS_H

#include "impact/contact_problem.h"

/* A contact that never has a tangential load. */
int pm_contact_problem_is_smooth(const pm_contact_problem_contact *c);
/* Coefficient of friction mu of contact i in the scaled problem. */
double pm_contact_problem_friction(const pm_contact_problem *x, int i, double mu);
/* Loads and rates of the modes in x->trial; 1 if all inequalities hold. */
int pm_contact_problem_trial_holds(pm_contact_problem *x);
/* The same of the loads x->p as they are: the rates that go with them, and whether all inequalities hold. */
int pm_contact_problem_loads_hold(pm_contact_problem *x);
/* Finds modes that hold, in x->trial; 0 if it does not. */
int pm_contact_problem_lemke(pm_contact_problem *x);
/* Likewise, by sweeps over the contacts one by one. */
int pm_contact_problem_sweeps(pm_contact_problem *x);

#endif
