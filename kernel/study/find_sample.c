/* find_sample.c - samples of one parameter between its bounds.
 *
 * Of most samples of a condition ZERO nothing is used but the sign of its reading.  They are run loosely first; again, as
 * accurately as the pass is, are run those whose reading could be of the other sign, or is used itself:
 *
 *   a reading that is zero, or not a number
 *   the two ends of each change of sign
 *   a reading that is nearer to zero than those of its neighbours
 *
 * until no more come up: a root next to a sample is not lost. */
#include "study/find.h"

#include <math.h>

#include "numerics/tolerances.h"
#include "state/workspace.h"

static int look_at(pm_workspace *w, int i, double loosest)
{
    pm_find *f = w->find;
    const double x = i < f->samples ? f->low[0] + i * ((f->high[0] - f->low[0]) / f->samples) : f->high[0];
    w->evidence.loosest = loosest;
    const int status = pm_find_look(w, &x, &f->node[i]);
    w->evidence.loosest = 0;
    f->node[i].loose = loosest > 0;
    return status;
}

static double value_of(const pm_find *f, int i) { return f->node[i].reading[f->zero[0]]; }

static int is_there(const pm_find *f, int i) { return i >= 0 && i <= f->samples; }

static int differs_in_sign(const pm_find *f, int i, int j)
{
    return is_there(f, j) && !(value_of(f, i) * value_of(f, j) > 0);
}

static int is_no_farther(const pm_find *f, int i, int j)
{
    return !is_there(f, j) || fabs(value_of(f, i)) <= fabs(value_of(f, j));
}

/* Whether more than the sign of sample i is used, or its sign is in doubt. */
static int matters(const pm_find *f, int i)
{
    return f->node[i].status != PM_OK || !(fabs(value_of(f, i)) > 0) || differs_in_sign(f, i, i - 1) ||
           differs_in_sign(f, i, i + 1) || (is_no_farther(f, i, i - 1) && is_no_farther(f, i, i + 1));
}

static int confirm(pm_workspace *w)
{
    const pm_find *f = w->find;
    for (int again = 1; again;) {
        again = 0;
        for (int i = 0; i <= f->samples; i++) {
            if (!f->node[i].loose || !matters(f, i)) continue;
            const int status = look_at(w, i, 0);
            if (status) return status;
            again = 1;
        }
    }
    return PM_OK;
}

int pm_find_sample(pm_workspace *w)
{
    const pm_find *f = w->find;
    for (int i = 0; i <= f->samples; i++) {
        const int status = look_at(w, i, f->nzero > 0 ? PM_FIND_LOOSE : 0);
        if (status) return status;
    }
    return f->nzero > 0 ? confirm(w) : PM_OK;
}
