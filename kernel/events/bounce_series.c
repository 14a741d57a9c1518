/* bounce_series.c - how long the bounces last that are too small to be computed.
 *
 * A contact that bounces is closed at a blow whose rebound is lost in rounding (last_bounce.c).  The bounces that are left
 * take a time all the same.  One contact alone, or several that share bodies, are struck in an order that comes again after
 * k blows: the feet of a crate that clatters, or rocks.  Small bounces are alike but for their size, so the flights of each
 * cycle shrink by one ratio, the contraction of the map from cycle to cycle:
 *   r = S / S',  S the sum of the last k flights, S' of the k before
 * (for k = 1 and constant accelerations the coefficient of restitution).  It is known when each flight of the last cycle, and
 * one before it, has that ratio to the one k earlier, and the order is the same.  The flights to come then sum up to
 *   S (r + r^2 + ...) = S r / (1 - r).
 * Until then the contacts are closed, which moves the bodies as the bounces do but for their height, and nothing that they
 * touch counts as being at rest: such a phase is computed in time.  Where the gaps of such an order are too small for their
 * ratio to settle, the end is expected by the ratio of the last cycles, in a coarse run by that of the cycles before.  What
 * bounces alone and has not settled is taken to go on by its last ratio; what would be left with r = e tells what is not known,
 * and a coarse run is off by that.  But where its flights shrink far less than the speeds (r near 1: nothing presses what
 * bounces) no end of the series is known: the body is not called at rest, and its blows are no longer counted.  The series of
 * several contacts without an order ends where it is cut off; a coarse run cuts it off earlier, and the difference is the error
 * of that. */
#include "events/bounce_series.h"

#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "elements/trigger.h"
#include "events/blow_order.h"
#include "events/event.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "scene/reference.h"
#include "state/arena.h"
#include "state/workspace.h"

/* ---- whom a contact touches ---- */
static void list_bodies(const pm_model *m, int contact, int *body)
{
    int of[PM_REFERENCES];
    const int n = pm_reference_bodies(m, PM_TABLE_CONTACT, contact, of);
    for (int k = 0; k < n; k++)
        if (of[k] != PM_GROUND) *body++ = of[k];
    *body = PM_NONE;
}

int pm_bounce_series_create(pm_workspace *w)
{
    pm_event_set *e = w->event;
    const int n = w->model->rows[PM_TABLE_CONTACT];
    const pm_array array[] = {
        PM_ARRAY(e->series, n),        PM_ARRAY(e->body, (PM_REFERENCES + 1) * n),
        PM_ARRAY(e->beside_struck, n), PM_ARRAY(e->ordered, n),
        PM_ARRAY(e->next, n),          PM_ARRAY(e->order.beside, n),
    };
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    for (int i = 0; i < n && !status; i++) list_bodies(w->model, i, e->body + (PM_REFERENCES + 1) * i);
    return status;
}

static const int *bodies_of(const pm_event_set *e, int contact)
{
    return e->body + (PM_REFERENCES + 1) * contact;
}

static int touches(const pm_event_set *e, int contact, int body)
{
    for (const int *of = bodies_of(e, contact); *of != PM_NONE; of++)
        if (*of == body) return 1;
    return 0;
}

static int share_body(const pm_event_set *e, int contact, int other)
{
    for (const int *of = bodies_of(e, contact); *of != PM_NONE; of++)
        if (touches(e, other, *of)) return 1;
    return 0;
}

/* ---- blows ---- */
void pm_bounce_series_forget(const pm_workspace *w, int contact)
{
    w->event->series[contact] = (pm_bounce_series){.over = -INFINITY, .expected = -INFINITY};
    w->event->order.n = 0;
}

void pm_bounce_series_begin(const pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) pm_bounce_series_forget(w, i);
}

/* The contacts that were struck and share a body with this one, itself among them. */
static int find_near(const pm_workspace *w, int contact)
{
    int near = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++)
        if (i == contact || (w->event->series[i].known > 0 && share_body(w->event, contact, i)))
            w->event->beside_struck[near++] = i;
    return near;
}

/* ---- the order of blows ---- */
/* By how much flights may be off a ratio that has settled, as a part of the flight before.  What they are off shrinks from cycle
 * to cycle as they do, so that a coarse run takes a ratio as settled some cycles earlier. */
