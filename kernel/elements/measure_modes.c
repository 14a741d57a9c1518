/* measure_modes.c - what is read off the modes of small motion (state/modes.h). */
#include <string.h>

#include "elements/measure_kinds.h"
#include "state/modes.h"
#include "state/workspace.h"

static int is_of_frame(const pm_modes *m, const pm_workspace *w)
{
    const size_t size = (size_t)w->model->nq * sizeof(double);
    return m->known && m->t == w->state.t && m->contacts == w->active.version &&
           !memcmp(m->q, w->state.q, size) && !memcmp(m->v, w->state.v, size);
}

static const pm_modes *modes_of(const pm_measure_args *x)
{
    pm_modes *m = x->w->frame.modes;
    const pm_state *s = &x->w->state;
    const size_t size = (size_t)x->w->model->nq * sizeof(double);
    if (is_of_frame(m, x->w)) return m;
    m->find(x->w);
    m->known = 1;
    m->t = s->t;
    m->contacts = x->w->active.version;
    memcpy(m->q, s->q, size);
    memcpy(m->v, s->v, size);
    return m;
}

static double of_mode(const pm_measure_args *x, const pm_modes *m, const double *value)
{
    const int number = x->e[PM_MEASURE_MEMBER];
    return number <= m->n ? value[number - 1] : NAN;
}

double pm_measured_mode_omega(const pm_measure_args *x)
{
    const pm_modes *m = modes_of(x);
    return of_mode(x, m, m->omega);
}
double pm_measured_mode_damping(const pm_measure_args *x)
{
    const pm_modes *m = modes_of(x);
    return of_mode(x, m, m->damping);
}
double pm_measured_modes_count(const pm_measure_args *x) { return modes_of(x)->n; }
double pm_measured_modes_growth(const pm_measure_args *x) { return modes_of(x)->growth; }
