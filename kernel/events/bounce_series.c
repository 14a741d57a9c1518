/* bounce_series.c - the time that the bounces take which are too small to be computed.
 *
 * A contact that bounces is closed at a blow whose rebound is lost in rounding (last_bounce.c).  The bounces that are left
 * take a time all the same.  With blows at t1 < t2 < t3 < t4 the flights between them shrink by r = (t4 - t3) / (t3 - t2),
 * which for constant accelerations is its coefficient of restitution.  If the flights before had the same ratio, and nothing
 * else struck its bodies in between, the ones to come sum up to
 *   (t4 - t3) (r + r^2 + ...) = (t4 - t3) r / (1 - r).
 * Until then the contact is closed, which moves the bodies as the bounces do but for their height, and nothing that it
 * touches counts as being at rest: such a phase is computed in time.  Where the ratio has not settled it is taken as the last
 * one, and what would be left with r = e tells what is not known: a coarse run is off by that.  But where the flights shrink
 * far less than the speeds (r near 1: nothing presses what bounces) no end of the series is known: it never rests as far as
 * can be told, and its blows are not counted any more. */
#include "events/bounce_series.h"

#include <math.h>

#include "elements/contact.h"
#include "events/event.h"
#include "numerics/tolerances.h"
#include "scene/reference.h"
#include "state/workspace.h"

void pm_bounce_series_begin(const pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++)
        w->event->series[i] = (pm_bounce_series){.over = -INFINITY};
}

static int touches(const pm_model *m, int contact, int body)
{
    int of[PM_REFERENCES];
    const int n = pm_reference_bodies(m, PM_TABLE_CONTACT, contact, of);
    for (int i = 0; i < n; i++)
        if (of[i] == body) return 1;
    return 0;
}

/* A blow on one of its bodies ends the series of another contact: what bounces there bounces otherwise from now on. */
static void disturb_others(const pm_workspace *w, int contact)
{
    int of[PM_REFERENCES];
    const int n = pm_reference_bodies(w->model, PM_TABLE_CONTACT, contact, of);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++)
        for (int k = 0; k < n && i != contact && w->event->series[i].known > 0; k++)
            if (of[k] != PM_GROUND && touches(w->model, i, of[k])) w->event->series[i].known = 0;
}

void pm_bounce_series_strike(const pm_workspace *w, int contact)
{
    pm_bounce_series *x = &w->event->series[contact];
    const double e = pm_contact_restitution(&w->frame, contact);
    if (!(e > 0 && e < 1)) return;
    disturb_others(w, contact);
    x->over = -INFINITY;
    for (int i = 3; i > 0; i--) x->struck[i] = x->struck[i - 1];
    x->struck[0] = w->state.t;
    x->known += x->known < 4;
}

static int is_closed(const pm_workspace *w, int contact)
{
    const int first = w->model->contact_slot[contact];
    for (int i = first; i < first + pm_contact_slots(w->model, contact); i++)
        if (w->state.slot[i].mode != PM_OPEN && w->state.slot[i].mode != PM_CAPTURED) return 1;
    return 0;
}

static double flight(const pm_bounce_series *x, int i) { return x->struck[i] - x->struck[i + 1]; }

/* How far the ratios of its last flights are apart. */
static double off(const pm_bounce_series *x)
{
    return fabs(flight(x, 0) / flight(x, 1) - flight(x, 1) / flight(x, 2));
}

/* The ratio of its last flights, if those before had the same; 0 if not. */
static double ratio_of(const pm_bounce_series *x)
{
    if (x->known < 4) return 0;
    const double ratio = flight(x, 0) / flight(x, 1);
    return ratio < 1 - PM_SERIES_SETTLED && off(x) < PM_SERIES_SETTLED * ratio * (1 - ratio) ? ratio : 0;
}

/* Its flights hardly shrink, and not by a ratio that is known. */
int pm_bounce_series_is_endless(const pm_workspace *w, int contact)
{
    const pm_bounce_series *x = &w->event->series[contact];
    if (x->known < 3 || ratio_of(x) > 0) return 0;
    const double e = pm_contact_restitution(&w->frame, contact);
    return flight(x, 1) - flight(x, 0) < PM_SERIES_SHRINKS * (1 - e) * flight(x, 1);
}

int pm_bounce_series_is_settled(const pm_workspace *w, int contact)
{
    return ratio_of(&w->event->series[contact]) > 0;
}

static double sum(double flight, double ratio) { return flight * ratio / (1 - ratio); }

/* The time that the flights to come take, and what is not known of it.  Where the ratio has not settled it is on its way to e;
 * of one flight alone nothing tells the ratio. */
static double left(const pm_workspace *w, int contact, double *unknown)
{
    const pm_bounce_series *x = &w->event->series[contact];
    const double e = pm_contact_restitution(&w->frame, contact), settled = ratio_of(x);
    *unknown = 0;
    if (x->known < 2) return 0;
    const double last = flight(x, 0);
    if (settled > 0) {
        *unknown = last * off(x) / ((1 - settled) * (1 - settled));
        return sum(last, settled);
    }
    const double longest = x->known > 2 ? sum(last, fmax(e, last / flight(x, 1))) : sum(last, e) + last;
    *unknown = longest - sum(last, e);
    return longest;
}

/* A coarse run shows what is not known. */
void pm_bounce_series_cut(const pm_workspace *w)
{
    const int waits = PM_SETTING(w->model, PM_SETTING_ROUTE) != PM_ROUTE_PATH;
    for (int i = 0; waits && i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        pm_bounce_series *x = &w->event->series[i];
        double unknown;
        if (x->known == 0 || x->struck[0] != w->state.t || !is_closed(w, i)) continue;
        const double time = left(w, i, &unknown) + (w->numbers.coarse > 1 ? PM_BOUNCE_EARLIER * unknown : 0);
        x->over = pm_bounce_series_is_endless(w, i) ? INFINITY : time > 0 ? w->state.t + time : -INFINITY;
    }
}

double pm_bounce_series_next(const pm_workspace *w)
{
    double next = INFINITY;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        const double over = w->event->series[i].over;
        if (over > w->state.t) next = fmin(next, over);
    }
    return next;
}

int pm_bounce_series_end(pm_workspace *w)
{
    int any = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        pm_bounce_series *x = &w->event->series[i];
        if (x->over == -INFINITY || x->over > w->state.t) continue;
        w->firing.jumped = x->over; /* by its last bounce */
        x->over = -INFINITY;
        any = 1;
    }
    return any;
}

static int is_going_on(const pm_workspace *w, int contact)
{
    const double over = w->event->series[contact].over;
    return over > w->state.t && (over < INFINITY || is_closed(w, contact));
}

int pm_bounce_series_moves(const pm_workspace *w, int body)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++)
        if (is_going_on(w, i) && (body == PM_NONE || touches(w->model, i, body))) return 1;
    return 0;
}

int pm_bounce_series_check(pm_workspace *w)
{
    if (pm_bounce_series_next(w) < INFINITY) return PM_OK;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        const pm_bounce_series *x = &w->event->series[i];
        if (is_going_on(w, i))
            return pm_fail(&w->result, PM_BOUNCES_ON, PM_TABLE_CONTACT, i, flight(x, 0), flight(x, 1));
    }
    return PM_OK;
}
