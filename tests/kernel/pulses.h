/* pulses.h - programs of the time that act for a short while: rectangles, bells and half sines. */
#ifndef PULSES_H
#define PULSES_H

#include "scene.h"

typedef struct pulse {
    int shape;
    double impulse, middle, width; /* N s, s, s */
} pulse;

static inline double pi(void) { return 4 * atan(1); }

/* impulse / width while t is within half a width of the middle. */
static inline int pulse_rectangle(scene *s, int t, const pulse *p)
{
    return SCENE_PROGRAM(s, scene_m(t), scene_k(s, p->middle), scene_op(PM_OP_SUB), scene_op(PM_OP_ABS),
                         scene_k(s, 0.5 * p->width), scene_op(PM_OP_LT), scene_k(s, p->impulse / p->width),
                         scene_op(PM_OP_MUL));
}

/* Its integral is the root of pi times the impulse. */
static inline int pulse_bell(scene *s, int t, const pulse *p)
{
    return SCENE_PROGRAM(s, scene_m(t), scene_k(s, p->middle), scene_op(PM_OP_SUB), scene_k(s, p->width),
                         scene_op(PM_OP_DIV), scene_k(s, 2), scene_op(PM_OP_POW), scene_op(PM_OP_NEG),
                         scene_op(PM_OP_EXP), scene_k(s, p->impulse / p->width), scene_op(PM_OP_MUL));
}

/* Its integral is 2 / pi times the impulse. */
static inline int pulse_half_sine(scene *s, int t, const pulse *p)
{
    return SCENE_PROGRAM(s, scene_m(t), scene_k(s, p->middle), scene_op(PM_OP_SUB), scene_op(PM_OP_ABS),
                         scene_k(s, 0.5 * p->width), scene_op(PM_OP_LT), scene_m(t), scene_k(s, p->middle),
                         scene_op(PM_OP_SUB), scene_k(s, pi() / p->width), scene_op(PM_OP_MUL),
                         scene_op(PM_OP_COS), scene_op(PM_OP_MUL), scene_k(s, p->impulse / p->width),
                         scene_op(PM_OP_MUL));
}

#endif
