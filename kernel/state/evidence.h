/* evidence.h - the decisions of a pass: what fired, what touched, pulled, slid or held, each with its distance from the
 * threshold.  Two passes of a case that differ by their errors only take the same decisions at slightly different
 * distances: distance over difference is the margin. */
#ifndef PM_EVIDENCE_H
#define PM_EVIDENCE_H

#include "state/workspace.h"

enum pm_evidence_kind {
    PM_EVIDENCE_VALUE = 0, /* of a function of the phase that did not fire at this instant */
    PM_EVIDENCE_RATE = 1,  /* at which a function went through zero: none, and it would have turned back */
    PM_EVIDENCE_NEAR = 2,  /* least value of a function that came close and turned back */
    PM_EVIDENCE_SIGN = 3   /* of an impulse, a force, a speed: compared in a blow or a choice of modes */
};

/* What is decided by a sign. */
enum pm_evidence_site {
    PM_SITE_STRIKES = 0,
    PM_SITE_PULLS_IN_BLOW = 1,
    PM_SITE_SLIDES_IN_BLOW = 2,
    PM_SITE_JOINS = 3,
    PM_SITE_PULLS = 4,
    PM_SITE_SLIDES = 5,
    PM_SITE_SLIP_LEFT = 6, /* at the end of a blow that was followed */
    PM_SITE_MEETS = 7,
    PM_EVIDENCE_SITES = 8
};

typedef struct pm_evidence_decision {
    int32_t instant, kind, what; /* what: which of its kind */
    int32_t trigger;             /* whose program the distance is in the unit of, or PM_NONE */
    int32_t in_time;  /* rates are by time, else by the way along a path: these two cannot be compared */
    uint32_t history; /* of all that was decided before */
    double distance;  /* from the threshold */
    double reach;     /* how far it was nearby: nothing by the scene's structure if that is rounding */
    double unit;      /* natural size of the distance; of triggers over the size of their program */
} pm_evidence_decision;

typedef struct pm_evidence_log {
    pm_evidence_decision *entry; /* [PM_DECISIONS] */
    int n;
    int32_t instant, stride; /* every stride-th instant is kept: the log never grows */
    uint32_t history;
} pm_evidence_log;

#define PM_DECISIONS 4096 /* kept of a pass */

void pm_evidence_begin(pm_evidence_log *log);
/* An instant begins; then whatever is decided at it; then what came of it is mixed into the history. */
void pm_evidence_instant(pm_workspace *w);
/* How fast, in the route's progress, a function of the phase goes through its zero. */
void pm_evidence_rate(pm_workspace *w, int function, double rate);
/* The sign of x, of natural size `unit`, decides what contact slot (or contact) `what` does. */
void pm_evidence_sign(pm_workspace *w, int site, int what, double x, double unit);
void pm_evidence_close(pm_workspace *w);
/* A contact has been struck infinitely often: other passes may have seen other numbers of its blows. */
void pm_evidence_part(pm_workspace *w, int contact);

/* Not zero by the scene's structure; unit: its natural size. */
int pm_evidence_is_open(const pm_evidence_decision *x, double unit);
/* Least distance over difference of the decisions that both passes took; trigger_scale[ntrigger] natural sizes of
 * the trigger programs. */
double pm_evidence_margin(const pm_evidence_log *a, const pm_evidence_log *b, const double *trigger_scale);

#endif
