/* Two curves that touch. */
#ifndef CURVE_PAIR_H
#define CURVE_PAIR_H

#include "elements/contact.h"
#include "equations/active_set.h"
#include "scene.h"
#include "state/workspace.h"

#define TWO_PI 6.283185307179586

/* x = a cos s, y = b sin s (1 + wave cos 3 s), round (at, 0) on a body; free outside. */
static inline int ring(scene *s, int body, double at, double a, double b, double wave)
{
    const scene_code place = scene_m(scene_measure(s, PM_MEASURE_PLACE, PM_NONE));
    const int x = SCENE_PROGRAM(s, scene_k(s, a), place, scene_op(PM_OP_COS), scene_op(PM_OP_MUL)),
              y = SCENE_PROGRAM(s, scene_k(s, b), place, scene_op(PM_OP_SIN), scene_op(PM_OP_MUL),
                                scene_k(s, 1), scene_k(s, wave), scene_k(s, 3), place, scene_op(PM_OP_MUL),
                                scene_op(PM_OP_COS), scene_op(PM_OP_MUL), scene_op(PM_OP_ADD),
                                scene_op(PM_OP_MUL));
    return SCENE_ROW(s, PM_TABLE_CURVE, scene_point(s, body, at, 0), x, y, scene_value(s, 0),
                     scene_value(s, TWO_PI), 1, -1, PM_NONE);
}

/* From (half, y) to (-half, y): free below. */
static inline int bottom(scene *s, int body, double half, double y)
{
    const scene_code place = scene_m(scene_measure(s, PM_MEASURE_PLACE, PM_NONE));
    return SCENE_ROW(s, PM_TABLE_CURVE, scene_point(s, body, 0, y), SCENE_PROGRAM(s, place),
                     SCENE_PROGRAM(s, scene_k(s, 0)), scene_value(s, -half), scene_value(s, half), 0, -1,
                     PM_NONE);
}

static inline int touch(scene *s, int a, int b, double e, int friction)
{
    return scene_contact(s, PM_CONTACT_CURVES, a, b, 0, e, friction, 0.3);
}

/* Either may be the first. */
static inline int touch_in_order(scene *s, int swapped, int a, int b, double e, int friction)
{
    return swapped ? touch(s, b, a, e, friction) : touch(s, a, b, e, friction);
}

#endif
