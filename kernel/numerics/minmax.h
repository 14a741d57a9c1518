/* minmax.h - the greater or the lesser of two numbers in one instruction (fmax is a call); an x that is no number is left
 * out, as there. */
#ifndef PM_MINMAX_H
#define PM_MINMAX_H

static inline double pm_max(double x, double than) { return x > than ? x : than; }
static inline double pm_min(double x, double than) { return x < than ? x : than; }

#endif
