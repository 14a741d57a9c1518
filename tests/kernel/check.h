/* check.h - checks that say what they saw: a test prints every failure and returns check_failures() from main. */
#ifndef CHECK_H
#define CHECK_H

#include <math.h>
#include <stdio.h>

static int check_count;

static inline int check_failures(void) { return check_count > 0; }

static inline int check_report(int good, const char *file, int line, const char *function, const char *what)
{
    if (good) return 1;
    check_count++;
    fprintf(stderr, "%s:%d: %s: %s\n", file, line, function, what);
    return 0;
}

/* |a - b| <= tolerance, or both are not a number. */
static inline int check_near(double a, double b, double tolerance, const char *file, int line,
                             const char *function, const char *what)
{
    if (fabs(a - b) <= tolerance || (isnan(a) && isnan(b)) || a == b) return 1;
    check_count++;
    fprintf(stderr, "%s:%d: %s: %s: %.17g, expected %.17g, off by %.3g > %.3g\n", file, line, function, what,
            a, b, fabs(a - b), tolerance);
    return 0;
}

#define CHECK(condition) check_report((condition) != 0, __FILE__, __LINE__, __func__, #condition)
#define EQUAL(a, b) check_near((double)(a), (double)(b), 0, __FILE__, __LINE__, __func__, #a)
#define NEAR(a, b, tolerance) check_near(a, b, tolerance, __FILE__, __LINE__, __func__, #a)

/* The same numbers in every run: a linear congruential generator, uniform in [low, high). */
static inline double check_random(double low, double high)
{
    static unsigned long long state = 2385;
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return low + (high - low) * (double)(state >> 11) / 9007199254740992.0;
}

/* Likewise, uniform in its logarithm. */
static inline double check_logarithmic(double low, double high)
{
    return exp(check_random(log(low), log(high)));
}

#endif
