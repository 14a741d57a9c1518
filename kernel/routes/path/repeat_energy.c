/* repeat_energy.c - from segment to segment, the kinetic energy.
 *
 *   T_end = T + W,    T_next = m T_end      W the work on the segment, m the ratio of the blow: neither depends on the speed
 *
 * From one begin to the next places differ by the shift alone.  So W is the work of the weight on the way that all bodies
 * have gone, and what forces without potential have done; exactly, while differences of energies would be rounded, and
 * alike in all segments.
 *
 * A segment gets over the barrier on its way if T exceeds its depth, which is the same in all segments: T at its begin less the
 * least T on it.  An error of T is carried on by m, and every segment adds its roundings. */
#include <math.h>

#include "numerics/tolerances.h"
#include "routes/path/repeat.h"
#include "state/frame.h"
#include "state/workspace.h"

double pm_repeat_energy_work(const pm_workspace *w)
{
    const pm_repeat *l = w->repeat;
    const double mass = pm_frame_total_mass(&w->frame);
    double work = 0;
    for (int i = 0; i < w->model->nz_work; i++) work += w->state.z[i] - l->begin.z[i];
    return work + mass * (w->numbers.gravity[0] * l->by[0] + w->numbers.gravity[1] * l->by[1]);
}

double pm_repeat_energy_depth(const pm_repeat *l) { return l->kinetic - l->lowest; }

void pm_repeat_energy_add(const pm_repeat *l, pm_repeats *c)
{
    const double end = c->kinetic + l->work, next = l->ratio * end;
    c->n++;
    c->lost += end - next;
    c->error = l->ratio * c->error + PM_ENERGY_ROUNDINGS * (end + next);
    c->kinetic = next;
}

/* A segment that begins with T = kinetic comes before the one that is known not to be sure. */
static int is_before_unsure(const pm_repeat *l, double begin, double kinetic)
{
    return isnan(l->unsure) || (kinetic - l->unsure) * (begin - l->unsure) > 0;
}

pm_repeats pm_repeat_energy_over_barrier(const pm_repeat *l, double begin, int64_t most, double error)
{
    pm_repeats c = {.kinetic = begin, .error = error};
    const double depth = pm_repeat_energy_depth(l);
    const double near = PM_REPEAT_BARRIER * fmax(l->kinetic, fabs(depth));
    if (!(begin - depth > near)) return c;
    if (most > PM_MOST_REPEATS) most = PM_MOST_REPEATS;
    while (c.n < most) {
        const double t = c.kinetic, next = l->ratio * (t + l->work);
        if (!(next - depth > near)) {
            c.is_last = 1;
            return c;
        }
        if (!is_before_unsure(l, begin, next)) return c;
        pm_repeat_energy_add(l, &c);
        if (fabs(next - t) > PM_REPEAT_SAME_STEP * t) continue;
        /* what is gained is lost in the blow: so it goes on */
        c.lost += (double)(most - c.n) * (t + l->work - next);
        c.n = most;
        c.kinetic = t;
    }
    return c;
}
