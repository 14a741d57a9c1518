/* integral_series.c - integrals over the flights of a series that are not followed.
 *
 * Flights between the blows of a contact shrink by a ratio r, and each repeats the one before on a smaller scale.  What is integrated
 * goes to a value L at the end of the series; its mean over a flight is off that by d, which shrinks by a ratio of its own: by r for a
 * speed, by r^2 for a height, not at all for what depends on the direction alone.  After a last flight F the others add
 *   sum_k F r^k (L + d s^k) = L T + d F r s / (1 - r s),  T = F r / (1 - r),  s = d / d'
 * with d' of the flight before.  What s was one flight earlier tells how far the sum is known; where it is no ratio of what shrinks,
 * nothing is known of it but that d does not grow.  Where the value has no number at the end its means tell L.
 *
 * Where a contact has been closed before its series was over the sum takes the place of what was integrated with the contact closed, if
 * nothing else has happened in between: else, and where the run ends before, the difference is an error. */
#include "events/integral_series.h"

#include <math.h>
#include <string.h>

#include "events/ask.h"
#include "events/bounce_series.h"
#include "events/event.h"
#include "events/integral.h"
#include "events/percentile.h"
#include "expression/program.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/workspace.h"

static pm_integral_flights *flights_of(const pm_workspace *w, int contact, int ask)
{
    return w->ask->flights + (size_t)contact * w->model->nask + ask;
}

int pm_integral_series_create(pm_workspace *w)
{
    const int n = w->model->programs.integrals ? w->model->rows[PM_TABLE_CONTACT] * w->model->nask : 0;
    const pm_array array[] = {PM_ARRAY(w->ask->flights, n)};
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

void pm_integral_series_forget(const pm_workspace *w, int contact)
{
    for (int i = 0; i < w->model->nask && w->model->programs.integrals; i++) flights_of(w, contact, i)->n = 0;
}

/* The i-th ask that watches, if it is an integral, else PM_NONE. */
static int integral_of(const pm_workspace *w, int i)
{
    const int ask = w->ask->observer[i];
    return pm_model_ask_is_integral(PM_ASK_ROW(w->model, ask)) ? ask : PM_NONE;
}

void pm_integral_series_mark(const pm_workspace *w, int contact)
{
    for (int i = 0; i < w->ask->nobserver; i++) {
        const int ask = integral_of(w, i);
        if (ask == PM_NONE) continue;
        pm_integral_flights *x = flights_of(w, contact, ask);
        const pm_integral *sum = &w->ask->integral[ask];
        if (x->n > 0 && x->at[0].t == w->state.t) continue;
        memmove(x->at + 1, x->at, PM_INTEGRAL_FLIGHTS * sizeof *x->at);
        x->at[0] = (pm_integral_at){w->state.t, sum->sum, sum->weight};
        x->n += x->n <= PM_INTEGRAL_FLIGHTS;
        x->jumps = w->result.count[PM_COUNT_JUMPS];
    }
}

/* ---- the rest of a series ---- */
static double gathered(const pm_integral_at *x, int weight) { return weight ? x->weight : x->sum; }

/* What the mean over flight k, the last one first, is off the limit. */
static double off(const pm_integral_at *at, int k, int weight, double limit)
{
    return (gathered(at + k, weight) - gathered(at + k + 1, weight)) / (at[k].t - at[k + 1].t) - limit;
}

/* By what something shrinks; not a number if it does not. */
static double shrinks(double now, double before)
{
    const double s = now / before;
    return s >= 0 && s <= 1 + PM_SERIES_SETTLED ? fmin(s, 1) : NAN;
}

static double sum_of(double flight, double ratio, double off, double shrinks)
{
    return flight * off * ratio * shrinks / (1 - ratio * shrinks);
}

pm_integral_tail pm_integral_series_tail(const pm_integral_flights *x, int weight, double ratio, double time,
                                         double limit)
{
    double d[PM_INTEGRAL_FLIGHTS] = {0};
    if (x->n < 2) return (pm_integral_tail){NAN, INFINITY};
    for (int k = 0; k < x->n - 1; k++) d[k] = off(x->at, k, weight, isfinite(limit) ? limit : 0);
    if (!isfinite(limit)) return (pm_integral_tail){d[0] * time, time * fabs(d[0] - d[1])};
    const double flight = x->at[0].t - x->at[1].t;
    const double now = x->n > 2 ? shrinks(d[0], d[1]) : NAN, before = x->n > 3 ? shrinks(d[1], d[2]) : NAN;
    const double sum = sum_of(flight, ratio, d[0], isnan(now) ? ratio : now),
                 other = sum_of(flight, ratio, d[0], before), most = time * fabs(d[0]);
    return (pm_integral_tail){limit * time + sum, isnan(now + before) ? most : fmin(fabs(sum - other), most)};
}

/* ---- flights that are passed at once ---- */
/* So little of an integral is open: by its tolerance, and by what rounding does to the flights that tell it. */
static int is_clear(const pm_workspace *w, const pm_integral_tail *x, double size, double sum, double ratio)
{
    const double open = PM_INTEGRAL_ERROR * w->numbers.tolerance * w->state.t * size;
    return x->error <= fmax(open, PM_INTEGRAL_ROUNDING * fabs(sum) / (1 - ratio));
}

int pm_integral_series_is_clear(pm_workspace *w, int contact, int ask, double ratio, double time)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    const pm_integral_flights *x = flights_of(w, contact, ask);
    pm_integral *of = &w->ask->integral[ask];
    const double value = pm_program_run(w, e[PM_ASK_PROGRAM]),
                 holds = e[PM_ASK_PROGRAM_2] < 0 ? 1 : pm_program_run(w, e[PM_ASK_PROGRAM_2]);
    of->leap = pm_integral_series_tail(x, 0, ratio, time, pm_integral_is_squared(e) ? value * value : value);
    of->leap_weight = pm_integral_series_tail(x, 1, ratio, time, holds);
    return is_clear(w, &of->leap, of->size, of->terms, ratio) &&
           is_clear(w, &of->leap_weight, 1, of->weight, ratio);
}