static double may_be_off(const pm_workspace *w, double ratio)
{
    const double earlier = w->numbers.coarse > 1 ? PM_BOUNCE_EARLIER / ratio : 1;
    return fmin(earlier * PM_SERIES_SETTLED, PM_SERIES_NEARLY) * ratio * (1 - ratio);
}

/* The ratio of the last cycle to the one before, if each flight, and one before them, has it and the order is the same; else 0. */
static double ratio_of_cycles(const pm_workspace *w, const pm_blows *x, int k)
{
    if (x->contact[0] != x->contact[k]) return 0;
    const double before = x->time[k] - x->time[2 * k], ratio = (x->time[0] - x->time[k]) / before;
    if (!(ratio > 0 && ratio < 1 - PM_SERIES_SETTLED) || !pm_blows_come_again(x, k, k + 1)) return 0;
    const int last = pm_blows_last_looked_at(x, k);
    if (last + k + 1 >= x->n || !pm_blows_come_again(x, k, last + 1)) return 0;
    const double share = may_be_off(w, ratio);
    for (int i = 0; i <= last; i++)
        if (!(fabs(pm_blows_flight(x, i) - ratio * pm_blows_flight(x, i + k)) <
              share * fmax(pm_blows_flight(x, i + k), before / k)))
            return 0;
    return ratio;
}

static int is_in_cycle(const pm_blows *x, int k, int contact)
{
    for (int i = 0; i < k; i++)
        if (x->contact[i] == contact) return 1;
    return 0;
}

static int several(const pm_blows *x, int k)
{
    for (int i = 1; i < k; i++)
        if (x->contact[i] != x->contact[0]) return 1;
    return 0;
}

/* What one cycle tells of all that are struck in it; a blow out of its order ends what was known of the others: what bounces there
 * bounces otherwise from now on. */
static void tell(const pm_event_set *e, int near, const pm_blows *x, int k, double ratio)
{
    for (int i = 0; i < near; i++) {
        pm_bounce_series *s = &e->series[e->beside_struck[i]];
        s->ratio = is_in_cycle(x, k, e->beside_struck[i]) ? ratio : 0;
        s->several = several(x, k);
        s->known_at = x->time[0];
        s->left = (x->time[0] - x->time[k]) * ratio / (1 - ratio);
    }
}

/* Where the order comes again and the ratio has nearly settled: the end by that ratio, in a coarse run by the one before,
 * which shows how far it is known.  -INFINITY if not. */
static double end_by_cycles(const pm_workspace *w, const pm_blows *x, int k)
{
    if (x->n < 3 * k + 1 || !pm_blows_come_again(x, k, 2 * k)) return -INFINITY;
    const double last = x->time[0] - x->time[k], before = x->time[k] - x->time[2 * k];
    const double ratio = last / before, earlier = before / (x->time[2 * k] - x->time[3 * k]);
    if (!(ratio > 0 && fmax(ratio, earlier) < 1 &&
          fabs(ratio - earlier) < PM_SERIES_NEARLY * ratio * (1 - ratio)))
        return -INFINITY;
    const double used = w->numbers.coarse > 1 ? earlier : ratio;
    return x->time[0] + last * used / (1 - used);
}

/* What touches now may only seem to: the blows before this instant tell. */
static double expect_end(const pm_workspace *w, const pm_blow_order *all)
{
    int now = 0;
    while (now < all->n && all->time[now] == w->state.t) now++;
    const pm_blows x = {all->n - now, all->contact + now, all->time + now};
    double end = -INFINITY;
    for (int k = 2; end == -INFINITY && k <= PM_SERIES_EXPECTED && 3 * k + 1 <= x.n; k++)
        end = end_by_cycles(w, &x, k);
    return end;
}

/* Its blows one after the other, with none at another contact of its bodies. */
static void count_own(const pm_workspace *w, int near, int contact)
{
    const double e = pm_contact_restitution(&w->frame, contact);
    for (int i = 0; i < near; i++)
        if (w->event->beside_struck[i] != contact) w->event->series[w->event->beside_struck[i]].own = 0;
    pm_bounce_series *x = &w->event->series[contact];
    x->own = e > 0 && e < 1 ? x->own + (x->own < 4) : 0;
}

