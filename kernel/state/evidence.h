/* evidence.h - what a pass of a case notes of its own errors and decisions: study/accuracy.c and study/margin.c read it.
 *
 * A decision is what fired, touched, pulled, slid or held, with its distance from the threshold.  Two passes of a case that
 * differ by their errors only take the same decisions at slightly different distances: distance over difference is the
 * margin.  A route that knows its own errors notes them, too: then no second pass is run. */
#ifndef PM_EVIDENCE_H
#define PM_EVIDENCE_H

#include "state/workspace.h"

#define PM_EVIDENCE_SEED 2383 /* of the disturbances of a coarse run, beside its number: any number */

enum pm_evidence_kind {
    /* of a function of the phase that did not fire at this instant; of a trigger after a jump */
    PM_EVIDENCE_VALUE = 0,
    PM_EVIDENCE_RATE = 1, /* at which a function went through zero: none, and it would have reversed */
    PM_EVIDENCE_NEAR = 2, /* least value of a function that came close and reversed */
    PM_EVIDENCE_SIGN = 3  /* of an impulse, a force, a speed: compared in a blow or a choice of modes */
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
    PM_SITE_PARTS = 8,  /* what touches */
    PM_SITE_SHARES = 9, /* as PULLS and SLIDES, of contacts that share a load */
    PM_EVIDENCE_SITES = 10
};

typedef struct pm_evidence_decision {
    int32_t instant, kind, what; /* what: which of its kind */
    int32_t trigger;             /* whose program the distance is in the unit of, or PM_NONE */
    int32_t in_time;    /* rates are by time, else by the way along a path: these two cannot be compared */
    uint32_t history;   /* of all that was decided before */
    uint32_t trial;     /* modes that were tried when it was taken; 0: of no trial */
    double distance;    /* from the threshold */
    double touching;    /* times as much as usual counts as touching, of a gap next to it; else 0 */
    double reach;       /* how far it was nearby: nothing by the scene's structure if that is rounding */
    double unit;        /* natural size of the distance; of triggers over the size of their program */
    double error;       /* of the distance, by that of the time, where the route tells it; else 0 */
    double approach;    /* m/s, greatest of the blow that it belongs to; 0: of none */
    int32_t table, row; /* whose it is, where neither a trigger nor a site tells; PM_NONE: of no place */
    double t;           /* s, of its instant */
} pm_evidence_decision;

typedef struct pm_evidence_log {
    pm_evidence_decision *entry; /* [room], the first n in use; its own, grows to PM_DECISIONS */
    int n, room;
    int32_t instant, stride; /* every stride-th instant is kept, lest they be more: a power of two */
    uint32_t history;
    uint32_t trial; /* see pm_evidence_try */
} pm_evidence_log;

#define PM_DECISIONS 4096   /* kept of a pass */
#define PM_DECISIONS_FEW 32 /* there is room for so many first: most scenes have fewer */

static inline int pm_evidence_is_kept(int32_t instant, int32_t stride)
{
    return (instant & (stride - 1)) == 0;
}

/* One pass of a case and what came of it. */
typedef struct pm_pass {
    double *out;     /* [nout] */
    double *error;   /* [nout] as the route itself says, NaN where it does not */
    double *more;    /* [nout] what is added to either kind of error */
    int32_t *reason; /* [nask] */
    double audit[PM_AUDITS];
    double found[PM_FOUND_COLUMNS];
    int64_t count[PM_COUNT_COLUMNS];
    pm_where where, ordered;
    double t;         /* where it ended */
    double factor;    /* what was asked of it: of the tolerance that the accuracy gives */
    double tolerance; /* of the integration */
    double margin;    /* of the decisions whose errors the route itself gave */
    double relative;  /* greatest error of T on its paths, of T */
    double late;      /* of the time along them: what the nodes of the steps did not resolve */
    double *end;      /* [2][nq] positions, velocities with which it ended */
    double *extreme;  /* [2][ntrigger] nearest to zero of a decision by forces, and how far nearby */
    int cut;          /* a series of blows without end was cut off, by its error in time */
    int64_t alike;    /* blows of series of which the rest was taken at once: how many is no decision */
    int unsure;       /* the extremes of such a function are not known */
    double tied; /* s, when a jump that was located and a time of the scene were at one instant; NaN: never */
    pm_unseen unseen;
    uint64_t outcome; /* hash of status, reasons and event counts */
    int status;
    int coarse;
    int number; /* of the passes of its case, from 1 */
    int fine;   /* a coarse one that takes in two each step of the main one, which takes few */
    int halves;
    pm_evidence_log log;
} pm_pass;

