/* shown.c - compares the samples of a program with its enclosures. */
#include "events/shown.h"

#include <math.h>

#include "numerics/tolerances.h"

static double second_difference(const pm_jet *x)
{
    return fabs(x[-1].value.lo - 2 * x[0].value.lo + x[1].value.lo);
}

/* The greatest one by sample k, or that by the rates there: the bend may be zero on average where one of the two is taken. */
static double differences(const pm_jet *sample, int k, double apart)
{
    const int last = PM_SHOWN_SAMPLES - 1;
    double most = 0;
    for (int j = k < 2 ? 1 : k - 1; j <= k + 1 && j < last; j++)
        most = fmax(second_difference(sample + j), most);
    for (int j = k > 0 ? k - 1 : 0; j <= k && j < last; j++)
        most = fmax(apart * fabs(sample[j + 1].rate.lo - sample[j].rate.lo), most);
    return most;
}

/* The bends at the samples, by the squared distance of these, are about the second differences of the values: not so where a
 * sample falls by chance into a pulse that is narrower than their distance. */
static int are_dense(const pm_jet *sample, double apart, double nothing)
{
    for (int k = 0; k < PM_SHOWN_SAMPLES; k++) {
        const double most = differences(sample, k, apart);
        const double bend = pm_interval_size(sample[k].bend); /* not bounded where a root begins */
        if (isfinite(bend) && bend * apart * apart > PM_TIME_DENSE * most + nothing) return 0;
    }
    return 1;
}

/* ---- how great it becomes ---- */
typedef struct pm_stretch {
    double from, to, most; /* of its size there: no more */
} pm_stretch;

static pm_stretch part_of(const pm_shown *x, double from, double to)
{
    return (pm_stretch){from, to, pm_interval_size(x->enclose(x, from, to).jet.value)};
}

static int greatest_of(const pm_stretch *part, int n)
{
    int k = 0;
    for (int i = 1; i < n; i++)
        if (!(part[i].most <= part[k].most)) k = i;
    return k;
}

/* The greatest size that it has in the stretch, but for a factor: the part with the greatest bound is halved until that is near
 * to a value.  (Over a wide part 1 / (e^x + e^-x) has a bound out of all proportion.) */
static void take_size(const pm_shown *x, double from, double to, double known)
{
    pm_stretch part[PM_TIME_PARTS];
    int n = 1;
    *x->size = fmax(*x->size, known);
    part[0] = part_of(x, from, to);
    for (int k = 0; n < PM_TIME_PARTS; k = greatest_of(part, n)) {
        if (part[k].most <= PM_SHOWN_SIZE * *x->size) break;
        const double middle = 0.5 * (part[k].from + part[k].to), end = part[k].to;
        *x->size = fmax(*x->size, pm_interval_size(x->enclose(x, middle, middle).jet.value));
        part[k] = part_of(x, part[k].from, middle);
        part[n++] = part_of(x, middle, end);
    }
}

/* ---- samples ---- */
/* The bends at the samples, widened by what changes nothing; 0: the samples are too far from each other to show anything. */
static int sampled_bends(const pm_shown *x, double from, double to, pm_interval *bends)
{
    pm_jet sample[PM_SHOWN_SAMPLES];
    pm_interval seen = {INFINITY, -INFINITY};
    const double h = to - from;
    double known = 0;
    for (int k = 0; k < PM_SHOWN_SAMPLES; k++) {
        const double t = from + h * k / (PM_SHOWN_SAMPLES - 1);
        sample[k] = x->enclose(x, t, t).jet;
        seen = pm_interval_hull(seen, sample[k].bend);
        const double value = pm_interval_size(sample[k].value);
        if (isfinite(value)) known = fmax(known, value);
    }
    take_size(x, from, to, known);
    const double nothing = x->w->numbers.tolerance * *x->size;
    *bends = pm_enclosure_sampled_bends(seen, nothing / (h * h));
    return are_dense(sample, h / (PM_SHOWN_SAMPLES - 1), nothing);
}

/* Whether the program stays within its bends over a part of the stretch, by series of high order: where intervals tell too
 * little. */
static int stays_by_series(const pm_shown *x, pm_interval bends, double from, double to)
{
    const pm_workspace *w = x->w;
    return x->along &&
           pm_interval_inside(
               pm_enclosure_bends_along(w->model, x->program, w->numbers.folded, x->along, from, to), bends);
}

/* The same by either, part by part. */
static int stays(const pm_shown *x, pm_interval bends, double from, double to, int *budget)
{
    const double middle = 0.5 * (from + to);
    if (pm_interval_inside(x->enclose(x, from, to).jet.bend, bends)) return 1;
    if (stays_by_series(x, bends, from, to)) return 1;
    if (--*budget < 0 || !pm_interval_inside(x->enclose(x, middle, middle).jet.bend, bends)) return 0;
    return stays(x, bends, from, middle, budget) && stays(x, bends, middle, to, budget);
}

int pm_shown_between(const pm_shown *x, double from, double to)
{
    const double h = (to - from) / (PM_SHOWN_SAMPLES - 1);
    pm_interval bends;
    int budget = PM_TIME_PARTS;
    if (!sampled_bends(x, from, to, &bends)) return 0;
    if (stays_by_series(x, bends, from, to)) return 1; /* often at once */
    for (int k = 0; k + 1 < PM_SHOWN_SAMPLES; k++)
        if (!stays(x, bends, from + h * k, from + h * (k + 1), &budget)) return 0;
    return 1;
}