/* As many as tell of cycles of k blows; more where blows of one instant have no flight between them. */
static pm_blows blows_of(pm_event_set *e, int near, int k)
{
    pm_blows x = {e->order.n, e->order.contact, e->order.time};
    if (pm_blows_flight(&x, k) == 0 && pm_blow_order_has(e, near, 3 * k + 1)) x.n = e->order.n;
    return x;
}

static void look_for_cycles(const pm_workspace *w, int near, int contact)
{
    pm_event_set *e = w->event;
    double ratio = 0;
    pm_blow_order_put(e, near, contact);
    for (int k = 1; ratio == 0 && k <= PM_SERIES_LONGEST && pm_blow_order_has(e, near, 2 * k + 2); k++) {
        const pm_blows x = blows_of(e, near, k);
        ratio = ratio_of_cycles(w, &x, k);
        if (ratio > 0) tell(e, near, &x, k, ratio);
    }
    for (int i = 0; i < near && ratio == 0; i++) e->series[e->beside_struck[i]].ratio = 0;
    e->series[contact].expected = ratio > 0 ? -INFINITY : expect_end(w, &e->order);
}

void pm_bounce_series_press(const pm_workspace *w, int contact)
{
    pm_bounce_series *x = &w->event->series[contact];
    if (x->over == INFINITY) x->over = -INFINITY;
}

void pm_bounce_series_strike(const pm_workspace *w, int contact, double approach)
{
    pm_bounce_series *x = &w->event->series[contact];
    if (x->known > 0 && x->struck[0] == w->state.t) return;
    memmove(x->struck + 1, x->struck, (PM_SERIES_BLOWS - 1) * sizeof *x->struck);
    x->struck[0] = w->state.t;
    x->approach[1] = x->approach[0];
    x->approach[0] = approach;
    x->known += x->known < PM_SERIES_BLOWS;
    x->ends = 0;
    pm_bounce_series_press(w, contact);
    const int near = find_near(w, contact);
    count_own(w, near, contact);
    if (!(x->over > w->state.t))
        look_for_cycles(w, near, contact);
    else
        w->event->order.n = 0; /* it lacks this one */
}

int pm_bounce_series_is_settled(const pm_workspace *w, int contact)
{
    return w->event->series[contact].ratio > 0;
}

int pm_bounce_series_is_of_several(const pm_workspace *w, int contact)
{
    return pm_bounce_series_is_settled(w, contact) && w->event->series[contact].several;
}

int pm_bounce_series_share(const pm_workspace *w, int contact, int other)
{
    const pm_bounce_series *x = &w->event->series[contact], *y = &w->event->series[other];
    return x->ratio > 0 && y->ratio == x->ratio && y->known_at == x->known_at;
}

/* ---- one that bounces alone ---- */
static double own_flight(const pm_bounce_series *x, int i) { return x->struck[i] - x->struck[i + 1]; }

/* How far the ratios of its last flights are apart. */
static double off(const pm_bounce_series *x)
{
    return fabs(own_flight(x, 0) / own_flight(x, 1) - own_flight(x, 1) / own_flight(x, 2));
}

/* From blow to blow its speed shrinks by e, or by less where it gains some in flight: as the bodies still slip. */
static double slower(const pm_workspace *w, int contact)
{
    const pm_bounce_series *x = &w->event->series[contact];
    const double e = pm_contact_restitution(&w->frame, contact), ratio = x->approach[0] / x->approach[1];
    return 1 - fmin(fmax(e, ratio), 1);
}

/* Its flights hardly shrink though its speeds do, and not by a ratio that is known. */
int pm_bounce_series_is_endless(const pm_workspace *w, int contact)
{
    const pm_bounce_series *x = &w->event->series[contact];
    if (x->own < 3 || x->ratio > 0) return 0;
    return own_flight(x, 1) - own_flight(x, 0) < PM_SERIES_SHRINKS * slower(w, contact) * own_flight(x, 1);
}

static double sum(double flight, double ratio) { return flight * ratio / (1 - ratio); }

