/* run.h - one case from its start to its end; what the files of the room share.
 *
 *   run.c           start -> phase -> event -> blow and modes -> next phase
 *   advance.c       steps of a phase, until something happens
 *   plan.c          which route computes a phase, and why
 *   routes.c        which routes there are
 *   disturb.c       states that are off by some roundings, in coarse runs
 *   speed_scale.c   the speed that a scene at rest is measured by
 *   phase_report.c  the list of the phases of one case
 *   workspace.c     memory of a thread
 *
 * Functions return enum pm_status: PM_OK, > 0 an early stop, < 0 a failure, both with w->result.where set. */
#ifndef PM_RUN_H
#define PM_RUN_H

#include "equations/start.h"
#include "state/workspace.h"

/* ---- run.c ---- */
/* Runs a case with param[nparam], SI: fills out, reason, audit and count of w->result, whose arrays are the caller's. */
int pm_run(pm_workspace *w, const double *param);
/* No ask has an answer: the case failed. */
void pm_run_fail_asks(const pm_model *model, pm_result *result);
/* Only the start of a case, ready for its first phase: constraints built, projected, accelerations known.  What happens at
 * the start is answered: w->result has its arrays, as for a run. */
int pm_run_start(pm_workspace *w, const double *param, pm_start_report *report);

/* ---- advance.c ---- */
/* Steps until something happens or a limit is met.  On an event w->state is at it (before the jump), the phase's
 * constraints still hold, w->event->hit and ->fired say what.  Instants that only mark something are passed on the way:
 * *ended = 1 if one of them ends the run. */
int pm_advance(pm_workspace *w, int *ended);

/* ---- plan.c ---- */
/* Chooses w->phase.route for the phase that begins at w->state with the active constraints; w->phase.rule tells why. */
int pm_plan_phase(pm_workspace *w);
/* The phase serves to pass a singular position, and that lies behind: the route that was asked for goes on. */
int pm_plan_has_passed(pm_workspace *w);
/* By its structure the run ends at its start, nothing can touch, and nothing that is asked needs accelerations. */
int pm_plan_kinematic(const pm_model *m, const struct pm_ask_set *ask);
/* The run has ended before any phase: its route is `state`, or `jump` if there were blows. */
void pm_plan_no_phase(pm_result *result);
/* The status of a case that has one: PM_NO_TIME_ROUTE where all is well, but rk or ida was asked for to compute a motion
 * and there was none (evidence of two routes in time would be no evidence). */
int pm_plan_end(const pm_model *model, pm_result *result, int status);

/* ---- disturb.c ---- */
/* Before a phase: in a coarse run it begins at a state that is off by some roundings.  The frame is DYNAMIC before and
 * after. */
int pm_disturb(pm_workspace *w);

/* ---- speed_scale.c ---- */
/* Makes w->numbers.speed no less than what the forces make of the scene's size.  The frame looks at w->state, before and
 * after. */
void pm_speed_scale(pm_workspace *w);

/* ---- phase_report.c ---- */
typedef struct pm_phase_report {
    int64_t cap, most, needed;
    int32_t *row;                     /* [cap][PM_PHASE_COLUMNS], the caller's */
    double *time;                     /* [cap] s, the caller's */
    int64_t njoint, ncontact;         /* of the caller's tables */
    int32_t *joint, *contact;         /* [cap][njoint], [cap][ncontact]: groups that share loads */
    int64_t skipped, steps, repeated; /* of the case, when the last phase began */
} pm_phase_report;

/* The phase that w->phase.route has begun; PM_CANCELLED if no more are wanted.  Does nothing without a list. */
int pm_phase_report_add(pm_workspace *w);
/* The run has ended: steps of its last phase. */
void pm_phase_report_end(pm_workspace *w);

#endif
