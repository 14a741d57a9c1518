/* tolerances.h - every number of the kernel that decides something: what counts as zero, as equal, as lost, as too many.
 *
 * One line each: the value, its unit ("of x": relative to x), why it is that, and what a larger one would do.  Nothing with
 * a dimension is compared with a bare number: sizes come from the case (numbers.size in m, numbers.speed in m/s) or from the
 * terms that were summed.  Where a number was calibrated the table of that calibration is named.  Numbers that decide
 * nothing - coefficients of a formula, lengths of arrays - stand where they are used. */
#ifndef PM_TOLERANCES_H
#define PM_TOLERANCES_H

/* ---- all rooms ---- */

/* ---- numerics ---- */

/* ---- state ---- */

/* ---- expression ---- */

/* ---- elements ---- */

/* ---- scene ---- */

/* ---- equations ---- */

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
