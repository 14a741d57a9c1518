/* repeat_pass.c - moves the run on by n segments at once.
 *
 *   q += n b,    v *= sqrt(T_n / T),    t += n t_leg,    integrals, counts and the error of a segment's time n times
 *
 * The ledger of momentum takes what the outer world has given: the difference of momenta. */
#include <math.h>

#include "elements/contact.h"
#include "equations/active_set.h"
#include "equations/ledger.h"
#include "numerics/minmax.h"
#include "routes/path/path.h"
#include "routes/path/repeat.h"
#include "state/frame.h"
#include "state/workspace.h"

static void move_state(pm_workspace *w, const pm_repeat *l, int64_t segments, double faster, double time)
{
    const pm_model *m = w->model;
    const double n = (double)segments;
    pm_state *s = &w->state;
    for (int i = 0; i < m->nz_controlled; i++) s->z[i] += n * (s->z[i] - l->begin.z[i]);
    for (int i = 0; i < m->nbody; i++) {
        for (int k = 0; k < 2; k++) s->q[3 * i + k] += n * l->by[k];
        s->q[3 * i + 2] += n * l->rotation[i];
    }
    for (int i = 0; i < m->nq; i++) s->v[i] *= faster;
    s->t += n * time;
    for (int i = 0; i < m->nslot; i++)
        if (s->slot[i].mode != PM_OPEN && pm_contact_is_pattern(m, pm_contact_of_slot(m, i)))
            s->slot[i].member += (int32_t)(segments * l->member);
}

static void count_segments(pm_workspace *w, const pm_repeat *l, int64_t segments, double time)
{
    static const int counted[] = {PM_COUNT_PHASES, PM_COUNT_JUMPS};
    const int64_t instants = pm_repeat_limit_instants(w, l);
    for (int i = 0; i < w->model->rows[PM_TABLE_EVENT]; i++) {
        const int64_t each = pm_repeat_limit_fires(&w->firing, l, i);
        w->firing.count[i] += segments * each;
        if (each > 0) w->firing.time[i] += (double)segments * time;
    }
    w->firing.jumped += (double)segments * time;
    for (int i = 0; i < 2; i++)
        w->result.count[counted[i]] += segments * (w->result.count[counted[i]] - l->count[counted[i]]);
    w->result.count[PM_COUNT_EVENTS] += segments * instants;
    w->result.count[PM_COUNT_REPEATED_SEGMENTS] += segments;
}

/* The clock's are of another run where no phase has begun. */
void pm_repeat_pass_begin(const pm_workspace *w, pm_repeat *l)
{
    const pm_path *p = w->path;
    const int begun = w->result.count[PM_COUNT_PHASES] > 0;
    l->late = begun ? pm_path_clock_left(p, w->state.t, w->step.end / p->h) : 0;
    l->unresolved = begun ? p->clock.unresolved : 0;
    l->clock = begun ? p->clock.error : 0;
}

double pm_repeat_pass_time(const pm_workspace *w, const pm_repeat *l)
{
    const pm_path *p = w->path;
    return w->state.t - l->begin.t + (pm_path_clock_left(p, w->state.t, w->step.end / p->h) - l->late);
}

/* All of them err alike. */
static void move_clock(pm_path *p, const pm_repeat *l, int64_t segments)
{
    const double n = (double)segments;
    p->clock.greatest += n * pm_min(p->clock.greatest, p->clock.unresolved - l->unresolved);
    p->clock.unresolved += n * (p->clock.unresolved - l->unresolved);
    p->clock.error += n * (p->clock.error - l->clock);
}

int pm_repeat_pass(pm_workspace *w, const pm_repeat *l, const pm_repeats *segments, double kinetic,
                   double time)
{
    double momentum[PM_LEDGER];
    pm_frame_momentum(&w->frame, PM_NONE, momentum);
    move_state(w, l, segments->n, kinetic > 0 ? sqrt(segments->kinetic / kinetic) : 1, time);
    count_segments(w, l, segments->n, time);
    if (time > 0) move_clock(w->path, l, segments->n);
    w->ledger.energy_lost += segments->lost;
    w->path->error = segments->error;
    w->path->ended = 0; /* the error is that at the begin of the segment that follows */
    pm_frame_look_state(&w->frame, &w->state);
    for (int i = 0; i < w->model->nslot; i++)
        if (w->state.slot[i].mode == PM_STICK) pm_active_set_anchor(&w->frame, &w->state, i);
    pm_ledger_follow(&w->frame, momentum, w->state.z);
    return pm_active_set_build(w);
}
