/* switch_search.h - where a switch of a program (program.h) changes inside a step. */
#ifndef PM_SWITCH_SEARCH_H
#define PM_SWITCH_SEARCH_H

#include "expression/program.h"
#include "numerics/bracket.h"
#include "state/workspace.h"

typedef struct pm_switch_search {
    int program;      /* an ask reads it */
    int exactly;      /* the state is looked at as an answer is (pm_ask_look) */
    int i;            /* the switch that is looked for */
    pm_switches here; /* the arguments of all its switches at the last look */
} pm_switch_search;

/* The argument of the switch at an instant of the step; not a number where it has no value. */
double pm_switch_search_argument(void *workspace, double t, void *search);
/* The instant *t between two others where the argument, fa and fb there, changes its sign. */
enum pm_search_end pm_switch_search_find(pm_workspace *w, pm_switch_search *x, double from, double fa,
                                         double to, double fb, double *t);

#endif
