/* curve_piece.h - the pieces of curves by points: between two knots one polynomial.
 *
 * At a knot the third derivative jumps.  What goes along such a curve follows one piece, beyond its ends, too, until it comes
 * to a knot: there a phase ends, and the next one follows the next piece.  Any other curve is one piece. */
#ifndef PM_CURVE_PIECE_H
#define PM_CURVE_PIECE_H

#include "elements/curve.h"

/* The curve has knots. */
int pm_curve_has_pieces(const pm_model *m, int curve);
int pm_curve_any_pieces(const pm_model *m);
/* The laps before s, in s: 0 of an open curve. */
double pm_curve_laps(const pm_frame *frame, int curve, double s);

/* The place nearest to s within the piece of `of`, by more than rounding. */
double pm_curve_piece_within(const pm_frame *frame, int curve, double s, double of);
/* A place within the piece into which s moves `way`; what is no farther than `nothing` from a knot is on it. */
double pm_curve_piece_ahead(const pm_frame *frame, int curve, double s, double way, double nothing);
/* How far a place is from the nearer end of the piece of `of`, m, about: negative beyond an end. */
double pm_curve_piece_room(const pm_frame *frame, int curve, const pm_curve_place *x, double of);
/* The end of a piece that is nearer to s is an end of the curve. */
int pm_curve_piece_is_last(const pm_frame *frame, int curve, double s);

#endif
