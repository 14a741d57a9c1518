/* patience.c - when a case is given up.  What has been computed does not depend on it: it only says when to stop. */
#include "state/patience.h"

#include <math.h>
#include <time.h>

#include "numerics/tolerances.h"
#include "planemotion.h"

static double now(void)
{
    struct timespec t;
    return clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t) ? NAN : (double)t.tv_sec + (double)t.tv_nsec / 1e9;
}

void pm_patience_begin(pm_patience *p)
{
    p->limit = INFINITY;
    p->begun = NAN;
    p->span = p->left = 1;
    p->over = PM_OK;
}

void pm_patience_limit(pm_patience *p, double limit)
{
    p->limit = limit;
    if (isnan(p->begun) && limit < INFINITY) p->begun = p->last = now();
}

/* The clock is looked at more seldom as long as little time passes from one look to the next. */
static int is_spent(pm_patience *p)
{
    if (--p->left > 0) return 0;
    const double t = now();
    const int soon = t - p->last < PM_PATIENCE_BETWEEN;
    p->span = soon && p->span < PM_PATIENCE_QUESTIONS ? 2 * p->span : soon ? p->span : 1;
    p->left = p->span;
    p->last = t;
    return t - p->begun >= p->limit;
}

int pm_patience_ends(pm_patience *p)
{
    if (p->over) return p->over;
    if (pm_patience_is_stopped(p->stop))
        p->over = PM_CANCELLED;
    else if (p->limit < INFINITY && is_spent(p))
        p->over = PM_LIMIT_CPU;
    return p->over;
}
