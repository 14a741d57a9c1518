/* left_out.c - what a closing blow has taken away, and how far answers are off by it while its series goes on.
 *
 * A contact that is closed at a blow at t0 stands closed until its series is over at T, where it bounces in truth.  The blow
 * changed velocities by D and would have left with e D, e the restitution.  Speeds and flights shrink as the time that is left, so
 * that a flight within which t lies began with no more than
 *   s = e min(1, (T - t) / (r (T - t0)))
 * of D, r the ratio of two flights, and lasts (1 - r) / r (T - t) or less.  Within it velocities are off by between s D and -s D,
 * and places by up to s D times a quarter of the flight: the height of a throw.  Forces are those of what stands there closed: in
 * flight there is none, and what reads them is off by all of it. */
#include "events/left_out.h"

#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "expression/program.h"
#include "numerics/minmax.h"
#include "state/arena.h"
#include "state/frame.h"

enum { KEPT = 16 }; /* closing blows; of others that are still left out nothing is told */

struct pm_left_out {
    int n;               /* that have been kept; the last ones are there */
    int kept, nq;        /* no more than so many are; coordinates */
    int contact[KEPT];   /* whose blow it was */
    double closed[KEPT]; /* s */
    double *change;      /* [kept][nq] D */
    double *q, *v;       /* [nq] of the frame, moved */
};

int pm_left_out_create(pm_workspace *w, pm_left_out **of)
{
    if (PM_ARENA_NEW(&w->memory, *of)) return PM_NO_MEMORY;
    pm_left_out *x = *of;
    x->nq = w->model->nq;
    x->kept = (int)pm_min(KEPT, w->model->rows[PM_TABLE_CONTACT]);
    const pm_array array[] = {
        PM_ARRAY(x->change, x->kept * x->nq),
        PM_ARRAY(x->q, x->nq),
        PM_ARRAY(x->v, x->nq),
    };
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

void pm_left_out_forget(pm_left_out *x) { x->n = 0; }

/* Where its blow is; PM_NONE if it is not there. */
static int find(const pm_left_out *x, int contact)
{
    for (int i = 0; i < x->n && i < x->kept; i++)
        if (x->contact[i] == contact) return i;
    return PM_NONE;
}

void pm_left_out_hold(pm_left_out *x, const pm_state *after, int contact, const double *before)
{
    const int known = find(x, contact), at = known == PM_NONE ? x->n++ % x->kept : known;
    x->contact[at] = contact;
    x->closed[at] = after->t;
    for (int i = 0; i < x->nq; i++) x->change[at * x->nq + i] = after->v[i] - before[i];
}

const double *pm_left_out_change(const pm_left_out *x, int contact)
{
    const int at = find(x, contact);
    return at == PM_NONE ? NULL : x->change + at * x->nq;
}

/* The program where places are moved by so much of D, and velocities. */
static double value_moved(pm_workspace *w, const pm_left_out *x, int program, const double *change,
                          double place, double speed)
{
    const double *q = w->frame.q, *v = w->frame.v;
    for (int i = 0; i < x->nq; i++) {
        x->q[i] = q[i] + place * change[i];
        x->v[i] = v[i] + speed * change[i];
    }
    pm_frame_look(&w->frame, w->frame.t, x->q, x->v, w->frame.z, w->frame.memory);
    const double value = pm_program_run(w, program);
    pm_frame_look(&w->frame, w->frame.t, q, v, w->frame.z, w->frame.memory);
    return value;
}

double pm_left_out_error(pm_workspace *w, const pm_left_out *x, int contact, double over, double ratio,
                         int program)
{
    const int at = find(x, contact);
    const double left = over - w->frame.t;
    if (at == PM_NONE || !isfinite(over) || !(left > 0 && ratio > 0)) return 0;
    const double value = pm_program_run(w, program);
    if (w->model->programs.level[program] == PM_LEVEL_DYNAMIC) return fabs(value);
    const double *change = x->change + at * x->nq, whole = over - x->closed[at];
    const double begun = fmin(left / ratio, whole);
    const double share = pm_contact_restitution(&w->frame, contact) * begun / whole,
                 top = share * (1 - ratio) * begun / 4;
    const double up = value_moved(w, x, program, change, 0, share),
                 down = value_moved(w, x, program, change, 0, -share),
                 high = value_moved(w, x, program, change, top, 0);
    if (pm_saddle_accelerate(w)) return INFINITY; /* the frame is as it was */
    return fmax(fabs(high - value), fmax(fabs(up - value), fabs(down - value)));
}
