/* bracket.h - roots and minima of functions of one variable, inside a bracket that is known.
 *
 * A root: by GSL's Brent method, or, where the slope is known, by Newton's method kept inside the bracket.  A minimum: by
 * GSL's Brent minimiser, from values alone.  Nothing here knows what the variable is. */
#ifndef PM_BRACKET_H
#define PM_BRACKET_H

/* How a search ended. */
enum pm_search_end {
    PM_SEARCH_FOUND = 0,
    PM_SEARCH_TOO_MANY = 1, /* not so close after so many values as was asked; the best place is told */
    PM_SEARCH_NO_NUMBER = 2 /* the function was not a number somewhere, or is not as its bracket says */
};

/* A function f(x) that belongs to `of`; `context` says which one it is.  Not a number where it has no value. */
typedef double pm_along(void *of, double x, void *context);
/* The same, with its slope. */
typedef double pm_sloped(void *of, double x, void *context, double *slope);

/* What the searches of one thread work in; NULL: out of memory.  One for roots, one for minima. */
void *pm_bracket_create(void);
void pm_bracket_free(void *solver);
void *pm_bracket_minimum_create(void);
void pm_bracket_minimum_free(void *solver);

/* A root of f in [a, b], where f(a) = fa and f(b) = fb differ in sign; to the rounding of x.  Returns enum pm_search_end. */
int pm_bracket_find(void *solver, pm_along *f, void *of, void *context, double a, double fa, double b,
                    double fb, double *root);
int pm_bracket_newton(pm_sloped *f, void *of, void *context, double a, double fa, double b, double fb,
                      double *root);

/* The slope of f at x by a difference over d to either side; over what lies in [begin, end] where it has no value beyond. */
double pm_bracket_slope(pm_along *f, void *of, void *context, double begin, double end, double x, double d);

/* What is known exactly only at places that are looked at: the value there, and a status (0: well). */
typedef int pm_exactly(void *of, double x, void *context, double *value);

/* Moves a root *x of the approximation f, inside [begin, end], to where the exact function is zero, or least of all values that
 * were taken: *off.  *taken is the last place where one was taken.  slope: of f at the root, or NAN: it is found by
 * differences.  Returns the status of `exactly`. */
int pm_bracket_polish(pm_along *f, pm_exactly *exactly, void *of, void *context, double begin, double end,
                      double slope, double *x, double *taken, double *off);

/* f(x) = fx is less than f(a) = fa and f(b) = fb, a < x < b. */
typedef struct pm_valley {
    double a, fa, x, fx, b, fb;
} pm_valley;

/* Where a minimum is close enough: after at most so many values, at this width: absolute, or of the farther end. */
typedef struct pm_closeness {
    int values;
    double absolute, relative;
} pm_closeness;

/* The place of the least value that was found.  Returns enum pm_search_end; *place is the best one in each case. */
int pm_bracket_minimum(void *solver, double (*f)(double, void *), void *context, const pm_valley *in,
                       const pm_closeness *to, double *place);

#endif
