/* accuracy.h - how far each answer can be trusted: estimated errors of the asks and the margin of the run's decisions.
 *
 * pm_accuracy_run makes the passes of a case and fills error and trust.  A route that knows its own errors says so while
 * it answers (pm_accuracy_answer for every column of out, pm_accuracy_decision for every decision): then no companion runs. */
#ifndef PM_ACCURACY_H
#define PM_ACCURACY_H

#include "state/evidence.h"
#include "state/workspace.h"

/* One pass of a case and what came of it. */
typedef struct pm_pass {
    double *out;     /* [nout] */
    double *error;   /* [nout] as the route itself says, NaN where it does not */
    double *more;    /* [nout] what is added to either kind of error */
    int32_t *reason; /* [nask] */
    double audit[PM_AUDITS];
    double found[PM_FOUND_COLUMNS];
    int64_t count[PM_COUNT_COLUMNS];
    pm_where where;
    double t;         /* where it ended */
    double factor;    /* what was asked of it: of the tolerance that the accuracy gives */
    double tolerance; /* of the integration */
    double margin;    /* of the decisions whose errors the route itself gave */
    double relative;  /* greatest error of T on its paths, of T */
    double *
        extreme; /* [2][ntrigger] nearest to zero of what forces or speeds decide, and how far it was nearby */
    int cut;     /* a series of blows without end was cut off, by its error in time */
    int unsure;  /* the extremes of such a function are not known */
    uint64_t outcome; /* hash of status, reasons and event counts */
    int status;
    int companion;
    int halves;
    pm_evidence_log log;
} pm_pass;

typedef struct pm_accuracy {
    int active; /* the present case is run for its errors too */
    int npass;
    int runs_find; /* a pass goes through find.c */
    int seeks;     /* a pass is a find with all its runs */
    int by_places; /* path_error.h */
    uint64_t noise;
    pm_pass pass[3], *present, *main, *other, *spare, *last;
    double *scale;           /* [nask] natural size of each ask */
    double *trigger_scale;   /* [ntrigger] */
    unsigned char *discrete; /* [nask] integers and yes or no: they have no error, but a margin */
    void *block;
} pm_accuracy;

int pm_accuracy_create(pm_workspace *w);
void pm_accuracy_free(pm_workspace *w);

/* Runs a case as pm_find_run does (with found NULL as pm_run, all parameters as given), and with PM_SETTING_ESTIMATE
 * again, as often as it takes: see accuracy.c.  error[nout] in the unit of out, NaN where there is none; margin[nask], NaN
 * for what is no integer and no yes or no; trust[PM_TRUSTS]; found[PM_FOUND_COLUMNS]. */
int pm_accuracy_run(pm_workspace *w, const double *param, double *found, double *error, double *margin,
                    double *trust);

/* For run.c, when a run begins: nothing is known of its errors and decisions. */
void pm_accuracy_begin(pm_workspace *w);
/* For case.c: the tolerance of the present pass. */
double pm_accuracy_tolerance(const pm_workspace *w);
/* For routes that take a state inside a step from its begin: in two halves.  A phase that one step covers would else be
 * the same in both passes that are compared. */
int pm_accuracy_in_halves(const pm_workspace *w);
/* For run.c, before a phase: in a companion the state is disturbed by a few roundings.  The frame is
 * DYNAMIC before and after. */
int pm_accuracy_disturb(pm_workspace *w);

/* For routes that know their errors: that of out[column], absolute; a decision that was taken at `distance` from its
 * threshold, known to `error` in the same unit. */
void pm_accuracy_answer(pm_workspace *w, int column, double error);
/* What was left untold of out[column], whoever tells its error. */
void pm_accuracy_more(pm_workspace *w, int column, double more);
/* A series of ever smaller blows is over although its last rebound would have lasted: earlier in a companion. */
void pm_accuracy_cut(pm_workspace *w);
void pm_accuracy_decision(pm_workspace *w, double distance, double error);

#endif
