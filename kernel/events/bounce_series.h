/* bounce_series.h - when a series of ever smaller bounces comes to its end, though it is cut off before. */
#ifndef PM_BOUNCE_SERIES_H
#define PM_BOUNCE_SERIES_H

#include "state/workspace.h"

int pm_bounce_series_create(pm_workspace *w);
/* A run begins: nothing has been struck. */
void pm_bounce_series_begin(const pm_workspace *w);
/* Nothing is known of the contact's blows any more. */
void pm_bounce_series_forget(const pm_workspace *w, int contact);
/* The contact is struck now, at this speed, m/s. */
void pm_bounce_series_strike(const pm_workspace *w, int contact, double approach);
/* The blows of this instant are done: a contact that was struck and stays closed has bounced for the last time that is
 * computed.  Where the route path is asked for, which knows no time, nothing waits for the end of the series. */
void pm_bounce_series_cut(pm_workspace *w);
/* 1 if the flights of the contact, or of the order of blows that it is part of, shrink by a ratio that is known: so are
 * those that are not computed. */
int pm_bounce_series_is_settled(const pm_workspace *w, int contact);
/* 1 if they hardly shrink at all: what bounces so low that it is cut off goes on bouncing, and nobody knows until when. */
int pm_bounce_series_is_endless(const pm_workspace *w, int contact);
/* A blow presses the contact: if it bounced without an end, it has done. */
void pm_bounce_series_press(const pm_workspace *w, int contact);
/* Where nothing moves any more but for such bounces: PM_BOUNCES_ON. */
int pm_bounce_series_check(pm_workspace *w);
/* The blow of this instant leaves the contact closed because what it would do then is not followed. */
void pm_bounce_series_hold(const pm_workspace *w, int contact);
/* 1 if that has happened now to a contact that shares a body with this one. */
int pm_bounce_series_ends_beside(const pm_workspace *w, int contact);
/* 1 if that is an order of several contacts. */
int pm_bounce_series_is_of_several(const pm_workspace *w, int contact);
/* 1 if the other contact, or itself, has its part in the same order of blows. */
int pm_bounce_series_share(const pm_workspace *w, int contact, int other);
/* The next time at which such a series is over, s; INFINITY: none is going on. */
double pm_bounce_series_next(const pm_workspace *w);
/* 1 if such a series is over by now; it is forgotten. */
int pm_bounce_series_end(pm_workspace *w);
/* 1 if the contact has been closed, and still bounces. */
int pm_bounce_series_goes_on(const pm_workspace *w, int contact);
/* 1 if a contact of the body (PM_NONE: any contact) still bounces. */
int pm_bounce_series_moves(const pm_workspace *w, int body);

#endif
