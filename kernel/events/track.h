/* track.h - what runs along a curve comes to an end of it, or of one of its pieces. */
#ifndef PM_TRACK_H
#define PM_TRACK_H

#include "state/workspace.h"

/* The joint is there and on a curve that ends, or whose pieces do. */
int pm_track_ends(const pm_workspace *w, int joint);
/* How far its foot is from the nearer end of them, m. */
double pm_track_left(const pm_frame *frame, int joint);
/* The end that is nearer is one of the curve. */
int pm_track_is_at_end(const pm_frame *frame, int joint);
/* PM_CURVE_ENDS, where = joint: at this instant what runs along a curve comes to its end. */
int pm_track_check(pm_workspace *w);

#endif
