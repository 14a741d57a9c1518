/* stand_ins.c - whether another round would change the response of bodies without mass. */
#include "equations/stand_ins.h"

#include <math.h>

#include "elements/constraint.h"
#include "numerics/minmax.h"
#include "state/workspace.h"

/* The greatest that one reaction does to what has a stand-in, as x has it.  Those on other bodies, be they heavy, say nothing of it. */
static double most_by_reactions(const pm_saddle *s)
{
    const int ground = s->model->nbody;
    double most = 0;
    for (int i = 0; i < s->active->n; i++) {
        const pm_constraint *c = &s->active->constraint[i];
        const double *d = pm_saddle_direction(s, c);
        for (int p = 0; p < pm_constraint_bodies(c); p++)
            for (int k = 0; k < 3 && c->body[p] != ground; k++) {
                const int at = 3 * c->body[p] + k;
                if (s->numbers->stand_in[at] == 0) continue;
                const double length = k == 2 ? s->numbers->size : 1;
                most = pm_max(s->numbers->inverse_mass[at] * fabs(d[3 * p + k] * s->rhs[i]) * length, most);
            }
    }
    return most;
}

double pm_stand_ins_change(const pm_saddle *saddle, const double *force, const double *x, int *worst)
{
    double most = 0, scale = most_by_reactions(saddle);
    for (int i = 0; i < saddle->model->nq; i++) {
        const double length = i % 3 == 2 ? saddle->numbers->size : 1;
        const double off = fabs(x[i] - saddle->previous[i]) * length;
        scale = pm_max(fabs(x[i]) * length, scale);
        if (force) scale = pm_max(fabs(saddle->numbers->inverse_mass[i] * force[i]) * length, scale);
        if (off > most) *worst = i;
        most = pm_max(off, most);
    }
    return scale > 0 ? most / scale : 0;
}
