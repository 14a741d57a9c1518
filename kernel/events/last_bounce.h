/* last_bounce.h - the end of a series of ever smaller bounces: the rebound after which a contact rests. */
#ifndef PM_LAST_BOUNCE_H
#define PM_LAST_BOUNCE_H

#include "state/workspace.h"

/* Restitution of a blow with this speed of approach, m/s: 0 where its rebound is the last. */
double pm_last_bounce_restitution(const pm_workspace *w, int contact, double approach);
/* How high a contact rises by the fastest rebounds that are not computed, m. */
double pm_last_bounce_height(const pm_workspace *w, int contact);
/* 1 if a contact that touches at `rate` of its gap, m/s, is so near to its last rebound that the number of blows that are
 * left is not known, and decides nothing. */
int pm_last_bounce_is_near(const pm_workspace *w, int contact, double rate);
/* 1 if a blow of the contact with this speed of approach, m/s, is one of the last of a series. */
int pm_last_bounce_is_slow(const pm_workspace *w, int contact, double approach);
/* 1 if with it the blows of all contacts end that share the order of its series (bounce_series.h). */
int pm_last_bounce_ends_others(const pm_workspace *w, int contact, double approach);
/* 1 if a closed contact that so slow a blow lets part at `rate`, m/s, would not part by more than rounding shows: it is
 * held. */
int pm_last_bounce_is_held(const pm_workspace *w, int contact, double rate);
/* 1 if the contact, which parts at `rate`, has been over by less than rounding shows: the bounce is spent, and its speed is
 * to be taken away as if by one more, plastic, blow. */
int pm_last_bounce_is_spent(const pm_workspace *w, int contact, double rate);

#endif
