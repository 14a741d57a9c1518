/* blow_order.c - the last blows of several contacts in the order of their times.
 *
 * Each contact keeps the times of its own (event.h): they are merged, the latest first, as far as somebody looks.  As long as blows
 * are of the same contacts the order is kept, and the next blow is put before it. */
#include "events/blow_order.h"

#include <math.h>
#include <string.h>

/* The latest blow of a contact that is not in its order yet; -INFINITY: there is none. */
static double next_of(const pm_event_set *e, int i)
{
    const pm_bounce_series *s = &e->series[e->beside_struck[i]];
    return e->ordered[i] < s->known ? s->struck[e->ordered[i]] : -INFINITY;
}

/* Those of one instant are entered in the order of the contacts: the latest is the last of them. */
static int append_latest(pm_event_set *e, int near)
{
    pm_blow_order *x = &e->order;
    int latest = 0;
    for (int i = 1; i < near; i++)
        if (e->next[i] >= e->next[latest]) latest = i;
    if (e->next[latest] == -INFINITY) return 0;
    x->contact[x->n] = e->beside_struck[latest];
    x->time[x->n++] = e->next[latest];
    e->ordered[latest]++;
    e->next[latest] = next_of(e, latest);
    return 1;
}

int pm_blow_order_has(pm_event_set *e, int near, int n)
{
    while (e->order.n < n && append_latest(e, near)) continue;
    return e->order.n >= n;
}

static void put_next(pm_event_set *e, int i, int ordered)
{
    e->ordered[i] = ordered;
    e->next[i] = next_of(e, i);
}

static int place_beside(const pm_event_set *e, int contact)
{
    int i = 0;
    while (e->beside_struck[i] != contact) i++;
    return i;
}

/* The last blow, of this contact, is put before those that are in order already, if they are of the same contacts. */
static int goes_before(pm_event_set *e, int near, int contact)
{
    pm_blow_order *x = &e->order;
    const double now = e->series[contact].struck[0];
    if (x->n == 0 || x->near != near || !(now > x->time[0]) ||
        memcmp(x->beside, e->beside_struck, (size_t)near * sizeof(int)) != 0)
        return 0;
    const int place = place_beside(e, contact), last = place_beside(e, x->contact[x->n - 1]);
    const int full = x->n == PM_SERIES_BLOWS;
    x->n -= full;
    memmove(x->time + 1, x->time, (size_t)x->n * sizeof *x->time);
    memmove(x->contact + 1, x->contact, (size_t)x->n * sizeof *x->contact);
    x->time[0] = now;
    x->contact[0] = contact;
    x->n++;
    put_next(e, place, e->ordered[place] + 1);
    if (full) put_next(e, last, e->ordered[last] - 1);
    return 1;
}

static void begin_order(pm_event_set *e, int near)
{
    e->order.n = 0;
    e->order.near = near;
    memcpy(e->order.beside, e->beside_struck, (size_t)near * sizeof(int));
    for (int i = 0; i < near; i++) put_next(e, i, 0);
}

void pm_blow_order_put(pm_event_set *e, int near, int contact)
{
    if (!goes_before(e, near, contact)) begin_order(e, near);
}

int pm_blows_come_again(const pm_blows *x, int k, int n)
{
    for (int i = 0; i < n; i++)
        if (x->contact[i] != x->contact[i + k]) return 0;
    return 1;
}

/* Between blows of one instant there is no flight: it tells nothing. */
int pm_blows_last_looked_at(const pm_blows *x, int k)
{
    int i = k;
    while (i + k + 1 < x->n && pm_blows_flight(x, i) == 0 && pm_blows_flight(x, i + k) == 0) i++;
    return i;
}