static void add(pm_integral *of, pm_integral_tail sum, pm_integral_tail weight)
{
    of->sum += sum.value;
    of->error += sum.error;
    of->weight += weight.value;
    of->weight_error += weight.error;
}

void pm_integral_series_leap(pm_workspace *w, double time)
{
    for (int i = 0; i < w->ask->nobserver; i++) {
        const int ask = integral_of(w, i);
        if (ask == PM_NONE) continue;
        pm_integral *of = &w->ask->integral[ask];
        add(of, of->leap, of->leap_weight);
        of->span += time;
        if (pm_integral_is_percentile(PM_ASK_ROW(w->model, ask)) &&
            pm_percentile_pass(w, ask, of->leap.value / time, time))
            w->ask->undefined[ask] = 1;
    }
}

/* ---- contacts that are closed before their series is over ---- */
static double flight_of(const pm_integral_flights *x, int k) { return x->at[k].t - x->at[k + 1].t; }

/* The ratio is that of the last flights but for so much of it; infinite where they are too few, or do not fill the time. */
static double off_ratio(const pm_integral_flights *x, double ratio, double time)
{
    if (x->n <= PM_INTEGRAL_FLIGHTS) return INFINITY;
    const double all = flight_of(x, 0) * ratio / (1 - ratio);
    if (!(fabs(all - time) <= PM_SERIES_SETTLED * time)) return INFINITY;
    return fabs(flight_of(x, 0) / flight_of(x, 1) - flight_of(x, 1) / flight_of(x, 2)) /
           (ratio * (1 - ratio));
}

/* What was gathered since the last blow is that of a closed contact: what the flights of the series have in its place. */
static pm_integral_tail instead(const pm_workspace *w, const pm_integral_flights *x, int weight, double now,
                                double limit, double ratio)
{
    if (x->n < 2) return (pm_integral_tail){0, 0};
    const double time = w->state.t - x->at[0].t, all = time * fabs(off(x->at, 0, weight, limit));
    const pm_integral_tail tail = pm_integral_series_tail(x, weight, ratio, time, limit);
    const double change = tail.value - (now - gathered(x->at, weight)),
                 error = tail.error + off_ratio(x, ratio, time) * fabs(change);
    const int known = w->result.count[PM_COUNT_JUMPS] == x->jumps + 1;
    if (!known || !(error < all)) return (pm_integral_tail){0, isfinite(all) ? all : 0};
    return (pm_integral_tail){change, error};
}

static void end(const pm_workspace *w, int contact, double ratio)
{
    for (int i = 0; i < w->ask->nobserver; i++) {
        const int ask = integral_of(w, i);
        if (ask == PM_NONE) continue;
        pm_integral *of = &w->ask->integral[ask];
        const pm_integral_flights *x = flights_of(w, contact, ask);
        add(of, instead(w, x, 0, of->sum, of->last, ratio),
            instead(w, x, 1, of->weight, of->last_weight, ratio));
    }
}

/* Those that were closed together share what was gathered since. */
void pm_integral_series_end(const pm_workspace *w)
{
    double told = NAN;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        const pm_bounce_series *x = &w->event->series[i];
        if (x->over == -INFINITY || x->over > w->state.t || x->struck[0] == told) continue;
        end(w, i, x->ratio);
        told = x->struck[0];
    }
}

void pm_integral_series_break(const pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++)
        if (pm_bounce_series_goes_on(w, i)) end(w, i, 0);
}
