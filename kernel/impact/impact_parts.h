/* impact_parts.h - one blow, as the files share it that resolve it: who takes part, what is tried, what comes of it.
 *
 * impact.c owns it for all blows of a workspace; nothing is kept in it from one blow to the next. */
#ifndef PM_IMPACT_PARTS_H
#define PM_IMPACT_PARTS_H

#include "elements/constraint.h"
#include "impact/impact_course.h"
#include "state/workspace.h"

/* Which part a slot takes. */
enum pm_share { PM_OUT = 0, PM_STRUCK = 1, PM_JOINED = 2, PM_DROPPED = 3 };

typedef struct pm_blow {
    unsigned char *share;     /* [nslot] enum pm_share */
    int32_t *resting;         /* [nslot] enum pm_contact_mode before the blow; PM_OPEN if struck */
    int32_t *trial;           /* [nslot] enum pm_contact_mode in the blow of what takes part */
    double *before;           /* [nq] velocities before the blow, m/s and rad/s */
    double *after;            /* [nq] and after it */
    double *response;         /* [nq] scratch of impact_course.c */
    int alone;                /* slot whose blow is followed by itself (impact_course.c), or PM_NONE */
    pm_impact_course_end end; /* of that */
} pm_blow;

static inline int pm_blow_has(const pm_blow *b, int slot)
{
    return b->share[slot] == PM_STRUCK || b->share[slot] == PM_JOINED;
}

/* ---- impact_trial.c: the constraints of a trial, and its impulses ---- */
/* Mode in which the contact of a slot enters a blow. */
int32_t pm_impact_trial_mode(const pm_model *m, int slot);
/* The active constraints, their impulses (w->saddle.rhs) and b->after, of the shares and modes that are tried. */
int pm_impact_trial_solve(pm_workspace *w, pm_blow *b);
/* Rate of active constraint i before the blow, relative to what drives prescribe. */
double pm_impact_trial_rate(const pm_workspace *w, int i);
/* What the impulses of the trial forbid: 1 if shares or modes have changed, and the trial must be repeated. */
int pm_impact_trial_change(pm_workspace *w, pm_blow *b);

/* ---- impact_end.c: what the blow that was found leaves ---- */
/* Whether the laws allow it: PM_BLOW_REVERSES, PM_BLOW_GAINS if not. */
int pm_impact_end_check(pm_workspace *w, const pm_blow *b);
/* Its impulses, for measures (w->impulses). */
void pm_impact_end_record(pm_workspace *w);
/* Modes after it: the frame looks at the velocities after the blow. */
void pm_impact_end_modes(pm_workspace *w, const pm_blow *b);

#endif
