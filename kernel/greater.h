/* greater.h - the greater or the lesser of two numbers in one instruction (fmax is a call); an x that is no number is left
 * out, as there. */
#ifndef PM_GREATER_H
#define PM_GREATER_H

static inline double pm_greater(double x, double than) { return x > than ? x : than; }
static inline double pm_less(double x, double than) { return x < than ? x : than; }

#endif
