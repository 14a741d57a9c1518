/* path_error.c - errors along paths.
 *
 * Places on a path carry no error but rounding; T does: it is rounded with the energies that make it, in every step, and
 * a blow that leaves m T_end leaves m times the error.  An answer f(place, T) is then known to |df/dT| dT, by a difference.
 * That holds as long as places alone decide when something happens; where speeds, forces or the time do, the run says
 * nothing of its errors, and error.c makes its companion. */
#include "path_error.h"

#include <math.h>
#include <string.h>

#include "body.h"
#include "error.h"
#include "nature.h"
#include "path.h"
#include "program.h"
#include "route.h"
#include "saddle.h"

#define ROUNDINGS 1e-15 /* of the energies, in a step or a blow: some roundings */
#define FASTER 1e-6     /* of the speeds, for the difference */

void pm_path_error_begin(pm_workspace *w, double kinetic)
{
    pm_path *p = w->path;
    if (w->count[PM_COUNT_PHASES] == 0) p->error = p->ended = 0;
    if (p->ended > 0) p->error *= kinetic / p->ended;
    p->error += ROUNDINGS * kinetic;
}

void pm_path_error_step(pm_workspace *w, double kinetic)
{
    pm_path *p = w->path;
    const double potential = p->by_work ? 0 : fabs(p->node[0].potential);
    p->ended = kinetic;
    p->error += ROUNDINGS * (p->node[0].kinetic + kinetic + potential);
}

void pm_path_error_barrier(pm_workspace *w, double distance)
{
    pm_error_decision(w, distance, w->path->error);
}

/* Places alone tell when triggers fire; a trigger that goes by sqrt(T) fires where the motion turns back. */
static int by_places(const pm_workspace *w)
{
    const pm_model *m = w->model;
    if (m->reads_time || w->count[PM_COUNT_ROUTES] != (int64_t)1 << PM_ROUTE_PATH) return 0;
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        const int kind = e[PM_TRIGGER_KIND], program = e[PM_TRIGGER_PROGRAM];
        if (kind > PM_TRIGGER_EVERY) {
            if (kind != PM_TRIGGER_START && kind != PM_TRIGGER_STRIKE) return 0;
            continue;
        }
        if (m->program_nature[program] != PM_NATURE_PLACE && m->program_growth[program] != PM_GROWTH_ROOT)
            return 0;
    }
    return 1;
}

void pm_path_error_answer(pm_workspace *w, int ask, int column, int program, double value)
{
    if (!w->error->active || w->route != &pm_route_path || !by_places(w)) return;
    const double kinetic = pm_body_kinetic(w, PM_NONE), error = w->path->error;
    const int growth = w->model->program_growth[program];
    if (isnan(value) || growth == PM_GROWTH_NONE || w->error->discrete[ask]) {
        pm_error_answer(w, column, 0); /* but for rounding; integers have the margin of their decisions */
        return;
    }
    if (growth == PM_GROWTH_UNKNOWN || !(kinetic > 0)) {
        pm_error_answer(w, column, NAN);
        return;
    }
    const int nq = w->model->nq, dynamic = w->model->program_level[program] == PM_LEVEL_DYNAMIC;
    double *v = w->frame.velocity;
    for (int i = 0; i < nq; i++) v[i] *= 1 + FASTER;
    const int failed = dynamic && pm_saddle_accelerate(w);
    const double changed = pm_program_run(w->model, program, w->param, w->value, w);
    for (int i = 0; i < nq; i++) v[i] = w->frame.v[i];
    if (dynamic) (void)pm_saddle_accelerate(w);
    pm_error_answer(w, column, failed ? NAN : fabs(changed - value) / (2 * FASTER * kinetic) * error);
}
