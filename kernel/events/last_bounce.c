/* last_bounce.c - which rebound is the last.
 *
 * A contact with restitution e < 1 bounces infinitely often in a finite time.  The height of a bounce goes by its speed
 * squared, h = v^2 / 2g: it is lost in the rounding of positions, which goes by how far the scene reaches, while v is far from
 * rounding.  So slower rebounds than v ~ sqrt(reach / size) are the last, unless the route knows positions better. Bodies on
 * several contacts rock from one to the other in the same way, even without restitution: a contact that would part so slowly
 * because another one was struck is held closed.  Where several are struck in an order that repeats, the last blow of one is
 * the last of all: by then every gap is within rounding. */
#include "events/last_bounce.h"

#include <math.h>

#include "elements/contact.h"
#include "equations/case.h"
#include "events/bounce_series.h"
#include "events/event.h"
#include "numerics/tolerances.h"
#include "state/route.h"
#include "state/workspace.h"

/* A speed of which the bounce is too low, as a share of the scene's speed; a coarse run cuts a series of blows off earlier, which
 * shows what that loses. */
static double cut_speed(const pm_workspace *w, double share)
{
    return (w->numbers.coarse > 1 ? PM_BOUNCE_EARLIER : 1) * share * w->numbers.speed;
}

/* Of the scene's speed, what is lost where places are rounded to so much. */
static double lost(const pm_workspace *w, double share)
{
    return share * sqrt(pm_contact_reach(w) / w->numbers.size);
}

/* Where the top of a bounce is an instant of its own the contact must not touch there. */
static double lowest_top(const pm_workspace *w) { return w->phase.route->meets_places ? PM_LOWEST_TOP : 0; }

/* Below which rebounds are the last.  Where it is known how long a series goes on it is followed less far; the first rebound of
 * all is followed as far as can be. */
static double last_speed(const pm_workspace *w, int contact)
{
    const double least = pm_bounce_series_is_settled(w, contact) ? PM_BOUNCE_SETTLED : 0,
                 top = w->event->series[contact].known > 1 ? lowest_top(w) : 0;
    return cut_speed(w, fmax(lost(w, PM_LAST_BOUNCE), fmax(least, top)));
}

/* Likewise what parts after a blow at another contact. */
static double spent_speed(const pm_workspace *w, int contact)
{
    const double spent = cut_speed(w, fmax(lost(w, PM_BOUNCE_SPENT), lowest_top(w)));
    return pm_bounce_series_is_settled(w, contact) ? fmax(spent, last_speed(w, contact)) : spent;
}

/* A route resolves the bounces of a contact that is struck alone. */
static int is_resolved(const pm_workspace *w, int contact)
{
    return w->phase.route->resolves && w->phase.route->resolves(w, contact) &&
           !pm_bounce_series_is_of_several(w, contact);
}

/* What parts no faster than this has no speed, however well the route knows places; in a coarse run earlier, as with the others:
 * the blows that are lost have been waited for, and that shows what is made of them. */
static double least_speed(const pm_workspace *w)
{
    return w->numbers.coarse > 1 ? PM_BOUNCE_EARLIER * pm_contact_speed(&w->frame) : 0;
}

double pm_last_bounce_restitution(const pm_workspace *w, int contact, double approach)
{
    const double e = pm_contact_restitution(&w->frame, contact);
    return e * -approach > (is_resolved(w, contact) ? least_speed(w) : last_speed(w, contact)) ? e : 0;
}

double pm_last_bounce_height(const pm_workspace *w, int contact)
{
    const double speed = last_speed(w, contact);
    return 0.5 * speed * speed / pm_case_acceleration(&w->numbers);
}

int pm_last_bounce_is_near(const pm_workspace *w, int contact, double rate)
{
    return !is_resolved(w, contact) && fabs(rate) <= PM_BOUNCE_UNKNOWN * last_speed(w, contact);
}

int pm_last_bounce_is_slow(const pm_workspace *w, int contact, double approach)
{
    return approach <= spent_speed(w, contact);
}

int pm_last_bounce_ends_others(const pm_workspace *w, int contact, double approach)
{
    return pm_bounce_series_is_settled(w, contact) && !is_resolved(w, contact) &&
           pm_last_bounce_is_slow(w, contact, approach);
}

int pm_last_bounce_is_held(const pm_workspace *w, int contact, double rate)
{
    return rate > pm_contact_speed(&w->frame) && pm_last_bounce_is_slow(w, contact, rate) &&
           !is_resolved(w, contact);
}

int pm_last_bounce_is_spent(const pm_workspace *w, int contact, double rate)
{
    return w->event->spent[contact] && rate > pm_contact_speed(&w->frame) && rate <= spent_speed(w, contact);
}
