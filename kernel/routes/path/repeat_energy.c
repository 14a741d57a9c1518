/* repeat_energy.c - from segment to segment, the kinetic energy.
 *
 *   T_end = T + W,    T_next = m T_end      W the work on the segment, m the ratio of the blow: neither depends on the speed
 *   n segments on:    m^n T + (m + m^2 + ... + m^n) W
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

/* ---- over the barrier ---- */
/* m^n - 1, and m + m^2 + ... + m^n, exactly where m is near to 1, too. */
typedef struct pm_powers {
    double rise, sum;
} pm_powers;

static pm_powers powers(double m, int64_t n)
{
    const double rise = n == 0 ? 0 : expm1((double)n * log(m));
    return (pm_powers){rise, m == 1 ? (double)n : m * rise / (m - 1)};
}

/* T + (m^n - 1) T + (m + ... + m^n) W, n segments after the one that begins with T = begin. */
static double kinetic_by(const pm_repeat *l, double begin, const pm_powers *x)
{
    return begin + (x->rise * begin + x->sum * l->work);
}

static double kinetic_after(const pm_repeat *l, double begin, int64_t n)
{
    const pm_powers x = powers(l->ratio, n);
    return kinetic_by(l, begin, &x);
}

/* T only rises or only falls from segment to segment.  It reaches `level` after n of them, (m^n - 1) (T' - T) = (level - T) (m - 1)
 * with T' that of the second; `most` if that takes longer, or if T moves away from it. */
static int64_t until(const pm_repeat *l, double begin, double level, int64_t most)
{
    const double step = begin * (l->ratio - 1) + l->ratio * l->work, way = level - begin,
                 n = l->ratio == 1 ? way / step : log1p(way * (l->ratio - 1) / step) / log(l->ratio);
    return n >= 0 && n < (double)most ? (int64_t)n : most;
}

/* A segment may be passed over if its T is above `least` and has not reached `unsure`, that of the one which is not sure. */
typedef struct pm_bound {
    double begin, least, unsure;
} pm_bound;

static int is_over(const pm_bound *b, double kinetic) { return kinetic > b->least; }

static int is_sure(const pm_bound *b, double kinetic)
{
    return is_over(b, kinetic) && (isnan(b->unsure) || (kinetic - b->unsure) * (b->begin - b->unsure) > 0);
}

/* How many of `most` may be passed over: each of them needs a next one that may be, too.  That number is known but for rounding, and
 * is looked for around there. */
static int64_t sure_of(const pm_repeat *l, const pm_bound *b, int64_t most)
{
    int64_t low = 0, high = most + 1, n = until(l, b->begin, b->least, most);
    if (!isnan(b->unsure)) n = until(l, b->begin, b->unsure, n);
    for (int64_t further = 1; high - low > 1; further *= 2) {
        if (!(n > low && n < high)) n = low + (high - low) / 2;
        if (is_sure(b, kinetic_after(l, b->begin, n)))
            n = (low = n) + further;
        else
            n = (high = n) - further;
    }
    return low;
}

/* 1 + 2 m + ... + n m^(n-1) */
static double weighted(double m, double n, const pm_powers *x)
{
    if (n * fabs(1 - m) < PM_REPEAT_ALIKE) return n * (n + 1) / 2;
    return (x->rise / (m - 1) - n * (1 + x->rise)) / (1 - m);
}

/* `error` of T, carried on by n segments, with their roundings: the sum of m^(n-1-k) (T_end + T_next). */
static double error_by(const pm_repeat *l, double begin, double n, const pm_powers *x, double error)
{
    const double m = l->ratio, last = n * (1 + x->rise) / m;
    return (1 + x->rise) * error +
           PM_ENERGY_ROUNDINGS * (1 + m) * (last * begin + weighted(m, n, x) * l->work);
}

pm_repeats pm_repeat_energy_over_barrier(const pm_repeat *l, double begin, int64_t most, double error)
{
    const double depth = pm_repeat_energy_depth(l), near = PM_REPEAT_BARRIER * fmax(l->kinetic, fabs(depth));
    const pm_bound bound = {begin, depth + near, l->unsure};
    pm_repeats c = {.kinetic = begin, .error = error};
    if (!is_over(&bound, begin)) return c;
    if (most > PM_MOST_REPEATS) most = PM_MOST_REPEATS;
    c.n = sure_of(l, &bound, most);
    const double n = (double)c.n;
    const pm_powers x = powers(l->ratio, c.n);
    c.kinetic = kinetic_by(l, begin, &x);
    c.lost = (n - x.sum) * l->work - x.rise * begin;
    c.error = error_by(l, begin, n, &x, error);
    c.is_last = c.n < most && !is_over(&bound, kinetic_after(l, begin, c.n + 1));
    return c;
}
