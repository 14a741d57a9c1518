/* enclosure.h - a program enclosed over a stretch of time, or of a step: bounds of its value, rate and bend, and where it
 * switches.
 *
 * A program is smooth but where an operation switches: a comparison, a choice, abs, min, max or floor whose operands change
 * sides, and atan2 that leaps from pi to -pi.  Over a stretch a switch is decided (its operands keep their sides), or it is
 * open. Over a stretch of time, all that a program reads beside the time - measures of the motion, answers - is taken as the
 * number 1: the enclosure bounds what the time alone does, and says nothing of switches by the motion. */
#ifndef PM_ENCLOSURE_H
#define PM_ENCLOSURE_H

#include "numerics/chebyshev_series.h"
#include "numerics/interval.h"
#include "state/model.h"

/* Where it is no number: beyond the domain of a root, a logarithm, an arc. */
enum pm_gaps { PM_GAPS_NONE = 0, PM_GAPS_SOMEWHERE = 1, PM_GAPS_EVERYWHERE = 2 };

/* A number along a stretch, and its first two derivatives by the time. */
typedef struct pm_jet {
    double at[3]; /* its value at the beginning, in the middle, at the end */
    pm_interval value, rate, bend;
    int motion; /* something else than the time enters */
    int gaps;   /* enum pm_gaps: in the stretch, as far as is known */
} pm_jet;

typedef struct pm_enclosure {
    pm_jet jet;
    int open;    /* switches that are not decided */
    int changes; /* of them those that stand otherwise at the end than at the beginning */
} pm_enclosure;

/* Program `index` from the time `from` to `to`, with the numbers of the case: param[nparam], value[nvalue]. */
pm_enclosure pm_enclosure_of_time(const pm_model *m, int index, const double *param, const double *value,
                                  double from, double to);

/* Measures along a step, as series through their samples (numerics/chebyshev_series.h): that of measure i is
 * series[place[i]]. */
typedef struct pm_measure_series {
    pm_chebyshev_series *series;
    const int *place;
} pm_measure_series;

/* Program `index`, folded (program_fold.h) with the numbers of the case number[nnumber], over the part [from, to] of a step,
 * 0 <= from <= to <= 1, along which its measures are known; rates and bends are by that fraction.  Answers are taken as above. */
pm_enclosure pm_enclosure_along(const pm_model *m, int index, const double *number,
                                const pm_measure_series *along, double from, double to);

/* Its bends there, by series of high order (enclosure_series.c): narrower, and dearer, where it has no open switch. */
pm_interval pm_enclosure_bends_along(const pm_model *m, int index, const double *number,
                                     const pm_measure_series *along, double from, double to);

/* The program at one place, of the branch with these signs of its switches (pm_switches in program.h); NULL: the one that is taken
 * there. */
pm_jet pm_enclosure_at(const pm_model *m, int index, const double *number, const pm_measure_series *along,
                       const signed char *sign, double s);

/* A measure over a part of a step, by the series through its samples. */
pm_jet pm_enclosure_of_series(const pm_chebyshev_series *series, double from, double to);

/* The bends of a program at the samples of a stretch, widened by what changes nothing and by how far samples tell more than
 * themselves: they do not show a bend in between that lies outside. */
pm_interval pm_enclosure_sampled_bends(pm_interval at_samples, double nothing);

/* ---- enclosure_rules.c: what operations make of jets ---- */
pm_jet pm_jet_of_one(int op, const pm_jet *a);
pm_jet pm_jet_of_two(int op, const pm_jet *a, const pm_jet *b);
pm_jet pm_jet_difference(const pm_jet *a, const pm_jet *b);
/* Either of the two. */
pm_jet pm_jet_hull(const pm_jet *a, const pm_jet *b);
/* Whether an operation that switches by x stands alike all along: x keeps off zero (floor: off integers), or is monotonic and
 * stands alike at both ends. */
int pm_jet_keeps_side(int op, const pm_jet *x);
/* The operand with whose sign atan2(y, x) may leap, where x < 0: y, or x where y is 0 all along; NULL: none. */
const pm_jet *pm_jet_leaps_with(const pm_jet *y, const pm_jet *x);
/* It stands otherwise at the end than at the beginning. */
int pm_jet_changes(int op, const pm_jet *x);

/* ---- enclosure_table.c ---- */
/* Of an operation that reads the piecewise polynomial `row`, on the operands a[]. */
pm_jet pm_jet_of_table(const pm_model *m, int op, int row, const pm_jet *a);
/* In which piece an argument lies, as a jet that switches like floor does. */
pm_jet pm_jet_of_pieces(const pm_model *m, int row, const pm_jet *a);

#endif
