/* curve_piece.c - pieces of curves by points, by the knots of the tables from which their places are read. */
#include "elements/curve_piece.h"

#include <math.h>

#include "expression/piecewise.h"
#include "numerics/tolerances.h"

/* Where a piece begins and ends, in s. */
typedef struct pm_curve_piece {
    double from, to;
} pm_curve_piece;

static int knots_of(const pm_model *m, int curve) { return PM_CURVE_ROW(m, curve)[PM_CURVE_KNOTS]; }

static int is_closed(const pm_frame *frame, int curve) { return pm_curve_is_round(frame->model, curve); }

int pm_curve_has_pieces(const pm_model *m, int curve) { return knots_of(m, curve) != PM_NONE; }

int pm_curve_any_pieces(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_CURVE]; i++)
        if (pm_curve_has_pieces(m, i)) return 1;
    return 0;
}

static pm_curve_piece whole(const pm_frame *frame, int curve)
{
    return (pm_curve_piece){pm_curve_bound(frame, curve, PM_CURVE_FROM),
                            pm_curve_bound(frame, curve, PM_CURVE_TO)};
}

double pm_curve_laps(const pm_frame *frame, int curve, double s)
{
    const pm_curve_piece all = whole(frame, curve);
    const double lap = all.to - all.from;
    return is_closed(frame, curve) ? lap * floor((s - all.from) / lap) : 0;
}

static pm_curve_piece piece_of(const pm_frame *frame, int curve, double s)
{
    const pm_curve_piece all = whole(frame, curve);
    if (!pm_curve_has_pieces(frame->model, curve)) return all;
    const pm_piecewise p = pm_piecewise_of(frame->model, knots_of(frame->model, curve));
    const double laps = pm_curve_laps(frame, curve, s);
    const double n = pm_piecewise_number(&p, fmin(fmax(s - laps, all.from), all.to));
    return (pm_curve_piece){fmax(pm_piecewise_begin(&p, n), all.from) + laps,
                            fmin(pm_piecewise_begin(&p, n + 1), all.to) + laps};
}

/* So far from a knot a place is surely in its piece. */
static double beside(const pm_frame *frame, int curve)
{
    const pm_curve_piece all = whole(frame, curve);
    return PM_CURVE_BESIDE * (all.to - all.from);
}

double pm_curve_piece_within(const pm_frame *frame, int curve, double s, double of)
{
    if (!pm_curve_has_pieces(frame->model, curve)) return s;
    const pm_curve_piece piece = piece_of(frame, curve, of);
    const double off = fmin(beside(frame, curve), 0.5 * (piece.to - piece.from));
    return fmin(fmax(s, piece.from + off), piece.to - off);
}

double pm_curve_piece_ahead(const pm_frame *frame, int curve, double s, double way, double nothing)
{
    const pm_curve_piece piece = piece_of(frame, curve, s);
    double of = s;
    if (way > 0 && piece.to - s <= nothing) of = piece.to + beside(frame, curve);
    if (way < 0 && s - piece.from <= nothing) of = piece.from - beside(frame, curve);
    return pm_curve_piece_within(frame, curve, s, of);
}

double pm_curve_piece_room(const pm_frame *frame, int curve, const pm_curve_place *x, double of)
{
    const pm_curve_piece piece = piece_of(frame, curve, of);
    return fabs(x->rate) * (x->s - piece.from) * (piece.to - x->s) / (piece.to - piece.from);
}

int pm_curve_piece_is_last(const pm_frame *frame, int curve, double s)
{
    const pm_curve_piece all = whole(frame, curve), piece = piece_of(frame, curve, s);
    if (is_closed(frame, curve)) return 0;
    return s - piece.from < piece.to - s ? piece.from <= all.from : piece.to >= all.to;
}
