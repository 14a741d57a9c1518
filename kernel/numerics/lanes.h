/* lanes.h - two numbers that a processor combines at once: the same operations on each, so the same bits as one by one. */
#ifndef PM_LANES_H
#define PM_LANES_H

#include <float.h>
#include <math.h>
#include <string.h>

typedef double pm_lanes __attribute__((vector_size(2 * sizeof(double))));

static inline pm_lanes pm_lanes_load(const double *from)
{
    pm_lanes x;
    memcpy(&x, from, sizeof x);
    return x;
}

static inline void pm_lanes_store(double *to, pm_lanes x) { memcpy(to, &x, sizeof x); }

/* With the third number of a body's velocity, acceleration or force. */
static inline void pm_lanes_store_three(double *to, pm_lanes x, double third)
{
    pm_lanes_store(to, x);
    to[2] = third;
}

/* n times three numbers; of few the call that copies memory costs more than the copy. */
static inline void pm_lanes_copy_threes(double *to, const double *from, int n)
{
    for (const double *end = from + 3 * n; from < end; from += 3, to += 3)
        pm_lanes_store_three(to, pm_lanes_load(from), from[2]);
}

/* A vector rotated by a right angle. */
static inline pm_lanes pm_lanes_left(pm_lanes v) { return (pm_lanes){-v[1], v[0]}; }

/* Cosine and sine of an angle, by one call where the library has one: it gives what the two give. */
static inline pm_lanes pm_lanes_direction(double angle)
{
#ifdef __GLIBC__
    double sine, cosine;
    sincos(angle, &sine, &cosine);
    return (pm_lanes){cosine, sine};
#else
    return (pm_lanes){cos(angle), sin(angle)};
#endif
}

/* Likewise, of a line: one at a right angle, as near as doubles are, lies along an axis.  Its cosine would be 6e-17, and by that
 * much a wall would throw what comes straight at it aside. */
static inline pm_lanes pm_lanes_axis(double angle)
{
    const pm_lanes x = pm_lanes_direction(angle);
    const double rounding = 0.5 * DBL_EPSILON * fabs(angle);
    if (fabs(x[0]) <= rounding) return (pm_lanes){0, copysign(1, x[1])};
    if (fabs(x[1]) <= rounding) return (pm_lanes){copysign(1, x[0]), 0};
    return x;
}

static inline double pm_lanes_sum(pm_lanes v) { return v[0] + v[1]; }

#endif
