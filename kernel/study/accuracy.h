/* accuracy.h - how far each answer can be trusted: estimated errors of the asks and the margin of the run's decisions.
 *
 * pm_accuracy_run makes the passes of a case and fills error and trust.  A route that knows its own errors says so while
 * it answers (pm_evidence_answer for every column of out, pm_evidence_decide for every decision): then no coarse run runs. */
#ifndef PM_ACCURACY_H
#define PM_ACCURACY_H

#include "state/evidence.h"
#include "state/workspace.h"
#include "study/natural_size.h"

typedef struct pm_accuracy {
    int npass;
    int runs_find; /* a pass goes through find.c */
    pm_pass pass[3], *main, *other, *spare, *last;
    const pm_pass *before; /* the main pass before, at a looser tolerance; NULL: there is none */
    double *neighbours;    /* [nout] scratch: errors of a list */
    double *first;         /* [nout] errors by the first of two coarse runs */
    pm_natural_size size;  /* of asks and triggers, at the end of the main pass */
    double late;           /* s: the error of the state at the end, as a time along its motion */
    double apart;       /* how far its comparison is from the main pass, of the sizes of what is compared */
    double *kept;       /* [nout] errors of the main pass, while another is tried */
    pm_closest closest; /* decision of the main pass, as its log, or the route, tells it */
    unsigned char *discrete; /* [nask] integers and yes or no: they have no error, but a margin */
} pm_accuracy;

/* pm_workspace_create, and memory for estimates of errors and for what is sought (find.h). */
int pm_accuracy_create(const pm_model *model, pm_workspace **workspace);

/* Runs a case as pm_find_run does (with found NULL as pm_run, all parameters as given), and with PM_SETTING_ESTIMATE
 * again, as often as it takes: see accuracy.c.  error[nout] in the unit of out, NaN where there is none; margin[nask], NaN
 * for what is no integer and no yes or no; trust[PM_TRUSTS]; found[PM_FOUND_COLUMNS]. */
int pm_accuracy_run(pm_workspace *w, const double *param, double *found, double *error, double *margin,
                    double *trust);

/* ---- margin.c ---- */
/* Least distance over difference of the decisions that both passes took; trigger_scale[ntrigger]: natural sizes of the
 * trigger programs. */
pm_closest pm_margin_of_logs(const pm_evidence_log *a, const pm_evidence_log *b, const double *trigger_scale);
/* Late in a series of ever smaller blows passes may have seen other numbers of them; else the same number. */
int pm_margin_same_jumps(const pm_accuracy *e);
/* The margin of the main pass, and its decision in e->closest; share: of the difference of both passes, what its error is taken
 * for.  Passes that came to other counts or statuses have a margin of 0, even where no log shows why. */
double pm_margin_judge(pm_accuracy *e, double share);
/* Of a run whose errors nobody estimates: PM_UNDECIDED where it was not told whether something fires, at which place and time. */
int pm_margin_unseen(pm_workspace *w);
/* The main pass ends as PM_UNDECIDED: of which decision, and when it was taken. */
void pm_margin_undecided(const pm_model *model, pm_accuracy *e, double margin);

#endif