/* The time that its flights to come take, and what is not known of it.  Where the ratio has not settled it is on its way to e;
 * of one flight alone nothing tells the ratio. */
static double left_alone(const pm_workspace *w, int contact, double *unknown)
{
    const pm_bounce_series *x = &w->event->series[contact];
    const double e = pm_contact_restitution(&w->frame, contact);
    *unknown = 0;
    if (x->own < 2) return 0;
    const double last = own_flight(x, 0);
    if (x->ratio > 0) {
        *unknown = x->own < 4 ? 0 : last * off(x) / ((1 - x->ratio) * (1 - x->ratio));
        return sum(last, x->ratio);
    }
    const double longest = x->own > 2 ? sum(last, fmax(e, last / own_flight(x, 1))) : sum(last, e) + last;
    *unknown = longest - sum(last, e);
    return longest;
}

/* A coarse run shows what is not known. */
static double end_alone(const pm_workspace *w, int contact)
{
    double unknown;
    const double left = left_alone(w, contact, &unknown);
    const double time = left + (w->numbers.coarse > 1 ? PM_BOUNCE_EARLIER * unknown : 0);
    if (pm_bounce_series_is_endless(w, contact)) return INFINITY;
    return time > 0 ? w->state.t + time : -INFINITY;
}

/* ---- its end ---- */
void pm_bounce_series_hold(const pm_workspace *w, int contact) { w->event->series[contact].ends = 1; }

static int is_closed(const pm_workspace *w, int contact)
{
    const int first = w->model->contact_slot[contact];
    for (int i = first; i < first + pm_contact_slots(w->model, contact); i++)
        if (w->state.slot[i].mode != PM_OPEN && w->state.slot[i].mode != PM_CAPTURED) return 1;
    return 0;
}

int pm_bounce_series_ends_beside(const pm_workspace *w, int contact)
{
    const pm_bounce_series *x = w->event->series;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++)
        if (x[i].ends && x[i].struck[0] == w->state.t && share_body(w->event, contact, i)) return 1;
    return 0;
}

/* Of all that share the order: they have been closed together, and each would be struck without end. */
static void cut(pm_workspace *w, int contact)
{
    const pm_bounce_series *x = &w->event->series[contact];
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        if (!pm_bounce_series_share(w, contact, i)) continue;
        w->event->series[i].over = x->known_at + x->left;
        pm_trigger_lose_strikes(w, i, PM_COUNTLESS);
    }
}

void pm_bounce_series_cut(pm_workspace *w)
{
    const int waits = PM_SETTING(w->model, PM_SETTING_ROUTE) != PM_ROUTE_PATH;
    for (int i = 0; waits && i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        pm_bounce_series *x = &w->event->series[i];
        if (!x->ends || x->struck[0] != w->state.t || !is_closed(w, i)) continue;
        if (x->ratio > 0 && x->several && x->known_at == w->state.t)
            cut(w, i);
        else if (x->own > 1)
            x->over = end_alone(w, i);
        else if (x->ratio == 0 && x->expected > w->state.t)
            x->over = x->expected;
    }
}

double pm_bounce_series_next(const pm_workspace *w)
{
    double next = INFINITY;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        const double over = w->event->series[i].over;
        if (over > w->state.t) next = pm_min(over, next);
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
        x->ratio = x->known = x->own = 0;
        w->event->order.n = 0;
        any = 1;
    }
    return any;
}

int pm_bounce_series_goes_on(const pm_workspace *w, int contact)
{
    const double over = w->event->series[contact].over;
    return over > w->state.t && (over < INFINITY || is_closed(w, contact));
}

int pm_bounce_series_moves(const pm_workspace *w, int body)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++)
        if (pm_bounce_series_goes_on(w, i) && (body == PM_NONE || touches(w->event, i, body))) return 1;
    return 0;
}

int pm_bounce_series_check(pm_workspace *w)
{
    if (pm_bounce_series_next(w) < INFINITY) return PM_OK;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        const pm_bounce_series *x = &w->event->series[i];
        if (pm_bounce_series_goes_on(w, i))
            return pm_fail(&w->result, PM_BOUNCES_ON, PM_TABLE_CONTACT, i, own_flight(x, 0),
                           own_flight(x, 1));
    }
    return PM_OK;
}
