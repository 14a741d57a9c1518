/* minimum.h - the least value of a function between two places, by values alone: GSL's minimiser of Brent. */
#ifndef PM_MINIMUM_H
#define PM_MINIMUM_H

void *pm_minimum_create(void);
void pm_minimum_free(void *solver);

/* f(x) = fx is less than f(a) = fa and f(b) = fb, a < x < b. */
typedef struct pm_valley {
    double a, fa, x, fx, b, fb;
} pm_valley;

/* Where it stops: after so many values, or at this width: absolute, or relative to the farther end. */
typedef struct pm_closeness {
    int values;
    double absolute, relative;
} pm_closeness;

/* The place of the least value that was found; where f is not a number, the search ends. */
double pm_minimum_find(void *solver, double (*f)(double, void *), void *context, const pm_valley *in,
                       const pm_closeness *to);

#endif
