/* tolerances.h - every number of the kernel that decides something: what counts as zero, as equal, as lost, as too many.
 *
 * One line each: the value, its unit ("of x": relative to x), why it is that, and what a larger one would do.  Nothing with
 * a dimension is compared with a bare number: sizes come from the case (numbers.size in m, numbers.speed in m/s) or from the
 * terms that were summed.  Where a number was calibrated the table of that calibration is named.  Numbers that decide
 * nothing - coefficients of a formula, lengths of arrays - stand where they are used. */
#ifndef PM_TOLERANCES_H
#define PM_TOLERANCES_H

/* ---- all rooms ---- */

#define PM_EPSILON 2.3e-16 /* of a number: rounding of one operation; more would stop searches earlier */

/* ---- numerics ---- */

#define PM_BRACKET_VALUES 300    /* values: a triple root takes 140; more would only put off the message */
#define PM_BRACKET_WIDTH 1e-14   /* of the bracket: a root near x = 0 is that close; more would move events */
#define PM_BRACKET_NOTHING 1e-16 /* of the bracket: a shift of Newton that gains nothing; likewise */
#define PM_BRACKET_POLISHED 1e-15  /* of the step: a shift that gains nothing on exact states; likewise */
#define PM_BRACKET_SLOPE_STEP 1e-4 /* of the step: distance of differences; more: curvature spoils slopes */
#define PM_BRACKET_FAR 0.1       /* of the step: a longer shift is no polish, it may leave for another root */
#define PM_CHEBYSHEV_SMOOTH 1e-3 /* of the values: tail of what has no corners; more would miss some */

/* ---- state ---- */

/* ---- expression ---- */

/* ---- elements ---- */

/* ---- scene ---- */

/* ---- equations ---- */
#define PM_MOST_MEMBERS 1e9     /* of a periodic row: int32 numbers them; more would not be told apart */
#define PM_LEDGER_ROUNDING 1e-7 /* relative residual: long runs gather rounding; larger: blind at tight accuracy */
#define PM_LEDGER_ERRORS 2e3    /* of the tolerance: a thousand blows leave 475 (studies, 1e-2 .. 1e-12); larger: blind */
#define PM_LEDGER_MOST 0.05     /* of all energy or momentum: no answer stands with more; larger: blind when loose */

/* ---- tree ---- */

/* ---- events ---- */

/* ---- impact ---- */

/* ---- routes/path ---- */

/* ---- routes/rk ---- */

/* ---- routes/ida ---- */

/* ---- routes/uniform ---- */

/* ---- routes/start ---- */

/* ---- run ---- */

/* ---- study ---- */

#endif
