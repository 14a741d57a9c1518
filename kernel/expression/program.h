/* program.h - postfix programs: the one evaluator for values, triggers, asks and forces. */
#ifndef PM_PROGRAM_H
#define PM_PROGRAM_H

#include "numerics/chebyshev_nodes.h"
#include "numerics/taylor.h"
#include "state/workspace.h"

/* Program `index` with the numbers of the case at w->frame, which must be filled to model->programs.level[index].  Not a
 * number where the expression has no value. */
double pm_program_run(pm_workspace *w, int index);
/* The table that it reads there where that has no value (PM_BEYOND_NONE), and the argument *x; PM_NONE: it has one. */
int pm_program_outside(pm_workspace *w, int index, double *x);
/* That of a value (it reads no measure and no answer), with the values that are worked out so far; param[nparam]. */
double pm_program_value(const pm_model *m, int index, const double *param, const double *value);

/* The measure is the size of something that has a sign: in programs abs is taken of what is read. */
int pm_program_takes_size(const pm_model *m, int measure);

/* Switches of a program: operations that are smooth but where an argument changes sign (of abs; the difference of what
 * min, max and comparisons compare).  With their signs given, the program is one smooth branch of itself. */
#define PM_SWITCHES 16
typedef struct pm_switches {
    const signed char *sign;                /* [n] given; NULL: those of the arguments */
    int n;                                  /* of what was run */
    double arg[PM_SWITCHES][PM_NODES_MOST]; /* what their arguments were at the nodes */
    unsigned char jumps[PM_SWITCHES];       /* 1: the value may jump there, else it has a corner */
} pm_switches;

/* How many a program has; 0 as well if they are too many, or it has steps of another kind. */
int pm_program_switches(const pm_model *m, int index);
/* Whether its one switch comes last and can but make dips (greatest: of the value, else of its negative): it has no extreme
 * there. */
int pm_program_only_dips(const pm_model *m, int index, int greatest);

/* Program `index` at n nodes: measure i was measured[place[i]][PM_NODES_MOST] there; value[n], switches: or NULL. */
void pm_program_run_nodes(pm_workspace *w, int index, int n, const int *place, const double *measured,
                          pm_switches *switches, double *value);

/* Works out number i of those that stay the same in the case that has begun (program_fold.h): its masses and its weight are known. */
void pm_program_fold_number(pm_workspace *w, int i);

/* A program that reads no measure but the time, at the time t, and its first and second derivative by the time. */
double pm_program_of_time(const pm_model *m, int index, const double *param, const double *value, double t,
                          double derivative[2]);

/* d(program)/d(measure) of one reading of a measure, the one that the walk over the program has come to, with the numbers of the
 * case at w->frame; the chain rule is a sum over all readings.  Where something switches, that of one of its sides. */
struct pm_program_walk;
double pm_program_slope(pm_workspace *w, int index, const struct pm_program_walk *reading);

/* A program that reads no measure but the place on a curve, with its derivatives at the place s; tables by that piece in
 * which `of` lies. */
pm_taylor pm_program_of_place(const pm_model *m, int index, const double *param, const double *value,
                              double s, double of);

/* Checks codes, arguments and stack of every program of a table set; returns PM_OK or PM_BAD_TABLE. */
int pm_program_validate(const pm_model *m, pm_where *where);

#endif