/* The decision of a case that is closest to its threshold. */
typedef struct pm_closest {
    double margin;
    const pm_evidence_decision *decision; /* NULL where no log has it */
    int trigger;                          /* then: that comes so close to firing, or PM_NONE */
    double parted; /* s, of the first instant at which two passes decided differently; 0: of none */
} pm_closest;

/* Nothing is known of the errors and decisions of the run that begins. */
void pm_evidence_begin(const pm_model *model, pm_evidence *evidence);
/* Of a log that nobody adds to any more. */
void pm_evidence_free_log(void *log);
/* The tolerance of integration in the present pass. */
double pm_evidence_tolerance(const pm_workspace *w);
/* Whether a coarse run takes in two each step of the main one, which takes few. */
int pm_evidence_is_fine(const pm_evidence *evidence);
/* Whether a route that takes a state inside a step from its begin takes it in two halves: a phase that one step covers would
 * else be the same in both passes that are compared. */
int pm_evidence_in_halves(const pm_evidence *evidence);
/* Whether it is a coarse run, which another is compared with. */
int pm_evidence_is_coarse(const pm_evidence *evidence);

/* What a coarse run adds to a rounded value, in units of PM_COARSER roundings of it: to either side by chance, and a little
 * always to the one of number i, as steps that are alike are rounded alike.  0 in other runs. */
double pm_evidence_noise(pm_evidence *evidence, int i);

/* For routes that know their errors: that of out[column], absolute; a decision that was taken at `distance` from its
 * threshold, known to `error` in the same unit. */
void pm_evidence_answer(pm_evidence *evidence, int column, double error);
void pm_evidence_decide(pm_evidence *evidence, double distance, double error);
/* What is added to the error of out[column], whoever knows it. */
void pm_evidence_more(pm_evidence *evidence, int column, double more);
/* A series of ever smaller blows was ended although its last rebound would have lasted: earlier in a coarse run. */
void pm_evidence_cut(pm_evidence *evidence);

/* A jump that was located and a time of the scene are at one instant, t: which of both came first is not known. */
void pm_evidence_ties(pm_evidence *evidence, double t);
/* From t on it is open whether what watches for a row of a table fires. */
void pm_evidence_unseen(pm_evidence *evidence, int table, int row, double t);
/* Whether a series of ever smaller blows was passed, or ended. */
int pm_evidence_has_series(const pm_pass *pass);

/* Adds a decision to the log of the pass, at the present instant. */
void pm_evidence_take(pm_evidence *evidence, const pm_evidence_decision *decision);
/* Likewise; it belongs to the blow whose decisions were added last at this instant. */
void pm_evidence_take_after(pm_evidence *evidence, const pm_evidence_decision *decision);
/* The sign of x, of natural size `unit`, decides what contact slot (or contact) `what` does. */
void pm_evidence_sign(pm_evidence *evidence, int site, int what, double x, double unit);
#define PM_EVIDENCE_LAST_BLOW (-1.0) /* in the place of the speed of approach: of a blow that ends a series */
/* What was decided at the present instant so far belongs to a blow with this greatest speed of approach, m/s. */
void pm_evidence_blow(pm_evidence *evidence, double approach);
/* A contact has been struck infinitely often: other passes may have seen other numbers of its blows. */
void pm_evidence_part(pm_evidence *evidence, int contact);
/* The rest of such a series is taken at once, after so many blows of which each was like the one before. */
void pm_evidence_leap(pm_evidence *evidence, int contact, int alike);
/* What is decided from now on belongs to this trial of modes (0: to none).  Two passes may try different modes at an instant and end
 * with the same: decisions are compared where both tried the same. */
void pm_evidence_try(pm_evidence *evidence, uint32_t trial);
/* The present instant is at t; what was decided after its blows belongs to the last of them. */
void pm_evidence_date(pm_evidence_log *log, double t);
/* What came of the present instant is mixed into the history of the log; the next one begins. */
void pm_evidence_mix(pm_evidence_log *log, uint32_t what);
/* The part of the run that a decision belongs to: see pm_evidence_part. */
int32_t pm_evidence_part_of(const pm_evidence_decision *x);

/* Not zero by the scene's structure; unit: its natural size. */
int pm_evidence_is_open(const pm_evidence_decision *x, double unit);

#endif
