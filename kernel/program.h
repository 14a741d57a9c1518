/* program.h - postfix programs: the one evaluator for values, triggers, asks and forces. */
#ifndef PM_PROGRAM_H
#define PM_PROGRAM_H

#include "model.h"

/* Runs program `index`.  With `w` it may use measures of w->frame, which must be filled to
 * model->program_level[index]; without (values), `value` holds the entries computed so far.  Not a number where
 * the expression has no value. */
double pm_program_run(const pm_model *m, int index, const double *param, const double *value,
                      pm_workspace *w);

/* Program `index` at n nodes: measure i was measured[place[i]][PM_NODES_MOST] there; value[n]. */
void pm_program_run_nodes(pm_workspace *w, int index, int n, const int *place, const double *measured,
                          double *value);

/* Works out what stays the same in the case that has begun: its masses and its weight are known.  From here on all programs
 * of the workspace are run by these numbers, until pm_case_values is told of other parameters. */
void pm_program_numbers(pm_workspace *w);

/* A program that reads no measure but the time, at the time t; *rate: how fast it changes. */
double pm_program_of_time(const pm_model *m, int index, const double *param, const double *value, double t,
                          double *rate);

/* Checks codes, arguments and stack of every program of a table set; returns PM_OK or PM_BAD_TABLE. */
int pm_program_validate(const pm_model *m, pm_where *where);

/* What an operation takes off the stack; all leave one number; < 0: no such operation. */
int pm_program_operands(int op);
double pm_program_unary(int op, double a);
double pm_program_binary(int op, double a, double b);

#endif
